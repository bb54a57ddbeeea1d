use super::exact_sum::{exact_cross, exact_difference};
use super::mesh::PlacedMesh;
use super::ray_hit::RayHit;
use super::space::normal_world_from_object;
use super::triangle_hit::TriangleHit;
use super::triangle_row::TriangleRow;
use super::triangle_surfaces::EXACT_BELOW;
use glam::DVec3;

/// The least cosine between a shading normal and the direction to the viewer.
const GRAZING: f64 = 0.01;

impl PlacedMesh {
    /// The shading normal where a ray hits it, in render space and facing the ray: interpolated from the vertex normals,
    /// as unit vector; none where the mesh has none, or where they do not all point to one side of the triangle.
    pub fn shading_normal(&self, hit: &RayHit) -> Option<DVec3> {
        let normals = self.geometry.normals.as_ref()?;
        let vertices = self.geometry.triangles[hit.primitive as usize];
        let normals = vertices.map(|vertex| DVec3::from(normals[vertex as usize].map(f64::from)));
        let triangle = self.triangle(hit.primitive);
        let sides = normals.map(|normal| normal.dot(unnormalised_normal(&triangle)));
        let is_above = sides.iter().all(|&side| side > 0.0);
        if !(is_above || sides.iter().all(|&side| side < 0.0)) {
            return None;
        }
        let ([origin, direction], _) = self.own_ray([hit.origin, hit.direction]);
        let triangle_hit = TriangleHit::of(origin, direction, &triangle);
        let along = normal_world_from_object(self.object_from_world, triangle_hit.interpolate(&normals));
        let normal = (along / along.abs().max_element()).normalize();
        let normal = if triangle_hit.along == is_above { -normal } else { normal };
        // On a coarse mesh it may face away from the viewer, where every material is black.
        let (towards, cosine) = (-hit.direction, -normal.dot(hit.direction));
        Some(if cosine < GRAZING { (normal + (GRAZING - cosine) * towards).normalize() } else { normal })
    }

    /// The colour where a ray hits it, interpolated from those of the vertices, linear Rec. 709; none where it has none.
    pub fn vertex_colour(&self, hit: &RayHit) -> Option<[f64; 3]> {
        let colours = self.geometry.colours.as_ref()?;
        let vertices = self.geometry.triangles[hit.primitive as usize];
        let colours = vertices.map(|vertex| DVec3::from(colours[vertex as usize].map(f64::from)));
        let ([origin, direction], _) = self.own_ray([hit.origin, hit.direction]);
        let triangle_hit = TriangleHit::of(origin, direction, &self.triangle(hit.primitive));
        Some(triangle_hit.interpolate(&colours).clamp(DVec3::ZERO, DVec3::ONE).to_array())
    }
}

/// (B − A) × (C − A), from exact differences.
#[inline(always)]
pub(super) fn unnormalised_normal(triangle: &TriangleRow) -> DVec3 {
    let [a, b, c] = triangle.corners;
    let (one, other) = (b - a, c - a);
    let cross = one.cross(other);
    let largest = one.abs().max_element() * other.abs().max_element();
    if cross.abs().max_element() > largest * EXACT_BELOW { cross } else { exact_normal([a, b, c]) }
}

#[cold]
#[inline(never)]
fn exact_normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    DVec3::from(exact_cross(&exact_difference(b, a), &exact_difference(c, a)).map(|part| part.rounded()))
}
