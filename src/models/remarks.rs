use crate::printable::printable;

/// The greatest number of different unread features that are named.
const MAX_NAMED: usize = 16;

/// What was dropped, replaced or not read of a model file, counted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Remarks {
    /// Triangles without an area, dropped.
    pub degenerate: u64,
    /// Triangles with a corner that is infinite or NaN, dropped.
    pub not_finite: u64,
    /// Normals without a direction, which became zero.
    pub zero_normals: u64,
    /// Vertices without a normal in a mesh where others have one; the normal became zero.
    pub missing_normals: u64,
    /// Vertices without a texture coordinate in a mesh with a texture where others have one, which became (0, 0).
    pub missing_uvs: u64,
    /// Texture coordinates that were infinite or NaN and became (0, 0).
    pub uvs_not_finite: u64,
    /// Colours of vertices with a part that was not a number, which became 0.
    pub colours_not_numbers: u64,
    /// Colours of vertices with a part beyond 0 to 1, which became the nearest in it.
    pub colours_clamped: u64,
    /// The greatest finite part of these colours, rounded up.
    pub greatest_colour: u64,
    /// Meshes without vertex normals.
    pub without_normals: u64,
    /// Meshes whose material has a texture, and which have no texture coordinates.
    pub without_uvs: u64,
    /// Meshes without triangles, left out.
    pub empty_meshes: u64,
    /// Polygons that cross themselves, which became fans.
    pub fans: u64,
    /// Vertices that no triangle uses, left out.
    pub unused_vertices: u64,
    /// Faces with a vertex that is not there, dropped.
    pub absent_vertices: u64,
    /// The line of the first of them.
    pub absent_vertex_line: Option<usize>,
    /// Corners whose texture coordinate or normal is not there.
    pub absent_attributes: u64,
    /// The line of the first of them.
    pub absent_attribute_line: Option<usize>,
    /// Rows with more values than their element has properties.
    pub extra_values: u64,
    /// Numbers of materials, lights and cameras out of their range, replaced by the nearest in it.
    pub clamped: u64,
    /// What there is to say about animations, as a sentence.
    pub animations: Option<String>,
    /// What was not read, by name, and how often it occurred.
    pub unread: Vec<(String, u64)>,
    /// Kinds of what was not read, beyond those that are named.
    pub more_unread: u64,
}

impl Remarks {
    /// Notes that something was not read.
    pub(super) fn add_unread(&mut self, name: &str, count: u64) {
        if count == 0 {
            return;
        }
        let name = printable(name, 80);
        match self.unread.iter().position(|(own, _)| *own == name) {
            Some(place) => self.unread[place].1 += count,
            None if self.unread.len() < MAX_NAMED => self.unread.push((name, count)),
            None => self.more_unread += count,
        }
    }

    /// Clamps a number, and counts it if that changed it.
    pub(super) fn clamp(&mut self, number: f64, min: f64, max: f64) -> f64 {
        let within = if number < min { min } else { number.min(max) };
        self.clamped += u64::from(within != number);
        within
    }

    /// Clamps each part of a colour, counted as one number.
    pub(super) fn clamp_colour(&mut self, colour: [f64; 3], max: f64) -> [f64; 3] {
        let before = self.clamped;
        let within = colour.map(|part| self.clamp(part, 0.0, max));
        self.clamped = before + u64::from(within != colour);
        within
    }

