//! What is said before a render, held against the render: of every light, material, enclosure and integrator.

use super::*;
use glam::DVec3;
use pinhole::film::rgba_bytes;
use pinhole::look::{foretell, preflight};
use pinhole::render::prepare;
use pinhole::scene::*;

const SIDE: u32 = 16;

type Spawn = fn(&mut World);

/// Every kind of light, with what is wrong with it, if anything.
const LIGHTS: &[(&str, Spawn)] = &[
    ("none", |_| ()),
    ("point", |world| _ = world.spawn((Name::new("lamp"), bulb(60.0), Placement::at(1.0, 3.0, 2.0)))),
    ("black point", |world| _ = world.spawn((Name::new("lamp"), bulb(0.0), Placement::at(1.0, 3.0, 2.0)))),
    ("point in the ball", |world| _ = world.spawn((Name::new("lamp"), bulb(60.0), Placement::at(0.0, 0.0, 0.0)))),
    ("dim point", |world| _ = world.spawn((Name::new("lamp"), bulb(0.004), Placement::at(1.0, 3.0, 2.0)))),
    ("sun", |world| {
        let from = LookAt { eye: DVec3::new(1.0, 4.0, 3.0), ..LookAt::default() };
        world.spawn((Name::new("sun"), DirectionalLight { irradiance: Rgb::grey(3.0), ..Default::default() }, from));
    }),
    ("spot", |world| spot(world, DVec3::ZERO)),
    ("spot turned away", |world| spot(world, DVec3::new(0.0, 9.0, 9.0))),
    ("lamp in view", |world| lamp(world, DVec3::new(0.4, 0.9, 1.0), 0.2, 5.0)),
    ("lamp out of view", |world| lamp(world, DVec3::new(2.0, 3.0, 4.0), 0.3, 40.0)),
    ("dim lamp", |world| lamp(world, DVec3::new(2.0, 3.0, 4.0), 0.1, 0.5)),
    ("black lamp", |world| lamp(world, DVec3::new(2.0, 3.0, 4.0), 0.3, 0.0)),
    ("panel turned away", |world| {
        let glow = Emissive { radiance: Rgb::grey(20.0), sides: Sides::Front };
        world.spawn((Name::new("panel"), Rectangle { width: 1.0, depth: 1.0 }, Placement::at(0.0, 3.0, 0.0), glow));
    }),
    ("ceiling", |world| {
        let glow = Emissive { radiance: Rgb::grey(2.0), ..Emissive::default() };
        world.spawn((Name::new("ceiling"), Plane::default(), Placement::at(0.0, 20.0, 0.0), glow));
    }),
    ("background", |world| _ = world.spawn((Name::new("sky"), Background { colour: Rgb::grey(1.0) }))),
    ("dim background", |world| _ = world.spawn((Name::new("sky"), Background { colour: Rgb::grey(4e-4) }))),
    ("black background", |world| _ = world.spawn((Name::new("sky"), Background { colour: Rgb::BLACK }))),
    ("gradient", |world| _ = world.spawn((Name::new("sky"), Gradient::default()))),
];

const MATERIALS: &[(&str, Spawn)] = &[
    ("grey", |world| ball(world, Matte { colour: Rgb::grey(0.5) })),
    ("black", |world| ball(world, Matte { colour: Rgb::BLACK })),
    ("mirror", |world| ball(world, Mirror::default())),
    ("dark glass", |world| ball(world, Glass { absorption: Rgb::grey(4.0), ..Glass::default() })),
    ("metal", |world| ball(world, Metal::default())),
    // It is behind the camera.
    ("away", |world| {
        world.spawn((Name::new("ball"), Sphere::default(), Matte::default(), Placement::at(0.0, 0.0, 9.0)));
    }),
];

