//! Sampling a BSDF for many rows at once.
//!
//! The rows of a list lie apart in their columns: a block of them is gathered component by component, one loop samples
//! all of its rows, and the rays that go on are appended.

use super::ScatteredRay;
use super::paths::ScatteredRoom;
use crate::each::{Each, all_are, by_lane, gathered, lanes, lanes_of};
use crate::intersect::{ShadingNormals, Surfaces};
use crate::material::{Bsdf, BsdfSample, Parameters, ShadingContext, Transport};
use crate::plan::{ColumnArrays, VectorRows, VectorRowsMut};
use crate::rays::{Paths, WorldRays};
use crate::shapes::offset_origin;
use glam::{DVec3, Vec3};
use multiversion::multiversion;

/// How many rows are sampled at once.
pub(super) const AT_ONCE: usize = 32;

/// The columns of the rows that a BSDF is sampled for.
pub(super) struct SampledColumns<'a> {
    /// The rays that arrive.
    pub rays: &'a WorldRays,
    /// The paths that they belong to.
    pub paths: &'a Paths,
    /// The surfaces that they hit.
    pub surfaces: &'a Surfaces,
    /// Their shading normals, where they have any.
    pub shading: Option<&'a ShadingNormals>,
}

/// Some of these rows, component by component.
pub(super) struct SampledBlock {
    direction: [[f32; AT_ONCE]; 3],
    throughput: [[f64; AT_ONCE]; 3],
    position: [[f32; AT_ONCE]; 3],
    geometric: [[f32; AT_ONCE]; 3],
    bound: [f32; AT_ONCE],
    normal: [[f64; AT_ONCE]; 3],
    table_row: [u32; AT_ONCE],
    colour: [[f64; AT_ONCE]; 3],
    metallic: [f64; AT_ONCE],
    roughness: [f64; AT_ONCE],
    eta: [f64; AT_ONCE],
    u: [[f64; AT_ONCE]; 2],
    choice: [f64; AT_ONCE],
}

/// The rays that leave them; of throughput 0 where the BSDF gives none, or one to the wrong side of the geometric surface.
pub(super) struct ScatteredBlock {
    origin: [[f32; AT_ONCE]; 3],
    direction: [[f32; AT_ONCE]; 3],
    throughput: [[f64; AT_ONCE]; 3],
    pdf: [f64; AT_ONCE],
    /// 0 if none of the block ends here.
    ends: u32,
}

impl SampledBlock {
    pub const NONE: Self = Self {
        direction: [[0.0; AT_ONCE]; 3],
        throughput: [[0.0; AT_ONCE]; 3],
        position: [[0.0; AT_ONCE]; 3],
        geometric: [[0.0; AT_ONCE]; 3],
        bound: [0.0; AT_ONCE],
        normal: [[0.0; AT_ONCE]; 3],
        table_row: [0; AT_ONCE],
        colour: [[0.0; AT_ONCE]; 3],
        metallic: [0.0; AT_ONCE],
        roughness: [0.0; AT_ONCE],
        eta: [1.0; AT_ONCE],
        u: [[0.0; AT_ONCE]; 2],
        choice: [0.0; AT_ONCE],
    };

    /// Gathers the rows.
    #[inline(always)]
    pub fn gather(&mut self, columns: &SampledColumns<'_>, rows: &[u32]) {
        gather_rows(self, columns, rows);
    }

    /// Sets what is known of a row's material: its row of the BSDF's table, its parameters and its relative index of
    /// refraction.
    #[inline(always)]
    pub fn set_context<B: Bsdf>(&mut self, lane: usize, context: &ShadingContext) {
        self.table_row[lane] = context.row as u32;
        self.colour.put(lane, context.parameters.colour);
        (self.metallic[lane], self.roughness[lane]) = (context.parameters.metallic, context.parameters.roughness);
        if B::TRANSMITS {
            self.eta[lane] = context.eta;
        }
    }

    /// Sets the random numbers of the rows.
    #[inline(always)]
    pub fn set_numbers(&mut self, points: &[[f64; 2]], choices: &[f64]) {
        for (lane, [u, v]) in by_lane::<AT_ONCE, _>(points) {
            (self.u[0][lane], self.u[1][lane]) = (u, v);
        }
        self.choice[..choices.len()].copy_from_slice(choices);
    }
}

impl ScatteredBlock {
    pub const NONE: Self = Self {
        origin: [[0.0; AT_ONCE]; 3],
        direction: [[0.0; AT_ONCE]; 3],
        throughput: [[0.0; AT_ONCE]; 3],
        pdf: [0.0; AT_ONCE],
        ends: 0,
    };

