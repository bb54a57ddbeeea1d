//! Checkpoints: the state of a render between two runs of the program, as one file, and where that file is kept.
//!
//! The format is little-endian: the magic word `pinhole checkpoint`, the format's version, the key of plan and scene,
//! how many samples there are, the film's size and what it keeps; then, tile by tile, steps done, planned samples, sums, counts, rejected samples,
//! sums of earlier blocks, moments and layers; then the splats; last the CRC-32 of every number before it.
//!
//! The checksum detects damage but is not a signature: anyone can write a checkpoint of any picture.
//! Therefore nothing in the file determines how much memory is allocated, and a state that no render can have produced
//! is an error.

use super::plausible::is_plausible;
use super::{
    EarlierBlocks, Film, FilmLayers, FilmMoments, FilmSplats, FilmTile, Rejected, Replaces, Target, write_whole,
};
use crate::each::Each;
use crate::scene::{FileKind, LayerKind, Unopened, check_memory, open_file, printable_path};
use crate::{Error, Result};
use std::fs::File;
use std::io::{self, BufReader, Read, Write};
use std::path::{Path, PathBuf};

/// The magic word at the start of a checkpoint.
const WORD: [u8; 20] = *b"pinhole checkpoint\r\n";
/// The version of the format; files of other versions are not read.
const VERSION: u32 = 5;
/// The file kind; the largest film with everything that it can keep stays below this size.
pub(super) const CHECKPOINT: FileKind = FileKind { name: "a checkpoint", max: 1 << 40 };
/// How many numbers are read or written at once.
const AT_ONCE: usize = 4096;
// Flags for what a film keeps.
const MOMENTS: u32 = 1;
const LAYERS: u32 = 2;
const PILOT: u32 = 4;
pub(super) const PLANNED: u32 = 8;
const SPLATS: u32 = 16;
pub(super) const PART: u32 = 32;
const DONE: u32 = 64;

/// Writes the state of a film atomically, with the key that identifies what it is a film of.
///
/// Errors: the path and the error of the operating system; a previous file at the path is then unchanged.
pub fn write_checkpoint<'a>(film: &Film, key: u64, target: impl Into<Target<'a>>) -> Result {
    write_whole(target, |file| {
        let mut out = begin(file, key, SamplesKept::of(film), shape(film))?;
        write_film(film, &mut out)?;
        out.end()
    })
}

/// Writes that a picture is done, in the place of a checkpoint: its beginning alone.
///
/// Errors: the path and the error of the operating system.
pub fn write_done<'a>(film: &Film, key: u64, target: impl Into<Target<'a>>) -> Result {
    write_whole(target, |file| {
        let mut shape = shape(film);
        shape[3] |= DONE;
        begin(file, key, SamplesKept::of(film), shape)?.end()
    })
}

/// Whether a picture with this key, of at least so many samples a pixel, is said to be done.
pub fn is_done(path: &Path, key: u64, samples: u32) -> bool {
    let steps = samples.saturating_add(super::FIRST_SAMPLE_STEPS - 1);
    opened(path, "continue", "continue from")
        .is_ok_and(|own| own.shape[3] & DONE != 0 && own.heading.key == key && own.heading.kept.steps >= steps)
}

