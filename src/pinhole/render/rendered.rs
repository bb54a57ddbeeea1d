use super::clock::Lap;
use super::{Execution, Limits, RenderInProgress, Watch, render_in_passes};
use crate::extract::adaptive_of;
use crate::film::{Curve, Film};
use crate::plan::{Census, Plan, Stage};
use crate::{Error, Result};
use bevy_ecs::prelude::*;
use std::time::Duration;

/// What a render leaves.
pub struct Rendered {
    /// What ran and what did not.
    pub plan: Plan,
    /// The light that arrived.
    pub film: Film,
    /// A lap a kept stage, summed over workers; empty where no statistics were asked for.
    pub laps: Vec<Lap>,
    /// Workers.
    pub threads: usize,
    /// From the first tile to the last.
    pub time: Duration,
    /// Bytes that the tables take.
    pub table_bytes: usize,
}

impl Rendered {
    /// How the film becomes a picture: light by the sRGB curve, a view's numbers as they are.
    pub fn curve(&self) -> Curve {
        if self.plan.view.is_some() { Curve::Straight } else { Curve::Srgb }
    }
}

/// Renders a scene by the stages on offer that it needs.
///
/// Errors: a refused scene, no plan, or a stop by the one who watches.
pub fn render(scene: &World, offer: &[Stage], execution: &Execution, watch: &dyn Watch) -> Result<Rendered> {
    let scene = &Census::of(scene);
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
