//! Every material that lights are sampled for, under several lights: it looks the same by every light strategy.

use super::{ALL, NOT_BY_BSDF, assert_agree, renders, strategies_agree};
use crate::scenes::{named, offer};
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::material::{BsdfClass, MaterialTable, REGISTERED, Registration, ShadingContext, Spawn};
use pinhole::plan::Census;
use pinhole::render::{Execution, render};
use pinhole::scene::{
    Cuboid, Emissive, Environment, Glass, Integrator, LightStrategy, LookAt, OrthographicCamera, PhotonMapping,
    Placement, Rectangle, Resolution, Rgb, Sampling, Sphere,
};
use pinhole_lab::measure::draws::Draws;
use std::fs;
use std::path::Path;
use std::sync::OnceLock;

/// The strategies that find what a narrow lobe reflects.
const NOT_BY_LIGHT: &[LightStrategy] = &[LightStrategy::Bsdf, LightStrategy::Mis];
/// Pixels of a plate, each side.
const SIDE: u32 = 8;
/// Plates lie so far apart.
const STEP: f64 = 2.0;

/// From this pdf on, in 1/sr, a lobe is so narrow that light sampling hardly ever finds what it reflects.
const NARROW: f64 = 30.0;

/// Lights, and the middle of the row of plates that they illuminate.
type Lights<'a> = &'a dyn Fn(&mut World, f64);

/// A plate for each example of a BSDF that is not specular, and whether it must enclose what fills it; those with narrow
/// lobes, or the others.
fn plates(narrow: bool) -> Vec<(Spawn, bool)> {
    // Looked at once, and not for every picture.
    static ARE_NARROW: OnceLock<Vec<bool>> = OnceLock::new();
    let all = || {
        let spread = REGISTERED.iter().filter(|own| own.class != BsdfClass::Specular);
        spread.flat_map(|own| (own.examples)().into_iter().map(move |(spawn, _)| (spawn, own)))
    };
    let are_narrow = ARE_NARROW.get_or_init(|| all().map(|(spawn, own)| peak(&spawn, own) > NARROW).collect());
    let those = all().zip(are_narrow).filter(|(_, is_narrow)| **is_narrow == narrow);
    those.map(|((spawn, own), _)| (spawn, own.transmits)).collect()
}

/// The greatest pdf among some samples, at 45°.
fn peak(spawn: &Spawn, own: &Registration) -> f64 {
    let mut world = World::new();
    spawn(&mut world.spawn_empty());
    let census = Census::of(&world);
    let table = census.table::<MaterialTable>().expect("a material");
    let opaque = ShadingContext::opaque(table.row[0] as usize, table.parameters[0]);
    let context = if own.transmits { ShadingContext { eta: 1.5, ..opaque } } else { opaque };
    let (bsdf, eye) = ((own.bsdf)(&census).expect("its table"), DVec3::new(1.0, 0.0, 1.0).normalize());
    let samples = (0..1000).filter_map(|index| {
        let mut draws = Draws::new(3301, index);
        bsdf.sample(&context, eye, [draws.unit(), draws.unit()], draws.unit())
    });
    samples.map(|sample| sample.pdf).fold(0.0, f64::max)
}

/// The plates in a row, seen from one side at 45°.
fn scene(lights: Lights<'_>, narrow: bool) -> World {
    let (mut world, plates) = (World::new(), plates(narrow));
    let middle = 0.5 * STEP * (plates.len() - 1) as f64;
    let look = LookAt { eye: [middle, 4.0, 4.0].into(), target: [middle, 0.0, 0.0].into(), ..LookAt::default() };
    world.spawn((
        Name::new("camera"),
        OrthographicCamera { view_height: STEP },
        Resolution { width: SIDE * plates.len() as u32, height: SIDE },
        look,
        Sampling { samples: 64, ..Sampling::default() },
        // Through glass and out of it again takes two segments more than one reflection.
        Integrator::Path { max_depth: 4, lights: LightStrategy::Mis, roulette: 0 },
    ));
    for (number, (spawn, encloses)) in plates.iter().enumerate() {
        let (x, size) = (STEP * number as f64, 0.999 * STEP);
        let mut plate = world.spawn(Placement::at(x, 0.0, 0.0));
        if *encloses {
            plate.insert((Cuboid { size: DVec3::new(size, 0.2, 2.0 * STEP) }, Placement::at(x, -0.1, 0.0)));
        } else {
            plate.insert(Rectangle { width: size, depth: 2.0 * STEP });
        }
        spawn(&mut plate);
    }
    lights(&mut world, middle);
    world
}

