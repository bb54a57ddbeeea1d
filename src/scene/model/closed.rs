use pinhole_models::TriangleMesh;
use std::collections::HashMap;

/// Whether the triangles of a mesh enclose an interior: each edge is passed as often in one direction as in the other, by
/// the places of its ends.
pub fn is_closed(mesh: &TriangleMesh) -> bool {
    // −0 and 0 are one place.
    let place = |corner: [f32; 3]| corner.map(|part| (part + 0.0).to_bits());
    let mut edges: HashMap<[[u32; 3]; 2], i32> = HashMap::new();
    for triangle in 0..mesh.triangles.len() {
        let corners = mesh.corners(triangle).map(place);
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            let [from, to] = [corners[from], corners[to]];
            *edges.entry([from.min(to), from.max(to)]).or_default() += if from < to { 1 } else { -1 };
        }
    }
    edges.values().all(|sum| *sum == 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tetrahedron_is_closed_and_none_of_its_parts_is() {
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-0.0, 0.0, 1.0], [-0.0, 0.0, -0.0]];
        // The last vertex is the first again, as where normals differ.
        let triangles = vec![[0, 2, 1], [4, 1, 3], [0, 3, 2], [1, 2, 3]];
        let whole = TriangleMesh { positions, triangles, ..TriangleMesh::default() };
        assert!(is_closed(&whole));
        for missing in 0..4 {
            let mut part = whole.clone();
            part.triangles.remove(missing);
            assert!(!is_closed(&part), "{missing}");
            let mut turned = whole.clone();
            turned.triangles[missing].swap(0, 1);
            assert!(!is_closed(&turned), "{missing}");
        }
    }
}
