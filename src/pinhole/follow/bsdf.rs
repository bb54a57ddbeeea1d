//! The stages of BSDFs, each generic over the BSDF.

use super::bidirectional::join_stage;
use super::interface::{Interface, InterfaceView};
use super::media::{deeper_media_evidence, media_evidence};
use super::photons::gather_photons_stage;
use super::recursive_mis::{join_weight_stage, leave_with_ratios_stage};
use super::scatter_block::{AT_ONCE, SampledBlock, SampledColumns, ScatteredBlock};
use super::specular::{specular_from_lights_stage, specular_stage, split_stage};
use super::{DeeperMedia, Media, Scattered, power_heuristic};
use crate::each::{Each, by_lane, gathered, lanes, lanes_of, list_those, put_lanes, rows_of, vectors_of};
use crate::extract::{
    GlassTable, MaterialTable, SamplingTable, ShapeTable, area_light_evidence, bidirectional_evidence, bsdf_evidence,
    environment_light_evidence, glass_contact_evidence, joined_evidence, mis_evidence, needed_if, traced_evidence,
};
use crate::intersect::{
    Contacts, Hits, MaterialRows, NO_SHAPE, ShadingNormals, SurfaceSides, Surfaces, list_rows, rows_of_kind,
};
use crate::material::{
    Bsdf, BsdfClass, MaterialKind, MatteTable, Parameters, ShadingContext, Transport, for_each_bsdf,
};
use crate::plan::{
    Census, Column, ColumnArrays, Evidence, Shared, Stage, StageKind, TileSystems, VectorRows, VectorRowsMut,
};
use crate::rays::{DrawsView, Paths, WorldRays, draws_of_one, draws_of_two};
use crate::sample::Purpose;
use crate::shade::{LightPdfs, ParameterColumns, ReflectionView, ReflectionViewItem, ShadowRays, light_evidence};
use bevy_ecs::prelude::*;
use bevy_ecs::query::QueryData;
use glam::{DVec3, Vec3};
use multiversion::multiversion;

/// What a path carries, by the pass that a stage runs in.
pub(super) const fn transport(from_light: bool) -> Transport {
    if from_light { Transport::Importance } else { Transport::Radiance }
}

/// What a BSDF is evaluated for at a surface of a tile with these parameters.
#[inline(always)]
pub(super) fn shading_context<B: Bsdf>(
    materials: &MaterialTable,
    interface: &Interface<'_>,
    (parameters, row, material): (Parameters, usize, usize),
    transport: Transport,
) -> ShadingContext {
    let eta = if B::TRANSMITS { interface.eta(materials.interior[material], row) } else { 1.0 };
    ShadingContext { row: materials.row[material] as usize, parameters, eta, reflectance: None, transport }
}

// ANCHOR: sample_bsdf
/// Samples the BSDF at every surface that has it, and appends the rays that go on.
pub fn sample_bsdf<B: Bsdf, const FROM_LIGHT: bool>(
    sampling: Res<Shared<SamplingTable>>,
    (materials, bsdf, glass): (Res<Shared<MaterialTable>>, Res<Shared<B>>, Option<Res<Shared<GlassTable>>>),
    (mut list, mut points, mut choices): (Local<Vec<u32>>, Local<Vec<[f64; 2]>>, Local<Vec<f64>>),
    mut tiles: Query<(BsdfView, DrawsView, ParameterColumns, InterfaceView, &MaterialRows)>,
) {
    let (mut block, mut made) = (SampledBlock::NONE, ScatteredBlock::NONE);
    for (BsdfViewItem { rays, paths, surfaces, shading, mut scattered }, draws, columns, interface, rows) in &mut tiles
    {
        let interface = Interface::new(interface, glass.as_deref());
        let (kinds, of_row) = (&materials.kind[..], &surfaces.material[..]);
        let has_bsdf = move |&row: &u32| (row, kinds[of_row[row as usize] as usize] == B::KIND);
        list_those(rows.row.iter().map(has_bsdf), &mut list);
        let draws = draws.draws(&sampling, Some(paths));
        draws_of_two(&draws, Purpose::Direction, &list, &mut points);
        choices.clear();
        if bsdf.chooses() {
            draws_of_one(&draws, Purpose::MaterialChoice, &list, &mut choices);
        }
        let seen = SampledColumns { rays, paths, surfaces, shading };
        let mut room = scattered.room(list.len());
        let mut choices = choices.chunks(AT_ONCE);
        for (rows, points) in list.chunks(AT_ONCE).zip(points.chunks(AT_ONCE)) {
            block.gather(&seen, rows);
            block.set_numbers(points, choices.next().unwrap_or_default());
            for (lane, row) in by_lane::<AT_ONCE, _>(rows) {
                let (row, material) = (row as usize, surfaces.material[row as usize] as usize);
                let of_row = (columns.get(&materials, row, material), row, material);
                block.set_context::<B>(
                    lane,
                    &shading_context::<B>(&materials, &interface, of_row, Transport::default()),
                );
            }
            made.sample(&**bsdf, &block, rows.len(), transport(FROM_LIGHT));
            made.append(rows, &mut room);
        }
        let length = room.length;
        scattered.slices_mut(length);
    }
}
// ANCHOR_END: sample_bsdf

