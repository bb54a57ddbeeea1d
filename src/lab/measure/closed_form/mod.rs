//! Numbers that theory knows, measured by whole renders.
//!
//! Reads: scenes of its own. Writes: means with their standard errors, beside the truth.
//! A test runs them with few samples, the command `closed-forms` with as many as are asked for.

mod aperture;
mod form_factor;
mod furnace;
mod material;
mod measured;
mod motion;
mod pane;
mod receiver;
mod sky;

use measured::GREEN;
pub use measured::{ClosedForm, Measured, every_stage};

/// Every closed form that is held against a render.
pub const CLOSED_FORMS: &[&[ClosedForm]] = &[
    furnace::FORMS,
    sky::FORMS,
    receiver::LIGHTS,
    receiver::FAR_LIGHTS,
    form_factor::FORMS,
    material::FORMS,
    pane::FORMS,
    aperture::FORMS,
    motion::FORMS,
];

/// All, in order.
pub fn closed_forms() -> impl Iterator<Item = &'static ClosedForm> {
    CLOSED_FORMS.iter().copied().flatten()
}
