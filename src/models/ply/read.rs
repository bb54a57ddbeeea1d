use super::element::Element;
use super::faces::{FaceParts, PlyFaces, read_faces, read_strips, skip_element, unread_element};
use super::header::{Format, Header};
use super::meshes::model_of;
use super::values::{Absent, Binary, Text, Values};
use super::vertices::{VertexParts, Vertices};
use crate::model::Model;
use crate::model_error::ModelError;
use crate::model_error::{shown, shown_bytes};
use crate::remarks::Remarks;

/// The parts of a colour.
const COLOURS: [&str; 4] = ["red", "green", "blue", "alpha"];

/// Reads a PLY file.
///
/// Errors: a header or a number that is not as it should be, or more rows than there are bytes.
pub fn read_ply(name: &str, bytes: &[u8]) -> Result<Model, ModelError> {
    let (header, rest) = Header::read(name, bytes)?;
    let mut remarks = Remarks::default();
    let rows = header.elements.iter().filter(|element| !element.properties.is_empty()).map(|element| element.rows);
    let read = match header.format {
        Format::Ascii => {
            let rows = rows.fold(0, u64::saturating_add);
            columns::<false>(name, &header, &mut Text::of(rest, rows), &mut remarks)
        }
        Format::LittleEndian => columns::<false>(name, &header, &mut Binary::<false> { rest }, &mut remarks),
        Format::BigEndian => columns::<true>(name, &header, &mut Binary::<true> { rest }, &mut remarks),
    }?;
    Ok(model_of(read, &header.textures, remarks))
}

fn columns<'b, const BIG: bool>(
    name: &str,
    header: &Header,
    values: &mut impl Values<'b>,
    remarks: &mut Remarks,
) -> Result<(Vertices, PlyFaces), ModelError> {
    let (mut columns, mut faces) = (Vertices::default(), PlyFaces::default());
    let is_text = header.format == Format::Ascii;
    let find = |name: &str| header.elements.iter().find(|element| element.name == name);
    let named = header.elements.iter().map(|element| shown(&element.name)).collect::<Vec<_>>().join(", ");
    let vertices = find("vertex").ok_or_else(|| {
        let named = if named.is_empty() { "there are none".into() } else { format!("its elements are {named}") };
        ModelError::new(name, "the element vertex", "missing", format!("a mesh needs it, and {named}"))
    })?;
    let count = vertices.rows;
    if find("face").is_none() && find("tristrips").is_none() {
        remarks.add_unread("points without faces", count);
    }
    for element in &header.elements {
        check_rows(name, element, values.left(), is_text)?;
        match element.name.as_str() {
            "vertex" => {
                let parts = VertexParts::of(name, element)?;
                remark_properties(element, |place| parts.contain(place), remarks);
                let size = element.least_size(false) as usize;
                let rows = if element.is_fixed() { values.rows(element.rows, size) } else { None };
                columns = match rows {
                    Some(rows) => parts.read_rows::<BIG>(element, rows, size, remarks),
                    None => parts.read_values(name, element, values, remarks)?,
                };
            }
            "face" => {
                let parts = FaceParts::of(name, element, header.textures.len())?;
                remark_properties(element, |place| parts.contain(place), remarks);
                let read = read_faces(name, element, (count, header.textures.len()), values, remarks)?;
                faces.wedges = read.wedges;
                faces.by_texture.splice(0..0, read.by_texture);
            }
            "tristrips" if find("face").is_none() => {
                faces.by_texture.push(read_strips(name, element, count, values, remarks)?);
            }
            _ => {
                remarks.add_unread(&unread_element(element), element.rows);
                skip_element(name, element, values)?;
            }
        }
    }
    Ok((columns, faces))
}

/// Errors: more rows than the bytes that are left can hold, or than an index can number.
fn check_rows(name: &str, element: &Element, left: usize, is_text: bool) -> Result<(), ModelError> {
    // The last number of a text needs no space behind it.
    let left = left as u64 + u64::from(is_text);
    let size = element.least_size(is_text);
    let max = u64::from(u32::MAX);
    let fits = element.rows.checked_mul(size).is_some_and(|bytes| bytes <= left);
    if fits && (size == 0 || element.rows <= max) {
        return Ok(());
    }
    let place = format!("the number of rows of element {}", shown(&element.name));
    let accepted = if fits {
        format!("an element may have {max}")
    } else {
        format!("each takes at least {size} bytes, and {left} bytes are left of the file")
    };
    Err(ModelError::new(name, place, element.rows, accepted))
}

