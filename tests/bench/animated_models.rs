//! pinhole beside three.js on animated glTF files: every corner of every triangle, at three times of every animation.
//!
//! `cargo bench --bench animated_models -- --models FOLDER --three FOLDER`: all `.gltf` and `.glb` files with animations
//! in the first folder and those below it; the second is the npm package `three`, of which `node` runs the loader.
//! It fails where a corner is further from that of three.js than 1e-5 of the model's size.

#![allow(clippy::print_stdout, reason = "a benchmark's product is what it prints")]

use pinhole::models::{Model, Moment, read_model_at};
use std::path::{Path, PathBuf};
use std::process::Command;

/// How far apart two corners may be, over the diagonal of the bounding box.
const APART: f64 = 1e-5;
/// The times, over the length of the animation.
const TIMES: [f64; 3] = [0.13, 0.5, 0.871];

type Point = [f64; 3];

fn main() {
    let words: Vec<String> = std::env::args().collect();
    let option = |name: &str| words.iter().position(|word| word == name).and_then(|at| words.get(at + 1));
    let (Some(models), Some(three)) = (option("--models"), option("--three")) else {
        println!("skipped: --models FOLDER and --three FOLDER are needed");
        return;
    };
    let mut files = Vec::new();
    files_in(Path::new(models), &mut files);
    files.sort();
    let (mut compared, mut read, mut all_agree) = (0, 0, true);
    for file in &files {
        let Ok(model) = read_at(file, None) else { continue };
        let animations = model.animations;
        read += usize::from(!animations.is_empty());
        for (number, animation) in animations.iter().enumerate() {
            let (mut worst, mut unread) = (0.0_f64, None);
            let said = TIMES.iter().try_for_each(|part| {
                let seconds = part * animation.seconds;
                let index = number.to_string();
                let own = read_at(file, Some(Moment { seconds, animation: Some(&index) }))?;
                match by_three(Path::new(three), file, &index, seconds) {
                    Ok(other) => {
                        worst = worst.max(apart(&triangles(&own), &other)?);
                        compared += 1;
                    }
                    Err(why) => unread = why.lines().find(|line| line.contains("Error")).map(str::to_owned),
                }
                Ok::<_, String>(())
            });
            let agree = said.is_ok() && worst <= APART;
            all_agree &= agree;
            let name = file.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            let said = said.err().map(|why| format!(", {why}")).unwrap_or_default();
            match unread {
                Some(why) => println!("{name}, animation {number}: three.js does not read it: {why}"),
                None => println!(
                    "{name}, animation {number} of {} s: {worst:.1e} of its size apart{said}",
                    animation.seconds
                ),
            }
        }
    }
    println!("{read} models with animations, compared {compared} times");
    assert!(compared > 0, "nothing was compared");
    assert!(all_agree, "three.js has some corners elsewhere");
}

fn files_in(folder: &Path, files: &mut Vec<PathBuf>) {
    for path in std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()) {
        if path.is_dir() {
            files_in(&path, files);
        } else if path.extension().is_some_and(|ending| ending == "gltf" || ending == "glb") {
            files.push(path);
        }
    }
}

fn read_at(file: &Path, moment: Option<Moment<'_>>) -> Result<Model, String> {
    let bytes = std::fs::read(file).map_err(|error| error.to_string())?;
    let folder = file.parent().unwrap_or(Path::new(""));
    let open = |name: &str| std::fs::read(folder.join(name)).map_err(|error| error.to_string());
    read_model_at(&file.to_string_lossy(), &bytes, moment, &open).map_err(|error| error.to_string())
}

/// The triangles of a model in the world.
fn triangles(model: &Model) -> Vec<[Point; 3]> {
    let mut all = Vec::new();
    for instance in &model.instances {
        let mesh = &model.meshes[instance.mesh];
        let placed = |at: [f32; 3]| instance.world_from_object.transform_point3(at.map(f64::from).into()).to_array();
        all.extend((0..mesh.triangles.len()).map(|triangle| mesh.corners(triangle).map(placed)));
    }
    all
}

fn by_three(three: &Path, file: &Path, animation: &str, seconds: f64) -> Result<Vec<[Point; 3]>, String> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bench/animated_models.mjs");
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let out = folder.path().join("corners");
    let mut command = Command::new("node");
    command.arg(script).arg(three).arg(file).arg(animation).arg(seconds.to_string()).arg(&out);
    let ran = command.output().map_err(|error| format!("node does not run: {error}"))?;
    let bytes = std::fs::read(&out).map_err(|_| String::from_utf8_lossy(&ran.stderr).into_owned())?;
    let numbers: Vec<f64> = bytes.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
    let points: Vec<Point> = numbers.as_chunks().0.to_vec();
    Ok(points.as_chunks().0.to_vec())
}

/// The greatest distance between corners over the size of the model: triangles come in the same order, and pinhole leaves
/// out those without an area.
fn apart(own: &[[Point; 3]], other: &[[Point; 3]]) -> Result<f64, String> {
    if own.is_empty() {
        return Err("pinhole has no triangles".into());
    }
    let points = || other.iter().flatten();
    let range = |axis: usize| {
        let [low, high] = [f64::min, f64::max].map(|of| points().map(|point| point[axis]).reduce(of).unwrap_or(0.0));
        high - low
    };
    let size = length([0, 1, 2].map(range)).max(f64::MIN_POSITIVE);
    let from = |a: Point, b: Point| length([0, 1, 2].map(|axis| a[axis] - b[axis])) / size;
    let of = |[a, b, c]: [Point; 3], [p, q, r]: [Point; 3]| {
        // Where a matrix mirrors, two corners change places.
        [[p, q, r], [p, r, q]]
            .map(|[p, q, r]| from(a, p).max(from(b, q)).max(from(c, r)))
            .into_iter()
            .fold(1.0, f64::min)
    };
    let mut rest = other.iter();
    let mut worst = 0.0_f64;
    for triangle in own {
        loop {
            let Some(next) = rest.next() else {
                return Err(format!("pinhole has {} triangles, three.js {}, and they differ", own.len(), other.len()));
            };
            let distance = of(*triangle, *next);
            if distance > APART && area(*next) <= 1e-12 * size * size {
                continue;
            }
            worst = worst.max(distance);
            break;
        }
    }
    Ok(worst)
}

fn area([a, b, c]: [Point; 3]) -> f64 {
    let [u, v] = [b, c].map(|corner| [0, 1, 2].map(|axis| corner[axis] - a[axis]));
    length([u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]])
}

fn length(vector: Point) -> f64 {
    vector.iter().map(|part| part * part).sum::<f64>().sqrt()
}
