//! Where a ray runs inside a shape.

use super::{AnyShape, Bounds, l1_norm};
use glam::DVec3;

/// How far beyond a surface the next one is looked for, as a fraction of the numbers from which its place was computed.
const STEP: f64 = 1.0 / (1_u64 << 46) as f64;
/// More surfaces than any ray should cross; what lies beyond them is left out.
const MAX_CROSSINGS: usize = 1 << 16;

/// Calls a function with each stretch between 0 and `end`, in units of the direction's length, along which a ray is inside
/// a shape.
///
/// Between two surfaces a point in the middle decides, so that a surface which rounding loses or finds twice costs or adds
/// next to nothing.
pub fn stretches_inside(
    (shape, bounds): (&AnyShape, &Bounds),
    [origin, direction]: [DVec3; 2],
    end: f64,
    mut found: impl FnMut([f64; 2]),
) {
    if !may_cross(bounds, origin, direction, end) {
        return;
    }
    let mut from = 0.0;
    for _ in 0..MAX_CROSSINGS {
        // Of a ray that starts on a surface, the next one is what counts.
        let past = if from == 0.0 { 0.0 } else { from + STEP * (l1_norm(origin) + from) };
        let t = past + shape.t(origin + past * direction, direction);
        let to = if t < end { t } else { end };
        let middle = if to < f64::INFINITY { 0.5 * (from + to) } else { 2.0 * from + l1_norm(origin) + 1.0 };
        if to > from && shape.windings(origin + middle * direction) > 0 {
            found([from, to]);
        }
        if !(t < end) {
            break;
        }
        from = t;
    }
}

/// Whether a ray may enter a box before its end.
fn may_cross(bounds: &Bounds, origin: DVec3, direction: DVec3, end: f64) -> bool {
    // A little more than rounding takes away.
    const WIDER: f64 = 1.0 + 1e-12;
    let (mut near, mut far) = (0.0, end);
    for axis in 0..3 {
        let (at, along) = (origin[axis], direction[axis]);
        if along == 0.0 {
            if at < bounds.min[axis] || at > bounds.max[axis] {
                return false;
            }
            continue;
        }
        let (one, other) = ((bounds.min[axis] - at) / along, (bounds.max[axis] - at) / along);
        let (first, last) = if one < other { (one, other) } else { (other, one) };
        near = if first > near { first } else { near };
        far = if last * WIDER < far { last * WIDER } else { far };
    }
    near <= far
}

#[cfg(test)]
mod stretches_tests {
    use super::*;
    use crate::extract::any_shapes;
    use crate::measure::draws::Draws;
    use crate::plan::Census;
    use crate::scene::{Cone, Cuboid, Cylinder, Matte, PerspectiveCamera, Placement, Plane, Sphere, Torus};
    use bevy_ecs::prelude::*;

    /// Many points along random rays: each must be in a stretch where the shape contains it, and in none where not.
    #[test]
    fn a_point_is_in_a_stretch_where_the_shape_contains_it() {
        let mut world = World::new();
        world.spawn(PerspectiveCamera::default());
        let uneven = Placement { scale: DVec3::new(1.0, 0.3, 2.0), ..Placement::at(0.2, 0.1, -0.3) };
        world.spawn((Sphere::default(), Matte::default()));
        world.spawn((Sphere::default(), Matte::default(), uneven));
        world.spawn((Cuboid::default(), Matte::default(), Placement::at(0.5, 0.0, 0.0)));
        world.spawn((Cylinder::default(), Matte::default()));
        world.spawn((Cone::default(), Matte::default()));
        world.spawn((Torus::default(), Matte::default()));
        world.spawn((Plane::default(), Matte::default()));
        let shapes = any_shapes(&Census::of(&world)).expect("shapes");
        let (mut points, mut inside, mut mistaken) = (0, 0, 0);
        for shape in &shapes {
            let bounds = shape.bounds().unwrap_or(Bounds::ALL);
            for index in 0..2000 {
                let mut draws = Draws::new(39, index);
                let ray = [draws.unit_vector() * draws.between(0.0, 3.0), draws.unit_vector()];
                let end = if index % 3 == 0 { f64::INFINITY } else { draws.between(0.0, 4.0) };
                let mut stretches = Vec::new();
                stretches_inside((shape, &bounds), ray, end, |own| stretches.push(own));
                assert!(stretches.windows(2).all(|pair| pair[0][1] <= pair[1][0]), "{stretches:?}");
                assert!(stretches.iter().all(|[from, to]| 0.0 <= *from && from < to && *to <= end));
                for _ in 0..20 {
                    let at = draws.between(0.0, if end < 5.0 { end } else { 5.0 });
                    let contained = shape.windings(ray[0] + at * ray[1]) > 0;
                    let listed = stretches.iter().any(|[from, to]| (*from..*to).contains(&at));
                    points += 1;
                    inside += usize::from(contained);
                    mistaken += usize::from(contained != listed);
                }
            }
        }
        eprintln!("stretches: {points} points on 14000 rays through 7 shapes, {inside} inside, {mistaken} mistaken");
        assert_eq!(mistaken, 0);
    }
}
