//! Textures: which materials have one, how it is mapped, and what it holds.

use super::Pyramid;
use super::area_lights::emissive_entities;
use super::cameras::eye;
use super::check::{kind_and_name, number, positive_length, reflectance, triple};
use super::image_files::{
    RemarkedTexels, alpha_image, check_memory_of_textures, emission_image, factor_image, normal_map_image, shown_name,
    texture_image,
};
use super::material::{in_use, material_kind_evidence};
use super::pose::pose;
use super::shapes::shape_entities;
use crate::each::Each;
use crate::material::{
    components_in_words, is_material, material_entities, media_entities, one_material, registered_materials,
};
use crate::plan::{Added, Census, Evidence, Table, TableKind, add_kind, check_is_added, counted, with_added};
use crate::scene::{
    Checker, EmissionMap, Emissive, Feeds, ImageTexture, MeshInstance, MetallicRoughnessMap, NormalMap, OpacityChannel,
    OpacityMap, Rgb, SceneError, Stripes, Texture, TextureBy, Tint, UvTransform, Wrap, WrapMode, for_each_texture,
};
use bevy_ecs::prelude::*;
use glam::{DMat2, DMat3, DVec2, DVec3};
use std::collections::BTreeMap;
use std::fmt::Debug;
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
        // Media, which come after the materials, have no texture.
        let media = media_entities(scene);
        let of_media = media.iter().map(|_| Ok(TextureMap::default()));
        Ok(Self { map: map.chain(of_media).collect::<Result<_, _>>()? })
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
    of_material.resize(of_material.len() + media_entities(scene).len(), NO_TEXTURE);
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

/// A point on a surface in the coordinates of its texture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TexturePoint {
    /// The texture coordinates, in units of the texture.
    pub point: DVec3,
    /// The pixel's offsets to the right and down.
    pub steps: [DVec3; 2],
}

impl TexturePoint {
    /// The same point without a footprint.
    #[inline(always)]
    pub fn alone(self) -> Self {
        Self { steps: [DVec3::ZERO; 2], ..self }
    }
}

/// A texture of colours that a formula gives, in place of the material's own.
pub trait Pattern: Texture + Clone + Debug + PartialEq {
    /// The name of its table, such as `checkers`.
    const TABLE: &'static str;
    /// The name of its stage, such as `Evaluate textures: checkers`.
    const STAGE: &'static str;
    /// Whether a program adds it.
    const IS_CUSTOM: bool = true;
    /// Albedos that none of its colours exceeds, by the names of their fields.
    fn albedos(&self) -> Vec<(&'static str, Rgb)>;
    /// The colour at a point: its mean over the pixel's footprint, which is 0 wide where it is not filtered.
    fn colour(&self, at: &TexturePoint) -> [f64; 3];
}

/// The textures of one kind that a formula gives, in spawn order.
#[derive(Clone, Debug, PartialEq)]
pub struct PatternTable<T> {
    /// The row of each material's texture; [`NO_TEXTURE`](super::NO_TEXTURE) where it has none of this kind.
    pub of_material: Vec<u32>,
    /// The textures.
    pub pattern: Vec<T>,
}

/// The checker textures.
pub type CheckerTable = PatternTable<Checker>;
/// The stripe textures.
pub type StripesTable = PatternTable<Stripes>;

impl<T: Pattern> Table for PatternTable<T> {
    const NAME: &'static str = T::TABLE;

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        if T::IS_CUSTOM {
            check_is_added::<Self>(scene, T::WORD, "add_texture")?;
        }
        let (of_material, rows) = rows_of_texture::<T>(scene);
        let mut table = Self { of_material, pattern: Vec::new() };
        for material in rows {
            let Some(pattern) = scene.get::<T>(material) else { continue };
            let who = kind_and_name(scene, T::WORD, material);
            for (field, colour) in pattern.albedos() {
                reflectance(&who, field, colour)?;
                check_beside_colour(scene, material, (&who, field, triple(colour.to_vec())), colour)?;
            }
            table.pattern.push(pattern.clone());
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.of_material[..]) + size_of_val(&self.pattern[..])
    }
}

/// The image textures of materials, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImageTable {
    /// The row of each material's image; [`NO_TEXTURE`](super::NO_TEXTURE) where it has none.
    pub of_material: Vec<u32>,
    /// The images in linear light; an image used by several materials is in memory once.
    pub pyramid: Vec<Arc<Pyramid>>,
    /// The image's width in units of its texture: its aspect ratio for object-space mapping, 1 for uv mapping.
    pub aspect: Vec<f64>,
    /// How each continues beyond its edges, along u and along v.
    pub wrap: Vec<[WrapMode; 2]>,
    /// What is done to the image's own coordinates before it is looked up, if anything.
    pub transform: Vec<Option<(DMat2, DVec2)>>,
    /// Whether each is filtered over a pixel's footprint.
    pub filter: Vec<bool>,
}

