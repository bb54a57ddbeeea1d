//! Density grids: what multiplies a medium's coefficients, voxel by voxel.
//!
//! *Index space* counts voxels: voxel i of an axis reaches from i to i + 1, and its centre is at i + 0.5.

use super::cameras::eye;
use super::image_files::shown_name;
use super::pose::pose;
use crate::check::{finite_point, number, positive_length, triple};
use crate::each::Each;
use crate::plan::Census;
use crate::scene::{
    DENSITY_FILE, DensityGrid, EmbeddedFiles, FileStore, MAX_VOXELS, SceneError, SceneFolder, Undecoded, check_memory,
    printable_path,
};
use crate::shapes::Pose;
use bevy_ecs::prelude::*;
use glam::{DAffine3, DMat3, DVec3};
use std::sync::Arc;

/// How many blocks the longest side of a grid is divided into.
const BLOCKS: usize = 16;

/// Numbers on a grid of voxels, and the majorant of each block of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    size: [usize; 3],
    /// Those along x first, with the outermost once more on every side: a cell between eight centres that lies half outside
    /// finds its corners as any other does.
    values: Vec<f32>,
    /// The voxels along a block's edges.
    block: usize,
    blocks: [usize; 3],
    /// The greatest density within each block, faces included: its majorant.
    max: Vec<f32>,
    /// What there is to say of the file that it was read from.
    pub remarks: Vec<String>,
}

/// A grid in its box.
pub(super) struct BoxedGrid {
    grid: Arc<Grid>,
    /// The voxels along a unit of the entity's space.
    index_from_entity: DMat3,
    /// The corner of the box where index space begins.
    min: DVec3,
}

/// A grid where a medium stands.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedGrid {
    /// The densities.
    pub grid: Arc<Grid>,
    /// From render space, at the moment when the shutter opens, to index space.
    pub index_from_render: DAffine3,
}

impl PlacedGrid {
    /// A ray of render space in index space, where its distances are the same numbers.
    #[inline(always)]
    pub fn index_ray(&self, [origin, direction]: [DVec3; 2]) -> [DVec3; 2] {
        [self.index_from_render.transform_point3(origin), self.index_from_render.transform_vector3(direction)]
    }
}

/// The grid beside a medium, one for all that the medium fills.
///
/// Errors: values or a file that are not accepted.
pub(super) fn grid_beside(scene: &Census<'_>, who: &str, medium: Entity) -> Result<Option<BoxedGrid>, SceneError> {
    let Some(own) = scene.get::<DensityGrid>(medium) else { return Ok(None) };
    let grid = grid_of(scene, who, own)?;
    let (min, max) = (finite_point(who, "min", own.min)?, finite_point(who, "max", own.max)?);
    let edges = max - min;
    if !(edges.min_element() > 0.0) {
        let accepted = format!("each part must be greater than that of min, {}", triple(min));
        return Err(SceneError::new(who, "max", triple(max), accepted));
    }
    positive_length(who, "edge of the density grid's box", edges.min_element())?;
    let size = DVec3::from_array(grid.size.each(|side| side as f64));
    let index_from_entity = DMat3::from_diagonal(size / edges);
    Ok(Some(BoxedGrid { grid, index_from_entity, min }))
}

/// A grid in the space of a shape that its medium fills, or in the world.
///
/// Errors: a placement that is not accepted.
pub(super) fn placed(
    scene: &Census<'_>,
    who: &str,
    BoxedGrid { grid, index_from_entity, min }: &BoxedGrid,
    shape: Option<Entity>,
) -> Result<PlacedGrid, SceneError> {
    let (entity_from_world, position) = match shape {
        Some(shape) => {
            let Pose { world_from_entity, entity_from_world } = pose(scene, who, shape)?;
            (entity_from_world, world_from_entity.translation)
        }
        None => (DMat3::IDENTITY, DVec3::ZERO),
    };
    let matrix3 = *index_from_entity * entity_from_world;
    let translation = matrix3 * (eye(scene)? - position) - *index_from_entity * *min;
    Ok(PlacedGrid { grid: Arc::clone(grid), index_from_render: DAffine3 { matrix3, translation } })
}

