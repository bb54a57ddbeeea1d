//! How pinhole is built, shown by extending it: a column and a stage of this chapter's own.
//! The picture is the cosine between each normal and the direction to the eye, which no stage of pinhole computes.
//! New here: nothing in the renderer; `Facing` and its stage live in this file.

use bevy_ecs::prelude::*;
use pinhole::intersect::{Surfaces, shape_evidence};
use pinhole::plan::{Column, Stage, TileSystems, VectorRows, column};
use pinhole::rays::WorldRays;
use pinhole::scene::*;
use pinhole::{Chapter, stages};
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("12_how_it_is_built", "how pinhole is built", scene)
        .offer(stages::camera_rays())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::unlit())
        .offer(facing_stage())
        .show::<Facing>()
}
// ANCHOR_END: chapter

// ANCHOR: facing
column! {
    /// The facing ratio of the surface that each ray hits.
    pub struct Facing("facing", "none, a ratio", "1", Ray) {
        /// The cosine of the angle between the normal and the direction to the eye; 0 where nothing is hit.
        cosine: f32,
    }
}

impl Facing {
    /// White where the surface faces the eye, black at its rim.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.cosine[row]; 3]
    }
}

/// The cosine for one row; at a rim rounding may make it negative, which the film would refuse.
fn facing([dx, dy, dz]: [f32; 3], [nx, ny, nz]: [f32; 3]) -> f32 {
    let cosine = -(dx * nx + dy * ny + dz * nz);
    if cosine > 0.0 { cosine } else { 0.0 }
}

/// Fills a tile's column.
fn fill_facing(mut tiles: Query<(&WorldRays, &Surfaces, &mut Facing)>) {
    for (rays, surfaces, mut column) in &mut tiles {
        let cosines = column.slices_mut(rays.rows());
        for (row, cosine) in cosines.iter_mut().enumerate() {
            let direction = rays.direction.at(row);
            *cosine = facing(direction, surfaces.get(row).normal.to_array());
        }
    }
}

/// The stage on offer.
fn facing_stage() -> Stage {
    Stage::new("Compute facing ratios", TileSystems::Shade, fill_facing).when(shape_evidence)
}
// ANCHOR_END: facing

// ANCHOR: scene
fn scene(world: &mut World) {
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(40.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 2.6, 6.0].into(), target: [0.0, 0.8, 0.0].into(), ..LookAt::default() },
    ));
    for (name, x, z, colour) in [
        ("near ball", -1.9, 1.0, Rgb::new(0.85, 0.35, 0.2)),
        ("middle ball", 0.2, -0.5, Rgb::new(0.9, 0.75, 0.3)),
        ("far ball", 2.3, -2.0, Rgb::new(0.25, 0.5, 0.75)),
    ] {
        world.spawn((Name::new(name), Sphere { radius: 0.8 }, Placement::at(x, 0.8, z), Matte { colour }));
    }
    world.spawn((Name::new("ground"), Plane::default(), Matte { colour: Rgb::grey(0.6) }));
    world.spawn((Name::new("sky"), Background { colour: Rgb::new(0.45, 0.6, 0.8) }));
}
// ANCHOR_END: scene
