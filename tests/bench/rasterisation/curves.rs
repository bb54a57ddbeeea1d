//! What a picture costs by projection and by rays: against triangles, against pixels, against lights.
//!
//! `--write` keeps the curves beside the chapter whose page shows them.
//! Each pair of pictures is timed in turns; a table has the least time of each, the intervals of their ratios are printed.

use super::interval::{cpu, interval};
use super::{KNOTS, SIZES, after, rendered, scene};
use bevy_ecs::prelude::*;
use pinhole::scene::*;
use pinhole::shapes::MeshHierarchy;
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::torus_knot::torus_knot;
use pinhole_lab::report::provenance::{Provenance, processor};
use std::fmt::Write;

const CHAPTER: &str = "34_both";

/// The mesh of the curves against pixels and lights: some 10⁵ triangles.
const KNOT: [u32; 2] = KNOTS[3];
/// Pictures 16 wide and 9 high, so many times, for 10⁴ to 2·10⁶ pixels.
const SCALES: [u32; 6] = [8, 15, 26, 47, 83, 120];
/// So many lights are summed at every surface; of more than those, one is chosen at random.
const SUMMED: [u32; 5] = [1, 4, 16, 32, 64];
const CHOSEN: [u32; 4] = [65, 128, 316, 1000];
const LIT_SIZE: [u32; 2] = [320, 180];

/// A table of milliseconds, a row for each count; NaN is not measured.
struct Curve {
    title: &'static str,
    columns: Vec<String>,
    rows: Vec<(u32, Vec<f64>)>,
    /// What it says in a sentence.
    told: String,
}

impl Curve {
    fn new(title: &'static str, columns: Vec<String>) -> Self {
        println!("{title}, milliseconds");
        Self { title, columns, rows: Vec::new(), told: String::new() }
    }

    /// The names of its columns, and a line for each row.
    fn text(&self) -> String {
        let mut text = format!("{:>9}", "count");
        self.columns.iter().for_each(|name| _ = write!(text, "  {name:>9}"));
        for (count, row) in &self.rows {
            _ = write!(text, "\n{count:>9}");
            for (value, name) in row.iter().zip(&self.columns) {
                let number = if value.is_nan() { "-".into() } else { format!("{value:.2}") };
                _ = write!(text, "  {number:>width$}", width = name.chars().count().max(9));
            }
        }
        text + "\n" + &self.told
    }
}

/// The least time of each of two pictures, in milliseconds; the interval of their ratio is printed.
fn pair(name: &str, worlds: [&World; 2]) -> [f64; 2] {
    worlds.iter().for_each(|world| _ = rendered(world, Some(1)));
    let (mut logs, mut times) = (Vec::new(), [f64::INFINITY; 2]);
    for _ in 0..after("--rounds", 5) {
        let pair = worlds.map(|world| 1e3 * cpu(&|| rendered(world, Some(1))).as_secs_f64());
        times = [0, 1].map(|which| times[which].min(pair[which]));
        logs.push((pair[0] / pair[1]).ln());
    }
    let (low, middle, high) = interval(&logs);
    println!("{name}: {:.2} ms and {:.2} ms, ratio {middle:.2} [{low:.2}, {high:.2}]", times[0], times[1]);
    times
}

/// A picture of the first hits by rays, and one by projection.
fn first_hits(name: &str, knot: [u32; 2], size: [u32; 2]) -> [f64; 2] {
    let world = |projects: bool| {
        let (mut world, camera) = scene(knot, size);
        let mut camera = world.entity_mut(camera);
        camera.insert(View { column: "hit".into() });
        if projects {
            camera.insert(Rasterisation);
        }
        world
    };
    pair(name, [&world(false), &world(true)])
}

/// Where two curves cross, between two counts on straight lines of logarithms.
fn crossing(rows: &[(u32, Vec<f64>)], [one, other]: [usize; 2]) -> Option<f64> {
    let ahead = |row: &(u32, Vec<f64>)| (f64::from(row.0).ln(), (row.1[one] / row.1[other]).ln());
    let pair = rows.windows(2).find(|pair| (ahead(&pair[0]).1 > 0.0) != (ahead(&pair[1]).1 > 0.0))?;
    let [(from, before), (to, behind)] = [ahead(&pair[0]), ahead(&pair[1])];
    Some((from + (to - from) * before / (before - behind)).exp())
}

/// Which of two columns takes less time, and up to where.
fn told(what: &str, rows: &[(u32, Vec<f64>)], [rays, projection]: [usize; 2]) -> String {
    let first = rows.first().is_some_and(|(_, row)| row[projection] < row[rays]);
    let faster = if first { "projection is faster than rays" } else { "rays are faster than projection" };
    match crossing(rows, [rays, projection]) {
        Some(count) => format!("{faster} up to {} {what}", rounded(count)),
        None => format!("{faster} throughout"),
    }
}

