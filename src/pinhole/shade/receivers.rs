//! The surfaces for which lights are sampled, and the shadow rays that are appended for them.

use super::light::ShadowRay;
use super::{LightPdfs, LightRays, TransmissiveRows};
use crate::intersect::{MaterialRows, ShadingNormals, Surface, Surfaces};
use crate::plan::Column;
use glam::DVec3;

/// A shadow ray with the irradiance that it carries.
pub(super) struct LightRay {
    pub ray: ShadowRay,
    pub t_max: f32,
    pub irradiance: [f64; 3],
}

/// The surfaces that lights may illuminate.
pub(super) struct LightRows<'a> {
    surfaces: &'a Surfaces,
    shading: Option<&'a ShadingNormals>,
    rows: &'a [u32],
    /// Those that are lit from behind as well.
    far: &'a [u32],
}

impl<'a> LightRows<'a> {
    #[inline(always)]
    pub fn new(
        surfaces: &'a Surfaces,
        shading: Option<&'a ShadingNormals>,
        list: &'a MaterialRows,
        far: Option<&'a TransmissiveRows>,
    ) -> Self {
        Self { surfaces, shading, rows: &list.row, far: far.map_or(&[], |far| &far.row) }
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
pub(super) type RayLists<'a> = (&'a mut LightRays, Option<&'a mut LightPdfs>);

/// What makes shadow rays.
///
/// It is a trait, and no closure, since a closure is compiled apart from the loop that calls it, and for the oldest
/// processors.
pub(super) trait MakesRays {
    /// The shadow ray from a surface; `normal` is the shading normal, or the geometric one where there is no other.
    fn ray_from(&self, surface: &Surface, normal: DVec3) -> LightRay;
}

/// Appends the shadow rays from all surfaces of a list to one light, where they carry light.
///
/// A scene without shading normals has a loop of its own.
#[inline(always)]
pub(super) fn append_rays(
    receivers: &LightRows<'_>,
    (rays, pdfs): RayLists<'_>,
    casts_shadows: bool,
    light: &impl MakesRays,
) {
    match receivers.shading {
        None => append(receivers.rows, rays, casts_shadows, light, &Plain(receivers.surfaces)),
        Some(normals) => append(receivers.rows, rays, casts_shadows, light, &Shaded(receivers.surfaces, normals)),
    }
    if !receivers.far.is_empty() {
        append(receivers.far, rays, casts_shadows, light, &Behind(receivers));
    }
    if let Some(pdfs) = pdfs {
        let (path, _) = pdfs.slices_mut(rays.rows());
        path.copy_from_slice(&rays.path);
    }
}

/// Where the surface and the normal of a row are found.
trait Receivers {
    fn of_row(&self, row: usize) -> (Surface, DVec3);
}

struct Plain<'a>(&'a Surfaces);
struct Shaded<'a>(&'a Surfaces, &'a ShadingNormals);
struct Behind<'a>(&'a LightRows<'a>);

impl Receivers for Plain<'_> {
    #[inline(always)]
    fn of_row(&self, row: usize) -> (Surface, DVec3) {
        let surface = self.0.get(row);
        (surface, surface.normal.as_dvec3())
    }
}

impl Receivers for Shaded<'_> {
    #[inline(always)]
    fn of_row(&self, row: usize) -> (Surface, DVec3) {
        (self.0.get(row), self.1.get(row))
    }
}

impl Receivers for Behind<'_> {
    #[inline(always)]
    fn of_row(&self, row: usize) -> (Surface, DVec3) {
        self.0.behind(row)
    }
}

/// Whether a light is far enough away to have a direction; at shorter distances the square is subnormal.
#[inline(always)]
pub(super) fn is_apart(ray: &ShadowRay) -> bool {
    ray.distance * ray.distance >= f64::MIN_POSITIVE
}

/// Every row is written, and the next one overwrites it unless it counts, so that no branch depends on the surface.
#[inline(always)]
fn append(rows: &[u32], rays: &mut LightRays, casts_shadows: bool, light: &impl MakesRays, receivers: &impl Receivers) {
    let length = rays.rows();
    let (path, ox, oy, oz, dx, dy, dz, t_max, r, g, b) = rays.slices_mut(length + rows.len());
    let mut at = length;
    for &row in rows {
        let (surface, normal) = receivers.of_row(row as usize);
        let light_ray = light.ray_from(&surface, normal);
        path[at] = row;
        (ox[at], oy[at], oz[at]) = light_ray.ray.origin.into();
        (dx[at], dy[at], dz[at]) = light_ray.ray.direction.into();
        t_max[at] = light_ray.t_max;
        [r[at], g[at], b[at]] = light_ray.irradiance.map(|part| part.min(MOST) as f32);
        at += usize::from(light_ray.ray.cosine > 0.0 && is_apart(&light_ray.ray));
    }
    if !casts_shadows {
        t_max[length..at].fill(0.0);
    }
    rays.slices_mut(at);
}

/// Appends one shadow ray per row in a sampled direction, and its pdf; all of them cast shadows.
///
/// `ray_of` gets the row, the surface and the shading normal.
#[inline(always)]
pub(super) fn append_sampled(
    receivers: &LightRows<'_>,
    (rays, mut pdfs): RayLists<'_>,
    ray_of: impl Fn(usize, &Surface, DVec3) -> (LightRay, f64),
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
fn append_sampled_rows(rows: &[u32], (rays, mut pdfs): RayLists<'_>, ray_of: impl Fn(usize) -> (LightRay, f64)) {
    let length = rays.rows();
    let most = length + rows.len();
    let (path, ox, oy, oz, dx, dy, dz, t_max, r, g, b) = rays.slices_mut(most);
    let mut pdf_columns = pdfs.as_deref_mut().map(|pdfs| pdfs.slices_mut(most));
    let mut at = length;
    for &row in rows {
        let (light_ray, pdf) = ray_of(row as usize);
        path[at] = row;
        (ox[at], oy[at], oz[at]) = light_ray.ray.origin.into();
        (dx[at], dy[at], dz[at]) = light_ray.ray.direction.into();
        t_max[at] = light_ray.t_max;
        [r[at], g[at], b[at]] = light_ray.irradiance.map(|part| part.min(MOST) as f32);
        if let Some(columns) = &mut pdf_columns {
            (columns.0[at], columns.1[at]) = (row, pdf);
        }
        at += usize::from(light_ray.ray.cosine > 0.0);
    }
    rays.slices_mut(at);
    if let Some(pdfs) = pdfs {
        pdfs.slices_mut(at);
    }
}

/// The greatest irradiance of a ray: more than f32 can represent is clamped.
const MOST: f64 = f32::MAX as f64;
