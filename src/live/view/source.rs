use bevy_ecs::prelude::World;
use pinhole::film::{Curve, Film, byte_from_linear, denoise, rgba_bytes};
use pinhole::plan::{Census, Plan, Stage};
use pinhole::render::{Execution, Lap, RenderInProgress, Watch, samples_after, steps_of};
use pinhole::{Error, Result};
use std::time::{Duration, Instant};

/// Where frames come from: one render at a time, which a change of the scene replaces.
#[derive(Default)]
pub struct FrameSource {
    render: Option<RenderInProgress>,
    laps: Vec<Lap>,
}

/// What a frame is to show; mode, pose and size stand on the scene's camera.
pub struct Shot<'a> {
    /// The scene.
    pub scene: &'a World,
    /// The stages on offer.
    pub offer: &'a [Stage],
    /// Whether the scene has changed since the last frame, so that its samples are void.
    pub changed: bool,
    /// How long to take samples, beyond the first.
    pub patience: Duration,
}

/// How far a picture is.
pub struct Progress<'r> {
    /// The plan that it is rendered by.
    pub plan: &'r Plan,
    /// The film so far.
    pub film: &'r Film,
    /// The samples of each pixel so far, and those that the camera asks for.
    pub samples: [u32; 2],
    /// What each kept stage took since the last frame, summed over the workers.
    pub laps: Vec<Lap>,
    /// How long the stages ran, from the first tile to the last.
    pub time: Duration,
}

impl FrameSource {
    /// The next frame of a scene: its first samples, or what further samples make of the last frame.
    ///
    /// Errors: an invalid scene, no plan, or that the observer stopped it; the samples so far are then kept.
    pub fn film(&mut self, shot: &Shot<'_>, watch: &dyn Watch) -> Result<Progress<'_>> {
        let scene = || Census::of(shot.scene);
        if shot.changed {
            self.laps.clear();
        }
        let begun = match self.render.take() {
            None => {
                self.laps.clear();
                RenderInProgress::begin(&scene(), shot.offer, &Execution::default())?
            }
            Some(mut render) => {
                if shot.changed {
                    render.begin_frame(&scene(), shot.offer)?;
                }
                render
            }
        };
        let render = self.render.insert(begun);
        let (before, last, end) = (render.time(), render.steps(), Instant::now() + shot.patience);
        let mut step = render.film.done.iter().copied().min().unwrap_or(0).max(steps_of(1) - 1);
        while step < last {
            step += 1;
            render.advance(step, watch)?;
            if Instant::now() > end || !render.is_sampled() {
                break;
            }
        }
        let laps = render.laps();
        let earlier = std::mem::replace(&mut self.laps, laps.clone());
        let since = |(at, lap): (usize, &Lap)| {
            let before = earlier.get(at).copied().unwrap_or_default();
            Lap { time: lap.time - before.time, rows: lap.rows - before.rows }
        };
        let laps = laps.iter().enumerate().map(since).collect();
        let samples = [samples_after(step), render.sampling.samples];
        Ok(Progress { plan: &render.plan, film: &render.film, samples, laps, time: render.time() - before })
    }

    /// The film so far, if there is one.
    pub fn last(&self) -> Option<(&Film, Curve)> {
        self.render.as_ref().map(|render| (&render.film, curve(&render.plan)))
    }

    /// The plan of the last frame.
    pub fn plan(&self) -> Option<&Plan> {
        self.render.as_ref().map(|render| &render.plan)
    }
}

impl Progress<'_> {
    /// Whether no further sample would be taken.
    pub fn is_done(&self) -> bool {
        self.samples[0] >= self.samples[1]
    }

    /// The picture, 8-bit RGBA, through so many levels of the denoiser where the film has the layers for it.
    ///
    /// Four times the samples have a quarter of the variance, and need a level less to hide it: the bias goes with it.
    pub fn pixels(&self, levels: u32) -> Vec<u8> {
        let levels = levels.saturating_sub(self.samples[0].max(1).ilog2() / 2);
        let smooth = if levels > 0 && self.plan.view.is_none() { denoise(self.film, levels) } else { None };
        let Some([red, green, blue]) = smooth else { return rgba_bytes(self.film, curve(self.plan)) };
        let pixels = red.iter().zip(&green).zip(&blue);
        let byte = |linear: &f32| byte_from_linear(*linear, curve(self.plan));
        pixels.flat_map(|((red, green), blue)| [byte(red), byte(green), byte(blue), u8::MAX]).collect()
    }
}

/// A view's values are data; radiance is shown by the sRGB curve.
fn curve(plan: &Plan) -> Curve {
    if plan.view.is_some() { Curve::Straight } else { Curve::Srgb }
}

/// Whether an error says no more than that the observer stopped the frame.
pub fn was_stopped(error: &Error) -> bool {
    matches!(error, Error::Interrupted)
}
