use super::clock::Lap;
use super::{Execution, Limits, RenderInProgress, Watch, render_in_passes};
use crate::extract::adaptive_of;
use crate::film::{Curve, Film};
use crate::plan::{Plan, Stage};
use crate::{Error, Result};
use bevy_ecs::prelude::*;
use std::time::Duration;

/// The result of a render.
pub struct Rendered {
    /// The stages that ran, and those that did not.
    pub plan: Plan,
    /// The accumulated radiance.
    pub film: Film,
    /// One lap per kept stage, summed over workers; empty where no statistics were requested.
    pub laps: Vec<Lap>,
    /// The number of workers.
    pub threads: usize,
    /// Elapsed time from the first tile to the last.
    pub time: Duration,
    /// Memory of the tables, in bytes.
    pub table_bytes: usize,
}

impl Rendered {
    /// The curve that turns the film into a picture: sRGB for radiance, the identity for a view's values.
    pub fn curve(&self) -> Curve {
        if self.plan.view.is_some() { Curve::Straight } else { Curve::Srgb }
    }
}

/// Renders a scene with those of the stages on offer that it needs.
///
/// Errors: an invalid scene, a plan that cannot be made, or an observer that stopped the render.
pub fn render(scene: &World, offer: &[Stage], execution: &Execution, watch: &dyn Watch) -> Result<Rendered> {
    let mut in_progress = RenderInProgress::begin(scene, offer, execution)?;
    match adaptive_of(scene)? {
        None => in_progress.advance(in_progress.steps(), watch)?,
        adaptive => {
            let limits = Limits { adaptive, ..Limits::default() };
            if render_in_passes(&mut in_progress, &limits, watch, &mut |_| Ok(()))?.stopped {
                return Err(Error::Interrupted);
            }
        }
    }
    Ok(in_progress.finish())
}