/// The densities of a component, from its file or its own values.
fn grid_of(scene: &Census<'_>, who: &str, own: &DensityGrid) -> Result<Arc<Grid>, SceneError> {
    static GRIDS: FileStore<Grid> = FileStore::new();
    let refused = |field, value: String, accepted: String| SceneError::new(who, field, value, accepted);
    if own.file.is_empty() {
        let size = own.size.each(|side| side as usize);
        let needed = own.size.iter().try_fold(1_u64, |all, &side| all.checked_mul(u64::from(side)));
        let needed = needed.filter(|voxels| (1..=MAX_VOXELS).contains(voxels)).ok_or_else(|| {
            let [x, y, z] = own.size;
            let accepted = format!("a density grid has a file, or 1 to {MAX_VOXELS} voxels and a value for each");
            refused("size", format!("{x} × {y} × {z}"), accepted)
        })?;
        if own.values.len() as u64 != needed {
            let accepted = format!("there must be {needed}, one for each voxel of the size");
            return Err(refused("values", format!("{} numbers", own.values.len()), accepted));
        }
        if let Some(wrong) = own.values.iter().find(|value| !(value.is_finite() && **value >= 0.0)) {
            let accepted = "each must be a finite number of at least 0";
            return Err(refused("values", format!("one that is {}", number(f64::from(*wrong))), accepted.into()));
        }
        return Ok(Arc::new(Grid::new(size, own.values.clone())));
    }
    let shown = shown_name(&own.file);
    if !own.values.is_empty() {
        let accepted = "a density grid has one of the two, so leave the other out";
        return Err(refused("values", format!("beside the file {shown}"), accepted.into()));
    }
    if let Some(bytes) = EmbeddedFiles::find(scene, &own.file) {
        return read_vol(bytes).map(Arc::new).map_err(|problem| refused("file", shown, problem));
    }
    let path = SceneFolder::path_of(scene, &own.file);
    let decode = |bytes: &[u8]| {
        let grid = read_vol(bytes).map_err(|said| format!("{} cannot be read: {said}", printable_path(&path)))?;
        let bytes = grid.bytes();
        Ok((grid, bytes))
    };
    GRIDS.get(&path, DENSITY_FILE, decode).map_err(|why| match why {
        Undecoded::File(error) => refused("file", shown, error.to_string()),
        Undecoded::Content(problem) => refused("file", shown, problem),
    })
}

