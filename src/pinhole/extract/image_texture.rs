use super::Pyramid;
use super::check::kind_and_name;
use super::image_file::{check_memory_of_textures, shown_name, texture_image};
use super::texture::{check_beside_colour, rows_of_texture};
use crate::plan::{Census, Table, counted};
use crate::scene::{ImageTexture, Rgb, SceneError, Texture, TextureBy, WrapMode};
use bevy_ecs::prelude::*;
use glam::{DMat2, DVec2};
use std::collections::BTreeMap;
use std::sync::Arc;

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
    let [r, g, b] = image.brightest.map(f64::from);
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
