use super::camera::eye;
use super::check::{finite_point, kind_and_name};
use super::non_opaque::is_non_opaque;
use super::pose::pose;
use super::shape_kind::{moving_shapes, numbered, shape_entities};
use super::velocity::moves_while_open;
use crate::plan::{Census, Table, check_is_added};
use crate::scene::{ChildOf, Placement, SceneError, Triangle};
use crate::shapes::{
    Ellipsoid, Listed, Placed, PlacedDisk, PlacedMesh, PlacedPlane, PlacedRectangle, PlacedSphere, SceneShape,
    ShapeKind, Slabs, TriangleRow, placed_normals,
};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// Shapes of one kind in render space, in spawn order, except for those that [move](super::MovingTable); those that
/// [are not opaque](super::NonOpaqueTable) come last, and only their surfaces are computed from here.
#[derive(Clone, Debug, PartialEq)]
pub struct ShapesOf<S: Listed> {
    /// The shapes, as the intersection kernels read them.
    pub row: Vec<S>,
    /// What the surface of each needs besides.
    pub surface_data: Vec<S::SurfaceData>,
    /// The shape's number.
    pub shape: Vec<u32>,
    /// How many, from the first on, are opaque to every ray.
    pub opaque: usize,
}

/// The table of spheres.
pub type SphereTable = ShapesOf<PlacedSphere>;
/// The table of spheres with a non-uniform scale.
pub type EllipsoidTable = ShapesOf<Ellipsoid>;
/// The table of planes.
pub type PlaneTable = ShapesOf<PlacedPlane>;
/// The table of disks.
pub type DiskTable = ShapesOf<PlacedDisk>;
/// The table of rectangles.
pub type RectangleTable = ShapesOf<PlacedRectangle>;
/// The table of cuboids.
pub type CuboidTable = ShapesOf<Slabs>;
/// The table of triangles.
pub type TriangleTable = ShapesOf<TriangleRow>;

/// The table of meshes.
pub type MeshTable = ShapesOf<PlacedMesh>;

impl<S: Listed> Default for ShapesOf<S> {
    fn default() -> Self {
        Self { row: Vec::new(), surface_data: Vec::new(), shape: Vec::new(), opaque: 0 }
    }
}

impl<S: Listed> ShapesOf<S> {
    /// Appends an opaque shape, with what its surface needs and its number.
    pub fn push(&mut self, (row, surface_data): (S, S::SurfaceData), shape: u32) {
        self.row.push(row);
        self.surface_data.push(surface_data);
        self.shape.push(shape);
        self.opaque += 1;
    }

    /// The opaque shapes, and their numbers.
    #[inline(always)]
    pub fn opaque(&self) -> (&[S], &[u32]) {
        (&self.row[..self.opaque], &self.shape[..self.opaque])
    }

    /// Those that pass a test, at the moment when the shutter opens.
    ///
    /// Errors: what is wrong with one of them.
    pub(super) fn that(scene: &Census<'_>, such: impl Fn(Entity) -> bool) -> Result<Self, SceneError> {
        let (eye, is_non_opaque) = (eye(scene)?, is_non_opaque(scene));
        let those = numbered::<S>(scene).into_iter().filter(|&(_, entity)| such(entity));
        let (others, opaque): (Vec<_>, Vec<_>) = those.partition(|&(_, entity)| is_non_opaque(entity));
        let (mut table, count) = (Self::default(), opaque.len());
        for (shape, entity) in opaque.into_iter().chain(others) {
            table.push(placed_shape::<S>(scene, entity, eye)?, shape as u32);
        }
        table.opaque = count;
        Ok(table)
    }
}

/// The shapes, numbered from 0.
impl<S: Listed> FromIterator<S> for ShapesOf<S> {
    fn from_iter<I: IntoIterator<Item = S>>(shapes: I) -> Self {
        let mut table = Self::default();
        shapes.into_iter().zip(0..).for_each(|(row, shape)| table.push((row, S::SurfaceData::default()), shape));
        table
    }
}

