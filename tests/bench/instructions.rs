//! What a feature costs a scene that does not use it, in instructions a ray and in bytes, counted by valgrind.
//!
//! `cargo bench --bench instructions` renders each scene with every stage on offer and with those that it needs, at two
//! sizes each; the slopes between the sizes leave out all that a program does once.
//! Instructions are counted by callgrind, bytes allocated by dhat, on one thread; images are compared byte by byte.
//! valgrind shows its guests no AVX-512, so the kernels for AVX2 run.
//!
//! `-- --against FOLDER` counts what samples of chapters cost here and in another checkout, both built with `--release`.
#![allow(clippy::print_stdout, reason = "a benchmark's product is what it prints")]

use pinhole::film::{film_stage, write_checkpoint, write_exr};
use pinhole::material::{MatteTable, MirrorTable, PhongTable};
use pinhole::plan::{Census, Stage, plan};
use pinhole::render::{Execution, Limits, RenderInProgress, WHOLE, render_in_passes};
use pinhole::scene::{Resolution, SceneFile};
use pinhole::{follow, intersect, rays, shade, stages};
use std::fs;
use std::path::Path;
use std::process::Command;

/// The most that a render with every stage on offer may take, as a multiple of one with only those needed.
const MAX: f64 = 1.005;

/// A scene, and the stages that it needs.
struct Case {
    name: &'static str,
    scene: &'static str,
    stages: fn() -> Vec<Stage>,
    samples: u32,
}

const CASES: [Case; 5] = [
    Case { name: "spheres seen unlit", scene: UNLIT, stages: unlit, samples: 1 },
    Case { name: "spheres and a plane in light and shadow", scene: LIT, stages: lit, samples: 1 },
    Case { name: "the same with 4 samples a pixel", scene: SAMPLED, stages: sampled, samples: 4 },
    Case { name: "some of chapters 13 to 17, with 4 samples", scene: VARIED, stages: varied, samples: 4 },
    Case {
        name: "paths among matte things and a mirror, with 4 samples",
        scene: FOLLOWED,
        stages: followed,
        samples: 4,
    },
];

/// Sizes whose pixels are as 1 to 4, in whole tiles.
const SIZES: [(u32, u32); 2] = [(96, 64), (192, 128)];

const UNLIT: &str = r#"[
    (perspective_camera: (fov: 40), placement: (position: (0, 1, 6)), resolution: (width: 96, height: 64)),
    (sphere: (radius: 1), placement: (position: (-1, 1, 0)), matte: (colour: (0.9, 0.7, 0.3))),
    (sphere: (radius: 0.6), placement: (position: (1, 0.6, 0.5)), matte: (colour: (0.2, 0.7, 0.3))),
]"#;

const LIT: &str = r#"[
    (perspective_camera: (fov: 40), integrator: RayCasting, placement: (position: (0, 1, 6)), resolution: (width: 96, height: 64)),
    (sphere: (radius: 1), placement: (position: (-1, 1, 0)), matte: (colour: (0.9, 0.7, 0.3))),
    (sphere: (radius: 0.6), placement: (position: (1, 0.6, 0.5)), matte: (colour: (0.2, 0.7, 0.3))),
    (plane: (), matte: (colour: (0.5, 0.5, 0.5))),
    (point_light: (intensity: (90, 80, 70)), placement: (position: (3, 5, 4))),
    (background: (colour: (0.1, 0.2, 0.3))),
]"#;

const SAMPLED: &str = r#"[
    (perspective_camera: (fov: 40), integrator: RayCasting, placement: (position: (0, 1, 6)), resolution: (width: 96, height: 64),
        sampling: (samples: 4)),
    (sphere: (radius: 1), placement: (position: (-1, 1, 0)), matte: (colour: (0.9, 0.7, 0.3))),
    (sphere: (radius: 0.6), placement: (position: (1, 0.6, 0.5)), matte: (colour: (0.2, 0.7, 0.3))),
    (plane: (), matte: (colour: (0.5, 0.5, 0.5))),
    (point_light: (intensity: (90, 80, 70)), placement: (position: (3, 5, 4))),
    (background: (colour: (0.1, 0.2, 0.3))),
]"#;

