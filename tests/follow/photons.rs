//! Caustics that photons find, held against closed forms, and against other ways to find the same light.

use super::caustics::{
    Form, WIDTH, assert_refused, assert_same_bits_however_divided, camera, forms, mean_of, over_square, point,
    through_layers, white,
};
use super::*;
use glam::DVec3;
use pinhole::follow::photon_radius;
use pinhole::look::{Preflight, preflight};
use pinhole::material::fresnel;
use pinhole::plan::Census;
use pinhole::render::prepare;
use pinhole::scene::*;
use scenes::caustics::{caustics, traced};

/// The same with photons in place of light paths that are connected to the camera.
fn mapped(make: impl Fn() -> World, radius: f64) -> impl Fn() -> World {
    move || {
        let mut world = make();
        let camera = named(&mut world, "camera");
        world.entity_mut(camera).remove::<LightTracing>().insert(PhotonMapping { radius, ..PhotonMapping::default() });
        world
    }
}

const IOR: f64 = 1.33;

/// The ground of a basin of water, by a camera above it: what no other method finds, for the light of a point comes by
/// refraction and goes by refraction.
fn seen_through_water() -> Form {
    let make = || {
        let mut world = World::new();
        camera(&mut world, DVec3::new(0.0, 3.0, 0.0), DVec3::ZERO, WIDTH, false, 4);
        world.spawn((Plane::default(), white()));
        let water = Glass { ior: IOR, ..Glass::default() };
        world.spawn((Cuboid { size: DVec3::splat(1.6) }, Placement::at(0.0, 0.7, 0.0), water));
        world.spawn(point(2.2));
        world
    };
    let on_ground = over_square(WIDTH, |x| through_layers(x, &[(0.7, 1.0), (1.5, IOR)]));
    let truth = on_ground * (1.0 - fresnel(1.0, IOR)) / (IOR * IOR);
    Form { name: "point over water, seen from above", truth, make: Box::new(make), samples: 60 }
}

/// The same by way of a mirror that is level with the camera: it shows the ground from above.
fn seen_in_a_mirror() -> Form {
    let make = || {
        let mut world = World::new();
        // Straight up, to a mirror at 2 that shows the ground from 4 above.
        let look = LookAt { eye: DVec3::new(0.0, 1.2, 0.0), target: DVec3::new(0.0, 2.0, 0.0), up: DVec3::Z };
        let integrator = Integrator::Path { max_depth: 4, lights: LightStrategy::Mis, roulette: 0 };
        let ortho = OrthographicCamera { view_height: WIDTH };
        world.spawn((Name::new("camera"), look, integrator, ortho, Resolution { width: 16, height: 16 }));
        world.spawn((Plane { normal: DVec3::Y }, Placement::at(0.0, 0.0, 0.0), white()));
        let mirror = Mirror { colour: Rgb::grey(0.8) };
        world.spawn((Rectangle { width: 2.0, depth: 2.0 }, Placement::at(0.0, 2.0, 0.0), mirror));
        world.spawn(point(1.0));
        world
    };
    // The lamp lights the ground itself, and by its image in the mirror, at 3; the mirror shows 0.8 of both.
    let from = |height: f64, x: f64| height / libm::pow(height * height + x * x, 1.5);
    let truth = over_square(WIDTH, |x| 0.8 * (from(1.0, x) + 0.8 * from(3.0, x)));
    Form { name: "point under a mirror, seen in it", truth, make: Box::new(make), samples: 30 }
}

#[test]
fn photons_bring_what_closed_forms_say() {
    const SEEDS: u64 = 12;
    let mut all = forms();
    all.extend([seen_through_water(), seen_in_a_mirror()]);
    let mut tried = 0;
    for (number, form) in (200..).zip(all) {
        let make = mapped(form.make, 0.06);
        let found = mean_of(&make, &offer(), form.samples, number * SEEDS..(number + 1) * SEEDS);
        let off = (found.mean - form.truth) / found.error;
        eprintln!("{:<36} {:.5} ± {:.5} for {:.5}: {off:+.1} SE", form.name, found.mean, found.error, form.truth);
        assert!(off.abs() <= 4.0, "{}", form.name);
        assert!(found.error <= 0.01 * form.truth, "{}: a standard error above 1 %", form.name);
        tried += 1;
    }
    eprintln!("photons: {tried} closed forms, 0 apart");
}

