//! What is odd about the media of a scene.

use crate::Result;
use crate::check::{kind_and_name, number};
use crate::extract::{Filled, MediumPlace, MediumTable, sky_evidence};
use crate::material::media_entities;
use crate::plan::Census;
use crate::scene::DirectionalLight;
use bevy_ecs::prelude::*;

/// How many of the smallest steps of single precision light should go between two scattering events.
const STEPS: f64 = 8.0;

/// Says that a medium without an end keeps out what shines from infinitely far away, and that one is so dense that single
/// precision does not keep its scattering events apart.
///
/// Errors: an invalid medium.
pub fn odd_media(scene: &Census<'_>) -> Result<Vec<String>> {
    let (table, entities, mut said) = (scene.table::<MediumTable>()?, media_entities(scene), Vec::new());
    for Filled { medium, place, density } in &table.place {
        let medium = *medium;
        let (own, who) = (&table.medium[medium], kind_and_name(scene, "medium", entities[medium]));
        let max = density.as_ref().map_or(1.0, |own| own.grid.max());
        let densest = max * own.extinction.into_iter().fold(0.0, f64::max);
        let is_opaque = own.extinction.iter().all(|part| *part > 0.0);
        if matches!(place, MediumPlace::Everywhere) && is_opaque && density.is_none() {
            let sky = sky_evidence(scene);
            let suns = scene.entities::<With<DirectionalLight>>().len();
            if sky.needed || suns > 0 {
                said.push(format!(
                    "the {who} fills all of space, so that no light from infinitely far away, of a sky or a sun, reaches \
                     through it; in a large shape without a material it lets that in"
                ));
            }
        }
        let remarks = density.iter().flat_map(|own| &own.grid.remarks);
        said.extend(remarks.map(|remark| format!("of the density grid of the {who}, {remark}")));
        let MediumPlace::Body { bounds, .. } = place else { continue };
        let far = bounds.min.abs().max(bounds.max.abs()).max_element();
        let apart = far * f64::from(f32::EPSILON);
        if own.scattering != [0.0; 3] && far.is_finite() && densest * apart * STEPS > 1.0 {
            said.push(format!(
                "the {who} scatters light every {} scene units, which single precision does not keep apart {} from the eye, \
                 so that light is lost in it",
                number(rounded(1.0 / densest)),
                number(rounded(far))
            ));
        }
    }
    Ok(said)
}

/// A length to two digits.
fn rounded(length: f64) -> f64 {
    format!("{length:.1e}").parse().unwrap_or(length)
}
