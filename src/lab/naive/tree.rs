//! A tree of boxes as a textbook has it: built and traversed by recursion, one box after another.
//!
//! It finds what testing everything finds, on every input that does not exhaust the machine's stack.

use glam::DVec3;
use pinhole::bvh::BoundingBox;
use pinhole::shapes::Shape;

// ANCHOR: tree
/// A tree of boxes.
pub struct Tree {
    /// The box around everything below.
    pub around: BoundingBox,
    /// What is below.
    pub below: Below,
}

/// What is below a box.
pub enum Below {
    /// In a leaf: the numbers of its primitives.
    Primitives(Vec<usize>),
    /// In a node: two trees.
    Trees(Box<[Tree; 2]>),
}
// ANCHOR_END: tree

/// Says where a set is divided: an axis and a place on it; none where the set becomes a leaf.
pub type Divide = fn(&[BoundingBox], &[usize]) -> Option<(usize, f64)>;

// ANCHOR: build
/// The tree over the primitives with these numbers.
///
/// A primitive is in the lower half if the centre of its box is below the place where the set is divided.
pub fn build(boxes: &[BoundingBox], numbers: Vec<usize>, divide: Divide) -> Tree {
    let around = united(numbers.iter().map(|&number| boxes[number]));
    if let Some((axis, place)) = divide(boxes, &numbers) {
        let (lower, upper): (Vec<usize>, Vec<usize>) =
            numbers.iter().partition(|&&number| centre(&boxes[number], axis) < place);
        if !lower.is_empty() && !upper.is_empty() {
            let trees = [lower, upper].map(|half| build(boxes, half, divide));
            return Tree { around, below: Below::Trees(Box::new(trees)) };
        }
    }
    Tree { around, below: Below::Primitives(numbers) }
}
// ANCHOR_END: build

/// The most primitives of a leaf where a tree is divided at medians.
const LEAF: usize = 4;

// ANCHOR: at_median
/// Divides a set at the median of the centres, across the axis along which they are spread most.
pub fn at_median(boxes: &[BoundingBox], numbers: &[usize]) -> Option<(usize, f64)> {
    if numbers.len() <= LEAF {
        return None;
    }
    let spread = [0, 1, 2].map(|axis| extent(boxes, numbers, axis)).map(|[low, high]| high - low);
    let axis = (0..3).max_by(|&a, &b| spread[a].total_cmp(&spread[b]))?;
    let mut centres: Vec<f64> = numbers.iter().map(|&number| centre(&boxes[number], axis)).collect();
    centres.sort_by(f64::total_cmp);
    Some((axis, centres[centres.len() / 2]))
}
// ANCHOR_END: at_median

/// The bins of centres along each axis.
const BINS: usize = 8;

// ANCHOR: by_cost
/// Divides a set where the rays that enter it cost least, at one of seven places along each axis.
pub fn by_cost(boxes: &[BoundingBox], numbers: &[usize]) -> Option<(usize, f64)> {
    let whole = united(numbers.iter().map(|&number| boxes[number])).half_area();
    // What it costs not to divide it.
    let (mut best, mut min) = (None, numbers.len() as f64);
    for axis in 0..3 {
        let [low, high] = extent(boxes, numbers, axis);
        let mut bins = [(BoundingBox::default(), 0); BINS];
        for &number in numbers {
            let place = (centre(&boxes[number], axis) - low) / (high - low) * BINS as f64;
            let (around, count) = &mut bins[(place as usize).min(BINS - 1)];
            around.enclose(&boxes[number]);
            *count += 1;
        }
        for above in 1..BINS {
            let parts = [&bins[..above], &bins[above..]].map(|part| {
                let count = part.iter().map(|(_, count)| count).sum();
                (united(part.iter().map(|(around, _)| *around)).half_area(), count)
            });
            let cost = split_cost(whole, parts);
            if cost < min {
                (best, min) = (Some((axis, low + (high - low) * above as f64 / BINS as f64)), cost);
            }
        }
    }
    best
}
// ANCHOR_END: by_cost

// ANCHOR: split_cost
/// The cost of visiting a node, where that of testing a primitive is 1.
const NODE: f64 = 1.0;

/// What a ray costs on average that enters a box, if the box is divided in two parts of these areas and counts.
///
/// The probability that it enters a part as well is the ratio of the areas.
pub fn split_cost(area: f32, [(lower, below), (upper, above)]: [(f32, usize); 2]) -> f64 {
    let entered = |part: f32| f64::from(part) / f64::from(area);
    NODE + entered(lower) * below as f64 + entered(upper) * above as f64
}
// ANCHOR_END: split_cost

/// The box around these.
fn united(boxes: impl Iterator<Item = BoundingBox>) -> BoundingBox {
    boxes.fold(BoundingBox::default(), |mut around, next| {
        around.enclose(&next);
        around
    })
}

/// The centre of a box along an axis.
fn centre(around: &BoundingBox, axis: usize) -> f64 {
    0.5 * (f64::from(around.low[axis]) + f64::from(around.high[axis]))
}

