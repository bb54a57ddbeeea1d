use super::arguments::TryPreflight;
use super::error::Result;
use super::format::{Format, print_json};
use super::options::RenderOptions;
use super::streams::Streams;
use super::subject::{Subject, every_stage};
use super::warnings::notes;
use bevy_ecs::prelude::*;
use pinhole::Chapter;
use pinhole::look::{Foretold, MISTAKES, Preflight, foretell, preflight};
use pinhole::plan::{Census, Stage};
use pinhole::render::{RenderInProgress, check_film_fits, prepare};
use pinhole::scene::in_words_of_files;
use serde_json::json;
use std::io::Write;
use std::time::{Duration, Instant};

/// What would be said before a render, a line each; without a subject, of small scenes with something wrong.
///
/// Errors: what the scene of a subject is refused for.
pub fn print_preflight(
    chapters: &[Chapter],
    asked: &TryPreflight,
    format: Format,
    streams: &mut Streams<'_>,
) -> Result {
    let began = Instant::now();
    if let Some(chapter) = &asked.chapter {
        let subject = Subject::find(chapters, chapter)?.set(&asked.options.set)?;
        let wanted = asked.options.asked(false);
        let world = subject.world(&wanted);
        let told = said(&world, &subject.stages(), began).map_err(|error| subject.placed(error, &wanted))?;
        let told: Vec<String> = told.into_iter().map(|sentence| subject.in_its_words(sentence)).collect();
        return match format {
            Format::Json => print_json(&json!({ "scene": subject.name(), "warnings": told }), streams.out),
            Format::Text => {
                notes(&Census::of(&world))?.iter().try_for_each(|note| streams.note(note))?;
                print_lines(&told, "", streams.out)
            }
        };
    }
    let out = &mut *streams.out;
    let stages = every_stage().stages();
    let mut scenes = Vec::new();
    for mistake in MISTAKES {
        let mut scene = World::new();
        (mistake.scene)(&mut scene);
        let (warnings, refused) = match said(&scene, &stages, Instant::now()) {
            // As a file would have them, on whose page of the book they stand.
            Ok(told) => (told.iter().map(|sentence| in_words_of_files(sentence)).collect(), None),
            Err(pinhole::Error::SceneError(scene_error)) => (Vec::new(), Some(scene_error.to_string())),
            Err(error) => return Err(error.into()),
        };
        if format.is_json() {
            scenes.push(json!({ "scene": mistake.what, "warnings": warnings, "refused": refused }));
            continue;
        }
        writeln!(out, "{}", mistake.what)?;
        match refused {
            None => print_lines(&warnings, "  ", out)?,
            Some(refused) => writeln!(out, "  refused: {refused}")?,
        }
    }
    if format.is_json() { print_json(&json!({ "scenes": scenes }), out) } else { Ok(()) }
}

fn said(scene: &World, stages: &[Stage], began: Instant) -> pinhole::Result<Vec<String>> {
    let census = &Census::of(scene);
    let (plan, tables) = prepare(census, stages)?;
    check_film_fits(census, &plan)?;
    preflight(census, (&plan, &tables), Preflight { patience: patience(), ..Preflight::default() }.since(began))
}

/// A build for tests, which is slower and may have others beside it, gets ten times as long, so that its warnings are the
/// same.
fn patience() -> Option<Duration> {
    cfg!(debug_assertions).then_some(Duration::from_secs(10))
}

fn print_lines(told: &[String], indent: &str, out: &mut dyn Write) -> Result {
    if told.is_empty() {
        writeln!(out, "{indent}nothing to say")?;
    }
    for line in told {
        writeln!(out, "{indent}before rendering: {line}")?;
    }
    Ok(())
}

/// Says what a reader should know before they wait; a program is told with the rest.
pub fn before_rendering(
    subject: &Subject<'_>,
    scene: &Census<'_>,
    options: &RenderOptions,
    (render, began): (&RenderInProgress, Instant),
    json: bool,
    streams: &mut Streams<'_>,
) -> Result<Foretold> {
    if options.no_preflight {
        return Ok(Foretold::default());
    }
    // How long a part takes, test rays all over the image do not say.
    let (threads, ends_in_time) = (options.threads.map(usize::from), options.time.is_some() || options.crop.is_some());
    let asked = Preflight { threads, ends_in_time, patience: patience() }.since(began);
    let mut said = foretell(scene, (&render.plan, render.tables()), asked)?;
    said.warnings = said.warnings.into_iter().map(|sentence| subject.in_its_words(sentence)).collect();
    if !json {
        said.warnings.iter().try_for_each(|warning| streams.note(&format!("before rendering: {warning}")))?;
    }
    Ok(said)
}
