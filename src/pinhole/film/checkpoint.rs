//! Checkpoints: the state of a render between two runs of the program, as one file, and where that file is kept.
//!
//! The format is little-endian: the magic word `pinhole checkpoint`, the format's version, the key of plan and scene,
//! how many samples there are, the film's size and what it keeps; then, tile by tile, steps done, planned samples, sums, counts, rejected samples,
//! moments and layers; then the splats; last the CRC-32 of every number before it.
//!
//! The checksum detects damage but is not a signature: anyone can write a checkpoint of any picture.
//! Therefore nothing in the file determines how much memory is allocated, and a state that no render can have produced
//! is an error.

use super::plausible::is_plausible;
use super::{Film, FilmLayers, FilmMoments, FilmSplats, FilmTile, Rejected, Replaces, Target, write_whole};
use crate::scene::{FileKind, LayerKind, Unopened, check_memory, open_file, printable_path};
use crate::{Error, Result};
use std::io::{self, BufReader, Read, Write};
use std::path::{Path, PathBuf};

/// The magic word at the start of a checkpoint.
const WORD: [u8; 20] = *b"pinhole checkpoint\r\n";
/// The version of the format; files of other versions are not read.
const VERSION: u32 = 4;
/// The file kind; the largest film with everything that it can keep stays below this size.
const CHECKPOINT: FileKind = FileKind { name: "a checkpoint", max: 1 << 40 };
/// How many numbers are read or written at once.
const AT_ONCE: usize = 4096;
// Flags for what a film keeps.
const MOMENTS: u32 = 1;
const LAYERS: u32 = 2;
const PILOT: u32 = 4;
const PLANNED: u32 = 8;
const SPLATS: u32 = 16;

/// Writes the state of a film atomically, with the key that identifies what it is a film of.
///
/// Errors: the path and the error of the operating system; a previous file at the path is then unchanged.
pub fn write_checkpoint<'a>(film: &Film, key: u64, target: impl Into<Target<'a>>) -> Result {
    write_whole(target, |file| {
        file.write_all(&WORD)?;
        let mut out = Numbers { stream: file, sum: crc32fast::Hasher::new() };
        out.write_u32(VERSION)?;
        out.write_u64(key)?;
        let SamplesKept { phase, samples, steps } = SamplesKept::of(film);
        out.write_u32s(&[phase, steps])?;
        out.write_u64(samples)?;
        out.write_u32s(&shape(film))?;
        write_film(film, &mut out)?;
        let sum = out.sum.clone().finalize();
        out.write_u32(sum)
    })
}

/// The beginning of a checkpoint.
pub(super) struct Heading {
    /// What it is a film of.
    pub key: u64,
    /// How far it is.
    pub kept: SamplesKept,
}

/// Reads the beginning of a checkpoint.
///
/// Errors: why the file cannot be opened; none where it is no checkpoint of this version.
pub(super) fn heading(path: &Path) -> std::result::Result<Heading, Option<Unopened>> {
    let mut file = open_file(path, CHECKPOINT).map_err(|error| Some(error.why))?.file;
    let mut word = [0; WORD.len()];
    let mut read = || {
        file.read_exact(&mut word)?;
        let mut numbers = Numbers { stream: &mut file, sum: crc32fast::Hasher::new() };
        let (version, key) = (numbers.read_u32()?, numbers.read_u64()?);
        Ok((version, Heading { key, kept: numbers.read_kept()? }))
    };
    let (version, heading) = read().map_err(|_: io::Error| None)?;
    if word == WORD && version == VERSION { Ok(heading) } else { Err(None) }
}

