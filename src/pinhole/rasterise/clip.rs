//! Triangles that are partly behind the camera, or far outside the image, are clipped in homogeneous space.

use super::spaces::{ClipPoint, Projection};

use crate::each::Each;

/// How far outside the image a vertex may lie without its triangle being clipped, in pixels.
///
/// Together with the longest side of an image it is what keeps edge functions below 2⁵³, where f64 is exact.
const GUARD: f64 = (1 << 15) as f64;

/// The depth of the near plane, as a fraction of the farthest vertex's distance.
const NEAR: f64 = 1.0 / (1_u64 << 40) as f64;

/// Where the near plane lies farther away than this fraction of a triangle's own farthest vertex, since other vertices of
/// the scene are so far away, the triangle has a near plane of its own.
const NOTICED: f64 = 1.0 / (1_u64 << 20) as f64;

/// How many times as far as the planes a new vertex may lie once rounding has moved it; edge functions are whole there
/// too.
const SLACK: f64 = 2.0;

/// The vertices that a triangle has at most when it is clipped by five planes.
const MAX: usize = 8;

/// A convex polygon in clip space.
#[derive(Clone, Copy, Debug)]
pub struct Polygon {
    points: [ClipPoint; MAX],
    count: usize,
}

impl Polygon {
    /// Its vertices, in order.
    pub fn points(&self) -> &[ClipPoint] {
        &self.points[..self.count]
    }

    fn push(&mut self, point: ClipPoint) {
        self.points[self.count] = point;
        self.count += 1;
    }
}

/// The five planes that triangles are clipped by: the near plane, and a guard band about the image.
#[derive(Clone, Copy, Debug)]
pub struct ClipPlanes {
    /// The depth of the near plane, in scene units.
    pub near: f64,
    /// The guard band's sides, in units of w.
    sides: [f64; 2],
}

impl ClipPlanes {
    /// The planes for an image, where no vertex is farther from the eye than this.
    pub fn new(projection: &Projection, farthest: f64) -> Self {
        let sides = [projection.size.x, projection.size.y].each(|pixels| 1.0 + 2.0 * GUARD / pixels);
        Self { near: NEAR * farthest, sides }
    }

    /// Whether nothing is to be clipped at a vertex.
    #[inline(always)]
    pub fn contain(&self, point: ClipPoint) -> bool {
        let [x, y] = self.sides;
        (point.depth >= self.near) & (point.x.abs() <= x * point.w) & (point.y.abs() <= y * point.w)
    }

    /// What is in front of the near plane and inside the guard band; empty if nothing is, a vertex is not finite, or
    /// vertices are so far away (some 10¹⁵ times the near plane's distance) that rounding displaces the new ones.
    ///
    /// One plane after another takes away what is behind it (Sutherland and Hodgman, *Reentrant Polygon Clipping*,
    /// 1974).
    /// The near plane is that of all triangles, so that two with a common edge are clipped alike, unless it would take away
    /// what is to be seen.
    pub fn clip(&self, triangle: [ClipPoint; 3]) -> Polygon {
        let distance = |point: &ClipPoint| point.x.abs().max(point.y.abs()).max(point.depth.abs());
        let farthest = triangle.iter().map(distance).fold(0.0, f64::max);
        let near = if self.near > NOTICED * farthest { NEAR * farthest } else { self.near };
        Self { near, ..*self }.clip_by_these(triangle)
    }

    fn clip_by_these(&self, triangle: [ClipPoint; 3]) -> Polygon {
        let mut polygon = Polygon { points: [ClipPoint::default(); MAX], count: 0 };
        let finite = |point: &ClipPoint| (point.x + point.y + point.depth).is_finite();
        if triangle.iter().all(finite) {
            triangle.into_iter().for_each(|point| polygon.push(point));
        }
        let [x, y] = self.sides;
        polygon = clipped(&polygon, |point| point.depth - self.near);
        polygon = clipped(&polygon, |point| x * point.w - point.x);
        polygon = clipped(&polygon, |point| x * point.w + point.x);
        polygon = clipped(&polygon, |point| y * point.w - point.y);
        polygon = clipped(&polygon, |point| y * point.w + point.y);
        let planes = Self { near: self.near / SLACK, sides: [x * SLACK, y * SLACK] };
        let kept = polygon.points().iter().all(|&point| planes.contain(point));
        Polygon { count: if kept { polygon.count } else { 0 }, ..polygon }
    }
}

// ANCHOR: clipped
/// The part of a polygon where a linear function of the point is at least 0.
///
/// A new vertex is computed from the one inside to the one outside, in whichever direction the polygon passes the edge,
/// so two triangles with a common edge get the same vertex.
fn clipped(polygon: &Polygon, side: impl Fn(ClipPoint) -> f64) -> Polygon {
    let mut left = Polygon { count: 0, ..*polygon };
    let points = polygon.points();
    for (place, &to) in points.iter().enumerate() {
        let from = points[(place + points.len() - 1) % points.len()];
        let (at_from, at_to) = (side(from), side(to));
        if (at_from < 0.0) != (at_to < 0.0) {
            left.push(if at_to < 0.0 {
                crossing(from, at_from, to, at_to)
            } else {
                crossing(to, at_to, from, at_from)
            });
        }
        if at_to >= 0.0 {
            left.push(to);
        }
    }
    left
}
// ANCHOR_END: clipped

/// Where the function is 0 between a vertex at which it is positive and one at which it is negative.
pub(super) fn crossing(inside: ClipPoint, at_inside: f64, outside: ClipPoint, at_outside: f64) -> ClipPoint {
    let t = at_inside / (at_inside - at_outside);
    let mix = |from: f64, to: f64| from + t * (to - from);
    ClipPoint {
        x: mix(inside.x, outside.x),
        y: mix(inside.y, outside.y),
        depth: mix(inside.depth, outside.depth),
        w: mix(inside.w, outside.w),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat3, DVec2, DVec3};

    /// One vertex 10¹³ away once took away all that is nearer than 9 units.
    #[test]
    fn a_vertex_far_away_takes_away_no_other_triangle() {
        let projection = Projection {
            camera_from_world: DMat3::IDENTITY,
            half: DVec2::new(0.8, 0.6),
            is_perspective: true,
            size: DVec2::new(64.0, 48.0),
        };
        for farthest in [1e1, 1e6, 1e13, 1e30, 1e300] {
            let planes = ClipPlanes::new(&projection, farthest);
            let clipped =
                |corners: [[f64; 3]; 3]| planes.clip(corners.map(|corner| projection.clip(DVec3::from(corner))));
            let before = [[-1.0, -1.0, -6.0], [1.0, -1.0, -6.0], [0.0, 1.0, -5.0]];
            let whole = clipped(before);
            assert_eq!(whole.points().len(), 3, "{farthest}");
            let floor = clipped([[-1.0, -1.0, -20.0], [1.0, -1.0, -20.0], [0.0, -1.0, 20.0]]);
            let nearest = floor.points().iter().map(|point| point.depth).fold(f64::INFINITY, f64::min);
            assert!(floor.points().len() >= 4 && nearest > 0.0 && nearest < 0.05, "{farthest}: {floor:?}");
        }
    }
}
