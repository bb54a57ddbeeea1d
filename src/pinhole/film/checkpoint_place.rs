//! Where a render's checkpoint is kept: beside its picture, under the first name that is free or its own.
//!
//! A checkpoint of another render stays, as does one of the same render that holds more samples, and any other file.

use super::checkpoint::{heading, write_checkpoint};
use super::{Film, Replaces};
use crate::Result;
use crate::scene::Unopened;
use std::path::{Path, PathBuf};

/// How many names are tried.
const MAX: u32 = 9;

/// How far a film is; the greater, the further.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SamplesKept {
    /// 0 for pilot samples, 1 for those that the picture is made of.
    pub phase: u32,
    /// All samples of all pixels, and the paths from the lights.
    pub samples: u64,
    /// The steps that every tile has done.
    pub steps: u32,
}

impl SamplesKept {
    /// Those of a film.
    pub fn of(film: &Film) -> Self {
        let samples: u64 = film.tiles.iter().flat_map(|tile| &tile.count).map(|&count| u64::from(count)).sum();
        let paths = film.splats.as_ref().map_or(0, |splats| splats.paths);
        let steps = film.done.iter().copied().min().unwrap_or(0);
        Self { phase: u32::from(!film.pilot), samples: samples.saturating_add(paths), steps }
    }
}

/// What is at the place of a checkpoint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CheckpointAt {
    /// There is no file.
    Missing,
    /// A checkpoint of the same render.
    Own(SamplesKept),
    /// Anything else, and whatever cannot be read.
    Other,
}

/// Looks at a file without reading its film.
pub fn checkpoint_at(path: &Path, key: u64) -> CheckpointAt {
    match heading(path) {
        Ok(heading) if heading.key == key => CheckpointAt::Own(heading.kept),
        Err(Some(Unopened::Missing)) => CheckpointAt::Missing,
        _ => CheckpointAt::Other,
    }
}

/// Where a render's checkpoint is, and what it holds; or where it would go; none where other files have all names.
pub fn checkpoint_place(first: &Path, key: u64) -> Option<(PathBuf, Option<SamplesKept>)> {
    let mut free = None;
    for path in names(first) {
        match checkpoint_at(&path, key) {
            CheckpointAt::Own(kept) => return Some((path, Some(kept))),
            CheckpointAt::Missing => free = free.or(Some((path, None))),
            CheckpointAt::Other => {}
        }
    }
    free
}

/// Writes a checkpoint, unless there is one of the same render with more samples; says where it is and whether it was
/// written. None where other files have all names.
///
/// Errors: the path and the error of the operating system.
pub fn keep_checkpoint(film: &Film, key: u64, first: &Path) -> Result<Option<(PathBuf, bool)>> {
    let own = SamplesKept::of(film);
    let no_more = |there: CheckpointAt| match there {
        CheckpointAt::Missing => true,
        CheckpointAt::Own(kept) => kept <= own,
        CheckpointAt::Other => false,
    };
    let Some((path, kept)) = checkpoint_place(first, key) else { return Ok(None) };
    if kept.is_some_and(|kept| kept > own) {
        return Ok(Some((path, false)));
    }
    let may_go = |path: &Path| no_more(checkpoint_at(path, key));
    // What another render writes under a name that was free stays, even at the same moment.
    let replaces = if kept.is_some() { Replaces::If(&may_go) } else { Replaces::Nothing };
    write_checkpoint(film, key, replaces.at(&path))?;
    Ok(Some((path, true)))
}

fn names(first: &Path) -> impl Iterator<Item = PathBuf> {
    (1..=MAX).map(move |number| match (number, first.file_stem()) {
        (2.., Some(stem)) => {
            let mut name = stem.to_os_string();
            name.push(format!("-{number}."));
            name.push(first.extension().unwrap_or_default());
            first.with_file_name(name)
        }
        _ => first.into(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// A film of one pixel with this many samples.
    fn film(samples: u32) -> Film {
        let mut film = Film::new(1, 1, 1);
        (0..samples).for_each(|_| film.tiles[0].add(0, [0.5; 3]));
        film.done = vec![samples + 3];
        film
    }

    #[test]
    fn every_render_has_a_checkpoint_of_its_own_and_only_more_samples_replace_it() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = |name: &str| folder.path().join(name);
        let first = path("w.checkpoint");
        fs::write(&first, "precious").expect("written");
        fs::create_dir(path("w-2.checkpoint")).expect("made");
        for (key, name) in [(1, "w-3.checkpoint"), (2, "w-4.checkpoint")] {
            assert_eq!(keep_checkpoint(&film(3), key, &first).expect("written"), Some((path(name), true)));
            assert_eq!(keep_checkpoint(&film(2), key, &first).expect("kept"), Some((path(name), false)));
            assert_eq!(checkpoint_at(&path(name), key), CheckpointAt::Own(SamplesKept::of(&film(3))));
            assert_eq!(checkpoint_at(&path(name), key + 1), CheckpointAt::Other);
            assert_eq!(keep_checkpoint(&film(5), key, &first).expect("written"), Some((path(name), true)));
            assert_eq!(checkpoint_at(&path(name), key), CheckpointAt::Own(SamplesKept::of(&film(5))));
        }
        assert_eq!(fs::read(&first).expect("there"), b"precious");
        for number in 5..=9 {
            fs::write(path(&format!("w-{number}.checkpoint")), "precious").expect("written");
        }
        assert_eq!(keep_checkpoint(&film(9), 3, &first).expect("no name is left"), None);
    }

    #[test]
    fn the_picture_s_samples_are_further_than_any_pilot_s() {
        let pilot = Film { pilot: true, ..film(9) };
        assert!(SamplesKept::of(&pilot) < SamplesKept::of(&film(0)));
        assert!(SamplesKept::of(&film(1)) < SamplesKept::of(&film(2)));
    }
}