impl<S: Listed> Table for ShapesOf<S> {
    const NAME: &'static str = S::NAMES.table;

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        if matches!(S::KIND, ShapeKind::Custom(_)) {
            check_is_added::<Self>(scene, S::Component::WORD, "add_shape")?;
        }
        let moves = moves_while_open(scene);
        Self::that(scene, |entity| !moves(entity))
    }

    fn bytes(&self) -> usize {
        self.row.len() * (size_of::<S>() + size_of::<S::SurfaceData>() + size_of::<u32>())
            + S::bytes_of_surface_data(&self.row)
    }
}

/// The shape of an entity, at the moment when the shutter opens.
pub(super) fn placed_shape<S: Listed>(
    scene: &Census<'_>,
    entity: Entity,
    eye: DVec3,
) -> Result<(S, S::SurfaceData), SceneError> {
    let component = scene.get::<S::Component>(entity).cloned().unwrap_or_default();
    let who = kind_and_name(scene, S::Component::WORD, entity);
    S::place(&component, &placed(scene, &who, entity, eye)?)
}

/// Where a shape's entity is placed.
fn placed<'a>(scene: &Census<'_>, who: &'a str, entity: Entity, eye: DVec3) -> Result<Placed<'a>, SceneError> {
    let pose = pose(scene, who, entity)?;
    let position = finite_point(who, "position", pose.world_from_entity.translation - eye)?;
    let scale = scene.get::<Placement>(entity).copied().unwrap_or_default().scale;
    Ok(Placed { who, pose, position, scale, has_parent: scene.get::<ChildOf>(entity).is_some() })
}

/// Vertex normals in world space, one row per triangle, in the order of [`TriangleTable`] and its sorted corners.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VertexNormalTable {
    /// Unit vectors on the side of the table's normal; all 0 where the author gave none.
    pub normals: Vec<[DVec3; 3]>,
    /// The same for each row of [`MovingTable`](super::MovingTable); all 0 where it holds another shape.
    pub moving: Vec<[DVec3; 3]>,
}

