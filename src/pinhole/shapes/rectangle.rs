use super::bounds::Bounds;
use super::double_double::double_double_rectangle_t;
use super::emitter::Parallelogram;
use super::planar::{Planar, crossing};
use super::ray_block::{Intersection, RayHit, SurfacePoint};
use super::shape::{Placed, SceneShape, Shape};
use super::uv::UvSlope;
use crate::each::Each;
use crate::scene::{Rectangle, SceneError, positive_length};
use glam::{DMat3, DVec3};

/// A rectangle in render space: the points of a plane whose two coordinates are both from −1 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedRectangle {
    /// The plane with its two coordinates.
    pub planar: Planar,
}

impl SceneShape for Rectangle {
    const NAME: &'static str = "Rectangle";
    const WORD: &'static str = "rectangle";

    fn scale(&mut self, by: f64) {
        self.width *= by;
        self.depth *= by;
    }
}

impl Shape for PlacedRectangle {
    type Component = Rectangle;
    type SurfaceData = ();
    type Emitter = Parallelogram;
    type Prepared = ();

    const HIERARCHY_FROM: usize = 12;

    fn has_inside(_: &Rectangle) -> bool {
        false
    }

    fn place(rectangle: &Rectangle, placed: &Placed<'_>) -> Result<(Self, ()), SceneError> {
        let width = positive_length(placed.who, "width", rectangle.width)?;
        let depth = positive_length(placed.who, "depth", rectangle.depth)?;
        Ok((Self { planar: Planar::place(placed, [width / 2.0, depth / 2.0])? }, ()))
    }

    #[inline(always)]
    fn intersection(&self, origin: DVec3, direction: DVec3) -> Intersection {
        rectangle_intersection(origin, direction, &self.planar)
    }

    fn precise_t(&self, origin: DVec3, direction: DVec3) -> f64 {
        double_double_rectangle_t(origin, direction, &self.planar)
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

    fn bounds(&self) -> Option<Bounds> {
        let [x, z] = self.planar.half_edges();
        Some(Bounds::about(self.planar.centre, x.abs() + z.abs()))
    }

    fn emitter(&self, (): &()) -> Option<Parallelogram> {
        Some(self.planar.parallelogram())
    }
}

/// Intersects O + tR with a rectangle, in f64: at the rectangle's plane, if both coordinates there are in [−1, 1].
#[inline(always)]
pub fn rectangle_intersection(origin: DVec3, direction: DVec3, planar: &Planar) -> Intersection {
    let crossing = crossing(origin, direction, planar);
    let [x, z] = crossing.at.each(f64::abs);
    let farther = if x > z { x } else { z };
    let at_the_edge = (farther - 1.0).abs() <= crossing.error;
    let hits = (x <= 1.0) & (z <= 1.0) & (crossing.t > 0.0) & !crossing.surely_not;
    Intersection {
        t: if hits { crossing.t } else { f64::INFINITY },
        uncertain: !crossing.surely_not & (!crossing.sure | at_the_edge),
    }
}

/// The t > 0 at which O + tR hits a rectangle, or infinity; uncertain cases are decided in double-double.
#[inline(always)]
pub fn rectangle_t(origin: DVec3, direction: DVec3, planar: &Planar) -> f64 {
    let intersection = rectangle_intersection(origin, direction, planar);
    if intersection.uncertain { double_double_rectangle_t(origin, direction, planar) } else { intersection.t }
}
