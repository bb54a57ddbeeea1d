//! What persists of a render between two runs of the program, as one file.
//!
//! Little-endian: the word `pinhole checkpoint`, the format's version, the key of plan and scene, the film's shape, what
//! it keeps; then, tile by tile, steps done, planned samples, sums, counts, rejected samples, moments, layers; then what
//! rays from the lights brought; last a digest of every number before it.

use super::{Film, FilmLayers, FilmMoments, FilmSplats, FilmTile, Rejected, write_whole};
use crate::scene::LayerKind;
use crate::{Error, Result};
use std::fs::File;
use std::io::{self, BufReader, Read, Write};
use std::path::Path;

/// What a checkpoint begins with.
const WORD: [u8; 20] = *b"pinhole checkpoint\r\n";
/// A file of another version is refused.
const VERSION: u32 = 2;

/// Writes the state of a film whole, under the key of what it is a film of.
///
/// Errors: the path and what the system said; what stood there before is then still there.
pub fn write_checkpoint(film: &Film, key: u64, path: &Path) -> Result {
    write_whole(path, |file| {
        file.write_all(&WORD)?;
        let mut out = Numbers { stream: file, digest: Digest::default() };
        out.write_u32(VERSION)?;
        out.write_u64(key)?;
        write_film(film, &mut out)?;
        let digest = out.digest.0;
        out.write_u64(digest)
    })
}

/// Reads the state of a film.
///
/// Errors, each in one sentence: no such file or what the system said, another kind of file, another version, a film of
/// something else than `key`, a file that is cut or damaged.
pub fn read_checkpoint(key: u64, path: &Path) -> Result<Film> {
    let refused = |what: &str| Error::Usage(format!("cannot continue from {}: {what}", path.display()));
    let unread = |error: io::Error| match error.kind() {
        io::ErrorKind::UnexpectedEof | io::ErrorKind::InvalidData => refused("the file is cut short or damaged"),
        io::ErrorKind::NotFound => refused("there is no such file"),
        _ => refused(&error.to_string()),
    };
    let mut file = BufReader::new(File::open(path).map_err(unread)?);
    let mut word = [0; WORD.len()];
    file.read_exact(&mut word).map_err(unread)?;
    if word != WORD {
        return Err(refused("it is no checkpoint of pinhole"));
    }
    let mut numbers = Numbers { stream: file, digest: Digest::default() };
    let version = numbers.read_u32().map_err(unread)?;
    if version != VERSION {
        return Err(refused(&format!("it is of version {version}, but this program reads version {VERSION}")));
    }
    if numbers.read_u64().map_err(unread)? != key {
        return Err(refused(
            "it is of another scene, size, seed, sampler, filter or set of layers than is asked for now; \
             render without --resume to begin anew",
        ));
    }
    let length = path.metadata().map_err(unread)?.len();
    let film = read_film(&mut numbers, length).map_err(unread)?;
    let digest = numbers.digest.0;
    let whole = numbers.read_u64().map_err(unread)? == digest && numbers.stream.read(&mut [0]).map_err(unread)? == 0;
    if whole { Ok(film) } else { Err(refused("the file is cut short or damaged")) }
}

