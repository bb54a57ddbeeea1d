use super::arithmetic::{Arithmetic, Precise, dot_of};
use super::bounds::Bounds;
use super::emitter::EmittingTriangle;
use super::mesh_hierarchy::MeshHierarchy;
use super::mesh_instance::{hierarchy_in, is_closed};
use super::mesh_normal::unnormalised_normal;
use super::mesh_packet::{MeshPacket, may_be_coherent};
use super::mesh_traversal::{MeshStacks, keep_closest_apart};
use super::offset::l1_norm;
use super::ray_block::{ClosestHit, ClosestHits, Intersection, RaySlices};
use super::ray_hit::{HitBlock, RayHit, SurfacePoint};
use super::shape::{Placed, Shape};
use super::space::{norm, normal_world_from_object};
use super::triangle_hit::TriangleHit;
use super::triangle_row::TriangleRow;
use super::triangle_surfaces::{ObjectMaps, interpolate_mesh};
use super::uv_slope::{UvSlope, planar_slope};
use crate::bvh::{PACKET, Stack, TestCounts};
use crate::scene::{MeshGeometry, MeshInstance, SceneError, number};
use glam::{DMat3, DVec2, DVec3};
use multiversion::multiversion;
use std::sync::Arc;

/// A mesh at a place: rays are taken to its object space, and its triangles stay as they are for all of its instances.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedMesh {
    /// The triangles.
    pub geometry: MeshGeometry,
    /// The same in a hierarchy.
    pub(super) hierarchy: Arc<MeshHierarchy>,
    /// The linear map from render space to object space.
    pub object_from_world: DMat3,
    /// Its inverse.
    pub world_from_object: DMat3,
    /// The origin of object space, relative to the eye.
    pub position: DVec3,
    /// The largest magnitude in the computation of a hit point, for its error bound.
    pub size: f64,
    /// Around all of it, in render space.
    pub bounds: Bounds,
    /// The sphere through the corners of that box.
    centre: DVec3,
    radius: f64,
}

/// A ray that starts farther away than this many times the radius of the sphere around a mesh is moved on to it; from
/// there f64 still resolves 2⁻⁴² of the radius.
const FAR_AWAY: f64 = 1024.0;

impl PlacedMesh {
    // ANCHOR: near_ray
    /// A ray in object space, and whether it starts close enough to the mesh.
    #[inline(always)]
    fn near_ray(&self, [origin, direction]: [DVec3; 2]) -> ([DVec3; 2], bool) {
        let apart = self.centre - origin;
        let ray = [self.object_from_world * (origin - self.position), self.object_from_world * direction];
        (ray, apart.length_squared() <= (FAR_AWAY * self.radius) * (FAR_AWAY * self.radius))
    }
    // ANCHOR_END: near_ray

    /// A ray in object space, and the t at which it starts there.
    ///
    /// From afar it is moved on to where it is close to the mesh, in double-double, since f64 would not resolve the
    /// triangles from there; t grows alike in both spaces.
    #[inline(always)]
    pub(super) fn own_ray(&self, ray: [DVec3; 2]) -> ([DVec3; 2], f64) {
        let (own, is_near) = self.near_ray(ray);
        if is_near { (own, 0.0) } else { self.moved_on(ray).unwrap_or((own, 0.0)) }
    }

    /// A ray from afar in object space, from where it is about to enter the sphere around the mesh; none for one that
    /// goes away from it.
    #[cold]
    #[inline(never)]
    fn moved_on(&self, [origin, direction]: [DVec3; 2]) -> Option<([DVec3; 2], f64)> {
        let length = direction.length();
        let start = (self.centre - origin).dot(direction) / (length * length) - 1.01 * self.radius / length;
        if !(start > 0.0 && start.is_finite()) {
            return None;
        }
        let rows = [0, 1, 2].map(|row| self.object_from_world.row(row).to_array().map(Precise::from));
        let from_position = [0, 1, 2].map(|axis| Precise::from(origin[axis]) - Precise::from(self.position[axis]));
        let along = direction.to_array().map(Precise::from);
        let along = rows.map(|row| dot_of(row, along));
        let at = [0, 1, 2].map(|axis| dot_of(rows[axis], from_position) + Precise::from(start) * along[axis]);
        let [at, along] = [at, along].map(|vector| DVec3::from(vector.map(Arithmetic::value)));
        Some(([at, along], start))
    }

