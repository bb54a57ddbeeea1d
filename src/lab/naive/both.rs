//! The two orders in which a picture can be made, and what projection has to be told of a shape that is round: its extent
//! on the image, or triangles in its place.

use glam::DVec3;
use pinhole::models::TriangleMesh;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A t and the number of the triangle that it belongs to.
pub type Nearest = (f64, usize);

/// Nothing was hit.
pub const NOTHING: Nearest = (f64::INFINITY, usize::MAX);

// ANCHOR: two_orders
/// For each ray the nearest triangle, ray by ray; `t_of` is infinite where a ray misses a triangle.
#[must_use]
pub fn image_order(rays: usize, triangles: usize, t_of: impl Fn(usize, usize) -> f64) -> Vec<Nearest> {
    let mut nearest = vec![NOTHING; rays];
    for ray in 0..rays {
        for triangle in 0..triangles {
            keep_nearest(&mut nearest[ray], t_of(ray, triangle), triangle);
        }
    }
    nearest
}

/// The same, triangle by triangle.
#[must_use]
pub fn object_order(rays: usize, triangles: usize, t_of: impl Fn(usize, usize) -> f64) -> Vec<Nearest> {
    let mut nearest = vec![NOTHING; rays];
    for triangle in 0..triangles {
        for ray in 0..rays {
            keep_nearest(&mut nearest[ray], t_of(ray, triangle), triangle);
        }
    }
    nearest
}
// ANCHOR_END: two_orders

fn keep_nearest(nearest: &mut Nearest, t: f64, triangle: usize) {
    if t < nearest.0 {
        *nearest = (t, triangle);
    }
}

// ANCHOR: interval_at_its_depth
/// A sphere's interval on the image plane, if it were a disk that faces the plane.
#[must_use]
pub fn interval_at_its_depth(right: f64, ahead: f64, radius: f64) -> [f64; 2] {
    [(right - radius) / ahead, (right + radius) / ahead]
}
// ANCHOR_END: interval_at_its_depth

/// The right interval, cut off at ±`half`: by the angles to the sphere's centre and from there to its outline.
#[must_use]
pub fn sphere_interval(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
    let distance = libm::hypot(right, ahead);
    if distance <= radius {
        return [-half, half];
    }
    let (to_centre, to_outline) = (libm::atan2(right, ahead), libm::asin(radius / distance));
    [-1.0, 1.0].map(|side| {
        let angle = to_centre + side * to_outline;
        if angle.abs() < FRAC_PI_2 { libm::tan(angle).clamp(-half, half) } else { side * half }
    })
}

