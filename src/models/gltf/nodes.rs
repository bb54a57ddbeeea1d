use super::animation::{Animated, AnimatedNode};
use super::document::{Document, Table};
use super::json::Json;
use super::object::Object;
use crate::model_error::ModelError;
use crate::remarks::Remarks;
use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3, DVec4};

/// The index of no node.
const NONE: u32 = u32::MAX;
/// How far from 1 the length of a rotation's quaternion may be without a remark, and a matrix's last row from that of an
/// affine map.
const UNIT: f64 = 1e-3;

/// The nodes of a file's scene, each before its children.
pub struct SceneNodes<'a> {
    document: &'a Document<'a>,
    animated: &'a Animated,
    roots: std::vec::IntoIter<u32>,
    /// The nodes about the next one: the children still to come of each, and its matrix to the world.
    ///
    /// A list rather than a recursion, for nodes may be nested a hundred thousand deep.
    about: Vec<(std::slice::Iter<'a, Json<'a>>, DAffine3)>,
}

impl<'a> SceneNodes<'a> {
    /// Those of a file, some of which may be animated.
    ///
    /// Errors: a node that is child of two nodes, or of itself in the end.
    pub fn of(document: &'a Document<'a>, animated: &'a Animated, remarks: &mut Remarks) -> Result<Self, ModelError> {
        let parents = parents(document, document.rows(Table::Nodes))?;
        let roots = roots(document, &parents, remarks)?.into_iter();
        Ok(Self { document, animated, roots, about: Vec::new() })
    }

    /// The index of the next node, the node, and its matrix to the world.
    ///
    /// Errors: a matrix that is not as it should be.
    pub fn next(&mut self, remarks: &mut Remarks) -> Result<Option<(usize, Object<'a>, DAffine3)>, ModelError> {
        let count = self.document.rows(Table::Nodes);
        let (index, parent) = loop {
            let Some((children, world)) = self.about.last_mut() else {
                let Some(root) = self.roots.next() else { return Ok(None) };
                break (root as usize, DAffine3::IDENTITY);
            };
            match children.next() {
                Some(child) => break (self.document.root.index_in("nodes", child, count)?, *world),
                None => drop(self.about.pop()),
            }
        };
        let node = self.document.row(Table::Nodes, index)?;
        let world = parent * local_matrix(&node, self.animated.get(&index), remarks)?;
        if !world.is_finite() {
            return Err(ModelError::new(
                node.file,
                node.path,
                "too far away",
                "its matrix to the world must be finite",
            ));
        }
        self.about.push((node.list("children")?.iter(), world));
        Ok(Some((index, node, world)))
    }
}

/// The parent of each node.
fn parents(document: &Document<'_>, count: usize) -> Result<Vec<u32>, ModelError> {
    let mut parents = vec![NONE; count];
    for parent in 0..count {
        let node = document.row(Table::Nodes, parent)?;
        for child in node.list("children")? {
            let child = node.index_in("children", child, count)?;
            if parents[child] != NONE {
                let accepted =
                    format!("node {child} is a child of node {} already, and has one parent", parents[child]);
                return Err(node.refused("children", child, accepted));
            }
            parents[child] = parent as u32;
        }
    }
    // From node to parent and on, one comes to a node without a parent, or goes round in circles; each node is passed
    // once, and knows from which start.
    let mut passed_from = vec![NONE; count];
    for start in 0..count as u32 {
        let mut node = start;
        while node != NONE && passed_from[node as usize] == NONE {
            passed_from[node as usize] = start;
            node = parents[node as usize];
        }
        if node != NONE && passed_from[node as usize] == start {
            let path = format!("nodes[{node}]");
            let accepted = "the nodes of a scene are a tree";
            return Err(ModelError::new(document.root.file, path, "a child of its own descendant", accepted));
        }
    }
    Ok(parents)
}

/// The nodes at the top of the scene: those it lists, or all without a parent.
fn roots(document: &Document<'_>, parents: &[u32], remarks: &mut Remarks) -> Result<Vec<u32>, ModelError> {
    let scenes = document.rows(Table::Scenes);
    let index = document.root.index("scene", scenes)?.or((scenes > 0).then_some(0));
    let Some(index) = index else {
        return Ok((0..parents.len() as u32).filter(|node| parents[*node as usize] == NONE).collect());
    };
    remarks.add_unread("scenes besides the one that is shown", scenes as u64 - 1);
    let scene = document.row(Table::Scenes, index)?;
    let mut is_root = vec![false; parents.len()];
    let mut roots = Vec::new();
    for json in scene.list("nodes")? {
        let root = scene.index_in("nodes", json, parents.len())?;
        if is_root[root] || parents[root] != NONE {
            return Err(scene.refused("nodes", root, "a scene lists each node without a parent once"));
        }
        is_root[root] = true;
        roots.push(root as u32);
    }
    Ok(roots)
}

