use super::deeper_media::{deeper_media_evidence, near_and_far};
use super::media::media_evidence;
use super::mirror::mirroring_normal;
use super::view::{BsdfView, BsdfViewItem, GlassView, GlassViewItem};
use super::{DeeperMedia, GlassRows, Media, Scattered, ScatteredRay, fresnel, mirror_direction, refract};
use crate::extract::{
    GlassTable, NO_ROW, SamplingTable, followed_evidence, glass_evidence, needed_if, traced_evidence,
};
use crate::intersect::{ShadingNormals, SurfaceSides, Surfaces};
use crate::plan::{Census, Evidence, Shared, Stage, StageKind, TileSystems};
use crate::rays::{DrawsView, Paths, WorldRays, draws_of_one};
use crate::sample::Purpose;
use crate::shapes::offset_origin;
use bevy_ecs::prelude::*;
use glam::DVec3;

// ANCHOR: glass_samples
/// A direction sampled at a glass surface, by reflection or by refraction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GlassSample {
    /// The direction, a unit vector.
    pub direction: DVec3,
    /// The factor of the radiance that arrives along it, on this side of the surface.
    pub weight: f64,
    /// Whether it is refracted, through the surface.
    pub through: bool,
}

/// Both directions at a smooth surface to a medium of relative index η: specular reflection, and refraction with the
/// rest of the light.
///
/// A beam that enters a denser medium becomes narrower, so its radiance in there is η² times as large; seen from this
/// side, the factor is 1/η².
/// For total internal reflection, the second sample has weight 0.
#[inline(always)]
pub fn glass_samples(direction: DVec3, normal: DVec3, eta: f64) -> [GlassSample; 2] {
    let reflected = fresnel((-direction.dot(normal)).max(0.0), eta);
    let mirrored = GlassSample { direction: mirror_direction(direction, normal), weight: reflected, through: false };
    let bent = refract(direction, normal, eta).map_or_else(GlassSample::default, |direction| GlassSample {
        direction,
        weight: (1.0 - reflected) / (eta * eta),
        through: true,
    });
    [mirrored, bent]
}
// ANCHOR_END: glass_samples

// ANCHOR: glass_event
/// One of the two at random: reflection with the Fresnel reflectance as its probability, by a number in [0, 1); divided
/// by the probability, the weight is 1 for reflection and 1/η² for refraction.
#[inline(always)]
pub fn glass_event(direction: DVec3, normal: DVec3, eta: f64, number: f64) -> GlassSample {
    let [mirrored, bent] = glass_samples(direction, normal, eta);
    if number < mirrored.weight || !bent.through {
        GlassSample { weight: 1.0, ..mirrored }
    } else {
        GlassSample { weight: 1.0 / (eta * eta), ..bent }
    }
}
// ANCHOR_END: glass_event

/// The columns of a tile that the stages at glass read.
struct GlassColumns<'a> {
    glass: &'a GlassTable,
    rays: &'a WorldRays,
    paths: &'a Paths,
    surfaces: &'a Surfaces,
    shading: Option<&'a ShadingNormals>,
    sides: &'a SurfaceSides,
    media: Option<&'a Media>,
    deeper: Option<&'a DeeperMedia>,
    list: &'a GlassRows,
}