/// Reads a .vol file: `VOL`, the version 3, then little-endian numbers: the kind 1 for f32, the voxels along x, y and z, the
/// channels, a box, and the values, those along x first (Mitsuba's `gridvolume`).
///
/// Errors: what is wrong, as a clause about `it`.
fn read_vol(bytes: &[u8]) -> Result<Grid, String> {
    const HEAD: usize = 48;
    if !bytes.starts_with(b"VOL") || bytes.len() < HEAD {
        return Err("it is no .vol file, which begins with VOL and a head of 48 bytes".into());
    }
    let word = |at: usize| [0, 1, 2, 3].each(|byte| bytes[at + byte]);
    let [kind, x, y, z, channels] = [4, 8, 12, 16, 20].map(|at| i32::from_le_bytes(word(at)));
    if (bytes[3], kind, channels) != (3, 1, 1) {
        let version = bytes[3];
        return Err(format!(
            "it has version {version}, numbers of kind {kind} and {channels} channels, and a density grid has version 3, \
             kind 1 (f32) and 1 channel"
        ));
    }
    let size = [x, y, z];
    let voxels = size.iter().try_fold(1_u64, |all, &side| all.checked_mul(u64::try_from(side).ok()?));
    let Some(voxels) = voxels.filter(|voxels| (1..=MAX_VOXELS).contains(voxels)) else {
        return Err(format!("it has {x} × {y} × {z} voxels, and a density grid has 1 to {MAX_VOXELS}"));
    };
    let held = (bytes.len() - HEAD) / 4;
    if (held as u64) < voxels {
        return Err(format!("it ends after {held} of {voxels} voxels"));
    }
    let bordered: u64 = size.iter().map(|side| u64::from(side.unsigned_abs()) + 2).product();
    check_memory(4 * (voxels + bordered))
        .map_err(|too_little| format!("it has {voxels} voxels, which {too_little}"))?;
    let numbers = bytes[HEAD..].chunks_exact(4).take(voxels as usize);
    let mut values: Vec<f32> = numbers.map(|word| f32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect();
    if let Some(wrong) = values.iter().find(|value| !value.is_finite()) {
        return Err(format!("it holds the density {wrong}, and each must be a finite number"));
    }
    let below = values.iter().filter(|value| **value < 0.0).count();
    values.iter_mut().for_each(|value| *value = value.max(0.0));
    let mut grid = Grid::new(size.each(|side| side as usize), values);
    if below > 0 {
        grid.remarks.push(format!("{below} of its {voxels} densities are below 0, and count as 0"));
    }
    Ok(grid)
}

impl Grid {
    /// A grid of so many voxels along x, y and z, and the density of each, those along x first.
    pub fn new(size: [usize; 3], values: Vec<f32>) -> Self {
        let block = size.into_iter().max().unwrap_or(1).div_ceil(BLOCKS);
        let blocks = size.each(|side| side.div_ceil(block));
        let mut bordered = Vec::with_capacity(size.iter().map(|side| side + 2).product());
        let places = |side: usize| (0..side + 2).map(move |place| place.saturating_sub(1).min(side - 1));
        for z in places(size[2]) {
            for y in places(size[1]) {
                let row = (z * size[1] + y) * size[0];
                bordered.extend(places(size[0]).map(|x| values[row + x]));
            }
        }
        let mut own = Self { size, values: bordered, block, blocks, max: Vec::new(), remarks: Vec::new() };
        let mut max = Vec::with_capacity(blocks.iter().product());
        for z in 0..blocks[2] {
            for y in 0..blocks[1] {
                for x in 0..blocks[0] {
                    max.push(own.max_within([x, y, z]));
                }
            }
        }
        own.max = max;
        if own.max.iter().all(|max| *max == 0.0) {
            own.remarks.push("its density is 0 everywhere".into());
        }
        own
    }

    /// The greatest value that the density within a block is interpolated between: the block's own voxels, and those around.
    fn max_within(&self, at: [usize; 3]) -> f32 {
        let [x, y, z] = [0, 1, 2].each(|axis| {
            let first = at[axis] * self.block;
            first..(first + self.block + 2).min(self.size[axis] + 2)
        });
        let rows = z.flat_map(|z| y.clone().map(move |y| (z * (self.size[1] + 2) + y) * (self.size[0] + 2)));
        rows.flat_map(|row| &self.values[row + x.start..row + x.end]).fold(0.0, |max, &value| max.max(value))
    }

    /// The greatest density of all.
    pub fn max(&self) -> f64 {
        f64::from(self.max.iter().fold(0.0_f32, |max, &own| max.max(own)))
    }

    /// The memory of its numbers.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.values[..]) + size_of_val(&self.max[..])
    }

    /// The density at a point of index space: trilinear between the centres of voxels, as that of the outermost centres
    /// beyond them, and 0 outside the box.
    #[inline]
    pub fn density(&self, point: DVec3) -> f64 {
        let size = DVec3::from_array(self.size.each(|side| side as f64));
        if !(point.cmpge(DVec3::ZERO).all() && point.cmple(size).all()) {
            return 0.0;
        }
        let from_centres = point - 0.5;
        // Rounded down, which a conversion to a whole number does for what is not below 0.
        let floor = |at: f64| at as i64 - i64::from(at < 0.0);
        let cell = [floor(from_centres.x), floor(from_centres.y), floor(from_centres.z)];
        interpolated(&self.corners(cell), from_centres - at_cell(cell))
    }

    /// The densities at the corners of a cell between eight centres, which may lie half outside; those along x first.
    #[inline(always)]
    fn corners(&self, [x, y, z]: [i64; 3]) -> [f64; 8] {
        // Rounding may say that a ray along a face of the box is outside.
        let bordered = |place: i64, side: usize| (place + 1).clamp(0, side as i64) as usize;
        let [along_y, along_z] = [self.size[0] + 2, (self.size[0] + 2) * (self.size[1] + 2)];
        let first =
            bordered(x, self.size[0]) + bordered(y, self.size[1]) * along_y + bordered(z, self.size[2]) * along_z;
        let [near, far] = [first, first + along_z];
        let [a, b, c, d] =
            [near, near + along_y, far, far + along_y].each(|row| [self.values[row], self.values[row + 1]]);
        [a[0], a[1], b[0], b[1], c[0], c[1], d[0], d[1]].each(f64::from)
    }

    /// The integral of the density along a ray of index space, from one distance to another.
    ///
    /// Within a cell between eight centres the density along a straight line is a polynomial of third degree, whose
    /// integral Gauss's rule with two points gives exactly.
    pub fn integral(&self, ray: [DVec3; 2], range: [f64; 2]) -> f64 {
        const NODES: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];
        let [origin, direction] = [ray[0] - 0.5, ray[1]];
        let mut sum = 0.0;
        self.blocks_along(ray, range, |of_block, _| {
            cells_along([origin, direction], of_block, |cell, [from, to]| {
                let corners = self.corners(cell);
                let base = origin - at_cell(cell);
                let at = |node: f64| interpolated(&corners, base + (from + node * (to - from)) * direction);
                sum += 0.5 * (to - from) * (at(NODES[0]) + at(NODES[1]));
            });
        });
        sum
    }

    /// Calls a function for each block of voxels along a ray of index space in which the density is not 0: the distances
    /// where the ray is in it, and the greatest density.
    #[inline]
    pub fn blocks_along(&self, [origin, direction]: [DVec3; 2], range: [f64; 2], mut found: impl FnMut([f64; 2], f64)) {
        let Some(range) = self.within(origin, direction, range) else { return };
        let edge = self.block as f64;
        cells_along([origin / edge, direction / edge], range, |cell, range| {
            // A ray along a face of the box is in the last block, whatever rounding says.
            let [x, y, z] = [0, 1, 2].each(|axis| cell[axis].clamp(0, self.blocks[axis] as i64 - 1) as usize);
            let max = self.max[(z * self.blocks[1] + y) * self.blocks[0] + x];
            if max > 0.0 {
                found(range, f64::from(max));
            }
        });
    }

    /// The part of a ray's range that lies within the box.
    fn within(&self, origin: DVec3, direction: DVec3, [mut from, mut to]: [f64; 2]) -> Option<[f64; 2]> {
        for axis in 0..3 {
            let (at, along, side) = (origin[axis], direction[axis], self.size[axis] as f64);
            if along == 0.0 {
                if !(at >= 0.0 && at <= side) {
                    return None;
                }
                continue;
            }
            let (one, other) = (-at / along, (side - at) / along);
            from = from.max(one.min(other));
            to = to.min(one.max(other));
        }
        (from < to && to < f64::INFINITY).then_some([from, to])
    }
}

