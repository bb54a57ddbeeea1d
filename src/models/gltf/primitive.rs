use super::accessor::{Accessor, Meant};
use super::buffers::Buffers;
use super::document::{Document, Table};
use super::morph::{Morph, add_morphs, morphs_of};
use super::object::Object;
use super::skin::{Influences, skinned};
use crate::memory::Memory;
use crate::model_error::ModelError;
use crate::remarks::Remarks;
use crate::triangle_mesh::TriangleMesh;
use crate::triangle_mesh::renumber;
use glam::DAffine3;

/// Which accessors a primitive is made of: primitives alike in that are one mesh.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct PrimitiveParts {
    mode: u64,
    positions: usize,
    indices: Option<usize>,
    normals: Option<usize>,
    uvs: Option<usize>,
    colours: Option<usize>,
    morphs: Vec<Morph>,
    /// The skin, and the accessors of joints and weights, a pair for every four joints of a vertex.
    skin: Option<(usize, Vec<[usize; 2]>)>,
}

/// How a mesh is used where its node places it: the set of its material's texture coordinates, the weights of its morph
/// targets, and its skin.
#[derive(Clone, Copy)]
pub struct Pose<'p> {
    /// The set.
    pub uv_set: u64,
    /// The weights.
    pub weights: &'p [f64],
    /// The index of the skin.
    pub skin: Option<usize>,
}

