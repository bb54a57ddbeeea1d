//! Bidirectional path tracing: every vertex of a path from the camera is joined to every vertex of a path from a light.
//!
//! Reads: surfaces of light paths; then, of camera paths, [`MaterialRows`] at every bounce.
//! Writes: [`LightVertices`], which between the two passes become [`LightVertexMap`]; then [`ShadowRays`] that carry the
//! light of each vertex.
//! Space: render space.
//!
//! A light vertex is a light that is as bright in each direction as its BSDF says, so that everything from shadow rays on
//! is as for other lights.

use super::bsdf::at_interfaces_where;
use super::interface::{Interface, InterfaceView};
use super::recursive_mis::{JoinRatios, RecursiveMis, bounded, squared};
use super::segment::{AT_ONCE, JoinedSurface, Segment, SegmentBlock, segments};
use super::{LightPower, bsdf::without_sides};
use crate::each::{Each, all_are, by_lane};
use crate::extract::{
    GlassTable, IntegratorTable, MaterialTable, bidirectional_evidence, bsdf_evidence, lit_from_behind_evidence,
};
use crate::intersect::{MaterialRows, ShadingNormals, Surfaces};
use crate::material::{Bsdf, MaterialKind, Parameters, ShadingContext, Transport};
use crate::plan::{Census, Column, Shared, Stage, StageKind, Table, TileSystems, VectorRowsMut, column};
use crate::rays::{Depth, Paths, PixelSamples, Tile, WorldRays, pixel_of_row};
use crate::scene::SceneError;
use crate::shade::{ParameterColumns, ShadowRays, TransmissiveRows, shadow_t_max};
use crate::shapes::offset_origin;
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::{DVec3, Vec3};
use rayon::ThreadPool;
use rayon::prelude::*;
use std::ops::Range;

column! {
    /// The vertices of a batch of light paths on surfaces that are not specular, in the order of bounces and paths.
    pub struct LightVertices("light vertices", "world, from the eye", "scene units; linear Rec. 709", Film) {
        /// The path, counted in the batch.
        path: u32,
        /// Where it is.
        position: Vec3 as [px, py, pz],
        /// The geometric normal, on the side that the light comes from.
        normal: Vec3 as [nx, ny, nz],
        /// The shading normal.
        shading: Vec3 as [sx, sy, sz],
        /// Where the light comes from; a unit vector.
        to_light: Vec3 as [tx, ty, tz],
        /// How far along the normal a ray must start to be certainly off the surface.
        bound: f32,
        /// The row of the material table.
        material: u32,
        /// The surface's colour.
        colour: [f64; 3] as [cr, cg, cb],
        /// How much of it is metal.
        metallic: f64,
        /// Its perceived roughness.
        roughness: f64,
        /// The index of refraction beyond the surface over that on this side.
        eta: f64,
        /// The power that the path carries here, divided by the pdf of its start.
        power: [f64; 3] as [r, g, b],
        /// What the path knows of other ways to find its light.
        arrival: f64,
        /// The same of those that are joined at earlier vertices.
        earlier: f64,
        /// The segments of the path from the light to here.
        segments: u32,
    }
}

impl LightVertices {
    /// The power that is carried.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.power(row).each(|part| part as f32)
    }

    /// A row.
    #[inline(always)]
    pub fn get(&self, row: usize) -> LightVertex {
        LightVertex {
            position: self.position(row),
            normal: self.normal(row),
            shading: self.shading(row),
            to_light: self.to_light(row),
            bound: self.bound[row],
            material: self.material[row],
            parameters: Parameters {
                colour: self.colour(row),
                metallic: self.metallic[row],
                roughness: self.roughness[row],
            },
            eta: self.eta[row],
            power: self.power(row),
            arrival: self.arrival[row],
            earlier: self.earlier[row],
            segments: self.segments[row],
        }
    }
}

/// A vertex of a light path; its fields are those of a row of [`LightVertices`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightVertex {
    /// Where it is, in render space.
    pub position: Vec3,
    /// The geometric normal, on the side that the light comes from.
    pub normal: Vec3,
    /// The shading normal.
    pub shading: Vec3,
    /// Where the light comes from; a unit vector.
    pub to_light: Vec3,
    /// The error bound of its position along the normal.
    pub bound: f32,
    /// The row of the material table.
    pub material: u32,
    /// The parameters of the surface there.
    pub parameters: Parameters,
    /// The relative index of refraction.
    pub eta: f64,
    /// The power that arrives, divided by the pdf of the path's start.
    pub power: [f64; 3],
    /// As in [`RecursiveMis`].
    pub arrival: f64,
    /// As in [`RecursiveMis`].
    pub earlier: f64,
    /// The segments of its path.
    pub segments: u32,
}

