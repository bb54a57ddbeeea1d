use super::Exercise;
use super::ask::Complaint;
use bevy_ecs::prelude::*;
use bevy_ecs::schedule::ScheduleConfigs;
use bevy_ecs::system::ScheduleSystem;
use pinhole::extract::camera_entity;
use pinhole::film::{FilmTile, film_stage};
use pinhole::plan::{Census, Column, Stage, plan};
use pinhole::rays::{PixelSamples, RasterPoints};
use pinhole::scene::{Resolution, Sampling};
use pinhole::{Chapter, Error, Overrides, Result, Size};
use std::sync::Arc;

/// What a stand-in may look at before the render: the chapter, and its scene with what the reader asks of it.
pub struct Setting<'s> {
    /// The chapter.
    pub chapter: &'s Chapter,
    /// Its scene.
    pub scene: &'s World,
    /// Which of the exercise's scenes this is; 0 is the chapter's own.
    pub number: usize,
}

impl Setting<'_> {
    /// How many pixels the picture has.
    pub fn resolution(&self) -> Resolution {
        self.camera::<Resolution>().copied().unwrap_or_default()
    }

    /// A component of the camera.
    pub fn camera<C: Component>(&self) -> Option<&C> {
        camera_entity(self.scene).ok().and_then(|camera| self.scene.get::<C>(camera))
    }
}

/// How a function takes its place in a chapter, and where it is told what went wrong.
pub type Render = dyn Fn(&Setting<'_>) -> (StandIn, Complaint) + Send + Sync;

type Make = Arc<dyn Fn() -> ScheduleConfigs<ScheduleSystem> + Send + Sync>;

/// A stage with a reader's function in it, which takes the place of one of pinhole's.
pub struct StandIn {
    /// The stage, where it is one.
    stage: Option<fn() -> Stage>,
    place: Place,
}

enum Place {
    Instead(Make),
    After(Make),
    Keep(Vec<String>),
    Painted([u32; 2], Box<Paint>),
}

/// The colour of a pixel, from 0 to 1.
type Paint = dyn Fn([u32; 2]) -> [f64; 3];

impl StandIn {
    /// A system that runs in place of this stage.
    pub fn instead<M: 'static>(
        stage: fn() -> Stage,
        system: impl IntoScheduleConfigs<ScheduleSystem, M> + Clone + Send + Sync + 'static,
    ) -> Self {
        Self { stage: Some(stage), place: Place::Instead(Arc::new(move || system.clone().into_configs())) }
    }

    /// A system that runs after this stage, and puts the reader's numbers over pinhole's.
    pub fn after<M: 'static>(
        stage: fn() -> Stage,
        system: impl IntoScheduleConfigs<ScheduleSystem, M> + Clone + Send + Sync + 'static,
    ) -> Self {
        Self { stage: Some(stage), place: Place::After(Arc::new(move || system.clone().into_configs())) }
    }

    /// Only the stages of these names are offered, beside what every chapter has.
    pub fn keeping(stages: Vec<String>) -> Self {
        Self { stage: None, place: Place::Keep(stages) }
    }

    /// These pixels in place of the film, line by line of an image of this width; black where there are none.
    pub fn film(pixels: Option<Vec<[f32; 3]>>, width: u32) -> Self {
        let pixels = pixels.unwrap_or_default();
        let system = move |mut tiles: Query<(&RasterPoints, Option<&PixelSamples>, &mut FilmTile)>| {
            for (raster, samples, mut film) in &mut tiles {
                for row in 0..raster.rows() {
                    let pixel = samples.map_or(row, |samples| samples.pixel[row] as usize);
                    let [x, y] = film.tile.pixel_of(pixel);
                    film.add(pixel, pixels.get((y * width + x) as usize).copied().unwrap_or_default());
                }
            }
        };
        Self::instead(film_stage, system)
    }

    /// No render, but a picture of this size that shows what the function answers, pixel by pixel.
    pub fn painted(size: [u32; 2], paint: impl Fn([u32; 2]) -> [f64; 3] + 'static) -> Self {
        Self { stage: None, place: Place::Painted(size, Box::new(paint)) }
    }

    /// The chapter with the stand-in, and the stage that must run for it.
    fn put_in(self, chapter: &Chapter) -> (Chapter, Option<Stage>) {
        let mut chapter = chapter.clone();
        if let Place::Keep(names) = &self.place {
            chapter.offer.retain(|stage| names.iter().any(|name| name == stage.name));
        }
        let Some(mut stage) = self.stage.map(|stage| stage()) else { return (chapter, None) };
        self.place.take(&mut stage);
        if !chapter.offer.contains(&stage) && chapter.stages().contains(&stage) {
            // What every chapter has may be offered as well.
            chapter.offer.push(stage.clone());
        }
        chapter.offer.iter_mut().filter(|own| **own == stage).for_each(|own| own.system = Arc::clone(&stage.system));
        (chapter, Some(stage))
    }
}

