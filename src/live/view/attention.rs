//! When a frame in progress is given up: for an order, or since nobody looks at the page any more.

use pinhole::render::Watch;
use std::io;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Weak};
use std::thread::{Builder, sleep};
use std::time::{Duration, Instant};

/// How long an order waits for the frame of a camera that moves, which is to be seen before the next movement.
pub const LONGEST_FRAME: Duration = Duration::from_millis(1000);
/// How long after a page's last request it is taken to be closed; an open one asks for a frame every few seconds.
pub const CLOSED_AFTER: Duration = Duration::from_secs(10);
/// How often someone looks whether either has come.
const LOOK_AGAIN: Duration = Duration::from_millis(100);

/// What has been asked of the viewer and not been answered yet, and when a page was last heard of.
pub struct Attention {
    since: Instant,
    /// Whether there is an order.
    order: Arc<AtomicBool>,
    /// When the first of those that wait came, in milliseconds from the start; [`NEVER`] if none waits.
    came: AtomicU64,
    /// Whether a frame is to be given up even if the camera moves.
    overdue: Arc<AtomicBool>,
    /// When a page was last heard of, in milliseconds from the start.
    looked: AtomicU64,
}

const NEVER: u64 = u64::MAX;

impl Default for Attention {
    fn default() -> Self {
        Self {
            since: Instant::now(),
            order: Arc::default(),
            came: AtomicU64::new(NEVER),
            overdue: Arc::default(),
            looked: AtomicU64::new(0),
        }
    }
}

impl Attention {
    fn now(&self) -> u64 {
        self.since.elapsed().as_millis() as u64
    }

    /// An order has come.
    pub fn order(&self) {
        let _ = self.came.compare_exchange(NEVER, self.now(), Ordering::SeqCst, Ordering::SeqCst);
        self.order.store(true, Ordering::SeqCst);
    }

    /// The viewer takes the orders that have come.
    pub fn taken(&self) {
        self.came.store(NEVER, Ordering::SeqCst);
        self.order.store(false, Ordering::SeqCst);
        self.overdue.store(false, Ordering::SeqCst);
    }

    /// A page was heard of.
    pub fn looked(&self) {
        self.looked.store(self.now(), Ordering::SeqCst);
    }

    /// Whether a page is open.
    pub fn is_looked_at(&self) -> bool {
        let since = self.now().saturating_sub(self.looked.load(Ordering::SeqCst));
        Duration::from_millis(since) < CLOSED_AFTER
    }

    /// Stops a frame for any order, or, where the camera moves, for one that has waited long; and once no page is open.
    pub fn watch(&self, moving: bool) -> UntilWanted {
        UntilWanted(Arc::clone(if moving { &self.overdue } else { &self.order }))
    }

    fn look(&self) {
        let came = self.came.load(Ordering::SeqCst);
        let waits_long = came != NEVER && self.now().saturating_sub(came) >= LONGEST_FRAME.as_millis() as u64;
        if waits_long || !self.is_looked_at() {
            self.overdue.store(true, Ordering::SeqCst);
            self.order.store(true, Ordering::SeqCst);
        }
    }
}

/// Looks many times a second, for as long as anyone has the attention.
///
/// Errors: the system starts no thread.
pub fn keep(attention: &Arc<Attention>) -> io::Result<()> {
    let attention: Weak<Attention> = Arc::downgrade(attention);
    Builder::new().name("attention".to_owned()).spawn(move || {
        while let Some(attention) = attention.upgrade() {
            attention.look();
            drop(attention);
            sleep(LOOK_AGAIN);
        }
    })?;
    Ok(())
}

/// Stops a frame once its flag is set.
pub struct UntilWanted(Arc<AtomicBool>);

impl Watch for UntilWanted {
    fn stopped(&self) -> bool {
        self.0.load(Ordering::SeqCst)
    }

    fn stop_flag(&self) -> Option<Arc<AtomicBool>> {
        Some(Arc::clone(&self.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_order_stops_a_frame_at_once_and_one_of_a_moving_camera_after_a_while() {
        let attention = Attention::default();
        let (resting, moving) = (attention.watch(false), attention.watch(true));
        let stopped = || (resting.stopped(), moving.stopped());
        attention.looked();
        attention.look();
        assert_eq!(stopped(), (false, false));
        attention.order();
        attention.look();
        assert_eq!(stopped(), (true, false));
        sleep(LONGEST_FRAME + Duration::from_millis(20));
        attention.look();
        assert_eq!(stopped(), (true, true));
        attention.taken();
        assert_eq!(stopped(), (false, false));
    }
}
