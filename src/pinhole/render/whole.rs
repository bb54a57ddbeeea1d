use super::{Execution, Limits, RenderInProgress, Rendered, Watch, render_in_passes};
use crate::extract::adaptive_of;
use crate::plan::{Census, Stage};
use crate::{Error, Result};
use bevy_ecs::prelude::*;

/// Renders a scene with those of the stages on offer that it needs.
///
/// Errors: an invalid scene, a plan that cannot be made, or an observer that stopped the render.
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
