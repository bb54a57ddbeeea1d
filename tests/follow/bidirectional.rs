//! Bidirectional path tracing, held against closed forms and against paths from the camera alone.

use super::caustics::{assert_refused, assert_same_bits_however_divided, camera, forms, mean_of};
use super::many_lights::under_a_knot;
use super::*;
use glam::{DQuat, DVec3};
use pinhole::scene::*;
use scenes::caustics::{caustics, traced};

/// The same scene, where paths from the lights are joined to those of the camera.
pub(super) fn joined(make: &dyn Fn() -> World) -> impl Fn() -> World + '_ {
    move || {
        let mut world = make();
        let camera = named(&mut world, "camera");
        world.entity_mut(camera).remove::<LightTracing>().insert(BidirectionalPathTracing::default());
        world
    }
}

/// Whether every block of pixels is as bright as by paths from the camera alone.
pub(super) fn agrees(name: &str, make: &dyn Fn() -> World, [alone, both]: [u32; 2]) {
    const SETS: u64 = 12;
    let alone = renders(make, LightStrategy::Mis, alone, 0..SETS);
    let both = renders(&joined(make), LightStrategy::Mis, both, SETS..2 * SETS);
    assert_agree(name, &alone, &both, 8);
}

pub(super) fn glow(radiance: f64) -> Emissive {
    Emissive { radiance: Rgb::grey(radiance), ..Emissive::default() }
}

/// A room 2 wide, open to the camera, with two balls.
pub(super) fn room(lamps: &dyn Fn(&mut World)) -> World {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.0, 1.0, 3.8), target: DVec3::new(0.0, 1.0, 0.0), up: DVec3::Y };
    let integrator = Integrator::Path { max_depth: 6, lights: LightStrategy::Mis, roulette: 3 };
    let fov = PerspectiveCamera { fov: Degrees(39.0), ..Default::default() };
    world.spawn((Name::new("camera"), look, fov, integrator, Resolution { width: 24, height: 24 }));
    for (size, at, colour) in [
        ([2.0, 0.02, 2.0], [0.0, -0.01, 0.0], [0.7, 0.7, 0.7]),
        ([2.0, 0.02, 2.0], [0.0, 2.01, 0.0], [0.7, 0.7, 0.7]),
        ([2.0, 2.0, 0.02], [0.0, 1.0, -1.01], [0.7, 0.7, 0.7]),
        ([0.02, 2.0, 2.0], [-1.01, 1.0, 0.0], [0.6, 0.1, 0.1]),
        ([0.02, 2.0, 2.0], [1.01, 1.0, 0.0], [0.1, 0.6, 0.1]),
    ] {
        let [r, g, b] = colour;
        let wall = (Cuboid { size: size.into() }, Matte { colour: Rgb::new(r, g, b) });
        world.spawn((wall, Placement::at(at[0], at[1], at[2])));
    }
    world.spawn((Sphere { radius: 0.35 }, Placement::at(-0.45, 0.36, 0.2), Matte::default()));
    let metal = Metal { roughness: 0.4, ..Metal::default() };
    world.spawn((Sphere { radius: 0.35 }, Placement::at(0.45, 0.36, 0.2), metal));
    lamps(&mut world);
    world
}

/// What holds of light tracing's closed forms holds of this as well: the same caustics are found.
#[test]
fn closed_forms_of_caustics_hold() {
    const SEEDS: u64 = 12;
    let mut tried = 0;
    for (number, form) in (300..).zip(forms()) {
        let make = joined(&*form.make);
        let found = mean_of(&make, &offer(), form.samples, number * SEEDS..(number + 1) * SEEDS);
        let off = (found.mean - form.truth) / found.error;
        eprintln!("{:<36} {:.5} ± {:.5} for {:.5}: {off:+.1} SE", form.name, found.mean, found.error, form.truth);
        assert!(off.abs() <= 4.0, "{}", form.name);
        assert!(found.error <= 0.01 * form.truth, "{}: a standard error above 1 %", form.name);
        tried += 1;
    }
    assert!(tried >= 9, "{tried}");
    eprintln!("bidirectional: {tried} closed forms of caustics, 0 apart");
}

