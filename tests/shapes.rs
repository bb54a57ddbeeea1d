//! What every registered shape must hold, with no line for any of them: a new shape is tested as soon as it is listed.

mod closed_forms;
mod together;

use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::extract::pose;
use pinhole::plan::Census;
use pinhole::scene::*;
use pinhole::shapes::emitter::Emitting;
use pinhole::shapes::{
    PlacedCone, PlacedCylinder, Planar, RayHit, SceneShape, UvSlope, double_double_disk_t, double_double_rectangle_t,
    with_shapes,
};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::measure::oracle::Oracle;
use pinhole_lab::measure::specimen::Specimen;

/// Calls a generic function for every registered shape.
macro_rules! for_each_shape {
    ($($kind:ident($shape:ty) $field:ident $plural:literal,)+) => {
        macro_rules! each {
            ($function:ident) => {
                $($function::<$shape>($plural);)+
            };
        }
    };
}
with_shapes!(for_each_shape);

fn scene<C: SceneShape>(component: C, placement: Placement) -> World {
    let mut world = World::new();
    world.spawn((PerspectiveCamera::default(), Resolution { width: 16, height: 16 }));
    world.spawn((component, placement, Matte::default()));
    world
}

/// Rays towards a shape of ordinary size from around it, and what they hit.
fn some_hits<S: Oracle>(seed: u64, tried: u64, mut see: impl FnMut(&Specimen<S>, &RayHit, &mut Draws)) {
    for index in 0..tried {
        let mut draws = Draws::new(seed, index);
        let Some(specimen) = Specimen::<S>::drawn(&mut draws, [0.0, 0.0], 4.0) else { continue };
        let (centre, radius) = specimen.shape.bounding_sphere().unwrap_or((specimen.placement.position, 1.0));
        let origin = centre + draws.unit_vector() * (2.0 * radius);
        let direction = (centre + draws.unit_vector() * (0.9 * radius) - origin).normalize();
        if let Some(hit) = specimen.hit(origin, direction) {
            see(&specimen, &hit, &mut draws);
        }
    }
}

/// Every point that is hit lies in the box and the sphere around the shape.
fn check_bounds<S: Oracle>(name: &str) {
    let mut points = 0;
    some_hits::<S>(3003, 2000, |specimen, hit, _| {
        let surface = specimen.shape.surface(&specimen.surface_data, hit);
        assert!((surface.normal.length() - 1.0).abs() < 1e-6, "{name}: {}", surface.normal);
        assert!(surface.normal.dot(hit.direction) <= 1e-6, "{name}: the normal faces the ray");
        assert!((surface.point - hit.point()).length() < 1e-6 * hit.t, "{name}: {hit:?}");
        points += 1;
        if !S::IS_PART {
            let outward = if surface.outside { surface.normal } else { -surface.normal };
            let sides = [-1e-6, 1e-6].map(|off| specimen.shape.contains(surface.point + off * hit.t * outward));
            // What is infinite is around nothing.
            let is_finite = specimen.shape.bounds().is_some();
            let expected = [S::has_inside(&specimen.component) && is_finite, false];
            assert_eq!(sides, expected, "{name}: is it inside just within and just beyond {}", surface.point);
        }
        let Some(bounds) = specimen.shape.bounds() else { return };
        let point = surface.point;
        assert!(point.cmpge(bounds.min).all() && point.cmple(bounds.max).all(), "{name}: {point} in {bounds:?}");
        let (centre, radius) = specimen.shape.bounding_sphere().expect("as finite as its box");
        assert!((point - centre).length() <= radius * (1.0 + 1e-9), "{name}: {point}");
    });
    eprintln!("bounds of {name}: {points} points inside");
    assert!(points > 100, "{name}: only {points} points");
}

