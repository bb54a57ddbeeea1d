//! Where points of lights fall, against what their pdfs say; and numbers at their ends.

use super::*;
use pinhole::shapes::PlacedSphere;
use pinhole::shapes::emitter::triangle_solid_angle;
use std::f64::consts::TAU;

const RAYS: u32 = 30_000;
/// Bins a side, and parts of a bin a side.
const BINS: usize = 12;
const PARTS: usize = 24;

/// A patch of an emitter, as two coordinates from 0 to 1 name it, and the coordinates of a point.
struct Chart {
    place: Box<dyn Fn([f64; 2]) -> DVec3>,
    find: Box<dyn Fn(DVec3) -> [f64; 2]>,
}

fn charts() -> Vec<(&'static str, Emitter, Chart)> {
    let (centre, x, z) = (DVec3::new(0.2, 1.0, -0.1), DVec3::new(1.0, 0.2, 0.0), DVec3::Z * 0.6);
    let skew = DVec3::new(0.5, 0.1, 0.4);
    let parallelogram = |x: DVec3, z: DVec3| Chart {
        place: Box::new(move |[s, t]| centre + x * (2.0 * s - 1.0) + z * (2.0 * t - 1.0)),
        find: Box::new(move |at| in_axes(at - centre, x, z).map(|part| 0.5 + 0.5 * part)),
    };
    let round = |x: DVec3, z: DVec3| Chart {
        place: Box::new(move |[s, t]| {
            let (radius, turn) = (s.sqrt(), TAU * t);
            centre + x * (radius * libm::cos(turn)) + z * (radius * libm::sin(turn))
        }),
        find: Box::new(move |at| {
            let [a, b] = in_axes(at - centre, x, z);
            [a * a + b * b, libm::atan2(b, a).rem_euclid(TAU) / TAU]
        }),
    };
    let side = DVec3::NEG_Y;
    let [a, b, c] = [centre - x - z, centre + x * 2.0 - z, centre + z];
    let (of_triangle, to_b, to_c) = (a, b - a, c - a);
    vec![
        ("rectangle", rectangle(centre, [x, z], side), parallelogram(x, z)),
        ("parallelogram", rectangle(centre, [x, skew], side), parallelogram(x, skew)),
        ("disk", disk(centre, [x, z.normalize() * x.length()], side), round(x, z.normalize() * x.length())),
        ("ellipse", disk(centre, [x, skew], side), round(x, skew)),
        (
            "triangle",
            triangle([a, b, c]),
            Chart {
                place: Box::new(move |[s, t]| of_triangle + (to_b * (1.0 - t) + to_c * t) * s),
                find: Box::new(move |at| {
                    let [p, q] = in_axes(at - of_triangle, to_b, to_c);
                    [p + q, q / (p + q)]
                }),
            },
        ),
    ]
}

/// The two factors of a vector in the plane of two others.
fn in_axes(v: DVec3, x: DVec3, z: DVec3) -> [f64; 2] {
    let n = x.cross(z);
    [z.cross(n).dot(v) / z.cross(n).dot(x), n.cross(x).dot(v) / n.cross(x).dot(z)]
}

/// A histogram of points, bin by bin, against the pdf summed over each bin: χ², and all bins together hold 1.
#[test]
fn points_fall_as_their_pdfs_say() {
    let mut cases = 0;
    for (name, emitter, chart) in charts() {
        for (seed, from) in [
            DVec3::ZERO,
            DVec3::new(0.9, 0.9, 0.1),
            DVec3::new(1.4, 1.05, 0.0),
            DVec3::new(-2.0, 0.1, 3.0),
            DVec3::new(9.0, -12.0, 5.0),
        ]
        .into_iter()
        .enumerate()
        {
            let mut counts = vec![0.0; BINS * BINS];
            for number in 0..RAYS {
                let mut draws = Draws::new(seed as u64 + 100, u64::from(number));
                let point = point_on(&emitter, from, [draws.unit(), draws.unit()]);
                let [s, t] = (chart.find)(from + point.to).map(|part| ((part * BINS as f64) as usize).min(BINS - 1));
                counts[s * BINS + t] += 1.0;
            }
            let expected: Vec<f64> =
                (0..BINS * BINS).map(|bin| probability_of(&emitter, &chart, from, [bin / BINS, bin % BINS])).collect();
            let whole: f64 = expected.iter().sum();
            // Arcs are summed as straight edges, and a pdf with a steep end in steps.
            assert!((whole - 1.0).abs() < 6e-3, "{name} from {from}: pdfs sum to {whole}");
            let (mut chi, mut bins) = (0.0, 0);
            for (count, probability) in counts.iter().zip(&expected) {
                let expected = probability / whole * f64::from(RAYS);
                if expected >= 5.0 {
                    chi += (count - expected) * (count - expected) / expected;
                    bins += 1;
                }
            }
            let freedom = f64::from(bins - 1);
            let off = (chi - freedom) / (2.0 * freedom).sqrt();
            eprintln!("{name:13} from {from:?}: sum {whole:.5}, χ² {chi:.1} of {bins} bins ({off:+.2})");
            assert!(off < 5.0, "{name} from {from}: χ² {chi} over {bins} bins");
            cases += 1;
        }
    }
    eprintln!("pdfs: {cases} cases × {RAYS} points in {} bins", BINS * BINS);
}

