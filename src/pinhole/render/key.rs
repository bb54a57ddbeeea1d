use crate::plan::Plan;
use crate::scene::{FNV_BASIS, fingerprint, fnv};
use bevy_ecs::prelude::*;

/// What a film is a film of, as a number: two renders with the same key add to the same sums.
///
/// It depends on the scene but for the number of samples, on the stages that run, and on the sources that the program was
/// built from, for a stage that was edited takes other samples; the number of workers and the side of a tile are no part
/// of it.
pub fn film_key(scene: &World, plan: &Plan) -> u64 {
    let mut text = String::from(env!("PINHOLE_SOURCES"));
    text += &fingerprint(scene);
    for row in plan.rows.iter().filter(|row| row.kept) {
        text += row.stage;
        text.push('\n');
    }
    fnv(FNV_BASIS, text.as_bytes())
}
