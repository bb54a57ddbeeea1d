use super::element::{Element, Number};
use super::read::absent;
use super::values::Values;
use crate::model_error::ModelError;
use crate::model_error::shown;
use crate::remarks::Remarks;
use crate::triangle_mesh::fan;

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

/// Reads the faces: polygons as fans of triangles.
///
/// Errors: the number that is missing or none, or an index that is not that of a vertex.
pub fn read_faces<'b>(
    file: &str,
    element: &Element,
    vertices: u64,
    values: &mut impl Values<'b>,
    remarks: &mut Remarks,
) -> Result<Vec<[u32; 3]>, ModelError> {
    let (list, count_type, index_type) = index_list(file, element)?;
    // At least one triangle each, as a rule; the caller has compared their number with the bytes that are there.
    let mut triangles = Vec::with_capacity(element.rows as usize);
    let mut polygon = Vec::new();
    for row in 0..element.rows {
        for (place, property) in element.properties.iter().enumerate() {
            let refused = |why| absent(file, element, row, &property.name, why);
            if place != list {
                let count = property.count.map_or(Ok(1), |count| values.whole(count)).map_err(refused)?;
                values.skip(property.number, u64::try_from(count).unwrap_or(0)).map_err(refused)?;
                continue;
            }
            if let Some(corners) = values.triangle(count_type, index_type) {
                if let Some(index) = corners.into_iter().find(|index| u64::from(*index) >= vertices) {
                    return Err(no_vertex(file, row, read_as(index, index_type), vertices));
                }
                triangles.push(corners);
                continue;
            }
            let count = values.whole(count_type).map_err(refused)?;
            if count < 0 || count as u64 > values.left() as u64 {
                let place = format!("the number of corners of face {row}");
                let accepted = format!("{} bytes are left of the file", values.left());
                return Err(ModelError::new(file, place, count, accepted));
            }
            polygon.clear();
            for _ in 0..count {
                let index = values.whole(index_type).map_err(refused)?;
                if index < 0 || index as u64 >= vertices {
                    return Err(no_vertex(file, row, index, vertices));
                }
                // Vertices are fewer than 2³², which the caller has seen to.
                polygon.push(index as u32);
            }
            match polygon[..] {
                [a, b, c] => triangles.push([a, b, c]),
                [] | [_] | [_, _] => remarks.degenerate += 1,
                _ => {
                    remarks.fans += u64::from(polygon.len() > 4);
                    triangles.extend(fan(&polygon));
                }
            }
        }
    }
    Ok(triangles)
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
    }
    Ok(())
}

/// What a remark calls an element that is not read.
pub fn unread_element(element: &Element) -> String {
    format!("the element {}", shown(&element.name))
}
