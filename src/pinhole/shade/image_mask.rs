use super::Radiance;
use crate::cameras::{Camera, Listed, with_cameras};
use crate::plan::{Column, Evidence, Shared, Stage, StageKind, TileSystems, VectorRowsMut};
use crate::rays::ScreenPoints;
use bevy_ecs::prelude::*;

/// Blackens the samples outside a camera's outline; they still count, so that its edge is antialiased.
pub fn mask_image<C: Listed>(projection: Res<Shared<C>>, mut tiles: Query<(&ScreenPoints, &mut Radiance)>) {
    for (screen, mut radiance) in &mut tiles {
        let mut radiance = radiance.slices_mut(screen.rows());
        for row in 0..screen.rows() {
            if !projection.is_in_image(screen.point(row)) {
                radiance.put(row, [0.0; 3]);
            }
        }
    }
}

/// The stage that runs [`mask_image`] for cameras of one kind, which has an outline.
pub fn image_mask_stage<C: Listed>() -> Stage {
    let name = C::OUTLINE.map_or("Mask the image", |outline| outline.stage);
    Stage::new(name, TileSystems::Mask, mask_image::<C>)
        .kind(StageKind::Alternative)
        .when(|scene| Evidence::of::<C::Component>(scene, &format!("{} camera", C::NAMES.noun)))
}

macro_rules! stages {
    ($($component:ident($camera:ty) $noun:literal,)+) => {
        /// The stages of all cameras that have an outline.
        pub fn image_mask_stages() -> Vec<fn() -> Stage> {
            let all: Vec<(bool, fn() -> Stage)> =
                vec![$((<$camera>::OUTLINE.is_some(), image_mask_stage::<$camera>)),+];
            all.into_iter().filter(|(has_outline, _)| *has_outline).map(|(_, stage)| stage).collect()
        }
    };
}
with_cameras!(stages);
