//! Choosing one of many lights: probabilities are exact, none is 0 where there is light, and the mean is the sum.

use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};
use pinhole::extract::{AreaLightTable, LightChoice, LightsOf};
use pinhole::lights::{ListedLight, PlacedPointLight, PlacedSpotLight, Receiver, luminance};
use pinhole::models::TriangleMesh;
use pinhole::plan::{Census, Table};
use pinhole::scene::*;
use pinhole::shapes::point_on;
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::torus_knot::torus_knot;

/// Fractions that are tried for every surface, evenly spread.
const FRACTIONS: u32 = 8192;
/// Arrangements of each set, with 15 surfaces each.
const CASES: u64 = 1;
/// Random choices, where means are compared.
const CHOICES: u32 = 50_000;
/// The least likely of a few hundred means lies within so many standard errors, 99 times in 100.
const LIMIT: f64 = 4.5;

type Fill = fn(&mut World, &mut Draws);

/// Sets of lights with an area.
const SETS: [(&str, Fill); 7] = [
    ("all kinds", |world, draws| (0..60).for_each(|number| spawn(world, number, draws.unit_vector() * 5.0, draws))),
    ("far away", |world, draws| {
        let there = draws.unit_vector() * 1e7;
        (0..60).for_each(|number| spawn(world, number, there + draws.unit_vector() * 500.0, draws));
    }),
    ("scattered", |world, draws| {
        for number in 0..80 {
            let distance = draws.power_of_ten(-3.0, 7.0);
            spawn(world, number, draws.unit_vector() * distance, draws);
        }
    }),
    ("in one place", |world, _| {
        for number in 0..40 {
            let emissive = Emissive { radiance: Rgb::grey(f64::from(1 + number)), ..Emissive::default() };
            world.spawn((Rectangle { width: 1.0, depth: 2.0 }, Placement::at(1.0, 2.0, 0.5), emissive));
        }
    }),
    ("on a line", |world, _| {
        for number in 0..50 {
            world.spawn((Sphere { radius: 0.1 }, Placement::at(f64::from(number), 1.0, -2.0), Emissive::default()));
        }
    }),
    ("all the same", |world, _| {
        for number in 0..64 {
            let at = Placement::at(f64::from(number % 8), 3.0, f64::from(number / 8));
            let down = Placement { orientation: DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0), ..at };
            world.spawn((Disk { radius: 0.3 }, down, Emissive { sides: Sides::Front, ..Emissive::default() }));
        }
    }),
    ("meshes", |world, draws| {
        let mut knot = torus_knot(24, 6);
        // Triangles without an area.
        knot.triangles.extend([[0, 0, 1], [5, 5, 5]]);
        let mesh = MeshInstance { geometry: MeshGeometry::new(knot) };
        let scale = DVec3::new(1.0, -2.0, 0.5);
        let placement = Placement { scale, orientation: turned(draws), ..Placement::at(0.5, 2.0, 1.0) };
        world.spawn((mesh.clone(), placement, Emissive { sides: Sides::Front, ..Emissive::default() }));
        world.spawn((mesh, Placement::at(-6.0, 1.0, 1.0), Emissive::default()));
        (0..9).for_each(|number| spawn(world, number, draws.unit_vector() * 5.0, draws));
    }),
];

fn turned(draws: &mut Draws) -> DQuat {
    let [x, y, z, w] = [(); 4].map(|()| draws.between(-1.0, 1.0));
    DQuat::from_xyzw(x, y, z, w).normalize()
}

