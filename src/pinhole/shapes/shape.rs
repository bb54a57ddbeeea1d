use super::bounds::Bounds;
use super::emitter::{Emitting, NeverSampled};
use super::ray_block::{
    BlockVectors, ClosestHit, ClosestHits, HitBlock, Intersection, LANES, RayHit, RaySlices, SurfacePoint,
    keep_closest_rows, vector,
};
use super::space::Pose;
use super::uv::UvSlope;
use crate::bvh::{Stack, TestCounts};
use crate::scene::SceneError;
use bevy_ecs::component::Mutable;
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};
use std::any::TypeId;
use std::fmt::Debug;

/// A component that makes an entity a shape.
pub trait SceneShape: Component<Mutability = Mutable> + Clone + Default {
    /// Its type's name, such as `Disk`.
    const NAME: &'static str;
    /// Its name in messages, such as `disk`.
    const WORD: &'static str;

    /// Multiplies all of its lengths.
    fn scale(&mut self, by: f64);

    /// Components that the tests of all shapes try: the default, and what is harder, such as thin parts.
    fn examples() -> Vec<Self> {
        vec![Self::default()]
    }
}

/// Where a shape's entity is placed.
#[derive(Clone, Copy, Debug)]
pub struct Placed<'a> {
    /// The entity in messages, such as `disk "table top"`.
    pub who: &'a str,
    /// Between its object space and world space, at the moment when the shutter opens.
    pub pose: Pose,
    /// The origin of its object space, relative to the eye.
    pub position: DVec3,
    /// The scale of its own placement, without those of its parents.
    pub scale: DVec3,
    /// Whether a parent is placed too.
    pub has_parent: bool,
}

