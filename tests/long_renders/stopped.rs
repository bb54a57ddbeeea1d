//! Whoever waits gets an answer: every command ends soon after it is asked to, and what is stopped midway leaves no trace.

use super::*;
use glam::DVec3;
use pinhole::extract::delta_light_rays;
use pinhole::film::FilmSplats;
use pinhole::plan::Census;
use pinhole::render::Worlds;
use scenes::offer;
use std::fmt::Write as _;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::thread;

/// Stops when its flag is set.
#[derive(Clone, Default)]
struct Flag(Arc<AtomicBool>);

impl Watch for Flag {
    fn stopped(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    fn stop_flag(&self) -> Option<Arc<AtomicBool>> {
        Some(Arc::clone(&self.0))
    }
}

const ENDLESS: Integrator = Integrator::Path { max_depth: u32::MAX, lights: LightStrategy::Mis, roulette: 0 };

/// A camera with this integrator, and a ball of mirror around the camera or, closed about a lamp, before it.
fn mirrors(around_camera: bool, more: impl Bundle) -> World {
    let mut world = World::new();
    let size = Resolution { width: 40, height: 24 };
    world.spawn((Name::new("camera"), PerspectiveCamera::default(), Placement::at(0.0, 1.0, 6.0), size, ENDLESS, more));
    let (place, radius) =
        if around_camera { (Placement::default(), 100.0) } else { (Placement::at(0.0, 9.0, 0.0), 1.0) };
    world.spawn((Sphere { radius }, Mirror { colour: Rgb::grey(1.0) }, place));
    world.spawn((PointLight { intensity: Rgb::grey(5.0), ..PointLight::default() }, place));
    world.spawn((Plane { normal: DVec3::Y }, Matte::default(), Placement::at(0.0, -200.0, 0.0)));
    world
}

/// How long a render goes on after its flag is set; it has to say that it was interrupted.
fn time_to_stop(render: &mut RenderInProgress, to: u32) -> Duration {
    let flag = Flag::default();
    let set = Arc::clone(&flag.0);
    let (sender, receiver) = std::sync::mpsc::channel();
    let timer = thread::spawn(move || {
        thread::sleep(Duration::from_millis(60));
        set.store(true, Ordering::Relaxed);
        sender.send(Instant::now()).expect("heard");
    });
    let stopped = render.advance(to, &flag);
    let ended = Instant::now();
    assert!(matches!(stopped, Err(Error::Interrupted)), "{stopped:?}");
    timer.join().expect("it only sleeps");
    ended.saturating_duration_since(receiver.recv().expect("it was set"))
}

/// Paths of four thousand million bounces: the samples that were under way are thrown away, with their layers.
#[test]
fn an_endless_path_is_given_up_and_adds_nothing() {
    let sampling = Sampling { samples: 3, ..Sampling::default() };
    for (what, scene) in
        [("one ray a pixel", mirrors(true, ())), ("samples with layers", mirrors(true, (sampling, Layers::all())))]
    {
        let mut render = RenderInProgress::begin(&Census::of(&scene), &offer(), &Execution::default()).expect("begins");
        let before = render.film.clone();
        let steps = render.steps();
        let took = time_to_stop(&mut render, steps);
        assert!(render.film == before, "{what}: something was added");
        assert!(took < Duration::from_secs(2), "{what}: {took:?}");
        eprintln!("{what}: given up after {took:?}");
    }
}

/// Light that never leaves the ball of mirror around its lamp: no batch of it joins the film.
#[test]
fn endless_paths_from_lights_are_given_up_and_add_nothing() {
    let sampling = Sampling { samples: 1, ..Sampling::default() };
    let scene = mirrors(false, (sampling, LightTracing::default()));
    let mut render = RenderInProgress::begin(&Census::of(&scene), &offer(), &Execution::default()).expect("begins");
    assert!(render.film.splats.is_some(), "light is traced from the lamp");
    let steps = render.steps();
    let took = time_to_stop(&mut render, steps);
    assert_eq!(render.film.least_done(), steps, "the camera's samples are done");
    assert!(render.film.splats == Some(FilmSplats::new(40, 24)), "no light joined");
    assert!(took < Duration::from_secs(2), "{took:?}");
    eprintln!("light: given up after {took:?}");
}

/// Everything that a film holds, as bits.
fn bits(film: &Film) -> [(&'static str, Vec<u64>); 4] {
    let of = |components: Vec<&Vec<f64>>| -> Vec<u64> {
        components.into_iter().flatten().map(|sum| sum.to_bits()).collect()
    };
    let counts = |components: Vec<&Vec<u32>>| components.into_iter().flatten().map(|&count| u64::from(count)).collect();
    let layers = &film.layers;
    [
        ("light", of(film.tiles.iter().flat_map(|tile| &tile.sum).collect())),
        ("samples", counts(film.tiles.iter().map(|tile| &tile.count).chain([&film.done]).collect())),
        ("layers", of(layers.iter().flat_map(|own| &own.sums).collect())),
        ("hits", counts(layers.iter().flat_map(|own| own.counts()).collect())),
    ]
}

/// A render that is stopped at any moment, within a tile or between two, goes on to the same bits.
#[test]
fn stopped_at_any_moment_it_goes_on_to_the_same_bits() {
    let sampling = Sampling { samples: 40, seed: 3, ..Sampling::default() };
    let scene = || {
        let mut scene = mirrors(false, (sampling, Layers::all()));
        let camera = named(&mut scene, "camera");
        scene.entity_mut(camera).insert(Integrator::Path { max_depth: 9, lights: LightStrategy::Mis, roulette: 0 });
        scene.spawn((Sphere { radius: 2.0 }, Mirror::default()));
        scene.spawn(Background { colour: Rgb::grey(0.5) });
        scene
    };
    let began = Instant::now();
    let whole = render(&scene(), &offer(), &Execution::default(), &()).expect("renders").film;
    let took = began.elapsed();
    let (mut stops, mut midway) = (0, 0);
    for part in 1..8 {
        let mut render =
            RenderInProgress::begin(&Census::of(&scene()), &offer(), &Execution::default()).expect("begins");
        let (flag, steps) = (Flag::default(), render.steps());
        let set = Arc::clone(&flag.0);
        let timer = thread::spawn(move || {
            thread::sleep(took * part / 9);
            set.store(true, Ordering::Relaxed);
        });
        stops += u32::from(render.advance(steps, &flag).is_err());
        timer.join().expect("it only sleeps");
        midway += u32::from(render.film.done.iter().any(|&done| done > 0 && done < steps));
        render.advance(steps, &()).expect("goes on");
        for (found, expected) in bits(&render.film).iter().zip(bits(&whole)) {
            assert!(*found == expected, "{} of a render stopped after {part} ninths", expected.0);
        }
    }
    assert!(stops > 0 && midway > 0, "{stops} stops, {midway} within a tile's samples");
    eprintln!("stopped: {stops} times, {midway} of them between two samples of a tile; the same bits and layers");
}

/// A file of a hundred thousand shapes.
fn many_shapes() -> String {
    let mut text =
        String::from("[(name: \"camera\", perspective_camera: (fov: 40.0), placement: (position: (0, 0, 9))),");
    for shape in 0..100_000 {
        let [x, y, z] = [shape % 50, shape / 50 % 50, shape / 2500].map(|along| f64::from(along) / 10.0);
        let _ = write!(text, "(sphere: (radius: 0.01), matte: (), placement: (position: ({x}, {y}, -{z}))),");
    }
    text + "(point_light: (intensity: (9, 9, 9)), placement: (position: (0, 5, 5)))]"
}

/// Paths without an end: in a ball of mirror around the camera.
const MIRROR_BALL: &str = "[(name: \"camera\", perspective_camera: (fov: 40), resolution: (width: 96, height: 54), \
    look_at: (eye: (0, 1, 6), target: (0, 0, 0)), integrator: Path(max_depth: 4294967295, lights: Mis, roulette: 0)), \
    (sphere: (radius: 100), mirror: (colour: (1, 1, 1))), \
    (sphere: (radius: 1), emissive: (radiance: (1, 1, 1)), placement: (position: (0, 0, 90)))]";

fn spawn(folder: &Path, words: &str) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pinhole"));
    command.current_dir(folder).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    command.args(words.split(' ')).spawn().expect("the program starts")
}

/// Every command that can take long, asked by Ctrl-C or SIGTERM while it parses, extracts, tries rays, traces, renders or
/// waits for a file that nobody writes.
#[test]
#[cfg(unix)]
fn every_command_ends_soon_after_a_signal() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path();
    fs::write(path.join("many.ron"), many_shapes()).expect("written");
    fs::write(path.join("ball.ron"), MIRROR_BALL).expect("written");
    assert!(Command::new("mkfifo").arg(path.join("pipe.checkpoint")).status().expect("made").success());
    let (mut worst, mut asked, mut kept) = ((Duration::ZERO, ""), 0, 0);
    for (number, words) in [
        "render ball.ron",
        "render ball.ron -q -o one.png",
        "render ball.ron -q --samples 64 -o some.exr",
        "render ball.ron -q --samples 4 --error 0.01 -o even.exr",
        "render ball.ron -q --samples 64 --resume -o pipe.exr",
        "trace ball.ron --pixel 3,3",
        "preflight ball.ron",
        "plan many.ron",
        "render many.ron -q -o many.png",
        "preflight many.ron",
        "trace many.ron --pixel 3,3",
        "report 18 --quick",
        "extremes --rays 100000000",
        "sweep 26",
        "closed-forms --times 1000",
        "cost 26",
        "render 5 -q --size 96x54 --samples 1000000 -o kept.exr",
        "render 25 -q --size 96x54 --samples 1000000 -o kept.png",
    ]
    .into_iter()
    .enumerate()
    {
        let mut child = spawn(path, words);
        // What is to be kept must have come as far as its first samples.
        thread::sleep(Duration::from_millis(if words.contains("kept") { 1500 } else { 300 }));
        if child.try_wait().expect("known").is_some() {
            eprintln!("{words}: over by itself");
            continue;
        }
        let signal = ["-TERM", "-INT"][number % 2];
        let sent = Instant::now();
        assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().expect("sent").success());
        while child.try_wait().expect("known").is_none() {
            if sent.elapsed() > Duration::from_secs(20) {
                child.kill().expect("killed");
                panic!("{words}: nothing came of {signal}");
            }
            thread::sleep(Duration::from_millis(5));
        }
        let took = sent.elapsed();
        let ended = child.wait_with_output().expect("it has ended");
        let said = String::from_utf8(ended.stderr).expect("UTF-8");
        // Before the program has come so far as to listen, the system ends it.
        if let Some(code) = ended.status.code() {
            assert!(code == 130 || words.starts_with("report"), "{words}: {code}, {said}");
            let (progress, last): (Vec<&str>, Vec<&str>) =
                said.lines().partition(|line| !line.starts_with("pinhole: "));
            assert!(last.len() == 1 && progress.len() < 20, "{words}: {said}");
            kept += u32::from(said.contains("hold what there is"));
        }
        eprintln!("{took:>12.1?} after {signal}: {words}: {}", said.trim());
        worst = worst.max((took, words));
        asked += 1;
    }
    let left = fs::read_dir(path).expect("listed").chain(fs::read_dir(path.join("out")).into_iter().flatten());
    let parts = left.filter(|file| file.as_ref().expect("listed").file_name().to_string_lossy().ends_with(".part"));
    assert_eq!(parts.count(), 0, "files that were half written");
    assert!(asked >= 12 && kept >= 2, "{asked} were asked, {kept} kept what there was");
    assert!(worst.0 < Duration::from_secs(2), "{worst:?}");
    eprintln!("signals: {asked} commands, the slowest answer after {worst:?}");
}

