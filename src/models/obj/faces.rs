//! Corners of faces, which number positions, texture coordinates and normals apart → vertices, which have one index.

use crate::model_error::ModelError;
use crate::number::whole;
use crate::triangle_mesh::TriangleMesh;

/// The index of a corner that has no texture coordinates or no normal.
const NONE: u32 = u32::MAX;

/// The columns that the corners of faces refer to.
#[derive(Default)]
pub struct Columns {
    /// From `v`.
    pub positions: Vec<[f32; 3]>,
    /// From `vt`, v up.
    pub uvs: Vec<[f32; 2]>,
    /// From `vn`.
    pub normals: Vec<[f32; 3]>,
}

/// A corner: indices of its position, its texture coordinates and its normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Corner {
    position: u32,
    uv: u32,
    normal: u32,
}

impl Corner {
    /// The corner that a word such as `3/2/1` or `-1//-1` describes.
    ///
    /// Errors: what is wrong with it, as the end of a sentence.
    pub fn read(word: &[u8], columns: &Columns) -> Result<Self, String> {
        let mut parts = word.split(|byte| *byte == b'/');
        let mut index = |rows: usize, what: &str, needed: bool| match parts.next() {
            None | Some(b"") if !needed => Ok(NONE),
            part => row(part.unwrap_or(b""), rows, what),
        };
        let position = index(columns.positions.len(), "position", true)?;
        let uv = index(columns.uvs.len(), "texture coordinate", false)?;
        let normal = index(columns.normals.len(), "normal", false)?;
        if parts.next().is_some() {
            return Err("a corner has at most three indices, such as 3/2/1".into());
        }
        Ok(Self { position, uv, normal })
    }
}

/// The row that an index denotes: from 1, or from −1 backwards.
fn row(word: &[u8], rows: usize, what: &str) -> Result<u32, String> {
    let Some(index) = whole(word) else {
        return Err(format!("the index of a {what} is a whole number, such as 3 or -1"));
    };
    let from_zero = if index < 0 { rows as i64 + index } else { index - 1 };
    // An index of 2³² − 1 would be NONE.
    if index == 0 || from_zero < 0 || from_zero >= rows as i64 || from_zero >= i64::from(NONE) {
        return Err(format!("there are {rows} {what}s above it, counted from 1 or, backwards, from -1"));
    }
    Ok(from_zero as u32)
}

/// How many vertices at one position are looked through for an equal one.
///
/// Without a bound, a hundred thousand corners at one position would take as many steps each.
const MOST_TRIED: usize = 64;

/// A vertex that is known.
struct Known {
    corner: Corner,
    /// The material whose faces it belongs to, by index.
    group: usize,
    /// Its index among their vertices.
    vertex: u32,
    /// The one before it at the same position.
    before: u32,
}

/// The vertices of the corners that have occurred.
#[derive(Default)]
pub struct Vertices {
    /// The last vertex at each position.
    last: Vec<u32>,
    known: Vec<Known>,
}

impl Vertices {
    /// The vertex of a corner among the faces of a material, the same for equal corners.
    pub fn find(&mut self, corner: Corner, group: usize, faces: &mut Faces) -> u32 {
        let position = corner.position as usize;
        if position >= self.last.len() {
            self.last.resize(position + 1, NONE);
        }
        let mut place = self.last[position];
        for _ in 0..MOST_TRIED {
            match self.known.get(place as usize) {
                None => break,
                Some(known) if known.corner == corner && known.group == group => return known.vertex,
                Some(known) => place = known.before,
            }
        }
        let vertex = faces.add(corner);
        self.known.push(Known { corner, group, vertex, before: self.last[position] });
        // There are fewer corners in memory than u32 can number.
        self.last[position] = (self.known.len() - 1) as u32;
        vertex
    }
}

/// The faces of one material.
#[derive(Default)]
pub struct Faces {
    /// The corner of each vertex.
    corners: Vec<Corner>,
    /// Indices of vertices.
    triangles: Vec<[u32; 3]>,
    /// Whether any corner has them.
    has_uvs: bool,
    has_normals: bool,
}

impl Faces {
    fn add(&mut self, corner: Corner) -> u32 {
        self.has_uvs |= corner.uv != NONE;
        self.has_normals |= corner.normal != NONE;
        self.corners.push(corner);
        (self.corners.len() - 1) as u32
    }

    /// Adds triangles.
    pub fn extend(&mut self, triangles: impl Iterator<Item = [u32; 3]>) {
        self.triangles.extend(triangles);
    }

