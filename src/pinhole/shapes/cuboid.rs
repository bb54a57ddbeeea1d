use super::arithmetic::Interval;
use super::bounds::{Bounds, l1_norm};
use super::double_double::double_double_cuboid_t;
use super::emitter::EmittingCuboid;
use super::planar::unit_in_f32;
use super::ray_block::{BlockVectors, Intersection, LANES, RayHit, SurfacePoint, vector};
use super::shape::{Placed, SceneShape, Shape};
use super::space::{Pose, normal_world_from_object};
use super::uv::{UvSlope, face_axes, within_unit};
use crate::each::Each;
use crate::scene::{Cuboid, SceneError, positive_length, triple};
use glam::{DMat3, DVec3};

/// The greatest ratio of a cuboid's longest to its shortest edge.
///
/// Normals whose components are exact in f32 rotate a face by up to 2⁻²⁵, which moves its far end by that fraction of
/// the cuboid's length: with this ratio, by less than a third of the thickness.
const LARGEST_RATIO: f64 = 1e7;
/// The factor by which its bounding sphere is enlarged, so that no rounding leads outside it.
const RADIUS_MARGIN: f64 = 1.0 + 1.0 / 1024.0;

/// The points x of render space with |nᵢ · (x − C)| ≤ hᵢ for three normals: a box, or three slabs at any angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slabs {
    /// C, relative to the eye.
    pub centre: DVec3,
    /// The outward normals n of the faces at the entity's +x, +y and +z, of length 1 to within f32, with components
    /// exact in f32, so that the normals of surfaces and of faces are the same numbers.
    pub normal: [DVec3; 3],
    /// h, from the centre to the faces, in units of the length of n.
    pub half: [f64; 3],
    /// The radius of a bounding sphere about the centre.
    pub bounding_radius: f64,
}

impl Slabs {
    /// The slabs whose faces have these normals and are half an edge from the centre.
    pub fn new(centre: DVec3, normals: [DVec3; 3], half_edges: [DVec3; 3]) -> Self {
        let normal = normals.each(unit_in_f32);
        let half = [0, 1, 2].each(|axis| normal[axis].dot(half_edges[axis]));
        let bounding_radius = half_edges.iter().map(|edge| edge.length()).sum::<f64>() * RADIUS_MARGIN;
        Self { centre, normal, half, bounding_radius }
    }

    /// Whether the normals are the axes, so that two of three products in every dot product are 0.
    #[inline(always)]
    fn is_upright(&self) -> bool {
        self.normal[0] == DVec3::X && self.normal[1] == DVec3::Y && self.normal[2] == DVec3::Z
    }

    /// The offsets from the centre to the midpoints of the faces at the ends of the three edges.
    pub fn half_edges(&self) -> [DVec3; 3] {
        [0, 1, 2].each(|axis| {
            let along = self.normal[(axis + 1) % 3].cross(self.normal[(axis + 2) % 3]);
            along * (self.half[axis] / self.normal[axis].dot(along))
        })
    }
}

impl SceneShape for Cuboid {
    const NAME: &'static str = "Cuboid";
    const WORD: &'static str = "cuboid";

    fn scale(&mut self, by: f64) {
        self.size *= by;
    }
}

impl Shape for Slabs {
    type Component = Cuboid;
    type SurfaceData = ();
    type Emitter = EmittingCuboid;
    type Prepared = ();

    const HIERARCHY_FROM: usize = 24;

    fn has_inside(_: &Cuboid) -> bool {
        true
    }

