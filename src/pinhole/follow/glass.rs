use super::deeper_media::{deeper_media_evidence, near_and_far};
use super::media::media_evidence;
use super::mirror::mirroring_normal;
use super::{DeeperMedia, GlassRows, Media, Scattered, ScatteredRay, fresnel, mirror_direction, refract};
use crate::extract::{
    GlassTable, NO_ROW, SamplingTable, followed_evidence, glass_evidence, needed_if, traced_evidence,
};
use crate::intersect::{ShadingNormals, SurfaceSides, Surfaces, offset_origin};
use crate::plan::{Evidence, Shared, Stage, StageKind, TileSystems};
use crate::rays::{Depth, PixelSamples, SampleNumber, Tile, WorldRays};
use crate::rays::{Draws, Paths, draws_of_one};
use crate::sample::Purpose;
use crate::scene::Integrator;
use bevy_ecs::prelude::*;
use glam::DVec3;

// ANCHOR: glass_samples
/// A way on from a surface of glass.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GlassSample {
    /// Where it goes, a unit vector.
    pub direction: DVec3,
    /// What is left, on this side, of the radiance that comes from there.
    pub share: f64,
    /// Whether it goes through the surface.
    pub through: bool,
}

/// Both ways on from a smooth surface to a medium η times as dense: mirrored, and bent, which takes the rest.
///
/// A beam that enters the denser medium narrows, so its radiance is η² times as large in there; seen from here, 1/η² of
/// it is left.
/// Where all is mirrored the second way has no share.
#[inline(always)]
pub fn glass_samples(direction: DVec3, normal: DVec3, eta: f64) -> [GlassSample; 2] {
    let reflected = fresnel((-direction.dot(normal)).max(0.0), eta);
    let mirrored = GlassSample { direction: mirror_direction(direction, normal), share: reflected, through: false };
    let bent = refract(direction, normal, eta).map_or_else(GlassSample::default, |direction| GlassSample {
        direction,
        share: (1.0 - reflected) / (eta * eta),
        through: true,
    });
    [mirrored, bent]
}
// ANCHOR_END: glass_samples

// ANCHOR: glass_event
/// One of the two ways by chance: mirrored as often as light is, by a number from 0 to below 1; so what is left of it is
/// all of the mirrored light, or 1/η² of the bent.
#[inline(always)]
pub fn glass_event(direction: DVec3, normal: DVec3, eta: f64, number: f64) -> GlassSample {
    let [mirrored, bent] = glass_samples(direction, normal, eta);
    if number < mirrored.share || !bent.through {
        GlassSample { share: 1.0, ..mirrored }
    } else {
        GlassSample { share: 1.0 / (eta * eta), ..bent }
    }
}
// ANCHOR_END: glass_event

/// The columns of a tile that glass is met with.
struct Met<'a> {
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

impl Met<'_> {
    /// How many times as dense the far side of a row's surface is; without a column of media all that is not this glass
    /// is empty.
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

    /// The ray that a way is; none of it where a normal to shade by sends it to the wrong side.
    #[inline(always)]
    fn ray(&self, row: usize, way: GlassSample) -> ScatteredRay {
        let surface = self.surfaces.get(row);
        let side = if way.through { -surface.normal } else { surface.normal };
        let leaves = way.direction.dot(side.as_dvec3()) > 0.0;
        let share = if leaves { way.share } else { 0.0 };
        ScatteredRay {
            origin: offset_origin(surface.position, side, surface.bound),
            direction: way.direction,
            share: self.paths.throughput(row).map(|part| part * share),
            pdf: f64::INFINITY,
        }
    }

    /// The direction in which a row's surface was met, and the normal that it bends light by.
    #[inline(always)]
    fn met(&self, row: usize) -> (DVec3, DVec3) {
        let direction = self.rays.direction_of(row);
        (direction, mirroring_normal(self.shading, row, self.surfaces.get(row).normal.as_dvec3(), direction))
    }
}

/// Sends a ray on from every surface of glass, mirrored or bent by chance; one that comes from a light with all of its
/// power, which no surface spreads or gathers, where radiance has its 1/η² (Veach 1997, 5.2).
pub fn scatter_glass<const FROM_LIGHT: bool>(
    sampling: Res<Shared<SamplingTable>>,
    glass: Res<Shared<GlassTable>>,
    mut numbers: Local<Vec<f64>>,
    mut tiles: Query<(
        (&Tile, &Depth, Option<&SampleNumber>, Option<&PixelSamples>, &WorldRays, &Paths),
        (Option<&Media>, Option<&DeeperMedia>),
        (&Surfaces, Option<&ShadingNormals>, &SurfaceSides, &GlassRows),
        &mut Scattered,
    )>,
) {
    for (
        (tile, &depth, number, samples, rays, paths),
        (media, deeper),
        (surfaces, shading, sides, list),
        mut scattered,
    ) in &mut tiles
    {
        let draws = Draws { sampling: &sampling, tile, number, samples, paths: Some(paths), depth };
        draws_of_one(&draws, Purpose::MaterialChoice, &list.row, &mut numbers);
        let met = Met { glass: &glass, rays, paths, surfaces, shading, sides, media, deeper, list };
        scattered.append(&list.row, |number, row| {
            let (direction, normal) = met.met(row);
            let way = glass_event(direction, normal, met.eta(number, row), numbers[number]);
            met.ray(row, if FROM_LIGHT { GlassSample { share: 1.0, ..way } } else { way })
        });
    }
}