impl PrimitiveParts {
    /// Those of a primitive; nothing if it has no triangles.
    ///
    /// Errors: an index that is none, or geometry that is there only in compressed form.
    pub fn of(
        document: &Document<'_>,
        primitive: &Object<'_>,
        pose: Pose<'_>,
        remarks: &mut Remarks,
    ) -> Result<Option<Self>, ModelError> {
        let mode = primitive.whole("mode")?.unwrap_or(4);
        let left_out = match mode {
            0 => "points",
            1..=3 => "lines",
            4..=6 => "",
            _ => return Err(primitive.refused("mode", mode, "it must be from 0 to 6")),
        };
        if !left_out.is_empty() {
            remarks.add_unread(left_out, 1);
            return Ok(None);
        }
        let attributes = primitive.needed("attributes", primitive.object("attributes")?)?;
        let rows = document.rows(Table::Accessors);
        let skin = match pose.skin {
            None => None,
            Some(skin) => {
                let influences = influences(&attributes, rows)?;
                (!influences.is_empty()).then_some((skin, influences))
            }
        };
        let uv_name = format!("TEXCOORD_{}", pose.uv_set);
        for (name, _) in attributes.fields() {
            let of_skin = pose.skin.is_some() && (name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_"));
            if !(["POSITION", "NORMAL", "COLOR_0", &uv_name].contains(&name) || of_skin) {
                remarks.add_unread(&format!("the attribute {name}"), 1);
            }
        }
        let Some(positions) = attributes.index("POSITION", rows)? else {
            remarks.add_unread("primitives without positions", 1);
            return Ok(None);
        };
        let compressed = primitive.extension("KHR_draco_mesh_compression")?;
        if let (Some(compressed), None) = (compressed, document.row(Table::Accessors, positions)?.get("bufferView")) {
            let place = compressed.path;
            let accepted = "compressed geometry is not read; export the model without it";
            return Err(ModelError::new(primitive.file, place, "there", accepted));
        }
        Ok(Some(Self {
            mode,
            positions,
            indices: primitive.index("indices", rows)?,
            normals: attributes.index("NORMAL", rows)?,
            colours: attributes.index("COLOR_0", rows)?,
            uvs: attributes.index(&uv_name, rows)?,
            morphs: morphs_of(document, primitive, pose.weights, remarks)?,
            skin,
        }))
    }

    /// Whether its skin places its vertices in the world.
    pub fn is_skinned(&self) -> bool {
        self.skin.is_some()
    }

    /// The mesh of these parts, whose skin has these joints.
    ///
    /// Errors: an accessor that is not as it should be, or an index beyond the vertices.
    pub fn read<'a>(
        &self,
        (document, buffers): (&Document<'a>, &'a Buffers<'a>),
        joints: &[DAffine3],
        memory: &mut Memory,
        remarks: &mut Remarks,
    ) -> Result<TriangleMesh, ModelError> {
        let accessor = |index, meant| Accessor::of(document, buffers, index, meant);
        let positions = accessor(self.positions, Meant::Vectors)?;
        let vertices = positions.count;
        let object = document.row(Table::Accessors, self.positions)?;
        if vertices > u64::from(u32::MAX) {
            return Err(object.refused("count", vertices, "a mesh may have 4294967295 vertices"));
        }
        let corners = match self.indices {
            Some(index) => accessor(index, Meant::Indices)?.indices(memory)?,
            None => {
                memory.take(vertices, 4, || [object.file.into(), object.path.clone()])?;
                (0..vertices as u32).collect()
            }
        };
        if let Some((place, index)) = corners.iter().enumerate().find(|(_, index)| u64::from(**index) >= vertices) {
            let file = document.root.file;
            let place = format!("the index of corner {place} in accessors[{}]", self.indices.unwrap_or(0));
            return Err(ModelError::new(file, place, index, format_args!("there are {vertices} vertices")));
        }
        let triangles = corners.len().saturating_sub(if self.mode == 4 { 0 } else { 2 });
        let triangles = if self.mode == 4 { triangles / 3 } else { triangles };
        memory.take(triangles as u64, TriangleMesh::BYTES_A_TRIANGLE, || [object.file.into(), object.path.clone()])?;
        let mut triangles = triangles_of(self.mode, &corners);
        if self.mode == 4 && corners.len() % 3 != 0 {
            remarks.add_unread("corners behind the last triangle", (corners.len() % 3) as u64);
        }
        // Exporters put many primitives into one accessor: what this one does not use is not read.
        let mut used = corners;
        let is_part = 4 * (used.len() as u64) < vertices;
        if is_part {
            used.sort_unstable();
            used.dedup();
            renumber(&mut triangles, &used);
        }
        let wanted = is_part.then_some(&used[..]);
        let normals = self.normals.map(|index| accessor(index, Meant::Vectors)).transpose()?;
        let uvs = self.uvs.map(|index| accessor(index, Meant::Pairs)).transpose()?;
        for other in [&normals, &uvs].into_iter().flatten() {
            other.check_count(vertices)?;
        }
        let colours: Option<Vec<[f32; 3]>> = match self.colours {
            None => None,
            Some(index) if document.row(Table::Accessors, index)?.text("type")? == Some("VEC4") => {
                let colours = accessor(index, Meant::Fours)?;
                colours.check_count(vertices)?;
                let colours: Vec<[f32; 4]> = colours.floats(wanted, memory)?;
                let see_through = colours.iter().filter(|colour| colour[3] < 1.0).count();
                remarks.add_unread("opacity below 1 of vertices", see_through as u64);
                Some(colours.into_iter().map(|[r, g, b, _]| [r, g, b]).collect())
            }
            Some(index) => {
                let colours = accessor(index, Meant::Vectors)?;
                colours.check_count(vertices)?;
                Some(colours.floats(wanted, memory)?)
            }
        };
        // The specification has readers clamp them.
        let mut within = |colour: [f32; 3]| remarks.vertex_colour(colour.map(f64::from)).map(|part| part as f32);
        let colours = colours.map(|colours| colours.into_iter().map(&mut within).collect());
        let mut mesh = TriangleMesh {
            positions: positions.floats(wanted, memory)?,
            triangles,
            normals: normals.map(|normals| normals.floats(wanted, memory)).transpose()?,
            uvs: uvs.map(|uvs| uvs.floats(wanted, memory)).transpose()?,
            colours,
        };
        let (file, rows) = ((document, buffers), (wanted, vertices));
        add_morphs(&mut mesh.positions, &self.morphs, |morph| morph.1, file, rows, memory)?;
        if let Some(normals) = &mut mesh.normals {
            add_morphs(normals, &self.morphs, |morph| morph.2, file, rows, memory)?;
        }
        let Some((_, accessors)) = &self.skin else { return Ok(mesh) };
        let mut sets: Vec<Influences> = Vec::new();
        for pair in accessors {
            let [joints, weights] = pair.map(|index| accessor(index, Meant::Fours));
            let (joints, weights) = (joints?, weights?);
            joints.check_count(vertices)?;
            weights.check_count(vertices)?;
            let rows = joints.floats(wanted, memory)?.into_iter().zip(weights.floats(wanted, memory)?);
            sets.push(rows.collect());
        }
        Ok(skinned(mesh, joints, &sets))
    }
}

/// The accessors of joints and weights, a pair for every four joints of a vertex.
fn influences(attributes: &Object<'_>, rows: usize) -> Result<Vec<[usize; 2]>, ModelError> {
    let mut pairs = Vec::new();
    loop {
        let [joints, weights] = ["JOINTS", "WEIGHTS"].map(|name| format!("{name}_{}", pairs.len()));
        match (attributes.index(&joints, rows)?, attributes.index(&weights, rows)?) {
            (Some(joints), Some(weights)) => pairs.push([joints, weights]),
            _ => return Ok(pairs),
        }
    }
}

/// The triangles of a list, a strip or a fan.
fn triangles_of(mode: u64, corners: &[u32]) -> Vec<[u32; 3]> {
    match mode {
        5 => corners
            .windows(3)
            .enumerate()
            .map(|(number, own)| if number % 2 == 0 { [own[0], own[1], own[2]] } else { [own[1], own[0], own[2]] })
            .collect(),
        6 => {
            let first = corners.first().copied().unwrap_or(0);
            corners.windows(2).skip(1).map(|pair| [pair[0], pair[1], first]).collect()
        }
        _ => corners.as_chunks().0.to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::written::{data, floats, mesh, read, refused};

    #[test]
    fn strips_and_fans_keep_their_sides() {
        assert_eq!(triangles_of(4, &[0, 1, 2, 3, 4, 5, 6]), [[0, 1, 2], [3, 4, 5]]);
        assert_eq!(triangles_of(5, &[0, 1, 2, 3, 4]), [[0, 1, 2], [2, 1, 3], [2, 3, 4]]);
        assert_eq!(triangles_of(6, &[0, 1, 2, 3]), [[1, 2, 0], [2, 3, 0]]);
        for mode in 4..=6 {
            assert!(triangles_of(mode, &[0, 1]).is_empty() && triangles_of(mode, &[]).is_empty());
        }
    }
    #[test]
    fn indices_may_have_any_size() {
        let corners = vec![[0, 1, 2], [0, 2, 3]];
        for indices in 3..=5 {
            let own = format!("{{'attributes':{{'POSITION':0,'NORMAL':1,'TEXCOORD_0':2}},'indices':{indices}}}");
            let model = read(&mesh(&own)).expect("read");
            let mesh = &model.meshes[0];
            assert_eq!(mesh.triangles, corners);
            assert_eq!(mesh.normals, Some(vec![[0.0, 0.0, 1.0]; 4]));
            // v goes down in the file as it does here.
            assert_eq!(mesh.uvs, Some(vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]]));
            assert_eq!((&*model.instances[0].name, model.remarks.clone()), ("own", Remarks::default()));
        }
    }

