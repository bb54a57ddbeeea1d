//! The wavelength of each path, where glass bends each colour by another angle.

use super::Paths;
use super::draws::{DrawsView, draw_one};
use crate::each::Each;
use crate::extract::{SamplingTable, wavelength_evidence};
use crate::plan::{Column, Shared, Stage, StageKind, TileSystems, VectorRowsMut, column};
use crate::sample::{Purpose, Spectrum};
use bevy_ecs::prelude::*;

column! {
    /// The wavelength of each ray, which is that of its whole path; exists where glass disperses light.
    pub struct Wavelengths("wavelength", "light", "nm", Path, begun in Media) {
        /// From 380 to 780.
        nm: f64,
    }
}

impl Wavelengths {
    /// Paints the wavelength as grey, from black at 380 nm to white at 780 nm.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [((self.nm[row] - 380.0) / 400.0) as f32; 3]
    }
}

column! {
    /// The factor that each path's throughput gets where it first meets a surface that disperses light; 1 behind it.
    ///
    /// Before that surface all wavelengths go the same way, so that a path carries all of them: red, green and blue.
    pub struct WavelengthWeights("wavelength weight", "light", "ratios", Path, begun in Media) {
        /// Red, green and blue; negative where the colour of the wavelength is outside Rec. 709.
        rgb: [f64; 3] as [r, g, b],
    }
}

impl WavelengthWeights {
    /// Paints the weight.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        self.rgb(row).each(|part| part as f32)
    }
}

/// Samples the wavelength of each path.
pub fn draw_wavelengths(
    sampling: Res<Shared<SamplingTable>>,
    mut tiles: Query<(DrawsView, &Paths, &mut Wavelengths, &mut WavelengthWeights)>,
) {
    let spectrum = Spectrum::get();
    for (draws, paths, mut wavelengths, mut weights) in &mut tiles {
        let (nm, mut weights) = (wavelengths.slices_mut(paths.rows()), weights.slices_mut(paths.rows()));
        draw_one(&draws.draws(&sampling, Some(paths)), Purpose::Wavelength, nm);
        for (row, nm) in nm.iter_mut().enumerate() {
            let (wavelength, weight) = spectrum.sample(*nm);
            *nm = wavelength;
            weights.put(row, weight);
        }
    }
}

/// The stage that runs this system.
pub fn wavelength_stage() -> Stage {
    Stage::new("Sample wavelengths", TileSystems::Media, draw_wavelengths)
        .on_first_bounce()
        .kind(StageKind::Estimator)
        .when(wavelength_evidence)
}
