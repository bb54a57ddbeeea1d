use super::arguments::RenderChapter;
use super::find::is_scene_file;
use super::interrupt::{EndsByItself, interrupted};
use super::render::render_subject;
use super::subject::Subject;
use crate::chapter::Chapter;
use crate::{Error, Result};
use std::io::Write;
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
pub fn render_at_every_save(chapters: &[Chapter], asked: &RenderChapter, out: &mut dyn Write) -> Result {
    let file = Path::new(&asked.chapter);
    if !is_scene_file(&asked.chapter) {
        let what = "a scene file is watched, whose name ends in .ron; `export` makes one of a chapter";
        return Err(Error::Usage(format!("cannot watch {}: {what}", asked.chapter)));
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
        let rendered =
            Subject::find(chapters, &asked.chapter).and_then(|subject| render_subject(&subject, &asked.options, out));
        waits = EndsByItself::begin();
        match rendered {
            Err(Error::Print(broken)) => return Err(Error::Print(broken)),
            Err(Error::Interrupted | Error::Stopped(_)) => break,
            Err(told) => writeln!(out, "{told}")?,
            Ok(()) => {}
        }
        writeln!(out, "waiting for the next save of {}, or Ctrl-C", file.display())?;
        out.flush()?;
    }
    writeln!(out, "stopped watching {}", file.display())?;
    Ok(())
}

fn stamp(file: &Path) -> Stamp {
    let metadata = std::fs::metadata(file).ok();
    Stamp {
        modified: metadata.as_ref().and_then(|metadata| metadata.modified().ok()),
        bytes: metadata.map_or(0, |metadata| metadata.len()),
    }
}
