use super::emitting::{AreaSample, Emitting, LightPoint};
use super::parallelogram::{Parallelogram, across, parallelogram_pdf, parallelogram_point, parallelogram_solid_angle};
use crate::each::Each;
use crate::shapes::l1_norm;
use glam::DVec3;

/// A cuboid as a light, sampled face by face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmittingCuboid {
    /// Relative to the eye.
    pub centre: DVec3,
    /// From the centre to the midpoints of three faces.
    pub half_edges: [DVec3; 3],
    /// The outward unit normals of these faces.
    pub normals: [DVec3; 3],
    /// Whether its edges are perpendicular.
    pub is_square: bool,
}

impl EmittingCuboid {
    /// The cuboid with these half edges.
    pub fn new(centre: DVec3, half_edges: [DVec3; 3]) -> Self {
        let normals = [0, 1, 2].each(|axis| {
            let normal = half_edges[(axis + 1) % 3].cross(half_edges[(axis + 2) % 3]).normalize();
            if normal.dot(half_edges[axis]) < 0.0 { -normal } else { normal }
        });
        let is_square = (0..3).all(|axis| across(half_edges[axis], half_edges[(axis + 1) % 3]));
        Self { centre, half_edges, normals, is_square }
    }

    /// Whether a point is inside it.
    #[inline(always)]
    pub fn contains(&self, point: DVec3) -> bool {
        (0..3).all(|axis| {
            let normal = self.normals[axis];
            normal.dot(point - self.centre).abs() < normal.dot(self.half_edges[axis])
        })
    }
}

impl Emitting for EmittingCuboid {
    const IS_CLOSED: bool = true;

    fn area(&self) -> f64 {
        let face = |axis: usize| {
            let [a, b] = [self.half_edges[(axis + 1) % 3], self.half_edges[(axis + 2) % 3]];
            8.0 * a.cross(b).length()
        };
        face(0) + face(1) + face(2)
    }

    #[inline(always)]
    fn faces(&self, point: DVec3) -> bool {
        !self.contains(point)
    }

    #[inline(always)]
    fn point(&self, from: DVec3, u: [f64; 2]) -> LightPoint {
        cuboid_point(self, from, u)
    }

    #[inline(always)]
    fn pdf(&self, from: DVec3, at: DVec3) -> f64 {
        cuboid_pdf(self, from, at - from)
    }

    #[inline(always)]
    fn distance(&self, from: DVec3, direction: DVec3) -> f64 {
        cuboid_distance(self, from, direction)
    }

    #[inline(always)]
    fn spot(&self, u: [f64; 2]) -> AreaSample {
        let area = |axis: usize| self.half_edges[(axis + 1) % 3].cross(self.half_edges[(axis + 2) % 3]).length();
        let areas = [area(0), area(1), area(2)];
        let all: f64 = areas.iter().sum();
        // The first number selects one of twice three faces, and its remainder is uniform again.
        let mut left = u[0] * 2.0;
        let sign = if left < 1.0 { 1.0 } else { -1.0 };
        left = left.fract() * all;
        let mut axis = 0;
        while axis < 2 && left >= areas[axis] {
            left -= areas[axis];
            axis += 1;
        }
        let along = [2.0 * (left / areas[axis]).min(1.0) - 1.0, 2.0 * u[1] - 1.0];
        let edges = [self.half_edges[(axis + 1) % 3], self.half_edges[(axis + 2) % 3]];
        let position = self.centre + sign * self.half_edges[axis] + along[0] * edges[0] + along[1] * edges[1];
        let size = l1_norm(self.centre) + self.half_edges.each(l1_norm).iter().sum::<f64>();
        AreaSample { position, normal: sign * self.normals[axis], area: self.area(), size }
    }
}

/// The faces of a cuboid that are visible from a point, and the solid angle of each.
#[derive(Clone, Copy, Debug)]
pub struct CuboidSeen {
    /// In sr: the faces at the ends of the three edges, then those at their beginnings; 0 for a hidden face.
    pub solid_angles: [f64; 6],
    /// Their sum, in sr.
    pub whole: f64,
}

