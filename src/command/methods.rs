//! `methods`: each method that may find a scene's light renders it a few times, and one of them is chosen.

use super::error::{Error, Result};
use super::format::{Format, print_json};
use super::interrupt::EndsByItself;
use super::report::{Bar, METHODS, Rival, size, variants};
use super::report_arguments::TryMethods;
use super::subject::Subject;
use bevy_ecs::prelude::*;
use pinhole::extract::{camera_entity, integrator_of};
use pinhole::plan::Census;
use pinhole::scene::{BidirectionalPathTracing, LightTracing, PhotonMapping};
use pinhole::{Chapter, Overrides};
use pinhole_lab::report::pilot::{Choice, Found, choose, pilot, table};
use serde::Serialize;
use std::io::Write;

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
