use crate::plan::{Column, Evidence, Stage, TileSystems, column};
use crate::rays::RasterPoints;
use bevy_ecs::prelude::*;

column! {
    /// The radiance that each ray carries to its origin.
    pub struct Radiance("radiance", "light", "linear Rec. 709", Ray, begun in Start) {
        /// Red.
        r: f32,
        /// Green.
        g: f32,
        /// Blue.
        b: f32,
    }
}

impl Radiance {
    /// The values themselves, without the sRGB curve that the picture gets.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.r[row], self.g[row], self.b[row]]
    }
}

/// Sets the radiance of every row of a tile to zero.
pub fn start_radiance(mut tiles: Query<(&RasterPoints, &mut Radiance)>) {
    for (raster, mut radiance) in &mut tiles {
        let (r, g, b) = radiance.slices_mut(raster.rows());
        r.fill(0.0);
        g.fill(0.0);
        b.fill(0.0);
    }
}

/// The stage that runs [`start_radiance`].
pub fn start_stage() -> Stage {
    Stage::new("Clear radiance", TileSystems::Start, start_radiance)
        .on_first_bounce()
        .on_camera_paths()
        .when(|_| Evidence::always("light is added to it"))
}
