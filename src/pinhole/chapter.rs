use crate::extract::camera_entity;
use crate::look::view_stage;
use crate::plan::{Column, Stage};
use crate::scene::{Adaptive, Filter, Layers, OPEN_END, Resolution, Sampler, Sampling, Statistics, View};
use crate::stages;
use bevy_ecs::prelude::*;

/// A chapter of the book: a scene and the stages taught so far; the scene picks from them.
#[derive(Clone)]
pub struct Chapter {
    /// The stem that its folder, its page and its example share, such as `05_pinhole`.
    pub name: &'static str,
    /// What it is about, in a few words.
    pub title: &'static str,
    /// Stages on offer.
    pub offer: Vec<Stage>,
    /// The column it shows instead of a picture.
    pub view: Option<&'static str>,
    scene: fn(&mut World),
}

impl Chapter {
    /// A chapter that offers nothing yet.
    pub fn new(name: &'static str, title: &'static str, scene: fn(&mut World)) -> Self {
        Self { name, title, scene, offer: Vec::new(), view: None }
    }

    /// Offers a stage, or several.
    pub fn offer(mut self, stages: impl IntoIterator<Item = Stage>) -> Self {
        self.offer.extend(stages);
        self
    }

    /// Shows a column instead of a picture, unless the reader asks for another.
    pub fn show<C: Column>(mut self) -> Self {
        self.view = Some(C::NAME);
        self
    }

    /// The stages on offer, with those that every chapter has: samples, painting a view, and the film.
    ///
    /// They stand in the order of [`stages`](crate::stages), whichever was offered first.
    pub fn stages(&self) -> Vec<Stage> {
        let mut offer = self.offer.clone();
        for own in stages::samples().into_iter().chain(stages::film()) {
            if !offer.contains(&own) {
                offer.push(own);
            }
        }
        offer.push(view_stage(&self.offer));
        stages::sort(&mut offer);
        offer
    }

    /// The chapter's scene, with what a reader asks of it.
    pub fn world(&self, asked: &Overrides) -> World {
        let mut world = World::new();
        (self.scene)(&mut world);
        let view = asked.view.clone().or(self.view.map(String::from));
        Overrides { view, ..asked.clone() }.put_on_camera(&mut world);
        world
    }
}

/// What a reader may change about a chapter's scene from the command line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overrides {
    /// Another number of pixels.
    pub resolution: Option<Resolution>,
    /// Another number of pixels, which may be measured by the one that the scene has.
    pub size: Option<Size>,
    /// A column to be painted.
    pub view: Option<String>,
    /// Whether stages are timed and counted.
    pub statistics: bool,
    /// How pixels are sampled.
    pub sampling: SamplingOverrides,
    /// Whether samples go on for as long as there is time, where their number is not asked for.
    pub endless: bool,
    /// The error that each pixel is to have.
    pub error: Option<f64>,
    /// What else to keep of every pixel.
    pub layers: Option<Layers>,
}

/// How many pixels a reader asks for, outright or measured by what the scene has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Size {
    /// So many.
    Pixels(Resolution),
    /// So many from left to right; the scene's shape says how many from top to bottom.
    Width(u32),
    /// So many from top to bottom; the scene's shape says how many from left to right.
    Height(u32),
    /// So many for every hundred of the scene's, each way.
    Percent(f64),
}

impl Size {
    /// What it makes of the number of pixels that a scene has.
    pub fn of(self, own: Resolution) -> Resolution {
        let [width, height] = [own.width, own.height].map(f64::from);
        let whole = |pixels: f64| (pixels.round() as u32).max(1);
        match self {
            Self::Pixels(resolution) => resolution,
            Self::Width(asked) => Resolution { width: asked, height: whole(f64::from(asked) * height / width) },
            Self::Height(asked) => Resolution { width: whole(f64::from(asked) * width / height), height: asked },
            Self::Percent(percent) => {
                Resolution { width: whole(width * percent / 100.0), height: whole(height * percent / 100.0) }
            }
        }
    }
}

/// What a reader may change about a camera's [`Sampling`]; where any of it is asked for, a camera without it gets the
/// default and then what is asked.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SamplingOverrides {
    /// Samples a pixel.
    pub samples: Option<u32>,
    /// Another seed.
    pub seed: Option<u64>,
    /// Where the random numbers come from.
    pub sampler: Option<Sampler>,
    /// What a sample counts for.
    pub filter: Option<Filter>,
}

impl SamplingOverrides {
    /// What it makes of a camera's sampling; nothing where nothing is asked.
    pub fn of(&self, own: Option<&Sampling>) -> Option<Sampling> {
        let Sampling { samples, seed, sampler, filter } = own.copied().unwrap_or_default();
        (*self != Self::default()).then(|| Sampling {
            samples: self.samples.unwrap_or(samples),
            seed: self.seed.unwrap_or(seed),
            sampler: self.sampler.unwrap_or(sampler),
            filter: self.filter.unwrap_or(filter),
        })
    }
}

impl Overrides {
    /// Whether another number of pixels is asked for.
    pub fn names_pixels(&self) -> bool {
        self.resolution.is_some() || self.size.is_some()
    }

    /// Puts what is asked onto a scene's camera, if it has one.
    pub fn put_on_camera(&self, world: &mut World) {
        let Ok(camera) = camera_entity(world) else { return };
        let mut camera = world.entity_mut(camera);
        if let Some(resolution) = self.resolution {
            camera.insert(resolution);
        }
        if let Some(size) = self.size {
            let own = camera.get::<Resolution>().copied().unwrap_or_default();
            camera.insert(size.of(own));
        }
        if let Some(column) = self.view.clone() {
            camera.insert(View { column });
        }
        let mut asked = self.sampling;
        if self.endless || self.error.is_some() {
            asked.samples = asked.samples.or(Some(OPEN_END));
        }
        if let Some(sampling) = asked.of(camera.get::<Sampling>()) {
            camera.insert(sampling);
        }
        if let Some(error) = self.error {
            let adaptive = camera.get::<Adaptive>().copied().unwrap_or_default();
            camera.insert(Adaptive { error, ..adaptive });
        }
        if let Some(layers) = self.layers.clone() {
            camera.insert(layers);
        }
        if self.statistics {
            camera.insert(Statistics);
        }
    }
}

impl IntoIterator for Stage {
    type Item = Self;
    type IntoIter = std::iter::Once<Self>;

    /// One stage, so that `offer` takes one or many.
    fn into_iter(self) -> Self::IntoIter {
        std::iter::once(self)
    }
}
