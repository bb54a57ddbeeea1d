//! Scenes beside what one mistake makes of them.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::picture::Picture;
use super::svg::Drawing;
use crate::naive::mistake::{
    glass_that_keeps_beams_narrow, light_samples_counted_in_full, metal_counted_as_matte, sky_in_all_directions_alike,
};
use bevy_ecs::prelude::*;
use pinhole::Chapter;
use pinhole::Result;
use pinhole::plan::Stage;
use pinhole::scene::{Glass, Sampling};

const SIZE: [u32; 2] = [276, 155];

/// So many samples a pixel.
fn sampled(samples: u32) -> impl Fn(&mut EntityWorldMut<'_>) + Copy {
    move |camera| {
        camera.insert(Sampling { samples, seed: 19, ..Sampling::default() });
    }
}

fn exhibit(picture: Result<Picture>, [what, why]: [&str; 2]) -> Result<Exhibit> {
    Ok(Exhibit { picture: picture?, lines: vec![what.to_owned(), why.to_owned()] })
}

/// Right, and with one stage more that spoils it.
fn spoiled(chapter: &Chapter, figure: &Figure, samples: u32, stage: Stage, lines: [&str; 2]) -> Result<Drawing> {
    let exhibits = [
        exhibit(Picture::of(chapter, SIZE, None, sampled(samples)), ["right", "as it should be"])?,
        exhibit(Picture::beside(chapter, SIZE, Some(stage), sampled(samples)), lines)?,
    ];
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, SIZE)))
}

/// Right, and with another stage in the place of those that do the same.
fn replaced(chapter: &Chapter, figure: &Figure, samples: u32, stage: Stage, lines: [&str; 2]) -> Result<Drawing> {
    let exhibits = [
        exhibit(Picture::of(chapter, SIZE, None, sampled(samples)), ["right", "as it should be"])?,
        exhibit(Picture::of(chapter, SIZE, Some(stage), sampled(samples)), lines)?,
    ];
    Ok(hang(figure, &exhibits, 2, &gallery_foot(chapter, figure, SIZE)))
}

/// Rough metal by the wrong pdf.
pub fn draw_metal(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let lines = ["the wrong pdf", "microfacets sampled, a matte pdf"];
    spoiled(chapter, figure, 8, metal_counted_as_matte(), lines)
}

/// Glass that bends the wrong way, and glass that keeps beams narrow.
pub fn draw_glass(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let upside_down = |camera: &mut EntityWorldMut<'_>| {
        sampled(2)(camera);
        camera.world_scope(|world| {
            world.query::<&mut Glass>().iter_mut(world).for_each(|mut glass| glass.ior = 1.0 / glass.ior);
        });
    };
    let keep_closest = Picture::beside(chapter, SIZE, Some(glass_that_keeps_beams_narrow()), sampled(2));
    let exhibits = [
        exhibit(Picture::of(chapter, SIZE, None, sampled(2)), ["right", "as it should be"])?,
        exhibit(Picture::of(chapter, SIZE, None, upside_down), ["*η* upside down", "as if air were the denser"])?,
        exhibit(keep_closest, ["*η*² forgotten on the way out", "beams stay narrow, and dark"])?,
    ];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}

/// A sky without the cosine.
pub fn draw_sky(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let lines = ["the missing cosine", "light that grazes counts in full"];
    replaced(chapter, figure, 16, sky_in_all_directions_alike(), lines)
}

/// Two ways to find a light, both counted.
pub fn draw_weights(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let lines = ["light samples without a weight", "found twice, counted twice"];
    replaced(chapter, figure, 8, light_samples_counted_in_full(), lines)
}