/// A light of one of the kinds, of any size, turned anywhere, of any power.
fn spawn(world: &mut World, number: u32, position: DVec3, draws: &mut Draws) {
    let sides = if draws.unit() < 0.5 { Sides::Front } else { Sides::Both };
    let radiance = times(Rgb::new(1.0, 0.5, 0.2), draws.power_of_ten(-6.0, 6.0));
    let size = draws.power_of_ten(-2.0, 0.0);
    let placement = Placement { position, orientation: turned(draws), scale: DVec3::splat(size) };
    let mut light = world.spawn((placement, Emissive { radiance, sides }));
    match number % 7 {
        0 => light.insert(Sphere { radius: 1.0 }),
        1 => light.insert(Disk { radius: 1.0 }),
        2 => light.insert(Rectangle { width: 1.0, depth: 0.2 }),
        3 => light.insert(Triangle::default()),
        4 => light.insert(Cuboid { size: DVec3::new(1.0, 0.3, 2.0) }),
        5 => light.insert(Cylinder { radius: 0.2, height: 2.0, capped: true }),
        _ => light.insert(MeshInstance::default()),
    };
}

fn times(colour: Rgb, power: f64) -> Rgb {
    Rgb::new(colour.r * power, colour.g * power, colour.b * power)
}

fn table_of<T: Table>(fill: impl Fn(&mut World)) -> T {
    let mut world = World::new();
    world.spawn(PerspectiveCamera::default());
    fill(&mut world);
    T::extract(&Census::of(&world)).expect("extracts")
}

/// Surfaces near lights and far from them, between them, and where one is.
fn receivers(draws: &mut Draws, places: &[DVec3]) -> Vec<Receiver> {
    let middle = places.iter().sum::<DVec3>() / places.len() as f64;
    let mut positions = vec![middle, places[0], places[places.len() / 2]];
    for _ in 0..6 {
        let near = places[(draws.unit() * places.len() as f64) as usize];
        let away = draws.power_of_ten(-4.0, 2.0);
        positions.push(near + draws.unit_vector() * away);
        let away = draws.power_of_ten(0.0, 7.0);
        positions.push(middle + draws.unit_vector() * away);
    }
    // As stages have them: offset origins in f32.
    positions
        .into_iter()
        .map(|position| Receiver { position: position.as_vec3().as_dvec3(), normal: draws.unit_vector(), depth: 0 })
        .collect()
}

/// How lights are chosen, and what each of them brings.
struct Chosen<'a> {
    name: String,
    lights: usize,
    choose: &'a dyn Fn(&Receiver, u32) -> (usize, f64),
    probability: &'a dyn Fn(&Receiver, usize) -> f64,
    /// The irradiance from a light by two random numbers, not yet divided by the probability of its choice.
    brings: &'a dyn Fn(&Receiver, usize, [f64; 2]) -> f64,
    /// Whether a light brings the same whatever the numbers.
    is_exact: bool,
}

#[derive(Default)]
struct Tried {
    surfaces: usize,
    choices: usize,
    lit: usize,
    means: usize,
    worst: f64,
}

