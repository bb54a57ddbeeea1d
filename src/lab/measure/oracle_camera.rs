//! The exact chain pixel → raster → NDC → screen → camera → world of a perspective camera.
//!
//! Reads: the image size, the full angle, the rotation and a pixel. Writes: each stage's value with
//! a relative error below 2^-290 (raster points exactly), and the errors of measured values in
//! pixels, radians and units in the last place. Positions are left out: render space has the eye at
//! its origin.

use super::enclosure::Enclosure;
use super::exact::{Dyadic, UNIT_ROUNDOFF_F32};
use super::exact_vector::{ExactVector, Vector};
use super::number::Number;
use glam::{DMat3, DVec2, DVec3, Vec3};
use pinhole::scene::FovAxis;

/// A point, in raster, NDC or screen space as its maker says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Point<N> {
    /// To the right.
    pub x: N,
    /// Down in raster and NDC, up in screen space.
    pub y: N,
}

/// A point with exact coordinates.
pub type ExactPoint = Point<Dyadic>;

/// A perspective camera, exactly or enclosed.
#[derive(Clone, Debug)]
pub struct OracleCamera<N> {
    /// The image's width in pixels.
    pub width: u32,
    /// The image's height in pixels.
    pub height: u32,
    /// The tangent of half the vertical angle.
    pub tan_half_vertical: N,
    /// The camera's x, y and z axes in the world, as columns, taken exactly as given.
    pub rotation: DMat3,
}

/// A perspective camera, exactly.
pub type ExactCamera = OracleCamera<Dyadic>;

impl<N: Number> OracleCamera<N> {
    /// The camera whose image of `width` × `height` pixels spans `full_angle` degrees along `axis`.
    ///
    /// # Panics
    /// When the image has no pixel or the angle does not lie strictly between 0 and 180 degrees.
    #[must_use]
    pub fn new(width: u32, height: u32, full_angle: f64, axis: FovAxis, rotation: DMat3) -> Self {
        assert!(width > 0 && height > 0 && full_angle > 0.0, "nothing seen");
        let tangent = N::tan_of_half(full_angle);
        let [w, h] = [width, height].map(|side| N::of(f64::from(side)));
        let spanned = match axis {
            FovAxis::Vertical => h.clone(),
            FovAxis::Horizontal => w,
            FovAxis::Smaller => N::of(f64::from(width.min(height))),
            FovAxis::Larger => N::of(f64::from(width.max(height))),
            FovAxis::Diagonal => w.by(&w).plus(&h.by(&h)).root(),
        };
        let tan_half_vertical = tangent.by(&h).over(&spanned);
        Self { width, height, tan_half_vertical, rotation }
    }

    /// The raster point at `sub_pixel` within the pixel, (0.5, 0.5) being its centre; exact, in
    /// pixels, y down.
    #[must_use]
    pub fn raster(&self, pixel: [u32; 2], sub_pixel: DVec2) -> Point<N> {
        let along = |pixel: u32, offset: f64| N::of(f64::from(pixel)).plus(&N::of(offset));
        Point { x: along(pixel[0], sub_pixel.x), y: along(pixel[1], sub_pixel.y) }
    }

    /// Width and height in pixels.
    fn size(&self) -> [N; 2] {
        [self.width, self.height].map(|side| N::of(f64::from(side)))
    }

    /// The NDC point of a raster point: raster / size, y down.
    #[must_use]
    pub fn ndc(&self, raster: &Point<N>) -> Point<N> {
        let [width, height] = self.size();
        Point { x: raster.x.over(&width), y: raster.y.over(&height) }
    }

    /// The screen point of a raster point: ((2x − width) / height, (height − 2y) / height), y up.
    ///
    /// It is the chain (2 ndc.x − 1) · width / height, 1 − 2 ndc.y with the divisions put last.
    #[must_use]
    pub fn screen(&self, raster: &Point<N>) -> Point<N> {
        let [width, height] = self.size();
        Point {
            x: raster.x.plus(&raster.x).less(&width).over(&height),
            y: height.less(&raster.y.plus(&raster.y)).over(&height),
        }
    }

    /// The camera point of a raster point: the screen point times the tangent, at z = −1.
    #[must_use]
    pub fn camera(&self, raster: &Point<N>) -> Vector<N> {
        let screen = self.screen(raster);
        Vector { x: screen.x.by(&self.tan_half_vertical), y: screen.y.by(&self.tan_half_vertical), z: N::of(-1.0) }
    }

    /// The world vector of a raster point before it is normalised: the rotation times the camera
    /// point.
    #[must_use]
    pub fn world_unnormalised(&self, raster: &Point<N>) -> Vector<N> {
        let camera = self.camera(raster);
        let row = |row: usize| Vector::of(self.rotation.row(row)).dot(&camera);
        Vector { x: row(0), y: row(1), z: row(2) }
    }

