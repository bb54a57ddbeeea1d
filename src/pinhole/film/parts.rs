//! Parts of a render as files, and the picture that they add up to.
//!
//! A part holds units: the samples of one tile that were summed from zero, either all of them or one block (see
//! [`BLOCK`]), and batches of light paths with their splats.
//! Its file is a checkpoint with units in the place of a film.
//! [`merge_parts`] adds units in the order in which one machine would have: the sums have the same bits, whoever computed
//! them and in whatever order they arrive.

use super::checkpoint::{
    CHECKPOINT, DAMAGED, Heading, Numbers, Opened, PART, PLANNED, begin, opened, read_tile, shape, why_unread,
    write_tile,
};
use super::plausible::is_plausible_unit;
use super::{
    BLOCK, FIRST_SAMPLE_STEPS, Film, FilmLayers, FilmMoments, FilmTile, SamplesKept, SplatFilter, Target, write_whole,
};
use crate::follow::LIGHT_PATHS;
use crate::scene::{Filter, open_file, printable_path};
use crate::{Error, Result};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fs::File;
use std::hash::{BuildHasher, RandomState};
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// How the work of a render is divided into parts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Split {
    /// Each part has tiles all over the image, with all of their samples.
    Tiles,
    /// Each part has blocks of samples of every tile.
    Samples,
    /// Each part has blocks of samples of some tiles.
    Both,
    /// By tiles, or where there are more parts than tiles by both.
    #[default]
    Chosen,
}

impl Split {
    /// All, by the words that name them.
    pub const ALL: [(&'static str, Self); 4] =
        [("tiles", Self::Tiles), ("samples", Self::Samples), ("both", Self::Both), ("chosen", Self::Chosen)];
}

/// One of the parts of a render.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Part {
    /// Which, from 1.
    pub number: u32,
    /// Of how many.
    pub of: u32,
    /// How the work is divided.
    pub split: Split,
}

/// Some of a tile's samples, to be summed from zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Unit {
    /// The number of the block of samples; none for all samples.
    pub block: Option<u32>,
    /// The number of the tile.
    pub tile: u32,
}

impl Part {
    /// How the work is divided, where that was to be chosen.
    fn split(&self, tiles: u64, blocks: u64) -> Split {
        match self.split {
            Split::Chosen if u64::from(self.of) <= tiles || blocks == 1 => Split::Tiles,
            Split::Chosen => Split::Both,
            split => split,
        }
    }

    /// Which of so many equal shares are this part's.
    fn cut(&self, all: u64) -> Range<u64> {
        let of = u128::from(self.of.max(1));
        let before = |number: u32| (u128::from(all) * u128::from(number) / of) as u64;
        before(self.number.saturating_sub(1))..before(self.number)
    }

    /// The units of this part, of an image of so many tiles with so many samples; those of all parts are all there are.
    pub fn units(&self, tiles: u32, samples: u32) -> Vec<Unit> {
        let (spread, tiles, blocks) = (spread(tiles), u64::from(tiles), u64::from(blocks_of(samples)));
        let unit = |at: u64| Unit { block: Some((at / tiles) as u32), tile: spread[(at % tiles) as usize] };
        match self.split(tiles, blocks) {
            Split::Tiles => self.cut(tiles).map(|at| Unit { block: None, ..unit(at) }).collect(),
            Split::Samples => {
                self.cut(blocks).flat_map(|block| (block * tiles..(block + 1) * tiles).map(unit)).collect()
            }
            Split::Both | Split::Chosen => self.cut(tiles * blocks).map(unit).collect(),
        }
    }

    /// Whether a unit is one of this part's; `places` are those of the tiles in the order of [`spread`].
    fn holds(&self, unit: Unit, places: &[u64], samples: u32) -> bool {
        let (tiles, blocks) = (places.len() as u64, u64::from(blocks_of(samples)));
        let Some(&place) = places.get(unit.tile as usize) else { return false };
        match (self.split(tiles, blocks), unit.block.map(u64::from)) {
            (Split::Tiles, None) => self.cut(tiles).contains(&place),
            (Split::Samples, Some(block)) => self.cut(blocks).contains(&block),
            (Split::Both, Some(block)) => block < blocks && self.cut(tiles * blocks).contains(&(block * tiles + place)),
            _ => false,
        }
    }

