use super::camera::eye;
use super::check::{kind_and_name, triple};
use super::material::in_use;
use super::pattern::{Pattern, PatternTable};
use super::pose::pose;
use super::shape_kind::shape_entities;
use crate::material::{components_in_words, is_material, material_entities, one_material, registered_materials};
use crate::plan::{Added, Census, Evidence, Table, TableKind, add_kind, with_added};
use crate::scene::{Feeds, Rgb, SceneError, Texture, TextureBy, for_each_texture};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec3};
use std::sync::Arc;

/// The row of a material without a texture of some kind.
pub const NO_TEXTURE: u32 = u32::MAX;

/// A texture without its type.
pub(super) struct Registered {
    word: &'static str,
    noun: &'static str,
    pattern: &'static str,
    feeds: Feeds,
    owners: fn(&Census<'_>) -> Arc<[Entity]>,
    pub is_on: fn(EntityRef<'_>) -> bool,
    evidence: fn(&Census<'_>, &str, &dyn Fn(TextureBy, bool) -> bool) -> Evidence,
    map: fn(&Census<'_>, Entity) -> Option<Result<TextureMap, SceneError>>,
}

impl Registered {
    const fn of<T: Texture>() -> Self {
        Self {
            word: T::WORD,
            noun: T::NOUN,
            pattern: T::PATTERN,
            feeds: T::FEEDS,
            owners: |scene| scene.entities::<With<T>>(),
            is_on: |entity| entity.contains::<T>(),
            evidence: |scene, noun, such| {
                texture_of_kind(scene, noun, |texture: &T| such(texture.by(), texture.is_filtered()))
            },
            map: |scene, material| {
                scene.get::<T>(material).map(|own| map_of(own, &kind_and_name(scene, T::WORD, material)))
            },
        }
    }
}

macro_rules! registered {
    ($($texture:ident),+) => {
        /// The textures of the library.
        const TEXTURES: &[Registered] = &[$(Registered::of::<crate::scene::$texture>()),+];
    };
}
for_each_texture!(registered);

/// All textures: those of the library, and then those that the scene adds.
pub(super) fn textures<'s>(scene: &'s Census<'_>) -> impl Iterator<Item = &'s Registered> + Clone {
    with_added(TEXTURES, scene)
}

/// Adds a texture of one's own to those that a scene may have, before it is planned.
pub fn add_texture<T: Pattern>(scene: &mut World) {
    let (table, entities) = (TableKind::of::<PatternTable<T>>(), |scene: &Census<'_>| scene.entities::<With<T>>());
    let added = Added { table, word: T::WORD, entities, stages: "of_texture" };
    add_kind::<T, _>(scene, Registered::of::<T>(), added);
}

/// Evidence that a shape is made of a material with such a texture.
pub fn texture_of_kind<T: Texture>(scene: &Census<'_>, noun: &str, such: impl Fn(&T) -> bool) -> Evidence {
    let in_use = in_use(scene);
    Evidence::among::<With<T>>(scene, noun, |entity| {
        in_use.contains(&entity.id()) && entity.get::<T>().is_some_and(&such)
    })
}

/// Evidence that a shape is made of a material with such a texture of colours, of any kind.
fn colours_evidence(
    scene: &Census<'_>,
    noun: impl Fn(&Registered) -> String,
    such: impl Fn(TextureBy, bool) -> bool,
) -> Evidence {
    let of_colours = textures(scene).filter(|own| own.feeds == Feeds::Colour);
    of_colours.map(|own| (own.evidence)(scene, &noun(own), &such)).reduce(Evidence::or).unwrap_or_default()
}

/// Evidence that a shape is made of a material with a texture of colours.
pub fn texture_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| colours_evidence(scene, |own| own.noun.into(), |_, _| true))
}

/// Evidence that a texture is filtered; those of other things than colours are not mentioned where none is.
pub fn filtered_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| {
        let noun = |own: &Registered| format!("filtered {}", own.pattern);
        let colours = colours_evidence(scene, noun, |_, is_filtered| is_filtered);
        let others = textures(scene).filter(|own| own.feeds != Feeds::Colour);
        let others = others.map(|own| (own.evidence)(scene, &noun(own), &|_, is_filtered| is_filtered));
        others.filter(|other| other.needed).fold(colours, Evidence::or)
    })
}

/// Evidence that a texture of colours is mapped by uv.
pub fn by_uv_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| colours_evidence(scene, |own| format!("{} by uv", own.pattern), |by, _| by == TextureBy::Uv))
}