impl Table for VertexNormalTable {
    const NAME: &'static str = "vertex normals";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (eye, entities) = (eye(scene)?, shape_entities(scene));
        let of = |entity: Entity| -> Result<[DVec3; 3], SceneError> {
            let Some(triangle) = scene.get::<Triangle>(entity) else { return Ok([DVec3::ZERO; 3]) };
            let who = kind_and_name(scene, Triangle::WORD, entity);
            Ok(placed_normals(triangle, &placed(scene, &who, entity, eye)?)?.unwrap_or_default())
        };
        let still = &scene.table::<TriangleTable>()?.shape;
        let normals = still.iter().map(|&shape| of(entities[shape as usize])).collect::<Result<_, _>>()?;
        let moving = moving_shapes(scene).iter().map(|&(_, entity)| of(entity)).collect::<Result<_, _>>()?;
        Ok(Self { normals, moving })
    }

    fn bytes(&self) -> usize {
        (self.normals.len() + self.moving.len()) * size_of::<[DVec3; 3]>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::extract::{ShapeTable, non_uniformly_scaled};
    use crate::scene::{Matte, PerspectiveCamera, Sphere};
    use crate::shapes::ShapeKind;
    use glam::DQuat;

    fn scene(scales: &[DVec3]) -> (World, Vec<Entity>) {
        let mut world = World::new();
        world.spawn((PerspectiveCamera::default(), Placement::at(0.0, 0.0, 9.0)));
        let orientation = DQuat::from_xyzw(0.5, -0.1, 0.7, 0.5).normalize();
        let spawn = |&scale: &DVec3| {
            let placement = Placement { scale, orientation, position: DVec3::new(1.0, 2.0, 3.0) };
            world.spawn((Sphere { radius: 2.0 }, Matte::default(), placement)).id()
        };
        let spheres = scales.iter().map(spawn).collect();
        (world, spheres)
    }

    #[test]
    fn a_sphere_is_in_one_table_or_the_other() {
        let non_uniform = [DVec3::new(1.0, 1.0, 1.0 + 2e-9), DVec3::new(-1.0, 1.0, 2.0), DVec3::new(1e-3, 1.0, 1e3)];
        let even = [DVec3::ONE, DVec3::new(1.0, 1.0, 1.0 + 1e-12), DVec3::new(-2.0, 2.0, 2.0), DVec3::splat(-1e-9)];
        let (world, spheres) = scene(&[&non_uniform[..], &even].concat());
        let (shapes, ellipsoids) =
            (ShapeTable::extract(&Census::of(&world)), EllipsoidTable::extract(&Census::of(&world)));
        let (shapes, ellipsoids) = (shapes.expect("shapes"), ellipsoids.expect("ellipsoids"));
        let spheres_left = SphereTable::extract(&Census::of(&world)).expect("spheres");
        assert_eq!(ellipsoids.shape, [0, 1, 2]);
        assert_eq!(spheres_left.shape, [3, 4, 5, 6]);
        for (number, &sphere) in spheres.iter().enumerate() {
            let kind = if non_uniformly_scaled(&Census::of(&world), sphere) {
                ShapeKind::Ellipsoid
            } else {
                ShapeKind::Sphere
            };
            assert_eq!(shapes.kind[number], kind, "sphere {number}");
        }
    }

    #[test]
    fn the_map_takes_poles_to_the_unit_sphere() {
        let scale = DVec3::new(-1e-3, 3.0, 1e3);
        let (world, spheres) = scene(&[scale]);
        let table = EllipsoidTable::extract(&Census::of(&world)).expect("ellipsoids");
        let pose = pose(&Census::of(&world), "", spheres[0]).expect("a pose");
        let Ellipsoid { centre, unit_from_world, bounding_radius, .. } = table.row[0];
        assert_eq!(centre, DVec3::new(1.0, 2.0, -6.0));
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            let pole = pose.world_from_entity.matrix3 * (axis * 2.0);
            assert!((unit_from_world * pole - axis).length() < 1e-7, "{axis}: {}", unit_from_world * pole);
            assert!(pole.length() <= bounding_radius);
        }
        assert!(bounding_radius < 2e3 * 1.0001);
    }

    #[test]
    fn a_sheared_sphere_fills_its_bounding_radius() {
        let (mut world, spheres) = scene(&[DVec3::new(1.0, 2.0, 0.5)]);
        let parent = world.spawn(Placement { scale: DVec3::new(3.0, 1.0, 100.0), ..Placement::default() }).id();
        world.entity_mut(spheres[0]).insert(ChildOf(parent));
        let map = pose(&Census::of(&world), "", spheres[0]).expect("a pose").world_from_entity.matrix3;
        let bounding_radius = EllipsoidTable::extract(&Census::of(&world)).expect("ellipsoids").row[0].bounding_radius;
        let steps = (0..100_000).map(|step| f64::from(step) * 1e-5 * std::f64::consts::TAU * 100.0);
        let point = |angle: f64| {
            let (height, round) = (libm::sin(angle / 200.0), libm::cos(angle / 200.0));
            map * (DVec3::new(libm::cos(angle) * round, libm::sin(angle) * round, height) * 2.0)
        };
        let farthest = steps.map(|angle| point(angle).length()).fold(0.0, f64::max);
        assert!(
            farthest <= bounding_radius && bounding_radius <= farthest * 1.02,
            "{farthest} within {bounding_radius}"
        );
    }

    #[test]
    fn an_ellipsoid_longer_than_ten_million_times_its_thickness_is_refused() {
        let table = |ratio: f64| EllipsoidTable::extract(&Census::of(&scene(&[DVec3::new(1.0, 1.0, ratio)]).0));
        assert!(table(0.999e7).is_ok() && table(1.001e-7).is_ok());
        for ratio in [2e7, 1e-8] {
            let scene_error = table(ratio).expect_err("refused").to_string();
            assert!(scene_error.contains("scale is (1, 1, ") && scene_error.contains("1e7 times"), "{scene_error}");
        }
    }
}