/// Writes the beginning of a checkpoint.
pub(super) fn begin<S: Write>(mut file: S, key: u64, kept: SamplesKept, shape: [u32; 5]) -> io::Result<Numbers<S>> {
    file.write_all(&WORD)?;
    let mut out = Numbers::new(file);
    out.write_u32(VERSION)?;
    out.write_u64(key)?;
    out.write_u32s(&[kept.phase, kept.steps])?;
    out.write_u64(kept.samples)?;
    out.write_u32s(&shape)?;
    Ok(out)
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
        let mut numbers = Numbers::new(&mut file);
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
    let unread = |error: io::Error| failed(&why_unread(&error));
    let Opened { heading, shape: found, mut numbers, length } = opened(path, "continue", "continue from")?;
    if found[3] & PART != 0 {
        return Err(failed("it is a part of a render, and `merge` joins parts"));
    }
    if found[3] & DONE != 0 {
        return Err(failed("it says no more than that a frame is done; render without --resume to start over"));
    }
    if heading.key != key {
        return Err(failed(
            "it belongs to another scene, size, seed, sampler, filter or set of layers, or to a program that computes \
             other numbers; render without --resume to start over",
        ));
    }
    let extra = if adaptive { found[3] & (PILOT | PLANNED) } else { 0 };
    let mut expected = shape(film);
    expected[3] = expected[3] & !(PILOT | PLANNED) | extra;
    let min = least_length(film, extra & PLANNED != 0);
    // Negative sums exist from the first sample of negative weight on, sums of earlier blocks from the second on, and each
    // tile keeps its first rejected samples.
    let a_row = 28 + 28 + 24 + 24 + 8 * film.layers.first().map_or(0, |layers| layers.sums.len() as u64);
    let more = |tile: &FilmTile| a_row * tile.count.len() as u64 + 24 * Rejected::MAX as u64 + 4;
    let max = min + film.tiles.iter().map(more).sum::<u64>();
    let has_mattes = film.layers.first().is_some_and(|layers| layers.kinds.contains(&LayerKind::Cryptomatte));
    // How many shapes a pixel shows, the film does not say.
    let max = if has_mattes { u64::MAX } else { max };
    if found != expected || !(min..=max).contains(&length) {
        return Err(failed(DAMAGED));
    }
    check_memory(length).map_err(|too_little| failed(&format!("its film {too_little}")))?;
    let mut read = Film { pilot: extra & PILOT != 0, ..film.emptied() };
    if extra & PLANNED != 0 {
        read.planned = read.tiles.iter().map(|tile| vec![0; tile.count.len()]).collect();
    }
    read_film(&mut read, &mut numbers).map_err(unread)?;
    let whole = numbers.ends_here().map_err(unread)?;
    if whole && is_plausible(&read) { Ok(read) } else { Err(failed(DAMAGED)) }
}

/// What is said of a file that cannot be whole.
pub(super) const DAMAGED: &str = "the file is cut short or damaged";

/// Why a file could not be read, in words.
pub(super) fn why_unread(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::UnexpectedEof | io::ErrorKind::InvalidData => DAMAGED.into(),
        _ => error.to_string(),
    }
}

/// A checkpoint of which the beginning has been read.
pub(super) struct Opened {
    pub heading: Heading,
    /// The description of its film.
    pub shape: [u32; 5],
    /// The numbers that follow.
    pub numbers: Numbers<BufReader<File>>,
    /// The length of the file.
    pub length: u64,
}

/// Opens a checkpoint, for what is told in messages, and reads its beginning.
///
/// Errors, each one sentence: the file does not exist or cannot be read, is no checkpoint, or has another version.
pub(super) fn opened(path: &Path, verb: &str, verb_with_file: &str) -> Result<Opened> {
    let failed = |what: &str| Error::Usage(format!("cannot {verb_with_file} {}: {what}", printable_path(path)));
    let unread = |error: io::Error| failed(&why_unread(&error));
    let opened = open_file(path, CHECKPOINT).map_err(|error| Error::Usage(format!("cannot {verb}: {error}")))?;
    let length = opened.metadata.len();
    let mut file = BufReader::new(opened.file);
    let mut word = [0; WORD.len()];
    file.read_exact(&mut word).map_err(unread)?;
    if word != WORD {
        return Err(failed("it is not a checkpoint of pinhole"));
    }
    let mut numbers = Numbers::new(file);
    let version = numbers.read_u32().map_err(unread)?;
    if version != VERSION {
        return Err(failed(&format!("it has version {version}, but this program reads version {VERSION}")));
    }
    let key = numbers.read_u64().map_err(unread)?;
    let kept = numbers.read_kept().map_err(unread)?;
    let mut shape = [0; 5];
    numbers.read_u32s(&mut shape).map_err(unread)?;
    Ok(Opened { heading: Heading { key, kept }, shape, numbers, length })
}

/// The header's description of a film: its size, the side of a tile, what it keeps, and its layers.
pub(super) fn shape(film: &Film) -> [u32; 5] {
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
    // negative sums and earlier ones, and how many samples were rejected and are kept.
    WORD.len() as u64 + 4 + 8 + 16 + 20 + 4 + of_splats + 24 * film.tiles.len() as u64 + a_pixel * pixels
}

