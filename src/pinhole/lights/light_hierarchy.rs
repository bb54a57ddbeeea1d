use super::light_bounds::{LightBounds, LightSums};
use crate::bvh::rounded_up;
use glam::DVec3;
use rayon::prelude::*;

/// The number of children of a node.
pub(super) const WIDTH: usize = 8;
/// The bits of a trail that choose a child.
pub(super) const STEP: u32 = WIDTH.trailing_zeros();
/// The most levels of nodes, such that a trail fits into 64 bits.
const MAX_LEVELS: u32 = 21;
/// The number of classes along an axis between which a set may be divided.
const BINS: usize = 12;
/// The fewest lights that are worth a task of their own.
const TASK: usize = 2048;

/// Up to eight sets of lights, component by component, as importance is computed for all of them at once.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LightNode {
    /// The centre of all of them, relative to the eye.
    pub origin: [f64; 3],
    /// The centre of a sphere around each, relative to the origin.
    pub centre: [[f32; WIDTH]; 3],
    /// Its radius.
    pub radius: [f32; WIDTH],
    /// The axis of the cone of normals.
    pub axis: [[f32; WIDTH]; 3],
    /// The cosine of the cone's half angle.
    pub spread: [f32; WIDTH],
    /// The cosine of the greatest angle from a normal at which there is light.
    pub edge: [f32; WIDTH],
    /// 1 where both sides emit, and 0 otherwise.
    pub both: [f32; WIDTH],
    /// The intensity along the normals, as a fraction of that of all lights.
    pub strength: [f64; WIDTH],
    /// The number of lights in each set and those before it.
    pub until: [u32; WIDTH],
    /// The node of each set, or the number of its only light.
    pub child: [u32; WIDTH],
}

impl LightNode {
    const EMPTY: Self = Self {
        origin: [0.0; 3],
        centre: [[0.0; WIDTH]; 3],
        radius: [0.0; WIDTH],
        axis: [[0.0; WIDTH]; 3],
        spread: [1.0; WIDTH],
        edge: [1.0; WIDTH],
        both: [0.0; WIDTH],
        strength: [0.0; WIDTH],
        until: [0; WIDTH],
        child: [0; WIDTH],
    };

    fn set(&mut self, place: usize, bounds: &LightBounds, total: f64) {
        let [min, max] = [bounds.around.min, bounds.around.max];
        let middle = 0.5 * min + 0.5 * max - DVec3::from(self.origin);
        let rounded = middle.as_vec3();
        let radius = (0.5 * max - 0.5 * min).length() + (rounded.as_dvec3() - middle).length();
        for axis in 0..3 {
            self.centre[axis][place] = rounded[axis];
            self.axis[axis][place] = bounds.axis[axis] as f32;
        }
        self.radius[place] = rounded_up(radius);
        self.spread[place] = bounds.spread as f32;
        self.edge[place] = bounds.edge as f32;
        self.both[place] = f32::from(u8::from(bounds.two_sided));
        self.strength[place] = if total > 0.0 { bounds.strength / total } else { 0.0 };
    }

    /// The number of lights of a set.
    pub fn count(&self, place: usize) -> u32 {
        self.until[place] - if place == 0 { 0 } else { self.until[place - 1] }
    }
}

/// A hierarchy of lights, by which one is chosen for a surface according to what it may contribute there (Conty Estévez
/// and Kulla 2018).
///
/// Each node has eight children, so that five nodes lead to one of ten thousand lights.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightHierarchy {
    /// The nodes, each before its children; the first is the root.
    pub(super) nodes: Vec<LightNode>,
    /// The children that lead to each light, from the root on, three bits for each, the first the lowest.
    pub(super) trail: Vec<u64>,
}

/// A light while the hierarchy is built.
#[derive(Clone, Copy)]
struct Item {
    light: u32,
    bounds: LightBounds,
}

