//! Caustics that are traced from the lights, held against closed forms, and against the camera's paths alone.

use super::*;
use glam::DVec3;
use pinhole::film::{read_checkpoint, write_checkpoint};
use pinhole::look::{Preflight, preflight};
use pinhole::material::fresnel;
use pinhole::plan::Census;
use pinhole::render::{RenderInProgress, Worlds, prepare, steps_of};
use pinhole::scene::*;
use pinhole_lab::naive::caustics::{join_without_area, join_without_cosine, refract_as_radiance};
use scenes::FilmBits;
use scenes::caustics::{caustics, traced};
use std::f64::consts::PI;
use std::ops::Range;

/// A mean over seeds, and its standard error.
#[derive(Debug)]
pub(super) struct Mean {
    pub mean: f64,
    pub error: f64,
}

/// The mean of green over the image, over renders with seeds of their own.
pub(super) fn mean_of(make: &dyn Fn() -> World, offer: &[Stage], samples: u32, seeds: Range<u64>) -> Mean {
    let means: Vec<f64> = seeds
        .map(|seed| {
            let mut world = make();
            let camera = named(&mut world, "camera");
            // A wider filter would take in what lies beyond the image.
            let filter = Filter::Box { radius: 0.5 };
            let sampling = Sampling { samples, seed, sampler: Sampler::Independent, filter };
            world.entity_mut(camera).insert(sampling);
            let film = render(&world, offer, &Execution::default(), &()).expect("renders").film;
            assert_eq!(film.rejected().0, 0);
            let pixels = (0..film.height).flat_map(|y| (0..film.width).map(move |x| (x, y)));
            pixels.map(|(x, y)| f64::from(film.mean(x, y)[1])).sum::<f64>() / f64::from(film.width * film.height)
        })
        .collect();
    let count = means.len() as f64;
    let mean = means.iter().sum::<f64>() / count;
    let variance = means.iter().map(|own| (own - mean) * (own - mean)).sum::<f64>() / (count - 1.0);
    Mean { mean, error: (variance / count).sqrt() }
}

/// A camera with paths and light tracing that looks from `eye` at a square of the ground or the ceiling this wide.
pub(super) fn camera(world: &mut World, eye: DVec3, target: DVec3, width: f64, perspective: bool, max_depth: u32) {
    let look = LookAt { eye, target, up: DVec3::Z };
    let integrator = Integrator::Path { max_depth, lights: LightStrategy::Mis, roulette: 0 };
    let size = Resolution { width: 16, height: 16 };
    let mut camera = world.spawn((Name::new("camera"), look, integrator, size, LightTracing::default()));
    if perspective {
        let fov = 2.0 * libm::atan(0.5 * width / eye.distance(target)) * 180.0 / PI;
        camera.insert(PerspectiveCamera { fov: Degrees(fov), ..Default::default() });
    } else {
        camera.insert(OrthographicCamera { view_height: width });
    }
}

/// The mean of a function of the distance from the middle over a square this wide.
pub(super) fn over_square(width: f64, function: impl Fn(f64) -> f64) -> f64 {
    const STEPS: u32 = 120;
    let place = |step: u32| width * ((f64::from(step) + 0.5) / f64::from(STEPS) - 0.5);
    let places = (0..STEPS).flat_map(|y| (0..STEPS).map(move |x| (place(x), place(y))));
    places.map(|(x, y)| function(libm::sqrt(x * x + y * y))).sum::<f64>() / f64::from(STEPS * STEPS)
}

/// What a point of the ground receives of a point light of intensity 1 straight above through flat layers: for each its
/// height and index of refraction, and the transmittance of all faces between together.
///
/// A ring of directions, sin θ dθ, falls on the ring x dx of the ground, where x is the sum of all h tan θᵢ.
pub(super) fn through_layers(x: f64, layers: &[(f64, f64)]) -> f64 {
    let place = |sine: f64| -> f64 {
        let tangent = |(height, ior): &(f64, f64)| {
            let inside = sine / ior;
            height * inside / libm::sqrt(1.0 - inside * inside)
        };
        layers.iter().map(tangent).sum()
    };
    let (mut low, mut high) = (0.0, 1.0 - 1e-9);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if place(middle) < x { low = middle } else { high = middle }
    }
    let sine = low.max(1e-6);
    let step = 1e-5 * sine;
    let slope = (place(sine + step) - place(sine - step)) / (2.0 * step);
    let mut passed = 1.0;
    for pair in layers.windows(2) {
        let inside = sine / pair[0].1;
        passed *= 1.0 - fresnel(libm::sqrt(1.0 - inside * inside), pair[1].1 / pair[0].1);
    }
    // dθ = d sin θ / cos θ.
    passed * sine / libm::sqrt(1.0 - sine * sine) / (place(sine) * slope)
}

