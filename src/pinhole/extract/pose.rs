use super::check::{finite_point, number, triple};
use super::motion::displacement_at_opening;
use crate::each::Each;
use crate::plan::Census;
use crate::scene::{ChildOf, LookAt, Placement, SceneError, called};
use crate::shapes::Pose;
use bevy_ecs::prelude::*;
use glam::{DAffine3, DMat3, DQuat, DVec3};

/// How far the square of a quaternion's length may be from 1 for it to be normalised without being scaled first.
const UNIT_TOLERANCE: f64 = 1e-6;
/// The sine of the least angle between up and the view; the axes are orthonormal to within 2⁻⁵² over this sine.
const MIN_SINE: f64 = 1e-6;
/// How far the three scales of a sphere may differ, relative to the first, and still be considered equal up to
/// rounding.
const EVEN_TOLERANCE: f64 = 1e-9;
const ONE_OF_THE_TWO: &str = "a LookAt already gives position and orientation: use one of the two";

/// The transform from object space to world space: the entity's placement, then its parent's, and so on to the root.
///
/// `who` is the entity's name in error messages, such as `sphere "ball"`.
pub fn world_from_entity(scene: &Census<'_>, who: &str, entity: Entity) -> Result<DAffine3, SceneError> {
    Ok(pose(scene, who, entity)?.world_from_entity)
}

/// The direction in which an entity looks: its own −z in world space, a unit vector.
pub fn ahead(scene: &Census<'_>, who: &str, entity: Entity) -> Result<DVec3, SceneError> {
    let along = world_from_entity(scene, who, entity)?.matrix3 * DVec3::NEG_Z;
    let accepted = "its −z must keep a direction";
    direction(along)
        .ok_or_else(|| SceneError::new(who, "placement", format!("a map of −z to {}", triple(along)), accepted))
}

// ANCHOR: pose
/// The same transform with its inverse.
pub fn pose(scene: &Census<'_>, who: &str, entity: Entity) -> Result<Pose, SceneError> {
    let Pose { mut world_from_entity, mut entity_from_world } = parent_from_entity(scene, who, entity)?;
    let (mut child, mut seen) = (entity, vec![entity]);
    while let Some(parent) = scene.get::<ChildOf>(child).map(ChildOf::parent) {
        if seen.contains(&parent) {
            let value = format!("part of a circle through {}", called(scene, parent));
            return Err(SceneError::new(who, "parent", value, "parents must lead to an entity without one"));
        }
        seen.push(parent);
        let parent_name = format!("{who}'s parent {}", called(scene, parent));
        let above = parent_from_entity(scene, &parent_name, parent)?;
        world_from_entity = above.world_from_entity * world_from_entity;
        entity_from_world *= above.entity_from_world;
        child = parent;
    }
    if let Some(displacement) = displacement_at_opening(scene, entity) {
        world_from_entity.translation += displacement;
    }
    let determinant = world_from_entity.matrix3.determinant();
    if determinant == 0.0 || !determinant.is_finite() || !world_from_entity.translation.is_finite() {
        let value = format!("a map of determinant {}", number(determinant));
        return Err(SceneError::new(who, "placement", value, "it must be finite and invertible"));
    }
    Ok(Pose { world_from_entity, entity_from_world })
}
// ANCHOR_END: pose

/// The transform from an entity to its parent only.
fn parent_from_entity(scene: &Census<'_>, who: &str, entity: Entity) -> Result<Pose, SceneError> {
    let placement = scene.get::<Placement>(entity).copied().unwrap_or_default();
    let look_at = scene.get::<LookAt>(entity);
    let position = finite_point(who, "position", placement.position)?;
    let scale = finite_point(who, "scale", placement.scale)?;
    if scale.x == 0.0 || scale.y == 0.0 || scale.z == 0.0 {
        return Err(SceneError::new(
            who,
            "scale",
            triple(scale),
            "no part may be 0, for the placement must be invertible",
        ));
    }
    let quaternion = placement.orientation;
    let Some(rotation) = normalised(quaternion) else {
        let accepted = "it must be a finite quaternion other than 0, or angles about an axis other than 0";
        return Err(SceneError::new(who, "orientation", quadruple(quaternion), accepted));
    };
    let (axes, origin) = match look_at {
        None => (DMat3::from_quat(rotation), position),
        Some(_) if position != DVec3::ZERO => {
            return Err(SceneError::new(who, "position", format!("set to {}", triple(position)), ONE_OF_THE_TWO));
        }
        Some(_) if quaternion != DQuat::IDENTITY => {
            return Err(SceneError::new(
                who,
                "orientation",
                format!("set to {}", quadruple(quaternion)),
                ONE_OF_THE_TWO,
            ));
        }
        Some(look) => (look_at_axes(who, look)?, look.eye),
    };
    Ok(Pose {
        world_from_entity: DAffine3 { matrix3: axes * DMat3::from_diagonal(scale), translation: origin },
        entity_from_world: DMat3::from_diagonal(1.0 / scale) * axes.transpose(),
    })
}