    /// Samples the BSDF for the first rows of a block.
    #[inline(always)]
    pub fn sample<B: Bsdf>(&mut self, bsdf: &B, block: &SampledBlock, rows: usize, transport: Transport) {
        if B::IN_BLOCKS && bsdf.in_blocks() {
            // What follows the last row is left over from an earlier block: a loop of a fixed length has no end to care for.
            sample_at_once(bsdf, block, self, transport);
        } else {
            sample_rows::<B, false>(bsdf, block, self, rows, transport);
        }
    }

    /// That of a row of the block.
    #[inline(always)]
    fn ray(&self, lane: usize) -> ScatteredRay {
        ScatteredRay {
            origin: self.origin.at(lane).into(),
            direction: Vec3::from(self.direction.at(lane)).as_dvec3(),
            throughput: self.throughput.at(lane),
            pdf: self.pdf[lane],
        }
    }

    /// Appends those that go on; all of them at once where there are none that do not.
    #[inline(always)]
    pub fn append(&self, rows: &[u32], to: &mut ScatteredRoom<'_>) {
        if rows.len() == AT_ONCE && self.ends == 0 {
            return to.append_all(rows, &self.origin, &self.direction, &self.throughput, &self.pdf);
        }
        for (lane, row) in by_lane::<AT_ONCE, _>(rows) {
            to.append(row, &self.ray(lane));
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn sample_at_once<B: Bsdf>(bsdf: &B, block: &SampledBlock, made: &mut ScatteredBlock, transport: Transport) {
    sample_rows::<B, true>(bsdf, block, made, AT_ONCE, transport);
}

/// Gathers rows component by component, with row 0 for what follows the last one.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn gather_rows(block: &mut SampledBlock, columns: &SampledColumns<'_>, rows: &[u32]) {
    let SampledColumns { rays, paths, surfaces, shading } = columns;
    let (rows, (position, geometric, bound, _)) = (lanes_of(rows, 0_u32), surfaces.slices());
    let of_normals = shading.map_or(geometric, |shading| shading.normal.slices(bound.len()));
    for axis in 0..3 {
        block.direction[axis] = gathered(&rays.direction[axis], &rows);
        block.position[axis] = gathered(position[axis], &rows);
        block.geometric[axis] = gathered(geometric[axis], &rows);
        let normal: [f32; AT_ONCE] = gathered(of_normals[axis], &rows);
        block.normal[axis] = lanes(|lane| f64::from(normal[lane]));
        block.throughput[axis] = gathered(&paths.throughput[axis], &rows);
    }
    block.bound = gathered(bound, &rows);
}

#[inline(always)]
fn sample_rows<B: Bsdf, const IN_BLOCK: bool>(
    bsdf: &B,
    block: &SampledBlock,
    made: &mut ScatteredBlock,
    rows: usize,
    transport: Transport,
) {
    const NONE: BsdfSample = BsdfSample { to_light: DVec3::Z, pdf: 0.0, weight: [0.0; 3] };
    let mut ends = 0;
    for lane in 0..rows.min(AT_ONCE) {
        let world_from_local = B::frame(block.normal.at(lane).into());
        let to_eye = world_from_local.transpose() * -Vec3::from(block.direction.at(lane)).as_dvec3();
        let parameters = Parameters {
            colour: block.colour.at(lane),
            metallic: block.metallic[lane],
            roughness: block.roughness[lane],
        };
        let (row, eta) = (block.table_row[lane] as usize, block.eta[lane]);
        let context = ShadingContext { row, parameters, eta, reflectance: None, transport };
        let (numbers, choice) = ([block.u[0][lane], block.u[1][lane]], block.choice[lane]);
        let sample = if IN_BLOCK {
            bsdf.sample_in_block(&context, to_eye, numbers, choice)
        } else {
            bsdf.sample(&context, to_eye, numbers, choice)
        };
        let BsdfSample { to_light, pdf, weight } = sample.unwrap_or(NONE);

        let geometric = Vec3::from(block.geometric.at(lane));
        let side = if B::TRANSMITS && to_light.z < 0.0 { -geometric } else { geometric };
        let direction = world_from_local * to_light;
        // A ray to the wrong side of the geometric surface goes nowhere.
        let leaves = direction.dot(side.as_dvec3()) > 0.0;
        let throughput = block.throughput.at(lane);
        made.origin.put(lane, offset_origin(Vec3::from(block.position.at(lane)), side, block.bound[lane]));
        made.direction.put(lane, direction.as_vec3());
        let throughput = [0, 1, 2].each(|part| if leaves { throughput[part] * weight[part] } else { 0.0 });
        made.throughput.put(lane, throughput);
        made.pdf[lane] = pdf;
        ends |= u32::from(all_are(throughput, 0.0));
    }
    made.ends = ends;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::{MaterialTable, for_each_bsdf};
    use crate::measure::draws::Draws;
    use crate::plan::{Census, Table};
    use crate::scene::Sphere;
    use bevy_ecs::prelude::World;

    /// Rows of a BSDF's materials; some rays arrive from behind, and some shading normals are far from the geometric ones.
    fn block<B: Bsdf>(materials: &MaterialTable, seed: u64) -> SampledBlock {
        let mut block = SampledBlock::NONE;
        for lane in 0..AT_ONCE {
            let mut draws = Draws::new(seed, lane as u64);
            let normal = draws.unit_vector().as_vec3();
            let shading = (normal.as_dvec3() + draws.unit_vector() * draws.power_of_ten(-3.0, 0.3)).normalize();
            block.normal.put(lane, shading);
            block.geometric.put(lane, normal);
            block.direction.put(lane, draws.unit_vector().as_vec3());
            block.position.put(lane, (draws.unit_vector() * 10.0).as_vec3());
            block.bound[lane] = draws.power_of_ten(-7.0, -5.0) as f32;
            block.throughput.put(lane, [draws.unit(), draws.unit(), draws.unit()]);
            let material = seed as usize % materials.kind.len();
            let parameters = materials.parameters[material];
            let context = ShadingContext::opaque(materials.row[material] as usize, parameters);
            block.set_context::<B>(lane, &ShadingContext { eta: draws.between(0.5, 2.0), ..context });
            (block.u[0][lane], block.u[1][lane], block.choice[lane]) = (draws.unit(), draws.unit(), draws.unit());
        }
        block
    }

    /// Compares rows at once with one row after another, by the BSDF's own way to sample; the rays that went on from rows
    /// that were sampled at once, and how many such rows there were.
    fn agrees<B: Bsdf>() -> [usize; 2] {
        let mut at_once_and_tried = [0; 2];
        for example in B::examples() {
            let mut world = World::new();
            world.spawn((Sphere { radius: 1.0 }, example.component));
            let census = Census::of(&world);
            let (bsdf, materials) =
                (B::extract(&census).expect("its table"), MaterialTable::extract(&census).expect("one"));
            for seed in 0..60 {
                let (block, [mut at_once, mut by_rows]) = (block::<B>(&materials, seed), [ScatteredBlock::NONE; 2]);
                at_once.sample(&bsdf, &block, AT_ONCE, Transport::Radiance);
                sample_rows::<B, false>(&bsdf, &block, &mut by_rows, AT_ONCE, Transport::Radiance);
                for lane in 0..AT_ONCE {
                    let bits = |made: &ScatteredBlock| {
                        let ScatteredRay { origin, direction, throughput, pdf } = made.ray(lane);
                        let vectors = [origin.as_dvec3(), direction].map(|vector| vector.to_array().map(f64::to_bits));
                        (vectors, throughput.map(f64::to_bits), pdf.to_bits())
                    };
                    let who = format!("{}, seed {seed}, lane {lane}", B::WORD);
                    let goes_on = |made: &ScatteredBlock| made.throughput.at(lane) != [0.0; 3];
                    assert_eq!(goes_on(&at_once), goes_on(&by_rows), "{who}");
                    assert!(!goes_on(&by_rows) || bits(&at_once) == bits(&by_rows), "{who}");
                    if B::IN_BLOCKS && bsdf.in_blocks() {
                        at_once_and_tried[0] += usize::from(goes_on(&by_rows));
                        at_once_and_tried[1] += 1;
                    }
                }
            }
        }
        at_once_and_tried
    }

    macro_rules! all_agree {
        ($($kind:ident($table:ident, $name:literal),)+) => {
            [$(($name, agrees::<crate::material::$table>())),+]
        };
    }

    #[test]
    fn rows_at_once_have_the_bits_of_row_after_row() {
        let of_each = for_each_bsdf!(all_agree);
        let at_once: Vec<_> = of_each.iter().filter(|(_, [_, tried])| *tried > 0).collect();
        eprintln!("BSDFs: {} compared; at once, rays that go on of rows: {at_once:?}", of_each.len());
        assert!(at_once.len() >= 2 && at_once.iter().all(|(_, [on, tried])| 5 * on > *tried), "{at_once:?}");
    }
}