    /// Which of so many batches of light paths are this part's.
    pub fn batches(&self, all: u64) -> Range<u64> {
        self.cut(all)
    }
}

/// The number of blocks of so many samples.
fn blocks_of(samples: u32) -> u32 {
    samples.div_ceil(BLOCK).max(1)
}

/// The tiles in an order in which none is near the one before, since neighbours take about the same time: in steps of
/// about the golden section of their number that have no divisor in common with it.
fn spread(tiles: u32) -> Vec<u32> {
    fn divisor(a: u64, b: u64) -> u64 {
        if b == 0 { a } else { divisor(b, a % b) }
    }
    let all = u64::from(tiles.max(1));
    let first = (all as f64 * 0.618_033_988_75) as u64;
    let step = (first.max(1)..).find(|&step| divisor(step, all) == 1).unwrap_or(1);
    (0..u64::from(tiles)).map(|at| (at * step % all) as u32).collect()
}

/// The place of each tile in that order.
fn places(tiles: u32) -> Vec<u64> {
    let mut places = vec![0; tiles as usize];
    spread(tiles).into_iter().enumerate().for_each(|(place, tile)| places[tile as usize] = place as u64);
    places
}

/// A unit with its sums.
#[derive(Clone, Debug, PartialEq)]
pub struct UnitFilm {
    /// Which.
    pub unit: Unit,
    /// How many samples each pixel was to get in all, where sampling is adaptive.
    pub planned: Option<Vec<u32>>,
    /// The sums.
    pub tile: FilmTile,
    /// The second moments, where they are kept.
    pub moments: Option<FilmMoments>,
    /// The layers, where they are kept.
    pub layers: Option<FilmLayers>,
}

/// Batches of light paths with their splats, in the order of the paths.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightUnit {
    /// The first batch.
    pub first: u64,
    /// How many there are.
    pub batches: u64,
    /// Where each splat lies on the raster: x, y.
    pub raster: [Vec<f64>; 2],
    /// Red, green and blue.
    pub rgb: [Vec<f64>; 3],
}

/// What there is of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct PartFilm {
    /// Which.
    pub part: Part,
    /// The number of samples of the whole render.
    pub samples: u32,
    /// The number of batches of light paths of the whole render.
    pub batches: u64,
    /// The units that are done.
    pub units: Vec<UnitFilm>,
    /// The batches of light paths that are done.
    pub light: Vec<LightUnit>,
}

/// The beginning of a part's file, after that of every checkpoint.
#[derive(Clone, Copy, Debug, PartialEq)]
struct PartHeading {
    part: Part,
    /// Whether each pixel has its own number of samples.
    planned: bool,
    samples: u32,
    batches: u64,
    units: u32,
    light: u32,
}

impl PartFilm {
    /// A part of which nothing is done.
    pub fn new(part: Part, samples: u32, batches: u64) -> Self {
        Self { part, samples, batches, units: Vec::new(), light: Vec::new() }
    }

    /// How far it is.
    pub fn kept(&self) -> SamplesKept {
        let samples: u64 = self.units.iter().flat_map(|own| &own.tile.count).map(|&count| u64::from(count)).sum();
        let paths: u64 = self.light.iter().map(|own| own.batches).sum();
        SamplesKept { phase: 1, samples: samples.saturating_add(paths), steps: self.units.len() as u32 }
    }