/// Inside a ball whose wall emits E and reflects ρ of what arrives, the wall is E / (1 − ρ) bright, however its light is
/// found; of paths of so many segments the sum ends with ρ to that power.
#[test]
fn a_glowing_ball_is_as_bright_as_its_series() {
    const SEGMENTS: u32 = 5;
    let make = |albedo: f64| {
        move || {
            let mut world = World::new();
            camera(&mut world, DVec3::new(0.2, 0.1, 0.0), DVec3::new(0.0, -1.0, 0.1), 1.0, true, SEGMENTS);
            world.spawn((Sphere { radius: 1.0 }, glow(1.0), Matte { colour: Rgb::grey(albedo) }));
            world
        }
    };
    for (number, albedo) in (0..).zip([0.0, 0.5, 0.9, 1.0]) {
        let scene = make(albedo);
        let truth: f64 = (0..SEGMENTS).map(|bounces| libm::pow(albedo, f64::from(bounces))).sum();
        let found = mean_of(&joined(&scene), &offer(), 16, 20 * number..20 * number + 12);
        let off = (found.mean - truth) / found.error.max(1e-6);
        eprintln!("albedo {albedo}: {:.5} ± {:.5} for {truth:.5}: {off:+.1} SE", found.mean, found.error);
        assert!(off.abs() <= 4.0, "albedo {albedo}");
        assert!(found.error <= 0.01 * truth, "albedo {albedo}: a standard error above 1 %");
    }
}

/// Points of a sequence leave less error than independent ones where two paths are joined at a pixel, too, and the same
/// mean: a pixel's light paths are points of one sequence, in another order than its paths from the camera.
///
/// The picture has 16 batches of light paths: where those are numbered one after another, each pixel has every 16th point.
#[test]
fn stratified_samples_leave_less_error_than_independent_ones() {
    const SEEDS: u64 = 3;
    let offer = offer();
    let render_by = |sampler: Sampler, seed: u64| {
        let mut world = room(&|world| {
            world.spawn((PointLight { intensity: Rgb::grey(1.0), casts_shadows: true }, Placement::at(0.0, 1.5, 0.2)));
        });
        let camera = named(&mut world, "camera");
        let sampling = Sampling { samples: 16, seed, sampler, ..Sampling::default() };
        let of_method = (BidirectionalPathTracing::default(), Resolution { width: 128, height: 128 });
        world.entity_mut(camera).insert((sampling, of_method));
        numbers(&render(&world, &offer, &Execution::default(), &()).expect("renders").film)
    };
    let of = |sampler: Sampler, first: u64| -> Vec<_> {
        (first..first + SEEDS).map(|seed| render_by(sampler, seed)).collect()
    };
    let independent = of(Sampler::Independent, 0);
    let variance = |renders: &[Numbers]| {
        let of_pixel = |pixel: usize| {
            let values = || renders.iter().map(|image| image.pixels[pixel][1]);
            let mean = values().sum::<f64>() / SEEDS as f64;
            values().map(|value| (value - mean) * (value - mean)).sum::<f64>() / (mean * mean + 0.01)
        };
        (0..renders[0].pixels.len()).map(of_pixel).sum::<f64>()
    };
    for (number, sampler) in (1..).zip([Sampler::Sobol, Sampler::Stratified]) {
        let renders = of(sampler, number * SEEDS);
        assert_agree(&format!("{sampler:?} and independent"), &independent, &renders, 16);
        let ratio = variance(&renders) / variance(&independent);
        eprintln!("joined paths: {sampler:?} leaves {ratio:.2} of the squared error of independent numbers");
        assert!(ratio < 0.68, "{sampler:?}: {ratio}");
    }
}