    /// The mesh, with v down; what a corner does not have is zero.
    pub fn into_mesh(self, columns: &Columns) -> TriangleMesh {
        let corners = self.corners;
        let normal = |corner: &Corner| columns.normals.get(corner.normal as usize).copied().unwrap_or_default();
        let uv = |corner: &Corner| columns.uvs.get(corner.uv as usize).map_or([0.0; 2], |[u, v]| [*u, 1.0 - v]);
        TriangleMesh {
            positions: corners.iter().map(|corner| columns.positions[corner.position as usize]).collect(),
            triangles: self.triangles,
            normals: self.has_normals.then(|| corners.iter().map(normal).collect()),
            uvs: self.has_uvs.then(|| corners.iter().map(uv).collect()),
        }
    }
}

impl Vertices {
    /// Errors: more vertices than an index can number.
    pub fn check_count(&self, file: &str) -> Result<(), ModelError> {
        if self.known.len() < NONE as usize {
            return Ok(());
        }
        Err(ModelError::new(file, "the number of vertices", self.known.len(), format_args!("a model may have {NONE}")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns() -> Columns {
        Columns { positions: vec![[0.0; 3]; 4], uvs: vec![[0.25, 0.25]; 3], normals: vec![[0.0, 0.0, 1.0]; 2] }
    }

    #[test]
    fn corners_count_from_1_or_backwards() {
        let read = |word: &str| {
            Corner::read(word.as_bytes(), &columns()).map(|corner| [corner.position, corner.uv, corner.normal])
        };
        assert_eq!(read("1"), Ok([0, NONE, NONE]));
        assert_eq!(read("4/3/2"), Ok([3, 2, 1]));
        assert_eq!(read("-4/-1"), Ok([0, 2, NONE]));
        assert_eq!(read("2//-2"), Ok([1, NONE, 0]));
        assert_eq!(read("2//"), Ok([1, NONE, NONE]));
        let beyond = |rows: usize, what: &str| {
            Err(format!("there are {rows} {what}s above it, counted from 1 or, backwards, from -1"))
        };
        assert_eq!(read("5"), beyond(4, "position"));
        assert_eq!(read("-5"), beyond(4, "position"));
        assert_eq!(read("0"), beyond(4, "position"));
        assert_eq!(read("1/4"), beyond(3, "texture coordinate"));
        assert_eq!(read("1/1/3"), beyond(2, "normal"));
        assert_eq!(read("1//-999999999999999999"), beyond(2, "normal"));
        for (word, what) in [("x", "position"), ("", "position"), ("1/1.5", "texture coordinate"), ("1//n", "normal")] {
            assert_eq!(read(word), Err(format!("the index of a {what} is a whole number, such as 3 or -1")));
        }
        assert_eq!(read("1/1/1/1"), Err("a corner has at most three indices, such as 3/2/1".into()));
    }

    #[test]
    fn equal_corners_are_one_vertex() {
        let columns = columns();
        let (mut vertices, mut faces, mut others) = (Vertices::default(), Faces::default(), Faces::default());
        let corner = |word: &str| Corner::read(word.as_bytes(), &columns).expect("a corner");
        let mut vertex = |word: &str| vertices.find(corner(word), 0, &mut faces);
        assert_eq!(["1/1", "2", "1/2", "1/1", "-3", "1"].map(&mut vertex), [0, 1, 2, 0, 1, 3]);
        assert_eq!(["2", "1/1", "2"].map(|word| vertices.find(corner(word), 1, &mut others)), [0, 1, 0]);
        faces.extend([[0, 1, 2]].into_iter());
        let mesh = faces.into_mesh(&columns);
        assert_eq!(mesh.positions.len(), 4);
        assert_eq!(mesh.uvs, Some(vec![[0.25, 0.75], [0.0; 2], [0.25, 0.75], [0.0; 2]]));
        assert_eq!(mesh.normals, None);
    }
    #[test]
    fn many_vertices_at_one_position_are_looked_through_to_a_bound() {
        let (mut vertices, mut faces) = (Vertices::default(), Faces::default());
        let corner = |uv: u32| Corner { position: 2, uv, normal: NONE };
        for uv in 0..65 {
            assert_eq!(vertices.find(corner(uv), 0, &mut faces), uv);
        }
        assert_eq!(vertices.find(corner(1), 0, &mut faces), 1);
        assert_eq!(vertices.find(corner(0), 0, &mut faces), 65);
    }
}