    /// Writes what there is, with the key and the shape of the film that it is a part of.
    ///
    /// Errors: the path and the error of the operating system; a previous file at the path is then unchanged.
    pub fn write<'a>(&self, film: &Film, key: u64, target: impl Into<Target<'a>>) -> Result {
        write_whole(target, |file| {
            let mut kept = shape(film);
            kept[3] |= PART;
            let mut out = begin(file, key, self.kept(), kept)?;
            let split = Split::ALL.iter().position(|(_, split)| *split == self.part.split).unwrap_or(0) as u32;
            out.write_u32s(&[self.part.number, self.part.of, split, self.samples])?;
            out.write_u64(self.batches)?;
            out.write_u32s(&[self.units.len() as u32, self.light.len() as u32])?;
            for own in &self.units {
                out.write_u32s(&[own.unit.tile, own.unit.block.unwrap_or(u32::MAX)])?;
                if let Some(planned) = &own.planned {
                    out.write_u32s(planned)?;
                }
                write_tile(&own.tile, own.moments.as_ref(), own.layers.as_ref(), &mut out)?;
            }
            for own in &self.light {
                out.write_u64(own.first)?;
                out.write_u64(own.batches)?;
                out.write_u64(own.rgb[0].len() as u64)?;
                out.write_all_f64s(&own.raster)?;
                out.write_all_f64s(&own.rgb)?;
            }
            out.end()
        })
    }

    /// Reads a part of a film of this shape.
    ///
    /// Errors, each one sentence: as for [`merge_parts`].
    pub fn read(film: &Film, key: u64, path: &Path) -> Result<Self> {
        let mut found = Self::new(Part { number: 1, of: 1, split: Split::Chosen }, 0, 0);
        let heading = each_entry(film, key, path, &mut |entry, _| match entry {
            PartEntry::Unit(own) => found.units.push(*own),
            PartEntry::Light(own) => found.light.push(own),
        })?;
        Ok(Self { part: heading.part, samples: heading.samples, batches: heading.batches, ..found })
    }
}

/// A piece of a part.
pub enum PartEntry {
    /// Samples of a tile.
    Unit(Box<UnitFilm>),
    /// Batches of light paths.
    Light(LightUnit),
}

/// How parts are checked by rendering some of them again.
pub struct Check<'c> {
    /// How many pieces of each file are, chosen at random.
    pub pieces: usize,
    /// Whether this program computes the same piece, of a render of so many samples; it also decides between two files of
    /// which one must be wrong.
    pub is_right: &'c mut dyn FnMut(&PartEntry, u32) -> bool,
}

/// Where an entry lies in its file, and a checksum of it.
#[derive(Clone, Copy, PartialEq)]
struct Place {
    offset: u64,
    sum: u32,
}

/// What a part's file begins with, the numbers that follow, and the length of the file.
type Begun = (PartHeading, Numbers<BufReader<File>>, u64);

/// Opens a part of a film of this shape and reads what it begins with.
fn begun(film: &Film, key: u64, path: &Path) -> Result<Begun> {
    let failed = |what: &str| Error::Usage(format!("cannot use {}: {what}", printable_path(path)));
    let Opened { heading: Heading { key: own, .. }, shape: found, mut numbers, length } = opened(path, "merge", "use")?;
    if found[3] & PART == 0 {
        return Err(failed("it is a checkpoint of a whole render, and not of a part"));
    }
    if own != key {
        return Err(failed(
            "it is a part of another scene, size, seed, sampler, filter or set of layers, or of a program that computes \
             other numbers",
        ));
    }
    let mut expected = shape(film);
    let planned = found[3] & PLANNED;
    expected[3] = expected[3] & !PLANNED | PART | planned;
    if found != expected {
        return Err(failed("it is a part of a film that keeps something else"));
    }
    let heading = read_heading(planned != 0, &mut numbers).map_err(|error| failed(&why_unread(&error)))?;
    if heading.part.number == 0 || heading.part.number > heading.part.of {
        return Err(failed(DAMAGED));
    }
    Ok((heading, numbers, length))
}

