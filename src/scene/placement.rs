//! Where an entity is, what it is called, and how it moves.

use super::printable;
use bevy_ecs::prelude::*;
use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};
use std::f64::consts::FRAC_PI_2;

/// The transform from an entity's own space to its parent's, or to the world's: scale, then rotation, then translation.
///
/// A scene file may give the orientation by angles instead: as `euler_xyz`, three angles in degrees, see
/// [`euler_xyz`](super::euler_xyz), or as `axis_angle: (axis: (0, 1, 0), angle: 90)`.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "WrittenPlacement")]
pub struct Placement {
    /// The origin of the entity's space, in scene units.
    pub position: DVec3,
    /// The rotation from the entity's axes to its parent's, a quaternion (x, y, z, w) of any length but 0, which is
    /// normalised.
    #[serde(skip_serializing_if = "unturned")]
    pub orientation: DQuat,
    /// The scale factors along the entity's own axes; a negative one mirrors, 0 is an error.
    #[serde(skip_serializing_if = "unscaled")]
    pub scale: DVec3,
}

impl Default for Placement {
    fn default() -> Self {
        Self { position: DVec3::ZERO, orientation: DQuat::IDENTITY, scale: DVec3::ONE }
    }
}

impl Placement {
    /// A translation to a point, without rotation or scale.
    pub fn at(x: f64, y: f64, z: f64) -> Self {
        Self { position: DVec3::new(x, y, z), ..Self::default() }
    }
}

/// Stands at `eye` and looks at `target`; it overrides the position and orientation of the [`Placement`].
///
/// `up` need not be perpendicular to the viewing direction, only not parallel to it. Left at its default it may be: straight
/// down the top of the image is then towards −z, and straight up towards z, as if a camera that looked along −z had been
/// tilted.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[require(Placement)]
pub struct LookAt {
    /// The position, in scene units.
    pub eye: DVec3,
    /// The point looked at, distinct from `eye`.
    pub target: DVec3,
    /// A direction that points upward in the image.
    #[serde(skip_serializing_if = "up_is_y")]
    pub up: DVec3,
}

impl Default for LookAt {
    fn default() -> Self {
        Self { eye: DVec3::ZERO, target: DVec3::NEG_Z, up: DVec3::Y }
    }
}

fn unturned(orientation: &DQuat) -> bool {
    same_bits(orientation.to_array(), DQuat::IDENTITY.to_array())
}

fn unscaled(scale: &DVec3) -> bool {
    same_bits(scale.to_array(), DVec3::ONE.to_array())
}

fn up_is_y(up: &DVec3) -> bool {
    same_bits(up.to_array(), DVec3::Y.to_array())
}

/// Whether a file may leave one out and mean the other; −0 and 0 differ here.
fn same_bits<const N: usize>(one: [f64; N], other: [f64; N]) -> bool {
    one.map(f64::to_bits) == other.map(f64::to_bits)
}

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

/// An angle in degrees, as a type, so that no call site has to state or guess the unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Degrees(pub f64);

impl Degrees {
    /// The same angle in radians.
    pub fn radians(self) -> f64 {
        self.0 * (std::f64::consts::PI / 180.0)
    }
}

/// On the camera: the interval of time during which it gathers light.
///
/// Every entity is where its placement says at time 0; one with a [`Motion`] is elsewhere at other times.
#[derive(Component, Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Shutter {
    /// When it opens, in units of time.
    pub open: f64,
    /// When it closes, not before it opens; if both are equal, the picture shows one instant.
    pub close: f64,
}

impl Default for Shutter {
    fn default() -> Self {
        Self { open: 0.0, close: 1.0 }
    }
}

/// On a shape of any kind, the camera, or a group of them: motion at constant velocity.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Motion {
    /// In world space, in scene units per unit of time, however the parents are rotated; their velocities are added.
    pub velocity: DVec3,
}

/// The longest name that a message shows whole, in characters.
const LONGEST: usize = 100;
/// The most entities that a message names.
const MAX: usize = 4;

/// How a message refers to an entity: its name in quotes, or its number if it has none.
pub fn called(world: &World, entity: Entity) -> String {
    match world.get::<Name>(entity) {
        Some(name) => format!("\"{}\"", printable(name, LONGEST)),
        None => format!("(unnamed, entity {})", entity.index()),
    }
}

/// How a message refers to several entities: the first few, and how many more there are.
pub fn some_of(world: &World, entities: &[Entity], between: &str) -> String {
    let names: Vec<String> = entities.iter().take(MAX).map(|&entity| called(world, entity)).collect();
    match entities.len().checked_sub(MAX) {
        None | Some(0) => names.join(between),
        Some(more) => format!("{} and {more} more", names.join(", ")),
    }
}

#[cfg(test)]
mod orientation_tests {
    use super::*;
    use crate::draws::Draws;
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