const INTEGRATORS: &[(&str, Option<Integrator>)] = &[
    ("chosen", None),
    ("ray casting", Some(Integrator::RayCasting)),
    ("Whitted", Some(Integrator::WHITTED)),
    ("ambient occlusion", Some(Integrator::AmbientOcclusion { distance: f64::INFINITY })),
    ("distribution", Some(Integrator::DISTRIBUTION)),
    ("paths", Some(Integrator::PATH)),
    ("paths, Bsdf", Some(Integrator::Path { max_depth: 16, lights: LightStrategy::Bsdf, roulette: 5 })),
    ("paths of one segment", Some(Integrator::Path { max_depth: 1, lights: LightStrategy::Mis, roulette: 5 })),
];

fn bulb(intensity: f64) -> PointLight {
    PointLight { intensity: Rgb::grey(intensity), ..PointLight::default() }
}

fn spot(world: &mut World, target: DVec3) {
    let light = SpotLight { intensity: Rgb::grey(60.0), ..SpotLight::default() };
    world.spawn((Name::new("lamp"), light, LookAt { eye: DVec3::new(1.0, 3.0, 2.0), target, ..LookAt::default() }));
}

fn lamp(world: &mut World, at: DVec3, radius: f64, radiance: f64) {
    let glow = Emissive { radiance: Rgb::grey(radiance), ..Emissive::default() };
    world.spawn((Name::new("lamp"), Sphere { radius }, Placement::at(at.x, at.y, at.z), glow));
}

fn ball(world: &mut World, material: impl Bundle) {
    world.spawn((Name::new("ball"), Sphere { radius: 1.2 }, Placement::at(0.0, 0.0, 0.0), material));
}

/// What was said of a scene and is not so.
fn falsehoods(world: &World, what: [&str; 3], is_closed: bool, told: &[String]) -> Vec<String> {
    let [light, material, integrator] = what;
    let rendered = render(world, &offer(), &Execution::default(), &()).expect("renders");
    let bytes = rgba_bytes(&rendered.film, rendered.curve());
    let max = |pixel: &[u8]| pixel[..3].iter().copied().max().expect("three");
    let pixels: Vec<u8> = bytes.chunks(4).map(max).collect();
    let dark_up_to = |max: u8| pixels.iter().filter(|&&byte| byte <= max).count() as f64 / pixels.len() as f64;
    let said = |words: &str| told.iter().any(|sentence| sentence.contains(words));
    let only_sky = ["background", "dim background", "gradient", "black background"].contains(&light);
    let claims = [
        ("probably be black", dark_up_to(0) >= 0.98),
        ("will look black", dark_up_to(8) >= 0.95),
        ("there is no light, no surface", ["none", "black background"].contains(&light)),
        ("could emit light is black", ["black point", "black lamp"].contains(&light)),
        ("no background with a colour", !only_sky || light == "black background"),
        ("hits a shape", material == "away" && !is_closed),
        ("no light but the background's", only_sky),
        ("the background illuminates nothing", only_sky),
        ("enclose it all around", is_closed),
        ("at max_depth 1", integrator == "paths of one segment"),
        ("what the camera sees reflects no light", ["black", "away"].contains(&material)),
        ("LightStrategy::Mis samples lights", integrator == "paths, Bsdf" && !only_sky),
        ("renders mirrors and glass black", ["mirror", "dark glass"].contains(&material)),
        ("is not in any light's beam", !["point", "sun", "spot"].contains(&light) || material == "black" || is_closed),
    ];
    let mut wrong: Vec<String> = claims
        .into_iter()
        .filter(|(words, is_so)| said(words) && !is_so)
        .map(|(words, _)| format!("\"{words}\" is not so"))
        .collect();
    if dark_up_to(0) == 1.0 && !said("black") && !said("returned light") && !said("hits a shape") {
        wrong.push("it is black, and nothing was said".into());
    }
    wrong
}