/// Reads the state of a film with the size and contents of `film`, which belongs to the render that is to be continued;
/// `adaptive` says whether the number of samples depends on the error.
///
/// Errors, each one sentence: the file does not exist or cannot be read, is not a checkpoint, has another version or
/// another key, or is truncated or damaged.
pub fn read_checkpoint(key: u64, film: &Film, adaptive: bool, path: &Path) -> Result<Film> {
    let failed = |what: &str| Error::Usage(format!("cannot continue from {}: {what}", printable_path(path)));
    let damaged = || failed("the file is cut short or damaged");
    let unread = |error: io::Error| match error.kind() {
        io::ErrorKind::UnexpectedEof | io::ErrorKind::InvalidData => damaged(),
        _ => failed(&error.to_string()),
    };
    let opened = open_file(path, CHECKPOINT).map_err(|error| Error::Usage(format!("cannot continue: {error}")))?;
    let length = opened.metadata.len();
    let mut file = BufReader::new(opened.file);
    let mut word = [0; WORD.len()];
    file.read_exact(&mut word).map_err(unread)?;
    if word != WORD {
        return Err(failed("it is not a checkpoint of pinhole"));
    }
    let mut numbers = Numbers { stream: file, sum: crc32fast::Hasher::new() };
    let version = numbers.read_u32().map_err(unread)?;
    if version != VERSION {
        return Err(failed(&format!("it has version {version}, but this program reads version {VERSION}")));
    }
    if numbers.read_u64().map_err(unread)? != key {
        return Err(failed(
            "it belongs to another scene, size, seed, sampler, filter or set of layers, or to another build of the \
             program; render without --resume to start over",
        ));
    }
    numbers.read_kept().map_err(unread)?;
    let mut found = [0; 5];
    numbers.read_u32s(&mut found).map_err(unread)?;
    let extra = if adaptive { found[3] & (PILOT | PLANNED) } else { 0 };
    let mut expected = shape(film);
    expected[3] = expected[3] & !(PILOT | PLANNED) | extra;
    let min = least_length(film, extra & PLANNED != 0);
    // Negative sums exist from the first sample of negative weight on, and each tile keeps its first rejected samples.
    let max = min + film.tiles.iter().map(|tile| 28 * tile.count.len() as u64 + 24 * Rejected::MAX as u64).sum::<u64>();
    let has_mattes = film.layers.first().is_some_and(|layers| layers.kinds.contains(&LayerKind::Cryptomatte));
    // How many shapes a pixel shows, the film does not say.
    let max = if has_mattes { u64::MAX } else { max };
    if found != expected || !(min..=max).contains(&length) {
        return Err(damaged());
    }
    check_memory(length).map_err(|too_little| failed(&format!("its film {too_little}")))?;
    let mut read = Film { pilot: extra & PILOT != 0, ..film.emptied() };
    if extra & PLANNED != 0 {
        read.planned = read.tiles.iter().map(|tile| vec![0; tile.count.len()]).collect();
    }
    read_film(&mut read, &mut numbers).map_err(unread)?;
    let sum = numbers.sum.clone().finalize();
    let whole = numbers.read_u32().map_err(unread)? == sum && numbers.stream.read(&mut [0]).map_err(unread)? == 0;
    if whole && is_plausible(&read) { Ok(read) } else { Err(damaged()) }
}

/// The header's description of a film: its size, the side of a tile, what it keeps, and its layers.
fn shape(film: &Film) -> [u32; 5] {
    let kept = [
        (MOMENTS, !film.moments.is_empty()),
        (LAYERS, !film.layers.is_empty()),
        (PILOT, film.pilot),
        (PLANNED, !film.planned.is_empty()),
        (SPLATS, film.splats.is_some()),
    ];
    let keeps = kept.iter().filter(|(_, kept)| *kept).map(|(bit, _)| bit).sum();
    let kinds = film.layers.first().map_or(0, FilmLayers::kind_bits);
    [film.width, film.height, film.tile_side, keeps, kinds]
}

