//! The surfaces for which lights are sampled, and the shadow rays that are appended for them.

use super::light::ShadowRay;
use super::{LightPdfs, ShadowRays, TransmissiveRows};
use crate::each::{Each, by_lane, gathered, lanes_of};
use crate::intersect::{MaterialRows, ShadingNormals, Surface, SurfaceSlices, Surfaces};
use crate::plan::{Column, VectorRows, VectorRowsMut};
use crate::rays::WorldRays;
use crate::shapes::offset_origin;
use glam::{DVec3, Vec3};
use multiversion::multiversion;

/// A shadow ray with the irradiance that it carries.
#[derive(Default)]
pub(super) struct LightRay {
    pub ray: ShadowRay,
    pub t_max: f32,
    pub irradiance: [f64; 3],
    /// The pdf with which it was sampled, in 1/sr; 0 for a light without an area.
    pub pdf: f64,
}

/// The surfaces that lights may illuminate.
pub(super) struct LightRows<'a> {
    surfaces: &'a Surfaces,
    shading: Option<&'a ShadingNormals>,
    rows: &'a [u32],
    /// Those that are lit from behind as well.
    far: &'a [u32],
    /// The rays that arrive at them, where what is made of them depends on these.
    arriving: Option<&'a WorldRays>,
}

impl<'a> LightRows<'a> {
    #[inline(always)]
    pub fn new(
        surfaces: &'a Surfaces,
        shading: Option<&'a ShadingNormals>,
        list: &'a MaterialRows,
        far: Option<&'a TransmissiveRows>,
    ) -> Self {
        Self { surfaces, shading, rows: &list.row, far: far.map_or(&[], |far| &far.row), arriving: None }
    }

    /// The same, where what is made of them depends on the rays that arrive.
    #[inline(always)]
    pub fn with_arriving(self, arriving: &'a WorldRays) -> Self {
        Self { arriving: Some(arriving), ..self }
    }

    /// Some of them: these rows, and those of them that are lit from behind as well.
    #[inline(always)]
    pub fn part(&self, rows: &'a [u32], far: &'a [u32]) -> Self {
        Self { rows, far, ..*self }
    }

    /// The rows of the surfaces, and of those that are lit from behind as well.
    pub fn rows(&self) -> [&'a [u32]; 2] {
        [self.rows, self.far]
    }

    /// Where the shadow rays of some rows start; of those behind, on the other side.
    #[inline(always)]
    pub fn starts(&self, rows: &[u32], behind: bool) -> Starts {
        starts_of(&self.surfaces.to_read(), rows, if behind { -1.0 } else { 1.0 })
    }

    /// A row's surface and shading normal.
    #[inline(always)]
    fn near(&self, row: usize) -> (Surface, DVec3) {
        let surface = self.surfaces.get(row);
        let normal = self.shading.map_or_else(|| surface.normal.as_dvec3(), |shading| shading.get(row));
        (surface, normal)
    }

    /// The same on the other side.
    #[inline(always)]
    fn behind(&self, row: usize) -> (Surface, DVec3) {
        let (surface, normal) = self.near(row);
        (Surface { normal: -surface.normal, ..surface }, -normal)
    }
}

/// The columns that shadow rays are appended to.
pub(super) type RayLists<'a> = (&'a mut ShadowRays, Option<&'a mut LightPdfs>);

/// What makes shadow rays.
///
/// It is a trait, and no closure, since a closure is compiled apart from the loop that calls it, and for the oldest
/// processors.
pub(super) trait MakesRays {
    /// The shadow ray from a surface; `normal` is the shading normal, or the geometric one where there is no other, and
    /// `u` a point of the unit square for a light that has an area, or of a lens.
    ///
    /// `arriving` is the direction of the ray that arrives, where it is asked for: [`LightRows::with_arriving`].
    fn ray_from(&self, surface: &Surface, normal: DVec3, u: [f64; 2], arriving: DVec3) -> LightRay;
}

/// A point of the unit square for each row, and for each that is lit from behind; none for a light without an area.
pub(super) type LightDraws<'a> = [&'a [[f64; 2]]; 2];

/// Appends the shadow rays from all surfaces of a list to one light, where they carry light.
#[inline(always)]
pub(super) fn append_rays(
    receivers: &LightRows<'_>,
    (rays, pdfs): RayLists<'_>,
    casts_shadows: bool,
    light: &impl MakesRays,
    [draws, far_draws]: LightDraws<'_>,
) {
    let mut to = (rays, pdfs);
    append((receivers.rows, draws), &mut to, casts_shadows, light, (receivers, 1.0));
    if !receivers.far.is_empty() {
        append((receivers.far, far_draws), &mut to, casts_shadows, light, (receivers, -1.0));
    }
}

/// Whether a light is far enough away to have a direction; at shorter distances the square is subnormal.
#[inline(always)]
pub(super) fn is_apart(ray: &ShadowRay) -> bool {
    ray.distance * ray.distance >= f64::MIN_POSITIVE
}

/// How many shadow rays are made at once.
pub(super) const AT_ONCE: usize = 32;

