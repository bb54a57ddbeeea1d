//! Which samples of BSDF sampling and of light sampling contribute, for two lobes and two lights.

use super::Figure;
use super::angle::write;
use super::label::Label;
use super::pen::{Fill, IMAGE, INK, LIGHT, Pen, RAY, WIDTH};
use super::svg::{Drawing, Svg};
use glam::{DVec2, DVec3};
use pinhole::Result;
use pinhole::extract::{SamplingTable, SphereTable, camera_entity};
use pinhole::material::{Bsdf, MaterialKind, MaterialTable, MetalTable, ShadingContext, mirror_direction};
use pinhole::plan::{Census, Table};
use pinhole::sample::{Draw, PixelKey, Purpose, SampleIndex, Sobol, unit};
use pinhole::shapes::emitter::{sphere_pdf, sphere_point};
use pinhole::shapes::sphere_t;
use pinhole::{Chapter, Overrides};
use std::f64::consts::TAU;

/// Samples of each strategy; and of those that the integral is estimated by.
const SAMPLES: u32 = 32;
const MANY: u32 = 1 << 14;
const HEIGHT: f64 = 760.0;
/// The angle of the eye to the normal, in degrees, and the distance of the lights, whose middle is in the direction of
/// specular reflection.
const EYE: f64 = 35.0;
const DISTANCE: f64 = 3.0;
/// Half the side of a map of directions in the drawing, and the tangent of the angle from its middle to there.
const MAP: f64 = 80.0;
const MAP_TANGENT: f64 = 0.4;
/// From the top: the points, and the middles of the maps.
const POINTS: f64 = 186.0;
const MAPS: [f64; 2] = [320.0, 588.0];
/// A sample that brings less than this fraction of the integral counts as none.
const MIN: f64 = 0.1;

/// A point of metal that shows a spherical light.
struct Case {
    metals: MetalTable,
    context: ShadingContext,
    to_eye: DVec3,
    light: DVec3,
    radius: f64,
}

/// A chapter's roughest and its smoothest metal, with its second smallest and its largest spherical light.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let scene = chapter.world(&Overrides::default());
    camera_entity(&scene)?;
    let census = &Census::of(&scene);
    let pixel = PixelKey::new(SamplingTable::extract(census)?.seed, [240, 135]);
    let (metals, materials) = (MetalTable::extract(census)?, MaterialTable::extract(census)?);
    let mut of_metals: Vec<ShadingContext> = (0..materials.kind.len())
        .filter(|&material| materials.kind[material] == MaterialKind::Metal)
        .map(|material| ShadingContext::opaque(materials.row[material] as usize, materials.parameters[material]))
        .collect();
    let alpha = |of: &ShadingContext| of.parameters.roughness;
    of_metals.sort_by(|a, b| alpha(b).total_cmp(&alpha(a)));
    let mut radii: Vec<f64> = SphereTable::extract(census)?.row.iter().map(|sphere| sphere.radius).collect();
    radii.sort_by(f64::total_cmp);
    let (&[wide, .., narrow], &[_, small, .., large]) = (&of_metals[..], &radii[..]) else {
        return Err(figure.unsuited("two metals and three spherical lights"));
    };
    let angle = EYE.to_radians();
    let to_eye = DVec3::new(-libm::sin(angle), 0.0, libm::cos(angle));
    let light = mirror_direction(-to_eye, DVec3::Z) * DISTANCE;
    let case = |context, radius| Case { metals: metals.clone(), context, to_eye, light, radius };
    let cases = [
        (["narrow lobe", "large light"], case(narrow, large)),
        (["narrow lobe", "small light"], case(narrow, small)),
        (["wide lobe", "large light"], case(wide, large)),
        (["wide lobe", "small light"], case(wide, small)),
    ];
    let mut svg = Svg::new(figure.name, HEIGHT);
    for (strategy, y) in ["BSDF sampling", "light sampling"].into_iter().zip(MAPS) {
        write(&mut svg, DVec2::new(8.0, y - MAP - 20.0), "start", &format!("{strategy}, *N* = {SAMPLES}"));
    }
    for (number, (names, case)) in cases.into_iter().enumerate() {
        let middle = WIDTH * (2.0 * number as f64 + 1.0) / 8.0;
        for (name, y) in names.into_iter().zip([20.0, 46.0]) {
            write(&mut svg, DVec2::new(middle, y), "middle", name);
        }
        case.paint_side(&mut svg, DVec2::new(middle - 14.0, POINTS), number == 0);
        let integral = case.integral(pixel);
        for (by_light, y) in [false, true].into_iter().zip(MAPS) {
            let samples: Vec<_> = (0..SAMPLES).map(|n| case.sample(by_light, n, SAMPLES, pixel)).collect();
            let count = paint_map(&mut svg, DVec2::new(middle, y), &case, &samples, integral);
            let colour = if count == 0 { INK } else { RAY };
            let told = format!("{count} of {SAMPLES}");
            let below = Label::near(DVec2::new(middle, y + MAP), &told, DVec2::Y, 7.0);
            svg.label(below.large().coloured(colour).title(1.0));
            let deviation = case.deviation(by_light, integral, pixel);
            let told = match deviation {
                ..0.01 => "*σ* < 0.01 *I*".to_owned(),
                ..1.0 => format!("*σ* = {deviation:.2} *I*"),
                _ => format!("*σ* = {deviation:.1} *I*"),
            };
            svg.label(Label::near(DVec2::new(middle, y + MAP + 26.0), &told, DVec2::Y, 7.0).large());
        }
    }
    let alphas = format!("α = {} and {}", alpha(&narrow), alpha(&wide));
    let note = format!("metal of {alphas}, radius {large} and {small}");
    let foot = format!("scene {}, {note} · cargo run --release -- figure {}", chapter.name, figure.name);
    Ok(svg.finish(figure.about, &foot))
}