/// The matrix that takes a node's space to its parent's, with what is animated of it.
fn local_matrix(
    node: &Object<'_>,
    animated: Option<&AnimatedNode>,
    remarks: &mut Remarks,
) -> Result<DAffine3, ModelError> {
    if let Some(columns) = node.numbers::<16>("matrix")? {
        let matrix = DMat4::from_cols_array(&columns);
        // Exporters that multiply matrices in f32 round this row, too.
        if (matrix.row(3) - DVec4::W).abs().max_element() > UNIT {
            let shown = matrix.row(3).to_array().map(|part| Json::Number(part).to_string()).join(", ");
            let accepted = "its last row must be 0, 0, 0, 1";
            return Err(node.refused("matrix", format_args!("one with the last row {shown}"), accepted));
        }
        return Ok(DAffine3::from_mat3_translation(DMat3::from_mat4(matrix), matrix.w_axis.truncate()));
    }
    let of = |own: Option<[f64; 3]>, field| own.map_or_else(|| node.numbers(field), |own| Ok(Some(own)));
    let translation = of(animated.and_then(|own| own.translation), "translation")?.map_or(DVec3::ZERO, DVec3::from);
    let scale = of(animated.and_then(|own| own.scale), "scale")?.map_or(DVec3::ONE, DVec3::from);
    let rotation =
        animated.and_then(|own| own.rotation).map_or_else(|| node.numbers("rotation"), |own| Ok(Some(own)))?;
    let rotation = match rotation {
        None => DMat3::IDENTITY,
        Some(parts) => {
            let quaternion = DVec4::from(parts);
            // Scaled by the largest part, no square is too large or too small.
            let long = quaternion / quaternion.abs().max_element();
            if !long.is_finite() {
                return Err(node.refused("rotation", "(0, 0, 0, 0)", "it must be a unit quaternion"));
            }
            let is_unit = (quaternion.length() - 1.0).abs() <= UNIT;
            remarks.clamped += u64::from(!is_unit);
            DMat3::from_quat(DQuat::from_vec4(long.normalize()))
        }
    };
    Ok(DAffine3::from_mat3_translation(rotation * DMat3::from_diagonal(scale), translation))
}

#[cfg(test)]
mod tests {
    use crate::written::{read, refused, square};
    use crate::{Instance, Model};
    use glam::{DMat4, DVec3};
    use std::f64::consts::FRAC_1_SQRT_2;

    fn with(nodes: &str) -> String {
        format!("{},'meshes':[{{'primitives':[{{'attributes':{{'POSITION':0}},'indices':3}}]}}],{nodes}", square())
    }

