//! Glass that disperses light: angles by Snell, white that stays white, and nothing of it where nothing disperses.

use super::*;
use glam::{DMat3, DVec3};
use pinhole::film::{Film, read_checkpoint, write_checkpoint};
use pinhole::follow::Scattered;
use pinhole::look::{Preflight, preflight, trace};
use pinhole::material::IndexCurve;
use pinhole::plan::{ComponentNumber, Plan, TileSystems, plan};
use pinhole::rays::Wavelengths;
use pinhole::render::{RenderInProgress, prepare, steps_of};
use pinhole::sample::Spectrum;
use pinhole::scene::*;
use scenes::FilmBits;
use std::f64::consts::{FRAC_PI_3, FRAC_PI_6};

/// The named glasses, and one of each form.
const GLASSES: [Dispersion; 6] = [
    Dispersion::Bk7,
    Dispersion::Sf11,
    Dispersion::Water,
    Dispersion::Diamond,
    Dispersion::Cauchy { a: 1.5046, b: 0.0042, c: 0.0 },
    Dispersion::Sellmeier { b: [1.3, 0.2, 1.0], c: [0.009, 0.04, 110.0] },
];

/// An index that is the same at all wavelengths.
const CONSTANT: Dispersion = Dispersion::Cauchy { a: 1.5, b: 0.0, c: 0.0 };

/// The lines h of mercury, F of hydrogen, d of helium, C of hydrogen and r of helium, in nm.
const LINES: [f64; 5] = [404.7, 486.1, 587.6, 656.3, 706.5];

/// A camera without a projection yet.
fn camera(world: &mut World, size: [u32; 2], look: LookAt, integrator: Integrator) -> Entity {
    let [width, height] = size;
    world.spawn((Name::new("camera"), look, Resolution { width, height }, integrator)).id()
}

/// A prism that stands on end, its edges along z, with its apex at the origin and its faces to the left and to the right.
fn prism(world: &mut World, apex: f64, glass: impl Bundle) {
    let (sin, cos) = libm::sincos(0.5 * apex);
    let glass = world.spawn((Name::new("glass"), glass)).id();
    let end = |z: f64| [DVec3::new(0.0, 0.0, z), DVec3::new(-sin, -cos, z), DVec3::new(sin, -cos, z)];
    let [near, far] = [end(1.0), end(-1.0)];
    // Anticlockwise from outside: the two ends, then each side as two triangles.
    let mut faces = vec![near, [far[0], far[2], far[1]]];
    for (one, other) in [(0, 1), (1, 2), (2, 0)] {
        faces.push([near[one], far[one], far[other]]);
        faces.push([near[one], far[other], near[other]]);
    }
    for vertices in faces {
        world.spawn((Triangle { vertices, ..Triangle::default() }, UsesMaterial(glass)));
    }
}

/// Every stage, and one that gives all paths this wavelength.
fn at_wavelength(wavelength: f64) -> Vec<Stage> {
    let set = move |mut tiles: Query<&mut Wavelengths>| {
        tiles.iter_mut().for_each(|mut own| own.nm.fill(wavelength));
    };
    let mut offer = offer();
    offer.push(Stage::new("Set wavelengths", TileSystems::Media, set).on_first_bounce().changes::<Wavelengths>());
    offer
}

/// The direction of the ray that a glass scattered at a bounce, which it has recorded.
fn scattered(trace: &pinhole::look::Trace, depth: u32) -> Option<DVec3> {
    let is_own = |stage: &str| stage == "Sample BSDFs: glass";
    let recorded =
        trace.stages.iter().find(|own| is_own(own.stage) && own.depth == depth && own.column.is::<Scattered>())?;
    let row = recorded.rows.first()?;
    let part = |name: &str| match row.iter().find(|(own, _)| *own == name)?.1 {
        ComponentNumber::F32(number) => Some(f64::from(number)),
        _ => None,
    };
    Some(DVec3::new(part("dx")?, part("dy")?, part("dz")?))
}

