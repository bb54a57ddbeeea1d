//! Whether a triangle covers a sample: in floating point with one comparison for all edges, and in whole numbers with the
//! top-left rule; what affine interpolation makes of a texture; and a depth buffer of few bits.

use glam::DVec2;
use pinhole::rasterise::is_top_left;

// ANCHOR: plain_area
/// Twice the area of the triangle from, to, point: positive where the point is to the right of the edge, with y down.
#[must_use]
pub fn area(from: DVec2, to: DVec2, point: DVec2) -> f64 {
    (to - from).perp_dot(point - from)
}
// ANCHOR_END: plain_area

// ANCHOR: naive_covers
/// Inside means to the right of all three edges; a sample on a common edge belongs to neither triangle: a crack.
#[must_use]
pub fn covers_strictly([a, b, c]: [DVec2; 3], point: DVec2) -> bool {
    area(a, b, point) > 0.0 && area(b, c, point) > 0.0 && area(c, a, point) > 0.0
}

/// Edges belong to the triangle; a sample on a common edge belongs to both.
#[must_use]
pub fn covers_loosely([a, b, c]: [DVec2; 3], point: DVec2) -> bool {
    area(a, b, point) >= 0.0 && area(b, c, point) >= 0.0 && area(c, a, point) >= 0.0
}
// ANCHOR_END: naive_covers

/// Whether a sample is inside an edge, all in steps of 1/256 of a pixel; on the edge, the top-left rule decides.
#[must_use]
pub fn is_inside_edge(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
    let [along, off] = [0, 1].map(|axis| [to, sample].map(|end| i64::from(end[axis]) - i64::from(from[axis])));
    let area = along[0] * off[1] - off[0] * along[1];
    area > 0 || (area == 0 && is_top_left(from, to))
}

/// Whether a sample is inside a triangle, all in steps of 1/256 of a pixel.
#[must_use]
pub fn covers([a, b, c]: [[i32; 2]; 3], sample: [i32; 2]) -> bool {
    is_inside_edge(a, b, sample) && is_inside_edge(b, c, sample) && is_inside_edge(c, a, sample)
}

// ANCHOR: barycentric
/// The weights of the corners at a point of the image: the areas opposite to them, as parts of the whole.
#[must_use]
pub fn weights([a, b, c]: [DVec2; 3], point: DVec2) -> [f64; 3] {
    let areas = [area(b, c, point), area(c, a, point), area(a, b, point)];
    areas.map(|part| part / area(a, b, c))
}

/// What a texture coordinate is there if it is taken for linear on the image: wrong but for an orthographic camera.
#[must_use]
pub fn affine(weights: [f64; 3], at_corners: [f64; 3]) -> f64 {
    (0..3).map(|corner| weights[corner] * at_corners[corner]).sum()
}

/// What it is: linear on the image are u/z and 1/z.
#[must_use]
pub fn perspective_correct(weights: [f64; 3], at_corners: [f64; 3], depths: [f64; 3]) -> f64 {
    let divided = |numbers: [f64; 3]| [0, 1, 2].map(|corner| numbers[corner] / depths[corner]);
    affine(weights, divided(at_corners)) / affine(weights, divided([1.0; 3]))
}
// ANCHOR_END: barycentric

// ANCHOR: depth_of_bits
/// A depth as a depth buffer of so many bits holds it: 1/z from 0, far away, to the largest number at the near plane.
#[must_use]
pub fn depth_of_bits(depth: f64, near: f64, bits: u32) -> u64 {
    ((near / depth).min(1.0) * ((1_u64 << bits) - 1) as f64).round() as u64
}
// ANCHOR_END: depth_of_bits

#[cfg(test)]
mod tests {
    use super::*;
    use pinhole::rasterise::{Edge, SUBPIXELS, edge_function};
    use pinhole::sample::{Purpose, uniform};

    /// A number from 0 to 1 that the arguments determine.
    fn unit(index: u32, number: u32) -> f64 {
        uniform(33, [index, 0], number, Purpose::Direction)
    }

