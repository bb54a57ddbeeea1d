//! Every registered BSDF, by the examples that it gives of itself: energy, reciprocity, and sampling.

#[path = "principled.rs"]
mod principled;

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::material::{
    Bsdf, BsdfClass, ErasedBsdf, MaterialTable, MetalTable, Parameters, PrincipledTable, REGISTERED, Registration,
    RoughGlassTable, ShadingContext, Transport,
};
use pinhole::plan::Census;
use pinhole::sample::square_of_disk;
use pinhole::scene::{Metal, MetallicRoughnessMap, Principled, Rgb, RoughGlass};
use pinhole_lab::measure::chi_squared::{Bins, p_value};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::hemisphere::Quadrature;
use std::f64::consts::{PI, TAU};

/// Angles of the direction to the eye, in degrees.
const ANGLES: [f64; 7] = [0.0, 20.0, 45.0, 65.0, 80.0, 86.0, 89.0];
/// Indices of refraction beyond the surface over that on the side of the eye, where it transmits light.
const ETAS: [f64; 2] = [1.5, 1.0 / 1.5];

/// An example of a BSDF that is not specular.
struct Example {
    name: String,
    bsdf: Box<dyn ErasedBsdf>,
    contexts: Vec<ShadingContext>,
    lossless_to: Option<f64>,
    transmits: bool,
}

fn examples_of(own: &Registration) -> Vec<Example> {
    let example = |(number, (spawn, lossless_to)): (usize, (pinhole::material::Spawn, Option<f64>))| {
        let mut world = World::new();
        spawn(&mut world.spawn_empty());
        let census = Census::of(&world);
        let table = census.table::<MaterialTable>().expect("a material");
        assert_eq!(table.kind[..], [own.kind], "{} {number} is of its own kind", own.component);
        let opaque = ShadingContext::opaque(table.row[0] as usize, table.parameters[0]);
        let etas = if own.transmits { &ETAS[..] } else { &[1.0] };
        Example {
            name: format!("{} {number}", own.component),
            bsdf: (own.bsdf)(&census).expect("its table"),
            contexts: etas.iter().map(|&eta| ShadingContext { eta, ..opaque }).collect(),
            lossless_to,
            transmits: own.transmits,
        }
    };
    (own.examples)().into_iter().enumerate().map(example).collect()
}

/// The metallic and roughness that an image gives points of a principled surface: at the ends of the tables of all
/// roughnesses, and between their steps.
const MAPPED: [[f64; 2]; 8] =
    [[0.0, 0.0], [1.0, 0.07], [0.3, 0.12], [0.0, 0.26], [1.0, 0.41], [0.5, 0.63], [0.0, 0.88], [1.0, 1.0]];

/// A principled surface of a grey where an image gives it this metallic and roughness.
fn mapped(grey: f64, of_image: [f64; 2]) -> Example {
    let mut world = World::new();
    let own = Principled { base_colour: Rgb::grey(grey), metallic: 0.5, roughness: 0.5, ..Principled::default() };
    world.spawn((own, MetallicRoughnessMap::default()));
    let bsdf = Census::of(&world).table::<PrincipledTable>().expect("a table");
    let [metallic, roughness] = of_image;
    Example {
        name: format!("Principled, {grey}, by an image {metallic} metallic and {roughness} rough"),
        bsdf: Box::new(bsdf),
        contexts: vec![ShadingContext::opaque(0, Parameters { colour: [grey; 3], metallic, roughness })],
        // Of smoother metals, samples find too little of what leaves at grazing incidence after several scatterings;
        // principled.rs integrates that over the cosine.
        lossless_to: (grey == 1.0 && (metallic < 1.0 || roughness >= 0.1)).then_some(3e-3),
        transmits: false,
    }
}

fn examples() -> Vec<Example> {
    let spread = REGISTERED.iter().filter(|own| own.class != BsdfClass::Specular);
    let mut found: Vec<Example> = spread.flat_map(examples_of).collect();
    found.extend(MAPPED.map(|of_image| mapped(1.0, of_image)));
    found.push(mapped(0.2, [0.4, 0.57]));
    assert!(found.len() > 10, "{} examples", found.len());
    found
}

