use super::bounds::{Bounds, l1_norm};
use super::double_double::{double_double_ellipsoid_point, double_double_ellipsoid_t};
use super::emitter::NeverSampled;
use super::ray_block::{Intersection, RayHit, SurfacePoint, UNIT_ROUNDOFF};
use super::shape::{Placed, Shape};
use super::space::{direction_object_from_world, normal_world_from_object, point_object_from_world};
use super::uv::{UvSlope, sphere_uv};
use crate::each::Each;
use crate::scene::{SceneError, Sphere, positive_length, triple};
use glam::{DMat3, DVec3};

/// 2⁻⁵³, the unit roundoff of f64.
const EPSILON: f64 = 1.0 / (1_u64 << 53) as f64;
/// The greatest ratio of an ellipsoid's longest to its shortest axis, up to which `extremes` has tested it.
const LARGEST_RATIO: f64 = 1e7;
/// The factor by which its bounding sphere is enlarged, so that no rounding of the map leads outside it.
const RADIUS_MARGIN: f64 = 1.0 + 1.0 / 65_536.0;

/// A sphere with a non-uniform scale: the points x of render space with |A (x − C)| = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid {
    /// C, relative to the eye.
    pub centre: DVec3,
    /// A: from render space to the space in which it is the unit sphere, per scene unit.
    pub unit_from_world: DMat3,
    /// The Frobenius norm ‖A‖: an upper bound of the factor by which A lengthens a vector.
    pub norm: f64,
    /// The radius of a bounding sphere about the centre.
    pub bounding_radius: f64,
}

impl Ellipsoid {
    /// The ellipsoid of a map whose longest half axis has at most about this length.
    pub fn new(centre: DVec3, unit_from_world: DMat3, longest: f64) -> Self {
        let squares: f64 = unit_from_world.to_cols_array().iter().map(|part| part * part).sum();
        Self { centre, unit_from_world, norm: squares.sqrt(), bounding_radius: longest * RADIUS_MARGIN }
    }
}

impl Shape for Ellipsoid {
    type Component = Sphere;
    type SurfaceData = ();
    type Emitter = NeverSampled;
    type Prepared = ();

    const NOUN: &'static str = "unevenly scaled sphere";
    const NON_UNIFORM: Option<bool> = Some(true);

    fn has_inside(_: &Sphere) -> bool {
        true
    }

    fn place(sphere: &Sphere, placed: &Placed<'_>) -> Result<(Self, ()), SceneError> {
        let (who, pose, radius) = (placed.who, placed.pose, sphere.radius);
        positive_length(who, "radius", radius)?;
        let unit_from_world = pose.entity_from_world * (1.0 / radius);
        let longest = radius * stretch(pose.world_from_entity.matrix3);
        let shortest = 1.0 / stretch(unit_from_world.transpose());
        positive_length(who, "longest half axis", longest)?;
        positive_length(who, "shortest half axis", shortest)?;
        let ratio = longest / shortest;
        if ratio > LARGEST_RATIO {
            let with = if placed.has_parent { "with its parents " } else { "" };
            let value = format!("{}, {with}{ratio:.1e} times as long as thick", triple(placed.scale));
            let accepted = format!("a sphere may be at most {LARGEST_RATIO:e} times as long as thick");
            return Err(SceneError::new(who, "scale", value, accepted));
        }
        Ok((Self::new(placed.position, unit_from_world, longest), ()))
    }

    #[inline(always)]
    fn intersection(&self, origin: DVec3, direction: DVec3) -> Intersection {
        ellipsoid_intersection(origin, direction, self)
    }

    fn precise_t(&self, origin: DVec3, direction: DVec3) -> f64 {
        double_double_ellipsoid_t(origin, direction, self)
    }

    #[inline(always)]
    fn culling_sphere(&self) -> Option<(DVec3, f64)> {
        Some((self.centre, self.bounding_radius))
    }

    #[inline(always)]
    fn surface(&self, (): &(), hit: &RayHit) -> SurfacePoint {
        ellipsoid_surface(hit, self)
    }

    #[inline(always)]
    fn uv(&self, (): &(), hit: &RayHit, _at: DVec3, _own: DVec3) -> [f64; 2] {
        sphere_uv(self.unit_from_world * (hit.origin - self.centre + hit.t * hit.direction))
    }

    fn uv_slope(&self, (): &(), _uv_from_world: DMat3) -> UvSlope {
        UvSlope::Round
    }

    /// Its extent along an axis is the length of that row of the map from the unit sphere.
    fn bounds(&self) -> Option<Bounds> {
        let world_from_unit = self.unit_from_world.inverse();
        let half_size = DVec3::from([0, 1, 2].each(|axis| world_from_unit.row(axis).length()));
        Some(Bounds::about(self.centre, half_size))
    }

    fn contains(&self, point: DVec3) -> bool {
        (self.unit_from_world * (point - self.centre)).length() < 1.0
    }

    fn thickness(&self) -> f64 {
        2.0 / self.norm
    }
}

