//! Ray against triangle as the textbooks have it.

use glam::{DVec3, Vec3};

// ANCHOR: naive_moller_trumbore
/// The t where the ray hits a triangle (Möller and Trumbore 1997), in f32, with the constant of their paper.
///
/// Each triangle solves for its own two coordinates, with its own rounding: along an edge that two triangles share, both
/// may find the ray outside, and light leaks through.
/// The constant has a size, and a scene has none: a triangle that is small or seen flat is called parallel and lost.
#[must_use]
pub fn hit_f32(origin: Vec3, direction: Vec3, [a, b, c]: [Vec3; 3]) -> Option<f32> {
    let (e1, e2) = (b - a, c - a);
    let p = direction.cross(e2);
    let determinant = e1.dot(p);
    if determinant.abs() < 1e-6 {
        return None;
    }
    let s = (origin - a) / determinant;
    let u = s.dot(p);
    let q = s.cross(e1);
    let v = direction.dot(q);
    let t = e2.dot(q);
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}
// ANCHOR_END: naive_moller_trumbore

/// The test of Woop, Benthin and Wald as published: sheared corners and edge functions in f32, an edge function that
/// comes out 0 once more in f64.
///
/// No light leaks, for two triangles round their common corners alike.
/// But what is watertight is the mesh of rounded corners, not the one that was asked for: near edges and far away the hit
/// is another triangle's, and t loses as many digits as the distance is longer than the triangle.
#[must_use]
pub fn hit_woop_f32(origin: Vec3, direction: Vec3, corners: [Vec3; 3]) -> Option<f32> {
    let size = direction.abs();
    let z = if size.z >= size.x && size.z >= size.y { 2 } else { usize::from(size.y > size.x) };
    let (x, y) = ((z + 1) % 3, (z + 2) % 3);
    let (shear_x, shear_y, shear_z) = (direction[x] / direction[z], direction[y] / direction[z], 1.0 / direction[z]);
    let [a, b, c] = corners.map(|corner| {
        let from = corner - origin;
        Vec3::new(from[x] - shear_x * from[z], from[y] - shear_y * from[z], shear_z * from[z])
    });
    let edge = |a: Vec3, b: Vec3| a.x * b.y - a.y * b.x;
    let in_f64 = |a: Vec3, b: Vec3| (f64::from(a.x) * f64::from(b.y) - f64::from(a.y) * f64::from(b.x)) as f32;
    let (mut u, mut v, mut w) = (edge(b, c), edge(c, a), edge(a, b));
    if u == 0.0 || v == 0.0 || w == 0.0 {
        (u, v, w) = (in_f64(b, c), in_f64(c, a), in_f64(a, b));
    }
    let (min, max) = (u.min(v).min(w), u.max(v).max(w));
    let whole = u + v + w;
    let t = (u * a.z + v * b.z + w * c.z) / whole;
    (!(min < 0.0 && max > 0.0) && whole != 0.0 && t > 0.0).then_some(t)
}

/// The same test without the constant, and an edge counted to neither of its triangles.
///
/// "Inside" with `>` for `>=` reads as well, and it leaves out every ray that is aimed at an edge exactly.
#[must_use]
pub fn hit_inside_strictly(origin: DVec3, direction: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (e1, e2) = (b - a, c - a);
    let p = direction.cross(e2);
    let determinant = e1.dot(p);
    let s = origin - a;
    let u = s.dot(p) / determinant;
    let q = s.cross(e1);
    let v = direction.dot(q) / determinant;
    let t = e2.dot(q) / determinant;
    (u > 0.0 && v > 0.0 && u + v < 1.0 && t > 0.0).then_some(t)
}

// ANCHOR: naive_winding
/// A normal by the order in which the corners come, after a placement has moved them.
///
/// Right until something is mirrored: then corners that went round anticlockwise go round clockwise, and outward is
/// inward.
#[must_use]
pub fn normal_by_winding([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize()
}
// ANCHOR_END: naive_winding

#[cfg(test)]
mod tests {
    use super::*;

    const HALF: [Vec3; 3] = [Vec3::new(-1.0, -1.0, -3.0), Vec3::new(1.0, -1.0, -3.0), Vec3::new(-1.0, 1.0, -3.0)];

    #[test]
    fn an_ordinary_triangle_hides_all_of_it() {
        let at = Vec3::new(-0.5, -0.25, 0.0);
        assert_eq!(hit_f32(at, Vec3::NEG_Z, HALF), Some(3.0));
        assert_eq!(hit_woop_f32(at, Vec3::NEG_Z, HALF), Some(3.0));
        assert_eq!(hit_woop_f32(Vec3::ZERO, Vec3::NEG_Z, HALF), Some(3.0));
        assert_eq!(hit_inside_strictly(at.as_dvec3(), DVec3::NEG_Z, HALF.map(|corner| corner.as_dvec3())), Some(3.0));
        assert_eq!(normal_by_winding(HALF.map(|corner| corner.as_dvec3())), DVec3::Z);
    }

    #[test]
    fn small_ones_edges_and_mirrors_show_it() {
        let small = HALF.map(|corner| corner * 1e-4);
        assert_eq!(hit_f32(Vec3::new(-0.5, -0.25, 0.0) * 1e-4, Vec3::NEG_Z, small), None);
        let corners = HALF.map(|corner| corner.as_dvec3());
        assert_eq!(hit_inside_strictly(DVec3::ZERO, DVec3::NEG_Z, corners), None);
        let mirrored = corners.map(|corner| corner * DVec3::new(-1.0, 1.0, 1.0));
        assert_eq!(normal_by_winding(mirrored), DVec3::NEG_Z);
    }
}
