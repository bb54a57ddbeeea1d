//! Each chapter's kept report was measured with the sources as they are, and is small.

use pinhole_cli::command::has_report;
use pinhole_lab::report::kept::{LARGEST, kept, made_from, place};
use std::fs;
use std::path::Path;

#[test]
fn reports_are_of_the_present_sources() {
    let (mut wrong, mut looked) = (Vec::new(), 0);
    for chapter in chapters::all().iter().filter(|chapter| has_report(chapter)) {
        looked += 1;
        let short = place(chapter.name).display().to_string();
        let bytes = fs::metadata(Path::new(env!("CARGO_MANIFEST_DIR")).join(&short)).map_or(0, |file| file.len());
        match kept(chapter.name) {
            Err(missing) => wrong.push(missing.to_string()),
            Ok(report) if report.made_from != made_from(chapter.name).expect("the sources are here") => {
                wrong.push(format!("{short} was measured with other sources than the present ones"));
            }
            Ok(report) => assert!(report.name == chapter.name && bytes <= LARGEST as u64, "{short}: {bytes} bytes"),
        }
    }
    assert!(
        wrong.is_empty(),
        "{};\nto measure anew, on a quiet machine: cargo run --release -- report all --write",
        wrong.join(",\n")
    );
    eprintln!("reports: {looked} kept reports are of the present sources");
}

/// A method without variance paints the same picture with every seed: one that is black, most likely.
#[test]
fn every_reported_method_has_some_variance() {
    let (mut looked, mut dead) = (0, Vec::new());
    for chapter in chapters::all().iter().filter(|chapter| has_report(chapter)) {
        let short = place(chapter.name).display().to_string();
        let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(&short)).expect("a kept report");
        let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        for variant in report["variants"].as_array().expect("variants") {
            looked += 1;
            let levels = variant["levels"].as_array().expect("levels");
            let variance = |level: &serde_json::Value| level["variance"]["value"][1].as_f64().unwrap_or(0.0);
            if !levels.iter().any(|level| variance(level) > 0.0) {
                dead.push(format!("{short}: {}", variant["name"]));
            }
        }
    }
    assert!(looked > 20 && dead.is_empty(), "of {looked}, without variance: {}", dead.join(", "));
    eprintln!("reports: {looked} methods, each with variance");
}