fn each_entry(film: &Film, key: u64, path: &Path, each: &mut dyn FnMut(PartEntry, Place)) -> Result<PartHeading> {
    let failed = |what: &str| Error::Usage(format!("cannot use {}: {what}", printable_path(path)));
    let unread = |error: io::Error| failed(&why_unread(&error));
    let (heading, mut numbers, length) = begun(film, key, path)?;
    let PartHeading { part, planned, samples, batches, .. } = heading;
    let places = places(film.tiles.len() as u32);
    let expected_batches = part.batches(batches);
    for _ in 0..heading.units {
        let offset = numbers.begin_entry();
        let own = read_unit(film, planned, &mut numbers).map_err(unread)?;
        if !part.holds(own.unit, &places, samples) || !is_plausible_unit(&own, samples) {
            return Err(failed("it holds numbers that no render can have produced"));
        }
        let sum = numbers.sum_of_entry();
        each(PartEntry::Unit(Box::new(own)), Place { offset, sum });
    }
    for _ in 0..heading.light {
        let offset = numbers.begin_entry();
        let own = read_light(&mut numbers, length).map_err(unread)?;
        let end = own.first.checked_add(own.batches);
        let numbers_hold = own.raster.iter().chain(&own.rgb).flatten().all(|number| number.is_finite());
        if own.first < expected_batches.start || end.is_none_or(|end| end > expected_batches.end) || !numbers_hold {
            return Err(failed("it holds light paths that no render can have traced"));
        }
        let sum = numbers.sum_of_entry();
        each(PartEntry::Light(own), Place { offset, sum });
    }
    if numbers.ends_here().map_err(unread)? { Ok(heading) } else { Err(failed(DAMAGED)) }
}

fn read_heading<S: Read>(planned: bool, numbers: &mut Numbers<S>) -> io::Result<PartHeading> {
    let mut first = [0; 4];
    numbers.read_u32s(&mut first)?;
    let [number, of, split, samples] = first;
    let batches = numbers.read_u64()?;
    let (units, light) = (numbers.read_u32()?, numbers.read_u32()?);
    let (_, split) = Split::ALL.get(split as usize).ok_or(io::ErrorKind::InvalidData)?;
    Ok(PartHeading { part: Part { number, of, split: *split }, planned, samples, batches, units, light })
}

fn read_unit<S: Read>(film: &Film, planned: bool, numbers: &mut Numbers<S>) -> io::Result<UnitFilm> {
    let (tile, block) = (numbers.read_u32()?, numbers.read_u32()?);
    let place = film.tiles.get(tile as usize).ok_or(io::ErrorKind::InvalidData)?.tile;
    let mut own = film.unit(Unit { tile, block: (block != u32::MAX).then_some(block) });
    own.planned = planned.then(|| vec![0; place.rows()]);
    if let Some(planned) = &mut own.planned {
        numbers.read_u32s(planned)?;
    }
    read_tile(&mut own.tile, own.moments.as_mut(), own.layers.as_mut(), numbers)?;
    Ok(own)
}

fn read_light<S: Read>(numbers: &mut Numbers<S>, length: u64) -> io::Result<LightUnit> {
    let (first, batches, rows) = (numbers.read_u64()?, numbers.read_u64()?, numbers.read_u64()?);
    if rows > length / 40 {
        return Err(io::ErrorKind::InvalidData.into());
    }
    let zeros = || vec![0.0; rows as usize];
    let mut own = LightUnit { first, batches, raster: [zeros(), zeros()], rgb: [zeros(), zeros(), zeros()] };
    numbers.read_all_f64s(&mut own.raster)?;
    numbers.read_all_f64s(&mut own.rgb)?;
    Ok(own)
}

impl Film {
    /// An empty unit of this film.
    pub fn unit(&self, unit: Unit) -> UnitFilm {
        let place = self.tiles[unit.tile as usize].tile;
        let rows = place.rows();
        UnitFilm {
            unit,
            planned: self.planned.get(unit.tile as usize).cloned(),
            tile: FilmTile { min: self.tiles[unit.tile as usize].min, ..FilmTile::new(place) },
            moments: (!self.moments.is_empty()).then(|| FilmMoments::new(rows)),
            layers: self.layers.first().map(|layers| FilmLayers::new(rows, &layers.kinds)),
        }
    }