    fn named<'m>(model: &'m Model, name: &str) -> &'m Instance {
        model.instances.iter().find(|instance| &*instance.name == name).expect("an instance")
    }

    #[test]
    fn matrices_are_multiplied_from_the_top_down() {
        let turn = format!("[0,0,{FRAC_1_SQRT_2},{FRAC_1_SQRT_2}]");
        let nodes = format!(
            "'nodes':[{{'name':'top','mesh':0,'translation':[1,2,3],'rotation':{turn},'scale':[2,1,1],'children':[1]}},\
             {{'name':'below','mesh':0,'matrix':[1,0,0,0,0,1,0,0,0,0,-1,0,5,0,0,1]}}]"
        );
        let model = read(&with(&nodes)).expect("read");
        let top = named(&model, "top").world_from_object;
        // Scaled along x, which a quarter turn about z takes to y.
        assert!((top.transform_point3(DVec3::X) - DVec3::new(1.0, 4.0, 3.0)).length() < 1e-14);
        let below = named(&model, "below").world_from_object;
        assert!((below.transform_point3(DVec3::Z) - DVec3::new(1.0, 12.0, 2.0)).length() < 1e-14);
        assert!(DMat4::from(below).determinant() < 0.0);
        assert_eq!(model.remarks.clamped, 0);
    }

    #[test]
    fn rotations_are_made_unit_quaternions() {
        let model = read(&with("'nodes':[{'mesh':0,'rotation':[0,0,1e300,1e300]}]")).expect("read");
        let turned = model.instances[0].world_from_object.transform_point3(DVec3::X);
        assert!((turned - DVec3::Y).length() < 1e-15);
        assert_eq!(model.remarks.clamped, 1);
        let none = "nodes[0].rotation is (0, 0, 0, 0), but it must be a unit quaternion";
        assert_eq!(refused("'nodes':[{'rotation':[0,0,0,0]}]"), none);
    }

    #[test]
    fn what_is_no_tree_is_refused() {
        let twice = "nodes[1].children is 2, but node 2 is a child of node 0 already, and has one parent";
        assert_eq!(refused("'nodes':[{'children':[2]},{'children':[2]},{}]"), twice);
        let circle = "nodes[1] is a child of its own descendant, but the nodes of a scene are a tree";
        assert_eq!(refused("'nodes':[{},{'children':[2]},{'children':[3]},{'children':[1,4]},{}]"), circle);
        let itself = "nodes[0] is a child of its own descendant, but the nodes of a scene are a tree";
        assert_eq!(refused("'nodes':[{'children':[0]}]"), itself);
        let rho = "nodes[2] is a child of its own descendant, but the nodes of a scene are a tree";
        assert_eq!(refused("'nodes':[{},{},{'children':[3,0]},{'children':[2]}]"), rho);
        let root = "scenes[0].nodes is 1, but a scene lists each node without a parent once";
        assert_eq!(refused("'nodes':[{'children':[1]},{}],'scenes':[{'nodes':[0,1]}]"), root);
        let beyond = "nodes[0].children is 1, but it must be a whole number from 0 to 0, for there are 1";
        assert_eq!(refused("'nodes':[{'children':[1]}]"), beyond);
    }

    #[test]
    fn matrices_that_are_none_are_refused() {
        let row = "nodes[0].matrix is one with the last row 0, 0, 0, 2, but its last row must be 0, 0, 0, 1";
        assert_eq!(refused("'nodes':[{'matrix':[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2]}]"), row);
        // Rounded in f32, it is a matrix like any other.
        for rounded in ["0.9999999,0,0,0.00001,0,1,0,0,0,0,1,0,0,0,0,0.9999999", "1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1"] {
            assert!(read(&with(&format!("'nodes':[{{'mesh':0,'matrix':[{rounded}]}}]"))).is_ok(), "{rounded}");
        }
        let far = "nodes[1] is too far away, but its matrix to the world must be finite";
        assert_eq!(refused("'nodes':[{'scale':[1e300,1,1],'children':[1]},{'scale':[1e300,1,1]}]"), far);
        let model = read(&with("'nodes':[{'mesh':0,'scale':[1,0,1]}]")).expect("read");
        assert_eq!(model.remarks.sentences()[0], "Not read: instances that a scale of 0 makes planar (1).");
    }

    #[test]
    fn the_scene_says_which_nodes_are_seen() {
        let count = |fields: &str| read(&with(fields)).map(|model| model.instances.len());
        let nodes = "'nodes':[{'mesh':0,'children':[1]},{'mesh':0},{'mesh':0}]";
        assert_eq!(count(nodes), Ok(3));
        assert_eq!(count(&format!("{nodes},'scenes':[{{'nodes':[0]}},{{'nodes':[2]}}]")), Ok(2));
        assert_eq!(count(&format!("{nodes},'scenes':[{{'nodes':[0]}},{{'nodes':[2]}}],'scene':1")), Ok(1));
        assert_eq!(count(&format!("{nodes},'scenes':[{{}}]")), Ok(0));
        assert_eq!(count("'nodes':[]"), Ok(1));
        let scene = "scene is 1, but it must be a whole number from 0 to 0, for there are 1";
        assert_eq!(refused(&format!("{nodes},'scenes':[{{}}],'scene':1")), scene);
    }

    #[test]
    fn nodes_may_be_nested_a_hundred_thousand_deep() {
        let chain: Vec<String> =
            (1..100_000).map(|child| format!("{{'children':[{child}],'translation':[0,0,1]}}")).collect();
        let model = read(&with(&format!("'nodes':[{},{{'mesh':0}}]", chain.join(",")))).expect("read");
        assert_eq!(model.instances[0].world_from_object.translation, DVec3::new(0.0, 0.0, 99_999.0));
    }
}