    fn place(&Cuboid { size }: &Cuboid, placed: &Placed<'_>) -> Result<(Self, ()), SceneError> {
        let who = placed.who;
        for part in size.to_array() {
            positive_length(who, "size", part).map_err(|scene_error| SceneError {
                value: triple(size),
                accepted: format!("each part must be{}", scene_error.accepted.trim_start_matches("it must be")),
                ..scene_error
            })?;
        }
        let Pose { world_from_entity, entity_from_world } = placed.pose;
        let half_edges = world_from_entity.matrix3 * DMat3::from_diagonal(size / 2.0);
        let edges = [0, 1, 2].each(|axis| half_edges.col(axis));
        let normals = DVec3::AXES.each(|axis| normal_world_from_object(entity_from_world, axis));
        let slabs = Self::new(placed.position, normals, edges);
        let longest = edges.each(DVec3::length).iter().copied().fold(0.0, f64::max);
        let thinnest = slabs.half.iter().copied().fold(f64::INFINITY, f64::min);
        positive_length(who, "longest placed edge", longest)?;
        positive_length(who, "placed thickness", thinnest)?;
        let ratio = longest / thinnest;
        if ratio > LARGEST_RATIO {
            let value = format!("{}, placed {ratio:.1e} times as long as thick", triple(size));
            let accepted = format!("a cuboid may be at most {LARGEST_RATIO:e} times as long as thick");
            return Err(SceneError::new(who, "size", value, accepted));
        }
        Ok((slabs, ()))
    }

    #[inline(always)]
    fn intersection(&self, origin: DVec3, direction: DVec3) -> Intersection {
        cuboid_intersection(origin, direction, self)
    }

    #[inline(always)]
    fn intersections(&self, [o, d]: [&BlockVectors; 2], t: &mut [f64; LANES], uncertain: &mut [bool; LANES]) {
        if self.is_upright() {
            for lane in 0..LANES {
                let intersection = upright_intersection(vector(o, lane), vector(d, lane), self);
                (t[lane], uncertain[lane]) = (intersection.t, intersection.uncertain);
            }
        } else {
            for lane in 0..LANES {
                let intersection = cuboid_intersection(vector(o, lane), vector(d, lane), self);
                (t[lane], uncertain[lane]) = (intersection.t, intersection.uncertain);
            }
        }
    }

    fn precise_t(&self, origin: DVec3, direction: DVec3) -> f64 {
        double_double_cuboid_t(origin, direction, self).0
    }

    #[inline(always)]
    fn culling_sphere(&self) -> Option<(DVec3, f64)> {
        Some((self.centre, self.bounding_radius))
    }

    #[inline(always)]
    fn surface(&self, (): &(), hit: &RayHit) -> SurfacePoint {
        cuboid_surface(hit, cuboid_face(hit.origin, hit.direction, self), self)
    }

    #[inline(always)]
    fn uv(&self, (): &(), hit: &RayHit, at: DVec3, _own: DVec3) -> [f64; 2] {
        cuboid_uv(self, at.x as usize, hit.t * hit.direction - (self.centre - hit.origin))
    }

    fn uv_slope(&self, (): &(), _uv_from_world: DMat3) -> UvSlope {
        UvSlope::Faces([0, 1, 2].each(|axis| self.normal[axis] / self.half[axis]))
    }

    fn bounds(&self) -> Option<Bounds> {
        let [x, y, z] = self.half_edges();
        Some(Bounds::about(self.centre, x.abs() + y.abs() + z.abs()))
    }

    fn contains(&self, point: DVec3) -> bool {
        (0..3).all(|axis| self.normal[axis].dot(point - self.centre).abs() < self.half[axis])
    }

    fn thickness(&self) -> f64 {
        2.0 * self.half.iter().copied().fold(f64::INFINITY, f64::min)
    }

    fn emitter(&self, (): &()) -> Option<EmittingCuboid> {
        Some(EmittingCuboid::new(self.centre, self.half_edges()))
    }
}

/// 2⁻⁵³, the unit roundoff of f64.
const EPSILON: f64 = 1.0 / (1_u64 << 53) as f64;
/// Half of u: the largest relative error of a t that counts as certain.
const SMALL: f64 = 1.0 / (1_u64 << 25) as f64;

/// Where a ray crosses a face: between which t, and the quotient that t is.
#[derive(Clone, Copy)]
struct Crossing {
    at: Interval,
    over: f64,
    speed: f64,
}

