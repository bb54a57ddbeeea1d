//! The reader's function in the picture of chapter 06: NDC points and back to pixels.

use super::question::{Input, Pixel};
use bevy_ecs::prelude::*;
use glam::DVec2;
use pinhole::extract::ImageFrame;
use pinhole::plan::{Column, Shared};
use pinhole::rays;
use pinhole::rays::{NdcPoints, ndc_from_raster, raster_from_pixel};
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// Every NDC point moved to the centre of the pixel that the reader's function finds it in; outside, it is (0, 0).
pub fn mine(ask: Ask<Input, Pixel>, setting: &Setting<'_>) -> StandIn {
    let size = setting.resolution();
    StandIn::after(
        rays::ndc_stage,
        move |image: Res<Shared<ImageFrame>>, mut tiles: Query<(RowPlaces, &mut NdcPoints)>| {
            for (place, mut ndc) in &mut tiles {
                for row in 0..ndc.rows() {
                    let asked = ([ndc.x[row], ndc.y[row]], size.width, size.height);
                    if let Some(pixel) = ask.at(place, row, asked) {
                        let centre = |[x, y]: [u32; 2]| ndc_from_raster(raster_from_pixel(x, y), image.size());
                        (ndc.x[row], ndc.y[row]) = pixel.map_or(DVec2::ZERO, centre).into();
                    }
                }
            }
        },
    )
}
