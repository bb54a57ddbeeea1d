use super::error::Result;
use super::files::Files;
use super::interrupt::{EndsByItself, Waiting};
use super::options::RenderOptions;
use pinhole::extract::adaptive_of;
use pinhole::film::{Film, check_place, read_checkpoint, write_checkpoint};
use pinhole::plan::Census;
use pinhole::render::{Limits, Outcome, RenderInProgress, film_key, render_in_passes};
use std::fs;
use std::io::ErrorKind;
use std::path::Path;
use std::time::Duration;

/// A render that took less leaves no checkpoint: it is as quickly made again.
const WORTH_KEEPING: Duration = Duration::from_secs(2);

/// Renders a camera's samples in passes, and writes the picture and a checkpoint between them; `say` gets what is to be
/// told before the first.
///
/// Errors: what a render or a file is refused for, or a stop by Ctrl-C, after which all is written.
pub fn render_long(
    render: &mut RenderInProgress,
    scene: &Census<'_>,
    options: &RenderOptions,
    files: &Files,
    waiting: &Waiting,
    say: &mut dyn FnMut(&str) -> Result,
) -> Result<Outcome> {
    let (key, checkpoint) = (film_key(scene, &render.plan), files.targets.checkpoint());
    checkpoint.iter().try_for_each(|checkpoint| check_place(checkpoint))?;
    let limits = Limits { time: options.time, write_every: options.write_every, adaptive: adaptive_of(scene)? };
    if let (true, Some(checkpoint)) = (options.resume, &checkpoint) {
        say(&resume(render, key, limits.adaptive.is_some(), checkpoint)?)?;
    }
    let mut keep = |film: &Film| {
        files.write(film)?;
        checkpoint.iter().try_for_each(|checkpoint| write_checkpoint(film, key, checkpoint))
    };
    let ends_by_itself = EndsByItself::begin();
    let outcome = render_in_passes(render, &limits, waiting, &mut keep);
    waiting.done();
    let outcome = outcome?;
    let Some(checkpoint) = &checkpoint else {
        return if outcome.stopped { Err(pinhole::Error::Interrupted.into()) } else { Ok(outcome) };
    };
    if outcome.stopped {
        keep(&render.film)?;
        let reached = match outcome.samples {
            0 => "stopped before every pixel had its first sample".to_string(),
            samples => format!("stopped after {samples} of {} samples a pixel", render.sampling.samples),
        };
        return Err(pinhole::Error::Stopped(format!(
            "{reached}; {} hold what there is, and the same command with --resume continues",
            files.targets.told(Some(checkpoint))
        ))
        .into());
    }
    drop(ends_by_itself);
    files.write(&render.film)?;
    if outcome.time >= WORTH_KEEPING || options.write_every.is_some() || options.resume {
        write_checkpoint(&render.film, key, checkpoint)?;
    } else if let Err(refused) = fs::remove_file(checkpoint)
        && refused.kind() != ErrorKind::NotFound
    {
        return Err(pinhole::Error::Write { path: checkpoint.clone(), source: refused }.into());
    }
    Ok(outcome)
}

/// Takes up what a checkpoint holds, if there is one, and says so.
fn resume(render: &mut RenderInProgress, key: u64, adaptive: bool, checkpoint: &Path) -> Result<String> {
    if !checkpoint.exists() {
        return Ok(format!("there is no {} to continue from, so the render begins anew", checkpoint.display()));
    }
    let film = read_checkpoint(key, &render.film, adaptive, checkpoint)?;
    render.take(film);
    let samples = pinhole::render::samples_after(render.film.least_done());
    let of = if render.film.pilot { " of the pilot" } else { "" };
    let more = !render.film.pilot && render.film.planned.is_empty() && samples > render.sampling.samples;
    let kept = if more { format!(", more than the {} asked for", render.sampling.samples) } else { String::new() };
    Ok(format!("continuing from {}, {samples} samples a pixel{of}{kept}", checkpoint.display()))
}
