//! The box along the world's axes about each shape that ends somewhere.

use super::{Ellipsoid, Planar, Slabs};
use glam::DVec3;

/// A box along the axes that a shape lies within.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The corner of least x, y and z.
    pub least: DVec3,
    /// The corner of most x, y and z.
    pub most: DVec3,
}

impl Bounds {
    /// So far each way from a centre, and more than rounding can have taken away: 2⁻²⁴ of the longest way, which holds for
    /// shapes up to ten million times as long one way as another, and 2⁻⁵⁰ of the place.
    fn about(centre: DVec3, reach: DVec3) -> Self {
        const OF_SIZE: f64 = 1.0 / (1_u64 << 24) as f64;
        const OF_PLACE: f64 = 1.0 / (1_u64 << 50) as f64;
        let reach = reach + DVec3::splat(reach.max_element() * OF_SIZE) + (centre.abs() + reach) * OF_PLACE;
        Self { least: centre - reach, most: centre + reach }
    }

    /// Whether the two have a point in common.
    pub fn meets(&self, other: &Self) -> bool {
        !(other.most.cmplt(self.least) | self.most.cmplt(other.least)).any()
    }

    /// Of a sphere.
    pub fn of_sphere(centre: DVec3, radius: f64) -> Self {
        Self::about(centre, DVec3::splat(radius))
    }

    /// Of an ellipsoid: along an axis it reaches as far as the row of the map from the unit sphere is long.
    pub fn of_ellipsoid(ellipsoid: &Ellipsoid) -> Self {
        let world_from_unit = ellipsoid.unit_from_world.inverse();
        Self::about(ellipsoid.centre, DVec3::from([0, 1, 2].map(|axis| world_from_unit.row(axis).length())))
    }

    /// Of a disk: x cos φ + z sin φ of its two half edges is √(x² + z²) at most, each part for itself.
    pub fn of_disk(planar: &Planar) -> Self {
        let [x, z] = planar.half_edges();
        Self::about(planar.centre, DVec3::from([0, 1, 2].map(|axis| (x[axis] * x[axis] + z[axis] * z[axis]).sqrt())))
    }

    /// Of a rectangle.
    pub fn of_rectangle(planar: &Planar) -> Self {
        let [x, z] = planar.half_edges();
        Self::about(planar.centre, x.abs() + z.abs())
    }

    /// Of a cuboid.
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

    /// Every point lies within, and the farthest come within a share of the box of all six sides.
    fn holds(bounds: Bounds, share: f64, point: impl Fn(&mut Draws) -> DVec3) {
        let mut draws = Draws::new(71, 0);
        let (mut least, mut most) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for _ in 0..POINTS {
            let point = point(&mut draws);
            (least, most) = (least.min(point), most.max(point));
        }
        let size = (bounds.most - bounds.least).max_element();
        assert!(least.cmpge(bounds.least).all() && most.cmple(bounds.most).all(), "{bounds:?}: {least} {most}");
        let loose = (least - bounds.least).max_element().max((bounds.most - most).max_element());
        assert!(loose <= share * size, "{bounds:?} is loose by {loose}");
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
            holds(Bounds::of_disk(&planar), 0.01, |draws| {
                let angle = draws.between(0.0, std::f64::consts::TAU);
                planar.centre + x * libm::cos(angle) + z * libm::sin(angle)
            });
            // Rectangles and cuboids end in corners, which the draws meet.
            holds(Bounds::of_rectangle(&planar), 1e-6, |draws| planar.centre + x * sign(draws) + z * sign(draws));
            let (_, slabs) = cuboid_shot(73, index, Spot::Face, Eye::Anywhere, 4.0, 3.0);
            let [x, y, z] = slabs.half_edges();
            holds(Bounds::of_cuboid(&slabs), 1e-6, |draws| {
                slabs.centre + x * sign(draws) + y * sign(draws) + z * sign(draws)
            });
            let edges = DMat3::from_cols(x, y, z);
            let longest = x.length() + y.length() + z.length();
            let ellipsoid = Ellipsoid::new(slabs.centre, edges.inverse(), longest);
            holds(Bounds::of_ellipsoid(&ellipsoid), 0.02, |draws| slabs.centre + edges * draws.unit_vector());
            holds(Bounds::of_sphere(planar.centre, 2.0), 0.02, |draws| planar.centre + draws.unit_vector() * 2.0);
        }
        eprintln!("bounds: {SHAPES} shapes of 5 kinds, {POINTS} points each, all within");
    }
}