    /// A square of two triangles that have the diagonal in common.
    const SQUARE: [[[i32; 2]; 3]; 2] = [[[0, 0], [1024, 0], [1024, 1024]], [[0, 0], [1024, 1024], [0, 1024]]];

    #[test]
    fn a_sample_on_the_diagonal_is_in_none_in_both_or_in_one() {
        let samples: Vec<[i32; 2]> = (0..4).map(|step| [128 + 256 * step; 2]).collect();
        let count = |covers: &dyn Fn([[i32; 2]; 3], [i32; 2]) -> bool| {
            let counts =
                samples.iter().map(|&sample| SQUARE.iter().filter(|&&corners| covers(corners, sample)).count());
            counts.collect::<Vec<_>>()
        };
        let float = |corners: [[i32; 2]; 3]| corners.map(|corner| DVec2::from(corner.map(f64::from)));
        let point = |sample: [i32; 2]| DVec2::from(sample.map(f64::from));
        assert_eq!(count(&|corners, sample| covers_strictly(float(corners), point(sample))), [0; 4]);
        assert_eq!(count(&|corners, sample| covers_loosely(float(corners), point(sample))), [2; 4]);
        assert_eq!(count(&covers), [1; 4]);
    }

    #[test]
    fn plain_edges_are_the_renderer_s() {
        for index in 0..3000 {
            // Small numbers, so that many samples lie on edges.
            let drawn = |number: u32| (unit(index, number) * 9.0 - 4.0).floor() as i32;
            let [from, to, sample] = [0, 2, 4].map(|number| [drawn(number), drawn(number + 1)]);
            let edge = Edge::new(from, to, [0, 0]).at(f64::from(sample[0]), f64::from(sample[1]));
            assert_eq!(is_inside_edge(from, to, sample), edge >= 0.0, "{from:?} {to:?} {sample:?}");
        }
    }

    /// Around a vertex, every sample near it is in one triangle of the fan, wherever vertex and samples lie.
    #[test]
    fn each_sample_of_a_fan_is_in_one_triangle() {
        for index in 0..200 {
            // Enough spokes that the rim is farther out than any sample.
            let spokes = 5 + (unit(index, 0) * 4.0) as usize;
            let rim: Vec<[i32; 2]> = (0..spokes)
                .map(|spoke| {
                    let turn =
                        (spoke as f64 + 0.8 * unit(index, spoke as u32 + 1)) / spokes as f64 * std::f64::consts::TAU;
                    [libm::cos(turn), libm::sin(turn)].map(|part| (part * 20.0).round() as i32)
                })
                .collect();
            let fan: Vec<[[i32; 2]; 3]> = (0..spokes).map(|at| [[0, 0], rim[at], rim[(at + 1) % spokes]]).collect();
            let right = fan.iter().all(|[a, b, c]| edge_function(*a, *b, *c) > 0);
            for sample in (-4..=4).flat_map(|x| (-4..=4).map(move |y| [x, y])).filter(|_| right) {
                assert_eq!(fan.iter().filter(|&&corners| covers(corners, sample)).count(), 1, "{sample:?} {fan:?}");
            }
        }
    }

    #[test]
    fn the_page_s_numbers() {
        let corners = [DVec2::ZERO, DVec2::new(4.0, 0.0), DVec2::new(0.0, 4.0)];
        let at = DVec2::new(2.0, 1.0);
        assert_eq!(weights(corners, at), [0.25, 0.5, 0.25]);
        assert_eq!(affine([0.5, 0.5, 0.0], [0.0, 1.0, 0.0]), 0.5);
        let right = perspective_correct([0.5, 0.5, 0.0], [0.0, 1.0, 0.0], [2.0, 10.0, 1.0]);
        assert!((right - 1.0 / 6.0).abs() < 1e-15);
        assert_eq!((depth_of_bits(5.0, 0.1, 12), depth_of_bits(5.05, 0.1, 12)), (82, 81));
        assert_eq!((depth_of_bits(5.0, 0.1, 12), depth_of_bits(5.02, 0.1, 12)), (82, 82));
        assert_eq!(SUBPIXELS, 256.0);
    }
}
