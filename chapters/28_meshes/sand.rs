//! Sand with ripples: a height for each place of a grid.

use glam::{DVec2, DVec3};
use pinhole::models::TriangleMesh;
use pinhole::scene::MeshGeometry;

/// The corners of the sand: x and z.
const FROM: DVec2 = DVec2::new(-7.0, -9.0);
const TO: DVec2 = DVec2::new(7.0, 4.5);

// ANCHOR: sand
/// A grid of `across` × `along` cells, two triangles each.
pub fn sand(across: u32, along: u32) -> MeshGeometry {
    let mut mesh = TriangleMesh::default();
    let mut normals = Vec::new();
    for (row, column) in (0..=along).flat_map(|row| (0..=across).map(move |column| (row, column))) {
        let part = DVec2::new(f64::from(column) / f64::from(across), f64::from(row) / f64::from(along));
        let DVec2 { x, y: z } = FROM + part * (TO - FROM);
        mesh.positions.push(DVec3::new(x, height(x, z), z).as_vec3().to_array());
        let step = 1e-4;
        let rise_x = (height(x + step, z) - height(x - step, z)) / (2.0 * step);
        let rise_z = (height(x, z + step) - height(x, z - step)) / (2.0 * step);
        normals.push(DVec3::new(-rise_x, 1.0, -rise_z).normalize().as_vec3().to_array());
    }
    for (row, column) in (0..along).flat_map(|row| (0..across).map(move |column| (row, column))) {
        let a = row * (across + 1) + column;
        let [b, c, d] = [a + 1, a + across + 1, a + across + 2];
        mesh.triangles.extend([[a, c, b], [b, c, d]]);
    }
    MeshGeometry::new(TriangleMesh { normals: Some(normals), ..mesh })
}
// ANCHOR_END: sand

/// Ripples that the wind has pushed out of line, on low dunes.
fn height(x: f64, z: f64) -> f64 {
    let sin = libm::sin;
    let phase = 7.0 * z + 1.1 * sin(1.3 * x + 0.4 * z) + 0.6 * sin(2.9 * x - 1.7);
    let ripples = 0.04 * sin(phase) + 0.02 * sin(0.5 * phase + 1.9 * x);
    ripples + 0.1 * sin(0.55 * x + 0.8) * sin(0.45 * z - 0.3)
}