impl CuboidSeen {
    /// From outside up to three faces are visible, from inside all six.
    #[inline(always)]
    pub fn new(cuboid: &EmittingCuboid, from: DVec3) -> Self {
        let inside = cuboid.contains(from);
        let mut solid_angles = [0.0; 6];
        for (number, solid_angle) in solid_angles.iter_mut().enumerate() {
            let face = face(cuboid, number);
            let before = face.normal.dot(from - face.centre);
            if inside || before > 0.0 {
                *solid_angle = parallelogram_solid_angle(&face, from);
            }
        }
        Self { solid_angles, whole: solid_angles.iter().sum() }
    }
}

/// Samples a point on a cuboid: a face in proportion to its solid angle, then a point on it.
#[inline(always)]
pub fn cuboid_point(cuboid: &EmittingCuboid, from: DVec3, u: [f64; 2]) -> LightPoint {
    let seen = CuboidSeen::new(cuboid, from);
    let at = u[0] * seen.whole;
    let (mut chosen, mut before, mut passed) = (None, 0.0, 0.0);
    for (number, &solid_angle) in seen.solid_angles.iter().enumerate() {
        if solid_angle > 0.0 && (chosen.is_none() || at >= passed) {
            (chosen, before) = (Some(number), passed);
        }
        passed += solid_angle;
    }
    let Some(number) = chosen else { return LightPoint::NONE };
    let random = seen.solid_angles[number] / seen.whole;
    let first = ((at - before) / seen.solid_angles[number]).clamp(0.0, 1.0);
    let point = parallelogram_point(&face(cuboid, number), from, [first, u[1]]);
    LightPoint { pdf: random * point.pdf, ..point }
}

/// The pdf of a direction sampled by [`cuboid_point`], in 1/sr; `to` is the offset to the cuboid's point there.
#[inline(always)]
pub fn cuboid_pdf(cuboid: &EmittingCuboid, from: DVec3, to: DVec3) -> f64 {
    let seen = CuboidSeen::new(cuboid, from);
    let at = from + to - cuboid.centre;
    let nearness = |number: usize| {
        let face = face(cuboid, number);
        let out = face.centre - cuboid.centre;
        face.normal.dot(at) / face.normal.dot(out)
    };
    let mut nearest = 0;
    for number in 1..6 {
        if nearness(number) > nearness(nearest) {
            nearest = number;
        }
    }
    let pdf = parallelogram_pdf(&face(cuboid, nearest), from, to);
    if seen.whole > 0.0 { pdf * (seen.solid_angles[nearest] / seen.whole) } else { 0.0 }
}

/// The distance to a cuboid along a ray sampled towards it: where it has entered all slabs, or from inside has left
/// one.
#[inline(always)]
pub fn cuboid_distance(cuboid: &EmittingCuboid, from: DVec3, direction: DVec3) -> f64 {
    let (mut enters, mut leaves) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        let normal = cuboid.normals[axis];
        let (half, along) = (normal.dot(cuboid.half_edges[axis]), normal.dot(direction));
        if along == 0.0 {
            continue;
        }
        let to_middle = normal.dot(cuboid.centre - from);
        let end = if along > 0.0 { half } else { -half };
        enters = enters.max((to_middle - end) / along);
        leaves = leaves.min((to_middle + end) / along);
    }
    if cuboid.contains(from) { leaves } else { enters }
}

/// One of the six faces, with its outward normal.
#[inline(always)]
fn face(cuboid: &EmittingCuboid, number: usize) -> Parallelogram {
    let axis = number % 3;
    let sign = if number < 3 { 1.0 } else { -1.0 };
    let half_edges = [cuboid.half_edges[(axis + 1) % 3], cuboid.half_edges[(axis + 2) % 3]];
    Parallelogram {
        centre: cuboid.centre + cuboid.half_edges[axis] * sign,
        half_edges,
        normal: cuboid.normals[axis] * sign,
        is_rectangle: cuboid.is_square,
    }
}
