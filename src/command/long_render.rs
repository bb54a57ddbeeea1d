use super::error::{Error, Result};
use super::files::Files;
use super::interrupt::{EndsByItself, Waiting, interrupted};
use super::options::RenderOptions;
use pinhole::extract::adaptive_of;
use pinhole::film::{
    CheckpointAt, Film, Replaces, SamplesKept, checkpoint_at, checkpoint_place, is_done, keep_checkpoint,
    read_checkpoint, remove_own, write_done,
};
use pinhole::plan::Census;
use pinhole::render::{Limits, Outcome, RenderInProgress, render_in_passes, samples_after};
use pinhole::scene::{fnv, printable_path};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

/// A render that took less leaves no checkpoint: it is as quickly made again.
const WORTH_KEEPING: Duration = Duration::from_secs(2);
/// How long to wait before each further try to write what could not be written at the end, in milliseconds.
const TRIES: [u64; 5] = [250, 500, 1000, 2000, 4000];
/// How many of them a reader who has pressed Ctrl-C waits for.
const TRIES_WHEN_STOPPED: usize = 2;

/// What came of a long render.
pub struct LongRender {
    /// How it ended.
    pub outcome: Outcome,
    /// The checkpoint that it left.
    pub checkpoint: Option<PathBuf>,
    /// Whether it was done before, so that nothing was rendered.
    pub was_done: bool,
}

/// Renders a camera's samples in passes, and writes the picture and a checkpoint between them; `say` gets what is to be
/// told meanwhile.
///
/// A file that cannot be written ends nothing: it is written again after the next pass, and at the end some more times.
///
/// Errors: what a render or a file is refused for, or a stop by Ctrl-C, after which all is written.
pub fn render_long(
    render: &mut RenderInProgress,
    scene: &Census<'_>,
    options: &RenderOptions,
    files: &Files,
    waiting: &Waiting,
    say: &mut dyn FnMut(&str) -> Result,
) -> Result<LongRender> {
    let (key, first) = (key_of(render, scene, options, waiting)?, files.targets.checkpoint());
    let limits = Limits { time: options.time, write_every: options.write_every, adaptive: adaptive_of(scene)? };
    if let (Some(_), Some(first)) = (options.frame, &first) {
        let is_there = files.targets.pictures.iter().all(|picture| picture.exists());
        if options.resume && is_there && is_done(first, key, render.sampling.samples) {
            return Ok(LongRender { outcome: Outcome::default(), checkpoint: None, was_done: true });
        }
        if is_done(first, key, 0) {
            // What it says no longer holds.
            remove_own(Replaces::If(&|path: &Path| is_done(path, key, 0)).at(first))?;
        }
    }
    let (mut found, mut has_first_name) = (None, true);
    if let Some(first) = &first {
        let place = checkpoint_place(first, key);
        found = place.as_ref().and_then(|(_, kept)| *kept);
        has_first_name = place.as_ref().is_some_and(|(path, _)| path == first);
        if options.resume {
            say(&resume(render, key, limits.adaptive.is_some(), (first, place))?)?;
        } else if let Some(said) = said_of(first, place) {
            say(&said)?;
        }
    }
    let mut kept = Kept { files, key, first: first.as_deref(), wrote: None, last: None };
    let ends_by_itself = EndsByItself::begin();
    let outcome = render_in_passes(render, &limits, waiting, &mut |film| kept.between_passes(film, say));
    waiting.done();
    let outcome = outcome?;
    if first.is_none() {
        return match outcome.stopped {
            true => Err(pinhole::Error::Interrupted.into()),
            false => {
                files.write(&render.film)?;
                Ok(LongRender { outcome, checkpoint: None, was_done: false })
            }
        };
    }
    // Beside the checkpoint of another render, that of a finished one would be one more with each change of the scene.
    let worth_keeping = (outcome.time >= WORTH_KEEPING && has_first_name)
        || options.write_every.is_some()
        || options.resume && options.frame.is_none();
    let keeps = outcome.stopped || worth_keeping || found.is_some();
    let written = kept.at_the_end(&render.film, keeps, outcome.stopped, say)?;
    drop(ends_by_itself);
    if outcome.stopped {
        return Err(stopped(&outcome, render.sampling.samples, files, &written));
    }
    written.pictures.map_err(|refused| match &written.checkpoint {
        Some(Ok((checkpoint, _))) => Error::usage(format!(
            "{refused}; all samples are in {}, and the same command with --resume writes the picture from there",
            printable_path(checkpoint)
        )),
        _ => refused.into(),
    })?;
    let checkpoint = match written.checkpoint {
        Some(Ok((checkpoint, true))) if keeps => Some(checkpoint),
        Some(Ok(_)) | None => None,
        Some(Err(refused)) => {
            say(&format!("warning: {refused}; the picture is complete, but nothing continues from it"))?;
            None
        }
    };
    if let (Some(_), Some(first)) = (options.frame, &first) {
        kept.done(&render.film, first)?;
        return Ok(LongRender { outcome, checkpoint: None, was_done: false });
    }
    if !keeps {
        kept.remove(&render.film)?;
    }
    Ok(LongRender { outcome, checkpoint, was_done: false })
}

