//! Stretched spheres and rays at them: silhouettes, tips, from near and far.

use crate::measure::ray_aim::{AimedRay, BAND_IN_QUANTA, Draws, rounded_ray};
use glam::{DMat3, DQuat, DVec3, Vec3};
use pinhole::shapes::Ellipsoid;

/// One direction quantum: the spacing of f32 numbers just below 1.
const QUANTUM: f64 = 1.0 / (1_u64 << 24) as f64;

/// A stretched sphere with what it was made of.
#[derive(Clone, Copy, Debug)]
pub struct Stretched {
    /// As the table holds it.
    pub ellipsoid: Ellipsoid,
    /// The map that made it, up to rounding.
    pub world_from_unit: DMat3,
    /// The longest half axis.
    pub longest: f64,
    /// The shortest.
    pub shortest: f64,
}

/// Where a ray is aimed.
#[derive(Clone, Copy, Debug)]
pub enum SampleLights {
    /// At the silhouette, up to a few direction quanta.
    Silhouette,
    /// At an end of a half axis, or very near it.
    Pole,
    /// Anywhere on the side that is seen.
    Anywhere,
}

/// From how far a ray comes.
#[derive(Clone, Copy, Debug)]
pub enum From {
    /// So many of the longest half axes from the centre.
    Far(f64),
    /// 10^U(this, 0) of the shortest half axis off the surface.
    Near(f64),
    /// Anywhere inside.
    Inside,
}

/// What a case draws.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// The case.
    pub seed: u64,
    /// The longest half axis over the shortest is 10 to at most this.
    pub ratio: f64,
    /// Sizes are 10^U(−this, this).
    pub sizes: f64,
    /// Where rays go.
    pub aim: SampleLights,
    /// Where they come from.
    pub from: From,
}

/// A turn, uniform over all turns.
pub fn turn(draws: &mut Draws) -> DQuat {
    // Two halves of the four numbers, each uniform on a circle (Shoemake, Graphics Gems III).
    let [a, b] = [(); 2].map(|()| draws.between(0.0, std::f64::consts::TAU));
    let fraction = draws.unit();
    let (r, s) = (libm::sqrt(1.0 - fraction), libm::sqrt(fraction));
    DQuat::from_xyzw(r * libm::sin(a), r * libm::cos(a), s * libm::sin(b), s * libm::cos(b))
}

/// Scales of which the largest is `ratio` times the smallest: needles, pancakes and all between, mirrored or not.
pub fn scales(draws: &mut Draws, ratio: f64) -> DVec3 {
    let kind = draws.unit();
    let middle = if kind < 0.35 {
        1.0
    } else if kind < 0.7 {
        ratio
    } else {
        libm::pow(ratio, draws.unit())
    };
    let mut sign = || if draws.unit() < 0.5 { -1.0 } else { 1.0 };
    let mut scales = [1.0 * sign(), middle * sign(), ratio * sign()];
    scales.rotate_left((draws.unit() * 3.0) as usize);
    DVec3::from(scales)
}

/// A ray and what it is aimed at; the eye is at the origin, where the ray starts.
pub fn shot(view: View, index: u64) -> (AimedRay, Stretched) {
    let mut draws = Draws::new(view.seed, index);
    let size = draws.power_of_ten(-view.sizes, view.sizes);
    let ratio = draws.power_of_ten(view.ratio - 0.5, view.ratio);
    let (axes, scale) = (DMat3::from_quat(turn(&mut draws)), scales(&mut draws, ratio) * size);
    let unit_from_world = DMat3::from_diagonal(1.0 / scale) * axes.transpose();
    let world_from_unit = axes * DMat3::from_diagonal(scale);
    let (longest, shortest) = (scale.abs().max_element(), scale.abs().min_element());

    let mut seen_from = draws.unit_vector();
    let mut g = match view.aim {
        SampleLights::Pole => {
            let axis = DVec3::AXES[(draws.unit() * 3.0) as usize] * if draws.unit() < 0.5 { -1.0 } else { 1.0 };
            (axis + draws.unit_vector() * draws.power_of_ten(-9.0, -1.0)).normalize()
        }
        _ => draws.unit_vector(),
    };
    // Where the ray starts, from the centre: far out, or a little off the surface.
    let start = match view.from {
        From::Far(radii) => seen_from * (longest * radii),
        From::Near(least) => {
            seen_from = (unit_from_world.transpose() * g).normalize();
            let aside = draws.unit_vector_across(seen_from) * draws.unit();
            world_from_unit * g + (seen_from + aside) * (shortest * draws.power_of_ten(least, 0.0))
        }
        From::Inside => world_from_unit * (seen_from * draws.between(0.0, 0.95)),
    };
    let from_unit = unit_from_world * start;
    if from_unit.dot(g) < 1.0 && matches!(view.from, From::Far(_)) {
        g = -g;
    }
    let mut quanta = 0.0;
    if let SampleLights::Silhouette = view.aim {
        // The points g of the unit sphere with g · e = 1 are those whose tangent planes hold the eye e.
        let towards = from_unit.normalize();
        let nearer = 1.0 / from_unit.length();
        g = towards * nearer + draws.unit_vector_across(towards) * libm::sqrt(1.0 - nearer * nearer);
        quanta = draws.between(-BAND_IN_QUANTA, BAND_IN_QUANTA);
    }
    let target = world_from_unit * g - start;
    let normal = (unit_from_world.transpose() * g).normalize();
    let ray = rounded_ray(Vec3::ZERO, target.normalize() + normal * (quanta * QUANTUM));
    let ellipsoid = Ellipsoid::new(-start, unit_from_world, longest);
    (ray, Stretched { ellipsoid, world_from_unit, longest, shortest })
}

/// The table of these ellipsoids; an ellipsoid's shape number is its place.
pub fn ellipsoid_table(ellipsoids: impl IntoIterator<Item = Ellipsoid>) -> pinhole::extract::EllipsoidTable {
    ellipsoids.into_iter().collect()
}
