use super::element::{Element, Number};
use super::values::{Values, double_at, float_at};
use crate::colour::linear_from_srgb;
use crate::model_error::ModelError;
use crate::remarks::Remarks;
use crate::triangle_mesh::TriangleMesh;

/// The names of a vertex's properties: x, y, z; the normal; u and v; red, green and blue.
const NAMES: [&[&str]; 11] = [
    &["x"],
    &["y"],
    &["z"],
    &["nx"],
    &["ny"],
    &["nz"],
    &["u", "s", "texture_u", "texcoord_u"],
    &["v", "t", "texture_v", "texcoord_v"],
    &["red", "r", "diffuse_red"],
    &["green", "g", "diffuse_green"],
    &["blue", "b", "diffuse_blue"],
];

/// The columns of the vertices.
#[derive(Default)]
pub struct Vertices {
    /// All but the triangles; the positions only where f32 holds them.
    pub mesh: TriangleMesh,
    /// The positions where it may not.
    pub precise: Option<Vec<[f64; 3]>>,
}

/// Which property is which part of a vertex.
pub struct VertexParts {
    /// The place of each of the parts' properties.
    places: [Option<usize>; 11],
    /// By which a colour's numbers are divided.
    whole_colour: f64,
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
        // A part of a normal alone is of no use, nor is u without v, nor a part of a colour.
        for parts in [3..6, 6..8, 8..11] {
            if places[parts.clone()].contains(&None) {
                places[parts].fill(None);
            }
        }
        let colour = places[8].map(|place| element.properties[place].number);
        let whole_colour = match colour {
            Some(Number::F32 | Number::F64) => 1.0,
            Some(Number::I16 | Number::U16) => 65_535.0,
            _ => 255.0,
        };
        Ok(Self { places, whole_colour })
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
            colours: self.places[8].map(|_| Vec::with_capacity(rows)),
        }
    }

    /// A colour in linear light.
    fn colour(&self, parts: [f32; 3], remarks: &mut Remarks) -> [f32; 3] {
        let own = parts.map(|part| f64::from(part) / self.whole_colour);
        remarks.vertex_colour(own).map(linear_from_srgb)
    }

    /// Reads the vertices of a binary file whose rows all have one size.
    pub fn read_rows<const BIG: bool>(
        &self,
        element: &Element,
        bytes: &[u8],
        size: usize,
        remarks: &mut Remarks,
    ) -> Vertices {
        let offset = |place: usize| element.properties[..place].iter().map(|own| own.number.size()).sum::<usize>();
        let columns = self.places.map(|place| {
            let place = place.unwrap_or(0);
            (offset(place), element.properties[place].number)
        });
        let read = |row: &[u8], part: usize| float_at::<BIG>(&row[columns[part].0..], columns[part].1);
        let double = |row: &[u8], part: usize| double_at::<BIG>(&row[columns[part].0..], columns[part].1);
        let mut mesh = self.columns(bytes.len() / size.max(1));
        let rows = || bytes.chunks_exact(size.max(1));
        let fits = |(_, number): &(usize, Number)| !matches!(number, Number::F64 | Number::I32 | Number::U32);
        let precise = if columns[..3].iter().all(fits) {
            mesh.positions.extend(rows().map(|row| [read(row, 0), read(row, 1), read(row, 2)]));
            None
        } else {
            Some(rows().map(|row| [double(row, 0), double(row, 1), double(row, 2)]).collect())
        };
        if let Some(normals) = &mut mesh.normals {
            normals.extend(rows().map(|row| [read(row, 3), read(row, 4), read(row, 5)]));
        }
        if let Some(uvs) = &mut mesh.uvs {
            uvs.extend(rows().map(|row| [read(row, 6), 1.0 - read(row, 7)]));
        }
        if let Some(colours) = &mut mesh.colours {
            colours.extend(rows().map(|row| self.colour([read(row, 8), read(row, 9), read(row, 10)], remarks)));
        }
        Vertices { mesh, precise }
    }

    /// Reads the vertices one number after another; the rows that have more of them than there should be are counted.
    ///
    /// Errors: the number that is missing or none.
    pub fn read_values<'b>(
        &self,
        file: &str,
        element: &Element,
        values: &mut impl Values<'b>,
        remarks: &mut Remarks,
    ) -> Result<Vertices, ModelError> {
        let mut part_of = vec![None; element.properties.len()];
        for (part, place) in self.places.iter().enumerate() {
            for place in place.iter() {
                part_of[*place] = Some(part);
            }
        }
        // The caller has compared the number of rows with the bytes that are there.
        let mut mesh = self.columns(element.rows as usize);
        let mut precise = Vec::with_capacity(element.rows as usize);
        for row in 0..element.rows {
            let (mut position, mut parts) = ([0.0; 3], [0.0; 8]);
            for (property, part) in element.properties.iter().zip(&part_of) {
                let read = match (part, property.count) {
                    (Some(part @ 0..3), _) => values.double(property.number).map(|number| position[*part] = number),
                    (Some(part), _) => values.float(property.number).map(|number| parts[*part - 3] = number),
                    (None, None) => values.skip(property.number, 1),
                    (None, Some(count)) => values
                        .whole(count)
                        .and_then(|count| values.skip(property.number, u64::try_from(count).unwrap_or(0))),
                };
                read.map_err(|why| super::read::absent(file, element, row, &property.name, why))?;
            }
            remarks.extra_values += u64::from(values.end_row());
            let [nx, ny, nz, u, v, r, g, b] = parts;
            precise.push(position);
            mesh.normals.iter_mut().for_each(|normals| normals.push([nx, ny, nz]));
            mesh.uvs.iter_mut().for_each(|uvs| uvs.push([u, 1.0 - v]));
            mesh.colours.iter_mut().for_each(|colours| colours.push(self.colour([r, g, b], remarks)));
        }
        Ok(Vertices { mesh, precise: Some(precise) })
    }
}