/// Where so many of them start, component by component.
pub(super) type Starts = [[f32; AT_ONCE]; 3];

/// The surfaces of some rows, component by component, so that one loop handles several.
struct SurfaceBlock {
    position: [[f32; AT_ONCE]; 3],
    geometric: [[f32; AT_ONCE]; 3],
    bound: [f32; AT_ONCE],
    material: [u32; AT_ONCE],
    normal: [[f64; AT_ONCE]; 3],
    arriving: [[f32; AT_ONCE]; 3],
    u: [[f64; AT_ONCE]; 2],
}

/// Their shadow rays, and 1 for each that carries light.
struct LightRayBlock {
    origin: [[f32; AT_ONCE]; 3],
    direction: [[f32; AT_ONCE]; 3],
    t_max: [f32; AT_ONCE],
    irradiance: [[f32; AT_ONCE]; 3],
    pdf: [f64; AT_ONCE],
    counts: [u32; AT_ONCE],
}

impl SurfaceBlock {
    const NONE: Self = Self {
        position: [[0.0; AT_ONCE]; 3],
        geometric: [[0.0; AT_ONCE]; 3],
        bound: [0.0; AT_ONCE],
        material: [0; AT_ONCE],
        normal: [[0.0; AT_ONCE]; 3],
        arriving: [[0.0; AT_ONCE]; 3],
        u: [[0.0; AT_ONCE]; 2],
    };

    #[inline(always)]
    fn get(&self, lane: usize) -> (Surface, DVec3) {
        let [position, normal] = [&self.position, &self.geometric].each(|vectors| Vec3::from(vectors.at(lane)));
        let surface = Surface { position, normal, bound: self.bound[lane], material: self.material[lane] };
        (surface, self.normal.at(lane).into())
    }
}

/// Where the shadow rays of rows start, on this side of the geometric normals or the other.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn starts_of(surfaces: &SurfaceSlices<'_>, rows: &[u32], side: f32) -> Starts {
    let rows = lanes_of(rows, 0_u32);
    let bound: [f32; AT_ONCE] = gathered(surfaces.bound, &rows);
    let [position, normal] = [surfaces.position, surfaces.normal].each(|all| all.each(|axis| gathered(axis, &rows)));
    let mut starts = [[0.0; AT_ONCE]; 3];
    for lane in 0..AT_ONCE {
        let (position, normal): ([f32; 3], [f32; 3]) = (position.at(lane), normal.at(lane));
        starts.put(lane, offset_origin(position.into(), side * Vec3::from(normal), bound[lane]));
    }
    starts
}

/// Gathers the surfaces of rows, seen from this side of their normals or from the other.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn gather_surfaces(
    block: &mut SurfaceBlock,
    surfaces: &SurfaceSlices<'_>,
    (shading, arriving): (Option<&ShadingNormals>, Option<&WorldRays>),
    rows: &[u32],
    side: f32,
) {
    let rows = lanes_of(rows, 0_u32);
    if let Some(arriving) = arriving {
        block.arriving = [0, 1, 2].each(|axis: usize| gathered(&arriving.direction[axis], &rows));
    }
    for axis in 0..3 {
        block.position[axis] = gathered(surfaces.position[axis], &rows);
        let geometric: [f32; AT_ONCE] = gathered(surfaces.normal[axis], &rows);
        let normal = match shading {
            Some(shading) => gathered(&shading.normal[axis], &rows),
            None => geometric,
        };
        for lane in 0..AT_ONCE {
            block.geometric[axis][lane] = side * geometric[lane];
            block.normal[axis][lane] = f64::from(side * normal[lane]);
        }
    }
    block.bound = gathered(surfaces.bound, &rows);
    block.material = gathered(surfaces.material, &rows);
}

impl LightRayBlock {
    const NONE: Self = Self {
        origin: [[0.0; AT_ONCE]; 3],
        direction: [[0.0; AT_ONCE]; 3],
        t_max: [0.0; AT_ONCE],
        irradiance: [[0.0; AT_ONCE]; 3],
        pdf: [0.0; AT_ONCE],
        counts: [0; AT_ONCE],
    };

    /// The components in the order of [`ShadowRays`].
    #[inline(always)]
    fn components(&mut self) -> [&mut [f32; AT_ONCE]; 10] {
        let Self { origin: [ox, oy, oz], direction: [dx, dy, dz], t_max, irradiance: [r, g, b], .. } = self;
        [ox, oy, oz, dx, dy, dz, t_max, r, g, b]
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, LightRay { ray, t_max, irradiance, pdf }: &LightRay) {
        self.origin.put(lane, ray.origin);
        self.direction.put(lane, ray.direction);
        self.t_max[lane] = *t_max;
        self.irradiance.put(lane, irradiance.each(|part| if part < MAX { part as f32 } else { f32::MAX }));
        self.pdf[lane] = *pdf;
        self.counts[lane] = u32::from((ray.cosine > 0.0) & is_apart(ray));
    }
}