    /// A triangle in object space.
    #[inline(always)]
    pub(super) fn triangle(&self, triangle: u32) -> TriangleRow {
        let corners = self.geometry.corners(triangle as usize).map(|corner| DVec3::from(corner.map(f64::from)));
        let size = corners.map(l1_norm).into_iter().fold(0.0, f64::max);
        TriangleRow { corners, size, centre: DVec3::ZERO, bounding_radius: 0.0 }
    }

    /// The vertices of a triangle in render space.
    pub fn placed_triangle(&self, triangle: usize) -> [DVec3; 3] {
        let placed = |corner: [f32; 3]| self.world_from_object * DVec3::from(corner.map(f64::from)) + self.position;
        self.geometry.corners(triangle).map(placed)
    }

    /// A triangle as a light; its normal is NaN where it has no area.
    #[inline(always)]
    pub fn emitting_triangle(&self, triangle: usize) -> EmittingTriangle {
        let normal = self.normal_of(&self.triangle(triangle as u32));
        EmittingTriangle { corners: self.placed_triangle(triangle), normal }
    }

    /// The unit normal of a triangle in render space, on the side from which its vertices run anticlockwise in object
    /// space.
    #[inline(always)]
    pub(super) fn normal_of(&self, triangle: &TriangleRow) -> DVec3 {
        let along = normal_world_from_object(self.object_from_world, unnormalised_normal(triangle));
        (along / along.abs().max_element()).normalize()
    }

    /// The vertices of all triangles in render space.
    pub fn placed_triangles(&self) -> impl Iterator<Item = [DVec3; 3]> {
        (0..self.geometry.triangles.len()).map(|triangle| self.placed_triangle(triangle))
    }

    /// The closest hit, its shape's number 0; [`ClosestHit::NONE`] for a miss.
    // It is asked for single points; inlined there, the loop over a tile's rays would not be.
    #[inline(never)]
    pub fn closest(&self, origin: DVec3, direction: DVec3) -> ClosestHit {
        self.keep_closest_of_ray([origin, direction], 0, ClosestHit::NONE, &mut Stack::default())
    }

    /// The closest hit, found by testing all triangles.
    pub fn closest_of_all(&self, origin: DVec3, direction: DVec3) -> ClosestHit {
        let (ray, start) = self.own_ray([origin, direction]);
        self.hierarchy.closest_of_all(ray, start)
    }
}

impl Shape for PlacedMesh {
    type Component = MeshInstance;
    type SurfaceData = ();
    type Emitter = EmittingTriangle;

    const HAS_PRIMITIVES: bool = true;
    const IS_TRIANGULAR: bool = true;
    const HIERARCHY_FROM: usize = 6;

    fn has_inside(mesh: &MeshInstance) -> bool {
        is_closed(&mesh.geometry)
    }

    fn place(mesh: &MeshInstance, placed: &Placed<'_>) -> Result<(Self, ()), SceneError> {
        let Placed { who, pose, position, .. } = *placed;
        let (geometry, hierarchy) = (mesh.geometry.clone(), hierarchy_in(&mesh.geometry));
        let size = hierarchy.size;
        if geometry.triangles.is_empty() || !size.is_finite() {
            let value = if geometry.triangles.is_empty() { "empty".into() } else { number(size) };
            return Err(SceneError::new(who, "triangles", value, "there must be one at least, with finite vertices"));
        }
        let (world_from_object, object_from_world) = (pose.world_from_entity.matrix3, pose.entity_from_world);
        let (low, high) = hierarchy.placed_extent(&geometry, world_from_object);
        let bounds = Bounds::about(position + 0.5 * (low + high), 0.5 * (high - low));
        // What rounding in object space amounts to in render space.
        let stretch = norm(world_from_object) * norm(object_from_world);
        let size = stretch * (l1_norm(position) + norm(world_from_object) * size);
        if !(size.is_finite() && bounds.min.is_finite() && bounds.max.is_finite()) {
            return Err(SceneError::new(who, "placed size", number(size), "it must be finite"));
        }
        let (centre, radius) = bounds.sphere_around();
        Ok((
            Self { geometry, hierarchy, object_from_world, world_from_object, position, size, bounds, centre, radius },
            (),
        ))
    }

