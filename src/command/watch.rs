use super::arguments::RenderChapter;
use super::error::{Error, Result};
use super::find::{is_scene_file, shown};
use super::format::Format;
use super::interrupt::{EndsByItself, interrupted};
use super::render::render_subject;
use super::streams::Streams;
use super::subject::Subject;
use pinhole::Chapter;
use std::path::Path;
use std::thread;
use std::time::{Duration, SystemTime};

/// How long to wait between two looks at the file; a save is over when nothing changed from one to the next.
const PAUSE: Duration = Duration::from_millis(50);

/// What changes when a file is saved.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Stamp {
    modified: Option<SystemTime>,
    bytes: u64,
}

/// Renders a scene file now and after every save, until Ctrl-C.
///
/// What is wrong with a file is told, and the next save waited for: an editor may have saved half of it.
///
/// Errors: no scene file is named, or nothing can be printed any more.
pub fn render_at_every_save(
    chapters: &[Chapter],
    asked: &RenderChapter,
    format: Format,
    streams: &mut Streams<'_>,
) -> Result {
    let (file, shown) = (Path::new(&asked.chapter), shown(&asked.chapter));
    if !is_scene_file(file) {
        let what = "a scene file is watched, whose name ends in .ron; `export` makes one of a chapter";
        return Err(Error::CommandLine(format!("cannot watch {shown}: {what}")));
    }
    let options = asked.options();
    if format == Format::Json || options.output.iter().any(|file| file.as_os_str() == "-") {
        let what = "one picture after another can be neither one JSON value nor one PNG on standard output";
        return Err(Error::CommandLine(format!("cannot watch {shown}: {what}")));
    }
    let (mut seen, mut last) = (stamp(file), None);
    let mut waits = EndsByItself::begin();
    while !interrupted() {
        let now = stamp(file);
        let settled = last.is_none() || seen == now;
        seen = now;
        if last == Some(now) || !settled {
            thread::sleep(PAUSE);
            continue;
        }
        last = Some(now);
        // A render has its own say in how it ends.
        drop(waits);
        let rendered = Subject::find(chapters, file)
            .and_then(|subject| subject.set(&options.scene.set))
            .and_then(|subject| render_subject(&subject, &options, Format::Text, streams));
        waits = EndsByItself::begin();
        match rendered {
            Err(Error::Pinhole(pinhole::Error::Print(broken))) => return Err(broken.into()),
            Err(Error::Pinhole(pinhole::Error::Interrupted | pinhole::Error::Stopped(_))) => break,
            Err(told) => writeln!(streams.out, "{told}")?,
            Ok(()) => {}
        }
        writeln!(streams.out, "waiting for the next save of {shown}, or Ctrl-C")?;
        streams.out.flush()?;
    }
    writeln!(streams.out, "stopped watching {shown}")?;
    Ok(())
}

fn stamp(file: &Path) -> Stamp {
    let metadata = std::fs::metadata(file).ok();
    Stamp {
        modified: metadata.as_ref().and_then(|metadata| metadata.modified().ok()),
        bytes: metadata.map_or(0, |metadata| metadata.len()),
    }
}