/// Every kind of light, and lights that light paths do not start on beside one that they do.
#[test]
fn every_light_brings_what_paths_from_the_camera_bring() {
    let front = || Emissive { sides: Sides::Front, ..glow(12.0) };
    let down = Placement { orientation: DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0), ..Placement::at(0.0, 1.9, 0.0) };
    let point = |y: f64| (PointLight { intensity: Rgb::grey(1.0), casts_shadows: true }, Placement::at(0.3, y, 0.2));
    let ahead = |y: f64| LookAt { eye: DVec3::new(0.2, y, 0.1), target: DVec3::new(-0.4, 0.3, 0.2), up: DVec3::Z };
    let spot = SpotLight { intensity: Rgb::grey(3.0), ..SpotLight::default() };
    let sun = DirectionalLight { irradiance: Rgb::grey(1.0), ..DirectionalLight::default() };
    let front = &front;
    let from_front = LookAt { eye: DVec3::new(0.2, 0.4, 2.0), target: DVec3::ZERO, up: DVec3::Y };
    let cases: [(&str, Box<dyn Fn(&mut World)>); 14] = [
        (
            "a one-sided rectangle",
            Box::new(move |world| _ = world.spawn((Rectangle { width: 0.5, depth: 0.5 }, front(), down))),
        ),
        (
            "a two-sided rectangle",
            Box::new(|world| {
                world.spawn((Rectangle { width: 0.4, depth: 0.6 }, glow(8.0), Placement::at(0.1, 1.3, 0.0)));
            }),
        ),
        (
            "a ball",
            Box::new(|world| _ = world.spawn((Sphere { radius: 0.2 }, glow(8.0), Placement::at(0.2, 1.4, 0.0)))),
        ),
        (
            "a disk and a ball",
            Box::new(move |world| {
                world.spawn((Disk { radius: 0.2 }, front(), down));
                world.spawn((Sphere { radius: 0.1 }, glow(30.0), Placement::at(-0.5, 1.2, 0.5)));
            }),
        ),
        (
            "a glowing cuboid",
            Box::new(|world| {
                world.spawn((
                    Cuboid { size: DVec3::splat(0.3) },
                    glow(6.0),
                    Placement::at(-0.2, 1.4, 0.2),
                    Matte::default(),
                ));
            }),
        ),
        ("a point", Box::new(move |world| _ = world.spawn(point(1.5)))),
        ("a point near a wall", Box::new(move |world| _ = world.spawn(point(1.85)))),
        (
            "a point without shadows beside a lamp",
            Box::new(move |world| {
                world.spawn((
                    PointLight { intensity: Rgb::grey(0.5), casts_shadows: false },
                    Placement::at(0.3, 1.5, 0.2),
                ));
                world.spawn((Rectangle { width: 0.5, depth: 0.5 }, front(), down));
            }),
        ),
        ("a spot", Box::new(move |world| _ = world.spawn((spot, ahead(1.7))))),
        (
            "a sun and a spot",
            Box::new(move |world| {
                world.spawn((sun, from_front));
                world.spawn((spot, ahead(1.7)));
            }),
        ),
        ("a sun", Box::new(move |world| _ = world.spawn((sun, from_front)))),
        (
            "two suns, one without shadows, over an endless ground",
            Box::new(move |world| {
                world.spawn((sun, from_front));
                let fill = DirectionalLight { irradiance: Rgb::grey(0.2), casts_shadows: false };
                world.spawn((fill, LookAt { eye: DVec3::new(-1.0, 1.0, 2.0), ..from_front }));
                world.spawn((Plane::default(), Placement::at(0.0, -0.1, 0.0), Matte::default()));
            }),
        ),
        (
            "two suns, a sky and a lamp over a large ground",
            Box::new(move |world| {
                world.spawn((sun, from_front));
                world.spawn((sun, LookAt { eye: DVec3::new(-1.0, 1.0, 2.0), ..from_front }));
                world.spawn(Gradient::default());
                world.spawn((Rectangle { width: 0.5, depth: 0.5 }, front(), down));
                world.spawn((Sphere { radius: 100.0 }, Placement::at(0.0, -100.1, 0.0), Matte::default()));
            }),
        ),
        (
            "a sky and a lamp",
            Box::new(move |world| {
                world.spawn(Gradient::default());
                world.spawn((Rectangle { width: 0.5, depth: 0.5 }, front(), down));
            }),
        ),
    ];
    let tried = cases.len();
    for (name, lamps) in cases {
        agrees(name, &|| room(&*lamps), [8, 2]);
    }
    let many = |world: &mut World| {
        for number in 0..100 {
            let at = Placement::at(0.18 * f64::from(number % 10) - 0.8, 1.9, 0.18 * f64::from(number / 10) - 0.8);
            world.spawn((Sphere { radius: 0.03 }, glow(1.0 + f64::from(number)), at));
        }
    };
    agrees("many lamps of a hierarchy", &|| room(&many), [12, 3]);
    let metal = || under_a_knot(Metal { roughness: 0.4, ..Metal::default() });
    agrees("metal under an emitting mesh", &metal, [12, 4]);
    agrees(
        "frosted glass under an emitting mesh",
        &|| under_a_knot(RoughGlass { roughness: 0.5, ..Default::default() }),
        [12, 4],
    );
    eprintln!("bidirectional: {} kinds of light, 0 blocks apart", tried + 3);
}

