use crate::extract::CameraJoinTable;
use glam::{DVec2, DVec3};

/// A point in front of the camera, joined to it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CameraJoin {
    /// From the point to where the camera's ray through it starts.
    pub to_camera: DVec3,
    /// Where in the image that ray goes through, in pixels; y down.
    pub raster: DVec2,
    /// What a pixel makes of a unit of light that the point sends to the camera per steradian, and per unit of its area
    /// as seen from there: a measure of how dense the camera's rays are at the point.
    pub importance: f64,
}

// ANCHOR: raster_from_camera
/// The raster point of a point in camera space: every step from raster to camera turned round.
///
/// `half_height` is that of the image plane at distance 1, and the point divided by its distance along the axis; or that
/// of the view's rectangle, and the point itself.
#[inline(always)]
pub fn raster_from_camera(camera: DVec2, half_height: f64, size: DVec2) -> DVec2 {
    let screen = camera / half_height;
    let ndc = DVec2::new(0.5 + 0.5 * screen.x * size.y / size.x, 0.5 - 0.5 * screen.y);
    ndc * size
}
// ANCHOR_END: raster_from_camera

// ANCHOR: join_camera
/// Joins a point of render space to a point of the camera's lens; none where it lies behind it, or where no pixel sees it.
///
/// A pixel is the mean over its area A on the plane at distance 1 of what comes along the rays through it.
/// A small surface at the point, s wide across the ray, fills s / d² sr, which is s / (d² cos³ θ) of that plane (θ the
/// angle off the camera's axis): so the pixel gets 1 / (A d² cos³ θ) of each unit that is sent to it.
/// With a depth of z = d cos θ that is d / (A z³).
/// Parallel rays are as dense everywhere: 1 / A.
///
/// A pinhole is a lens of one point, (0, 0).
/// From another point all pixels look elsewhere, as dense and as far from one another: they are moved on the plane at
/// distance 1, so that at the focus distance they come to lie where the pinhole has them.
#[inline(always)]
pub fn join_camera(join: &CameraJoinTable, lens: DVec2, point: DVec3) -> Option<CameraJoin> {
    let camera = join.camera_from_world * point;
    let depth = -camera.z;
    if depth <= 0.0 {
        return None;
    }
    let (along, to_camera, importance) = if join.is_perspective {
        let to_lens = join.camera_from_world.transpose() * lens.extend(0.0) - point;
        let thinned = to_lens.length() / (depth * depth * depth);
        let along = (camera.truncate() - lens) / depth + lens / join.focus_distance;
        (along, to_lens, thinned / join.pixel_area())
    } else {
        (camera.truncate(), join.camera_from_world.row(2) * depth, 1.0 / join.pixel_area())
    };
    let raster = raster_from_camera(along, join.half_height, join.size);
    let (least, most) = (DVec2::splat(-join.margin), join.size + join.margin);
    let seen = raster.cmpge(least).all() && raster.cmple(most).all();
    seen.then_some(CameraJoin { to_camera, raster, importance })
}
// ANCHOR_END: join_camera

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::ray_aim::Draws;
    use crate::rays::{
        camera_ray_lens, camera_ray_orthographic, camera_ray_perspective, ndc_from_raster, screen_from_ndc,
    };
    use glam::DMat3;

    /// A camera: a rectangle, a pinhole, or a lens and a point of it.
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

    /// Where the camera's ray through a raster point starts, and where it goes, in camera space.
    fn ray(join: &CameraJoinTable, lens: DVec2, raster: DVec2) -> (DVec3, DVec3) {
        let screen = screen_from_ndc(ndc_from_raster(raster, join.size), join.size.x / join.size.y);
        match join.is_perspective {
            false => (camera_ray_orthographic(screen, join.half_height), DVec3::NEG_Z),
            true if lens == DVec2::ZERO => (DVec3::ZERO, camera_ray_perspective(screen, join.half_height)),
            true => (lens.extend(0.0), camera_ray_lens(screen, join.half_height, lens, join.focus_distance)),
        }
    }

    /// A point on the ray through a raster point is joined to that raster point.
    #[test]
    fn joins_lead_back_along_the_camera_s_own_rays() {
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
            // What is near a lens is seen far off to its side; a digit of the way there is one of the place.
            let far = (1.0 + lens.length() / length) / join.half_height.min(1.0);
            worst = worst.max((found.raster - raster).length() / join.size.max_element() / far);
            let back = point + found.to_camera - world_from_camera * origin;
            assert!(back.length() <= 1e-12 * (length + origin.length()), "{index}");
        }
        // A point 10³ away on a rectangle 10⁻² high has lost five digits of its place across.
        assert!(worst < 1e-10, "{worst}");
        eprintln!("joins: 30000 points, worst {worst:.1e} of the image");
    }

    /// The importance, integrated over a surface that fills the image, is one a pixel.
    #[test]
    fn a_pixel_s_importance_is_the_pdf_of_its_rays() {
        let mut tried = 0;
        for index in 0..3000 {
            let mut draws = Draws::new(2702, index);
            let (join, lens) = join(&mut draws, index % 3);
            // The corners of a piece of a plane across some axis, a thousandth of a pixel wide on the image.
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
            let slant = normal.dot(found.to_camera.normalize()).abs();
            if slant < 0.05 {
                continue;
            }
            let pixels = found.importance * area * slant;
            assert!((pixels / (step * step) - 1.0).abs() < 1e-2, "{index}: {pixels:e}");
            tried += 1;
        }
        assert!(tried > 1000, "{tried}");
        eprintln!("importance: {tried} places, each within 1 % of the density of the camera's rays");
    }

    #[test]
    fn nothing_behind_the_camera_is_joined() {
        for which in [1, 2] {
            let (join, lens) = join(&mut Draws::new(2703, 0), which);
            let back = join.camera_from_world.row(2);
            assert!(join_camera(&join, lens, back).is_none() && join_camera(&join, lens, DVec3::ZERO).is_none());
            let ahead = join_camera(&join, lens, -back * join.focus_distance.min(1.0));
            assert!(ahead.is_some());
        }
    }
}