    /// The width of one pixel on the plane z = −1: 2 · tan(vertical / 2) / height.
    #[must_use]
    pub fn pixel_pitch(&self) -> N {
        let [_, height] = self.size();
        self.tan_half_vertical.plus(&self.tan_half_vertical).over(&height)
    }

    /// As [`ExactCamera::camera_error_in_pixels`]; nothing where these numbers cannot tell.
    pub fn camera_pixels(&self, measured: DVec3, raster: &Point<N>) -> Option<f64> {
        if !measured.is_finite() {
            return Some(f64::INFINITY);
        }
        self.in_pixels(&Vector::of(measured), raster)
    }

    /// As [`ExactCamera::world_error_in_pixels`]; nothing where these numbers cannot tell.
    pub fn world_pixels(&self, measured: Vec3, raster: &Point<N>) -> Option<f64> {
        if !measured.is_finite() {
            return Some(f64::INFINITY);
        }
        let measured = Vector::<N>::of(measured);
        let column = |column: usize| Vector::of(self.rotation.col(column)).dot(&measured);
        let (x, y, depth) = (column(0), column(1), N::of(0.0).less(&column(2)));
        if depth.sign()? <= 0 {
            return Some(f64::INFINITY);
        }
        self.in_pixels(&Vector { x: x.over(&depth), y: y.over(&depth), z: N::of(-1.0) }, raster)
    }

    /// As [`ExactCamera::world_error_in_radians`]; nothing where these numbers cannot tell.
    pub fn world_radians(&self, measured: Vec3, raster: &Point<N>) -> Option<f64> {
        if !measured.is_finite() || measured == Vec3::ZERO {
            return Some(f64::INFINITY);
        }
        let (measured, exact) = (Vector::<N>::of(measured), self.world_unnormalised(raster));
        Some(libm::atan2(measured.cross(&exact).length_about()?, measured.dot(&exact).about()?))
    }

    /// The distance from the exact camera point over the pixel pitch.
    fn in_pixels(&self, camera: &Vector<N>, raster: &Point<N>) -> Option<f64> {
        Some(camera.minus(&self.camera(raster)).length_about()? / self.pixel_pitch().about()?)
    }
}

impl ExactCamera {
    /// The world direction of a raster point, of unit length.
    #[must_use]
    pub fn world(&self, raster: &ExactPoint) -> ExactVector {
        let world = self.world_unnormalised(raster);
        world.times(&Dyadic::of(1).divided_by(&world.length()))
    }

    /// How far a measured camera point lies from the exact one, in pixels; infinite when it is not
    /// finite.
    #[must_use]
    pub fn camera_error_in_pixels(&self, measured: DVec3, raster: &ExactPoint) -> f64 {
        self.camera_pixels(measured, raster).unwrap_or(f64::INFINITY)
    }

    /// How far a measured world direction, of any length, points from the exact camera point, in
    /// pixels; infinite when it is not finite or points behind the camera.
    ///
    /// The transpose of the rotation takes it back exactly, so the rotation is to be orthonormal.
    #[must_use]
    pub fn world_error_in_pixels(&self, measured: Vec3, raster: &ExactPoint) -> f64 {
        self.world_pixels(measured, raster).unwrap_or(f64::INFINITY)
    }

    /// The angle between a measured world direction, of any length, and the exact one, in radians;
    /// infinite when it is not finite or zero.
    #[must_use]
    pub fn world_error_in_radians(&self, measured: Vec3, raster: &ExactPoint) -> f64 {
        self.world_radians(measured, raster).unwrap_or(f64::INFINITY)
    }
}

/// How far a direction's length is from 1, in u = 2^-24, with its sign; infinite when it is not
/// finite.
#[must_use]
pub fn length_error_in_u(direction: Vec3) -> f64 {
    if !direction.is_finite() {
        return f64::INFINITY;
    }
    let enclosed = length_less_one::<Enclosure>(direction).about();
    enclosed.unwrap_or_else(|| length_less_one::<Dyadic>(direction).to_f64()) / UNIT_ROUNDOFF_F32
}

fn length_less_one<N: Number>(direction: Vec3) -> N {
    let direction = Vector::<N>::of(direction);
    direction.dot(&direction).root().less(&N::of(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    const CENTRE: DVec2 = DVec2::splat(0.5);

    /// Ninety degrees over the height of a 4 × 2 image, so that every stage is a short fraction.
    fn double_double() -> ExactCamera {
        ExactCamera::new(4, 2, 90.0, FovAxis::Vertical, DMat3::IDENTITY)
    }

    fn pair(point: &ExactPoint) -> [f64; 2] {
        [point.x.to_f64(), point.y.to_f64()]
    }

    #[test]
    fn every_stage_of_the_first_pixel_is_known() {
        let camera = double_double();
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
        let camera = ExactCamera { rotation: quarter_turn, ..double_double() };
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