impl GlassColumns<'_> {
    /// The relative index η of a row's surface, the far side's over the near side's; without a column of media,
    /// everything outside this glass is a vacuum.
    #[inline(always)]
    fn eta(&self, number: usize, row: usize) -> f64 {
        let (own, from_outside) = (self.list.of[number], self.sides.outside[row] != 0);
        let ior = |of: u32| if of == NO_ROW { 1.0 } else { self.glass.ior[of as usize] };
        match self.media {
            Some(media) => {
                let beyond = self.deeper.map_or(&[][..], |deeper| deeper.get(row));
                let [near, far] = near_and_far(media.get(row), beyond, own, from_outside, &self.glass.priority);
                ior(far) / ior(near)
            }
            None if from_outside => ior(own),
            None => 1.0 / ior(own),
        }
    }

    /// The scattered ray of a sample; of throughput 0 where a shading normal sends it to the wrong side.
    #[inline(always)]
    fn ray(&self, row: usize, sample: GlassSample) -> ScatteredRay {
        let surface = self.surfaces.get(row);
        let side = if sample.through { -surface.normal } else { surface.normal };
        let leaves = sample.direction.dot(side.as_dvec3()) > 0.0;
        let weight = if leaves { sample.weight } else { 0.0 };
        ScatteredRay {
            origin: offset_origin(surface.position, side, surface.bound),
            direction: sample.direction,
            throughput: self.paths.throughput(row).map(|part| part * weight),
            pdf: f64::INFINITY,
        }
    }

    /// The ray's direction and the normal that it is refracted by.
    #[inline(always)]
    fn incidence(&self, row: usize) -> (DVec3, DVec3) {
        let direction = self.rays.direction_of(row);
        (direction, mirroring_normal(self.shading, row, self.surfaces.get(row).normal.as_dvec3(), direction))
    }
}

/// Samples reflection or refraction at every glass surface; a ray from a light keeps all of its power, where radiance
/// would get its 1/η² (Veach 1997, 5.2).
pub fn sample_glass<const FROM_LIGHT: bool>(
    sampling: Res<Shared<SamplingTable>>,
    glass: Res<Shared<GlassTable>>,
    mut numbers: Local<Vec<f64>>,
    mut tiles: Query<(BsdfView, DrawsView, GlassView)>,
) {
    for (
        BsdfViewItem { rays, paths, surfaces, shading, mut scattered },
        draws,
        GlassViewItem { sides, list, media, deeper },
    ) in &mut tiles
    {
        let draws = draws.draws(&sampling, Some(paths));
        draws_of_one(&draws, Purpose::MaterialChoice, &list.row, &mut numbers);
        let columns = GlassColumns { glass: &glass, rays, paths, surfaces, shading, sides, media, deeper, list };
        scattered.append(&list.row, |number, row| {
            let (direction, normal) = columns.incidence(row);
            let sample = glass_event(direction, normal, columns.eta(number, row), numbers[number]);
            columns.ray(row, if FROM_LIGHT { GlassSample { weight: 1.0, ..sample } } else { sample })
        });
    }
}

/// The least throughput of a ray that is traced where both are: their number doubles at every surface, and most
/// contribute next to nothing.
const MIN_THROUGHPUT: f64 = 1.0 / 512.0;

// ANCHOR: split_rays_at_glass
/// Traces both rays at every glass surface (Whitted 1980), except for those with too little throughput to be seen.
pub fn split_rays_at_glass(glass: Res<Shared<GlassTable>>, mut tiles: Query<(BsdfView, GlassView)>) {
    for (
        BsdfViewItem { rays, paths, surfaces, shading, mut scattered },
        GlassViewItem { sides, list, media, deeper },
    ) in &mut tiles
    {
        let columns = GlassColumns { glass: &glass, rays, paths, surfaces, shading, sides, media, deeper, list };
        for which in [0, 1] {
            scattered.append(&list.row, |number, row| {
                let (direction, normal) = columns.incidence(row);
                let ray = columns.ray(row, glass_samples(direction, normal, columns.eta(number, row))[which]);
                let seen = ray.throughput.iter().any(|part| *part >= MIN_THROUGHPUT);
                if seen { ray } else { ScatteredRay::default() }
            });
        }
    }
}
// ANCHOR_END: split_rays_at_glass

/// The stage that traces both rays.
pub fn glass_stage() -> Stage {
    reading(Stage::new("Split rays at glass", TileSystems::SampleBsdfs, split_rays_at_glass))
        .on_camera_paths()
        .kind(StageKind::Alternative)
        .when(|scene| glass_evidence(scene).and(|| split_evidence(scene)))
}