/// The points of many rays come near all six sides of the box.
fn check_tightness<S: Oracle>(name: &str) {
    const RAYS: u32 = 20_000;
    for index in 0..4 {
        let mut draws = Draws::new(3008, index);
        let Some(drawn) = Specimen::<S>::drawn(&mut draws, [0.0, 0.0], 4.0) else { continue };
        // Random rays would not find the thinnest examples, such as a tube of a ten-thousandth of its radius.
        let Some(specimen) = Specimen::<S>::of(S::Component::default(), drawn.placement) else { continue };
        let (Some(bounds), Some((centre, radius))) = (specimen.shape.bounds(), specimen.shape.bounding_sphere()) else {
            continue;
        };
        let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        // The points that come nearest to the six sides; half the rays are aimed close to one of them, so that tips are
        // found.
        let mut nearest = [centre; 6];
        for ray in 0..RAYS {
            let origin = centre + draws.unit_vector() * (2.0 * radius);
            let at = DVec3::new(draws.unit(), draws.unit(), draws.unit());
            let around = draws.unit_vector() * (radius * draws.power_of_ten(-3.0, -0.5));
            let anywhere = bounds.min + at * (bounds.max - bounds.min);
            let aim = if ray % 2 == 0 { anywhere } else { nearest[ray as usize / 2 % 6] + around };
            let direction = (aim - origin).normalize();
            if let Some(hit) = specimen.hit(origin, direction) {
                for (side, nearest) in nearest.iter_mut().enumerate() {
                    let (axis, point) = (side / 2, hit.point());
                    let further = if side % 2 == 0 { point[axis] < min[axis] } else { point[axis] > max[axis] };
                    *nearest = if further { point } else { *nearest };
                }
                (min, max) = (min.min(hit.point()), max.max(hit.point()));
            }
        }
        let loose = (min - bounds.min).max_element().max((bounds.max - max).max_element());
        assert!(loose < 0.1 * radius, "{name}: {bounds:?} is loose by {loose}");
    }
    eprintln!("bounds of {name}: {RAYS} rays each come near all sides");
}

/// The bound of a hit covers the rounding of its point to f32, also around the eye.
fn check_error_bounds<S: Oracle>(name: &str) {
    let mut points = 0;
    for index in 0..2000 {
        let mut draws = Draws::new(3009, index);
        let Some(specimen) = Specimen::<S>::drawn(&mut draws, [0.0, 0.0], 0.02) else { continue };
        let (origin, direction) = (draws.unit_vector() * 0.001, draws.unit_vector());
        let Some(hit) = specimen.hit(origin, direction) else { continue };
        let surface = specimen.shape.surface(&specimen.surface_data, &hit);
        let rounding = (surface.point.as_vec3().as_dvec3() - surface.point).length();
        assert!(rounding <= f64::from(surface.bound), "{name}: {} for {rounding:e} at {hit:?}", surface.bound);
        points += 1;
    }
    eprintln!("error bounds of {name}: {points} points around the eye");
    assert!(points > 20, "{name}: only {points} points");
}

#[test]
fn every_point_of_a_surface_lies_within_its_bounds_and_all_sides_are_neared() {
    each!(check_error_bounds);
    each!(check_bounds);
    each!(check_tightness);
}

/// A shape and everything about it 16 times as large: so is t.
fn check_scaling<S: Oracle>(name: &str) {
    const TIMES: f64 = 16.0;
    let mut rays = 0;
    some_hits::<S>(3004, 1000, |specimen, hit, _| {
        let (mut component, mut placement) = (specimen.component.clone(), specimen.placement);
        component.scale(TIMES);
        placement.position *= TIMES;
        let large = Specimen::<S>::of(component, placement).expect("an accepted shape");
        let (t, large_t) = (hit.t, large.shape.t(hit.origin * TIMES, hit.direction));
        assert!((large_t / t / TIMES - 1.0).abs() < 1e-12, "{name}: {large_t} for {t}");
        rays += 1;
    });
    eprintln!("scaling of {name}: {rays} rays");
}

#[test]
fn a_larger_scene_is_the_same_scene() {
    each!(check_scaling);
}