fn write_film<S: Write>(film: &Film, out: &mut Numbers<S>) -> io::Result<()> {
    for number in [film.width, film.height, film.tile_side] {
        out.write_u32(number)?;
    }
    let kinds = film.layers.first().map_or(0, FilmLayers::kind_bits);
    let keeps = [
        !film.moments.is_empty(),
        !film.layers.is_empty(),
        film.pilot,
        !film.planned.is_empty(),
        film.splats.is_some(),
    ];
    out.write_u32(keeps.iter().rev().fold(0, |bits, &keeps| bits << 1 | u32::from(keeps)))?;
    out.write_u32(kinds)?;
    for (number, tile) in film.tiles.iter().enumerate() {
        out.write_u32(film.done[number])?;
        if let Some(planned) = film.planned.get(number) {
            out.write_u32s(planned)?;
        }
        for lane in tile.sums() {
            out.write_f64s(lane)?;
        }
        out.write_u32s(&tile.count)?;
        out.write_u32(u32::from(!tile.negative_count.is_empty()))?;
        out.write_u32s(&tile.negative_count)?;
        for lane in &tile.negative {
            out.write_f64s(lane)?;
        }
        out.write_u64(tile.rejected)?;
        out.write_u32(tile.first_rejected.len() as u32)?;
        for rejected in &tile.first_rejected {
            out.write_u32s(&rejected.pixel)?;
            out.write_u32(rejected.sample)?;
            out.write_u32s(&rejected.radiance.map(f32::to_bits))?;
        }
        if let Some(moments) = film.moments.get(number) {
            for lane in [&moments.r, &moments.g, &moments.b] {
                out.write_f64s(lane)?;
            }
        }
        if let Some(layers) = film.layers.get(number) {
            for lane in layers.counts() {
                out.write_u32s(lane)?;
            }
            for lane in &layers.sums {
                out.write_f64s(lane)?;
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

fn read_film<S: Read>(numbers: &mut Numbers<S>, length: u64) -> io::Result<Film> {
    let [width, height, tile_side] = [numbers.read_u32()?, numbers.read_u32()?, numbers.read_u32()?];
    let (keeps, kind_bits) = (numbers.read_u32()?, numbers.read_u32()?);
    // A damaged size must not make the film larger than the file: a pixel takes at least its sums and its count.
    let pixels = u64::from(width) * u64::from(height);
    if tile_side == 0 || pixels.saturating_mul(28) > length || keeps > 31 {
        return Err(io::ErrorKind::InvalidData.into());
    }
    let kinds: Vec<LayerKind> = LayerKind::ALL.into_iter().filter(|&kind| kind_bits >> kind as u32 & 1 == 1).collect();
    let mut film = Film::new(width, height, tile_side);
    if keeps & 1 != 0 {
        film.moments = film.tiles.iter().map(|tile| FilmMoments::new(tile.tile.rows())).collect();
    }
    if keeps & 2 != 0 {
        film.layers = film.tiles.iter().map(|tile| FilmLayers::new(tile.tile.rows(), &kinds)).collect();
    }
    film.pilot = keeps & 4 != 0;
    if keeps & 8 != 0 {
        film.planned = film.tiles.iter().map(|tile| vec![0; tile.tile.rows()]).collect();
    }
    for number in 0..film.tiles.len() {
        film.done[number] = numbers.read_u32()?;
        if let Some(planned) = film.planned.get_mut(number) {
            numbers.read_u32s(planned)?;
        }
        read_tile(&mut film.tiles[number], numbers)?;
        if let Some(moments) = film.moments.get_mut(number) {
            for lane in [&mut moments.r, &mut moments.g, &mut moments.b] {
                numbers.read_f64s(lane)?;
            }
        }
        if let Some(layers) = film.layers.get_mut(number) {
            for lane in layers.counts_mut() {
                numbers.read_u32s(lane)?;
            }
            for lane in &mut layers.sums {
                numbers.read_f64s(lane)?;
            }
        }
    }
    if keeps & 16 != 0 {
        let mut splats = FilmSplats::new(width, height);
        (splats.paths, splats.rejected) = (numbers.read_u64()?, numbers.read_u64()?);
        for sums in &mut splats.sums {
            numbers.read_f64s(sums)?;
        }
        film.splats = Some(splats);
    }
    Ok(film)
}

fn read_tile<S: Read>(tile: &mut FilmTile, numbers: &mut Numbers<S>) -> io::Result<()> {
    for lane in tile.sums_mut() {
        numbers.read_f64s(lane)?;
    }
    numbers.read_u32s(&mut tile.count)?;
    if numbers.read_u32()? != 0 {
        let rows = tile.count.len();
        tile.negative_count.resize(rows, 0);
        numbers.read_u32s(&mut tile.negative_count)?;
        for lane in &mut tile.negative {
            lane.resize(rows, 0.0);
            numbers.read_f64s(lane)?;
        }
    }
    tile.rejected = numbers.read_u64()?;
    let remembered = numbers.read_u32()?;
    if remembered > 64 {
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

/// A digest of numbers in order: FNV-1a over 64-bit words.
struct Digest(u64);

impl Default for Digest {
    fn default() -> Self {
        Self(0xCBF2_9CE4_8422_2325)
    }
}

impl Digest {
    fn take(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0100_0000_01B3).rotate_left(23);
    }
}

/// Numbers on their way to or from a file, and the digest of those that have passed.
struct Numbers<S> {
    stream: S,
    digest: Digest,
}

impl<S: Write> Numbers<S> {
    fn write_u32(&mut self, number: u32) -> io::Result<()> {
        self.digest.take(u64::from(number));
        self.stream.write_all(&number.to_le_bytes())
    }

    fn write_u64(&mut self, number: u64) -> io::Result<()> {
        self.digest.take(number);
        self.stream.write_all(&number.to_le_bytes())
    }

    fn write_u32s(&mut self, numbers: &[u32]) -> io::Result<()> {
        numbers.iter().try_for_each(|&number| self.write_u32(number))
    }

    fn write_f64s(&mut self, numbers: &[f64]) -> io::Result<()> {
        numbers.iter().try_for_each(|&number| self.write_u64(number.to_bits()))
    }
}

impl<S: Read> Numbers<S> {
    fn read_u32(&mut self) -> io::Result<u32> {
        let mut bytes = [0; 4];
        self.stream.read_exact(&mut bytes)?;
        let number = u32::from_le_bytes(bytes);
        self.digest.take(u64::from(number));
        Ok(number)
    }

    fn read_u64(&mut self) -> io::Result<u64> {
        let mut bytes = [0; 8];
        self.stream.read_exact(&mut bytes)?;
        let number = u64::from_le_bytes(bytes);
        self.digest.take(number);
        Ok(number)
    }

    fn read_u32s(&mut self, numbers: &mut [u32]) -> io::Result<()> {
        for number in numbers {
            *number = self.read_u32()?;
        }
        Ok(())
    }

    fn read_f64s(&mut self, numbers: &mut [f64]) -> io::Result<()> {
        for number in numbers {
            *number = f64::from_bits(self.read_u64()?);
        }
        Ok(())
    }
}
