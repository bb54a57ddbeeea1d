//! Whether triangles enclose an interior.

use super::TriangleTable;
use glam::DVec3;
use std::collections::HashMap;

/// Corners nearer to one another than this fraction of the mesh's extent may be one corner that rounding has moved.
const ONE_CORNER: f64 = 1e-9;
/// How many corners after it, in order of x, are compared with each corner.
const COMPARED: usize = 256;

/// Why triangles have no interior.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct OpenMesh {
    /// The row of the first triangle with such an edge.
    pub row: usize,
    /// Whether its neighbour is there, but shows the other side.
    pub turned: bool,
}

/// A corner of some triangle, by its bits.
type Corner = [u64; 3];
/// An edge, its smaller corner first.
type Edge = [Corner; 2];

/// The first of these rows that has an edge without a neighbour; none if every edge is passed as often in one direction
/// as in the other, as it is on a closed surface whose triangles all show the same side.
pub(super) fn open_mesh(triangles: &TriangleTable, rows: &[usize]) -> Option<OpenMesh> {
    let mut unmatched = sums(triangles, rows, &|corner| corner);
    unmatched.retain(|_, (sum, _)| *sum != 0);
    if unmatched.is_empty() {
        return None;
    }
    let joined = joined(triangles, rows, unmatched.keys().flatten().copied().collect());
    let sums = sums(triangles, rows, &|corner| joined.get(&corner).copied().unwrap_or(corner));
    let open = sums.values().filter(|(sum, _)| *sum != 0).min_by_key(|(_, (row, _))| *row);
    open.map(|&(_, (row, count))| OpenMesh { row, turned: count > 1 })
}

/// For each edge how often it is passed from its smaller corner to its greater minus how often back, the first row that
/// has it, and the number of triangles that have it.
fn sums(
    triangles: &TriangleTable,
    rows: &[usize],
    joined: &dyn Fn(Corner) -> Corner,
) -> HashMap<Edge, (i64, (usize, usize))> {
    let mut sums = HashMap::new();
    for &row in rows {
        let corners = triangles.row[row].corners.map(|corner| joined(bits(corner)));
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            let [from, to] = [corners[from], corners[to]];
            let step = if (from < to) == triangles.surface_data[row].turned { -1 } else { 1 };
            if from != to {
                let (sum, (_, count)) = sums.entry([from.min(to), from.max(to)]).or_insert((0, (row, 0)));
                *sum += step;
                *count += 1;
            }
        }
    }
    sums
}

fn bits(corner: DVec3) -> Corner {
    // −0 and 0 are one place.
    corner.to_array().map(|part| (part + 0.0).to_bits())
}

/// For each of these corners the one that stands for all that may be the same.
fn joined(triangles: &TriangleTable, rows: &[usize], corners: Vec<Corner>) -> HashMap<Corner, Corner> {
    let all = || rows.iter().flat_map(|&row| triangles.row[row].corners);
    let (min, max) = all().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(min, max), at| (min.min(at), max.max(at)));
    let apart = ONE_CORNER * (max - min).max_element();
    let mut sorted: Vec<DVec3> = corners.into_iter().map(|corner| DVec3::from(corner.map(f64::from_bits))).collect();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z)));
    sorted.dedup();
    let mut joined = HashMap::new();
    for (number, &corner) in sorted.iter().enumerate() {
        let own = *joined.entry(bits(corner)).or_insert(bits(corner));
        let near = sorted[number + 1..].iter().take(COMPARED).take_while(|other| other.x - corner.x <= apart);
        for &other in near.filter(|other| (**other - corner).abs().max_element() <= apart) {
            joined.entry(bits(other)).or_insert(own);
        }
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::ray_aim::Draws;
    use crate::shapes::TriangleFace;
    use glam::{DQuat, DVec2};

    /// The corners of a platonic solid's triangles, anticlockwise from outside.
    fn solids() -> [(&'static str, Vec<[DVec3; 3]>); 3] {
        let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z];
        let facing =
            |[a, b, c]: [DVec3; 3]| if (b - a).cross(c - a).dot(a + b + c) > 0.0 { [a, b, c] } else { [a, c, b] };
        let corners = [x + y + z, x - y - z, y - x - z, z - x - y];
        let tetrahedron = (0..4).map(|left| {
            let [a, b, c] = [1, 2, 3].map(|step| corners[(left + step) % 4]);
            facing([a, b, c])
        });
        let octahedron = (0..8).map(|octant: u32| {
            let side = |bit: u32| if octant >> bit & 1 == 0 { 1.0 } else { -1.0 };
            facing([x * side(0), y * side(1), z * side(2)])
        });
        let cube = [x, y, z].into_iter().flat_map(|axis| [axis, -axis]).flat_map(|out| {
            let (u, v) = (DVec3::new(out.y, out.z, out.x), DVec3::new(out.z, out.x, out.y));
            [[out + u + v, out - u + v, out - u - v], [out + u + v, out - u - v, out + u - v]].map(facing)
        });
        [("tetrahedron", tetrahedron.collect()), ("octahedron", octahedron.collect()), ("cube", cube.collect())]
    }

    fn table(triangles: &[[DVec3; 3]]) -> (TriangleTable, Vec<usize>) {
        let mut table = TriangleTable::default();
        for corners in triangles {
            let (row, face) = TriangleFace::of(*corners, [DVec2::ZERO, DVec2::X, DVec2::Y]);
            table.row.push(row);
            table.surface_data.push(face);
            table.shape.push(0);
        }
        (table, (0..triangles.len()).collect())
    }

    /// Solids as they are, one of their triangles missing, one turned round, all turned round, and corners that rounding
    /// has moved.
    #[test]
    fn solids_are_closed_and_no_part_of_them_is() {
        let (mut closed, mut open) = (0, 0);
        for (name, solid) in solids() {
            for index in 0..20 {
                let mut draws = Draws::new(27, index);
                let turn = DQuat::from_vec4(draws.unit_vector().extend(draws.between(-1.0, 1.0))).normalize();
                let (size, place) = (draws.power_of_ten(-6.0, 6.0), draws.unit_vector() * 3.0);
                let solid: Vec<_> = solid.iter().map(|corners| corners.map(|at| size * (turn * at + place))).collect();
                let found = |triangles: &[[DVec3; 3]]| {
                    let (table, rows) = table(triangles);
                    open_mesh(&table, &rows)
                };
                assert_eq!(found(&solid), None, "{name}");
                let turned: Vec<_> = solid.iter().map(|&[a, b, c]| [a, c, b]).collect();
                assert_eq!(found(&turned), None, "{name} inside out");
                let shaken: Vec<_> =
                    solid.iter().map(|at| at.map(|at| at + 1e-15 * size * draws.unit_vector())).collect();
                assert_eq!(found(&shaken), None, "{name} with rounded corners");
                closed += 3;
                for missing in 0..solid.len() {
                    let mut holed = solid.clone();
                    holed.remove(missing);
                    assert!(found(&holed).is_some_and(|open| !open.turned), "{name} without {missing}");
                    let mut wrong = solid.clone();
                    wrong[missing].swap(0, 1);
                    assert!(found(&wrong).is_some_and(|open| open.turned), "{name} with {missing} turned");
                    open += 2;
                }
            }
        }
        eprintln!("meshes: {closed} closed, {open} open or with a triangle turned round");
    }
}
