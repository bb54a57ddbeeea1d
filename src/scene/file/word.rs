use crate::material::MATERIALS;
use crate::{
    Adaptive, Background, BidirectionalPathTracing, Checker, Cone, Cuboid, Cylinder, DensityGrid, DirectionalLight,
    Disk, Dispersion, EmissionMap, Emissive, Environment, EquirectangularCamera, Exposure, FisheyeCamera, Gradient,
    ImageTexture, Integrator, Keys, Layers, Lens, LightTracing, LookAt, Medium, Mesh, MetallicRoughnessMap, Motion,
    NormalMap, Opacity, OpacityMap, OrthographicCamera, PerspectiveCamera, PhotonMapping, Placement, Plane, PointLight,
    Rasterisation, Rectangle, Resolution, Sampling, Shutter, SingleSided, Sphere, SpotLight, Statistics, Stripes, Tint,
    ToneMapping, Torus, Triangle, View,
};
use bevy_ecs::prelude::*;
use ron::error::SpannedError;
use ron::ser::PrettyConfig;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::any::TypeId;
use std::sync::Arc;

// ANCHOR: words
/// Every component that a scene file may hold, with its word there; a new component adds one line.
///
/// Files are written in this order; materials, which have a list of their own, come before what emits light.
const WORDS: &[Word] = &[
    Word::of::<PerspectiveCamera>("perspective_camera"),
    Word::of::<OrthographicCamera>("orthographic_camera"),
    Word::of::<FisheyeCamera>("fisheye_camera"),
    Word::of::<EquirectangularCamera>("equirectangular_camera"),
    Word::of::<Lens>("lens"),
    Word::of::<Sphere>("sphere"),
    Word::of::<Plane>("plane"),
    Word::of::<Disk>("disk"),
    Word::of::<Rectangle>("rectangle"),
    Word::of::<Cuboid>("cuboid"),
    Word::of::<Cylinder>("cylinder"),
    Word::of::<Cone>("cone"),
    Word::of::<Torus>("torus"),
    Word::of::<Triangle>("triangle"),
    Word::of::<Mesh>("mesh"),
    Word::of::<PointLight>("point_light"),
    Word::of::<DirectionalLight>("directional_light"),
    Word::of::<SpotLight>("spot_light"),
    Word::of::<LookAt>("look_at"),
    Word::of::<Placement>("placement"),
    Word::of::<Resolution>("resolution"),
    Word::of::<Motion>("motion"),
    Word::of::<Shutter>("shutter"),
    Word::of::<Keys>("keys"),
    Word::of::<Sampling>("sampling"),
    Word::of::<Adaptive>("adaptive"),
    Word::of::<Rasterisation>("rasterisation"),
    Word::of::<Integrator>("integrator"),
    Word::of::<LightTracing>("light_tracing"),
    Word::of::<PhotonMapping>("photon_mapping"),
    Word::of::<BidirectionalPathTracing>("bidirectional_path_tracing"),
    Word::of::<Exposure>("exposure"),
    Word::of::<ToneMapping>("tone_mapping"),
    Word::of::<Emissive>("emissive"),
    Word::of::<Dispersion>("dispersion"),
    Word::of::<Medium>("medium"),
    Word::of::<DensityGrid>("density_grid"),
    Word::of::<Checker>("checker"),
    Word::of::<Stripes>("stripes"),
    Word::of::<ImageTexture>("image_texture"),
    Word::of::<Tint>("tint"),
    Word::of::<NormalMap>("normal_map"),
    Word::of::<MetallicRoughnessMap>("metallic_roughness_map"),
    Word::of::<EmissionMap>("emission_map"),
    Word::of::<Opacity>("opacity"),
    Word::of::<OpacityMap>("opacity_map"),
    Word::of::<SingleSided>("single_sided"),
    Word::of::<Background>("background"),
    Word::of::<Gradient>("gradient"),
    Word::of::<Environment>("environment"),
    Word::of::<View>("view"),
    Word::of::<Layers>("layers"),
    Word::of::<Statistics>("statistics"),
];
// ANCHOR_END: words

/// The words that are not components of their own: a name, two references to other entities, and a flag.
pub const RELATIONS: [&str; 4] = ["name", "parent", "material", "disabled"];

/// The words of all components, in the order in which files are written.
pub fn words() -> impl Iterator<Item = &'static str> {
    Word::all().map(|word| word.word)
}

/// Inserts a component that was read into an entity.
pub type Put = Arc<dyn Fn(&mut EntityWorldMut<'_>) + Send + Sync>;

/// A component and its word in scene files.
pub struct Word {
    /// The word, such as `point_light`.
    pub word: &'static str,
    /// The name of the component's type, such as `PointLight`.
    pub component: fn() -> &'static str,
    /// The component's type.
    pub kind: fn() -> TypeId,
    /// Parses the component from the text after the word's colon.
    pub read: fn(&str) -> Result<Put, SpannedError>,
    /// The text after the colon, if the entity has the component.
    pub write: fn(&EntityRef<'_>) -> Option<Result<String, ron::Error>>,
    /// The text that `write` makes of a component with all fields left out, if they may be.
    pub of_default: fn() -> Option<String>,
}

impl Word {
    /// The word of a component.
    pub const fn of<C: Component + Clone + Serialize + DeserializeOwned>(word: &'static str) -> Self {
        Self {
            word,
            component: component::<C>,
            kind: TypeId::of::<C>,
            read: read::<C>,
            write: write::<C>,
            of_default: of_default::<C>,
        }
    }

    /// Finds a component by its word.
    pub fn find(word: &str) -> Option<&'static Self> {
        Self::all().find(|own| own.word == word)
    }

    /// All components, in order.
    pub fn all() -> impl Iterator<Item = &'static Self> {
        let emits = WORDS.iter().position(|word| word.word == "emissive").unwrap_or(WORDS.len());
        let (before, after) = WORDS.split_at(emits);
        before.iter().chain(MATERIALS).chain(after)
    }
}

fn component<C>() -> &'static str {
    let path = std::any::type_name::<C>();
    path.rsplit_once("::").map_or(path, |(_, name)| name)
}

fn read<C: Component + Clone + DeserializeOwned>(text: &str) -> Result<Put, SpannedError> {
    let component: C = ron::from_str(text)?;
    Ok(Arc::new(move |entity| {
        entity.insert(component.clone());
    }))
}

fn write<C: Component + Serialize>(entity: &EntityRef<'_>) -> Option<Result<String, ron::Error>> {
    entity.get::<C>().map(text_of)
}

fn of_default<C: Serialize + DeserializeOwned>() -> Option<String> {
    let component: C = ron::from_str("()").ok()?;
    text_of(&component).ok()
}

/// A component as the text after its word's colon.
pub fn text_of<C: Serialize>(component: &C) -> Result<String, ron::Error> {
    ron::ser::to_string_pretty(component, PrettyConfig::new().compact_structs(true).compact_arrays(true))
}