/// Calls a function for every cell of the lattice of whole numbers that a ray is in from one distance to another, in order,
/// with the distances where it is in it (Amanatides and Woo 1987).
///
/// Where it enters a cell is computed from the ray anew and not added up, so that no error grows along the way.
#[inline(always)]
fn cells_along(ray: [DVec3; 2], [from, to]: [f64; 2], mut visit: impl FnMut([i64; 3], [f64; 2])) {
    let [x, y, z] = (ray[0] + from * ray[1]).floor().to_array();
    let mut cell = [x as i64, y as i64, z as i64];
    let [origin, direction] = ray.each(|of| of.to_array());
    let leaves = |axis: usize, place: i64| match direction[axis] {
        along if along > 0.0 => ((place + 1) as f64 - origin[axis]) / along,
        along if along < 0.0 => (place as f64 - origin[axis]) / along,
        _ => f64::INFINITY,
    };
    let mut next = [leaves(0, cell[0]), leaves(1, cell[1]), leaves(2, cell[2])];
    let mut at = from;
    loop {
        let axis = if next[0] <= next[1] && next[0] <= next[2] {
            0
        } else if next[1] <= next[2] {
            1
        } else {
            2
        };
        let end = if next[axis] < to { next[axis] } else { to };
        if end > at {
            visit(cell, [at, end]);
            at = end;
        }
        if !(next[axis] < to) {
            break;
        }
        cell[axis] += if direction[axis] > 0.0 { 1 } else { -1 };
        next[axis] = leaves(axis, cell[axis]);
    }
}

