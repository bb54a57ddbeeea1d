use super::element::{Element, Number};
use super::read::absent;
use super::values::{Absent, Values};
use crate::model_error::ModelError;
use crate::model_error::shown;
use crate::polygon::Polygons;
use crate::remarks::Remarks;

/// The names of a face's list of vertices.
const NAMES: [&str; 2] = ["vertex_indices", "vertex_index"];

/// The place of a face's list of vertices, the type of its count and of its indices.
pub fn index_list(file: &str, element: &Element) -> Result<(usize, Number, Number), ModelError> {
    let wrong = |value: &str, accepted: &str| Err(ModelError::new(file, "a face's vertex_indices", value, accepted));
    let Some(place) = element.find(&NAMES) else {
        return wrong("missing", "a face needs a list vertex_indices or vertex_index");
    };
    let property = &element.properties[place];
    match property.count {
        Some(count) if property.number.is_whole() => Ok((place, count, property.number)),
        Some(_) => wrong("a list of floats", "its numbers must be whole"),
        None => wrong("one number", "it must be a list"),
    }
}

/// The faces of a file: for each image that they are textured with, or for one or none.
#[derive(Default)]
pub struct PlyFaces {
    /// The faces of each image.
    pub by_texture: Vec<Polygons>,
    /// Where corners have texture coordinates of their own: the vertex and the coordinates of each, v up.
    pub wedges: Option<Vec<(u32, [f32; 2])>>,
}

/// Which properties of a face are read, by their places.
#[derive(Clone, Copy)]
pub struct FaceParts {
    /// The list of vertices, the type of its count and of its indices.
    list: (usize, Number, Number),
    /// The list of texture coordinates, two for each corner.
    wedges: Option<usize>,
    /// The number of the image.
    texture: Option<usize>,
}

impl FaceParts {
    /// Those of an element, in a file that names so many images.
    ///
    /// Errors: there is no list of vertices.
    pub fn of(file: &str, element: &Element, textures: usize) -> Result<Self, ModelError> {
        let list = index_list(file, element)?;
        let find = |name: &str, is_list: bool| {
            let place = element.find(&[name])?;
            (element.properties[place].count.is_some() == is_list).then_some(place)
        };
        let wedges = find("texcoord", true).filter(|_| textures > 0);
        let texture = find("texnumber", false).filter(|_| textures > 1);
        Ok(Self { list, wedges, texture })
    }

    /// Whether the property at this place is read.
    pub fn contain(&self, place: usize) -> bool {
        self.list.0 == place || [self.wedges, self.texture].contains(&Some(place))
    }
}

/// Reads the faces.
///
/// Errors: the number that is missing or none, or an index that is not that of a vertex.
pub fn read_faces<'b>(
    file: &str,
    element: &Element,
    (vertices, textures): (u64, usize),
    values: &mut impl Values<'b>,
    remarks: &mut Remarks,
) -> Result<PlyFaces, ModelError> {
    let FaceParts { list: (list, count_type, index_type), wedges, texture } = FaceParts::of(file, element, textures)?;
    let mut by_texture: Vec<Polygons> = Vec::new();
    // At least one triangle each, as a rule; the caller has compared their number with the bytes that are there.
    by_texture.push(Polygons::with_capacity(element.rows as usize));
    by_texture.extend((1..textures).map(|_| Polygons::default()));
    let mut own_wedges = wedges.map(|_| Vec::new());
    let is_plain = wedges.is_none() && texture.is_none();
    let (mut polygon, mut coordinates) = (Vec::new(), Vec::new());
    for row in 0..element.rows {
        let mut number = 0;
        for (place, property) in element.properties.iter().enumerate() {
            let refused = |why| absent(file, element, row, &property.name, why);
            if place != list {
                let count = property.count.map_or(Ok(1), |count| values.whole(count)).map_err(refused)?;
                let count = u64::try_from(count).unwrap_or(0);
                if wedges == Some(place) {
                    coordinates.clear();
                    for _ in 0..count {
                        coordinates.push(values.float(property.number).map_err(refused)?);
                    }
                } else if texture == Some(place) {
                    number = values.whole(property.number).map_err(refused)?;
                } else {
                    values.skip(property.number, count).map_err(refused)?;
                }
                continue;
            }
            if is_plain && let Some(corners) = values.triangle(count_type, index_type) {
                if let Some(index) = corners.into_iter().find(|index| u64::from(*index) >= vertices) {
                    return Err(no_vertex(file, row, read_as(index, index_type), vertices));
                }
                by_texture[0].add_triangle(corners);
                polygon.clear();
                continue;
            }
            read_list(file, (row, vertices), (count_type, index_type), values, &mut polygon, refused)?;
            if is_plain {
                by_texture[0].add(&polygon, remarks);
            }
        }
        if !is_plain {
            if let Some(own) = &mut own_wedges {
                let uv = |corner: usize| match coordinates.get(2 * corner..2 * corner + 2) {
                    Some(uv) => [uv[0], uv[1]],
                    None => [0.0; 2],
                };
                for (corner, vertex) in polygon.iter_mut().enumerate() {
                    own.push((*vertex, uv(corner)));
                    // Fewer than there are bytes in a file of at most 4 GiB.
                    *vertex = (own.len() - 1) as u32;
                }
            }
            let image = usize::try_from(number).unwrap_or(0).min(by_texture.len() - 1);
            by_texture[image].add(&polygon, remarks);
        }
        remarks.extra_values += u64::from(values.end_row());
    }
    Ok(PlyFaces { by_texture, wedges: own_wedges })
}