/// Makes the rays of some surfaces.
#[inline(always)]
fn make(light: &impl MakesRays, block: &SurfaceBlock, made: &mut LightRayBlock) {
    for lane in 0..AT_ONCE {
        let (surface, normal) = block.get(lane);
        let (arriving, u) = (Vec3::from(block.arriving.at(lane)).as_dvec3(), [block.u[0][lane], block.u[1][lane]]);
        made.set(lane, &light.ray_from(&surface, normal, u, arriving));
    }
}

/// Appends the rays of all rows that carry light.
#[inline(always)]
fn append(
    (rows, draws): (&[u32], &[[f64; 2]]),
    (rays, pdfs): &mut RayLists<'_>,
    casts_shadows: bool,
    light: &impl MakesRays,
    (receivers, side): (&LightRows<'_>, f32),
) {
    let (mut block, mut made) = (SurfaceBlock::NONE, LightRayBlock::NONE);
    let (mut path, surfaces) = ([0; AT_ONCE], receivers.surfaces.to_read());
    let mut draws = draws.chunks(AT_ONCE);
    for rows in rows.chunks(AT_ONCE) {
        gather_surfaces(&mut block, &surfaces, (receivers.shading, receivers.arriving), rows, side);
        for (lane, [u, v]) in by_lane::<AT_ONCE, _>(draws.next().unwrap_or_default()) {
            (block.u[0][lane], block.u[1][lane]) = (u, v);
        }
        make(light, &block, &mut made);
        path[..rows.len()].copy_from_slice(rows);
        let mut count = rows.len();
        if made.counts[..count].contains(&0) {
            count = 0;
            // Every ray is written, and the next one overwrites it unless it counts, so that no branch depends on it.
            for (lane, row) in by_lane::<AT_ONCE, _>(rows) {
                // It is no more than the lane, which the compiler does not see.
                let at = count % AT_ONCE;
                path[at] = row;
                for component in made.components() {
                    component[at] = component[lane];
                }
                made.pdf[at] = made.pdf[lane];
                count += made.counts[lane] as usize;
            }
        }
        if !casts_shadows {
            made.t_max = [0.0; AT_ONCE];
        }
        append_lanes(&mut rays.row, &path, count);
        let ShadowRays { origin: [ox, oy, oz], direction: [dx, dy, dz], t_max, irradiance: [r, g, b], .. } = rays;
        for (column, component) in [ox, oy, oz, dx, dy, dz, t_max, r, g, b].into_iter().zip(made.components()) {
            append_lanes(column, component, count);
        }
        if let Some(pdfs) = pdfs {
            append_lanes(&mut pdfs.row, &path, count);
            append_lanes(&mut pdfs.pdf, &made.pdf, count);
        }
    }
}

/// Appends the first lanes: all of them, which is a few instructions, of which the last are cut off again.
#[inline(always)]
fn append_lanes<T: Copy>(column: &mut Vec<T>, lanes: &[T; AT_ONCE], count: usize) {
    let length = column.len() + count;
    column.extend_from_slice(lanes);
    column.truncate(length);
}

/// Appends one shadow ray per row in a sampled direction, and its pdf; all of them cast shadows.
///
/// `ray_of` gets the row, the surface and the shading normal.
#[inline(always)]
pub(super) fn append_sampled(
    receivers: &LightRows<'_>,
    (rays, mut pdfs): RayLists<'_>,
    ray_of: impl Fn(usize, &Surface, DVec3) -> LightRay,
) {
    append_sampled_rows(receivers.rows, (rays, pdfs.as_deref_mut()), |row| {
        let (surface, normal) = receivers.near(row);
        ray_of(row, &surface, normal)
    });
    if !receivers.far.is_empty() {
        append_sampled_rows(receivers.far, (rays, pdfs), |row| {
            let (surface, normal) = receivers.behind(row);
            ray_of(row, &surface, normal)
        });
    }
}

#[inline(always)]
fn append_sampled_rows(rows: &[u32], (rays, mut pdfs): RayLists<'_>, ray_of: impl Fn(usize) -> LightRay) {
    let length = rays.rows();
    let max = length + rows.len();
    let (path, mut origin, mut direction, t_max, mut irradiance) = rays.slices_mut(max);
    let mut pdf_columns = pdfs.as_deref_mut().map(|pdfs| pdfs.slices_mut(max));
    let mut at = length;
    for &row in rows {
        let light_ray = ray_of(row as usize);
        path[at] = row;
        origin.put(at, light_ray.ray.origin);
        direction.put(at, light_ray.ray.direction);
        t_max[at] = light_ray.t_max;
        irradiance.put(at, light_ray.irradiance.each(|part| part.min(MAX) as f32));
        if let Some(columns) = &mut pdf_columns {
            (columns.0[at], columns.1[at]) = (row, light_ray.pdf);
        }
        at += usize::from(light_ray.ray.cosine > 0.0);
    }
    rays.slices_mut(at);
    if let Some(pdfs) = pdfs {
        pdfs.slices_mut(at);
    }
}

/// The greatest irradiance of a ray: more than f32 can represent is clamped.
const MAX: f64 = f32::MAX as f64;