    fn intersection(&self, origin: DVec3, direction: DVec3) -> Intersection {
        Intersection { t: self.closest(origin, direction).t, uncertain: false }
    }

    fn precise_t(&self, origin: DVec3, direction: DVec3) -> f64 {
        self.closest(origin, direction).t
    }

    fn primitive_at(&self, origin: DVec3, direction: DVec3, _t: f64) -> u32 {
        self.closest(origin, direction).primitive
    }

    fn keep_closest(meshes: &[Self], numbers: &[u32], rays: RaySlices<'_>, hits: ClosestHits<'_>) {
        mesh_rows(meshes, numbers, rays, hits);
    }

    #[inline(always)]
    fn keep_closest_of_ray(&self, ray: [DVec3; 2], number: u32, closest: ClosestHit, stack: &mut Stack) -> ClosestHit {
        self.hierarchy.keep_closest(self.own_ray(ray), number, closest, stack)
    }

    fn keep_closest_counted(
        &self,
        ray: [DVec3; 2],
        number: u32,
        closest: ClosestHit,
        above: u32,
        counts: &mut TestCounts,
    ) -> ClosestHit {
        self.hierarchy.keep_closest_counted(self.own_ray(ray), number, closest, above, counts)
    }

    fn surface(&self, _: &(), hit: &RayHit) -> SurfacePoint {
        let triangle = self.triangle(hit.primitive);
        let ([origin, direction], _) = self.own_ray([hit.origin, hit.direction]);
        let triangle_hit = TriangleHit::of(origin, direction, &triangle);
        let point = self.world_from_object * triangle_hit.interpolate(&triangle.corners) + self.position;
        let normal = self.normal_of(&triangle);
        let outside = !triangle_hit.along;
        let normal = if outside { normal } else { -normal };
        let at = DVec3::from(triangle_hit.weights);
        SurfacePoint { point, normal, bound: hit.bound(point, self.size), outside, at }
    }

    /// Together where all of them are of one mesh.
    fn fill_surfaces(meshes: &[Self], surface_data: &[()], hits: &mut HitBlock, count: usize) {
        let is_one = hits.shape[..count].windows(2).all(|pair| pair[0] == pair[1]);
        if is_one {
            meshes[hits.shape[0] as usize].interpolate(hits, count);
        }
        for lane in 0..count {
            if !(is_one && hits.is_certain(lane)) {
                Self::fill_surface(meshes, surface_data, hits, lane);
            }
        }
    }

    fn uv(&self, _: &(), hit: &RayHit, at: DVec3, _own: DVec3) -> [f64; 2] {
        let uvs = self.uvs_of(hit.primitive);
        (at.x * uvs[0] + at.y * uvs[1] + at.z * uvs[2]).into()
    }

    fn uv_slope(&self, _: &(), _uv_from_world: DMat3) -> UvSlope {
        UvSlope::OfPrimitive
    }

    fn uv_slope_of(&self, _: &(), triangle: u32) -> UvSlope {
        let [a, b, c] = self.triangle(triangle).corners.map(|corner| self.world_from_object * corner);
        planar_slope([b - a, c - a], self.uvs_of(triangle))
    }

    fn contains(&self, point: DVec3) -> bool {
        self.windings(point) > 0
    }

    fn windings(&self, point: DVec3) -> u32 {
        self.windings_around(point)
    }

    fn thickness(&self) -> f64 {
        self.least_thickness()
    }

    fn bounds(&self) -> Option<Bounds> {
        Some(self.bounds)
    }

