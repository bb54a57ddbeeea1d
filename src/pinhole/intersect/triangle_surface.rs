use super::Hits;
use super::classify::TriangleRows;
use super::sphere::UNIT_ROUNDOFF;
use super::surface::{Surface, SurfaceSides, SurfaceUvs, Surfaces, offset_bound};
use super::triangle::{Edges, Shear, edges, longest_axis, triangle_evidence};
use super::triangle_exact::exact_weights;
use crate::extract::{ShapeTable, TriangleRow, TriangleTable};
use crate::plan::{Shared, Stage, TileSystems};
use crate::rays::WorldRays;
use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};

/// Where on a triangle a ray meets it, and from which side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// The corners' shares of the point: from 0 to 1, together 1 to within 2⁻⁵¹.
    pub weights: [f64; 3],
    /// Whether the ray goes the way that (B − A) × (C − A) points.
    pub along: bool,
}

impl Meeting {
    /// Where a ray that meets a triangle does so.
    #[inline(always)]
    pub fn of(origin: DVec3, direction: DVec3, facet: &TriangleRow) -> Self {
        match longest_axis(direction) {
            0 => Self::by::<0>(origin, direction, facet),
            1 => Self::by::<1>(origin, direction, facet),
            _ => Self::by::<2>(origin, direction, facet),
        }
    }

    /// The shares are the areas over their sum; what rounding has pushed below 0 is 0.
    /// Where the sum is so small that a share could be off by more than 2⁻²⁶, exact arithmetic finds them.
    #[inline(always)]
    fn by<const Z: usize>(origin: DVec3, direction: DVec3, facet: &TriangleRow) -> Self {
        let (shear, size) = (Shear::along::<Z>(direction), origin.abs().element_sum());
        let Edges { areas, error, .. } = edges::<Z>(origin, shear, facet, size);
        let whole: f64 = areas.iter().sum();
        let (shares, along) = if 4.0 * error < 0.25 * UNIT_ROUNDOFF * whole.abs() {
            (areas.map(|area| area / whole), whole * shear.z)
        } else {
            exact_weights(origin, direction, facet)
        };
        let shares = shares.map(|share| share.max(0.0));
        let sum: f64 = shares.iter().sum();
        Self { weights: shares.map(|share| share / sum), along: along > 0.0 }
    }

    /// What the corners' vectors are there.
    #[inline(always)]
    pub fn mix(&self, corners: &[DVec3; 3]) -> DVec3 {
        let [a, b, c] = self.weights;
        a * corners[0] + b * corners[1] + c * corners[2]
    }

    /// What the corners' texture coordinates are there.
    #[inline(always)]
    pub fn mix_uvs(&self, corners: &[DVec2; 3]) -> DVec2 {
        let [a, b, c] = self.weights;
        a * corners[0] + b * corners[1] + c * corners[2]
    }
}

/// The surface where a ray meets the triangle of a row.
///
/// The point is the mean of the corners by their shares, not O + tR: so it lies off the plane by the rounding of that mean
/// alone, 8ε times the largest corner, however flat the ray comes in, and [`offset_bound`] holds as it does for a plane.
/// That a new ray must not meet its own triangle also asks for a t whose sign is right (`pbrt` compares t with its error
/// bound); here the sign is never in doubt.
#[inline(always)]
pub fn triangle_surface(
    triangles: &TriangleTable,
    row: usize,
    origin: DVec3,
    direction: DVec3,
    material: u32,
) -> (Surface, Meeting) {
    let facet = &triangles.facet[row];
    let meeting = Meeting::of(origin, direction, facet);
    let point = meeting.mix(&facet.corners);
    let bound = offset_bound(point, origin, facet.size);
    let leaves_by_normal = meeting.along != triangles.turned[row];
    let normal = if leaves_by_normal { -triangles.normal[row] } else { triangles.normal[row] };
    (Surface { position: point.as_vec3(), normal: normal.as_vec3(), bound, material }, meeting)
}

/// Fills the surface of every row that hit a triangle.
pub fn fill_triangle_surfaces(
    triangles: Res<Shared<TriangleTable>>,
    shapes: Res<Shared<ShapeTable>>,
    mut tiles: Query<(
        &WorldRays,
        &Hits,
        &TriangleRows,
        &mut Surfaces,
        Option<&mut SurfaceUvs>,
        Option<&mut SurfaceSides>,
    )>,
) {
    for (rays, hits, list, mut surfaces, mut uvs, mut sides) in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            let shape = hits.shape[row] as usize;
            let (triangle, material) = (shapes.row[shape] as usize, shapes.material[shape]);
            let (origin, direction) = (rays.origin_of(row), rays.direction_of(row));
            let (surface, meeting) = triangle_surface(&triangles, triangle, origin, direction, material);
            surfaces.set(row, surface);
            if let Some(sides) = &mut sides {
                sides.outside[row] = u32::from(meeting.along == triangles.turned[triangle]);
            }
            if let Some(uvs) = &mut uvs {
                (uvs.u[row], uvs.v[row]) = meeting.mix_uvs(&triangles.uvs[triangle]).into();
            }
        }
    }
}

/// The stage that fills surfaces.
pub fn triangle_surface_stage() -> Stage {
    Stage::new("Compute surfaces: triangles", TileSystems::Surface, fill_triangle_surfaces).when(triangle_evidence)
}
