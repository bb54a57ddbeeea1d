use super::faces::{Columns, Corner, Faces, Vertices, rows_of};
use super::library::Libraries;
use super::lines::{lines, rest_of};
use crate::centre::centre_of;
use crate::colour::linear_from_srgb;
use crate::model::{Instance, Model};
use crate::model_error::ModelError;
use crate::model_error::shown_bytes;
use crate::model_material::ModelMaterial;
use crate::number::{double, words};
use crate::open::Open;
use glam::DAffine3;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// What an OBJ file says besides its faces' corners that is of no use here.
const IGNORED: [&[u8]; 3] = [b"o", b"g", b"s"];

/// The faces so far, by material.
#[derive(Default)]
struct Groups {
    /// Those of each material, in the order of their first face.
    faces: Vec<(Option<Arc<str>>, Faces)>,
    /// The index of each material's.
    by_material: HashMap<Option<Arc<str>>, usize>,
    /// The material of the next face.
    material: Option<Arc<str>>,
    /// The index of its faces, once there is one.
    current: Option<usize>,
}

impl Groups {
    fn current(&mut self) -> (usize, &mut Faces) {
        let index = *self.current.get_or_insert_with(|| {
            *self.by_material.entry(self.material.clone()).or_insert_with(|| {
                self.faces.push((self.material.clone(), Faces::default()));
                self.faces.len() - 1
            })
        });
        (index, &mut self.faces[index].1)
    }

    fn use_material(&mut self, name: &str) {
        if self.material.as_deref() != Some(name) {
            self.material = Some(name.into());
            self.current = None;
        }
    }
}

/// Reads an OBJ file, and its material libraries.
///
/// Errors: a line that is not as it should be; a library that cannot be read is one of the remarks.
pub fn read_obj(name: &str, bytes: &[u8], open: Open<'_>) -> Result<Model, ModelError> {
    let mut model = Model::default();
    let (mut columns, mut vertices, mut groups) = (Columns::default(), Vertices::default(), Groups::default());
    let mut libraries = Libraries::of(bytes);
    let (mut polygon, all) = (Vec::new(), rows_of(bytes));
    for (number, line) in lines(bytes) {
        let mut words = words(&line);
        let Some(keyword) = words.next() else { continue };
        match keyword {
            b"v" => {
                columns.positions.push(numbers(name, number, "v", &mut words)?);
                if let Some(colour) = colour(words) {
                    // Those before it that have none are white.
                    columns.colours.resize(columns.positions.len() - 1, [1.0; 3]);
                    columns.colours.push(model.remarks.vertex_colour(colour).map(linear_from_srgb));
                }
            }
            b"vn" => columns.normals.push(numbers(name, number, "vn", &mut words)?.map(|part| part as f32)),
            b"vt" => columns.uvs.push(texture_coordinates(name, number, &mut words)?),
            b"f" => {
                polygon.clear();
                let (rows, mut is_there) = (columns.rows(), true);
                let (group, faces) = groups.current();
                for word in words {
                    let absent = model.remarks.absent_attributes;
                    let corner = Corner::read(word, rows, all, &mut model.remarks)
                        .map_err(|accepted| ModelError::new(name, place(number, "f"), shown_bytes(word), accepted))?;
                    if model.remarks.absent_attributes > absent {
                        model.remarks.absent_attribute_line.get_or_insert(number);
                    }
                    match corner {
                        Some(corner) if is_there => polygon.push(vertices.find(corner, group, faces)),
                        _ => is_there = false,
                    }
                }
                vertices.check_count(name)?;
                if is_there {
                    faces.add_polygon(&polygon, &mut model.remarks);
                } else {
                    model.remarks.absent_vertices += 1;
                    model.remarks.absent_vertex_line.get_or_insert(number);
                }
            }
            b"usemtl" => groups.use_material(&rest_of(&line)),
            b"mtllib" => libraries.read(&rest_of(&line), open, &mut model)?,
            _ if IGNORED.contains(&keyword) => {}
            _ => model
                .remarks
                .add_unread(&format!("`{}`", String::from_utf8_lossy(&keyword[..keyword.len().min(80)])), 1),
        }
    }
    drop(vertices);
    place_meshes(&mut model, groups, &columns, &libraries);
    model.images = libraries.into_images();
    Ok(model)
}

fn place(line: usize, keyword: &str) -> String {
    format!("`{keyword}` on line {line}")
}