/// The length in bytes of the checkpoint of such a film if no sample was rejected or has negative weight.
fn least_length(film: &Film, planned: bool) -> u64 {
    let pixels = u64::from(film.width) * u64::from(film.height);
    let layers = film.layers.first().map_or(0, |layers| 12 + 8 * layers.sums.len() as u64);
    let moments = if film.moments.is_empty() { 0 } else { 24 };
    let (splats, of_splats) = if film.splats.is_some() { (24, 16) } else { (0, 0) };
    let a_pixel = 28 + layers + moments + splats + if planned { 4 } else { 0 };
    // The magic word, the version, the key, how far it is, the size and the checksum; per tile its steps, whether it has
    // negative sums, and how many samples were rejected and are kept.
    WORD.len() as u64 + 4 + 8 + 16 + 20 + 4 + of_splats + 20 * film.tiles.len() as u64 + a_pixel * pixels
}

fn write_film<S: Write>(film: &Film, out: &mut Numbers<S>) -> io::Result<()> {
    for (number, tile) in film.tiles.iter().enumerate() {
        out.write_u32(film.done[number])?;
        if let Some(planned) = film.planned.get(number) {
            out.write_u32s(planned)?;
        }
        for component in &tile.sum {
            out.write_f64s(component)?;
        }
        out.write_u32s(&tile.count)?;
        out.write_u32(u32::from(!tile.negative_count.is_empty()))?;
        out.write_u32s(&tile.negative_count)?;
        for component in &tile.negative {
            out.write_f64s(component)?;
        }
        out.write_u64(tile.rejected)?;
        out.write_u32(tile.first_rejected.len() as u32)?;
        for rejected in &tile.first_rejected {
            out.write_u32s(&rejected.pixel)?;
            out.write_u32(rejected.sample)?;
            out.write_u32s(&rejected.radiance.map(f32::to_bits))?;
        }
        if let Some(moments) = film.moments.get(number) {
            for component in &moments.sum {
                out.write_f64s(component)?;
            }
        }
        if let Some(layers) = film.layers.get(number) {
            for component in layers.counts() {
                out.write_u32s(component)?;
            }
            for component in &layers.sums {
                out.write_f64s(component)?;
            }
            if layers.kinds.contains(&LayerKind::Cryptomatte) {
                out.write_u32(layers.mattes.len() as u32)?;
                layers.mattes.iter().try_for_each(|(&(row, shape), &count)| out.write_u32s(&[row, shape, count]))?;
            }
        }
    }
    if let Some(splats) = &film.splats {
        out.write_u64(splats.paths)?;
        out.write_u64(splats.rejected)?;
        for sums in &splats.sums {
            out.write_f64s(sums)?;
        }
    }
    Ok(())
}

/// Reads the contents of an empty film.
fn read_film<S: Read>(film: &mut Film, numbers: &mut Numbers<S>) -> io::Result<()> {
    for number in 0..film.tiles.len() {
        film.done[number] = numbers.read_u32()?;
        if let Some(planned) = film.planned.get_mut(number) {
            numbers.read_u32s(planned)?;
        }
        read_tile(&mut film.tiles[number], numbers)?;
        if let Some(FilmMoments { sum: [r, g, b] }) = film.moments.get_mut(number) {
            for component in [r, g, b] {
                numbers.read_f64s(component)?;
            }
        }
        if let Some(layers) = film.layers.get_mut(number) {
            for component in layers.counts_mut() {
                numbers.read_u32s(component)?;
            }
            for component in &mut layers.sums {
                numbers.read_f64s(component)?;
            }
            if layers.kinds.contains(&LayerKind::Cryptomatte) {
                // Nothing is allocated for what is not there to be read.
                for _ in 0..numbers.read_u32()? {
                    let mut matte = [0; 3];
                    numbers.read_u32s(&mut matte)?;
                    layers.mattes.insert((matte[0], matte[1]), matte[2]);
                }
            }
        }
    }
    if let Some(FilmSplats { paths, rejected, sums, .. }) = &mut film.splats {
        (*paths, *rejected) = (numbers.read_u64()?, numbers.read_u64()?);
        for sums in sums {
            numbers.read_f64s(sums)?;
        }
    }
    Ok(())
}