    /// The colour of a vertex with every part within 0 to 1; what had to be changed is counted.
    pub(super) fn vertex_colour(&mut self, colour: [f64; 3]) -> [f64; 3] {
        if colour.iter().all(|part| (0.0..=1.0).contains(part)) {
            return colour;
        }
        let is_number = !colour.iter().any(|part| part.is_nan());
        let count = if is_number { &mut self.colours_clamped } else { &mut self.colours_not_numbers };
        *count += 1;
        let greatest = colour.into_iter().filter(|part| part.is_finite()).fold(0.0, f64::max);
        self.greatest_colour = self.greatest_colour.max(greatest.ceil() as u64);
        colour.map(|part| if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) })
    }

    /// What there is to say, in one sentence each; nothing if the file was read as it is.
    pub fn sentences(&self) -> Vec<String> {
        let counted = [
            (self.degenerate, "triangle without an area was dropped", "triangles without an area were dropped"),
            (
                self.not_finite,
                "triangle with a corner that is infinite or not a number was dropped",
                "triangles with a corner that is infinite or not a number were dropped",
            ),
            (
                self.zero_normals,
                "vertex normal has no direction, and the triangle's own is used there",
                "vertex normals have no direction, and the triangle's own is used there",
            ),
            (
                self.missing_normals,
                "vertex has no normal, as others of its mesh have, and the triangle's own is used there",
                "vertices have no normal, as others of their mesh have, and the triangle's own is used there",
            ),
            (
                self.missing_uvs,
                "vertex has no texture coordinate, as others of its mesh have, and takes (0, 0)",
                "vertices have no texture coordinate, as others of their mesh have, and take (0, 0)",
            ),
            (
                self.uvs_not_finite,
                "texture coordinate that is infinite or not a number became (0, 0)",
                "texture coordinates that are infinite or not a number became (0, 0)",
            ),
            (
                self.colours_not_numbers,
                "vertex has a colour with a part that is not a number, and the part became 0",
                "vertices have a colour with a part that is not a number, and the part became 0",
            ),
            (
                self.colours_clamped,
                "vertex has a colour with a part below 0 or above 1, and the part became the nearest from 0 to 1",
                "vertices have a colour with a part below 0 or above 1, and the part became the nearest from 0 to 1",
            ),
            (
                self.without_normals,
                "mesh has no vertex normals, so that its triangles look planar",
                "meshes have no vertex normals, so that their triangles look planar",
            ),
            (
                self.without_uvs,
                "mesh has a material with a texture, but no texture coordinates",
                "meshes have a material with a texture, but no texture coordinates",
            ),
            (self.empty_meshes, "mesh without triangles was left out", "meshes without triangles were left out"),
            (
                self.fans,
                "polygon that crosses itself or has very many corners became a fan of triangles",
                "polygons that cross themselves or have very many corners became fans of triangles",
            ),
            (
                self.unused_vertices,
                "vertex that no triangle uses was left out",
                "vertices that no triangle uses were left out",
            ),
            (self.absent_vertices, ABSENT_VERTEX, "faces with a vertex that the file does not have were dropped"),
            (
                self.absent_attributes,
                ABSENT_ATTRIBUTE,
                "corners have a texture coordinate or a normal that the file does not have, and go without",
            ),
            (
                self.extra_values,
                "row has more values than its element has properties, and the rest of it was left out",
                "rows have more values than their element has properties, and the rest of them was left out",
            ),
            (
                self.clamped,
                "number was out of its range and became the nearest in it",
                "numbers were out of their range and became the nearest in it",
            ),
        ];
        let mut sentences: Vec<String> = counted
            .into_iter()
            .filter(|(count, ..)| *count > 0)
            .map(|(count, one, many)| {
                let line = match one {
                    ABSENT_VERTEX => self.absent_vertex_line,
                    ABSENT_ATTRIBUTE => self.absent_attribute_line,
                    _ => None,
                };
                let first = if count == 1 { "" } else { "the first " };
                let place = line.map_or_else(String::new, |line| format!(" ({first}on line {line})"));
                format!("{count} {}{place}.", if count == 1 { one } else { many })
            })
            .collect();
        // A light that is baked into colours is seldom brighter than 2, and bytes seldom darker.
        if (3..=255).contains(&self.greatest_colour) {
            sentences.push(format!(
                "The colours of vertices go up to {}, as if they were bytes: divided by 255, they would lie from 0 to 1.",
                self.greatest_colour
            ));
        }
        sentences.extend(self.animations.clone());
        if !self.unread.is_empty() {
            let named = self.unread.iter().map(|(name, count)| format!("{name} ({count})")).collect::<Vec<_>>();
            let more = if self.more_unread > 0 { format!(", and {} others", self.more_unread) } else { String::new() };
            sentences.push(format!("Not read: {}{more}.", named.join(", ")));
        }
        sentences
    }
}

