//! Mutations: bugs made on purpose, at every stage from raster to picture, to see that a review names that very stage.
//!
//! Each stands in for a mistake that someone has made: a sign, half a pixel, a tangent of the wrong angle.
//! No source changes: the stage's system is exchanged, or its numbers are spoilt right after it ran.

mod hits;
mod light;
mod moving;
mod rays;
mod shapes;
mod table;
mod textures;

pub use table::MUTATIONS;

use super::{DEVELOP, Develop, SNAPSHOT_SIZE, Snapshots};
use bevy_ecs::prelude::*;
use bevy_ecs::schedule::ScheduleConfigs;
use bevy_ecs::system::ScheduleSystem;
use pinhole::Chapter;
use pinhole::film::byte_from_linear;
use pinhole::plan::{Census, Stage};
use pinhole::{Error, Overrides, Result};
use std::sync::Arc;

/// A mutation: a bug made on purpose.
#[derive(Clone, Copy, Debug)]
pub struct Mutation {
    /// The word that `review --mutate` takes.
    pub name: &'static str,
    /// The stage that a review must name; none for the development of the film, which is no stage.
    at: Option<fn() -> Stage>,
    /// The mistake, in a few words.
    pub mistake: &'static str,
    /// A chapter whose picture runs that stage.
    pub chapter: &'static str,
    bug: Bug,
}

/// Makes a system as a configuration.
type Make = fn() -> ScheduleConfigs<ScheduleSystem>;

#[derive(Clone, Copy, Debug)]
enum Bug {
    /// Spoils what the stage wrote.
    After(Make),
    /// Runs instead of the stage.
    Instead(Make),
    /// Develops the film otherwise.
    Develop(Develop),
}

impl Mutation {
    /// The name of the stage that a review must name.
    pub fn stage(&self) -> &'static str {
        self.at.map_or(DEVELOP, |stage| stage().name)
    }

    /// The bug of a name.
    ///
    /// Errors: no such name; the nearest is told.
    pub fn named(name: &str) -> Result<&'static Self> {
        let likeness = |mutation: &&Self| (strsim::jaro_winkler(mutation.name, name) * 1e6) as u64;
        MUTATIONS.iter().find(|mutation| mutation.name == name).ok_or_else(|| {
            let nearest = MUTATIONS.iter().max_by_key(likeness).map_or("half-pixel", |mutation| mutation.name);
            Error::Usage(format!(
                "there is no mutation \"{name}\"; the nearest is {nearest}, \
                 and `review --mutate all` shows all"
            ))
        })
    }

    /// What a chapter computes with the bug in it.
    ///
    /// Errors: a chapter whose picture does not run the stage; what a render would be refused for.
    pub fn snapshots(&self, chapter: &Chapter) -> Result<Snapshots> {
        let stages = chapter.stages();
        if let Some(stage) = self.at.map(|stage| stage())
            && !runs(chapter, &stages, &stage)?
        {
            return Err(Error::Usage(format!(
                "{} does not run \"{}\", where {} belongs; {} does",
                chapter.name, stage.name, self.name, self.chapter
            )));
        }
        let develop = if let Bug::Develop(develop) = self.bug { develop } else { byte_from_linear };
        let stages: Vec<Stage> = stages.into_iter().map(|stage| self.mutated_in(stage)).collect();
        Snapshots::with_stages(chapter, &stages, develop)
    }

    fn mutated_in(&self, mut stage: Stage) -> Stage {
        if self.at.is_none_or(|mutated| !stage.is(mutated)) {
            return stage;
        }
        match self.bug {
            Bug::After(spoil) => {
                let right = stage.system;
                stage.system = Arc::new(move || (right(), spoil()).chain());
            }
            Bug::Instead(wrong) => stage.system = Arc::new(wrong),
            Bug::Develop(_) => {}
        }
        stage
    }
}

fn runs(chapter: &Chapter, stages: &[Stage], wanted: &Stage) -> Result<bool> {
    let world = chapter.world(&Overrides { resolution: Some(SNAPSHOT_SIZE), ..Overrides::default() });
    let plan = pinhole::plan::plan(&Census::of(&world), stages)?;
    Ok(plan.stages.contains(wanted))
}
