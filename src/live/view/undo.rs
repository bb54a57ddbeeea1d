//! What a reader has done to camera and scene, step by step, to be taken back.

use std::time::{Duration, Instant};

/// The most steps that are remembered.
const STEPS: usize = 100;
/// Changes of one kind that follow each other sooner than this are one step: a drag, or a slider that is moved.
const ONE_STEP: Duration = Duration::from_millis(600);

/// What a step changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// The camera is moved.
    Move,
    /// The text is edited.
    Edit,
    /// Anything that is a step of its own.
    Other,
}

/// The states before each step, and those that were taken back.
pub struct Undo<T> {
    before: Vec<T>,
    after: Vec<T>,
    last: Option<(Step, Instant)>,
}

impl<T> Default for Undo<T> {
    fn default() -> Self {
        Self { before: Vec::new(), after: Vec::new(), last: None }
    }
}

impl<T> Undo<T> {
    /// A step has been taken from this state.
    pub fn took(&mut self, step: Step, from: T) {
        let goes_on = self.last.is_some_and(|(last, when)| last == step && when.elapsed() < ONE_STEP);
        if !goes_on || step == Step::Other || self.before.is_empty() {
            self.before.push(from);
        }
        if self.before.len() > STEPS {
            self.before.remove(0);
        }
        self.after.clear();
        self.last = Some((step, Instant::now()));
    }

    /// The state to go back to from this one.
    pub fn back(&mut self, from: T) -> Option<T> {
        Self::go(&mut self.before, &mut self.after, &mut self.last, from)
    }

    /// The state to go forward to from this one.
    pub fn forward(&mut self, from: T) -> Option<T> {
        Self::go(&mut self.after, &mut self.before, &mut self.last, from)
    }

    fn go(out: &mut Vec<T>, into: &mut Vec<T>, last: &mut Option<(Step, Instant)>, from: T) -> Option<T> {
        let found = out.pop()?;
        into.push(from);
        *last = None;
        Some(found)
    }

    /// How many steps can be taken back, and forward again.
    pub fn steps(&self) -> [usize; 2] {
        [self.before.len(), self.after.len()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drag_is_one_step_and_every_step_leads_back_and_forward() {
        let mut undo = Undo::default();
        (0..5).for_each(|state| undo.took(Step::Move, state));
        undo.took(Step::Edit, 5);
        undo.took(Step::Other, 6);
        undo.took(Step::Other, 7);
        assert_eq!(undo.steps(), [4, 0]);
        let back: Vec<i32> = [8, 7, 6, 5].into_iter().map_while(|now| undo.back(now)).collect();
        assert_eq!((back, undo.back(0)), (vec![7, 6, 5, 0], None));
        let forward: Vec<i32> = [0, 5, 6, 7].into_iter().map_while(|now| undo.forward(now)).collect();
        assert_eq!((forward, undo.steps()), (vec![5, 6, 7, 8], [4, 0]));
        assert_eq!(undo.back(8), Some(7));
        undo.took(Step::Move, 7);
        assert_eq!(undo.steps(), [4, 0], "what was taken back is gone once something else is done");
        (0..1000).for_each(|state| undo.took(Step::Other, state));
        assert_eq!(undo.steps(), [STEPS, 0]);
    }
}