fn eye_at(degrees: f64) -> DVec3 {
    let angle = degrees * PI / 180.0;
    DVec3::new(libm::sin(angle), 0.0, libm::cos(angle))
}

/// A direction above the surface, or on either side of it.
fn direction(draws: &mut Draws, either_side: bool) -> DVec3 {
    let direction = draws.unit_vector().normalize();
    if either_side { direction } else { DVec3::new(direction.x, direction.y, direction.z.abs()) }
}

/// The same direction, seen from the other side of the surface.
fn flipped(direction: DVec3) -> DVec3 {
    DVec3::new(direction.x, -direction.y, -direction.z)
}

/// The mean weight over a lattice in the three numbers that a sample takes, which is the albedo; every weight is what
/// `eval` and `pdf` say.
fn albedo(example: &Example, context: &ShadingContext, to_eye: DVec3) -> f64 {
    // The further from the normal, the narrower lobes are, and the less alike weights.
    let count = if to_eye.z > 0.5 { 10_000 } else { 40_000 };
    // The lattice of the plastic number's cubic kin (Roberts 2018).
    const G: f64 = 1.220_744_084_605_759_5;
    let mut sum = 0.0;
    for index in 0..count {
        let at = |power: f64| (0.5 + f64::from(index) / power).fract();
        let (numbers, choice) = (square_of_disk((f64::from(index) + 0.5) / f64::from(count), at(G)), at(G * G));
        let Some(sample) = example.bsdf.sample(context, to_eye, numbers, choice) else { continue };
        let (light, whole) = (sample.to_light, sample.weight[0]);
        let pdf = example.bsdf.pdf(context, light, to_eye);
        let weight = example.bsdf.eval(context, light, to_eye)[0] * light.z.abs() / pdf;
        let name = &example.name;
        assert!((pdf / sample.pdf - 1.0).abs() < 1e-6, "{name} at {to_eye}: pdf {pdf} and {}", sample.pdf);
        assert!((weight - whole).abs() <= 1e-6 * whole.max(1e-3), "{name} at {to_eye}: weight {weight} and {whole}");
        assert!(example.transmits || light.z > 0.0, "{name} sends light through");
        sum += whole;
    }
    sum / f64::from(count)
}

/// What enters a denser medium is scaled by 1/η², and that is no loss: importance is not.
fn in_furnace(context: &ShadingContext) -> ShadingContext {
    ShadingContext { transport: Transport::Importance, ..*context }
}

#[test]
fn no_material_gives_back_more_than_it_gets() {
    let (mut tried, mut max, mut min) = (0, (0.0_f64, String::new()), (f64::INFINITY, String::new()));
    for example in examples() {
        for (context, angle) in example.contexts.iter().flat_map(|context| ANGLES.map(|angle| (context, angle))) {
            let all = albedo(&example, &in_furnace(context), eye_at(angle));
            let what = format!("{} at {angle}°, η {:.2}", example.name, context.eta);
            assert!(all <= 1.0 + 1e-3, "{what}: {all}");
            if let Some(off) = example.lossless_to {
                assert!(all >= 1.0 - off, "{what}: {all}");
                min = if all < min.0 { (all, what.clone()) } else { min };
            }
            max = if all > max.0 { (all, what) } else { max };
            tried += 1;
        }
    }
    eprintln!("white furnace: {tried} albedos; the greatest {max:?}, the least without absorption {min:?}");
}