/// A sphere about the origin as a mesh with shading normals: `around` triangles at each pole, and half as many rings.
#[must_use]
pub fn globe(radius: f64, around: u32) -> TriangleMesh {
    let (around, rings) = (around.max(3), around.max(4) / 2);
    let normal = |ring: u32, side: u32| {
        let [latitude, longitude] =
            [f64::from(ring) / f64::from(rings) * PI, f64::from(side % around) / f64::from(around) * TAU];
        let (up, out) = (libm::cos(latitude), libm::sin(latitude));
        DVec3::new(out * libm::cos(longitude), up, out * libm::sin(longitude))
    };
    // One vertex at each pole, and between them a ring after another.
    let inner = (1..rings).flat_map(|ring| (0..around).map(move |side| (ring, side)));
    let normals: Vec<DVec3> =
        [DVec3::Y].into_iter().chain(inner.map(|(ring, side)| normal(ring, side))).chain([DVec3::NEG_Y]).collect();
    let last = normals.len() as u32 - 1;
    let vertex = |ring: u32, side: u32| match ring {
        0 => 0,
        ring if ring == rings => last,
        ring => 1 + (ring - 1) * around + side % around,
    };
    let mut triangles = Vec::new();
    for (ring, side) in (0..rings).flat_map(|ring| (0..around).map(move |side| (ring, side))) {
        let [a, b] = [vertex(ring, side), vertex(ring, side + 1)];
        let [c, d] = [vertex(ring + 1, side), vertex(ring + 1, side + 1)];
        if ring > 0 {
            triangles.push([a, b, c]);
        }
        if ring + 1 < rings {
            triangles.push([b, d, c]);
        }
    }
    TriangleMesh {
        positions: normals.iter().map(|normal| (*normal * radius).as_vec3().to_array()).collect(),
        normals: Some(normals.iter().map(|normal| normal.as_vec3().to_array()).collect()),
        triangles,
        ..TriangleMesh::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;
    use pinhole::shapes::sphere_t;

    #[test]
    fn both_orders_find_the_same_triangles() {
        // Few different numbers, so that many are equal, and some are missed.
        let t_of = |ray: usize, triangle: usize| match (7 * ray + 5 * triangle + ray * triangle) % 11 {
            0..=3 => f64::INFINITY,
            t => t as f64,
        };
        let by_rays = image_order(300, 40, t_of);
        assert_eq!(by_rays, object_order(300, 40, t_of));
        assert!(by_rays.iter().any(|nearest| nearest.1 > 0 && nearest.1 < 40));
        assert_eq!(image_order(2, 0, t_of), [NOTHING; 2]);
    }

    #[test]
    fn the_page_s_numbers() {
        let [left, right] = sphere_interval(3.0, 4.0, 3.0, 4.0);
        assert!(left.abs() < 1e-15 && (right - 24.0 / 7.0).abs() < 1e-14, "{left} {right}");
        assert_eq!(interval_at_its_depth(3.0, 4.0, 3.0), [0.0, 1.5]);
    }

    /// No ray outside the interval hits, and just inside of its ends one does.
    #[test]
    fn rays_hit_a_sphere_inside_its_interval_and_nowhere_else() {
        let (half, mut hits) = (3.0, 0);
        for index in 0..400 {
            let mut draws = Draws::new(3402, index);
            let radius = draws.between(0.2, 2.0);
            let (right, ahead) = (draws.between(-4.0, 4.0), draws.between(-radius, 4.0));
            let ends = sphere_interval(right, ahead, radius, half);
            let centre = DVec3::new(right, 0.0, -ahead);
            let is_hit = |x: f64| sphere_t(DVec3::ZERO, DVec3::new(x, 0.0, -1.0), centre, radius).is_finite();
            for step in 0..=600 {
                let x = (f64::from(step) / 300.0 - 1.0) * half;
                if is_hit(x) {
                    assert!(ends[0] <= x && x <= ends[1], "{x} is outside {ends:?} of {right} {ahead} {radius}");
                    hits += 1;
                }
            }
            let inside = 1e-9 * (ends[1] - ends[0]);
            if inside > 0.0 {
                assert!(is_hit(ends[0] + inside) && is_hit(ends[1] - inside), "{ends:?} of {right} {ahead} {radius}");
            }
        }
        assert!(hits > 10_000, "{hits}");
    }

    #[test]
    fn a_globe_is_closed_and_turns_its_outside_out() {
        let mesh = globe(2.0, 12);
        assert_eq!((mesh.triangles.len(), mesh.positions.len()), (2 * 12 * 5, 2 + 12 * 5));
        let mut edges = std::collections::BTreeSet::new();
        for &[a, b, c] in &mesh.triangles {
            let [pa, pb, pc] = [a, b, c].map(|vertex| DVec3::from(mesh.positions[vertex as usize].map(f64::from)));
            assert!((pb - pa).cross(pc - pa).dot(pa + pb + pc) > 0.0, "{a} {b} {c}");
            [(a, b), (b, c), (c, a)].into_iter().for_each(|edge| assert!(edges.insert(edge), "{edge:?} twice"));
        }
        assert!(edges.iter().all(|&(from, to)| edges.contains(&(to, from))));
    }
}
