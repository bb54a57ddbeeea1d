use super::hits::ShapeRows;
use super::moving::at_rest;
use super::{HitPrimitives, Hits, NO_SHAPE, Surfaces};
use crate::each::Each;
use crate::extract::{MeshTable, MovingTable, ShapeTable, TriangleTable, VertexNormalTable, moving_evidence};
use crate::plan::{Census, Evidence, Shared, Stage, TileSystems, VectorRows, VectorRowsMut, column};
use crate::rays::{RayTimes, WorldRays};
use crate::scene::{MeshInstance, Triangle};
use crate::shapes::{AnyShape, PlacedMesh, RayHit, ShapeKind, TriangleHit, TriangleRow};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use bevy_ecs::system::SystemParam;
use glam::{DVec3, Vec3};

column! {
    /// The shading normal at each hit, in world space; zero for a miss.
    ///
    /// It is the geometric normal except on triangles with vertex normals and where a normal map tilts it; exists if the
    /// scene has one or the other.
    pub struct ShadingNormals("shading", "world", "unit vector", Ray, begun in Normal) {
        /// A unit vector on the side of the ray, or nearly so.
        normal: Vec3 as [nx, ny, nz],
    }
}

impl ShadingNormals {
    /// Paints the normal: each component from −1 to 1 is mapped to 0 to 1; black for a miss.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        let normal = self.normal.at(row);
        if normal == [0.0; 3] { normal } else { normal.each(|component| 0.5 + 0.5 * component) }
    }

    /// Writes a row.
    #[inline(always)]
    pub fn set(&mut self, row: usize, normal: DVec3) {
        self.normal.put(row, normal.as_vec3());
    }

    /// Reads a row, in f64.
    #[inline(always)]
    pub fn get(&self, row: usize) -> DVec3 {
        self.normal(row).as_dvec3()
    }
}

// ANCHOR: shading_normal
/// The shading normal, interpolated from the vertex normals; a unit vector.
///
/// All three vertex normals point to one side of the triangle, so no weighted mean of them is 0.
#[inline(always)]
pub fn shading_normal(normals: &[DVec3; 3], triangle_hit: &TriangleHit) -> DVec3 {
    triangle_hit.interpolate(normals).normalize()
}
// ANCHOR_END: shading_normal

// ANCHOR: falling_cosine
/// The cosine of the angle of incidence with respect to the shading normal; 0 if the light is below the geometric
/// surface, whatever the shading normal is.
#[inline(always)]
pub fn falling_cosine(geometric: DVec3, shading: DVec3, to_light: DVec3) -> f64 {
    let above = geometric.dot(to_light) > 0.0;
    if above { shading.dot(to_light) } else { 0.0 }
}
// ANCHOR_END: falling_cosine

/// The hits of a tile, and their shading normals.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct ShadingNormalView {
    rays: &'static WorldRays,
    hits: &'static Hits,
    surfaces: &'static Surfaces,
    triangles: Option<&'static ShapeRows<TriangleRow>>,
    meshes: Option<&'static ShapeRows<PlacedMesh>>,
    primitives: Option<&'static HitPrimitives>,
    times: Option<&'static RayTimes>,
    shading: &'static mut ShadingNormals,
}

/// The shapes that have vertex normals.
#[derive(SystemParam)]
pub struct VertexNormals<'w> {
    shapes: Res<'w, Shared<ShapeTable>>,
    triangles: Option<Res<'w, Shared<TriangleTable>>>,
    of_triangles: Option<Res<'w, Shared<VertexNormalTable>>>,
    meshes: Option<Res<'w, Shared<MeshTable>>>,
    moving: Option<Res<'w, Shared<MovingTable>>>,
}