/// One of two or more of what each chapter brings: the others must cost nothing.
const VARIED: &str = r#"[
    (perspective_camera: (fov: 40), integrator: RayCasting, placement: (position: (0, 1, 6)), resolution: (width: 96, height: 64),
        sampling: (samples: 4, filter: Tent(radius: 1))),
    (disk: (radius: 1.2), placement: (position: (-1, 0.5, 0)), phong: (colour: (0.5, 0.4, 0.2))),
    (cuboid: (size: (1, 1.2, 1)), placement: (position: (1, 0.6, 0)), matte: (),
        checker: (second: (0.2, 0.2, 0.6), size: 0.3, by: Space)),
    (spot_light: (intensity: (90, 80, 70)), placement: (position: (0, 1, 8))),
    (gradient: (top: (0.1, 0.2, 0.5))),
]"#;

/// Light paths beyond the first surface, by the kinds of material and light that are there and no others.
const FOLLOWED: &str = r#"[
    (perspective_camera: (fov: 40), placement: (position: (0, 1, 6)), resolution: (width: 96, height: 64),
        sampling: (samples: 4), integrator: Path(max_depth: 5, lights: Mis, roulette: 3)),
    (sphere: (radius: 1), placement: (position: (-1, 1, 0)), matte: (colour: (0.9, 0.7, 0.3))),
    (sphere: (radius: 0.6), placement: (position: (1, 0.6, 0.5)), mirror: ()),
    (plane: (), matte: (colour: (0.5, 0.5, 0.5))),
    (sphere: (radius: 0.5), placement: (position: (3, 5, 4)), emissive: (radiance: (30, 28, 26))),
    (background: (colour: (0.1, 0.2, 0.3))),
]"#;

/// From the screen to the world, for a perspective camera.
fn perspective() -> Vec<Stage> {
    vec![rays::ndc_stage(), rays::screen_stage(), rays::perspective_stage(), rays::world_stage()]
}

fn unlit() -> Vec<Stage> {
    let mut stages = perspective();
    stages.extend([rays::raster_stage(), intersect::start_stage(), intersect::sphere_stage()]);
    stages.extend([intersect::classify_stage(), intersect::sphere_surface_stage()]);
    stages.extend([shade::start_stage(), shade::unlit_stage(), film_stage()]);
    stages
}

fn lit_with(raster: Stage) -> Vec<Stage> {
    let mut stages = perspective();
    stages.extend([raster, intersect::start_stage(), intersect::sphere_stage(), intersect::plane_stage()]);
    stages.extend([intersect::classify_stage(), intersect::sphere_surface_stage(), intersect::plane_surface_stage()]);
    stages.extend([
        shade::start_stage(),
        shade::background_stage(),
        shade::start_shadow_rays_stage(),
        shade::point_light_stage(),
        shade::start_shadow_stage(),
    ]);
    stages.extend([
        shade::sphere_shadow_stage(),
        shade::plane_shadow_stage(),
        follow::direct_light_stage::<MatteTable>(),
        film_stage(),
    ]);
    stages
}

fn lit() -> Vec<Stage> {
    lit_with(rays::raster_stage())
}

fn sampled() -> Vec<Stage> {
    lit_with(rays::place_samples_stage())
}

fn varied() -> Vec<Stage> {
    let mut stages = perspective();
    stages.extend([rays::place_samples_stage(), intersect::start_stage()]);
    stages.extend([intersect::disk_stage(), intersect::cuboid_stage(), intersect::classify_stage()]);
    stages.extend([intersect::disk_surface_stage(), intersect::cuboid_surface_stage()]);
    stages.extend([shade::start_stage(), shade::start_shadow_rays_stage(), shade::gradient_stage()]);
    stages.extend([
        shade::footprint_stage(),
        shade::colour_stage(),
        shade::texture_point_stage(),
        shade::checker_stage(),
    ]);
    stages.extend([
        shade::spot_light_stage(),
        shade::start_shadow_stage(),
        shade::shape_shadow_stage::<pinhole::shapes::PlacedDisk>(),
    ]);
    stages.extend([
        shade::shape_shadow_stage::<pinhole::shapes::Slabs>(),
        follow::direct_light_stage::<MatteTable>(),
        follow::direct_light_stage::<PhongTable>(),
        film_stage(),
    ]);
    stages
}