impl Case {
    /// The BSDF times the cosine.
    fn reflected(&self, to_light: DVec3) -> f64 {
        self.metals.eval(&self.context, to_light, self.to_eye)[0] * to_light.z.max(0.0)
    }

    /// Whether a direction finds the light.
    fn finds(&self, direction: DVec3) -> bool {
        sphere_t(DVec3::ZERO, direction, self.light, self.radius) < f64::INFINITY
    }

    /// The pdfs of a direction by both strategies: of the light's points, and of the BSDF.
    fn pdfs(&self, direction: DVec3) -> [f64; 2] {
        let by_light = if self.finds(direction) { sphere_pdf(self.light, self.radius) } else { 0.0 };
        [by_light, self.metals.pdf(&self.context, direction, self.to_eye)]
    }

    /// A direction of one strategy, and what it brings of a light of radiance 1.
    fn sample(&self, by_light: bool, number: u32, samples: u32, pixel: PixelKey) -> (DVec3, f64) {
        let sample = SampleIndex { number, samples, depth: 0 };
        let purpose = if by_light { Purpose::LightPoint } else { Purpose::Direction };
        let numbers = Sobol::of(sample, purpose).two(pixel).map(unit);
        if by_light {
            let point = sphere_point(self.light, self.radius, numbers);
            let direction = point.to.normalize();
            return (direction, self.reflected(direction) / point.pdf);
        }
        let choice = unit(Sobol::of(sample, Purpose::MaterialChoice).one(pixel));
        match self.metals.sample(&self.context, self.to_eye, numbers, choice) {
            Some(sample) => (sample.to_light, if self.finds(sample.to_light) { sample.weight[0] } else { 0.0 }),
            None => (-DVec3::Z, 0.0),
        }
    }

    /// What the light brings in all, by many samples of both strategies with the balance heuristic.
    fn integral(&self, pixel: PixelKey) -> f64 {
        let weighted = |by_light: bool, number: u32| {
            let (direction, brought) = self.sample(by_light, number, MANY, pixel);
            let [p, q] = self.pdfs(direction);
            if brought > 0.0 { brought * if by_light { p } else { q } / (p + q) } else { 0.0 }
        };
        (0..MANY).map(|number| weighted(false, number) + weighted(true, number)).sum::<f64>() / f64::from(MANY)
    }

    /// The standard deviation of one sample of a strategy over the integral.
    fn deviation(&self, by_light: bool, integral: f64, pixel: PixelKey) -> f64 {
        let square = |number: u32| {
            let apart = self.sample(by_light, number, MANY, pixel).1 / integral - 1.0;
            apart * apart
        };
        ((0..MANY).map(square).sum::<f64>() / f64::from(MANY)).sqrt()
    }