/// What a stage reads to compute the MIS weights of light samples, and the shadow rays that it weights.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct LightWeightView {
    /// The rays from the eye.
    pub eye: &'static WorldRays,
    /// The surfaces that they hit.
    pub surfaces: &'static Surfaces,
    /// Their shading normals, where they have any.
    pub shading: Option<&'static ShadingNormals>,
    /// The pdfs with which the shadow rays were sampled.
    pub pdfs: &'static LightPdfs,
    /// The shadow rays.
    pub rays: &'static mut ShadowRays,
}

/// The surfaces that rays from an eye see, and the rays.
///
/// All components are of one length: one check of a row's number serves them all, so that what a BSDF does not ask for is
/// not read.
struct Seen<'a> {
    ray: [&'a [f32]; 3],
    normal: [&'a [f32]; 3],
    shading: Option<&'a ShadingNormals>,
    material: &'a [u32],
}

impl<'a> Seen<'a> {
    fn new(rays: &'a WorldRays, surfaces: &'a Surfaces, shading: Option<&'a ShadingNormals>) -> Self {
        let (_, normal, _, material) = surfaces.slices();
        Self { ray: rays.direction.slices(material.len()), normal, shading, material }
    }

    /// The components of the shading normals, or of the geometric ones where there are no others.
    #[inline(always)]
    fn normals(&self) -> [&'a [f32]; 3] {
        self.shading.map_or(self.normal, |normals| normals.normal.slices(self.material.len()))
    }

    /// A direction of world space and that to the eye, in the frame of a row's surface.
    #[inline(always)]
    fn local<B: Bsdf>(&self, row: usize, to_light: DVec3) -> [DVec3; 2] {
        let of = |vectors: &[&[f32]; 3]| Vec3::from(vectors.at(row)).as_dvec3();
        let normal = self.shading.map_or_else(|| of(&self.normal), |normals| normals.get(row));
        let local_from_world = B::frame(normal).transpose();
        [to_light, -of(&self.ray)].each(|direction| local_from_world * direction)
    }
}

// ANCHOR: mis_bsdf
/// Weights every light sample at a surface with this BSDF against BSDF sampling.
pub fn mis_bsdf<B: Bsdf>(
    (materials, bsdf, glass): (Res<Shared<MaterialTable>>, Res<Shared<B>>, Option<Res<Shared<GlassTable>>>),
    mut tiles: Query<(LightWeightView, ParameterColumns, InterfaceView)>,
) {
    for (LightWeightViewItem { eye, surfaces, shading, pdfs, mut rays }, columns, interface) in &mut tiles {
        let interface = Interface::new(interface, glass.as_deref());
        let seen = Seen::new(eye, surfaces, shading);
        // Of many at once, where nothing about the material is asked: the same bits.
        if B::PDF_OF_DIRECTIONS {
            weight_in_blocks(&**bsdf, &materials, &seen, &pdfs.pdf, &mut rays);
            continue;
        }
        for ray in 0..rays.rows() {
            let (row, by_light) = (rays.row[ray] as usize, pdfs.pdf[ray]);
            let material = seen.material[row] as usize;
            if by_light == 0.0 || materials.kind[material] != B::KIND {
                continue;
            }
            let [to_light, to_eye] = seen.local::<B>(row, rays.direction_of(ray));
            let of_row = (columns.get(&materials, row, material), row, material);
            let context = shading_context::<B>(&materials, &interface, of_row, Transport::Radiance);
            let by_bsdf = bsdf.pdf(&context, to_light, to_eye);
            rays.weight_by(ray, [power_heuristic(by_light, by_bsdf); 3]);
        }
    }
}
// ANCHOR_END: mis_bsdf

/// The same for many rays at once, for a BSDF whose pdf no parameter changes: what is not weighted is multiplied by 1.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn weight_in_blocks<B: Bsdf>(
    bsdf: &B,
    materials: &MaterialTable,
    seen: &Seen<'_>,
    by_light: &[f64],
    rays: &mut ShadowRays,
) {
    let context = ShadingContext::opaque(0, Parameters::coloured([0.0; 3]));
    let (rows, _, direction, _, mut irradiance) = rays.slices_mut(by_light.len());
    let direction = direction.each(|axis| &*axis);
    for start in (0..by_light.len()).step_by(AT_ONCE) {
        let end = by_light.len().min(start + AT_ONCE);
        let row: [u32; AT_ONCE] = lanes_of(&rows[start..end], 0_u32);
        let pdf: [f64; AT_ONCE] = lanes_of(&by_light[start..end], 0.0);
        let to_light: [[f32; AT_ONCE]; 3] = vectors_of(rows_of(direction, start..end), 0.0);
        let (ray, normal) =
            (seen.ray.each(|axis| gathered(axis, &row)), seen.normals().each(|axis| gathered(axis, &row)));
        let mut counts = [0_u32; AT_ONCE];
        for (lane, row) in by_lane::<AT_ONCE, _>(&rows[start..end]) {
            counts[lane] = u32::from(materials.kind[seen.material[row as usize] as usize] == B::KIND);
        }
        let mut weight = [1.0; AT_ONCE];
        for lane in 0..AT_ONCE {
            let [normal, to_light, ray] =
                [&normal, &to_light, &ray].each(|vectors| Vec3::from(vectors.at(lane)).as_dvec3());
            let local_from_world = B::frame(normal).transpose();
            let by_bsdf = bsdf.pdf(&context, local_from_world * to_light, local_from_world * -ray);
            let is_weighted = (counts[lane] != 0) & (pdf[lane] != 0.0);
            weight[lane] = if is_weighted { power_heuristic(pdf[lane], by_bsdf) } else { 1.0 };
        }
        for part in &mut irradiance {
            let carried: [f32; AT_ONCE] = lanes_of(&part[start..end], 0.0);
            let weighted: [f32; AT_ONCE] = lanes(|lane| (f64::from(carried[lane]) * weight[lane]) as f32);
            put_lanes(&mut part[start..end], &weighted);
        }
    }
}

