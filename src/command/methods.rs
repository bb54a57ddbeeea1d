//! `methods`: each method that may find a scene's light renders it a few times, and one of them is chosen.

use super::error::{Error, Result};
use super::format::{Format, print_json};
use super::interrupt::EndsByItself;
use super::own_file::write_file;
use super::report::{Bar, METHODS, Rival, measure_one, rivals, size, variants};
use super::report_arguments::{ReportErrors, TryMethods};
use super::subject::Subject;
use bevy_ecs::prelude::*;
use pinhole::extract::{camera_entity, integrator_of};
use pinhole::plan::Census;
use pinhole::scene::{BidirectionalPathTracing, FileKind, LightTracing, PhotonMapping, read_file};
use pinhole::{Chapter, Overrides};
use pinhole_lab::report::pilot::{Choice, Found, choose, pilot, table};
use pinhole_lab::report::provenance::processor_and_caches;
use pinhole_lab::report::table::short;
use pinhole_lab::repository;
use serde::Serialize;
use std::fmt::Write as _;
use std::io::Write;

/// What is kept beside chapter 39, whose figure and next page show it.
pub(super) const KEPT: &str = "chapters/39_both_ends/curves.txt";

/// The scenes that stand there side by side, and the methods that have something to do in each; the first of them is the
/// scene's own, and its reference the others' too.
const SCENES: [(&str, &str, &[&str]); 4] = [
    ("keyhole", "39_both_ends", &["bidirectional_path_tracing", "path_tracing"]),
    (
        "pool",
        "tests/methods/pool.ron",
        &["photon_mapping", "path_tracing", "light_tracing", "bidirectional_path_tracing"],
    ),
    ("Cornell box", "tests/methods/cornell.ron", &["path_tracing", "bidirectional_path_tracing"]),
    ("Veach's plates", "tests/methods/veach.ron", &["path_tracing", "bidirectional_path_tracing"]),
];

const KEPT_CURVES: FileKind = FileKind { name: "kept curves", max: 1 << 20 };
/// What stands before the digests of a scene's films, one for each method.
const FILMS: &str = "films ";

fn asked_of(scene: &str, methods: &[&str]) -> ReportErrors {
    let against = methods[1..].iter().map(|method| format!("method={method}")).collect();
    ReportErrors { subject: scene.into(), against, quick: true, ..ReportErrors::default() }
}

/// Why what is kept is not of today's films, in a few words; none where it is.
///
/// Errors: what a render would be refused for.
pub fn outdated_methods(chapters: &[Chapter]) -> Result<Option<String>> {
    let kept = read_file(&repository().join(KEPT), KEPT_CURVES).unwrap_or_default();
    let kept = String::from_utf8_lossy(&kept);
    for (title, scene, methods) in SCENES {
        let kept = kept.lines().skip_while(|line| !line.starts_with(title)).find_map(|line| line.strip_prefix(FILMS));
        let kept: Vec<&str> = kept.into_iter().flat_map(str::split_whitespace).collect();
        let asked = asked_of(scene, methods);
        let (subject, rivals) = (Subject::find(chapters, scene)?, rivals(chapters, &asked.against)?);
        for (at, variant) in variants(&subject, &rivals, size(&subject, None)?)?.iter().enumerate() {
            if kept.get(at) != Some(&variant.film()?.as_str()) {
                return Ok(Some(format!("the curve of {} in {title} is of another film", methods[at])));
            }
        }
    }
    Ok(None)
}

/// Measures error against run time by each method on each scene, and what the pilot says, and keeps both.
pub(super) fn measure_methods(chapters: &[Chapter]) -> Result {
    let mut text = String::from("error against run time: relMSE, and milliseconds of processor time a picture\n");
    let mut pilots = Vec::new();
    let mut measured = String::new();
    for (title, scene, methods) in SCENES {
        let asked = asked_of(scene, methods);
        let report = measure_one(chapters, &asked, Format::Json, &mut std::io::sink())?.report;
        let _ = write!(text, "\n{title}, by {}\nsamples", asked.command_line());
        for method in methods {
            let _ = write!(text, "  {:>width$}  {method} ms", method, width = method.len());
        }
        for (level, samples) in report.ladder.samples.iter().enumerate() {
            let _ = write!(text, "\n{samples:>7}");
            for (variant, method) in report.variants.iter().zip(methods) {
                let level = &variant.levels[level];
                let numbers = [level.rel_mse, 1e3 * level.render.median.value].map(short);
                let _ =
                    write!(text, "  {:>w$}  {:>m$}", numbers[0], numbers[1], w = method.len(), m = method.len() + 3);
            }
        }
        let films: Vec<&str> = report.variants.iter().map(|variant| variant.film.as_str()).collect();
        let _ = writeln!(text, "\n{FILMS}{}", films.join(" "));
        measured = report.provenance.measured();
        let pilot = TryMethods { subject: scene.into(), samples: None, seeds: None, size: None, quick: false };
        print_methods(chapters, &pilot, Format::Text, &mut pilots)?;
        pilots.push(b'\n');
    }
    let _ = write!(text, "\n{}{}\n{measured}\n", String::from_utf8_lossy(&pilots), processor_and_caches());
    Ok(write_file(true, &repository().join(KEPT), text.as_bytes())?)
}