#[test]
fn materials_are_reciprocal() {
    let (mut tried, mut both_zero, mut worst) = (0, 0, 0.0_f64);
    for example in examples() {
        for (context, index) in example.contexts.iter().flat_map(|context| (0..4000).map(move |index| (context, index)))
        {
            let mut draws = Draws::new(3101, index);
            let (mut eye, light) = (direction(&mut draws, false), direction(&mut draws, example.transmits));
            if index % 2 == 0 {
                // Near the mirrored direction, where narrow lobes are.
                eye = (DVec3::new(-light.x, -light.y, light.z.abs()) + 0.02 * draws.unit_vector()).normalize();
                eye.z = eye.z.abs();
            }
            let through = light.z < 0.0;
            // Light that goes the other way through the surface finds the media exchanged.
            let back = if through { ShadingContext { eta: 1.0 / context.eta, ..*context } } else { *context };
            let [from, to] = if through { [eye, light].map(flipped) } else { [eye, light] };
            let there = example.bsdf.eval(&in_furnace(context), light, eye);
            let again = example.bsdf.eval(&back, from, to);
            for part in 0..3 {
                let larger = there[part].max(again[part]);
                both_zero += u32::from(larger == 0.0);
                let off = if larger > 0.0 { (there[part] - again[part]).abs() / larger } else { 0.0 };
                worst = worst.max(off);
                assert!(off <= 1e-6, "{} {index}: {there:?} and {again:?}, {light} {eye}", example.name);
            }
            assert!(there.iter().all(|part| *part >= 0.0 && part.is_finite()), "{} {index}: {there:?}", example.name);
            tried += 1;
        }
    }
    eprintln!("reciprocity: {tried} pairs of directions, worst {worst:.1e}; {both_zero} of their components are 0");
    assert!(both_zero < tried, "most are 0");
}

/// A cell of directions: bounds of the angle to the normal and of the azimuth.
#[derive(Clone, Copy)]
struct Cell {
    angle: [f64; 2],
    turn: [f64; 2],
}

impl Cell {
    /// Two halves, across the side that is longer on the sphere, so that cells close in on narrow lobes.
    fn halves(self) -> [Self; 2] {
        let half = |[low, high]: [f64; 2]| [[low, 0.5 * (low + high)], [0.5 * (low + high), high]];
        let across = libm::sin(self.angle[0]).max(libm::sin(self.angle[1])) * (self.turn[1] - self.turn[0]);
        if self.angle[1] - self.angle[0] > across {
            half(self.angle).map(|angle| Self { angle, ..self })
        } else {
            half(self.turn).map(|turn| Self { turn, ..self })
        }
    }

    fn holds(self, (angle, turn): (f64, f64)) -> bool {
        self.angle[0] <= angle && angle < self.angle[1] && self.turn[0] <= turn && turn < self.turn[1]
    }

    /// ∫ f dω over the cell, refined until halving it changes little.
    fn integral(self, rule: &Quadrature, depth: u32, f: &dyn Fn(DVec3) -> f64) -> f64 {
        let whole = |cell: Self| {
            rule.sum(cell.angle[0], cell.angle[1], |angle| {
                let (across, z) = libm::sincos(angle);
                across
                    * rule.sum(cell.turn[0], cell.turn[1], |turn| {
                        f(DVec3::new(across * libm::cos(turn), across * libm::sin(turn), z))
                    })
            })
        };
        let (all, halves) = (whole(self), self.halves());
        let refined: f64 = halves.iter().map(|&half| whole(half)).sum();
        if depth == 0 || (all - refined).abs() < 1e-6 {
            return refined;
        }
        halves.iter().map(|half| half.integral(rule, depth - 1, f)).sum()
    }
}

fn place_of(light: DVec3) -> (f64, f64) {
    let angle = libm::atan2(light.x.hypot(light.y), light.z);
    (angle.min(PI * (1.0 - 1e-16)), libm::atan2(light.y, light.x).rem_euclid(TAU).min(TAU * (1.0 - 1e-16)))
}

/// Cells that hold at most so many of these places each, of all directions to which light is sent, and how many of other
/// places each holds.
fn cells(places: &[(f64, f64)], others: &[(f64, f64)], max: usize, either_side: bool) -> Vec<(Cell, usize)> {
    let sides = if either_side { &[0.0, 0.5 * PI][..] } else { &[0.0] };
    let mut open: Vec<(Cell, [Vec<(f64, f64)>; 2], u32)> = Vec::new();
    for &low in sides {
        let cell = Cell { angle: [low, low + 0.5 * PI], turn: [0.0, TAU] };
        let within = |of: &[(f64, f64)]| of.iter().copied().filter(|&place| cell.holds(place)).collect();
        open.push((cell, [within(places), within(others)], 0));
    }
    let mut found = Vec::new();
    while let Some((cell, inside, depth)) = open.pop() {
        if inside[0].len() <= max || depth == 48 {
            found.push((cell, inside[1].len()));
        } else {
            let halves = cell.halves();
            let [(a, b), (c, d)] =
                inside.map(|of| of.into_iter().partition::<Vec<_>, _>(|&place| halves[0].holds(place)));
            open.extend([(halves[0], [a, c], depth + 1), (halves[1], [b, d], depth + 1)]);
        }
    }
    found
}

