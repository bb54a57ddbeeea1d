//! What is made from the list of shapes: where a row may be of any kind, its kind is looked up here and nowhere else.

use super::bounds::Bounds;
use super::emitter::{Emitting, LightPoint};
use super::kind::ShapeKind;
use super::ray_block::{
    BlockHits, ClosestHit, ClosestHits, LANES, RayBlock, RayHit, SurfacePoint, keep_closest_near, vector,
};
use super::shape::{Shape, ShapeNames};
use super::uv::{UvSlope, face_axes, most_of, round_step};
use crate::bvh::{Stack, TestCounts};
use crate::each::Each;
use glam::DVec3;
use multiversion::multiversion;
use std::fmt::Debug;
use std::sync::Arc;

/// A shape of the list.
pub trait Listed: Shape {
    /// Its kind.
    const KIND: ShapeKind;
    /// The names of what exists once for each shape.
    const NAMES: ShapeNames;

    /// The shape as one of any kind.
    fn into_any_shape(self, surface_data: Self::SurfaceData) -> AnyShape;

    /// The shape as a light of any kind; none where it cannot be sampled.
    fn listed_emitter(&self, surface_data: &Self::SurfaceData) -> Option<Emitter>;
}

/// Something to be done once for each registered shape.
pub trait ShapeVisitor {
    /// Does it for one of them.
    fn visit<S: Listed>(&mut self);
}

/// Something to be done with an emitter.
pub trait EmitterVisitor {
    /// Does it with one of this type.
    fn visit<E: Emitting>(self, emitter: &E);
}

/// The probability of starting a ray inside a closed shape that emits on both sides, where there is seldom anything.
const INWARD: f64 = 1.0 / 16.0;

/// A sampled point at which a ray leaves a light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LeavingPoint {
    /// The position in render space.
    pub position: DVec3,
    /// The unit normal of the side that the ray starts on.
    pub normal: DVec3,
    /// Power per unit of radiance and cosine: the area over the probability of the side.
    pub area: f64,
    /// The largest magnitude in the computation of its position, for its error bound.
    pub size: f64,
}

/// The names of what exists once for a shape.
#[doc(hidden)]
#[macro_export]
macro_rules! shape_names {
    ($rows:expr, $plural:literal) => {
        $crate::named::ShapeNames {
            table: $plural,
            hierarchy: concat!("hierarchy of ", $plural),
            rows: $rows,
            classify: concat!("List rows: ", $plural),
            intersect: concat!("Intersect ", $plural),
            raster_boxes: concat!("raster boxes of ", $plural),
            rasterise: concat!("Rasterise boxes: ", $plural),
            surface: concat!("Compute surfaces: ", $plural),
            shadow: concat!("Trace shadow rays: ", $plural),
        }
    };
}
pub use shape_names;

