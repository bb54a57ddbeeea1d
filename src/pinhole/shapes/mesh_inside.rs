//! The inside of a mesh: whether a point is in it, and how thin it is.

use super::mesh::PlacedMesh;
use super::offset::l1_norm;
use super::ray_hit::RayHit;
use super::shape::Shape;
use glam::DVec3;

/// How far past a triangle a ray that counts triangles goes on, as a fraction of the numbers from which it was computed.
const NEXT_TRIANGLE: f64 = 1.0 / (1_u64 << 46) as f64;

impl PlacedMesh {
    /// How many times a mesh that closes is around a point, counted along a ray: every surface that it leaves through is
    /// around the point, unless it was entered on the way.
    pub(super) fn windings_around(&self, point: DVec3) -> u32 {
        // Any direction will do; this one is along no axis.
        let direction = DVec3::new(0.6, 0.48, 0.64);
        if !self.bounds.contains(point) || !self.closes() {
            return 0;
        }
        let (mut around, mut origin) = (0, point);
        // Each step crosses a triangle, so that the count ends by itself; a step that rounding loses ends it too.
        for _ in 0..2 * self.geometry.triangles.len() {
            let closest = self.closest(origin, direction);
            if closest.t == f64::INFINITY {
                break;
            }
            let hit = RayHit { primitive: closest.primitive, ..RayHit::at_rest(origin, direction, closest.t) };
            around += if self.surface(&(), &hit).outside { -1 } else { 1 };
            let past = NEXT_TRIANGLE * (self.size + l1_norm(origin) + closest.t);
            origin += (closest.t + past) * direction;
        }
        u32::try_from(around).unwrap_or(0)
    }

    /// Whether its triangles enclose an inside.
    fn closes(&self) -> bool {
        self.hierarchy.is_closed(&self.geometry)
    }

    /// The least distance to what lies behind the middle of a triangle: where two sides are near each other over an area,
    /// some triangle's middle is there.
    pub(super) fn least_thickness(&self) -> f64 {
        let behind = |(triangle, corners): (usize, [DVec3; 3])| {
            let inward = -self.normal_of(&self.triangle(triangle as u32));
            let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
            let past = NEXT_TRIANGLE * (self.size + l1_norm(middle));
            let t = if inward.is_finite() { self.closest(middle + past * inward, inward).t } else { f64::INFINITY };
            t + past
        };
        self.placed_triangles().enumerate().map(behind).fold(f64::INFINITY, f64::min)
    }
}