/// Whether the entity's placement and its parents' together have a non-uniform scale, so that a sphere becomes an
/// ellipsoid.
///
/// An invalid placement counts as uniform: extraction will report what is wrong with it.
pub fn non_uniformly_scaled(scene: &Census<'_>, entity: Entity) -> bool {
    let scale = scene.get::<Placement>(entity).map_or(DVec3::ONE, |placement| placement.scale.abs());
    let even_alone = scale.x == scale.y && scale.y == scale.z && scene.get::<ChildOf>(entity).is_none();
    !even_alone && pose(scene, "", entity).is_ok_and(|pose| !is_even(pose.world_from_entity.matrix3))
}

/// Whether a map lengthens every direction by the same factor, mirrored or not.
fn is_even(world_from_entity: DMat3) -> bool {
    let lengths = DVec3::from([0, 1, 2].each(|axis| world_from_entity.col(axis).length()));
    let [x, y, z] = [0, 1, 2].each(|axis| world_from_entity.col(axis));
    let skew = x.dot(y).abs().max(y.dot(z).abs()).max(z.dot(x).abs());
    let non_uniform = (lengths - lengths.x).abs().max_element();
    non_uniform <= EVEN_TOLERANCE * lengths.x && skew <= EVEN_TOLERANCE * lengths.x * lengths.x
}

/// The unit quaternion of the same rotation, or none where there is no rotation; scaled first where that is needed, so
/// that no square overflows or vanishes.
fn normalised(quaternion: DQuat) -> Option<DQuat> {
    let largest = quaternion.to_array().into_iter().fold(0.0, |largest: f64, part| largest.max(part.abs()));
    if !quaternion.is_finite() || largest == 0.0 {
        return None;
    }
    let nearly_unit = (quaternion.length_squared() - 1.0).abs() <= UNIT_TOLERANCE;
    let scaled = || DQuat::from_array(quaternion.to_array().each(|part| part / largest));
    Some(if nearly_unit { quaternion } else { scaled() }.normalize())
}

fn quadruple(q: DQuat) -> String {
    format!("({}, {}, {}, {})", number(q.x), number(q.y), number(q.z), number(q.w))
}

// ANCHOR: look_at_axes
/// The axes of a camera or object at `eye` that looks at `target`: x to its right, y up, −z ahead.
///
/// Errors: a coordinate that is not finite, `eye` equal to `target`, `up` of length 0 or, other than the default, along the
/// view.
pub fn look_at_axes(who: &str, look: &LookAt) -> Result<DMat3, SceneError> {
    finite_point(who, "eye", look.eye)?;
    finite_point(who, "target", look.target)?;
    let Some(back) = direction(look.eye - look.target) else {
        return Err(SceneError::new(who, "target", triple(look.target), "it must be a point other than eye"));
    };
    let Some(up) = direction(upward(look)) else {
        return Err(SceneError::new(who, "up", triple(look.up), "it must be a finite direction other than 0"));
    };
    let right = up.cross(back);
    match direction(right) {
        Some(x) if right.length() >= MIN_SINE => Ok(DMat3::from_cols(x, back.cross(x), back)),
        _ => {
            let across = if back.y.abs() < 0.9 { "(0, 1, 0)" } else { "(0, 0, -1)" };
            let accepted = format!("it must not point along the view from eye to target; {across} does not");
            Err(SceneError::new(who, "up", triple(look.up), accepted))
        }
    }
}

/// The direction that is upward in the image: `up` as it is given, or, where it is the default and the view is vertical,
/// that of a camera which looked along −z and was tilted until it looks down (−z) or up (z).
pub fn upward(look: &LookAt) -> DVec3 {
    let back = direction(look.eye - look.target).unwrap_or_default();
    let is_vertical = DVec3::Y.cross(back).length() < MIN_SINE;
    if look.up == DVec3::Y && is_vertical { DVec3::new(0.0, 0.0, -back.y.signum()) } else { look.up }
}
// ANCHOR_END: look_at_axes