/// Through a lens, by parallel rays, from inside glass, where glass focuses light, where shading normals lean, and on the
/// scenes that are compared in public.
#[test]
fn every_camera_and_glass_bring_what_paths_from_the_camera_bring() {
    let lamp = |world: &mut World| {
        world.spawn((Sphere { radius: 0.25 }, glow(8.0), Placement::at(0.2, 1.5, 0.0)));
    };
    let by = |change: &dyn Fn(&mut World, Entity)| {
        let mut world = room(&lamp);
        let camera = named(&mut world, "camera");
        change(&mut world, camera);
        world
    };
    agrees(
        "a lens",
        &|| {
            by(&|world, camera| {
                let aperture = Aperture::Radius { radius: 0.2 };
                world.entity_mut(camera).insert(Lens { aperture, focus_distance: 3.0, blades: 5, ..Lens::default() });
            })
        },
        [8, 2],
    );
    agrees(
        "parallel rays",
        &|| {
            by(&|world, camera| {
                world.entity_mut(camera).remove::<PerspectiveCamera>().insert(OrthographicCamera { view_height: 2.2 });
            })
        },
        [8, 2],
    );
    agrees(
        "a ball of glass and a mirror",
        &|| {
            by(&|world, _| {
                world.spawn((Sphere { radius: 0.25 }, Glass::default(), Placement::at(0.0, 0.3, 0.6)));
                world.spawn((Rectangle { width: 0.6, depth: 0.6 }, Mirror::default(), Placement::at(0.5, 0.02, -0.4)));
            })
        },
        [32, 8],
    );
    agrees(
        "a lamp in frosted glass",
        &|| {
            by(&|world, _| {
                let rough = RoughGlass { roughness: 0.5, ..RoughGlass::default() };
                world.spawn((Sphere { radius: 0.4 }, rough, Placement::at(0.2, 1.5, 0.0)));
            })
        },
        [24, 8],
    );
    agrees(
        "a camera in glass",
        &|| {
            by(&|world, _| {
                let glass = Glass { absorption: Rgb::new(0.1, 0.05, 0.2), ..Glass::default() };
                world.spawn((Cuboid { size: DVec3::splat(2.0) }, glass, Placement::at(0.0, 1.0, 4.0)));
            })
        },
        [24, 8],
    );
    agrees("caustics", &|| caustics(true), [24, 8]);
    for name in ["cornell-glass", "veach-mis"] {
        let make = || {
            let mut world = public(name, LightStrategy::Mis);
            let camera = named(&mut world, "camera");
            world.entity_mut(camera).insert(Resolution { width: 32, height: 32 });
            world
        };
        agrees(name, &make, [24, 8]);
    }
}

