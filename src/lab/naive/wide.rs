//! The renderer's wide tree, traversed in plain f64: eight boxes, one after the other.

use glam::DVec3;
use pinhole::bvh::{Bvh, Child, ChildKind, WIDTH, WideNode};

/// Which planes a ray enters slabs by: 0 for the lower ones, 1 for the upper ones.
pub fn first_planes(direction: DVec3) -> [usize; 3] {
    direction.to_array().map(|part| usize::from(part.is_sign_negative()))
}

// ANCHOR: intervals
/// Where a ray enters and leaves the boxes of a node; it enters slabs by the planes `first`.
///
/// The loop over axes is outside: with all eight children in the inner loop, a compiler makes one instruction of it.
pub fn intervals(node: &WideNode, [origin, direction]: [DVec3; 2], first: [usize; 3]) -> [[f64; WIDTH]; 2] {
    let (mut enters, mut leaves) = ([f64::NEG_INFINITY; WIDTH], [f64::INFINITY; WIDTH]);
    for axis in 0..3 {
        let inverse = 1.0 / direction[axis];
        let [near, far] = [&node.planes[first[axis]][axis], &node.planes[1 - first[axis]][axis]];
        for child in 0..WIDTH {
            let t = (f64::from(near[child]) - origin[axis]) * inverse;
            enters[child] = if t > enters[child] { t } else { enters[child] };
            let t = (f64::from(far[child]) - origin[axis]) * inverse;
            leaves[child] = if t < leaves[child] { t } else { leaves[child] };
        }
    }
    [enters, leaves]
}
// ANCHOR_END: intervals

// ANCHOR: entered
/// The boxes that a ray enters before its closest hit so far: bit 0 is the first box, bit 7 the last.
pub fn entered(enters: [f64; WIDTH], leaves: [f64; WIDTH], closest: f64) -> u32 {
    let is_entered = |child: usize| enters[child] <= leaves[child] && leaves[child] >= 0.0 && enters[child] <= closest;
    (0..WIDTH).map(|child| u32::from(is_entered(child)) << child).sum()
}
// ANCHOR_END: entered

/// The closest hit of a ray before `t_max`: t and the primitive's number; it enters slabs by the planes `first`, `mask`
/// says which boxes it enters, and `t_of` where it hits a primitive.
pub fn closest(
    bvh: &Bvh,
    (ray, first): ([DVec3; 2], [usize; 3]),
    t_max: f64,
    mask: impl Fn([f64; WIDTH], [f64; WIDTH], f64) -> u32,
    mut t_of: impl FnMut(usize) -> f64,
) -> (f64, usize) {
    let (mut t, mut number, mut open) = (t_max, usize::MAX, vec![(0.0, Child::ROOT)]);
    while let Some((from, child)) = open.pop() {
        if from > t {
            continue;
        }
        match child.kind() {
            ChildKind::Leaf(leaf) => {
                for primitive in bvh.primitives(leaf).iter().map(|&primitive| primitive as usize) {
                    let found = t_of(primitive);
                    if found < t || (found == t && primitive < number && t < f64::INFINITY) {
                        (t, number) = (found, primitive);
                    }
                }
            }
            ChildKind::Node(node) => {
                let node = &bvh.nodes[node];
                let [enters, leaves] = intervals(node, ray, first);
                let mask = mask(enters, leaves, t);
                let children = (0..WIDTH).filter(|child| mask >> child & 1 == 1 && node.child[*child] != Child::NONE);
                let base = open.len();
                open.extend(children.map(|child| (enters[child], node.child[child])));
                // The nearest comes last, and so next.
                open[base..].sort_by(|a, b| b.0.total_cmp(&a.0));
            }
        }
    }
    (t, number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;
    use pinhole::shapes::{PlacedSphere, Shape, hierarchy_of};

    #[test]
    fn the_wide_tree_in_f64_finds_what_testing_everything_finds() {
        let mut draws = Draws::new(3101, 0);
        let spheres: Vec<PlacedSphere> = (0..600)
            .map(|_| PlacedSphere {
                centre: DVec3::from([(); 3].map(|()| draws.between(-1.0, 1.0))),
                radius: draws.power_of_ten(-3.0, -0.7),
            })
            .collect();
        let bvh = hierarchy_of(&spheres).expect("bounded");
        let (rays, mut hits) = (20_000, 0);
        for index in 0..rays {
            let origin = DVec3::from([(); 3].map(|()| draws.between(-2.0, 2.0)));
            let PlacedSphere { centre, radius } = spheres[index % spheres.len()];
            let ray = [origin, (centre + radius * draws.unit_vector() - origin).normalize()];
            let t_of = |number: usize| spheres[number].t(ray[0], ray[1]);
            let all = (0..spheres.len()).map(t_of).fold(f64::INFINITY, f64::min);
            let (t, number) = closest(&bvh, (ray, first_planes(ray[1])), f64::INFINITY, entered, t_of);
            assert_eq!(t, all, "{ray:?}");
            hits += usize::from(number < usize::MAX);
        }
        assert!(hits > rays / 4);
        eprintln!("wide tree in f64: {rays} rays, {hits} hit, 0 differ from brute force");
    }
}
