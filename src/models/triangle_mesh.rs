use crate::remarks::Remarks;
use glam::DVec3;

// ANCHOR: triangle_mesh
/// A mesh of triangles, as plain columns: one row per vertex, and one per triangle.
///
/// Every position is finite, every triangle has an area, and every index is that of a vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    /// The vertices' positions, in the mesh's object space.
    pub positions: Vec<[f32; 3]>,
    /// The triangles' corners, as indices of vertices: anticlockwise as seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The vertices' normals, each a unit vector, or zero where the file has none.
    pub normals: Option<Vec<[f32; 3]>>,
    /// The vertices' texture coordinates: u to the right and v down, (0, 0) at the image's upper left corner.
    pub uvs: Option<Vec<[f32; 2]>>,
    /// The vertices' colours, linear Rec. 709, each part from 0 to 1.
    pub colours: Option<Vec<[f32; 3]>>,
}
// ANCHOR_END: triangle_mesh

impl TriangleMesh {
    /// The positions of a triangle's vertices.
    #[inline(always)]
    pub fn corners(&self, triangle: usize) -> [[f32; 3]; 3] {
        let ([a, b, c], at) = (self.triangles[triangle], |vertex: u32| self.positions[vertex as usize]);
        [at(a), at(b), at(c)]
    }

    /// The bytes of a triangle.
    pub const BYTES_A_TRIANGLE: u64 = 12;

    /// Drops the triangles that no ray can hit and the vertices that no triangle uses, and makes every normal a unit
    /// vector or zero.
    ///
    /// The indices must be those of vertices.
    pub(super) fn cleaned(mut self, remarks: &mut Remarks) -> Self {
        let positions = &self.positions;
        self.triangles.retain(|triangle| {
            let [a, b, c] = triangle.map(|index| DVec3::from(positions[index as usize].map(f64::from)));
            // Differences of f32 numbers of similar size are exact in f64; the products of collinear ones then round to
            // equal numbers. One coordinate that is not finite makes the product so, too.
            let cross = (b - a).cross(c - a);
            if cross.is_finite() {
                remarks.degenerate += u64::from(cross == DVec3::ZERO);
                cross != DVec3::ZERO
            } else {
                remarks.not_finite += 1;
                false
            }
        });
        for normal in self.normals.iter_mut().flatten() {
            let long = DVec3::from(normal.map(f64::from));
            // A unit vector that was rounded to f32 stays as it is.
            if (long.length_squared() - 1.0).abs() <= f64::from(f32::EPSILON) {
                continue;
            }
            let unit = long.try_normalize().map_or([0.0; 3], |unit| unit.as_vec3().to_array());
            remarks.zero_normals += u64::from(unit == [0.0; 3]);
            *normal = unit;
        }
        for uv in self.uvs.iter_mut().flatten() {
            if !uv.iter().all(|part| part.is_finite()) {
                remarks.uvs_not_finite += 1;
                *uv = [0.0; 2];
            }
        }
        self.with_used_vertices()
    }

    /// The same triangles, without the vertices that none of them uses.
    fn with_used_vertices(mut self) -> Self {
        const UNUSED: u32 = u32::MAX;
        let mut row = vec![UNUSED; self.positions.len()];
        self.triangles.iter().flatten().for_each(|&index| row[index as usize] = 0);
        if !row.contains(&UNUSED) {
            return self;
        }
        let used: Vec<bool> = row.iter().map(|&row| row != UNUSED).collect();
        for (number, row) in row.iter_mut().filter(|row| **row != UNUSED).enumerate() {
            // Fewer than there are vertices, which have indices of 32 bits.
            *row = number as u32;
        }
        self.triangles.iter_mut().flatten().for_each(|index| *index = row[*index as usize]);
        let triples = [Some(&mut self.positions), self.normals.as_mut(), self.colours.as_mut()];
        triples.into_iter().flatten().for_each(|column| retain_used(column, &used));
        self.uvs.iter_mut().for_each(|uvs| retain_used(uvs, &used));
        self
    }

    /// Its memory, in bytes.
    pub fn bytes(&self) -> usize {
        let normals = self.normals.as_ref().map_or(0, |normals| size_of_val(&normals[..]));
        let uvs = self.uvs.as_ref().map_or(0, |uvs| size_of_val(&uvs[..]));
        let colours = self.colours.as_ref().map_or(0, |colours| size_of_val(&colours[..]));
        size_of_val(&self.positions[..]) + size_of_val(&self.triangles[..]) + normals + uvs + colours
    }
}

fn retain_used<T>(column: &mut Vec<T>, used: &[bool]) {
    let mut used = used.iter();
    column.retain(|_| used.next().is_some_and(|used| *used));
    column.shrink_to_fit();
}

