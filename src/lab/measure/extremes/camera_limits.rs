//! Cameras where the textbooks divide by 0, overflow or step out of their pixel.

use super::camera_chain::{CameraCase, CameraChain, Pose, axes_error};
use super::camera_table::{one_by_one, turned};
use super::{Method, Trial};
use crate::measure::camera_check::CameraOracle;
use crate::measure::draws::Draws;
use crate::naive::camera::{look_at_f32, raster_f32, stepped_f32, tan_half_f32};
use glam::{DMat3, DQuat, DVec3};
use pinhole::extract::tan_half;
use pinhole::scene::{Degrees, FovAxis, LookAt};

/// Refusals take their time, and one is much like the other.
pub(super) const FEW: u64 = 100_000;

/// The cases of limits that have naive methods of their own.
pub fn trials() -> Vec<Trial> {
    vec![every_pixel(65_536), every_pixel(65_535), wide_tangents(), no_angle(), no_axes(), any_distance()]
}

/// Every pixel of a line as wide as images go: its points lie in it.
///
/// One over a power of two is exact in f32, and so are its multiples up to 1; one over the width beside it is not.
fn every_pixel(width: u32) -> Trial {
    const ROWS: [Method; 4] = [
        Method::pinhole("pinhole, raster and ndc in their pixel", "", 0.0),
        Method::pinhole("pinhole, ndc off the centre", "px", 1e-3),
        Method::naive("naive, x + jitter in f32", "", 0.0),
        Method::naive("naive, x += 1 / width in f32", "px", 1e-3),
    ];
    // Without a factor in common with either width, so that every pixel has its turn, and the first few are spread out.
    const STRIDE: u64 = 40_507;
    let stepped = stepped_f32(width);
    let check = move |chain: &mut CameraChain, index: u64, tally: &mut super::Tally| {
        let x = (index * STRIDE % u64::from(width)) as u32;
        let axes = chain.set(turned([width, 1], 0.5, DQuat::IDENTITY));
        tally.count(axes.is_ok());
        let wrote = chain.pixels([x, 0], 1)[0];
        let (pixel, size) = (f64::from(x), f64::from(width));
        tally.scores[0].check(wrote.raster.x.floor() == pixel && (wrote.ndc.x * size).floor() == pixel);
        tally.scores[1].measure((wrote.ndc.x * size - (pixel + 0.5)).abs());
        let jitter = (Draws::new(121, index).unit() * f64::from(1 << 24)).floor() as f32 / (1 << 24) as f32;
        tally.scores[2].check(raster_f32(x, jitter).floor() == x as f32);
        tally.scores[3].measure((f64::from(stepped[x as usize]) * size - (pixel + 0.5)).abs());
    };
    one_by_one(&format!("{width} x 1, every pixel"), &ROWS, check).at_most(u64::from(width))
}

/// tan(φ / 2) of angles that leave 0.01° to 90° to 180°. In f64 four roundings, one of them through a slope of 2 at
/// most: 8 · 2⁻⁵³.
fn wide_tangents() -> Trial {
    const BOUND: f64 = 8.0 / (1_u64 << 29) as f64;
    const ROWS: [Method; 2] =
        [Method::pinhole("pinhole, tan of half the angle", "u", BOUND), Method::naive("naive, tan in f32", "u", 4.0)];
    one_by_one("90 to 179.99 degrees, the tangent", &ROWS, |_, index, tally| {
        let fov = f64::from((180.0 - Draws::new(122, index).power_of_ten(-2.0, 1.954)) as f32);
        let exact = CameraOracle::new(1, 1, fov, FovAxis::Vertical, DMat3::IDENTITY).tan_half_vertical();
        tally.count(true);
        tally.scores[0].check_value(tan_half(Degrees(fov)), exact);
        tally.scores[1].check_value(f64::from(tan_half_f32(fov as f32)), exact);
    })
}

/// Angles that no pinhole has are refused by name; the tangent takes them.
fn no_angle() -> Trial {
    const ROWS: [Method; 2] = [
        Method::pinhole("pinhole, refused: fov", "", 0.0),
        Method::naive("naive, tan in f32: image upside down", "", 0.0),
    ];
    one_by_one("180 degrees and more, 0 and less, NaN", &ROWS, |chain, index, tally| {
        let size = Draws::new(123, index).power_of_ten(-12.0, 3.0);
        let fov = [180.0, 180.0 + size, -size, 0.0, f64::NAN, f64::INFINITY][index as usize % 6];
        let scene_error = chain.set(turned([64, 64], fov, DQuat::IDENTITY)).err();
        tally.count(scene_error.is_none());
        tally.scores[0].check(scene_error.is_some_and(|scene_error| scene_error.field == "fov"));
        tally.scores[1].check(tan_half_f32(fov as f32) >= 0.0);
    })
    .at_most(FEW)
}

/// Nothing to look at, or no way up: refused by name; the textbook answers axes that are no numbers.
fn no_axes() -> Trial {
    const ROWS: [Method; 2] =
        [Method::pinhole("pinhole, refused: target or up", "", 0.0), Method::naive("naive look-at, f32", "", 0.0)];
    one_by_one("the eye at its target, up along the view, up 0", &ROWS, |chain, index, tally| {
        let mut draws = Draws::new(124, index);
        let eye = (draws.unit_vector() * draws.power_of_ten(-2.0, 4.0)).as_vec3().as_dvec3();
        let (target, up, field) = match index % 3 {
            0 => (eye, DVec3::Y, "target"),
            1 => (DVec3::ZERO, eye * draws.power_of_ten(-3.0, 3.0), "up"),
            _ => (DVec3::ZERO, DVec3::ZERO, "up"),
        };
        let looking = Pose::Looking(LookAt { eye, target, up });
        let scene_error = chain.set(CameraCase { pose: looking, ..turned([64, 64], 45.0, DQuat::IDENTITY) }).err();
        tally.count(scene_error.is_none());
        tally.scores[0].check(scene_error.is_some_and(|scene_error| scene_error.field == field));
        tally.scores[1].check(look_at_f32(eye.as_vec3(), target.as_vec3(), up.as_vec3()).is_finite());
    })
    .at_most(FEW)
}

/// A target at any distance, also where its square is too small or too large for f32.
fn any_distance() -> Trial {
    const ROWS: [Method; 2] = [
        Method::pinhole("pinhole, axes where it looks", "rad", 4e-15),
        Method::naive("naive look-at, f32", "rad", super::camera::ANGLE_BOUND * 4.0),
    ];
    one_by_one("a target 1e-30 to 1e30 away", &ROWS, |chain, index, tally| {
        let mut draws = Draws::new(125, index);
        let target = (draws.unit_vector() * draws.power_of_ten(-30.0, 30.0)).as_vec3().as_dvec3();
        let look = LookAt { eye: DVec3::ZERO, target, up: draws.unit_vector().as_vec3().as_dvec3() };
        let axes = chain.set(CameraCase { pose: Pose::Looking(look), ..turned([64, 64], 45.0, DQuat::IDENTITY) });
        tally.count(axes.is_ok());
        // An up within 1e-6 of the view may be refused.
        let Ok(axes) = axes else { return };
        tally.scores[0].measure(axes_error(axes, &look));
        let naive = look_at_f32(look.eye.as_vec3(), target.as_vec3(), look.up.as_vec3());
        tally.scores[1].measure(if naive.is_finite() { axes_error(naive.as_dmat3(), &look) } else { f64::INFINITY });
    })
}