impl LightHierarchy {
    /// Builds the hierarchy of lights; those without bounds emit nothing and are never chosen.
    pub fn build(lights: usize, bounds_of: impl Fn(usize) -> Option<LightBounds> + Sync) -> Self {
        let item = |light: usize| bounds_of(light).map(|bounds| Item { light: light as u32, bounds });
        let mut items: Vec<Item> = (0..lights).into_par_iter().with_min_len(TASK).filter_map(item).collect();
        // Scaled first, such that no sum of them overflows.
        let max = items.iter().map(|item| item.bounds.strength).fold(0.0, f64::max);
        if max > 0.0 {
            items.iter_mut().for_each(|item| item.bounds.strength /= max);
        }
        let total = items.iter().map(|item| item.bounds.strength).sum();
        let nodes = if items.is_empty() { Vec::new() } else { subtree(&mut items, MAX_LEVELS - 1, total) };
        drop(items);
        let mut trail = vec![0; lights];
        let mut waiting = vec![(0, 0, 0)];
        while let Some((node, shift, above)) = waiting.pop() {
            let Some(own): Option<&LightNode> = nodes.get(node) else { continue };
            for place in (0..WIDTH).filter(|&place| own.count(place) > 0) {
                let (child, trailed) = (own.child[place] as usize, above | (place as u64) << shift);
                match own.count(place) {
                    1 => trail[child] = trailed,
                    _ => waiting.push((child, shift + STEP, trailed)),
                }
            }
        }
        Self { nodes, trail }
    }

    /// Whether there is no light to choose.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The memory of its arrays, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.nodes[..]) + size_of_val(&self.trail[..])
    }

    /// The memory that a hierarchy of so many lights takes at most while it is built, in bytes.
    pub fn bytes_to_build(lights: u64) -> u64 {
        lights * (2 * size_of::<LightNode>() as u64 / 4 + size_of::<Item>() as u64 + 8)
    }
}

/// The nodes of a set, the first of them its own; `below` is the number of levels that may follow.
fn subtree(items: &mut [Item], below: u32, total: f64) -> Vec<LightNode> {
    let room = 1_usize.checked_shl(STEP * below).filter(|&room| room > 0).unwrap_or(usize::MAX);
    let mut ends = divided(items, cost, divide);
    let starts = std::iter::once(0).chain(ends.iter().copied());
    if starts.zip(&ends).any(|(start, end)| end - start > room) {
        ends = divided(items, |items| items.len() as f64, |items| items.len() / 2);
    }
    let mut sets = Vec::with_capacity(WIDTH);
    let (mut rest, mut start) = (items, 0);
    for end in ends {
        let (set, after) = rest.split_at_mut(end - start);
        sets.push(set);
        (rest, start) = (after, end);
    }
    let below_set = |set: &mut &mut [Item]| match set.len() {
        1 => Vec::new(),
        _ => subtree(set, below - 1, total),
    };
    let bounds_of = |set: &&mut [Item]| LightBounds::of_all(&set.iter().map(|item| item.bounds).collect::<Vec<_>>());
    let bounds: Vec<LightBounds> = sets.iter().map(bounds_of).collect();
    let around = LightBounds::of_all(&bounds).around;
    let mut root = LightNode { origin: (0.5 * around.min + 0.5 * around.max).into(), ..LightNode::EMPTY };
    let mut until = 0;
    for (place, set) in sets.iter().enumerate() {
        root.set(place, &bounds[place], total);
        until += set.len() as u32;
        root.until[place] = until;
        root.child[place] = set[0].light;
    }
    root.until[sets.len()..].fill(until);
    let large = until as usize > TASK;
    let parts: Vec<Vec<LightNode>> =
        if large { sets.par_iter_mut().map(below_set).collect() } else { sets.iter_mut().map(below_set).collect() };
    let mut nodes = vec![root];
    for (place, part) in parts.into_iter().enumerate().filter(|(_, part)| !part.is_empty()) {
        let first = nodes.len() as u32;
        nodes[0].child[place] = first;
        nodes.extend(part.into_iter().map(|node| moved(node, first)));
    }
    nodes
}

