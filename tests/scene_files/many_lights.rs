//! Ten thousand lights: the memory does not grow with them, and they are as bright as all of them together.

use super::hostile::run_within;
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::image_file::read_numbers;
use std::f64::consts::PI;
use std::fmt::Write;
use std::fs;

const LIGHTS: u64 = 10_000;
const SIDE: usize = 128;
/// The blocks that are compared, a side in pixels.
const BLOCK: usize = 16;

/// A floor from above, and lights over it, by sixteen threads in 6 GB of address space.
///
/// Each pixel's truth is the sum over all lights at its centre.
#[test]
fn ten_thousand_point_lights_need_no_more_memory_than_one() {
    let mut draws = Draws::new(4400, 0);
    let lights: Vec<([f64; 3], f64)> = (0..LIGHTS)
        .map(|_| {
            let at = [draws.between(-4.0, 4.0), draws.between(0.3, 2.0), draws.between(-4.0, 4.0)];
            (at, draws.power_of_ten(-5.0, -3.0))
        })
        .collect();
    let mut scene = format!(
        "[(name: \"eye\", orthographic_camera: (view_height: 6), resolution: (width: {SIDE}, height: {SIDE}), \
         look_at: (eye: (0, 5, 0), target: (0, 0, 0), up: (0, 0, -1)), sampling: (samples: 16, filter: Box(radius: 0.5))), \
         (name: \"floor\", plane: (), matte: (colour: (0.5, 0.5, 0.5)))"
    );
    for ([x, y, z], intensity) in &lights {
        let colour = format!("({intensity}, {intensity}, {intensity})");
        write!(scene, ", (placement: (position: ({x}, {y}, {z})), point_light: (intensity: {colour}))").expect("text");
    }
    scene.push(']');
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("scene.ron"), scene).expect("written");
    let words = ["render", "scene.ron", "-q", "--threads", "16", "-o", "a.exr"];
    let (ended, said) = run_within(folder.path(), "6000000", &words);
    assert_eq!(ended, Some(0), "{said}");

    let told = read_numbers(&folder.path().join("a.exr")).expect("an image");
    let centre = |at: usize| 6.0 * ((at as f64 + 0.5) / SIDE as f64 - 0.5);
    let truth = |row: usize, column: usize| -> f64 {
        let (x, z) = (centre(column), centre(row));
        let brings = |([lx, ly, lz], intensity): &([f64; 3], f64)| {
            let squared = (lx - x) * (lx - x) + ly * ly + (lz - z) * (lz - z);
            intensity * ly / (squared * squared.sqrt())
        };
        0.5 / PI * lights.iter().map(brings).sum::<f64>()
    };
    let (mut worst, mut blocks, mut noise) = (0.0_f64, 0, 0.0);
    for start in (0..SIDE * SIDE).step_by(BLOCK).filter(|start| (start / SIDE).is_multiple_of(BLOCK)) {
        let (top, left) = (start / SIDE, start % SIDE);
        let pixels = (top..top + BLOCK).flat_map(|row| (left..left + BLOCK).map(move |column| (row, column)));
        let off: Vec<f64> =
            pixels.map(|(row, column)| told.pixels[row * SIDE + column][0] / truth(row, column) - 1.0).collect();
        let n = off.len() as f64;
        let mean = off.iter().sum::<f64>() / n;
        let variance = off.iter().map(|off| (off - mean) * (off - mean)).sum::<f64>() / (n - 1.0);
        // A pixel's mean differs from its centre by the light's curvature, a ten thousandth.
        let deviation = mean / (variance / n).sqrt().max(1e-4);
        (worst, blocks, noise) = (worst.max(deviation.abs()), blocks + 1, noise + variance.sqrt());
    }
    eprintln!(
        "{LIGHTS} lights: {blocks} blocks, worst {worst:.1} standard errors, noise {:.1} % at 16 samples",
        100.0 * noise / f64::from(blocks)
    );
    // The least likely of 64, 999 times in 1000.
    assert!(worst < 4.3, "{worst}");
}