fn read_tile<S: Read>(tile: &mut FilmTile, numbers: &mut Numbers<S>) -> io::Result<()> {
    for component in &mut tile.sum {
        numbers.read_f64s(component)?;
    }
    numbers.read_u32s(&mut tile.count)?;
    if numbers.read_u32()? != 0 {
        let rows = tile.count.len();
        tile.negative_count.resize(rows, 0);
        numbers.read_u32s(&mut tile.negative_count)?;
        for component in &mut tile.negative {
            component.resize(rows, 0.0);
            numbers.read_f64s(component)?;
        }
    }
    tile.rejected = numbers.read_u64()?;
    let remembered = numbers.read_u32()?;
    if remembered as usize > Rejected::MAX {
        return Err(io::ErrorKind::InvalidData.into());
    }
    for _ in 0..remembered {
        let pixel = [numbers.read_u32()?, numbers.read_u32()?];
        let sample = numbers.read_u32()?;
        let mut radiance = [0; 3];
        numbers.read_u32s(&mut radiance)?;
        tile.first_rejected.push(Rejected { pixel, sample, radiance: radiance.map(f32::from_bits) });
    }
    Ok(())
}

/// A stream of numbers, with the checksum of those that have been read or written.
struct Numbers<S> {
    stream: S,
    sum: crc32fast::Hasher,
}

impl<S: Write> Numbers<S> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.sum.update(bytes);
        self.stream.write_all(bytes)
    }

    fn write_u32(&mut self, number: u32) -> io::Result<()> {
        self.write(&number.to_le_bytes())
    }

    fn write_u64(&mut self, number: u64) -> io::Result<()> {
        self.write(&number.to_le_bytes())
    }

    fn write_u32s(&mut self, numbers: &[u32]) -> io::Result<()> {
        let mut some = numbers.chunks(AT_ONCE);
        some.try_for_each(|some| {
            self.write(some.iter().map(|number| number.to_le_bytes()).collect::<Vec<_>>().as_flattened())
        })
    }

    fn write_f64s(&mut self, numbers: &[f64]) -> io::Result<()> {
        let mut some = numbers.chunks(AT_ONCE);
        some.try_for_each(|some| {
            self.write(some.iter().map(|number| number.to_le_bytes()).collect::<Vec<_>>().as_flattened())
        })
    }
}

impl<S: Read> Numbers<S> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<()> {
        self.stream.read_exact(bytes)?;
        self.sum.update(bytes);
        Ok(())
    }

    fn read_u32(&mut self) -> io::Result<u32> {
        let mut bytes = [0; 4];
        self.read(&mut bytes)?;
        Ok(u32::from_le_bytes(bytes))
    }

    fn read_u64(&mut self) -> io::Result<u64> {
        let mut bytes = [0; 8];
        self.read(&mut bytes)?;
        Ok(u64::from_le_bytes(bytes))
    }

    fn read_kept(&mut self) -> io::Result<SamplesKept> {
        let (phase, steps) = (self.read_u32()?, self.read_u32()?);
        Ok(SamplesKept { phase, samples: self.read_u64()?, steps })
    }

    fn read_u32s(&mut self, numbers: &mut [u32]) -> io::Result<()> {
        for some in numbers.chunks_mut(AT_ONCE) {
            let mut bytes = vec![[0; 4]; some.len()];
            self.read(bytes.as_flattened_mut())?;
            some.iter_mut().zip(bytes).for_each(|(number, bytes)| *number = u32::from_le_bytes(bytes));
        }
        Ok(())
    }

    fn read_f64s(&mut self, numbers: &mut [f64]) -> io::Result<()> {
        for some in numbers.chunks_mut(AT_ONCE) {
            let mut bytes = vec![[0; 8]; some.len()];
            self.read(bytes.as_flattened_mut())?;
            some.iter_mut().zip(bytes).for_each(|(number, bytes)| *number = f64::from_le_bytes(bytes));
        }
        Ok(())
    }
}

// Where a render's checkpoint is kept: beside its picture, under the first name that is free or its own.
//
// A checkpoint of another render stays, as does one of the same render that holds more samples, and any other file.

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
mod checkpoint_place_tests {
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
