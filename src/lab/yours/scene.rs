//! The scenes of the reader's program as entities, and what they would be with a mistake.

use crate::naive::one_page;
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use pinhole::film::Film;
use pinhole::models::TriangleMesh;
use pinhole::render::{Execution, render};
use pinhole::scene::*;
use pinhole::{Chapter, Error, stages};
use std::f64::consts::PI;

/// The size of the program's picture.
pub const SIZE: [usize; 2] = [480, 270];

/// The scene that the program shows after a chapter, from the fifth on.
pub fn scene_after(chapter: u32) -> World {
    let mut world = World::new();
    let integrator = match chapter {
        ..19 => Integrator::RayCasting,
        19..21 => Integrator::WHITTED,
        21..25 => Integrator::DISTRIBUTION,
        25..33 => Integrator::PATH,
        33.. => Integrator::RayCasting,
    };
    let camera = PerspectiveCamera { fov: Degrees(60.0), axis: FovAxis::Vertical };
    let camera = world.spawn((camera, Resolution { width: SIZE[0] as u32, height: SIZE[1] as u32 }, integrator)).id();
    if chapter >= 9 {
        let (eye, target) = (DVec3::new(2.5, 1.4, 1.4), DVec3::new(0.0, -0.3, -3.0));
        world.entity_mut(camera).insert(LookAt { eye, target, ..LookAt::default() });
    }
    if chapter == 23 {
        let aperture = Aperture::Radius { radius: 0.12 };
        world.entity_mut(camera).insert(Lens { aperture, focus_distance: 3.5, blades: 0, turn: Degrees(0.0) });
    }
    if (17..33).contains(&chapter) {
        world.entity_mut(camera).insert(Sampling { samples: 64, filter: Filter::BOX, seed: 1, ..Sampling::default() });
    }
    world.spawn(Background { colour: Rgb::new(0.5, 0.7, 1.0) });
    let sphere = |radius, x, y, z| (Sphere { radius }, Placement::at(x, y, z));
    let matte = |r, g, b| Matte { colour: Rgb::new(r, g, b) };
    let (ground, red) = (matte(0.5, 0.6, 0.5), matte(0.9, 0.3, 0.2));
    if chapter >= 28 {
        let [rings, sides] = if chapter < 30 { [32, 6] } else { [400, 30] };
        world.spawn((MeshInstance::new(shell(rings, sides)), matte(0.9, 0.5, 0.3)));
    }
    if chapter >= 33 {
        world.spawn((Rectangle { width: 8.0, depth: 5.0 }, Placement::at(0.0, -1.0, -3.5), ground));
        // The lamp, as if all of it were at its centre.
        let intensity = Rgb::new(60.0, 54.0, 45.0);
        world.spawn((PointLight { intensity, casts_shadows: false }, Placement::at(1.0, 3.0, 0.0)));
        brighten(&mut world, 0.25 * PI);
        return world;
    }
    if chapter < 13 {
        world.spawn((sphere(100.0, 0.0, -101.0, -3.0), ground));
        world.spawn((sphere(1.0, 0.0, 0.0, -3.0), red));
    } else {
        world.spawn((Plane::default(), Placement::at(0.0, -1.0, 0.0), ground));
        let block = (Cuboid { size: DVec3::new(1.4, 1.8, 1.4) }, Placement::at(-2.1, -0.1, -3.8));
        world.spawn((block, matte(0.3, 0.4, 0.8)));
        let (large, small) = (sphere(1.0, 0.0, 0.0, -3.0), sphere(0.5, 1.5, -0.5, -1.6));
        if chapter < 19 {
            world.spawn((large, red));
            world.spawn((small, matte(0.8, 0.8, 0.3)));
        } else {
            world.spawn((large, Mirror { colour: Rgb::new(0.9, 0.8, 0.6) }));
            if chapter < 28 {
                world.spawn((small, red));
            }
        }
        if chapter >= 20 {
            world.spawn((sphere(0.6, 2.3, -0.4, -1.4), Glass { ior: 1.5, ..Glass::default() }));
        }
    }
    let lamp = |r, g, b| PointLight { intensity: Rgb::new(r, g, b), ..PointLight::default() };
    match chapter {
        ..10 => _ = world.spawn((lamp(60.0, 60.0, 60.0), Placement::at(3.0, 4.0, 0.0))),
        10..21 => {
            world.spawn((lamp(60.0, 54.0, 45.0), Placement::at(3.0, 4.0, 0.0)));
            world.spawn((lamp(8.0, 14.0, 24.0), Placement::at(-4.0, 3.0, -1.0)));
        }
        26 => {
            let emission = Emissive { radiance: Rgb::new(6.0, 5.4, 4.5), sides: Sides::Front };
            world.spawn((sphere(0.4, -0.5, -0.55, -1.3), emission));
        }
        21.. => {
            let emission = Emissive { radiance: Rgb::new(60.0, 54.0, 45.0), sides: Sides::Front };
            world.spawn((sphere(0.5, 1.0, 3.0, 0.0), emission));
        }
    }
    world
}

