//! Light and materials that the camera's integrator leaves out, and the integrator that includes them.

use crate::extract::{emissive_evidence, glossy_evidence, integrator_of, matte_evidence, specular_evidence};
use crate::plan::Census;
use crate::scene::Integrator;
use crate::shade::point_evidence;

/// A sentence for each kind of light or material in the scene that its integrator does not render.
pub fn unseen(scene: &Census<'_>) -> Vec<String> {
    let (material, emitters) = (matte_evidence(scene), emissive_evidence(scene));
    let (specular, glossy) = (specular_evidence(scene), glossy_evidence(scene));
    let lit_by_area = emitters.needed && (material.needed || glossy.needed);
    let mut warnings = Vec::new();
    match integrator_of(scene).integrator {
        Integrator::RayCasting => {
            if specular.needed {
                warnings.push(format!(
                    "ray casting renders mirrors and glass black ({}); Integrator::Whitted traces reflection and refraction",
                    specular.reason
                ));
            }
            // Beside other lights, emitting surfaces that are visible but do not illuminate are taken to be intended.
            if lit_by_area && !point_evidence(scene).needed {
                warnings.push(format!(
                    "with ray casting, surfaces that emit light do not illuminate others ({}); with Integrator::Path they do",
                    emitters.reason
                ));
            }
        }
        Integrator::Whitted { .. } => {
            if glossy.needed {
                warnings.push(format!(
                    "Whitted's method shows only lights without an area on glossy surfaces ({}); Integrator::Path \
                     shows the rest",
                    glossy.reason
                ));
            }
            if lit_by_area {
                warnings.push(format!(
                    "with Whitted's method, surfaces that emit light do not illuminate others ({}); with Integrator::Path they do",
                    emitters.reason
                ));
            }
        }
        Integrator::AmbientOcclusion { .. } => {
            let all = specular.or(glossy);
            if all.needed {
                warnings.push(format!(
                    "ambient occlusion renders mirrors, glass and metal like all other surfaces ({}); Integrator::Path \
                     shows what they reflect",
                    all.reason
                ));
            }
        }
        Integrator::Distribution { .. } => {
            if emitters.needed && material.needed && specular.needed {
                warnings.push(format!(
                    "light that arrives through mirrors or glass ({}) from surfaces that emit it ({}) is missing on \
                     matte surfaces, which Whitted's method does not trace further; Integrator::Path finds it",
                    specular.reason, emitters.reason
                ));
            }
        }
        Integrator::Path { .. } => {}
    }
    warnings
}
