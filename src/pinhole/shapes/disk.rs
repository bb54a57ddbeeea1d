use super::bounds::Bounds;
use super::double_double::double_double_disk_t;
use super::emitter::{EmittingDisk, Parallelogram};
use super::planar::{Planar, crossing};
use super::ray_block::{Intersection, RayHit, SurfacePoint};
use super::shape::{Placed, SceneShape, Shape};
use super::uv::UvSlope;
use crate::each::Each;
use crate::scene::{Disk, SceneError, positive_length};
use glam::{DMat3, DVec3};

/// A disk in render space: the points of a plane whose two coordinates have squares that add up to at most 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedDisk {
    /// The plane with its two coordinates.
    pub planar: Planar,
}

impl SceneShape for Disk {
    const NAME: &'static str = "Disk";
    const WORD: &'static str = "disk";

    fn scale(&mut self, by: f64) {
        self.radius *= by;
    }
}

impl Shape for PlacedDisk {
    type Component = Disk;
    type SurfaceData = ();
    type Emitter = EmittingDisk;
    type Prepared = ();

    const HIERARCHY_FROM: usize = 12;

    fn has_inside(_: &Disk) -> bool {
        false
    }

    fn place(disk: &Disk, placed: &Placed<'_>) -> Result<(Self, ()), SceneError> {
        let radius = positive_length(placed.who, "radius", disk.radius)?;
        Ok((Self { planar: Planar::place(placed, [radius; 2])? }, ()))
    }

    #[inline(always)]
    fn intersection(&self, origin: DVec3, direction: DVec3) -> Intersection {
        disk_intersection(origin, direction, &self.planar)
    }

    fn precise_t(&self, origin: DVec3, direction: DVec3) -> f64 {
        double_double_disk_t(origin, direction, &self.planar)
    }

    #[inline(always)]
    fn surface(&self, (): &(), hit: &RayHit) -> SurfacePoint {
        self.planar.surface(hit)
    }

    #[inline(always)]
    fn uv(&self, (): &(), hit: &RayHit, _at: DVec3, _own: DVec3) -> [f64; 2] {
        self.planar.uv(hit)
    }

    fn uv_slope(&self, (): &(), _uv_from_world: DMat3) -> UvSlope {
        self.planar.uv_slope()
    }

    /// The maximum of x cos φ + z sin φ for its two half edges is √(x² + z²), component by component.
    fn bounds(&self) -> Option<Bounds> {
        let [x, z] = self.planar.half_edges();
        let half_size = DVec3::from([0, 1, 2].each(|axis| (x[axis] * x[axis] + z[axis] * z[axis]).sqrt()));
        Some(Bounds::about(self.planar.centre, half_size))
    }

    fn emitter(&self, (): &()) -> Option<EmittingDisk> {
        let planar = &self.planar;
        Some(EmittingDisk(Parallelogram::about_ellipse(planar.centre, planar.half_edges(), planar.normal)))
    }
}

// ANCHOR: disk_intersection
/// Intersects O + tR with a disk, in f64: at the disk's plane, if the squares of the coordinates there sum to at most
/// 1.
///
/// If rounding moved the point p by at most e along each axis, |p|² is off by at most 2√2|p|e + 2e², and 2|p| ≤ 1 +
/// |p|².
#[inline(always)]
pub fn disk_intersection(origin: DVec3, direction: DVec3, planar: &Planar) -> Intersection {
    let crossing = crossing(origin, direction, planar);
    let [x, z] = crossing.at;
    let square = x * x + z * z;
    let slack = 3.0 * crossing.error * (1.0 + square + crossing.error);
    let at_the_edge = (square - 1.0).abs() <= slack;
    let hits = (square <= 1.0) & (crossing.t > 0.0) & !crossing.surely_not;
    Intersection {
        t: if hits { crossing.t } else { f64::INFINITY },
        uncertain: !crossing.surely_not & (!crossing.sure | at_the_edge),
    }
}

/// The t > 0 at which O + tR hits a disk, or infinity; uncertain cases are decided in double-double.
#[inline(always)]
pub fn disk_t(origin: DVec3, direction: DVec3, planar: &Planar) -> f64 {
    let intersection = disk_intersection(origin, direction, planar);
    if intersection.uncertain { double_double_disk_t(origin, direction, planar) } else { intersection.t }
}
// ANCHOR_END: disk_intersection