/// Replaces each index by its place in a sorted list of those that are used.
pub(super) fn renumber(triangles: &mut [[u32; 3]], used: &[u32]) {
    for index in triangles.iter_mut().flatten() {
        // Every index is in the list; and a list of u32 indices without repetitions is not longer than 2³².
        *index = used.binary_search(index).unwrap_or(0) as u32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> TriangleMesh {
        TriangleMesh {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..TriangleMesh::default()
        }
    }

    #[test]
    fn triangles_without_an_area_are_dropped() {
        let mut mesh = square();
        mesh.positions.extend([[0.1, 0.1, 0.1], [0.2, 0.2, 0.2], [0.4, 0.4, 0.4]]);
        mesh.triangles.extend([[0, 0, 1], [0, 1, 1], [1, 2, 1], [4, 5, 6], [0, 5, 6]]);
        let mut remarks = Remarks::default();
        let cleaned = mesh.cleaned(&mut remarks);
        assert_eq!((cleaned.triangles.len(), remarks.degenerate, remarks.not_finite), (2, 5, 0));
        assert_eq!(cleaned.positions.len(), 4);
    }

    #[test]
    fn vertices_that_no_triangle_uses_are_dropped_from_every_column() {
        let mut mesh = square();
        mesh.positions.splice(1..1, [[9.0; 3], [f32::NAN; 3]]);
        mesh.triangles = vec![[0, 3, 4], [0, 4, 5]];
        mesh.uvs = Some((0..6).map(|row| [row as f32; 2]).collect());
        mesh.colours = Some(vec![[0.5, 1.0, 0.0]; 6]);
        let cleaned = mesh.cleaned(&mut Remarks::default());
        assert_eq!((cleaned.positions, cleaned.triangles), (square().positions, square().triangles));
        assert_eq!(cleaned.uvs, Some(vec![[0.0; 2], [3.0; 2], [4.0; 2], [5.0; 2]]));
        assert_eq!(cleaned.colours, Some(vec![[0.5, 1.0, 0.0]; 4]));
    }

    #[test]
    fn thin_and_tiny_triangles_are_kept() {
        for size in [f32::MIN_POSITIVE, 1e-30, 1.0, 1e30, 3e38] {
            let positions = vec![[0.0; 3], [size, 0.0, 0.0], [0.5 * size, size * f32::EPSILON, 0.0]];
            let mesh = TriangleMesh { positions, triangles: vec![[0, 1, 2]], ..TriangleMesh::default() };
            let mut remarks = Remarks::default();
            assert_eq!(mesh.clone().cleaned(&mut remarks), mesh, "{size}");
            assert_eq!(remarks, Remarks::default());
        }
    }

    #[test]
    fn one_coordinate_that_is_not_finite_drops_its_triangles_and_its_vertex() {
        for odd in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            for (vertex, part) in (0..4).flat_map(|vertex| (0..3).map(move |part| (vertex, part))) {
                let mut mesh = square();
                mesh.positions[vertex][part] = odd;
                mesh.uvs = Some(vec![[0.0, 0.0], [0.1, 0.0], [0.2, 0.0], [0.3, 0.0]]);
                mesh.normals = Some(vec![[0.0, 0.0, 2.0]; 4]);
                let dropped = mesh.triangles.iter().filter(|corners| corners.contains(&(vertex as u32))).count();
                let mut remarks = Remarks::default();
                let cleaned = mesh.cleaned(&mut remarks);
                assert_eq!((remarks.not_finite, remarks.degenerate), (dropped as u64, 0));
                assert_eq!(cleaned.triangles.len(), 2 - dropped);
                assert_eq!(cleaned.positions.len(), if dropped == 1 { 3 } else { 0 });
                let uvs = cleaned.uvs.expect("uvs");
                for (position, uv) in cleaned.positions.iter().zip(&uvs) {
                    let own = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
                    let number = own.iter().position(|own| own[..] == position[..2]).expect("a corner");
                    assert_eq!(uv[0], number as f32 * 0.1);
                }
                assert!(cleaned.normals.expect("normals").iter().all(|normal| *normal == [0.0, 0.0, 1.0]));
            }
        }
    }

    #[test]
    fn normals_are_unit_vectors_or_zero_and_texture_coordinates_finite() {
        let mut mesh = square();
        mesh.normals = Some(vec![[3.0, 0.0, 4.0], [0.0; 3], [f32::NAN, 0.0, 1.0], [1e-38, 0.0, 0.0]]);
        mesh.uvs = Some(vec![[0.5, 7.0], [f32::NAN, 0.5], [0.0, f32::INFINITY], [1.0, 0.0]]);
        let mut remarks = Remarks::default();
        let cleaned = mesh.cleaned(&mut remarks);
        assert_eq!(cleaned.normals, Some(vec![[0.6, 0.0, 0.8], [0.0; 3], [0.0; 3], [1.0, 0.0, 0.0]]));
        assert_eq!(cleaned.uvs, Some(vec![[0.5, 7.0], [0.0; 2], [0.0; 2], [1.0, 0.0]]));
        assert_eq!((remarks.zero_normals, remarks.uvs_not_finite), (2, 2));
    }
}