/// As many numbers as fit.
fn numbers<'w, const N: usize>(
    name: &str,
    line: usize,
    keyword: &str,
    words: &mut impl Iterator<Item = &'w [u8]>,
) -> Result<[f64; N], ModelError> {
    let mut numbers = [0.0; N];
    for number in &mut numbers {
        let word = words.next().unwrap_or(b"");
        *number = double(word).ok_or_else(|| {
            ModelError::new(
                name,
                place(line, keyword),
                shown_bytes(word),
                if N == 1 { "it needs a number".into() } else { format!("it needs {N} numbers") },
            )
        })?;
    }
    Ok(numbers)
}

/// The colour behind a position, as the file has it: three numbers, or four of which the first is the position's weight.
fn colour<'w>(words: impl Iterator<Item = &'w [u8]>) -> Option<[f64; 3]> {
    let (mut numbers, mut count) = ([0.0; 4], 0);
    for (number, word) in numbers.iter_mut().zip(words) {
        *number = double(word)?;
        count += 1;
    }
    match (numbers, count) {
        ([r, g, b, _], 3) | ([_, r, g, b], 4) => Some([r, g, b]),
        _ => None,
    }
}

/// u, and v if it is there.
fn texture_coordinates<'w>(
    name: &str,
    line: usize,
    words: &mut impl Iterator<Item = &'w [u8]>,
) -> Result<[f32; 2], ModelError> {
    let [u] = numbers(name, line, "vt", words)?;
    let v = words.next().map_or(Ok([0.0]), |word| numbers(name, line, "vt", &mut std::iter::once(word)))?;
    Ok([u, v[0]].map(|part| part as f32))
}

