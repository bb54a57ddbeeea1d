//! Images over uv that are no colours: metallic and roughness, emission, and opacity.

use super::Pyramid;
use super::check::{kind_and_name, positive_length};
use super::emissive::emissive_entities;
use super::image_file::{alpha_image, emission_image, factor_image};
use super::texture::{NO_TEXTURE, rows_of_texture, texture_of_kind};
use crate::plan::{Census, Evidence, Table};
use crate::scene::{
    EmissionMap, Emissive, MetallicRoughnessMap, OpacityChannel, OpacityMap, SceneError, Texture, UvTransform, Wrap,
    WrapMode,
};
use bevy_ecs::prelude::*;
use glam::{DMat2, DVec2};
use std::collections::BTreeMap;
use std::sync::Arc;

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
    let brightest = images.pyramid.last().map_or([0.0; 3], |image| image.brightest.map(f64::from));
    let max = [0, 1, 2].map(|part| radiance[part] * brightest[part]).into_iter().fold(0.0, f64::max);
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
