//! What another program adds to pinhole, from outside: each file is one thing, and no file of pinhole knows of it.
//!
//! - [`bowl`]: a shape, a paraboloid.
//! - [`chalk`]: a material, Oren and Nayar's rough matte surfaces.
//! - [`rings`]: a texture, the rings of a tree.
//! - [`lantern`]: a light that is brighter ahead than behind.
//! - [`contours`]: a stage, which draws lines of equal height.
//!
//! [`table`] is a scene that has all of them; `cargo run --release -p outside` shows what can be done with it.

pub mod bowl;
pub mod chalk;
pub mod contours;
pub mod lantern;
pub mod rings;

use bowl::{Bowl, PlacedBowl};
use chalk::{Chalk, ChalkTable};
use contours::Contours;
use lantern::{Lantern, PlacedLantern};
use pinhole::extend::*;
use pinhole::prelude::*;
use rings::Rings;

// ANCHOR: stages
/// All stages of pinhole, and those of what is added here.
pub fn stages() -> Vec<Stage> {
    let own = [of_light::<PlacedLantern>(), of_texture::<Rings>(), contours::stage()];
    every_stage_and(own.into_iter().chain(of_shape::<PlacedBowl>()).chain(of_material::<ChalkTable>()))
}
// ANCHOR_END: stages

// ANCHOR: add_to
/// Says that a scene may have what is added here.
pub fn add_to(scene: &mut World) {
    add_shape::<PlacedBowl>(scene);
    add_material::<ChalkTable>(scene);
    add_texture::<Rings>(scene);
    add_light::<PlacedLantern>(scene);
}
// ANCHOR_END: add_to

/// A bowl of chalk on a table with rings, under a lantern.
pub fn table(width: u32, height: u32) -> World {
    let mut scene = World::new();
    add_to(&mut scene);
    scene.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(30.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 3.2, 6.0].into(), target: [0.0, 0.4, 0.0].into(), ..LookAt::default() },
        Resolution { width, height },
        Sampling { samples: 16, ..Sampling::default() },
    ));
    let chalk = Chalk { colour: Rgb::new(0.8, 0.8, 0.75), sigma: Degrees(30.0) };
    scene.spawn((Name::new("bowl"), Bowl { radius: 1.2, height: 0.9 }, chalk));
    scene.spawn((Name::new("ball"), Sphere { radius: 0.35 }, Placement::at(0.0, 0.45, 0.0), Matte::default()));
    scene.spawn((Name::new("table"), Plane::default(), Matte::default(), Rings::default()));
    scene.spawn((
        Name::new("lantern"),
        Lantern { intensity: Rgb::grey(110.0) },
        LookAt { eye: [-2.0, 4.0, 2.0].into(), target: [0.0, 0.0, 0.0].into(), ..LookAt::default() },
    ));
    scene
}

/// The same with lines of equal height.
pub fn table_with_contours(width: u32, height: u32) -> World {
    let mut scene = table(width, height);
    scene.spawn(Contours { step: 0.15, width: 0.02 });
    scene
}
