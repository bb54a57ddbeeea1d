//! What lights send to a surface, against formulae.

use super::*;
use pinhole::shapes::PlacedSphere;
use pinhole::shapes::emitter::{
    parallelogram_area_pdf, parallelogram_area_point, triangle_area_pdf, triangle_area_point,
};
use std::f64::consts::{FRAC_PI_2, PI};

/// Rays a case: the spread is at most as large as the mean nearly everywhere, so that 0.6 % are one standard error.
const RAYS: u32 = 25_000;

/// Asserts that a case is within four standard errors of the truth, and its standard error at most 1 % of it.
fn check(name: &str, received: &Received, truth: f64) {
    let off = received.off(truth);
    assert!(off.abs() <= 4.0, "{name}: {} for {truth}, {off:.2} standard errors off", received.mean);
    assert!(received.error() <= 0.01 * truth, "{name}: the error is {} of {truth}", received.error());
    assert!(received.mismatch < 1e-9, "{name}: a pdf differs from itself by {}", received.mismatch);
}

#[test]
fn spheres_of_any_size_shine_as_they_should() {
    let (mut cases, mut worst) = (0, 0.0_f64);
    for power in 0..=24 {
        let ratio = libm::exp10(-f64::from(power) / 4.0) * (1.0 - 1e-9);
        for angle in [0.0, 0.4, 1.0, 1.4] {
            // Wholly above the horizon, where the law is exact.
            if libm::asin(ratio) + angle > FRAC_PI_2 {
                continue;
            }
            let mut draws = Draws::new(11, cases);
            let normal = draws.unit_vector();
            let across = draws.unit_vector_across(normal);
            let centre = (normal * libm::cos(angle) + across * libm::sin(angle)) * 3.0;
            let emitter = Emitter::Sphere(PlacedSphere { centre, radius: 3.0 * ratio });
            let received = Received::of(&emitter, DVec3::ZERO, normal, RAYS, cases);
            let truth = PI * ratio * ratio * libm::cos(angle);
            check(&format!("sphere {ratio:e} at {angle}"), &received, truth);
            worst = worst.max(received.off(truth).abs());
            cases += 1;
        }
    }
    eprintln!("spheres: {cases} sizes and angles from 1 to 1e-6 × {RAYS} rays, worst {worst:.2} standard errors");
}

/// A sphere that touches the surface fills all of its sky: E = πL, and the same from inside a sphere.
#[test]
fn a_touching_sphere_fills_the_sky() {
    for (name, height) in [("touching", 1.0 + 1e-12), ("inside", 0.3), ("at the wall", 1.0 - 1e-12)] {
        let emitter = Emitter::Sphere(PlacedSphere { centre: DVec3::Y * height, radius: 1.0 });
        let received = Received::of(&emitter, DVec3::ZERO, DVec3::Y, 2 * RAYS, 5);
        check(name, &received, PI);
    }
    eprintln!("spheres: 3 that fill the sky × {} rays", 2 * RAYS);
}

#[test]
fn rectangles_and_triangles_shine_as_lambert_says() {
    let (mut cases, mut worst, mut widest) = (0, 0.0_f64, 0.0_f64);
    let (up, x, z) = (DVec3::Y, DVec3::X, DVec3::Z);
    for height in [10.0, 1.0, 0.1, 0.01, 1e-3, 1e-5] {
        for aside in [0.0, 0.5, 0.99, 1.001, 1.1, 3.0] {
            for depth in [0.5, 0.01] {
                let centre = up * height;
                let whole = rectangle(centre, [x, z * depth], -up);
                let skew = rectangle(centre, [x, x * 0.3 + z * depth], -up);
                let half = triangle([centre - x, centre + x, centre + z * depth]);
                for emitter in [whole, skew, half] {
                    let from = x * aside + z * (0.1 * depth);
                    let received = Received::of(&emitter, from, up, RAYS, cases);
                    let truth = polygon_irradiance(&corners_of(&emitter), from, up);
                    // The formula itself loses its digits where light comes in along the surface.
                    if truth < 1e-9 {
                        continue;
                    }
                    check(&format!("{emitter:?} from {from}"), &received, truth);
                    worst = worst.max(received.off(truth).abs());
                    if truth > 0.1 {
                        widest = widest.max(received.deviation / truth);
                    }
                    cases += 1;
                }
            }
        }
    }
    eprintln!(
        "polygons: {cases} cases × {RAYS} rays, worst {worst:.2} standard errors; deviation over mean ≤ {widest:.3}"
    );
    assert!(widest <= 1.0);
}

