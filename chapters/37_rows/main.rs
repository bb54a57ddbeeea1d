//! A thousand beads through a lens: a table of a thousand rows, in which sixteen at a time have a colour.
//! Far behind them small lamps show the lens's shape.
//! New here: nothing to see. How the stages' loops are written so that one of them works on many rows at once.

use bevy_ecs::prelude::*;
use pinhole::scene::*;
use pinhole::{Chapter, stages};
use std::process::ExitCode;

fn main() -> ExitCode {
    pinhole::run(chapter())
}

// ANCHOR: chapter
/// The scene, and the stages on offer.
pub fn chapter() -> Chapter {
    Chapter::new("37_rows", "a thousand rows at once", scene)
        .offer(stages::camera_rays())
        .offer(stages::samples())
        .offer(stages::intersection())
        .offer(stages::surfaces())
        .offer(stages::direct_light())
        .offer(stages::environment())
        .offer(stages::lens())
        .offer(stages::lights())
}
// ANCHOR_END: chapter

// ANCHOR: scene
fn scene(world: &mut World) {
    let lens = Lens { aperture: Aperture::Radius { radius: 0.14 }, focus_distance: 5.6, ..Lens::default() };
    world.spawn((
        Name::new("camera"),
        PerspectiveCamera { fov: Degrees(26.0), axis: FovAxis::Vertical },
        LookAt { eye: [0.0, 1.5, 5.4].into(), target: [0.0, 0.62, 0.0].into(), ..LookAt::default() },
        lens,
        Integrator::RayCasting,
        Sampling { samples: 64, seed: 37, ..Sampling::default() },
    ));
    world.spawn((Name::new("ground"), Plane::default(), Matte { colour: Rgb::grey(0.32) }));
    world.spawn((Name::new("dusk"), Gradient { bottom: Rgb::new(0.05, 0.05, 0.08), top: Rgb::new(0.12, 0.16, 0.26) }));

    // Four colours in turn, each for the sixteen rows of a block.
    let glazes =
        [Rgb::new(0.8, 0.25, 0.16), Rgb::new(0.85, 0.6, 0.2), Rgb::new(0.2, 0.55, 0.5), Rgb::new(0.3, 0.35, 0.7)];
    for row in 0..1000 {
        let (along, across) = (f64::from(row / 25), f64::from(row % 25));
        let place = Placement::at(0.3 * (across - 12.0), 0.11, 2.2 - 0.3 * along);
        let matte = Matte { colour: glazes[row as usize / 16 % 4] };
        world.spawn((Name::new(format!("bead {row}")), Sphere { radius: 0.11 }, place, matte));
    }

    let sun = DirectionalLight { irradiance: Rgb::new(2.6, 2.3, 1.9), ..DirectionalLight::default() };
    world.spawn((Name::new("low sun"), sun, LookAt { eye: [-3.0, 2.4, 1.0].into(), ..LookAt::default() }));
    for lamp in 0..7 {
        let (x, y) = (2.1 * f64::from(lamp) - 6.3, 0.9 + 0.35 * f64::from(lamp * 3 % 4));
        let glow = Emissive {
            radiance: Rgb::new(9.0, 7.0 - 0.5 * f64::from(lamp), 3.0 + 0.7 * f64::from(lamp)),
            ..Emissive::default()
        };
        world.spawn((Name::new(format!("lamp {lamp}")), Sphere { radius: 0.1 }, Placement::at(x, y, -14.0), glow));
    }
}
// ANCHOR_END: scene
