//! Polygons → triangles: a fan where that is right, and ears where the polygon is concave.

use crate::remarks::Remarks;
use glam::{DVec2, DVec3};

/// How many corners are tested for one polygon before it is given up; convex ones need none of these tests.
const MAX_TESTS: usize = 1 << 26;

/// The faces of a mesh in their order, triangles and larger polygons.
#[derive(Debug, Default)]
pub struct Polygons {
    triangles: Vec<[u32; 3]>,
    /// For each larger polygon, how many triangles come before it, and how many corners it has.
    larger: Vec<(usize, usize)>,
    /// Their corners, one polygon after the other.
    corners: Vec<u32>,
}

impl Polygons {
    /// None yet, with room for so many triangles.
    pub fn with_capacity(triangles: usize) -> Self {
        Self { triangles: Vec::with_capacity(triangles), ..Self::default() }
    }

    /// Adds a triangle.
    #[inline(always)]
    pub fn add_triangle(&mut self, corners: [u32; 3]) {
        self.triangles.push(corners);
    }

    /// Adds a polygon; one of fewer than three corners has no area, which is counted.
    pub fn add(&mut self, corners: &[u32], remarks: &mut Remarks) {
        match *corners {
            [a, b, c] => self.add_triangle([a, b, c]),
            [] | [_] | [_, _] => remarks.degenerate += 1,
            _ => {
                self.larger.push((self.triangles.len(), corners.len()));
                self.corners.extend_from_slice(corners);
            }
        }
    }

    /// The corners of all faces.
    pub fn corners(&self) -> impl Iterator<Item = u32> {
        self.triangles.iter().flatten().chain(&self.corners).copied()
    }

    /// All of them as triangles, where `at` gives the position of a corner.
    pub fn into_triangles(self, at: impl Fn(u32) -> DVec3, remarks: &mut Remarks) -> Vec<[u32; 3]> {
        if self.larger.is_empty() {
            return self.triangles;
        }
        let mut triangles = Vec::with_capacity(self.triangles.len() + self.corners.len() - 2 * self.larger.len());
        let (mut done, mut rest) = (0, &self.corners[..]);
        for (before, count) in self.larger {
            triangles.extend_from_slice(&self.triangles[done..before]);
            let (corners, behind) = rest.split_at(count);
            (done, rest) = (before, behind);
            if !triangulate(corners, &at, &mut triangles) {
                remarks.fans += 1;
                triangles.extend(fan(corners));
            }
        }
        triangles.extend_from_slice(&self.triangles[done..]);
        triangles
    }
}

/// The triangles of a polygon: a fan about its first corner.
pub fn fan(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    let first = corners.first().copied().unwrap_or(0);
    corners.windows(2).skip(1).map(move |pair| [first, pair[0], pair[1]])
}

/// Adds the triangles of a polygon of four corners or more: a fan if it is convex, and ears otherwise.
///
/// False if it crosses itself, has no area or no finite one, or takes too long.
fn triangulate(corners: &[u32], at: impl Fn(u32) -> DVec3, triangles: &mut Vec<[u32; 3]>) -> bool {
    let Some(points) = projected(corners, at) else { return false };
    let count = points.len();
    let turn = |a: usize, b: usize, c: usize| (points[b] - points[a]).perp_dot(points[c] - points[b]);
    let is_convex = (0..count).all(|corner| turn((corner + count - 1) % count, corner, (corner + 1) % count) >= 0.0)
        && (2..count).all(|corner| turn(0, corner - 1, corner) > 0.0);
    if is_convex {
        triangles.extend(fan(corners));
        return true;
    }
    let begun = triangles.len();
    let complete = cut_ears(&points, |[a, b, c]| triangles.push([corners[a], corners[b], corners[c]]));
    if !complete {
        triangles.truncate(begun);
    }
    complete
}