/// The probability of a χ² at least as large as that of the sampled directions against the pdf.
fn p_of(example: &Example, context: &ShadingContext, angle: f64, seed: u64) -> f64 {
    // Fewer do not find a lobe that is 5 % too wide.
    const SAMPLES: u64 = 20_000;
    let eye = eye_at(angle);
    let places = |seed| {
        let sampled = (0..SAMPLES).filter_map(move |index| {
            let mut draws = Draws::new(seed, index);
            let numbers = [draws.unit(), draws.unit()];
            example.bsdf.sample(context, eye, numbers, draws.unit())
        });
        sampled.map(|sample| place_of(sample.to_light)).collect::<Vec<_>>()
    };
    // The cells must not depend on the samples that are counted in them.
    let sampled = places(seed + 1);
    let (cells, rule) = (cells(&places(seed), &sampled, 150, example.transmits), Quadrature::default());
    let mut bins = Bins::new(cells.len() + 1);
    for (bin, (cell, count)) in cells.iter().enumerate() {
        (0..*count).for_each(|_| bins.count(bin));
        let part = cell.integral(&rule, 12, &|light| example.bsdf.pdf(context, light, eye));
        bins.expect(bin, part * SAMPLES as f64);
    }
    let none = SAMPLES as f64 - bins.total();
    let what = format!("{} at {angle}°, η {:.2}", example.name, context.eta);
    assert!(none > -1e-3 * SAMPLES as f64, "{what}: its pdf adds up to {}", bins.total() / SAMPLES as f64);
    bins.expect(cells.len(), none.max(0.0));
    (sampled.len() as u64..SAMPLES).for_each(|_| bins.count(cells.len()));
    let counted: usize = cells.iter().map(|(_, count)| count).sum();
    assert_eq!(counted, sampled.len(), "{what}: cells cover all directions");
    let (statistic, freedom) = bins.statistic();
    p_value(statistic, freedom)
}

#[test]
fn sampled_directions_have_their_pdf() {
    let (mut tried, mut min) = (0_u64, (1.0_f64, String::new()));
    for example in examples() {
        for context in &example.contexts {
            for angle in [0.0, 45.0, 80.0, 89.0] {
                tried += 1;
                let p = p_of(&example, context, angle, 5000 + 2 * tried);
                if p < min.0 {
                    min = (p, format!("{} at {angle}°, η {:.2}", example.name, context.eta));
                }
            }
        }
    }
    // Šidák: the least of so many is below this once in a hundred.
    let limit = 1.0 - libm::pow(0.99, 1.0 / tried as f64);
    eprintln!("sampling: {tried} χ² tests, least p {:.5} ({}), limit {limit:.1e}", min.0, min.1);
    assert!(min.0 > limit, "{min:?}");
}

#[test]
fn roughness_ends_at_0_and_at_1() {
    let accepted = |roughness: f64| {
        let metal = MetalTable::parameters(&Metal { roughness, ..Metal::default() }, "it");
        let glass = RoughGlassTable::parameters(&RoughGlass { roughness, ..RoughGlass::default() }, "it");
        let principled = PrincipledTable::parameters(&Principled { roughness, ..Principled::default() }, "it");
        [metal, glass, principled].map(|colour| colour.is_ok())
    };
    for (roughness, expected) in [(0.0, true), (1.0, true), (1.0 + f64::EPSILON, false), (-1e-300, false)] {
        assert_eq!(accepted(roughness), [expected; 3], "roughness {roughness:e}");
    }
}

#[test]
fn what_transmits_light_has_no_colour_of_its_own() {
    let contexts: Vec<ShadingContext> =
        REGISTERED.iter().filter(|own| own.transmits).flat_map(examples_of).flat_map(|own| own.contexts).collect();
    assert!(contexts.len() > 2 && contexts.iter().all(|context| context.parameters.colour == [0.0; 3]), "{contexts:?}");
}