    /// Adds a unit whose samples come next in its tile.
    fn append(&mut self, own: UnitFilm) {
        let tile = own.unit.tile as usize;
        if let (Some(into), Some(planned)) = (self.planned.get_mut(tile), own.planned) {
            *into = planned;
        }
        if own.unit.block.unwrap_or(0) == 0 {
            self.tiles[tile] = own.tile;
            if let (Some(into), Some(moments)) = (self.moments.get_mut(tile), own.moments) {
                *into = moments;
            }
            if let (Some(into), Some(layers)) = (self.layers.get_mut(tile), own.layers) {
                *into = layers;
            }
            return;
        }
        // Where no pixel was to get a sample, no block was begun.
        if own.tile.rejected == 0 && own.tile.count.iter().all(|&count| count == 0) {
            return;
        }
        if let (Some(into), Some(moments)) = (self.moments.get_mut(tile), own.moments) {
            into.append(&self.tiles[tile], &moments);
        }
        if let (Some(into), Some(layers)) = (self.layers.get_mut(tile), own.layers) {
            into.append(&layers);
        }
        self.tiles[tile].append(&own.tile);
    }
}

/// What came of a merge.
pub struct Merged {
    /// The film that the parts add up to.
    pub film: Film,
    /// The number of samples of the whole render.
    pub samples: u32,
    /// Whether everything is there.
    pub complete: bool,
    /// How many files were used.
    pub used: usize,
    /// The parts of which something is in no file, of the division that most of the files are of.
    pub missing: Vec<Part>,
    /// The files that were not used, and why.
    pub refused: Vec<(PathBuf, String)>,
}

/// What is known of one part's file.
struct Indexed {
    path: PathBuf,
    heading: PartHeading,
}

/// The pieces of all files that can be used, and the files that cannot.
#[derive(Default)]
struct Index {
    files: Vec<Indexed>,
    units: BTreeMap<Unit, (usize, Place)>,
    light: BTreeMap<u64, (u64, usize, Place)>,
    refused: Vec<(PathBuf, String)>,
}

impl Index {
    fn refuse(&mut self, path: &Path, what: &str) {
        self.refused.push((path.into(), format!("cannot use {}: {what}", printable_path(path))));
    }

    /// Adds a file, or refuses it; gives an earlier file that must be wrong if this one is right.
    fn add(
        &mut self,
        film: &Film,
        (key, expected): (u64, Option<(u32, u64)>),
        path: &Path,
        check: &mut Check<'_>,
    ) -> Option<(PathBuf, PathBuf, Place)> {
        let (mut units, mut light, mut chosen) = (Vec::new(), Vec::new(), Vec::new());
        let (mut seen, random) = (0_u64, RandomState::new());
        let read = each_entry(film, key, path, &mut |entry, place| {
            match &entry {
                PartEntry::Unit(own) => units.push((own.unit, place)),
                PartEntry::Light(own) => light.push((own.first, own.batches, place)),
            }
            // Each of those so far has the same probability to be among the chosen.
            let at = random.hash_one(seen) % (seen + 1);
            seen += 1;
            if chosen.len() < check.pieces {
                chosen.push(entry);
            } else if let Some(place) = chosen.get_mut(at as usize) {
                *place = entry;
            }
        });
        let heading = match read {
            Ok(heading) => heading,
            Err(why) => {
                self.refused.push((path.into(), why.to_string()));
                return None;
            }
        };
        if let Some((samples, batches)) = expected.filter(|own| *own != (heading.samples, heading.batches)) {
            self.refuse(
                path,
                &format!(
                    "it is of a render of {} samples and {} batches of light paths, and not of {samples} and {batches}",
                    heading.samples, heading.batches
                ),
            );
            return None;
        }
        if !chosen.iter().all(|entry| (check.is_right)(entry, heading.samples)) {
            self.refuse(path, "it holds other sums than a render of the same samples gives");
            return None;
        }
        let other = units.iter().find_map(|(unit, place)| {
            self.units.get(unit).filter(|(_, held)| held.sum != place.sum).map(|(file, _)| (*file, *place))
        });
        let other = other.or_else(|| {
            light.iter().find_map(|(first, batches, place)| {
                let differs = |held: &&(u64, usize, Place)| held.0 == *batches && held.2.sum != place.sum;
                self.light.get(first).filter(differs).map(|(_, file, _)| (*file, *place))
            })
        });
        if let Some((other, place)) = other {
            return Some((path.into(), self.files[other].path.clone(), place));
        }
        let number = self.files.len();
        units.into_iter().for_each(|(unit, place)| _ = self.units.entry(unit).or_insert((number, place)));
        for (first, batches, place) in light {
            self.light.entry(first).or_insert((batches, number, place));
        }
        self.files.push(Indexed { path: path.into(), heading });
        None
    }
}

