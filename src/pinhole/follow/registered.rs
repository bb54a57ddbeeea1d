use super::bsdf::{connections_stage, direct_light_stage, mis_stage, sample_from_lights_stage, sample_stage};
use super::bsdf_rows::classify_bsdf_stage;
use super::specular::{specular_from_lights_stage, specular_stage, split_stage};
use crate::material::{Bsdf, BsdfClass, MaterialKind, for_each_bsdf};
use crate::plan::Stage;

/// What the stages of a BSDF are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BsdfRole {
    /// Listing the rows that hit it.
    Classify,
    /// Weighting light samples against sampling it.
    MisWeights,
    /// Evaluating it for direct light.
    Evaluate,
    /// The same where light paths are connected to the camera.
    Connections,
    /// Following all of its specular directions.
    Split,
    /// Sampling it for further rays.
    Sample,
    /// The same for paths from lights.
    SampleFromLights,
}

/// A stage of a BSDF.
#[derive(Clone, Copy)]
pub struct BsdfStage {
    /// What it is for.
    pub role: BsdfRole,
    /// The BSDF's kind.
    pub kind: MaterialKind,
    /// How the BSDF scatters.
    pub class: BsdfClass,
    /// Whether it transmits light.
    pub transmits: bool,
    /// The stage.
    pub stage: fn() -> Stage,
}

/// The stages of a BSDF.
pub fn stages_of<B: Bsdf>() -> Vec<BsdfStage> {
    use BsdfRole::*;
    let of = |role, stage| BsdfStage { role, kind: B::KIND, class: B::CLASS, transmits: B::TRANSMITS, stage };
    let mut stages: Vec<BsdfStage> = Vec::new();
    if B::CLASS == BsdfClass::Specular {
        stages.push(of(Classify, classify_bsdf_stage::<B>));
        stages.push(of(Sample, specular_stage::<B>));
        if B::TRANSMITS {
            stages.push(of(Split, split_stage::<B>));
            stages.push(of(SampleFromLights, specular_from_lights_stage::<B>));
        }
        return stages;
    }
    stages.push(of(MisWeights, mis_stage::<B>));
    stages.push(of(Sample, sample_stage::<B>));
    stages.push(of(Evaluate, direct_light_stage::<B>));
    if B::TRANSMITS {
        stages.push(of(Connections, connections_stage::<B>));
        stages.push(of(SampleFromLights, sample_from_lights_stage::<B>));
    }
    stages
}

macro_rules! all_stages {
    ($($kind:ident($table:ident, $name:literal),)+) => {
        /// The stages of all BSDFs, one BSDF after another.
        pub fn bsdf_stages() -> Vec<BsdfStage> {
            [$(stages_of::<crate::material::$table>()),+].concat()
        }
    };
}

for_each_bsdf!(all_stages);
