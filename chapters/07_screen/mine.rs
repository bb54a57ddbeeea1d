//! The reader's function in the picture of chapter 07: screen points and back.

use super::question::Input;
use bevy_ecs::prelude::*;
use pinhole::extract::ImageFrame;
use pinhole::plan::{Column, Shared};
use pinhole::rays;
use pinhole::rays::{ScreenPoints, screen_from_ndc};
use pinhole_lab::exercise::{Ask, RowPlaces, Setting, StandIn};

/// Every screen point taken to NDC by the reader's function, and back by pinhole's: what undoes it leaves it in place.
pub fn mine(ask: Ask<Input, [f64; 2]>, setting: &Setting<'_>) -> StandIn {
    let size = setting.resolution();
    StandIn::after(
        rays::screen_stage,
        move |image: Res<Shared<ImageFrame>>, mut tiles: Query<(RowPlaces, &mut ScreenPoints)>| {
            for (place, mut screen) in &mut tiles {
                for row in 0..screen.rows() {
                    let asked = ([screen.x[row], screen.y[row]], size.width, size.height);
                    if let Some(ndc) = ask.at(place, row, asked) {
                        (screen.x[row], screen.y[row]) = screen_from_ndc(ndc.into(), image.aspect()).into();
                    }
                }
            }
        },
    )
}