/// There is no more memory for the rays to ten thousand lights than for those to ten, since of more than 64 each pixel
/// chooses one; and the tiles' side changes no bit.
#[test]
fn many_lights_take_no_more_memory() {
    let scene = |lights: u32, size: [u32; 2]| {
        let mut world = World::new();
        let size = Resolution { width: size[0], height: size[1] };
        world.spawn((Name::new("camera"), PerspectiveCamera::default(), Placement::at(0.0, 3.0, 6.0), size));
        world.spawn((Plane { normal: DVec3::Y }, Matte::default()));
        for light in 0..lights {
            let [x, z] = [light % 100, light / 100].map(|along| f64::from(along) * 0.1 - 5.0);
            world.spawn((PointLight::default(), Placement::at(x, 2.0, z)));
        }
        world
    };
    let begun = |scene: &World, execution: &Execution| {
        RenderInProgress::begin(&Census::of(scene), &offer(), execution).expect("begins")
    };
    let mut sides = Vec::new();
    for (lights, rays) in [(1, 1), (10, 10), (64, 64), (65, 1), (10_000, 1), (30_000, 1)] {
        let render = begun(&scene(lights, [64, 64]), &Execution::default());
        let of_lights = ["shadow ray", "light pdf", "shadow hit"];
        let columns = render.plan.columns.iter().filter(|column| of_lights.contains(&column.name));
        let row: usize = columns.map(|column| column.bytes_per_row()).sum();
        let side = render.film.tile_side;
        let bytes = (side * side * rays) as usize * row;
        assert!(row > 0 && bytes <= 16 << 20, "{lights} lights in tiles of {side}: {bytes} bytes");
        assert_eq!(delta_light_rays(&Census::of(&scene(lights, [64, 64]))), rays as usize, "{lights} lights");
        sides.push(side);
    }
    assert_eq!(sides, [32; 6], "by the number of lights");

    let scene = scene(300, [21, 10]);
    let expected = FilmBits::of(&render(&scene, &offer(), &Execution::default(), &()).expect("renders").film);
    for execution in [
        Execution { tile_side: 2, ..Execution::default() },
        Execution { tile_side: 5, ..Execution::default() },
        Execution { worlds: Worlds::One, ..Execution::default() },
    ] {
        let film = render(&scene, &offer(), &execution, &()).expect("renders").film;
        FilmBits::of(&film).assert_is(&expected, &format!("tiles of {}", film.tile_side));
    }
    eprintln!("lights: 1 to 30,000 in tiles of {sides:?} pixels a side");
}

/// A thousand workers for one tile take longer to start than the tile.
#[test]
fn no_more_workers_start_than_there_is_work() {
    let started = |size: [u32; 2], threads, more: &dyn Fn(&mut World)| {
        let mut scene = full(Setup { size, ..Setup::default() });
        more(&mut scene);
        let execution = Execution { threads: Some(threads), ..Execution::default() };
        RenderInProgress::begin(&Census::of(&scene), &offer(), &execution).expect("begins").threads()
    };
    let nothing = |_: &mut World| ();
    assert_eq!(started([8, 8], 1000, &nothing), 1);
    assert_eq!(started([33, 64], 1000, &nothing), 4);
    assert_eq!(started([33, 64], 3, &nothing), 3);
    let lights = |scene: &mut World| {
        let camera = named(scene, "camera");
        let sampling = Sampling { samples: 100, ..Sampling::default() };
        scene.entity_mut(camera).insert((sampling, Integrator::PATH, LightTracing::default()));
        scene.spawn((Sphere { radius: 0.1 }, Glass::default(), Placement::at(0.0, 9.0, 0.0)));
        scene.spawn(PointLight::default());
    };
    assert_eq!(started([16, 16], 1000, &lights), 25, "100 · 16² paths from the lights in batches of 1024");
}
