use super::{MaterialKind, frame_of};
use crate::plan::Table;
use crate::scene::{Feeds, Rgb, SceneError};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};

/// How concentrated the light is that a BSDF scatters, which decides how integrators treat it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BsdfClass {
    /// Broad enough to be lit by light sampling alone; only path tracing continues paths from it.
    Diffuse,
    /// Narrow enough to show what surrounds it: distribution ray tracing continues paths from it as well.
    Glossy,
    /// A delta distribution: it is never evaluated, and lights are not sampled for it.
    Specular,
}

/// What a path carries: radiance towards the camera, or importance towards the lights.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Transport {
    /// For paths that start at the camera; light that enters a denser medium has its radiance scaled by 1/η².
    #[default]
    Radiance,
    /// For paths that start at a light; power is not scaled at an interface, so its BSDF is the adjoint (Veach 1997,
    /// 5.2).
    Importance,
}

/// The parameters of a surface at a point, each of which a texture may give; a BSDF reads those that it has.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Parameters {
    /// The colour: red, green, blue, from 0 to 1; black for none.
    pub colour: [f64; 3],
    /// How much of it is metal, from 0 to 1.
    pub metallic: f64,
    /// The perceived roughness, from 0 to 1.
    pub roughness: f64,
}

impl Parameters {
    /// Those of a surface that has a colour and nothing else.
    pub const fn coloured(colour: [f64; 3]) -> Self {
        Self { colour, metallic: 0.0, roughness: 0.0 }
    }
}

/// What a BSDF is evaluated for: a row of its table, and what the scene says of the surface there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadingContext {
    /// The row of the BSDF's table.
    pub row: usize,
    /// The surface's parameters, from textures or else from the [`MaterialTable`](super::MaterialTable).
    pub parameters: Parameters,
    /// The index of refraction beyond the surface over that on the side of the eye; 1 for an opaque material.
    pub eta: f64,
    /// The reflectance of a smooth surface, where layers lie there that are too thin to be kept apart.
    pub reflectance: Option<f64>,
    /// What the path carries.
    pub transport: Transport,
}

impl ShadingContext {
    /// A row of a table of opaque materials, on a surface with these parameters.
    pub const fn opaque(row: usize, parameters: Parameters) -> Self {
        Self { row, parameters, eta: 1.0, reflectance: None, transport: Transport::Radiance }
    }
}

/// A direction sampled from a BSDF that is not specular.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfSample {
    /// The direction to the light, a unit vector in the surface's frame.
    pub to_light: DVec3,
    /// Its pdf in 1/sr, above 0.
    pub pdf: f64,
    /// BSDF · |cos θ| / pdf: red, green, blue.
    pub weight: [f64; 3],
}

/// A direction of a specular BSDF.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpecularSample {
    /// The direction, a unit vector in the space of the arriving ray.
    pub direction: DVec3,
    /// The factor of the radiance that arrives along it: red, green, blue; 0 where there is no such direction.
    pub weight: [f64; 3],
    /// Whether it leads through the surface.
    pub through: bool,
}

/// What fills a shape whose surface transmits light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interior {
    /// The index of refraction relative to a vacuum.
    pub ior: f64,
    /// The absorption coefficient per scene unit: red, green, blue, at least 0.
    pub absorption: [f64; 3],
    /// Where two overlap, the one with the higher priority is present.
    pub priority: u32,
}

/// A material for the tests of all materials, which read what must hold of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Example<C> {
    /// The material's component.
    pub component: C,
    /// How far its albedo may fall short of 1 where it should absorb nothing; none where it absorbs or loses energy.
    pub lossless_to: Option<f64>,
}

/// The names that the list of BSDFs gives the stages and the column of one of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StageNames {
    /// Sampling it for paths from the camera, or from both sides.
    pub sample: &'static str,
    /// Sampling it for paths from lights.
    pub sample_from_lights: &'static str,
    /// Following all of its specular directions.
    pub split: &'static str,
    /// Evaluating it for direct light.
    pub direct_light: &'static str,
    /// The same where light paths are connected to the camera.
    pub connections: &'static str,
    /// Weighting light samples against sampling it.
    pub mis: &'static str,
    /// Listing the rows that hit it.
    pub classify: &'static str,
    /// The column of these rows.
    pub rows: &'static str,
}

