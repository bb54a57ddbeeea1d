//! Corners of faces, which number positions, texture coordinates and normals apart → vertices, which have one index.

use super::lines::lines;
use crate::centre::about;
use crate::model_error::ModelError;
use crate::number::{whole, words};
use crate::polygon::Polygons;
use crate::remarks::Remarks;
use crate::triangle_mesh::TriangleMesh;
use glam::DVec3;

/// The index of a corner that has no texture coordinates or no normal.
const NONE: u32 = u32::MAX;

/// The columns that the corners of faces refer to.
#[derive(Default)]
pub struct Columns {
    /// From `v`.
    pub positions: Vec<[f64; 3]>,
    /// From `v` as well, in sRGB; as many as there are positions, or fewer, or none.
    pub colours: Vec<[f32; 3]>,
    /// From `vt`, v up.
    pub uvs: Vec<[f32; 2]>,
    /// From `vn`.
    pub normals: Vec<[f32; 3]>,
}

impl Columns {
    /// The number of positions, texture coordinates and normals so far.
    pub fn rows(&self) -> [usize; 3] {
        [self.positions.len(), self.uvs.len(), self.normals.len()]
    }
}

/// The number of positions, texture coordinates and normals of a whole file: a face may come before its vertices.
pub fn rows_of(text: &[u8]) -> [usize; 3] {
    let mut rows = [0; 3];
    for (_, line) in lines(text) {
        match words(&line).next() {
            Some(b"v") => rows[0] += 1,
            Some(b"vt") => rows[1] += 1,
            Some(b"vn") => rows[2] += 1,
            _ => {}
        }
    }
    rows
}

/// A corner: indices of its position, its texture coordinates and its normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Corner {
    position: u32,
    uv: u32,
    normal: u32,
}

impl Corner {
    /// The corner that a word such as `3/2/1` or `-1//-1` describes; none if it has a position that the file does not
    /// have.
    ///
    /// `so_far` is how many rows are above it, from which negative indices count, and `all` how many the file has.
    /// Errors: what is wrong with it, as the end of a sentence.
    pub fn read(
        word: &[u8],
        so_far: [usize; 3],
        all: [usize; 3],
        remarks: &mut Remarks,
    ) -> Result<Option<Self>, String> {
        let mut parts = word.split(|byte| *byte == b'/');
        let mut index = |column: usize, what: &str| match parts.next() {
            None | Some(b"") if column > 0 => Ok(Index::Without),
            part => row(part.unwrap_or(b""), so_far[column], all[column], what),
        };
        let position = index(0, "position")?;
        let mut attribute = |index: Index| {
            remarks.absent_attributes += u64::from(index == Index::Absent);
            if let Index::Row(row) = index { row } else { NONE }
        };
        let uv = attribute(index(1, "texture coordinate")?);
        let normal = attribute(index(2, "normal")?);
        if parts.next().is_some() {
            return Err("a corner has at most three indices, such as 3/2/1".into());
        }
        Ok(if let Index::Row(position) = position { Some(Self { position, uv, normal }) } else { None })
    }
}

/// What an index of a corner denotes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Index {
    /// A row, from 0.
    Row(u32),
    /// One that the file does not have.
    Absent,
    /// The corner has no such index.
    Without,
}

/// The row that an index denotes: from 1, or from −1 backwards.
fn row(word: &[u8], so_far: usize, all: usize, what: &str) -> Result<Index, String> {
    let Some(index) = whole(word) else {
        return Err(format!("the index of a {what} is a whole number, such as 3 or -1"));
    };
    let from_zero = if index < 0 { so_far as i64 + index } else { index - 1 };
    // An index of 2³² − 1 would be NONE.
    let is_there = from_zero >= 0 && from_zero < all as i64 && from_zero < i64::from(NONE);
    Ok(if is_there { Index::Row(from_zero as u32) } else { Index::Absent })
}

