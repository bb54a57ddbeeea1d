use super::bounds::Bounds;
use super::emitter::NeverSampled;
use super::frustum::Frustum;
use super::kind::ShapeKind;
use super::ray_block::Intersection;
use super::shape::{Placed, RayHit, SceneShape, Shape, SurfacePoint};
use super::unit_space::UnitSpace;
use super::uv_slope::UvSlope;
use crate::scene::{Cone, SceneError, positive_length};
use glam::{DMat3, DVec3};

/// r(y) = (1 − y) / 2: 1 at the base, 0 at the apex.
const PROFILE: [f64; 2] = [0.5, -0.5];

/// A cone in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedCone(pub Frustum);

impl SceneShape for Cone {
    const NAME: &'static str = "Cone";
    const WORD: &'static str = "cone";

    fn scale(&mut self, by: f64) {
        self.radius *= by;
        self.height *= by;
    }

    fn examples() -> Vec<Self> {
        let of = |radius, height, capped| Self { radius, height, capped };
        vec![of(1.0, 2.0, true), of(1.0, 1.0, false), of(1.0, 0.01, true), of(0.01, 3.0, true), of(0.01, 3.0, false)]
    }
}

impl Shape for PlacedCone {
    type Component = Cone;
    type Beside = ();
    type Emitter = NeverSampled;

    fn has_inside(cone: &Cone) -> bool {
        cone.capped
    }

    fn place(cone: &Cone, placed: &Placed<'_>) -> Result<(Self, ()), SceneError> {
        let radius = positive_length(placed.who, "radius", cone.radius)?;
        let half = positive_length(placed.who, "height", cone.height)? / 2.0;
        let space = UnitSpace::place(placed, DVec3::new(radius, half, radius), 1.0)?;
        Ok((Self(Frustum { space, profile: PROFILE, capped: cone.capped }), ()))
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
        UvSlope::Own(ShapeKind::Cone, self.0.space.half_axes(uv_from_world))
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