/// The key of a render: the film of a part of the image is another film, and so is that of other moments, of other samples
/// at each of them, or of another film's frames.
///
/// Errors: stopped.
pub fn key_of(
    render: &RenderInProgress,
    scene: &Census<'_>,
    options: &RenderOptions,
    waiting: &Waiting,
) -> pinhole::Result<u64> {
    let key = match (render.key(scene, waiting)?, render.moments()) {
        (key, 1) => key,
        (key, moments) => fnv(key, format!("{moments} {} {:?}", render.sampling.samples, options.fps).as_bytes()),
    };
    Ok(options.crop.map_or(key, |part| fnv(key, format!("{part:?}").as_bytes())))
}

/// What is kept of a render on the way.
struct Kept<'f> {
    files: &'f Files,
    key: u64,
    /// The first name for the checkpoint.
    first: Option<&'f Path>,
    /// The checkpoint that was written.
    wrote: Option<PathBuf>,
    /// What failed last, so that it is told once.
    last: Option<String>,
}

/// What was written at the end.
struct Written {
    pictures: pinhole::Result,
    /// The checkpoint and whether it was written, or holds more than this render.
    checkpoint: Option<pinhole::Result<(PathBuf, bool)>>,
}

impl Kept<'_> {
    /// Writes picture and checkpoint, each whether or not the other can be.
    fn between_passes(&mut self, film: &Film, say: &mut dyn FnMut(&str) -> Result) -> pinhole::Result {
        let pictures = self.files.write(film);
        let checkpoint = self.checkpoint(film);
        for refused in [pictures.err(), checkpoint.and_then(std::result::Result::err)].into_iter().flatten() {
            if !is_of_a_file(&refused) {
                return Err(refused);
            }
            let told = refused.to_string();
            if self.last.as_ref() != Some(&told) {
                // Who cannot be told goes without.
                let _ = say(&format!("warning: {told}; the render goes on, and it is written again later"));
                self.last = Some(told);
            }
        }
        Ok(())
    }

    fn checkpoint(&mut self, film: &Film) -> Option<pinhole::Result<(PathBuf, bool)>> {
        let kept = keep_checkpoint(film, self.key, self.first?).transpose();
        if let Some(Ok((path, true))) = &kept {
            self.wrote = Some(path.clone());
        }
        kept
    }

    /// Writes what there is, and tries again for a while where that fails.
    fn at_the_end(
        &mut self,
        film: &Film,
        keeps: bool,
        stopped: bool,
        say: &mut dyn FnMut(&str) -> Result,
    ) -> Result<Written> {
        let mut pictures = self.files.write(film);
        let mut checkpoint = (keeps || pictures.is_err()).then(|| self.checkpoint(film)).flatten();
        let tries = if stopped { &TRIES[..TRIES_WHEN_STOPPED] } else { &TRIES };
        for pause in tries {
            let failed = pictures.as_ref().err().or(checkpoint.as_ref().and_then(|kept| kept.as_ref().err()));
            let Some(refused) = failed.filter(|refused| is_of_a_file(refused)) else { break };
            let told = refused.to_string();
            if self.last.as_ref() != Some(&told) {
                say(&format!("warning: {told}; trying again"))?;
                self.last = Some(told);
            }
            if !stopped && interrupted() {
                break;
            }
            thread::sleep(Duration::from_millis(*pause));
            if pictures.is_err() {
                pictures = self.files.write(film);
            }
            if let Some(Err(_)) = &checkpoint {
                checkpoint = self.checkpoint(film);
            }
        }
        Ok(Written { pictures, checkpoint })
    }

    /// Writes that a frame is done in the place of its checkpoint, unless that is the place of another file.
    fn done(&self, film: &Film, first: &Path) -> Result {
        let may_go =
            |path: &Path| matches!(checkpoint_at(path, self.key), CheckpointAt::Own(_) | CheckpointAt::Missing);
        if may_go(first) {
            write_done(film, self.key, Replaces::If(&may_go).at(first))?;
        }
        Ok(())
    }

    /// Removes a checkpoint that is not worth keeping, if this render wrote it.
    fn remove(&self, film: &Film) -> Result {
        let own = SamplesKept::of(film);
        let is_own = |path: &Path| matches!(checkpoint_at(path, self.key), CheckpointAt::Own(kept) if kept <= own);
        if let Some(path) = &self.wrote {
            remove_own(Replaces::If(&is_own).at(path))?;
        }
        Ok(())
    }
}

