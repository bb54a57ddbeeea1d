//! The reader's function in the picture of chapter 35: the whole film is smoothed with it.

use super::question::Input;
use bevy_ecs::prelude::*;
use glam::DVec3;
use pinhole::Overrides;
use pinhole::extract::camera_entity;
use pinhole::film::{FilmTile, GUIDES, Guides, denoise, film_stage};
use pinhole::plan::Column;
use pinhole::rays::{PixelSamples, RasterPoints};
use pinhole::render::{Execution, render};
use pinhole::scene::{Layers, Sampling};
use pinhole_lab::exercise::{Ask, Setting, StandIn};
use pinhole_lab::naive::denoise::{LEVELS, denoised, image_of};

/// The picture through the filter, each neighbour counted as the reader's function says.
pub fn mine(ask: Ask<Input, f64>, setting: &Setting<'_>) -> StandIn {
    let width = setting.resolution().width as usize;
    let picture = smoothed(&ask, setting).unwrap_or_default();
    StandIn::instead(film_stage, move |mut tiles: Query<(&RasterPoints, Option<&PixelSamples>, &mut FilmTile)>| {
        for (raster, samples, mut film) in &mut tiles {
            for row in 0..raster.rows() {
                let pixel = samples.map_or(row, |samples| samples.pixel[row] as usize);
                let [x, y] = film.tile.pixel_of(pixel).map(|at| at as usize);
                film.add(pixel, picture.get(y * width + x).copied().unwrap_or_default());
            }
        }
    })
}

/// The chapter's own film, smoothed in plain code; none where the function cannot answer, or nothing is rendered.
fn smoothed(ask: &Ask<Input, f64>, setting: &Setting<'_>) -> Option<Vec<[f32; 3]>> {
    // The same scene again, with the layers that guide the filter.
    let layers = Some(Layers { kinds: GUIDES.to_vec() });
    let asked = Overrides { resolution: Some(setting.resolution()), layers, ..Overrides::default() };
    let mut scene = setting.chapter.world(&asked);
    if let (Ok(camera), Some(sampling)) = (camera_entity(&scene), setting.camera::<Sampling>()) {
        scene.entity_mut(camera).insert(*sampling);
    }
    let rendered = render(&scene, &setting.chapter.stages(), &Execution::default(), &());
    let film = rendered.map_err(|error| ask.complain(error.to_string())).ok()?.film;
    let guides = Guides::of(&film)?;
    // Without levels the denoiser leaves a film as it is.
    let image = image_of(&denoise(&film, 0)?, &guides);
    let smooth = denoised(image, LEVELS, |own, other| {
        // The sky has no surface.
        if own.normal == DVec3::ZERO || other.normal == DVec3::ZERO {
            return 0.0;
        }
        let offset = other.position - own.position;
        ask.once((own.normal.into(), other.normal.into(), offset.into())).unwrap_or(0.0)
    });
    let albedo = |at: usize| guides.albedo.each_ref().map(|part| part[at]);
    let light = |(at, light): (usize, DVec3)| [0, 1, 2].map(|part| light[part] as f32 * albedo(at)[part]);
    Some(smooth.pixels.iter().map(|pixel| pixel.light).enumerate().map(light).collect())
}