/// A scene, its name, and the irradiance over π that a ground of albedo 1 shows.
pub(super) struct Form {
    pub name: &'static str,
    pub truth: f64,
    pub make: Box<dyn Fn() -> World>,
    pub samples: u32,
}

pub(super) const WIDTH: f64 = 1.0;

pub(super) fn white() -> Matte {
    Matte { colour: Rgb::grey(1.0) }
}

pub(super) fn point(y: f64) -> (PointLight, Placement) {
    (PointLight { intensity: Rgb::grey(PI), casts_shadows: true }, Placement::at(0.0, y, 0.0))
}

fn ball(y: f64) -> (Sphere, Emissive, Placement) {
    const RADIUS: f64 = 0.05;
    let radiance = Rgb::grey(1.0 / (RADIUS * RADIUS));
    (Sphere { radius: RADIUS }, Emissive { radiance, ..Emissive::default() }, Placement::at(0.0, y, 0.0))
}

/// A lamp between a mirror and a ceiling: the ceiling gets the lamp's light, and that of its image in the mirror.
fn over_a_mirror(perspective: bool) -> Form {
    let make = move || {
        let mut world = World::new();
        camera(&mut world, DVec3::new(0.0, 1.5, 0.0), DVec3::new(0.0, 2.0, 0.0), WIDTH, perspective, 3);
        world.spawn((Plane { normal: DVec3::NEG_Y }, Placement::at(0.0, 2.0, 0.0), white()));
        let mirror = Mirror { colour: Rgb::grey(0.8) };
        world.spawn((Rectangle { width: 0.8, depth: 0.8 }, Placement::at(0.0, 0.0, 0.0), mirror));
        world.spawn(point(1.0));
        world
    };
    let from = |height: f64, x: f64| height / libm::pow(height * height + x * x, 1.5);
    let truth = over_square(WIDTH, |x| from(1.0, x) + 0.8 * from(3.0, x));
    let name = if perspective { "point over a mirror" } else { "point over a mirror, orthographic" };
    Form { name, truth, make: Box::new(make), samples: 16 }
}

/// A pane between a lamp and the ground, each of its faces crossed once.
fn through_a_pane(name: &'static str, lamp: fn(&mut World)) -> Form {
    let make = move || {
        let mut world = World::new();
        camera(&mut world, DVec3::new(0.0, 0.9, 0.0), DVec3::ZERO, WIDTH, true, 4);
        world.spawn((Plane::default(), white()));
        let size = DVec3::new(1.2, 0.5, 1.2);
        world.spawn((Cuboid { size }, Placement::at(0.0, 1.25, 0.0), Glass { ior: 1.5, ..Glass::default() }));
        lamp(&mut world);
        world
    };
    let truth = over_square(WIDTH, |x| through_layers(x, &[(0.7, 1.0), (0.5, 1.5), (1.0, 1.0)]));
    Form { name, truth, make: Box::new(make), samples: 120 }
}

/// A lamp over water, seen on its ground by a camera in the water.
fn into_water(name: &'static str, lamp: fn(&mut World)) -> Form {
    let make = move || {
        let mut world = World::new();
        camera(&mut world, DVec3::new(0.0, 0.9, 0.0), DVec3::ZERO, WIDTH, true, 3);
        world.spawn((Plane::default(), white()));
        let water = Glass { ior: 1.33, ..Glass::default() };
        world.spawn((Cuboid { size: DVec3::new(1.6, 1.6, 1.6) }, Placement::at(0.0, 0.7, 0.0), water));
        lamp(&mut world);
        world
    };
    let truth = over_square(WIDTH, |x| through_layers(x, &[(0.7, 1.0), (1.5, 1.33)]));
    Form { name, truth, make: Box::new(make), samples: 120 }
}

