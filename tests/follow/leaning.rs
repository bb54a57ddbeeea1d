//! Shading normals, held against surfaces that truly lean: the light on a triangle whose vertex normals are all n′, or on
//! a rectangle whose normal map is n′ everywhere, is that on a surface of normal n′ above a black floor, which takes away what comes from below.

use super::normal_maps::write_map;
use super::*;
use glam::{DQuat, DVec3};
use pinhole::film::{Film, write_exr};
use pinhole::scene::*;
use pinhole::shade::direction_of;
use std::path::Path;

/// Every material that light sampling can find light for, rough enough that no strategy is lost.
pub const MATERIALS: &[(&str, fn(&mut EntityWorldMut<'_>))] = &[
    ("matte", |thing| _ = thing.insert(Matte { colour: Rgb::grey(0.8) })),
    ("Phong", |thing| {
        _ = thing.insert(Phong { colour: Rgb::grey(0.3), specular: Rgb::grey(0.6), exponent: 8.0 });
    }),
    ("Blinn–Phong", |thing| {
        _ = thing.insert(BlinnPhong { colour: Rgb::grey(0.3), specular: Rgb::grey(0.6), exponent: 12.0 });
    }),
    ("metal", |thing| {
        _ = thing.insert(Metal { colour: Rgb::grey(0.9), roughness: 0.4, multiple_scattering: false });
    }),
    ("metal, multiple scattering", |thing| {
        _ = thing.insert(Metal { colour: Rgb::grey(0.9), roughness: 1.0, multiple_scattering: true });
    }),
    ("principled", |thing| {
        _ = thing.insert(Principled {
            base_colour: Rgb::grey(0.8),
            metallic: 0.3,
            roughness: 0.7,
            ..Principled::default()
        });
    }),
];

/// The vertex normals, 50° from the triangle's own.
fn leaning() -> DVec3 {
    let (sine, cosine) = libm::sincos(50_f64.to_radians());
    DVec3::new(0.8 * sine, cosine, 0.6 * sine)
}

/// A sky brighter on one side than on the other, so that its turn shows.
fn write_sky(path: &Path) {
    let (width, height) = (32_u32, 16_u32);
    let mut image = Film::new(width, height, width);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let at = [f64::from(x) + 0.5, f64::from(y) + 0.5];
        let direction = direction_of([at[0] / f64::from(width), at[1] / f64::from(height)].into());
        let bright = direction.dot(DVec3::new(0.6, 0.64, -0.48)).max(0.0);
        let radiance = (0.1 + 2.0 * bright * bright * bright) as f32;
        image.tiles[0].add((y * width + x) as usize, [radiance; 3]);
    }
    write_exr(&image, path).expect("written");
}

/// A camera that looks at the origin through a window so small that all of it is one point.
fn scene(surface: &dyn Fn(&mut World), lights: &dyn Fn(&mut World)) -> World {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.9, 3.0, 1.6), target: DVec3::ZERO, up: DVec3::Y };
    let integrator = Integrator::Path { max_depth: 2, lights: LightStrategy::Mis, roulette: 0 };
    let size = Resolution { width: 8, height: 8 };
    world.spawn((Name::new("camera"), OrthographicCamera { view_height: 1e-3 }, look, size, integrator));
    surface(&mut world);
    lights(&mut world);
    world
}

