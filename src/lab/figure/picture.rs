use crate::png_url;
use bevy_ecs::prelude::*;
use pinhole::extract::camera_entity;
use pinhole::film::{Curve, Film, byte_from_linear, png_bytes, png_bytes_by};
use pinhole::plan::{Stage, TileSystems};
use pinhole::render::{Execution, Rendered, render};
use pinhole::scene::{Integrator, Resolution, Sampling};
use pinhole::{Chapter, Overrides};
use pinhole::{Result, stages};
use std::cell::Cell;

thread_local! {
    static MAX_SAMPLES: Cell<u32> = const { Cell::new(u32::MAX) };
}

/// Draws with at most so many samples a pixel of a picture, for who looks at a figure's lines and labels only.
pub fn with_few_samples<T>(max: u32, draw: impl FnOnce() -> T) -> T {
    let before = MAX_SAMPLES.replace(max);
    let drawn = draw();
    MAX_SAMPLES.set(before);
    drawn
}

/// So many samples, or renders, or fewer for who looks at a figure's lines and labels only.
pub(super) fn few(count: u32) -> u32 {
    count.min(MAX_SAMPLES.get())
}

/// A picture of a chapter's scene, within a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels from left to right and from top to bottom.
    pub size: [u32; 2],
    /// The PNG as a URL that holds it.
    pub url: String,
}

impl Picture {
    /// Renders a chapter's scene with all stages that pinhole has, after `change` has had its camera.
    ///
    /// `instead` takes the place of the stages that stand where it stands in the order.
    /// Errors: what a render of that scene would be refused for.
    pub fn of(
        chapter: &Chapter,
        size: [u32; 2],
        instead: Option<Stage>,
        change: impl FnOnce(&mut EntityWorldMut<'_>),
    ) -> Result<Self> {
        let mut whole = all_stages(chapter);
        if let Some(stage) = instead {
            whole.offer.retain(|other| other.set != stage.set);
            whole.offer.push(stage);
        }
        let rendered = rendered(chapter, &whole, size, change)?;
        Ok(Self { size, url: png_url(&png_bytes(&rendered.film, rendered.curve())?) })
    }

    /// The same with a stage in the place of the one whose system it had.
    ///
    /// Errors: what a render of that scene would be refused for.
    pub fn replacing(
        chapter: &Chapter,
        size: [u32; 2],
        stage: Option<Stage>,
        change: impl FnOnce(&mut EntityWorldMut<'_>),
    ) -> Result<Self> {
        let mut whole = all_stages(chapter);
        for own in &mut whole.offer {
            if let Some(stage) = stage.as_ref().filter(|stage| *stage == own) {
                *own = stage.clone();
            }
        }
        let rendered = rendered(chapter, &whole, size, change)?;
        Ok(Self { size, url: png_url(&png_bytes(&rendered.film, rendered.curve())?) })
    }

    /// The same with one stage more.
    ///
    /// Errors: what a render of that scene would be refused for.
    pub fn beside(
        chapter: &Chapter,
        size: [u32; 2],
        beside: Option<Stage>,
        change: impl FnOnce(&mut EntityWorldMut<'_>),
    ) -> Result<Self> {
        let mut whole = all_stages(chapter);
        whole.offer.extend(beside);
        let rendered = rendered(chapter, &whole, size, change)?;
        Ok(Self { size, url: png_url(&png_bytes(&rendered.film, rendered.curve())?) })
    }

    /// The same without another stage, each byte encoded for the screen twice: what is shown is encoded light, taken for
    /// light.
    ///
    /// Errors: what a render of that scene would be refused for.
    pub fn encoded_twice(
        chapter: &Chapter,
        size: [u32; 2],
        change: impl FnOnce(&mut EntityWorldMut<'_>),
    ) -> Result<Self> {
        let rendered = rendered(chapter, &all_stages(chapter), size, change)?;
        let curve = rendered.curve();
        let twice = |light: f32| byte_from_linear(f32::from(byte_from_linear(light, curve)) / 255.0, curve);
        Ok(Self { size, url: png_url(&png_bytes_by(&rendered.film, curve, twice)?) })
    }

    /// A picture of these pixels, linear Rec. 709, row by row.
    ///
    /// Errors: the picture could not be encoded.
    pub fn painted(size: [u32; 2], pixels: &[[f32; 3]]) -> Result<Self> {
        let [width, height] = size;
        let mut film = Film::new(width, height, width.max(height).max(1));
        for (row, &radiance) in pixels.iter().enumerate() {
            film.tiles.iter_mut().for_each(|tile| tile.add(row, radiance));
        }
        Ok(Self { size, url: png_url(&png_bytes(&film, Curve::Srgb)?) })
    }
}

/// The chapter with every stage that pinhole has.
fn all_stages(chapter: &Chapter) -> Chapter {
    let mut whole = chapter.clone();
    whole.view = None;
    whole.offer = stages::all();
    whole
}

/// A chapter's scene, rendered by the stages of `whole` after `change` has had its camera.
///
/// Where the chapter follows no light from surface to surface, neither does its figure, which would otherwise be lit by
/// the sky, with few samples.
fn rendered(
    chapter: &Chapter,
    whole: &Chapter,
    size: [u32; 2],
    change: impl FnOnce(&mut EntityWorldMut<'_>),
) -> Result<Rendered> {
    let [width, height] = size;
    let asked = Overrides { resolution: Some(Resolution { width, height }), ..Overrides::default() };
    let mut scene = whole.world(&asked);
    let camera = camera_entity(&scene)?;
    let follows = chapter.offer.iter().any(|stage| stage.set == TileSystems::RemainingBounces);
    if !follows && !scene.entity(camera).contains::<Integrator>() {
        scene.entity_mut(camera).insert(Integrator::RayCasting);
    }
    // A picture in a figure is small.
    at_most(&mut scene, camera, SAMPLES);
    change(&mut scene.entity_mut(camera));
    at_most(&mut scene, camera, MAX_SAMPLES.get());
    render(&scene, &whole.stages(), &Execution::default(), &())
}

/// The samples a pixel of a figure's picture, unless the figure asks for others.
const SAMPLES: u32 = 16;

fn at_most(scene: &mut World, camera: Entity, samples: u32) {
    if let Some(mut sampling) = scene.get_mut::<Sampling>(camera) {
        sampling.samples = sampling.samples.min(samples);
    }
}
