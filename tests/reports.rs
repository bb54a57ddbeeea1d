//! Each chapter's kept report has the errors of today's film, says when it was measured, and is small.

use pinhole::scene::{Background, Integrator, LightStrategy, PerspectiveCamera, Rgb};
use pinhole_cli::command::{has_report, outdated_methods, outdated_report};
use pinhole_lab::report::kept::{LARGEST, kept, place};
use std::fs;
use std::path::Path;

#[test]
fn reports_are_of_the_film_that_chapters_make() {
    let (all, mut wrong, mut looked) = (chapters::all(), Vec::new(), 0);
    for chapter in all.iter().filter(|chapter| has_report(chapter)) {
        looked += 1;
        let why = outdated_report(&all, chapter).expect("it renders");
        wrong.extend(why.map(|why| format!("{}: {why}", chapter.name)));
        let Ok(report) = kept(chapter.name) else { continue };
        let short = place(chapter.name).display().to_string();
        let bytes = fs::metadata(Path::new(env!("CARGO_MANIFEST_DIR")).join(&short)).map_or(0, |file| file.len());
        assert!(report.name == chapter.name && bytes <= LARGEST as u64, "{short}: {bytes} bytes");
        assert!(report.provenance.profile == "release" && !report.provenance.date.is_empty(), "{short}: when?");
    }
    wrong.extend(outdated_methods(&all).expect("they render"));
    let anew = "cargo run --release -- measure";
    assert!(wrong.is_empty(), "{};\nto measure anew, on a quiet machine: {anew}", wrong.join(",\n"));
    eprintln!("reports: the errors of {looked} kept reports are of today's film");
}

#[test]
fn a_film_that_differs_asks_for_measuring() {
    let mut all = chapters::all();
    let at = all.iter().position(|own| own.name == "18_error_and_time").expect("the chapter");
    all[at] = all[at].clone().with_scene(|world| {
        world.spawn(PerspectiveCamera::default());
        world.spawn(Background { colour: Rgb::grey(0.5) });
    });
    let why = outdated_report(&all, &all[at]).expect("it renders");
    assert_eq!(why.as_deref(), Some("the errors of 18_error_and_time are of another film"));
}

#[test]
fn curves_of_another_film_ask_for_measuring() {
    let mut all = chapters::all();
    let at = all.iter().position(|own| own.name == "39_both_ends").expect("the chapter");
    all[at] = all[at].clone().with_scene(|world| {
        let integrator = Integrator::Path { max_depth: 4, lights: LightStrategy::default(), roulette: 5 };
        world.spawn((PerspectiveCamera::default(), integrator));
        world.spawn(Background { colour: Rgb::grey(0.5) });
    });
    let why = outdated_methods(&all).expect("it renders");
    assert_eq!(why.as_deref(), Some("the curve of bidirectional_path_tracing in keyhole is of another film"));
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
