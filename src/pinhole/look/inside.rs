use crate::Result;
use crate::extract::{
    GlassBodyTable, GlassTable, ShapeTable, TriangleTable, glass_evidence, list_around, listed_kinds, shape_name,
};
use crate::plan::Census;
use crate::shapes::emitter::triangle_solid_angle;
use glam::DVec3;
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// A solid angle, in steradians, from which triangles seen from the camera count as closed around it.
const ALL_ROUND: f64 = 4.0 * PI * (1.0 - 1e-6);

/// A warning that the camera is inside a shape, and inside which: one with an inside of its own, or a closed mesh.
pub fn shape_around_camera(scene: &Census<'_>, shapes: &ShapeTable) -> Result<Option<String>> {
    // The camera is the origin of render space.
    let mut around = None;
    for listed in listed_kinds(scene) {
        around = around.or((listed.around)(scene, DVec3::ZERO)?);
    }
    let mesh = triangles_around(&*scene.table::<TriangleTable>()?, shapes);
    let Some(shape) = around.or(mesh) else { return Ok(None) };
    Ok(Some(format!("the camera is inside the {} and sees it from within", shape_name(scene, shape as usize))))
}

/// The index of refraction of the glass that the camera is in; none where it is in none.
pub fn ior_around_camera(scene: &Census<'_>) -> Result<Option<f64>> {
    if !glass_evidence(scene).needed {
        return Ok(None);
    }
    let (bodies, glass) = (scene.table::<GlassBodyTable>()?, scene.table::<GlassTable>()?);
    let mut around = Vec::new();
    list_around(&bodies.row, &glass, (DVec3::ZERO, 0.0), &mut around);
    Ok(around.first().map(|&row| glass.ior[row as usize]))
}

/// The first triangle of a mesh of one material that is closed around the camera: signed solid angles, negative where a
/// triangle shows its front, add up to ±4π inside a closed mesh and to zero outside it.
fn triangles_around(triangles: &TriangleTable, shapes: &ShapeTable) -> Option<u32> {
    let mut filled: BTreeMap<u32, (f64, u32)> = BTreeMap::new();
    for (row, &shape) in triangles.shape.iter().enumerate() {
        let corners = &triangles.row[row].corners;
        let angle = triangle_solid_angle(corners).copysign(triangles.surface_data[row].normal.dot(corners[0]));
        let of = filled.entry(shapes.material[shape as usize]).or_insert((0.0, shape));
        of.0 += if angle.is_finite() { angle } else { 0.0 };
    }
    filled.into_values().find(|(angle, _)| angle.abs() >= ALL_ROUND).map(|(_, shape)| shape)
}
