//! A sky that lights its scene, whatever else the scene holds and although no integrator is named.

use super::*;
use glam::DVec3;
use pinhole::film::{Film, write_exr};
use pinhole::look::{Preflight, preflight};
use pinhole::render::prepare;
use pinhole::scene::*;
use pinhole::{Chapter, stages};

type Part<'a> = (&'static str, &'a dyn Fn(&mut World));

/// An EXR of radiance 1 in all directions.
fn even_image(name: &str) -> String {
    let mut world = World::new();
    world.spawn((PerspectiveCamera::default(), Resolution { width: 8, height: 4 }));
    world.spawn(Background { colour: Rgb::grey(1.0) });
    let film: Film = render(&world, &offer(), &Execution::default(), &()).expect("renders").film;
    let file = std::env::temp_dir().join(format!("pinhole_{name}_{}.exr", std::process::id()));
    write_exr(&film, &file).expect("written");
    file.to_string_lossy().into_owned()
}

/// A floor of albedo 0.5 seen from above, in front of a sky of radiance 0.2: it is as bright as half of the sky.
fn floor(parts: &[&dyn Fn(&mut World)]) -> World {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::Y, target: DVec3::new(0.0, 0.0, 0.1), up: DVec3::Z };
    let sampling = Sampling { samples: 64, ..Sampling::default() };
    let camera = PerspectiveCamera { fov: Degrees(40.0), ..PerspectiveCamera::default() };
    world.spawn((Name::new("camera"), camera, look, Resolution { width: 4, height: 4 }, sampling));
    world.spawn((Name::new("floor"), Plane::default(), Matte { colour: Rgb::grey(0.5) }));
    parts.iter().for_each(|part| part(&mut world));
    world
}

/// Every kind of sky with each of many companions: all of them give the closed form, 0.1.
#[test]
fn a_sky_lights_whatever_stands_under_it() {
    const FAINT: Rgb = Rgb { r: 1e-9, g: 1e-9, b: 1e-9 };
    let file = even_image("even_sky");
    let grey = Rgb::grey(0.2);
    let skies: [Part<'_>; 3] = [
        ("a background", &|world| _ = world.spawn((Name::new("sky"), Background { colour: grey }))),
        ("a gradient", &|world| _ = world.spawn((Name::new("sky"), Gradient { bottom: grey, top: grey }))),
        ("an environment", &|world| {
            let file = file.clone();
            world.spawn((Name::new("sky"), Environment { file, scale: 0.2, ..Environment::default() }));
        }),
    ];
    let far = Placement::at(50.0, 0.0, 0.0);
    let small = Sphere { radius: 0.01 };
    let high = Placement::at(0.0, 30.0, 0.0);
    let companions: [Part<'_>; 11] = [
        ("nothing", &|_| ()),
        ("a mirror ball", &|world| _ = world.spawn((Sphere::default(), Mirror::default(), far))),
        ("a glass ball", &|world| _ = world.spawn((Sphere::default(), Glass::default(), far))),
        ("a metal ball", &|world| _ = world.spawn((Sphere::default(), Metal::default(), far))),
        ("a glossy ball", &|world| _ = world.spawn((Sphere::default(), Phong::default(), far))),
        ("a point light", &|world| _ = world.spawn((PointLight { intensity: FAINT, ..PointLight::default() }, high))),
        ("a sun", &|world| _ = world.spawn(DirectionalLight { irradiance: FAINT, ..DirectionalLight::default() })),
        ("a spotlight", &|world| _ = world.spawn((SpotLight { intensity: FAINT, ..SpotLight::default() }, high))),
        ("an ember", &|world| _ = world.spawn((small, Emissive { radiance: FAINT, ..Emissive::default() }, high))),
        ("a mirror ball and a point light", &|world| {
            world.spawn((Sphere::default(), Mirror::default(), far));
            world.spawn((PointLight { intensity: FAINT, ..PointLight::default() }, high));
        }),
        ("a disabled light", &|world| _ = world.spawn((PointLight::default(), high, Disabled))),
    ];
    let mut worst = 0.0_f32;
    for (sky, add_sky) in &skies {
        for (companion, add_companion) in &companions {
            let world = floor(&[add_sky, add_companion]);
            let chosen = integrator_of(&Census::of(&world));
            assert_eq!(chosen.integrator, Integrator::PATH, "{sky} and {companion}");
            assert!(!chosen.is_named && !chosen.reason.is_empty(), "{}", chosen.reason);
            let film = render(&world, &offer(), &Execution::default(), &()).expect("renders").film;
            let mean = (0..16).map(|at| film.mean(at % 4, at / 4)[1]).sum::<f32>() / 16.0;
            worst = worst.max((mean - 0.1).abs());
            assert!((mean - 0.1).abs() < 5e-4, "{sky} and {companion}: {mean}");
            let census = &Census::of(&world);
            let (plan, tables) = prepare(census, &offer()).expect("prepares");
            assert!(plan.rows.iter().any(|row| row.kept && row.reason.contains("path tracing")), "{sky}, {companion}");
            preflight(census, (&plan, &tables), Preflight::default()).expect("no refusal");
        }
    }
    eprintln!("skies: {} scenes, each within {worst:.1e} of 0.1", skies.len() * companions.len());
    let _ = std::fs::remove_file(&file);
}