/// Checks that all image textures fit into memory together, before any is decoded.
fn check_memory(scene: &Census<'_>) -> Result<(), SceneError> {
    let owners = scene.entities::<With<ImageTexture>>();
    let files = owners.iter().filter_map(|&owner| scene.get::<ImageTexture>(owner)).map(|texture| &*texture.file);
    check_memory_of_textures(scene, files).map_err(|(count, too_little)| {
        let files = counted(count, "file");
        SceneError::new("the scene", "set of image textures", files, format!("decoding them {too_little}"))
    })
}

fn image_of(scene: &Census<'_>, owner: Entity) -> Result<Arc<Pyramid>, SceneError> {
    let file = scene.get::<ImageTexture>(owner).map_or("", |texture| &texture.file);
    let who = kind_and_name(scene, ImageTexture::WORD, owner);
    let image = texture_image(scene, &who, file)?;
    let [r, g, b] = image.brightest.each(f64::from);
    check_beside_colour(scene, owner, (&who, "file", shown_name(file)), Rgb::new(r, g, b))?;
    Ok(image)
}

impl Table for ImageTable {
    const NAME: &'static str = "images";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        check_memory(scene)?;
        let (of_material, rows) = rows_of_texture::<ImageTexture>(scene);
        let mut table = Self { of_material, ..Self::default() };
        for material in rows {
            let Some(texture) = scene.get::<ImageTexture>(material) else { continue };
            let image = image_of(scene, material)?;
            let aspect = image.levels[0].width as f64 / image.levels[0].height as f64;
            table.aspect.push(if texture.by == TextureBy::Uv { 1.0 } else { aspect });
            table.pyramid.push(image);
            table.wrap.push(texture.wrap.axes());
            table.transform.push(texture.transform.affine(&kind_and_name(scene, ImageTexture::WORD, material))?);
            table.filter.push(texture.filter);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        let images: BTreeMap<_, usize> =
            self.pyramid.iter().map(|pyramid| (Arc::as_ptr(pyramid), pyramid.bytes())).collect();
        self.of_material.len() * 4 + images.into_values().sum::<usize>()
    }
}

// Images over uv that are no colours: metallic and roughness, emission, and opacity.

/// A map: an image over uv, beside a material or its emission.
pub(super) trait UvMap: Texture {
    fn size(&self) -> f64;
    fn wrap(&self) -> Wrap;
    fn transform(&self) -> UvTransform;
    /// Reads its image.
    fn image(&self, scene: &World, who: &str) -> Result<Arc<Pyramid>, SceneError>;
}

/// What reads an image file, with who asks for it.
type ReadImage = fn(&World, &str, &str) -> Result<Arc<Pyramid>, SceneError>;

macro_rules! uv_map {
    ($map:ty, $read:expr) => {
        impl UvMap for $map {
            fn size(&self) -> f64 {
                self.size
            }
            fn wrap(&self) -> Wrap {
                self.wrap
            }
            fn transform(&self) -> UvTransform {
                self.transform
            }
            fn image(&self, scene: &World, who: &str) -> Result<Arc<Pyramid>, SceneError> {
                let read: fn(&Self) -> ReadImage = $read;
                read(self)(scene, who, &self.file)
            }
        }
    };
}

uv_map!(MetallicRoughnessMap, |_| factor_image);
uv_map!(EmissionMap, |_| emission_image);
uv_map!(OpacityMap, |map| match map.channel {
    OpacityChannel::Alpha => alpha_image,
    OpacityChannel::Red => factor_image,
});

/// Images over uv, in the order of the rows that they belong to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UvImages {
    /// The images; one that several rows use is in memory once.
    pub pyramid: Vec<Arc<Pyramid>>,
    /// The side of the image in units of uv.
    pub size: Vec<f64>,
    /// How each continues beyond its edges, along u and along v.
    pub wrap: Vec<[WrapMode; 2]>,
    /// What is done to the coordinates before each is looked up, if anything.
    pub transform: Vec<Option<(DMat2, DVec2)>>,
    /// Whether each is filtered over a pixel's footprint.
    pub filter: Vec<bool>,
}