/// The least share of a ray that is followed where both are: with two rays a surface their number doubles, and most bring
/// next to nothing.
const LEAST_SHARE: f64 = 1.0 / 512.0;

// ANCHOR: split_at_glass
/// Sends both rays on from every surface of glass (Whitted 1980), but for those that bring too little to be seen.
pub fn split_at_glass(
    glass: Res<Shared<GlassTable>>,
    mut tiles: Query<(
        (&WorldRays, &Paths, Option<&Media>, Option<&DeeperMedia>),
        (&Surfaces, Option<&ShadingNormals>, &SurfaceSides, &GlassRows),
        &mut Scattered,
    )>,
) {
    for ((rays, paths, media, deeper), (surfaces, shading, sides, list), mut scattered) in &mut tiles {
        let met = Met { glass: &glass, rays, paths, surfaces, shading, sides, media, deeper, list };
        for which in [0, 1] {
            scattered.append(&list.row, |number, row| {
                let (direction, normal) = met.met(row);
                let ray = met.ray(row, glass_samples(direction, normal, met.eta(number, row))[which]);
                let seen = ray.share.iter().any(|part| *part >= LEAST_SHARE);
                if seen { ray } else { ScatteredRay::default() }
            });
        }
    }
}
// ANCHOR_END: split_at_glass

/// The stage that sends both rays on.
pub fn glass_stage() -> Stage {
    reading(Stage::new("Split rays at glass", TileSystems::SampleBsdfs, split_at_glass))
        .on_camera_paths()
        .kind(StageKind::Alternative)
        .when(|scene| glass_evidence(scene).and(|| split_evidence(scene)))
}

/// The stage that sends one on by chance.
pub fn glass_sample_stage() -> Stage {
    reading(Stage::new("Sample BSDFs: glass", TileSystems::SampleBsdfs, scatter_glass::<false>))
        .on_camera_paths()
        .kind(StageKind::Alternative)
        .when(|scene| {
            let both = split_evidence(scene);
            let one = Evidence { needed: !both.needed, ..both };
            glass_evidence(scene).and(|| followed_evidence(scene)).and(|| one)
        })
}

/// The stage that does so with light from lights.
pub fn glass_light_stage() -> Stage {
    reading(Stage::new("Sample BSDFs: glass, from lights", TileSystems::SampleBsdfs, scatter_glass::<true>))
        .on_light_paths()
        .kind(StageKind::Alternative)
        .when(|scene| traced_evidence(scene).and(|| glass_evidence(scene)))
}

fn reading(stage: Stage) -> Stage {
    stage.reads_where::<Media>(media_evidence).reads_where::<DeeperMedia>(deeper_media_evidence).appends::<Scattered>()
}

/// Evidence that nothing is left to chance at glass.
fn split_evidence(scene: &World) -> Evidence {
    needed_if(scene, |integrator| matches!(integrator, Integrator::Whitted { .. }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::ray_aim::Draws as Numbers;

    /// What comes of a way by chance is on average what both ways come to, and no light is lost or made.
    #[test]
    fn chance_agrees_with_both_ways_and_nothing_is_lost() {
        const STEPS: u32 = 4000;
        for index in 0..400 {
            let mut draws = Numbers::new(1951, index);
            let (normal, eta) = (draws.unit_vector().normalize(), draws.power_of_ten(-0.5, 0.5));
            let direction = (draws.unit_vector_across(normal) * draws.between(0.0, 3.0) - normal).normalize();
            let [mirrored, bent] = glass_samples(direction, normal, eta);
            assert!((mirrored.share + bent.share * eta * eta - 1.0).abs() < 1e-12 || !bent.through);
            let mut sums = [0.0; 2];
            for step in 0..STEPS {
                let way = glass_event(direction, normal, eta, (f64::from(step) + 0.5) / f64::from(STEPS));
                sums[usize::from(way.through)] += way.share / f64::from(STEPS);
                assert_eq!(way.direction, if way.through { bent.direction } else { mirrored.direction });
            }
            let step = 1.0 / f64::from(STEPS) / (eta * eta).min(1.0);
            assert!((sums[0] - mirrored.share).abs() <= step && (sums[1] - bent.share).abs() <= step, "{index}");
        }
        eprintln!("glass: 400 surfaces, by chance and both ways");
    }

    /// In and out again through parallel faces: the direction comes back, and the factors 1/η² and η² cancel.
    #[test]
    fn through_a_pane_nothing_is_narrowed() {
        for index in 0..2000 {
            let mut draws = Numbers::new(1952, index);
            let (normal, eta) = (draws.unit_vector().normalize(), draws.between(1.0, 3.0));
            let direction = (draws.unit_vector_across(normal) * draws.between(0.0, 3.0) - normal).normalize();
            let [_, inward] = glass_samples(direction, normal, eta);
            let [mirrored, outward] = glass_samples(inward.direction, normal, 1.0 / eta);
            assert!((outward.direction - direction).length() < 1e-13, "{index}");
            let once = 1.0 - mirrored.share;
            assert!(
                (inward.share * outward.share - once * once).abs() < 1e-12,
                "{index}: both faces let as much through"
            );
        }
        eprintln!("panes: 2000 ways through, none bent, none brightened");
    }

    #[test]
    fn a_surface_between_equals_is_none() {
        let direction = DVec3::new(0.6, 0.0, -0.8);
        let way = glass_event(direction, DVec3::Z, 1.0, 0.0);
        assert!(way.through && way.share == 1.0 && (way.direction - direction).length() < 1e-15);
    }
}