/// Bytes of a light vertex: in its batch's columns, in the list of all, and in the map.
pub const LIGHT_VERTEX_BYTES: u64 = (3 * size_of::<LightVertex>() + 3 * size_of::<u32>()) as u64;

/// Surfaces that light paths hit, and the vertices that become of them.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct StoreVerticesView {
    depth: &'static Depth,
    rays: &'static WorldRays,
    paths: &'static Paths,
    surfaces: &'static Surfaces,
    shading: Option<&'static ShadingNormals>,
    power: &'static LightPower,
    list: &'static MaterialRows,
    mis: &'static RecursiveMis,
    vertices: &'static mut LightVertices,
}

// ANCHOR: store_vertices
/// Stores a vertex wherever a light path hits a surface that is not specular, with all that is asked when it is joined.
pub fn store_vertices(
    (materials, glass): (Res<Shared<MaterialTable>>, Option<Res<Shared<GlassTable>>>),
    mut tiles: Query<(StoreVerticesView, ParameterColumns, InterfaceView)>,
) {
    for (view, columns, interface) in &mut tiles {
        let interface = Interface::new(interface, glass.as_deref());
        let StoreVerticesViewItem { depth, rays, paths, surfaces, shading, power, list, mis, mut vertices } = view;
        let first = vertices.rows();
        vertices.slices_mut(first + list.row.len());
        for (place, &row) in (first..).zip(&list.row) {
            let row = row as usize;
            let (surface, path) = (surfaces.get(row), paths.first[row] as usize);
            let material = surface.material as usize;
            let (whole, carried) = (power.rgb(path), paths.throughput(row));
            let vertex = LightVertex {
                position: surface.position,
                normal: surface.normal,
                shading: shading.map_or(surface.normal, |shading| shading.normal(row)),
                to_light: -rays.direction_of(row).as_vec3(),
                bound: surface.bound,
                material: surface.material,
                parameters: columns.get(&materials, row, material),
                eta: interface.eta(materials.interior[material], row),
                power: [whole[0] * carried[0], whole[1] * carried[1], whole[2] * carried[2]],
                arrival: mis.arrival[path],
                earlier: mis.earlier[path],
                segments: depth.0 + 1,
            };
            vertices.put(place, path as u32, &vertex);
        }
    }
}
// ANCHOR_END: store_vertices

impl LightVertices {
    /// Replaces a row by a vertex of a path.
    #[inline(always)]
    fn put(&mut self, row: usize, path: u32, own: &LightVertex) {
        self.path[row] = path;
        self.position.put(row, own.position);
        self.normal.put(row, own.normal);
        self.shading.put(row, own.shading);
        self.to_light.put(row, own.to_light);
        self.bound[row] = own.bound;
        self.material[row] = own.material;
        self.colour.put(row, own.parameters.colour);
        self.metallic[row] = own.parameters.metallic;
        self.roughness[row] = own.parameters.roughness;
        self.eta[row] = own.eta;
        self.power.put(row, own.power);
        self.arrival[row] = own.arrival;
        self.earlier[row] = own.earlier;
        self.segments[row] = own.segments;
    }
}

/// The stage that runs [`store_vertices`].
pub fn store_vertices_stage() -> Stage {
    let stage = Stage::new("Store light vertices", TileSystems::SampleLights, store_vertices);
    at_interfaces_where(stage, lit_from_behind_evidence)
        .on_light_paths()
        .kind(StageKind::Alternative)
        .when(bidirectional_evidence)
}

/// The light vertices of one sample, path by path.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightVertexMap {
    /// The vertices of each path, one path after another.
    vertices: Vec<LightVertex>,
    /// The material and the segments of each once more: all that is asked of those that are not joined.
    brief: Vec<[u32; 2]>,
    /// Where those of each path begin, and the end.
    first: Vec<u32>,
    /// The width of the image, between whose pixels the paths are divided.
    width: u32,
    /// How many paths there are for each.
    paths_a_pixel: f64,
}

impl Table for LightVertexMap {
    const NAME: &'static str = "light vertices of a sample";

    /// Without vertices: each sample has its own, which are traced before it.
    fn extract(_: &Census<'_>) -> Result<Self, SceneError> {
        Ok(Self::default())
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.vertices[..]) + size_of_val(&self.brief[..]) + size_of_val(&self.first[..])
    }
}