/// To two digits.
fn rounded(count: f64) -> f64 {
    let unit = libm::exp10(libm::floor(libm::log10(count)) - 1.0);
    libm::round(count / unit) * unit
}

fn by_triangles() -> Curve {
    let size = |[width, height]: [u32; 2]| format!("{width} × {height}");
    let both = |at| [format!("rays {}", size(at)), format!("projection {}", size(at))];
    let columns = SIZES.into_iter().flat_map(both).chain(["hierarchy".into()]).collect();
    let mut curve = Curve::new("triangles of a torus knot, first hits", columns);
    let max = after("--most", 2_000_000);
    for knot in KNOTS.into_iter().filter(|[along, around]| 2 * along * around <= max) {
        let count = 2 * knot[0] * knot[1];
        let times = SIZES.map(|at| first_hits(&format!("{count:8} triangles, {}", size(at)), knot, at));
        let mesh = MeshGeometry::new(torus_knot(knot[0], knot[1]));
        let built = (0..after("--rounds", 5)).map(|_| 1e3 * cpu(&|| MeshHierarchy::of(&mesh)).as_secs_f64());
        let row = times.as_flattened().iter().copied().chain([built.fold(f64::INFINITY, f64::min)]);
        curve.rows.push((count, row.collect()));
    }
    let at = |(number, at)| format!("{}: {}", size(at), told("triangles", &curve.rows, [2 * number, 2 * number + 1]));
    curve.told = SIZES.into_iter().enumerate().map(at).collect::<Vec<_>>().join("\n");
    curve
}

fn by_pixels() -> Curve {
    let mut curve =
        Curve::new("pixels, first hits of 102,400 triangles", ["rays", "projection"].map(Into::into).into());
    for scale in SCALES {
        let size = [16 * scale, 9 * scale];
        let count = size[0] * size[1];
        let times = first_hits(&format!("{count:8} pixels"), KNOT, size);
        curve.rows.push((count, times.into()));
    }
    curve.told = told("pixels", &curve.rows, [0, 1]);
    curve
}

/// A knot under so many point lights, which are as bright together as one.
fn lit(count: u32, casts_shadows: bool, projects: bool) -> World {
    let (mut world, camera) = scene(KNOT, LIT_SIZE);
    if projects {
        world.entity_mut(camera).insert(Rasterisation);
    }
    let mut draws = Draws::new(34, 0);
    for _ in 0..count {
        let direction = draws.unit_vector();
        let at = Placement::at(9.0 * direction.x, 4.0 + 9.0 * direction.y.abs(), 9.0 * direction.z);
        let intensity = Rgb::grey(900.0 / f64::from(count));
        world.spawn((PointLight { intensity, casts_shadows }, at));
    }
    world
}

fn by_lights() -> Curve {
    let columns = ["rays, each light", "projection, each light", "without shadows", "rays, one light"];
    let columns = columns.into_iter().chain(["projection, one light", "one, without shadows"]);
    let columns = columns.map(Into::into).collect();
    let mut curve = Curve::new("lights, lit picture of 102,400 triangles at 320 × 180", columns);
    for count in SUMMED.into_iter().chain(CHOSEN) {
        let shadowed = [&lit(count, true, false), &lit(count, true, true)];
        let [rays, projection] = pair(&format!("{count:4} lights, rays and projection"), shadowed);
        let [_, none] = pair(&format!("{count:4} lights, shadows and none"), [shadowed[1], &lit(count, false, true)]);
        let (times, missing) = ([rays, projection, none], [f64::NAN; 3]);
        let row = if SUMMED.contains(&count) { [times, missing] } else { [missing, times] };
        curve.rows.push((count, row.concat()));
    }
    curve
}

/// The curves; all of them are kept if they are asked for in full.
pub fn measure() {
    let curves = [by_triangles(), by_pixels(), by_lights()];
    let head = "milliseconds a picture, processor time of one thread, the least of several";
    let mut text = format!("{head}\n");
    for curve in &curves {
        _ = write!(text, "\n{}\n{}\n", curve.title, curve.text().trim_end());
    }
    _ = writeln!(text, "\nmachine: {}", processor());
    println!("{text}");
    if std::env::args().any(|word| word == "--write") {
        let measured = Provenance::now(String::new()).measured();
        let file = format!("{}/chapters/{CHAPTER}/curves.txt", env!("CARGO_MANIFEST_DIR"));
        std::fs::write(file, format!("{text}{measured}\n")).expect("the curves can be written");
    }
}
