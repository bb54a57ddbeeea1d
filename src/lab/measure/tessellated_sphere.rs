//! A sphere of triangles, as few as keep it within a stated distance of the sphere.

use glam::DVec3;
use pinhole::models::TriangleMesh;
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

/// The unit sphere as the faces of an octahedron, each divided into k² triangles whose vertices are on the sphere; no
/// point of a triangle is farther from the sphere than this.
///
/// A triangle is farthest from the sphere where the perpendicular from the centre hits its plane: by the sagitta of the
/// circle through its vertices.
#[must_use]
pub fn tessellated_sphere(error: f64) -> TriangleMesh {
    // Twice as many divisions make a quarter of the sagitta, so the search begins below what this rule asks for.
    let min = (0.5 * (sagitta(8) * 64.0 / error).sqrt()).max(1.0) as u32;
    let divisions = (min..).find(|&divisions| sagitta(divisions) <= error).unwrap_or(u32::MAX);
    let (mut mesh, mut vertices) = (TriangleMesh::default(), BTreeMap::new());
    for octant in 0..8_i32 {
        let sign = [0, 1, 2].map(|axis| 1 - 2 * (octant >> axis & 1));
        for triangle in triangles_of_face(divisions) {
            let corner = |at: [u32; 3]| {
                let signed = [0, 1, 2].map(|axis| at[axis] as i32 * sign[axis]);
                *vertices.entry(signed).or_insert_with(|| {
                    let place = DVec3::from(sign.map(f64::from)) * vertex(at, divisions);
                    mesh.positions.push(place.as_vec3().to_array());
                    mesh.positions.len() as u32 - 1
                })
            };
            mesh.triangles.push(triangle.map(corner));
        }
    }
    mesh
}

/// The greatest distance between a sphere and the triangles of so many divisions, in radii.
fn sagitta(divisions: u32) -> f64 {
    let distances = triangles_of_face(divisions).map(|triangle| {
        let [a, b, c] = triangle.map(|at| vertex(at, divisions));
        (b - a).cross(c - a).normalize().dot(a).abs()
    });
    1.0 - distances.fold(1.0, f64::min)
}

/// The triangles of one face, by the coordinates of their corners, which add up to the number of divisions.
fn triangles_of_face(divisions: u32) -> impl Iterator<Item = [[u32; 3]; 3]> {
    let at = move |x: u32, y: u32| [x, y, divisions - x - y];
    let cells = (0..divisions).flat_map(move |x| (0..divisions - x).map(move |y| (x, y)));
    cells.flat_map(move |(x, y)| {
        let upright = [at(x, y), at(x + 1, y), at(x, y + 1)];
        let inverted = (x + y + 2 <= divisions).then(|| [at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)]);
        std::iter::once(upright).chain(inverted)
    })
}

/// A vertex of the first octant; along the edges of the octahedron the angles between neighbours are equal.
fn vertex(at: [u32; 3], divisions: u32) -> DVec3 {
    DVec3::from(at.map(|part| libm::sin(FRAC_PI_2 * f64::from(part) / f64::from(divisions)))).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_point_of_a_triangle_is_farther_from_the_sphere_than_stated() {
        for error in [0.3, 0.01, 1e-4] {
            let mesh = tessellated_sphere(error);
            let mut worst = 0.0_f64;
            for triangle in 0..mesh.triangles.len() {
                let [a, b, c] = mesh.corners(triangle).map(|corner| DVec3::from(corner.map(f64::from)));
                // A grid of points of the triangle, its edges among them.
                for (u, v) in (0..=8).flat_map(|u| (0..=8 - u).map(move |v| (f64::from(u) / 8.0, f64::from(v) / 8.0))) {
                    worst = worst.max((1.0 - (a + u * (b - a) + v * (c - a)).length()).abs());
                }
            }
            eprintln!("{} triangles: {worst:.2e} for {error:e}", mesh.triangles.len());
            assert!(worst < error * (1.0 + 1e-2) && worst > 0.2 * error, "{worst} for {error}");
            // Closed: each edge is in two triangles, once in either direction or twice in one.
            assert_eq!(mesh.positions.len(), mesh.triangles.len() / 2 + 2);
        }
    }
}
