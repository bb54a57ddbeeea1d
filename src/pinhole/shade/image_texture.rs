use super::lookup::{image_mean, nearest_texel, transformed};
use super::{SurfaceColours, TexturePoints};
use crate::extract::TexturePoint;
use crate::extract::{ImageTable, NO_TEXTURE, texture_of_kind};
use crate::intersect::{MaterialRows, Surfaces};
use crate::plan::{Shared, Stage, TileSystems};
use crate::scene::ImageTexture;
use bevy_ecs::prelude::*;
use glam::DVec3;

/// Evaluates the colours of materials with an image texture.
pub fn evaluate_images(
    images: Res<Shared<ImageTable>>,
    mut tiles: Query<(&Surfaces, &MaterialRows, &TexturePoints, &mut SurfaceColours)>,
) {
    for (surfaces, list, points, mut colours) in &mut tiles {
        for &row in &list.row {
            let row = row as usize;
            let texture = images.of_material[surfaces.material[row] as usize];
            if texture == NO_TEXTURE {
                continue;
            }
            let texture = texture as usize;
            let (pyramid, wrap) = (&images.pyramid[texture], images.wrap[texture]);
            let mut at = points.get(row);
            if images.aspect[texture] != 1.0 {
                at = about_the_middle(at, images.aspect[texture]);
            }
            at = transformed(at, &images.transform[texture]);
            let colour = if images.filter[texture] {
                image_mean(pyramid, &at, wrap)
            } else {
                nearest_texel(&pyramid.levels[0], at.point.truncate(), wrap)
            };
            colours.set(row, colour);
        }
    }
}

/// The same point with its second coordinate stretched about the image's middle.
#[inline(always)]
fn about_the_middle(at: TexturePoint, aspect: f64) -> TexturePoint {
    let stretched = |step: DVec3| DVec3::new(step.x, step.y * aspect, step.z);
    let point = DVec3::new(at.point.x, 0.5 + (at.point.y - 0.5) * aspect, 0.0);
    TexturePoint { point, steps: at.steps.map(stretched) }
}

/// The stage that runs [`evaluate_images`].
pub fn image_stage() -> Stage {
    Stage::new("Evaluate textures: images", TileSystems::Texture, evaluate_images)
        .when(|scene| texture_of_kind::<ImageTexture>(scene, "image texture", |_| true))
}
