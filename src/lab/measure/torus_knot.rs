//! A displaced torus knot: a closed mesh of as many triangles as are asked for, none of them twice the same.

use glam::DVec3;
use pinhole::models::TriangleMesh;
use std::f64::consts::TAU;

/// The curve that the knot's tube follows; the tube's radius is never below [`MIN_RADIUS`].
#[must_use]
pub fn curve(u: f64) -> DVec3 {
    let across = 2.0 + libm::cos(3.0 * u);
    DVec3::new(across * libm::cos(2.0 * u), libm::sin(3.0 * u), across * libm::sin(2.0 * u))
}

/// A bound of the tube's radius from below: 0.45 (1 − 0.15 − 0.05).
pub const MIN_RADIUS: f64 = 0.36;

/// The derivative of the curve.
fn derivative(u: f64) -> DVec3 {
    let (across, changing) = (2.0 + libm::cos(3.0 * u), -3.0 * libm::sin(3.0 * u));
    let (cos, sin) = (libm::cos(2.0 * u), libm::sin(2.0 * u));
    DVec3::new(changing * cos - 2.0 * across * sin, 3.0 * libm::cos(3.0 * u), changing * sin + 2.0 * across * cos)
}

/// Steps along the knot and around its tube for some 10^(power/2) triangles, 2 · 12.8 a · a of them.
#[must_use]
pub fn steps_for(power: i32) -> [u32; 2] {
    let around = libm::round(libm::sqrt(libm::exp10(f64::from(power) / 2.0) / 25.6)).max(3.0);
    [libm::round(12.8 * around), around].map(|steps| steps as u32)
}

/// The (2, 3) torus knot of 2 · along · around triangles, its tube displaced by waves; scene (e) of the public
/// comparison scenes, where 800 × 64 and 2560 × 200 have 102,400 and 1,024,000 triangles.
#[must_use]
pub fn torus_knot(along: u32, around: u32) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for i in 0..along {
        let u = TAU * f64::from(i) / f64::from(along);
        let tangent = derivative(u).normalize();
        let binormal = tangent.cross(DVec3::Y).normalize();
        let normal = binormal.cross(tangent);
        for j in 0..around {
            let v = TAU * f64::from(j) / f64::from(around);
            let waves = 0.15 * libm::sin(24.0 * u) * libm::sin(5.0 * v);
            let ripples = 0.05 * libm::sin(97.0 * u) * libm::sin(13.0 * v);
            let radius = 0.45 * (1.0 + waves + ripples);
            let at = curve(u) + radius * (libm::cos(v) * normal + libm::sin(v) * binormal);
            mesh.positions.push(at.as_vec3().to_array());
        }
    }
    let vertex = |i: u32, j: u32| (i % along) * around + j % around;
    for (i, j) in (0..along).flat_map(|i| (0..around).map(move |j| (i, j))) {
        let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
        mesh.triangles.extend([[a, b, c], [a, c, d]]);
    }
    mesh
}