impl LightVertexMap {
    /// The map of the vertices that batches of so many paths have left, for an image of this size; made by these threads.
    pub fn new(
        batches: &[&LightVertices],
        paths_each: u32,
        [width, height]: [u32; 2],
        threads: Option<&ThreadPool>,
    ) -> Self {
        let (each, mut first) = (paths_each as usize, vec![0_u32]);
        for own in batches {
            // How many there are of each path, and then of all paths before it.
            let (before, start) = (first[first.len() - 1], first.len());
            first.resize(start + each, 0);
            own.path.iter().for_each(|&path| first[start + path as usize] += 1);
            first[start..].iter_mut().fold(before, |sum, own| {
                *own += sum;
                *own
            });
        }
        let mut vertices = vec![LightVertex::default(); first[first.len() - 1] as usize];
        let mut brief = vec![[0; 2]; vertices.len()];
        let (mut rest, mut parts) = ((&mut vertices[..], &mut brief[..]), Vec::with_capacity(batches.len()));
        for (batch, &own) in batches.iter().enumerate() {
            let (part, after) = rest.0.split_at_mut(own.rows());
            let (brief, brief_after) = rest.1.split_at_mut(own.rows());
            parts.push((own, &first[batch * each..(batch + 1) * each], part, brief));
            rest = (after, brief_after);
        }
        let sort = |(own, first, part, brief): (&LightVertices, &[u32], &mut [LightVertex], &mut [[u32; 2]])| {
            let mut next: Vec<u32> = first.iter().map(|own| own - first[0]).collect();
            for (row, &path) in own.path.iter().enumerate() {
                let place = &mut next[path as usize];
                part[*place as usize] = own.get(row);
                brief[*place as usize] = [own.material[row], own.segments[row]];
                *place += 1;
            }
        };
        match threads {
            Some(threads) => threads.install(|| parts.into_par_iter().for_each(sort)),
            None => parts.into_iter().for_each(sort),
        }
        let paths = batches.len() * each;
        let pixels = f64::from(width) * f64::from(height);
        Self { vertices, brief, first, width, paths_a_pixel: paths as f64 / pixels }
    }

    // ANCHOR: path_of_pixel
    /// The vertices of the light path that is joined to the paths of a pixel.
    ///
    /// There are as many light paths as pixels or another number of them; each pixel has one, and neighbours different ones
    /// where there are enough.
    #[inline(always)]
    pub fn of_pixel(&self, [x, y]: [u32; 2]) -> Range<usize> {
        let Some(last) = self.first.len().checked_sub(2) else { return 0..0 };
        let pixel = u64::from(y) * u64::from(self.width) + u64::from(x);
        let path =
            if self.paths_a_pixel == 1.0 { pixel as usize } else { (pixel as f64 * self.paths_a_pixel) as usize };
        let path = path.min(last);
        self.first[path] as usize..self.first[path + 1] as usize
    }
    // ANCHOR_END: path_of_pixel
}

/// Surfaces of camera paths, and the rays that join them to light vertices.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct JoinView {
    tile: &'static Tile,
    depth: &'static Depth,
    samples: Option<&'static PixelSamples>,
    paths: &'static Paths,
    surfaces: &'static Surfaces,
    shading: Option<&'static ShadingNormals>,
    list: &'static MaterialRows,
    far: Option<&'static TransmissiveRows>,
    rays: &'static mut ShadowRays,
    ratios: &'static mut JoinRatios,
}

/// What a shadow ray to a light vertex carries, and what is known of other ways to find its path.
struct Join {
    irradiance: [f64; 3],
    onward: f64,
    reverse: f64,
}

// ANCHOR: join_vertex
/// What a light vertex with this BSDF sends to a surface of some kind: its power, times its BSDF and the cosines of both ends
/// over the square of the distance.
#[inline(always)]
fn join_vertex<B: Bsdf>(
    bsdf: &B,
    (vertex, bsdf_row): (&LightVertex, usize),
    (kind, normal): (MaterialKind, DVec3),
    segment: &Segment,
    [onward, to_source]: [DVec3; 2],
) -> Join {
    let Segment { direction, square, geometry } = *segment;
    let opaque = ShadingContext::opaque(bsdf_row, vertex.parameters);
    let context = ShadingContext { eta: vertex.eta, transport: Transport::Importance, ..opaque };
    let (scattered, [forth, back]) = bsdf.eval_and_pdfs(&context, onward, to_source);

    // As many paths from either end come along the ray as its BSDF samples this direction.
    let from_light = forth * kind.cosine(normal, direction) / square;
    let from_eye = B::KIND.cosine(vertex.normal.as_dvec3(), direction) / square;
    let known = bounded(vertex.arrival + vertex.earlier * squared(back));
    Join {
        irradiance: [0, 1, 2].each(|part| vertex.power[part] * scattered[part] * geometry),
        onward: bounded(squared(from_eye) * known),
        reverse: squared(from_light),
    }
}
// ANCHOR_END: join_vertex