/// A shape that moves is at every time what a shape that stands there would be.
fn check_motion<S: Oracle>(name: &str) {
    let mut rays = 0;
    some_hits::<S>(3005, 1000, |specimen, hit, draws| {
        let displacement = draws.unit_vector() * 0.1;
        let placement = Placement { position: specimen.placement.position + displacement, ..specimen.placement };
        let there = Specimen::<S>::of(specimen.component.clone(), placement).expect("an accepted shape");
        let moved = specimen.shape.clone().into_any_shape(specimen.surface_data.clone());
        let rest = hit.origin - displacement;
        let (t, standing) = (moved.t(rest, hit.direction), there.shape.t(hit.origin, hit.direction));
        assert!(t == standing || (t - standing).abs() < 1e-6 * standing, "{name}: {t} for {standing}");
        let Some(hit) = there.hit(hit.origin, hit.direction) else { return };
        let surface = moved.surface(&RayHit { origin: rest, displacement, ..hit });
        let still = there.shape.surface(&there.surface_data, &hit);
        assert!((surface.point + displacement - still.point).length() < 1e-9 * hit.t, "{name}");
        assert!((surface.normal - still.normal).length() < 1e-6 && surface.outside == still.outside, "{name}");
        rays += 1;
    });
    eprintln!("motion of {name}: {rays} rays");
}

#[test]
fn a_moving_shape_is_where_it_has_moved_to() {
    each!(check_motion);
}

/// u and v of two hits close to one another differ by what their slope says.
fn check_uv_slopes<S: Oracle>(name: &str) {
    const STEP: f64 = 1e-6;
    let (mut rays, mut worst) = (0, 0.0_f64);
    some_hits::<S>(3006, 1000, |specimen, hit, draws| {
        let world = scene(specimen.component.clone(), specimen.placement);
        let census = Census::of(&world);
        let entity = pinhole::extract::shape_entities(&census)[0];
        let own_from_world = pose(&census, "", entity).expect("a pose").entity_from_world;
        let uv_from_world = S::uv_from_world(&specimen.component, own_from_world);
        let (at, origin) = (specimen.shape.surface(&specimen.surface_data, hit), specimen.placement.position);
        let across = draws.unit_vector_across(at.normal.normalize()) * STEP;
        let Some(next) = specimen.hit(hit.origin + across, hit.direction) else { return };
        let after = specimen.shape.surface(&specimen.surface_data, &next);
        let step = after.point - at.point;
        let uv = |hit: &RayHit, at: DVec3| {
            specimen.shape.uv(&specimen.surface_data, hit, at, uv_from_world * (hit.point() - origin))
        };
        let (before, after_uv) = (uv(hit, at.at), uv(&next, after.at));
        let slope = match specimen.shape.uv_slope(&specimen.surface_data, uv_from_world) {
            UvSlope::OfPrimitive => specimen.shape.uv_slope_of(&specimen.surface_data, hit.primitive),
            slope => slope,
        };
        let own = own_from_world * (at.point - origin);
        let expected = slope.step(own, at.normal, step, own_from_world * step);
        let change = DVec3::new(after_uv[0] - before[0], after_uv[1] - before[1], 0.0);
        // Across a seam or an edge, and at a pole, there is no slope.
        if step.length() > 1e3 * STEP || change.length() > 0.1 || (after.normal - at.normal).length() > 0.1 {
            return;
        }
        worst = worst.max((change - expected).length() / STEP);
        rays += 1;
    });
    eprintln!("uv slopes of {name}: {rays} rays, worst {worst:.1e}");
    assert!(worst < 2e-2 && rays > 50, "{name}: {worst} of {rays}");
}

#[test]
fn u_and_v_change_as_their_slopes_say() {
    each!(check_uv_slopes);
}