/// What the list of BSDFs says of each of them.
pub trait Named {
    /// Its kind.
    const KIND: MaterialKind;
    /// The names of its stages.
    const NAMES: StageNames;
}

/// A BSDF: the table of its parameters, and all that a renderer asks of a material.
///
/// Directions point away from the surface and are unit vectors in its frame, whose normal is +z on the side of the eye.
/// A BSDF that is not specular has [`eval`](Self::eval), [`pdf`](Self::pdf) and [`sample`](Self::sample); a specular
/// one has [`specular_directions`](Self::specular_directions) and [`sample_specular`](Self::sample_specular).
pub trait Bsdf: Table + Named {
    /// The component that an author writes.
    type Component: Component + Clone;
    /// The component's name.
    const COMPONENT: &'static str;
    /// The component's word in messages and in scene files.
    const WORD: &'static str;
    /// One such surface, in the reasons of the plan.
    const NOUN: &'static str;
    /// How it scatters.
    const CLASS: BsdfClass;
    /// Whether light passes through the surface.
    const TRANSMITS: bool = false;
    /// What textures may give it in place of its own; its normal they always may.
    const TAKES: &'static [Feeds] = &[];
    /// Whether its lobes can be so narrow that the length of a normal rounded to f32 shows in them.
    const NARROW: bool = false;

    /// The frame in which it is evaluated, about the normal of a surface.
    #[inline(always)]
    fn frame(normal: DVec3) -> DMat3 {
        frame_of(if Self::NARROW { normal.normalize() } else { normal })
    }

    /// The kind that a component becomes, which may be another one where its parameters are extreme.
    fn kind_of(_component: &Self::Component) -> MaterialKind {
        Self::KIND
    }

    /// The surface's parameters where no texture gives others.
    ///
    /// Errors: the first of the component's values that is invalid.
    fn parameters(component: &Self::Component, who: &str) -> Result<Parameters, SceneError>;

    /// What fills a closed shape of this material.
    ///
    /// Errors: the first of the component's values that is invalid.
    fn interior(_component: &Self::Component, _who: &str) -> Result<Option<Interior>, SceneError> {
        Ok(None)
    }

    /// The albedo beside that of the colour, which the two must not exceed together.
    fn albedo_beside_colour(_component: &Self::Component) -> Option<Rgb> {
        None
    }

    /// The BSDF in 1/sr: red, green, blue.
    fn eval(&self, _site: &ShadingContext, _to_light: DVec3, _to_eye: DVec3) -> [f64; 3] {
        [0.0; 3]
    }

    /// The pdf with which [`Self::sample`] chooses `to_light`, in 1/sr.
    fn pdf(&self, _site: &ShadingContext, _to_light: DVec3, _to_eye: DVec3) -> f64 {
        0.0
    }

    /// Samples a direction to the light by two numbers in [0, 1), and by a third where it [`chooses`](Self::chooses);
    /// none where the sampled direction leads to the wrong side of the surface.
    fn sample(&self, _site: &ShadingContext, _to_eye: DVec3, _numbers: [f64; 2], _choice: f64) -> Option<BsdfSample> {
        None
    }

    /// Whether sampling needs a third number, or a specular BSDF one.
    fn chooses(&self) -> bool {
        false
    }

    /// Both directions of a specular BSDF, by reflection and by refraction; the ray arrives along `direction`, and
    /// `normal` faces it.
    fn specular_directions(&self, _site: &ShadingContext, _direction: DVec3, _normal: DVec3) -> [SpecularSample; 2] {
        [SpecularSample::default(); 2]
    }

    /// One of the two, selected by a number in [0, 1) and divided by its probability.
    fn sample_specular(
        &self,
        context: &ShadingContext,
        direction: DVec3,
        normal: DVec3,
        _number: f64,
    ) -> SpecularSample {
        self.specular_directions(context, direction, normal)[0]
    }

    /// Materials for the tests of all materials.
    fn examples() -> Vec<Example<Self::Component>>;
}