/// What the pilot found, as JSON has it.
#[derive(Serialize)]
struct Told<'a> {
    scene: &'a str,
    width: u32,
    height: u32,
    samples: u32,
    seeds: u32,
    methods: Vec<Row<'a>>,
    #[serde(flatten)]
    choice: Choice,
    ask: Option<String>,
}

#[derive(Serialize)]
struct Row<'a> {
    method: &'a str,
    #[serde(flatten)]
    found: &'a Found,
}

/// A line for each method, then which one to take, why, and how to ask for it.
///
/// Errors: a scene that follows no paths, or what any render of it would be refused for.
pub fn print_methods(chapters: &[Chapter], asked: &TryMethods, format: Format, out: &mut dyn Write) -> Result {
    let subject = Subject::find(chapters, &asked.subject)?;
    let size = size(&subject, asked.size)?;
    let (samples, seeds) = if asked.quick { (4, 8) } else { (16, 16) };
    let (samples, seeds) = (asked.samples.unwrap_or(samples), asked.seeds.unwrap_or(seeds));
    let world = subject.world(&Overrides::default());
    if !integrator_of(&Census::of(&world)).integrator.transport().samples_diffuse {
        return Err(Error::usage(format!(
            "{} follows no paths that methods could differ in: give its camera the integrator Path()",
            subject.shown()
        )));
    }
    let rivals: Vec<Rival<'_>> = METHODS.into_iter().map(|(word, method)| Rival::Method(word, method)).collect();
    // The first is the scene as it is, by whichever method.
    let variants = variants(&subject, &rivals, size)?.split_off(1);
    let waiting = Bar::of(u64::from(samples) * u64::from(seeds) * variants.len() as u64);
    let ends_by_itself = EndsByItself::begin();
    let found = pilot(&variants, samples, seeds, &waiting);
    waiting.bar.finish_and_clear();
    let mut found = found?;
    drop(ends_by_itself);
    for found in &mut found {
        if let Found::Refused(why) = found {
            *why = subject.in_its_words(std::mem::take(why));
        }
    }
    let methods: Vec<(&str, Found)> = METHODS.iter().map(|(word, _)| *word).zip(found).collect();
    let choice = choose(&methods);
    let ask = choice.chosen.as_deref().map(|chosen| ask(chosen, asked_for(&world)));
    if format.is_json() {
        let rows = methods.iter().map(|(method, found)| Row { method, found }).collect();
        let (scene, (width, height)) = (subject.name(), (size.width, size.height));
        return print_json(&Told { scene, width, height, samples, seeds, methods: rows, choice, ask }, out);
    }
    let (width, height) = (size.width, size.height);
    writeln!(out, "{}: {width} x {height} pixels, {samples} samples, {seeds} seeds a method", subject.shown())?;
    write!(out, "{}", table(&methods, samples))?;
    let Choice { chosen, why } = choice;
    writeln!(out, "{}: {why}", chosen.as_deref().unwrap_or("none is chosen"))?;
    ask.map_or(Ok(()), |ask| Ok(writeln!(out, "to ask for it: {ask}")?))
}

/// The method that a scene's camera asks for; none for path tracing.
fn asked_for(world: &World) -> Option<&'static str> {
    let camera = world.entity(camera_entity(world).ok()?);
    let has = [
        camera.contains::<LightTracing>(),
        camera.contains::<PhotonMapping>(),
        camera.contains::<BidirectionalPathTracing>(),
    ];
    METHODS[1..].iter().zip(has).find(|(_, has)| *has).map(|((word, _), _)| *word)
}

/// How a scene asks for a method, in the words of a scene file.
fn ask(chosen: &str, now: Option<&str>) -> String {
    match (chosen == METHODS[0].0, now) {
        (true, None) => "the scene does so already".into(),
        (true, Some(now)) => format!("without `{now}` on the camera"),
        (false, Some(now)) if now == chosen => "the scene does so already".into(),
        (false, Some(now)) => format!("`{chosen}: ()` on the camera, in place of `{now}`"),
        (false, None) => format!("`{chosen}: ()` on the camera"),
    }
}
