//! Light that glass parts by its wavelength.

use super::Scattered;
use super::bsdf::at_interfaces_where;
use super::interface::{Interface, InterfaceView};
use crate::extract::{GlassTable, MaterialTable, wavelength_evidence};
use crate::intersect::{Hits, NO_SHAPE, Surfaces};
use crate::plan::{Column, Shared, Stage, StageKind, TileSystems, VectorRowsMut};
use crate::rays::{Paths, WavelengthWeights, Wavelengths};
use bevy_ecs::prelude::*;

// ANCHOR: weight_by_wavelength
/// Multiplies the throughput of each path that hits a dispersing surface for the first time by the weight of its
/// wavelength.
///
/// From there on each wavelength goes its own way, and the path stands for its own one alone.
/// That holds of its reflection, too, since the reflectance depends on the index.
pub fn weight_by_wavelength(
    (materials, glass): (Res<Shared<MaterialTable>>, Res<Shared<GlassTable>>),
    mut tiles: Query<(&Hits, &Surfaces, InterfaceView, &mut WavelengthWeights, &mut Paths)>,
) {
    for (hits, surfaces, interface, mut weights, mut paths) in &mut tiles {
        let interface = Interface::new(interface, Some(&glass));
        let (weights, paths) = (&mut *weights, &mut *paths);
        for (row, &shape) in hits.shape.iter().enumerate() {
            // What only emits light has no material.
            let Some(&own) = materials.interior.get(surfaces.material[row] as usize) else { continue };
            if shape != NO_SHAPE && interface.disperses(own, row) {
                paths.throughput.scale(row, weights.rgb(row));
                weights.rgb.put(row, [1.0; 3]);
            }
        }
    }
}
// ANCHOR_END: weight_by_wavelength

/// The stage that runs [`weight_by_wavelength`].
pub fn weight_by_wavelength_stage() -> Stage {
    let stage = Stage::new("Weight paths by wavelength", TileSystems::Absorb, weight_by_wavelength);
    at_interfaces_where(stage, wavelength_evidence).kind(StageKind::Estimator).when(wavelength_evidence)
}

/// Gives the rays of the next bounce the wavelengths of the rays that they were scattered from, and their weights.
pub fn carry_wavelengths(
    (mut kept, mut kept_weights): (Local<Wavelengths>, Local<WavelengthWeights>),
    mut tiles: Query<(&Scattered, &mut Wavelengths, &mut WavelengthWeights)>,
) {
    for (scattered, mut wavelengths, mut weights) in &mut tiles {
        let rows = scattered.rows();
        let (nm, mut rgb) = (kept.slices_mut(rows), kept_weights.slices_mut(rows));
        for (ray, &row) in scattered.row.iter().enumerate() {
            nm[ray] = wavelengths.nm(row as usize);
            rgb.put(ray, weights.rgb(row as usize));
        }
        std::mem::swap(&mut *kept, &mut *wavelengths);
        std::mem::swap(&mut *kept_weights, &mut *weights);
    }
}

/// The stage that runs [`carry_wavelengths`].
pub fn carry_wavelengths_stage() -> Stage {
    Stage::new("Carry wavelengths to the next bounce", TileSystems::Step, carry_wavelengths).when(wavelength_evidence)
}
