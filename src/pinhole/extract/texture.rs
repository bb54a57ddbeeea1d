use super::camera::eye;
use super::check::{kind_and_name, positive_length, triple};
use super::material::in_use;
use super::pose::pose;
use super::shape_kind::shape_entities;
use crate::material::{REGISTERED, components_in_words, is_material, material_entities, one_material};
use crate::plan::{Census, Evidence, Table};
use crate::scene::{Checker, Feeds, ImageTexture, Rgb, SceneError, Stripes, Texture, TextureBy, for_each_texture};
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
        }
    }
}

macro_rules! registered {
    ($($texture:ident),+) => {
        /// All textures.
        pub(super) const TEXTURES: &[Registered] = &[$(Registered::of::<crate::scene::$texture>()),+];
    };
}
for_each_texture!(registered);

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
    let of_colours = TEXTURES.iter().filter(|own| own.feeds == Feeds::Colour);
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
        let others = TEXTURES.iter().filter(|own| own.feeds != Feeds::Colour);
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
    if let Some(checker) = scene.get::<Checker>(material) {
        let size = size_of_texture::<Checker>(scene, material, checker.size)?;
        return Ok(mapping_by(checker.by, DMat3::from_diagonal(DVec3::splat(1.0 / size))));
    }
    if let Some(stripes) = scene.get::<Stripes>(material) {
        let size = size_of_texture::<Stripes>(scene, material, stripes.size)?;
        let mut across = stripes.across;
        if stripes.by == TextureBy::Uv {
            across.z = 0.0;
        }
        let longest = across.abs().max_element();
        if !(longest > 0.0 && across.is_finite()) {
            let accepted = match stripes.by {
                TextureBy::Uv => "its x and y, along u and v, must be a finite direction other than 0",
                TextureBy::Space => "it must be a finite direction other than 0",
            };
            let who = kind_and_name(scene, Stripes::WORD, material);
            return Err(SceneError::new(who, "across", triple(stripes.across), accepted));
        }
        let row = (across / longest).normalize() / size;
        return Ok(mapping_by(stripes.by, DMat3::from_cols(row, DVec3::ZERO, DVec3::ZERO).transpose()));
    }
    if let Some(image) = scene.get::<ImageTexture>(material) {
        let size = size_of_texture::<ImageTexture>(scene, material, image.size)?;
        let map = mapping_by(image.by, DMat3::from_diagonal(DVec3::splat(1.0 / size)));
        return Ok(if image.by == TextureBy::Space {
            TextureMap { mapping: TextureMapping::OnFaces, ..map }
        } else {
            map
        });
    }
    Ok(TextureMap::default())
}

/// In object space the origin is the centre of a cell or image; in uv it is a corner.
fn mapping_by(by: TextureBy, matrix: DMat3) -> TextureMap {
    match by {
        TextureBy::Uv => TextureMap { mapping: TextureMapping::AlongUv, matrix, shift: DVec3::ZERO },
        TextureBy::Space => TextureMap { mapping: TextureMapping::InSpace, matrix, shift: DVec3::splat(0.5) },
    }
}

fn size_of_texture<T: Texture>(scene: &Census<'_>, material: Entity, size: f64) -> Result<f64, SceneError> {
    positive_length(&kind_and_name(scene, T::WORD, material), "size", size)
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
        let first = REGISTERED.iter().find(|material| material.takes(feeds)).map_or("Matte", |first| first.component);
        return refused("missing", format!("it belongs on an entity that is a material, such as one with a {first}"));
    }
    let material = one_material(scene, owner)?;
    if !material.takes(feeds) {
        let takers = components_in_words("a ", |material| material.takes(feeds));
        return refused(material.word, format!("{given}, as of {takers}"));
    }
    Ok(())
}

/// Checks that every texture of a material belongs to one, that its BSDF takes what the texture gives, and that it has one
/// texture of colours at most.
fn check_owners(scene: &Census<'_>) -> Result<(), SceneError> {
    let of_materials = TEXTURES.iter().filter(|own| !matches!(own.feeds, Feeds::Emission | Feeds::Opacity));
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
pub(super) fn rows_of_kind<T: Component>(scene: &Census<'_>) -> (Vec<u32>, Vec<Entity>) {
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