/// The shell that the program makes of triangles.
fn shell(rings: u32, sides: u32) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for ring in 0..=rings {
        let along = f64::from(ring) / f64::from(rings);
        let size = 1.2 * libm::exp(2.4 * (along - 1.0));
        let turn = DVec2::from_angle(8.0 * PI * along);
        for side in 0..sides {
            let round = DVec2::from_angle(2.0 * PI * f64::from(side) / f64::from(sides));
            let (out, down) = (size * (0.35 + 0.3 * round.x), size * (0.9 - 0.3 * round.y));
            let place = DVec3::new(1.0 - out * turn.x, 0.44 - down, -1.6 - out * turn.y);
            mesh.positions.push(place.as_vec3().to_array());
        }
    }
    for ring in 0..rings {
        for side in 0..sides {
            let [a, b] = [side, (side + 1) % sides].map(|side| ring * sides + side);
            mesh.triangles.extend([[a, b, a + sides], [b, b + sides, a + sides]]);
        }
    }
    mesh
}

/// The picture that the program shows after a chapter: pinhole's of the same scene, and that of page 1 itself, where light
/// comes from nowhere as well; with at most so many samples a pixel.
///
/// Errors: those of a render.
pub fn film_after(chapter: u32, samples: u32) -> Result<Film, Error> {
    if chapter == 1 {
        return Ok(one_page::film(SIZE));
    }
    let mut scene = scene_after(chapter);
    sample_at_most(&mut scene, samples);
    picture_of(&scene)
}

/// At most so many samples a pixel.
pub(super) fn sample_at_most(scene: &mut World, samples: u32) {
    let mut samplings = scene.query::<&mut Sampling>();
    samplings.iter_mut(scene).for_each(|mut own| own.samples = own.samples.min(samples));
}

/// pinhole's picture of a scene.
///
/// Errors: those of a render.
pub fn picture_of(scene: &World) -> Result<Film, Error> {
    let chapter = Chapter::new("yours", "the reader's scene", |_| ()).offer(stages::all());
    Ok(render(scene, &chapter.stages(), &Execution::default(), &())?.film)
}

/// A mistake as a change of the scene.
pub struct Variant {
    /// What the picture looks like, as the end of a sentence.
    pub looks_like: &'static str,
    /// The first chapter whose program can have it.
    pub from: u32,
    /// The first one whose program cannot.
    pub until: u32,
    /// Makes it.
    pub change: fn(&mut World),
}

