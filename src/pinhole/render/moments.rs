//! A picture of things that change while the shutter is open, as the mean of pictures at moments.

use super::light_pass::LightPass;
use super::render_world::prepare;
use super::steps::steps_of;
use super::{RenderInProgress, Watch};
use crate::extract::ImageFrame;
use crate::film::{FilmLayers, FilmMoments};
use crate::follow::Splats;
use crate::plan::{Census, Plan, Stage};
use crate::rays::PixelSamples;
use crate::{Error, Result};
use bevy_ecs::prelude::*;
use std::sync::PoisonError;

/// A scene at one of so many moments, by its number from 0 on and by how many there are.
pub type SceneAt = Box<dyn Fn(u32, u32) -> Result<World> + Send + Sync>;

/// The moments of a render: each has its part of the samples of every pixel, the first the first ones, and so on.
///
/// The picture is the mean of the pictures at the moments, as the accumulation buffer computes it (Haeberli and Akeley,
/// "The accumulation buffer: hardware support for high-quality rendering", 1990).
/// As the numbers of the samples go on from moment to moment, the points in a pixel are as well distributed as those of a
/// render without moments.
pub(super) struct Moments {
    count: u32,
    scene: SceneAt,
    offer: Vec<Stage>,
    /// The one whose tables the worlds have.
    shown: Option<u32>,
}

// ANCHOR: first_sample_of
/// The number of the first sample of one of so many moments, which is also the end of those of the moment before: each
/// gets as many samples as the others, or one more where they do not divide evenly.
pub fn first_sample_of(number: u32, moments: u32, samples: u32) -> u32 {
    (u64::from(number) * u64::from(samples) / u64::from(moments)) as u32
}
// ANCHOR_END: first_sample_of

impl RenderInProgress {
    /// Makes this the render of a scene at so many moments, of which nothing has been rendered yet; no more than there are
    /// samples, or batches of light paths, so that each moment has some of them.
    ///
    /// Size, sampling and layers of the picture stay those of the scene that the render began with.
    /// More samples in one go make another picture, since each moment then has others.
    pub fn at_moments(&mut self, count: u32, scene: SceneAt, offer: Vec<Stage>) {
        let (samples, batches) = self.expected();
        let most = if self.light.is_some() { u64::from(samples).min(batches) } else { samples.into() };
        let count = u64::from(count).min(most).max(1) as u32;
        self.moments = (count > 1).then_some(Moments { count, scene, offer, shown: None });
    }

    /// The number of moments; 1 where the picture is of one scene.
    pub fn moments(&self) -> u32 {
        self.moments.as_ref().map_or(1, |moments| moments.count)
    }

    /// Advances every tile to `to` steps, moment by moment.
    pub(super) fn advance_at_moments(&mut self, to: u32, watch: &dyn Watch) -> Result {
        let count = self.moments();
        for number in 0..count {
            let end = steps_of(first_sample_of(number + 1, count, self.sampling.samples));
            let end = if number + 1 < count { end.min(to) } else { to };
            if self.film.least_done() < end || !self.has_light_paths(end) {
                self.show(number)?;
                self.advance_scene(end, watch)?;
            }
            if end == to {
                break;
            }
        }
        Ok(())
    }

    /// Whether the light paths that correspond to so many steps have been traced.
    fn has_light_paths(&self, steps: u32) -> bool {
        let samples = self.film.samples_between(0, steps);
        self.light.as_ref().is_none_or(|light| light.is_done(&self.film, samples))
    }

    /// Gives the worlds the scene of a moment.
    ///
    /// Errors: an invalid scene, or one whose film is another.
    fn show(&mut self, number: u32) -> Result {
        let Some(moments) = self.moments.as_mut().filter(|moments| moments.shown != Some(number)) else {
            return Ok(());
        };
        let scene = (moments.scene)(number, moments.count)?;
        let census = &Census::of(&scene);
        let (plan, tables) = prepare(census, &moments.offer)?;
        let image = *census.table::<ImageFrame>()?;
        let holds = |plan: &Plan| {
            let of_film = [plan.keeps::<FilmMoments>(), plan.keeps::<FilmLayers>(), plan.keeps::<Splats>()];
            (of_film, plan.keeps::<PixelSamples>())
        };
        if holds(&plan) != holds(&self.plan) || self.attributes.image != Some([image.width, image.height]) {
            let what = "while its shutter is open the scene comes to need another kind of film; name the camera's integrator, \
                        or render with --moments 1";
            return Err(Error::Usage(format!("cannot render the picture at {} moments: {what}", moments.count)));
        }
        moments.shown = Some(number);
        let is_alike = plan.rows == self.plan.rows && plan.columns == self.plan.columns;
        (self.plan, self.tables) = (plan, tables);
        self.renumber(self.sampling);
        for world in &mut self.worlds {
            let own = world.get_mut().unwrap_or_else(PoisonError::into_inner);
            match own {
                Some(world) if is_alike => self.tables.iter().for_each(|table| (table.insert)(&mut world.world)),
                _ => *own = None,
            }
        }
        self.light.iter_mut().for_each(LightPass::forget_scene);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_samples_are_divided_among_the_moments_as_evenly_as_they_can_be() {
        for samples in (1..70).chain([1000, u32::MAX]) {
            for moments in (1..20).chain([64]).filter(|moments| *moments <= samples) {
                let first = |number| first_sample_of(number, moments, samples);
                assert_eq!([first(0), first(moments)], [0, samples]);
                let least = samples / moments;
                let most = least + u32::from(!samples.is_multiple_of(moments));
                assert!((0..moments).all(|number| (least..=most).contains(&(first(number + 1) - first(number)))));
            }
        }
    }
}
