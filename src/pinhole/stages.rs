//! What the renderer does, from top to bottom: every stage once, in the order of the data flow.
//!
//! Reads: nothing. Writes: lists of stages for `Chapter::offer`.
//! Each stage belongs to a group that a chapter can offer, such as [`camera_rays`] or [`glass`]; [`all`] is everything.
//! Stages of one set run in the order of this list, whichever group was offered first.
//!
//! ```
//! use pinhole::stages;
//!
//! let names: Vec<&str> = stages::camera_rays().iter().map(|stage| stage.name).collect();
//! assert_eq!(names[..3], ["Place raster points", "Compute NDC points", "Compute screen points"]);
//! assert!(stages::all().len() > 90);
//! ```

mod registered;

use crate::extract::Pattern;
use crate::lights::ListedLight;
use crate::material::Bsdf;
use crate::plan::Stage;
use crate::shapes::Listed;
use crate::{film, follow, intersect, rasterise, rays, shade};
use registered::{
    bsdf_rows, bsdf_samples, carried_ratios, direct_light_of_bsdfs, image_masks, image_plane_rays, intersections,
    joins, light_samples, raster_boxes, shadow_rays, surface_points, wide_rays,
};
use std::any::TypeId;
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// The groups in which stages are offered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Group {
    CameraRays,
    Samples,
    WideCameras,
    Lens,
    Motion,
    Intersection,
    Rasterisation,
    Surfaces,
    Transforms,
    Shadows,
    Radiance,
    Unlit,
    DirectLight,
    Lights,
    Highlights,
    Textures,
    Environment,
    Bounces,
    PathContinuation,
    SpecularReflection,
    GlossyReflection,
    Glass,
    Dispersion,
    AreaLights,
    AmbientOcclusion,
    Mis,
    LightTracing,
    PhotonMapping,
    Bidirectional,
    Media,
    Film,
}
use Group::*;

/// A stage on offer, and the group that it belongs to.
type Grouped = (Group, fn() -> Stage);