/// The least and the greatest centre along an axis.
fn extent(boxes: &[BoundingBox], numbers: &[usize], axis: usize) -> [f64; 2] {
    let centres = numbers.iter().map(|&number| centre(&boxes[number], axis));
    centres.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
}

/// A ray on its path through a tree: its closest hit so far, and what it was tested against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// Origin and direction.
    pub ray: [DVec3; 2],
    /// The closest hit so far.
    pub t: f64,
    /// The primitive that was hit; the largest number where none was.
    pub number: usize,
    /// How many boxes the ray was tested against.
    pub boxes: usize,
    /// How many primitives.
    pub primitives: usize,
}

impl Search {
    /// A ray that has hit nothing closer than `t_max`.
    pub fn new(ray: [DVec3; 2], t_max: f64) -> Self {
        Self { ray, t: t_max, number: usize::MAX, boxes: 0, primitives: 0 }
    }

    /// Tests a primitive and keeps the closest hit; at equal distances the lower number wins.
    fn test(&mut self, number: usize, t_of: &mut impl FnMut(usize) -> f64) {
        self.primitives += 1;
        let t = t_of(number);
        if t < self.t || (t == self.t && number < self.number && t < f64::INFINITY) {
            (self.t, self.number) = (t, number);
        }
    }
}

/// Where a ray enters a box, and 0 from inside; none where it misses it.
pub fn enters(around: &BoundingBox, [origin, direction]: [DVec3; 2]) -> Option<f64> {
    let (mut from, mut until) = (0.0, f64::INFINITY);
    for axis in 0..3 {
        let [low, high] = [around.low[axis], around.high[axis]].map(f64::from);
        let inverse = 1.0 / direction[axis];
        let [near, far] = if inverse.is_sign_negative() { [high, low] } else { [low, high] };
        // Comparisons that a NaN fails leave the interval as it is.
        let t = (near - origin[axis]) * inverse;
        from = if t > from { t } else { from };
        let t = (far - origin[axis]) * inverse;
        until = if t < until { t } else { until };
    }
    (from <= until).then_some(from)
}

// ANCHOR: to_visit
/// The children to visit, in order: those that are entered before the closest hit so far, the nearer first.
pub fn to_visit(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
    match enters.map(|t| t.filter(|&t| t <= closest)) {
        [None, None] => [None, None],
        [Some(_), None] => [Some(0), None],
        [None, Some(_)] => [Some(1), None],
        [Some(lower), Some(upper)] if upper < lower => [Some(1), Some(0)],
        [Some(_), Some(_)] => [Some(0), Some(1)],
    }
}
// ANCHOR_END: to_visit

impl Tree {
    /// The tree over shapes, all of which must be bounded.
    pub fn of_shapes<S: Shape>(shapes: &[S], divide: Divide) -> Self {
        let around = |shape: &S| shape.bounds().map(|bounds| BoundingBox::around(bounds.min, bounds.max));
        let boxes: Vec<BoundingBox> = shapes.iter().filter_map(around).collect();
        build(&boxes, (0..boxes.len()).collect(), divide)
    }

    // ANCHOR: closest
    /// Finds the closest hit below; `order` says which children to visit, and `t_of` where the ray hits a primitive.
    pub fn closest(
        &self,
        search: &mut Search,
        order: &impl Fn([Option<f64>; 2], f64) -> [Option<u32>; 2],
        t_of: &mut impl FnMut(usize) -> f64,
    ) {
        match &self.below {
            Below::Primitives(numbers) => numbers.iter().for_each(|&number| search.test(number, t_of)),
            Below::Trees(trees) => {
                let enters = trees.each_ref().map(|tree| enters(&tree.around, search.ray));
                search.boxes += 2;
                for child in order(enters, search.t).into_iter().flatten().map(|child| child as usize % 2) {
                    // The first may have brought a hit before the box of the second.
                    if enters[child].is_some_and(|t| t <= search.t) {
                        trees[child].closest(search, order, t_of);
                    }
                }
            }
        }
    }
    // ANCHOR_END: closest

    // ANCHOR: first_found
    /// The mistake: once something was hit in the nearer box, the farther one is left out.
    ///
    /// The two boxes may overlap, and what is hit in the nearer box may lie behind what is in the other.
    pub fn first_found(&self, search: &mut Search, t_of: &mut impl FnMut(usize) -> f64) -> bool {
        match &self.below {
            Below::Primitives(numbers) => {
                let before = search.t;
                numbers.iter().for_each(|&number| search.test(number, t_of));
                search.t < before
            }
            Below::Trees(trees) => {
                let enters = trees.each_ref().map(|tree| enters(&tree.around, search.ray));
                let order = to_visit(enters, search.t).into_iter().flatten();
                order.into_iter().any(|child| trees[child as usize].first_found(search, t_of))
            }
        }
    }
    // ANCHOR_END: first_found