impl UvImages {
    pub(super) fn push<M: UvMap>(&mut self, scene: &Census<'_>, owner: Entity, map: &M) -> Result<(), SceneError> {
        let who = kind_and_name(scene, M::WORD, owner);
        self.size.push(positive_length(&who, "size", map.size())?);
        self.wrap.push(map.wrap().axes());
        self.transform.push(map.transform().affine(&who)?);
        self.filter.push(map.is_filtered());
        self.pyramid.push(map.image(scene, &who)?);
        Ok(())
    }

    pub(super) fn bytes(&self) -> usize {
        let images: BTreeMap<_, usize> = self.pyramid.iter().map(|image| (Arc::as_ptr(image), image.bytes())).collect();
        images.into_values().sum()
    }
}

/// The images of metallic and roughness, in spawn order of their materials.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MetallicRoughnessTable {
    /// The row of each material's image; [`NO_TEXTURE`] where it has none.
    pub of_material: Vec<u32>,
    /// The images, roughness in green and metallic in blue.
    pub images: UvImages,
}

impl Table for MetallicRoughnessTable {
    const NAME: &'static str = "metallic–roughness maps";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (of_material, rows) = rows_of_texture::<MetallicRoughnessMap>(scene);
        let mut table = Self { of_material, ..Self::default() };
        for material in rows {
            let Some(map) = scene.get::<MetallicRoughnessMap>(material) else { continue };
            table.images.push(scene, material, map)?;
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.of_material.len() * 4 + self.images.bytes()
    }
}

/// Checks that the brightest texel of the last image times the radiance is a number that f32 holds.
fn check_brightest(scene: &Census<'_>, emissive: Entity, images: &UvImages) -> Result<(), SceneError> {
    let radiance = scene.get::<Emissive>(emissive).map_or([0.0; 3], |own| own.radiance.to_array());
    let brightest = images.pyramid.last().map_or([0.0; 3], |image| image.brightest.each(f64::from));
    let max = [0, 1, 2].each(|part| radiance[part] * brightest[part]).into_iter().fold(0.0, f64::max);
    if max <= f64::from(f32::MAX) {
        return Ok(());
    }
    let value = format!("an image whose brightest texel makes the radiance {max:.2e}");
    let who = kind_and_name(scene, EmissionMap::WORD, emissive);
    Err(SceneError::new(who, "file", value, "the product of the two must be at most 3.4e38"))
}

/// The images of emission, in spawn order of the emissive surfaces.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EmissionMapTable {
    /// The row of each emissive surface's image; [`NO_TEXTURE`] where it has none.
    pub of_emissive: Vec<u32>,
    /// The images in linear light.
    pub images: UvImages,
}

impl Table for EmissionMapTable {
    const NAME: &'static str = "emission maps";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        for &owner in scene.entities::<With<EmissionMap>>().iter() {
            if scene.get::<Emissive>(owner).is_none() {
                let accepted =
                    "an emission map belongs on an entity with an Emissive, whose radiance it is a factor of";
                let who = kind_and_name(scene, EmissionMap::WORD, owner);
                return Err(SceneError::new(who, "emission", "missing", accepted));
            }
        }
        let mut table = Self::default();
        for &emissive in emissive_entities(scene).iter() {
            let Some(map) = scene.get::<EmissionMap>(emissive) else {
                table.of_emissive.push(NO_TEXTURE);
                continue;
            };
            table.of_emissive.push(table.images.size.len() as u32);
            table.images.push(scene, emissive, map)?;
            check_brightest(scene, emissive, &table.images)?;
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.of_emissive.len() * 4 + self.images.bytes()
    }
}

/// Evidence that a shape is made of a material with a map of metallic and roughness.
pub fn metallic_roughness_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| texture_of_kind::<MetallicRoughnessMap>(scene, MetallicRoughnessMap::NOUN, |_| true))
}

/// Evidence that a map of metallic and roughness is filtered.
pub fn filtered_roughness_evidence(scene: &Census<'_>) -> Evidence {
    texture_of_kind(scene, "filtered metallic–roughness map", MetallicRoughnessMap::is_filtered)
}

/// Evidence that a shape's emission has a map.
pub fn emission_map_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| texture_of_kind::<EmissionMap>(scene, EmissionMap::NOUN, |_| true))
}

/// Evidence that a map of emission is filtered.
pub fn filtered_emission_evidence(scene: &Census<'_>) -> Evidence {
    texture_of_kind(scene, "filtered emission map", EmissionMap::is_filtered)
}

const WORD: &str = "normal map";