// ANCHOR: add_direct_light
/// Adds the light of each unblocked shadow ray that a surface with this BSDF reflects or transmits to the eye.
pub fn add_direct_light<B: Bsdf, const FROM_LIGHT: bool>(
    (materials, bsdf, glass): (Res<Shared<MaterialTable>>, Res<Shared<B>>, Option<Res<Shared<GlassTable>>>),
    mut tiles: Query<(ReflectionView, ParameterColumns, InterfaceView)>,
) {
    for (view, columns, interface) in &mut tiles {
        let ReflectionViewItem { eye, surfaces, shading, light, shadow: hits, mut radiance } = view;
        let interface = Interface::new(interface, glass.as_deref());
        let seen = Seen::new(eye, surfaces, shading);
        let (rows, _, direction, _, irradiance) = light.slices();
        let blocked = hits.map(|hits| &hits.shape[..rows.len()]);
        let mut sum = radiance.slices_mut(seen.material.len());
        for ray in 0..rows.len() {
            let row = rows[ray] as usize;
            let material = seen.material[row] as usize;
            if materials.kind[material] != B::KIND || blocked.is_some_and(|shape| shape[ray] != NO_SHAPE) {
                continue;
            }
            // A BSDF is a function of two directions in the frame of the surface.
            let [to_light, to_eye] = seen.local::<B>(row, Vec3::from(direction.at(ray)).as_dvec3());
            let of_row = (columns.get(&materials, row, material), row, material);
            let context = shading_context::<B>(&materials, &interface, of_row, transport(FROM_LIGHT));
            // The cosine is in the irradiance.
            let (bsdf, irradiance) = (bsdf.eval(&context, to_light, to_eye), irradiance.at(ray).each(f64::from));
            sum.add(row, [0, 1, 2].each(|part| (bsdf[part] * irradiance[part]).min(f64::from(f32::MAX)) as f32));
        }
    }
}
// ANCHOR_END: add_direct_light

