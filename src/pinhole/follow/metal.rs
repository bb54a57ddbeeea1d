use super::view::{BsdfView, BsdfViewItem};
use super::{
    MetalRows, MultipleScatteringTable, Scattered, ScatteredRay, cosine_direction, frame_of, ggx_brdf, ggx_sample,
    visible_pdf,
};
use crate::extract::{
    MaterialKind, MaterialTable, MetalTable, SamplingTable, metal_evidence, multiple_scattering_evidence, needed_if,
};
use crate::intersect::NO_SHAPE;
use crate::plan::{Census, Column, Evidence, Shared, Stage, StageKind, TileSystems};
use crate::rays::{DrawsView, draws_of_one, draws_of_two};
use crate::sample::Purpose;
use crate::shade::{ReflectionView, ReflectionViewItem, lit_evidence};
use bevy_ecs::prelude::*;
use glam::DVec3;

/// The BSDF of rough metals in a surface's frame: single scattering, and multiple scattering where a scene asks for it.
#[derive(Clone, Copy)]
pub struct RoughMetals<'a> {
    /// Colours and roughness.
    pub metals: &'a MetalTable,
    /// The multiple-scattering lobe; none where that energy is lost.
    pub several: Option<&'a MultipleScatteringTable>,
}

impl RoughMetals<'_> {
    /// The BRDF of a metal in 1/sr: red, green, blue.
    #[inline(always)]
    pub fn brdf(&self, metal: usize, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        let once = ggx_brdf(to_light, to_eye, self.metals.alpha[metal]);
        let once = self.metals.colour[metal].map(|colour| once * colour);
        let Some(several) = self.several else { return once };
        let again = several.brdf(metal, to_light, to_eye);
        [0, 1, 2].map(|part| once[part] + again[part])
    }

    /// The pdf with which [`Self::sample`] chooses `to_light`, in 1/sr.
    #[inline(always)]
    pub fn pdf(&self, metal: usize, to_light: DVec3, to_eye: DVec3) -> f64 {
        let visible = visible_pdf(to_light, to_eye, self.metals.alpha[metal]);
        self.several.map_or(visible, |several| several.pdf(metal, to_light, to_eye, visible))
    }

    /// Samples a direction to the light: the direction, its pdf, and BRDF · cosine / pdf; none where it leads below the
    /// surface.
    ///
    /// `choice`, a number in [0, 1), selects the single- or the multiple-scattering lobe.
    #[inline(always)]
    pub(super) fn sample(
        &self,
        metal: usize,
        to_eye: DVec3,
        numbers: [f64; 2],
        choice: f64,
    ) -> Option<(DVec3, f64, [f64; 3])> {
        let microfacet_sample = || ggx_sample(to_eye, self.metals.alpha[metal], numbers);
        let Some(several) = self.several else {
            let (microfacet_sample, colour) = (microfacet_sample()?, self.metals.colour[metal]);
            return Some((
                microfacet_sample.to_light,
                microfacet_sample.pdf,
                colour.map(|colour| colour * microfacet_sample.weight),
            ));
        };
        let is_lost = several.is_lost(metal, to_eye, choice);
        let to_light = if is_lost { cosine_direction(numbers) } else { microfacet_sample()?.to_light };
        let pdf = self.pdf(metal, to_light, to_eye);
        let weights = self.brdf(metal, to_light, to_eye).map(|brdf| brdf * to_light.z / pdf);
        (pdf > 0.0).then_some((to_light, pdf, weights))
    }
}

/// Samples the BSDF of rough metal at every such surface, by visible microfacet normals.
pub fn sample_metal(
    sampling: Res<Shared<SamplingTable>>,
    (metals, several): (Res<Shared<MetalTable>>, Option<Res<Shared<MultipleScatteringTable>>>),
    (mut points, mut choices): (Local<Vec<[f64; 2]>>, Local<Vec<f64>>),
    mut tiles: Query<(BsdfView, DrawsView, &MetalRows)>,
) {
    let rough = RoughMetals { metals: &metals, several: several.as_deref().map(|several| &**several) };
    for (BsdfViewItem { rays, paths, surfaces, shading, mut scattered }, draws, list) in &mut tiles {
        let draws = draws.draws(&sampling, Some(paths));
        draws_of_two(&draws, Purpose::Direction, &list.row, &mut points);
        if rough.several.is_some() {
            draws_of_one(&draws, Purpose::MaterialChoice, &list.row, &mut choices);
        }
        scattered.append(&list.row, |number, row| {
            let (metal, choice) = (list.of[number] as usize, choices.get(number).copied().unwrap_or_default());
            ScatteredRay::leaving(row, (rays, paths), (surfaces, shading), |_, to_eye| {
                rough.sample(metal, to_eye, points[number], choice)
            })
        });
    }
}

/// Adds the light of each unblocked shadow ray that rough metal reflects to the eye.
pub fn add_metal(
    materials: Res<Shared<MaterialTable>>,
    (metals, several): (Res<Shared<MetalTable>>, Option<Res<Shared<MultipleScatteringTable>>>),
    mut tiles: Query<ReflectionView>,
) {
    let rough = RoughMetals { metals: &metals, several: several.as_deref().map(|several| &**several) };
    for ReflectionViewItem { eye, surfaces, shading, light, shadow: hits, mut radiance } in &mut tiles {
        for ray in 0..light.rows() {
            let row = light.path[ray] as usize;
            let surface = surfaces.get(row);
            let material = surface.material as usize;
            if materials.kind[material] != MaterialKind::Metal || hits.is_some_and(|hits| hits.shape[ray] != NO_SHAPE) {
                continue;
            }
            let normal = shading.map_or_else(|| surface.normal.as_dvec3(), |normals| normals.get(row));
            let local_from_world = frame_of(normal).transpose();
            let [to_light, to_eye] =
                [light.direction_of(ray), -eye.direction_of(row)].map(|direction| local_from_world * direction);
            let (brdf, irradiance) =
                (rough.brdf(materials.row[material] as usize, to_light, to_eye), light.irradiance(ray));
            let [r, g, b] = [0, 1, 2].map(|part| (brdf[part] * irradiance[part]).min(f64::from(f32::MAX)) as f32);
            radiance.r[row] += r;
            radiance.g[row] += g;
            radiance.b[row] += b;
        }
    }
}

/// The stage that samples the BSDF.
pub fn metal_stage() -> Stage {
    Stage::new("Sample BSDFs: metal", TileSystems::SampleBsdfs, sample_metal)
        .kind(StageKind::Estimator)
        .appends::<Scattered>()
        .table_where::<MultipleScatteringTable>(multiple_scattering_evidence)
        .when(|scene| metal_evidence(scene).and(|| scattered_evidence(scene)))
}

/// The stage that evaluates direct light.
pub fn metal_light_stage() -> Stage {
    Stage::new("Evaluate direct light: metal", TileSystems::Shade, add_metal)
        .table_where::<MultipleScatteringTable>(multiple_scattering_evidence)
        .when(|scene| metal_evidence(scene).and(|| lit_evidence(scene)))
}

/// Evidence that directions from rough metal are sampled.
fn scattered_evidence(scene: &Census<'_>) -> Evidence {
    needed_if(scene, |integrator| integrator.transport().samples_glossy)
}