/// An image of one colour in all directions.
fn even_environment() -> String {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("even.hdr");
    let mut bytes = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 4\n".to_vec();
    bytes.extend([128, 128, 128, 128].repeat(16));
    fs::write(&path, bytes).expect("written");
    path.to_string_lossy().into_owned()
}

#[test]
fn light_strategies_agree_at_every_material() {
    let glow = |radiance| Emissive { radiance: Rgb::grey(radiance), ..Emissive::default() };
    let large = |world: &mut World, middle: f64| {
        let light = Rectangle { width: 2.0 * middle + 8.0, depth: 6.0 };
        world.spawn((light, Placement::at(middle, 2.0, -1.0), glow(1.0)));
    };
    let small = |world: &mut World, middle: f64| {
        for number in 0..=(2.0 * middle / STEP).round() as u32 {
            let at = Placement::at(STEP * f64::from(number), 1.5, -1.5);
            world.spawn((Sphere { radius: 0.3 }, at, glow(20.0)));
        }
    };
    let file = even_environment();
    let even = |world: &mut World, _: f64| {
        world.spawn(Environment { file: file.clone(), ..Environment::default() });
    };
    let all: [(&str, Lights<'_>, bool, &[LightStrategy]); 5] = [
        ("broad lobes in an even environment", &even, false, ALL),
        ("broad lobes under a large light", &large, false, ALL),
        ("broad lobes under small lights", &small, false, NOT_BY_BSDF),
        ("narrow lobes in an even environment", &even, true, NOT_BY_LIGHT),
        ("narrow lobes under a large light", &large, true, NOT_BY_LIGHT),
    ];
    for (name, lights, narrow, strategies) in all {
        let film = render(&scene(lights, narrow), &offer(), &Execution::default(), &()).expect("renders").film;
        for plate in 0..plates(narrow).len() as u32 {
            let mean = film.mean(plate * SIDE + SIDE / 2, SIDE / 2);
            assert!(mean[0] > 1e-4, "plate {plate} of {name} is black");
        }
        strategies_agree(name, &|| scene(lights, narrow), strategies, 6, SIDE);
    }
}

/// Photons that come through a pane, on every material with a broad lobe, against paths from the camera, which come through
/// the pane as well.
#[test]
fn photons_agree_with_paths_at_every_material() {
    const SETS: u64 = 12;
    let make = |photons: bool| {
        move || {
            let under_a_pane = |world: &mut World, middle: f64| {
                let width = 2.0 * middle + 8.0;
                let light = Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() };
                world.spawn((Rectangle { width, depth: 6.0 }, Placement::at(middle, 2.0, -1.0), light));
                let pane = Cuboid { size: DVec3::new(width, 0.2, 9.0) };
                world.spawn((pane, Placement::at(middle, 1.0, 0.0), Glass::default()));
            };
            let mut world = scene(&under_a_pane, false);
            let camera = named(&mut world, "camera");
            let integrator = Integrator::Path { max_depth: 8, lights: LightStrategy::Mis, roulette: 0 };
            world.entity_mut(camera).insert(integrator);
            if photons {
                world.entity_mut(camera).insert(PhotonMapping { paths: 8.0, radius: 0.1 });
            }
            world
        }
    };
    let alone = renders(&make(false), LightStrategy::Mis, 24, 0..SETS);
    let photons = renders(&make(true), LightStrategy::Mis, 8, SETS..2 * SETS);
    let found = assert_agree("photons and paths at every material", &alone, &photons, SIDE);
    assert_eq!(found.tests, 3 * plates(false).len(), "a block for each material and channel");
}

/// Paths from a lamp that are joined to those of the camera, on every material with a broad lobe and with a narrow one.
#[test]
fn joined_paths_agree_with_paths_at_every_material() {
    const SETS: u64 = 12;
    let lamp = |world: &mut World, middle: f64| {
        let light = Emissive { radiance: Rgb::grey(1.0), ..Emissive::default() };
        world.spawn((Rectangle { width: 2.0 * middle + 8.0, depth: 6.0 }, Placement::at(middle, 2.0, -1.0), light));
    };
    let mut tried = 0;
    for narrow in [false, true] {
        let make = || scene(&lamp, narrow);
        let alone = renders(&make, LightStrategy::Mis, 16, 0..SETS);
        let both = renders(&super::bidirectional::joined(&make), LightStrategy::Mis, 16, SETS..2 * SETS);
        let found = assert_agree("joined paths at every material", &alone, &both, SIDE);
        assert_eq!(found.tests, 3 * plates(narrow).len(), "a block for each material and channel");
        tried += plates(narrow).len();
    }
    eprintln!("joined paths: {tried} materials, 0 blocks apart");
}
