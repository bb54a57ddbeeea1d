//! One run: its image, its times, and the file that lets a stopped report go on.

use crate::measure::image_error::Numbers;
use pinhole::film::{Film, Replaces, remove_own, write_whole};
use pinhole::scene::{FNV_BASIS, FileKind, fnv, open_file, read_file};
use pinhole::{Error, Result};
use serde::{Deserialize, Serialize};
use std::fs;
use std::io::{BufRead, Read, Write};
use std::path::{Path, PathBuf};

const RUN: FileKind = FileKind { name: "a kept run", max: 1 << 36 };

/// The times of one run, in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// Wall time of plan, tables and render.
    pub wall: f64,
    /// CPU time of the process in that time.
    pub cpu: f64,
    /// CPU time before the first tile: checking, planning, building tables and the workers' worlds.
    pub build: f64,
}

impl Times {
    /// CPU time of the render alone.
    pub fn render(&self) -> f64 {
        (self.cpu - self.build).max(0.0)
    }
}

/// One image, how it was made and what it took.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The image, linear Rec. 709.
    pub image: Numbers,
    /// Its times.
    pub times: Times,
    /// Samples that were negative or not finite, and so did not join the film.
    pub rejected: u64,
}

/// The line that a run's file begins with.
#[derive(Serialize, Deserialize)]
struct Heading {
    made_from: String,
    size: [u32; 2],
    times: Times,
    rejected: u64,
}

/// A hash (FNV-1a, 64 bits) of any bytes, in sixteen hexadecimal digits.
pub fn hash(bytes: &[u8]) -> String {
    format!("{:016x}", fnv(FNV_BASIS, bytes))
}

/// What tells this program from one built of other sources: the length of its file, and when it was written.
///
/// Times of two programs make no curve together, so a stopped report goes on only with the program that began it.
pub fn this_program() -> String {
    let file = std::env::current_exe().and_then(fs::metadata);
    file.map(|file| format!("{} {:?}", file.len(), file.modified().ok())).unwrap_or_default()
}

/// A film as numbers to be compared.
pub fn numbers(film: &Film) -> Numbers {
    let pixels = (0..film.height).flat_map(|y| (0..film.width).map(move |x| film.mean(x, y).map(f64::from)));
    Numbers { size: [film.width, film.height], pixels: pixels.collect(), white: None }
}

/// Where the runs of a report are kept until it is done.
///
/// Each run is a file of its own, written whole, so that a report can be stopped at any moment and go on.
#[derive(Clone, Debug)]
pub struct Shelf {
    folder: PathBuf,
    /// A fingerprint of all that decides the images; runs made from anything else are not taken.
    made_from: String,
}

impl Shelf {
    /// A shelf in this folder for runs of this fingerprint.
    pub fn new(folder: PathBuf, made_from: String) -> Self {
        Self { folder, made_from }
    }

    fn file(&self, name: &str) -> PathBuf {
        self.folder.join(format!("{name}.run"))
    }

    /// The run of this name, if it was made from the same.
    pub fn take(&self, name: &str) -> Option<Run> {
        let bytes = read_file(&self.file(name), RUN).ok()?;
        let end = bytes.iter().position(|byte| *byte == b'\n')?;
        let heading: Heading = serde_json::from_slice(&bytes[..end]).ok()?;
        let Heading { made_from, size, times, rejected } = heading;
        let values: Vec<f64> = (bytes[end + 1..].chunks_exact(8))
            .map(|chunk| f64::from_le_bytes([0, 1, 2, 3, 4, 5, 6, 7].map(|byte| chunk[byte])))
            .collect();
        let whole = values.len() as u64 == 3_u64.saturating_mul(u64::from(size[0]) * u64::from(size[1]));
        let pixels = values.chunks_exact(3).map(|parts| [parts[0], parts[1], parts[2]]).collect();
        let run = Run { image: Numbers { size, pixels, white: None }, times, rejected };
        (whole && made_from == self.made_from).then_some(run)
    }

    /// Keeps a run.
    ///
    /// Errors: the path and what the system said.
    pub fn keep(&self, name: &str, run: &Run) -> Result {
        let Run { image, times, rejected } = run;
        let heading =
            Heading { made_from: self.made_from.clone(), size: image.size, times: *times, rejected: *rejected };
        let heading = serde_json::to_string(&heading).map_err(std::io::Error::from)?;
        write_whole(Replaces::If(&is_run).at(&self.file(name)), |file| {
            writeln!(file, "{heading}")?;
            image.pixels.iter().flatten().try_for_each(|part| file.write_all(&part.to_le_bytes()))
        })
    }

    /// Takes the runs away once the report is written, and the folder if nothing else is in it.
    ///
    /// Errors: the path and what the system said.
    pub fn clear(&self) -> Result {
        let refused = |source| Error::Write { path: self.folder.clone(), source };
        let entries = match fs::read_dir(&self.folder) {
            Err(source) if source.kind() == std::io::ErrorKind::NotFound => return Ok(()),
            entries => entries.map_err(refused)?,
        };
        for entry in entries {
            let path = entry.map_err(refused)?.path();
            if is_run(&path) {
                remove_own(Replaces::If(&is_run).at(&path))?;
            }
        }
        // Somebody else's file keeps its folder.
        let _ = fs::remove_dir(&self.folder);
        Ok(())
    }
}

/// Whether a file is one of a run, of whatever report.
fn is_run(path: &Path) -> bool {
    const LONGEST_HEADING: u64 = 4096;
    let mut line = Vec::new();
    let opened = open_file(path, RUN).ok().map(|own| std::io::BufReader::new(own.file.take(LONGEST_HEADING)));
    let read = opened.and_then(|mut file| file.read_until(b'\n', &mut line).ok());
    read.is_some() && serde_json::from_slice::<Heading>(&line).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kept_run_comes_back_bit_for_bit_and_another_report_s_does_not() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let shelf = |made_from: &str| Shelf::new(folder.path().join("runs"), made_from.into());
        let image = Numbers { size: [2, 1], pixels: vec![[0.1, 1e-300, 2.0], [0.0, 1.0 / 3.0, 7.0]], white: None };
        let times = Times { wall: 0.25, cpu: 0.2, build: 0.05 };
        let run = Run { image, times, rejected: 3 };
        shelf("a").keep("one", &run).expect("written");
        assert_eq!(shelf("a").take("one"), Some(run));
        assert_eq!(shelf("b").take("one"), None);
        assert_eq!(shelf("a").take("other"), None);
        let file = folder.path().join("runs/one.run");
        let bytes = fs::read(&file).expect("read");
        fs::write(&file, &bytes[..bytes.len() - 8]).expect("written");
        assert_eq!(shelf("a").take("one"), None, "half a file is no run");
        shelf("a").clear().expect("cleared");
        shelf("a").clear().expect("nothing to clear is no error");
        assert!(!folder.path().join("runs").exists());
    }
}
