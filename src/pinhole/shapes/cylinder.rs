use super::bounds::Bounds;
use super::emitter::NeverSampled;
use super::frustum::Frustum;
use super::kind::ShapeKind;
use super::ray_block::Intersection;
use super::shape::{Placed, RayHit, SceneShape, Shape, SurfacePoint};
use super::unit_space::UnitSpace;
use super::uv_slope::UvSlope;
use crate::scene::{Cylinder, SceneError, positive_length};
use glam::{DMat3, DVec3};

/// r(y) = 1.
const PROFILE: [f64; 2] = [1.0, 0.0];

/// A cylinder in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedCylinder(pub Frustum);

impl SceneShape for Cylinder {
    const NAME: &'static str = "Cylinder";
    const WORD: &'static str = "cylinder";

    fn scale(&mut self, by: f64) {
        self.radius *= by;
        self.height *= by;
    }

    fn examples() -> Vec<Self> {
        let of = |radius, height, capped| Self { radius, height, capped };
        vec![of(1.0, 2.0, true), of(1.0, 1.0, false), of(1.0, 0.01, true), of(0.01, 3.0, true), of(0.01, 3.0, false)]
    }
}

impl Shape for PlacedCylinder {
    type Component = Cylinder;
    type Beside = ();
    type Emitter = NeverSampled;

    fn has_inside(cylinder: &Cylinder) -> bool {
        cylinder.capped
    }

    fn place(cylinder: &Cylinder, placed: &Placed<'_>) -> Result<(Self, ()), SceneError> {
        let radius = positive_length(placed.who, "radius", cylinder.radius)?;
        let half = positive_length(placed.who, "height", cylinder.height)? / 2.0;
        let space = UnitSpace::place(placed, DVec3::new(radius, half, radius), 1.0)?;
        Ok((Self(Frustum { space, profile: PROFILE, capped: cylinder.capped }), ()))
    }

    #[inline(always)]
    fn intersection(&self, origin: DVec3, direction: DVec3) -> Intersection {
        self.0.intersection(origin, direction)
    }

    fn precise_t(&self, origin: DVec3, direction: DVec3) -> f64 {
        self.0.precise_t(origin, direction)
    }

    #[inline(always)]
    fn culling_sphere(&self) -> Option<(DVec3, f64)> {
        Some(self.0.space.culling_sphere())
    }

    #[inline(always)]
    fn surface(&self, (): &(), hit: &RayHit) -> SurfacePoint {
        self.0.surface(hit)
    }

    #[inline(always)]
    fn uv(&self, (): &(), _hit: &RayHit, at: DVec3, _own: DVec3) -> [f64; 2] {
        Frustum::uv(at)
    }

    fn uv_slope(&self, (): &(), uv_from_world: DMat3) -> UvSlope {
        UvSlope::Own(ShapeKind::Cylinder, self.0.space.half_axes(uv_from_world))
    }

    #[inline(always)]
    fn uv_step(half_axes: [f64; 2], own: DVec3, step: DVec3) -> DVec3 {
        Frustum::uv_step(PROFILE, half_axes, own, step)
    }

    fn bounds(&self) -> Option<Bounds> {
        Some(self.0.bounds())
    }

    fn contains(&self, point: DVec3) -> bool {
        self.0.contains(point)
    }
}
