use crate::each::Each;
use crate::extract::{camera_entity, integrator_of};
use crate::look::view_stage;
use crate::plan::{Census, Column, Stage};
use crate::render::{Execution, Rendered, render};
use crate::scene::{
    Adaptive, Exposure, Filter, Layers, OPEN_END, Resolution, Sampler, Sampling, Statistics, ToneMapping, View,
};
use crate::{Result, stages};
use bevy_ecs::prelude::*;
use std::sync::Arc;

/// Renders a scene with whichever of all stages it needs, on all cores.
///
/// Errors: what is wrong with the scene, in one sentence.
///
/// ```
/// use pinhole::prelude::*;
///
/// let mut scene = World::new();
/// scene.spawn((PerspectiveCamera::default(), Resolution { width: 16, height: 9 }));
/// scene.spawn(Background { colour: Rgb::new(0.25, 0.5, 1.0) });
/// let rendered = render_scene(&scene)?;
/// assert_eq!(rendered.film.mean(3, 4), [0.25, 0.5, 1.0]);
/// # Ok::<(), pinhole::Error>(())
/// ```
pub fn render_scene(scene: &World) -> Result<Rendered> {
    render(scene, &every_stage_and([]), &Execution::default(), &())
}

/// All stages of the library, and those that a program adds, of which a plan keeps those that a scene needs.
pub fn every_stage_and(own: impl IntoIterator<Item = Stage>) -> Vec<Stage> {
    Chapter::new("scene", "a scene", |_| ()).offer(stages::all()).offer(own).stages()
}

/// A chapter of the book: a scene, and the stages taught so far, of which the plan keeps those that the scene needs.
///
/// ```
/// use pinhole::prelude::*;
/// use pinhole::stages;
///
/// fn scene(world: &mut World) {
///     world.spawn((PerspectiveCamera::default(), Resolution { width: 32, height: 18 }));
///     world.spawn((Sphere { radius: 1.0 }, Placement::at(0.0, 0.0, -4.0), Matte::default()));
/// }
///
/// let chapter = Chapter::new("my_chapter", "a silhouette", scene)
///     .offer(stages::camera_rays())
///     .offer(stages::intersection())
///     .offer(stages::surfaces())
///     .offer(stages::unlit());
/// let world = chapter.world(&Overrides::default());
/// let plan = pinhole::plan::plan(&Census::of(&world), &chapter.stages())?;
/// assert!(plan.rows.iter().any(|row| row.stage == "Intersect spheres" && row.kept));
/// assert!(plan.rows.iter().any(|row| row.stage == "Intersect planes" && !row.kept));
/// # Ok::<(), pinhole::Error>(())
/// ```
#[derive(Clone)]
pub struct Chapter {
    /// The stem shared by its folder, its page and its example, such as `05_pinhole`.
    pub name: &'static str,
    /// Its title, in a few words.
    pub title: &'static str,
    /// The stages that the plan may choose from.
    pub offer: Vec<Stage>,
    /// The column to paint instead of the picture, by name.
    pub view: Option<&'static str>,
    scene: Arc<dyn Fn(&mut World) + Send + Sync>,
}

impl Chapter {
    /// A chapter that offers no stages yet.
    pub fn new(name: &'static str, title: &'static str, scene: fn(&mut World)) -> Self {
        Self { name, title, scene: Arc::new(scene), offer: Vec::new(), view: None }
    }

    /// The same stages for another scene.
    pub fn with_scene(self, scene: impl Fn(&mut World) + Send + Sync + 'static) -> Self {
        Self { scene: Arc::new(scene), ..self }
    }

    /// Offers one stage or several.
    pub fn offer(mut self, stages: impl IntoIterator<Item = Stage>) -> Self {
        self.offer.extend(stages);
        self
    }

    /// Paints a column instead of the picture, unless the overrides name another one.
    pub fn show<C: Column>(mut self) -> Self {
        self.view = Some(C::NAME);
        self
    }

    /// The stages offered, with those that every chapter has: samples, painting a view, and the film.
    ///
    /// They stand in the order of [`stages`], whichever was offered first.
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

    /// The chapter's scene with the overrides applied to its camera.
    ///
    /// The sky illuminates what a path finds it from; in a chapter that offers no path continuation it is only seen,
    /// and the camera of such a scene says so by naming its integrator.
    pub fn world(&self, overrides: &Overrides) -> World {
        let mut world = World::new();
        (self.scene)(&mut world);
        if !stages::path_continuation().iter().any(|stage| self.offer.contains(stage)) {
            name_integrator_without_sky(&mut world);
        }
        let view = overrides.view.clone().or(self.view.map(String::from));
        Overrides { view, ..overrides.clone() }.put_on_camera(&mut world);
        world
    }
}

