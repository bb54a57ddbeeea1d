use super::bsdf::entities_of_kind;
use super::metal::smooth_colour;
use super::{Bsdf, BsdfClass, Example, Named, Parameters, ShadingContext, SpecularSample, mirror_direction};
use crate::check::{kind_and_name, reflectance};
use crate::plan::{Census, Table};
use crate::scene::{Mirror, SceneError};
use glam::DVec3;

/// Perfect mirrors, in spawn order, including metal too smooth for its roughness to show.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MirrorTable {
    /// The reflectance of each: red, green, blue, from 0 to 1.
    pub colour: Vec<[f64; 3]>,
}

impl Table for MirrorTable {
    const NAME: &'static str = "mirrors";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let colour = |entity| match scene.get::<Mirror>(entity) {
            Some(mirror) => {
                Ok(reflectance(&kind_and_name(scene, Self::WORD, entity), "colour", mirror.colour)?.to_array())
            }
            None => smooth_colour(scene, entity),
        };
        let colours: Result<_, SceneError> = entities_of_kind(scene, Self::KIND).into_iter().map(colour).collect();
        Ok(Self { colour: colours? })
    }

    fn bytes(&self) -> usize {
        self.colour.len() * size_of::<[f64; 3]>()
    }
}

impl Bsdf for MirrorTable {
    type Component = Mirror;
    const COMPONENT: &'static str = "Mirror";
    const WORD: &'static str = "mirror";
    const NOUN: &'static str = "mirror";
    const CLASS: BsdfClass = BsdfClass::Specular;

    fn parameters(mirror: &Mirror, who: &str) -> Result<Parameters, SceneError> {
        reflectance(who, "colour", mirror.colour).map(|_| Parameters::default())
    }

    // ANCHOR: sample_mirror
    /// The only direction of this specular BSDF is that of reflection.
    #[inline(always)]
    fn specular_directions(&self, context: &ShadingContext, direction: DVec3, normal: DVec3) -> [SpecularSample; 2] {
        let (direction, weight) = (mirror_direction(direction, normal), self.colour[context.row]);
        [SpecularSample { direction, weight, through: false }, SpecularSample::default()]
    }
    // ANCHOR_END: sample_mirror

    fn examples() -> Vec<Example<Mirror>> {
        vec![Example { component: Mirror::default(), lossless_to: None }]
    }
}