/// A node whose inner children are `by` places later.
fn moved(mut node: LightNode, by: u32) -> LightNode {
    for place in 0..WIDTH {
        node.child[place] += if node.count(place) > 1 { by } else { 0 };
    }
    node
}

/// Divides a set into up to eight, the one of the greatest cost first; returns where each of them ends.
fn divided(items: &mut [Item], cost: impl Fn(&[Item]) -> f64, divide: impl Fn(&mut [Item]) -> usize) -> Vec<usize> {
    if items.len() <= WIDTH {
        return (1..=items.len()).collect();
    }
    let mut sets = vec![(0, items.len(), cost(items))];
    while sets.len() < WIDTH {
        let largest = (0..sets.len()).filter(|&set| sets[set].1 - sets[set].0 > 1).max_by(|&one, &other| {
            let key = |set: usize| (sets[set].2, sets[set].1 - sets[set].0);
            key(one).0.total_cmp(&key(other).0).then(key(one).1.cmp(&key(other).1))
        });
        let Some(largest) = largest else { break };
        let (start, end, _) = sets[largest];
        let middle = start + divide(&mut items[start..end]);
        sets[largest] = (start, middle, cost(&items[start..middle]));
        sets.insert(largest + 1, (middle, end, cost(&items[middle..end])));
    }
    sets.into_iter().map(|(_, end, _)| end).collect()
}

fn cost(items: &[Item]) -> f64 {
    let mut sums = LightSums::NONE;
    items.iter().for_each(|item| sums.add(&item.bounds));
    sums.cost()
}

/// Divides a set of several in two such that their summed cost is least, or in halves where they are all in one place;
/// returns how many are in the first.
fn divide(items: &mut [Item]) -> usize {
    let doubled_centre = |bounds: &LightBounds| bounds.around.min + bounds.around.max;
    let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for item in &*items {
        let centre = doubled_centre(&item.bounds);
        (min, max) = (min.min(centre), max.max(centre));
    }
    let scale = BINS as f64 / (max - min);
    let bin_of = |bounds: &LightBounds, axis: usize| {
        let along = (doubled_centre(bounds)[axis] - min[axis]) * scale[axis];
        (along as usize).min(BINS - 1)
    };
    let axes = (0..3).filter(|&axis| scale[axis].is_finite() && scale[axis] > 0.0);
    let axes: Vec<usize> = axes.collect();
    let mut bins = [[LightSums::NONE; BINS]; 3];
    for item in &*items {
        axes.iter().for_each(|&axis| bins[axis][bin_of(&item.bounds, axis)].add(&item.bounds));
    }
    let mut best: Option<(f64, usize, usize)> = None;
    for &axis in &axes {
        let mut all = LightSums::NONE;
        bins[axis].iter().for_each(|bin| all.join(bin));
        let extent = all.extent();
        let lengthwise = extent.max_element() / extent[axis].max(f64::MIN_POSITIVE);
        let mut after = [LightSums::NONE; BINS];
        for bin in (0..BINS - 1).rev() {
            after[bin] = after[bin + 1];
            after[bin].join(&bins[axis][bin + 1]);
        }
        let mut before = LightSums::NONE;
        for bin in 0..BINS - 1 {
            before.join(&bins[axis][bin]);
            if before.is_empty() || after[bin].is_empty() {
                continue;
            }
            let cost = lengthwise * (before.cost() + after[bin].cost());
            if best.is_none_or(|(min, ..)| cost < min) {
                best = Some((cost, axis, bin));
            }
        }
    }
    let Some((_, axis, bin)) = best else { return items.len() / 2 };
    partition(items, |item| bin_of(&item.bounds, axis) <= bin)
}

/// Moves the items that pass a test before the others; returns how many there are.
fn partition(items: &mut [Item], test: impl Fn(&Item) -> bool) -> usize {
    let (mut start, mut end) = (0, items.len());
    while start < end {
        if test(&items[start]) {
            start += 1;
        } else {
            end -= 1;
            items.swap(start, end);
        }
    }
    start
}