pub(super) fn forms() -> Vec<Form> {
    let mut forms = super::distant::forms();
    forms.extend([
        over_a_mirror(true),
        over_a_mirror(false),
        through_a_pane("point through a pane", |world| _ = world.spawn(point(2.2))),
        through_a_pane("small ball through a pane", |world| _ = world.spawn(ball(2.2))),
        into_water("point over water", |world| _ = world.spawn(point(2.2))),
        into_water("small ball over water", |world| _ = world.spawn(ball(2.2))),
    ]);
    forms
}

/// Renders of each form.
///
/// Every form has seeds of its own: with the same ones, the same random numbers choose where light paths start, and all
/// forms deviate alike.
const SEEDS: u64 = 40;

#[test]
fn caustics_from_lights_are_those_of_closed_forms() {
    for (number, form) in (0..).zip(forms()) {
        let found = mean_of(&form.make, &offer(), form.samples, number * SEEDS..(number + 1) * SEEDS);
        let off = (found.mean - form.truth) / found.error;
        eprintln!("{:<34} {:.5} ± {:.5} for {:.5}: {off:+.1} SE", form.name, found.mean, found.error, form.truth);
        assert!(off.abs() <= 4.0, "{}", form.name);
        assert!(found.error <= 0.01 * form.truth, "{}: a standard error above 1 %", form.name);
    }
}

/// A mistake, and how far from the truth it must be found.
#[test]
fn a_factor_that_is_forgotten_is_found() {
    let mistakes = [("the cosine", join_without_cosine()), ("the area", join_without_area())];
    let mistakes = mistakes.into_iter().map(|(name, stage)| (name, stage, over_a_mirror(true)));
    let water = into_water("point over water", |world| _ = world.spawn(point(2.2)));
    for (name, stage, form) in mistakes.chain([("no 1/η²", refract_as_radiance(), water)]) {
        let offer: Vec<Stage> =
            offer().into_iter().map(|own| if own.name == stage.name { stage.clone() } else { own }).collect();
        let found = mean_of(&form.make, &offer, form.samples, 0..SEEDS / 4);
        let off = (found.mean - form.truth) / found.error;
        eprintln!("{name} forgotten: {:.5} ± {:.5} for {:.5}: {off:+.1} SE", found.mean, found.error, form.truth);
        assert!(off.abs() > 4.0, "{name}");
    }
}

/// Whether light from the lamps brings what the camera's paths alone bring, to every block of pixels.
pub fn agrees(name: &str, make: &dyn Fn() -> World, samples: u32) {
    const SETS: u64 = 12;
    let alone = renders(make, LightStrategy::Mis, 6 * samples, 0..SETS);
    for (number, lights) in [LightStrategy::Bsdf, LightStrategy::Light, LightStrategy::Mis].into_iter().enumerate() {
        let first = SETS * (number as u64 + 1);
        let traced = renders(&traced(make), lights, samples, first..first + SETS);
        assert_agree(&format!("{name}, {lights:?}"), &alone, &traced, 8);
    }
}

#[test]
fn light_from_area_lights_brings_what_the_camera_s_paths_bring() {
    agrees("caustics", &|| caustics(true), 8);
    let through_a_lens = || {
        let mut world = caustics(true);
        let camera = named(&mut world, "camera");
        let aperture = Aperture::Radius { radius: 0.2 };
        let look = LookAt { eye: DVec3::new(0.2, 2.3, 1.9), target: DVec3::new(0.0, 0.0, 0.3), up: DVec3::Y };
        world.entity_mut(camera).insert((look, Lens { aperture, focus_distance: 1.8, blades: 5, ..Lens::default() }));
        world
    };
    agrees("caustics through a lens", &through_a_lens, 8);
    let make = || {
        let mut world = public("cornell-glass", LightStrategy::Mis);
        let camera = named(&mut world, "camera");
        world.entity_mut(camera).insert(Resolution { width: 32, height: 32 });
        world
    };
    agrees("cornell-glass", &make, 8);
}

/// Asserts that a scene is refused in one sentence that holds these words, and gives the sentence.
pub(super) fn assert_refused(world: &World, words: &str) -> String {
    let said = render(world, &offer(), &Execution::default(), &()).err().expect("refused").to_string();
    eprintln!("{said}");
    assert!(said.contains(words) && !said.ends_with('.') && said.lines().count() == 1, "{said}");
    said
}