#[test]
fn pictures_have_the_same_bits_however_they_are_traced() {
    let (mut tried, folder) = (0, tempfile::tempdir().expect("a folder"));
    for (lamps, is_sunny, sampler, paths) in [
        (true, false, Sampler::Sobol, 1.0),
        (false, false, Sampler::Independent, 0.3),
        (true, true, Sampler::Sobol, 0.7),
    ] {
        let mut scene = joined(&|| if is_sunny { in_the_sun(1.0) } else { caustics(lamps) })();
        let camera = named(&mut scene, "camera");
        let sampling = Sampling { samples: 4, seed: 39, sampler, ..Sampling::default() };
        scene.entity_mut(camera).insert((sampling, BidirectionalPathTracing { paths }));
        tried += assert_same_bits_however_divided(&scene, 4, folder.path());
    }
    eprintln!("bidirectional: {tried} ways to trace 3 films, every bit the same");
}

#[test]
fn what_cannot_be_joined_is_said_in_a_sentence() {
    type Change = fn(&mut World, Entity);
    let cases: [(&str, Change); 10] = [
        ("bidirectional_path_tracing paths is 0", |world, camera| {
            world.entity_mut(camera).insert(BidirectionalPathTracing { paths: 0.0 });
        }),
        ("bidirectional_path_tracing paths is NaN", |world, camera| {
            world.entity_mut(camera).insert(BidirectionalPathTracing { paths: f64::NAN });
        }),
        ("beside light_tracing", |world, camera| _ = world.entity_mut(camera).insert(LightTracing::default())),
        ("beside photon_mapping", |world, camera| _ = world.entity_mut(camera).insert(PhotonMapping::default())),
        ("beside dispersion", |world, _| {
            let ball = named(world, "ball");
            world.entity_mut(ball).insert(Dispersion::Bk7);
        }),
        ("without paths", |world, camera| _ = world.entity_mut(camera).insert(Integrator::WHITTED)),
        ("without MIS", |world, camera| {
            let lights = LightStrategy::Light;
            world.entity_mut(camera).insert(Integrator::Path { max_depth: 6, lights, roulette: 3 });
        }),
        ("with adaptive sampling", |world, camera| {
            world.entity_mut(camera).insert((Sampling::default(), Adaptive::default()));
        }),
        ("on a fisheye camera", |world, camera| {
            world.entity_mut(camera).remove::<PerspectiveCamera>().insert(FisheyeCamera::default());
        }),
        ("with so many lights", |world, _| {
            for number in 0..65 {
                world.spawn((PointLight::default(), Placement::at(0.01 * f64::from(number), 3.0, 0.0)));
            }
        }),
    ];
    for (word, change) in cases {
        let mut world = joined(&|| caustics(true))();
        let camera = named(&mut world, "camera");
        change(&mut world, camera);
        assert_refused(&world, word);
    }
}

/// What the vertices of a sample take is counted before anything is allocated.
#[test]
fn more_vertices_than_fit_are_refused() {
    let mut world = joined(&|| caustics(true))();
    let camera = named(&mut world, "camera");
    let size = Resolution { width: 8192, height: 8192 };
    world.entity_mut(camera).insert((BidirectionalPathTracing { paths: 1024.0 }, size));
    let said = assert_refused(&world, "such a film with its light vertices");
    assert!(said.ends_with(" fits"), "{said}");
}