/// The direction in which a ray leaves the prism that meets its left face midway at this angle of incidence, by the
/// renderer's own stages: the first of the paths that are refracted twice.
fn leaving(apex: f64, glass: Dispersion, incidence: f64, wavelength: f64) -> DVec3 {
    let mut world = World::new();
    let (sin, cos) = libm::sincos(0.5 * apex);
    let (middle, inward) = (0.5 * DVec3::new(-sin, -cos, 0.0), DVec3::new(cos, -sin, 0.0));
    let towards = DMat3::from_rotation_z(incidence) * inward;
    let look = LookAt { eye: middle - 3.0 * towards, target: middle, up: DVec3::Z };
    let integrator = Integrator::Path { max_depth: 4, lights: LightStrategy::Mis, roulette: 0 };
    let camera = camera(&mut world, [1, 1], look, integrator);
    world.entity_mut(camera).insert(OrthographicCamera { view_height: 1e-6 });
    prism(&mut world, apex, (Glass::default(), glass));
    world.spawn(Background { colour: Rgb::grey(1.0) });
    let offer = at_wavelength(wavelength);
    let mut traced = |seed: u64| {
        let sampling = Sampling { samples: 1, seed, sampler: Sampler::Independent, ..Sampling::default() };
        world.entity_mut(camera).insert(sampling);
        let trace = trace(&Census::of(&world), &offer, TracePixel { x: 0, y: 0 }).expect("traces");
        let [inside, outside] = [0, 1].map(|depth| scattered(&trace, depth));
        // Both reflections lead back to the left.
        outside.filter(|outside| outside.x > 0.0 && inside.is_some_and(|inside| inside.x > 0.0))
    };
    (0..100).find_map(&mut traced).expect("one of 100 paths is refracted twice")
}

/// For each glass and line at the angle of least deviation, and at two others, the ray leaves where Snell's law says.
#[test]
fn a_prism_deviates_each_line_as_snell_says() {
    let (mut worst, mut tried) = (0.0_f64, 0);
    for glass in GLASSES {
        let mut deviations = Vec::new();
        for line in LINES {
            let index = IndexCurve::of(glass).index(line);
            let apex = if index < 1.9 { FRAC_PI_3 } else { FRAC_PI_6 };
            let least = libm::asin(index * libm::sin(0.5 * apex));
            for incidence in [least, least + 0.1, least - 0.05] {
                let inside = libm::asin(libm::sin(incidence) / index);
                let out = libm::asin(index * libm::sin(apex - inside));
                let expected = 0.5 * apex - out;
                let own = leaving(apex, glass, incidence, line);
                let off = libm::atan2(own.y, own.x) - expected;
                worst = worst.max(off.abs()).max(own.z.abs());
                assert!(off.abs() < 1e-6 && own.z.abs() < 1e-6, "{glass:?} at {line} nm: off by {off:.2e} rad");
                if incidence == least {
                    // At the least deviation the path is symmetrical: δ = 2θ − A.
                    assert!((incidence + out - apex - (2.0 * least - apex)).abs() < 1e-12);
                    deviations.push((2.0 * least - apex).to_degrees());
                }
                tried += 1;
            }
        }
        assert!(deviations.windows(2).all(|pair| pair[0] > pair[1]), "violet is deviated most: {deviations:?}");
        eprintln!("{glass:?}: least deviations {deviations:.4?}°");
    }
    eprintln!("prism: {tried} rays off by at most {worst:.1e} rad");
}

/// The mean over a film, unclamped: of the camera's samples and of the splats of light paths.
fn mean_of_film(film: &Film) -> [f64; 3] {
    assert_eq!(film.rejected().0, 0);
    let pixels = f64::from(film.width * film.height);
    let mut mean = [0.0; 3];
    for tile in &film.tiles {
        for row in 0..tile.tile.rows() {
            let own = tile.mean_f64(row);
            (0..3).for_each(|channel| mean[channel] += own[channel] / pixels);
        }
    }
    if let Some(splats) = &film.splats {
        let of = |channel: usize| splats.sums[channel].iter().sum::<f64>() / splats.paths as f64 / pixels;
        (0..3).for_each(|channel| mean[channel] += of(channel));
    }
    mean
}

