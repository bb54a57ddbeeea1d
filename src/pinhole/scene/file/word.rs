use crate::scene::{
    Adaptive, Background, BlinnPhong, Checker, Cuboid, DirectionalLight, Disk, Emissive, Environment,
    EquirectangularCamera, FisheyeCamera, Glass, Gradient, ImageTexture, Integrator, Layers, Lens, LightTracing,
    LookAt, Matte, Metal, Mirror, Motion, OrthographicCamera, PerspectiveCamera, Phong, Placement, Plane, PointLight,
    Rectangle, Resolution, Sampling, Shutter, Sphere, SpotLight, Statistics, Stripes, Triangle, View,
};
use bevy_ecs::prelude::*;
use ron::error::SpannedError;
use ron::ser::PrettyConfig;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::any::TypeId;

// ANCHOR: words
/// Every component that a scene file may hold, and its word there; a new one joins with a line.
///
/// A file is written in this order.
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
    Word::of::<Triangle>("triangle"),
    Word::of::<PointLight>("point_light"),
    Word::of::<DirectionalLight>("directional_light"),
    Word::of::<SpotLight>("spot_light"),
    Word::of::<LookAt>("look_at"),
    Word::of::<Placement>("placement"),
    Word::of::<Resolution>("resolution"),
    Word::of::<Motion>("motion"),
    Word::of::<Shutter>("shutter"),
    Word::of::<Sampling>("sampling"),
    Word::of::<Adaptive>("adaptive"),
    Word::of::<Integrator>("integrator"),
    Word::of::<LightTracing>("light_tracing"),
    Word::of::<Matte>("matte"),
    Word::of::<Phong>("phong"),
    Word::of::<BlinnPhong>("blinn_phong"),
    Word::of::<Mirror>("mirror"),
    Word::of::<Glass>("glass"),
    Word::of::<Metal>("metal"),
    Word::of::<Emissive>("emissive"),
    Word::of::<Checker>("checker"),
    Word::of::<Stripes>("stripes"),
    Word::of::<ImageTexture>("image_texture"),
    Word::of::<Background>("background"),
    Word::of::<Gradient>("gradient"),
    Word::of::<Environment>("environment"),
    Word::of::<View>("view"),
    Word::of::<Layers>("layers"),
    Word::of::<Statistics>("statistics"),
];
// ANCHOR_END: words

/// The words that are no component of their own type in a file: a name, and three ways to stand to other entities.
pub const RELATIONS: [&str; 4] = ["name", "parent", "material", "disabled"];

/// The words of components, in the order in which a file is written.
pub fn words() -> impl Iterator<Item = &'static str> {
    WORDS.iter().map(|word| word.word)
}

/// Puts a component that was read onto an entity.
pub type Put = Box<dyn Fn(&mut EntityWorldMut<'_>) + Send + Sync>;

/// A component and its word in files.
pub struct Word {
    /// Such as `point_light`.
    pub word: &'static str,
    /// The component's type.
    pub kind: fn() -> TypeId,
    /// Reads the component from the text after the word's colon.
    pub read: fn(&str) -> Result<Put, SpannedError>,
    /// The text after the colon, if the entity carries the component.
    pub write: fn(&EntityRef<'_>) -> Option<Result<String, ron::Error>>,
    /// What `write` would say of a component that is read from `()`, if it can be.
    pub of_nothing: fn() -> Option<String>,
}

impl Word {
    const fn of<C: Component + Clone + Serialize + DeserializeOwned>(word: &'static str) -> Self {
        Self { word, kind: TypeId::of::<C>, read: read::<C>, write: write::<C>, of_nothing: of_nothing::<C> }
    }

    /// The word as a file has it.
    pub fn find(word: &str) -> Option<&'static Self> {
        WORDS.iter().find(|own| own.word == word)
    }

    /// All, in order.
    pub fn all() -> &'static [Self] {
        WORDS
    }
}

fn read<C: Component + Clone + DeserializeOwned>(text: &str) -> Result<Put, SpannedError> {
    let component: C = ron::from_str(text)?;
    Ok(Box::new(move |entity| {
        entity.insert(component.clone());
    }))
}

fn write<C: Component + Serialize>(entity: &EntityRef<'_>) -> Option<Result<String, ron::Error>> {
    entity.get::<C>().map(text_of)
}

fn of_nothing<C: Serialize + DeserializeOwned>() -> Option<String> {
    let component: C = ron::from_str("()").ok()?;
    text_of(&component).ok()
}

fn text_of<C: Serialize>(component: &C) -> Result<String, ron::Error> {
    ron::ser::to_string_pretty(component, PrettyConfig::new().compact_structs(true).compact_arrays(true))
}
