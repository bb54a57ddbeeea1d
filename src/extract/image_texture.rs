use super::check::kind_and_name;
use super::image_file::{Numbers, read_texels, shortened};
use super::phong::beside_highlight;
use super::texture::{Texture, rows_of_kind};
use super::{Pyramid, Texels};
use crate::plan::{Table, entities};
use crate::scene::{ImageTexture, Refusal, Rgb, TextureBy, Wrap};
use bevy_ecs::prelude::*;

/// The materials that are coloured by an image, in spawn order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImageTable {
    /// The row of each material's image; [`NO_TEXTURE`](super::NO_TEXTURE) where it has none.
    pub of_material: Vec<u32>,
    /// The images, in linear light.
    pub pyramid: Vec<Pyramid>,
    /// How often the image is as high as its texture's unit: its width over its height by space, 1 by uv.
    pub aspect: Vec<f64>,
    /// What there is beyond their edges.
    pub wrap: Vec<Wrap>,
    /// Whether a pixel gets a mean of what it covers.
    pub filter: Vec<bool>,
}

/// Checks every image texture's file.
pub(super) fn check_images(scene: &World) -> Result<(), Refusal> {
    entities::<With<ImageTexture>>(scene).into_iter().try_for_each(|owner| image_of(scene, owner).map(|_| ()))
}

fn image_of(scene: &World, owner: Entity) -> Result<Texels, Refusal> {
    let file = scene.get::<ImageTexture>(owner).map_or("", |texture| &texture.file);
    let who = kind_and_name(scene, ImageTexture::WORD, owner);
    let texels = read_texels(scene, &who, file, Numbers::Shares)?;
    let [r, g, b] = [0, 1, 2].map(|part| texels.rgb.iter().map(|texel| texel[part]).fold(0.0, f32::max).into());
    beside_highlight(scene, owner, (&who, "file", shortened(&format!("{file:?}"))), Rgb::new(r, g, b))?;
    Ok(texels)
}

impl Table for ImageTable {
    const NAME: &'static str = "images";

    fn extract(scene: &World) -> Result<Self, Refusal> {
        let (of_material, rows) = rows_of_kind::<ImageTexture>(scene);
        let mut table = Self { of_material, ..Self::default() };
        for material in rows {
            let Some(texture) = scene.get::<ImageTexture>(material) else { continue };
            let image = image_of(scene, material)?;
            let aspect = image.width as f64 / image.height as f64;
            table.aspect.push(if texture.by == TextureBy::Uv { 1.0 } else { aspect });
            table.pyramid.push(Pyramid::on(image));
            table.wrap.push(texture.wrap);
            table.filter.push(texture.filter);
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        self.of_material.len() * 4 + self.pyramid.iter().map(Pyramid::bytes).sum::<usize>()
    }
}