#[test]
fn what_is_said_before_a_render_is_so() {
    let (mut tried, mut claims, mut wrong) = (0, 0, Vec::new());
    for (number, (light, spawn_light)) in LIGHTS.iter().enumerate() {
        for (of_material, (material, spawn_ball)) in MATERIALS.iter().enumerate() {
            for (of_integrator, (integrator, named)) in INTEGRATORS.iter().enumerate() {
                // In the open and enclosed in turn; with more samples asked for, both.
                let is_first = (number + of_material + of_integrator).is_multiple_of(2);
                let enclosures = if times_samples() > 1 { &[false, true][..] } else { &[is_first][..] };
                for &is_closed in enclosures {
                    let mut world = World::new();
                    let look = LookAt { eye: DVec3::new(0.0, 0.5, 4.0), ..LookAt::default() };
                    let size = Resolution { width: SIDE, height: SIDE };
                    let samples = [1, 4, 16][(number + tried) % 3];
                    let sampling = Sampling { samples, ..Sampling::default() };
                    let camera =
                        world.spawn((Name::new("camera"), PerspectiveCamera::default(), look, size, sampling)).id();
                    if let Some(integrator) = named {
                        world.entity_mut(camera).insert(*integrator);
                    }
                    spawn_ball(&mut world);
                    spawn_light(&mut world);
                    if is_closed {
                        let room = Cuboid { size: DVec3::splat(12.0) };
                        world.spawn((Name::new("room"), room, Matte { colour: Rgb::grey(0.3) }));
                    }
                    let census = &Census::of(&world);
                    let Ok((plan, tables)) = prepare(census, &offer()) else { continue };
                    let told = preflight(census, (&plan, &tables), unhurried()).expect("said");
                    let found = falsehoods(&world, [light, material, integrator], is_closed, &told);
                    claims += told.iter().filter(|sentence| sentence.contains("black")).count();
                    for words in found {
                        wrong.push(format!("{light}, {material}, {integrator}, closed {is_closed}: {words}: {told:?}"));
                    }
                    tried += 1;
                }
            }
        }
    }
    eprintln!("foretold: {tried} scenes, {claims} of them said to be black or to render something black");
    assert!(tried > 600 && claims > 150, "{tried} {claims}");
    assert!(wrong.is_empty(), "{} of {tried}: {:#?}", wrong.len(), &wrong[..wrong.len().min(40)]);
}

/// A lake under the sky, which absorbs nearly all paths: one ray in fifty returns light, and every pixel is grey after
/// many; and a small lamp in a black picture.
#[test]
fn a_lake_that_reflects_the_sky_is_not_called_black() {
    for samples in [1, 256] {
        let mut world = World::new();
        let look = LookAt { eye: DVec3::new(0.0, 10.0, 4.0), ..LookAt::default() };
        let size = Resolution { width: 48, height: 32 };
        let camera = (Name::new("camera"), PerspectiveCamera { fov: Degrees(30.0), ..Default::default() }, look, size);
        world.spawn((camera, Sampling { samples, ..Sampling::default() }));
        world.spawn((Name::new("sky"), Background { colour: Rgb::new(0.8, 0.9, 1.0) }));
        world.spawn((Name::new("lake"), Plane::default(), Glass { absorption: Rgb::grey(2.0), ..Glass::default() }));
        let told = said(&world);
        assert!(!told.iter().any(|line| line.contains("black")), "{samples}: {told:?}");
    }
    let mut world = World::new();
    let size = Resolution { width: 96, height: 64 };
    world.spawn((Name::new("camera"), PerspectiveCamera::default(), Placement::at(0.0, 0.0, 9.0), size));
    lamp(&mut world, DVec3::ZERO, 0.6, 1.0);
    assert!(said(&world).is_empty(), "{:?}", said(&world));
}