/// The mean of a picture over seeds by channel, and its standard error.
fn by_channel(make: &dyn Fn() -> World, samples: u32, seeds: std::ops::Range<u64>) -> [[f64; 2]; 3] {
    let means: Vec<[f64; 3]> = seeds
        .map(|seed| {
            let mut world = make();
            let camera = named(&mut world, "camera");
            let filter = Filter::Box { radius: 0.5 };
            world.entity_mut(camera).insert(Sampling { samples, seed, sampler: Sampler::Sobol, filter });
            mean_of_film(&render(&world, &offer(), &Execution::default(), &()).expect("renders").film)
        })
        .collect();
    let count = means.len() as f64;
    [0, 1, 2].map(|channel| {
        let mean = means.iter().map(|own| own[channel]).sum::<f64>() / count;
        let squares: f64 = means.iter().map(|own| (own[channel] - mean) * (own[channel] - mean)).sum();
        [mean, (squares / (count - 1.0) / count).sqrt()]
    })
}

/// A coloured room with a body: lit by a lamp and by a tinted sky.
fn room(body: &dyn Fn(&mut World), integrator: Integrator, traced: bool) -> World {
    let mut world = World::new();
    let look = LookAt { eye: DVec3::new(0.0, 2.0, 4.0), target: DVec3::new(0.0, 0.4, 0.0), ..LookAt::default() };
    let camera = camera(&mut world, [24, 16], look, integrator);
    world.entity_mut(camera).insert(PerspectiveCamera { fov: Degrees(40.0), ..PerspectiveCamera::default() });
    if traced {
        world.entity_mut(camera).insert(LightTracing { paths: 1.0 });
    }
    world.spawn((Plane::default(), Matte { colour: Rgb::new(0.8, 0.4, 0.2) }));
    body(&mut world);
    let glow = Emissive { radiance: Rgb::new(20.0, 15.0, 10.0), ..Emissive::default() };
    world.spawn((Sphere { radius: 0.3 }, Placement::at(1.0, 2.5, 0.0), glow));
    world.spawn(Background { colour: Rgb::new(0.2, 0.4, 0.8) });
    world
}

fn compare(name: &str, own: [[f64; 2]; 3], truth: [[f64; 2]; 3]) {
    for channel in 0..3 {
        let ([mean, error], [expected, other]) = (own[channel], truth[channel]);
        let off = (mean - expected) / (error * error + other * other).sqrt();
        eprintln!("{name}, channel {channel}: {mean:.5} ± {error:.5} for {expected:.5} ± {other:.5}, {off:+.2}");
        assert!(off.abs() <= 4.0, "{name}, channel {channel}");
        assert!(error < 0.02 * expected, "{name}, channel {channel}: the error is too large to tell");
    }
}

/// Of an index that is the same at all wavelengths, the hero wavelengths add up to the picture in RGB: for smooth and rough
/// glass, with and without absorption, roulette, light tracing and fog all around.
#[test]
fn a_constant_index_gives_the_picture_in_rgb() {
    let path = |roulette| Integrator::Path { max_depth: 12, lights: LightStrategy::Mis, roulette };
    let cases: [(&str, f64, f64, u32, bool, bool); 5] = [
        ("smooth", 0.0, 0.0, 0, false, false),
        ("smooth, absorbing, roulette", 0.0, 0.7, 2, false, false),
        ("rough, roulette", 0.3, 0.0, 1, false, false),
        ("smooth, light tracing", 0.0, 0.2, 0, true, false),
        ("smooth, in fog", 0.0, 0.0, 0, false, true),
    ];
    for (name, roughness, absorption, roulette, traced, foggy) in cases {
        let made = |dispersion: Option<Dispersion>| {
            let body = |world: &mut World| {
                let absorption = Rgb::new(absorption, 0.5 * absorption, 0.1 * absorption);
                let glass = RoughGlass { ior: 1.5, roughness, absorption, priority: 0 };
                let mut body = world.spawn((Sphere { radius: 0.8 }, Placement::at(0.0, 0.9, 0.0), glass));
                dispersion.into_iter().for_each(|own| _ = body.insert(own));
                if foggy {
                    // Behind the glass, as the camera sees it: only paths that have their wavelengths come there.
                    let [absorption, scattering] = [Rgb::new(1.0, 0.2, 0.0), Rgb::new(0.5, 2.0, 4.0)];
                    let fog = Medium { absorption, scattering, anisotropy: 0.3, ..Medium::default() };
                    world.spawn((Cuboid { size: DVec3::new(4.0, 2.6, 1.0) }, Placement::at(0.0, 1.4, -1.5), fog));
                    let haze = Medium { scattering: Rgb::new(3.0, 1.0, 0.5), ..Medium::default() };
                    world.spawn((Sphere { radius: 0.5 }, Placement::at(0.2, 1.2, -1.6), haze));
                }
            };
            room(&body, path(roulette), traced)
        };
        let samples = if foggy { 128 } else { 32 };
        let own = by_channel(&|| made(Some(CONSTANT)), samples, 0..12);
        compare(name, own, by_channel(&|| made(None), samples, 100..112));
    }
}