/// The normal maps of materials, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NormalMapTable {
    /// The row of each material's map; [`NO_TEXTURE`](super::NO_TEXTURE) where it has none.
    pub of_material: Vec<u32>,
    /// The images, each part from 0 to 1; an image used by several materials is in memory once.
    pub image: Vec<Arc<RemarkedTexels>>,
    /// The factor of the parts along the surface.
    pub scale: Vec<f64>,
    /// The side of the image in units of uv.
    pub size: Vec<f64>,
    /// How each continues beyond its edges, along u and along v.
    pub wrap: Vec<[WrapMode; 2]>,
    /// What is done to the coordinates before the map is looked up, if anything.
    pub transform: Vec<Option<(DMat2, DVec2)>>,
}

impl Table for NormalMapTable {
    const NAME: &'static str = "normal maps";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let materials = material_entities(scene);
        for &owner in scene.entities::<With<NormalMap>>().iter() {
            if !materials.contains(&owner) {
                let accepted = "a normal map belongs on an entity that is a material, such as one with a Matte";
                return Err(SceneError::new(kind_and_name(scene, WORD, owner), "material", "missing", accepted));
            }
        }
        let (of_material, rows) = rows_of_texture::<NormalMap>(scene);
        let mut table = Self { of_material, ..Self::default() };
        for material in rows {
            let Some(map) = scene.get::<NormalMap>(material) else { continue };
            let who = kind_and_name(scene, WORD, material);
            if !map.scale.is_finite() {
                return Err(SceneError::new(who, "scale", number(map.scale), "it must be a finite number"));
            }
            table.scale.push(map.scale);
            table.size.push(positive_length(&who, "size", map.size)?);
            table.wrap.push(map.wrap.axes());
            table.transform.push(map.transform.affine(&who)?);
            table.image.push(normal_map_image(scene, &who, &map.file)?);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        let images: BTreeMap<_, usize> =
            self.image.iter().map(|image| (Arc::as_ptr(image), image.texels.bytes())).collect();
        self.of_material.len() * 4 + images.into_values().sum::<usize>()
    }
}

/// Evidence that a shape is made of a material with a normal map.
pub fn normal_map_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| material_kind_evidence::<NormalMap>(scene, WORD))
}

/// The tints of materials, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TintTable {
    /// The row of each material's tint; [`NO_TEXTURE`] where it has none.
    pub of_material: Vec<u32>,
    /// The factor of the colour.
    pub factor: Vec<[f64; 3]>,
    /// Whether the colours of a mesh's vertices are a factor, too.
    pub by_vertex: Vec<bool>,
}

impl TintTable {
    /// The row of a material's tint, if it has one.
    #[inline(always)]
    pub fn row_of(&self, material: usize) -> Option<usize> {
        let row = self.of_material[material];
        (row != NO_TEXTURE).then_some(row as usize)
    }
}

impl Table for TintTable {
    const NAME: &'static str = "tints";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (of_material, rows) = rows_of_texture::<Tint>(scene);
        let mut table = Self { of_material, ..Self::default() };
        for &owner in scene.entities::<With<Tint>>().iter() {
            check_owner(scene, ("tint", owner), (Feeds::Colour, "a tint multiplies the colour of diffuse reflection"))?;
        }
        for material in rows {
            let Some(tint) = scene.get::<Tint>(material) else { continue };
            let who = kind_and_name(scene, "tint", material);
            table.factor.push(reflectance(&who, "factor", tint.factor)?.to_array());
            table.by_vertex.push(tint.by_vertex);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.of_material.len() * 4 + self.factor.len() * (size_of::<[f64; 3]>() + size_of::<bool>())
    }
}

/// Evidence that a shape is made of a material with a tint.
pub fn tint_evidence(scene: &Census<'_>) -> Evidence {
    scene.once(|scene| material_kind_evidence::<Tint>(scene, "tinted material"))
}

/// Evidence that a surface's colour is not that of its material everywhere.
pub fn surface_colour_evidence(scene: &Census<'_>) -> Evidence {
    let tint = tint_evidence(scene);
    let texture = texture_evidence(scene);
    if tint.needed { texture.or(tint) } else { texture }
}

/// Evidence that a mesh has colours of its vertices, and a material is tinted.
pub fn vertex_colour_evidence(scene: &Census<'_>) -> Evidence {
    let has = |mesh| scene.get::<MeshInstance>(mesh).is_some_and(|mesh| mesh.geometry.colours.is_some());
    tint_evidence(scene).and(|| Evidence::of_kind::<With<MeshInstance>>(scene, "mesh with colours", has))
}