/// The pdf summed over a bin: part by part, each the solid angle of its four corners.
fn probability_of(emitter: &Emitter, chart: &Chart, from: DVec3, bin: [usize; 2]) -> f64 {
    let size = 1.0 / (BINS * PARTS) as f64;
    let mut sum = 0.0;
    for part in 0..PARTS * PARTS {
        let [s, t] = [bin[0] * PARTS + part / PARTS, bin[1] * PARTS + part % PARTS].map(|at| at as f64 * size);
        let corner = |i: f64, j: f64| (chart.place)([s + i * size, t + j * size]) - from;
        let corners = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
        let angle = triangle_solid_angle(&[corners[0], corners[1], corners[2]])
            + triangle_solid_angle(&[corners[0], corners[2], corners[3]]);
        sum += angle * pdf_towards(emitter, from, from + corner(0.5, 0.5));
    }
    sum
}

/// Numbers at the ends of their range give points and pdfs that are numbers, on every light from everywhere.
#[test]
fn ends_of_the_unit_square_are_no_trouble() {
    let ends = [0.0, 1.0 / 16_777_216.0, 0.5, 1.0 - 1.0 / 16_777_216.0];
    let mut tried = 0;
    for index in 0..3000 {
        let mut draws = Draws::new(77, index);
        let mut vector = || draws.unit_vector() * draws.power_of_ten(-3.0, 3.0);
        let (centre, a, b, c, away) = (vector(), vector(), vector(), vector(), vector());
        let nearness = draws.power_of_ten(-7.0, 2.0);
        let lights = [
            Emitter::Sphere(PlacedSphere { centre, radius: a.length() }),
            rectangle(centre, [a, a.cross(b).normalize() * b.length()], away),
            rectangle(centre, [a, b], away),
            disk(centre, [a, a.cross(b).normalize() * a.length()], away),
            disk(centre, [a, b], away),
            triangle([centre, centre + a, centre + b]),
            cuboid(centre, [a, a.cross(b).normalize() * b.length(), a.cross(a.cross(b)).normalize() * c.length()]),
            cuboid(centre, [a, b, c]),
        ];
        for light in &lights {
            // Beside a point of the light, as near as may be.
            let on = point_on(light, away, [0.3, 0.6]).to + away;
            let from = on + draws.unit_vector() * (nearness * a.length());
            for u in ends.into_iter().flat_map(|u| ends.map(|v| [u, v])) {
                let point = point_on(light, from, u);
                let fine = point.to.is_finite() && point.pdf > 0.0;
                assert!(fine, "{index}: {light:?} from {from} at {u:?}: {point:?}");
                tried += 1;
            }
        }
    }
    eprintln!("ends: {tried} points, none without a pdf");
}

#[test]
fn from_its_own_face_nothing_of_a_cuboid_is_visible() {
    let light = cuboid(DVec3::ZERO, [DVec3::X, DVec3::Y, DVec3::Z]);
    let on_top = DVec3::new(0.2, 1.0, -0.3);
    assert_eq!(point_on(&light, on_top, [0.3, 0.6]), LightPoint::NONE);
    assert_eq!(pdf_towards(&light, on_top, DVec3::new(1.0, 0.1, 0.2)), 0.0);
}