/// The greatest factor by which a map lengthens a vector, or up to 1 % more where its columns are not perpendicular.
fn stretch(map: DMat3) -> f64 {
    const ROUNDS: u32 = 5;
    bound_of_eigenvalues(map.transpose() * map, ROUNDS).sqrt()
}

/// An upper bound of a symmetric matrix's eigenvalues, its largest row sum; each round squares the matrix, which halves
/// the logarithm of the bound's excess.
fn bound_of_eigenvalues(matrix: DMat3, rounds: u32) -> f64 {
    let bound = [0, 1, 2].each(|row| matrix.row(row).abs().element_sum()).iter().copied().fold(0.0, f64::max);
    if rounds == 0 || bound == 0.0 || !bound.is_finite() {
        return bound;
    }
    let reduced = matrix * (1.0 / bound);
    bound * bound_of_eigenvalues(reduced * reduced, rounds - 1).sqrt()
}

// ANCHOR: ellipsoid_intersection
/// Intersects O + tR with an ellipsoid, in f64: the ray is transformed to the space where the ellipsoid is the unit
/// sphere.
///
/// p = A (O − C) is transformed as a point and q = A R as a direction, and q is not normalised, so that p + tq is
/// A (O + tR − C) for the same t.
/// The discriminant is 1 − |p − (p·q / q·q) q|², with the component of p perpendicular to the ray, as for a sphere.
#[inline(always)]
pub fn ellipsoid_intersection(origin: DVec3, direction: DVec3, ellipsoid: &Ellipsoid) -> Intersection {
    let p = point_object_from_world(ellipsoid.unit_from_world, ellipsoid.centre, origin);
    let q = direction_object_from_world(ellipsoid.unit_from_world, direction);
    let (qq, pp) = (q.dot(q), p.dot(p));
    let s = -p.dot(q) / qq;
    let across = p + s * q;
    let ll = across.dot(across);
    let (discriminant, c) = (1.0 - ll, pp - 1.0);
    let half_chord = (discriminant.max(0.0) / qq).sqrt();

    let (outside, ahead) = (c > 0.0, s > 0.0);
    let sum = if ahead { s + half_chord } else { s - half_chord };
    let root = if ahead & !outside { sum } else { c / (qq * sum) };
    let misses = (discriminant < 0.0) | (outside & !ahead);
    let t = if misses { f64::INFINITY } else { root };

    let error = mapping_error(ellipsoid, origin, s.abs(), direction);
    let error_of_discriminant = 2.0 * error * (1.0 + ll + error);
    let error_of_c = 2.0 * error * (1.0 + pp.sqrt() + error);
    let unsure_of_hit = (error_of_c >= 0.5 * UNIT_ROUNDOFF * c.abs())
        | (error_of_discriminant >= discriminant)
        | (error_of_discriminant >= UNIT_ROUNDOFF * qq * root * half_chord);
    let unsure_of_miss = if discriminant < 0.0 { -discriminant <= error_of_discriminant } else { c <= error_of_c };
    Intersection { t, uncertain: if misses { unsure_of_miss } else { unsure_of_hit } }
}

/// A bound on the rounding error of p + sq, in the space of the unit sphere.
///
/// Let ε = 2⁻⁵³ and ‖A‖ be the Frobenius norm of A.
/// O − C has a relative error of ε, and each component of A (O − C) an error of 3ε relative to the terms summed, so p
/// is off by 4ε‖A‖|O − C| and q by 3ε‖A‖|R|; the product sq and the sum add ε each, relative to values of at most
/// ‖A‖|O − C|.
/// Together that is 6ε‖A‖|O − C| + 3ε‖A‖|sR|; an error of s itself moves the point along the ray and enters squared
/// only.
/// A factor of 8 leaves room for that, and for the rounding of the squares.
/// Hence |p + sq|² is off by twice its length times this bound, plus the bound squared; and 2|l| ≤ 1 + |l|².
#[inline(always)]
fn mapping_error(ellipsoid: &Ellipsoid, origin: DVec3, s: f64, direction: DVec3) -> f64 {
    let lengths = l1_norm(origin - ellipsoid.centre) + s * l1_norm(direction);
    8.0 * EPSILON * (1.0 + ellipsoid.norm * lengths)
}

/// The smallest t > 0 at which O + tR intersects an ellipsoid, or infinity; uncertain cases are decided in
/// double-double.
#[inline(always)]
pub fn ellipsoid_t(origin: DVec3, direction: DVec3, ellipsoid: &Ellipsoid) -> f64 {
    let intersection = ellipsoid_intersection(origin, direction, ellipsoid);
    if intersection.uncertain { double_double_ellipsoid_t(origin, direction, ellipsoid) } else { intersection.t }
}
// ANCHOR_END: ellipsoid_intersection