macro_rules! registry {
    ($($kind:ident($shape:ty) $field:ident $plural:literal,)+) => {
        $(impl Listed for $shape {
            const KIND: ShapeKind = ShapeKind::$kind;
            const NAMES: ShapeNames = shape_names!(concat!(stringify!($field), " rows"), $plural);

            fn into_any_shape(self, surface_data: Self::SurfaceData) -> AnyShape {
                AnyShape::$kind(self, surface_data)
            }

            fn listed_emitter(&self, surface_data: &Self::SurfaceData) -> Option<Emitter> {
                self.emitter(surface_data).map(Emitter::$kind)
            }
        })+

        /// Does something for every registered shape, in the order of the list.
        pub fn visit_shapes(visitor: &mut impl ShapeVisitor) {
            $(visitor.visit::<$shape>();)+
        }

        /// A shape of any kind, with what its surface needs.
        #[derive(Clone, Debug, PartialEq)]
        #[allow(clippy::large_enum_variant, reason = "few shapes move, and each is read where it stands")]
        pub enum AnyShape {
            $(#[doc = concat!("One of the ", $plural, ".")] $kind($shape, <$shape as Shape>::SurfaceData),)+
            /// A shape that a program adds.
            Custom(CustomShape),
        }

        impl AnyShape {
            /// The smallest t > 0 at which O + tR intersects it, or infinity.
            pub fn t(&self, origin: DVec3, direction: DVec3) -> f64 {
                match self {
                    $(Self::$kind(shape, _) => shape.t(origin, direction),)+
                    Self::Custom(body) => body.0.t(origin, direction),
                }
            }

            /// Which of its primitives a ray hits at this t.
            pub fn primitive_at(&self, origin: DVec3, direction: DVec3, t: f64) -> u32 {
                match self {
                    $(Self::$kind(shape, _) => shape.primitive_at(origin, direction, t),)+
                    Self::Custom(body) => body.0.primitive_at(origin, direction, t),
                }
            }

            /// Intersects a block of rays, with 1 / R·R of each, with it and keeps the closest hits.
            pub(crate) fn keep_closest(
                &self,
                rays: (&RayBlock, &[f64; LANES]),
                number: u32,
                hits: ClosestHits<'_>,
            ) {
                match self {
                    $(Self::$kind(one, _) => keep_closest_of_one(rays, one, number, hits),)+
                    Self::Custom(body) => body.0.keep_closest(rays, number, hits),
                }
            }

            /// Intersects one ray with it, keeps the closest hit, and counts what the ray is tested against.
            pub(crate) fn keep_closest_counted(
                &self,
                ray: [DVec3; 2],
                number: u32,
                closest: ClosestHit,
                counts: &mut TestCounts,
            ) -> ClosestHit {
                match self {
                    $(Self::$kind(one, _) => one.keep_closest_counted(ray, number, closest, 0, counts),)+
                    Self::Custom(body) => body.0.keep_closest_counted(ray, number, closest, counts),
                }
            }

            /// The surface where a ray hits it.
            pub fn surface(&self, hit: &RayHit) -> SurfacePoint {
                match self {
                    $(Self::$kind(shape, surface_data) => shape.surface(surface_data, hit),)+
                    Self::Custom(body) => body.0.surface(hit),
                }
            }

            /// u and v where a ray hits it; `at` is what its surface has, `own` the hit in its uv space.
            pub fn uv(&self, hit: &RayHit, at: DVec3, own: DVec3) -> [f64; 2] {
                match self {
                    $(Self::$kind(shape, surface_data) => shape.uv(surface_data, hit, at, own),)+
                    Self::Custom(body) => body.0.uv(hit, at, own),
                }
            }

            /// How many times it contains a point.
            pub fn windings(&self, point: DVec3) -> u32 {
                match self {
                    $(Self::$kind(shape, _) => shape.windings(point),)+
                    Self::Custom(body) => body.0.windings(point),
                }
            }

            /// A length that its inside is nowhere thinner than, but for edges and tips.
            pub fn thickness(&self) -> f64 {
                match self {
                    $(Self::$kind(shape, _) => shape.thickness(),)+
                    Self::Custom(body) => body.0.thickness(),
                }
            }

            /// A box around it; none where it is infinite.
            pub fn bounds(&self) -> Option<Bounds> {
                match self {
                    $(Self::$kind(shape, _) => shape.bounds(),)+
                    Self::Custom(body) => body.0.bounds(),
                }
            }
        }

        /// The shape of an area light that can be sampled, in render space.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Emitter {
            $(#[doc = concat!("One of the ", $plural, ".")] $kind(<$shape as Shape>::Emitter),)+
        }

        impl Emitter {
            /// The area that emits, on one side, in square scene units.
            pub fn area(&self) -> f64 {
                match self { $(Self::$kind(emitter) => Emitting::area(emitter),)+ }
            }

            /// The unit normal on its own side where all of it is in one plane; none for other shapes.
            pub fn plane_normal(&self) -> Option<DVec3> {
                match self { $(Self::$kind(emitter) => emitter.plane_normal(),)+ }
            }

            /// Whether a point is on the side of the shape's own normal, which is the outside of a closed shape.
            #[inline(always)]
            pub fn faces(&self, point: DVec3) -> bool {
                match self { $(Self::$kind(emitter) => emitter.faces(point),)+ }
            }
        }

        /// Does something with an emitter by its type.
        #[inline(always)]
        pub fn visit_emitter(emitter: &Emitter, visitor: impl EmitterVisitor) {
            match emitter { $(Emitter::$kind(emitter) => visitor.visit(emitter),)+ }
        }

        /// The point of a light for a point of the unit square.
        #[inline(always)]
        pub fn point_on(emitter: &Emitter, from: DVec3, u: [f64; 2]) -> LightPoint {
            match emitter { $(Emitter::$kind(emitter) => emitter.point(from, u),)+ }
        }

        /// The pdf with which [`point_on`] samples the direction to a point of the light, in 1/sr.
        #[inline(always)]
        pub fn pdf_towards(emitter: &Emitter, from: DVec3, at: DVec3) -> f64 {
            match emitter { $(Emitter::$kind(emitter) => emitter.pdf(from, at),)+ }
        }

        /// The distance to a light along a ray sampled towards it; rounding of the direction may make the ray miss
        /// slightly.
        ///
        /// In units of the direction's length.
        #[inline(always)]
        pub fn distance_to(emitter: &Emitter, from: DVec3, direction: DVec3) -> f64 {
            match emitter { $(Emitter::$kind(emitter) => emitter.distance(from, direction),)+ }
        }

        /// Samples a point on an emitter uniformly over its area, and one of its sides by `side`.
        #[inline(always)]
        pub fn leaving_point(emitter: &Emitter, one_sided: bool, u: [f64; 2], side: f64) -> LeavingPoint {
            match emitter { $(Emitter::$kind(emitter) => leaving(emitter, one_sided, u, side),)+ }
        }

        fn own_uv_step(kind: ShapeKind, numbers: [f64; 2], own: DVec3, step: DVec3) -> DVec3 {
            match kind {
                $(ShapeKind::$kind => <$shape as Shape>::uv_step(numbers, own, step),)+
                ShapeKind::Moving | ShapeKind::Medium | ShapeKind::Custom(_) => DVec3::ZERO,
            }
        }
    };
}
with_shapes!(registry);

/// Makes a shape one that a scene can have by `add_shape`: its number among those that a program
/// adds, and its plural in the names of its stages.
///
/// Its emission is found by BSDF sampling only.
#[macro_export]
macro_rules! custom_shape {
    ($shape:ty, $number:literal, $plural:literal) => {
        impl $crate::named::Listed for $shape {
            const KIND: $crate::named::ShapeKind = $crate::named::ShapeKind::Custom($number);
            const NAMES: $crate::named::ShapeNames = $crate::shape_names!(concat!("rows of ", $plural), $plural);

            fn into_any_shape(
                self,
                surface_data: <Self as $crate::named::Shape>::SurfaceData,
            ) -> $crate::named::AnyShape {
                $crate::named::AnyShape::custom(self, surface_data)
            }

            fn listed_emitter(
                &self,
                _: &<Self as $crate::named::Shape>::SurfaceData,
            ) -> Option<$crate::named::Emitter> {
                None
            }
        }
    };
}
pub use custom_shape;

/// A shape that a program adds where a shape may be of any kind: that of a few shapes, each of which is tested alone.
#[derive(Clone, Debug)]
pub struct CustomShape(Arc<dyn ErasedShape>);

impl PartialEq for CustomShape {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl AnyShape {
    /// A shape that a program adds.
    pub fn custom<S: Shape>(shape: S, surface_data: S::SurfaceData) -> Self {
        Self::Custom(CustomShape(Arc::new((shape, surface_data))))
    }
}

/// What is asked of [`AnyShape`], of a shape without its type.
trait ErasedShape: Debug + Send + Sync {
    fn t(&self, origin: DVec3, direction: DVec3) -> f64;
    fn primitive_at(&self, origin: DVec3, direction: DVec3, t: f64) -> u32;
    fn keep_closest(&self, rays: (&RayBlock, &[f64; LANES]), number: u32, hits: ClosestHits<'_>);
    fn keep_closest_counted(
        &self,
        ray: [DVec3; 2],
        number: u32,
        closest: ClosestHit,
        counts: &mut TestCounts,
    ) -> ClosestHit;
    fn surface(&self, hit: &RayHit) -> SurfacePoint;
    fn uv(&self, hit: &RayHit, at: DVec3, own: DVec3) -> [f64; 2];
    fn windings(&self, point: DVec3) -> u32;
    fn thickness(&self) -> f64;
    fn bounds(&self) -> Option<Bounds>;
}

impl<S: Shape> ErasedShape for (S, S::SurfaceData) {
    fn t(&self, origin: DVec3, direction: DVec3) -> f64 {
        self.0.t(origin, direction)
    }
    fn primitive_at(&self, origin: DVec3, direction: DVec3, t: f64) -> u32 {
        self.0.primitive_at(origin, direction, t)
    }
    fn keep_closest(&self, rays: (&RayBlock, &[f64; LANES]), number: u32, hits: ClosestHits<'_>) {
        keep_closest_of_one(rays, &self.0, number, hits);
    }
    fn keep_closest_counted(
        &self,
        ray: [DVec3; 2],
        number: u32,
        closest: ClosestHit,
        counts: &mut TestCounts,
    ) -> ClosestHit {
        self.0.keep_closest_counted(ray, number, closest, 0, counts)
    }
    fn surface(&self, hit: &RayHit) -> SurfacePoint {
        self.0.surface(&self.1, hit)
    }
    fn uv(&self, hit: &RayHit, at: DVec3, own: DVec3) -> [f64; 2] {
        self.0.uv(&self.1, hit, at, own)
    }
    fn windings(&self, point: DVec3) -> u32 {
        self.0.windings(point)
    }
    fn thickness(&self) -> f64 {
        self.0.thickness()
    }
    fn bounds(&self) -> Option<Bounds> {
        self.0.bounds()
    }
}

fn keep_closest_of_one<S: Shape>(
    (rays, inverse): (&RayBlock, &[f64; LANES]),
    one: &S,
    number: u32,
    mut hits: ClosestHits<'_>,
) {
    if !S::HAS_PRIMITIVES {
        let mut closest = BlockHits::of(hits.t, hits.shape);
        keep_closest_near(rays, inverse, one, number, &mut closest);
        return closest.write(hits.t, hits.shape);
    }
    keep_closest_alone(rays, one, number, &mut hits);
}

/// The rays of a block, each alone.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn keep_closest_alone<S: Shape>(rays: &RayBlock, one: &S, number: u32, hits: &mut ClosestHits<'_>) {
    let mut stack = Stack::default();
    for lane in 0..hits.t.len() {
        let ray = [vector(&rays.o, lane), vector(&rays.d, lane)];
        hits.set(lane, one.keep_closest_of_ray(ray, number, hits.get(lane), &mut stack));
    }
}

#[inline(always)]
fn leaving<E: Emitting>(emitter: &E, one_sided: bool, u: [f64; 2], side: f64) -> LeavingPoint {
    let spot = emitter.spot(u);
    let away = match (one_sided, E::IS_CLOSED) {
        (true, _) => 0.0,
        (_, true) => INWARD,
        _ => 0.5,
    };
    let (normal, random) = if side < away { (-spot.normal, away) } else { (spot.normal, 1.0 - away) };
    LeavingPoint { position: spot.position, normal, area: spot.area / random, size: spot.size }
}

impl UvSlope {
    /// The change of u and v where a hit moves by an offset, given in world and object space; `own` is the hit in
    /// object space, `normal` the surface normal in world space.
    ///
    /// Not finite where it is undefined, such as at the poles of a sphere.
    #[inline(always)]
    pub fn step(&self, own: DVec3, normal: DVec3, step: DVec3, own_step: DVec3) -> DVec3 {
        match self {
            Self::Nowhere | Self::OfPrimitive => DVec3::ZERO,
            Self::Planar([u, v]) => DVec3::new(u.dot(step), v.dot(step), 0.0),
            Self::Round => round_step(own, own_step),
            Self::Faces(slopes) => {
                let axis = most_of(DVec3::from(slopes.each(|slope| normal.dot(slope) / slope.length())));
                let [u, v] = face_axes(axis, own[axis] < 0.0);
                let moved = DVec3::from(slopes.each(|slope| 0.5 * slope.dot(step)));
                DVec3::new(u.dot(moved), v.dot(moved), 0.0)
            }
            Self::Own(kind, numbers) => own_uv_step(*kind, *numbers, own, own_step),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;
    use crate::shapes::PlacedSphere;
    use crate::shapes::emitter::{EmittingCuboid, EmittingDisk, EmittingTriangle, Parallelogram};

    /// Points are uniform over the area: the sum of their cosines to a distant plane gives the shape's projected area.
    #[test]
    fn points_of_lights_are_spread_over_their_area() {
        const TRIED: u64 = 40_000;
        let planar = Parallelogram::new(DVec3::new(1.0, 2.0, 3.0), [DVec3::X * 2.0, DVec3::Z], DVec3::Y);
        let cuboid = EmittingCuboid::new(DVec3::ONE, [DVec3::X, DVec3::Y * 2.0, DVec3::Z * 0.5]);
        let triangle = [DVec3::ZERO, DVec3::X * 3.0, DVec3::Y * 2.0];
        let emitters = [
            (Emitter::Sphere(PlacedSphere { centre: DVec3::ONE, radius: 2.0 }), DVec3::ONE),
            (Emitter::Rectangle(planar), planar.centre),
            (Emitter::Disk(EmittingDisk(planar)), planar.centre),
            (
                Emitter::Triangle(EmittingTriangle { corners: triangle, normal: DVec3::Z }),
                DVec3::new(1.0, 2.0 / 3.0, 0.0),
            ),
            (Emitter::Cuboid(cuboid), DVec3::ONE),
        ];
        for (number, (emitter, middle)) in emitters.into_iter().enumerate() {
            for one_sided in [true, false] {
                let mut draws = Draws::new(2712, number as u64);
                let (mut mean, mut up, mut area) = (DVec3::ZERO, DVec3::ZERO, 0.0);
                for _ in 0..TRIED {
                    let (u, side) = ([draws.unit(), draws.unit()], draws.unit());
                    let point = leaving_point(&emitter, one_sided, u, side);
                    assert!((point.normal.length() - 1.0).abs() < 1e-12);
                    let outward = emitter.faces(point.position + 1e-6 * point.normal);
                    assert!(outward || !one_sided, "{number}");
                    mean += point.position - middle;
                    up += point.normal.abs() * point.area;
                    area += point.area;
                }
                let sides = if one_sided { 1.0 } else { 2.0 };
                let n = TRIED as f64;
                assert!((mean / n).abs().max_element() < 0.04, "{number}: {}", mean / n);
                assert!((area / n / emitter.area() / sides - 1.0).abs() < 0.06, "{number}: {}", area / n);
                if let (Emitter::Cuboid(_), true) = (&emitter, one_sided) {
                    // Faces across x, y and z: 4, 1 and 8 units, each twice.
                    assert!((up / n - DVec3::new(8.0, 4.0, 16.0)).abs().max_element() < 0.5, "{}", up / n);
                }
            }
        }
    }
}