/// The stage that samples one of them.
pub fn glass_sample_stage() -> Stage {
    reading(Stage::new("Sample BSDFs: glass", TileSystems::SampleBsdfs, sample_glass::<false>))
        .on_camera_paths()
        .kind(StageKind::Alternative)
        .when(|scene| {
            let both = split_evidence(scene);
            let one = Evidence { needed: !both.needed, ..both };
            glass_evidence(scene).and(|| followed_evidence(scene)).and(|| one)
        })
}

/// The stage that samples one of them for paths from lights.
pub fn glass_light_stage() -> Stage {
    reading(Stage::new("Sample BSDFs: glass, from lights", TileSystems::SampleBsdfs, sample_glass::<true>))
        .on_light_paths()
        .kind(StageKind::Alternative)
        .when(|scene| traced_evidence(scene).and(|| glass_evidence(scene)))
}

fn reading(stage: Stage) -> Stage {
    stage.reads_where::<Media>(media_evidence).reads_where::<DeeperMedia>(deeper_media_evidence).appends::<Scattered>()
}

/// Evidence that both rays are traced at glass.
fn split_evidence(scene: &Census<'_>) -> Evidence {
    needed_if(scene, |integrator| integrator.transport().splits_at_glass)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::ray_aim::Draws as Numbers;

    /// The mean of the sampled weights is that of the two rays, and no light is lost or gained.
    #[test]
    fn sampling_agrees_with_splitting_and_nothing_is_lost() {
        const STEPS: u32 = 4000;
        for index in 0..400 {
            let mut draws = Numbers::new(1951, index);
            let (normal, eta) = (draws.unit_vector().normalize(), draws.power_of_ten(-0.5, 0.5));
            let direction = (draws.unit_vector_across(normal) * draws.between(0.0, 3.0) - normal).normalize();
            let [mirrored, bent] = glass_samples(direction, normal, eta);
            assert!((mirrored.weight + bent.weight * eta * eta - 1.0).abs() < 1e-12 || !bent.through);
            let mut sums = [0.0; 2];
            for step in 0..STEPS {
                let sample = glass_event(direction, normal, eta, (f64::from(step) + 0.5) / f64::from(STEPS));
                sums[usize::from(sample.through)] += sample.weight / f64::from(STEPS);
                assert_eq!(sample.direction, if sample.through { bent.direction } else { mirrored.direction });
            }
            let step = 1.0 / f64::from(STEPS) / (eta * eta).min(1.0);
            assert!((sums[0] - mirrored.weight).abs() <= step && (sums[1] - bent.weight).abs() <= step, "{index}");
        }
        eprintln!("glass: 400 surfaces, sampled and split");
    }

    /// In and out again through parallel faces, the direction comes back and the factors 1/η² and η² cancel.
    #[test]
    fn through_a_pane_radiance_is_unscaled() {
        for index in 0..2000 {
            let mut draws = Numbers::new(1952, index);
            let (normal, eta) = (draws.unit_vector().normalize(), draws.between(1.0, 3.0));
            let direction = (draws.unit_vector_across(normal) * draws.between(0.0, 3.0) - normal).normalize();
            let [_, inward] = glass_samples(direction, normal, eta);
            let [mirrored, outward] = glass_samples(inward.direction, normal, 1.0 / eta);
            assert!((outward.direction - direction).length() < 1e-13, "{index}");
            let once = 1.0 - mirrored.weight;
            assert!(
                (inward.weight * outward.weight - once * once).abs() < 1e-12,
                "{index}: both faces transmit the same fraction"
            );
        }
        eprintln!("panes: 2000 paths through, none bent, none brightened");
    }

    #[test]
    fn a_surface_between_equals_is_none() {
        let direction = DVec3::new(0.6, 0.0, -0.8);
        let sample = glass_event(direction, DVec3::Z, 1.0, 0.0);
        assert!(sample.through && sample.weight == 1.0 && (sample.direction - direction).length() < 1e-15);
    }
}