    /// The geometry and the hierarchy of each mesh, however many instances it has.
    fn bytes_of_surface_data(meshes: &[Self]) -> usize {
        let mut seen: Vec<(*const MeshHierarchy, usize)> = meshes
            .iter()
            .map(|mesh| (Arc::as_ptr(&mesh.hierarchy), mesh.geometry.bytes() + mesh.hierarchy.bytes()))
            .collect();
        seen.sort_unstable();
        seen.dedup();
        seen.iter().map(|(_, bytes)| bytes).sum()
    }
}

impl PlacedMesh {
    /// The surfaces of hits that are all of this mesh, where f64 is certain of them.
    fn interpolate(&self, hits: &mut HitBlock, count: usize) {
        for lane in 0..count {
            let corners = self.geometry.corners(hits.primitive[lane] as usize);
            hits.set_corners(lane, corners.map(|corner| DVec3::from(corner.map(f64::from))));
        }
        let maps = ObjectMaps {
            object_from_world: self.object_from_world,
            world_from_object: self.world_from_object,
            normal_from_object: self.object_from_world.transpose(),
            position: self.position,
            centre: self.centre,
            far_away: (FAR_AWAY * self.radius) * (FAR_AWAY * self.radius),
            size: self.size,
        };
        interpolate_mesh(hits, &maps);
    }

    /// The texture coordinates of a triangle's vertices: those of the mesh, or else (0, 0), (1, 0) and (0, 1).
    fn uvs_of(&self, triangle: u32) -> [DVec2; 3] {
        match &self.geometry.uvs {
            None => [DVec2::ZERO, DVec2::X, DVec2::Y],
            Some(uvs) => self.geometry.triangles[triangle as usize]
                .map(|vertex| DVec2::from(uvs[vertex as usize].map(f64::from))),
        }
    }
}

/// Intersects rays with one mesh after another: coherent ones in packets, others one by one, or several in turns where
/// the hierarchy is larger than a processor's caches.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn mesh_rows(meshes: &[PlacedMesh], numbers: &[u32], rays: RaySlices<'_>, mut hits: ClosestHits<'_>) {
    if hits.t.len() < PACKET {
        let mut stack = Stack::default();
        return for (mesh, &number) in meshes.iter().zip(numbers) {
            for row in 0..hits.t.len() {
                hits.set(row, mesh.keep_closest_of_ray(rays.ray(row), number, hits.get(row), &mut stack));
            }
        };
    }
    let (mut packet, mut stacks) = (MeshPacket::default(), MeshStacks::default());
    for (mesh, &number) in meshes.iter().zip(numbers) {
        let room = (&mut packet, &mut stacks);
        match hits.any {
            true => mesh.keep_closest_of_rows::<true>(number, rays, &mut hits, room),
            false => mesh.keep_closest_of_rows::<false>(number, rays, &mut hits, room),
        }
    }
}

impl PlacedMesh {
    #[inline(always)]
    fn keep_closest_of_rows<const ANY: bool>(
        &self,
        number: u32,
        rays: RaySlices<'_>,
        hits: &mut ClosestHits<'_>,
        (packet, stacks): (&mut MeshPacket, &mut MeshStacks),
    ) {
        let (hierarchy, own_ray) = (&*self.hierarchy, |row| self.own_ray(rays.ray(row)));
        let (mut waiting, mut in_packets) = (0, true);
        for start in (0..hits.t.len() / PACKET).map(|packet| packet * PACKET) {
            let [origin, direction] =
                [rays.origin, rays.direction].map(|of| of.map(|part| &part[start..start + PACKET]));
            let some = RaySlices { origin, direction };
            let near_ray = |place| self.near_ray(some.ray(place));
            if in_packets && may_be_coherent(some) && packet.set(hierarchy, near_ray) {
                keep_closest_apart::<ANY>(hierarchy, number, waiting..start, own_ray, hits, stacks);
                // What one packet is too wide for, its neighbours are too.
                in_packets = packet.keep_closest::<ANY>(hierarchy, number, start, hits, &mut stacks[0]);
                waiting = if in_packets { start + PACKET } else { start };
            }
        }
        keep_closest_apart::<ANY>(hierarchy, number, waiting..hits.t.len(), own_ray, hits, stacks);
    }
}