/// Names the integrator that the scene would have in front of a black sky, where the sky alone makes the difference.
fn name_integrator_without_sky(world: &mut World) {
    let Some(integrator) = integrator_of(&Census::of(world)).without_sky else { return };
    if let Ok(camera) = camera_entity(world) {
        world.entity_mut(camera).insert(integrator);
    }
}

/// What the command line may override in a scene; everything that is `None` or false leaves the scene as it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overrides {
    /// The number of pixels, outright.
    pub resolution: Option<Resolution>,
    /// The number of pixels, possibly relative to the scene's own.
    pub size: Option<Size>,
    /// The column to paint instead of the picture, by name.
    pub view: Option<String>,
    /// Whether stages are timed and counted.
    pub statistics: bool,
    /// How pixels are sampled.
    pub sampling: SamplingOverrides,
    /// Whether, if no number of samples is given, sampling continues until time runs out.
    pub endless: bool,
    /// The target error of each pixel, as in [`Adaptive`].
    pub error: Option<f64>,
    /// The layers to keep beside radiance.
    pub layers: Option<Layers>,
    /// The exposure of the picture.
    pub exposure: Option<Exposure>,
    /// The tone mapping of the picture.
    pub tone_mapping: Option<ToneMapping>,
}

/// The size of an image in pixels, outright or relative to the scene's own [`Resolution`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Size {
    /// Exactly this size.
    Pixels(Resolution),
    /// This width; the height follows from the scene's aspect ratio.
    Width(u32),
    /// This height; the width follows from the scene's aspect ratio.
    Height(u32),
    /// This percentage of the scene's width and of its height.
    Percent(f64),
}

impl Size {
    /// The resolution that results for a scene whose own is given; each side is rounded to a whole number of at least
    /// 1.
    pub fn of(self, own: Resolution) -> Resolution {
        let [width, height] = [own.width, own.height].each(f64::from);
        let whole = |pixels: f64| (pixels.round() as u32).max(1);
        match self {
            Self::Pixels(resolution) => resolution,
            Self::Width(pixels) => Resolution { width: pixels, height: whole(f64::from(pixels) * height / width) },
            Self::Height(pixels) => Resolution { width: whole(f64::from(pixels) * width / height), height: pixels },
            Self::Percent(percent) => {
                Resolution { width: whole(width * percent / 100.0), height: whole(height * percent / 100.0) }
            }
        }
    }
}

/// What the command line may override in a camera's [`Sampling`].
///
/// A camera without that component gets the default with the overrides applied, as soon as there is one of them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SamplingOverrides {
    /// Samples per pixel.
    pub samples: Option<u32>,
    /// The seed of the random numbers.
    pub seed: Option<u64>,
    /// The sampler.
    pub sampler: Option<Sampler>,
    /// The reconstruction filter.
    pub filter: Option<Filter>,
}

impl SamplingOverrides {
    /// The camera's sampling with the overrides applied; `None` if there are none.
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
    /// Whether the number of pixels is overridden.
    pub fn sets_resolution(&self) -> bool {
        self.resolution.is_some() || self.size.is_some()
    }

    /// Applies the overrides to a scene's camera, if it has one.
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
        let mut sampling = self.sampling;
        if self.endless || self.error.is_some() {
            sampling.samples = sampling.samples.or(Some(OPEN_END));
        }
        if let Some(sampling) = sampling.of(camera.get::<Sampling>()) {
            camera.insert(sampling);
        }
        if let Some(error) = self.error {
            let adaptive = camera.get::<Adaptive>().copied().unwrap_or_default();
            camera.insert(Adaptive { error, ..adaptive });
        }
        if let Some(layers) = self.layers.clone() {
            camera.insert(layers);
        }
        if let Some(exposure) = self.exposure {
            camera.insert(exposure);
        }
        if let Some(tone_mapping) = self.tone_mapping {
            camera.insert(tone_mapping);
        }
        if self.statistics {
            camera.insert(Statistics);
        }
    }
}

impl IntoIterator for Stage {
    type Item = Self;
    type IntoIter = std::iter::Once<Self>;

    /// Yields the one stage, so that `offer` takes one or many.
    fn into_iter(self) -> Self::IntoIter {
        std::iter::once(self)
    }
}