fn write_film<S: Write>(film: &Film, out: &mut Numbers<S>) -> io::Result<()> {
    for (number, tile) in film.tiles.iter().enumerate() {
        out.write_u32(film.done[number])?;
        if let Some(planned) = film.planned.get(number) {
            out.write_u32s(planned)?;
        }
        write_tile(tile, film.moments.get(number), film.layers.get(number), out)?;
    }
    if let Some(splats) = &film.splats {
        out.write_u64(splats.paths)?;
        out.write_u64(splats.rejected)?;
        out.write_all_f64s(&splats.sums)?;
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
        read_tile(&mut film.tiles[number], film.moments.get_mut(number), film.layers.get_mut(number), numbers)?;
    }
    if let Some(FilmSplats { paths, rejected, sums, .. }) = &mut film.splats {
        (*paths, *rejected) = (numbers.read_u64()?, numbers.read_u64()?);
        numbers.read_all_f64s(sums)?;
    }
    Ok(())
}

/// Writes what a film keeps of a tile.
pub(super) fn write_tile<S: Write>(
    tile: &FilmTile,
    moments: Option<&FilmMoments>,
    layers: Option<&FilmLayers>,
    out: &mut Numbers<S>,
) -> io::Result<()> {
    out.write_all_f64s(&tile.sum)?;
    out.write_u32s(&tile.count)?;
    out.write_u32(u32::from(!tile.negative_count.is_empty()))?;
    out.write_u32s(&tile.negative_count)?;
    out.write_all_f64s(&tile.negative)?;
    out.write_u64(tile.rejected)?;
    out.write_u32(tile.first_rejected.len() as u32)?;
    for rejected in &tile.first_rejected {
        out.write_u32s(&rejected.pixel)?;
        out.write_u32(rejected.sample)?;
        out.write_u32s(&rejected.radiance.each(f32::to_bits))?;
    }
    out.write_u32(u32::from(tile.earlier.is_some()))?;
    if let Some(earlier) = &tile.earlier {
        out.write_all_f64s(&earlier.sum)?;
        out.write_u32s(&earlier.count)?;
        out.write_u32(u32::from(!earlier.negative[0].is_empty()))?;
        out.write_all_f64s(&earlier.negative)?;
    }
    if let Some(moments) = moments {
        out.write_all_f64s(&moments.sum)?;
        if tile.earlier.is_some() {
            out.write_all_f64s(&moments.earlier)?;
        }
    }
    if let Some(layers) = layers {
        for component in layers.counts() {
            out.write_u32s(component)?;
        }
        out.write_all_f64s(&layers.sums)?;
        if tile.earlier.is_some() {
            out.write_all_f64s(&layers.earlier)?;
        }
        if layers.kinds.contains(&LayerKind::Cryptomatte) {
            out.write_u32(layers.mattes.len() as u32)?;
            layers.mattes.iter().try_for_each(|(&(row, shape), &count)| out.write_u32s(&[row, shape, count]))?;
        }
    }
    Ok(())
}

