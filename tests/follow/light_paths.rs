//! Light tracing, held against what follows from its definition: lights add up, light that falls straight on a surface
//! is left to the camera's paths, and so is emission that the camera sees.

use super::leaning::MATERIALS;
use super::*;
use glam::{DQuat, DVec3};
use pinhole::film::Film;
use pinhole::scene::*;
use pinhole::shade::join_cosine;

type Spawn = fn(&mut World);

fn facing_down(x: f64, y: f64) -> Placement {
    Placement { orientation: DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0), ..Placement::at(x, y, 0.0) }
}

fn glow(radiance: f64) -> Emissive {
    Emissive { radiance: Rgb::grey(radiance), ..Emissive::default() }
}

/// One light of each kind that light paths start on.
const LIGHTS: [(&str, Spawn); 7] = [
    ("point", |world| {
        world.spawn((PointLight { intensity: Rgb::grey(2.0), ..PointLight::default() }, Placement::at(0.1, 1.0, 0.0)));
    }),
    ("spot", |world| {
        let down = LookAt { eye: DVec3::new(0.1, 1.0, 0.0), target: DVec3::new(0.1, 0.0, 0.05), up: DVec3::X };
        let (inner_angle, outer_angle) = (Degrees(20.0), Degrees(50.0));
        world.spawn((SpotLight { intensity: Rgb::grey(2.0), inner_angle, outer_angle, casts_shadows: true }, down));
    }),
    ("sphere", |world| _ = world.spawn((Sphere { radius: 0.1 }, Placement::at(0.1, 1.0, 0.0), glow(60.0)))),
    ("disk", |world| _ = world.spawn((Disk { radius: 0.1 }, facing_down(0.1, 1.0), glow(60.0)))),
    ("rectangle", |world| {
        world.spawn((Rectangle { width: 0.2, depth: 0.1 }, facing_down(0.1, 1.0), glow(60.0)));
    }),
    ("triangle", |world| {
        let vertices = [DVec3::ZERO, DVec3::new(0.2, 0.0, 0.0), DVec3::new(0.0, 0.1, 0.2)];
        world.spawn((Triangle { vertices, ..Triangle::default() }, Placement::at(0.1, 1.0, 0.0), glow(60.0)));
    }),
    ("cuboid", |world| {
        world.spawn((Cuboid { size: DVec3::new(0.2, 0.1, 0.1) }, Placement::at(0.1, 1.0, 0.0), glow(60.0)));
    }),
];

/// A camera with light tracing beside paths, which looks from one place to another.
fn seen(eye: DVec3, target: DVec3, size: [u32; 2], samples: u32, seed: u64) -> World {
    let mut world = World::new();
    let look = LookAt { eye, target, up: DVec3::Z };
    let [width, height] = size;
    let integrator = Integrator::Path { max_depth: 5, lights: LightStrategy::Mis, roulette: 0 };
    let sampling = Sampling { samples, seed, sampler: Sampler::Independent, ..Sampling::default() };
    let camera = (Name::new("camera"), PerspectiveCamera::default(), look, Resolution { width, height });
    world.spawn((camera, integrator, sampling, LightTracing::default()));
    world
}

fn film_of(world: &World) -> Film {
    let film = render(world, &offer(), &Execution::default(), &()).expect("renders").film;
    assert_eq!(film.rejected().0, 0);
    film
}

/// What light paths alone bring to the film, green, the mean over its pixels.
fn splatted(film: &Film) -> f64 {
    let Some(splats) = &film.splats else { return 0.0 };
    splats.sums[1].iter().sum::<f64>() / splats.paths as f64 / splats.sums[1].len() as f64
}

/// Mean and variance of that mean, over seeds.
fn through_a_mirror(lights: &[Spawn], seeds: std::ops::Range<u64>) -> [f64; 2] {
    let count = (seeds.end - seeds.start) as f64;
    let values: Vec<f64> = seeds
        .map(|seed| {
            let mut world = seen(DVec3::new(0.0, 1.5, 0.0), DVec3::new(0.0, 2.0, 0.0), [16, 16], 32, seed);
            let camera = named(&mut world, "camera");
            let wide = PerspectiveCamera { fov: Degrees(110.0), ..PerspectiveCamera::default() };
            world.entity_mut(camera).insert((wide, LightTracing { paths: 4.0 }));
            world.spawn((Plane { normal: DVec3::NEG_Y }, Placement::at(0.0, 2.0, 0.0), Matte::default()));
            world.spawn((Rectangle { width: 0.8, depth: 0.8 }, Mirror::default()));
            lights.iter().for_each(|light| light(&mut world));
            splatted(&film_of(&world))
        })
        .collect();
    let mean = values.iter().sum::<f64>() / count;
    let spread: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
    [mean, spread / (count - 1.0) / count]
}

/// Takes the light away from all there is, and leaves the shapes.
fn darken(world: &mut World) {
    let mut lights = world.query_filtered::<Entity, Or<(With<Emissive>, With<PointLight>, With<SpotLight>)>>();
    let lights: Vec<Entity> = lights.iter(world).collect();
    for light in lights {
        let mut light = world.entity_mut(light);
        light.remove::<(Emissive, PointLight, SpotLight)>().insert(Matte { colour: Rgb::grey(0.0) });
    }
}