fn followed() -> Vec<Stage> {
    let mut stages = perspective();
    stages.extend([rays::place_samples_stage(), intersect::start_stage(), shade::start_stage()]);
    stages.extend([shade::start_shadow_rays_stage(), follow::start_paths_stage(), follow::start_scattered_stage()]);
    stages.extend([intersect::sphere_stage(), intersect::plane_stage(), intersect::classify_stage()]);
    stages.extend([follow::classify_bsdf_stage::<MirrorTable>(), follow::max_depth_stage()]);
    stages.extend([intersect::sphere_surface_stage(), intersect::plane_surface_stage(), shade::background_stage()]);
    stages.extend([shade::area_light_stage(), shade::start_shadow_stage(), shade::sphere_shadow_stage()]);
    stages.extend([
        shade::plane_shadow_stage(),
        follow::mis_stage::<MatteTable>(),
        follow::direct_light_stage::<MatteTable>(),
    ]);
    stages.extend([
        follow::mis_emission_stage(),
        follow::specular_stage::<MirrorTable>(),
        follow::sample_stage::<MatteTable>(),
    ]);
    stages.extend([follow::roulette_stage(), follow::add_bounce_stage(), follow::next_bounce_stage()]);
    stages.extend([follow::remaining_bounces_stage(), follow::sum_bounces_stage(), film_stage()]);
    stages
}

fn main() {
    let words: Vec<String> = std::env::args().collect();
    for (flag, offers_all) in [("--only", false), ("--all", true)] {
        if let Some(at) = words.iter().position(|word| word == flag) {
            return render_case(&words[at + 1..], offers_all);
        }
    }
    if Command::new("valgrind").arg("--version").output().is_err() {
        println!("instructions: valgrind is not installed here; nothing was counted");
        return;
    }
    if let Some(at) = words.iter().position(|word| word == "--against") {
        return against(Path::new(words.get(at + 1).expect("a folder")));
    }
    let max = CASES.iter().map(compare).fold(0.0_f64, f64::max);
    assert!(max <= MAX, "a scene pays for what it does not use: {max:.4} times the instructions, at most {MAX}");
}

/// Numbers of chapters that rasterise nothing; together they have all kinds of shapes, lights and integrators.
const TRACED: [&str; 17] =
    ["10", "13", "14", "16", "17", "19", "20", "21", "22", "23", "24", "25", "26", "27", "28", "29", "31"];

/// Prints how many instructions twelve samples more of each pixel take, here as a multiple of another checkout's.
///
/// No test rays are traced before, and nothing is written in between: how much of that there is depends on time.
fn against(other: &Path) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut max = 0.0_f64;
    for chapter in TRACED {
        let [own, others] = [Path::new(env!("CARGO_MANIFEST_DIR")), other].map(|checkout| {
            let exr = folder.path().join("picture.exr");
            let [few, many] = ["4", "16"].map(|samples| {
                let mut tool = callgrind();
                tool.current_dir(checkout)
                    .arg("target/release/pinhole")
                    .args(["render", chapter, "--quiet", "-j", "1"]);
                tool.args(["--no-preflight", "--write-every", "10000s", "--size", "96x64", "-n", samples, "-o"])
                    .arg(&exr);
                count(tool, "Collected :")
            });
            (many - few, fs::read(exr).expect("a picture"))
        });
        let (ratio, same) = (own.0 / others.0, if own.1 == others.1 { "the same picture" } else { "another picture" });
        println!(
            "chapter {chapter}: {:.1} million instructions, {ratio:.4} times the other's {:.1}; {same}",
            own.0 / 1e6,
            others.0 / 1e6
        );
        max = max.max(ratio);
    }
    assert!(max <= MAX, "a chapter takes {max:.4} times the instructions, at most {MAX}");
}

