//! How much each reflection model sends in which direction.

use super::Figure;
use super::label::Label;
use super::pen::{IMAGE, INK, LIGHT, Pen, RAY, WIDTH};
use super::svg::{Drawing, Svg};
use glam::{DVec2, DVec3};
use pinhole::Result;
use pinhole::extract::{MaterialKind, MaterialTable};
use pinhole::material::{BlinnPhongTable, PhongTable, half_vector_cosine, highlight, mirror_cosine};
use pinhole::plan::{Census, Table};
use pinhole::{Chapter, Overrides};
use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

/// How obliquely the light falls in each of the panels, in degrees off the normal.
const ANGLES: [f64; 3] = [15.0, 50.0, 80.0];
const HEIGHT: f64 = 396.0;
/// Where the surface lies, where the lobes across stand, and how far from either the longest lobe may reach: no farther
/// than a panel's half, for at grazing incidence it lies along the surface.
const GROUND: f64 = 142.0;
const ACROSS: f64 = 318.0;
const EXTENT: f64 = 108.0;
/// Steps from one side of the hemisphere to the other.
const STEPS: u32 = 120;

/// The lobes of a chapter's first Phong and Blinn–Phong materials, in the plane of the light and the normal, and in the
/// plane across it through the mirrored direction to the light.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let scene = chapter.world(&Overrides::default());
    let census = &Census::of(&scene);
    let (materials, phong) = (MaterialTable::extract(census)?, PhongTable::extract(census)?);
    let blinn = BlinnPhongTable::extract(census)?;
    let first = |kind: MaterialKind| materials.kind.iter().position(|&own| own == kind);
    let (Some(of_phong), Some(of_blinn)) = (first(MaterialKind::Phong), first(MaterialKind::BlinnPhong)) else {
        return Err(figure.unsuited("a Phong and a Blinn–Phong material"));
    };
    let matte = |material: usize| materials.parameters[material].colour[0] * FRAC_1_PI;
    // In the first plane the two lobes all but coincide: the wider line shows beside the other.
    let models: [(Pen, &dyn Fn([DVec3; 2]) -> f64); 3] = [
        (Pen::new(INK, 1.8), &|_| matte(of_phong)),
        (Pen::new(RAY, 4.0), &|[light, eye]| {
            let cosine = mirror_cosine(DVec3::Y, light, eye);
            matte(of_phong) + phong.specular[0][0] * highlight(phong.peak[0], phong.exponent[0], cosine)
        }),
        (Pen::new(IMAGE, 1.6), &|[light, eye]| {
            let cosine = half_vector_cosine(DVec3::Y, light, eye);
            matte(of_blinn) + blinn.specular[0][0] * highlight(blinn.peak[0], blinn.exponent[0], cosine)
        }),
    ];
    let longest = (matte(of_phong) + phong.specular[0][0] * phong.peak[0])
        .max(matte(of_blinn) + blinn.specular[0][0] * blinn.peak[0]);
    let mut svg = Svg::new(figure.name, HEIGHT);
    let names = [
        "matte".to_string(),
        format!("Phong, *n* = {}", phong.exponent[0]),
        format!("Blinn–Phong, *n* = {}", blinn.exponent[0]),
    ];
    for (panel, degrees) in ANGLES.into_iter().enumerate() {
        let foot = DVec2::new(WIDTH * (2.0 * panel as f64 + 1.0) / 6.0, GROUND);
        let half = WIDTH / 6.0 - 10.0;
        let arrives = direction(-degrees.to_radians());
        svg.line(foot - DVec2::X * half, foot + DVec2::X * half, Pen::new(INK, 1.6));
        svg.line(foot, foot - DVec2::Y * EXTENT, Pen::new(INK, 0.9).faint(0.6).dashed("5 4"));
        svg.arrow(foot + on_page(arrives) * (half * 0.95), foot, Pen::new(LIGHT, 2.2));
        let beside = DVec2::new(foot.x, ACROSS);
        svg.line(beside, beside - DVec2::Y * EXTENT, Pen::new(INK, 0.9).faint(0.6).dashed("5 4"));
        let mirrored = direction(degrees.to_radians());
        for ((pen, model), name) in models.iter().zip(&names) {
            let colour = pen.colour;
            let at =
                |angle: f64| foot + on_page(direction(angle)) * (EXTENT * model([arrives, direction(angle)]) / longest);
            let across = |angle: f64| {
                let eye = mirrored * libm::cos(angle) + DVec3::Z * libm::sin(angle);
                beside + on_page(direction(angle)) * (EXTENT * model([arrives, eye]) / longest)
            };
            let angle = |step: u32| (f64::from(step) / f64::from(STEPS) * 2.0 - 1.0) * FRAC_PI_2;
            for step in 0..STEPS {
                svg.line(at(angle(step)), at(angle(step + 1)), *pen);
                svg.line(across(angle(step)), across(angle(step + 1)), *pen);
            }
            // Each curve is named once, where the curves are furthest apart.
            if panel == 1 {
                let tip = (0..=STEPS)
                    .map(angle)
                    .max_by(|&a, &b| length(model, arrives, a).total_cmp(&length(model, arrives, b)));
                let tip = if colour == INK { -0.9 } else { tip.unwrap_or(0.0) };
                let side = DVec2::new(if colour == IMAGE { 0.2 } else { 1.0 }, -1.0);
                let side = if colour == INK { DVec2::new(-1.0, -0.4) } else { side };
                svg.label(Label::near(at(tip), name, side, 8.0).coloured(colour));
            }
        }
        let told = format!("light {degrees}° off the normal");
        svg.label(Label::near(foot + DVec2::Y * 8.0, &told, DVec2::Y, 6.0).title(0.95));
        svg.label(Label::near(beside + DVec2::Y * 8.0, "the same, across", DVec2::Y, 6.0).title(0.95));
    }
    let note = "red parts; longer is brighter";
    Ok(svg.finish(figure.about, &figure.stamp([480, 270], note)))
}

fn length(model: &dyn Fn([DVec3; 2]) -> f64, arrives: DVec3, angle: f64) -> f64 {
    model([arrives, direction(angle)])
}

/// The direction at an angle off the normal, to the right where it is above 0.
fn direction(angle: f64) -> DVec3 {
    DVec3::new(libm::sin(angle), libm::cos(angle), 0.0)
}

/// The same in the drawing, where y points down.
fn on_page(direction: DVec3) -> DVec2 {
    DVec2::new(direction.x, -direction.y)
}