/// How many vertices at one position are looked through for an equal one.
///
/// Without a bound, a hundred thousand corners at one position would take as many steps each.
const MAX_TRIED: usize = 64;

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
        for _ in 0..MAX_TRIED {
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
    /// Polygons of indices of vertices.
    polygons: Polygons,
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

    /// Adds a polygon of vertices.
    pub fn add_polygon(&mut self, vertices: &[u32], remarks: &mut Remarks) {
        self.polygons.add(vertices, remarks);
    }

    /// How many of its vertices have no texture coordinate, and no normal, where others have one.
    pub fn missing(&self) -> [u64; 2] {
        let count = |has_some: bool, is_missing: fn(&&Corner) -> bool| {
            if has_some { self.corners.iter().filter(is_missing).count() as u64 } else { 0 }
        };
        [count(self.has_uvs, |corner| corner.uv == NONE), count(self.has_normals, |corner| corner.normal == NONE)]
    }

    /// The positions of its vertices.
    pub fn positions(&self, columns: &Columns) -> impl Iterator<Item = [f64; 3]> {
        self.corners.iter().map(|corner| columns.positions[corner.position as usize])
    }

    /// The mesh about a point, with v down; what a corner does not have is zero, and its colour white.
    pub fn into_mesh(self, columns: &Columns, centre: DVec3, remarks: &mut Remarks) -> TriangleMesh {
        let corners = self.corners;
        let normal = |corner: &Corner| columns.normals.get(corner.normal as usize).copied().unwrap_or_default();
        let uv = |corner: &Corner| columns.uvs.get(corner.uv as usize).map_or([0.0; 2], |[u, v]| [*u, 1.0 - v]);
        let colour = |corner: &Corner| columns.colours.get(corner.position as usize).copied().unwrap_or([1.0; 3]);
        let at = |vertex: u32| DVec3::from(columns.positions[corners[vertex as usize].position as usize]);
        TriangleMesh {
            positions: corners
                .iter()
                .map(|corner| about(centre, columns.positions[corner.position as usize]))
                .collect(),
            triangles: self.polygons.into_triangles(at, remarks),
            normals: self.has_normals.then(|| corners.iter().map(normal).collect()),
            uvs: self.has_uvs.then(|| corners.iter().map(uv).collect()),
            colours: (!columns.colours.is_empty()).then(|| corners.iter().map(colour).collect()),
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
        Columns {
            positions: vec![[0.0; 3]; 4],
            uvs: vec![[0.25, 0.25]; 3],
            normals: vec![[0.0, 0.0, 1.0]; 2],
            ..Columns::default()
        }
    }

    /// The corner of a word, where more rows follow than are there.
    fn corner(word: &str) -> Result<Option<Corner>, String> {
        Corner::read(word.as_bytes(), columns().rows(), [6, 4, 3], &mut Remarks::default())
    }

    #[test]
    fn corners_count_from_1_or_backwards() {
        let read = |word: &str| corner(word).map(|corner| corner.map(|own| [own.position, own.uv, own.normal]));
        assert_eq!(read("1"), Ok(Some([0, NONE, NONE])));
        assert_eq!(read("4/3/2"), Ok(Some([3, 2, 1])));
        assert_eq!(read("-4/-1"), Ok(Some([0, 2, NONE])));
        assert_eq!(read("2//-2"), Ok(Some([1, NONE, 0])));
        assert_eq!(read("2//"), Ok(Some([1, NONE, NONE])));
        // What comes later in the file.
        assert_eq!(read("6/4/3"), Ok(Some([5, 3, 2])));
        for word in ["7", "-5", "0", "999999999999999999", "7/1/1"] {
            assert_eq!(read(word), Ok(None), "{word}");
        }
        for word in ["1/5/4", "1/0/0", "1/-4/-999999999999999999"] {
            assert_eq!(read(word), Ok(Some([0, NONE, NONE])), "{word}");
            let mut remarks = Remarks::default();
            assert!(Corner::read(word.as_bytes(), columns().rows(), [6, 4, 3], &mut remarks).is_ok());
            assert_eq!(remarks.absent_attributes, 2);
        }
        for (word, what) in [("x", "position"), ("", "position"), ("1/1.5", "texture coordinate"), ("1//n", "normal")] {
            assert_eq!(read(word), Err(format!("the index of a {what} is a whole number, such as 3 or -1")));
        }
        assert_eq!(read("1/1/1/1"), Err("a corner has at most three indices, such as 3/2/1".into()));
        assert_eq!(rows_of(b"v 1\nvt\nvn 1\n#v\n v 2\nvp 1\nf 1"), [2, 1, 1]);
    }

    #[test]
    fn equal_corners_are_one_vertex() {
        let (mut vertices, mut faces, mut others) = (Vertices::default(), Faces::default(), Faces::default());
        let corner = |word: &str| corner(word).expect("a corner").expect("its position");
        let mut vertex = |word: &str| vertices.find(corner(word), 0, &mut faces);
        assert_eq!(["1/1", "2", "1/2", "1/1", "-3", "1"].map(&mut vertex), [0, 1, 2, 0, 1, 3]);
        assert_eq!(["2", "1/1", "2"].map(|word| vertices.find(corner(word), 1, &mut others)), [0, 1, 0]);
        faces.add_polygon(&[0, 1, 2], &mut Remarks::default());
        let mesh = faces.into_mesh(&columns(), DVec3::ZERO, &mut Remarks::default());
        assert_eq!(mesh.positions.len(), 4);
        assert_eq!(mesh.uvs, Some(vec![[0.25, 0.75], [0.0; 2], [0.25, 0.75], [0.0; 2]]));
        assert_eq!((mesh.normals, mesh.colours), (None, None));
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