    #[test]
    fn primitives_of_the_same_parts_are_one_mesh() {
        let own = "{'attributes':{'POSITION':0},'indices':3}";
        let model =
            read(&mesh(&format!("{own},{own},{{'attributes':{{'POSITION':0}},'mode':6}},{own}"))).expect("read");
        let meshes: Vec<usize> = model.instances.iter().map(|instance| instance.mesh).collect();
        assert_eq!((model.meshes.len(), meshes), (2, vec![0, 0, 1, 0]));
        assert_eq!((model.remarks.without_normals, model.remarks.sentences().len()), (2, 1));
    }

    #[test]
    fn a_part_of_a_large_accessor_is_read_alone() {
        let bytes = floats(&(0..300).map(|number| (number * number % 101) as f32).collect::<Vec<_>>());
        let file = format!(
            "'buffers':[{{'byteLength':1203,'uri':'{}'}}],'bufferViews':[{{'buffer':0,'byteLength':1200}},\
             {{'buffer':0,'byteOffset':1200,'byteLength':3}}],'accessors':[\
             {{'bufferView':0,'componentType':5126,'count':100,'type':'VEC3'}},\
             {{'bufferView':1,'componentType':5121,'count':3,'type':'SCALAR'}}],\
             'meshes':[{{'primitives':[{{'attributes':{{'POSITION':0}},'indices':1}}]}}]",
            data(&[&bytes[..], &[90, 7, 30]].concat())
        );
        let model = read(&file).expect("read");
        let row = |row: usize| [0, 1, 2].map(|part| ((3 * row + part) * (3 * row + part) % 101) as f32);
        assert_eq!(model.meshes[0].positions, [row(7), row(30), row(90)]);
        assert_eq!(model.meshes[0].triangles, [[2, 0, 1]]);
    }

