use bevy_ecs::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// The conditions on which tracing is abandoned although rays are left; checked before every bounce of a tile, never
/// for a single ray.
///
/// A path may have four billion bounces, so a render must be able to stop before it ends.
/// An abandoned run has not summed all of its light, so none of it may be added to the film.
#[derive(Resource, Clone, Debug, Default)]
pub struct Stop {
    /// A flag that another thread sets to stop the run.
    pub flag: Option<Arc<AtomicBool>>,
    /// The time after which the run is abandoned.
    pub deadline: Option<Instant>,
    /// Whether the current run was abandoned.
    pub given_up: bool,
}

impl Stop {
    /// Stops when the flag is set.
    pub fn at_flag(flag: Option<Arc<AtomicBool>>) -> Self {
        Self { flag, ..Self::default() }
    }

    /// Stops at the deadline.
    pub fn at_deadline(deadline: Instant) -> Self {
        Self { deadline: Some(deadline), ..Self::default() }
    }

    /// Whether the flag is set or the deadline has passed.
    pub fn is_due(&self) -> bool {
        self.flag.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed))
            || self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }

    /// Abandons the run if it is due; returns whether it did.
    pub(super) fn gives_up(&mut self) -> bool {
        self.given_up |= self.is_due();
        self.given_up
    }
}

/// Whether the current run was completed; an abandoned one is not added to the film.
pub fn is_whole(stop: Option<Res<Stop>>) -> bool {
    stop.is_none_or(|stop| !stop.given_up)
}