/// A wide triangle in the plane y = 0 whose vertex normals lean.
fn shaded(material: fn(&mut EntityWorldMut<'_>)) -> impl Fn(&mut World) {
    move |world| {
        let vertices = [DVec3::new(-0.3, 0.0, -0.2), DVec3::new(0.1, 0.0, 0.4), DVec3::new(0.3, 0.0, -0.2)];
        material(&mut world.spawn(Triangle { vertices, normals: Some([leaning(); 3]), uvs: None }));
    }
}

/// A wide rectangle in the plane y = 0 with a normal map of one direction; and how it lies, with that direction's parts
/// along growing u, along falling v and out of its front.
fn mapped(material: fn(&mut EntityWorldMut<'_>), lies: usize, folder: &Path) -> impl Fn(&mut World) {
    let DVec3 { x, y, z } = leaning();
    let (placement, local) = match lies {
        // u is +x and v is +z.
        0 => (Placement::default(), [x, -z, y]),
        // Turned over about x, so that it is seen from behind, and v is −z.
        1 => {
            let orientation = DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0);
            (Placement { orientation, ..Placement::default() }, [-x, -z, y])
        }
        // Mirrored, so that u is −x.
        2 => (Placement { scale: DVec3::new(-2.0, 1.0, 1.0), ..Placement::default() }, [-x, -z, y]),
        // The same direction by half of its steepness.
        _ => (Placement::default(), [0.5 * x, -0.5 * z, y]),
    };
    let file = folder.join(format!("map-{lies}.exr"));
    write_map(&file, 2, |_| local);
    let scale = if lies == 3 { 2.0 } else { 1.0 };
    let map = NormalMap { file: file.to_string_lossy().into_owned(), scale, ..NormalMap::default() };
    move |world| material(world.spawn((Rectangle { width: 0.6, depth: 0.6 }, placement)).insert(map.clone()))
}

/// A small rectangle that leans as those normals do, above a black floor.
fn tilted(material: fn(&mut EntityWorldMut<'_>)) -> impl Fn(&mut World) {
    move |world| {
        let orientation = DQuat::from_rotation_arc(DVec3::Y, leaning());
        let plate = Rectangle { width: 0.01, depth: 0.01 };
        material(&mut world.spawn((plate, Placement { orientation, ..Placement::default() })));
        world.spawn((Plane::default(), Placement::at(0.0, -0.01, 0.0), Matte { colour: Rgb::grey(0.0) }));
    }
}

#[test]
fn vertex_normals_answer_every_light_as_a_surface_that_leans_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("sky.exr");
    write_sky(&file);
    let sky = |world: &mut World| {
        let file = file.to_string_lossy().into_owned();
        world.spawn(Environment { file, turn: Degrees(70.0), scale: 1.0 });
    };
    let panel = |world: &mut World| {
        let glow = Emissive { radiance: Rgb::grey(2.0), ..Emissive::default() };
        world.spawn((Rectangle { width: 6.0, depth: 5.0 }, Placement::at(0.8, 1.2, -2.0), glow));
    };
    const SETS: u64 = 8;
    const SAMPLES: u32 = 384;
    let mut tried = 0;
    for (turn, &(name, material)) in MATERIALS.iter().enumerate() {
        for (at, (light, lights)) in
            [("a turned sky", &sky as &dyn Fn(&mut World)), ("a panel", &panel)].into_iter().enumerate()
        {
            let truth = renders(&|| scene(&tilted(material), lights), LightStrategy::Bsdf, SAMPLES, 0..SETS);
            for (number, &strategy) in ALL.iter().enumerate() {
                // One of them in turn; with more samples asked for, each.
                if times_samples() == 1 && number != (turn + at) % ALL.len() {
                    continue;
                }
                let first = SETS * (number as u64 + 1);
                let own = renders(&|| scene(&shaded(material), lights), strategy, SAMPLES, first..first + SETS);
                let found = assert_agree(&format!("{name} under {light}, {strategy:?}"), &own, &truth, 8);
                assert!(found.resolution < 0.012, "{name} under {light}: too noisy to tell");
                tried += 1;
            }
        }
    }
    eprintln!("vertex normals: {tried} pairs of {SETS} × {} paths", 64 * SAMPLES);
}

/// Lights without an area are seen in one direction only, so nothing is random and the two agree to rounding.
#[test]
fn shading_normals_answer_lights_without_area_exactly() {
    let folder = tempfile::tempdir().expect("a folder");
    type Spawn = fn(&mut World);
    let lights: [(&str, Spawn); 3] = [
        ("a point light", |world| {
            let light = PointLight { intensity: Rgb::grey(9.0), ..PointLight::default() };
            world.spawn((light, Placement::at(1.0, 2.0, 3.0)));
        }),
        ("a spot light", |world| {
            let light = SpotLight { intensity: Rgb::grey(9.0), ..SpotLight::default() };
            world.spawn((light, LookAt { eye: DVec3::new(1.0, 2.0, -0.5), target: DVec3::ZERO, up: DVec3::Y }));
        }),
        ("a directional light", |world| {
            let light = DirectionalLight { irradiance: Rgb::grey(2.0), ..DirectionalLight::default() };
            world.spawn((light, LookAt { eye: DVec3::new(3.0, 1.0, 1.0), target: DVec3::ZERO, up: DVec3::Y }));
        }),
    ];
    let (mut tried, mut worst) = (0, 0.0_f64);
    for &(name, material) in MATERIALS {
        for (light, lights) in lights {
            let radiance = |surface: &dyn Fn(&mut World)| {
                let film =
                    render(&scene(surface, &lights), &offer(), &Execution::default(), &()).expect("renders").film;
                f64::from(film.mean(4, 4)[1])
            };
            let truth = radiance(&tilted(material));
            let maps = (0..4).map(|lies| radiance(&mapped(material, lies, folder.path())));
            for (surface, own) in std::iter::once(radiance(&shaded(material))).chain(maps).enumerate() {
                let off = (own / truth - 1.0).abs();
                assert!(truth > 1e-3 && off < 2e-3, "{name} under {light}, surface {surface}: {own} for {truth}");
                (tried, worst) = (tried + 1, worst.max(off));
            }
        }
    }
    eprintln!("shading normals: {tried} surfaces and lights, worst {worst:.1e} apart");
}

/// Both turn the camera's ray to the same place of the sky, wherever that is bright.
#[test]
fn a_mapped_mirror_shows_what_one_that_leans_so_shows() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("sky.exr");
    write_sky(&file);
    let silver = |thing: &mut EntityWorldMut<'_>| _ = thing.insert(Mirror { colour: Rgb::grey(0.9) });
    let mut brightest = 0.0_f64;
    for turn in [10.0, 100.0, 190.0, 280.0] {
        let sky = |world: &mut World| {
            let file = file.to_string_lossy().into_owned();
            world.spawn(Environment { file, turn: Degrees(turn), scale: 1.0 });
        };
        let radiance = |surface: &dyn Fn(&mut World)| {
            renders_by(&|| scene(surface, &sky), Integrator::WHITTED, 1, 0..1)[0].pixels[36][1]
        };
        let truth = radiance(&tilted(silver));
        for lies in 0..4 {
            let own = radiance(&mapped(silver, lies, folder.path()));
            assert!((own / truth - 1.0).abs() < 2e-3, "sky turned by {turn}°, {lies}: {own} for {truth}");
        }
        brightest = brightest.max(truth);
    }
    eprintln!("mapped mirrors: 16 show the sky, of up to {brightest:.3}");
    assert!(brightest > 0.5, "a dark sky shows nothing: {brightest}");
}
