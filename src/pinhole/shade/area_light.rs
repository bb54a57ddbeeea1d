use super::ShadowRays;
use super::light::{ShadowRay, cosine_of, shadow_t_max};
use super::radiance::{LightSamplingView, LightSamplingViewItem};
use super::receivers::{
    AT_ONCE, LightDraws, LightRay, LightRows, MakesRays, RayLists, Starts, append_rays, append_sampled,
};
use crate::each::{Each, list_those, set_length};
use crate::extract::{AreaLightTable, SamplingTable, area_light_evidence, light_sampling_evidence, material_evidence};
use crate::intersect::Surface;
use crate::lights::Receiver;
use crate::plan::{Shared, Stage, StageKind, TileSystems, VectorRows};
use crate::rays::{Draws, DrawsView, Paths, draws_of_two, fractions_of_one};
use crate::sample::{Draw, PixelKey, Purpose, unit, with_sampler};
use crate::shapes::emitter::{ANY_WAY, Emitting, WAYS, WayVisitor};
use crate::shapes::{EmitterVisitor, offset_origin, pdf_towards, visit_emitter};
use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};
use multiversion::multiversion;

// ANCHOR: irradiance_from_area
/// One sample's estimate of the irradiance from an area light of radiance L: L cos θ / p.
///
/// p is the pdf of the sampled direction per unit of solid angle, so the mean of many samples converges to the integral
/// of L cos θ over the directions that the light subtends.
#[inline(always)]
pub fn irradiance_from_area(radiance: [f64; 3], cosine: f64, pdf: f64) -> [f64; 3] {
    let weight = cosine / pdf;
    [radiance[0] * weight, radiance[1] * weight, radiance[2] * weight]
}
// ANCHOR_END: irradiance_from_area

/// The pdf of sampling a point on a light from another point, in 1/sr, including the probability of choosing that
/// light; 0 where the light does not shine.
///
/// `receiver` is where a ray starts that hit the light at `at`; its normal counts where there are many lights.
#[inline(always)]
pub fn area_light_pdf(lights: &AreaLightTable, light: usize, receiver: &Receiver, at: DVec3) -> f64 {
    let from = receiver.position;
    lights.with_light(light, |emitter, _, one_sided| {
        let shines = !one_sided || emitter.faces(from);
        if shines { lights.probability_of(light, receiver) * pdf_towards(emitter, from, at) } else { 0.0 }
    })
}

// ANCHOR: sample_light
/// Samples a point on a light that is chosen with this probability; returns the shadow ray towards it.
///
/// The shadow ray follows its direction as rounded to f32, so its end is computed anew by intersecting the light along
/// it: otherwise a light hit at grazing incidence would block its own ray.
#[inline(always)]
fn sample_light<E: Emitting, const WAY: usize>(
    light: &E,
    (radiance, one_sided, probability): ([f64; 3], bool, f64),
    surface: &Surface,
    normal: DVec3,
    u: [f64; 2],
) -> LightRay {
    let origin = offset_origin(surface.position, surface.normal, surface.bound);
    let from = origin.as_dvec3();
    let point = light.point_in::<WAY>(from, u);
    let pdf = probability * point.pdf;
    let shines = (pdf > 0.0) & (!one_sided | light.faces(from));

    let length = point.to.length();
    let direction = (point.to * (1.0 / length)).as_vec3();
    let hit = light.distance(from, direction.as_dvec3());
    let distance = if (hit > 0.0) & (hit < f64::INFINITY) { hit } else { length };
    let cosine = cosine_of(surface, normal, direction);
    let irradiance = irradiance_from_area(radiance, cosine, pdf);
    let ray = ShadowRay { origin, direction, distance, cosine: if shines { cosine } else { 0.0 } };
    LightRay { ray, t_max: shadow_t_max(distance), irradiance, pdf }
}
// ANCHOR_END: sample_light

