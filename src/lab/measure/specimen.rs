//! Shapes of every registered kind that are tried: the examples of their components, of any size, anywhere, turned and
//! scaled at random.

use super::draws::Draws;
use super::oracle::Oracle;
use super::ray_aim::AimedRay;
use glam::{DAffine3, DMat3, DQuat, DVec3};
use pinhole::intersect::NO_SHAPE;
use pinhole::scene::Placement;
use pinhole::shapes::{ClosestHits, Listed, Placed, Pose, RayHit, RaySlices, SceneShape, Shape};
use std::slice::from_ref;

/// So many shapes of a kind at random in a cube of half side 1, which together fill the same part of it at any number.
///
/// # Panics
/// When the kind's default is not accepted.
pub fn shapes_in_a_cube<S: Oracle>(count: usize) -> Vec<S> {
    let mut draws = Draws::new(78, 0);
    let size = 0.5 / libm::cbrt(count as f64);
    let shape = |_| {
        let position = DVec3::from([(); 3].map(|()| draws.between(-1.0, 1.0)));
        let placement = Placement { position, scale: DVec3::splat(size), ..Placement::default() };
        Specimen::<S>::of(S::Component::default(), placement).expect("a default").shape
    };
    (0..count).map(shape).collect()
}

/// A shape in render space, with the component and the placement that it is made from; the eye is the world's origin.
pub struct Specimen<S: Shape> {
    /// The shape, as the intersection kernels read it.
    pub shape: S,
    /// What its surface needs besides.
    pub surface_data: S::SurfaceData,
    /// The component.
    pub component: S::Component,
    /// Where it is placed.
    pub placement: Placement,
}

impl<S: Listed> Specimen<S> {
    /// A component at a placement; none where it is not accepted.
    pub fn of(component: S::Component, placement: Placement) -> Option<Self> {
        let Placement { position, orientation, scale } = placement;
        let axes = DMat3::from_quat(orientation);
        let pose = Pose {
            world_from_entity: DAffine3 { matrix3: axes * DMat3::from_diagonal(scale), translation: position },
            entity_from_world: DMat3::from_diagonal(1.0 / scale) * axes.transpose(),
        };
        let placed = Placed { who: S::Component::WORD, pose, position, scale, has_parent: false };
        let (shape, surface_data) = S::place(&component, &placed).ok()?;
        Some(Self { shape, surface_data, component, placement })
    }

    /// One of the component's examples of a random size from 10 to these powers, turned at random, its origin this many
    /// sizes away.
    ///
    /// Half of them are close to an axis, where the directions of f32 are finest.
    pub fn drawn(draws: &mut Draws, sizes: [f64; 2], away: f64) -> Option<Self> {
        let examples = S::Component::examples();
        let mut component = examples[(draws.unit() * examples.len() as f64) as usize].clone();
        let size = draws.power_of_ten(sizes[0], sizes[1]);
        component.scale(size);
        let [x, y, z, w] = [(); 4].map(|()| draws.between(-1.0, 1.0));
        let orientation = DQuat::from_xyzw(x, y, z, w).normalize();
        let scale = match S::NON_UNIFORM {
            Some(false) => DVec3::splat(draws.between(0.5, 2.0)),
            _ => DVec3::new(draws.between(0.5, 2.0), draws.between(0.2, 1.0), draws.between(0.5, 3.0)),
        };
        Self::of(component, Placement { position: place(draws, size, away), orientation, scale })
    }

    /// The same, an unevenly scaled sphere up to 10⁷ times as long as it is thick.
    pub fn drawn_stretched(draws: &mut Draws, sizes: [f64; 2], away: f64) -> Option<Self> {
        if S::NON_UNIFORM != Some(true) {
            return Self::drawn(draws, sizes, away);
        }
        let (size, ratio) = (draws.power_of_ten(sizes[0], sizes[1]), draws.power_of_ten(0.1, 6.9));
        let (orientation, scale) = (turn(draws), scales(draws, ratio) * size);
        let position = place(draws, scale.abs().max_element(), away);
        Self::of(S::Component::default(), Placement { position, orientation, scale })
    }

    /// The centre and radius of a sphere around it; of one that is infinite, its origin and as far as it is away.
    pub fn sphere_around(&self) -> (DVec3, f64) {
        let position = self.placement.position;
        self.shape.bounding_sphere().unwrap_or((position, position.length()))
    }

    /// The surface where a ray hits it, if it does.
    pub fn hit(&self, origin: DVec3, direction: DVec3) -> Option<RayHit> {
        let t = self.shape.t(origin, direction);
        let primitive = self.shape.primitive_at(origin, direction, t);
        t.is_finite().then_some(RayHit { primitive, ..RayHit::at_rest(origin, direction, t) })
    }

    /// The distance that its intersection kernel finds, if it finds one.
    pub fn kernel_t(&self, ray: AimedRay) -> Option<f64> {
        kernel_ts(from_ref(&self.shape), &[ray], f64::INFINITY)[0]
    }
}

/// The distances to the closest of these shapes before `t_max` that the intersection kernel finds, one a ray.
pub fn kernel_ts<S: Shape>(shapes: &[S], rays: &[AimedRay], t_max: f64) -> Vec<Option<f64>> {
    let part = |vector: fn(&AimedRay) -> glam::Vec3, axis: usize| rays.iter().map(|ray| vector(ray)[axis]).collect();
    let origin: [Vec<f32>; 3] = [0, 1, 2].map(|axis| part(|ray| ray.origin, axis));
    let direction: [Vec<f32>; 3] = [0, 1, 2].map(|axis| part(|ray| ray.direction, axis));
    let numbers: Vec<u32> = (0..shapes.len() as u32).collect();
    let (mut t, mut shape) = (vec![t_max; rays.len()], vec![NO_SHAPE; rays.len()]);
    let hits = ClosestHits { t: &mut t, shape: &mut shape, primitive: None, any: false };
    let slices = RaySlices {
        origin: origin.each_ref().map(|part| &part[..]),
        direction: direction.each_ref().map(|part| &part[..]),
    };
    S::keep_closest((shapes, &S::prepared(shapes)), &numbers, slices, hits);
    t.iter().zip(shape).map(|(&t, shape)| (shape != NO_SHAPE).then_some(t)).collect()
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

/// A place so many sizes from the eye; half of all are close to an axis.
fn place(draws: &mut Draws, size: f64, away: f64) -> DVec3 {
    let position = draws.unit_vector() * (size * away);
    let along = position.abs().max_element();
    let beside_axis = position.map(|part| if part.abs() == along { part } else { 2.0 * part / away.max(2.0) });
    if draws.unit() < 0.5 { position } else { beside_axis }
}

impl<S: Oracle> Specimen<S> {
    /// A random point in it or close to it.
    pub fn aim(&self, draws: &mut Draws) -> DVec3 {
        let (centre, radius) = self.sphere_around();
        self.shape.aim(draws).unwrap_or_else(|| centre + draws.unit_vector() * (0.5 * radius))
    }
}