/// Merges parts into a film of the shape of this one, which is empty; `filter` is that of the camera, and `expected` the
/// number of samples of a pixel and of batches of light paths, if they are known: otherwise most parts have them.
///
/// A piece that several parts hold counts once; where two hold other sums for the same samples, these are rendered again,
/// and the file that is wrong is refused.
/// So is one that is damaged, of another render or of another number of samples, and one of which a piece that is checked
/// is wrong: by name, and the others are merged.
/// As long as parts are missing, the film holds the units that are there; of a tile's blocks, those that the gaps leave.
/// Memory holds one film and a line for each unit, never all parts.
///
/// Errors: no file can be used, or one cannot be read a second time.
pub fn merge_parts(
    film: &Film,
    key: u64,
    (filter, expected): (Filter, Option<(u32, u64)>),
    paths: &[PathBuf],
    mut check: Check<'_>,
) -> Result<Merged> {
    let expected = expected.or_else(|| usual(film, key, paths));
    let mut wrong: Vec<PathBuf> = Vec::new();
    let Index { files, units, light, refused } = 'all: loop {
        let mut index = Index::default();
        wrong.iter().for_each(|path| index.refuse(path, "it holds other sums than a render of the same samples gives"));
        for path in paths.iter().filter(|path| !wrong.contains(path)) {
            let Some((one, other, place)) = index.add(film, (key, expected), path, &mut check) else { continue };
            // One of the two is wrong, and maybe all that follows from it: the wrong one is left out, and all is read anew.
            wrong.push(if is_right_at(film, key, &one, place, &mut check)? { other } else { one });
            continue 'all;
        }
        break index;
    };
    let Some(first) = files.first().map(|file| file.heading) else {
        let why =
            refused.first().map_or("there is no part to merge".into(), |(_, why): &(PathBuf, String)| why.clone());
        return Err(Error::Usage(why));
    };
    let mut merged = film.emptied();
    if first.planned {
        merged.planned = film.tiles.iter().map(|tile| vec![0; tile.tile.rows()]).collect();
    }
    let mut reader = Reader { film, files: &files, open: None };
    let last = blocks_of(first.samples);
    let mut blocks = vec![0; film.tiles.len()];
    let there: BTreeSet<Unit> = units.keys().copied().collect();
    // All of a tile before its blocks, and these in order: as the units are sorted.
    for (unit, (file, place)) in units {
        let tile = unit.tile as usize;
        if blocks[tile] == last {
            continue;
        }
        // Until the first block is there, a tile shows the first that is.
        let own = reader.unit(file, place)?;
        match unit.block {
            None => blocks[tile] = last,
            Some(block) if block == blocks[tile] => blocks[tile] += 1,
            Some(_) => {}
        }
        merged.append(own);
    }
    let mut gaps: Vec<Range<u64>> = Vec::new();
    for (done, &own) in merged.done.iter_mut().zip(&blocks) {
        *done = match own {
            0 => 0,
            own if own == last => first.samples.saturating_add(FIRST_SAMPLE_STEPS - 1),
            own => own * BLOCK + FIRST_SAMPLE_STEPS - 1,
        };
    }
    if let Some(mut splats) = merged.splats.take() {
        let mut filter = SplatFilter::new(filter);
        let mut next = 0;
        for (start, (batches, file, place)) in light {
            if start < next {
                continue;
            }
            gaps.push(next..start);
            next = start + batches;
            let own = reader.light(file, place)?;
            let [x, y] = &own.raster;
            let [r, g, b] = &own.rgb;
            for at in 0..x.len() {
                splats.add(&mut filter, [x[at], y[at]], [r[at], g[at], b[at]]);
            }
            splats.paths += batches * u64::from(LIGHT_PATHS);
        }
        gaps.push(next..first.batches);
        merged.splats = Some(splats);
    }
    gaps.retain(|gap| !gap.is_empty());
    let complete = gaps.is_empty() && blocks.iter().all(|&own| own == last);
    let lacks = |part: &Part| {
        let lit = part.batches(first.batches);
        gaps.iter().any(|gap| gap.start < lit.end && lit.start < gap.end)
            || part
                .units(blocks.len() as u32, first.samples)
                .iter()
                .any(|unit| blocks[unit.tile as usize] != last && !(unit.block.is_some() && there.contains(unit)))
    };
    let missing = parts_of_most(&files).filter(|part| !complete && lacks(part)).collect();
    Ok(Merged { film: merged, samples: first.samples, complete, used: files.len(), missing, refused })
}