/// Asserts that a scene of so many samples gives the bits of one whole render however its steps are divided, stopped and
/// continued from a checkpoint, by how many threads, in tiles of what size; returns the number of ways.
pub(super) fn assert_same_bits_however_divided(scene: &World, samples: u32, folder: &std::path::Path) -> u32 {
    let whole = FilmBits::of(&render(scene, &offer(), &Execution::default(), &()).expect("renders").film);
    let (mut tried, end) = (0, steps_of(samples));
    let cuts: [&[u32]; 3] = [&[], &[1, 2, 5], &[4]];
    for (number, cut) in cuts.into_iter().enumerate() {
        for (threads, tile_side, worlds) in
            [(1, 32, Worlds::PerWorker), (3, 8, Worlds::PerWorker), (2, 31, Worlds::One)]
        {
            let execution = Execution { threads: Some(threads), tile_side, worlds, part: None };
            let census = &Census::of(scene);
            let mut in_progress = RenderInProgress::begin(census, &offer(), &execution).expect("begins");
            for &step in cut.iter().chain([&end]) {
                in_progress.advance(step, &()).expect("goes on");
                if number > 0 && step < end {
                    let path = folder.join("checkpoint");
                    write_checkpoint(&in_progress.film, 27, &path).expect("written");
                    let kept = read_checkpoint(27, &in_progress.film, false, &path).expect("read");
                    assert!(kept == in_progress.film, "a checkpoint holds all of a film");
                    in_progress = RenderInProgress::begin(census, &offer(), &execution).expect("begins");
                    in_progress.take(kept);
                }
            }
            FilmBits::of(&in_progress.film).assert_is(&whole, &format!("{threads} threads, {worlds:?}, cut {cut:?}"));
            tried += 1;
        }
    }
    tried
}

#[test]
fn light_from_area_lights_has_the_same_bits_however_it_is_traced() {
    let filters = [Filter::Box { radius: 0.5 }, Filter::Mitchell { radius: 2.0, b: 1.0 / 3.0, c: 1.0 / 3.0 }];
    let (mut tried, folder) = (0, tempfile::tempdir().expect("a folder"));
    for (lamps, filter, sampler) in [
        (true, filters[0], Sampler::Sobol),
        (false, filters[1], Sampler::Independent),
        (true, filters[1], Sampler::Stratified),
    ] {
        let mut scene = traced(|| caustics(lamps))();
        let camera = named(&mut scene, "camera");
        scene.entity_mut(camera).insert(Sampling { samples: 5, seed: 27, sampler, filter });
        let whole = render(&scene, &offer(), &Execution::default(), &()).expect("renders").film;
        let splats = whole.splats.as_ref().expect("light from lamps");
        assert_eq!(splats.paths, (48_u64 * 32 * 5).div_ceil(1024) * 1024);
        let lit = splats.sums[0].iter().filter(|sum| **sum > 0.0).count();
        eprintln!("light from lamps: {lit} of {} pixels got some", 48 * 32);
        assert!(lit > 60, "{lit}");
        tried += assert_same_bits_however_divided(&scene, 5, folder.path());
    }
    eprintln!("light from lamps: {tried} ways to trace 3 films, every bit the same");
}

#[test]
fn a_scene_that_does_not_ask_for_it_has_nothing_of_it() {
    let stages = [
        "Sample emitted rays",
        "Keep specular bounces first",
        "Connect to the camera",
        "Splat to the film",
        "Sample BSDFs: glass, from lights",
        "Mark caustic paths",
        "Correct for shading normals",
    ];
    let columns = ["light power", "splats", "caustic path"];
    let tables = ["light paths", "join to the camera"];
    let plan_of = |scene: &World| pinhole::plan::plan(&Census::of(scene), &offer()).expect("a plan");
    let kept = |plan: &pinhole::plan::Plan| {
        let stage = |name: &&&str| plan.rows.iter().any(|row| row.stage == **name && row.kept);
        let [c, t] =
            [plan.columns.iter().map(|c| c.name).collect::<Vec<_>>(), plan.tables.iter().map(|t| t.name).collect()];
        [
            stages.iter().filter(stage).count(),
            columns.iter().filter(|name| c.contains(name)).count(),
            tables.iter().filter(|name| t.contains(name)).count(),
            plan.passes.len(),
        ]
    };
    let (plain, asking) = (caustics(true), traced(|| caustics(true))());
    assert_eq!(kept(&plan_of(&plain)), [0, 0, 0, 1]);
    assert_eq!(kept(&plan_of(&asking)), [stages.len(), columns.len(), tables.len(), 2]);
    assert!(
        plan_of(&asking)
            .to_string()
            .contains("pass \"light\": a row is a path from a light, it produces the splats on the film")
    );
    // Without mirrors and glass, without a lamp, or with a view, there is nothing to trace.
    let without = |names: &[&str]| {
        let mut world = traced(|| caustics(true))();
        for name in names {
            let entity = named(&mut world, name);
            world.despawn(entity);
        }
        kept(&plan_of(&world))
    };
    assert_eq!(without(&["ball", "jar", "silver"]), [0, 0, 0, 1]);
    assert_eq!(without(&["lamp", "panel", "bulb"]), [0, 0, 0, 1]);
    assert_eq!(without(&["ball", "jar"]), [stages.len() - 1, columns.len(), tables.len(), 2]);
    let mut viewed = traced(|| caustics(true))();
    let camera = named(&mut viewed, "camera");
    viewed.entity_mut(camera).insert(View { column: "hit".into() });
    assert_eq!(kept(&plan_of(&viewed)), [0, 0, 0, 1]);
    // No lamp with an area: nothing that the camera's paths could find twice.
    assert_eq!(kept(&plan_of(&traced(|| caustics(false))())), [stages.len() - 1, columns.len() - 1, tables.len(), 2]);
}