/// The visible points of a light that are sampled, cell by cell, against their pdf summed over its area.
fn check_light<S: Oracle>(name: &str) {
    const TRIED: u32 = 40_000;
    const CELLS: usize = 3;
    let (mut lights, mut worst) = (0, 0.0_f64);
    for index in 0..6 {
        let mut draws = Draws::new(3007, index);
        let Some(specimen) = Specimen::<S>::drawn(&mut draws, [0.0, 0.0], 2.0) else { continue };
        let (Some(light), Some(bounds)) = (specimen.shape.emitter(&specimen.surface_data), specimen.shape.bounds())
        else {
            continue;
        };
        let (centre, radius) = specimen.shape.bounding_sphere().expect("as finite as its box");
        let from = centre + draws.unit_vector() * (radius * [1.1, 1.5, 8.0][index as usize % 3]);
        let cell = |point: DVec3| {
            let at = (point - bounds.min) / (bounds.max - bounds.min) * CELLS as f64;
            at.to_array().into_iter().fold(0, |cell, part| cell * CELLS + (part.max(0.0) as usize).min(CELLS - 1))
        };
        let visible = |to: DVec3| specimen.shape.t(from, to) > 1.0 - 1e-6;
        let mut sums = [[0.0; 4]; CELLS * CELLS * CELLS];
        let mut facing = 0;
        for _ in 0..TRIED {
            let sampled = light.point(from, [draws.unit(), draws.unit()]);
            let again = light.pdf(from, from + sampled.to);
            assert!((again / sampled.pdf - 1.0).abs() < 1e-5, "{name}: pdf {} and {again}", sampled.pdf);
            if visible(sampled.to) {
                let bin = &mut sums[cell(from + sampled.to)];
                (bin[0], bin[1]) = (bin[0] + 1.0, bin[1] + 1.0);
            }
            let spot = light.spot([draws.unit(), draws.unit()]);
            let to = spot.position - from;
            assert!(spot.position.abs().max_element() <= spot.size, "{name}: {} beyond {}", spot.position, spot.size);
            facing += u32::from(spot.normal.dot(to) < 0.0);
            if visible(to) {
                let per_area = spot.normal.dot(to).abs() / (to.length_squared() * to.length());
                let weight = spot.area * per_area * light.pdf(from, spot.position);
                let bin = &mut sums[cell(spot.position)];
                (bin[2], bin[3]) = (bin[2] + weight, bin[3] + weight * weight);
            }
        }
        for [count, count_squared, weight, weight_squared] in sums {
            if count + weight > 50.0 {
                worst = worst.max((count - weight).abs() / (count_squared + weight_squared).sqrt());
            }
        }
        // From there it is so small that points are sampled by area.
        let far = centre + (from - centre) * 1e5;
        for _ in 0..100 {
            let sampled = light.point(far, [draws.unit(), draws.unit()]);
            let again = light.pdf(far, far + sampled.to);
            assert!((again / sampled.pdf - 1.0).abs() < 4e-6, "{name}, far: pdf {} and {again}", sampled.pdf);
        }
        assert_eq!(light.faces(from), facing > 0, "{name}: {facing} spots face {from}");
        lights += 1;
    }
    eprintln!("lights that are {name}: {lights} of {TRIED} points each, worst {worst:.1} σ");
    assert!(worst < 4.8, "{name}: {worst} σ");
}

#[test]
fn points_of_lights_fall_as_their_pdfs_say() {
    each!(check_light);
}

/// How flat a cylinder and a cone may be scaled: the longest half axis, √2 long, over the shortest and over 3.
#[test]
fn a_shape_is_refused_only_where_it_is_too_thin() {
    fn is_placed<S: Oracle>(min: f64) -> bool {
        let placement = Placement { scale: DVec3::new(1.0, min, 1.0), ..Placement::default() };
        Specimen::<S>::of(S::Component::default(), placement).is_some()
    }
    let limit = 2.0_f64.sqrt() / 3.0 / 1e6;
    for (name, is_placed) in
        [("cylinder", is_placed::<PlacedCylinder> as fn(f64) -> bool), ("cone", is_placed::<PlacedCone>)]
    {
        assert!(is_placed(1.05 * limit) && !is_placed(0.95 * limit), "{name}");
    }
}

/// On a slope where the products in n · f are not 0, but cancel.
#[test]
fn a_ray_that_starts_on_a_planar_shape_does_not_hit_it() {
    let half_edges = [DVec3::new(1.0, -1.0, 0.0), DVec3::Z];
    let planar = Planar::new(DVec3::ZERO, DVec3::new(1.0, 1.0, 0.0), half_edges).expect("an area");
    let on_it = DVec3::new(0.25, -0.25, 0.0);
    for t in [double_double_disk_t, double_double_rectangle_t] {
        assert_eq!(t(on_it, planar.normal, &planar), f64::INFINITY);
        assert!((t(on_it - planar.normal, planar.normal, &planar) - 1.0).abs() < 1e-6);
    }
}
