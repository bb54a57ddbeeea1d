//! What a frame is compared with: its camera and its shapes in exact numbers.

use crate::measure::oracle_camera::ExactCamera;
use crate::measure::oracle_plane::Plane;
use crate::measure::oracle_sphere::Sphere;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::Result;
use pinhole::extract::{
    CameraAxes, CuboidTable, DiskTable, Ellipsoid, EllipsoidTable, Planar, PlaneTable, RectangleTable, ShapeKind,
    ShapeTable, Slabs, SphereTable, TriangleRow, TriangleTable, camera_entity,
};
use pinhole::plan::{Census, Table};
use pinhole::render::Inspection;
use pinhole::scene::{OrthographicCamera, PerspectiveCamera};

/// What the frame is compared with.
pub(super) struct Exact {
    pub camera: ExactCamera,
    /// Half the height of an orthographic camera's rectangle.
    pub half_height: Option<f64>,
    /// None where some move: each ray meets those elsewhere, so no hit is compared.
    pub shapes: Vec<ExactShape>,
}

pub(super) enum ExactShape {
    Sphere(Sphere),
    Plane(Plane),
    Ellipsoid(Ellipsoid),
    Disk(Planar),
    Rectangle(Planar),
    Cuboid(Slabs),
    Triangle(TriangleRow, DVec3),
}

impl Exact {
    pub fn of(scene: &World, frame: &Inspection) -> Result<Self> {
        let camera = camera_entity(scene)?;
        let (width, height) = (frame.image.width, frame.image.height);
        let census = &Census::of(scene);
        let axes = CameraAxes::extract(census)?.world_from_camera;
        let PerspectiveCamera { fov, axis } = scene.get::<PerspectiveCamera>(camera).copied().unwrap_or_default();
        let half_height = scene.get::<OrthographicCamera>(camera).map(|camera| camera.view_height / 2.0);
        let (shapes, spheres) = (ShapeTable::extract(census)?, SphereTable::extract(census)?);
        let (planes, ellipsoids) = (PlaneTable::extract(census)?, EllipsoidTable::extract(census)?);
        let (disks, rectangles) = (DiskTable::extract(census)?, RectangleTable::extract(census)?);
        let (cuboids, triangles) = (CuboidTable::extract(census)?, TriangleTable::extract(census)?);
        let shape = |(kind, &row): (&ShapeKind, &u32)| {
            Some(match (kind, row as usize) {
                (ShapeKind::Sphere, row) => {
                    ExactShape::Sphere(Sphere { centre: spheres.centre(row), radius: spheres.radius[row] })
                }
                (ShapeKind::Plane, row) => {
                    ExactShape::Plane(Plane { normal: planes.normal[row], offset: planes.offset[row] })
                }
                (ShapeKind::Ellipsoid, row) => ExactShape::Ellipsoid(ellipsoids.ellipsoid[row]),
                (ShapeKind::Disk, row) => ExactShape::Disk(disks.planar[row]),
                (ShapeKind::Rectangle, row) => ExactShape::Rectangle(rectangles.planar[row]),
                (ShapeKind::Cuboid, row) => ExactShape::Cuboid(cuboids.slabs[row]),
                (ShapeKind::Triangle, row) => ExactShape::Triangle(triangles.triangle[row], triangles.normal[row]),
                (ShapeKind::Moving, _) => return None,
            })
        };
        let shapes = shapes.kind.iter().zip(&shapes.row).map(shape).collect::<Option<Vec<_>>>().unwrap_or_default();
        Ok(Self { camera: ExactCamera::new(width, height, fov.0, axis, axes), half_height, shapes })
    }
}