/// A body that absorbs nothing cannot be seen in an even sky, whatever it does to each wavelength.
#[test]
fn a_lossless_body_is_invisible_in_a_furnace() {
    let path = Integrator::Path { max_depth: 200, lights: LightStrategy::Mis, roulette: 0 };
    for glass in GLASSES {
        let make = || {
            let mut world = World::new();
            let look = LookAt { eye: DVec3::new(0.0, 0.0, 4.0), target: DVec3::ZERO, ..LookAt::default() };
            let camera = camera(&mut world, [24, 24], look, path);
            world.entity_mut(camera).insert(PerspectiveCamera { fov: Degrees(25.0), ..PerspectiveCamera::default() });
            world.spawn((Sphere { radius: 1.0 }, Glass::default(), glass));
            world.spawn(Background { colour: Rgb::grey(1.0) });
            world
        };
        compare(&format!("{glass:?}"), by_channel(&make, 16, 0..12), [[1.0, 0.0]; 3]);
    }
}

/// White light through a slit and a prism onto a screen, seen by the camera straight from above.
fn spectrum(traced: bool, glass: impl Bundle) -> World {
    let mut world = World::new();
    // The screen is at x = 4, the prism at the origin, the lamp far to the left; least deviation of yellow light.
    let integrator = Integrator::Path { max_depth: 5, lights: LightStrategy::Mis, roulette: 0 };
    let look = LookAt { eye: DVec3::new(1.0, -3.0, 0.0), target: DVec3::new(4.0, -3.0, 0.0), up: DVec3::Y };
    let camera = camera(&mut world, [1, 12], look, integrator);
    world.entity_mut(camera).insert(OrthographicCamera { view_height: 3.0 });
    if traced {
        world.entity_mut(camera).insert(LightTracing { paths: 1.0 });
    }
    prism(&mut world, FRAC_PI_3, glass);
    world.spawn((Plane { normal: DVec3::NEG_X }, Placement::at(4.0, 0.0, 0.0), Matte { colour: Rgb::grey(0.8) }));
    let middle = 0.5 * DVec3::new(-0.5, -libm::cos(FRAC_PI_6), 0.0);
    let incidence = libm::asin(1.78 * libm::sin(FRAC_PI_6));
    let from = middle - 3.0 * (DMat3::from_rotation_z(incidence) * DVec3::new(libm::cos(FRAC_PI_6), -0.5, 0.0));
    let light = SpotLight {
        intensity: Rgb::grey(4000.0),
        inner_angle: Degrees(2.0),
        outer_angle: Degrees(2.5),
        casts_shadows: true,
    };
    world.spawn((light, LookAt { eye: from, target: middle, up: DVec3::Z }));
    world
}

