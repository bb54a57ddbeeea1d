//! The extremes with few rays: the very code that `cargo run --release -- extremes` runs with many.

use bevy_ecs::prelude::*;
use glam::Vec3;
use pinhole::intersect::Hits;
use pinhole::plan::{Evidence, Stage, TileSystems};
use pinhole::shade::Radiance;
use pinhole::{Chapter, Overrides};
use pinhole_lab::measure::extremes::{Group, Outcome, try_group, unbroken};
use pinhole_lab::measure::oracle_plane::{Plane, enclosed_plane_t, plane_hit};
use pinhole_lab::measure::oracle_sphere::{Roots, Sphere, enclosed_line_ts, enclosed_sphere_t, line_roots, sphere_hit};
use pinhole_lab::measure::ray_aim::{self, AimedRay};
use pinhole_lab::measure::sweep::sweep;
use std::fs;

/// Tries a group, prints its table, and asks that pinhole holds everywhere and each naive method breaks somewhere.
fn holds(group: Group, rays: u64) {
    let cases = try_group(group, "", rays, &());
    // Longer lines of a table would be broken on a page of the book.
    let fits = |line: &str| line.chars().count() <= 84;
    assert!(group.heading().lines().last().is_some_and(fits), "{}", group.heading());
    for case in &cases {
        eprint!("{case}");
        let wide = case.outcomes.iter().map(Outcome::to_string).find(|line| !fits(line));
        assert_eq!(wide, None, "a line of a table is wider than a page of the book");
        assert!(case.held(), "pinhole does not hold in:\n{case}");
        assert!(case.rays > 0, "nothing was tried in {}", case.name);
        let too_long = case.to_string().lines().find(|line| line.chars().count() > 100).map(String::from);
        assert_eq!(too_long, None, "a line is longer than a page is wide");
    }
    assert_eq!(unbroken(&cases), Vec::<&str>::new(), "these prove nothing, for no case breaks them");
    let tried: u64 = cases.iter().map(|case| case.rays).sum();
    eprintln!("{group}: {} cases, {tried} rays", cases.len());
}

#[test]
fn rays_at_every_shape_hold() {
    holds(Group::Shapes, 512);
}

#[test]
fn shadow_rays_hold() {
    holds(Group::Shadow, 2048);
}

#[test]
fn cameras_hold() {
    holds(Group::Camera, 2048);
}

#[test]
fn transforms_hold() {
    holds(Group::Transform, 2048);
}

#[test]
fn materials_hold() {
    holds(Group::Material, 2048);
}

#[test]
fn textures_hold() {
    holds(Group::Texture, 1024);
}

#[test]
fn triangles_hold() {
    holds(Group::Triangle, 2048);
}

#[test]
fn samples_hold() {
    holds(Group::Sampling, 4096);
}

#[test]
fn films_hold() {
    holds(Group::Film, 256);
}

#[test]
fn lights_hold() {
    holds(Group::Light, 2048);
}

#[test]
fn lenses_hold() {
    holds(Group::Lens, 1024);
}

#[test]
fn lights_with_an_area_hold() {
    holds(Group::Emitter, 1024);
}

#[test]
fn light_paths_hold() {
    holds(Group::Transport, 2048);
}

#[test]
fn results_do_not_depend_on_threads() {
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| try_group(Group::Triangle, "", 3000, &()))
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn a_method_that_misses_would_be_seen() {
    let mut cases = try_group(Group::Triangle, "", 512, &());
    let first: &mut Outcome = &mut cases[0].outcomes[0];
    first.score.check(false);
    assert!(!cases[0].held() && cases[1].held());
}

/// The rays of the cases, and beside them those that touch: exact tangents, starts on the surface, planes edge on.
fn aimed_at_spheres(index: u64) -> Vec<(AimedRay, Sphere)> {
    let touching = |origin: Vec3, direction: Vec3, sphere: Sphere| (AimedRay { origin, direction }, sphere);
    let unit = Sphere { centre: glam::DVec3::new(0.0, 0.0, -3.0), radius: 1.0 };
    let step = f32::from_bits(1.0_f32.to_bits() + index as u32 % 3 - 1);
    vec![
        ray_aim::silhouette(91, index, 1e3),
        ray_aim::silhouette(92, index, 1e7),
        ray_aim::horizon(93, index, 1e8, 1e-2),
        ray_aim::tangent(94, index, 1.0, 1.5),
        ray_aim::centre(95, index, 1.0, 1e5),
        ray_aim::sphere_of_any_size(96, index),
        ray_aim::seen_sphere_of_any_size(97, index),
        touching(Vec3::X * step, Vec3::NEG_Z, unit),
        touching(Vec3::Z * -2.0 * step, Vec3::Z, unit),
        touching(Vec3::new(0.6 * step, 0.8, 0.0), Vec3::NEG_Z, unit),
        touching(Vec3::ZERO, Vec3::ZERO, unit),
    ]
}