/// Stages in order, and then those of every registered shape, BSDF, camera or light.
struct Part(&'static [Grouped], fn() -> Vec<Grouped>);

/// All stages in the order of the data flow.
///
/// Where several of one set add to the same sums, their order here decides the last bits of the picture.
#[rustfmt::skip]
const LIST: &[Part] = &[Part(&[
    // Image points become rays in world space, or rays start on the lights.
    (CameraRays, rays::raster_stage),
    (Samples, rays::place_samples_stage),
    (CameraRays, rays::ndc_stage),
    (CameraRays, rays::screen_stage),
    (Lens, rays::lens_point_stage),
    (Motion, rays::time_stage),
], image_plane_rays), Part(&[
    (Lens, rays::lens_stage),
], wide_rays), Part(&[
    (LightTracing, follow::light_start_stage),
    (CameraRays, rays::world_stage),

    // The columns that each bounce fills are cleared.
    (Intersection, intersect::start_stage),
    (Radiance, shade::start_stage),
    (DirectLight, shade::start_shadow_rays_stage),
    (Glass, follow::leave_glass_at_start_stage),
    (PhotonMapping, follow::start_photon_paths_stage),
    (Bounces, follow::start_paths_stage),
    (Media, follow::light_from_outside_stage),
    (Bounces, follow::start_scattered_stage),
    (AreaLights, follow::start_previous_surfaces_stage),

    // Rays are intersected with each kind of shape, and the closest hit is kept.
], intersections), Part(&[
    (Motion, intersect::moving_stage),
    (Textures, shade::non_opaque_stage),

    // Or, where a camera asks for it, triangles are projected onto the image, and the boxes of other shapes.
], raster_boxes), Part(&[
    (Rasterisation, rasterise::rasterise_stage),

    // Media emit and scatter light on the way to what was hit.
    (Media, follow::medium_emission_stage),
    (Media, follow::distance_stage),
    (Media, follow::distance_from_lights_stage),

    // Surfaces that touch glass are hit or crossed together with it.
    (Glass, intersect::contact_stage),

    // What rays were tested against is counted, where a view asks for it.
    (Intersection, intersect::count_stage),

    // Rows are sorted by the kinds of shapes and materials that were hit.
    (Surfaces, intersect::classify_stage),
], bsdf_rows), Part(&[
    (Bounces, follow::max_depth_stage),
    (LightTracing, follow::keep_specular_stage),
    (LightTracing, follow::caustic_paths_stage),
    (DirectLight, shade::transmissive_rows_stage),

    // Positions, normals and colours of the surfaces that were hit.
], surface_points), Part(&[
    (Media, follow::scattering_event_stage),
    (Motion, intersect::moving_surface_stage),
    (Glass, intersect::contact_bound_stage),
    (Transforms, intersect::shading_normal_stage),
    (Textures, shade::copy_normals_stage),
    (Textures, shade::footprint_stage),
    (Textures, shade::colour_stage),
    (Textures, shade::texture_point_stage),
    (Textures, shade::checker_stage),
    (Textures, shade::stripes_stage),
    (Textures, shade::image_stage),
    (Textures, shade::normal_map_stage),
    (Textures, shade::metallic_roughness_stage),
    (Textures, shade::emission_map_stage),
    (Textures, shade::tint_stage),

    // The radiance of rays that hit nothing.
    (Radiance, shade::background_stage),
    (Environment, shade::environment_stage),
    (AreaLights, follow::mis_environment_stage),
    (Environment, shade::gradient_stage),
    (LightTracing, follow::environment_caustics_stage),

    // Layers of the film are recorded.
    (Film, film::layers_stage),

    // The medium along each ray is found, and absorbs light.
    (Glass, follow::start_media_stage),
    (Dispersion, rays::wavelength_stage),
    (Dispersion, follow::weight_by_wavelength_stage),
    (Glass, follow::absorb_stage),

    // Lights are sampled: a ray from each surface towards each of them, or towards the camera.
    (LightTracing, shade::join_point_stage),
    (Bidirectional, follow::arrive_with_ratios_stage),
], || light_samples(true)), Part(&[
    (AreaLights, shade::area_light_stage),
], || light_samples(false)), Part(&[
    (LightTracing, shade::camera_join_stage),
    (PhotonMapping, follow::store_photons_stage),
    (Bidirectional, follow::store_vertices_stage),
    (Bidirectional, follow::camera_ratios_stage),
    (AreaLights, shade::environment_light_stage),
    (AmbientOcclusion, follow::sky_rays_stage),
    (Bidirectional, follow::join_ratios_stage),
], joins), Part(&[
    (Media, follow::phase_join_stage),

    // Shadow rays are traced.
    (Glass, follow::leave_contacts_to_lights_stage),
    (Shadows, shade::start_shadow_stage),
], shadow_rays), Part(&[
    (Motion, shade::moving_shadow_stage),
    (Textures, shade::non_opaque_shadow_stage),
    (Glass, follow::absorb_shadow_stage),
    (Glass, follow::block_across_surfaces_stage),
    (Media, follow::medium_shadow_stage),
    (Media, follow::phase_mis_stage),
    (Media, follow::phase_join_weight_stage),

    // Direct light is evaluated: the light of unblocked shadow rays, reflected along the path.
], direct_light_of_bsdfs), Part(&[
    (Media, follow::phase_direct_light_stage),
    (Lights, shade::emissive_stage),
    (AreaLights, follow::mis_emission_stage),
    (Bidirectional, follow::found_emission_stage),
    (AmbientOcclusion, follow::sky_stage),
    (Unlit, shade::unlit_stage),

    // BSDFs are sampled to continue the path, or it is terminated.
], bsdf_samples), Part(&[
    (Media, follow::phase_sample_stage),
    (LightTracing, follow::shading_adjoint_stage),
    (Bidirectional, follow::leave_specular_stage),
    (Media, follow::phase_ratios_stage),
], carried_ratios), Part(&[
    (PathContinuation, follow::roulette_stage),
    (Bounces, follow::add_bounce_stage),
    (LightTracing, follow::splat_stage),
    (Glass, follow::leave_contacts_stage),
    (Glass, follow::carry_media_stage),
    (Dispersion, follow::carry_wavelengths_stage),
    (Glass, follow::absorb_at_start_stage),
    (AreaLights, follow::keep_previous_surfaces_stage),
    (PhotonMapping, follow::mark_photon_paths_stage),
    (Bounces, follow::next_bounce_stage),
    (Bounces, follow::footprints_stage),
    (Bounces, follow::times_stage),

    // All further bounces; then the light of the whole path is added to the film.
    (Bounces, follow::remaining_bounces_stage),
    (Bounces, follow::sum_bounces_stage),
], image_masks), Part(&[
    (Film, film::moments_stage),
    (Film, film::film_stage),
], Vec::new)];

fn of(group: Group) -> Vec<Stage> {
    listed(|own| own == group)
}

/// The stages of some groups, each with its place in the list.
fn listed(wanted: impl Fn(Group) -> bool) -> Vec<Stage> {
    let all = LIST.iter().flat_map(|Part(stages, registered)| stages.iter().copied().chain(registered()));
    let places = all.enumerate().filter(|&(_, (group, _))| wanted(group));
    places.map(|(place, (_, stage))| Stage { place, ..stage() }).collect()
}

/// All stages but the painting of a view, which depends on what else is on offer.
pub fn all() -> Vec<Stage> {
    listed(|_| true)
}

/// Sorts stages into the order of the list; those that are not in it follow in their given order.
pub fn sort(offer: &mut [Stage]) {
    static PLACES: OnceLock<BTreeMap<TypeId, usize>> = OnceLock::new();
    let places = PLACES.get_or_init(|| all().iter().map(|stage| (stage.id, stage.place)).collect());
    for stage in offer.iter_mut() {
        stage.place = places.get(&stage.id).copied().unwrap_or(usize::MAX);
    }
    offer.sort_by_key(|stage| stage.place);
}

/// A ray through the centre of each pixel: raster, NDC, screen, camera and world space; perspective and orthographic
/// cameras.
pub fn camera_rays() -> Vec<Stage> {
    of(CameraRays)
}

/// Several samples per pixel, where the camera asks for them.
pub fn samples() -> Vec<Stage> {
    of(Samples)
}

/// Fisheye and equirectangular cameras.
pub fn wide_cameras() -> Vec<Stage> {
    of(WideCameras)
}

/// A thin lens in place of the pinhole.
pub fn lens() -> Vec<Stage> {
    of(Lens)
}

/// Ray times, and shapes that move while the shutter is open.
pub fn motion() -> Vec<Stage> {
    of(Motion)
}

/// The closest hit of each ray with spheres, planes, disks, rectangles, cuboids and triangles.
pub fn intersection() -> Vec<Stage> {
    of(Intersection)
}

/// Triangles, meshes and the boxes of other shapes projected onto the image, so that no camera ray has to look for them.
pub fn rasterisation() -> Vec<Stage> {
    of(Rasterisation)
}

/// Positions and normals of hits.
pub fn surfaces() -> Vec<Stage> {
    of(Surfaces)
}

/// The effects of transforms on shapes: non-uniformly scaled spheres, and shading normals.
pub fn transforms() -> Vec<Stage> {
    of(Transforms)
}

/// Shadow rays from surfaces to lights.
pub fn shadows() -> Vec<Stage> {
    of(Shadows)
}

/// Surface colours in front of a background, where no lights are on offer.
pub fn unlit() -> Vec<Stage> {
    let shown = of(Unlit).into_iter().map(|stage| stage.when(shade::shown_evidence));
    of(Radiance).into_iter().chain(shown).collect()
}

/// Point lights on matte surfaces, with shadows, and a background; in a scene without light, surfaces are shown unlit.
pub fn direct_light() -> Vec<Stage> {
    [Radiance, DirectLight, Shadows, Unlit].into_iter().flat_map(of).collect()
}

/// Directional lights, spot lights, and surfaces that emit light.
pub fn lights() -> Vec<Stage> {
    of(Lights)
}

/// Phong and Blinn–Phong highlights.
pub fn highlights() -> Vec<Stage> {
    of(Highlights)
}

/// Textures, filtered over each pixel's footprint.
pub fn textures() -> Vec<Stage> {
    of(Textures)
}

/// Backgrounds of more than one colour: a gradient or an environment image.
pub fn environment() -> Vec<Stage> {
    of(Environment)
}

/// The stages that carry a path from bounce to bounce and sum its light.
pub fn bounces() -> Vec<Stage> {
    of(Bounces)
}

/// Mirrors, whose BSDF is a delta distribution.
pub fn specular_reflection() -> Vec<Stage> {
    of(SpecularReflection)
}

/// Glossy materials such as rough metal: their BSDFs sampled, and evaluated for direct light.
pub fn glossy_reflection() -> Vec<Stage> {
    of(GlossyReflection)
}

/// Glass: reflection and refraction, and the light that it absorbs.
pub fn glass() -> Vec<Stage> {
    of(Glass)
}

/// Dispersion: paths of one wavelength each, where the index of a glass depends on it.
pub fn dispersion() -> Vec<Stage> {
    of(Dispersion)
}

/// Area lights: surfaces that emit, and the environment.
pub fn area_lights() -> Vec<Stage> {
    of(AreaLights)
}

/// Ambient occlusion.
pub fn ambient_occlusion() -> Vec<Stage> {
    of(AmbientOcclusion)
}

/// Path continuation from matte surfaces, and Russian roulette.
pub fn path_continuation() -> Vec<Stage> {
    of(PathContinuation)
}

/// Multiple importance sampling: light that BSDF sampling finds too is weighted.
pub fn mis() -> Vec<Stage> {
    of(Mis)
}

/// Light tracing: paths from the lights to the camera.
pub fn light_tracing() -> Vec<Stage> {
    of(LightTracing)
}

/// Photon mapping: paths from the lights that end where paths from the camera find them.
///
/// To be offered beside [`light_tracing`], whose paths they are.
pub fn photon_mapping() -> Vec<Stage> {
    of(PhotonMapping)
}

/// Bidirectional path tracing: paths from the lights that are joined to paths from the camera, vertex to vertex.
///
/// To be offered beside [`light_tracing`], whose connections to the camera it weights.
pub fn bidirectional_path_tracing() -> Vec<Stage> {
    of(Bidirectional)
}

/// Participating media such as fog: distances sampled along each ray, light scattered by phase functions, and attenuated
/// on its way.
pub fn media() -> Vec<Stage> {
    of(Media)
}

/// The film: sums of samples, and the layers of each pixel.
pub fn film() -> Vec<Stage> {
    of(Film)
}

/// The stages of a shape that a program adds: its rows are listed, it is intersected with rays and shadow rays, in space
/// or in the pixels of its box, and its surface is computed.
pub fn of_shape<S: Listed>() -> Vec<Stage> {
    let boxes = (S::IS_BOUNDED && !S::IS_TRIANGULAR).then(rasterise::box_stage::<S>);
    let stages = [
        intersect::intersect_stage::<S>(),
        intersect::classify_shape_stage::<S>(),
        intersect::surface_stage::<S>(),
        shade::shape_shadow_stage::<S>(),
    ];
    boxes.into_iter().chain(stages).collect()
}

/// The stages of a material that a program adds: it is lit, and paths are continued from it.
pub fn of_material<B: Bsdf>() -> Vec<Stage> {
    follow::stages_of::<B>().iter().map(|own| (own.stage)()).collect()
}

/// The stage of a light that a program adds.
pub fn of_light<L: ListedLight>() -> Stage {
    shade::light_sampling_stage::<L>()
}

/// The stage of a texture that a program adds.
pub fn of_texture<T: Pattern>() -> Stage {
    shade::pattern_stage::<T>()
}
