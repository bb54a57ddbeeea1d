//! What a film is a film of, as one number.

use super::in_progress::FilmPart;
use super::light_pass::Means;
use super::render_world::RenderWorld;
use super::steps::runs;
use super::{RenderInProgress, Watch};
use crate::film::{FilmLayers, FilmMoments, FilmTile};
use crate::follow::Stop;
use crate::rays::Tile;
use crate::scene::{FNV_BASIS, fingerprint, fnv};
use crate::{Error, Result};
use bevy_ecs::prelude::*;

/// Along each side of the image, at how many places a pixel is traced to see what this program computes.
const PLACES: u32 = 16;
/// The side of the tiles in which they lie; the first lattice holds one pixel of each.
const SIDE: u32 = 8;

impl RenderInProgress {
    /// A number that identifies what the film is a film of: samples of two renders with the same key may be added
    /// together.
    ///
    /// It depends on the scene except for the number of samples, on the stages that run, and on the numbers that this
    /// program computes: it holds the bits of the first sample of up to 256 pixels, and of the first light paths.
    /// So a program that was built from edited stages has another key, and one with another text, compiler or
    /// instruction set has the same if it computes the same; a change that none of these samples meets is not noticed.
    /// The number of workers and the side of a tile do not count.
    ///
    /// Errors: the observer stopped it.
    pub fn key(&self, scene: &World, watch: &dyn Watch) -> Result<u64> {
        let mut hash = fnv(FNV_BASIS, env!("CARGO_PKG_VERSION").as_bytes());
        hash = fnv(hash, fingerprint(scene).as_bytes());
        for row in self.plan.rows.iter().filter(|row| row.kept) {
            hash = fnv(fnv(hash, row.stage.as_bytes()), b"\n");
        }
        let mut world = RenderWorld::new(&self.plan, &self.tables, 1, &[]);
        world.stop_at(Stop::at_flag(watch.stop_flag()));
        for number in self.first_sample(&mut world) {
            hash = fnv(hash, &number.to_le_bytes());
        }
        if let Some(light) = &self.light {
            let means = Means { plan: &self.plan, tables: &self.tables, pool: None };
            for number in light.first_splats(&means, watch) {
                hash = fnv(hash, &number.to_le_bytes());
            }
        }
        if let Some(pass) = &self.of_sample {
            let means = Means { plan: &self.plan, tables: &self.tables, pool: None };
            for number in pass.first_bits(&means, watch) {
                hash = fnv(hash, &number.to_le_bytes());
            }
        }
        if watch.stopped() { Err(Error::Interrupted) } else { Ok(hash) }
    }

    /// The bits of the first sample of pixels all over the image.
    fn first_sample(&self, world: &mut RenderWorld) -> Vec<u64> {
        let (width, height) = (self.film.width, self.film.height);
        let starts = |side: u32| {
            let mut starts: Vec<u32> = (0..PLACES)
                .map(|at| (u64::from(at) * u64::from(side) / u64::from(PLACES)) as u32 / SIDE * SIDE)
                .collect();
            starts.dedup();
            starts
        };
        let run = runs(0, 1)[0];
        let mut bits = Vec::new();
        for y in starts(height) {
            for x in starts(width) {
                let mut film = FilmTile::new(Tile { x, y, width: SIDE.min(width - x), height: SIDE.min(height - y) });
                film.min = self.film.tiles.first().map_or(0.0, |own| own.min);
                let rows = film.tile.rows();
                let mut moments = self.film.moments.first().map(|_| FilmMoments::new(rows));
                let mut layers = self.film.layers.first().map(|own| FilmLayers::new(rows, &own.kinds));
                let mut part = FilmPart {
                    film: &mut film,
                    moments: moments.as_mut(),
                    layers: layers.as_mut(),
                    done: &mut 0,
                    planned: None,
                };
                let tile = world.tiles[0];
                world.swap_part(tile, &mut part);
                world.activate(tile, &run, None);
                world.run();
                world.swap_part(tile, &mut part);
                bits.extend(film.count.iter().map(|&count| u64::from(count)));
                let sums = layers.iter().flat_map(|layers| &layers.sums);
                bits.extend(film.sum.iter().chain(sums).flatten().map(|sum| sum.to_bits()));
            }
        }
        bits
    }
}