/// Evidence that a texture of colours is mapped by uv and filtered.
pub fn filtered_by_uv_evidence(scene: &Census<'_>) -> Evidence {
    let noun = |own: &Registered| format!("filtered {} by uv", own.pattern);
    colours_evidence(scene, noun, |by, is_filtered| by == TextureBy::Uv && is_filtered)
}

/// The origin of a texture's coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TextureMapping {
    /// There is no texture.
    #[default]
    Nowhere,
    /// The surface parameters u and v.
    AlongUv,
    /// The point in the shape's object space.
    InSpace,
    /// The same, projected along the axis that the surface faces most.
    OnFaces,
}

/// The mapping of a material's texture: from uv or object space to the texture's own coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TextureMap {
    /// The origin of the coordinates.
    pub mapping: TextureMapping,
    /// The linear part of the map to texture coordinates.
    pub matrix: DMat3,
    /// The texture coordinates of the origin.
    pub shift: DVec3,
}

/// The texture mapping of each material, in the order of the materials.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TextureMaps {
    /// One for each material.
    pub map: Vec<TextureMap>,
}

impl Table for TextureMaps {
    const NAME: &'static str = "texture maps";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        check_owners(scene)?;
        let materials = material_entities(scene);
        let map = materials.iter().map(|&material| texture_map(scene, material));
        Ok(Self { map: map.collect::<Result<_, _>>()? })
    }

    fn bytes(&self) -> usize {
        self.map.len() * size_of::<TextureMap>()
    }
}

/// The texture mapping of a material's entity.
fn texture_map(scene: &Census<'_>, material: Entity) -> Result<TextureMap, SceneError> {
    let of_colours = textures(scene).filter(|own| own.feeds == Feeds::Colour);
    let map = of_colours.filter_map(|own| (own.map)(scene, material)).next();
    map.unwrap_or_else(|| Ok(TextureMap::default()))
}

/// The mapping of a texture of this kind: in object space the origin is the centre of a cell or image; in uv it is a corner.
fn map_of<T: Texture>(texture: &T, who: &str) -> Result<TextureMap, SceneError> {
    let matrix = texture.texture_from_surface(who)?;
    let (mapping, shift) = match (texture.by(), T::ON_FACES) {
        (TextureBy::Uv, _) => (TextureMapping::AlongUv, DVec3::ZERO),
        (TextureBy::Space, false) => (TextureMapping::InSpace, DVec3::splat(0.5)),
        (TextureBy::Space, true) => (TextureMapping::OnFaces, DVec3::splat(0.5)),
    };
    Ok(TextureMap { mapping, matrix, shift })
}

/// Checks that an entity with such a component is a material whose BSDF takes what it gives.
pub(super) fn check_owner(
    scene: &Census<'_>,
    (word, owner): (&str, Entity),
    (feeds, given): (Feeds, &str),
) -> Result<(), SceneError> {
    let refused =
        |value, accepted| Err(SceneError::new(kind_and_name(scene, word, owner), "material", value, accepted));
    if !is_material(scene, owner) {
        let first =
            registered_materials(scene).find(|material| material.takes(feeds)).map_or("Matte", |first| first.component);
        return refused("missing", format!("it belongs on an entity that is a material, such as one with a {first}"));
    }
    let material = one_material(scene, owner)?;
    if !material.takes(feeds) {
        let takers = components_in_words(scene, "a ", |material| material.takes(feeds));
        return refused(material.word, format!("{given}, as of {takers}"));
    }
    Ok(())
}