/// A single pixel with many samples is no picture that takes minutes, however cold the first ray finds the machine.
#[test]
fn a_pixel_is_not_said_to_take_minutes() {
    for size in [[1, 1], [2, 1], [8, 8]] {
        let mut world = World::new();
        let size = Resolution { width: size[0], height: size[1] };
        let sampling = Sampling { samples: 20_000, ..Sampling::default() };
        world.spawn((Name::new("camera"), PerspectiveCamera::default(), Placement::at(0.0, 0.0, 4.0), size, sampling));
        ball(&mut world, Matte::default());
        lamp(&mut world, DVec3::new(2.0, 3.0, 4.0), 0.3, 40.0);
        let told = said(&world);
        assert!(told.is_empty(), "{told:?}");
    }
}

pub fn said(world: &World) -> Vec<String> {
    let census = &Census::of(world);
    let (plan, tables) = prepare(census, &offer()).expect("prepared");
    preflight(census, (&plan, &tables), unhurried()).expect("said")
}

#[test]
fn angles_in_radians_are_asked_about_and_others_are_not() {
    let scene = |fov: f64, turn: f64, cone: f64| {
        let mut world = World::new();
        world.spawn((
            Name::new("camera"),
            PerspectiveCamera { fov: Degrees(fov), ..Default::default() },
            Placement::at(0.0, 0.0, 4.0),
        ));
        let orientation = euler_xyz(Degrees(turn), Degrees(0.0), Degrees(0.0));
        world.spawn((
            Name::new("box"),
            Cuboid::default(),
            Matte::default(),
            Placement { orientation, ..Placement::default() },
        ));
        let light = SpotLight { outer_angle: Degrees(cone), inner_angle: Degrees(cone / 2.0), ..SpotLight::default() };
        let look = LookAt { eye: DVec3::new(0.0, 1.0, 4.0), ..LookAt::default() };
        world.spawn((Name::new("spot"), light, look));
        said(&world).into_iter().filter(|line| line.contains("radians")).collect::<Vec<_>>()
    };
    for (fov, turn, cone, asked) in [
        (40.0, 90.0, 60.0, None),
        (0.7, 90.0, 60.0, Some(["\"camera\"", "fov 0.7", "40.1"])),
        (40.0, 1.57, 60.0, Some(["\"box\"", "turned by 1.57", "90.0"])),
        (40.0, 90.0, 1.05, Some(["\"spot\"", "outer_angle 1.05", "60.2"])),
        (3.0, 5.0, 4.0, None),
    ] {
        let told = scene(fov, turn, cone);
        let holds = |words: [&str; 3]| told.len() == 1 && words.iter().all(|word| told[0].contains(word));
        assert!(asked.map_or(told.is_empty(), holds), "{fov} {turn} {cone}: {told:?}");
    }
}

#[test]
fn a_shape_smaller_than_a_pixel_is_named() {
    let scene = |distance: f64| {
        let mut world = World::new();
        let size = Resolution { width: 96, height: 64 };
        world.spawn((Name::new("camera"), PerspectiveCamera::default(), size, Placement::at(0.0, 1.0, 0.0)));
        world.spawn((Name::new("floor"), Plane::default(), Matte::default()));
        world.spawn((
            Name::new("moon"),
            Sphere::default(),
            Matte::default(),
            Placement::at(distance / 31.0, 1.0, -distance),
        ));
        world.spawn((Name::new("lamp"), bulb(60.0), Placement::at(1.0, 5.0, 0.0)));
        said(&world)
    };
    assert!(scene(10.0).is_empty(), "{:?}", scene(10.0));
    let told = scene(5e4);
    assert!(told.len() == 1 && told[0].contains("sphere \"moon\" is 0.00 pixels wide"), "{told:?}");
}

