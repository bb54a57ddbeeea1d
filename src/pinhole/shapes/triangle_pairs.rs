//! Rays, each with the one triangle that it is known to be near.

use super::mesh::PlacedMesh;
use super::triangle_block::{EdgeValues, ROUNDING, certain_t, edge_values, may_be_hit};
use super::triangle_edges::{longest_axis, permuted};
use glam::DVec3;
use multiversion::multiversion;

/// How many pairs are intersected at once: so many that what is written for one pair has arrived in memory before it is
/// read with others.
pub const PAIRS: usize = 32;

type Lanes = [f64; PAIRS];

/// Rays and a triangle for each, their axes permuted such that the largest component of a direction is the last.
#[derive(Clone, Debug, Default)]
pub struct TrianglePairs {
    origin: [Lanes; 3],
    direction: [Lanes; 3],
    corners: [[Lanes; 3]; 3],
    size: Lanes,
}

impl TrianglePairs {
    /// Sets a pair; no coordinate of the triangle is larger than `size`.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, [origin, direction]: [DVec3; 2], corners: [DVec3; 3], size: f64) {
        let [a, b, c] = corners;
        let all = [origin, direction, a, b, c];
        let [origin_permuted, direction, a, b, c] = match longest_axis(direction) {
            0 => all.map(permuted::<0>),
            1 => all.map(permuted::<1>),
            _ => all.map(permuted::<2>),
        };
        for axis in 0..3 {
            self.origin[axis][lane] = origin_permuted[axis];
            self.direction[axis][lane] = direction[axis];
            self.corners[0][axis][lane] = a[axis];
            self.corners[1][axis][lane] = b[axis];
            self.corners[2][axis][lane] = c[axis];
        }
        self.size[lane] = origin.x.abs() + origin.y.abs() + origin.z.abs() + size;
    }

    /// The t of each pair, as [`triangle_t`](super::triangle_t()) finds it; infinity for a miss, and NaN where exact
    /// arithmetic has to say.
    pub fn t(&self) -> Lanes {
        t_of_pairs(self)
    }

    /// The edge functions of a pair, and 1 / Rz.
    #[inline(always)]
    fn edges(&self, lane: usize) -> (EdgeValues, f64) {
        let of = |parts: &[Lanes; 3]| [parts[0][lane], parts[1][lane], parts[2][lane]];
        let ([ox, oy, oz], [x, y, z]) = (of(&self.origin), of(&self.direction));
        let shear = [x / z, y / z, 1.0 / z];
        let corners = [of(&self.corners[0]), of(&self.corners[1]), of(&self.corners[2])];
        (edge_values(corners, [ox, oy, oz], shear, ROUNDING * self.size[lane]), shear[2])
    }
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn t_of_pairs(pairs: &TrianglePairs) -> Lanes {
    let mut t = [f64::INFINITY; PAIRS];
    for lane in 0..PAIRS {
        let (values, shear_z) = pairs.edges(lane);
        let certain = certain_t(values, shear_z).unwrap_or(f64::NAN);
        t[lane] = if may_be_hit(values.0, values.2) == 0 { f64::INFINITY } else { certain };
    }
    t
}

impl PlacedMesh {
    /// Sets a pair of a ray and one of the triangles, in object space, and gives the t at which the ray starts there.
    #[inline(always)]
    pub fn set_pair(&self, pairs: &mut TrianglePairs, lane: usize, ray: [DVec3; 2], triangle: u32) -> f64 {
        let (own, start) = self.own_ray(ray);
        let corners = self.geometry.corners(triangle as usize).map(|corner| DVec3::from(corner.map(f64::from)));
        pairs.set(lane, own, corners, self.hierarchy.size);
        start
    }

    /// The t at which a ray hits one of the triangles, as the hierarchy finds it; infinity for a miss.
    pub fn triangle_t(&self, ray: [DVec3; 2], triangle: u32) -> f64 {
        self.hierarchy.triangle_t(self.own_ray(ray), &self.triangle(triangle))
    }
}
