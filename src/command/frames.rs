//! The frames of a film, each a picture.

use super::chapter_text::ChapterText;
use super::error::{Error, Result};
use super::files::Targets;
use super::format::Format;
use super::options::RenderOptions;
use super::render::{keep_guides, render_with};
use super::streams::Streams;
use super::subject::Subject;
use bevy_ecs::prelude::World;
use pinhole::extract::{adaptive_of, validate};
use pinhole::plan::Census;
use pinhole::render::SceneAt;
use pinhole::scene::{ModelScene, SceneFile, animates_after, printable_path};
use std::borrow::Cow;
use std::path::{Path, PathBuf};

/// A file of a frame: the number stands before the ending.
pub fn frame_file(picture: &Path, frame: u32) -> PathBuf {
    let mut name = picture.file_stem().unwrap_or_default().to_os_string();
    name.push(format!("_{frame:04}"));
    if let Some(ending) = picture.extension() {
        name.push(".");
        name.push(ending);
    }
    picture.with_file_name(name)
}

/// The frames of a part: every so many.
pub fn frames_of([first, last]: [u32; 2], part: Option<[u32; 2]>) -> impl Iterator<Item = u32> {
    let [number, of] = part.unwrap_or([1, 1]);
    (first..=last).skip(number as usize - 1).step_by(of as usize)
}

/// One of the moments of a frame.
#[derive(Clone, Copy)]
struct Moment {
    /// Its number, from 0 on, and how many there are.
    of: [u32; 2],
    /// Whether nothing moves meanwhile.
    frozen: bool,
}

impl Subject<'_> {
    /// What a film of it is made of: a scene file, or that of a chapter; none for a model.
    fn film_file(&self) -> Result<Option<Cow<'_, SceneFile>>> {
        Ok(match self {
            Self::File { file, .. } => Some(Cow::Borrowed(file)),
            Self::Chapter(chapter) => Some(Cow::Owned(ChapterText::of(chapter)?.file().clone())),
            Self::Model { .. } => None,
        })
    }

    /// The scene at a frame, or at one of its moments, by its keys or its animation.
    ///
    /// Errors: nothing in it changes with time, or a key sets what cannot be set.
    fn at(&self, frame: u32, rate: f64, moment: Option<Moment>) -> Result<Subject<'static>> {
        let still =
            || Error::usage(format!("nothing in {} has keys or an animation, so it has no frames", self.shown()));
        let frame = f64::from(frame);
        let of_file = |file: &SceneFile| {
            if !file.may_change() {
                return Err(still());
            }
            let at = match moment {
                None => file.at(frame, rate),
                Some(Moment { of, frozen }) => file.at_moment(frame, rate, of, frozen),
            };
            at.map_err(Error::usage)
        };
        match self {
            Self::File { file, typed } => Ok(Subject::File { file: of_file(file)?, typed: typed.clone() }),
            Self::Chapter(chapter) => {
                let text = ChapterText::of(chapter)?;
                Ok(Subject::Chapter(Cow::Owned(text.with(of_file(text.file())?))))
            }
            Self::Model { model, .. } if model.animations.is_empty() => Err(still()),
            Self::Model { model, typed } => {
                let part = moment.map_or(0.0, |Moment { of: [number, of], .. }| {
                    (f64::from(number) + 0.5) / f64::from(of) * model.shutter
                });
                let model = ModelScene { seconds: Some(frame / rate + part), ..model.clone() };
                Ok(Subject::Model { model, typed: typed.clone() })
            }
        }
    }
}