/// Light tracing is not recommended where it finds nothing, and what it leaves out is said.
#[test]
fn light_tracing_is_advised_where_it_helps() {
    let tank = |is_tank: bool, traced: bool, more: &dyn Fn(&mut World)| {
        let mut world = World::new();
        let look = LookAt { eye: DVec3::new(0.0, 3.0, 9.0), target: DVec3::new(0.0, 1.0, 0.0), ..LookAt::default() };
        let size = Resolution { width: 48, height: 32 };
        let camera = (Name::new("camera"), PerspectiveCamera { fov: Degrees(25.0), ..Default::default() }, look, size);
        let camera = world.spawn((camera, Integrator::PATH)).id();
        if traced {
            world.entity_mut(camera).insert(LightTracing::default());
        }
        world.spawn((Name::new("table"), Rectangle { width: 12.0, depth: 12.0 }, Matte::default()));
        let side = if is_tank { 4.0 } else { 0.5 };
        let water = Cuboid { size: DVec3::new(side, 2.0, side) };
        world.spawn((Name::new("water"), water, Placement::at(0.0, 1.1, 0.0), Glass::default()));
        let from = LookAt { eye: DVec3::new(1.0, 4.0, 2.0), ..LookAt::default() };
        world.spawn((Name::new("sun"), DirectionalLight::default(), from));
        more(&mut world);
        said(&world).into_iter().filter(|line| line.contains("from a light without an area")).collect::<Vec<_>>()
    };
    for (is_tank, traced, words) in [
        (true, false, Some("first hit a mirror or glass; PhotonMapping")),
        (true, true, Some("is still missing on what the camera sees through glass")),
        (false, false, Some("with LightTracing on the camera it is found from the light")),
        (false, true, None),
    ] {
        let told = tank(is_tank, traced, &|_| ());
        let holds = |words: &str| told.len() == 1 && told[0].contains(words);
        assert!(words.map_or(told.is_empty(), holds), "tank {is_tank}, traced {traced}: {told:?}");
    }
    // What a scene would be refused with is not advised.
    let haze = |world: &mut World| _ = world.spawn((Name::new("haze"), Medium::default()));
    let falling = |world: &mut World| {
        world.spawn((Sphere { radius: 0.1 }, Matte::default(), Motion { velocity: DVec3::NEG_Y }));
        let camera = named(world, "camera");
        world.entity_mut(camera).insert(Shutter::default());
    };
    let parted = |world: &mut World| {
        let water = named(world, "water");
        world.entity_mut(water).insert(Dispersion::Water);
    };
    for (more, refused) in [(&haze as &dyn Fn(&mut World), "Photon"), (&falling, "Tracing"), (&parted, "Photon")] {
        let told = tank(true, false, more);
        assert!(
            told.len() == 1 && told[0].contains("a small sphere or disk") && !told[0].contains(refused),
            "{told:?}"
        );
    }
}

/// The pixel that is worth a trace shows a lit surface in every chapter that has one.
#[test]
fn the_pixel_to_trace_is_lit() {
    let (mut tried, mut none) = (0, Vec::new());
    for chapter in chapters::all() {
        let asked = Overrides { resolution: Some(Resolution { width: 96, height: 54 }), ..Overrides::default() };
        let scene = chapter.world(&asked);
        let census = &Census::of(&scene);
        let (plan, tables) = prepare(census, &chapter.stages()).expect("prepared");
        let foretold = foretell(census, (&plan, &tables), unhurried()).expect("said");
        let Some([x, y]) = foretold.lit_pixel else {
            none.push(chapter.name);
            continue;
        };
        let pixel = pinhole::render::inspect_pixel(census, &chapter.stages(), [x, y], 0, &[]).expect("traced");
        let radiance = pixel.world.get::<pinhole::shade::Radiance>(pixel.tiles[0]).expect("light");
        let [r, g, b] = radiance.rgb(0);
        assert!(r.max(g).max(b) > 1e-3, "{}: pixel {x},{y} is dark", chapter.name);
        tried += 1;
    }
    eprintln!("pixels to trace: {tried} chapters; none in {none:?}");
    assert!(tried >= 20, "{none:?}");
}