/// The stage that samples a BSDF: for paths from both sides where radiance and importance are scattered alike.
pub fn sample_stage<B: Bsdf>() -> Stage {
    let stage = Stage::new(B::NAMES.sample, TileSystems::SampleBsdfs, sample_bsdf::<B, false>);
    let stage = scatters::<B>(stage).when(|scene| bsdf_evidence::<B>(scene).and(|| continued_evidence::<B>(scene)));
    if B::TRANSMITS { stage.on_camera_paths() } else { stage }
}

/// The stage that samples a BSDF for paths from lights.
pub fn sample_from_lights_stage<B: Bsdf>() -> Stage {
    let stage = Stage::new(B::NAMES.sample_from_lights, TileSystems::SampleBsdfs, sample_bsdf::<B, true>);
    scatters::<B>(stage).on_light_paths().when(|scene| traced_evidence(scene).and(|| bsdf_evidence::<B>(scene)))
}

fn scatters<B: Bsdf>(stage: Stage) -> Stage {
    continues(at_interfaces::<B>(stage))
}

/// A stage that appends the rays which go on.
pub(super) fn continues(stage: Stage) -> Stage {
    stage.kind(StageKind::Estimator).appends::<Scattered>()
}

/// The stage that weights light samples at surfaces with a BSDF.
pub fn mis_stage<B: Bsdf>() -> Stage {
    at_interfaces::<B>(Stage::new(B::NAMES.mis, TileSystems::MisWeights, mis_bsdf::<B>))
        .kind(StageKind::Alternative)
        .when(|scene| {
            let lights = area_light_evidence(scene).or(environment_light_evidence(scene));
            let weighted = lights.and(|| mis_evidence(scene)).and(|| bsdf_evidence::<B>(scene));
            let joined = bidirectional_evidence(scene);
            if joined.needed { Evidence { needed: false, ..joined } } else { weighted }
        })
}

/// The stage that evaluates a BSDF for direct light, and for connections to the camera where radiance and importance
/// are scattered alike.
pub fn direct_light_stage<B: Bsdf>() -> Stage {
    let stage = Stage::new(B::NAMES.direct_light, TileSystems::Shade, add_direct_light::<B, false>);
    let stage = at_interfaces::<B>(stage).when(|scene| bsdf_evidence::<B>(scene).and(|| light_evidence(scene)));
    if B::TRANSMITS { stage.on_camera_paths() } else { stage }
}

/// The stage that evaluates the matte BSDF for direct light.
///
/// A generic function is compiled in the crate that names its types, and as much optimised as that crate: this one is
/// compiled here.
pub fn matte_direct_light_stage() -> Stage {
    direct_light_stage::<MatteTable>()
}

/// The stage that evaluates a BSDF for connections to the camera.
pub fn connections_stage<B: Bsdf>() -> Stage {
    let stage = Stage::new(B::NAMES.connections, TileSystems::Shade, add_direct_light::<B, true>);
    at_interfaces::<B>(stage).on_light_paths().when(|scene| joined_evidence(scene).and(|| bsdf_evidence::<B>(scene)))
}