// ANCHOR: ellipsoid_surface
/// The surface where a ray hits an ellipsoid.
///
/// In the space of the unit sphere the normal at g is g itself; Aᵀ transforms it to the world, and |Aᵀg| is the length
/// in unit space of one scene unit along the normal.
///
/// The bound.
/// Let g be the exact point at the computed t, and m = Aᵀg / |Aᵀg|.
/// The tangent plane at the image of g / |g| has normal m, and the ellipsoid lies entirely behind it; the image of g
/// lies behind that plane by |g| (1 − |g|) / |Aᵀg|, which is about half of (1 − |g|²) / |Aᵀg|.
/// An origin that is moved along m by more than this, and by the rounding errors, is therefore off the surface whatever
/// the curvature, since nothing but the distance to a plane matters.
/// The residual |g|² − 1 is measured to within twice the error of g; both are doubled.
/// From inside, the origin stays inside while the bound is less than a seventh of the smallest radius of curvature,
/// which is the shortest semi-axis squared over the longest; a thinner ellipsoid has no room for an origin.
/// If that error would rotate the normal by more than u or exceed u times the shortest semi-axis, g is computed again
/// in double-double.
#[inline(always)]
pub fn ellipsoid_surface(hit: &RayHit, ellipsoid: &Ellipsoid) -> SurfacePoint {
    let (RayHit { origin, direction, t, .. }, map) = (*hit, ellipsoid.unit_from_world);
    let mut point = hit.point();
    let mut g = map * ((origin - ellipsoid.centre) + t * direction);
    let mut across = normal_world_from_object(map, g);
    let mut error = mapping_error(ellipsoid, origin, t, direction);
    if error * ellipsoid.norm >= UNIT_ROUNDOFF * across.length() {
        let (further, exact) = double_double_ellipsoid_point(origin, direction, t, ellipsoid);
        point += further * direction;
        (g, error) = (exact, 8.0 * EPSILON);
        across = normal_world_from_object(map, g);
    }
    let steps = across.length();
    let behind = ((g.dot(g) - 1.0).abs() + 2.0 * error) / steps;
    let bound = hit.bound(point, 0.0) + behind as f32;
    // The side is decided in unit space, where g and q are known best.
    let away = g.dot(direction_object_from_world(map, direction)) > 0.0;
    let normal = if away { -across / steps } else { across / steps };
    SurfacePoint { point, normal, bound, outside: !away, at: DVec3::ZERO }
}
// ANCHOR_END: ellipsoid_surface

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat3;

    /// Semi-axes 1, 2, 4 along x, y, z, ten units ahead.
    fn egg() -> Ellipsoid {
        let unit_from_world = DMat3::from_diagonal(DVec3::new(1.0, 0.5, 0.25));
        Ellipsoid::new(DVec3::new(0.0, 0.0, -10.0), unit_from_world, 4.0)
    }

    #[test]
    fn rays_hit_the_poles_at_the_ends_of_the_semi_axes() {
        let t = |origin, direction| ellipsoid_t(origin, direction, &egg());
        assert_eq!(t(DVec3::ZERO, DVec3::NEG_Z), 6.0);
        assert_eq!(t(DVec3::ZERO, DVec3::NEG_Z * 2.0), 3.0);
        assert_eq!(t(DVec3::new(0.0, 5.0, -10.0), DVec3::NEG_Y), 3.0);
        assert_eq!(t(DVec3::new(0.0, 0.0, -10.0), DVec3::X), 1.0);
        assert_eq!(t(DVec3::X, DVec3::NEG_Z), 10.0);
        assert_eq!(t(DVec3::X * (1.0 + f64::EPSILON), DVec3::NEG_Z), f64::INFINITY);
        assert_eq!(t(DVec3::ZERO, DVec3::Z), f64::INFINITY);
    }

    #[test]
    fn normals_point_outward_under_a_mirroring_transform() {
        let origin = DVec3::new(0.3, 0.7, 0.0);
        let at = |ellipsoid: &Ellipsoid| {
            let t = ellipsoid_t(origin, DVec3::NEG_Z, ellipsoid);
            ellipsoid_surface(&RayHit::at_rest(origin, DVec3::NEG_Z, t), ellipsoid)
        };
        let (plain, mirror) = (egg(), DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0)));
        let mirrored = Ellipsoid { unit_from_world: mirror * plain.unit_from_world, ..plain };
        assert_eq!(at(&plain), at(&mirrored));
        let surface = at(&plain);
        let from_centre = surface.point - plain.centre;
        let gradient = from_centre / DVec3::new(1.0, 4.0, 16.0);
        assert!(gradient.normalize().distance(surface.normal) < 1e-7 && surface.outside);
        assert!((surface.normal.length() - 1.0).abs() < 1e-6 && surface.bound > 0.0 && surface.bound < 1e-4);
        assert!(surface.normal.dot(DVec3::Z) > 0.0);
    }

    #[test]
    fn where_f64_is_uncertain_the_double_double_point_lies_on_the_surface() {
        let long = Ellipsoid::new(DVec3::new(0.0, 3e9, -4e9), DMat3::from_diagonal(DVec3::new(1.0, 1e-4, 1.0)), 1e4);
        let direction = DVec3::new(0.0, 0.6, -0.8);
        let t = ellipsoid_t(DVec3::ZERO, direction, &long);
        let (_, g) = double_double_ellipsoid_point(DVec3::ZERO, direction, t, &long);
        assert!((g.length() - 1.0).abs() < 1e-15, "{g}");
    }
}
