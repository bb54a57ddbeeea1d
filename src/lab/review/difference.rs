use super::BLOCK_SIDE;
use pinhole::film::FilmTile;
use pinhole::plan::Column;
use serde::Serialize;
use std::fmt;
use std::ops::RangeInclusive;

/// The first of what two texts of [`digests`](super::digests) differ in, in the order of the stages.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Difference {
    /// The stage, in words.
    pub stage: String,
    /// The column that it writes.
    pub column: String,
    /// Where in the picture, or in the order of the stages.
    pub place: Place,
}

/// Where two runs part.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Place {
    /// A stage wrote other numbers, and the picture shows it.
    Block {
        /// The first block of pixels that differs, from the left and from the top, from 0.
        block: [u32; 2],
        /// The pixels of that block, from the left and from the top.
        pixels: [RangeInclusive<u32>; 2],
        /// How many blocks differ.
        differing: usize,
        /// How many blocks there are.
        blocks: usize,
    },
    /// A stage wrote other numbers, and yet the film is the same.
    Unseen,
    /// A stage no longer runs at this place.
    Gone,
    /// A stage runs at this place that did not.
    New,
}

/// A table of the text: its stage and column, and the words of its lines, one but for the film.
struct Table<'a> {
    stage: &'a str,
    column: &'a str,
    lines: Vec<Vec<&'a str>>,
}

/// The first stage whose numbers differ between two texts of [`digests`](super::digests), and where the film shows it.
pub fn first_difference(old: &str, new: &str) -> Option<Difference> {
    let (size, [old, new]) = (image_size(new), [old, new].map(tables));
    let same_stage = |one: &Table<'_>, other: &Table<'_>| one.stage == other.stage && one.column == other.column;
    let seen = || {
        let film = |tables: &'_ [Table<'_>]| tables.iter().rposition(Table::is_film);
        first_block(&old[film(&old)?], &new[film(&new)?], size)
    };
    for position in 0..old.len().max(new.len()) {
        let (table, place) = match (old.get(position), new.get(position)) {
            (Some(old), Some(new)) if same_stage(old, new) => match old.lines == new.lines {
                true => continue,
                false => (new, seen().unwrap_or(Place::Unseen)),
            },
            (Some(gone), now) if now.is_none() || !new.iter().any(|new| same_stage(gone, new)) => (gone, Place::Gone),
            (_, Some(new)) => (new, Place::New),
            _ => continue,
        };
        return Some(Difference { stage: table.stage.into(), column: table.column.into(), place });
    }
    None
}

impl Table<'_> {
    /// Whether it tells one block from another.
    fn is_film(&self) -> bool {
        self.column == FilmTile::NAME
    }
}

fn tables(text: &str) -> Vec<Table<'_>> {
    let mut tables: Vec<Table<'_>> = Vec::new();
    for line in text.lines() {
        let head = line.split_once('"').and_then(|(word, line)| Some((word.trim(), line.split_once("\" writes ")?)));
        if let Some((word, (stage, column))) = head {
            let lines = if word.is_empty() { Vec::new() } else { vec![vec![word]] };
            tables.push(Table { stage, column, lines });
        } else if let (Some(table), false) = (tables.last_mut(), line.trim().is_empty()) {
            table.lines.push(line.split_whitespace().collect());
        }
    }
    tables
}

/// The size that the text starts with; blocks at the right and at the bottom end there.
fn image_size(text: &str) -> [u32; 2] {
    let mut numbers = text.split(|sign: char| !sign.is_ascii_digit()).filter_map(|word| word.parse().ok());
    [numbers.next().unwrap_or(u32::MAX), numbers.next().unwrap_or(u32::MAX)]
}

/// A stage and what it writes, with the blocks in which two texts of [`digests`](super::digests) differ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StageBlocks {
    /// The stage, in words.
    pub stage: String,
    /// The column that it writes.
    pub column: String,
    /// Blocks from left to right.
    pub across: usize,
    /// Blocks from top to bottom.
    pub down: usize,
    /// The blocks with other numbers, line by line, counted from 0 at the top left.
    pub differing: Vec<[usize; 2]>,
    /// Whether it only ran before.
    pub gone: bool,
    /// Whether it only runs now.
    pub new: bool,
}

/// Every stage of two texts of [`digests`](super::digests): those of the later one in order, then those that are gone.
pub fn stage_blocks(old: &str, new: &str) -> Vec<StageBlocks> {
    let [old, new] = [old, new].map(tables);
    let same = |one: &Table<'_>, other: &Table<'_>| one.stage == other.stage && one.column == other.column;
    let of = |table: &Table<'_>, [across, down]: [usize; 2], differing, gone, new| StageBlocks {
        stage: table.stage.into(),
        column: table.column.into(),
        across,
        down,
        differing,
        gone,
        new,
    };
    let mut all = Vec::new();
    for table in &new {
        let before = old.iter().find(|before| same(before, table));
        let (size, differing) = differing_blocks(before.unwrap_or(table), table);
        all.push(of(table, size, differing, false, before.is_none()));
    }
    for table in old.iter().filter(|gone| !new.iter().any(|now| same(now, gone))) {
        all.push(of(table, differing_blocks(table, table).0, Vec::new(), true, false));
    }
    all
}