/// Whether a piece of a file is what this program computes.
fn is_right_at(film: &Film, key: u64, path: &Path, place: Place, check: &mut Check<'_>) -> Result<bool> {
    let mut is_right = true;
    let heading = begun(film, key, path)?.0;
    each_entry(film, key, path, &mut |entry, own| {
        is_right &= own != place || (check.is_right)(&entry, heading.samples);
    })?;
    Ok(is_right)
}

/// The numbers of samples and of batches that most of the parts say their render has.
fn usual(film: &Film, key: u64, paths: &[PathBuf]) -> Option<(u32, u64)> {
    let mut counts: BTreeMap<(u32, u64), usize> = BTreeMap::new();
    for path in paths {
        if let Ok((PartHeading { samples, batches, .. }, ..)) = begun(film, key, path) {
            *counts.entry((samples, batches)).or_default() += 1;
        }
    }
    counts.into_iter().max_by_key(|(_, count)| *count).map(|(own, _)| own)
}

/// The parts of the division that most of the files are of; of several, the first.
fn parts_of_most(files: &[Indexed]) -> impl Iterator<Item = Part> {
    let division = |file: &Indexed| Part { number: 1, ..file.heading.part };
    let mut alike: HashMap<Part, usize> = HashMap::new();
    files.iter().for_each(|file| *alike.entry(division(file)).or_default() += 1);
    let most = files.iter().rev().map(division).max_by_key(|one| alike[one]);
    most.into_iter().flat_map(|first| (1..=first.of).map(move |number| Part { number, ..first }))
}

/// Reads entries of several files, of which one is open at a time.
struct Reader<'f> {
    film: &'f Film,
    files: &'f [Indexed],
    open: Option<(usize, BufReader<File>)>,
}

impl Reader<'_> {
    fn at(&mut self, file: usize, place: Place) -> Result<Numbers<&mut BufReader<File>>> {
        let path = &self.files[file].path;
        let failed = |error: io::Error| Error::Usage(format!("cannot use {}: {error}", printable_path(path)));
        if self.open.as_ref().is_none_or(|(own, _)| *own != file) {
            let opened = open_file(path, CHECKPOINT).map_err(|error| Error::Usage(format!("cannot merge: {error}")))?;
            self.open = Some((file, BufReader::new(opened.file)));
        }
        match &mut self.open {
            Some((_, stream)) => {
                stream.seek(SeekFrom::Start(place.offset)).map_err(failed)?;
                Ok(Numbers::new(stream))
            }
            None => Err(failed(io::ErrorKind::NotFound.into())),
        }
    }

    fn unit(&mut self, file: usize, place: Place) -> Result<UnitFilm> {
        let (film, planned) = (self.film, self.files[file].heading.planned);
        let path = self.files[file].path.clone();
        read_unit(film, planned, &mut self.at(file, place)?).map_err(|_| changed(&path))
    }

    fn light(&mut self, file: usize, place: Place) -> Result<LightUnit> {
        let path = self.files[file].path.clone();
        read_light(&mut self.at(file, place)?, u64::MAX).map_err(|_| changed(&path))
    }
}

fn changed(path: &Path) -> Error {
    Error::Usage(format!("cannot use {}: it changed while it was read", printable_path(path)))
}
