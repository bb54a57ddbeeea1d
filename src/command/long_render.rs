use super::interrupt::{EndsByItself, Waiting};
use super::options::RenderOptions;
use super::span::told;
use crate::extract::{ShapeTable, adaptive_of};
use crate::film::{
    Curve, Film, check_place, column_of_layer, read_checkpoint, write_checkpoint, write_exr, write_layered_exr,
    write_png,
};
use crate::plan::{Plan, Table};
use crate::render::{Limits, Outcome, RenderUnderWay, film_key, render_in_passes};
use crate::scene::OPEN_END;
use crate::{Error, Result};
use bevy_ecs::prelude::*;
use std::fs;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A render that took less leaves no checkpoint: it is as quickly made again.
const WORTH_KEEPING: Duration = Duration::from_secs(2);

/// The picture's files, and what else is written beside them.
pub struct Files {
    /// The picture, as PNG or EXR or both.
    pub pictures: Vec<PathBuf>,
    /// The names of shapes by their numbers, for the layer that tells them.
    names: Vec<String>,
    curve: Curve,
}

impl Files {
    /// Where the pictures of a scene go.
    pub fn new(pictures: Vec<PathBuf>, scene: &World, plan: &Plan) -> Self {
        let curve = if plan.view.is_some() { Curve::Straight } else { Curve::Srgb };
        let names = ShapeTable::extract(scene).map(|shapes| shapes.name).unwrap_or_default();
        Self { pictures, names, curve }
    }

    /// The checkpoint: beside the picture, with its name.
    pub fn checkpoint(&self) -> PathBuf {
        self.pictures.first().map_or_else(PathBuf::new, |picture| picture.with_extension("checkpoint"))
    }

    /// Writes the pictures anew, each whole.
    pub fn write(&self, film: &Film) -> Result {
        self.pictures.iter().try_for_each(|picture| self.write_one(film, picture))
    }

    /// Writes one of them.
    pub fn write_one(&self, film: &Film, picture: &Path) -> Result {
        let is_exr = picture.extension().is_some_and(|ending| ending == "exr");
        match (is_exr, film.layers.is_empty()) {
            (false, _) => write_png(film, self.curve, picture),
            (true, true) => write_exr(film, picture),
            (true, false) => write_layered_exr(film, &self.names, picture),
        }
    }

    /// The files by name, with `and` before the last.
    pub fn told(&self, with_checkpoint: bool) -> String {
        let checkpoint = with_checkpoint.then(|| self.checkpoint());
        let names: Vec<String> =
            self.pictures.iter().chain(&checkpoint).map(|file| file.display().to_string()).collect();
        match names.split_last() {
            Some((last, [])) => last.clone(),
            Some((last, before)) => format!("{} and {last}", before.join(", ")),
            None => String::new(),
        }
    }
}

/// Renders a camera's samples in passes, and writes the picture and a checkpoint between them.
///
/// Errors: what a render or a file is refused for, or a stop by Ctrl-C, after which all is written.
pub fn render_long(
    render: &mut RenderUnderWay,
    scene: &World,
    options: &RenderOptions,
    files: &Files,
    out: &mut dyn Write,
) -> Result<Outcome> {
    let (key, checkpoint) = (film_key(scene, &render.plan), files.checkpoint());
    check_place(&checkpoint)?;
    let limits = Limits { time: options.time, write_every: options.write_every, adaptive: adaptive_of(scene)? };
    if options.resume {
        resume(render, key, limits.adaptive.is_some(), &checkpoint, options, out)?;
    }
    let waiting = Waiting::new(0, options.quiet || options.stats);
    let mut keep = |film: &Film| {
        files.write(film)?;
        write_checkpoint(film, key, &checkpoint)
    };
    let ends_by_itself = EndsByItself::begin();
    let outcome = render_in_passes(render, &limits, &waiting, &mut keep);
    waiting.done();
    let outcome = outcome?;
    if outcome.stopped {
        keep(&render.film)?;
        let reached = match outcome.samples {
            0 => "stopped before every pixel had its first sample".to_string(),
            samples => format!("stopped after {samples} of {} samples a pixel", render.sampling.samples),
        };
        return Err(Error::Stopped(format!(
            "{reached}; {} hold what there is, and the same command with --resume continues",
            files.told(true)
        )));
    }
    drop(ends_by_itself);
    files.write(&render.film)?;
    if outcome.time >= WORTH_KEEPING || options.write_every.is_some() || options.resume {
        write_checkpoint(&render.film, key, &checkpoint)?;
    } else if let Err(refused) = fs::remove_file(&checkpoint)
        && refused.kind() != ErrorKind::NotFound
    {
        return Err(Error::Write { path: checkpoint, source: refused });
    }
    Ok(outcome)
}

fn resume(
    render: &mut RenderUnderWay,
    key: u64,
    adaptive: bool,
    checkpoint: &Path,
    options: &RenderOptions,
    out: &mut dyn Write,
) -> Result {
    let told = if checkpoint.exists() {
        let film = read_checkpoint(key, &render.film, adaptive, checkpoint)?;
        render.take(film);
        let samples = crate::render::samples_after(render.film.least_done());
        let of = if render.film.pilot { " of the pilot" } else { "" };
        let more = !render.film.pilot && render.film.planned.is_empty() && samples > render.sampling.samples;
        let kept = if more { format!(", more than the {} asked for", render.sampling.samples) } else { String::new() };
        format!("continuing from {}, {samples} samples a pixel{of}{kept}", checkpoint.display())
    } else {
        format!("there is no {} to continue from, so the render begins anew", checkpoint.display())
    };
    if !options.quiet && !options.stats {
        writeln!(out, "{told}")?;
    }
    Ok(())
}

/// Says how far the samples went, and what error they came to.
pub fn tell_outcome(outcome: &Outcome, render_samples: u32, target: Option<f64>, out: &mut dyn Write) -> Result {
    let time = told(outcome.time);
    if outcome.out_of_time {
        let asked = if render_samples == OPEN_END { "at most " } else { "" };
        writeln!(out, "the time is up: {} of {asked}{render_samples} samples a pixel in {time}", outcome.samples)?;
    } else if target.is_none() {
        writeln!(out, "{} samples a pixel in {time}", outcome.samples)?;
    }
    if let (Some(found), Some(target)) = (outcome.achieved, target) {
        let (mean, fewest, most) = found.samples;
        writeln!(
            out,
            "error {target} asked, {:.4} measured from {mean:.1} samples a pixel, {fewest} to {most} of them, in {time}",
            found.error
        )?;
        writeln!(
            out,
            "{} of {} pixels are above {target} by their own samples; {} of them wanted more than the {render_samples} \
             samples that there are",
            found.above, found.pixels, found.cut_short
        )?;
    }
    Ok(())
}

/// Says which layers are 0 everywhere because nothing that runs writes what they are made of.
pub fn warn_of_empty_layers(film: &Film, plan: &Plan, out: &mut dyn Write) -> Result {
    for &kind in film.layers.first().map_or(&[][..], |layers| &layers.kinds) {
        let Some(column) = column_of_layer(kind) else { continue };
        if !plan.columns.iter().any(|own| own.name == column) {
            let word = kind.word();
            writeln!(out, "warning: the layer `{word}` is empty, for nothing that runs writes the column `{column}`")?;
        }
    }
    Ok(())
}
