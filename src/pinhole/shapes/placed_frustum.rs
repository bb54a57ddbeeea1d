use super::bounds::Bounds;
use super::frustum::Frustum;
use super::frustum_light::EmittingFrustum;
use super::kind::ShapeKind;
use super::ray_block::Intersection;
use super::ray_hit::{RayHit, SurfacePoint};
use super::shape::{Placed, SceneShape, Shape};
use super::unit_space::UnitSpace;
use super::uv_slope::UvSlope;
use crate::scene::{SceneError, positive_length};
use glam::{DMat3, DVec3};
use std::fmt::Debug;
use std::marker::PhantomData;

/// A component that is a frustum once it is placed.
pub trait FrustumShape: SceneShape + Debug + PartialEq {
    /// Its kind.
    const KIND: ShapeKind;
    /// a and b of the radius a + by, in unit space.
    const PROFILE: [f64; 2];

    /// The largest radius and the height, in scene units.
    fn extent(&self) -> [f64; 2];
    /// Whether disks close its ends.
    fn is_capped(&self) -> bool;
}

/// A cylinder or a cone in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedFrustum<C> {
    /// What its numbers are, whichever component they come from.
    pub frustum: Frustum,
    component: PhantomData<fn() -> C>,
}

// ANCHOR: frustum_shape
impl<C: FrustumShape> Shape for PlacedFrustum<C> {
    type Component = C;
    type SurfaceData = ();
    type Emitter = EmittingFrustum;

    const HIERARCHY_FROM: usize = 48;

    fn has_inside(component: &C) -> bool {
        component.is_capped()
    }

    fn place(component: &C, placed: &Placed<'_>) -> Result<(Self, ()), SceneError> {
        let [radius, height] = component.extent();
        let radius = positive_length(placed.who, "radius", radius)?;
        let half = positive_length(placed.who, "height", height)? / 2.0;
        let space = UnitSpace::place(placed, DVec3::new(radius, half, radius), 1.0)?;
        let frustum = Frustum { space, profile: C::PROFILE, capped: component.is_capped() };
        Ok((Self { frustum, component: PhantomData }, ()))
    }

    #[inline(always)]
    fn intersection(&self, origin: DVec3, direction: DVec3) -> Intersection {
        self.frustum.intersection(origin, direction)
    }

    fn precise_t(&self, origin: DVec3, direction: DVec3) -> f64 {
        self.frustum.precise_t(origin, direction)
    }

    #[inline(always)]
    fn culling_sphere(&self) -> Option<(DVec3, f64)> {
        Some(self.frustum.space.culling_sphere())
    }

    #[inline(always)]
    fn surface(&self, (): &(), hit: &RayHit) -> SurfacePoint {
        self.frustum.surface(hit)
    }

    #[inline(always)]
    fn uv(&self, (): &(), _hit: &RayHit, at: DVec3, _own: DVec3) -> [f64; 2] {
        Frustum::uv(at)
    }

    fn uv_slope(&self, (): &(), uv_from_world: DMat3) -> UvSlope {
        UvSlope::Own(C::KIND, self.frustum.space.half_axes(uv_from_world))
    }

    #[inline(always)]
    fn uv_step(half_axes: [f64; 2], own: DVec3, step: DVec3) -> DVec3 {
        Frustum::uv_step(C::PROFILE, half_axes, own, step)
    }

    fn bounds(&self) -> Option<Bounds> {
        Some(self.frustum.bounds())
    }

    fn contains(&self, point: DVec3) -> bool {
        self.frustum.contains(point)
    }

    fn thickness(&self) -> f64 {
        self.frustum.thickness()
    }

    fn is_sampled(component: &C) -> bool {
        component.is_capped()
    }

    fn emitter(&self, (): &()) -> Option<EmittingFrustum> {
        EmittingFrustum::new(&self.frustum)
    }
}
// ANCHOR_END: frustum_shape