/// A frame's scene, and the scenes of its moments where something changes while the shutter is open that no motion along a
/// straight line shows.
///
/// Errors: nothing in it changes with time, a key sets what cannot be set, or moments and what else is asked for do not go
/// together.
fn frame_of(
    subject: &Subject<'_>,
    options: &RenderOptions,
    frame: u32,
) -> Result<(Subject<'static>, Option<(u32, SceneAt)>)> {
    let (rate, moments, time) = (options.fps, options.moments, f64::from(frame));
    let plain = subject.at(frame, rate, None)?;
    let file = subject.film_file()?;
    let exposure_time = match (&file, subject) {
        (Some(file), _) => file.exposure_time(time).map_err(Error::usage)?,
        (None, Subject::Model { model, .. }) => model.shutter,
        (None, _) => 0.0,
    };
    if moments <= 1 || exposure_time <= 0.0 {
        return Ok((plain, None));
    }
    let asked = options.asked(false);
    let world = plain.world(&asked);
    let closed = subject.at(frame, rate, Some(Moment { of: [0, 1], frozen: true }))?;
    let is_valid = |world: &World| validate(&Census::of(world)).is_ok();
    // Not all that keys move may move while the shutter is open, but everything may be elsewhere at another moment.
    let frozen = !is_valid(&world) && is_valid(&closed.world(&asked));
    let changes = match &file {
        Some(file) => file.changes(time, rate, moments).map_err(Error::usage)?,
        None => false,
    };
    if !(frozen || changes || animates_after(&world, time / rate)) {
        return Ok((plain, None));
    }
    if adaptive_of(&Census::of(&world)).is_ok_and(|adaptive| adaptive.is_some()) {
        return Err(Error::usage(format!(
            "cannot render frame {frame} to an error: it is the mean of moments, which have equal numbers of samples, so say \
             how many with --samples, or leave the blur out with --moments 1"
        )));
    }
    let (subject, denoise) = (subject.clone().owned(), options.denoise);
    let scene = move |number, of| {
        let at = subject.at(frame, rate, Some(Moment { of: [number, of], frozen }));
        let mut world = at.map_err(|error| pinhole::Error::Usage(error.to_string()))?.world(&asked);
        if denoise {
            keep_guides(&mut world);
        }
        Ok(world)
    };
    Ok((if frozen { closed } else { plain }, Some((moments, Box::new(scene)))))
}

/// Renders the frames one after another; with `--resume` those that are done are not rendered again.
///
/// Errors: those of the first frame that cannot be rendered.
pub fn render_frames(
    subject: &Subject<'_>,
    options: &RenderOptions,
    frames: [u32; 2],
    format: Format,
    streams: &mut Streams<'_>,
) -> Result {
    let targets = Targets::of(subject, options)?;
    if targets.pictures.is_empty() {
        return Err(Error::CommandLine("the frames of a film are files, so --output has to name one".into()));
    }
    // One ray a pixel is over at once.
    let _ = format;
    for frame in frames_of(frames, options.part) {
        let own = RenderOptions {
            output: targets.pictures.iter().map(|picture| frame_file(picture, frame)).collect(),
            output_is_chosen: !targets.named,
            part: None,
            frame: Some(frame),
            quiet: true,
            ..options.clone()
        };
        let (at, moments) = frame_of(subject, options, frame)?;
        match render_with(&at, &own, (None, moments), Format::Text, streams) {
            Err(Error::Pinhole(pinhole::Error::Stopped(why))) if options.part.is_some() => {
                return Err(Error::Unfinished(why));
            }
            Err(Error::Pinhole(pinhole::Error::Interrupted)) if options.part.is_some() => {
                return Err(Error::Unfinished(format!(
                    "stopped in frame {frame}; the same command with --resume continues"
                )));
            }
            ended => ended?,
        }
    }
    Ok(())
}

/// Says which frames of a film are missing.
///
/// Errors: some are.
pub fn missing_frames(
    subject: &Subject<'_>,
    options: &RenderOptions,
    frames: [u32; 2],
    streams: &mut Streams<'_>,
) -> Result {
    let targets = Targets::of(subject, options)?;
    let all = || frames_of(frames, None);
    let is_there = |frame: u32| targets.pictures.iter().all(|picture| frame_file(picture, frame).exists());
    let missing: Vec<String> = all().filter(|frame| !is_there(*frame)).map(|frame| frame.to_string()).collect();
    let first =
        targets.pictures.first().map(|picture| printable_path(&frame_file(picture, frames[0]))).unwrap_or_default();
    if missing.is_empty() {
        writeln!(streams.out, "all {} frames are there, from {first} on", all().count())?;
        return Ok(());
    }
    let shown = missing.iter().take(12).cloned().collect::<Vec<_>>().join(", ");
    let more = missing.len().saturating_sub(12);
    let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
    Err(Error::Unfinished(format!("{} of {} frames are missing: {shown}{rest}", missing.len(), all().count())))
}
