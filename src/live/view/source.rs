use super::develop::Picture;
use bevy_ecs::prelude::World;
use glam::DVec3;
use pinhole::extract::{camera_entity, eye};
use pinhole::film::{FileAttributes, Film, History};
use pinhole::plan::{Census, Plan, Stage};
use pinhole::rasterise::Projection;
use pinhole::rays::Tile;
use pinhole::render::{Execution, Lap, RenderInProgress, Watch, samples_after, steps_of};
use pinhole::scene::Resolution;
use pinhole::{Error, Result};
use std::time::{Duration, Instant};

/// Where frames come from: one render at a time, which a change of the scene replaces.
#[derive(Default)]
pub struct FrameSource {
    render: Option<RenderInProgress>,
    /// The pixels of the frame that it was begun with, which decided how many workers it has.
    begun_with: u64,
    laps: Vec<Lap>,
    /// What the frame before the last change has gathered, and what the last frame has.
    gathered: [Option<Gathered>; 2],
    /// How each render is executed.
    execution: Execution,
}

/// Radiance with its surfaces, and where it was seen from.
struct Gathered {
    history: History,
    projection: Projection,
    eye: DVec3,
}

impl Gathered {
    /// What a film has, in the memory of what is no longer needed; none if the camera does not project, or the layers
    /// that it needs are not kept.
    fn of(film: &Film, scene: &Census<'_>, spare: Option<Self>) -> Option<Self> {
        let projection = *scene.table::<Projection>().ok()?;
        let history = History::in_place_of(spare.map(|own| own.history), film)?;
        Some(Self { history, projection, eye: eye(scene).ok()? })
    }

    /// With what an earlier frame knows of the same surfaces.
    fn with_earlier(self, Self { history, projection, eye }: &Self) -> Self {
        Self { history: self.history.with_earlier(history, projection, *eye), ..self }
    }
}

/// The samples of its own up to which a frame has those of earlier frames beside them.
const MAX_BESIDE: u32 = 16;

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
    /// Whether a frame takes over what earlier ones know of the same surfaces.
    pub gathers: bool,
    /// The pixels that take further samples than their first, from left and top to right and bottom; none for all.
    pub region: Option<[u32; 4]>,
}

impl Shot<'_> {
    fn is_refined(&self, tile: &Tile) -> bool {
        self.region.is_none_or(|[left, top, right, bottom]| {
            tile.x < right && tile.y < bottom && tile.x + tile.width > left && tile.y + tile.height > top
        })
    }
}

/// How far a picture is.
pub struct Progress<'r> {
    /// The plan that it is rendered by.
    pub plan: &'r Plan,
    /// The samples of each pixel so far, and those that the camera asks for.
    pub samples: [u32; 2],
    /// What each kept stage took since the last frame, summed over the workers.
    pub laps: Vec<Lap>,
    /// How long the stages ran, from the first tile to the last.
    pub time: Duration,
}

impl FrameSource {
    /// One whose renders are executed so.
    pub fn new(execution: Execution) -> Self {
        Self { execution, ..Self::default() }
    }

    /// The next frame of a scene: its first samples, or what further samples make of the last frame.
    ///
    /// Errors: an invalid scene, no plan, or that the observer stopped it; the samples so far are then kept.
    pub fn film(&mut self, shot: &Shot<'_>, watch: &dyn Watch) -> Result<Progress<'_>> {
        let scene = || Census::of(shot.scene);
        if shot.changed {
            self.laps.clear();
        }
        let size = shot.scene.get::<Resolution>(camera_entity(shot.scene)?).copied().unwrap_or_default();
        let pixels = u64::from(size.width) * u64::from(size.height);
        // A larger frame may be worth more workers.
        let kept = self.render.take().filter(|_| !(shot.changed && pixels > self.begun_with));
        let begun = match kept {
            None => {
                self.laps.clear();
                self.begun_with = pixels;
                RenderInProgress::begin(&scene(), shot.offer, &self.execution)?
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
        let refined = render.film.tiles.iter().zip(&render.film.done).filter(|(own, _)| shot.is_refined(&own.tile));
        let mut step = refined.map(|(_, &done)| done).min().unwrap_or(0).max(steps_of(1) - 1);
        while step < last {
            step += 1;
            // Where nothing is to be refined, a tile is taken to have had all of its steps.
            let mut kept = Vec::new();
            if step > steps_of(1) && shot.region.is_some() {
                for (at, _) in render.film.tiles.iter().enumerate().filter(|(_, own)| !shot.is_refined(&own.tile)) {
                    kept.push((at, std::mem::replace(&mut render.film.done[at], u32::MAX)));
                }
            }
            let advanced = render.advance(step, watch);
            kept.into_iter().for_each(|(at, done)| render.film.done[at] = done);
            advanced?;
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
        let [earlier, last] = &mut self.gathered;
        let spare = if shot.changed { std::mem::replace(earlier, last.take()) } else { last.take() };
        let gathers = shot.gathers && render.plan.view.is_none();
        let own = if gathers { Gathered::of(&render.film, &scene(), spare) } else { None };
        // Once the camera has rested for a while, its own samples are enough, and have no bias.
        let earlier = self.gathered[0].as_ref().filter(|_| samples[0] <= MAX_BESIDE);
        self.gathered[1] = own.map(|own| match earlier {
            Some(earlier) => own.with_earlier(earlier),
            None => own,
        });
        Ok(Progress { plan: &render.plan, samples, laps, time: render.time() - before })
    }

    /// Forgets what earlier frames have gathered, since the scene is another.
    pub fn forget(&mut self) {
        self.gathered = [None, None];
    }

    /// The film so far, if there is one; with levels, through so many of the denoiser where the frame gathers what it
    /// needs.
    pub fn picture(&self, levels: u32) -> Option<Picture<'_>> {
        let render = self.render.as_ref()?;
        let gathered = self.gathered[1].as_ref().filter(|_| levels > 0);
        let denoised = gathered.map(|gathered| denoised(&gathered.history, levels));
        Some(Picture { film: &render.film, denoised, curve: render.curve })
    }

    /// What the picture's file says beside its pixels.
    pub fn attributes(&self) -> FileAttributes {
        self.render.as_ref().map(|render| render.attributes.clone()).unwrap_or_default()
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
}

/// The radiance that a frame has gathered, smoothed in so many levels.
///
/// Four times the samples have a quarter of the variance, and need a level less to hide it: the bias goes with it.
fn denoised(gathered: &History, levels: u32) -> [Vec<f32>; 3] {
    let samples = gathered.mean_samples().max(1.0) as u32;
    gathered.denoised(levels.saturating_sub(samples.ilog2() / 2))
}

/// Whether an error says no more than that the observer stopped the frame.
pub fn was_stopped(error: &Error) -> bool {
    matches!(error, Error::Interrupted)
}
