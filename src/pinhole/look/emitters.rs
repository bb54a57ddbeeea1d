//! Surfaces that emit light and that strategies for direct light do not agree about, or cannot sample.

use crate::Result;
use crate::each::Each;
use crate::extract::{AreaLightTable, EmissiveTable, NO_ROW, ShapeTable, integrator_of, sampled_shapes, shape_name};
use crate::plan::{Census, Table, counted};
use crate::scene::LightStrategy;
use std::collections::HashMap;

/// Lights are compared with one another up to this number.
const MAX_COMPARED: usize = 4096;

/// A sentence about emitters that light sampling cannot sample, where it is the only strategy, and one about emitters
/// that coincide.
pub fn emitters(scene: &Census<'_>) -> Result<Vec<String>> {
    let Some(strategy) = integrator_of(scene).integrator.transport().lights else { return Ok(Vec::new()) };
    if scene.table::<EmissiveTable>()?.radiance.is_empty() {
        return Ok(Vec::new());
    }
    let mut warnings = Vec::new();
    if strategy == LightStrategy::Light {
        warnings.extend(unsampled(scene)?);
    }
    // Where no light is sampled, there is no table of lights, and none is made for a warning.
    if scene.extractions().contains_key(AreaLightTable::NAME) {
        warnings.extend(coincident(scene)?);
    }
    Ok(warnings)
}

/// Emitters that have no row among the lights that are sampled.
fn unsampled(scene: &Census<'_>) -> Result<Option<String>> {
    let (shapes, lights) = (scene.table::<ShapeTable>()?, scene.table::<AreaLightTable>()?);
    let emissive = scene.table::<EmissiveTable>()?;
    let emits = |shape: &usize| {
        let row = shapes.emissive[*shape];
        row != NO_ROW && emissive.radiance[row as usize] != [0.0; 3]
    };
    let missed: Vec<usize> =
        (0..shapes.kind.len()).filter(emits).filter(|&s| lights.light_of_shape[s] == NO_ROW).collect();
    let Some(&first) = missed.first() else { return Ok(None) };
    let which =
        format!("{} (the first is the {})", counted(missed.len(), "emitting surface"), shape_name(scene, first));
    let does = integrator_of(scene).integrator.transport();
    Ok(Some(if does.samples_diffuse {
        format!(
            "light sampling cannot sample {which}, so BSDF sampling finds their light, as with LightStrategy::Bsdf; \
             more samples, or {} instead, lessen its noise",
            sampled_shapes(scene)
        )
    } else {
        format!(
            "{} samples lights and nothing else, and it cannot sample {which}: their light on other surfaces is \
             missing; Integrator::Path finds it",
            does.name
        )
    }))
}

/// Two lights with the very same surface.
fn coincident(scene: &Census<'_>) -> Result<Option<String>> {
    let lights = scene.table::<AreaLightTable>()?;
    let mut seen = HashMap::new();
    for (light, emitter) in lights.emitter.iter().enumerate().take(MAX_COMPARED) {
        if let Some(other) = seen.insert(format!("{emitter:?}"), light) {
            let [one, other] = [other, light].each(|light| shape_name(scene, lights.shape[light] as usize));
            return Ok(Some(format!(
                "the {one} and the {other} emit light from the very same surface, where rounding decides which of them \
                 a ray hits: strategies for direct light give different pictures; move one of them, or add their \
                 radiances in one"
            )));
        }
    }
    Ok(None)
}