/// The mistakes that are tried where a picture differs.
pub fn variants() -> Vec<Variant> {
    let always = |looks_like, change| Variant { looks_like, from: 5, until: 100, change };
    let within = |from, until, looks_like, change| Variant { looks_like, from, until, change };
    vec![
        always("all lamps are π times too bright: is the division by π missing?", |world| brighten(world, PI)),
        always("all lamps are too dark by a factor of π: is it divided by π twice?", |world| {
            brighten(world, 1.0 / PI)
        }),
        always("all lamps are twice as bright as they should be.", |world| brighten(world, 2.0)),
        always("all lamps are half as bright as they should be.", |world| brighten(world, 0.5)),
        within(5, 21, "nothing casts a shadow: what is done with the ray to the light?", |world| {
            world.query::<&mut PointLight>().iter_mut(world).for_each(|mut light| light.casts_shadows = false);
        }),
        always("the angle of view is twice as large: is it halved before its tangent is taken?", |world| {
            world.query::<&mut PerspectiveCamera>().iter_mut(world).for_each(|mut camera| camera.fov.0 *= 2.0);
        }),
        always("the angle of view is that from the left edge to the right.", |world| {
            let all = world.query::<&mut PerspectiveCamera>();
            { all }.iter_mut(world).for_each(|mut camera| camera.axis = FovAxis::Horizontal);
        }),
        always("the plane is at twice the distance: the tangent is taken for the whole height.", |world| {
            let half = libm::atan(0.5 * libm::tan(30.0_f64.to_radians())).to_degrees();
            world
                .query::<&mut PerspectiveCamera>()
                .iter_mut(world)
                .for_each(|mut camera| camera.fov = Degrees(2.0 * half));
        }),
        within(10, 100, "the camera stands where page 1 put it: the step of chapter 9 is missing.", |world| {
            look_at(world, |look| *look = LookAt { eye: DVec3::ZERO, target: DVec3::NEG_Z, ..LookAt::default() });
        }),
        within(9, 100, "the eye is still at the origin.", |world| {
            let target = DVec3::new(0.0, -0.3, -3.0);
            look_at(world, |look| *look = LookAt { eye: DVec3::ZERO, target, ..LookAt::default() });
        }),
        within(9, 100, "the camera looks away from its target: is `back` turned round?", |world| {
            look_at(world, |look| look.target = 2.0 * look.eye - look.target);
        }),
        always("surfaces have lost their colours.", |world| {
            world.query::<&mut Matte>().iter_mut(world).for_each(|mut matte| matte.colour = Rgb::grey(1.0));
        }),
        within(10, 21, "only the first lamp shines.", |world| remove_light(world, 1)),
        within(10, 21, "only the last lamp shines.", |world| remove_light(world, 0)),
        within(13, 100, "the block is missing.", remove_all::<Cuboid>),
        within(13, 100, "the ground is missing.", remove_all::<Plane>),
        within(19, 100, "mirrors reflect all light, whatever their colour.", |world| {
            world.query::<&mut Mirror>().iter_mut(world).for_each(|mut mirror| mirror.colour = Rgb::grey(1.0));
        }),
        within(
            19,
            100,
            "mirrors reflect nothing: does the ray start above the surface and lead away from it, and does the loop go on?",
            |world| {
                world.query::<&mut Mirror>().iter_mut(world).for_each(|mut mirror| mirror.colour = Rgb::BLACK);
            },
        ),
        within(19, 100, "the mirror ball is matte.", |world| {
            let balls: Vec<Entity> = world.query_filtered::<Entity, With<Mirror>>().iter(world).collect();
            for ball in balls {
                let colour = Rgb::new(0.9, 0.8, 0.6);
                world.entity_mut(ball).remove::<Mirror>().insert(Matte { colour });
            }
        }),
        within(20, 100, "light bends the wrong way: `eta` is that of the other direction.", |world| {
            world.query::<&mut Glass>().iter_mut(world).for_each(|mut glass| glass.ior = 1.0 / glass.ior);
        }),
        within(20, 100, "the glass does not bend light.", |world| {
            world.query::<&mut Glass>().iter_mut(world).for_each(|mut glass| glass.ior = 1.0);
        }),
        within(25, 100, "the sky lights nothing.", |world| {
            world.query::<&mut Background>().iter_mut(world).for_each(|mut sky| sky.colour = Rgb::BLACK);
        }),
        within(25, 100, "light goes by one surface only: the path ends too early.", |world| {
            world.query::<&mut Integrator>().iter_mut(world).for_each(|mut own| *own = Integrator::DISTRIBUTION);
        }),
    ]
}

fn brighten(world: &mut World, by: f64) {
    let brighter = |colour: Rgb| Rgb::new(colour.r * by, colour.g * by, colour.b * by);
    world.query::<&mut PointLight>().iter_mut(world).for_each(|mut own| own.intensity = brighter(own.intensity));
    world.query::<&mut Emissive>().iter_mut(world).for_each(|mut own| own.radiance = brighter(own.radiance));
}

fn look_at(world: &mut World, change: impl Fn(&mut LookAt)) {
    world.query::<&mut LookAt>().iter_mut(world).for_each(|mut look| change(&mut look));
}

fn remove_light(world: &mut World, number: usize) {
    let light = world.query_filtered::<Entity, With<PointLight>>().iter(world).nth(number);
    light.into_iter().for_each(|light| _ = world.despawn(light));
}

fn remove_all<C: Component>(world: &mut World) {
    let all: Vec<Entity> = world.query_filtered::<Entity, With<C>>().iter(world).collect();
    all.into_iter().for_each(|one| _ = world.despawn(one));
}