/// Reads what a film keeps of a tile into empty ones.
pub(super) fn read_tile<S: Read>(
    tile: &mut FilmTile,
    moments: Option<&mut FilmMoments>,
    layers: Option<&mut FilmLayers>,
    numbers: &mut Numbers<S>,
) -> io::Result<()> {
    let rows = tile.count.len();
    numbers.read_all_f64s(&mut tile.sum)?;
    numbers.read_u32s(&mut tile.count)?;
    if numbers.read_u32()? != 0 {
        tile.negative_count.resize(rows, 0);
        numbers.read_u32s(&mut tile.negative_count)?;
        tile.negative.iter_mut().for_each(|component| component.resize(rows, 0.0));
        numbers.read_all_f64s(&mut tile.negative)?;
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
        tile.first_rejected.push(Rejected { pixel, sample, radiance: radiance.each(f32::from_bits) });
    }
    let zeros = || vec![0.0; rows];
    if numbers.read_u32()? != 0 {
        let sum = [zeros(), zeros(), zeros()];
        let mut earlier = EarlierBlocks { sum, count: vec![0; rows], ..EarlierBlocks::default() };
        numbers.read_all_f64s(&mut earlier.sum)?;
        numbers.read_u32s(&mut earlier.count)?;
        if numbers.read_u32()? != 0 {
            earlier.negative = [zeros(), zeros(), zeros()];
            numbers.read_all_f64s(&mut earlier.negative)?;
        }
        tile.earlier = Some(Box::new(earlier));
    }
    if let Some(moments) = moments {
        numbers.read_all_f64s(&mut moments.sum)?;
        if tile.earlier.is_some() {
            moments.earlier = [zeros(), zeros(), zeros()];
            numbers.read_all_f64s(&mut moments.earlier)?;
        }
    }
    if let Some(layers) = layers {
        for component in layers.counts_mut() {
            numbers.read_u32s(component)?;
        }
        numbers.read_all_f64s(&mut layers.sums)?;
        if tile.earlier.is_some() {
            layers.earlier = vec![zeros(); layers.sums.len()];
            numbers.read_all_f64s(&mut layers.earlier)?;
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
    Ok(())
}

/// A stream of numbers, with the checksum of those that have been read or written.
pub(super) struct Numbers<S> {
    stream: S,
    sum: crc32fast::Hasher,
    /// The checksum of an entry, and how many bytes have been read.
    entry: Option<crc32fast::Hasher>,
    offset: u64,
}

impl<S> Numbers<S> {
    /// The numbers after the magic word.
    pub fn new(stream: S) -> Self {
        Self { stream, sum: crc32fast::Hasher::new(), entry: None, offset: WORD.len() as u64 }
    }

    /// Begins an entry that is to have a checksum of its own, and gives its place in the file.
    pub fn begin_entry(&mut self) -> u64 {
        self.entry = Some(crc32fast::Hasher::new());
        self.offset
    }

    /// The checksum of the entry that ends here.
    pub fn sum_of_entry(&mut self) -> u32 {
        self.entry.take().map_or(0, crc32fast::Hasher::finalize)
    }
}

impl<S: Write> Numbers<S> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.sum.update(bytes);
        self.stream.write_all(bytes)
    }

    /// Writes the checksum, with which a file ends.
    pub fn end(&mut self) -> io::Result<()> {
        let sum = self.sum.clone().finalize();
        self.write_u32(sum)
    }

    pub fn write_u32(&mut self, number: u32) -> io::Result<()> {
        self.write(&number.to_le_bytes())
    }

    pub fn write_u64(&mut self, number: u64) -> io::Result<()> {
        self.write(&number.to_le_bytes())
    }

    pub fn write_u32s(&mut self, numbers: &[u32]) -> io::Result<()> {
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

    pub fn write_all_f64s(&mut self, components: &[Vec<f64>]) -> io::Result<()> {
        components.iter().try_for_each(|component| self.write_f64s(component))
    }
}

impl<S: Read> Numbers<S> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<()> {
        self.stream.read_exact(bytes)?;
        self.sum.update(bytes);
        if let Some(entry) = &mut self.entry {
            entry.update(bytes);
        }
        self.offset += bytes.len() as u64;
        Ok(())
    }

    /// Whether the file ends here, with the checksum of all that was read.
    pub fn ends_here(&mut self) -> io::Result<bool> {
        let sum = self.sum.clone().finalize();
        Ok(self.read_u32()? == sum && self.stream.read(&mut [0])? == 0)
    }

    pub fn read_u32(&mut self) -> io::Result<u32> {
        let mut bytes = [0; 4];
        self.read(&mut bytes)?;
        Ok(u32::from_le_bytes(bytes))
    }

    pub fn read_u64(&mut self) -> io::Result<u64> {
        let mut bytes = [0; 8];
        self.read(&mut bytes)?;
        Ok(u64::from_le_bytes(bytes))
    }

    fn read_kept(&mut self) -> io::Result<SamplesKept> {
        let (phase, steps) = (self.read_u32()?, self.read_u32()?);
        Ok(SamplesKept { phase, samples: self.read_u64()?, steps })
    }

    pub fn read_u32s(&mut self, numbers: &mut [u32]) -> io::Result<()> {
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

    pub fn read_all_f64s(&mut self, components: &mut [Vec<f64>]) -> io::Result<()> {
        components.iter_mut().try_for_each(|component| self.read_f64s(component))
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