/// How many blocks two tables have across and down, and which of them differ.
fn differing_blocks(old: &Table<'_>, new: &Table<'_>) -> ([usize; 2], Vec<[usize; 2]>) {
    let across = [old, new].iter().flat_map(|table| &table.lines).map(Vec::len).max().unwrap_or(0);
    let down = old.lines.len().max(new.lines.len());
    fn word<'a>(table: &Table<'a>, x: usize, y: usize) -> Option<&'a str> {
        table.lines.get(y)?.get(x).copied()
    }
    let blocks = (0..down).flat_map(|y| (0..across).map(move |x| [x, y]));
    ([across, down], blocks.filter(|&[x, y]| word(old, x, y) != word(new, x, y)).collect())
}

fn first_block(old: &Table<'_>, new: &Table<'_>, size: [u32; 2]) -> Option<Place> {
    let ([across, down], differing) = differing_blocks(old, new);
    let block = differing.first()?.map(|along| along as u32);
    let pixels = [0, 1].map(|axis| {
        let first = block[axis] * BLOCK_SIDE;
        first..=(first + BLOCK_SIDE - 1).min(size[axis].saturating_sub(1).max(first))
    });
    Some(Place::Block { block, pixels, differing: differing.len(), blocks: across * down })
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { stage, column, place } = self;
        match place {
            Place::Block { pixels: [x, y], differing, blocks, .. } => write!(
                f,
                "the first stage whose numbers differ is \"{stage}\" (column {column}); in the picture {differing} of \
                 {blocks} blocks differ, the first at pixels {}..{}, {}..{}",
                x.start(),
                x.end(),
                y.start(),
                y.end()
            ),
            Place::Unseen => write!(
                f,
                "the first stage whose numbers differ is \"{stage}\" (column {column}); the film is the same to the last bit"
            ),
            Place::Gone => {
                write!(f, "the stages themselves differ: \"{stage}\" (column {column}) ran here, and does not now")
            }
            Place::New => {
                write!(f, "the stages themselves differ: \"{stage}\" (column {column}) runs here now, and did not")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OLD: &str = "20 × 10 pixels, of the film a digest for each 8 × 8\n\n\
        aaaa \"Place points\" writes raster\nbbbb \"List rows\" writes sphere rows\ncccc \"Add light\" writes radiance\n\n\
        \"Accumulate film\" writes pixel\n-------- eeee eeee\n-------- eeee eeee\n";

    #[test]
    fn the_same_text_has_no_difference() {
        assert_eq!(first_difference(OLD, OLD), None);
        assert_eq!(first_difference(OLD, &OLD.replace('\n', "\r\n")), None);
    }

    #[test]
    fn the_first_stage_in_order_is_named_and_the_first_block_of_the_film() {
        let new = OLD.replace("bbbb", "bbbc").replace("cccc", "cccd").replace("eeee eeee\n-", "eeee ffff\n-");
        let difference = first_difference(OLD, &new).map(|difference| difference.to_string());
        let expected = "the first stage whose numbers differ is \"List rows\" (column sphere rows); \
            in the picture 1 of 6 blocks differ, the first at pixels 16..19, 0..7";
        assert_eq!(difference.as_deref(), Some(expected));
    }

    #[test]
    fn numbers_that_no_pixel_shows_are_named_too() {
        let difference = first_difference(OLD, &OLD.replace("bbbb", "bbbc")).map(|difference| difference.to_string());
        let expected = "the first stage whose numbers differ is \"List rows\" (column sphere rows); \
            the film is the same to the last bit";
        assert_eq!(difference.as_deref(), Some(expected));
    }

    #[test]
    fn a_block_that_gains_or_loses_its_rows_differs() {
        let new = OLD.replace("\n-------- eeee eeee\n-------- ", "\n-------- eeee eeee\nffff ");
        for difference in [first_difference(OLD, &new), first_difference(&new, OLD)] {
            let place = difference.map(|difference| difference.place);
            let pixels = [0..=7, 8..=9];
            assert_eq!(place, Some(Place::Block { block: [0, 1], pixels, differing: 1, blocks: 6 }));
        }
    }

    #[test]
    fn every_stage_is_listed_and_those_that_come_or_go_say_so() {
        let new = OLD.replace("bbbb", "bbbc").replace("Add light", "Add more light");
        let told = stage_blocks(OLD, &new);
        let words: Vec<_> =
            told.iter().map(|stage| (&*stage.stage, stage.differing.len(), stage.gone, stage.new)).collect();
        let expected = [
            ("Place points", 0, false, false),
            ("List rows", 1, false, false),
            ("Add more light", 0, false, true),
            ("Accumulate film", 0, false, false),
            ("Add light", 0, true, false),
        ];
        assert_eq!(words, expected);
        assert_eq!((told[1].across, told[1].down), (1, 1));
    }

    #[test]
    fn a_stage_that_comes_or_goes_is_named() {
        let without = OLD.replace("bbbb \"List rows\" writes sphere rows\n", "");
        let named = |difference: Option<Difference>| difference.map(|difference| (difference.stage, difference.place));
        assert_eq!(named(first_difference(OLD, &without)), Some(("List rows".into(), Place::Gone)));
        assert_eq!(named(first_difference(&without, OLD)), Some(("List rows".into(), Place::New)));
        let shorter = OLD.split("\n\n\"Acc").next().unwrap_or_default();
        assert_eq!(named(first_difference(OLD, shorter)), Some(("Accumulate film".into(), Place::Gone)));
        assert_eq!(named(first_difference("", OLD)), Some(("Place points".into(), Place::New)));
    }
}