impl Chosen<'_> {
    fn check(&self, receiver: &Receiver, draws: &mut Draws, tried: &mut Tried) {
        let name = &self.name;
        let probability: Vec<f64> = (0..self.lights).map(|light| (self.probability)(receiver, light)).collect();
        let sum: f64 = probability.iter().sum();
        assert!((sum - 1.0).abs() < 1e-12, "{name}: {sum}");

        let mut count = vec![0_u32; self.lights];
        for step in 0..FRACTIONS {
            let (light, own) = (self.choose)(receiver, step * (u32::MAX / FRACTIONS + 1) + 12_345);
            assert_eq!(own, probability[light], "{name}, light {light}");
            count[light] += 1;
        }
        for (light, &count) in count.iter().enumerate() {
            let off = f64::from(count) - probability[light] * f64::from(FRACTIONS);
            assert!(off.abs() <= 1.0, "{name}, light {light}: {off}");
        }

        // What each light brings, and what all do.
        let samples = if self.is_exact { 1 } else { 400 };
        // The mean of each, and its variance.
        let brought: Vec<[f64; 2]> = (0..self.lights)
            .map(|light| {
                let each: Vec<f64> =
                    (0..samples).map(|_| (self.brings)(receiver, light, [draws.unit(), draws.unit()])).collect();
                let mean = each.iter().sum::<f64>() / f64::from(samples);
                let squares = each.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>();
                [mean, squares / f64::from(samples)]
            })
            .collect();
        let whole: f64 = brought.iter().map(|[mean, _]| mean).sum();
        let uniform = 1.0 / self.lights as f64;
        let (mut variance, mut of_whole) = (0.0, 0.0);
        for (&[mean, squares], &probability) in brought.iter().zip(&probability) {
            if mean > 0.0 {
                assert!(probability > uniform / 17.0, "{name}: {probability:e} of a light that brings {mean:e}");
                tried.lit += 1;
            }
            if probability > 0.0 {
                let off = mean / probability - whole;
                variance += probability * off * off + squares / probability;
                of_whole += squares / f64::from(samples);
            }
        }

        let mut mean = 0.0;
        for _ in 0..CHOICES {
            let (light, own) = (self.choose)(receiver, (draws.unit() * 4_294_967_296.0) as u32);
            // Counted from the sum, so that no digits of a small spread are lost.
            let more = (self.brings)(receiver, light, [draws.unit(), draws.unit()]) / own - whole;
            mean += more / f64::from(CHOICES);
        }
        // By the variance that the probabilities imply, since a light that is seldom chosen may not be among these.
        let error = (variance / f64::from(CHOICES) + of_whole).sqrt();
        let off = if mean == 0.0 { 0.0 } else { mean / error.max(1e-12 * whole) };
        assert!(off.abs() < LIMIT, "{name}: off by {mean:e} of {whole:e}, {off:+.1} standard errors");
        tried.worst = tried.worst.max(off.abs());
        (tried.surfaces, tried.choices, tried.means) =
            (tried.surfaces + 1, tried.choices + FRACTIONS as usize, tried.means + 1);
    }
}

#[test]
fn many_area_lights_are_chosen_with_the_probability_that_is_told() {
    let mut tried = Tried::default();
    for (number, (name, fill)) in SETS.into_iter().enumerate() {
        for case in 0..CASES {
            let draws = &mut Draws::new(4100 + number as u64, case);
            let shared = std::cell::RefCell::new(*draws);
            let lights = table_of::<AreaLightTable>(|world| fill(world, &mut shared.borrow_mut()));
            assert!(lights.hierarchy.is_some(), "{name}");
            let brings = |receiver: &Receiver, light: usize, u: [f64; 2]| {
                lights.with_light(light, |emitter, radiance, one_sided| {
                    let point = point_on(emitter, receiver.position, u);
                    let shines = point.pdf > 0.0 && (!one_sided || emitter.faces(receiver.position));
                    let cosine = receiver.normal.dot(point.to / point.to.length()).max(0.0);
                    if shines && cosine > 0.0 { luminance(radiance) * cosine / point.pdf } else { 0.0 }
                })
            };
            let places: Vec<DVec3> = (0..lights.lights())
                .map(|light| lights.with_light(light, |emitter, _, _| point_on(emitter, DVec3::ZERO, [0.5; 2]).to))
                .filter(|place| place.is_finite())
                .collect();
            let chosen = Chosen {
                name: format!("{name} {case}"),
                lights: lights.lights(),
                choose: &|receiver, fraction| lights.choose(receiver, fraction),
                probability: &|receiver, light| lights.probability_of(light, receiver),
                brings: &brings,
                is_exact: false,
            };
            for receiver in receivers(draws, &places) {
                chosen.check(&receiver, draws, &mut tried);
            }
        }
    }
    said("area lights", &tried);
}

fn said(what: &str, tried: &Tried) {
    eprintln!(
        "{what}: {} surfaces, {} choices counted, {} lights that bring light, {} means, worst {:.1} standard errors",
        tried.surfaces, tried.choices, tried.lit, tried.means, tried.worst
    );
}

