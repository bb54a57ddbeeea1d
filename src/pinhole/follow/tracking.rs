//! Media whose density varies along a ray: how far light goes in them, how much of it, and what they emit.

use super::distances::{
    ChosenColour, MediaAlong, SampledDistance, Span, Stretch, add_depth, depth, emission_between, over, transmittances,
};
use crate::each::{Each, all_are};
use crate::extract::{Coefficients, MediumTable, PlacedGrid};
use crate::sample::RandomStream;
use glam::DVec3;

/// The steps after which the search for a distance of a given optical depth ends.
const TRIALS: u32 = 64;

/// The grid of a span, and the ray in its index space.
#[inline(always)]
fn grid_of<'m>(
    grids: &[(u32, [DVec3; 2])],
    media: &'m MediumTable,
    own: &Span,
) -> Option<(&'m PlacedGrid, [DVec3; 2])> {
    let (place, ray) = grids.get(own.grid as usize)?;
    Some((media.place[*place as usize].density.as_ref()?, *ray))
}

impl MediaAlong {
    /// The density of a span's medium at a distance; never more than the majorant, whatever rounding says.
    pub(super) fn density(&self, media: &MediumTable, own: &Span, t: f64) -> f64 {
        let Some((placed, [origin, direction])) = grid_of(&self.grids, media, own) else { return 1.0 };
        placed.grid.density(origin + t * direction).min(own.majorant)
    }

    /// The integral of the density of a span's medium between two distances, as far as they lie in the span.
    fn length(&self, media: &MediumTable, own: &Span, [from, to]: [f64; 2]) -> f64 {
        let (from, to) = (from.max(own.from), to.min(own.to));
        if !(from < to) {
            return 0.0;
        }
        grid_of(&self.grids, media, own).map_or(to - from, |(placed, ray)| placed.grid.integral(ray, [from, to]))
    }

    /// Adds the optical depths between two distances.
    fn add_depths(&self, media: &MediumTable, range: [f64; 2], depths: &mut [f64; 3]) {
        for own in self.spans.iter().filter(|own| own.from < range[1] && own.to > range[0]) {
            add_depth(depths, media.medium[own.medium].extinction, self.length(media, own, range));
        }
    }

    /// The spans that fill a stretch.
    #[inline(always)]
    fn within(&self, stretch: &Stretch) -> impl Iterator<Item = &Span> {
        let (from, to) = (stretch.from, stretch.to);
        let spans = match self.spans.get(stretch.only as usize) {
            Some(only) => std::slice::from_ref(only),
            None => &self.spans,
        };
        spans.iter().filter(move |own| own.from <= from && to <= own.to)
    }

    /// The coefficients at a distance within a stretch.
    #[inline]
    fn coefficients(&self, media: &MediumTable, stretch: &Stretch, t: f64) -> Coefficients {
        let mut sum = Coefficients::default();
        for own in self.within(stretch) {
            let (density, of) = (self.density(media, own, t), &media.medium[own.medium]);
            for part in 0..3 {
                sum.extinction[part] += density * of.extinction[part];
                sum.scattering[part] += density * of.scattering[part];
                sum.emission[part] += density * of.emission[part];
            }
        }
        sum
    }