#[test]
fn enclosures_tell_what_exact_arithmetic_tells() {
    const INPUTS: u64 = 3000;
    let bits = |t: Option<f64>| t.map(f64::to_bits);
    let (mut told, mut untold) = (0, 0);
    let mut compare = |enclosed: Option<Option<u64>>, exact: Option<u64>, what: &str| match enclosed {
        None => untold += 1,
        Some(enclosed) => {
            assert_eq!(enclosed, exact, "{what}");
            told += 1;
        }
    };
    for index in 0..INPUTS {
        for (ray, sphere) in aimed_at_spheres(index) {
            let AimedRay { origin, direction } = ray;
            let what = format!("{ray:?}, {sphere:?}");
            let exact = sphere_hit(origin, direction, sphere).map(|t| t.to_f64());
            compare(enclosed_sphere_t(origin, direction, sphere).map(bits), bits(exact), &what);
            let exact = line_roots(origin, direction, sphere).map(|Roots { near, far }| [near.to_f64(), far.to_f64()]);
            let [near, far] = [0, 1].map(|root| exact.map(|roots| roots[root].to_bits()));
            let enclosed = enclosed_line_ts(origin, direction, sphere);
            compare(enclosed.map(|ts| bits(ts.map(|ts| ts[0]))), near, &what);
            compare(enclosed.map(|ts| bits(ts.map(|ts| ts[1]))), far, &what);
        }
        for (flattest, edge_on) in [(0.0, false), (4.0, false), (12.0, false), (0.0, true)] {
            let (ray, plane) = ray_aim::plane_of_any_offset(98, index, flattest);
            let normal = if edge_on { Vec3::X } else { plane.normal.as_vec3() };
            let plane = Plane { normal: normal.as_dvec3(), ..plane };
            let direction = if edge_on { Vec3::Y } else { ray.direction };
            let exact = plane_hit(ray.origin, direction, plane).map(|t| t.to_f64());
            compare(
                enclosed_plane_t(ray.origin, direction, plane).map(bits),
                bits(exact),
                &format!("{ray:?}, {plane:?}"),
            );
        }
    }
    eprintln!("enclosures: {told} answers equal exact arithmetic to the last bit, {untold} left to it, 0 disagree");
    assert!(untold * 10 < told, "exact arithmetic has too much left to do");
}

fn chapter(name: &str) -> Chapter {
    chapters::all().into_iter().find(|chapter| chapter.name == name).expect("a chapter of this name")
}

#[test]
fn sweeps_of_chapters_hold() {
    let drawn = ["23_depth_of_field", "26_choosing_samples"];
    for name in ["10_light_and_shadow", "02_ray", "03_hit", "04_orthographic", "05_pinhole"].into_iter().chain(drawn) {
        let chapter = chapter(name);
        let lines = sweep(&|| chapter.world(&Overrides::default()), &chapter.stages(), &()).expect("sweeps");
        for line in &lines {
            assert!(line.held, "{name}: {line}");
            assert!(line.to_string().chars().count() <= 132, "{line}");
        }
        eprintln!("sweep: {} lines of {name}, all held", lines.len());
    }
}

/// Light that depends on a length of its own.
fn add_fog(mut tiles: Query<(&Hits, &mut Radiance)>) {
    for (hits, mut radiance) in &mut tiles {
        for row in 0..hits.t.len() {
            radiance.rgb[0][row] += if hits.t[row] < 7.0 { 0.25 } else { 0.0 };
        }
    }
}

#[test]
fn a_stage_with_a_length_of_its_own_does_not_survive_a_sweep() {
    let chapter = chapter("05_pinhole");
    let mut stages = chapter.stages();
    let fog = Stage::new("Add fog", TileSystems::Shade, add_fog);
    stages.push(fog.when(|_| Evidence::always("the test asks for it")));
    let lines = sweep(&|| chapter.world(&Overrides::default()), &stages, &()).expect("sweeps");
    let broken: Vec<String> = lines.iter().filter(|line| !line.held).map(ToString::to_string).collect();
    eprintln!("with fog: {}", broken.join("\n"));
    assert!(broken.iter().any(|line| line.starts_with("scaled")), "{broken:?}");
}

#[test]
fn the_page_needs_nothing_but_itself() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("extremes").join("index.html");
    let words = ["extremes", "shapes", "--case", "spheres:", "--rays", "256", "--page", &file.display().to_string()]
        .map(String::from);
    let mut said = Vec::new();
    pinhole_cli::command::run(&chapters::all(), &words, &mut said).expect("pinhole holds");
    let page = fs::read_to_string(&file).expect("the page");
    for outside in ["http:", "https:", "src=\"/", "<script", "url("] {
        assert!(!page.contains(outside), "the page asks for {outside}");
    }
    let pictures = page.matches("<img alt=\"").count();
    assert_eq!(pictures, page.matches("src=\"data:image/png;base64,").count());
    assert!(pictures >= 30 && page.contains("class=\"held\"") && page.contains("class=\"breaks\""));
    assert!(page.len() < 2_000_000, "{} bytes", page.len());
    eprintln!("page: {pictures} pictures in {} bytes", page.len());
}
