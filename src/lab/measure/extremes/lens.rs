//! Lenses: do rays converge where the camera is focused, is the opening filled evenly, how wide is what is out of focus?

use super::{Group, Method, Tally, Trial};
use crate::measure::draws::Draws;
use crate::measure::exact::Dyadic;
use crate::naive::lens::{focus_along_the_ray, onto_disk, radius_at_random, square_onto_disk};
use glam::{DVec2, DVec3};
use pinhole::extract::{LensTable, tan_half};
use pinhole::rays::{camera_ray_lens, polygon_point};
use pinhole::scene::{Aperture, Degrees, Lens};
use std::ops::Range;

/// By how much the sum of |P| and 2|L| is rounded in f64: 4 roundings of 2⁻⁵³ in each direction.
const FOCUS: f64 = 1e-15;
const IN_FOCUS: [Method; 2] = [
    Method::pinhole("pinhole, a plane across the axis", "of |P| + 2|L|", FOCUS),
    Method::naive("naive, so far along the ray", "of |P| + 2|L|", FOCUS),
];
/// Points a shell; with n points a fraction p is off by 4 √(p (1 − p) / n) at most, in all but one of 16000 inputs.
const POINTS: u32 = 4096;
const SPREAD: f64 = 4.5 * 0.5 / 64.0;
const EVENLY: [Method; 3] = [
    Method::pinhole("pinhole, squares to circles", "of the area", SPREAD),
    Method::naive("naive, a random radius", "of the area", SPREAD),
    Method::naive("naive, a square cut off", "of the area", SPREAD),
];
const POLYGONS: [Method; 2] = [
    Method::pinhole("pinhole, a triangle an edge", "of the area", SPREAD),
    Method::naive("naive, the disk instead", "of the area", SPREAD),
];
/// The edge of the circle, f64 and a quotient away.
const CIRCLE: [Method; 2] = [
    Method::pinhole("pinhole, a plane across the axis", "of the circle", 1e-9),
    Method::naive("naive, so far along the ray", "of the circle", 1e-9),
];

/// The cases of the group.
pub fn trials() -> Vec<Trial> {
    vec![
        Trial::new(Group::Lens, "in focus, 45°", &IN_FOCUS, |range| {
            check_in_focus(range, 2311, [45.0, 45.0], [-1.0, 1.0])
        }),
        Trial::new(Group::Lens, "in focus, 0.001° to 179°", &IN_FOCUS, |range| {
            check_in_focus(range, 2312, [1e-3, 179.0], [-1.0, 1.0])
        }),
        Trial::new(Group::Lens, "in focus, lens and focus 10^−6 to 10^6", &IN_FOCUS, |range| {
            check_in_focus(range, 2313, [20.0, 120.0], [-6.0, 6.0])
        }),
        Trial::new(Group::Lens, "the area fraction of a round opening", &EVENLY, check_disk).at_most(1024),
        Trial::new(Group::Lens, "the area fraction of an opening with edges", &POLYGONS, check_polygon).at_most(1024),
        Trial::new(Group::Lens, "the edge of what is out of focus", &CIRCLE, check_circle),
    ]
}

/// How far a ray from the lens passes from where the pinhole's is in focus.
fn check_in_focus(range: Range<u64>, seed: u64, fov: [f64; 2], powers: [f64; 2]) -> Tally {
    let mut tally = Tally::new(IN_FOCUS.len());
    for index in range {
        let mut draws = Draws::new(seed, index);
        let tangent = tan_half(Degrees(draws.between(fov[0], fov[1])));
        let screen = DVec2::new(draws.between(-1.78, 1.78), draws.between(-1.0, 1.0));
        let (radius, focus) = (draws.power_of_ten(powers[0], powers[1]), draws.power_of_ten(powers[0], powers[1]));
        let lens = onto_disk(DVec2::new(draws.unit(), draws.unit())) * radius;
        tally.count(true);
        for (score, aim) in tally.scores.iter_mut().zip([camera_ray_lens, focus_along_the_ray]) {
            score.measure(miss(screen, tangent, lens, focus, aim(screen, tangent, lens, focus)));
        }
    }
    tally
}