/// However a light is chosen, two bring what each brings alone.
#[test]
fn lights_add_up_on_light_paths() {
    const SEEDS: u64 = 8;
    let beside: Spawn = |world| {
        let light = PointLight { intensity: Rgb::grey(1.0), ..PointLight::default() };
        world.spawn((light, Placement::at(-0.2, 1.2, 0.1)));
    };
    for (number, (name, light)) in LIGHTS.into_iter().enumerate() {
        let first = SEEDS * (2 * number as u64 + 1);
        // What shines no more still stands in the other's light.
        let [other, of_other] = through_a_mirror(&[light, darken, beside], 1000..1000 + SEEDS);
        let [alone, of_alone] = through_a_mirror(&[light], first..first + SEEDS);
        let [both, of_both] = through_a_mirror(&[light, beside], first + SEEDS..first + 2 * SEEDS);
        let error = (of_other + of_alone + of_both).sqrt();
        let off = (both - other - alone) / error;
        eprintln!("{name} and another: {both:.5} for {alone:.5} + {other:.5}, {off:+.1} SE of {error:.1e}");
        assert!(alone > 1e-3 && error < 0.01 * both, "{name}: a standard error of {error} of {both}");
        assert!(off.abs() < 4.0, "{name}: together {both}, apart {alone} and {other}");
    }
}

/// A mirror in a shell that no light passes: light paths end on the shell, since what falls straight on it is the camera's.
#[test]
fn what_falls_straight_on_a_surface_is_left_to_the_camera() {
    let scene = |light: Spawn, shell: Option<fn(&mut EntityWorldMut<'_>)>| {
        let mut world = seen(DVec3::new(0.0, 0.5, 3.0), DVec3::ZERO, [24, 16], 8, 3);
        world.spawn((Plane::default(), Placement::at(0.0, -0.8, 0.0), Matte::default()));
        world.spawn((Sphere { radius: 0.3 }, Placement::at(0.1, 0.0, 0.0), Mirror::default()));
        if let Some(material) = shell {
            material(&mut world.spawn((Sphere { radius: 0.5 }, Placement::at(0.1, 0.0, 0.0))));
        }
        light(&mut world);
        splatted(&film_of(&world))
    };
    let mut tried = 0;
    for (light_name, light) in LIGHTS {
        assert!(scene(light, None) > 0.0, "{light_name}: without a shell the mirror sends light to the floor");
        for &(name, material) in MATERIALS {
            assert_eq!(scene(light, Some(material)), 0.0, "{light_name} on a shell of {name}");
            tried += 1;
        }
    }
    eprintln!("light paths: {tried} lights and shells, nothing counted twice");
}

/// What emits and has a material too shows its radiance to the camera, light tracing or not.
#[test]
fn emission_that_the_camera_sees_is_whole_with_light_tracing() {
    let shapes: [fn(&mut World) -> EntityWorldMut<'_>; 5] = [
        |world| world.spawn(Sphere { radius: 0.5 }),
        |world| world.spawn(Disk { radius: 0.5 }),
        |world| world.spawn(Rectangle::default()),
        |world| world.spawn(Cuboid::default()),
        |world| {
            let vertices = [DVec3::new(-1.0, 0.0, -1.0), DVec3::new(0.0, 0.0, 2.0), DVec3::new(1.0, 0.0, -1.0)];
            world.spawn(Triangle { vertices, ..Triangle::default() })
        },
    ];
    let mut tried = 0;
    for (number, shape) in shapes.into_iter().enumerate() {
        for &(name, material) in MATERIALS {
            for light_tracing in [false, true] {
                let mut world = seen(DVec3::Y * 9.0, DVec3::ZERO, [4, 4], 4, 1);
                let camera = named(&mut world, "camera");
                let mut camera = world.entity_mut(camera);
                camera.insert(PerspectiveCamera { fov: Degrees(1.0), ..PerspectiveCamera::default() });
                if !light_tracing {
                    camera.remove::<LightTracing>();
                }
                let mut lamp = shape(&mut world);
                lamp.insert(glow(3.0));
                material(&mut lamp);
                // Behind the lamp, where it shows the camera nothing.
                world.spawn((Sphere { radius: 0.2 }, Placement::at(0.0, -2.0, 0.0), Mirror::default()));
                let film = film_of(&world);
                for (x, y) in (0..4).flat_map(|y| (0..4).map(move |x| (x, y))) {
                    assert_eq!(film.mean(x, y), [3.0; 3], "shape {number} of {name}, light tracing {light_tracing}");
                    tried += 1;
                }
            }
        }
    }
    eprintln!("emission: {tried} pixels show their lamp's radiance");
}

#[test]
fn a_surface_that_faces_away_from_camera_or_light_is_not_connected() {
    for [to_camera, falling] in [[-0.5, 0.5], [0.0, 0.5], [0.5, -0.5], [0.5, 0.0]] {
        assert_eq!(join_cosine(to_camera, falling, 0.25), 0.0, "{to_camera} to the camera, {falling} from the light");
    }
    assert_eq!(join_cosine(0.5, 0.5, 0.25), 0.25);
}