    #[test]
    fn the_first_set_of_colours_is_that_of_the_vertices() {
        let model = read(&mesh("{'attributes':{'POSITION':0,'COLOR_0':1},'indices':3}")).expect("read");
        assert_eq!(model.meshes[0].colours, Some(vec![[0.0, 0.0, 1.0]; 4]));
        let four = mesh("{'attributes':{'POSITION':0,'COLOR_0':2},'indices':3}")
            .replace("'count':4,'type':'VEC2'", "'count':2,'type':'VEC4'");
        assert_eq!(refused(&four), "accessors[2].count is 2, but the mesh has 4 positions");
    }

    #[test]
    fn what_has_no_triangles_is_left_out_and_said() {
        let points = "{'attributes':{'POSITION':0},'mode':0},{'attributes':{'POSITION':0},'mode':3},{'attributes':{}}";
        let model = read(&mesh(points)).expect("read");
        assert!(model.meshes.is_empty() && model.instances.is_empty());
        let sentences = ["Not read: points (1), lines (1), primitives without positions (1)."];
        assert_eq!(model.remarks.sentences(), sentences);
        let model = read(&mesh("{'attributes':{'POSITION':0,'COLOR_1':0},'targets':[{},{}]}")).expect("read");
        // Morph targets whose weight is 0 change nothing.
        let sentence = "Not read: the attribute COLOR_1 (1), corners behind the last triangle (1).";
        assert_eq!(model.remarks.sentences()[1], sentence);
    }

    #[test]
    fn broken_primitives_are_refused() {
        let with = |primitive: &str| refused(&mesh(primitive));
        let mode = "meshes[0].primitives[0].mode is 7, but it must be from 0 to 6";
        assert_eq!(with("{'attributes':{'POSITION':0},'mode':7}"), mode);
        assert_eq!(with("{}"), "meshes[0].primitives[0].attributes is missing, but it is needed");
        let beyond = "meshes[0].primitives[0].attributes.POSITION is 6, but it must be a whole number from 0 to 5, \
                      for there are 6";
        assert_eq!(with("{'attributes':{'POSITION':6}}"), beyond);
        let draco = "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression is there, but compressed geometry \
                     is not \
                     read; export the model without it";
        let compressed = "{'attributes':{'POSITION':0},'extensions':{'KHR_draco_mesh_compression':{}}}";
        assert_eq!(refused(&mesh(compressed).replace("'accessors':[{'bufferView':0,", "'accessors':[{")), draco);
        assert!(read(&mesh(compressed)).is_ok());
        let stray = mesh("{'attributes':{'POSITION':0},'indices':3}").replacen("'count':4", "'count':3", 1);
        assert_eq!(refused(&stray), "the index of corner 5 in accessors[3] is 3, but there are 3 vertices");
        let few = mesh("{'attributes':{'POSITION':0,'NORMAL':1}}").replacen("'count':4", "'count':3", 1);
        assert_eq!(refused(&few), "accessors[1].count is 4, but the mesh has 3 positions");
    }
}
