use super::Exercise;
use super::ask::Complaint;
use bevy_ecs::prelude::*;
use bevy_ecs::schedule::ScheduleConfigs;
use bevy_ecs::system::ScheduleSystem;
use pinhole::extract::camera_entity;
use pinhole::plan::{Census, Stage, plan};
use pinhole::scene::Resolution;
use pinhole::{Chapter, Error, Result};
use std::sync::Arc;

/// What a stand-in may look at before the render: the chapter, and its scene with what the reader asks of it.
pub struct Setting<'s> {
    /// The chapter.
    pub chapter: &'s Chapter,
    /// Its scene.
    pub scene: &'s World,
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
}

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
            Self::Keep(_) => {}
        }
    }
}

/// A chapter with a reader's function in place of one of pinhole's stages.
pub struct Mine {
    /// The chapter, to be rendered as any other.
    pub chapter: Chapter,
    complaint: Complaint,
}

impl Mine {
    /// The chapter with this exercise's function in it.
    ///
    /// Errors: why no picture shows the function; the stage in which it would stand does not run.
    pub fn of(exercise: &Exercise, chapter: &Chapter, scene: &World) -> Result<Self> {
        let render = exercise.mine.as_ref().map_err(|why| Error::Usage((*why).into()))?;
        let (stand_in, complaint) = render(&Setting { chapter, scene });
        complaint.get().map_or(Ok(()), |sentence| Err(Error::Usage(sentence.clone())))?;
        let (chapter, stage) = stand_in.put_in(chapter);
        if let Some(stage) = stage
            && !plan(&Census::of(scene), &chapter.stages())?.stages.contains(&stage)
        {
            let (function, name) = (exercise.function, stage.name);
            return Err(Error::Usage(format!("{function} stands in \"{name}\", which this render does not run")));
        }
        Ok(Self { chapter, complaint })
    }

    /// What the render has to say against the function, in one sentence.
    ///
    /// Errors: a panic or an answer that no picture can hold: at which pixel, for what, and what came back.
    pub fn answers(&self) -> Result {
        self.complaint.get().map_or(Ok(()), |sentence| Err(Error::Usage(sentence.clone())))
    }
}
