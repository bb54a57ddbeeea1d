use super::{PlacedCamera, Program, pinhole_from_theirs, theirs_from_pinhole};
use crate::extract::{ImageFrame, look_at_axes, tan_half};
use crate::scene::{Degrees, LookAt};
use glam::DVec3;

/// How far cameras move when they are converted to a program's convention and back.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RoundTrip {
    /// The number of cameras converted.
    pub cameras: u64,
    /// The number of cameras whose eye or axes did not come back equal.
    pub moved: u64,
    /// The number of cameras whose tan(fov / 2) came back with other bits.
    pub widened: u64,
    /// The greatest relative error of tan(fov / 2), in units of ε = 2⁻⁵².
    pub worst: f64,
}

/// Converts cameras to a program's convention and back: angles from 1e-4° to 179.99°, images from 1 × 65536 to 65536 ×
/// 1 pixels.
pub fn round_trip(program: Program, cameras: u64) -> RoundTrip {
    let mut trip = RoundTrip { cameras, ..RoundTrip::default() };
    for index in 0..cameras {
        let original = camera(index);
        let back = pinhole_from_theirs(program, &theirs_from_pinhole(program, &original), original.image);
        let error = (back.tan_half_vertical / original.tan_half_vertical - 1.0).abs() / f64::EPSILON;
        trip.moved +=
            u64::from(back.look.eye != original.look.eye || back.world_from_camera != original.world_from_camera);
        trip.widened += u64::from(back.tan_half_vertical != original.tan_half_vertical);
        trip.worst = trip.worst.max(error);
    }
    trip
}

/// A camera that is a function of its index only.
fn camera(index: u64) -> PlacedCamera {
    let number = |purpose: u64| unit(index.wrapping_mul(16).wrapping_add(purpose));
    let side = |purpose| libm::exp2(16.0 * number(purpose)).round() as u32;
    // Half of the angles are spread over very small ones on a logarithmic scale, half over all.
    let degrees = if index.is_multiple_of(2) { libm::pow(10.0, -4.0 + 6.25 * number(0)) } else { 179.99 * number(0) };
    let point = |purpose| DVec3::new(number(purpose) - 0.5, number(purpose + 1) - 0.5, number(purpose + 2) - 0.5);
    let eye = point(3) * libm::pow(10.0, 8.0 * number(6));
    let look = LookAt { eye, target: eye + point(7) * 1e3, up: DVec3::Y };
    let world_from_camera = look_at_axes("camera", &look).unwrap_or_default();
    let tan_half_vertical = tan_half(Degrees(degrees.clamp(1e-4, 179.99)));
    PlacedCamera { look, world_from_camera, tan_half_vertical, image: ImageFrame { width: side(1), height: side(2) } }
}

/// A number in [0, 1) that is a function of its argument only (splitmix64's finaliser).
fn unit(index: u64) -> f64 {
    let mut z = index.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cameras_come_back_from_every_program() {
        for program in Program::ALL {
            let trip = round_trip(program, 20_000);
            eprintln!("{program}: {trip:?}");
            assert_eq!(trip.moved, 0, "{program}");
        }
    }
}