/// What each pixel of the screen gets, by channel, with its standard error over seeds.
fn on_screen(make: &dyn Fn() -> World, seeds: std::ops::Range<u64>) -> Vec<[[f64; 2]; 3]> {
    let films: Vec<Film> = seeds
        .map(|seed| {
            let mut world = make();
            let camera = named(&mut world, "camera");
            let filter = Filter::Box { radius: 0.5 };
            world.entity_mut(camera).insert(Sampling { samples: 1024, seed, sampler: Sampler::Independent, filter });
            render(&world, &offer(), &Execution::default(), &()).expect("renders").film
        })
        .collect();
    let count = films.len() as f64;
    let of = |pixel: usize, channel: usize| {
        let each = films.iter().map(|film| {
            let splats = film.splats.as_ref().expect("light paths");
            splats.sums[channel][pixel] / splats.paths as f64
        });
        let mean = each.clone().sum::<f64>() / count;
        let squares: f64 = each.map(|own| (own - mean) * (own - mean)).sum();
        [mean, (squares / (count - 1.0).max(1.0) / count).sqrt()]
    };
    (0..12).map(|pixel| [0, 1, 2].map(|channel| of(pixel, channel))).collect()
}

/// The spectrum on the screen is the sum of pictures of single wavelengths, each of ordinary glass with the index there:
/// a sum over the middles of equal parts of the distribution that wavelengths are sampled from.
#[test]
fn a_spectrum_is_the_sum_of_its_lines() {
    const PARTS: u32 = 40;
    let whole = on_screen(&|| spectrum(true, (Glass::default(), Dispersion::Sf11)), 0..16);
    let mut sum = vec![[[0.0; 2]; 3]; 12];
    for part in 0..PARTS {
        let (wavelength, weight) = Spectrum::get().sample((f64::from(part) + 0.5) / f64::from(PARTS));
        let ior = IndexCurve::of(Dispersion::Sf11).index(wavelength);
        let glass = move || spectrum(true, Glass { ior, ..Glass::default() });
        let first = 1000 + 2 * u64::from(part);
        for (pixel, own) in on_screen(&glass, first..first + 2).into_iter().enumerate() {
            for channel in 0..3 {
                let share = weight[channel] / f64::from(PARTS);
                sum[pixel][channel][0] += share * own[channel][0];
                sum[pixel][channel][1] += share * share * own[channel][1] * own[channel][1];
            }
        }
    }
    let brightest = whole.iter().map(|own| own[1][0]).fold(0.0, f64::max);
    for (pixel, (own, parts)) in whole.iter().zip(&sum).enumerate() {
        for channel in 0..3 {
            let ([mean, error], [expected, square]) = (own[channel], parts[channel]);
            // The edges of the parts' beams are steps of their sum.
            let off =
                (mean - expected).abs() / (error * error + square + (0.01 * brightest) * (0.01 * brightest)).sqrt();
            eprintln!("pixel {pixel}, channel {channel}: {mean:.4} ± {error:.4} for {expected:.4}, {off:.2}");
            assert!(off <= 4.0, "pixel {pixel}, channel {channel}");
        }
    }
    // Red is deviated least, blue most: the brightest pixels of the channels follow in that order.
    let place = |channel: usize| {
        let all: f64 = whole.iter().map(|own| own[channel][0].max(0.0)).sum();
        whole.iter().enumerate().map(|(pixel, own)| pixel as f64 * own[channel][0].max(0.0)).sum::<f64>() / all
    };
    let [red, green, blue] = [0, 1, 2].map(place);
    assert!(red < green && green < blue, "{red} {green} {blue}");
    eprintln!("spectrum: red at {red:.2}, green at {green:.2}, blue at {blue:.2}");
}

fn plan_of(world: &World) -> Plan {
    plan(&Census::of(world), &offer()).expect("a plan")
}

fn ball_of(glass: impl Bundle, integrator: Integrator) -> World {
    let body = |world: &mut World| _ = world.spawn((Name::new("ball"), Sphere { radius: 0.8 }));
    let mut world = room(&body, integrator, false);
    let ball = named(&mut world, "ball");
    world.entity_mut(ball).insert(glass);
    world
}

