use crate::each::Each;
use crate::extract::{LayerTable, MaterialTable, layer_evidence};
use crate::intersect::{Hits, NO_SHAPE, ShadingNormals, SurfaceUvs, Surfaces};
use crate::plan::{
    Census, Column, ColumnComponent, ColumnKind, ComponentValues, Evidence, Lifetime, Shared, Stage, TileSystems,
    column_component,
};
use crate::rays::{PixelSamples, RasterPoints, WorldRays, sampling_evidence};
use crate::scene::LayerKind;
use crate::shade::SurfaceColours;
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// The layers of one tile's film, with a row per pixel; exists only if layers are requested.
///
/// A sample whose camera ray misses adds nothing, so that a pixel at an edge describes the surface alone; the coverage
/// layer says how much of the pixel that is.
/// All samples have the same weight, whatever the reconstruction filter.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilmLayers {
    /// The kinds, each once, in the order in which a file holds them.
    pub kinds: Vec<LayerKind>,
    /// Number of samples taken.
    pub taken: Vec<u32>,
    /// Number of samples whose camera ray hit a surface.
    pub hits: Vec<u32>,
    /// The number of the shape that the first sample hit; [`NO_SHAPE`] if it hit nothing.
    pub entity: Vec<u32>,
    /// Sums over the samples that hit a surface: one component for every channel of every kind that is a mean, in
    /// order; over the block of samples in progress.
    pub sums: Vec<Vec<f64>>,
    /// The same over all earlier blocks; empty before the second.
    pub earlier: Vec<Vec<f64>>,
    /// How many samples of a row hit a shape, by row and number of the shape; empty without the layer `cryptomatte`.
    pub mattes: BTreeMap<(u32, u32), u32>,
}

impl FilmLayers {
    /// Layers without samples.
    pub fn new(rows: usize, kinds: &[LayerKind]) -> Self {
        let components: usize = kinds.iter().filter(|kind| kind.is_mean()).map(|kind| kind.channels().len()).sum();
        Self {
            kinds: kinds.to_vec(),
            taken: vec![0; rows],
            hits: vec![0; rows],
            entity: vec![NO_SHAPE; rows],
            sums: vec![vec![0.0; rows]; components],
            earlier: Vec::new(),
            mattes: BTreeMap::new(),
        }
    }

    /// Whether no sample has been taken.
    pub(crate) fn are_empty(&self) -> bool {
        self.taken.iter().all(|&taken| taken == 0)
    }

    /// Takes all samples away.
    pub(crate) fn empty(&mut self) {
        self.taken.fill(0);
        self.hits.fill(0);
        self.entity.fill(NO_SHAPE);
        self.sums.iter_mut().for_each(|sums| sums.fill(0.0));
        self.earlier.clear();
        self.mattes.clear();
    }

    /// The kinds as bits, for checkpoints.
    pub fn kind_bits(&self) -> u32 {
        self.kinds.iter().fold(0, |bits, &kind| bits | 1 << kind as u32)
    }

    /// All components that are not sums, for checkpoints.
    pub fn counts(&self) -> [&Vec<u32>; 3] {
        [&self.taken, &self.hits, &self.entity]
    }

    /// The same components, to be filled from a checkpoint.
    pub fn counts_mut(&mut self) -> [&mut Vec<u32>; 3] {
        [&mut self.taken, &mut self.hits, &mut self.entity]
    }

    /// The range of the components of a kind within the sums.
    fn components_of(&self, wanted: LayerKind) -> std::ops::Range<usize> {
        let before = self.kinds.iter().filter(|kind| kind.is_mean() && **kind < wanted);
        let first: usize = before.map(|kind| kind.channels().len()).sum();
        first..first + wanted.channels().len()
    }

    /// A channel of a kind that is a mean, or of coverage; 0 if no sample hit a surface.
    pub fn mean(&self, kind: LayerKind, channel: usize, row: usize) -> f64 {
        match kind {
            LayerKind::Coverage => f64::from(self.hits[row]) / f64::from(self.taken[row].max(1)),
            _ => self.sum(self.components_of(kind).start + channel, row) / f64::from(self.hits[row].max(1)),
        }
    }

    /// Those of some sums that belong to a kind that is a mean, channel by channel.
    pub(super) fn sums_of<'s>(&self, kind: LayerKind, sums: &'s [Vec<f64>]) -> &'s [Vec<f64>] {
        &sums[self.components_of(kind)]
    }

    /// Its memory in bytes.
    pub fn bytes(&self) -> usize {
        let sums = (self.sums.len() + self.earlier.len()) * size_of::<f64>();
        let mattes = self.mattes.len() * MATTE_BYTES;
        self.taken.len() * (3 * size_of::<u32>() + sums) + mattes + size_of::<Self>()
    }
}

/// The memory of one of the counts of [`FilmLayers::mattes`] in a tree whose nodes are two thirds full, as they are on
/// average, in bytes.
pub const MATTE_BYTES: usize = 3 * size_of::<u32>() * 3 / 2;

column_component!(FilmLayers);