/// To every block of pixels, of lamps that have an area and of such as have none; the radius is far below a block's side.
#[test]
fn photons_bring_what_other_methods_bring() {
    const SETS: u64 = 12;
    let alone = renders(&|| caustics(true), LightStrategy::Mis, 32, 0..SETS);
    for (number, lights) in [LightStrategy::Bsdf, LightStrategy::Light, LightStrategy::Mis].into_iter().enumerate() {
        let first = SETS * (number as u64 + 1);
        // Means of few samples are skewed where few photons arrive.
        let photons = renders(&mapped(|| caustics(true), 0.02), lights, 16, first..first + SETS);
        assert_agree(&format!("photons and paths, {lights:?}"), &alone, &photons, 8);
    }
    // Through water that the camera looks into, where light tracing finds nothing.
    let basin = || {
        let mut world = World::new();
        let look = LookAt { eye: DVec3::new(0.2, 2.6, 2.2), target: DVec3::new(0.0, 0.3, 0.0), up: DVec3::Y };
        let fov = PerspectiveCamera { fov: Degrees(40.0), ..Default::default() };
        let integrator = Integrator::Path { max_depth: 12, lights: LightStrategy::Mis, roulette: 4 };
        world.spawn((Name::new("camera"), look, fov, integrator, Resolution { width: 32, height: 32 }));
        world.spawn((Rectangle { width: 4.0, depth: 4.0 }, Placement::at(0.0, 0.0, 0.0), white()));
        let clay = Matte { colour: Rgb::new(0.8, 0.5, 0.3) };
        world.spawn((Sphere { radius: 0.25 }, Placement::at(0.3, 0.4, 0.1), clay));
        let water = Glass { ior: IOR, absorption: Rgb::new(0.4, 0.1, 0.05), ..Glass::default() };
        world.spawn((Cuboid { size: DVec3::new(1.8, 1.0, 1.8) }, Placement::at(0.0, 0.4, 0.0), water));
        let emissive = Emissive { radiance: Rgb::grey(8.0), ..Emissive::default() };
        world.spawn((Sphere { radius: 0.4 }, Placement::at(-0.6, 2.4, -0.4), emissive));
        world
    };
    let alone = renders(&basin, LightStrategy::Mis, 96, 0..SETS);
    let photons = renders(&mapped(basin, 0.02), LightStrategy::Mis, 32, SETS..2 * SETS);
    assert_agree("photons and paths, through water", &alone, &photons, 8);
    let make = || {
        let mut world = public("cornell-glass", LightStrategy::Mis);
        let camera = named(&mut world, "camera");
        world.entity_mut(camera).insert(Resolution { width: 32, height: 32 });
        world
    };
    let alone = renders(&make, LightStrategy::Mis, 48, 0..SETS);
    let photons = renders(&mapped(make, 4.0), LightStrategy::Mis, 16, SETS..2 * SETS);
    assert_agree("photons and paths, cornell-glass", &alone, &photons, 8);
}