/// Columns and stages are there where glass disperses and its rays are sampled, and nowhere else.
#[test]
fn a_scene_without_dispersion_has_nothing_of_it() {
    let stages = ["Sample wavelengths", "Weight paths by wavelength", "Carry wavelengths to the next bounce"];
    let has = |world: &World| {
        let plan = plan_of(world);
        let columns = ["wavelength", "wavelength weight"].map(|name| plan.columns.iter().any(|own| own.name == name));
        let kept = stages.map(|name| plan.rows.iter().any(|row| row.stage == name && row.kept));
        assert!(columns.iter().chain(&kept).all(|own| *own == columns[0]), "{columns:?} {kept:?}");
        columns[0]
    };
    assert!(!has(&ball_of(Glass::default(), Integrator::PATH)));
    assert!(has(&ball_of((Glass::default(), Dispersion::Bk7), Integrator::PATH)));
    assert!(has(&ball_of((RoughGlass::default(), Dispersion::Bk7), Integrator::PATH)));
    assert!(has(&ball_of((Glass::default(), Dispersion::Bk7), Integrator::DISTRIBUTION)));
    assert!(!has(&ball_of((Glass::default(), Dispersion::Bk7), Integrator::RayCasting)));
    let split = ball_of((Glass::default(), Dispersion::Bk7), Integrator::WHITTED);
    assert!(!has(&split));
    let plan = plan_of(&split);
    let row = plan.rows.iter().find(|row| row.stage == stages[0]).expect("on offer");
    assert!(row.reason.contains("splits rays"), "{}", row.reason);
    let mut unused = ball_of(Matte::default(), Integrator::PATH);
    unused.spawn((Name::new("spare"), Glass::default(), Dispersion::Sf11));
    assert!(!has(&unused), "no shape is made of it");
}

/// Whitted's method has no wavelengths: its picture is that of glass with the index of the yellow line.
#[test]
fn split_rays_use_the_index_of_the_yellow_line() {
    let film = |world: &World| render(world, &offer(), &Execution::default(), &()).expect("renders").film;
    let ior = IndexCurve::of(Dispersion::Sf11).index(pinhole::material::D_LINE);
    let own = film(&ball_of((Glass::default(), Dispersion::Sf11), Integrator::WHITTED));
    let plain = film(&ball_of(Glass { ior, ..Glass::default() }, Integrator::WHITTED));
    FilmBits::of(&own).assert_is(&FilmBits::of(&plain), "index of the yellow line");
}

/// Where the camera names no integrator, dispersion needs paths; where it names Whitted's method, that is said, and so is
/// an index of refraction that nothing uses.
#[test]
fn what_is_not_seen_of_a_dispersion_is_said() {
    let glass = |ior: f64| (Glass { ior, ..Glass::default() }, Dispersion::Bk7);
    let mut world = World::new();
    world.spawn((PerspectiveCamera::default(), Placement::at(0.0, 0.0, 4.0), Resolution { width: 8, height: 8 }));
    world.spawn((Name::new("lamp"), PointLight::default(), Placement::at(2.0, 3.0, 4.0)));
    world.spawn((Sphere { radius: 0.5 }, Matte::default(), Placement::at(-1.0, 0.0, 0.0)));
    let ball = world.spawn((Name::new("ball"), Sphere { radius: 0.5 }, Glass::default())).id();
    assert_eq!(integrator_of(&Census::of(&world)).integrator, Integrator::WHITTED);
    world.entity_mut(ball).insert(Dispersion::Bk7);
    let chosen = integrator_of(&Census::of(&world));
    assert_eq!(chosen.integrator, Integrator::PATH);
    assert!(chosen.reason.contains("1 dispersing glass surface: \"ball\""), "{}", chosen.reason);
    let said = |world: &World| {
        let census = &Census::of(world);
        let prepared = prepare(census, &offer()).expect("prepares");
        preflight(census, (&prepared.0, &prepared.1), Preflight::default()).expect("looks").join("\n")
    };
    let whitted = said(&ball_of(glass(1.5), Integrator::WHITTED));
    assert!(whitted.contains("index at 587.56 nm (1 dispersing glass surface: \"ball\")"), "{whitted}");
    for (ior, is_said) in [(1.5, false), (1.517, false), (1.7, true)] {
        let said = said(&ball_of(glass(ior), Integrator::PATH));
        assert!(!said.contains("587.56 nm (1"), "{said}");
        assert_eq!(said.contains("glass \"ball\" has the ior 1.7"), is_said, "{said}");
    }
}

