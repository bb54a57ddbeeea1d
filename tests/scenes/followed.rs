//! Scenes whose light is followed: mirrors, glass, rough metal, lights with an area, an environment.

use super::Setup;
use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};
use pinhole::scene::*;

/// What a followed scene may have; each decides about some stage, column or table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FollowToggle {
    Mirror,
    Glass,
    Absorbing,
    Metal,
    Lamp,
    OneSided,
    Environment,
}

impl FollowToggle {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Mirror, Self::Glass, Self::Absorbing, Self::Metal, Self::Lamp, Self::OneSided, Self::Environment];
}

/// Every integrator, with paths in their three ways to find lights.
pub const INTEGRATORS: [Integrator; 7] = [
    Integrator::RayCasting,
    Integrator::WHITTED,
    Integrator::AmbientOcclusion { distance: 8.0 },
    Integrator::DISTRIBUTION,
    path(LightStrategy::Bsdf),
    path(LightStrategy::Light),
    path(LightStrategy::Mis),
];

const fn path(lights: LightStrategy) -> Integrator {
    Integrator::Path { max_depth: 12, lights, roulette: 2 }
}

/// A floor, a matte ball, a point light, and what is on.
pub fn followed_by(on: &[FollowToggle], integrator: Integrator, setup: Setup) -> World {
    let has = |toggle| on.contains(&toggle);
    let mut world = World::new();
    let look = LookAt { eye: setup.point(0.5, 1.5, 4.0), target: setup.point(0.0, 0.5, 0.0), up: DVec3::Y };
    setup.camera(&mut world, look);
    let camera = world.query_filtered::<Entity, With<LookAt>>().single(&world).expect("a camera");
    world.entity_mut(camera).insert(integrator);
    let at = |x, y, z| Placement { position: setup.point(x, y, z), ..Placement::default() };
    let ball = |radius: f64| Sphere { radius: radius * setup.scale };
    world.spawn((Name::new("floor"), Plane::default(), at(0.0, 0.0, 0.0), Matte::default()));
    let red = Matte { colour: Rgb::new(0.8, 0.3, 0.2) };
    world.spawn((Name::new("matte ball"), ball(0.5), at(0.0, 0.5, -1.0), red));
    world.spawn((Name::new("point"), setup.light(9.0, true), at(-2.0, 3.0, 2.0)));
    if has(FollowToggle::Mirror) {
        world.spawn((Name::new("mirror"), ball(0.5), at(-1.2, 0.5, 0.0), Mirror::default()));
    }
    if has(FollowToggle::Glass) {
        let absorption = if has(FollowToggle::Absorbing) {
            let [r, g, b] = [0.2, 0.9, 1.4].map(|part| part / setup.scale);
            Rgb::new(r, g, b)
        } else {
            Rgb::BLACK
        };
        world.spawn((Name::new("glass"), ball(0.5), at(0.1, 0.5, 0.7), Glass { absorption, ..Glass::default() }));
    }
    if has(FollowToggle::Metal) {
        world.spawn((Name::new("metal"), ball(0.5), at(1.3, 0.5, 0.0), Metal::default()));
    }
    if has(FollowToggle::Lamp) {
        let orientation = DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0);
        let sides = if has(FollowToggle::OneSided) { Sides::Front } else { Sides::Both };
        let place = Placement { orientation, ..at(0.5, 2.5, 0.5) };
        let panel = Rectangle { width: setup.scale, depth: setup.scale };
        world.spawn((Name::new("lamp"), panel, place, Emissive { radiance: Rgb::grey(4.0), sides }));
    }
    if has(FollowToggle::Environment) {
        let file = "chapters/16_textures/evening.hdr".into();
        world.spawn((Name::new("evening"), Environment { file, turn: Degrees(30.0), scale: 2.0 }));
    }
    world
}

/// All of it, by one of the integrators.
pub fn followed(integrator: Integrator, setup: Setup) -> World {
    followed_by(&FollowToggle::ALL, integrator, setup)
}
