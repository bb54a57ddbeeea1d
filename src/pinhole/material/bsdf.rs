//! What a BSDF is, the materials of a scene, and their table.

use super::{PhaseTable, for_each_bsdf, frame_of, media_entities, named_bsdf};
use crate::check::kind_and_name;
use crate::plan::{Added, Census, Table, TableKind, add_kind, united, with_added};
use crate::scene::{Feeds, Rgb, SceneError};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};
use std::collections::HashMap;
use std::sync::Arc;

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

/// The frame about a normal, whose length is mended where lobes are so narrow that its rounding shows.
#[inline(always)]
pub(crate) fn frame_about(normal: DVec3, narrow: bool) -> DMat3 {
    frame_of(if narrow { normal.normalize() } else { normal })
}

// ANCHOR: reverse_pdf
/// The pdf with which a path would go from a surface to the eye if it came from the light.
///
/// A transmitted path comes from the other side, where the index of refraction is the inverse.
#[inline(always)]
pub(crate) fn reverse_pdf<B: Bsdf>(bsdf: &B, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> f64 {
    if to_light.z >= 0.0 {
        return bsdf.pdf(context, to_eye, to_light);
    }
    let flipped = |direction: DVec3| DVec3::new(direction.x, direction.y, -direction.z);
    let behind = ShadingContext { eta: 1.0 / context.eta, ..*context };
    bsdf.pdf(&behind, flipped(to_eye), flipped(to_light))
}
// ANCHOR_END: reverse_pdf

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
    /// Gathering photons.
    pub photons: &'static str,
    /// Joining surfaces to light vertices with it.
    pub join: &'static str,
    /// Weighting what is joined to surfaces with it.
    pub join_weights: &'static str,
    /// Carrying MIS ratios on from surfaces with it.
    pub ratios: &'static str,
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
    /// Whether [`Self::sample_in_block`] is so nearly without branches that it is compiled for many rows at once.
    const IN_BLOCKS: bool = false;
    /// Whether [`Self::pdf`] is of the directions alone, whatever the surface's parameters, and so nearly without branches
    /// that it is compiled for many rows at once.
    const PDF_OF_DIRECTIONS: bool = false;
    /// Whether its lobes can be so narrow that the length of a normal rounded to f32 shows in them.
    const NARROW: bool = false;

    /// The frame in which it is evaluated, about the normal of a surface.
    #[inline(always)]
    fn frame(normal: DVec3) -> DMat3 {
        frame_about(normal, Self::NARROW)
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

    /// [`Self::eval`] and [`Self::pdfs`], of which a lobe has a part in common.
    #[inline(always)]
    fn eval_and_pdfs(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> ([f64; 3], [f64; 2]) {
        (self.eval(context, to_light, to_eye), self.pdfs(context, to_light, to_eye))
    }

    /// [`Self::pdf`], and that of the way back: [`reverse_pdf`].
    #[inline(always)]
    fn pdfs(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> [f64; 2] {
        [self.pdf(context, to_light, to_eye), reverse_pdf(self, context, to_light, to_eye)]
    }

    /// Samples a direction to the light by two numbers in [0, 1), and by a third where it [`chooses`](Self::chooses);
    /// none where the sampled direction leads to the wrong side of the surface.
    fn sample(&self, _site: &ShadingContext, _to_eye: DVec3, _numbers: [f64; 2], _choice: f64) -> Option<BsdfSample> {
        None
    }

    /// [`Self::sample`] for one of many rows, where [`in_blocks`](Self::in_blocks) says that it may be.
    #[inline(always)]
    fn sample_in_block(
        &self,
        context: &ShadingContext,
        to_eye: DVec3,
        numbers: [f64; 2],
        choice: f64,
    ) -> Option<BsdfSample> {
        self.sample(context, to_eye, numbers, choice)
    }

    /// Whether all of its materials can be sampled by [`Self::sample_in_block`].
    fn in_blocks(&self) -> bool {
        Self::IN_BLOCKS
    }

    /// Whether sampling needs a third number, or a specular BSDF one.
    fn chooses(&self) -> bool {
        false
    }

    /// Both directions of a specular BSDF, by reflection and by refraction; the ray arrives along `direction`, and
    /// `normal` faces it.
    #[inline]
    fn specular_directions(&self, _site: &ShadingContext, _direction: DVec3, _normal: DVec3) -> [SpecularSample; 2] {
        [SpecularSample::default(); 2]
    }

    /// One of the two, selected by a number in [0, 1) and divided by its probability.
    #[inline]
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

/// A BSDF whose type is not known, for tests and figures; stages are compiled for each BSDF instead.
pub trait ErasedBsdf: Send + Sync {
    /// See [`Bsdf::eval`].
    fn eval(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> [f64; 3];
    /// See [`Bsdf::pdf`].
    fn pdf(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> f64;
    /// See [`Bsdf::sample`].
    fn sample(&self, context: &ShadingContext, to_eye: DVec3, numbers: [f64; 2], choice: f64) -> Option<BsdfSample>;
}

impl<B: Bsdf> ErasedBsdf for Arc<B> {
    fn eval(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> [f64; 3] {
        Bsdf::eval(&**self, context, to_light, to_eye)
    }

    fn pdf(&self, context: &ShadingContext, to_light: DVec3, to_eye: DVec3) -> f64 {
        Bsdf::pdf(&**self, context, to_light, to_eye)
    }

    fn sample(&self, context: &ShadingContext, to_eye: DVec3, numbers: [f64; 2], choice: f64) -> Option<BsdfSample> {
        Bsdf::sample(&**self, context, to_eye, numbers, choice)
    }
}

macro_rules! kinds {
    ($($kind:ident($table:ident, $name:literal),)+) => {
        /// The kinds of material: one for each BSDF.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum MaterialKind {
            $(#[doc = concat!("A row of [`", stringify!($table), "`](crate::material::", stringify!($table), ").")] $kind,)+
            /// The phase function of a medium, a row of [`PhaseTable`](crate::material::PhaseTable): what no surface has.
            Phase,
            /// A row of the table of a BSDF that a program adds.
            Custom {
                /// A number of its own among these.
                number: u8,
                /// How it scatters.
                class: BsdfClass,
                /// Whether light passes through its surface.
                transmits: bool,
            },
        }

        $(named_bsdf!(crate::material::$table, MaterialKind::$kind, $name);)+

        impl MaterialKind {
            /// How its BSDF scatters.
            #[inline(always)]
            const fn class(self) -> BsdfClass {
                match self {
                    $(Self::$kind => <crate::material::$table>::CLASS,)+
                    Self::Phase => PhaseTable::CLASS,
                    Self::Custom { class, .. } => class,
                }
            }

            /// Whether light passes through its surface.
            #[inline(always)]
            pub const fn transmits(self) -> bool {
                match self {
                    $(Self::$kind => <crate::material::$table>::TRANSMITS,)+
                    Self::Phase => PhaseTable::TRANSMITS,
                    Self::Custom { transmits, .. } => transmits,
                }
            }
        }
    };
}

for_each_bsdf!(kinds);

impl MaterialKind {
    /// Whether its BSDF is a delta distribution.
    #[inline(always)]
    pub const fn is_specular(self) -> bool {
        matches!(self.class(), BsdfClass::Specular)
    }

    /// By how much an area with this normal counts for a ray: |cos θ| of a surface; 1 of a scattering event, which has no
    /// area.
    #[inline(always)]
    pub fn cosine(self, normal: DVec3, direction: DVec3) -> f64 {
        if self == Self::Phase { 1.0 } else { normal.dot(direction).abs() }
    }
}

// The materials of a scene, by what the list of BSDFs says of their components.

/// Inserts a material into an entity.
pub type Spawn = Box<dyn Fn(&mut EntityWorldMut<'_>) + Send + Sync>;

/// A BSDF without its type.
#[derive(Clone, Copy)]
pub struct Registration {
    /// Its kind.
    pub kind: MaterialKind,
    /// How it scatters.
    pub class: BsdfClass,
    /// Whether light passes through its surface.
    pub transmits: bool,
    /// What textures may give it in place of its own, its normal aside.
    pub takes: &'static [Feeds],
    /// The name of its component.
    pub component: &'static str,
    /// The component's word in messages.
    pub word: &'static str,
    /// One such surface, in the reasons of the plan.
    pub noun: &'static str,
    /// The table of its parameters.
    pub table: fn() -> TableKind,
    entities: fn(&Census<'_>) -> Arc<[Entity]>,
    declared: fn(&Census<'_>) -> Arc<[Entity]>,
    carries: fn(&Census<'_>, Entity) -> bool,
    kind_of: fn(&Census<'_>, Entity) -> MaterialKind,
    parameters: fn(&Census<'_>, Entity, &str) -> Result<Parameters, SceneError>,
    interior: fn(&Census<'_>, Entity, &str) -> Result<Option<Interior>, SceneError>,
    albedo_beside_colour: fn(&Census<'_>, Entity) -> Option<Rgb>,
    /// Its materials for tests, and how far their albedo may fall short of 1 where nothing should be absorbed.
    pub examples: fn() -> Vec<(Spawn, Option<f64>)>,
    /// Its BSDF in a scene, for tests and figures.
    pub bsdf: fn(&Census<'_>) -> Result<Box<dyn ErasedBsdf>, SceneError>,
}

/// The component of an entity that has it.
fn of<'s, B: Bsdf>(scene: &'s Census<'_>, entity: Entity) -> Option<&'s B::Component> {
    scene.get::<B::Component>(entity)
}

impl Registration {
    const fn of<B: Bsdf>() -> Self {
        Self {
            kind: B::KIND,
            class: B::CLASS,
            transmits: B::TRANSMITS,
            takes: B::TAKES,
            component: B::COMPONENT,
            word: B::WORD,
            noun: B::NOUN,
            table: TableKind::of::<B>,
            entities: |scene| scene.entities::<With<B::Component>>(),
            declared: |scene| scene.declared::<With<B::Component>>(),
            carries: |scene, entity| of::<B>(scene, entity).is_some(),
            kind_of: |scene, entity| of::<B>(scene, entity).map_or(B::KIND, B::kind_of),
            parameters: |scene, entity, who| {
                of::<B>(scene, entity).map_or(Ok(Parameters::default()), |own| B::parameters(own, who))
            },
            interior: |scene, entity, who| of::<B>(scene, entity).map_or(Ok(None), |own| B::interior(own, who)),
            albedo_beside_colour: |scene, entity| of::<B>(scene, entity).and_then(B::albedo_beside_colour),
            examples: || {
                let spawn = |component: B::Component| -> Spawn {
                    Box::new(move |entity| {
                        entity.insert(component.clone());
                    })
                };
                B::examples().into_iter().map(|own| (spawn(own.component), own.lossless_to)).collect()
            },
            bsdf: |scene| Ok(Box::new(scene.table::<B>()?)),
        }
    }

    /// Whether textures may give it this.
    pub(crate) fn takes(&self, feeds: Feeds) -> bool {
        feeds == Feeds::Normal || self.takes.contains(&feeds)
    }

    /// The surface's parameters, after checking the values of a material that has this component.
    pub fn parameters(&self, scene: &Census<'_>, entity: Entity) -> Result<Parameters, SceneError> {
        (self.parameters)(scene, entity, &kind_and_name(scene, self.word, entity))
    }

    /// What fills a closed shape of a material that has this component.
    pub fn interior(&self, scene: &Census<'_>, entity: Entity) -> Result<Option<Interior>, SceneError> {
        (self.interior)(scene, entity, &kind_and_name(scene, self.word, entity))
    }

    /// The kind of a material that has this component.
    pub fn kind(&self, scene: &Census<'_>, entity: Entity) -> MaterialKind {
        (self.kind_of)(scene, entity)
    }

    /// The albedo beside that of the colour of a material that has this component.
    pub fn albedo_beside_colour(&self, scene: &Census<'_>, entity: Entity) -> Option<Rgb> {
        (self.albedo_beside_colour)(scene, entity)
    }
}

macro_rules! registered {
    ($($kind:ident($table:ident, $name:literal),)+) => {
        /// The BSDFs of the library, in the order of their kinds.
        pub static REGISTERED: &[Registration] = &[$(Registration::of::<crate::material::$table>()),+];
    };
}

for_each_bsdf!(registered);

/// All BSDFs: those of the library, and then those that the scene adds.
pub fn registered_materials<'s>(scene: &'s Census<'_>) -> impl Iterator<Item = &'s Registration> + Clone {
    with_added(REGISTERED, scene)
}

/// Adds a material of one's own to those that a scene may have, before it is planned.
pub fn add_material<B: Bsdf>(scene: &mut World) {
    let (table, entities) = (TableKind::of::<B>(), |scene: &Census<'_>| scene.entities::<With<B::Component>>());
    let added = Added { table, word: B::WORD, entities, stages: "of_material" };
    add_kind::<B, _>(scene, Registration::of::<B>(), added);
}

/// Checks that no two BSDFs have the same kind.
///
/// Errors: one that a program adds with the number of another.
pub(crate) fn check_kinds(scene: &Census<'_>) -> Result<(), SceneError> {
    for (at, own) in registered_materials(scene).enumerate() {
        if let Some(other) = registered_materials(scene).skip(at + 1).find(|other| other.kind == own.kind) {
            let value = format!("that of {}", own.component);
            return Err(SceneError::new(other.component, "number", value, NUMBERS));
        }
    }
    Ok(())
}

/// What is asked of the numbers that a program gives to what it adds.
pub(crate) const NUMBERS: &str = "each shape, and each material, that a program adds needs one of its own";

/// The enabled entities that carry a material, in spawn order, one for each row of the table.
pub fn material_entities(scene: &Census<'_>) -> Arc<[Entity]> {
    scene.once(|scene| united(&mut registered_materials(scene).map(|own| (own.entities)(scene))).into())
}

/// The same with the disabled ones.
pub fn declared_materials(scene: &Census<'_>) -> Arc<[Entity]> {
    scene.once(|scene| united(&mut registered_materials(scene).map(|own| (own.declared)(scene))).into())
}

/// The first BSDF whose component an entity carries.
fn registration<'s>(scene: &'s Census<'_>, entity: Entity) -> Option<&'s Registration> {
    registered_materials(scene).find(|own| (own.carries)(scene, entity))
}

/// The kind of an entity's material; none where it has none.
pub fn material_kind(scene: &Census<'_>, entity: Entity) -> Option<MaterialKind> {
    registration(scene, entity).map(|own| own.kind(scene, entity))
}

/// The enabled entities whose material is of one kind, in spawn order, one for each row of its table.
pub fn entities_of_kind(scene: &Census<'_>, kind: MaterialKind) -> Vec<Entity> {
    material_entities(scene).iter().copied().filter(|&entity| material_kind(scene, entity) == Some(kind)).collect()
}

/// Whether an entity, enabled or not, carries a material.
pub fn is_material(scene: &Census<'_>, entity: Entity) -> bool {
    registration(scene, entity).is_some()
}

/// What fills a closed shape of an entity's material.
pub(crate) fn interior_of(scene: &Census<'_>, entity: Entity) -> Result<Option<Interior>, SceneError> {
    registration(scene, entity).map_or(Ok(None), |own| own.interior(scene, entity))
}

/// Some of the components that are materials, in words: `Matte, Phong … or Metal`.
pub(crate) fn components_in_words(scene: &Census<'_>, article: &str, such: impl Fn(&Registration) -> bool) -> String {
    let each = registered_materials(scene).filter(|own| such(own));
    let names: Vec<String> = each.map(|own| format!("{article}{}", own.component)).collect();
    match &names[..] {
        [] => String::new(),
        [one] => one.clone(),
        [others @ .., last] => format!("{} or {last}", others.join(", ")),
    }
}

/// The one material component of an entity.
pub(crate) fn one_material<'s>(scene: &'s Census<'_>, entity: Entity) -> Result<&'s Registration, SceneError> {
    let present: Vec<&Registration> = registered_materials(scene).filter(|own| (own.carries)(scene, entity)).collect();
    match present[..] {
        [one] => Ok(one),
        _ => {
            let names: Vec<&str> = present.iter().map(|own| own.component).collect();
            let value = format!("{} at once", names.join(" and "));
            let who = kind_and_name(scene, "material", entity);
            Err(SceneError::new(who, "material", value, "an entity may be one material only"))
        }
    }
}

/// Stands for no row, in a column of row numbers.
pub const NO_ROW: u32 = u32::MAX;

/// The materials of shapes of all kinds, in spawn order; their further parameters are in the table of their BSDF.
///
/// After them come the phase functions of media, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MaterialTable {
    /// The kind of each.
    pub kind: Vec<MaterialKind>,
    /// Its row in the table of its BSDF.
    pub row: Vec<u32>,
    /// The parameters of each where no texture gives another.
    pub parameters: Vec<Parameters>,
    /// The row of what fills its shapes in the table of glass; [`NO_ROW`] for opaque materials.
    pub interior: Vec<u32>,
}

impl MaterialTable {
    /// Materials that are opaque and of one row each, as for tests.
    pub fn opaque(kind: Vec<MaterialKind>, colour: Vec<[f64; 3]>) -> Self {
        let count = kind.len();
        Self {
            kind,
            row: vec![0; count],
            parameters: colour.into_iter().map(Parameters::coloured).collect(),
            interior: vec![NO_ROW; count],
        }
    }
}

impl Table for MaterialTable {
    const NAME: &'static str = "materials";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let mut table = Self::default();
        let (mut rows_of_kind, mut interiors) = (HashMap::<MaterialKind, u32>::new(), 0);
        for &entity in material_entities(scene).iter() {
            let written = one_material(scene, entity)?;
            let kind = written.kind(scene, entity);
            let rows = rows_of_kind.entry(kind).or_default();
            table.row.push(*rows);
            *rows += 1;
            table.kind.push(kind);
            table.parameters.push(written.parameters(scene, entity)?);
            let is_filled = written.interior(scene, entity)?.is_some();
            table.interior.push(if is_filled { interiors } else { NO_ROW });
            interiors += u32::from(is_filled);
        }
        for (row, &medium) in media_entities(scene).iter().enumerate() {
            table.row.push(row as u32);
            table.kind.push(MaterialKind::Phase);
            table.parameters.push(PhaseTable::checked(scene, medium)?);
            table.interior.push(NO_ROW);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.kind.len() * (size_of::<MaterialKind>() + 2 * size_of::<u32>() + size_of::<Parameters>())
    }
}