impl Column for FilmLayers {
    const NAME: &'static str = "layers";
    const SPACE: &'static str = "film";
    const UNIT: &'static str = "sums of each layer's own";
    const LIFETIME: Lifetime = Lifetime::Film;

    fn rows(&self) -> usize {
        self.taken.len()
    }

    fn components(&self) -> Vec<ColumnComponent<'_>> {
        let names = self.kinds.iter().filter(|kind| kind.is_mean()).flat_map(|kind| kind.channels());
        let counts = [("taken", &self.taken), ("hits", &self.hits), ("entity", &self.entity)];
        let counts = counts.each(|(name, component)| ColumnComponent { name, values: ComponentValues::U32(component) });
        let sums = names
            .zip(&self.sums)
            .map(|(&name, component)| ColumnComponent { name, values: ComponentValues::F64(component) });
        counts.into_iter().chain(sums).collect()
    }

    fn paint(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.hits[row] as f32 / self.taken[row].max(1) as f32; 3]
    }
}

/// The columns of a tile from which layers are computed, as far as they exist.
#[derive(Clone, Copy)]
struct LayerInputs<'t> {
    table: &'t LayerTable,
    materials: Option<&'t MaterialTable>,
    rays: Option<&'t WorldRays>,
    hits: &'t Hits,
    surfaces: Option<&'t Surfaces>,
    shading_normals: Option<&'t ShadingNormals>,
    uvs: Option<&'t SurfaceUvs>,
    colours: Option<&'t SurfaceColours>,
}

impl LayerInputs<'_> {
    /// Adds the channels of a kind, at the rows that hit a surface, to the sums of their pixels.
    ///
    /// The kind is asked for once, and not in every row; a column that does not exist adds nothing.
    fn add(&self, kind: LayerKind, sums: &mut [Vec<f64>], pixels: Option<&PixelSamples>) {
        match (kind, self.surfaces) {
            (LayerKind::Position, Some(own)) => {
                let eye = self.table.eye;
                self.add_rows(sums, pixels, |row| eye + own.get(row).position.as_dvec3());
            }
            (LayerKind::Normal, _) => self.add_rows(sums, pixels, |row| self.normal(row)),
            (LayerKind::NormalCamera, _) => self.add_rows(sums, pixels, |row| self.in_camera_space(self.normal(row))),
            (LayerKind::ShadingNormal, _) => self.add_rows(sums, pixels, |row| self.shading_normal(row)),
            (LayerKind::ShadingNormalCamera, _) => {
                self.add_rows(sums, pixels, |row| self.in_camera_space(self.shading_normal(row)));
            }
            (LayerKind::Uv, _) => {
                if let Some(uvs) = self.uvs {
                    self.add_rows(sums, pixels, |row| DVec2::from(uvs.uv(row)).extend(0.0));
                }
            }
            (LayerKind::Albedo, _) => match (self.colours, self.materials, self.surfaces) {
                (Some(colours), _, _) => self.add_rows(sums, pixels, |row| colours.rgb(row).into()),
                // A surface that only emits has no material, and reflects no light.
                (None, Some(materials), Some(surfaces)) => self.add_rows(sums, pixels, |row| {
                    let own = materials.parameters.get(surfaces.material[row] as usize);
                    own.map_or(DVec3::ZERO, |own| DVec3::from(own.colour))
                }),
                _ => {}
            },
            (LayerKind::DepthAlongRay, _) => self.add_rows(sums, pixels, |row| {
                let length = self.rays.map_or(1.0, |own| own.direction_of(row).length());
                DVec3::new(self.hits.t[row] * length, 0.0, 0.0)
            }),
            (LayerKind::DepthAlongAxis, _) => self.add_rows(sums, pixels, |row| {
                let backward = self.table.world_from_camera.z_axis;
                let depth = self.rays.map_or(0.0, |rays| -backward.dot(rays.point_at(row, self.hits.t[row])));
                DVec3::new(depth, 0.0, 0.0)
            }),
            (LayerKind::Position, None)
            | (
                LayerKind::Coverage
                | LayerKind::Entity
                | LayerKind::Samples
                | LayerKind::Variance
                | LayerKind::Cryptomatte,
                _,
            ) => {}
        }
    }

    /// Adds a value for each row that hit a surface.
    #[inline(always)]
    fn add_rows(&self, sums: &mut [Vec<f64>], pixels: Option<&PixelSamples>, value: impl Fn(usize) -> DVec3) {
        let hit = (0..self.hits.rows()).filter(|&row| self.hits.shape[row] != NO_SHAPE);
        let rows = hit.map(|row| (pixels.map_or(row, |pixels| pixels.pixel[row] as usize), value(row)));
        match sums {
            [x, y, z] => rows.for_each(|(pixel, value)| {
                x[pixel] += value.x;
                y[pixel] += value.y;
                z[pixel] += value.z;
            }),
            sums => rows.for_each(|(pixel, value)| {
                sums.iter_mut().enumerate().for_each(|(channel, sums)| sums[pixel] += value[channel]);
            }),
        }
    }

    #[inline(always)]
    fn normal(&self, row: usize) -> DVec3 {
        self.surfaces.map_or(DVec3::ZERO, |surfaces| surfaces.get(row).normal.as_dvec3())
    }

    #[inline(always)]
    fn shading_normal(&self, row: usize) -> DVec3 {
        self.shading_normals.map_or_else(|| self.normal(row), |normals| normals.get(row))
    }

    #[inline(always)]
    fn in_camera_space(&self, normal: DVec3) -> DVec3 {
        self.table.world_from_camera.transpose() * normal
    }
}