/// The corner of a cell from which it is counted.
#[inline(always)]
fn at_cell([x, y, z]: [i64; 3]) -> DVec3 {
    DVec3::new(x as f64, y as f64, z as f64)
}

/// The trilinear interpolation of eight corners, by fractions of the cell's edges.
#[inline(always)]
fn interpolated(corners: &[f64; 8], at: DVec3) -> f64 {
    let between = |one: f64, other: f64, at: f64| one + (other - one) * at;
    let along_x = |pair: usize| between(corners[2 * pair], corners[2 * pair + 1], at.x);
    let (near, far) = (between(along_x(0), along_x(1), at.y), between(along_x(2), along_x(3), at.y));
    between(near, far, at.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;

    fn random_grid(size: [usize; 3], draws: &mut Draws) -> Grid {
        let count = size.iter().product();
        Grid::new(size, (0..count).map(|_| if draws.unit() < 0.3 { 0.0 } else { draws.unit() as f32 }).collect())
    }

    fn random_ray(size: [usize; 3], draws: &mut Draws) -> [DVec3; 2] {
        let around = |draws: &mut Draws, side: usize| side as f64 * (3.0 * draws.unit() - 1.0);
        let origin = DVec3::new(around(draws, size[0]), around(draws, size[1]), around(draws, size[2]));
        let within = |draws: &mut Draws, side: usize| side as f64 * draws.unit();
        let aim = DVec3::new(within(draws, size[0]), within(draws, size[1]), within(draws, size[2]));
        let mut direction = aim - origin;
        // Some run along an axis, and some along the planes between voxels.
        match draws.unit() {
            few if few < 0.1 => direction = DVec3::new(0.0, 0.0, direction.z),
            few if few < 0.2 => direction.y = 0.0,
            _ => {}
        }
        let origin = if draws.unit() < 0.2 { (2.0 * origin).round() / 2.0 } else { origin };
        [origin, direction.normalize()]
    }

    /// The integral from cell to cell is what a million small steps add up to, from everywhere and along every axis.
    #[test]
    fn integrals_are_sums_of_small_steps() {
        const STEPS: u32 = 20_000;
        let mut draws = Draws::new(93, 0);
        let (mut tried, mut not_zero, mut worst) = (0, 0, 0.0_f64);
        for size in [[1, 1, 1], [2, 3, 4], [17, 5, 40], [33, 33, 33]] {
            for _ in 0..60 {
                let grid = random_grid(size, &mut draws);
                let ray = random_ray(size, &mut draws);
                let to = 3.0 * size.iter().sum::<usize>() as f64 * draws.unit();
                let own = grid.integral(ray, [0.0, to]);
                let step = to / f64::from(STEPS);
                let at = |step_number: u32| ray[0] + (f64::from(step_number) + 0.5) * step * ray[1];
                let sum: f64 = (0..STEPS).map(|number| grid.density(at(number)) * step).sum();
                // Of the box's faces, where the density steps to 0, each costs the sum half a step.
                worst = worst.max((own - sum).abs() / (2.0 * step));
                assert!((own - sum).abs() <= 2.0 * step, "{size:?} {ray:?} to {to}: {own} for {sum}");
                tried += 1;
                not_zero += u32::from(own > 0.0);
            }
        }
        assert!(not_zero > 100, "only {not_zero}");
        eprintln!("density: {tried} integrals, {not_zero} not 0, worst {worst:.2} of what the sum is known to");
    }

    /// No density along a ray exceeds the greatest of its block, none is missed between blocks, and they are in order.
    #[test]
    fn blocks_bound_what_is_in_them() {
        let mut draws = Draws::new(94, 0);
        let mut points = 0;
        for size in [[1, 1, 1], [3, 70, 2], [33, 40, 50]] {
            for _ in 0..100 {
                let grid = random_grid(size, &mut draws);
                let ray = random_ray(size, &mut draws);
                let mut found: Vec<([f64; 2], f64)> = Vec::new();
                grid.blocks_along(ray, [0.0, f64::INFINITY], |range, majorant| found.push((range, majorant)));
                assert!(found.iter().all(|([from, to], _)| from < to));
                assert!(found.windows(2).all(|pair| pair[0].0[1] <= pair[1].0[0]), "in order");
                for number in 0..200 {
                    // Not where it starts, which may be on a face that it leaves.
                    let t = (f64::from(number) + 0.5) * 0.37;
                    let density = grid.density(ray[0] + t * ray[1]);
                    let of_block = found.iter().filter(|(range, _)| range[0] <= t && t <= range[1]);
                    let majorant = of_block.map(|own| own.1).fold(0.0, f64::max);
                    assert!(
                        density <= majorant * (1.0 + 1e-14),
                        "{size:?}: {density} where {majorant} is the majorant"
                    );
                    points += 1;
                }
            }
        }
        eprintln!("density: {points} points below the majorants of their blocks");
    }

    /// A file is read as it was written, and damage is told.
    #[test]
    fn files_are_read_or_refused() {
        let mut file = b"VOL\x03".to_vec();
        let words = [1_i32, 2, 3, 1, 1];
        words.iter().for_each(|word| file.extend(word.to_le_bytes()));
        (0..6).for_each(|_| file.extend(0.0_f32.to_le_bytes()));
        [0.0_f32, 1.0, 2.0, -3.0, 4.0, 5.0].iter().for_each(|value| file.extend(value.to_le_bytes()));
        let grid = read_vol(&file).expect("read");
        assert_eq!((grid.size, grid.values.len()), ([2, 3, 1], 4 * 5 * 3));
        let centres = (0..6).map(|at| grid.density(DVec3::new((at % 2) as f64 + 0.5, (at / 2) as f64 + 0.5, 0.5)));
        assert_eq!(centres.collect::<Vec<f64>>(), [0.0, 1.0, 2.0, 0.0, 4.0, 5.0]);
        assert_eq!(grid.remarks.len(), 1, "{:?}", grid.remarks);
        let mut refused = 0;
        for length in 0..file.len() {
            assert!(read_vol(&file[..length]).is_err(), "{length} bytes");
            refused += 1;
        }
        for (at, byte) in [(0, b'X'), (3, 4), (4, 3), (8, 0), (11, 0x80), (14, 0x7f), (20, 3), (51, 0xff)] {
            let mut damaged = file.clone();
            damaged[at] = byte;
            if at == 51 {
                damaged[50] = 0xff;
            }
            let told = read_vol(&damaged).expect_err("refused");
            assert!(told.starts_with("it ") && !told.contains(". "), "{told}");
            refused += 1;
        }
        eprintln!("density: {refused} damaged files refused");
    }
}
