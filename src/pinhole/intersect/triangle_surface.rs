use super::ray_block::UNIT_ROUNDOFF;
use super::rows::TriangleRows;
use super::surface::{Surface, offset_bound};
use super::triangle::{Edges, Shear, edges, longest_axis, triangle_evidence};
use super::triangle_exact::exact_barycentrics;
use super::view::{SurfaceView, SurfaceViewItem};
use crate::extract::{ShapeTable, TriangleRow, TriangleTable};
use crate::plan::{Shared, Stage, TileSystems};
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};

/// The point at which a ray hits a triangle, in barycentric coordinates, and the side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleHit {
    /// The barycentric coordinates: each in [0, 1], with a sum of 1 to within 2⁻⁵¹.
    pub weights: [f64; 3],
    /// Whether the ray's direction is on the side of (B − A) × (C − A).
    pub along: bool,
}

impl TriangleHit {
    /// The hit of a ray that is known to hit the triangle.
    #[inline(always)]
    pub fn of(origin: DVec3, direction: DVec3, triangle: &TriangleRow) -> Self {
        match longest_axis(direction) {
            0 => Self::by::<0>(origin, direction, triangle),
            1 => Self::by::<1>(origin, direction, triangle),
            _ => Self::by::<2>(origin, direction, triangle),
        }
    }

    /// The barycentric coordinates are the areas over their sum; those that rounding made negative are set to 0.
    /// If the sum is so small that a coordinate could be off by more than 2⁻²⁶, exact arithmetic is used.
    #[inline(always)]
    fn by<const Z: usize>(origin: DVec3, direction: DVec3, triangle: &TriangleRow) -> Self {
        let (shear, size) = (Shear::along::<Z>(direction), origin.abs().element_sum());
        let Edges { areas, error, .. } = edges::<Z>(origin, shear, triangle, size);
        let whole: f64 = areas.iter().sum();
        let (weights, along) = if 4.0 * error < 0.25 * UNIT_ROUNDOFF * whole.abs() {
            (areas.map(|area| area / whole), whole * shear.z)
        } else {
            exact_barycentrics(origin, direction, triangle)
        };
        let weights = weights.map(|weight| weight.max(0.0));
        let sum: f64 = weights.iter().sum();
        Self { weights: weights.map(|weight| weight / sum), along: along > 0.0 }
    }

    /// Interpolates vectors given at the vertices.
    #[inline(always)]
    pub fn interpolate(&self, vectors: &[DVec3; 3]) -> DVec3 {
        let [a, b, c] = self.weights;
        a * vectors[0] + b * vectors[1] + c * vectors[2]
    }

    /// Interpolates texture coordinates given at the vertices.
    #[inline(always)]
    pub fn interpolate_uvs(&self, uvs: &[DVec2; 3]) -> DVec2 {
        let [a, b, c] = self.weights;
        a * uvs[0] + b * uvs[1] + c * uvs[2]
    }
}

/// The surface where a ray hits the triangle of a table's row.
///
/// The point is interpolated from the vertices rather than computed as O + tR: it is off the plane only by the rounding
/// of that mean, 8ε times the largest vertex, even at grazing incidence, and [`offset_bound`] holds as for a plane.
/// For a spawned ray not to hit its own triangle again, the sign of t must also be right (PBRT compares t with its
/// error bound); here that sign is never uncertain.
#[inline(always)]
pub fn triangle_surface(
    triangles: &TriangleTable,
    row: usize,
    origin: DVec3,
    direction: DVec3,
    material: u32,
) -> (Surface, TriangleHit) {
    let triangle = &triangles.triangle[row];
    let triangle_hit = TriangleHit::of(origin, direction, triangle);
    let point = triangle_hit.interpolate(&triangle.corners);
    let bound = offset_bound(point, origin, triangle.size);
    let leaves_by_normal = triangle_hit.along != triangles.turned[row];
    let normal = if leaves_by_normal { -triangles.normal[row] } else { triangles.normal[row] };
    (Surface { position: point.as_vec3(), normal: normal.as_vec3(), bound, material }, triangle_hit)
}

/// Fills the surface of every row that hit a triangle.
pub fn fill_triangle_surfaces(
    triangles: Res<Shared<TriangleTable>>,
    shapes: Res<Shared<ShapeTable>>,
    mut tiles: Query<SurfaceView<TriangleRows>>,
) {
    for SurfaceViewItem { rays, hits, list, mut surfaces, mut uvs, mut sides } in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            let shape = hits.shape[row] as usize;
            let (triangle, material) = (shapes.row[shape] as usize, shapes.material[shape]);
            let (origin, direction) = (rays.origin_of(row), rays.direction_of(row));
            let (surface, triangle_hit) = triangle_surface(&triangles, triangle, origin, direction, material);
            surfaces.set(row, surface);
            if let Some(sides) = &mut sides {
                sides.outside[row] = u32::from(triangle_hit.along == triangles.turned[triangle]);
            }
            if let Some(uvs) = &mut uvs {
                (uvs.u[row], uvs.v[row]) = triangle_hit.interpolate_uvs(&triangles.uvs[triangle]).into();
            }
        }
    }
}

/// The stage that fills surfaces.
pub fn triangle_surface_stage() -> Stage {
    Stage::new("Compute surfaces: triangles", TileSystems::Surface, fill_triangle_surfaces).when(triangle_evidence)
}
