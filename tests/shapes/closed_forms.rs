//! Cylinders, cones and tori as functions of u and v: the point, the normal and both derivatives, in closed form.

use glam::{DMat3, DVec3};
use pinhole::scene::*;
use pinhole::shapes::{PlacedCone, PlacedCylinder, PlacedTorus, SceneShape};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::oracle::Oracle;
use pinhole_lab::measure::specimen::Specimen;
use std::f64::consts::TAU;

/// A point of a surface in object space, its unnormalised outward normal, and the derivatives by u and v.
struct Spot {
    point: DVec3,
    normal: DVec3,
    by_u: DVec3,
    by_v: DVec3,
    /// How far along the normal there is certainly nothing else.
    room: f64,
}

/// A component whose side is a known function of u and v.
trait Parametric: SceneShape + std::fmt::Debug {
    fn spot(&self, u: f64, v: f64) -> Spot;
}

/// Away from the y axis at the longitude of u, and the derivative of that by u.
fn away(u: f64) -> [DVec3; 2] {
    let (sin, cos) = (libm::sin(TAU * u), libm::cos(TAU * u));
    [DVec3::new(-sin, 0.0, -cos), TAU * DVec3::new(-cos, 0.0, sin)]
}

impl Parametric for Cylinder {
    fn spot(&self, u: f64, v: f64) -> Spot {
        let ([out, turned], Self { radius, height, .. }) = (away(u), *self);
        let point = radius * out + height * (0.5 - v) * DVec3::Y;
        Spot { point, normal: out, by_u: radius * turned, by_v: -height * DVec3::Y, room: radius }
    }
}

impl Parametric for Cone {
    fn spot(&self, u: f64, v: f64) -> Spot {
        let ([out, turned], Self { radius, height, .. }) = (away(u), *self);
        Spot {
            point: v * radius * out + height * (0.5 - v) * DVec3::Y,
            normal: height * out + radius * DVec3::Y,
            by_u: v * radius * turned,
            by_v: radius * out - height * DVec3::Y,
            room: radius,
        }
    }
}

impl Parametric for Torus {
    fn spot(&self, u: f64, v: f64) -> Spot {
        let ([out, turned], Self { radius, tube }) = (away(u), *self);
        let (sin, cos) = (libm::sin(TAU * v), libm::cos(TAU * v));
        Spot {
            point: (radius + tube * sin) * out + tube * cos * DVec3::Y,
            normal: sin * out + cos * DVec3::Y,
            by_u: (radius + tube * sin) * turned,
            by_v: TAU * tube * (cos * out - sin * DVec3::Y),
            room: 0.1 * tube.min(radius - tube),
        }
    }
}

fn check<S: Oracle>(name: &str)
where
    S::Component: Parametric,
{
    const POINTS: u64 = 4000;
    let mut worst = [0.0_f64; 5];
    for index in 0..POINTS {
        let mut draws = Draws::new(3021, index);
        let away = draws.power_of_ten(0.5, 2.0);
        let specimen = Specimen::<S>::drawn(&mut draws, [-2.0, 2.0], away).expect("an accepted shape");
        let Placement { position, orientation, scale } = specimen.placement;
        let world_from_own = DMat3::from_quat(orientation) * DMat3::from_diagonal(scale);
        let own_from_world = world_from_own.inverse();
        let (u, v) = (draws.between(0.01, 0.99), draws.between(0.05, 0.95));
        let Spot { point: own, normal, by_u, by_v, room } = specimen.component.spot(u, v);
        let (point, normal) = (position + world_from_own * own, (own_from_world.transpose() * normal).normalize());
        let distance = room * scale.min_element();
        let hit = specimen.hit(point + distance * normal, -normal).expect("the point is hit");
        let surface = specimen.shape.surface(&specimen.surface_data, &hit);
        assert!(surface.outside, "{name}: the outer side of {:?} at {u}, {v}", specimen.component);
        let found = specimen.shape.uv(&specimen.surface_data, &hit, surface.at, own);
        let slope = specimen.shape.uv_slope(&specimen.surface_data, own_from_world);
        let step = |by: DVec3| slope.step(own, normal, world_from_own * by, by);
        // A normal is known as well as the point is, relative to the thinnest part.
        let known = 1e-14 * position.length() / distance;
        let errors = [
            (hit.t / distance - 1.0).abs() / known,
            (surface.normal - normal).length() / known,
            (found[0] - u).abs().max((found[1] - v).abs()) / known,
            (step(by_u) - DVec3::X).length(),
            (step(by_v) - DVec3::Y).length(),
        ];
        worst = [0, 1, 2, 3, 4].map(|which| worst[which].max(errors[which]));
    }
    let [t, turned, uv, u_slope, v_slope] = worst;
    eprintln!(
        "closed forms of {name}: {POINTS} points; in units of what is known t is off by {t:.2}, the normal by \
         {turned:.2}, u and v by {uv:.2}; their derivatives by {u_slope:.1e} and {v_slope:.1e}"
    );
    assert!(t < 10.0 && turned < 10.0 && uv < 10.0, "{name}: {worst:?}");
    assert!(u_slope < 1e-9 && v_slope < 1e-9, "{name}: {worst:?}");
}

#[test]
fn points_normals_and_derivatives_are_those_of_the_closed_forms() {
    check::<PlacedCylinder>("cylinders");
    check::<PlacedCone>("cones");
    check::<PlacedTorus>("tori");
}
