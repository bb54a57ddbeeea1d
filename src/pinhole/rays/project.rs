use crate::extract::CameraJoinTable;
use glam::{DVec2, DVec3};

/// A connection between a point in front of the camera and the camera (PBRT's `CameraWiSample`).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CameraJoin {
    /// From the point to the origin of the camera ray through it, in world space.
    pub to_camera: DVec3,
    /// The raster point of that ray, in pixels, y down.
    pub raster: DVec2,
    /// The importance We with its geometric term: the contribution to a pixel per unit of radiance and of projected
    /// area at the point, which equals the number of camera rays through a unit of that area with one ray per pixel.
    pub importance: f64,
}

// ANCHOR: raster_from_camera
/// The raster point of a point in camera space: the inverse of all the steps from raster to camera.
///
/// For a perspective camera, `half_height` is that of the image plane at distance 1, and the point has been divided by
/// its depth; for an orthographic camera, it is that of the window, and the point is taken as it is.
#[inline(always)]
pub fn raster_from_camera(camera: DVec2, half_height: f64, size: DVec2) -> DVec2 {
    let screen = camera / half_height;
    let ndc = DVec2::new(0.5 + 0.5 * screen.x * size.y / size.x, 0.5 - 0.5 * screen.y);
    ndc * size
}
// ANCHOR_END: raster_from_camera

