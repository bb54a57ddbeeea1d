use bevy_ecs::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// When to give up following light although rays are left; asked before every bounce of a tile, never for a ray.
///
/// A path may have four thousand million bounces, so whoever waits for it needs an answer before it ends.
/// A run that is given up has not gathered all of its light: nothing of it may join the film.
#[derive(Resource, Clone, Debug, Default)]
pub struct Stop {
    /// Set by someone else once nobody waits any longer.
    pub flag: Option<Arc<AtomicBool>>,
    /// The moment after which nobody waits any longer.
    pub deadline: Option<Instant>,
    /// Whether the run under way has been given up.
    pub given_up: bool,
}

impl Stop {
    /// One that looks at a flag.
    pub fn at_flag(flag: Option<Arc<AtomicBool>>) -> Self {
        Self { flag, ..Self::default() }
    }

    /// One that looks at the clock.
    pub fn at_deadline(deadline: Instant) -> Self {
        Self { deadline: Some(deadline), ..Self::default() }
    }

    /// Whether the time has come.
    pub fn is_due(&self) -> bool {
        self.flag.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed))
            || self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }

    /// Gives the run up if the time has come; whether it did.
    pub(super) fn gives_up(&mut self) -> bool {
        self.given_up |= self.is_due();
        self.given_up
    }
}

/// Whether the run under way has all of its light so far: without this nothing joins the film.
pub fn is_whole(stop: Option<Res<Stop>>) -> bool {
    stop.is_none_or(|stop| !stop.given_up)
}