#[test]
fn what_light_tracing_cannot_do_is_said_in_a_sentence() {
    type Change = fn(&mut World, Entity);
    let cases: [(&str, Change); 10] = [
        ("light_tracing paths", |world, camera| _ = world.entity_mut(camera).insert(LightTracing { paths: 0.0 })),
        ("without paths", |world, camera| _ = world.entity_mut(camera).insert(Integrator::WHITTED)),
        ("light_tracing paths is NaN", |world, camera| {
            world.entity_mut(camera).insert(LightTracing { paths: f64::NAN });
        }),
        ("light_tracing paths is 1025", |world, camera| {
            world.entity_mut(camera).insert(LightTracing { paths: 1025.0 });
        }),
        ("while something moves", |world, _| {
            let ball = named(world, "ball");
            let camera = named(world, "camera");
            world.entity_mut(camera).insert(Shutter::default());
            world.entity_mut(ball).insert(Motion { velocity: DVec3::X });
        }),
        ("on an equirectangular camera", |world, camera| {
            world.entity_mut(camera).remove::<PerspectiveCamera>().insert(EquirectangularCamera);
        }),
        ("light_tracing", |world, _| _ = world.spawn((Name::new("another"), LightTracing::default()))),
        ("on a fisheye camera", |world, camera| {
            world.entity_mut(camera).remove::<PerspectiveCamera>().insert(FisheyeCamera::default());
        }),
        ("with adaptive sampling", |world, camera| {
            world.entity_mut(camera).insert((Sampling::default(), Adaptive::default()));
        }),
        ("on no camera", |world, camera| {
            world.entity_mut(camera).remove::<LightTracing>();
            world.spawn(LightTracing::default());
        }),
    ];
    for (word, change) in cases {
        let mut world = traced(|| caustics(true))();
        let camera = named(&mut world, "camera");
        change(&mut world, camera);
        assert_refused(&world, word);
    }
}

#[test]
fn what_only_light_tracing_finds_is_said_before() {
    let told = |scene: &World| {
        let census = &Census::of(scene);
        let (plan, tables) = prepare(census, &offer()).expect("prepared");
        let asked = Preflight { threads: Some(1), ends_in_time: true, ..Preflight::default() };
        preflight(census, (&plan, &tables), asked).expect("looks").join("\n")
    };
    let (mut plain, mut asking) = (caustics(false), traced(|| caustics(false))());
    assert!(told(&plain).contains("with LightTracing on the camera it is found"), "{}", told(&plain));
    assert!(!told(&asking).contains("missing"), "{}", told(&asking));
    for world in [&mut plain, &mut asking] {
        world.spawn((Name::new("sun"), DirectionalLight::default()));
    }
    assert!(told(&plain).contains("directional light: \"sun\") is missing"), "{}", told(&plain));
    assert!(!told(&asking).contains("missing"), "{}", told(&asking));
    // Water without an end: no area across the sun holds all that it sends there.
    asking.spawn((Name::new("sea"), Plane::default(), Placement::at(0.0, -1.0, 0.0), Glass::default()));
    assert!(told(&asking).contains("no paths start on lights without a position (1 directional light: \"sun\")"));
}
