use crate::extract::followed_evidence;
use crate::intersect::{ShadingNormals, Surface, Surfaces};
use crate::material::{Bsdf, BsdfSample};
use crate::plan::{Stage, TileSystems, column};
use crate::rays::{Paths, WorldRays, ray_vectors};
use crate::shapes::offset_origin;
use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};

column! {
    /// Rays scattered from surfaces, grouped by the kind of material.
    pub struct Scattered("scattered", "world, from the eye", "scene units", Ray, begun in Start) {
        /// The row of the ray that it was scattered from.
        row: u32,
        /// Origin, x: offset from the surface by its error bound.
        ox: f32,
        /// Origin, y.
        oy: f32,
        /// Origin, z.
        oz: f32,
        /// Direction, x; the three are a unit vector.
        dx: f32,
        /// Direction, y.
        dy: f32,
        /// Direction, z.
        dz: f32,
        /// Path throughput, red.
        r: f64,
        /// Green.
        g: f64,
        /// Blue.
        b: f64,
        /// The pdf of its direction under BSDF sampling, in 1/sr; infinite after a specular bounce.
        pdf: f64,
    }
}

/// One row of [`Scattered`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ScatteredRay {
    /// Its origin, offset from the surface.
    pub origin: Vec3,
    /// Its direction, a unit vector.
    pub direction: DVec3,
    /// The path's throughput including this bounce; a ray of throughput 0 is left out.
    pub throughput: [f64; 3],
    /// The pdf of its direction under BSDF sampling, in 1/sr; infinite after a specular bounce.
    pub pdf: f64,
}

impl ScatteredRay {
    /// The ray that a BSDF scatters from a surface hit by `rays`; of throughput 0 where it gives none, or one to the wrong
    /// side of the geometric surface.
    ///
    /// `sample` gets the direction to the eye in the frame of the shading normal.
    #[inline(always)]
    pub(super) fn leaving<B: Bsdf>(
        row: usize,
        (rays, paths): (&WorldRays, &Paths),
        (surfaces, shading): (&Surfaces, Option<&ShadingNormals>),
        sample: impl FnOnce(&Surface, DVec3) -> Option<BsdfSample>,
    ) -> Self {
        let surface = surfaces.get(row);
        let own = surface.normal.as_dvec3();
        let world_from_local = B::frame(shading.map_or(own, |normals| normals.get(row)));
        let to_eye = world_from_local.transpose() * -rays.direction_of(row);
        let Some(BsdfSample { to_light, pdf, weight }) = sample(&surface, to_eye) else { return Self::default() };
        let through = B::TRANSMITS && to_light.z < 0.0;
        let side = if through { -surface.normal } else { surface.normal };
        let direction = world_from_local * to_light;
        let leaves = direction.dot(side.as_dvec3()) > 0.0;
        let throughput = if leaves { paths.throughput(row) } else { [0.0; 3] };
        Self {
            origin: offset_origin(surface.position, side, surface.bound),
            direction,
            throughput: [0, 1, 2].map(|part| throughput[part] * weight[part]),
            pdf,
        }
    }
}

ray_vectors!(Scattered);

impl Scattered {
    /// The direction, each component mapped from [−1, 1] to [0, 1].
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.dx[row], self.dy[row], self.dz[row]].map(|part| 0.5 + 0.5 * part)
    }

    /// Appends a ray for each of these rows, except for rays of throughput 0.
    ///
    /// Every row is written, and the next one overwrites it unless it counts, so that no branch depends on the surface.
    #[inline(always)]
    pub fn append(&mut self, rows: &[u32], ray_of: impl Fn(usize, usize) -> ScatteredRay) {
        let length = self.row.len();
        let (path, ox, oy, oz, dx, dy, dz, r, g, b, pdf) = self.slices_mut(length + rows.len());
        let mut at = length;
        for (number, &row) in rows.iter().enumerate() {
            let ray = ray_of(number, row as usize);
            path[at] = row;
            (ox[at], oy[at], oz[at]) = ray.origin.into();
            (dx[at], dy[at], dz[at]) = ray.direction.as_vec3().into();
            [r[at], g[at], b[at]] = ray.throughput;
            pdf[at] = ray.pdf;
            at += usize::from(ray.throughput != [0.0; 3]);
        }
        self.slices_mut(at);
    }

    /// Moves a row to an earlier place.
    pub(super) fn moved(&mut self, from: usize, to: usize) {
        self.row[to] = self.row[from];
        [&mut self.ox, &mut self.oy, &mut self.oz].into_iter().for_each(|component| component[to] = component[from]);
        [&mut self.dx, &mut self.dy, &mut self.dz].into_iter().for_each(|component| component[to] = component[from]);
        [&mut self.r, &mut self.g, &mut self.b].into_iter().for_each(|component| component[to] = component[from]);
        self.pdf[to] = self.pdf[from];
    }
}

/// Clears every tile's list of scattered rays.
pub fn start_scattered(mut tiles: Query<&mut Scattered>) {
    tiles.iter_mut().for_each(|mut scattered| scattered.clear());
}

/// The stage that runs [`start_scattered`].
pub fn start_scattered_stage() -> Stage {
    Stage::new("Clear scattered rays", TileSystems::Start, start_scattered).when(followed_evidence)
}
