//! What a reader takes back, and cameras that an address carries.

use super::super::orbit::{CameraAt, Orbit};
use super::super::undo::{Step, Undo};
use super::{Choice, State, Viewer};

impl Viewer {
    /// Where the reader is.
    pub(super) fn state(&self) -> State {
        let (scene, taken_out) = (self.choice.scene.clone(), self.choice.taken_out.clone());
        State { orbit: self.orbit, scene, taken_out }
    }

    /// Goes a step back or forward; where there is none, nothing happens.
    pub(super) fn go(&mut self, step: fn(&mut Undo<State>, State) -> Option<State>) -> Result<(), String> {
        let from = self.state();
        let Some(State { orbit, scene, taken_out }) = step(&mut self.undo, from) else { return Ok(()) };
        let before = std::mem::replace(&mut self.orbit, orbit);
        let chosen = self.choose(Choice { scene, taken_out, ..self.choice.clone() });
        if chosen.is_err() {
            self.orbit = before;
        }
        chosen
    }

    /// Puts the camera where an address says.
    pub(super) fn put_camera(&mut self, there: &CameraAt) -> Result<(), String> {
        let own = Orbit::of(&self.world, Some(1.0)).map_err(|error| self.choice.scene.explain(error))?;
        let refused = "a camera stands at an eye, looks at a target that is elsewhere, and has an up that is not its \
                       direction";
        let orbit = own.put_at(there).ok_or(refused)?;
        self.undo.took(Step::Other, self.state());
        orbit.put(&mut self.world);
        self.orbit = Some(orbit);
        self.renew();
        Ok(())
    }
}