/// Checks that every texture of a material belongs to one, that its BSDF takes what the texture gives, and that it has one
/// texture of colours at most.
fn check_owners(scene: &Census<'_>) -> Result<(), SceneError> {
    let of_materials = textures(scene).filter(|own| !matches!(own.feeds, Feeds::Emission | Feeds::Opacity));
    let mut owned: Vec<(Entity, &Registered)> = of_materials
        .flat_map(|own| (own.owners)(scene).iter().map(move |&owner| (owner, own)).collect::<Vec<_>>())
        .collect();
    owned.sort_by_key(|(owner, _)| owner.index());
    for (at, &(owner, own)) in owned.iter().enumerate() {
        let given = match own.feeds {
            Feeds::Colour => "a texture colours diffuse reflection",
            Feeds::MetallicRoughness => "it gives a metallic and a roughness",
            Feeds::Normal => "it tilts normals",
            Feeds::Emission => "it changes an emission",
            Feeds::Opacity => "it opens a surface",
        };
        check_owner(scene, (own.word, owner), (own.feeds, given))?;
        let is_second =
            |(other, of): &&(Entity, &Registered)| *other == owner && [own.feeds, of.feeds] == [Feeds::Colour; 2];
        if let Some((_, other)) = owned[at + 1..].iter().take_while(|(other, _)| *other == owner).find(is_second) {
            let value = format!("given twice, as {} and as {}", own.word, other.word);
            let who = kind_and_name(scene, own.word, owner);
            return Err(SceneError::new(who, "texture", value, "a material may have one texture only"));
        }
    }
    Ok(())
}

/// Checks that a texture's colour and the albedo that its material has beside it add up to at most 1; `largest` is the
/// texture's maximum in each component.
pub(super) fn check_beside_colour(
    scene: &Census<'_>,
    material: Entity,
    (who, field, value): (&str, &'static str, String),
    largest: Rgb,
) -> Result<(), SceneError> {
    let beside = one_material(scene, material)?.albedo_beside_colour(scene, material);
    let Some(beside) = beside.filter(|own| (own.to_vec() + largest.to_vec()).max_element() > 1.0) else {
        return Ok(());
    };
    let (beside, largest) = (triple(beside.to_vec()), triple(largest.to_vec()));
    let accepted = format!(
        "its parts are at most {largest} and with the material's specular colour {beside} must add up to at most 1, for a \
         surface gives back no more than it gets"
    );
    Err(SceneError::new(who, field, value, accepted))
}

/// The row of each material among those with such a component, and the entities of these rows.
pub fn rows_of_texture<T: Component>(scene: &Census<'_>) -> (Vec<u32>, Vec<Entity>) {
    let (mut of_material, mut rows) = (Vec::new(), Vec::new());
    for &material in material_entities(scene).iter() {
        let carries = scene.get::<T>(material).is_some();
        of_material.push(if carries { rows.len() as u32 } else { NO_TEXTURE });
        rows.extend(carries.then_some(material));
    }
    (of_material, rows)
}

/// Each shape's object space, in the order of the shapes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShapeSpaces {
    /// Its origin, relative to the eye.
    pub origin: Vec<DVec3>,
    /// The linear map into it.
    pub shape_from_world: Vec<DMat3>,
    /// The linear map out of it.
    pub world_from_shape: Vec<DMat3>,
}

impl Table for ShapeSpaces {
    const NAME: &'static str = "shape spaces";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let eye = eye(scene)?;
        let mut table = Self::default();
        for &shape in shape_entities(scene).iter() {
            let pose = pose(scene, &kind_and_name(scene, "shape", shape), shape)?;
            table.origin.push(pose.world_from_entity.translation - eye);
            table.shape_from_world.push(pose.entity_from_world);
            table.world_from_shape.push(pose.world_from_entity.matrix3);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.origin.len() * (size_of::<DVec3>() + 2 * size_of::<DMat3>())
    }
}
