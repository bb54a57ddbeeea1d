//! What an integrator that the camera names leaves out of a scene, and which one shows it.

use crate::extract::{
    emissive_evidence, glass_evidence, integrator_of, matte_evidence, metal_evidence, mirror_evidence,
};
use crate::plan::Census;
use crate::scene::Integrator;
use crate::shade::point_evidence;

/// A sentence for each kind of light or matter that the scene has and its integrator does not show.
pub fn unseen(scene: &Census<'_>) -> Vec<String> {
    let (material, lamps) = (matte_evidence(scene), emissive_evidence(scene));
    let (specular, metal) = (mirror_evidence(scene).or(glass_evidence(scene)), metal_evidence(scene));
    let lit_by_area = lamps.needed && (material.needed || metal.needed);
    let mut told = Vec::new();
    match integrator_of(scene).integrator {
        Integrator::RayCasting => {
            if specular.needed {
                told.push(format!(
                    "ray casting shows mirrors and glass dark ({}); Integrator::Whitted follows them",
                    specular.reason
                ));
            }
            // Beside other lights, that surfaces which emit are only seen is what was asked for.
            if lit_by_area && !point_evidence(scene).needed {
                told.push(format!(
                    "ray casting lights nothing by surfaces that emit ({}); Integrator::Path does",
                    lamps.reason
                ));
            }
        }
        Integrator::Whitted { .. } => {
            if metal.needed {
                told.push(format!(
                    "Whitted's rays show nothing in rough metal but lights without an area ({}); Integrator::Path \
                     shows the rest",
                    metal.reason
                ));
            }
            if lit_by_area {
                told.push(format!(
                    "Whitted's rays light nothing by surfaces that emit ({}); Integrator::Path does",
                    lamps.reason
                ));
            }
        }
        Integrator::AmbientOcclusion { .. } => {
            let all = specular.or(metal);
            if all.needed {
                told.push(format!(
                    "ambient occlusion shows mirrors, glass and metal as it shows all surfaces ({}); Integrator::Path \
                     shows what they reflect",
                    all.reason
                ));
            }
        }
        Integrator::Distribution { .. } => {
            if lamps.needed && material.needed && specular.needed {
                told.push(format!(
                    "light that comes by way of mirrors or glass ({}) from surfaces that emit ({}) is missing from \
                     matte surfaces, which send no rays on; Integrator::Path finds it",
                    specular.reason, lamps.reason
                ));
            }
        }
        Integrator::Path { .. } => {}
    }
    told
}