// ANCHOR: join_camera
/// Connects a point of render space to a point of the camera's lens; `None` if it is behind the camera or outside the
/// image.
///
/// A pixel is the mean radiance over its area A on the image plane at distance 1.
/// A small surface of projected area s at distance d subtends s / d² sr, which is s / (d² cos³ θ) of that plane, where
/// θ is the angle to the camera's axis; the importance is therefore 1 / (A d² cos³ θ), or d / (A z³) with a depth of
/// z = d cos θ.
/// Parallel rays are equally dense everywhere: their importance is 1 / A.
///
/// A pinhole is a lens that consists of the single point (0, 0).
/// From another point of the lens all pixels are shifted by the same offset on the plane at distance 1, such that on
/// the plane of focus they coincide with those of the pinhole.
#[inline(always)]
pub fn join_camera(join: &CameraJoinTable, lens: DVec2, point: DVec3) -> Option<CameraJoin> {
    let camera = join.camera_from_world * point;
    let depth = -camera.z;
    let (projected, to_camera, importance) = if join.is_perspective {
        let to_lens = join.camera_from_world.transpose() * lens.extend(0.0) - point;
        let falloff = to_lens.length() / (depth * depth * depth);
        let projected = (camera.truncate() - lens) / depth + lens / join.focus_distance;
        (projected, to_lens, falloff / join.pixel_area())
    } else {
        (camera.truncate(), join.camera_from_world.row(2) * depth, 1.0 / join.pixel_area())
    };
    let raster = raster_from_camera(projected, join.half_height, join.size);
    let (min, max) = (DVec2::splat(-join.margin), join.size + join.margin);
    let inside = (raster.x >= min.x) & (raster.y >= min.y) & (raster.x <= max.x) & (raster.y <= max.y);
    (inside & (depth > 0.0)).then_some(CameraJoin { to_camera, raster, importance })
}
// ANCHOR_END: join_camera

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;
    use crate::rays::{
        camera_ray_lens, camera_ray_orthographic, camera_ray_perspective, ndc_from_raster, screen_from_ndc,
    };
    use glam::DMat3;

    /// A camera: orthographic, a pinhole, or a lens and a point of it.
    fn join(draws: &mut Draws, which: u64) -> (CameraJoinTable, DVec2) {
        let back = draws.unit_vector().normalize();
        let right = draws.unit_vector_across(back).normalize();
        let mut join = CameraJoinTable {
            camera_from_world: DMat3::from_cols(right, back.cross(right), back).transpose(),
            is_perspective: which > 0,
            half_height: draws.power_of_ten(-2.0, 1.0),
            focus_distance: f64::INFINITY,
            size: DVec2::new(draws.between(1.0, 4000.0).floor(), draws.between(1.0, 4000.0).floor()),
            margin: 0.5,
        };
        let mut lens = DVec2::ZERO;
        if which > 1 {
            join.focus_distance = draws.power_of_ten(-1.0, 2.0);
            let across = draws.unit_vector_across(DVec3::Z) * join.focus_distance * draws.power_of_ten(-3.0, 0.0);
            lens = across.truncate();
        }
        (join, lens)
    }

    /// The origin and direction of the camera ray through a raster point, in camera space.
    fn ray(join: &CameraJoinTable, lens: DVec2, raster: DVec2) -> (DVec3, DVec3) {
        let screen = screen_from_ndc(ndc_from_raster(raster, join.size), join.size.x / join.size.y);
        match join.is_perspective {
            false => (camera_ray_orthographic(screen, join.half_height), DVec3::NEG_Z),
            true if lens == DVec2::ZERO => (DVec3::ZERO, camera_ray_perspective(screen, join.half_height)),
            true => (lens.extend(0.0), camera_ray_lens(screen, join.half_height, lens, join.focus_distance)),
        }
    }

    /// A point on the ray through a raster point is connected to that raster point.
    #[test]
    fn connections_retrace_camera_rays() {
        let mut worst = 0.0_f64;
        for index in 0..30_000 {
            let mut draws = Draws::new(2701, index);
            let (join, lens) = join(&mut draws, index % 3);
            let raster = DVec2::new(draws.unit(), draws.unit()) * join.size;
            let (origin, direction) = ray(&join, lens, raster);
            let length = draws.power_of_ten(-3.0, 3.0);
            let world_from_camera = join.camera_from_world.transpose();
            let point = world_from_camera * (origin + direction * length);
            let found = join_camera(&join, lens, point).expect("in front");
            // From the rim of a lens a near point is seen at a large offset, which costs digits of its position.
            let far = (1.0 + lens.length() / length) / join.half_height.min(1.0);
            worst = worst.max((found.raster - raster).length() / join.size.max_element() / far);
            let back = point + found.to_camera - world_from_camera * origin;
            assert!(back.length() <= 1e-12 * (length + origin.length()), "{index}");
        }
        // A point at a distance of 10³ from a window 10⁻² high has lost five digits of its position across.
        assert!(worst < 1e-10, "{worst}");
        eprintln!("connections: 30000 points, worst {worst:.1e} of the image");
    }

    /// The importance, integrated over a surface that fills the image, is 1 per pixel.
    #[test]
    fn a_pixel_s_importance_is_the_pdf_of_its_rays() {
        let mut tried = 0;
        for index in 0..3000 {
            let mut draws = Draws::new(2702, index);
            let (join, lens) = join(&mut draws, index % 3);
            // The corners of a patch of some plane, a ten-thousandth of a pixel wide in the image.
            let raster = DVec2::new(draws.unit(), draws.unit()) * (join.size - 1.0);
            let normal = draws.unit_vector().normalize();
            let at = |raster: DVec2| {
                let world_from_camera = join.camera_from_world.transpose();
                let (origin, direction) = ray(&join, lens, raster);
                let (origin, direction) = (world_from_camera * origin, world_from_camera * direction);
                let offset = world_from_camera * DVec3::NEG_Z * 10.0;
                origin + direction * (normal.dot(offset - origin) / normal.dot(direction))
            };
            let step = 1e-4;
            let (a, b, c) = (at(raster), at(raster + DVec2::X * step), at(raster + DVec2::Y * step));
            let area = (b - a).cross(c - a).length();
            let Some(found) = join_camera(&join, lens, a) else { continue };
            let cosine = normal.dot(found.to_camera.normalize()).abs();
            if cosine < 0.05 {
                continue;
            }
            let pixels = found.importance * area * cosine;
            assert!((pixels / (step * step) - 1.0).abs() < 1e-2, "{index}: {pixels:e}");
            tried += 1;
        }
        assert!(tried > 1000, "{tried}");
        eprintln!("importance: {tried} points, each within 1 % of the number of camera rays per area");
    }

    #[test]
    fn nothing_behind_the_camera_is_connected() {
        for which in [1, 2] {
            let (join, lens) = join(&mut Draws::new(2703, 0), which);
            let back = join.camera_from_world.row(2);
            assert!(join_camera(&join, lens, back).is_none() && join_camera(&join, lens, DVec3::ZERO).is_none());
            let ahead = join_camera(&join, lens, -back * join.focus_distance.min(1.0));
            assert!(ahead.is_some());
        }
    }
}
