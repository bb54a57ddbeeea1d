//! The frames of a film, each a picture.

use super::chapter_text::ChapterText;
use super::error::{Error, Result};
use super::files::Targets;
use super::format::Format;
use super::options::RenderOptions;
use super::render::render_subject;
use super::streams::Streams;
use super::subject::Subject;
use pinhole::scene::{ModelScene, printable_path};
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

impl<'c> Subject<'c> {
    /// The scene at a frame, by its keys or its animation.
    ///
    /// Errors: nothing in it changes with time, or a key sets what cannot be set.
    pub fn at(&self, frame: u32, rate: f64) -> Result<Subject<'c>> {
        let still =
            || Error::usage(format!("nothing in {} has keys or an animation, so it has no frames", self.shown()));
        match self {
            Self::File { file, typed } => {
                if !file.may_change() {
                    return Err(still());
                }
                let file = file.at(f64::from(frame), rate).map_err(Error::usage)?;
                Ok(Self::File { file, typed: typed.clone() })
            }
            Self::Chapter(chapter) => {
                let text = ChapterText::of(chapter)?;
                let at = text.at(f64::from(frame), rate)?.ok_or_else(still)?;
                Ok(Self::Chapter(Cow::Owned(at)))
            }
            Self::Model { model, .. } if model.animations.is_empty() => Err(still()),
            Self::Model { model, typed } => {
                let model = ModelScene { seconds: Some(f64::from(frame) / rate), ..model.clone() };
                Ok(Self::Model { model, typed: typed.clone() })
            }
        }
    }
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
        let at = subject.at(frame, options.fps)?;
        match render_subject(&at, &own, Format::Text, streams) {
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