impl Crossing {
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        let [over, speed] = self.quotient_or(other, other.at.t > self.at.t);
        Self { at: self.at.max(other.at), over, speed }
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        let [over, speed] = self.quotient_or(other, other.at.t < self.at.t);
        Self { at: self.at.min(other.at), over, speed }
    }

    #[inline(always)]
    fn quotient_or(self, other: Self, is_other: bool) -> [f64; 2] {
        if is_other { [other.over, other.speed] } else { [self.over, self.speed] }
    }
}

// ANCHOR: slab
/// Where a ray enters and leaves the slab |n · (x − C)| ≤ h: at t = (n·f ∓ h) / (n·R) with f = C − O, for n·R > 0.
///
/// A ray parallel to the slab divides by 0 and gets −∞ to ∞ inside and ∞ to ∞, or −∞ to −∞, outside, which is correct.
/// If rounding leaves the sign of n·R uncertain, or whether the ray lies in a face, the interval is all of ℝ.
/// One division serves for both faces and their bounds, and only the t that is kept is divided exactly, later.
#[inline(always)]
fn slab(f: DVec3, direction: DVec3, normal: DVec3, half: f64) -> [Crossing; 2] {
    let (of_f, of_direction) = (normal * f, normal * direction);
    let (middle, approach) = (of_f.x + of_f.y + of_f.z, of_direction.x + of_direction.y + of_direction.z);
    crossings([middle, l1_norm(of_f)], [approach, l1_norm(of_direction)], half)
}

/// The same across an axis, by the components of f and R along it.
#[inline(always)]
fn upright_slab(f: f64, direction: f64, half: f64) -> [Crossing; 2] {
    crossings([f, f.abs()], [direction, direction.abs()], half)
}

/// The same by n·f and n·R, each with the sum of the magnitudes of its three products.
#[inline(always)]
fn crossings([middle, sum]: [f64; 2], [approach, sum_of_approach]: [f64; 2], half: f64) -> [Crossing; 2] {
    // The magnitude, not the negative: −0 and 0 must both give speed 0.
    let (towards, speed) = (if approach < 0.0 { -middle } else { middle }, approach.abs());
    let (over_near, over_far, inverse) = (towards - half, towards + half, 1.0 / speed);

    let lost = 8.0 * EPSILON * (sum + half);
    let relative = EPSILON * (4.0 * sum_of_approach * inverse + 6.0);
    let (along, in_a_face) = (sum_of_approach == 0.0, (over_near.abs() <= lost) | (over_far.abs() <= lost));
    let unsure = if along { in_a_face } else { relative.is_nan() | (relative >= 0.25) };
    let error = |t: f64| if along { 0.0 } else { 2.0 * (lost * inverse + relative * t.abs()) };
    let bounds = |t: f64| {
        if unsure { Interval { t, min: f64::NEG_INFINITY, max: f64::INFINITY } } else { Interval::new(t, error(t)) }
    };
    let crossing = |over: f64| Crossing { at: bounds(over * inverse), over, speed };
    [crossing(over_near), crossing(over_far)]
}
// ANCHOR_END: slab

// ANCHOR: cuboid_intersection
/// Intersects O + tR with a cuboid, in f64: the ray is inside between entering the last slab and leaving the first.
#[inline(always)]
pub fn cuboid_intersection(origin: DVec3, direction: DVec3, slabs: &Slabs) -> Intersection {
    let f = slabs.centre - origin;
    let x = slab(f, direction, slabs.normal[0], slabs.half[0]);
    let y = slab(f, direction, slabs.normal[1], slabs.half[1]);
    let z = slab(f, direction, slabs.normal[2], slabs.half[2]);
    between([x, y, z])
}

/// The same of a cuboid whose faces lie across the axes.
#[inline(always)]
fn upright_intersection(origin: DVec3, direction: DVec3, slabs: &Slabs) -> Intersection {
    let f = slabs.centre - origin;
    let x = upright_slab(f.x, direction.x, slabs.half[0]);
    let y = upright_slab(f.y, direction.y, slabs.half[1]);
    let z = upright_slab(f.z, direction.z, slabs.half[2]);
    between([x, y, z])
}

