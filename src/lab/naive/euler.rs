//! Orientation as three angles.

use glam::{DMat3, DVec3};
use pinhole::scene::Degrees;

// ANCHOR: naive_euler
/// A camera's axes from three angles: it rolls about its own view, then pitches upward, then turns to the left.
#[must_use]
pub fn yaw_pitch_roll(yaw: Degrees, pitch: Degrees, roll: Degrees) -> DMat3 {
    about_y(yaw) * about_x(pitch) * about_z(roll)
}

/// The same three angles, taken in another order: another direction.
#[must_use]
pub fn pitch_yaw_roll(yaw: Degrees, pitch: Degrees, roll: Degrees) -> DMat3 {
    about_x(pitch) * about_y(yaw) * about_z(roll)
}
// ANCHOR_END: naive_euler

fn about_x(angle: Degrees) -> DMat3 {
    let (sine, cosine) = (libm::sin(angle.radians()), libm::cos(angle.radians()));
    DMat3::from_cols(DVec3::X, DVec3::new(0.0, cosine, sine), DVec3::new(0.0, -sine, cosine))
}

fn about_y(angle: Degrees) -> DMat3 {
    let (sine, cosine) = (libm::sin(angle.radians()), libm::cos(angle.radians()));
    DMat3::from_cols(DVec3::new(cosine, 0.0, -sine), DVec3::Y, DVec3::new(sine, 0.0, cosine))
}

fn about_z(angle: Degrees) -> DMat3 {
    let (sine, cosine) = (libm::sin(angle.radians()), libm::cos(angle.radians()));
    DMat3::from_cols(DVec3::new(cosine, sine, 0.0), DVec3::new(-sine, cosine, 0.0), DVec3::Z)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn apart(a: DMat3, b: DMat3) -> f64 {
        (a - b).to_cols_array().iter().fold(0.0, |worst: f64, part| worst.max(part.abs()))
    }

    #[test]
    fn the_order_matters_and_straight_up_one_angle_is_lost() {
        let angles = |yaw, pitch, roll| [yaw, pitch, roll].map(Degrees);
        let [yaw, pitch, roll] = angles(40.0, 30.0, 0.0);
        assert!(apart(yaw_pitch_roll(yaw, pitch, roll), pitch_yaw_roll(yaw, pitch, roll)) > 0.1);
        // Looking straight up, to turn by 50° is to roll back by 50°.
        let [yaw, pitch, roll] = angles(50.0, 90.0, 0.0);
        let [no_yaw, _, rolled] = angles(0.0, 90.0, -50.0);
        let locked = apart(yaw_pitch_roll(yaw, pitch, roll), yaw_pitch_roll(no_yaw, pitch, rolled));
        let free = apart(yaw_pitch_roll(yaw, Degrees(45.0), roll), yaw_pitch_roll(no_yaw, Degrees(45.0), rolled));
        assert!(locked < 1e-15 && free > 0.1, "{locked:e} {free}");
        for pitch in [0.0, 37.0, 90.0] {
            let axes = yaw_pitch_roll(Degrees(20.0), Degrees(pitch), Degrees(70.0));
            assert!(apart(axes.transpose() * axes, DMat3::IDENTITY) < 1e-15 && axes.determinant() > 0.0);
        }
    }
}