#[test]
fn many_lights_without_an_area_are_chosen_with_the_probability_that_is_told() {
    let mut tried = Tried::default();
    for case in 0..6 {
        points::<PlacedPointLight>(case, &mut tried, |draws| PointLight {
            intensity: Rgb::grey(draws.power_of_ten(-6.0, 6.0)),
            casts_shadows: true,
        });
        points::<PlacedSpotLight>(case, &mut tried, |draws| SpotLight {
            intensity: Rgb::grey(draws.power_of_ten(-3.0, 3.0)),
            inner_angle: Degrees(0.0),
            outer_angle: Degrees(draws.between(1.0, 180.0)),
            casts_shadows: true,
        });
    }
    said("lights without an area", &tried);
}

fn points<L: ListedLight>(case: u64, tried: &mut Tried, light: impl Fn(&mut Draws) -> L::Component) {
    let draws = &mut Draws::new(4200, case);
    let shared = std::cell::RefCell::new(*draws);
    let lights = table_of::<LightsOf<L>>(|world| {
        let draws = &mut *shared.borrow_mut();
        for number in 0..200 {
            let position = match case {
                // All in one place, on a line, far away, and scattered.
                0 => DVec3::ONE,
                1 => DVec3::X * f64::from(number),
                2 => DVec3::new(1e7, 0.0, 0.0) + draws.unit_vector() * 300.0,
                _ => draws.unit_vector() * draws.power_of_ten(-2.0, 2.0),
            };
            world.spawn((light(draws), Placement { position, orientation: turned(draws), ..Placement::default() }));
        }
    });
    let Some(LightChoice::Hierarchy(hierarchy)) = &lights.choice else { panic!("{}: no hierarchy", L::NAMES.table) };
    let (choice, row) = (lights.choice.as_ref().expect("a choice"), &lights.row);
    let places: Vec<DVec3> = row.iter().map(|light| light.bounds().expect("bounds").around.min).collect();
    let brings = |receiver: &Receiver, light: usize, _: [f64; 2]| {
        let sample = row[light].sample(receiver.position);
        let cosine = receiver.normal.dot(sample.direction.as_dvec3()).max(0.0);
        let is_apart = sample.distance * sample.distance >= f64::MIN_POSITIVE;
        if is_apart && cosine > 0.0 { luminance(L::irradiance(&sample, cosine)) } else { 0.0 }
    };
    let chosen = Chosen {
        name: format!("{} {case}", L::NAMES.table),
        lights: row.len(),
        choose: &|receiver, fraction| choice.choose(receiver, fraction),
        probability: &|receiver, light| hierarchy.probability(receiver, light),
        brings: &brings,
        is_exact: true,
    };
    for receiver in receivers(draws, &places) {
        chosen.check(&receiver, draws, tried);
    }
}

/// A mesh whose triangles have no area is no light, and a scene that has no other is dark.
#[test]
fn triangles_without_an_area_are_never_chosen() {
    let mut tried = 0;
    for triangles in [1, 40] {
        let mesh = TriangleMesh {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            triangles: vec![[0, 1, 2]; triangles],
            ..TriangleMesh::default()
        };
        let of = |mesh: TriangleMesh| {
            let mesh = MeshInstance { geometry: MeshGeometry::new(mesh) };
            table_of::<AreaLightTable>(|world| {
                _ = world.spawn((mesh.clone(), Placement::default(), Emissive::default()))
            })
        };
        assert!(of(mesh.clone()).is_empty(), "{triangles}");
        let mut one = mesh;
        one.triangles.push([0, 1, 3]);
        let lights = of(one);
        assert!(!lights.is_empty());
        for step in 0..FRACTIONS {
            let position = DVec3::new(0.2, 0.1, f64::from(step % 7));
            let receiver = Receiver { position, normal: DVec3::NEG_Z, depth: 0 };
            assert_eq!(lights.choose(&receiver, step * 524_287), (triangles, 1.0));
            assert!((0..triangles).all(|light| lights.probability_of(light, &receiver) == 0.0));
            tried += 1;
        }
    }
    eprintln!("triangles without an area: {tried} choices");
}
