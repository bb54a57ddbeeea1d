//! Rays → the closest hit and its surface.
//!
//! Reads: a ray column ([`WorldRays`](crate::rays::WorldRays), or shadow rays) and the tables of shapes.
//! Writes: [`Hits`], the lists of rows of each kind, and [`Surfaces`].
//! Space: render space. The kinds of shapes run one after another over the whole tile, and each keeps the closest hits;
//! at equal distances the lowest shape number wins, so the order of the kinds does not affect the result.
//!
//! ```
//! use pinhole::intersect::sphere_intersection;
//! use pinhole::prelude::*;
//!
//! // A ray along −z towards a sphere of radius 1 whose centre is 5 away.
//! let hit = sphere_intersection(DVec3::new(0.0, 0.0, -5.0), DVec3::NEG_Z, 1.0);
//! assert_eq!((hit.t, hit.uncertain), (4.0, false));
//! // Along a tangent rounding decides, and the bound says so: such rays are intersected again in double-double.
//! assert!(sphere_intersection(DVec3::new(1.0, 0.0, -5.0), DVec3::NEG_Z, 1.0).uncertain);
//! ```

mod classify;
mod contact;
mod count;
mod hits;
mod moving;
mod named_stages;
mod shading_normal;
mod shape_stages;
mod surface;

pub use crate::extract::shape_evidence;
pub use crate::shapes::sphere_intersection;
pub use hits::Hits;
pub(crate) use hits::rows_of_kind;
pub(crate) use surface::SurfaceSlices;
pub use surface::{Surface, Surfaces};

unstable! {
    use classify::{classify_hits, classify_shape, classify_shape_stage, classify_stage, list_rows};
    use contact::{Contacts, GlassCrossing, contact_bound_stage, contact_stage, merge_contacts, widen_bounds};
    use count::{AllShapes, BoxTests, PrimitiveTests, TraversalDepths, count_stage};
    use hits::{
        EmissiveRows, HitColumn, HitPrimitives, MaterialRows, NO_PRIMITIVE, NO_SHAPE, RayColumn, ShapeRows, start_hits,
        start_stage,
    };
    use moving::{at_rest, intersect_moving, moving_stage, moving_surface_stage};
    use named_stages::{
        cuboid_stage, cuboid_surface_stage, disk_stage, disk_surface_stage, ellipsoid_stage, ellipsoid_surface_stage,
        mesh_stage, mesh_surface_stage, plane_stage, plane_surface_stage, rectangle_stage, rectangle_surface_stage,
        sphere_stage, sphere_surface_stage, triangle_stage, triangle_surface_stage,
    };
    use shading_normal::{
        ShadingNormals, falling_cosine, interpolate_normals, shading_normal, shading_normal_stage,
        vertex_normal_evidence,
    };
    use shape_stages::{fill_surfaces, intersect_shapes, intersect_stage, shape_stages, surface_stage};
    use surface::{SurfaceSides, SurfaceUvs};
}
