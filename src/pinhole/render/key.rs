use crate::plan::Plan;
use crate::scene::{FNV_BASIS, fingerprint, fnv};
use bevy_ecs::prelude::*;

/// A number that identifies what a film is a film of: samples of two renders with the same key may be added together.
///
/// It depends on the scene except for the number of samples, on the stages that run, and on the code that the
/// program was built from, since an edited stage takes other samples; it does not depend on the number of workers or
/// the side of a tile.
pub fn film_key(scene: &World, plan: &Plan) -> u64 {
    let mut text = String::from(env!("PINHOLE_SOURCES"));
    text += &fingerprint(scene);
    for row in plan.rows.iter().filter(|row| row.kept) {
        text += row.stage;
        text.push('\n');
    }
    fnv(FNV_BASIS, text.as_bytes())
}
