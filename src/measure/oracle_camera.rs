//! The exact chain pixel → raster → NDC → screen → camera → world of a perspective camera.
//!
//! Reads: the image size, the full angle, the rotation and a pixel. Writes: each stage's value with
//! a relative error below 2^-290 (raster points exactly), and the errors of measured values in
//! pixels, radians and units in the last place. Positions are left out: render space has the eye at
//! its origin.

use super::exact::Dyadic;
use super::exact_angle::tan_of_degrees;
use super::exact_vector::ExactVector;
use crate::scene::FovAxis;
use glam::{DMat3, DVec2, DVec3, Vec3};

/// A point with exact coordinates, in raster, NDC or screen space as its maker says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExactPoint {
    /// To the right.
    pub x: Dyadic,
    /// Down in raster and NDC, up in screen space.
    pub y: Dyadic,
}

/// A perspective camera, exactly.
#[derive(Clone, Debug)]
pub struct ExactCamera {
    /// The image's width in pixels.
    pub width: u32,
    /// The image's height in pixels.
    pub height: u32,
    /// The tangent of half the vertical angle.
    pub tan_half_vertical: Dyadic,
    /// The camera's x, y and z axes in the world, as columns, taken exactly as given.
    pub rotation: DMat3,
}

impl ExactCamera {
    /// The camera whose image of `width` × `height` pixels spans `full_angle` degrees along `axis`.
    ///
    /// # Panics
    /// When the image has no pixel or the angle does not lie strictly between 0 and 180 degrees.
    #[must_use]
    pub fn new(width: u32, height: u32, full_angle: f64, axis: FovAxis, rotation: DMat3) -> Self {
        assert!(width > 0 && height > 0 && full_angle > 0.0, "nothing seen");
        let tangent = tan_of_degrees(&Dyadic::of(full_angle).scaled(-1));
        let (w, h) = (Dyadic::of(width), Dyadic::of(height));
        let spanned = match axis {
            FovAxis::Vertical => h.clone(),
            FovAxis::Horizontal => w,
            FovAxis::Smaller => w.min(h.clone()),
            FovAxis::Larger => w.max(h.clone()),
            FovAxis::Diagonal => (&w.squared() + &h.squared()).square_root(),
        };
        let tan_half_vertical = (&tangent * &h).divided_by(&spanned);
        Self { width, height, tan_half_vertical, rotation }
    }

    /// The raster point at `sub_pixel` within the pixel, (0.5, 0.5) being its centre; exact, in
    /// pixels, y down.
    #[must_use]
    pub fn raster(&self, pixel: [u32; 2], sub_pixel: DVec2) -> ExactPoint {
        let along = |pixel: u32, offset: f64| &Dyadic::of(pixel) + &Dyadic::of(offset);
        ExactPoint { x: along(pixel[0], sub_pixel.x), y: along(pixel[1], sub_pixel.y) }
    }

    /// The NDC point of a raster point: raster / size, y down.
    #[must_use]
    pub fn ndc(&self, raster: &ExactPoint) -> ExactPoint {
        ExactPoint { x: raster.x.divided_by(&Dyadic::of(self.width)), y: raster.y.divided_by(&Dyadic::of(self.height)) }
    }

    /// The screen point of a raster point: ((2x − width) / height, (height − 2y) / height), y up.
    ///
    /// It is the chain (2 ndc.x − 1) · width / height, 1 − 2 ndc.y with the divisions put last.
    #[must_use]
    pub fn screen(&self, raster: &ExactPoint) -> ExactPoint {
        let (width, height) = (Dyadic::of(self.width), Dyadic::of(self.height));
        ExactPoint {
            x: (&raster.x.scaled(1) - &width).divided_by(&height),
            y: (&height - &raster.y.scaled(1)).divided_by(&height),
        }
    }

    /// The camera point of a raster point: the screen point times the tangent, at z = −1.
    #[must_use]
    pub fn camera(&self, raster: &ExactPoint) -> ExactVector {
        let screen = self.screen(raster);
        ExactVector {
            x: &screen.x * &self.tan_half_vertical,
            y: &screen.y * &self.tan_half_vertical,
            z: Dyadic::of(-1),
        }
    }

    /// The world vector of a raster point before it is normalised: the rotation times the camera
    /// point.
    #[must_use]
    pub fn world_unnormalised(&self, raster: &ExactPoint) -> ExactVector {
        let camera = self.camera(raster);
        let row = |row: usize| ExactVector::of(self.rotation.row(row)).dot(&camera);
        ExactVector { x: row(0), y: row(1), z: row(2) }
    }

    /// The world direction of a raster point, of unit length.
    #[must_use]
    pub fn world(&self, raster: &ExactPoint) -> ExactVector {
        let world = self.world_unnormalised(raster);
        world.times(&Dyadic::of(1).divided_by(&world.length()))
    }

    /// The width of one pixel on the plane z = −1: 2 · tan(vertical / 2) / height.
    #[must_use]
    pub fn pixel_pitch(&self) -> Dyadic {
        self.tan_half_vertical.scaled(1).divided_by(&Dyadic::of(self.height))
    }

    /// How far a measured camera point lies from the exact one, in pixels; infinite when it is not
    /// finite.
    #[must_use]
    pub fn camera_error_in_pixels(&self, measured: DVec3, raster: &ExactPoint) -> f64 {
        if !measured.is_finite() {
            return f64::INFINITY;
        }
        self.in_pixels(&ExactVector::of(measured), raster)
    }

