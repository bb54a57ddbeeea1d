//! What pages 22 and 25 say of rays to the sky and of light paths, from closed forms and sums.

use super::page_says;
use pinhole::film::{Curve, byte_from_linear};
use pinhole_lab::naive::path::{
    light_of_capped_path, uniform_direction, uniform_weight, weight_without_cosine, weight_without_pi,
};
use std::path::Path;

/// Slices of the hemisphere, or rings of the disk.
const SLICES: u32 = 1_000_000;

/// Mean and variance of what a ray counts whose direction's height is drawn so, where it sees the sky by its height and
/// the fraction of turns at which nothing else is in the way.
fn mean_and_variance(counts: impl Fn(f64) -> f64, turns: f64) -> [f64; 2] {
    let (mut mean, mut square) = (0.0, 0.0);
    for slice in 0..SLICES {
        let count = counts((f64::from(slice) + 0.5) / f64::from(SLICES));
        mean += turns * count / f64::from(SLICES);
        square += turns * count * count / f64::from(SLICES);
    }
    [mean, square - mean * mean]
}

#[test]
fn directions_vary_as_page_22_says() {
    let page = "22_ambient_occlusion.md";
    let mut ratio = 0.0;
    for (name, open, lowest, turns) in [
        ("nothing", "1", 1.0, 1.0),
        ("an endless wall, straight up", "0.5", 1.0, 0.5),
        ("a ball overhead, $r/h = 0.8$", "0.36", 0.6, 1.0),
    ] {
        let seen = |height: f64| f64::from(u8::from(height < lowest));
        let uniform = |u: f64| {
            let height = uniform_direction([u, 0.0])[2];
            seen(height) * uniform_weight(1.0, height)
        };
        let [of_uniform, of_cosine] =
            [mean_and_variance(uniform, turns), mean_and_variance(|u| seen((1.0 - u).sqrt()), turns)];
        let expected: f64 = open.parse().expect("a number");
        assert!((of_uniform[0] - expected).abs() < 1e-5 && (of_cosine[0] - expected).abs() < 1e-5, "{name}");
        let [uniform, cosine_weighted] = [of_uniform[1], of_cosine[1]].map(f64::abs);
        page_says(page, &format!("| {name} | {open} | {uniform:.3} | {cosine_weighted:.3} |"));
        if turns < 1.0 {
            ratio = uniform / cosine_weighted;
        }
    }
    page_says(page, &format!("needs {ratio:.1} times the rays"));
    let [plain, _] = mean_and_variance(|u| f64::from(u8::from(uniform_direction([u, 0.0])[2] < 0.6)), 1.0);
    page_says(page, &format!("$\\sqrt{{1 - 0.64}} = {plain:.1}$, instead of 0.36"));
}

#[test]
fn a_cap_loses_what_page_25_says() {
    let page = "25_path_tracing.md";
    let left = |albedo: f64| light_of_capped_path(albedo, 64) * (1.0 - albedo);
    page_says(page, &format!("{:.3} of the light is left. At 0.9999 it is {:.4}.", left(0.99), left(0.9999)));
}

#[test]
fn factors_too_many_are_what_page_25_says() {
    let page = "25_path_tracing.md";
    page_says(page, &format!("twice what it may, {:.1}.", weight_without_cosine(0.8)));
    page_says(page, &format!("$0.8\\,\\pi = {:.2}$", weight_without_pi(0.8)));
    let once = byte_from_linear(0.5, Curve::Srgb);
    let twice = byte_from_linear(f32::from(once) / 255.0, Curve::Srgb);
    page_says(page, &format!("half the light is byte {once}, and twice encoded {twice}"));
}

/// The errors at 256 samples are those of the report that is kept beside the chapter.
#[test]
fn the_table_of_page_26_is_its_report() {
    let kept =
        std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("chapters/26_choosing_samples/report.json"));
    let report: serde_json::Value = serde_json::from_str(&kept.expect("a report")).expect("JSON");
    let of = |variant: usize| {
        let level = &report["variants"][variant]["levels"][4];
        assert_eq!(level["samples"], 256);
        [&level["mse"]["value"][1], &level["rel_mse"]].map(|error| four_digits(error.as_f64().expect("a number")))
    };
    let comparisons = report["comparisons"].as_array().expect("comparisons");
    let times = |variant: &str, at: &str| {
        // The last is that of the most samples, or of the longest time.
        let last = comparisons.iter().rfind(|one| one["variant"] == variant && one["at"].get(at).is_some());
        let [low, ratio, high] =
            [0, 1, 2].map(|part| last.expect(at)["mse"]["value"][part].as_f64().expect("a number"));
        let decimals = usize::from(ratio < 10.0);
        format!("{ratio:.decimals$} ({low:.decimals$} to {high:.decimals$})")
    };
    let [mse, relative] = of(0);
    page_says("26_choosing_samples.md", &format!("| MIS | {mse} | 1 | 1 | {relative} | 1 |"));
    for (variant, (name, word)) in [("BSDF sampling", "bsdf"), ("light sampling", "light")].into_iter().enumerate() {
        let ([own, own_relative], [samples, seconds]) =
            (of(variant + 1), ["samples", "seconds"].map(|at| times(word, at)));
        let relative = format!("{own_relative} | {{{{= {own_relative}/{relative} : 0}}}}");
        page_says("26_choosing_samples.md", &format!("| {name} | {own} | {samples} | {seconds} | {relative} |"));
    }
}

/// A number as reports print it.
fn four_digits(number: f64) -> String {
    let decimals = (3 - number.log10().floor() as i32).max(0) as usize;
    format!("{number:.decimals$}")
}
