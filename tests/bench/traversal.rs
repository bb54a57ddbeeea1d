//! Rays a second through the hierarchy of a mesh, beside Embree's on the same rays in the same run:
//! `cargo bench --bench traversal -- --rays FOLDER --embree PROGRAM`.
//!
//! FOLDER holds the ray sets that `raysets.py` of the peers writes, PROGRAM is their `embree_bench.cpp`; without the
//! latter only pinhole is timed.
//! Rounds of both alternate, each in one thread, by processor time; a ratio is the median of the rounds' ratios, its interval the least and
//! the most.

#![allow(clippy::print_stdout, reason = "a benchmark's product is what it prints")]

use cpu_time::ProcessTime;
use pinhole::intersect::NO_SHAPE;
use pinhole::models::TriangleMesh;
use pinhole::scene::{MeshGeometry, MeshInstance, Placement};
use pinhole::shapes::{ClosestHits, MeshHierarchy, PlacedMesh, RaySlices, Shape};
use pinhole_lab::measure::specimen::Specimen;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

const MESHES: [&str; 2] = ["mesh100k", "mesh1m"];
const SETS: [&str; 3] = ["primary", "random", "bounce"];
/// The rays that a stage gets at once.
const BATCH: usize = 1024;

/// Hits and mean t that every renderer must find; from the peers' README.
const ORACLE: [(&str, &str, u64, f64); 6] = [
    ("mesh100k", "primary", 464_936, 8.31775),
    ("mesh100k", "random", 458_540, 0.89946),
    ("mesh100k", "bounce", 90_359, 1.21887),
    ("mesh1m", "primary", 466_205, 8.31695),
    ("mesh1m", "random", 459_139, 0.89908),
    ("mesh1m", "bounce", 92_142, 1.20714),
];

struct Options {
    rays: PathBuf,
    embree: Option<PathBuf>,
    rounds: usize,
    meshes: Vec<String>,
}

fn options() -> Options {
    let mut options = Options { rays: "rays".into(), embree: None, rounds: 3, meshes: MESHES.map(String::from).into() };
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        let mut value = || words.next().unwrap_or_else(|| panic!("{word} needs a value"));
        match word.as_str() {
            "--rays" => options.rays = value().into(),
            "--embree" => options.embree = Some(value().into()),
            "--rounds" => options.rounds = value().parse().expect("a number of rounds"),
            "--meshes" => options.meshes = value().split(',').map(String::from).collect(),
            "--bench" => {}
            _ => panic!("{word} is unknown: --rays FOLDER, --embree PROGRAM, --rounds N, --meshes A,B"),
        }
    }
    options
}

