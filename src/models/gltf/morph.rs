use super::accessor::{Accessor, Meant};
use super::buffers::Buffers;
use super::document::{Document, Table};
use super::json::Json;
use super::object::Object;
use crate::memory::Memory;
use crate::model_error::ModelError;
use crate::remarks::Remarks;

/// A morph target: accessors of what it adds to positions and normals, and its weight, as bits.
pub type Morph = (u64, Option<usize>, Option<usize>);

/// The weights of a mesh's morph targets where they are not animated: those of its node, or else its own.
///
/// Errors: they are no list of numbers.
pub fn rest_weights(node: Option<&Object<'_>>, mesh: &Object<'_>) -> Result<Vec<f64>, ModelError> {
    let of_node = node.filter(|node| node.get("weights").is_some());
    let holder = of_node.unwrap_or(mesh);
    let number = |json: &Json<'_>| match json {
        Json::Number(number) => Ok(*number),
        other => Err(holder.refused("weights", other, "it must be a list of numbers")),
    };
    holder.list("weights")?.iter().map(number).collect()
}

/// The targets of a primitive whose weights are not 0.
///
/// Errors: an index that is none.
pub fn morphs_of(
    document: &Document<'_>,
    primitive: &Object<'_>,
    weights: &[f64],
    remarks: &mut Remarks,
) -> Result<Vec<Morph>, ModelError> {
    let (rows, mut morphs) = (document.rows(Table::Accessors), Vec::new());
    for (number, (json, weight)) in primitive.list("targets")?.iter().zip(weights).enumerate() {
        if *weight == 0.0 {
            continue;
        }
        let target = primitive.item("targets", number, json)?;
        for (name, _) in target.fields() {
            let is_read = ["POSITION", "NORMAL", "TANGENT"].contains(&name);
            remarks.add_unread(&format!("the attribute {name} of morph targets"), u64::from(!is_read));
        }
        morphs.push((weight.to_bits(), target.index("POSITION", rows)?, target.index("NORMAL", rows)?));
    }
    Ok(morphs)
}

/// Adds targets to a column, from the accessor that `of` chooses of each.
///
/// Errors: an accessor with another number of rows, or one that is not as it should be.
pub fn add_morphs<'a>(
    column: &mut [[f32; 3]],
    morphs: &[Morph],
    of: impl Fn(&Morph) -> Option<usize>,
    (document, buffers): (&Document<'a>, &'a Buffers<'a>),
    (wanted, vertices): (Option<&[u32]>, u64),
    memory: &mut Memory,
) -> Result<(), ModelError> {
    for (morph, index) in morphs.iter().filter_map(|morph| Some((morph, of(morph)?))) {
        let accessor = Accessor::of(document, buffers, index, Meant::Vectors)?;
        accessor.check_count(vertices)?;
        let weight = f64::from_bits(morph.0);
        for (own, more) in column.iter_mut().zip(accessor.floats::<3>(wanted, memory)?) {
            *own = [0, 1, 2].map(|part| (f64::from(own[part]) + weight * f64::from(more[part])) as f32);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::written::{mesh, read};

    /// The square's normals, all along z, as what a target adds to its positions.
    #[test]
    fn targets_are_added_by_their_weights_in_the_rest_pose() {
        let heights = |mesh_weights: &str, node_weights: &str| {
            let primitive = "{'attributes':{'POSITION':0},'indices':3,'targets':[{'POSITION':1},{'POSITION':1}]}";
            let file = mesh(primitive)
                .replace("'name':'own',", &format!("'name':'own',{mesh_weights}"))
                .replace("'nodes':[{", &format!("'nodes':[{{{node_weights}"));
            let model = read(&file).expect("read");
            assert_eq!(model.remarks.unread, []);
            model.meshes[0].positions.iter().map(|position| position[2]).collect::<Vec<_>>()
        };
        assert_eq!(heights("", ""), [0.0; 4]);
        assert_eq!(heights("'weights':[0.25,0.5],", ""), [0.75; 4]);
        assert_eq!(heights("'weights':[0.25,0.5],", "'weights':[2,0],"), [2.0; 4]);
        assert_eq!(heights("", "'weights':[-1],"), [-1.0; 4]);
    }

    #[test]
    fn two_nodes_with_other_weights_have_other_meshes() {
        let primitive = "{'attributes':{'POSITION':0},'indices':3,'targets':[{'POSITION':1}]}";
        let nodes = "'nodes':[{'mesh':0,'weights':[1]},{'mesh':0,'weights':[1]},{'mesh':0}]";
        let model = read(&mesh(primitive).replace("'nodes':[{'mesh':0}]", nodes)).expect("read");
        let used: Vec<usize> = model.instances.iter().map(|instance| instance.mesh).collect();
        assert_eq!((model.meshes.len(), used), (2, vec![0, 0, 1]));
    }
}