/// How far from the point P in focus a ray from L is at that depth, over |P| + 2|L|; in exact arithmetic but for the last
/// quotient.
fn miss(screen: DVec2, tangent: f64, lens: DVec2, focus: f64, direction: DVec3) -> f64 {
    let exact = Dyadic::of;
    // (L + D f / −D_z − P) (−D_z), in which nothing is divided.
    let depth = exact(-direction.z);
    let off = |screen: f64, lens: f64, along: f64| {
        let there = &(&exact(lens) * &depth) + &(&exact(along) * &exact(focus));
        let wanted = &(&(&exact(screen) * &exact(tangent)) * &exact(focus)) * &depth;
        (&there - &wanted).to_f64() / -direction.z
    };
    let off = DVec2::new(off(screen.x, lens.x, direction.x), off(screen.y, lens.y, direction.y));
    off.length() / (screen.length() * tangent * focus + 2.0 * lens.length())
}

/// The points of an input: random, so that no pattern of a sampler helps.
fn points(seed: u64, index: u64) -> impl Iterator<Item = DVec2> {
    let mut draws = Draws::new(seed, index);
    (0..POINTS).map(move |_| DVec2::new(draws.unit(), draws.unit()))
}

/// How far the fraction of points within a circle, and to one side of a line through the centre, is from that of the area.
fn check_disk(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(EVENLY.len());
    for index in range {
        let mut draws = Draws::new(2314, index);
        let (fraction, side) = (draws.between(0.1, 0.9), draws.unit() * std::f64::consts::TAU);
        let across = DVec2::new(libm::cos(side), libm::sin(side));
        tally.count(true);
        for (score, spread) in tally.scores.iter_mut().zip([onto_disk, radius_at_random, square_onto_disk]) {
            let (mut within, mut beside) = (0, 0);
            for point in points(2315, index).map(spread) {
                within += u32::from(point.length_squared() < fraction);
                beside += u32::from(point.dot(across) > 0.0);
            }
            let off = |count: u32, fraction: f64| (f64::from(count) / f64::from(POINTS) - fraction).abs();
            score.measure(off(within, fraction).max(off(beside, 0.5)));
        }
    }
    tally
}

/// The same of a polygon, within a smaller one.
fn check_polygon(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(POLYGONS.len());
    for index in range {
        let mut draws = Draws::new(2316, index);
        let (fraction, blades) = (draws.between(0.1, 0.9), 3 + (index % 7) as u32);
        let aperture = Aperture::Radius { radius: 1.0 };
        let lens = Lens { aperture, blades, turn: Degrees(draws.between(0.0, 360.0)), ..Lens::default() };
        let Ok(opening) = LensTable::of(&lens, "") else { continue };
        // Within a polygon √fraction as large: on the inner side of every edge of it.
        let edges: Vec<(DVec2, f64)> = opening
            .corners
            .windows(2)
            .map(|pair| {
                let outward = (pair[1] - pair[0]).perp() * -1.0;
                (outward, outward.dot(pair[0]) * fraction.sqrt())
            })
            .collect();
        let within = |point: DVec2| edges.iter().all(|&(outward, distance)| outward.dot(point) < distance);
        tally.count(true);
        let spreads: [&dyn Fn(DVec2) -> DVec2; 2] = [&|u| polygon_point(u, &opening.corners), &onto_disk];
        for (score, spread) in tally.scores.iter_mut().zip(spreads) {
            let count = points(2317, index).filter(|&u| within(spread(u))).count();
            score.measure((count as f64 / f64::from(POINTS) - fraction).abs());
        }
    }
    tally
}

/// A point off the axis at depth z, seen through the lens's edge: where its ray has hit the plane in focus.
fn check_circle(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(CIRCLE.len());
    for index in range {
        let mut draws = Draws::new(2318, index);
        let (radius, focus) = (draws.between(0.01, 0.5), draws.power_of_ten(0.0, 2.0));
        let depth = focus * draws.power_of_ten(-0.5, 2.0);
        let lens = Lens { aperture: Aperture::Radius { radius }, focus_distance: focus, ..Lens::default() };
        let Ok(table) = LensTable::of(&lens, "") else { continue };
        let circle = table.circle_of_confusion(depth);
        let turn = draws.unit() * std::f64::consts::TAU;
        let edge = DVec2::new(libm::cos(turn), libm::sin(turn)) * radius;
        // The screen point, with a tangent of 1, whose ray from the edge of the lens passes through the point.
        let at = DVec2::new(draws.between(-1.0, 1.0), draws.between(-1.0, 1.0));
        let screen = at + edge * (1.0 / focus - 1.0 / depth);
        tally.count(circle > 1e-6);
        for (score, aim) in tally.scores.iter_mut().zip([camera_ray_lens, focus_along_the_ray]) {
            let direction = aim(screen, 1.0, edge, focus);
            let there = edge + direction.truncate() * (depth / -direction.z);
            score.measure((there - at * depth).length() * focus / depth / (circle + radius * 1e-3));
        }
    }
    tally
}