impl Place {
    fn take(self, stage: &mut Stage) {
        match self {
            Self::Instead(mine) => stage.system = mine,
            Self::After(mine) => {
                let pinhole = Arc::clone(&stage.system);
                stage.system = Arc::new(move || (pinhole(), mine()).chain());
            }
            Self::Keep(_) | Self::Painted(..) => {}
        }
    }
}

/// Whose function stands in a chapter.
#[derive(Clone, Copy)]
pub enum Whose {
    /// That which says what is right.
    Pinholes,
    /// The reader's.
    Readers,
}

/// A chapter with an exercise's function in place of one of pinhole's stages.
pub struct Mine {
    /// The chapter, to be rendered as any other.
    pub chapter: Chapter,
    complaint: Complaint,
    /// What shows the answers where nothing is rendered.
    painted: Option<Painted>,
}

/// A picture that was painted: its size, and its colours line by line.
pub type Painted = ([u32; 2], Vec<[f32; 3]>);

impl Mine {
    /// The chapter with the reader's function in it.
    ///
    /// Errors: why no picture shows the function; the stage in which it would stand does not run.
    pub fn of(exercise: &Exercise, chapter: &Chapter, scene: &World) -> Result<Self> {
        Self::by(Whose::Readers, exercise, &Setting { chapter, scene, number: 0 })
    }

    /// The same with anybody's function in any of the exercise's scenes.
    ///
    /// Errors: the same.
    pub fn by(whose: Whose, exercise: &Exercise, setting: &Setting<'_>) -> Result<Self> {
        let renders = exercise.mine.as_ref().map_err(|why| Error::Usage((*why).into()))?;
        let (stand_in, complaint) = renders[whose as usize](setting);
        let mut painted = None;
        if let Place::Painted(size @ [width, height], paint) = &stand_in.place {
            let pixels = (0..*height).flat_map(|y| (0..*width).map(move |x| [x, y]));
            painted = Some((*size, pixels.map(|at| paint(at).map(|part| part as f32)).collect()));
        }
        complaint.get().map_or(Ok(()), |sentence| Err(Error::Usage(sentence.clone())))?;
        let (chapter, stage) = stand_in.put_in(setting.chapter);
        if let Some(stage) = stage
            && !plan(&Census::of(setting.scene), &chapter.stages())?.stages.contains(&stage)
        {
            let (function, name) = (exercise.function, stage.name);
            return Err(Error::Usage(format!("{function} stands in \"{name}\", which this render does not run")));
        }
        Ok(Self { chapter, complaint, painted })
    }

    /// What was painted in place of a render.
    pub fn painted(&mut self) -> Option<Painted> {
        self.painted.take()
    }

    /// What the render has to say against the function, in one sentence.
    ///
    /// Errors: a panic or an answer that no picture can hold: at which pixel, for what, and what came back.
    pub fn answers(&self) -> Result {
        self.complaint.get().map_or(Ok(()), |sentence| Err(Error::Usage(sentence.clone())))
    }
}

/// A chapter whose scene is changed before anything else is asked of it.
pub fn edited(chapter: &Chapter, edit: impl Fn(&mut World) + Send + Sync + 'static) -> Chapter {
    let own = chapter.clone();
    let mut chapter = chapter.clone().with_scene(move |world| {
        *world = own.world(&Overrides::default());
        edit(world);
    });
    // By now the camera names the column that the chapter paints, so that an edit may name another.
    chapter.view = None;
    chapter
}

/// Puts components on a scene's camera, in place of those that it has.
pub fn on_camera(world: &mut World, components: impl Bundle) {
    if let Ok(camera) = camera_entity(world) {
        world.entity_mut(camera).insert(components);
    }
}

/// Renders a sampled scene with no more pixels across than this, and no more samples of each.
pub fn at_most(world: &mut World, (width, samples): (u32, u32)) {
    let Ok(camera) = camera_entity(world) else { return };
    let mut camera = world.entity_mut(camera);
    let Some(&sampling) = camera.get::<Sampling>() else { return };
    let own = camera.get::<Resolution>().copied().unwrap_or_default();
    let size = Size::Width(own.width.min(width)).of(own);
    camera.insert((size, Sampling { samples: sampling.samples.min(samples), ..sampling }));
}
