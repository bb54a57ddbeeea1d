//! The oracle of a camera's points and rays: enclosed first, exactly where that cannot tell.
//!
//! Reads: what [`ExactCamera`] reads. Writes: the errors that it writes; lengths and angles within 2⁻²⁰ of themselves.

use super::enclosure::Enclosure;
use super::number::Number;
use super::oracle_camera::{ExactCamera, OracleCamera, Point};
use glam::{DMat3, DVec2, DVec3, Vec3};
use pinhole::scene::FovAxis;
use std::sync::OnceLock;

/// The centre of a pixel within it.
const CENTRE: DVec2 = DVec2::splat(0.5);

/// A camera as both oracles have it; the exact one is made when it is first asked.
#[derive(Clone, Debug)]
pub struct CameraOracle {
    /// The image's width in pixels.
    pub width: u32,
    /// The image's height in pixels.
    pub height: u32,
    full_angle: f64,
    axis: FovAxis,
    enclosed: OracleCamera<Enclosure>,
    exact: OnceLock<ExactCamera>,
}

impl CameraOracle {
    /// The oracle of the camera whose image of `width` × `height` pixels spans `full_angle` degrees along `axis`.
    #[must_use]
    pub fn new(width: u32, height: u32, full_angle: f64, axis: FovAxis, rotation: DMat3) -> Self {
        let enclosed = OracleCamera::new(width, height, full_angle, axis, rotation);
        Self { width, height, full_angle, axis, enclosed, exact: OnceLock::new() }
    }

    /// The same camera, turned so.
    #[must_use]
    pub fn turned(&self, rotation: DMat3) -> Self {
        let mut turned = self.clone();
        turned.enclosed.rotation = rotation;
        if let Some(exact) = turned.exact.get_mut() {
            exact.rotation = rotation;
        }
        turned
    }

    /// The camera's axes in the world, as columns.
    #[must_use]
    pub fn rotation(&self) -> DMat3 {
        self.enclosed.rotation
    }

    fn exact(&self) -> &ExactCamera {
        let make = || OracleCamera::new(self.width, self.height, self.full_angle, self.axis, self.rotation());
        self.exact.get_or_init(make)
    }

    /// What the enclosed camera answers, or else the exact one.
    fn told<T>(
        &self,
        enclosed: impl FnOnce(&OracleCamera<Enclosure>) -> Option<T>,
        exact: impl FnOnce(&ExactCamera) -> Option<T>,
        unknown: T,
    ) -> T {
        enclosed(&self.enclosed).or_else(|| exact(self.exact())).unwrap_or(unknown)
    }

    /// The width of one pixel on the plane z = −1, rounded to f64 once.
    #[must_use]
    pub fn pixel_pitch(&self) -> f64 {
        self.told(|camera| camera.pixel_pitch().rounded(), |camera| camera.pixel_pitch().rounded(), f64::NAN)
    }

    /// The tangent of half the vertical angle, rounded to f64 once.
    #[must_use]
    pub fn tan_half_vertical(&self) -> f64 {
        self.told(|camera| camera.tan_half_vertical.rounded(), |camera| camera.tan_half_vertical.rounded(), f64::NAN)
    }

    /// The raster point of a pixel's centre.
    #[must_use]
    pub fn raster(&self, pixel: [u32; 2]) -> DVec2 {
        let raster = |camera: &OracleCamera<Enclosure>| rounded(&camera.raster(pixel, CENTRE));
        self.told(raster, |camera| rounded(&camera.raster(pixel, CENTRE)), DVec2::NAN)
    }

    /// The NDC point of a pixel's centre, each part rounded to f64 once.
    #[must_use]
    pub fn ndc(&self, pixel: [u32; 2]) -> DVec2 {
        self.told(|camera| rounded(&ndc(camera, pixel)), |camera| rounded(&ndc(camera, pixel)), DVec2::NAN)
    }

    /// The screen point of a pixel's centre, each part rounded to f64 once.
    #[must_use]
    pub fn screen(&self, pixel: [u32; 2]) -> DVec2 {
        self.told(|camera| rounded(&screen(camera, pixel)), |camera| rounded(&screen(camera, pixel)), DVec2::NAN)
    }

