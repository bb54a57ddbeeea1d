use super::accessor::{Accessor, Meant};
use super::animation::Animated;
use super::buffers::Buffers;
use super::document::{Document, Table};
use super::nodes::SceneNodes;
use super::object::Object;
use crate::memory::Memory;
use crate::model_error::ModelError;
use crate::remarks::Remarks;
use crate::triangle_mesh::TriangleMesh;
use glam::{DAffine3, DMat3, DMat4, DVec3};
use std::collections::HashMap;

/// The matrices to the world of the nodes of a scene, by their indices.
pub type Worlds = HashMap<usize, DAffine3>;

/// The matrices of all nodes, some of which may be animated.
///
/// Errors: those of [`SceneNodes`].
pub fn worlds_of(document: &Document<'_>, animated: &Animated) -> Result<Worlds, ModelError> {
    // What is said of nodes is said where they are placed.
    let mut unsaid = Remarks::default();
    let (mut nodes, mut worlds) = (SceneNodes::of(document, animated, &mut unsaid)?, Worlds::new());
    while let Some((index, _, world)) = nodes.next(&mut unsaid)? {
        worlds.insert(index, world);
    }
    Ok(worlds)
}

/// The joints of a skin: for each, the matrix from the mesh's bind pose to the world.
///
/// Errors: a joint that is no node, or matrices that cannot be read.
pub fn joints_of<'a>(
    document: &Document<'a>,
    buffers: &'a Buffers<'a>,
    skin: &Object<'a>,
    worlds: &Worlds,
    memory: &mut Memory,
) -> Result<Vec<DAffine3>, ModelError> {
    let joints = skin.list("joints")?;
    memory.take(joints.len() as u64, size_of::<DAffine3>() as u64, || [skin.file.into(), skin.path.clone()])?;
    let inverse = match skin.index("inverseBindMatrices", document.rows(Table::Accessors))? {
        None => Vec::new(),
        Some(index) => Accessor::of(document, buffers, index, Meant::Matrices)?.floats::<16>(None, memory)?,
    };
    let mut matrices = Vec::with_capacity(joints.len());
    for (number, joint) in joints.iter().enumerate() {
        let node = skin.index_in("joints", joint, document.rows(Table::Nodes))?;
        let world = worlds.get(&node).copied().unwrap_or(DAffine3::IDENTITY);
        let bind = inverse.get(number).map_or(DMat4::IDENTITY, |own| DMat4::from_cols_array(&own.map(f64::from)));
        matrices.push(world * DAffine3::from_mat3_translation(DMat3::from_mat4(bind), bind.w_axis.truncate()));
    }
    Ok(matrices)
}

/// The joints and the weights of each vertex, four at a time.
pub type Influences = Vec<([f32; 4], [f32; 4])>;

/// Moves each vertex by the mean of its joints' matrices, weighted by their weights; the mesh is in world space then.
pub fn skinned(mut mesh: TriangleMesh, joints: &[DAffine3], sets: &[Influences]) -> TriangleMesh {
    let mut turned = 0_i64;
    for vertex in 0..mesh.positions.len() {
        let Some(matrix) = mean(joints, sets.iter().filter_map(|set| set.get(vertex))) else { continue };
        let position = DVec3::from(mesh.positions[vertex].map(f64::from));
        mesh.positions[vertex] = matrix.transform_point3(position).as_vec3().to_array();
        if let Some(normal) = mesh.normals.as_mut().and_then(|normals| normals.get_mut(vertex)) {
            // The cofactors: the inverse transposed, times the determinant, so that no matrix is too flat.
            let [x, y, z] = [matrix.matrix3.x_axis, matrix.matrix3.y_axis, matrix.matrix3.z_axis];
            let own = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * DVec3::from(normal.map(f64::from));
            let sign = if matrix.matrix3.determinant() < 0.0 { -1.0 } else { 1.0 };
            *normal = (sign * own).normalize_or_zero().as_vec3().to_array();
        }
        turned += if matrix.matrix3.determinant() < 0.0 { 1 } else { -1 };
    }
    // A mirroring matrix turns the sides of triangles.
    if turned > 0 {
        mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    }
    mesh
}

