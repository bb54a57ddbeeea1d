//! The model of this part: a seashell, made by a formula instead of a file.
//!
//! A shell grows at its mouth and keeps its form, so each whorl is the one before it, larger by one factor: an ellipse
//! swept along a logarithmic spiral (D. M. Raup, "Geometric analysis of shell coiling", Journal of Paleontology 40, 1966).
#![allow(dead_code, reason = "several chapters include this file, and not each uses all of it")]

use glam::{DVec2, DVec3};
use pinhole::models::TriangleMesh;
use pinhole::scene::MeshGeometry;
use std::f64::consts::TAU;

/// How a shell coils; lengths are in units of the distance from the axis to the middle of the mouth.
#[derive(Clone, Copy, Debug)]
pub struct Coil {
    /// Whorls from the apex to the mouth.
    pub whorls: f64,
    /// The factor by which a whorl is larger than the one before: Raup's W.
    pub expansion: f64,
    /// How far the middle of the mouth lies below the point that the spiral shrinks to: Raup's T.
    pub translation: f64,
    /// The half axes of the mouth: away from the axis, and along it.
    pub mouth: [f64; 2],
    /// The angle by which the mouth leans outwards, in radians.
    pub lean: f64,
    /// Ribs a whorl, and how far they stand out as a fraction of the mouth's half axes.
    pub ribs: (f64, f64),
}

/// A slender shell with high ribs, such as a wentletrap.
pub const TOWER: Coil =
    Coil { whorls: 7.0, expansion: 1.45, translation: 4.4, mouth: [0.8, 0.86], lean: 0.3, ribs: (10.0, 0.22) };

/// A wide shell with a low spire, such as a moon snail.
pub const MOON: Coil =
    Coil { whorls: 4.5, expansion: 2.0, translation: 2.2, mouth: [0.95, 1.1], lean: 0.35, ribs: (18.0, 0.04) };

/// The turn of the wall inside the mouth, back from the lip, in radians.
const INSIDE: f64 = 0.55 * TAU;
/// The half axes inside the mouth, as a fraction of those outside.
const HOLLOW: f64 = 0.88;

/// A slender seashell of 2 · `along` · `around` triangles, 2 units high, its apex up and the origin at its middle.
pub fn seashell(along: u32, around: u32) -> MeshGeometry {
    coiled(&TOWER, along, around)
}

// ANCHOR: coiled
/// A shell of 2 · `along` · `around` triangles, its apex up and the origin at its middle: `along` + 1 rings of `around`
/// vertices from the apex to the lip and back inside, each joined to the next.
pub fn coiled(coil: &Coil, along: u32, around: u32) -> MeshGeometry {
    let (along, around) = (along.max(4), around.max(3));
    let mut mesh = TriangleMesh::default();
    let (mut normals, mut uvs) = (Vec::new(), Vec::new());
    for ring in 0..=along {
        let place = f64::from(ring) / f64::from(along);
        // The last vertex of a ring lies where the first does, with the other end of the texture.
        for side in 0..=around {
            let turn = TAU * f64::from(side % around) / f64::from(around);
            mesh.positions.push(coil.point(place, turn).as_vec3().to_array());
            normals.push(coil.normal(place, turn).as_vec3().to_array());
            uvs.push([f64::from(side) / f64::from(around), place].map(|part| part as f32));
        }
    }
    let vertex = |ring: u32, side: u32| ring * (around + 1) + side;
    for (ring, side) in (0..along).flat_map(|ring| (0..around).map(move |side| (ring, side))) {
        let [a, b] = [vertex(ring, side), vertex(ring, side + 1)];
        let [c, d] = [vertex(ring + 1, side), vertex(ring + 1, side + 1)];
        mesh.triangles.extend([[a, b, c], [b, d, c]]);
    }
    // A fan across the first ring, at the apex, and one across the last, deep inside: the surface is closed.
    for side in 1..around - 1 {
        mesh.triangles.push([vertex(0, 0), vertex(0, side + 1), vertex(0, side)]);
        mesh.triangles.push([vertex(along, 0), vertex(along, side), vertex(along, side + 1)]);
    }
    MeshGeometry::new(TriangleMesh { normals: Some(normals), uvs: Some(uvs), ..mesh })
}
// ANCHOR_END: coiled

impl Coil {
    // ANCHOR: point
    /// The point of the surface at a place between the apex (0) and the end inside the mouth (1), and at an angle about
    /// the tube, in radians.
    fn point(&self, place: f64, turn: f64) -> DVec3 {
        let (theta, wall) = self.wall(place);
        let grown = libm::exp(libm::log(self.expansion) * theta / TAU);
        let (count, height) = self.ribs;
        let rib = libm::pow(0.5 + 0.5 * libm::cos(count * theta), 3.0);
        let radius = wall * (1.0 + height * rib * (wall - HOLLOW) / (1.0 - HOLLOW));
        let on_ellipse = DVec2::new(self.mouth[0] * libm::cos(turn), self.mouth[1] * libm::sin(turn)) * radius;
        let leaning = DVec2::new(libm::cos(self.lean), libm::sin(self.lean)).rotate(on_ellipse);
        let (out, up) = (1.0 + leaning.x, leaning.y - self.translation);
        let (cosine, sine) = (libm::cos(theta), libm::sin(theta));
        (DVec3::new(out * cosine, up, out * sine) * grown + DVec3::Y * self.middle()) * (1.0 / self.middle())
    }
    // ANCHOR_END: point

    /// The angle about the axis, 0 at the lip, and the part of the mouth's half axes there.
    fn wall(&self, place: f64) -> (f64, f64) {
        let outside = self.whorls * TAU;
        // Outside, round the lip, and back inside; the lip gets as many rings as a tenth of a whorl.
        let lip = 0.1 * TAU;
        let length = place * (outside + lip + INSIDE);
        if length <= outside {
            (length - outside, 1.0)
        } else if length <= outside + lip {
            let round = (length - outside) / lip * std::f64::consts::PI;
            (0.06 * libm::sin(round), 0.5 * (1.0 + HOLLOW) + 0.5 * (1.0 - HOLLOW) * libm::cos(round))
        } else {
            (outside + lip - length, HOLLOW)
        }
    }

    /// Half the height from the lowest point of the mouth to the apex.
    fn middle(&self) -> f64 {
        0.5 * (self.translation + self.mouth[1])
    }

    /// The unit normal of the surface: across the two directions in which a point moves with its parameters.
    fn normal(&self, place: f64, turn: f64) -> DVec3 {
        let step = 1e-6;
        // At the ends there is a point on one side only.
        let [before, after] = [(place - step).max(0.0), (place + step).min(1.0)];
        let along = self.point(after, turn) - self.point(before, turn);
        let about = self.point(place, turn + step) - self.point(place, turn - step);
        about.cross(along).normalize_or_zero()
    }
}