/// Notes the properties that are not read.
fn remark_properties(element: &Element, is_read: impl Fn(usize) -> bool, remarks: &mut Remarks) {
    let is_colour = |name: &str| COLOURS.contains(&name.strip_prefix("diffuse_").unwrap_or(name));
    let unread = || element.properties.iter().enumerate().filter(|(place, _)| !is_read(*place));
    if unread().any(|(_, property)| is_colour(&property.name) && property.name != "alpha") {
        remarks.add_unread(&format!("colours of {}", element.name), element.rows);
    }
    for (_, property) in unread() {
        if !is_colour(&property.name) || property.name == "alpha" {
            remarks.add_unread(&format!("the property {} of {}", shown(&property.name), element.name), element.rows);
        }
    }
}

/// The error of a number that is missing or none.
pub fn absent(file: &str, element: &Element, row: u64, property: &str, why: Absent<'_>) -> ModelError {
    let place = format!("{} of {} {row}", shown(property), shown(&element.name));
    match why {
        Absent::End => ModelError::new(file, place, "missing", "the file ends before it"),
        Absent::Word(word) => ModelError::new(file, place, shown_bytes(word), "it must be a number of its type"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read_model;

    const CORNERS: &str = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 2 0\n";

    fn header(vertex: &str, face: &str) -> String {
        format!("ply\nformat ascii 1.0\nelement vertex 5\n{vertex}\nelement face 2\n{face}\nend_header\n")
    }

    const XYZ: &str = "property float x\nproperty float y\nproperty float z";
    const LIST: &str = "property list uchar int vertex_indices";

    fn read(text: &str) -> Result<Model, String> {
        let none = |_: &str| Err("there is none".to_owned());
        read_model("a.ply", text.as_bytes(), &none).map_err(|error| error.to_string())
    }

    fn refused(text: &str) -> String {
        match read(text) {
            Ok(model) => format!("read: {model:?}"),
            Err(sentence) => sentence.strip_prefix("a.ply: ").map_or(sentence.clone(), str::to_owned),
        }
    }

    #[test]
    fn polygons_are_fans() {
        let model = read(&format!("{}{CORNERS}5 0 1 2 4 3\n 3\n0 1 2", header(XYZ, LIST))).expect("read");
        assert_eq!(model.meshes[0].triangles, [[0, 1, 2], [0, 2, 4], [0, 4, 3], [0, 1, 2]]);
        assert_eq!((model.remarks.fans, model.remarks.without_normals, model.instances.len()), (0, 1, 1));
        let model = read(&format!("{}{CORNERS}4 0 1 2 3\n2 0 1", header(XYZ, LIST))).expect("read");
        assert_eq!((model.meshes[0].triangles.len(), model.remarks.fans, model.remarks.degenerate), (2, 0, 1));
    }

    #[test]
    fn normals_and_texture_coordinates_are_read_by_their_names() {
        for [u, v] in [["u", "v"], ["s", "t"], ["texture_u", "texture_v"], ["texcoord_u", "texcoord_v"]] {
            let vertex = format!(
                "property double x\nproperty uchar red\nproperty int y\nproperty float z\nproperty float ny\n\
                 property list uchar float weights\nproperty float nx\nproperty float nz\nproperty float {v}\n\
                 property float {u}\nproperty uchar quality"
            );
            let rows = "0 255 0 0 3 2 9 9 0 4 0.25 0.5 1\n1 255 0 0 3 0 0 4 0 1 7\n1 255 1 0 1 1 8 0 0 0 0 7\n\
                        0 0 1 0 0 0 0 1 0 0 7\n0 0 2 0 0 0 0 1 0 0 7\n";
            let model = read(&format!("{}{rows}3 0 1 2 3 2 3 4", header(&vertex, LIST))).expect("read");
            let mesh = &model.meshes[0];
            assert_eq!(mesh.positions[2], [1.0, 1.0, 0.0]);
            assert_eq!(mesh.normals.as_ref().map(|normals| normals[0]), Some([0.0, 0.6, 0.8]));
            // v goes up in the file.
            assert_eq!(mesh.uvs.as_ref().map(|uvs| [uvs[0], uvs[1]]), Some([[0.5, 0.75], [1.0, 1.0]]));
            let sentence = "Not read: colours of vertex (5), the property \"weights\" of vertex (5), the property \
                            \"quality\" of vertex (5).";
            assert_eq!(model.remarks.sentences(), [sentence]);
        }
    }

    /// In binary, the corners of a face with coordinates of its own are where those of any face are.
    #[test]
    fn textured_faces_are_read_alike_in_text_and_in_binary() {
        let header = |format: &str| {
            format!(
                "ply\nformat {format} 1.0\ncomment TextureFile t.png\nelement vertex 5\n{XYZ}\nelement face 2\n{LIST}\n\
                 property list uchar float texcoord\nproperty uchar red\nend_header\n"
            )
        };
        let faces = [([0, 1, 2], [0.0, 0.0, 1.0, 0.0, 1.0, 1.0]), ([0, 2, 4], [0.0, 0.0, 1.0, 1.0, 0.5, 0.25])];
        let mut text = header("ascii") + CORNERS;
        let mut binary = header("binary_little_endian").into_bytes();
        binary.extend(CORNERS.split_whitespace().flat_map(|word| word.parse::<f32>().expect("a number").to_le_bytes()));
        for (corners, uvs) in faces {
            text += &format!("3 {} {} {} 6", corners[0], corners[1], corners[2]);
            text += &uvs.map(|part: f32| format!(" {part}")).concat();
            text += " 200\n";
            binary.push(3);
            binary.extend(corners.iter().flat_map(|corner: &i32| corner.to_le_bytes()));
            binary.push(6);
            binary.extend(uvs.iter().flat_map(|part| part.to_le_bytes()));
            binary.push(200);
        }
        let of = |bytes: &[u8]| read_model("a.ply", bytes, &|_: &str| Err("there is none".to_owned())).expect("read");
        let [a, b] = [of(text.as_bytes()), of(&binary)];
        let parts = |model: &Model| {
            model.meshes.iter().map(|mesh| (mesh.positions.clone(), mesh.uvs.clone())).collect::<Vec<_>>()
        };
        assert_eq!(parts(&a), parts(&b));
        assert_eq!((a.meshes[0].triangles.len(), a.meshes[0].positions.len()), (2, 6));
    }

    #[test]
    fn u_without_v_is_not_read() {
        let vertex = format!("{XYZ}\nproperty float u\nproperty float nx");
        let rows = CORNERS.replace('\n', " 1 1\n");
        let model = read(&format!("{}{rows}3 0 1 2 3 2 3 4", header(&vertex, LIST))).expect("read");
        assert!(model.meshes[0].uvs.is_none() && model.meshes[0].normals.is_none());
        assert_eq!(model.remarks.unread.len(), 2);
    }

    #[test]
    fn other_elements_are_passed_over() {
        let text = format!(
            "ply\nformat ascii 1.0\nelement face 1\n{}\nelement other 2\nproperty list char short a\nproperty char b\n\
             element none 999999999999999999\nelement vertex 5\n{XYZ}\nend_header\n3 0 1 2 7 2 1 2 3 0 4 {CORNERS}",
            LIST.replace("vertex_indices", "vertex_index\nproperty int flags")
        );
        let model = read(&text).expect("read");
        assert_eq!(model.meshes[0].triangles, [[0, 1, 2]]);
        let sentence = "Not read: the property \"flags\" of face (1), the element \"other\" (2), the element \"none\" \
                        (999999999999999999).";
        assert_eq!(model.remarks.sentences()[2], sentence);
    }

    #[test]
    fn headers_without_what_a_mesh_needs_are_refused() {
        let start = "ply\nformat ascii 1.0\n";
        let none = "the element vertex is missing, but a mesh needs it, and there are none";
        assert_eq!(refused(&format!("{start}end_header\n")), none);
        let other = "the element vertex is missing, but a mesh needs it, and its elements are \"vertices\"";
        assert_eq!(refused(&format!("{start}element vertices 0\nend_header\n")), other);
        let no_face = format!("{start}element vertex 0\n{XYZ}\nend_header\n");
        assert!(read(&no_face).expect("read").instances.is_empty());
        let points = format!("{start}element vertex 5\n{XYZ}\nend_header\n{CORNERS}");
        let said = read(&points).expect("read").remarks.sentences();
        assert_eq!(said.last().map(String::as_str), Some("Not read: points without faces (5)."));
        let with = |vertex: &str, face: &str| refused(&format!("{}{CORNERS}3 0 1 2 3 0 1 2", header(vertex, face)));
        let no_z = with("property float x\nproperty float y", LIST);
        assert_eq!(no_z, "a vertex's z is missing, but a vertex needs the properties x, y and z");
        let list = with(&XYZ.replace("float z", "list uchar float z"), LIST);
        assert_eq!(list, "a vertex's z is a list, but it must be one number");
        let named = "a face's vertex_indices is";
        let missing = format!("{named} missing, but a face needs a list vertex_indices or vertex_index");
        assert_eq!(with(XYZ, &LIST.replace("vertex_indices", "corners")), missing);
        assert_eq!(with(XYZ, "property int vertex_indices"), format!("{named} one number, but it must be a list"));
        let floats = format!("{named} a list of floats, but its numbers must be whole");
        assert_eq!(with(XYZ, &LIST.replace("int", "float")), floats);
    }

    #[test]
    fn rows_that_are_not_there_are_refused() {
        let with = |faces: &str| refused(&format!("{}{CORNERS}{faces}", header(XYZ, LIST)));
        assert_eq!(with("3 0 1 2 3 0 1 5"), "a corner of face 1 is 5, but there are 5 vertices, counted from 0");
        assert_eq!(with("3 0 -1 2 3 0 1 5"), "a corner of face 0 is -1, but there are 5 vertices, counted from 0");
        let word = "\"vertex_indices\" of \"face\" 1 is \"1.5\", but it must be a number of its type";
        assert_eq!(with("3 0 1 2 3 0 1.5 2"), word);
        let end = "\"vertex_indices\" of \"face\" 1 is missing, but the file ends before it";
        assert_eq!(with("3 0 1 2 3 0 1"), end);
        let many = "the number of corners of face 0 is 4000000000, but 6 bytes are left of the file";
        assert_eq!(with("4000000000 0 1 2"), many);
        let negative = "the number of corners of face 0 is -3, but 6 bytes are left of the file";
        assert_eq!(with("-3 0 1 2"), negative);
        let vertex = refused(&format!("{}{}", header(XYZ, LIST), CORNERS.replace("0.5", "x")));
        assert_eq!(vertex, "\"x\" of \"vertex\" 4 is \"x\", but it must be a number of its type");
        for rows in ["1000000000000", "999999999999999999"] {
            let many = refused(&header(XYZ, LIST).replace("vertex 5", &format!("vertex {rows}")));
            let expected = format!(
                "the number of rows of element \"vertex\" is {rows}, but each takes at least 6 bytes, and 1 bytes are \
                 left \
                 of the file"
            );
            assert_eq!(many, expected);
        }
    }

    #[test]
    fn the_same_mesh_is_read_from_text_and_from_both_binary_formats() {
        let text = read(&format!("{}{CORNERS}3 0 1 2 3 2 3 4", header(XYZ, LIST))).expect("read");
        let numbers = || CORNERS.split_whitespace().map(|word| word.parse::<f32>().expect("a number"));
        let corners = [[0, 1, 2], [2, 3, 4_i32]];
        let binary = |is_big: bool| {
            let name = if is_big { "binary_big_endian" } else { "binary_little_endian" };
            let mut bytes = header(XYZ, LIST).replace("ascii", name).into_bytes();
            bytes.extend(numbers().flat_map(|number| if is_big { number.to_be_bytes() } else { number.to_le_bytes() }));
            for triangle in corners {
                bytes.push(3);
                bytes.extend(triangle.iter().flat_map(|at| if is_big { at.to_be_bytes() } else { at.to_le_bytes() }));
            }
            bytes
        };
        for is_big in [false, true] {
            let bytes = binary(is_big);
            assert_eq!(read_ply("a.ply", &bytes).expect("read"), text);
            for length in 0..bytes.len() {
                assert!(read_ply("a.ply", &bytes[..length]).is_err(), "{length} bytes");
            }
            let mut stray = bytes.clone();
            let at = stray.len() - 4;
            stray[at..].fill(0xff);
            let sentence = read_ply("a.ply", &stray).expect_err("refused").to_string();
            assert_eq!(sentence, "a.ply: a corner of face 1 is -1, but there are 5 vertices, counted from 0");
        }
    }
}
