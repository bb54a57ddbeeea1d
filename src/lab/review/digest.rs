use bevy_ecs::prelude::*;
use bevy_ecs::world::EntityRef;
use pinhole::Result;
use pinhole::extract::ImageFrame;
use pinhole::film::FilmTile;
use pinhole::look::paths;
use pinhole::plan::{Census, Column, ColumnKind, Plan, Stage, Table};
use pinhole::rays::{Depth, Tile};
use pinhole::render::{Execution, Hook, inspect_stages};
use std::fmt::Write;
use std::sync::Arc;

/// The side of a block of pixels that shares a digest.
pub const BLOCK_SIDE: u32 = 8;

/// FNV-1a, 64 bits: where it starts, and what it multiplies with.
const FNV_START: u64 = 0xcbf2_9ce4_8422_2325;
const FNV_PRIME: u64 = 0x0000_0100_0000_01b3;

/// What all stages wrote, in order, a table of digests each.
#[derive(Resource, Default)]
struct Digests(Vec<DigestTable>);

/// What one stage wrote into one column: a digest a block of pixels, of which only the film's are told one by one.
struct DigestTable {
    stage: &'static str,
    column: &'static str,
    /// Blocks from left to right.
    across: usize,
    /// None where the column has no row.
    blocks: Vec<Option<u64>>,
}

/// A digest of everything that every stage writes, as text: a word for each column of each stage, and of the film a table
/// of words, a line a row of blocks.
///
/// The digests are taken after the stage and not at the end, so that a column that several stages write still tells
/// which of them was the first to write something else.
/// The text does not depend on the side of the tiles, where [`BLOCK_SIDE`] divides it.
/// Of later bounces, whose rows are not pixels, it holds what they brought, and no more.
///
/// Errors: what a render would be refused for.
pub fn digests(scene: &World, offer: &[Stage]) -> Result<String> {
    digests_in_tiles(scene, offer, Execution::default().tile_side)
}

pub(super) fn digests_in_tiles(scene: &World, offer: &[Stage], tile_side: u32) -> Result<String> {
    let image = ImageFrame::extract(&Census::of(scene))?;
    let mut frame = inspect_stages(scene, offer, tile_side, &[digest_hook(image)])?;
    let Digests(tables) = frame.world.remove_resource().unwrap_or_default();
    let mut text = format!(
        "{} × {} pixels, of the film a digest for each {BLOCK_SIDE} × {BLOCK_SIDE}\n\n",
        image.width, image.height
    );
    for table in &tables {
        let _ = match table.column == FilmTile::NAME {
            true => write!(text, "\n\"{}\" writes {}\n{table}", table.stage, table.column),
            false => writeln!(text, "{} \"{}\" writes {}", table.whole(), table.stage, table.column),
        };
    }
    Ok(text)
}

/// A system after each stage that digests the columns that it wrote.
fn digest_hook(image: ImageFrame) -> Hook {
    Arc::new(move |_, stage: &Stage, plan: &Plan| {
        let stage_name = stage.name;
        let columns: Vec<ColumnKind> = stage.writes.iter().copied().filter(|c| plan.columns.contains(c)).collect();
        let digest = move |world: &mut World, tiles: &mut QueryState<Entity, With<Tile>>| {
            if tiles.iter(world).any(|tile| world.get::<Depth>(tile).is_some_and(|depth| depth.0 > 0)) {
                return;
            }
            let tables: Vec<DigestTable> = columns
                .iter()
                .map(|&column| {
                    let mut table = DigestTable::new(stage_name, column.name, image);
                    for tile in tiles.iter(world) {
                        table.add(column, &world.entity(tile));
                    }
                    table
                })
                .collect();
            world.get_resource_or_init::<Digests>().0.extend(tables);
        };
        digest.into_configs()
    })
}

impl DigestTable {
    fn new(stage: &'static str, column: &'static str, image: ImageFrame) -> Self {
        let [across, down] = [image.width, image.height].map(|pixels| pixels.div_ceil(BLOCK_SIDE) as usize);
        Self { stage, column, across, blocks: vec![None; across * down] }
    }

    /// Adds a tile's rows in order, each to the block of the pixel whose path it belongs to.
    ///
    /// The component that names the path counts as the pixel, so that the digest does not depend on how the image is cut.
    fn add(&mut self, column: ColumnKind, tile: &EntityRef<'_>) {
        let Some(place) = tile.get::<Tile>() else { return };
        let components = (column.components)(tile);
        for (row, path) in paths(column, tile).into_iter().enumerate() {
            let [x, y] = place.pixel_of(path);
            let [block_x, block_y] = [x, y].map(|pixels| (pixels / BLOCK_SIDE) as usize);
            let block = &mut self.blocks[block_y * self.across + block_x];
            let mut state = fnv(block.unwrap_or(FNV_START), u64::from(x) << 32 | u64::from(y));
            for component in components.iter().filter(|component| !matches!(component.name, "row" | "pixel")) {
                state = fnv(state, component.values.bits(row));
            }
            *block = Some(state);
        }
    }
}

