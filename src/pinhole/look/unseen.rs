//! Light and materials that the camera's integrator leaves out, and the integrator that includes them.

use crate::extract::{emissive_evidence, glossy_evidence, integrator_of, matte_evidence, specular_evidence};
use crate::plan::Census;
use crate::shade::point_evidence;

/// A sentence for each kind of light or material in the scene that its integrator does not render.
pub fn unseen(scene: &Census<'_>) -> Vec<String> {
    let (material, emitters) = (matte_evidence(scene), emissive_evidence(scene));
    let (specular, glossy) = (specular_evidence(scene), glossy_evidence(scene));
    let lit_by_area = emitters.needed && (material.needed || glossy.needed);
    let does = integrator_of(scene).integrator.transport();
    let (name, mut warnings) = (does.name, Vec::new());
    if does.occlusion.is_some() {
        let all = specular.or(glossy);
        if all.needed {
            warnings.push(format!(
                "{name} renders mirrors, glass and metal like all other surfaces ({}); Integrator::Path shows what they \
                 reflect",
                all.reason
            ));
        }
        return warnings;
    }
    if specular.needed && !does.follows_paths {
        warnings.push(format!(
            "{name} renders mirrors and glass black ({}); Integrator::Whitted traces reflection and refraction",
            specular.reason
        ));
    }
    if glossy.needed && does.follows_paths && !does.samples_glossy {
        warnings.push(format!(
            "{name} shows only lights without an area on glossy surfaces ({}); Integrator::Path shows the rest",
            glossy.reason
        ));
    }
    // Beside other lights, emitting surfaces that are visible at the first hit but do not illuminate are taken to be
    // intended.
    if lit_by_area && does.lights.is_none() && (does.follows_paths || !point_evidence(scene).needed) {
        warnings.push(format!(
            "with {name}, surfaces that emit light do not illuminate others ({}); with Integrator::Path they do",
            emitters.reason
        ));
    }
    let is_caustic = emitters.needed && material.needed && specular.needed;
    if is_caustic && does.lights.is_some() && !does.samples_diffuse {
        warnings.push(format!(
            "light that arrives through mirrors or glass ({}) from surfaces that emit it ({}) is missing on matte \
             surfaces, from which {name} does not trace further; Integrator::Path finds it",
            specular.reason, emitters.reason
        ));
    }
    warnings
}