/// Renders a case at a size by the stages that it needs, with the others on offer or without them.
fn render_case(words: &[String], offers_all: bool) {
    let [case, width, height, output] = words else { panic!("a case, a width, a height and a file are needed") };
    let case = &CASES[case.parse::<usize>().expect("a case's number")];
    let (width, height) = (width.parse().expect("pixels"), height.parse().expect("pixels"));
    let mut world = SceneFile::parse(Path::new("case.ron"), case.scene.into()).expect("a scene").world();
    let camera = pinhole::extract::camera_entity(&world).expect("a camera");
    world.entity_mut(camera).insert(Resolution { width, height });
    let offer = if offers_all { stages::all() } else { (case.stages)() };
    let census = &Census::of(&world);
    let kept = plan(census, &offer).expect("a plan");
    let all_kept = kept.rows.iter().all(|row| row.kept);
    assert!(all_kept != offers_all, "only the stages that the scene needs, or others too:\n{kept}");
    let execution = Execution { threads: Some(1), ..Execution::default() };
    let mut in_progress = RenderInProgress::begin(census, &offer, &execution).expect("a plan");
    if in_progress.is_sampled() {
        render_in_passes(&mut in_progress, &Limits::default(), &(), &mut |_| Ok(())).expect("renders");
        let key = in_progress.key(&world, &()).expect("nobody stops it");
        write_checkpoint(&in_progress.film, key, &Path::new(output).with_extension("checkpoint")).expect("a file");
    } else {
        in_progress.advance(WHOLE, &()).expect("renders");
    }
    write_exr(&in_progress.finish().film, Path::new(output)).expect("a file");
}

/// Prints a case's slopes, and gives the ratio of instructions.
fn compare(case: &Case) -> f64 {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let number = CASES.iter().position(|other| other.name == case.name).expect("a case").to_string();
    let mut counted = Vec::new();
    for (width, height) in SIZES {
        let (full_exr, only_exr) = (folder.path().join("full.exr"), folder.path().join("only.exr"));
        let render = |mut tool: Command, flag: &str, exr: &Path| {
            let (width, height) = (width.to_string(), height.to_string());
            tool.arg(std::env::current_exe().expect("this program")).args([flag, &number, &width, &height]).arg(exr);
            tool
        };
        let both = |tool: fn() -> Command| [render(tool(), "--all", &full_exr), render(tool(), "--only", &only_exr)];
        let instructions = both(callgrind).map(|tool| count(tool, "Collected :"));
        let bytes = both(dhat).map(|tool| count(tool, "Total:"));
        let images = [&full_exr, &only_exr].map(|file| fs::read(file).expect("an image"));
        assert!(images[0] == images[1], "{}: the images differ", case.name);
        counted.push((f64::from(width * height * case.samples), instructions, bytes));
    }
    let rays = counted[1].0 - counted[0].0;
    let slope = |program: usize| (counted[1].1[program] - counted[0].1[program]) / rays;
    let grown = |program: usize| (counted[1].2[program] - counted[0].2[program]) / rays;
    let once = |program: usize| counted[0].1[program] - slope(program) * counted[0].0;
    let ratio = slope(0) / slope(1);
    println!(
        "{}: {:.1} instructions a camera ray with every stage on offer, {:.1} with what it needs: {ratio:.4} times; \
         {:.2} and {:.2} bytes allocated a camera ray; images equal to the bit; once a run {:.1} million instructions \
         more",
        case.name,
        slope(0),
        slope(1),
        grown(0),
        grown(1),
        (once(0) - once(1)) / 1e6,
    );
    ratio
}

fn callgrind() -> Command {
    let mut tool = Command::new("valgrind");
    tool.args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]).env_clear();
    tool
}

fn dhat() -> Command {
    let mut tool = Command::new("valgrind");
    tool.args(["--tool=dhat", "--dhat-out-file=/dev/null"]).env_clear();
    tool
}

/// Runs a program under valgrind and reads the number after a word of what it says.
fn count(mut tool: Command, word: &str) -> f64 {
    let output = tool.output().expect("valgrind runs");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{said}");
    let line = said.lines().find_map(|line| line.split_once(word)).expect("a count").1;
    let digits: String = line.trim().chars().take_while(|c| c.is_ascii_digit() || *c == ',').collect();
    digits.replace(',', "").parse().expect("a number")
}