/// The same by where the ray enters and leaves each slab.
#[inline(always)]
fn between([[near_x, far_x], [near_y, far_y], [near_z, far_z]]: [[Crossing; 2]; 3]) -> Intersection {
    let (entry, exit) = (near_x.max(near_y).max(near_z), far_x.min(far_y).min(far_z));
    let (enters, leaves) = (entry.at, exit.at);

    let surely_not = (enters.min > leaves.max) | (leaves.max < 0.0);
    let surely_inside = enters.max <= leaves.min;
    let from_outside = enters.min > 0.0;
    let from_inside = (enters.max < 0.0) & (leaves.min > 0.0);
    let (first, open) = if from_outside { (entry, enters.max - enters.min) } else { (exit, leaves.max - leaves.min) };
    let t = first.over / first.speed;
    let sure = surely_inside & (from_outside | from_inside) & (open <= SMALL * t);
    Intersection { t: if surely_not { f64::INFINITY } else { t }, uncertain: !surely_not & !sure }
}

/// The smallest t > 0 at which O + tR intersects a face of a cuboid, or infinity; uncertain cases are decided in
/// double-double.
#[inline(always)]
pub fn cuboid_t(origin: DVec3, direction: DVec3, slabs: &Slabs) -> f64 {
    let intersection = cuboid_intersection(origin, direction, slabs);
    if intersection.uncertain { double_double_cuboid_t(origin, direction, slabs).0 } else { intersection.t }
}
// ANCHOR_END: cuboid_intersection

/// The axis of the face that O + tR hits first; at an edge or a vertex, the first of the axes.
pub fn cuboid_face(origin: DVec3, direction: DVec3, slabs: &Slabs) -> usize {
    let f = slabs.centre - origin;
    let is_upright = slabs.is_upright();
    let along = |axis: usize| {
        let [near, far] = if is_upright {
            upright_slab(f[axis], direction[axis], slabs.half[axis])
        } else {
            slab(f, direction, slabs.normal[axis], slabs.half[axis])
        };
        [near.at, far.at]
    };
    let all = [along(0), along(1), along(2)];
    let from_outside = all.iter().any(|[near, _]| near.min > 0.0);
    let from_inside = all.iter().all(|[near, _]| near.max < 0.0);
    let is_first = |axis: usize| {
        let before = |other: usize| match (from_outside, from_inside) {
            (true, _) => all[axis][0].min > all[other][0].max,
            (_, true) => all[axis][1].max < all[other][1].min,
            _ => false,
        };
        before((axis + 1) % 3) && before((axis + 2) % 3)
    };
    (0..3).find(|&axis| is_first(axis)).unwrap_or_else(|| double_double_cuboid_t(origin, direction, slabs).1)
}

// ANCHOR: cuboid_surface
/// The surface where a ray hits the face of a cuboid across an axis.
///
/// The normal faces the ray on either side.
/// From inside, a hit within rounding error of another face is moved away from that face by the bounds of both, since
/// its shadow rays might otherwise start behind it.
#[inline(always)]
pub fn cuboid_surface(hit: &RayHit, axis: usize, slabs: &Slabs) -> SurfacePoint {
    let (mut point, normal) = (hit.point(), slabs.normal[axis]);
    let bound = hit.bound(point, l1_norm(slabs.centre) + slabs.half[axis]);
    let outside = normal.dot(hit.direction) * normal.dot(point - slabs.centre) <= 0.0;
    if !outside {
        let room = 2.0 * f64::from(bound);
        for other in [(axis + 1) % 3, (axis + 2) % 3] {
            let (across, half) = (slabs.normal[other], slabs.half[other]);
            let along = across.dot(point - slabs.centre);
            let lacking = room - (half - along.abs());
            if lacking > 0.0 && room < half {
                // Parallel to the other two faces, so that only this distance changes.
                let edge = slabs.normal[3 - axis - other].cross(normal);
                point -= edge * (lacking * along.signum() / across.dot(edge));
            }
        }
    }
    let normal = if normal.dot(hit.direction) > 0.0 { -normal } else { normal };
    SurfacePoint { point, normal, bound, outside, at: DVec3::X * axis as f64 }
}
// ANCHOR_END: cuboid_surface