    /// How far a measured camera point lies from that of a pixel's centre, in pixels.
    #[must_use]
    pub fn camera_error_in_pixels(&self, measured: DVec3, pixel: [u32; 2]) -> f64 {
        self.told(
            |camera| camera.camera_pixels(measured, &camera.raster(pixel, CENTRE)),
            |camera| camera.camera_pixels(measured, &camera.raster(pixel, CENTRE)),
            f64::INFINITY,
        )
    }

    /// How far a measured world direction points from a pixel's centre, in pixels.
    #[must_use]
    pub fn world_error_in_pixels(&self, measured: Vec3, pixel: [u32; 2]) -> f64 {
        self.told(
            |camera| camera.world_pixels(measured, &camera.raster(pixel, CENTRE)),
            |camera| camera.world_pixels(measured, &camera.raster(pixel, CENTRE)),
            f64::INFINITY,
        )
    }

    /// The angle between a measured world direction and that of a pixel's centre, in radians.
    #[must_use]
    pub fn world_error_in_radians(&self, measured: Vec3, pixel: [u32; 2]) -> f64 {
        self.told(
            |camera| camera.world_radians(measured, &camera.raster(pixel, CENTRE)),
            |camera| camera.world_radians(measured, &camera.raster(pixel, CENTRE)),
            f64::INFINITY,
        )
    }
}

fn ndc<N: Number>(camera: &OracleCamera<N>, pixel: [u32; 2]) -> Point<N> {
    camera.ndc(&camera.raster(pixel, CENTRE))
}

fn screen<N: Number>(camera: &OracleCamera<N>, pixel: [u32; 2]) -> Point<N> {
    camera.screen(&camera.raster(pixel, CENTRE))
}

fn rounded<N: Number>(point: &Point<N>) -> Option<DVec2> {
    Some(DVec2::new(point.x.rounded()?, point.y.rounded()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;
    use crate::measure::exact::Dyadic;
    use crate::measure::exact::relative_error;

    #[test]
    fn enclosed_cameras_tell_what_exact_ones_tell() {
        const CAMERAS: u64 = 300;
        let (mut told, mut untold) = (0, 0);
        for index in 0..CAMERAS {
            let mut draws = Draws::new(83, index);
            let fov =
                if index % 2 == 0 { draws.power_of_ten(-4.0, 2.2) } else { 180.0 - draws.power_of_ten(-2.0, 2.2) };
            let axes = [FovAxis::Vertical, FovAxis::Horizontal, FovAxis::Diagonal, FovAxis::Smaller];
            let size = [0, 1].map(|_| draws.power_of_ten(0.0, 4.8) as u32);
            let (x, z) = (draws.unit_vector(), draws.unit_vector());
            let rotation = DMat3::from_cols(x, z.cross(x), z);
            let check = CameraOracle::new(size[0], size[1], fov, axes[index as usize % 4], rotation);
            let exact = check.exact();
            let pixel = size.map(|side| (draws.unit() * f64::from(side)) as u32);
            let raster = exact.raster(pixel, CENTRE);
            let camera = exact.camera(&raster);
            let measured = DVec3::new(camera.x.to_f64(), camera.y.to_f64(), -1.0);
            let world = (rotation * measured.normalize()).as_vec3();

            let enclosed = check.enclosed.raster(pixel, CENTRE);
            let pairs = [
                (check.enclosed.camera_pixels(measured, &enclosed), exact.camera_pixels(measured, &raster)),
                (check.enclosed.world_pixels(world, &enclosed), exact.world_pixels(world, &raster)),
                (check.enclosed.world_radians(world, &enclosed), exact.world_radians(world, &raster)),
            ];
            for (enclosed, exact) in pairs {
                let exact = exact.expect("exact arithmetic always tells");
                match enclosed {
                    None => untold += 1,
                    Some(enclosed) if exact.is_infinite() => assert_eq!(enclosed, exact),
                    Some(enclosed) => {
                        assert!(relative_error(enclosed, &Dyadic::of(exact)) < 1e-6, "{enclosed}, not {exact}");
                        told += 1;
                    }
                }
            }
            assert_eq!(check.ndc(pixel), rounded(&exact.ndc(&raster)).expect("told"));
            assert_eq!(check.screen(pixel), rounded(&exact.screen(&raster)).expect("told"));
            assert_eq!(check.pixel_pitch(), exact.pixel_pitch().to_f64());
        }
        eprintln!("{CAMERAS} cameras: {told} errors told by enclosures as exactly, {untold} left to exact arithmetic");
        assert!(untold * 20 < told);
    }
}
