use super::accessor::{Accessor, Meant};
use super::buffers::Buffers;
use super::document::{Document, INSTANCING, Table};
use super::object::Object;
use crate::memory::Memory;
use crate::model_error::ModelError;
use glam::{DAffine3, DMat3, DQuat, DVec3, DVec4};

/// The matrices to the world of a node's mesh: its own, or one for each instance that the node lists.
///
/// Errors: attributes that cannot be read, or of different lengths.
pub fn places_of<'a>(
    document: &Document<'a>,
    buffers: &'a Buffers<'a>,
    node: &Object<'a>,
    world: DAffine3,
    memory: &mut Memory,
) -> Result<Vec<DAffine3>, ModelError> {
    let Some(extension) = node.extension(INSTANCING)? else { return Ok(vec![world]) };
    let Some(attributes) = extension.object("attributes")? else { return Ok(vec![world]) };
    let accessor = |name: &str, meant| {
        let index = attributes.index(name, document.rows(Table::Accessors))?;
        index.map(|index| Accessor::of(document, buffers, index, meant)).transpose()
    };
    let translations = accessor("TRANSLATION", Meant::Vectors)?;
    let rotations = accessor("ROTATION", Meant::Fours)?;
    let scales = accessor("SCALE", Meant::Vectors)?;
    let all = || [&translations, &rotations, &scales].into_iter().flatten();
    let Some(count) = all().map(|own| own.count).next() else { return Ok(vec![world]) };
    if let Some(other) = all().find(|own| own.count != count) {
        let accepted = format!("every attribute of the instances must have as many rows, and the first has {count}");
        return Err(attributes.refused("count", other.count, accepted));
    }
    memory.take(count, size_of::<DAffine3>() as u64, || [node.file.into(), attributes.path.clone()])?;
    let mut vectors = |own: Option<Accessor<'_>>, other: f32| match own {
        Some(own) => own.floats::<3>(None, memory),
        None => Ok(vec![[other; 3]; count as usize]),
    };
    let (translations, scales) = (vectors(translations, 0.0)?, vectors(scales, 1.0)?);
    let rotations = match rotations {
        Some(own) => own.floats::<4>(None, memory)?,
        None => vec![[0.0, 0.0, 0.0, 1.0]; count as usize],
    };
    let place = |((translation, rotation), scale): (([f32; 3], [f32; 4]), [f32; 3])| {
        let unit = DVec4::from(rotation.map(f64::from)).try_normalize().unwrap_or(DVec4::W);
        let turned = DMat3::from_quat(DQuat::from_vec4(unit));
        let scaled = turned * DMat3::from_diagonal(DVec3::from(scale.map(f64::from)));
        world * DAffine3::from_mat3_translation(scaled, DVec3::from(translation.map(f64::from)))
    };
    let places = translations.into_iter().zip(rotations).zip(scales).map(place);
    Ok(places.filter(|place| place.is_finite()).collect())
}

#[cfg(test)]
mod tests {
    use crate::written::{mesh, read, refused};
    use glam::DVec3;

    fn with(attributes: &str) -> String {
        let own = format!("'extensions':{{'EXT_mesh_gpu_instancing':{{'attributes':{{{attributes}}}}}}}");
        let node = format!("'nodes':[{{'mesh':0,'translation':[0,0,3],{own}}}]");
        mesh("{'attributes':{'POSITION':0},'indices':3}").replace("'nodes':[{'mesh':0}]", &node)
    }

    /// The square's corners as places of four squares, and its normals as their scales.
    #[test]
    fn a_node_may_place_its_mesh_many_times() {
        let model = read(&with("'TRANSLATION':0")).expect("read");
        let places: Vec<DVec3> = model.instances.iter().map(|own| own.world_from_object.translation).collect();
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 3.0));
        assert_eq!((places, model.meshes.len()), (corners.to_vec(), 1));
        // A scale of 0 along an axis leaves nothing.
        let flat = read(&with("'TRANSLATION':0,'SCALE':1")).expect("read");
        assert_eq!(flat.remarks.sentences()[0], "Not read: instances that a scale of 0 makes planar (4).");
        assert!(read(&with("")).is_ok_and(|model| model.instances.len() == 1));
        let non_uniform = "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes.count is 3, but every attribute of the \
                      instances must have as many rows, and the first has 4";
        // The second accessor is that of the scales.
        let (head, tail) =
            with("'TRANSLATION':0,'SCALE':1").split_once("'count':4").map_or_else(Default::default, |at| {
                (format!("{}'count':4", at.0), at.1.replacen("'count':4", "'count':3", 1))
            });
        assert_eq!(refused(&format!("{head}{tail}")), non_uniform);
    }
}