const ABSENT_VERTEX: &str = "face with a vertex that the file does not have was dropped";
const ABSENT_ATTRIBUTE: &str =
    "corner has a texture coordinate or a normal that the file does not have, and goes without";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_remark_is_a_sentence() {
        assert!(Remarks::default().sentences().is_empty());
        let one = Remarks {
            degenerate: 1,
            not_finite: 1,
            zero_normals: 1,
            missing_normals: 1,
            missing_uvs: 1,
            uvs_not_finite: 1,
            colours_not_numbers: 1,
            colours_clamped: 1,
            without_normals: 1,
            without_uvs: 1,
            empty_meshes: 1,
            fans: 1,
            unused_vertices: 1,
            absent_vertices: 1,
            absent_attributes: 1,
            extra_values: 1,
            clamped: 1,
            ..Remarks::default()
        };
        assert_eq!(one.sentences().len(), 17);
        assert!(one.sentences().iter().all(|sentence| sentence.starts_with("1 ") && sentence.ends_with('.')));
        let many = Remarks { degenerate: 12, ..Remarks::default() };
        assert_eq!(many.sentences(), ["12 triangles without an area were dropped."]);
    }

    #[test]
    fn colours_of_vertices_out_of_range_are_counted() {
        let mut remarks = Remarks::default();
        assert_eq!(remarks.vertex_colour([0.0, 1.0, 0.5]), [0.0, 1.0, 0.5]);
        assert_eq!(remarks, Remarks::default());
        assert_eq!(remarks.vertex_colour([-0.5, 1.25, 0.5]), [0.0, 1.0, 0.5]);
        assert_eq!(remarks.vertex_colour([f64::NAN, 0.25, f64::INFINITY]), [0.0, 0.25, 1.0]);
        assert_eq!((remarks.colours_clamped, remarks.colours_not_numbers, remarks.sentences().len()), (1, 1, 2));
        assert_eq!(remarks.vertex_colour([200.0, 99.5, 0.0]), [1.0, 1.0, 0.0]);
        assert!(remarks.sentences()[2].contains("go up to 200, as if they were bytes"), "{:?}", remarks.sentences());
    }

    #[test]
    fn what_is_not_read_is_named_up_to_a_point() {
        let mut remarks = Remarks::default();
        remarks.add_unread("nothing", 0);
        remarks.add_unread("cameras", 2);
        remarks.add_unread("skins\n", 1);
        remarks.add_unread("cameras", 1);
        assert_eq!(remarks.sentences(), ["Not read: cameras (3), skins\\n (1)."]);
        for number in 0..20 {
            remarks.add_unread(&format!("kind {number}"), 1);
        }
        assert_eq!(remarks.unread.len(), 16);
        assert!(remarks.sentences()[0].ends_with(", kind 13 (1), and 6 others."));
    }

    #[test]
    fn numbers_out_of_range_are_counted() {
        let mut remarks = Remarks::default();
        assert_eq!(remarks.clamp(0.5, 0.0, 1.0), 0.5);
        assert_eq!(remarks.clamp_colour([0.0, 1.0, 0.2], 1.0), [0.0, 1.0, 0.2]);
        assert_eq!(remarks.clamped, 0);
        assert_eq!(remarks.clamp(-0.5, 0.0, 1.0), 0.0);
        assert_eq!(remarks.clamp_colour([-1.0, 2.0, 0.2], 1.0), [0.0, 1.0, 0.2]);
        assert_eq!(remarks.clamped, 2);
    }
}