/// Requests what is known of the media at surfaces that transmit light, where the scene gives a reason.
pub(super) fn at_interfaces_where(stage: Stage, reason: fn(&Census<'_>) -> Evidence) -> Stage {
    stage
        .reads_where::<SurfaceSides>(reason)
        .reads_where::<Media>(media_evidence)
        .reads_where::<DeeperMedia>(deeper_media_evidence)
        .reads_where::<Contacts>(glass_contact_evidence)
}

/// Requests what is known of the media at surfaces of a BSDF that transmits light, and of nothing of the kind elsewhere.
pub(super) fn at_interfaces<B: Bsdf>(stage: Stage) -> Stage {
    if B::TRANSMITS { at_interfaces_where(stage, bsdf_evidence::<B>) } else { without_sides(stage) }
}

/// Requests nothing of the kind.
pub(super) fn without_sides(stage: Stage) -> Stage {
    let never = |_: &Census<'_>| Evidence::default();
    stage
        .table_where::<GlassTable>(never)
        .reads_where::<SurfaceSides>(never)
        .reads_where::<Media>(never)
        .reads_where::<DeeperMedia>(never)
}

/// Evidence that paths are continued from surfaces with a BSDF.
fn continued_evidence<B: Bsdf>(scene: &Census<'_>) -> Evidence {
    needed_if(scene, |integrator| {
        let does = integrator.transport();
        if B::CLASS == BsdfClass::Glossy { does.samples_glossy } else { does.samples_diffuse }
    })
}

rows_of_kind! {
    /// The rows that hit a surface with a specular BSDF, ascending.
    pub struct BsdfRows<B: Bsdf>
}

/// Lists the rows that hit a surface with this BSDF.
pub fn classify_bsdf<B: Bsdf>(
    shapes: Res<Shared<ShapeTable>>,
    materials: Res<Shared<MaterialTable>>,
    mut tiles: Query<(&Hits, &mut BsdfRows<B>)>,
) {
    // A shape without a material has a row that no table has.
    let kinds = &materials.kind[..];
    for (hits, mut list) in &mut tiles {
        let has_bsdf = move |&material: &u32| kinds.get(material as usize) == Some(&B::KIND);
        list_rows(hits, &shapes.material, &mut list.row, has_bsdf);
    }
}

/// The stage that runs [`classify_bsdf`].
pub fn classify_bsdf_stage<B: Bsdf>() -> Stage {
    Stage::new(B::NAMES.classify, TileSystems::Classify, classify_bsdf::<B>).when(bsdf_evidence::<B>)
}

/// What the stages of a BSDF are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BsdfRole {
    /// Listing the rows that hit it.
    Classify,
    /// Weighting light samples against sampling it.
    MisWeights,
    /// Evaluating it for direct light.
    Evaluate,
    /// The same where light paths are connected to the camera.
    Connections,
    /// Gathering photons.
    Gather,
    /// Joining surfaces to light vertices with it.
    Join,
    /// Weighting what is joined to surfaces with it.
    JoinWeights,
    /// Carrying MIS ratios on from surfaces with it.
    Ratios,
    /// Following all of its specular directions.
    Split,
    /// Sampling it for further rays.
    Sample,
    /// The same for paths from lights.
    SampleFromLights,
}

/// A stage of a BSDF.
#[derive(Clone, Copy)]
pub struct BsdfStage {
    /// What it is for.
    pub role: BsdfRole,
    /// The BSDF's kind.
    pub kind: MaterialKind,
    /// How the BSDF scatters.
    pub class: BsdfClass,
    /// Whether it transmits light.
    pub transmits: bool,
    /// The stage.
    pub stage: fn() -> Stage,
}

/// The stages of a BSDF.
pub fn stages_of<B: Bsdf>() -> Vec<BsdfStage> {
    use BsdfRole::*;
    let of = |role, stage| BsdfStage { role, kind: B::KIND, class: B::CLASS, transmits: B::TRANSMITS, stage };
    let mut stages: Vec<BsdfStage> = Vec::new();
    if B::CLASS == BsdfClass::Specular {
        stages.push(of(Classify, classify_bsdf_stage::<B>));
        stages.push(of(Sample, specular_stage::<B>));
        if B::TRANSMITS {
            stages.push(of(Split, split_stage::<B>));
            stages.push(of(SampleFromLights, specular_from_lights_stage::<B>));
        }
        return stages;
    }
    stages.push(of(MisWeights, mis_stage::<B>));
    stages.push(of(Sample, sample_stage::<B>));
    stages.push(of(Evaluate, direct_light_stage::<B>));
    stages.push(of(Gather, gather_photons_stage::<B>));
    stages.push(of(Join, join_stage::<B>));
    stages.push(of(JoinWeights, join_weight_stage::<B>));
    stages.push(of(Ratios, leave_with_ratios_stage::<B>));
    if B::TRANSMITS {
        stages.push(of(Connections, connections_stage::<B>));
        stages.push(of(SampleFromLights, sample_from_lights_stage::<B>));
    }
    stages
}

