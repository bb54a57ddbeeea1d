//! A mesh in render space.

use super::arithmetic::{Arithmetic, Precise, dot_of, exact_cross, exact_difference};
use super::bounds::{Bounds, l1_norm};
use super::emitter::EmittingTriangle;
use super::mesh_lockstep::Lockstep;
use super::mesh_traversal::{MeshHierarchy, MeshPacket, may_be_coherent};
use super::ray_block::{ClosestHit, ClosestHits, HITS, HitBlock, Intersection, RayHit, RaySlices, SurfacePoint};
use super::shape::{Placed, SceneShape, Shape};
use super::space::{norm, normal_world_from_object};
use super::triangle::{EXACT_BELOW, ObjectMaps, TriangleHit, TriangleRow, interpolate_mesh};
use super::uv::{UvSlope, planar_slope};
use crate::bvh::{PACKET, ROW, ROWS, Stack, TestCounts};
use crate::each::Each;
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
        let rows = [0, 1, 2].each(|row| self.object_from_world.row(row).to_array().each(Precise::from));
        let from_position = [0, 1, 2].each(|axis| Precise::from(origin[axis]) - Precise::from(self.position[axis]));
        let along = direction.to_array().each(Precise::from);
        let along = rows.each(|row| dot_of(row, along));
        let at = [0, 1, 2].each(|axis| dot_of(rows[axis], from_position) + Precise::from(start) * along[axis]);
        let [at, along] = [at, along].each(|vector| DVec3::from(vector.each(Arithmetic::value)));
        Some(([at, along], start))
    }

    /// A triangle in object space.
    #[inline(always)]
    pub(super) fn triangle(&self, triangle: u32) -> TriangleRow {
        let corners = self.geometry.corners(triangle as usize).each(|corner| DVec3::from(corner.each(f64::from)));
        let size = corners.each(l1_norm).into_iter().fold(0.0, f64::max);
        TriangleRow { corners, size, centre: DVec3::ZERO, bounding_radius: 0.0 }
    }

    /// The vertices of a triangle in render space.
    pub fn placed_triangle(&self, triangle: usize) -> [DVec3; 3] {
        let placed = |corner: [f32; 3]| self.world_from_object * DVec3::from(corner.each(f64::from)) + self.position;
        self.geometry.corners(triangle).each(placed)
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
    type Prepared = ();

    const HAS_PRIMITIVES: bool = true;
    const IS_TRIANGULAR: bool = true;
    const HIERARCHY_FROM: usize = 6;
    const IN_BLOCKS: bool = false;

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

    fn keep_closest((meshes, ()): (&[Self], &()), numbers: &[u32], rays: RaySlices<'_>, hits: ClosestHits<'_>) {
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

    #[inline(always)]
    fn uv(&self, _: &(), hit: &RayHit, at: DVec3, _own: DVec3) -> [f64; 2] {
        let uvs = self.uvs_of(hit.primitive);
        (at.x * uvs[0] + at.y * uvs[1] + at.z * uvs[2]).into()
    }

    fn uv_slope(&self, _: &(), _uv_from_world: DMat3) -> UvSlope {
        UvSlope::OfPrimitive
    }

    #[inline(always)]
    fn uv_slope_of(&self, _: &(), triangle: u32) -> UvSlope {
        let [a, b, c] = self.triangle(triangle).corners.each(|corner| self.world_from_object * corner);
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
        for lane in 0..count.min(HITS) {
            let corners = self.geometry.corners(hits.primitive[lane] as usize);
            hits.set_corners(lane, corners.each(|corner| DVec3::from(corner.each(f64::from))));
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
    #[inline]
    fn uvs_of(&self, triangle: u32) -> [DVec2; 3] {
        match &self.geometry.uvs {
            None => [DVec2::ZERO, DVec2::X, DVec2::Y],
            Some(uvs) => self.geometry.triangles[triangle as usize]
                .each(|vertex| DVec2::from(uvs[vertex as usize].each(f64::from))),
        }
    }
}

/// Intersects rays with one mesh after another: coherent ones in packets, others in lockstep, and a few one by one.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn mesh_rows(meshes: &[PlacedMesh], numbers: &[u32], rays: RaySlices<'_>, mut hits: ClosestHits<'_>) {
    let mut stack = Stack::default();
    // In lockstep 16 rays take 1.4 times as long as alone, 32 hardly longer, and 64 nine tenths.
    if hits.t.len() < PACKET {
        return for (mesh, &number) in meshes.iter().zip(numbers) {
            for row in 0..hits.t.len() {
                hits.set(row, mesh.keep_closest_of_ray(rays.ray(row), number, hits.get(row), &mut stack));
            }
        };
    }
    let (mut packet, mut lockstep) = (MeshPacket::default(), Lockstep::default());
    for (mesh, &number) in meshes.iter().zip(numbers) {
        let room = (&mut packet, &mut lockstep, &mut stack);
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
        (packet, lockstep, stack): (&mut MeshPacket, &mut Lockstep, &mut Stack),
    ) {
        let hierarchy = &*self.hierarchy;
        let (mut waiting, mut in_packets) = (0, true);
        let packets = hits.t.len() / PACKET;
        for packet_number in 0..=packets {
            let (start, is_last) = (packet_number * PACKET, packet_number == packets);
            let is_packet = in_packets && !is_last && {
                let some = rays.part(start..start + PACKET);
                may_be_coherent(some) && self.set_packet(packet, some)
            };
            if is_packet || is_last {
                let end = if is_last { hits.t.len() } else { start };
                lockstep.keep_closest::<ANY>((self, number), waiting..end, rays, hits, stack);
            }
            if is_packet {
                // What one packet is too wide for, its neighbours are too.
                in_packets = packet.keep_closest::<ANY>(hierarchy, number, start, hits, stack);
                waiting = if in_packets { start + PACKET } else { start };
            }
        }
    }

    /// Takes the rays of a packet to object space; says whether they all start close to the mesh and are coherent.
    #[inline(always)]
    fn set_packet(&self, packet: &mut MeshPacket, rays: RaySlices<'_>) -> bool {
        let mut all_near = true;
        for row in 0..ROWS {
            for i in 0..ROW {
                let (ray, is_near) = self.near_ray(rays.ray(row * ROW + i));
                all_near &= is_near;
                packet.set_ray(row, i, ray);
            }
        }
        all_near && packet.prepare(&self.hierarchy)
    }
}

// The inside of a mesh: whether a point is in it, and how thin it is.

/// How far past a triangle a ray that counts triangles goes on, as a fraction of the numbers from which it was computed.
const NEXT_TRIANGLE: f64 = 1.0 / (1_u64 << 46) as f64;

impl PlacedMesh {
    /// How many times a mesh that closes is around a point, counted along a ray: every surface that it leaves through is
    /// around the point, unless it was entered on the way.
    pub(super) fn windings_around(&self, point: DVec3) -> u32 {
        // Any direction will do; this one is along no axis.
        let direction = DVec3::new(0.6, 0.48, 0.64);
        if !self.bounds.contains(point) || !self.closes() {
            return 0;
        }
        let (mut around, mut origin) = (0, point);
        // Each step crosses a triangle, so that the count ends by itself; a step that rounding loses ends it too.
        for _ in 0..2 * self.geometry.triangles.len() {
            let closest = self.closest(origin, direction);
            if closest.t == f64::INFINITY {
                break;
            }
            let hit = RayHit { primitive: closest.primitive, ..RayHit::at_rest(origin, direction, closest.t) };
            around += if self.surface(&(), &hit).outside { -1 } else { 1 };
            let past = NEXT_TRIANGLE * (self.size + l1_norm(origin) + closest.t);
            origin += (closest.t + past) * direction;
        }
        u32::try_from(around).unwrap_or(0)
    }

    /// Whether its triangles enclose an inside.
    fn closes(&self) -> bool {
        self.hierarchy.is_closed(&self.geometry)
    }

    /// The least distance to what lies behind the middle of a triangle: where two sides are near each other over an area,
    /// some triangle's middle is there.
    pub(super) fn least_thickness(&self) -> f64 {
        let behind = |(triangle, corners): (usize, [DVec3; 3])| {
            let inward = -self.normal_of(&self.triangle(triangle as u32));
            let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
            let past = NEXT_TRIANGLE * (self.size + l1_norm(middle));
            let t = if inward.is_finite() { self.closest(middle + past * inward, inward).t } else { f64::INFINITY };
            t + past
        };
        self.placed_triangles().enumerate().map(behind).fold(f64::INFINITY, f64::min)
    }
}

/// The least cosine between a shading normal and the direction to the viewer.
const GRAZING: f64 = 0.01;

impl PlacedMesh {
    /// The shading normal where a ray hits it, in render space and facing the ray: interpolated from the vertex normals,
    /// as unit vector; none where the mesh has none, or where they do not all point to one side of the triangle.
    #[inline(always)]
    pub fn shading_normal(&self, hit: &RayHit) -> Option<DVec3> {
        let normals = self.geometry.normals.as_ref()?;
        let vertices = self.geometry.triangles[hit.primitive as usize];
        let normals = vertices.each(|vertex| DVec3::from(normals[vertex as usize].each(f64::from)));
        let triangle = self.triangle(hit.primitive);
        let sides = normals.each(|normal| normal.dot(unnormalised_normal(&triangle)));
        let is_above = sides.iter().all(|&side| side > 0.0);
        if !(is_above || sides.iter().all(|&side| side < 0.0)) {
            return None;
        }
        let ([origin, direction], _) = self.own_ray([hit.origin, hit.direction]);
        let triangle_hit = TriangleHit::of(origin, direction, &triangle);
        let along = normal_world_from_object(self.object_from_world, triangle_hit.interpolate(&normals));
        let normal = (along / along.abs().max_element()).normalize();
        let normal = if triangle_hit.along == is_above { -normal } else { normal };
        // On a coarse mesh it may face away from the viewer, where every material is black.
        let (towards, cosine) = (-hit.direction, -normal.dot(hit.direction));
        Some(if cosine < GRAZING { (normal + (GRAZING - cosine) * towards).normalize() } else { normal })
    }

    /// The colour where a ray hits it, interpolated from those of the vertices, linear Rec. 709; none where it has none.
    pub fn vertex_colour(&self, hit: &RayHit) -> Option<[f64; 3]> {
        let colours = self.geometry.colours.as_ref()?;
        let vertices = self.geometry.triangles[hit.primitive as usize];
        let colours = vertices.each(|vertex| DVec3::from(colours[vertex as usize].each(f64::from)));
        let ([origin, direction], _) = self.own_ray([hit.origin, hit.direction]);
        let triangle_hit = TriangleHit::of(origin, direction, &self.triangle(hit.primitive));
        Some(triangle_hit.interpolate(&colours).clamp(DVec3::ZERO, DVec3::ONE).to_array())
    }
}

/// (B − A) × (C − A), from exact differences.
#[inline(always)]
pub(super) fn unnormalised_normal(triangle: &TriangleRow) -> DVec3 {
    let [a, b, c] = triangle.corners;
    let (one, other) = (b - a, c - a);
    let cross = one.cross(other);
    let largest = one.abs().max_element() * other.abs().max_element();
    if cross.abs().max_element() > largest * EXACT_BELOW { cross } else { exact_normal([a, b, c]) }
}

#[cold]
#[inline(never)]
fn exact_normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    DVec3::from(exact_cross(&exact_difference(b, a), &exact_difference(c, a)).each(|part| part.rounded()))
}

// The component of a mesh, and the hierarchy that its geometry has, however many instances there are.

impl SceneShape for MeshInstance {
    const NAME: &'static str = "MeshInstance";
    const WORD: &'static str = "mesh";

    fn scale(&mut self, by: f64) {
        let mut mesh = (*self.geometry).clone();
        for part in mesh.positions.iter_mut().flatten() {
            *part = (f64::from(*part) * by) as f32;
        }
        self.geometry = MeshGeometry::new(mesh);
    }

    /// An octahedron, and a flat one.
    fn examples() -> Vec<Self> {
        let mut flat = (*MeshGeometry::default()).clone();
        flat.positions.iter_mut().for_each(|[_, y, _]| *y *= 0.25);
        vec![Self::default(), Self { geometry: MeshGeometry::new(flat) }]
    }
}

/// The hierarchy of a mesh, built when the first instance asks for it.
pub(super) fn hierarchy_in(geometry: &MeshGeometry) -> Arc<MeshHierarchy> {
    geometry.once(MeshHierarchy::of)
}

/// Whether a mesh encloses an interior; found out when something first asks for it.
pub(super) fn is_closed(geometry: &MeshGeometry) -> bool {
    hierarchy_in(geometry).is_closed(geometry)
}