/// Fills a tile's shading normals.
pub fn interpolate_normals(table: VertexNormals<'_>, mut tiles: Query<ShadingNormalView>) {
    let VertexNormals { shapes, triangles, of_triangles, meshes, moving } = table;
    for ShadingNormalViewItem {
        rays,
        hits,
        surfaces,
        triangles: list,
        meshes: mesh_list,
        primitives,
        times,
        mut shading,
    } in &mut tiles
    {
        shading.normal.clone_from(&surfaces.normal);
        let mut set = |row: usize, normal: Vec3| shading.normal.put(row, normal);
        let row_of = |row: usize| shapes.row[hits.shape[row] as usize] as usize;
        if let (Some(list), Some(triangles), Some(normals)) = (list, &triangles, &of_triangles) {
            for row in list.row.iter().map(|&row| row as usize) {
                let triangle = row_of(row);
                let vertex_normals = &normals.normals[triangle];
                if vertex_normals[0] != DVec3::ZERO {
                    let (origin, turned) = (rays.origin_of(row), triangles.surface_data[triangle].turned);
                    let triangle = (&triangles.row[triangle], turned, vertex_normals);
                    set(row, facing_normal(origin, rays.direction_of(row), triangle));
                }
            }
        }
        if let (Some(list), Some(meshes), Some(primitives)) = (mesh_list, &meshes, primitives) {
            for row in list.row.iter().map(|&row| row as usize) {
                let primitive = primitives.primitive[row];
                let ray = RayHit::at_rest(rays.origin_of(row), rays.direction_of(row), hits.t[row]);
                if let Some(normal) = meshes.row[row_of(row)].shading_normal(&RayHit { primitive, ..ray }) {
                    set(row, normal.as_vec3());
                }
            }
        }
        let (Some(moving), Some(times)) = (&moving, times) else { continue };
        for (row, &shape) in hits.shape.iter().enumerate() {
            if shape == NO_SHAPE || shapes.kind[shape as usize] != ShapeKind::Moving {
                continue;
            }
            let mover = shapes.row[shape as usize] as usize;
            let origin = at_rest(rays.origin_of(row), moving.velocity[mover], times.time[row]);
            match (&moving.body[mover], &of_triangles, primitives) {
                (AnyShape::Triangle(triangle, face), Some(normals), _) if normals.moving[mover][0] != DVec3::ZERO => {
                    let triangle = (triangle, face.turned, &normals.moving[mover]);
                    set(row, facing_normal(origin, rays.direction_of(row), triangle));
                }
                (AnyShape::Mesh(mesh, ()), _, Some(primitives)) => {
                    let primitive = primitives.primitive[row];
                    let ray = RayHit::at_rest(origin, rays.direction_of(row), hits.t[row]);
                    if let Some(normal) = mesh.shading_normal(&RayHit { primitive, ..ray }) {
                        set(row, normal.as_vec3());
                    }
                }
                _ => {}
            }
        }
    }
}

/// The shading normal where a ray hits a triangle, whose normal may be turned, on the side of the ray.
#[inline(always)]
fn facing_normal(
    origin: DVec3,
    direction: DVec3,
    (triangle, turned, normals): (&TriangleRow, bool, &[DVec3; 3]),
) -> Vec3 {
    let triangle_hit = TriangleHit::of(origin, direction, triangle);
    let leaves_by_normal = triangle_hit.along != turned;
    let normal = shading_normal(normals, &triangle_hit);
    if leaves_by_normal { -normal } else { normal }.as_vec3()
}

/// The stage that runs this system.
pub fn shading_normal_stage() -> Stage {
    Stage::new("Interpolate shading normals", TileSystems::Normal, interpolate_normals)
        .table_where::<TriangleTable>(triangle_normal_evidence)
        .table_where::<VertexNormalTable>(triangle_normal_evidence)
        .table_where::<MeshTable>(mesh_normal_evidence)
        .table_where::<MovingTable>(moving_normal_evidence)
        .reads_where::<ShapeRows<TriangleRow>>(triangle_normal_evidence)
        .reads_where::<ShapeRows<PlacedMesh>>(mesh_normal_evidence)
        .reads_where::<HitPrimitives>(mesh_normal_evidence)
        .reads_where::<RayTimes>(moving_normal_evidence)
        .when(vertex_normal_evidence)
}

/// Evidence that the scene contains a shape with vertex normals.
pub fn vertex_normal_evidence(scene: &Census<'_>) -> Evidence {
    triangle_normal_evidence(scene).or(mesh_normal_evidence(scene))
}

fn triangle_normal_evidence(scene: &Census<'_>) -> Evidence {
    let has = |triangle| scene.get::<Triangle>(triangle).is_some_and(|triangle| triangle.normals.is_some());
    Evidence::of_kind::<With<Triangle>>(scene, "triangle with normals", has)
}

fn mesh_normal_evidence(scene: &Census<'_>) -> Evidence {
    let has = |mesh| scene.get::<MeshInstance>(mesh).is_some_and(|mesh| mesh.geometry.normals.is_some());
    Evidence::of_kind::<With<MeshInstance>>(scene, "mesh with normals", has)
}

/// Evidence that one of these moves while the shutter is open.
fn moving_normal_evidence(scene: &Census<'_>) -> Evidence {
    vertex_normal_evidence(scene).and(|| moving_evidence(scene))
}
