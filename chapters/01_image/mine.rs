//! The reader's function in the picture of chapter 01: raster points from the numbers of pixels.

use super::question::Input;
use bevy_ecs::prelude::*;
use pinhole::plan::Column;
use pinhole::rays;
use pinhole::rays::RasterPoints;
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// Every pixel's centre by its number in the image.
pub fn mine(ask: Ask<Input, [f64; 2]>, setting: &Setting<'_>) -> StandIn {
    let width = setting.resolution().width;
    StandIn::after(rays::raster_stage, move |mut tiles: Query<(RowPlaces, &mut RasterPoints)>| {
        for (place, mut raster) in &mut tiles {
            for row in 0..raster.rows() {
                let [x, y] = place.0.pixel_of(row);
                let index = u64::from(y) * u64::from(width) + u64::from(x);
                if let Some([x, y]) = ask.at(place, row, (index, width)) {
                    (raster.x[row], raster.y[row]) = (x, y);
                }
            }
        }
    })
}