/// A large first radius blurs light that is brightest in the middle; the mean over samples of what each radius makes of it
/// is known, and its error falls with the mean of r², in the end with the number of samples to the power α − 1 = −1/3.
#[test]
fn the_blur_is_that_of_the_radii_and_falls_as_they_do() {
    const RADIUS: f64 = 0.3;
    // A small window in the middle, where the light of a lamp through a pane is brightest.
    const WINDOW: f64 = 0.05;
    let form = || {
        let mut world = World::new();
        camera(&mut world, DVec3::new(0.0, 0.9, 0.0), DVec3::ZERO, WINDOW, false, 4);
        world.spawn((Plane::default(), white()));
        let pane = Cuboid { size: DVec3::new(3.0, 0.1, 3.0) };
        world.spawn((pane, Placement::at(0.0, 0.45, 0.0), Glass { ior: 1.5, ..Glass::default() }));
        world.spawn(point(0.8));
        world
    };
    // The camera is above the pane, so its own way passes it once each way: two faces at normal incidence.
    let passed = (1.0 - fresnel(1.0, 1.5)) * (1.0 - fresnel(1.0, 1.5));
    let at = |x: f64| through_layers(x, &[(0.3, 1.0), (0.1, 1.5), (0.4, 1.0)]) * passed;
    let over_disk = |radius: f64| {
        const RINGS: u32 = 64;
        let ring = |ring: u32| at(radius * libm::sqrt((f64::from(ring) + 0.5) / f64::from(RINGS)));
        (0..RINGS).map(ring).sum::<f64>() / f64::from(RINGS)
    };
    let truth = at(1e-4);
    let mut biases = Vec::new();
    for (samples, seeds) in [(1, 256), (8, 32), (64, 12)] {
        let predicted =
            (0..samples).map(|sample| over_disk(photon_radius(RADIUS, sample))).sum::<f64>() / f64::from(samples);
        let make = || {
            let mut world = mapped(form, RADIUS)();
            let camera = named(&mut world, "camera");
            let integrator = Integrator::Path { max_depth: 6, lights: LightStrategy::Mis, roulette: 0 };
            world.entity_mut(camera).insert((integrator, PhotonMapping { paths: 64.0, radius: RADIUS }));
            world
        };
        let found = mean_of(&make, &offer(), samples, 0..seeds);
        let off = (found.mean - predicted) / found.error;
        eprintln!(
            "{samples} samples: {:.5} ± {:.5} for {predicted:.5}, {off:+.1} SE; without blur {truth:.5}",
            found.mean, found.error
        );
        assert!(off.abs() <= 4.0, "{samples} samples");
        biases.push((f64::from(samples), truth - found.mean, found.error));
    }
    // The mean of r² over the first n samples.
    let mean_square = |samples: u32| {
        let square = |sample| photon_radius(1.0, sample) * photon_radius(1.0, sample);
        (0..samples).map(square).sum::<f64>() / f64::from(samples)
    };
    let power = |few: u32, many: u32| {
        libm::log(mean_square(many) / mean_square(few)) / libm::log(f64::from(many) / f64::from(few))
    };
    let [(few, large, error), .., (many, small, small_error)] = biases[..] else { panic!("three numbers") };
    let slope = libm::log(small / large) / libm::log(many / few);
    let uncertain = 2.0 * (error / large + small_error / small) / libm::log(many / few);
    let expected = power(few as u32, many as u32);
    eprintln!("the blur falls with the number of samples to the power {slope:.3} ± {uncertain:.3}, for {expected:.3}");
    assert!((slope - expected).abs() <= uncertain + 0.03, "powers of r above the second shift it a little");
    let (late, latest) = (power(1 << 10, 1 << 14), power(1 << 14, 1 << 18));
    eprintln!("in the long run, {late:.3} and {latest:.3}");
    assert!((late + 1.0 / 3.0).abs() < 0.02 && (latest + 1.0 / 3.0).abs() < (late + 1.0 / 3.0).abs());
}

#[test]
fn photons_have_the_same_bits_however_they_are_traced() {
    let (mut tried, folder) = (0, tempfile::tempdir().expect("a folder"));
    for (lamps, sampler, radius) in [(true, Sampler::Sobol, 0.0), (false, Sampler::Independent, 0.05)] {
        let mut scene = mapped(|| caustics(lamps), radius)();
        let camera = named(&mut scene, "camera");
        scene.entity_mut(camera).insert(Sampling { samples: 4, seed: 38, sampler, ..Sampling::default() });
        tried += assert_same_bits_however_divided(&scene, 4, folder.path());
    }
    eprintln!("photons: {tried} ways to trace 2 films, every bit the same");
}

#[test]
fn a_scene_without_photons_has_nothing_of_them() {
    let plan_of = |scene: &World| pinhole::plan::plan(&Census::of(scene), &offer()).expect("a plan");
    let kept = |scene: &World| {
        let plan = plan_of(scene);
        let stages = plan.rows.iter().filter(|row| row.kept && row.stage.contains("hoton")).count();
        let columns = plan.columns.iter().filter(|column| column.name == "photons").count();
        [stages, columns, plan.tables.iter().filter(|table| table.name == "photon map").count()]
    };
    assert_eq!(kept(&caustics(true)), [0; 3]);
    assert_eq!(kept(&traced(|| caustics(true))()), [0; 3]);
    // Two marks, one that stores, and one that gathers for each kind of material that is not specular.
    assert_eq!(kept(&mapped(|| caustics(true), 0.0)()), [5, 1, 1]);
    let plan = plan_of(&mapped(|| caustics(true), 0.0)());
    assert!(plan.to_string().contains("it produces the photons for each sample"));
    assert!(!plan.rows.iter().any(|row| row.kept && (row.stage.contains("onnect") || row.stage.contains("Splat"))));
}