/// The corners in the coordinate plane that the polygon faces most, in which they run anticlockwise.
fn projected(corners: &[u32], at: impl Fn(u32) -> DVec3) -> Option<Vec<DVec2>> {
    let first = at(*corners.first()?);
    let points: Vec<DVec3> = corners.iter().map(|&corner| at(corner) - first).collect();
    // Twice the vector area (Newell).
    let area: DVec3 = points.windows(2).map(|pair| pair[0].cross(pair[1])).sum();
    if !(area.is_finite() && area != DVec3::ZERO) {
        return None;
    }
    let axis = [1, 2].into_iter().fold(0, |max, axis| if area[axis].abs() > area[max].abs() { axis } else { max });
    let [right, up] =
        if area[axis] > 0.0 { [(axis + 1) % 3, (axis + 2) % 3] } else { [(axis + 2) % 3, (axis + 1) % 3] };
    Some(points.iter().map(|point| DVec2::new(point[right], point[up])).collect())
}

/// Cuts ears off a simple polygon whose corners run anticlockwise: triangles of three successive corners that have an
/// area and contain no other corner.
///
/// False if none is left before all is cut.
fn cut_ears(points: &[DVec2], mut ear: impl FnMut([usize; 3])) -> bool {
    let count = points.len();
    let mut before: Vec<usize> = (0..count).map(|corner| (corner + count - 1) % count).collect();
    let mut behind: Vec<usize> = (0..count).map(|corner| (corner + 1) % count).collect();
    let turn = |a: usize, b: usize, c: usize| (points[b] - points[a]).perp_dot(points[c] - points[b]);
    // Only corners that do not turn left can lie in an ear.
    let mut inward: Vec<usize> = (0..count).filter(|&own| turn(before[own], own, behind[own]) <= 0.0).collect();
    let (mut left, mut corner, mut tried, mut tests) = (count, 0, 0, 0);
    while left > 3 {
        let [a, b, c] = [before[corner], corner, behind[corner]];
        let contains = |&other: &usize| {
            let at = points[other];
            let is_corner = [a, b, c].iter().any(|&own| points[own] == at);
            let side = |from: usize, to: usize| (points[to] - points[from]).perp_dot(at - points[from]) >= 0.0;
            !is_corner && side(a, b) && side(b, c) && side(c, a)
        };
        tests += inward.len() + 1;
        if tests > MAX_TESTS {
            return false;
        }
        if turn(a, b, c) > 0.0 && !inward.iter().any(contains) {
            ear([a, b, c]);
            (behind[a], before[c]) = (c, a);
            (left, tried) = (left - 1, 0);
            inward.retain(|&own| own != b && turn(before[own], own, behind[own]) <= 0.0);
        } else {
            tried += 1;
            if tried > left {
                return false;
            }
        }
        corner = c;
    }
    let [a, b, c] = [before[corner], corner, behind[corner]];
    let is_last = turn(a, b, c) >= 0.0;
    if is_last {
        ear([a, b, c]);
    }
    is_last
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The triangles of one polygon in the plane z = 0, and whether it became a fan for want of ears.
    fn cut(points: &[[f64; 2]]) -> (Vec<[u32; 3]>, u64) {
        let (mut polygons, mut remarks) = (Polygons::default(), Remarks::default());
        polygons.add(&(0..points.len() as u32).collect::<Vec<_>>(), &mut remarks);
        let at = |corner: u32| DVec3::new(points[corner as usize][0], points[corner as usize][1], 0.0);
        (polygons.into_triangles(at, &mut remarks), remarks.fans)
    }

    fn area(points: &[[f64; 2]], [a, b, c]: [u32; 3]) -> f64 {
        let at = |corner: u32| DVec2::from(points[corner as usize]);
        0.5 * (at(b) - at(a)).perp_dot(at(c) - at(a))
    }

    fn shoelace(points: &[[f64; 2]]) -> f64 {
        let next = |corner: usize| points[(corner + 1) % points.len()];
        0.5 * (0..points.len()).map(|own| DVec2::from(points[own]).perp_dot(DVec2::from(next(own)))).sum::<f64>()
    }

    #[test]
    fn convex_polygons_are_fans() {
        assert_eq!(fan(&[7, 8, 9, 4, 5]).collect::<Vec<_>>(), [[7, 8, 9], [7, 9, 4], [7, 4, 5]]);
        assert_eq!(fan(&[1, 2]).count() + fan(&[1]).count() + fan(&[]).count(), 0);
        let (triangles, fans) = cut(&[[0.0, 0.0], [2.0, 0.0], [3.0, 1.0], [1.0, 2.0]]);
        assert_eq!((triangles, fans), (vec![[0, 1, 2], [0, 2, 3]], 0));
    }

    #[test]
    fn faces_stay_in_their_order() {
        let (mut polygons, mut remarks) = (Polygons::default(), Remarks::default());
        polygons.add(&[4, 5, 6], &mut remarks);
        polygons.add(&[0, 1, 2, 3], &mut remarks);
        polygons.add(&[1, 2], &mut remarks);
        polygons.add_triangle([7, 8, 9]);
        let at = |corner: u32| [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y][corner as usize];
        assert_eq!(polygons.corners().count(), 10);
        let triangles = polygons.into_triangles(at, &mut remarks);
        assert_eq!(triangles, [[4, 5, 6], [0, 1, 2], [0, 2, 3], [7, 8, 9]]);
        assert_eq!((remarks.degenerate, remarks.fans), (1, 0));
    }

    /// Whichever corner it begins with and in whichever of the two directions it is seen, the triangles of a simple
    /// polygon cover its area once.
    #[test]
    fn concave_polygons_are_cut_into_ears() {
        let arrow = vec![[0.0, 0.0], [4.0, 4.0], [0.0, 1.0], [-4.0, 4.0]];
        let l = vec![[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
        // A ring that is cut open: two corners are there twice.
        let ring = vec![
            [0.0, 0.0],
            [4.0, 0.0],
            [4.0, 4.0],
            [0.0, 4.0],
            [0.0, 0.0],
            [1.0, 1.0],
            [1.0, 3.0],
            [3.0, 3.0],
            [3.0, 1.0],
            [1.0, 1.0],
        ];
        // A corner in the middle of an edge.
        let straight = vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 2.0]];
        let comb: Vec<[f64; 2]> = (0..40)
            .map(|tooth| [f64::from(tooth), if tooth & 1 == 0 { 5.0 } else { 0.1 }])
            .chain([[39.0, -1.0], [0.0, -1.0]])
            .rev()
            .collect();
        for (name, shape) in [("arrow", arrow), ("L", l), ("ring", ring), ("straight", straight), ("comb", comb)] {
            for start in 0..shape.len() {
                let mut points = shape.clone();
                points.rotate_left(start);
                let (triangles, fans) = cut(&points);
                assert_eq!((triangles.len(), fans), (shape.len() - 2, 0), "{name} from {start}");
                let areas: Vec<f64> = triangles.iter().map(|triangle| area(&points, *triangle)).collect();
                assert!(areas.iter().all(|area| *area >= 0.0), "{name} from {start}: {areas:?}");
                assert!((areas.iter().sum::<f64>() - shoelace(&points)).abs() < 1e-9, "{name} from {start}");
                points.reverse();
                let (triangles, fans) = cut(&points);
                let all: f64 = triangles.iter().map(|triangle| area(&points, *triangle)).sum();
                assert!(fans == 0 && (all - shoelace(&points)).abs() < 1e-9, "{name} reversed from {start}");
            }
        }
    }

    #[test]
    fn what_has_no_ears_becomes_a_fan_and_is_counted() {
        for points in [
            vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]],
            vec![[0.0, 0.0]; 5],
            vec![[f64::NAN, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        ] {
            let (triangles, fans) = cut(&points);
            assert_eq!((triangles.len(), fans), (points.len() - 2, 1), "{points:?}");
        }
        // So many teeth that cutting them one by one would take minutes.
        let tooth = |own: u32| [f64::from(own), if own.is_multiple_of(2) { 5.0 } else { 0.1 }];
        let saw: Vec<[f64; 2]> = (0..100_000).map(tooth).chain([[99_999.0, -1.0], [0.0, -1.0]]).rev().collect();
        assert_eq!(cut(&saw).0.len(), saw.len() - 2);
    }
}