/// The weighted mean of the matrices of a vertex's joints; none where it has none.
fn mean<'i>(joints: &[DAffine3], influences: impl Iterator<Item = &'i ([f32; 4], [f32; 4])>) -> Option<DAffine3> {
    let (mut sum, mut weights) = ([0.0; 12], 0.0);
    for (joint, weight) in influences.flat_map(|(own, by)| own.iter().zip(by)) {
        if let (Some(matrix), true) = (joints.get(*joint as usize), *weight > 0.0) {
            weights += f64::from(*weight);
            for (sum, part) in sum.iter_mut().zip(matrix.to_cols_array()) {
                *sum += f64::from(*weight) * part;
            }
        }
    }
    // They should add up to 1, and do but for rounding.
    (weights > 0.0).then(|| DAffine3::from_cols_array(&sum.map(|part| part / weights)))
}

#[cfg(test)]
mod tests {
    use crate::Model;
    use crate::written::{data, floats, read};

    /// A triangle whose first corner follows one joint, the second another, and the third both alike; below a node that
    /// the skin must ignore.
    fn skinned(weights: [f32; 12], joints: &str, node: &str) -> Model {
        let mut bytes = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        bytes.extend(floats(&weights));
        bytes.extend([0, 1, 0, 0].repeat(3));
        // The bind pose of the second joint is 1 to the right.
        for shift in [0.0, -1.0] {
            bytes.extend(floats(&[1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, shift, 0.0, 0.0, 1.0]));
        }
        let view = |offset: usize, length: usize| format!("{{'buffer':0,'byteOffset':{offset},'byteLength':{length}}}");
        let views = [view(0, 36), view(36, 48), view(84, 12), view(96, 128)].join(",");
        let accessor = |view: usize, component: usize, count: usize, kind: &str| {
            format!("{{'bufferView':{view},'componentType':{component},'count':{count},'type':'{kind}'}}")
        };
        let accessors = [
            accessor(0, 5126, 3, "VEC3"),
            accessor(1, 5126, 3, "VEC4"),
            accessor(2, 5121, 3, "VEC4"),
            accessor(3, 5126, 2, "MAT4"),
        ]
        .join(",");
        let attributes = "'attributes':{'POSITION':0,'WEIGHTS_0':1,'JOINTS_0':2}";
        read(&format!(
            "'buffers':[{{'byteLength':224,'uri':'{}'}}],'bufferViews':[{views}],'accessors':[{accessors}],\
             'meshes':[{{'primitives':[{{{attributes}}}]}}],'skins':[{{'joints':[1,2],'inverseBindMatrices':3}}],\
             'nodes':[{{'mesh':0,'skin':0{node}}},{joints}]",
            data(&bytes)
        ))
        .expect("read")
    }

    const WEIGHTS: [f32; 12] = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.5, 0.5, 0.0, 0.0];

    #[test]
    fn joints_place_a_mesh_and_its_node_does_not() {
        let joints = "{'translation':[0,0,5]},{'translation':[3,0,0]}";
        for node in ["", ",'scale':[100,100,100]", ",'translation':[7,7,7]"] {
            let model = skinned(WEIGHTS, joints, node);
            assert_eq!(model.meshes[0].positions, [[0.0, 0.0, 5.0], [3.0, 0.0, 0.0], [1.0, 1.0, 2.5]], "{node}");
            assert_eq!(model.instances[0].world_from_object, glam::DAffine3::IDENTITY);
            assert_eq!(model.remarks.unread, []);
        }
        // In the bind pose nothing moves.
        let rest = skinned(WEIGHTS, "{},{'translation':[1,0,0]}", "");
        assert_eq!(rest.meshes[0].positions, [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    }

    #[test]
    fn weights_that_do_not_add_up_to_one_are_scaled_and_a_vertex_without_any_stays() {
        let mut weights = WEIGHTS.map(|weight| 0.5 * weight);
        weights[4..8].fill(0.0);
        let model = skinned(weights, "{'translation':[0,0,5]},{'translation':[3,0,0]}", "");
        assert_eq!(model.meshes[0].positions, [[0.0, 0.0, 5.0], [1.0, 0.0, 0.0], [1.0, 1.0, 2.5]]);
    }

    #[test]
    fn mirroring_joints_turn_the_triangles() {
        let mirrored = "{'scale':[-1,1,1]},{'scale':[-1,1,1],'translation':[-1,0,0]}";
        let mesh = &skinned(WEIGHTS, mirrored, "").meshes[0];
        let [a, b, c] = mesh.corners(0).map(|corner| glam::DVec3::from(corner.map(f64::from)));
        assert!((b - a).cross(c - a).z > 0.0, "{:?}", mesh.corners(0));
    }
}
