use super::check::{kind_and_name, number, positive_length};
use super::image_file::{RemarkedTexels, normal_map_image};
use super::material::material_kind_evidence;
use super::texture::rows_of_texture;
use crate::material::material_entities;
use crate::plan::{Census, Evidence, Table};
use crate::scene::{NormalMap, SceneError, WrapMode};
use bevy_ecs::prelude::*;
use glam::{DMat2, DVec2};
use std::collections::BTreeMap;
use std::sync::Arc;

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