    /// How far a measured world direction, of any length, points from the exact camera point, in
    /// pixels; infinite when it is not finite or points behind the camera.
    ///
    /// The transpose of the rotation takes it back exactly, so the rotation is to be orthonormal.
    #[must_use]
    pub fn world_error_in_pixels(&self, measured: Vec3, raster: &ExactPoint) -> f64 {
        if !measured.is_finite() {
            return f64::INFINITY;
        }
        let measured = ExactVector::of(measured);
        let column = |column: usize| ExactVector::of(self.rotation.col(column)).dot(&measured);
        let (x, y, depth) = (column(0), column(1), -&column(2));
        if depth.sign() <= 0 {
            return f64::INFINITY;
        }
        let (x, y) = (x.divided_by(&depth), y.divided_by(&depth));
        self.in_pixels(&ExactVector { x, y, z: Dyadic::of(-1) }, raster)
    }

    /// The angle between a measured world direction, of any length, and the exact one, in radians;
    /// infinite when it is not finite or zero.
    #[must_use]
    pub fn world_error_in_radians(&self, measured: Vec3, raster: &ExactPoint) -> f64 {
        if !measured.is_finite() || measured == Vec3::ZERO {
            return f64::INFINITY;
        }
        let (measured, exact) = (ExactVector::of(measured), self.world_unnormalised(raster));
        libm::atan2(measured.cross(&exact).squared_length().sqrt(), measured.dot(&exact).to_f64())
    }

    /// The distance from the exact camera point over the pixel pitch.
    fn in_pixels(&self, camera: &ExactVector, raster: &ExactPoint) -> f64 {
        camera.minus(&self.camera(raster)).squared_length().sqrt() / self.pixel_pitch().to_f64()
    }
}

/// How far a direction's length is from 1, in u = 2^-24, with its sign; infinite when it is not
/// finite.
#[must_use]
pub fn length_error_in_u(direction: Vec3) -> f64 {
    if !direction.is_finite() {
        return f64::INFINITY;
    }
    (&ExactVector::of(direction).length() - &Dyadic::of(1)).scaled(24).to_f64()
}

#[cfg(test)]
mod tests {
    use super::*;

    const CENTRE: DVec2 = DVec2::splat(0.5);

    /// Ninety degrees over the height of a 4 × 2 image, so that every stage is a short fraction.
    fn wide() -> ExactCamera {
        ExactCamera::new(4, 2, 90.0, FovAxis::Vertical, DMat3::IDENTITY)
    }

    fn pair(point: &ExactPoint) -> [f64; 2] {
        [point.x.to_f64(), point.y.to_f64()]
    }

    #[test]
    fn every_stage_of_the_first_pixel_is_known() {
        let camera = wide();
        let raster = camera.raster([0, 0], CENTRE);
        assert_eq!(pair(&raster), [0.5, 0.5]);
        assert_eq!(pair(&camera.ndc(&raster)), [0.125, 0.25]);
        assert_eq!(pair(&camera.screen(&raster)), [-1.5, 0.5]);
        let point = camera.camera(&raster);
        assert_eq!([point.x.to_f64(), point.y.to_f64(), point.z.to_f64()], [-1.5, 0.5, -1.0]);
        let length = camera.world(&raster).length();
        assert!((&length - &Dyadic::of(1)).abs() < Dyadic::of(1).scaled(-290));
    }

    #[test]
    fn the_axes_agree_on_one_camera() {
        let tangent = |angle, axis| ExactCamera::new(4, 2, angle, axis, DMat3::IDENTITY).tan_half_vertical.to_f64();
        assert_eq!(tangent(90.0, FovAxis::Vertical), 1.0);
        assert_eq!(tangent(90.0, FovAxis::Smaller), 1.0);
        assert_eq!(tangent(90.0, FovAxis::Horizontal), 0.5);
        assert_eq!(tangent(90.0, FovAxis::Larger), 0.5);
        assert!((tangent(90.0, FovAxis::Diagonal) - 0.2f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn errors_are_measured_in_pixels_and_radians() {
        let quarter_turn = DMat3::from_cols(DVec3::Z, DVec3::Y, DVec3::NEG_X);
        let camera = ExactCamera { rotation: quarter_turn, ..wide() };
        let (middle, next) = (camera.raster([2, 1], DVec2::ZERO), camera.raster([3, 1], DVec2::ZERO));
        // The middle of the image looks along the camera's −z, which is the world's +x here.
        assert_eq!(camera.world_error_in_pixels(Vec3::X * 3.0, &middle), 0.0);
        assert_eq!(camera.world_error_in_pixels(Vec3::X, &next), 1.0);
        assert_eq!(camera.world_error_in_pixels(-Vec3::X, &next), f64::INFINITY);
        assert_eq!(camera.world_error_in_radians(Vec3::X * 3.0, &middle), 0.0);
        let eighth = std::f64::consts::FRAC_PI_4;
        assert!((camera.world_error_in_radians(Vec3::X, &next) - eighth).abs() < 1e-15);
        assert_eq!(camera.camera_error_in_pixels(DVec3::new(0.0, 0.25, -1.0), &middle), 0.25);
        assert_eq!(camera.camera_error_in_pixels(DVec3::NAN, &middle), f64::INFINITY);
    }

    #[test]
    fn lengths_are_measured_in_u() {
        assert_eq!(length_error_in_u(Vec3::X), 0.0);
        assert_eq!(length_error_in_u(Vec3::X * (1.0 + f32::EPSILON)), 2.0);
        assert_eq!(length_error_in_u(Vec3::NAN), f64::INFINITY);
    }
}