/// Whether an error is one of a file, which may pass.
fn is_of_a_file(error: &pinhole::Error) -> bool {
    matches!(error, pinhole::Error::Write { .. })
}

/// What a reader who has pressed Ctrl-C is told.
fn stopped(outcome: &Outcome, of: u32, files: &Files, written: &Written) -> Error {
    let reached = match outcome.samples {
        0 => "stopped before every pixel had its first sample".to_string(),
        samples => format!("stopped after {samples} of {of} samples a pixel"),
    };
    let continues = "the same command with --resume continues";
    let pictures = match &written.pictures {
        Ok(()) => format!("{} hold what there is", files.targets.told(None)),
        Err(refused) => refused.to_string(),
    };
    let kept = match (&written.pictures, &written.checkpoint) {
        (Ok(()), Some(Ok((checkpoint, true)))) => {
            format!("{} hold what there is, and {continues}", files.targets.told(Some(checkpoint)))
        }
        (Err(refused), Some(Ok((checkpoint, true)))) => {
            format!("{refused}, but {} holds what there is, and {continues}", printable_path(checkpoint))
        }
        (_, Some(Ok((checkpoint, false)))) => {
            format!("{pictures}; {} holds more, and {continues} from there", printable_path(checkpoint))
        }
        (_, Some(Err(refused))) => format!("{pictures}; {refused}"),
        (_, None) => pictures,
    };
    pinhole::Error::Stopped(format!("{reached}; {kept}")).into()
}

/// What a reader should know of the files at the checkpoint's place before a render that does not continue.
fn said_of(first: &Path, place: Option<(PathBuf, Option<SamplesKept>)>) -> Option<String> {
    match place {
        Some((path, Some(kept))) if samples_after(kept.steps) > 0 => Some(format!(
            "note: {} holds {} samples a pixel of this very render: --resume continues from there; fewer samples do not \
             replace it",
            printable_path(&path),
            samples_after(kept.steps)
        )),
        Some((path, None)) if path != first => Some(format!(
            "note: {} is no checkpoint of this render and stays, so this one's is {}",
            printable_path(first),
            printable_path(&path)
        )),
        None => Some(format!(
            "note: {} and the names after it are those of other files, so this render leaves no checkpoint",
            printable_path(first)
        )),
        _ => None,
    }
}

/// Takes up what a checkpoint holds, if there is one, and says so.
fn resume(
    render: &mut RenderInProgress,
    key: u64,
    adaptive: bool,
    (first, place): (&Path, Option<(PathBuf, Option<SamplesKept>)>),
) -> Result<String> {
    let checkpoint = match place {
        Some((own, Some(_))) => own,
        Some((free, None)) if free == first => {
            let shown = printable_path(first);
            return Ok(format!("there is no {shown} to continue from, so the render begins anew"));
        }
        // Reading it says what it is instead.
        _ => first.into(),
    };
    let film = read_checkpoint(key, &render.film, adaptive, &checkpoint)?;
    render.take(film);
    let samples = samples_after(render.film.least_done());
    let of = if render.film.pilot { " of the pilot" } else { "" };
    let more = !render.film.pilot && render.film.planned.is_empty() && samples > render.sampling.samples;
    let kept = if more { format!(", more than the {} asked for", render.sampling.samples) } else { String::new() };
    Ok(format!("continuing from {}, {samples} samples a pixel{of}{kept}", printable_path(&checkpoint)))
}
