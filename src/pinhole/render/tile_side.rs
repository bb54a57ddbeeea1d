use crate::extract::{delta_light_rays, shape_entities};
use crate::plan::{Census, ColumnKind, Plan};
use crate::shade::{LightPdfs, ShadowHits, ShadowRays};

/// The greatest memory for the shadow rays of a worker's tile, in bytes, without the spare capacity of the lists.
const MAX_BYTES: f64 = (16_u32 << 20) as f64;
/// The greatest number of ray–shape tests in one stage of a tile, which take some tenths of a second; a render can be
/// stopped only between stages.
const MAX_TESTS: f64 = (1_u32 << 28) as f64;
/// With tiles of one pixel, the film would take more memory than the columns save.
const MIN: u32 = 2;

/// The side of a full tile, in pixels: at most this, and less where many lights or shapes would make its columns large
/// or its stages slow.
///
/// Every pixel sends a shadow ray to each of a few lights without an area, and those of a tile are in memory at once.
/// No bit of the image depends on the side.
pub(super) fn tile_side(scene: &Census<'_>, plan: &Plan, max: u32) -> u32 {
    let of_light =
        |column: &&ColumnKind| column.is::<ShadowRays>() || column.is::<LightPdfs>() || column.is::<ShadowHits>();
    let columns = plan.columns.iter().filter(of_light);
    let bytes: usize = columns.map(|column| column.bytes_per_row()).sum();
    let lights = if bytes > 0 { delta_light_rays(scene).max(1) } else { 1 } as f64;
    let shapes = shape_entities(scene).len().max(1) as f64;
    let mut side = max;
    while side > MIN {
        let rays = f64::from(side) * f64::from(side) * lights;
        if rays * bytes as f64 <= MAX_BYTES && rays * shapes <= MAX_TESTS {
            break;
        }
        side = (side / 2).max(MIN);
    }
    side
}