// ANCHOR: direction
/// The unit vector along `v`, or none where it has no direction; scaled first, so that no square overflows.
fn direction(v: DVec3) -> Option<DVec3> {
    let largest = v.abs().max_element();
    if v.is_finite() && largest > 0.0 { (v / largest).try_normalize() } else { None }
}
// ANCHOR_END: direction

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{direction_object_from_world, normal_world_from_object, point_object_from_world};

    /// Straight down and straight up, exactly or nearly, x stays where it was as the camera was tilted; an up that was
    /// written along the view is refused, and the one that the refusal names is taken.
    #[test]
    fn a_vertical_view_needs_no_up() {
        let looking = |ahead: DVec3, up: DVec3| {
            let eye = DVec3::new(3.0, -2.0, 5.0);
            look_at_axes("camera", &LookAt { eye, target: eye + ahead, up })
        };
        for (ahead, top) in [(DVec3::NEG_Y, DVec3::NEG_Z), (DVec3::Y, DVec3::Z)] {
            for tilt in [0.0, 1e-9, 9e-7, 1.1e-6, 1e-3] {
                let nearly = ahead * libm::cos(tilt) + DVec3::NEG_Z * libm::sin(tilt);
                let axes = looking(7.0 * nearly, DVec3::Y).expect("axes");
                assert!(axes.x_axis.distance(DVec3::X) < 1e-9, "{ahead} {tilt}: {axes}");
                assert!(axes.y_axis.distance(top) <= 1.01 * tilt + 1e-9, "{ahead} {tilt}: {axes}");
            }
            for up in [2.0 * DVec3::Y, DVec3::NEG_Y] {
                let refused = looking(ahead, up).expect_err("an up along the view").to_string();
                assert!(refused.ends_with("from eye to target; (0, 0, -1) does not"), "{refused}");
                assert!(looking(ahead, DVec3::NEG_Z).is_ok());
            }
        }
        let refused = looking(DVec3::Z, DVec3::Z).expect_err("an up along the view").to_string();
        assert!(refused.ends_with("; (0, 1, 0) does not"), "{refused}");
    }

    /// A mirrored, scaled object under a rotated and flattened parent.
    fn nested() -> Pose {
        let mut world = World::new();
        let tilt = DQuat::from_xyzw(0.5, -0.1, 0.7, 0.5).normalize();
        let (position, planar) = (DVec3::new(3.0, -2.0, 1.0), DVec3::new(1.0, 0.125, -2.0));
        let parent = world.spawn(Placement { position, orientation: tilt, scale: planar }).id();
        let own = Placement { position, orientation: tilt, scale: DVec3::new(-1.0, 3.0, 0.5) };
        let entity = world.spawn((own, ChildOf(parent))).id();
        pose(&Census::of(&world), "", entity).expect("a pose")
    }

    #[test]
    fn points_and_directions_come_back() {
        let Pose { world_from_entity, entity_from_world } = nested();
        let (point, along) = (DVec3::new(0.3, -0.7, 1.1), DVec3::new(-0.2, 0.9, 0.4));
        let there = world_from_entity.transform_point3(point);
        let back = point_object_from_world(entity_from_world, world_from_entity.translation, there);
        assert!(back.distance(point) < 1e-14, "{back}");
        let further = world_from_entity.transform_point3(point + along);
        let back = direction_object_from_world(entity_from_world, further - there);
        assert!(back.distance(along) < 1e-14, "a direction is a difference of two points: {back}");
    }

    #[test]
    fn normals_stay_perpendicular_and_on_their_side() {
        let Pose { world_from_entity, entity_from_world } = nested();
        let normal = DVec3::new(0.6, 0.0, 0.8);
        let there = normal_world_from_object(entity_from_world, normal);
        for along in [DVec3::Y, DVec3::new(0.8, 0.0, -0.6)] {
            assert!(there.dot(world_from_entity.matrix3 * along).abs() < 1e-14);
        }
        // A point in front of the surface stays there, though these maps mirror twice.
        assert!(there.dot(world_from_entity.matrix3 * normal) > 0.0);
        let leaning = (world_from_entity.matrix3 * normal).normalize().dot(there.normalize());
        assert!(leaning < 0.9, "transformed like a direction, it would lean: {leaning}");
    }
}