/// A dispersion beside what is no glass is refused, and so is one that gives no index.
#[test]
fn what_cannot_disperse_says_so() {
    let told = |world: &World| {
        let result = render(world, &offer(), &Execution::default(), &()).map(|_| ());
        result.expect_err("refused").to_string()
    };
    let with = |bundle: Dispersion| told(&ball_of((Glass::default(), bundle), Integrator::PATH));
    let matte = told(&ball_of((Matte::default(), Dispersion::Bk7), Integrator::PATH));
    let thin = told(&ball_of((ThinGlass::default(), Dispersion::Bk7), Integrator::PATH));
    let mut world = ball_of(Glass::default(), Integrator::PATH);
    world.spawn((Name::new("alone"), Dispersion::Bk7));
    for (said, words) in [
        (matte, ["dispersion \"ball\"", "material is matte", "Glass or RoughGlass"]),
        (thin, ["dispersion \"ball\"", "material is thin_glass", "Glass or RoughGlass"]),
        (told(&world), ["dispersion \"alone\"", "material is missing", "Glass or RoughGlass"]),
        (
            with(Dispersion::Cauchy { a: f64::NAN, b: 0.0, c: 0.0 }),
            ["dispersion \"ball\"", "cauchy a is NaN", "a finite number"],
        ),
        (
            with(Dispersion::Cauchy { a: 0.0, b: 0.0, c: 0.0 }),
            ["dispersion \"ball\"", "index is 0 at 380 nm", "from 0.001 to 1000"],
        ),
        (
            with(Dispersion::Sellmeier { b: [1.0; 3], c: [0.16; 3] }),
            ["dispersion \"ball\"", "index is", "at all wavelengths from 380 to 780 nm"],
        ),
    ] {
        assert!(words.iter().all(|word| said.contains(word)), "{said}");
    }
}

/// Negative samples are kept in checkpoints, and a render goes on from them bit by bit; a film of another scene that held
/// such sums would be damaged.
#[test]
fn negative_samples_survive_a_checkpoint() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("checkpoint");
    for traced in [false, true] {
        let body = |world: &mut World| {
            let glass = (Glass::default(), Dispersion::Sf11);
            world.spawn((Sphere { radius: 0.8 }, Placement::at(0.0, 0.9, 0.0), glass));
        };
        let mut world = room(&body, Integrator::PATH, traced);
        let camera = named(&mut world, "camera");
        world.entity_mut(camera).insert(Sampling { samples: 5, seed: 3, ..Sampling::default() });
        let census = &Census::of(&world);
        let execution = Execution::default();
        let begin = || RenderInProgress::begin(census, &offer(), &execution).expect("begins");
        let mut whole = begin();
        whole.advance(steps_of(5), &()).expect("goes on");
        let mut cut = begin();
        cut.advance(steps_of(2), &()).expect("goes on");
        let sums = cut.film.tiles.iter().flat_map(|tile| tile.sum.iter().flatten());
        assert!(sums.clone().any(|sum| *sum < 0.0), "no sum is negative");
        assert_eq!(cut.film.rejected().0, 0);
        write_checkpoint(&cut.film, 27, &path).expect("written");
        let mut resumed = begin();
        resumed.take(read_checkpoint(27, &resumed.film, false, &path).expect("read"));
        assert!(resumed.film == cut.film, "a checkpoint holds all of a film");
        resumed.advance(steps_of(5), &()).expect("goes on");
        FilmBits::of(&resumed.film).assert_is(&FilmBits::of(&whole.film), "resumed");
        let plain =
            room(&|world| _ = world.spawn((Sphere { radius: 0.8 }, Glass::default())), Integrator::PATH, traced);
        let other = RenderInProgress::begin(&Census::of(&plain), &offer(), &execution).expect("begins");
        let said = read_checkpoint(27, &other.film, false, &path).expect_err("refused").to_string();
        assert!(said.contains("damaged"), "{said}");
    }
}