/// The uv of a point on a face of a cuboid: 0 to 1 from edge to edge along each axis.
#[inline(always)]
pub fn cuboid_uv(slabs: &Slabs, axis: usize, from_centre: DVec3) -> [f64; 2] {
    let at = |axis: usize| slabs.normal[axis].dot(from_centre) / slabs.half[axis];
    let own = DVec3::new(at(0), at(1), at(2));
    face_axes(axis, own[axis] < 0.0).each(|along| within_unit(0.5 + 0.5 * along.dot(own)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;

    /// What is left out of an upright cuboid's products are zeros, which change no bit: from anywhere, from its faces and
    /// along them.
    #[test]
    fn an_upright_cuboid_is_hit_as_any_other_is() {
        let (centre, half) = (DVec3::new(0.25, -0.5, 3.0), DVec3::new(0.75, 1.25, 0.001));
        let slabs = Slabs::new(centre, DVec3::AXES, [DVec3::X * half.x, DVec3::Y * half.y, DVec3::Z * half.z]);
        assert!(slabs.is_upright());
        let (mut tried, mut hit, mut uncertain) = (0, 0, 0);
        for index in 0..50_000 {
            let mut draws = Draws::new(1302, index);
            let mut number = |max: f64| f64::from(draws.between(-max, max) as f32);
            let mut origin = DVec3::new(number(2.0), number(2.0), number(6.0));
            let aim = centre + half * DVec3::new(number(1.5), number(1.5), number(1.5));
            let mut direction = (aim - origin).normalize().as_vec3().as_dvec3();
            for axis in 0..3 {
                if number(1.0) > 0.7 {
                    direction[axis] = 0.0 * number(1.0);
                }
                if number(1.0) > 0.8 {
                    origin[axis] = centre[axis] + half[axis] * number(1.0).signum();
                }
            }
            let [own, other] =
                [upright_intersection(origin, direction, &slabs), cuboid_intersection(origin, direction, &slabs)];
            let is_same = own.t.to_bits() == other.t.to_bits() || (own.t.is_nan() && other.t.is_nan());
            assert!(is_same && own.uncertain == other.uncertain, "{origin} {direction}: {own:?} for {other:?}");
            tried += 1;
            hit += u32::from(own.t < f64::INFINITY);
            uncertain += u32::from(own.uncertain);
        }
        eprintln!("upright cuboid: {tried} rays, {hit} hit, {uncertain} uncertain, 0 apart");
        assert!(hit > 5_000 && uncertain > 500, "{hit}, {uncertain}");
    }

    #[test]
    fn faces_of_a_cuboid_read_from_left_to_right_and_down() {
        let slabs = Slabs::new(DVec3::ZERO, DVec3::AXES, [DVec3::X, DVec3::Y * 2.0, DVec3::Z * 4.0]);
        let at = |axis, x, y, z| cuboid_uv(&slabs, axis, DVec3::new(x, y, z));
        assert_eq!(at(2, -1.0, 2.0, 4.0), [0.0, 0.0]);
        assert_eq!(at(2, 1.0, -2.0, 4.0), [1.0, 1.0]);
        assert_eq!(at(2, 0.5, 1.0, -4.0), [0.25, 0.25]);
        assert_eq!(at(0, 1.0, 2.0, 4.0), [0.0, 0.0]);
        assert_eq!(at(0, 1.0, -2.0, -4.0), [1.0, 1.0]);
        assert_eq!(at(0, -1.0, 2.0, -4.0), [0.0, 0.0]);
        assert_eq!(at(1, -1.0, 2.0, -4.0), [0.0, 0.0]);
        assert_eq!(at(1, 1.0, -2.0, -4.0), [1.0, 1.0]);
        assert_eq!(at(1, 0.0, 2.0, 0.0), [0.5, 0.5]);
    }
}