    /// The extinction alone.
    #[inline]
    fn extinction(&self, media: &MediumTable, stretch: &Stretch, t: f64) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for own in self.within(stretch) {
            let (density, of) = (self.density(media, own, t), &media.medium[own.medium].extinction);
            (0..3).for_each(|part| sum[part] += density * of[part]);
        }
        sum
    }

    /// Divides each span whose density varies into the blocks of its grid, of which each knows its majorant.
    pub(super) fn divide_into_blocks(&mut self, media: &MediumTable) {
        let Self { spans, whole, grids, .. } = self;
        std::mem::swap(spans, whole);
        spans.clear();
        for own in whole.iter() {
            match grid_of(grids, media, own) {
                Some((placed, ray)) => placed.grid.blocks_along(ray, [own.from, own.to], |[from, to], majorant| {
                    spans.push(Span { from, to, majorant, ..*own });
                }),
                None => spans.push(*own),
            }
        }
    }

    /// The voxels that a ray crosses between two distances, of the grid that has the smallest.
    #[inline]
    fn voxels(&self, media: &MediumTable, stretch: &Stretch) -> f64 {
        let a_unit =
            self.within(stretch).filter_map(|own| Some(grid_of(&self.grids, media, own)?.1[1].abs().element_sum()));
        a_unit.fold(0.0, f64::max) * (stretch.to - stretch.from) + 1.0
    }

    /// The transmittance along the spans of a ray, whose densities may vary: no number is random in it, since the integral
    /// of a density is known exactly.
    pub fn transmittance(&self, media: &MediumTable) -> [f64; 3] {
        let mut depths = [0.0; 3];
        self.add_depths(media, [0.0, f64::INFINITY], &mut depths);
        transmittances(depths)
    }

    /// The radiance that media of varying density along a ray emit towards its origin, where `absorption` is what else
    /// absorbs all along it.
    ///
    /// Of a medium alone, emission and extinction vary together, so that their quotient ε / σ is constant and the integral
    /// known. Where more than it absorbs, a stretch is cut into about as many parts as it has voxels, and each is asked at
    /// one distance, as far from its beginning as a number in [0, 1) says for all of them (Pauly, Kollig and Keller 2000).
    pub fn emission(&self, media: &MediumTable, absorption: [f64; 3], number: f64) -> [f64; 3] {
        let (mut sum, mut depths, mut at) = ([0.0; 3], [0.0; 3], 0.0);
        let reached =
            |depths: &[f64; 3], t: f64| [0, 1, 2].each(|part| libm::exp(-depths[part] - depth(absorption[part], t)));
        for stretch in &self.stretches {
            self.add_depths(media, [at, stretch.from], &mut depths);
            at = stretch.from;
            if all_are(stretch.sum.emission, 0.0) {
                continue;
            }
            if !stretch.varies {
                let emitted = emission_between(stretch, absorption);
                let arrives = reached(&depths, at);
                (0..3).for_each(|part| sum[part] += arrives[part] * emitted[part]);
                continue;
            }
            if let Some(own) = self.spans.get(stretch.only as usize)
                && all_are(absorption, 0.0)
            {
                let of = &media.medium[own.medium];
                let (integral, arrives) = (self.length(media, own, [stretch.from, stretch.to]), reached(&depths, at));
                let whole = Stretch { from: 0.0, to: integral, sum: *of, varies: false, only: stretch.only };
                let emitted = emission_between(&whole, absorption);
                (0..3).for_each(|part| sum[part] += arrives[part] * emitted[part]);
                continue;
            }
            let parts = self.voxels(media, stretch).ceil();
            let length = (stretch.to - stretch.from) / parts;
            for place in 0..parts as u32 {
                let t = (stretch.from + (f64::from(place) + number) * length).min(stretch.to);
                self.add_depths(media, [at, t], &mut depths);
                at = t;
                let (emission, arrives) = (self.coefficients(media, stretch, t).emission, reached(&depths, t));
                (0..3).for_each(|part| sum[part] += arrives[part] * emission[part] * length);
            }
        }
        sum
    }

    /// Samples the distance at which light is scattered along a ray of this throughput, where densities vary, by a number in
    /// [0, 1) and a stream of more.
    ///
    /// Where the optical depth of a block's majorant, its greatest density, is less than its number of voxels, light goes from
    /// one possible collision to the next, as if the majorant were everywhere, and each is a real one with the probability of
    /// the density there over it (Woodcock and others 1965). In a denser block the distance is found at which the optical depth
    /// is the one sampled. So no block costs much more than its voxels do.
    ///
    /// Colours are weighted by the balance heuristic over everything that was decided on the way, null collisions
    /// included (Miller, Georgiev and Jarosz 2019).
    pub fn sample_varying_distance(
        &self,
        media: &MediumTable,
        throughput: [f64; 3],
        number: f64,
        stream: &mut RandomStream,
    ) -> SampledDistance {
        let Some(ChosenColour { choice, colour, depth: mut left }) = ChosenColour::of(throughput, number) else {
            return SampledDistance::UNSCATTERED;
        };
        // What each colour's own sampling would have done all this with, and what only absorbs besides.
        let (mut path_pdfs, mut unscattered) = ([1.0; 3], [0.0; 3]);
        let weights = |values: [f64; 3], pdfs: [f64; 3]| {
            let mean = (0..3).map(|part| choice[part] * pdfs[part]).sum::<f64>();
            [0, 1, 2].each(|part| over(choice[part], values[part], mean))
        };
        for stretch in &self.stretches {
            let (majorants, range) = (stretch.rate(), [stretch.from, stretch.to]);
            if all_are(majorants, 0.0) {
                self.add_depths(media, range, &mut unscattered);
                continue;
            }
            let length = stretch.to - stretch.from;
            let greatest = majorants.iter().fold(0.0, |max: f64, &part| max.max(part));
            let collides_rarely = depth(greatest, length) < self.voxels(media, stretch);
            let event = if stretch.varies && collides_rarely {
                self.null_collisions(media, (stretch, colour), &mut left, &mut path_pdfs, stream)
            } else {
                self.exact_distance(media, (stretch, colour), &mut left, &mut path_pdfs)
            };
            if let Some(t) = event {
                let own = self.coefficients(media, stretch, t);
                let absorbed = transmittances(unscattered);
                let values = [0, 1, 2].each(|part| path_pdfs[part] * absorbed[part] * own.scattering[part]);
                let pdfs = [0, 1, 2].each(|part| path_pdfs[part] * own.extinction[part]);
                return SampledDistance { t: Some(t), weight: weights(values, pdfs) };
            }
        }
        let absorbed = transmittances(unscattered);
        let values = [0, 1, 2].each(|part| path_pdfs[part] * absorbed[part]);
        SampledDistance { t: None, weight: weights(values, path_pdfs) }
    }

    // ANCHOR: null_collisions
    /// Goes from one possible collision to the next, and returns the distance of a real one; `left` is the optical depth of
    /// the majorant that is left until the next.
    fn null_collisions(
        &self,
        media: &MediumTable,
        (stretch, colour): (&Stretch, usize),
        left: &mut f64,
        path_pdfs: &mut [f64; 3],
        stream: &mut RandomStream,
    ) -> Option<f64> {
        let (majorants, mut at) = (stretch.sum.extinction, stretch.from);
        loop {
            let rest = depth(majorants[colour], stretch.to - at);
            let step = if rest > *left { *left / majorants[colour] } else { stretch.to - at };
            // The same factor for all colours changes no weight.
            if majorants != [majorants[colour]; 3] {
                (0..3).for_each(|part| path_pdfs[part] *= libm::exp(-depth(majorants[part], step)));
            }
            if !(rest > *left) {
                *left -= rest;
                return None;
            }
            at += step;
            let own = self.extinction(media, stretch, at);
            if stream.next_unit() * majorants[colour] < own[colour] {
                return Some(at);
            }
            // Over the majorant, which changes no weight either, they remain within range.
            for part in 0..3 {
                path_pdfs[part] *= (majorants[part] - own[part]).max(0.0) / majorants[colour];
            }
            *left = -libm::log1p(-stream.next_unit());
        }
    }
    // ANCHOR_END: null_collisions

    /// Finds the distance at which the optical depth of a colour reaches what is left, by Newton's steps between bounds.
    fn exact_distance(
        &self,
        media: &MediumTable,
        (stretch, colour): (&Stretch, usize),
        left: &mut f64,
        path_pdfs: &mut [f64; 3],
    ) -> Option<f64> {
        let depths_to = |t: f64| {
            let mut depths = [0.0; 3];
            self.add_depths(media, [stretch.from, t], &mut depths);
            depths
        };
        let all = depths_to(stretch.to);
        if !(all[colour] > *left) {
            *left -= all[colour];
            (0..3).for_each(|part| path_pdfs[part] *= libm::exp(-all[part]));
            return None;
        }
        let (mut before, mut after) = (stretch.from, stretch.to);
        let mut t = stretch.from;
        for _ in 0..TRIALS {
            let rest = *left - depths_to(t)[colour];
            (before, after) = if rest > 0.0 { (t, after) } else { (before, t) };
            let newton = t + rest / self.extinction(media, stretch, t)[colour];
            let next = if newton > before && newton < after { newton } else { 0.5 * (before + after) };
            if (next - t).abs() <= f64::EPSILON * next {
                break;
            }
            t = next;
        }
        let depths = depths_to(t);
        (0..3).for_each(|part| path_pdfs[part] *= libm::exp(-depths[part]));
        Some(t)
    }
}