/// By points spread evenly over the area, as lights far away are sampled; near ones too are right, with more spread.
#[test]
fn areas_shine_as_lambert_says() {
    let (mut cases, mut worst) = (0, 0.0_f64);
    let (up, x, z) = (DVec3::Y, DVec3::X, DVec3::Z);
    for height in [30.0, 5.0, 1.0, 0.5] {
        for aside in [0.0, 0.5, 1.1, 3.0] {
            let (centre, from) = (up * height, x * aside + z * 0.1);
            let Emitter::Rectangle(planar) = rectangle(centre, [x, x * 0.3 + z * 0.5], -up) else { unreachable!() };
            let corners = [centre - x, centre + x, centre + z * 0.7];
            let by_area = Received::by(
                &|u| parallelogram_area_point(&planar, from, u),
                &|to| parallelogram_area_pdf(&planar, to),
                up,
                4 * RAYS,
                cases,
            );
            let truth = polygon_irradiance(&corners_of(&Emitter::Rectangle(planar)), from, up);
            check(&format!("rectangle {height} above, {aside} aside"), &by_area, truth);
            worst = worst.max(by_area.off(truth).abs());
            let by_area = Received::by(
                &|u| triangle_area_point(&corners, from, u),
                &|to| triangle_area_pdf(&corners, to),
                up,
                4 * RAYS,
                cases,
            );
            let truth = polygon_irradiance(&corners, from, up);
            check(&format!("triangle {height} above, {aside} aside"), &by_area, truth);
            worst = worst.max(by_area.off(truth).abs());
            cases += 2;
        }
    }
    eprintln!("by area: {cases} cases × {} rays, worst {worst:.2} standard errors", 4 * RAYS);
}

/// Parallel to the surface, `aside` from the axis: half of 1 − (a² + h² − r²) / √((a² + h² + r²)² − 4a²r²), times π.
fn disk_irradiance(height: f64, aside: f64) -> f64 {
    let (hh, aa) = (height * height, aside * aside);
    let root = ((aa + hh + 1.0) * (aa + hh + 1.0) - 4.0 * aa).sqrt();
    // Where the difference would lose its digits, 2h²·2 / … in its place: (root + s)(root − s) = 4h².
    let s = aa + hh - 1.0;
    if s > 0.0 { 2.0 * PI * hh / (root * (root + s)) } else { FRAC_PI_2 * (1.0 - s / root) }
}

#[test]
fn disks_shine_as_they_should_on_and_off_their_axis() {
    let (mut cases, mut worst, mut widest) = (0, 0.0_f64, 0.0_f64);
    for height in [30.0, 3.0, 1.0, 0.1, 0.01, 1e-3, 1e-5] {
        for aside in [0.0, 0.5, 0.9, 0.99, 0.999, 1.001, 1.01, 1.1, 1.41, 2.0, 2.99, 3.5] {
            let turn = 1.1_f64;
            let from = DVec3::new(aside * libm::cos(turn), 0.0, aside * libm::sin(turn));
            let emitter = disk(DVec3::Y * height, [DVec3::X, DVec3::Z], DVec3::NEG_Y);
            let received = Received::of(&emitter, from, DVec3::Y, RAYS, cases);
            let truth = disk_irradiance(height, aside);
            check(&format!("disk {height} from {aside}"), &received, truth);
            worst = worst.max(received.off(truth).abs());
            widest = widest.max(received.deviation / truth);
            cases += 1;
        }
    }
    eprintln!(
        "disks: {cases} cases × {RAYS} rays, worst {worst:.2} standard errors; deviation over mean ≤ {widest:.3}"
    );
    assert!(widest <= 1.0);
}

/// The faces of a cuboid that can be seen, cut at the horizon, as polygons.
#[test]
fn cuboids_shine_as_their_faces_do() {
    let (mut cases, mut worst) = (0, 0.0_f64);
    for lean in [0.0, 0.4] {
        let half_edges = [DVec3::X * 0.5, DVec3::new(lean, 0.5, 0.0), DVec3::Z * 0.7];
        let emitter = cuboid(DVec3::ZERO, half_edges);
        let Emitter::Cuboid(faces) = emitter else { unreachable!() };
        for from in [[0.0, -1.0, 0.0], [2.0, -0.7, 1.0], [0.1, -0.501, 0.2], [30.0, -80.0, 10.0], [0.1, 0.1, 0.2]] {
            let from = DVec3::from(from);
            let mut truth = 0.0;
            for (axis, sign) in (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
                let out = faces.half_edges[axis] * sign;
                if !faces.contains(from) && (faces.normals[axis] * sign).dot(from - out) <= 0.0 {
                    continue;
                }
                let [a, b] = [1, 2].map(|next| faces.half_edges[(axis + next) % 3]);
                truth += polygon_irradiance(
                    &above(&[out - a - b, out + a - b, out + a + b, out - a + b], from.y),
                    from,
                    DVec3::Y,
                );
            }
            let received = Received::of(&emitter, from, DVec3::Y, RAYS, cases);
            check(&format!("cuboid {lean} from {from}"), &received, truth);
            worst = worst.max(received.off(truth).abs());
            cases += 1;
        }
    }
    eprintln!("cuboids: {cases} cases × {RAYS} rays, worst {worst:.2} standard errors");
}

/// The part of a polygon above a height.
fn above(corners: &[DVec3], height: f64) -> Vec<DVec3> {
    let mut kept = Vec::new();
    for (i, &corner) in corners.iter().enumerate() {
        let next = corners[(i + 1) % corners.len()];
        let [here, there] = [corner.y - height, next.y - height];
        if here >= 0.0 {
            kept.push(corner);
        }
        if (here > 0.0) != (there > 0.0) && here != there {
            kept.push(corner + (next - corner) * (here / (here - there)));
        }
    }
    kept
}
