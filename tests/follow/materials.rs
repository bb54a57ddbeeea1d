//! Every material that scatters light, under several lights: it is the same by every light strategy.

use super::{ALL, NOT_BY_BSDF, strategies_agree};
use crate::scenes::offer;
use bevy_ecs::prelude::*;
use pinhole::extract::{MaterialKind, MaterialTable};
use pinhole::plan::Census;
use pinhole::render::{Execution, render};
use pinhole::scene::{
    BlinnPhong, Emissive, Integrator, LightStrategy, LookAt, Matte, Metal, OrthographicCamera, Phong, Placement,
    Rectangle, Resolution, Rgb, Sampling, Sphere,
};

/// Pixels of a plate, each side.
const SIDE: u32 = 8;
/// Plates lie so far apart.
const STEP: f64 = 2.0;

type Plate = (Rectangle, Placement);

/// One plate for each material, and for each end of its numbers.
const PLATES: &[fn(&mut World, Plate) -> Entity] = &[
    |world, plate| world.spawn((plate, Matte::default())).id(),
    |world, plate| world.spawn((plate, phong(0.4, 0.3, 12.0))).id(),
    |world, plate| world.spawn((plate, phong(0.05, 0.9, 100.0))).id(),
    |world, plate| world.spawn((plate, phong(0.0, 1.0, 0.0))).id(),
    |world, plate| world.spawn((plate, blinn_phong(0.4, 0.3, 12.0))).id(),
    |world, plate| world.spawn((plate, blinn_phong(0.05, 0.9, 100.0))).id(),
    |world, plate| world.spawn((plate, metal(0.1, false))).id(),
    |world, plate| world.spawn((plate, metal(0.5, true))).id(),
    |world, plate| world.spawn((plate, metal(1.0, false))).id(),
];

fn phong(colour: f64, specular: f64, exponent: f64) -> Phong {
    Phong { colour: Rgb::grey(colour), specular: Rgb::grey(specular), exponent }
}

fn blinn_phong(colour: f64, specular: f64, exponent: f64) -> BlinnPhong {
    BlinnPhong { colour: Rgb::grey(colour), specular: Rgb::grey(specular), exponent }
}

fn metal(roughness: f64, multiple_scattering: bool) -> Metal {
    Metal { colour: Rgb::grey(0.9), roughness, multiple_scattering }
}

/// Whether light sampling can find light for a material of this kind; a new kind has to be named here.
fn has_a_plate(kind: MaterialKind) -> bool {
    match kind {
        MaterialKind::Matte | MaterialKind::Phong | MaterialKind::BlinnPhong | MaterialKind::Metal => true,
        MaterialKind::Mirror | MaterialKind::Glass => false,
    }
}

fn middle() -> f64 {
    0.5 * STEP * (PLATES.len() - 1) as f64
}

/// The plates in a row, seen from one side at 45°.
fn plates(lights: &dyn Fn(&mut World)) -> World {
    let mut world = World::new();
    let (x, size) = (middle(), 0.999 * STEP);
    let look = LookAt { eye: [x, 4.0, 4.0].into(), target: [x, 0.0, 0.0].into(), ..LookAt::default() };
    world.spawn((
        Name::new("camera"),
        OrthographicCamera { view_height: STEP },
        Resolution { width: SIDE * PLATES.len() as u32, height: SIDE },
        look,
        Sampling { samples: 64, ..Sampling::default() },
        Integrator::Path { max_depth: 2, lights: LightStrategy::Mis, roulette: 0 },
    ));
    for (number, spawn) in PLATES.iter().enumerate() {
        let plate = Rectangle { width: size, depth: 2.0 * STEP };
        spawn(&mut world, (plate, Placement::at(STEP * number as f64, 0.0, 0.0)));
    }
    lights(&mut world);
    world
}

#[test]
fn light_strategies_agree_at_every_material() {
    let glow = |radiance| Emissive { radiance: Rgb::grey(radiance), ..Emissive::default() };
    let large = |world: &mut World| {
        let light = Rectangle { width: 2.0 * middle() + 8.0, depth: 6.0 };
        world.spawn((light, Placement::at(middle(), 2.0, -1.0), glow(1.0)));
    };
    let small = |world: &mut World| {
        for number in 0..PLATES.len() {
            let at = Placement::at(STEP * number as f64, 1.5, -1.5);
            world.spawn((Sphere { radius: 0.3 }, at, glow(20.0)));
        }
    };
    let scene = plates(&large);
    let table = Census::of(&scene).table::<MaterialTable>().expect("materials");
    assert_eq!(table.kind.len(), PLATES.len());
    assert!(table.kind.iter().all(|&kind| has_a_plate(kind)));
    for (name, lights) in [("a large light", &large as &dyn Fn(&mut World)), ("small lights", &small)] {
        let film = render(&plates(lights), &offer(), &Execution::default(), &()).expect("renders").film;
        for plate in 0..PLATES.len() as u32 {
            let mean = film.mean(plate * SIDE + SIDE / 2, SIDE / 2);
            assert!(mean[0] > 1e-4, "plate {plate} under {name} is black");
        }
    }
    strategies_agree("plates under a large light", &|| plates(&large), ALL, 32, SIDE);
    strategies_agree("plates under small lights", &|| plates(&small), NOT_BY_BSDF, 32, SIDE);
}