/// Appends, for each row, a shadow ray to a point sampled on one of the area lights.
///
/// Of few lights each is sampled for all rows at once: from what the camera sees for every row, deeper for those that have
/// chosen it. Of many, one is chosen row by row.
pub fn sample_area_lights(
    lights: Res<Shared<AreaLightTable>>,
    sampling: Res<Shared<SamplingTable>>,
    (mut fractions, mut lists, mut points): (Local<[Vec<u32>; 2]>, Local<[Vec<u32>; 2]>, Local<[Vec<[f64; 2]>; 2]>),
    mut by_way: Local<ByWay>,
    mut tiles: Query<(LightSamplingView, DrawsView, Option<&Paths>)>,
) {
    if lights.is_empty() {
        return;
    }
    for (LightSamplingViewItem { surfaces, shading, list, far, mut rays, mut pdfs }, draws, paths) in &mut tiles {
        let receivers = LightRows::new(surfaces, shading, list, far);
        let draws = draws.draws(&sampling, paths);
        if lights.hierarchy.is_some() {
            let to = (&mut *rays, pdfs.as_deref_mut());
            let (sample, key) = (draws.sample(), |row| draws.key(row));
            with_sampler!(sampling.sampler, D => {
                let drawn = [Purpose::LightChoice, Purpose::LightPoint].each(|purpose| D::of(sample, purpose));
                sample_one_of_many(drawn, key, &lights, &receivers, to);
            });
            continue;
        }
        let samples_each = lights.samples_each(draws.depth.0);
        if !samples_each {
            for (rows, fractions) in receivers.rows().into_iter().zip(fractions.iter_mut()) {
                fractions_of_one(&draws, Purpose::LightChoice, rows, fractions);
            }
        }
        for light in (0..lights.lights()).filter(|&light| lights.probability[light] > 0.0) {
            let mut chosen = receivers.rows();
            if !samples_each {
                let has_chosen = lights.fractions_of(light);
                for ((rows, fractions), list) in receivers.rows().into_iter().zip(&*fractions).zip(lists.iter_mut()) {
                    let drawn = rows.iter().zip(fractions);
                    list_those(drawn.map(|(&row, &drawn)| (row, has_chosen.contains(&u64::from(drawn)))), list);
                }
                chosen = [&lists[0], &lists[1]];
            }
            let (of_light, probability) =
                if samples_each { (sampling.for_light(light), 1.0) } else { (**sampling, lights.probability[light]) };
            let of_light = Draws { sampling: &of_light, ..draws };
            for (chosen, points) in chosen.into_iter().zip(points.iter_mut()) {
                draws_of_two(&of_light, Purpose::LightPoint, chosen, points);
            }
            lights.with_light(light, |emitter, radiance, one_sided| {
                let light = (radiance, one_sided, probability);
                let receivers = receivers.part(chosen[0], chosen[1]);
                let to = (&mut *rays, pdfs.as_deref_mut());
                let (draws, by_way) = ([&points[0][..], &points[1][..]], &mut *by_way);
                visit_emitter(emitter, OneLight { light, receivers, draws, to, by_way });
            });
        }
    }
}

/// One area light, the surfaces that have chosen it, and where their shadow rays go.
struct OneLight<'a> {
    /// Its radiance, whether it shines on one side only, and the probability of choosing it.
    light: ([f64; 3], bool, f64),
    receivers: LightRows<'a>,
    draws: LightDraws<'a>,
    to: RayLists<'a>,
    /// Room for the rows by the ways in which the light is sampled for them, on the near side and behind.
    by_way: &'a mut ByWay,
}

/// Rows that have chosen a light, and their points of the unit square.
#[derive(Default)]
pub struct ChosenRows {
    row: Vec<u32>,
    point: Vec<[f64; 2]>,
    /// How many there are; what follows is room.
    count: usize,
}

impl ChosenRows {
    /// The rows.
    fn rows(&self) -> &[u32] {
        &self.row[..self.count]
    }

    /// Their points.
    fn points(&self) -> &[[f64; 2]] {
        &self.point[..self.count]
    }
}

/// Those of each way, on the near side and behind.
type ByWay = [[ChosenRows; 2]; WAYS];

impl EmitterVisitor for OneLight<'_> {
    fn visit<E: Emitting>(mut self, emitter: &E) {
        let (_, one_sided, _) = self.light;
        if E::HAS_WAYS | one_sided {
            self.part_by_way(&|starts, found| ways_at(emitter, one_sided, starts, found));
        }
        emitter.in_ways(&mut InWays(self));
    }
}

impl OneLight<'_> {
    /// Lists the rows on which the light shines by the ways in which it is sampled for them, which the function finds out
    /// for a block of rows.
    fn part_by_way(&mut self, ways_at: &dyn Fn(&Starts, &mut [u32; AT_ONCE])) {
        for (side, (rows, draws)) in self.receivers.rows().into_iter().zip(self.draws).enumerate() {
            let mut counts = [0; WAYS];
            for chosen in self.by_way.iter_mut().filter(|chosen| chosen[side].row.len() < rows.len()) {
                set_length(&mut chosen[side].row, rows.len(), || 0);
                set_length(&mut chosen[side].point, rows.len(), || [0.0; 2]);
            }
            let mut found = [0; AT_ONCE];
            for (rows, draws) in rows.chunks(AT_ONCE).zip(draws.chunks(AT_ONCE)) {
                ways_at(&self.receivers.starts(rows, side == 1), &mut found);
                for lane in 0..rows.len().min(AT_ONCE) {
                    let (row, u, found) = (rows[lane], draws[lane], found[lane]);
                    let (way, shines) = ((found >> 1) as usize % WAYS, found & 1);
                    let (chosen, count) = (&mut self.by_way[way][side], &mut counts[way]);
                    // Every row is written, and the next one of its way overwrites it where no light shines on it.
                    (chosen.row[*count], chosen.point[*count]) = (row, u);
                    *count += shines as usize;
                }
            }
            for (chosen, count) in self.by_way.iter_mut().zip(counts) {
                chosen[side].count = count;
            }
        }
    }
}