/// Reads a list of vertices.
fn read_list<'b>(
    file: &str,
    (row, vertices): (u64, u64),
    (count_type, index_type): (Number, Number),
    values: &mut impl Values<'b>,
    polygon: &mut Vec<u32>,
    refused: impl Fn(Absent<'b>) -> ModelError,
) -> Result<(), ModelError> {
    let count = values.whole(count_type).map_err(&refused)?;
    if count < 0 || count as u64 > values.left() as u64 {
        let place = format!("the number of corners of face {row}");
        let accepted = format!("{} bytes are left of the file", values.left());
        return Err(ModelError::new(file, place, count, accepted));
    }
    polygon.clear();
    for _ in 0..count {
        let index = values.whole(index_type).map_err(&refused)?;
        if index < 0 || index as u64 >= vertices {
            return Err(no_vertex(file, row, index, vertices));
        }
        // Vertices are fewer than 2³², which the caller has seen to.
        polygon.push(index as u32);
    }
    Ok(())
}

/// Reads strips of triangles: lists in which −1 begins a new one.
///
/// Errors: the same.
pub fn read_strips<'b>(
    file: &str,
    element: &Element,
    vertices: u64,
    values: &mut impl Values<'b>,
    remarks: &mut Remarks,
) -> Result<Polygons, ModelError> {
    let (list, count_type, index_type) = index_list(file, element)?;
    let mut polygons = Polygons::default();
    for row in 0..element.rows {
        for (place, property) in element.properties.iter().enumerate() {
            let refused = |why| absent(file, element, row, &property.name, why);
            let count = property.count.map_or(Ok(1), |count| values.whole(count)).map_err(refused)?;
            let count = u64::try_from(count).unwrap_or(0);
            if place != list {
                values.skip(property.number, count).map_err(refused)?;
                continue;
            }
            debug_assert_eq!(property.count, Some(count_type));
            let (mut strip, mut length) = ([0; 2], 0_u64);
            for _ in 0..count {
                let index = values.whole(index_type).map_err(refused)?;
                if index < 0 {
                    length = 0;
                    continue;
                }
                if index as u64 >= vertices {
                    return Err(no_vertex(file, row, index, vertices));
                }
                let index = index as u32;
                match length {
                    0 | 1 => {}
                    even if even.is_multiple_of(2) => polygons.add_triangle([strip[0], strip[1], index]),
                    _ => polygons.add_triangle([strip[1], strip[0], index]),
                }
                (strip, length) = ([strip[1], index], length + 1);
            }
        }
        remarks.extra_values += u64::from(values.end_row());
    }
    Ok(polygons)
}

/// The error of an index that is not that of a vertex.
fn no_vertex(file: &str, row: u64, index: i64, vertices: u64) -> ModelError {
    let accepted = format!("there are {vertices} vertices, counted from 0");
    ModelError::new(file, format_args!("a corner of face {row}"), index, accepted)
}

/// The bits of an index as its type has them: a negative one looks like a large one.
fn read_as(index: u32, number: Number) -> i64 {
    if number == Number::I32 { i64::from(index.cast_signed()) } else { i64::from(index) }
}

/// Passes over the rows of an element.
///
/// Errors: the file ends before.
pub fn skip_element<'b>(file: &str, element: &Element, values: &mut impl Values<'b>) -> Result<(), ModelError> {
    // Rows of nothing have no end in the file, however many they are.
    if element.properties.is_empty() {
        return Ok(());
    }
    for row in 0..element.rows {
        for property in &element.properties {
            let refused = |why| absent(file, element, row, &property.name, why);
            let count = property.count.map_or(Ok(1), |count| values.whole(count)).map_err(refused)?;
            values.skip(property.number, u64::try_from(count).unwrap_or(0)).map_err(refused)?;
        }
        values.end_row();
    }
    Ok(())
}

/// What a remark calls an element that is not read.
pub fn unread_element(element: &Element) -> String {
    format!("the element {}", shown(&element.name))
}