/// Makes a mesh and an instance of each material's faces.
fn place_meshes(model: &mut Model, groups: Groups, columns: &Columns, libraries: &Libraries) {
    let mut missing: HashSet<Arc<str>> = HashSet::new();
    // All meshes about one point, so that what they have in common stays so.
    let centre = centre_of(groups.faces.iter().flat_map(|(_, faces)| faces.positions(columns)));
    let mut plain = None;
    for (material, faces) in groups.faces {
        let [without_uvs, without_normals] = faces.missing();
        let mesh = faces.into_mesh(columns, centre, &mut model.remarks).cleaned(&mut model.remarks);
        // A normal that is not there is not one without a direction.
        model.remarks.zero_normals -= without_normals;
        model.remarks.missing_normals += without_normals;
        if mesh.triangles.is_empty() {
            model.remarks.empty_meshes += 1;
            continue;
        }
        let mut index = material.as_ref().and_then(|material| libraries.index_of(material));
        if let (Some(material), None) = (&material, index)
            && missing.insert(material.clone())
        {
            model.remarks.add_unread("materials that no library describes", 1);
        }
        if mesh.colours.is_some() && index.is_none() {
            // White, so that the colours of the vertices are seen as they are, and from both sides as all of an OBJ file.
            index = Some(*plain.get_or_insert_with(|| {
                let (name, double_sided) = ("vertex colours".into(), true);
                model.materials.push(ModelMaterial { name, double_sided, ..ModelMaterial::default() });
                model.materials.len() - 1
            }));
        }
        model.remarks.without_normals += u64::from(mesh.normals.is_none());
        let is_textured = index.is_some_and(|index| model.materials[index].base_colour_texture.is_some());
        model.remarks.without_uvs += u64::from(is_textured && mesh.uvs.is_none());
        model.remarks.missing_uvs += if is_textured { without_uvs } else { 0 };
        model.instances.push(Instance {
            name: material.unwrap_or_default(),
            mesh: model.meshes.len(),
            material: index,
            world_from_object: DAffine3::from_translation(centre),
        });
        model.meshes.push(Arc::new(mesh));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read_model;

    const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

    fn read(text: &str) -> Result<Model, String> {
        let open = |name: &str| match name {
            "a.mtl" => Ok(b"newmtl red\nKd 1 0 0\nmap_Kd a.png\nnewmtl green\nKd 0 1 0\n".to_vec()),
            "b c.mtl" => Ok(b"newmtl blue\nKd 0 0 1\n".to_vec()),
            "wrong.mtl" => Ok(b"newmtl blue\nKd x\n".to_vec()),
            _ => Err("there is none".to_owned()),
        };
        read_model("a.obj", text.as_bytes(), &open).map_err(|error| error.to_string())
    }

    fn refused(text: &str) -> String {
        match read(text) {
            Ok(model) => format!("read: {model:?}"),
            Err(sentence) => sentence.strip_prefix("a.obj: ").map_or(sentence.clone(), str::to_owned),
        }
    }

    #[test]
    fn each_material_s_faces_are_a_mesh() {
        let text = format!(
            "mtllib a.mtl\nmtllib b c.mtl\nmtllib a.mtl\n{SQUARE}f 1 2 3\nusemtl red\nf 1 2 3 4\nusemtl blue\nf 2 3 4\n\
             usemtl red\nf -4 -3 -2\nusemtl green\nusemtl unknown\nf 1 2 4\nf 2 1 4"
        );
        let model = read(&text).expect("read");
        let parts: Vec<_> = model
            .instances
            .iter()
            .map(|own| (&*own.name, model.meshes[own.mesh].triangles.len(), own.material))
            .collect();
        assert_eq!(parts, [("", 1, None), ("red", 3, Some(0)), ("blue", 1, Some(2)), ("unknown", 2, None)]);
        assert_eq!((model.materials.len(), model.images.len()), (3, 1));
        assert_eq!(model.remarks.without_uvs, 1);
        assert_eq!(model.remarks.sentences()[2], "Not read: materials that no library describes (1).");
    }

    #[test]
    fn corners_have_texture_coordinates_and_normals_or_not() {
        let text = format!("{SQUARE}vt 0.25 0.75 0\nvt 0.5\nvn 0 0 2\nf 1/1/1 2/2/1 3//1 4\n");
        let mesh = (*read(&text).expect("read").meshes[0]).clone();
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(mesh.uvs, Some(vec![[0.25, 0.25], [0.5, 1.0], [0.0; 2], [0.0; 2]]));
        assert_eq!(mesh.normals, Some(vec![[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0; 3]]));
    }

    #[test]
    fn libraries_that_cannot_be_read_are_said() {
        let model = read(&format!("mtllib none.mtl\nmtllib a.mtl no.mtl\nmtllib\n{SQUARE}f 1 2 3")).expect("read");
        assert_eq!(model.materials.len(), 2);
        let sentence = "Not read: the library \"none.mtl\", since there is none (1), the library \"no.mtl\", since \
                        there is \
                        none (1).";
        assert_eq!(model.remarks.sentences()[1], sentence);
        let model = read(&format!("mtllib wrong.mtl\nusemtl blue\n{SQUARE}f 1 2 3")).expect("read");
        assert_eq!((model.materials[0].base_colour, model.instances[0].material), ([0.8; 3], Some(0)));
        let sentence = "Not read: `Kd` on line 2 of \"wrong.mtl\", since \"x\" is no finite number (1).";
        assert_eq!(model.remarks.sentences()[1], sentence);
    }

    #[test]
    fn what_is_not_read_is_said() {
        let text = format!(
            "v 0 0 1 0.5 0.5 0.5\nv 0 0 1 1\no all\ng a b\ns off\nl 1 2\nl 1 2\np 1\n{SQUARE}f 3 4 5\nf 3 4\nf 3 4 5 \
             6 1"
        );
        let model = read(&text).expect("read");
        assert_eq!((model.remarks.fans, model.remarks.degenerate), (0, 1));
        let sentence = "Not read: `l` (2), `p` (1).";
        assert_eq!(model.remarks.sentences().last().map(String::as_str), Some(sentence));
    }

    #[test]
    fn broken_lines_are_refused_with_their_number() {
        assert_eq!(refused("v 0 0\n"), "`v` on line 1 is \"\", but it needs 3 numbers");
        assert_eq!(refused("\nv 0 zero 0\n"), "`v` on line 2 is \"zero\", but it needs 3 numbers");
        assert_eq!(refused("vn 0 1\n"), "`vn` on line 1 is \"\", but it needs 3 numbers");
        assert_eq!(refused("vt\n"), "`vt` on line 1 is \"\", but it needs a number");
        assert_eq!(refused("vt 0 x\n"), "`vt` on line 1 is \"x\", but it needs a number");
        let index = "`f` on line 5 is \"x\", but the index of a position is a whole number, such as 3 or -1";
        assert_eq!(refused(&format!("{SQUARE}f 1 2 x")), index);
    }

    #[test]
    fn numbers_that_are_not_finite_drop_their_triangles() {
        let model = read(&format!("{SQUARE}v nan 0 0\nv 1e99 0 0\nf 1 2 3\nf 1 2 5\nf 1 3 6\nf 1 1 2")).expect("read");
        assert_eq!((model.remarks.not_finite, model.remarks.degenerate), (2, 1));
        assert_eq!((model.meshes[0].positions.len(), model.meshes[0].triangles.len()), (3, 1));
        let model = read("").expect("read");
        assert!(model.meshes.is_empty() && model.instances.is_empty());
    }
}