/// A black sky lights nothing, and a sky over specular surfaces alone needs nothing that it did not need before.
#[test]
fn a_sky_that_lights_nothing_chooses_nothing() {
    let black: [&dyn Fn(&mut World); 3] = [
        &|world| _ = world.spawn(Background { colour: Rgb::BLACK }),
        &|world| _ = world.spawn(Gradient { bottom: Rgb::BLACK, top: Rgb::BLACK }),
        &|world| _ = world.spawn(Environment { file: "gone.exr".into(), scale: 0.0, ..Environment::default() }),
    ];
    for sky in black {
        assert_eq!(integrator_of(&Census::of(&floor(&[sky]))).integrator, Integrator::RayCasting);
    }
    let mut mirrors = World::new();
    mirrors.spawn((PerspectiveCamera::default(), Placement::at(0.0, 0.0, 5.0)));
    mirrors.spawn((Sphere::default(), Mirror::default()));
    mirrors.spawn((PointLight::default(), Placement::at(0.0, 5.0, 0.0)));
    mirrors.spawn(Background { colour: Rgb::grey(1.0) });
    assert_eq!(integrator_of(&Census::of(&mirrors)).integrator, Integrator::WHITTED);
}

/// A chapter that offers no path continuation shows its sky and is lit by its lights; its scene says so. A scene for which
/// no such stage is on offer is refused, not black.
#[test]
fn without_paths_on_offer_the_scene_names_its_integrator() {
    fn scene(world: &mut World) {
        *world = floor(&[&|world| _ = world.spawn(Background { colour: Rgb::grey(0.2) })]);
    }
    let direct =
        || [stages::camera_rays(), stages::intersection(), stages::surfaces(), stages::direct_light()].concat();
    let chapter = Chapter::new("direct", "direct light", scene).offer(direct());
    let named = |chapter: &Chapter| {
        let mut world = chapter.world(&Overrides::default());
        world.query::<&Integrator>().iter(&world).next().copied()
    };
    assert_eq!(named(&chapter), Some(Integrator::RayCasting));
    assert_eq!(named(&Chapter::new("all", "all", scene).offer(stages::all())), None);
    let mut world = World::new();
    scene(&mut world);
    let refused = prepare(&Census::of(&world), &chapter.stages()).map(|_| ()).expect_err("refused").to_string();
    assert!(refused.contains("camera \"camera\"") && refused.contains("RayCasting"), "{refused}");
    let told = ["integrator", "\"sky\""].map(|word| refused.contains(word));
    assert!(told[0], "{refused}");
}

/// A camera that sees both halves of the sky.
#[test]
fn a_gradient_is_seen_where_one_end_alone_is_black() {
    let (black, grey) = (Rgb::BLACK, Rgb::grey(0.5));
    for (bottom, top, seen) in [(black, grey, true), (grey, black, true), (grey, grey, true), (black, black, false)] {
        let mut world = World::new();
        world.spawn((PerspectiveCamera::default(), Resolution { width: 4, height: 4 }));
        world.spawn(Gradient { bottom, top });
        let film = render(&world, &offer(), &Execution::default(), &()).expect("renders").film;
        for y in 0..4 {
            assert_eq!(film.mean(1, y)[0] > 0.0, seen, "{bottom:?} to {top:?}, line {y}");
        }
    }
}
