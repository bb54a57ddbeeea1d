use super::{Degrees, Placement};
use glam::{DQuat, DVec3};
use serde::Deserialize;
use std::f64::consts::FRAC_PI_2;

/// The rotation about the fixed x axis, then about the fixed y axis, then about the fixed z axis, each by the
/// right-hand rule; in Blender "XYZ Euler".
///
/// As a product of matrices it is Z · Y · X, which is also the rotation about z, then the turned y, then the turned x.
pub fn euler_xyz(x: Degrees, y: Degrees, z: Degrees) -> DQuat {
    let about = |axis, angle| axis_angle(axis, angle);
    about(DVec3::Z, z) * about(DVec3::Y, y) * about(DVec3::X, x)
}

/// The rotation about an axis of any length by an angle, by the right-hand rule; NaN about an axis of length 0.
pub fn axis_angle(axis: DVec3, angle: Degrees) -> DQuat {
    let [sine, cosine] = half_angle(angle);
    let [x, y, z] = (axis / axis.abs().max_element()).normalize().to_array().map(|part| part * sine);
    DQuat::from_xyzw(x, y, z, cosine)
}

/// Sine and cosine of half an angle; exact to the last bit for multiples of 180°.
fn half_angle(Degrees(angle): Degrees) -> [f64; 2] {
    let turns = angle % 720.0;
    let quarters = (turns / 180.0).round();
    let (sine, cosine) = libm::sincos((turns - 180.0 * quarters) / 180.0 * FRAC_PI_2);
    match quarters.rem_euclid(4.0) as u32 {
        0 => [sine, cosine],
        1 => [cosine, -sine],
        2 => [-sine, -cosine],
        _ => [-cosine, sine],
    }
}

/// A placement as a scene file may write it: the orientation as a quaternion, or by angles.
#[derive(Deserialize)]
#[serde(rename = "Placement", default, deny_unknown_fields)]
pub(super) struct WrittenPlacement {
    position: DVec3,
    orientation: DQuat,
    euler_xyz: [Degrees; 3],
    axis_angle: AxisAngle,
    scale: DVec3,
}

/// An axis and the angle about it.
#[derive(Clone, Copy, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct AxisAngle {
    axis: DVec3,
    angle: Degrees,
}

impl Default for AxisAngle {
    fn default() -> Self {
        Self { axis: DVec3::Y, angle: Degrees(0.0) }
    }
}

impl Default for WrittenPlacement {
    fn default() -> Self {
        let Placement { position, orientation, scale } = Placement::default();
        Self { position, orientation, euler_xyz: [Degrees(0.0); 3], axis_angle: AxisAngle::default(), scale }
    }
}

impl TryFrom<WrittenPlacement> for Placement {
    type Error = &'static str;

    fn try_from(written: WrittenPlacement) -> Result<Self, Self::Error> {
        let WrittenPlacement { position, orientation, euler_xyz: [x, y, z], axis_angle: turn, scale } = written;
        let by_euler = [x, y, z] != [Degrees(0.0); 3];
        let by_axis = turn != AxisAngle::default();
        let placed = |orientation| Ok(Self { position, orientation, scale });
        match (orientation != DQuat::IDENTITY, by_euler, by_axis) {
            (_, false, false) => placed(orientation),
            (false, true, false) => placed(euler_xyz(x, y, z)),
            (false, false, true) => placed(axis_angle(turn.axis, turn.angle)),
            _ => Err("turned once: by `orientation`, `euler_xyz` or `axis_angle`"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::ray_aim::Draws;
    use glam::DMat3;

    /// The textbook's matrices, one after another, against the quaternions.
    #[test]
    fn angles_turn_in_the_order_that_is_said() {
        let mut worst = 0.0_f64;
        for index in 0..2000 {
            let mut draws = Draws::new(14, index);
            let [x, y, z] = [0; 3].map(|_| draws.between(-1000.0, 1000.0));
            let [a, b, c] = [x, y, z].map(|angle: f64| angle.to_radians());
            let [(sx, cx), (sy, cy), (sz, cz)] = [a, b, c].map(libm::sincos);
            let about_x = DMat3::from_cols(DVec3::X, DVec3::new(0.0, cx, sx), DVec3::new(0.0, -sx, cx));
            let about_y = DMat3::from_cols(DVec3::new(cy, 0.0, -sy), DVec3::Y, DVec3::new(sy, 0.0, cy));
            let about_z = DMat3::from_cols(DVec3::new(cz, sz, 0.0), DVec3::new(-sz, cz, 0.0), DVec3::Z);
            let matrix = about_z * about_y * about_x;
            let turned = DMat3::from_quat(euler_xyz(Degrees(x), Degrees(y), Degrees(z)));
            worst = worst.max((matrix - turned).to_cols_array().iter().fold(0.0, |worst, part| worst.max(part.abs())));
            let axis = draws.unit_vector() * draws.power_of_ten(-200.0, 200.0);
            let turned = axis_angle(axis, Degrees(x));
            let along = (axis / axis.abs().max_element()).normalize();
            worst = worst.max((turned * along - along).length());
            let across = along.any_orthonormal_vector();
            worst = worst.max(((turned * across).dot(across) - libm::cos(a)).abs());
        }
        assert!(worst < 1e-13, "{worst}");
        eprintln!("orientations: 2000 by Euler angles and 2000 by axis and angle, within {worst:.1e}");
        let quarter = euler_xyz(Degrees(0.0), Degrees(180.0), Degrees(0.0));
        assert_eq!(quarter, DQuat::from_xyzw(0.0, 1.0, 0.0, -0.0), "half a turn is exact");
    }
}