/// What layers are made of, and the film of layers.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct LayersView {
    raster: &'static RasterPoints,
    samples: Option<&'static PixelSamples>,
    rays: Option<&'static WorldRays>,
    hits: Option<&'static Hits>,
    surfaces: Option<&'static Surfaces>,
    shading_normals: Option<&'static ShadingNormals>,
    uvs: Option<&'static SurfaceUvs>,
    colours: Option<&'static SurfaceColours>,
    layers: &'static mut FilmLayers,
}

/// Adds each row's values to its pixel's layers.
pub fn add_to_layers(
    table: Res<Shared<LayerTable>>,
    materials: Option<Res<Shared<MaterialTable>>>,
    mut tiles: Query<LayersView>,
) {
    for LayersViewItem { raster, samples, rays, hits, surfaces, shading_normals, uvs, colours, mut layers } in
        &mut tiles
    {
        let layers = &mut *layers;
        let pixel_of = |row: usize| samples.map_or(row, |samples| samples.pixel[row] as usize);
        (0..raster.rows()).for_each(|row| layers.taken[pixel_of(row)] += 1);
        let Some(hits) = hits else { continue };
        for (row, &shape) in hits.shape.iter().enumerate() {
            let pixel = pixel_of(row);
            layers.hits[pixel] += u32::from(shape != NO_SHAPE);
            if layers.taken[pixel] == 1 {
                layers.entity[pixel] = shape;
            }
        }
        if layers.kinds.contains(&LayerKind::Cryptomatte) {
            for (row, &shape) in hits.shape.iter().enumerate().filter(|&(_, &shape)| shape != NO_SHAPE) {
                *layers.mattes.entry((pixel_of(row) as u32, shape)).or_default() += 1;
            }
        }
        let materials = materials.as_deref().map(|materials| &**materials);
        let inputs = LayerInputs { table: &table, materials, rays, hits, surfaces, shading_normals, uvs, colours };
        let mut sums = layers.sums.as_mut_slice();
        for kind in layers.kinds.iter().copied().filter(|kind| kind.is_mean()) {
            let of_kind;
            (of_kind, sums) = std::mem::take(&mut sums).split_at_mut(kind.channels().len());
            inputs.add(kind, of_kind, samples);
        }
    }
}

/// The stage that runs this system.
pub fn layers_stage() -> Stage {
    Stage::new("Accumulate layers", TileSystems::Layers, add_to_layers)
        .reads_where::<PixelSamples>(sampling_evidence)
        .reads_where::<Hits>(|scene| layer_evidence(scene, "hit layer", needs_hits))
        .reads_where::<WorldRays>(|scene| layer_evidence(scene, "depth layer", needs_rays))
        .reads_where::<Surfaces>(|scene| layer_evidence(scene, "surface layer", needs_surfaces))
        .reads_where::<ShadingNormals>(|scene| layer_evidence(scene, "shading layer", needs_shading_normals))
        .reads_where::<SurfaceUvs>(|scene| layer_evidence(scene, "uv layer", |kind| kind == LayerKind::Uv))
        .reads_where::<SurfaceColours>(albedo_evidence)
        .table_where::<MaterialTable>(albedo_evidence)
        .when(|scene| layer_evidence(scene, "layer request", |_| true))
}

fn albedo_evidence(scene: &Census<'_>) -> Evidence {
    layer_evidence(scene, "albedo layer", |kind| kind == LayerKind::Albedo)
}

fn needs_hits(kind: LayerKind) -> bool {
    !matches!(kind, LayerKind::Samples | LayerKind::Variance)
}

fn needs_shading_normals(kind: LayerKind) -> bool {
    matches!(kind, LayerKind::ShadingNormal | LayerKind::ShadingNormalCamera)
}

fn needs_rays(kind: LayerKind) -> bool {
    matches!(kind, LayerKind::DepthAlongRay | LayerKind::DepthAlongAxis)
}

fn needs_surfaces(kind: LayerKind) -> bool {
    let normal = matches!(
        kind,
        LayerKind::Normal | LayerKind::NormalCamera | LayerKind::ShadingNormal | LayerKind::ShadingNormalCamera
    );
    normal || matches!(kind, LayerKind::Position | LayerKind::Albedo)
}

/// The column without which a layer would be 0 everywhere.
pub fn column_of_layer(kind: LayerKind) -> Option<ColumnKind> {
    match kind {
        LayerKind::Samples | LayerKind::Variance => None,
        LayerKind::Uv => Some(ColumnKind::of::<SurfaceUvs>()),
        _ if needs_surfaces(kind) => Some(ColumnKind::of::<Surfaces>()),
        _ => Some(ColumnKind::of::<Hits>()),
    }
}