/// Twice the way in which an emitter is sampled from each of these points, and 1 more where it shines on it.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn ways_at<E: Emitting>(emitter: &E, one_sided: bool, starts: &Starts, found: &mut [u32; AT_ONCE]) {
    // A copy, which nothing that is written can change: what is the same for all rows is computed once.
    let emitter = *emitter;
    for lane in 0..AT_ONCE {
        let from = Vec3::from(starts.at(lane)).as_dvec3();
        let shines = !one_sided | emitter.faces(from);
        found[lane] = 2 * emitter.way(from) as u32 + u32::from(shines);
    }
}

/// What is sampled of a light in each of its ways.
struct InWays<'a>(OneLight<'a>);

impl WayVisitor for InWays<'_> {
    fn visit<E: Emitting, const WAY: usize>(&mut self, emitter: &E) {
        let OneLight { light, receivers, draws, to: (rays, pdfs), by_way } = &mut self.0;
        let (light, to) = (InWay::<E, WAY> { emitter: *emitter, light: *light }, (&mut **rays, pdfs.as_deref_mut()));
        let [near, far] = &by_way[WAY];
        let (receivers, draws) = if E::HAS_WAYS | light.light.1 {
            (receivers.part(near.rows(), far.rows()), [near.points(), far.points()])
        } else {
            (receivers.part(receivers.rows()[0], receivers.rows()[1]), *draws)
        };
        if E::IN_BLOCKS {
            sample_in_blocks(&light, &receivers, draws, to)
        } else {
            append_rays(&receivers, to, true, &light, draws)
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn sample_in_blocks<E: Emitting, const WAY: usize>(
    light: &InWay<E, WAY>,
    receivers: &LightRows<'_>,
    draws: LightDraws<'_>,
    to: RayLists<'_>,
) {
    append_rays(receivers, to, true, light, draws);
}

/// An area light that is sampled in one of its ways.
struct InWay<E, const WAY: usize> {
    emitter: E,
    /// Its radiance, whether it shines on one side only, and the probability of choosing it.
    light: ([f64; 3], bool, f64),
}

impl<E: Emitting, const WAY: usize> MakesRays for InWay<E, WAY> {
    #[inline(always)]
    fn ray_from(&self, surface: &Surface, normal: DVec3, u: [f64; 2], _: DVec3) -> LightRay {
        sample_light::<E, WAY>(&self.emitter, self.light, surface, normal, u)
    }
}

#[inline(always)]
fn sample_one_of_many<D: Draw>(
    [choice, place]: [D; 2],
    key: impl Fn(usize) -> PixelKey,
    lights: &AreaLightTable,
    receivers: &LightRows<'_>,
    to: RayLists<'_>,
) {
    append_sampled(receivers, to, |row, surface, normal| {
        let (key, origin) = (key(row), offset_origin(surface.position, surface.normal, surface.bound));
        let receiver = Receiver { position: origin.as_dvec3(), normal: surface.normal.as_dvec3(), depth: 0 };
        let (light, probability) = lights.choose(&receiver, choice.one(key));
        let mut ray = LightRay::default();
        lights.with_light(light, |emitter, radiance, one_sided| {
            let (light, u) = ((radiance, one_sided, probability), place.two(key).each(unit));
            visit_emitter(emitter, OneRay { light, surface, normal, u, ray: &mut ray });
        });
        ray
    });
}

/// A surface whose shadow ray to one light is asked for.
struct OneRay<'a> {
    light: ([f64; 3], bool, f64),
    surface: &'a Surface,
    normal: DVec3,
    u: [f64; 2],
    ray: &'a mut LightRay,
}

impl EmitterVisitor for OneRay<'_> {
    #[inline(always)]
    fn visit<E: Emitting>(self, emitter: &E) {
        *self.ray = sample_light::<E, ANY_WAY>(emitter, self.light, self.surface, self.normal, self.u);
    }
}

/// The stage that runs [`sample_area_lights`]: next-event estimation, the alternative to BSDF sampling alone.
pub fn area_light_stage() -> Stage {
    Stage::new("Sample area lights", TileSystems::SampleLights, sample_area_lights)
        .kind(StageKind::Alternative)
        .appends::<ShadowRays>()
        .when(|scene| {
            area_light_evidence(scene).and(|| light_sampling_evidence(scene)).and(|| material_evidence(scene))
        })
}