fn words_of(file: &Path) -> Vec<u32> {
    let bytes = std::fs::read(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    bytes.chunks_exact(4).map(|word| u32::from_le_bytes(word.try_into().expect("four bytes"))).collect()
}

fn floats_of(file: &Path) -> Vec<f32> {
    words_of(file).into_iter().map(f32::from_bits).collect()
}

fn mesh_of(folder: &Path, name: &str) -> TriangleMesh {
    let positions = floats_of(&folder.join(format!("{name}.v")));
    let triangles = words_of(&folder.join(format!("{name}.f")));
    TriangleMesh {
        positions: positions.chunks_exact(3).map(|at| [at[0], at[1], at[2]]).collect(),
        triangles: triangles.chunks_exact(3).map(|of| [of[0], of[1], of[2]]).collect(),
        ..TriangleMesh::default()
    }
}

/// Rays as the columns of a tile hold them.
struct Rays {
    components: [Vec<f32>; 6],
}

impl Rays {
    fn of(file: &Path) -> Self {
        let numbers = floats_of(file);
        Self { components: [0, 1, 2, 3, 4, 5].map(|at| numbers.iter().skip(at).step_by(6).copied().collect()) }
    }

    fn len(&self) -> usize {
        self.components[0].len()
    }
}

/// What tracing a set found, and in what time.
struct Traced {
    hits: u64,
    mean_t: f64,
    seconds: f64,
}

fn trace(mesh: &PlacedMesh, rays: &Rays, any: bool) -> Traced {
    let mut t = vec![f64::INFINITY; rays.len()];
    let mut shape = vec![NO_SHAPE; rays.len()];
    let mut primitive = vec![0; rays.len()];
    let start = ProcessTime::now();
    for first in (0..rays.len()).step_by(BATCH) {
        let rows = first..rays.len().min(first + BATCH);
        let [ox, oy, oz, dx, dy, dz] = rays.components.each_ref().map(|component| &component[rows.clone()]);
        let slices = RaySlices { origin: [ox, oy, oz], direction: [dx, dy, dz] };
        let primitive = (!any).then(|| &mut primitive[rows.clone()]);
        let hits = ClosestHits { t: &mut t[rows.clone()], shape: &mut shape[rows], primitive, any };
        PlacedMesh::keep_closest((std::slice::from_ref(mesh), &()), &[0], slices, hits);
    }
    let seconds = start.elapsed().as_secs_f64();
    let found = t.iter().zip(&shape).filter(|(_, shape)| **shape != NO_SHAPE);
    let (hits, sum) = found.fold((0, 0.0), |(hits, sum), (t, _)| (hits + 1, sum + t));
    Traced { hits, mean_t: sum / hits as f64, seconds }
}

/// What Embree prints, by a key such as `random closest 1`, in million rays a second; and its build in milliseconds.
fn embree(program: &Path, folder: &Path, mesh: &str) -> BTreeMap<String, f64> {
    let run = Command::new(program).arg(folder).arg(mesh).arg("1").env("EMBREE_ROBUST", "1").output();
    let text = String::from_utf8(run.expect("Embree runs").stdout).expect("text");
    let mut found = BTreeMap::new();
    for line in text.lines() {
        let field = |name: &str| {
            let at = line.split(' ').find_map(|word| word.strip_prefix(name));
            at.unwrap_or_default().to_owned()
        };
        if line.starts_with("RAYS") {
            let kind = if line.contains(" any ") { "any" } else { "closest" };
            let rate = field("cpuMrays/s=").parse().expect("a rate");
            found.insert(format!("{} {kind} {}", field("set="), field("width=")), rate);
        } else if line.starts_with("BUILD") && line.contains("quality=medium") {
            found.insert("build".into(), field("cpu_ms=").parse().expect("milliseconds"));
        }
    }
    found
}

fn median(numbers: &mut [f64]) -> (f64, f64, f64) {
    numbers.sort_by(f64::total_cmp);
    (numbers[numbers.len() / 2], numbers[0], numbers[numbers.len() - 1])
}

fn main() {
    let options = options();
    for name in &options.meshes {
        let geometry = MeshGeometry::new(mesh_of(&options.rays, name));
        let sets = SETS.map(|set| (set, Rays::of(&options.rays.join(format!("{name}.{set}")))));
        let mut rates: BTreeMap<String, Vec<f64>> = BTreeMap::new();
        let mut ratios: BTreeMap<String, Vec<f64>> = BTreeMap::new();
        for round in 0..=options.rounds {
            let start = ProcessTime::now();
            let hierarchy = MeshHierarchy::of(&geometry);
            let build = 1e3 * start.elapsed().as_secs_f64();
            let triangles = geometry.triangles.len() as f64;
            let component = MeshInstance { geometry: geometry.clone() };
            let mesh = Specimen::<PlacedMesh>::of(component, Placement::default()).expect("a mesh").shape;
            if round == 0 {
                println!("{name}: {:.1} bytes a triangle in the hierarchy", hierarchy.bytes() as f64 / triangles);
            }
            let mut own = BTreeMap::from([("build".to_owned(), build)]);
            for (set, rays) in &sets {
                for any in [false, true] {
                    let traced = trace(&mesh, rays, any);
                    let kind = if any { "any" } else { "closest" };
                    own.insert(format!("{set} {kind}"), rays.len() as f64 / traced.seconds / 1e6);
                    if round == 0 {
                        check(name, set, any, &traced);
                    }
                }
            }
            // The first round only warms up.
            if round == 0 {
                continue;
            }
            let other = options.embree.as_ref().map(|program| embree(program, &options.rays, name)).unwrap_or_default();
            for (what, rate) in own {
                for width in ["1", "8"] {
                    let key = if what == "build" { what.clone() } else { format!("{what} {width}") };
                    let ratio = other.get(&key).map(|theirs| rate / theirs);
                    let shown = if width == "1" { what.clone() } else { format!("{what}, packets of 8") };
                    if let Some(ratio) = ratio.filter(|_| width == "1" || what.starts_with("primary")) {
                        ratios.entry(shown).or_default().push(ratio);
                    }
                }
                rates.entry(what).or_default().push(rate);
            }
        }
        for (what, mut rates) in rates {
            let (rate, min, max) = median(&mut rates);
            let unit = if what == "build" { "ms" } else { "million rays a second" };
            print!("{name} {what}: {rate:.2} [{min:.2}, {max:.2}] {unit}");
            for (over, shown) in [("", "Embree's single rays"), (", packets of 8", "Embree's packets of 8")] {
                if let Some(ratios) = ratios.get_mut(&format!("{what}{over}")) {
                    let (ratio, min, max) = median(ratios);
                    let shown = if what == "build" { "Embree's build" } else { shown };
                    print!(", {ratio:.2} [{min:.2}, {max:.2}] of {shown}");
                }
                if what == "build" {
                    break;
                }
            }
            println!();
        }
    }
}

fn check(name: &str, set: &str, any: bool, traced: &Traced) {
    let Some(&(.., hits, mean_t)) = ORACLE.iter().find(|oracle| (oracle.0, oracle.1) == (name, set)) else { return };
    let kind = if any { "any" } else { "closest" };
    let apart = traced.hits.abs_diff(hits);
    println!("{name} {set} {kind}: {} hits, {apart} apart from the oracle, mean t {:.5}", traced.hits, traced.mean_t);
    assert!(apart <= 2, "{name} {set} {kind}: {} hits, but the oracle has {hits}", traced.hits);
    assert!(any || (traced.mean_t - mean_t).abs() < 3e-5, "{name} {set}: mean t {}, not {mean_t}", traced.mean_t);
}