#[test]
fn what_photons_cannot_do_is_said_in_a_sentence() {
    type Change = fn(&mut World, Entity);
    let mapping = |paths, radius| PhotonMapping { paths, radius };
    let insert: &dyn Fn(&mut World, Entity, PhotonMapping) =
        &|world, camera, own| _ = world.entity_mut(camera).insert(own);
    for (said, own) in [
        ("photon_mapping paths is 0", mapping(0.0, 0.0)),
        ("photon_mapping paths is NaN", mapping(f64::NAN, 0.0)),
        ("photon_mapping radius is -1", mapping(1.0, -1.0)),
        ("photon_mapping radius is NaN", mapping(1.0, f64::NAN)),
        ("photon_mapping radius is inf", mapping(1.0, f64::INFINITY)),
    ] {
        refuses(said, &|world, camera| insert(world, camera, own));
    }
    let cases: [(&str, Change); 5] = [
        ("beside dispersion", |world, _| {
            let ball = named(world, "ball");
            world.entity_mut(ball).insert(Dispersion::Bk7);
        }),
        ("beside light_tracing", |world, camera| _ = world.entity_mut(camera).insert(LightTracing::default())),
        ("without paths", |world, camera| _ = world.entity_mut(camera).insert(Integrator::WHITTED)),
        ("with adaptive sampling", |world, camera| {
            world.entity_mut(camera).insert((Sampling::default(), Adaptive::default()));
        }),
        ("on no camera", |world, camera| {
            world.entity_mut(camera).remove::<PhotonMapping>();
            world.spawn(PhotonMapping::default());
        }),
    ];
    for (said, change) in cases {
        refuses(said, &change);
    }
}

fn refuses(word: &str, change: &dyn Fn(&mut World, Entity)) {
    let mut world = mapped(|| caustics(true), 0.0)();
    let camera = named(&mut world, "camera");
    change(&mut world, camera);
    assert_refused(&world, word);
}

#[test]
fn an_odd_radius_is_said_before() {
    for (radius, word) in [(1e-5, Some("of a pixel's width")), (0.05, None), (50.0, Some("larger than the scene"))] {
        let scene = mapped(|| caustics(true), radius)();
        let census = &Census::of(&scene);
        let (plan, tables) = prepare(census, &offer()).expect("prepared");
        let asked = Preflight { threads: Some(1), ends_in_time: true, ..Preflight::default() };
        let told = preflight(census, (&plan, &tables), asked).expect("looks").join("\n");
        assert!(!told.contains("more than white"), "{told}");
        assert!(word.map_or(!told.contains("radius"), |word| told.contains(word)), "{radius}: {told}");
    }
}

/// What the photons of a sample take is counted before anything is allocated.
#[test]
fn more_photons_than_fit_are_refused() {
    let mut world = mapped(|| caustics(true), 0.0)();
    let camera = named(&mut world, "camera");
    let size = Resolution { width: 8192, height: 8192 };
    world.entity_mut(camera).insert((PhotonMapping { paths: 1024.0, radius: 0.0 }, size));
    let said = assert_refused(&world, "such a film with its photons");
    assert!(said.ends_with(" fits"), "{said}");
}

/// Radii from nearly none to all of the scene, one photon a pixel in a thousand, and cameras without an image plane.
#[test]
fn extreme_photons_leave_finite_pictures() {
    let mut tried = 0;
    for (paths, radius) in [(1.0 / 1024.0, 0.0), (1.0 / 1024.0, 1e-12), (0.125, 1e6), (0.125, 1e12), (4.0, 1e-3)] {
        for is_wide in [false, true] {
            let mut world = mapped(|| caustics(true), 0.0)();
            let camera = named(&mut world, "camera");
            let sampling = Sampling { samples: 2, ..Sampling::default() };
            world.entity_mut(camera).insert((PhotonMapping { paths, radius }, sampling));
            if is_wide {
                world.entity_mut(camera).remove::<PerspectiveCamera>().insert(FisheyeCamera::default());
            }
            let film = render(&world, &offer(), &Execution::default(), &()).expect("renders").film;
            assert_eq!(film.rejected().0, 0, "{paths} paths, radius {radius}");
            tried += 1;
        }
    }
    eprintln!("photons: {tried} extreme renders, 0 samples rejected");
}