/// One path for a thousand pixels or a thousand for one, lamps of one point and lamps as large as the scene, paths of
/// thousands of segments.
#[test]
fn extremes_leave_finite_pictures() {
    let mut tried = 0;
    let white = Matte { colour: Rgb::grey(1.0) };
    for (paths, radius, segments) in
        [(1.0 / 1024.0, 1e-6, 6), (64.0, 1e-3, 4), (1.0, 1e-12, 10_000), (0.5, 0.9, 10_000), (1.0, 1e-18, 2)]
    {
        let mut world = World::new();
        camera(&mut world, DVec3::new(0.0, 0.0, 0.95), DVec3::new(0.0, 0.3, 0.0), 1.0, true, segments);
        world.spawn((Sphere { radius: 1.0 }, white));
        world.spawn((Sphere { radius }, glow((1.0 / (radius * radius)).min(1e37)), Placement::at(0.01, 0.0, 0.0)));
        let camera = named(&mut world, "camera");
        let integrator = Integrator::Path { max_depth: segments, lights: LightStrategy::Mis, roulette: 5 };
        let sampling = Sampling { samples: 1, ..Sampling::default() };
        world.entity_mut(camera).remove::<LightTracing>();
        world.entity_mut(camera).insert((BidirectionalPathTracing { paths }, integrator, sampling));
        if segments > 1000 {
            // A wall that absorbs little, so that paths are long but end.
            world.entity_mut(camera).insert(Resolution { width: 4, height: 4 });
            let wall = world.query_filtered::<Entity, With<Matte>>().single(&world).expect("one");
            world.entity_mut(wall).insert(Matte { colour: Rgb::grey(0.999) });
        }
        let film = render(&world, &offer(), &Execution::default(), &()).expect("renders").film;
        assert_eq!(film.rejected().0, 0, "{paths} paths, radius {radius}");
        tried += 1;
    }
    for irradiance in [1e-38, 1e-6, 1e6, 1e30] {
        let film =
            render(&joined(&|| in_the_sun(irradiance))(), &offer(), &Execution::default(), &()).expect("renders");
        assert_eq!(film.film.rejected().0, 0, "a sun of {irradiance}");
        tried += 1;
    }
    eprintln!("bidirectional: {tried} extreme renders, 0 samples rejected");
}

/// Lamps and glass, and a sun that is as bright as they are, or far less or more.
fn in_the_sun(irradiance: f64) -> World {
    let mut world = caustics(true);
    let look = LookAt { eye: DVec3::new(-1.0, 2.0, 0.5), target: DVec3::ZERO, up: DVec3::Y };
    world.spawn((DirectionalLight { irradiance: Rgb::grey(irradiance), ..DirectionalLight::default() }, look));
    world
}

/// Light tracing finds the same caustics of a sun and of lamps, with other weights.
#[test]
fn a_sun_beside_lamps_brings_what_light_tracing_brings() {
    const SETS: u64 = 12;
    for (name, irradiance) in
        [("a sun like the lamps", 1.0), ("a faint sun", 0.02), ("a sun that outshines them", 50.0)]
    {
        let make = || in_the_sun(irradiance);
        let traced = renders(&traced(&make), LightStrategy::Mis, 12, 0..SETS);
        let both = renders(&joined(&make), LightStrategy::Mis, 6, SETS..2 * SETS);
        assert_agree(name, &traced, &both, 8);
    }
}

#[test]
fn a_scene_without_it_has_nothing_of_it() {
    let plan_of = |scene: &World| pinhole::plan::plan(&Census::of(scene), &offer()).expect("a plan");
    let kept = |scene: &World| {
        let plan = plan_of(scene);
        let stages = plan.rows.iter().filter(|row| row.kept && is_of_it(row.stage)).count();
        let columns = ["light vertices", "recursive MIS", "join ratios", "started on"];
        [stages, plan.columns.iter().filter(|column| columns.contains(&column.name)).count()]
    };
    assert_eq!(kept(&caustics(true)), [0; 2]);
    assert_eq!(kept(&traced(|| caustics(true))()), [0; 2]);
    let [stages, columns] = kept(&joined(&|| caustics(true))());
    assert!(stages >= 8, "{stages}");
    assert_eq!(columns, 4);
    let plan = plan_of(&joined(&|| caustics(true))());
    assert!(plan.to_string().contains("it produces the vertices for each sample, and splats on the film"));
}

fn is_of_it(stage: &str) -> bool {
    ["MIS ratios", "light vertices", "weights of joins", "weighted against light paths"]
        .iter()
        .any(|word| stage.contains(word))
}