// ANCHOR: join_vertices
/// Appends a ray from every surface to each vertex with this BSDF of its pixel's light path.
///
/// Every ray is written, and the next one overwrites it unless it carries light.
pub fn join_vertices<B: Bsdf>(
    (materials, bsdf): (Res<Shared<MaterialTable>>, Res<Shared<B>>),
    (map, integrator): (Res<Shared<LightVertexMap>>, Res<Shared<IntegratorTable>>),
    (mut joined, mut pairs): (Local<Vec<JoinedSurface>>, Local<Vec<[u32; 2]>>),
    mut tiles: Query<JoinView>,
) {
    let mut block = SegmentBlock::NONE;
    for view in &mut tiles {
        list_pairs((B::KIND, &materials), (&map, integrator.max_depth), &view, (&mut joined, &mut pairs));
        let JoinViewItem { mut rays, mut ratios, .. } = view;
        let mut at = rays.rows();
        let (path, mut origins, mut directions, t_max, mut irradiance) = rays.slices_mut(at + pairs.len());
        let (row_of_ratios, onward, reverse) = ratios.slices_mut(at + pairs.len());
        for pairs in pairs.chunks(AT_ONCE) {
            block.gather(&joined, &map.vertices, pairs);
            segments(&mut block, B::TRANSMITS, B::NARROW);
            let (lanes, count) = block.those(pairs.len());
            for (_, lane) in by_lane::<AT_ONCE, _>(&lanes[..count.min(AT_ONCE)]) {
                let lane = lane as usize;
                let [surface, vertex] = pairs[lane];
                let (surface, vertex) = (&joined[surface as usize], &map.vertices[vertex as usize]);
                let bsdf_row = materials.row[vertex.material as usize] as usize;
                let (segment, local) = block.get(lane);
                let of_surface = (surface.kind, surface.normal.as_dvec3());
                let join = join_vertex(&**bsdf, (vertex, bsdf_row), of_surface, &segment, local);
                (path[at], row_of_ratios[at]) = (surface.row, surface.row);
                origins.put(at, surface.origin);
                directions.put(at, segment.direction.as_vec3());
                t_max[at] = shadow_t_max(segment.square.sqrt());
                irradiance.put(at, join.irradiance.each(|part| part.min(f64::from(f32::MAX)) as f32));
                (onward[at], reverse[at]) = (join.onward, join.reverse);
                at += usize::from(!all_are(join.irradiance, 0.0));
            }
        }
        rays.slices_mut(at);
        ratios.slices_mut(at);
    }
}
// ANCHOR_END: join_vertices

/// Lists the surfaces from which rays to light vertices start, and with each the vertices of a kind of its pixel's light path.
fn list_pairs(
    (kind, materials): (MaterialKind, &MaterialTable),
    (map, max_depth): (&LightVertexMap, u32),
    view: &JoinViewItem<'_, '_>,
    (joined, pairs): (&mut Vec<JoinedSurface>, &mut Vec<[u32; 2]>),
) {
    let JoinViewItem { tile, depth, samples, paths, surfaces, shading, list, far, .. } = view;
    joined.clear();
    let mut length = 0;
    for (rows, side) in [(&list.row[..], 1.0), (far.map_or(&[][..], |far| &far.row), -1.0)] {
        for &of in rows {
            let row = of as usize;
            let path = map.of_pixel(pixel_of_row(tile, *samples, Some(paths), row));
            if path.is_empty() {
                continue;
            }
            let (surface, number) = (surfaces.get(row), joined.len() as u32);
            let normal = surface.normal * side as f32;
            joined.push(JoinedSurface {
                row: of,
                kind: materials.kind[surface.material as usize],
                origin: offset_origin(surface.position, normal, surface.bound),
                normal,
                shaded: shading.map_or(surface.normal.as_dvec3(), |shading| shading.get(row)) * side,
            });
            if pairs.len() < length + path.len() {
                pairs.resize_with(2 * (length + path.len()), || [0; 2]);
            }
            for (vertex, &[material, segments]) in path.clone().zip(&map.brief[path]) {
                let is_short = depth.0.saturating_add(2).saturating_add(segments) <= max_depth;
                pairs[length] = [number, vertex as u32];
                length += usize::from((materials.kind[material as usize] == kind) & is_short);
            }
        }
    }
    pairs.truncate(length);
}

/// The stage that joins surfaces to light vertices with a BSDF.
pub fn join_stage<B: Bsdf>() -> Stage {
    joins::<B>().when(|scene| bidirectional_evidence(scene).and(|| bsdf_evidence::<B>(scene)))
}

/// The same, whatever has the BSDF.
pub(super) fn joins<B: Bsdf>() -> Stage {
    without_sides(Stage::new(B::NAMES.join, TileSystems::SampleLights, join_vertices::<B>))
        .on_camera_paths()
        .kind(StageKind::Alternative)
        .appends::<ShadowRays>()
        .changes::<JoinRatios>()
}
