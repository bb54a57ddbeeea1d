//! Small scenes, each with a mistake that everyone makes once.

use crate::scene::{
    Background, Cuboid, Emissive, Glass, Integrator, Lens, LightStrategy, LookAt, Matte, Mirror, Name,
    PerspectiveCamera, Placement, Plane, PointLight, Rectangle, Resolution, Rgb, Sphere,
};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// A scene and what is wrong with it; one scene is correct, for comparison.
pub struct Mistake {
    /// What is wrong, in a few words.
    pub what: &'static str,
    /// The scene.
    pub scene: fn(&mut World),
}

/// All of the scenes; the first has nothing wrong.
pub const MISTAKES: &[Mistake] = &[
    Mistake {
        what: "nothing wrong",
        scene: |world| {
            eye(world, 6.0, ());
            floor_and_ball(world);
            lamp(world, [3.0, 5.0, 4.0], 100.0);
        },
    },
    Mistake {
        what: "no light, by path tracing",
        scene: |world| {
            eye(world, 6.0, Integrator::PATH);
            floor_and_ball(world);
        },
    },
    Mistake {
        what: "a light behind the wall",
        scene: |world| {
            eye(world, 6.0, ());
            world.spawn((Name::new("wall"), Plane { normal: DVec3::Z }, Matte::default()));
            lamp(world, [0.0, 1.0, -3.0], 100.0);
        },
    },
    Mistake {
        what: "a light inside the ball",
        scene: |world| {
            eye(world, 6.0, ());
            floor_and_ball(world);
            lamp(world, [0.0, 1.0, 0.0], 100.0);
        },
    },
    Mistake {
        what: "the camera inside the ball",
        scene: |world| {
            eye(world, 0.5, ());
            floor_and_ball(world);
            lamp(world, [3.0, 5.0, 4.0], 100.0);
        },
    },
    Mistake {
        what: "the camera inside a block of tinted glass",
        scene: |world| {
            eye(world, 6.0, ());
            floor_and_ball(world);
            let bulb = Emissive { radiance: Rgb::grey(100.0), ..Emissive::default() };
            world.spawn((Name::new("bulb"), Sphere { radius: 0.5 }, Placement::at(3.0, 5.0, 4.0), bulb));
            let block = Cuboid { size: DVec3::splat(1.0) };
            let glass = Glass { absorption: Rgb::new(0.5, 0.1, 0.1), ..Glass::default() };
            world.spawn((Name::new("block"), block, Placement::at(0.0, 1.0, 6.0), glass));
        },
    },
    Mistake {
        what: "the camera looks the other way",
        scene: |world| {
            eye(world, -6.0, ());
            let ball = (Name::new("ball"), Sphere { radius: 1.0 }, Matte::default());
            world.spawn((ball, Placement::at(0.0, 1.0, -12.0)));
            lamp(world, [3.0, 5.0, 4.0], 100.0);
        },
    },
    Mistake {
        what: "the same in front of a blue sky",
        scene: |world| {
            eye(world, -6.0, ());
            let ball = (Name::new("ball"), Sphere { radius: 1.0 }, Matte::default());
            world.spawn((ball, Placement::at(0.0, 1.0, -12.0)));
            world.spawn(Background { colour: Rgb::new(0.3, 0.5, 0.8) });
        },
    },
    Mistake {
        what: "a light a hundred times too bright",
        scene: |world| {
            eye(world, 6.0, ());
            floor_and_ball(world);
            lamp(world, [3.0, 5.0, 4.0], 10_000.0);
        },
    },
    Mistake {
        what: "a small area light found by BSDF sampling alone",
        scene: |world| {
            let lights = LightStrategy::Bsdf;
            eye(world, 6.0, Integrator::Path { max_depth: 16, lights, roulette: 5 });
            floor_and_ball(world);
            let light = Emissive { radiance: Rgb::grey(1e4), ..Emissive::default() };
            world.spawn((Name::new("lamp"), Sphere { radius: 0.05 }, Placement::at(3.0, 5.0, 4.0), light));
        },
    },
    Mistake {
        what: "a mirror, by ray casting",
        scene: |world| {
            eye(world, 6.0, Integrator::RayCasting);
            floor_and_ball(world);
            lamp(world, [3.0, 5.0, 4.0], 100.0);
            world.spawn((Name::new("mirror"), Sphere { radius: 1.0 }, Placement::at(2.0, 1.0, 0.0), Mirror::default()));
        },
    },
    Mistake {
        what: "an area light, by Whitted's method",
        scene: |world| {
            eye(world, 6.0, Integrator::WHITTED);
            floor_and_ball(world);
            let panel = (Rectangle { width: 2.0, depth: 2.0 }, Emissive::default());
            world.spawn((Name::new("panel"), panel, Placement::at(0.0, 4.0, 0.0)));
            world.spawn((Name::new("mirror"), Sphere { radius: 1.0 }, Placement::at(2.0, 1.0, 0.0), Mirror::default()));
        },
    },
    Mistake {
        what: "a focus distance of 0",
        scene: |world| {
            eye(world, 6.0, Lens { focus_distance: 0.0, ..Lens::default() });
            floor_and_ball(world);
            lamp(world, [3.0, 5.0, 4.0], 100.0);
        },
    },
];

/// A camera on the z axis, with further components, that looks towards the ball from z > 0 and away from it from z < 0.
fn eye(world: &mut World, z: f64, more: impl Bundle) {
    let eye = DVec3::new(0.0, 1.0, z);
    let look = LookAt { eye, target: eye - z.signum() * DVec3::Z, ..LookAt::default() };
    let size = Resolution { width: 96, height: 64 };
    world.spawn((Name::new("camera"), PerspectiveCamera::default(), look, size, more));
}

fn floor_and_ball(world: &mut World) {
    world.spawn((Name::new("floor"), Plane::default(), Matte::default()));
    world.spawn((Name::new("ball"), Sphere { radius: 1.0 }, Placement::at(0.0, 1.0, 0.0), Matte::default()));
}

fn lamp(world: &mut World, [x, y, z]: [f64; 3], intensity: f64) {
    let light = PointLight { intensity: Rgb::grey(intensity), ..PointLight::default() };
    world.spawn((Name::new("lamp"), light, Placement::at(x, y, z)));
}