macro_rules! all_stages {
    ($($kind:ident($table:ident, $name:literal),)+) => {
        /// The stages of all BSDFs, one BSDF after another.
        pub fn bsdf_stages() -> Vec<BsdfStage> {
            [$(stages_of::<crate::material::$table>()),+].concat()
        }
    };
}

for_each_bsdf!(all_stages);

/// What a stage reads to sample a BSDF, and the scattered rays that it appends.
#[derive(QueryData)]
#[query_data(mutable)]
pub struct BsdfView {
    /// The rays that arrive.
    pub rays: &'static WorldRays,
    /// The paths that they belong to.
    pub paths: &'static Paths,
    /// The surfaces that they hit.
    pub surfaces: &'static Surfaces,
    /// Their shading normals, where they have any.
    pub shading: Option<&'static ShadingNormals>,
    /// The rays that go on.
    pub scattered: &'static mut Scattered,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;

    /// Lengths about those of a block; some surfaces of another material, some lights that have no area.
    #[test]
    fn many_light_samples_are_weighted_as_each() {
        let (mut tried, mut weighted) = (0, 0);
        for length in [1, AT_ONCE - 1, AT_ONCE, AT_ONCE + 1, 5 * AT_ONCE + 7] {
            let mut draws = Draws::new(9_127, length as u64);
            let (mut eye, mut surfaces) = (WorldRays::default(), Surfaces::default());
            let (mut rays, mut by_light) = (ShadowRays::default(), vec![0.0; length]);
            let (_, mut to_surface) = eye.slices_mut(length);
            let (_, mut normal, _, material) = surfaces.slices_mut(length);
            let (row, _, mut to_light, _, mut irradiance) = rays.slices_mut(length);
            for ray in 0..length {
                to_surface.put(ray, draws.unit_vector().as_vec3());
                normal.put(ray, draws.unit_vector().as_vec3());
                material[ray] = u32::from(draws.unit() < 0.2);
                row[ray] = (draws.unit() * length as f64) as u32;
                to_light.put(ray, draws.unit_vector().as_vec3());
                irradiance.put(ray, [draws.unit() as f32, draws.power_of_ten(-40.0, 38.0) as f32, 0.0]);
                by_light[ray] = if draws.unit() < 0.1 { 0.0 } else { draws.power_of_ten(-3.0, 3.0) };
            }
            let materials = MaterialTable::opaque(vec![MaterialKind::Matte, MaterialKind::Phong], vec![[0.5; 3]; 2]);
            let (seen, before) = (Seen::new(&eye, &surfaces, None), rays.clone());
            weight_in_blocks(&MatteTable, &materials, &seen, &by_light, &mut rays);
            for ray in 0..length {
                let row = before.row[ray] as usize;
                let [to_light, to_eye] = seen.local::<MatteTable>(row, before.direction_of(ray));
                let by_bsdf = MatteTable.pdf(&ShadingContext::opaque(0, Parameters::default()), to_light, to_eye);
                let counts = seen.material[row] == 0 && by_light[ray] != 0.0;
                let weight = if counts { power_heuristic(by_light[ray], by_bsdf) } else { 1.0 };
                let expected = before.irradiance(ray).each(|part| (f64::from(part) * weight) as f32);
                assert_eq!(rays.irradiance(ray).each(f32::to_bits), expected.each(f32::to_bits), "{length}, {ray}");
                tried += 1;
                weighted += usize::from(weight < 1.0);
            }
        }
        eprintln!("{tried} light samples, {weighted} of them weighted");
        // Half of the directions are above the surface, 0.8 of the surfaces matte, 0.9 of the lights with an area.
        assert!(4 * weighted > tried);
    }
}