/// All that the renderer asks of a shape; everything else is generic over it.
///
/// A value is the shape as the intersection kernels read it: a row of its table, in render space, in f64.
/// The types that implement it are listed at the head of this folder.
pub trait Shape: Clone + Debug + PartialEq + Send + Sync + 'static {
    /// The component of the scene that it is made from.
    type Component: SceneShape;
    /// What its surface needs besides, kept apart from what intersection reads; often nothing.
    type SurfaceData: Clone + Debug + Default + PartialEq + Send + Sync + 'static;
    /// The shape as a light that is sampled; [`NeverSampled`](super::emitter::NeverSampled) for shapes whose emission is found by
    /// BSDF sampling only.
    type Emitter: Emitting;
    /// What is computed once of all shapes that every ray is tested against, for [`Self::keep_closest`]; often nothing.
    type Prepared: Clone + Debug + Default + PartialEq + Send + Sync + 'static;

    /// What it is called where the plan counts the entities that need its stages.
    const NOUN: &'static str = Self::Component::WORD;
    /// For a component that has a shape of its own where the placement's scale is not uniform: whether this is that one.
    const NON_UNIFORM: Option<bool> = None;
    /// Whether it has a bounding box.
    const IS_BOUNDED: bool = true;
    /// Whether it consists of several primitives, so that a hit has to say which.
    const HAS_PRIMITIVES: bool = false;
    /// Whether it consists of triangles, which can be rasterised.
    const IS_TRIANGULAR: bool = false;
    /// Whether several usually make up one surface, such as the triangles of a mesh.
    const IS_PART: bool = false;
    /// Whether its u and v are those of a point in its uv space.
    const HAS_UV_SPACE: bool = false;
    /// Whether [`Self::intersections`] of a block takes less time than [`Self::intersection`] of one ray after another.
    const IN_BLOCKS: bool = true;
    /// From so many on a hierarchy over them saves time; fewer are tested one by one, sixteen rays at a time.
    ///
    /// `cargo bench --bench curves` prints both times for rays of a camera and for random ones: this lies between the
    /// numbers from which on either gain.
    const HIERARCHY_FROM: usize = 64;

    /// Whether it can be made of glass: it has an inside, alone or together with others.
    fn has_inside(component: &Self::Component) -> bool;

    /// The shape of a component and its placement.
    ///
    /// Errors: a number of the component, or of the placed shape, that is not accepted.
    fn place(component: &Self::Component, placed: &Placed<'_>) -> Result<(Self, Self::SurfaceData), SceneError>;

    /// The smallest t > 0 at which O + tR intersects it, in f64, and whether rounding leaves that uncertain.
    fn intersection(&self, origin: DVec3, direction: DVec3) -> Intersection;

    /// The same of a block of sixteen rays, given component by component: the t of each, and whether it is uncertain.
    #[inline(always)]
    fn intersections(&self, [o, d]: [&BlockVectors; 2], t: &mut [f64; LANES], uncertain: &mut [bool; LANES]) {
        for lane in 0..LANES {
            let intersection = self.intersection(vector(o, lane), vector(d, lane));
            (t[lane], uncertain[lane]) = (intersection.t, intersection.uncertain);
        }
    }

    /// The same t with more precision, or infinity; only asked where f64 is uncertain.
    fn precise_t(&self, origin: DVec3, direction: DVec3) -> f64;

    /// The smallest t > 0 at which O + tR intersects it, or infinity.
    #[inline(always)]
    fn t(&self, origin: DVec3, direction: DVec3) -> f64 {
        let intersection = self.intersection(origin, direction);
        if intersection.uncertain { self.precise_t(origin, direction) } else { intersection.t }
    }

    /// The centre and radius of a sphere around it, which rays are tested against first; none where that gains nothing.
    #[inline(always)]
    fn culling_sphere(&self) -> Option<(DVec3, f64)> {
        None
    }

    /// What [`Self::keep_closest`] reads of these shapes besides.
    fn prepared(_shapes: &[Self]) -> Self::Prepared {
        Self::Prepared::default()
    }

    /// Intersects all rays with all of these shapes, of which that was prepared and which have these numbers, and keeps the
    /// closest hits.
    fn keep_closest(
        (shapes, _): (&[Self], &Self::Prepared),
        numbers: &[u32],
        rays: RaySlices<'_>,
        hits: ClosestHits<'_>,
    ) {
        keep_closest_rows(shapes, numbers, rays, hits);
    }

    /// Intersects one ray with it, whose number this is, and keeps the closest hit.
    #[inline(always)]
    fn keep_closest_of_ray(&self, ray: [DVec3; 2], number: u32, closest: ClosestHit, _: &mut Stack) -> ClosestHit {
        let t = self.t(ray[0], ray[1]);
        let closer = t < closest.t || (t == closest.t && number < closest.shape && t < f64::INFINITY);
        if closer { ClosestHit { t, shape: number, ..closest } } else { closest }
    }

    /// The same, and counts what the ray is tested against; `above` nodes of a hierarchy are above the shape.
    fn keep_closest_counted(
        &self,
        ray: [DVec3; 2],
        number: u32,
        closest: ClosestHit,
        _above: u32,
        counts: &mut TestCounts,
    ) -> ClosestHit {
        counts.primitives += 1;
        self.keep_closest_of_ray(ray, number, closest, &mut Stack::default())
    }

    /// Which of its primitives a ray hits at this t; 0 where it does not consist of several.
    fn primitive_at(&self, _origin: DVec3, _direction: DVec3, _t: f64) -> u32 {
        0
    }

    /// The surface where a ray hits it.
    fn surface(&self, surface_data: &Self::SurfaceData, hit: &RayHit) -> SurfacePoint;

    /// The surface of one hit of a block, each of which is given with the row of its shape.
    #[inline(always)]
    fn fill_surface(shapes: &[Self], surface_data: &[Self::SurfaceData], hits: &mut HitBlock, lane: usize) {
        let (row, hit) = hits.hit(lane);
        hits.set_surface(lane, &shapes[row as usize].surface(&surface_data[row as usize], &hit));
    }

    /// The surfaces of the first `count` hits; a shape that computes several together answers with the same bits.
    #[inline(always)]
    fn fill_surfaces(shapes: &[Self], surface_data: &[Self::SurfaceData], hits: &mut HitBlock, count: usize) {
        (0..count).for_each(|lane| Self::fill_surface(shapes, surface_data, hits, lane));
    }

    /// u and v where a ray hits it: at [`SurfacePoint::at`], and at `own` in its uv space, which is given where
    /// [`Self::HAS_UV_SPACE`] says so.
    fn uv(&self, surface_data: &Self::SurfaceData, hit: &RayHit, at: DVec3, own: DVec3) -> [f64; 2];

    /// The linear map from world space to its uv space, which is its object space unless it says otherwise.
    fn uv_from_world(_component: &Self::Component, entity_from_world: DMat3) -> DMat3 {
        entity_from_world
    }

    /// The gradients of u and v along it; `uv_from_world` is the linear map to its uv space.
    fn uv_slope(&self, surface_data: &Self::SurfaceData, uv_from_world: DMat3) -> UvSlope;

    /// The gradients of u and v along one of its primitives, where [`UvSlope::OfPrimitive`] says that each has its own.
    fn uv_slope_of(&self, _beside: &Self::SurfaceData, _primitive: u32) -> UvSlope {
        UvSlope::Nowhere
    }

    /// The change of u and v along an offset from a hit, both in object space, for a shape whose slope is
    /// [`UvSlope::Own`] with these numbers.
    #[inline(always)]
    fn uv_step(_numbers: [f64; 2], _own: DVec3, _step: DVec3) -> DVec3 {
        DVec3::ZERO
    }

    /// A box around it; none where it is infinite.
    fn bounds(&self) -> Option<Bounds>;

    /// The memory that these shapes take besides their rows, in bytes.
    fn bytes_of_surface_data(_shapes: &[Self]) -> usize {
        0
    }

    /// The centre and radius of a sphere around it; none where it is infinite.
    fn bounding_sphere(&self) -> Option<(DVec3, f64)> {
        self.bounds().map(|bounds| bounds.sphere_around())
    }

    /// Whether a point is inside; false for a shape that has no inside of its own.
    fn contains(&self, _point: DVec3) -> bool {
        false
    }

    /// How many times it contains a point; more than once only where its own surface overlaps itself.
    fn windings(&self, point: DVec3) -> u32 {
        u32::from(self.contains(point))
    }

    /// A length that its inside is nowhere thinner than, but for edges and tips; infinite where it has no inside.
    fn thickness(&self) -> f64 {
        f64::INFINITY
    }

    /// Whether it is sampled where it emits; the emission of others is found by BSDF sampling only.
    fn is_sampled(_component: &Self::Component) -> bool {
        TypeId::of::<Self::Emitter>() != TypeId::of::<NeverSampled>()
    }

    /// The shape as a light that is sampled; none where it cannot be, or where each of its primitives is one.
    fn emitter(&self, _beside: &Self::SurfaceData) -> Option<Self::Emitter> {
        None
    }
}

/// The names of a registered shape's table, column and stages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShapeNames {
    /// Its table.
    pub table: &'static str,
    /// The hierarchy over them.
    pub hierarchy: &'static str,
    /// The column that lists the rows which hit it.
    pub rows: &'static str,
    /// The stage that lists them, of a shape that a program adds.
    pub classify: &'static str,
    /// The stage that intersects rays with it.
    pub intersect: &'static str,
    /// The table of the pixels that each of them may cover.
    pub raster_boxes: &'static str,
    /// The stage that intersects rays with each of them in those pixels only.
    pub rasterise: &'static str,
    /// The stage that computes its surface.
    pub surface: &'static str,
    /// The stage that traces shadow rays against it.
    pub shadow: &'static str,
}
