use crate::each::Each;
use crate::extract::{FilterTable, ImageFrame, LayerTable, LightTracingTable, SamplingTable, adaptive_of};
use crate::film::{BLOCK, FilmLayers, FilmMoments, MATTE_BYTES};
use crate::follow::{LIGHT_VERTEX_BYTES, LightVertices, PHOTON_BYTES, Photons, Splats};
use crate::plan::{Census, Plan};
use crate::scene::{Filter, LayerKind, SceneError, TooLittleMemory, called, check_memory};
use bevy_ecs::prelude::*;

/// The peak memory of this process, in bytes; none where the system does not report it.
pub fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kibibytes: u64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kibibytes * 1024)
}

/// The light vertices of a path that are reckoned with.
const VERTICES: f64 = 8.0;

/// Bytes that a render of a scene takes per pixel of its film, and of photons or light vertices for each sample of a pixel.
pub fn film_bytes_per_pixel(scene: &Census<'_>, plan: &Plan) -> Result<u64, SceneError> {
    const THREE: u64 = 3 * size_of::<f64>() as u64;
    const COUNT: u64 = size_of::<u32>() as u64;
    // The sums of earlier blocks of samples stand beside those of the block in progress.
    let sums = if scene.table::<SamplingTable>()?.samples > BLOCK { 2 } else { 1 };
    let mut film = sums * (THREE + COUNT);
    if matches!(scene.table::<FilterTable>()?.filter, Filter::Mitchell { .. }) {
        film += sums * THREE + COUNT;
    }
    if plan.keeps::<FilmMoments>() {
        film += sums * THREE;
    }
    if plan.keeps::<Splats>() {
        film += THREE;
    }
    if plan.keeps::<Photons>() {
        // As many light paths as pixel samples, times a factor, each of which may end as a photon.
        film += (PHOTON_BYTES as f64 * scene.table::<LightTracingTable>()?.paths).ceil() as u64;
    }
    if plan.keeps::<LightVertices>() {
        // Russian roulette leaves most paths few vertices; where all is white they may have more.
        let vertices = VERTICES * scene.table::<LightTracingTable>()?.paths;
        film += (LIGHT_VERTEX_BYTES as f64 * vertices).ceil() as u64;
    }
    if plan.keeps::<FilmLayers>() {
        let kinds = LayerTable::kinds_of(scene);
        let means = kinds.iter().filter(|kind| kind.is_mean());
        let a_sum = sums * size_of::<f64>() as u64;
        film += 3 * COUNT + means.map(|kind| kind.channels().len() as u64 * a_sum).sum::<u64>();
        if kinds.contains(&LayerKind::Cryptomatte) {
            // Two shapes a pixel: few pixels show more.
            film += 2 * MATTE_BYTES as u64;
        }
    }
    if adaptive_of(scene)?.is_some() {
        // The pilot's film exists beside the next one, and each pixel has a planned number of samples.
        film = 2 * film + COUNT;
    }
    Ok(film)
}

/// Checks that there is memory for a render's film before any of it is allocated.
///
/// Errors: the resolution, the memory it needs, the memory there is, and the resolution that would fit.
pub fn check_film_fits(scene: &Census<'_>, plan: &Plan) -> Result<(), SceneError> {
    let image = scene.table::<ImageFrame>()?;
    let (width, height) = (image.width, image.height);
    let a_pixel = film_bytes_per_pixel(scene, plan)?;
    let pixels = u64::from(width) * u64::from(height);
    check_memory(pixels * a_pixel).map_err(|too_little| {
        let who = crate::extract::camera_entity(scene)
            .map_or("camera".into(), |own| format!("camera {}", called(scene, own)));
        let what = match (plan.keeps::<Photons>(), plan.keeps::<LightVertices>()) {
            (true, _) => "such a film with its photons",
            (_, true) => "such a film with its light vertices",
            _ => "such a film",
        };
        let accepted = format!("{what} {too_little}; {}", fitting([width, height], a_pixel, too_little));
        SceneError::new(who, "resolution", format!("{width} × {height}"), accepted)
    })
}

/// The largest resolution of the same aspect ratio that fits, to two digits.
fn fitting(size: [u32; 2], a_pixel: u64, too_little: TooLittleMemory) -> String {
    let pixels = size.iter().map(|&side| f64::from(side)).product::<f64>();
    let scale = (too_little.usable() as f64 / a_pixel as f64 / pixels).sqrt();
    let [width, height] = size.each(|side| {
        let side = (f64::from(side) * scale) as u32;
        let digit = 10_u32.pow(side.max(10).ilog10() - 1);
        (side / digit * digit).max(1)
    });
    format!("at most about {width} × {height} fits")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_resolution_that_fits_has_the_same_aspect_and_fits() {
        let too_little = TooLittleMemory { needed: 0, free: 8 << 30 };
        let message = fitting([32_768, 32_768], 28, too_little);
        assert_eq!(message, "at most about 16000 × 16000 fits");
        assert!(16_000_u64 * 16_000 * 28 <= too_little.usable());
        assert_eq!(fitting([65_536, 16], 28, TooLittleMemory { needed: 0, free: 0 }), "at most about 1 × 1 fits");
    }
}