impl DigestTable {
    /// One word for all blocks.
    fn whole(&self) -> String {
        let missing = 1 << 32;
        let blocks = self.blocks.iter().map(|block| block.map_or(missing, |block| u64::from(folded(block))));
        word(blocks.fold(FNV_START, fnv))
    }
}

impl std::fmt::Display for DigestTable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for line in self.blocks.chunks(self.across) {
            let words: Vec<String> = line.iter().map(|block| block.map_or("--------".into(), word)).collect();
            writeln!(f, "{}", words.join(" "))?;
        }
        Ok(())
    }
}

/// Takes in the eight bytes of a number, the lowest first.
fn fnv(state: u64, bits: u64) -> u64 {
    bits.to_le_bytes().iter().fold(state, |state, &byte| (state ^ u64::from(byte)).wrapping_mul(FNV_PRIME))
}

/// Both halves of a digest folded into one.
fn folded(digest: u64) -> u32 {
    (digest >> 32) as u32 ^ digest as u32
}

/// The same in eight hexadecimal digits.
fn word(digest: u64) -> String {
    format!("{:08x}", folded(digest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pinhole::rays::RasterPoints;
    use pinhole::scene::{LookAt, Matte, PerspectiveCamera, Placement, Plane, PointLight, Resolution, Sphere};
    use pinhole::{Chapter, stages};

    /// The digests of a tile of two blocks, 3 pixels into the image, after `change`.
    fn two_blocks(change: impl Fn(&mut RasterPoints)) -> String {
        let mut raster = RasterPoints { point: [vec![0.25; 128], vec![-3.0; 128]] };
        change(&mut raster);
        let mut world = World::new();
        let tile = world.spawn((Tile { x: 0, y: 0, width: 16, height: 8 }, raster)).id();
        let mut table = DigestTable::new("a stage", "raster", ImageFrame { width: 16, height: 8 });
        table.add(ColumnKind::of::<RasterPoints>(), &world.entity(tile));
        table.to_string()
    }

    #[test]
    fn the_lowest_bit_of_one_number_changes_the_digest_of_its_block_alone() {
        let before = two_blocks(|_| ());
        for (row, changed) in [(0, 0), (7, 0), (8, 1), (127, 1)] {
            let after = two_blocks(|raster| raster.point[1][row] = f64::from_bits(raster.point[1][row].to_bits() ^ 1));
            let differs =
                before.split_whitespace().zip(after.split_whitespace()).map(|(before, after)| before != after);
            assert_eq!(differs.collect::<Vec<bool>>(), [changed == 0, changed == 1], "row {row}");
        }
    }

    #[test]
    fn two_pixels_that_change_places_change_the_digest() {
        let first = two_blocks(|raster| raster.point[0][0] = 1.0);
        assert_ne!(first, two_blocks(|raster| raster.point[0][1] = 1.0));
    }

    #[test]
    fn a_block_without_rows_has_no_digest() {
        let table = DigestTable::new("a stage", "light", ImageFrame { width: 17, height: 9 });
        assert_eq!(table.to_string(), "-------- -------- --------\n".repeat(2));
        let mut one = DigestTable::new("a stage", "light", ImageFrame { width: 17, height: 9 });
        one.blocks[4] = Some(7);
        let mut other = DigestTable::new("a stage", "light", ImageFrame { width: 17, height: 9 });
        other.blocks[5] = Some(7);
        assert!(table.whole() != one.whole() && one.whole() != other.whole(), "the word tells which block it is");
    }

    fn scene(world: &mut World) {
        let eye = LookAt { eye: [0.0, 1.0, 4.0].into(), target: [0.0, 0.5, 0.0].into(), ..LookAt::default() };
        world.spawn((PerspectiveCamera::default(), eye, Resolution { width: 70, height: 43 }));
        world.spawn((Sphere::default(), Placement::at(0.0, 1.0, 0.0), Matte::default()));
        world.spawn((Plane::default(), Matte::default()));
        world.spawn((PointLight::default(), Placement::at(2.0, 5.0, 2.0)));
        world.spawn((PointLight::default(), Placement::at(-2.0, 5.0, 2.0)));
    }

    #[test]
    fn the_side_of_the_tiles_does_not_matter() -> Result {
        let chapter = Chapter::new("digest", "for this test", scene).offer(stages::all());
        let (world, stages) = (chapter.world(&pinhole::Overrides::default()), chapter.stages());
        let text = digests_in_tiles(&world, &stages, 32)?;
        assert!(text.contains(" \"Sample point lights\" writes shadow ray\n"), "{text}");
        for side in [8, 16, 64] {
            assert!(digests_in_tiles(&world, &stages, side)? == text, "tiles of {side} pixels");
        }
        Ok(())
    }
}
