use super::element::Element;
use super::values::{Values, float_at};
use crate::model_error::ModelError;
use crate::triangle_mesh::TriangleMesh;

/// The names of a vertex's properties: x, y, z; the normal; u and v.
const NAMES: [&[&str]; 8] = [
    &["x"],
    &["y"],
    &["z"],
    &["nx"],
    &["ny"],
    &["nz"],
    &["u", "s", "texture_u", "texcoord_u"],
    &["v", "t", "texture_v", "texcoord_v"],
];

/// Which property is which part of a vertex.
pub struct VertexParts {
    /// The place of each of the parts' properties.
    places: [Option<usize>; 8],
}

impl VertexParts {
    /// Those of an element.
    ///
    /// Errors: x, y or z is missing, or one of the parts is a list.
    pub fn of(file: &str, element: &Element) -> Result<Self, ModelError> {
        let mut places = NAMES.map(|names| element.find(names));
        for (names, place) in NAMES.iter().zip(places) {
            let name = names[0];
            match place {
                Some(place) if element.properties[place].count.is_some() => {
                    let shown = format!("a vertex's {}", element.properties[place].name);
                    return Err(ModelError::new(file, shown, "a list", "it must be one number"));
                }
                None if ["x", "y", "z"].contains(&name) => {
                    let accepted = "a vertex needs the properties x, y and z";
                    return Err(ModelError::new(file, format_args!("a vertex's {name}"), "missing", accepted));
                }
                _ => {}
            }
        }
        // A part of a normal alone is of no use, nor is u without v.
        for parts in [3..6, 6..8] {
            if places[parts.clone()].contains(&None) {
                places[parts].fill(None);
            }
        }
        Ok(Self { places })
    }

    /// Whether the property at this place is read.
    pub fn contain(&self, place: usize) -> bool {
        self.places.contains(&Some(place))
    }

    /// Empty columns for the parts that are there.
    fn columns(&self, rows: usize) -> TriangleMesh {
        TriangleMesh {
            positions: Vec::with_capacity(rows),
            triangles: Vec::new(),
            normals: self.places[3].map(|_| Vec::with_capacity(rows)),
            uvs: self.places[6].map(|_| Vec::with_capacity(rows)),
        }
    }

    /// Reads the vertices of a binary file whose rows all have one size.
    pub fn read_rows<const BIG: bool>(&self, element: &Element, bytes: &[u8], size: usize) -> TriangleMesh {
        let offset = |place: usize| element.properties[..place].iter().map(|own| own.number.size()).sum::<usize>();
        let column = |part: usize| {
            let place = self.places[part].unwrap_or(0);
            (offset(place), element.properties[place].number)
        };
        let columns = [0, 1, 2, 3, 4, 5, 6, 7].map(column);
        let read = |row: &[u8], part: usize| float_at::<BIG>(&row[columns[part].0..], columns[part].1);
        let mut mesh = self.columns(bytes.len() / size.max(1));
        let rows = || bytes.chunks_exact(size.max(1));
        mesh.positions.extend(rows().map(|row| [read(row, 0), read(row, 1), read(row, 2)]));
        if let Some(normals) = &mut mesh.normals {
            normals.extend(rows().map(|row| [read(row, 3), read(row, 4), read(row, 5)]));
        }
        if let Some(uvs) = &mut mesh.uvs {
            uvs.extend(rows().map(|row| [read(row, 6), 1.0 - read(row, 7)]));
        }
        mesh
    }

    /// Reads the vertices one number after another.
    ///
    /// Errors: the number that is missing or none.
    pub fn read_values<'b>(
        &self,
        file: &str,
        element: &Element,
        values: &mut impl Values<'b>,
    ) -> Result<TriangleMesh, ModelError> {
        let mut part_of = vec![None; element.properties.len()];
        for (part, place) in self.places.iter().enumerate() {
            for place in place.iter() {
                part_of[*place] = Some(part);
            }
        }
        // The caller has compared the number of rows with the bytes that are there.
        let mut mesh = self.columns(element.rows as usize);
        for row in 0..element.rows {
            let mut parts = [0.0; 8];
            for (property, part) in element.properties.iter().zip(&part_of) {
                let read = match (part, property.count) {
                    (Some(part), _) => values.float(property.number).map(|number| parts[*part] = number),
                    (None, None) => values.skip(property.number, 1),
                    (None, Some(count)) => values
                        .whole(count)
                        .and_then(|count| values.skip(property.number, u64::try_from(count).unwrap_or(0))),
                };
                read.map_err(|why| super::read::absent(file, element, row, &property.name, why))?;
            }
            let [x, y, z, nx, ny, nz, u, v] = parts;
            mesh.positions.push([x, y, z]);
            mesh.normals.iter_mut().for_each(|normals| normals.push([nx, ny, nz]));
            mesh.uvs.iter_mut().for_each(|uvs| uvs.push([u, 1.0 - v]));
        }
        Ok(mesh)
    }
}
