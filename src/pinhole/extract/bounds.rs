//! The axis-aligned bounding box of each finite shape.

use super::{Ellipsoid, Planar, Slabs};
use glam::DVec3;

/// An axis-aligned box that contains a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The corner of minimum x, y and z.
    pub least: DVec3,
    /// The corner of maximum x, y and z.
    pub most: DVec3,
}

impl Bounds {
    /// A box with this half size about a centre, enlarged by more than rounding can have lost: by 2⁻²⁴ of the largest
    /// extent, which holds for shapes up to ten million times as long as they are thick, and by 2⁻⁵⁰ of the position.
    fn about(centre: DVec3, half_size: DVec3) -> Self {
        const OF_SIZE: f64 = 1.0 / (1_u64 << 24) as f64;
        const OF_POSITION: f64 = 1.0 / (1_u64 << 50) as f64;
        let half_size =
            half_size + DVec3::splat(half_size.max_element() * OF_SIZE) + (centre.abs() + half_size) * OF_POSITION;
        Self { least: centre - half_size, most: centre + half_size }
    }

    /// Whether two boxes have a point in common.
    pub fn overlaps(&self, other: &Self) -> bool {
        !(other.most.cmplt(self.least) | self.most.cmplt(other.least)).any()
    }

    /// The box of a sphere.
    pub fn of_sphere(centre: DVec3, radius: f64) -> Self {
        Self::about(centre, DVec3::splat(radius))
    }

    /// The box of an ellipsoid: its extent along an axis is the length of that row of the map from the unit sphere.
    pub fn of_ellipsoid(ellipsoid: &Ellipsoid) -> Self {
        let world_from_unit = ellipsoid.unit_from_world.inverse();
        Self::about(ellipsoid.centre, DVec3::from([0, 1, 2].map(|axis| world_from_unit.row(axis).length())))
    }

    /// The box of a disk: the maximum of x cos φ + z sin φ for its two half edges is √(x² + z²), component by
    /// component.
    pub fn of_disk(planar: &Planar) -> Self {
        let [x, z] = planar.half_edges();
        Self::about(planar.centre, DVec3::from([0, 1, 2].map(|axis| (x[axis] * x[axis] + z[axis] * z[axis]).sqrt())))
    }

    /// The box of a rectangle.
    pub fn of_rectangle(planar: &Planar) -> Self {
        let [x, z] = planar.half_edges();
        Self::about(planar.centre, x.abs() + z.abs())
    }

    /// The box of a cuboid.
    pub fn of_cuboid(slabs: &Slabs) -> Self {
        let [x, y, z] = slabs.half_edges();
        Self::about(slabs.centre, x.abs() + y.abs() + z.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::cuboid_aim::{Eye, Spot, cuboid_shot};
    use crate::measure::planar_aim::{At, View, planar_shot};
    use crate::measure::ray_aim::Draws;
    use glam::DMat3;

    const POINTS: u64 = 10_000;
    const SHAPES: u64 = 12;

    /// Every point is inside the box, and on all six sides some points come within this fraction of the box's size.
    fn contains(bounds: Bounds, fraction: f64, point: impl Fn(&mut Draws) -> DVec3) {
        let mut draws = Draws::new(71, 0);
        let (mut least, mut most) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for _ in 0..POINTS {
            let point = point(&mut draws);
            (least, most) = (least.min(point), most.max(point));
        }
        let size = (bounds.most - bounds.least).max_element();
        assert!(least.cmpge(bounds.least).all() && most.cmple(bounds.most).all(), "{bounds:?}: {least} {most}");
        let loose = (least - bounds.least).max_element().max((bounds.most - most).max_element());
        assert!(loose <= fraction * size, "{bounds:?} is loose by {loose}");
    }

    fn sign(draws: &mut Draws) -> f64 {
        if draws.unit() < 0.5 { 1.0 } else { -1.0 }
    }

    #[test]
    fn every_point_of_a_surface_lies_within_and_all_six_sides_are_neared() {
        for index in 0..SHAPES {
            let view = View { seed: 72, at: At::Inside, sizes: 4.0, flattest: 1.0, away: [0.0, 3.0], from_eye: false };
            let (_, planar) = planar_shot(view, index);
            let [x, z] = planar.half_edges();
            contains(Bounds::of_disk(&planar), 0.01, |draws| {
                let angle = draws.between(0.0, std::f64::consts::TAU);
                planar.centre + x * libm::cos(angle) + z * libm::sin(angle)
            });
            // Rectangles and cuboids have corners, which the samples hit exactly.
            contains(Bounds::of_rectangle(&planar), 1e-6, |draws| planar.centre + x * sign(draws) + z * sign(draws));
            let (_, slabs) = cuboid_shot(73, index, Spot::Face, Eye::Anywhere, 4.0, 3.0);
            let [x, y, z] = slabs.half_edges();
            contains(Bounds::of_cuboid(&slabs), 1e-6, |draws| {
                slabs.centre + x * sign(draws) + y * sign(draws) + z * sign(draws)
            });
            let edges = DMat3::from_cols(x, y, z);
            let longest = x.length() + y.length() + z.length();
            let ellipsoid = Ellipsoid::new(slabs.centre, edges.inverse(), longest);
            contains(Bounds::of_ellipsoid(&ellipsoid), 0.02, |draws| slabs.centre + edges * draws.unit_vector());
            contains(Bounds::of_sphere(planar.centre, 2.0), 0.02, |draws| planar.centre + draws.unit_vector() * 2.0);
        }
        eprintln!("bounds: {SHAPES} shapes of 5 kinds, {POINTS} points each, all inside");
    }
}