    /// The point from the side: the ray to the eye, the lobe in the plane of both, and the light.
    fn paint_side(&self, svg: &mut Svg, foot: DVec2, is_named: bool) {
        let on_page = |direction: DVec3| DVec2::new(direction.x, -direction.z);
        let axis = self.light / DISTANCE;
        let shown = 100.0;
        svg.line(foot - DVec2::X * 64.0, foot + DVec2::X * 92.0, Pen::new(INK, 1.6));
        svg.arrow(foot, foot + on_page(self.to_eye) * 90.0, Pen::new(INK, 1.4));
        let at = foot + on_page(axis) * shown;
        svg.circle(at, shown * self.radius / DISTANCE, Some(&Fill::new(LIGHT, 0.7)), Some(Pen::new(LIGHT, 1.2)));
        let steps = 720;
        let in_plane = |step: u32| {
            let angle = (f64::from(step) / f64::from(steps) - 0.5) * 0.5 * TAU;
            DVec3::new(libm::sin(angle), 0.0, libm::cos(angle))
        };
        let highest = (0..=steps).map(|step| self.reflected(in_plane(step))).fold(0.0, f64::max);
        let lobe = |step: u32| foot + on_page(in_plane(step)) * (82.0 * self.reflected(in_plane(step)) / highest);
        let lobe: Vec<DVec2> = (0..=steps).map(lobe).collect();
        svg.polygon(&lobe, Some(&Fill::new(IMAGE, 0.5)), Some(Pen::new(IMAGE, 1.2)));
        if is_named {
            let eye = Label::near(foot + on_page(self.to_eye) * 90.0, "*ω*ₒ", DVec2::new(-1.0, 0.3), 5.0);
            svg.label(eye.large());
        }
    }
}

/// Directions as the point sees them around the light's middle, with the light, the part of the lobe above half its
/// height, and each sample as a dot whose area is what it brings; returns how many contribute.
fn paint_map(svg: &mut Svg, middle: DVec2, case: &Case, samples: &[(DVec3, f64)], integral: f64) -> usize {
    let axis = case.light / DISTANCE;
    let (right, up) = (DVec3::Y.cross(axis), DVec3::Y);
    let at = |direction: DVec3| {
        let ahead = direction.dot(axis);
        let place = DVec2::new(direction.dot(right), -direction.dot(up)) / ahead / MAP_TANGENT;
        (ahead > 0.0 && place.abs().max_element() < 0.98).then_some(middle + place * MAP)
    };
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let corners = corners.map(|(x, y)| middle + DVec2::new(x, y) * MAP);
    svg.polygon(&corners, None, Some(Pen::new(INK, 1.0).faint(0.6)));
    let sine = case.radius / DISTANCE;
    let radius = sine / (1.0 - sine * sine).sqrt() / MAP_TANGENT * MAP;
    svg.circle(middle, radius, Some(&Fill::new(LIGHT, 0.22)), Some(Pen::new(LIGHT, 1.8)));
    let direction_at =
        |turn: f64, tangent: f64| (axis + (right * libm::cos(turn) + up * libm::sin(turn)) * tangent).normalize();
    let half = 0.5 * case.reflected(axis);
    let edge = |part: u32| {
        let turn = TAU * f64::from(part) / 60.0;
        let (mut low, mut high) = (0.0, MAP_TANGENT);
        for _ in 0..24 {
            let tangent = 0.5 * (low + high);
            if case.reflected(direction_at(turn, tangent)) > half { low = tangent } else { high = tangent }
        }
        middle + DVec2::new(libm::cos(turn), -libm::sin(turn)) * (MAP * low / MAP_TANGENT)
    };
    let edge: Vec<DVec2> = (0..60).map(edge).collect();
    svg.polygon(&edge, Some(&Fill::new(IMAGE, 0.28)), Some(Pen::new(IMAGE, 1.4)));
    let contributes = |brought: f64| brought >= MIN * integral;
    for &(direction, brought) in samples {
        let Some(place) = at(direction) else { continue };
        if contributes(brought) {
            let radius = (2.5 * (brought / integral).sqrt()).min(22.0);
            svg.circle(place, radius, Some(&Fill::new(RAY, 0.75)), Some(Pen::new(RAY, 0.8)));
        } else {
            svg.circle(place, 2.0, Some(&Fill::new(INK, 0.75)), None);
        }
    }
    samples.iter().filter(|&&(_, brought)| contributes(brought)).count()
}