    /// The leaves, the nodes on the longest path down to one, and the most primitives of a leaf.
    pub fn form(&self) -> [usize; 3] {
        match &self.below {
            Below::Primitives(numbers) => [1, 0, numbers.len()],
            Below::Trees(trees) => {
                let [[leaves, depth, max], other] = trees.each_ref().map(Self::form);
                [leaves + other[0], 1 + depth.max(other[1]), max.max(other[2])]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;
    use pinhole::shapes::PlacedSphere;

    /// Spheres of all sizes, many of which overlap.
    fn spheres(count: u64) -> Vec<PlacedSphere> {
        let sphere = |index| {
            let mut draws = Draws::new(3001, index);
            let centre = DVec3::from([(); 3].map(|()| draws.between(-1.0, 1.0)));
            PlacedSphere { centre, radius: draws.power_of_ten(-3.0, -0.7) }
        };
        (0..count).map(sphere).collect()
    }

    /// A ray towards the edge of one of the spheres.
    fn ray(spheres: &[PlacedSphere], index: u64) -> [DVec3; 2] {
        let mut draws = Draws::new(3002, index);
        let origin = DVec3::from([(); 3].map(|()| draws.between(-2.0, 2.0)));
        let PlacedSphere { centre, radius } = spheres[index as usize % spheres.len()];
        let mut direction = (centre + radius * draws.unit_vector() - origin).normalize();
        // Some are parallel to a plane of boxes.
        if index.is_multiple_of(5) {
            direction[index as usize % 3] = 0.0;
        }
        [origin, direction]
    }

    #[test]
    fn a_tree_finds_what_testing_everything_finds() {
        let (rays, mut hits, mut saved) = (20_000, 0, 0);
        let spheres = spheres(500);
        for divide in [at_median as Divide, by_cost] {
            let tree = Tree::of_shapes(&spheres, divide);
            for ray in (0..rays).map(|index| ray(&spheres, index)) {
                let mut t_of = |number: usize| spheres[number].t(ray[0], ray[1]);
                let [mut all, mut found] = [Search::new(ray, f64::INFINITY); 2];
                (0..spheres.len()).for_each(|number| all.test(number, &mut t_of));
                tree.closest(&mut found, &to_visit, &mut t_of);
                assert_eq!((all.t, all.number), (found.t, found.number), "{ray:?}");
                hits += usize::from(found.number < usize::MAX);
                saved += all.primitives - found.primitives;
            }
        }
        assert!(hits > rays as usize / 2 && saved > 2 * 480 * rays as usize, "{hits} hits, {saved} tests saved");
        eprintln!("tree: {} rays, {hits} hit, 0 differ from brute force", 2 * rays);
    }

    #[test]
    fn the_mistake_of_the_page_loses_hits() {
        let spheres = spheres(500);
        let tree = Tree::of_shapes(&spheres, by_cost);
        let wrong = (0..4000).map(|index| ray(&spheres, index)).filter(|&ray| {
            let mut t_of = |number: usize| spheres[number].t(ray[0], ray[1]);
            let [mut right, mut first] = [Search::new(ray, f64::INFINITY); 2];
            tree.closest(&mut right, &to_visit, &mut t_of);
            tree.first_found(&mut first, &mut t_of);
            right.t != first.t
        });
        let wrong = wrong.count();
        eprintln!("first found: {wrong} of 4000 rays are wrong");
        assert!(wrong > 40);
    }

    /// The numbers that the page works through.
    #[test]
    fn the_example_of_the_page() {
        // Six unit cubes along x: five side by side, and one far off.
        let cube = |x: f32| BoundingBox { low: [x, 0.0, 0.0], high: [x + 1.0, 1.0, 1.0] };
        let boxes = [0.0, 1.0, 2.0, 3.0, 4.0, 15.0].map(cube);
        let area = |range: std::ops::Range<usize>| united(boxes[range].iter().copied()).half_area();
        assert_eq!([area(0..6), area(0..3), area(3..6), area(0..5), area(5..6)], [33.0, 7.0, 27.0, 11.0, 3.0]);
        let [middle, gap] = [3, 5].map(|at| split_cost(33.0, [(area(0..at), at), (area(at..6), 6 - at)]));
        assert!((middle - (1.0 + (7.0 * 3.0 + 27.0 * 3.0) / 33.0)).abs() < 1e-12 && (middle - 4.09).abs() < 0.005);
        assert!((gap - (1.0 + (11.0 * 5.0 + 3.0) / 33.0)).abs() < 1e-12 && (gap - 2.76).abs() < 0.005);
        let numbers: Vec<usize> = (0..6).collect();
        let (axis, place) = by_cost(&boxes, &numbers).expect("it pays to divide it");
        assert!(axis == 0 && place > 4.5 && place < 15.5, "{place}");
        assert_eq!(at_median(&boxes, &numbers), Some((0, 3.5)));
    }

    #[test]
    fn where_all_centres_are_equal_nothing_can_be_divided() {
        let boxes = [BoundingBox { low: [-1.0; 3], high: [1.0; 3] }; 100];
        for divide in [at_median as Divide, by_cost] {
            assert_eq!(build(&boxes, (0..100).collect(), divide).form(), [1, 0, 100]);
        }
    }
}
