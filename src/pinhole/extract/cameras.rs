//! The camera of a scene: its axes, its lens, the steps between its pixels.

use super::check::{kind_and_name, number, positive_length, triple};
use super::pose::world_from_entity;
use super::{PerspectiveProjection, SMALLEST_PIXEL, SamplingTable};
use crate::cameras::{Camera, CameraNames, ImageFrame, Listed, RaySpread, with_cameras};
use crate::plan::{Census, Evidence, Table, counted, declared, entities};
use crate::scene::{
    Adaptive, Aperture, ChildOf, Exposure, Layers, Lens, PerspectiveCamera, Placement, Rasterisation, Resolution,
    Sampling, SceneError, ToneMapping, called, some_of,
};
use bevy_ecs::prelude::*;
use glam::{DMat3, DVec2, DVec3};
use std::sync::Arc;

/// How far a camera's axes may be from orthonormal before it is considered scaled.
const ROTATION_TOLERANCE: f64 = 1e-9;
/// The greatest number of pixels along one side.
const LONGEST_SIDE: u32 = 65_536;
/// The greatest number of pixels of a film, whose sums take 28 bytes each.
const MAX_PIXELS: u64 = 1 << 30;

/// The camera's position in world space: the origin of render space.
pub fn eye(scene: &Census<'_>) -> Result<DVec3, SceneError> {
    scene.once(|scene| {
        let (who, camera) = named_camera(scene)?;
        Ok(world_from_entity(scene, &who, camera)?.translation)
    })
}

impl Table for ImageFrame {
    const NAME: &'static str = "image shape";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (who, camera) = named_camera(scene)?;
        let Resolution { width, height } = scene.get::<Resolution>(camera).copied().unwrap_or_default();
        let sides = 1..=LONGEST_SIDE;
        let pixels = u64::from(width) * u64::from(height);
        if !sides.contains(&width) || !sides.contains(&height) || pixels > MAX_PIXELS {
            let accepted = format!(
                "each side must have 1 to {LONGEST_SIDE} pixels, and the image at most {MAX_PIXELS} altogether"
            );
            return Err(SceneError::new(who, "resolution", format!("{width} × {height}"), accepted));
        }
        Ok(Self { width, height })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

macro_rules! tables {
    ($($component:ident($camera:ty) $noun:literal,)+) => {
        $(impl Table for $camera {
            const NAME: &'static str = <Self as Camera>::TABLE;

            fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
                projection(scene)
            }

            fn bytes(&self) -> usize {
                size_of::<Self>()
            }
        })+
    };
}
with_cameras!(tables);

/// The projection of the scene's camera, or the default for a camera of another kind.
fn projection<C: Listed>(scene: &Census<'_>) -> Result<C, SceneError> {
    let (who, camera) = named_camera(scene)?;
    let Some(component) = scene.get::<C::Component>(camera) else { return Ok(C::default()) };
    let projection = C::project(component, *scene.table::<ImageFrame>()?, &who)?;
    match C::OUTLINE {
        Some(outline) if !scene.entities::<With<Layers>>().is_empty() => {
            let (noun, outside) = (C::NAMES.noun, outline.noun);
            let accepted = format!(
                "a {noun} camera has none, for outside its {outside} there is nothing to record: use another kind"
            );
            Err(SceneError::new(who, "layers", "requested", accepted))
        }
        _ => Ok(projection),
    }
}

/// How the rays of the scene's camera change across its image.
pub fn camera_spread(scene: &Census<'_>) -> Result<RaySpread, SceneError> {
    (camera_kind(scene)?.spread)(scene)
}

/// The camera's axes in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraAxes {
    /// Columns: the camera's x (right), y (up) and z (back) axes as unit vectors in world space.
    pub world_from_camera: DMat3,
}

impl Table for CameraAxes {
    const NAME: &'static str = "camera axes";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (who, camera) = named_camera(scene)?;
        let world_from_camera = world_from_entity(scene, &who, camera)?.matrix3;
        let off = world_from_camera.transpose() * world_from_camera - DMat3::IDENTITY;
        let worst = off.to_cols_array().iter().fold(0.0_f64, |worst, part| worst.max(part.abs()));
        let rotation = worst <= ROTATION_TOLERANCE && world_from_camera.determinant() > 0.0;
        if !rotation {
            return Err(scaled(scene, who, camera));
        }
        Ok(Self { world_from_camera })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// The error about the first entity from a camera up to its root that scales or mirrors it.
fn scaled(scene: &Census<'_>, who: String, camera: Entity) -> SceneError {
    let accepted = "a camera may only be rotated and moved, and no parent may scale or mirror it";
    let mut chain: Vec<(String, Entity)> = vec![(who.clone(), camera)];
    while let Some(parent) = scene.get::<ChildOf>(chain[chain.len() - 1].1).map(ChildOf::parent) {
        chain.push((format!("{who}'s parent {}", called(scene, parent)), parent));
    }
    let scale = |entity: Entity| scene.get::<Placement>(entity).map_or(DVec3::ONE, |placement| placement.scale);
    let scales =
        |(_, entity): &&(String, Entity)| (scale(*entity) - DVec3::ONE).abs().max_element() > ROTATION_TOLERANCE;
    let (who, entity) = chain.iter().find(scales).unwrap_or(&chain[0]);
    let scale = scale(*entity);
    let mirrors = if scale.x * scale.y * scale.z < 0.0 { ", which mirrors" } else { "" };
    SceneError::new(who.as_str(), "scale", format!("{}{mirrors}", triple(scale)), accepted)
}

/// A registered camera without its type.
#[derive(Clone, Copy)]
pub struct CameraKind {
    /// Its names.
    pub names: CameraNames,
    /// Whether its rays pass through a plane or a window.
    pub has_image_plane: bool,
    /// Whether its rays start at more than one point.
    pub has_many_origins: bool,
    /// How its rays change across the image of a scene.
    pub(super) spread: fn(&Census<'_>) -> Result<RaySpread, SceneError>,
    carrying: fn(&World) -> Vec<Entity>,
    declared: fn(&World) -> Vec<Entity>,
}

impl CameraKind {
    const fn of<C: Listed>() -> Self {
        Self {
            names: C::NAMES,
            has_image_plane: C::HAS_IMAGE_PLANE,
            has_many_origins: C::HAS_MANY_ORIGINS,
            spread: |scene| Ok(scene.table::<C>()?.spread(*scene.table::<ImageFrame>()?)),
            carrying: entities::<With<C::Component>>,
            declared: declared::<With<C::Component>>,
        }
    }
}

macro_rules! kinds {
    ($($component:ident($camera:ty) $noun:literal,)+) => {
        /// The registered cameras.
        pub const CAMERA_KINDS: &[CameraKind] = &[$(CameraKind::of::<$camera>()),+];
    };
}
with_cameras!(kinds);

/// A noun with its article: `a fisheye`, `an orthographic`.
pub(super) fn with_article(noun: &str) -> String {
    let article = if noun.to_lowercase().starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    format!("{article} {noun}")
}

/// The names of cameras, each with its article: `a fisheye or an orthographic`.
pub(super) fn any_of(names: impl Iterator<Item = &'static str>) -> String {
    let names: Vec<String> = names.map(with_article).collect();
    match &names[..] {
        [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
        _ => names.concat(),
    }
}

/// The one camera of the scene.
pub fn camera_entity(scene: &World) -> Result<Entity, SceneError> {
    find_camera(scene).map(|(camera, _)| camera)
}

fn find_camera(scene: &World) -> Result<(Entity, &'static CameraKind), SceneError> {
    let of_kind = |kind: &'static CameraKind| (kind.carrying)(scene).into_iter().map(move |camera| (camera, kind));
    let found: Vec<(Entity, &CameraKind)> = CAMERA_KINDS.iter().flat_map(of_kind).collect();
    let components = any_of(CAMERA_KINDS.iter().map(|kind| kind.names.component));
    let accepted = format!("exactly one entity must carry {components}");
    let value = match found[..] {
        [camera] => return Ok(camera),
        [] => {
            let disabled = CAMERA_KINDS.iter().flat_map(|kind| (kind.declared)(scene)).next();
            disabled.map_or("missing".into(), |own| format!("{}, which is disabled", called(scene, own)))
        }
        [(one, _), ..] if found.iter().all(|&(other, _)| other == one) => {
            let kinds: Vec<String> = found.iter().map(|(_, kind)| with_article(kind.names.component)).collect();
            format!("{} at once, on {}", kinds.join(" and "), called(scene, one))
        }
        _ => {
            let cameras: Vec<Entity> = found.iter().map(|&(camera, _)| camera).collect();
            format!("given {}: {}", counted(cameras.len(), "time"), some_of(scene, &cameras, ", "))
        }
    };
    Err(SceneError::new("the scene", "camera", value, accepted))
}

/// The camera of the scene and its kind, looked up once per census.
fn found_camera(scene: &Census<'_>) -> Result<(Entity, &'static CameraKind), SceneError> {
    scene.once(|scene| find_camera(scene))
}

/// The camera of the scene.
pub(super) fn camera_of(scene: &Census<'_>) -> Result<Entity, SceneError> {
    found_camera(scene).map(|(camera, _)| camera)
}

/// What kind of camera the scene has.
pub fn camera_kind(scene: &Census<'_>) -> Result<&'static CameraKind, SceneError> {
    found_camera(scene).map(|(_, kind)| kind)
}

/// The camera and its name in messages.
pub(super) fn named_camera(scene: &Census<'_>) -> Result<(String, Entity), SceneError> {
    let camera = camera_of(scene)?;
    Ok((kind_and_name(scene, "camera", camera), camera))
}

// Components that mean nothing but on the camera.

/// Such components, each with its word in messages, unless a table of their own asks where they are.
const ON_CAMERA: [(&str, fn(&Census<'_>) -> Arc<[Entity]>); 6] = [
    ("resolution", |scene| scene.entities::<With<Resolution>>()),
    ("sampling", |scene| scene.entities::<With<Sampling>>()),
    ("rasterisation", |scene| scene.entities::<With<Rasterisation>>()),
    ("adaptive", |scene| scene.entities::<With<Adaptive>>()),
    ("exposure", |scene| scene.entities::<With<Exposure>>()),
    ("tone_mapping", |scene| scene.entities::<With<ToneMapping>>()),
];

/// Checks that no other entity carries one of them.
pub(super) fn check_on_camera(scene: &Census<'_>) -> Result<(), SceneError> {
    let camera = camera_of(scene)?;
    for (word, carrying) in ON_CAMERA {
        if let Some(&other) = carrying(scene).iter().find(|&&entity| entity != camera) {
            return Err(SceneError::new(called(scene, other), word, "on no camera", "it must be on the camera"));
        }
    }
    Ok(())
}

/// The least fraction of a pixel that a sample stands for, however many samples there are, as in pbrt-v4: neighbouring
/// samples are random, and so farther apart than the pixel's side over the square root of their number.
const MIN_FRACTION: f64 = 0.125;

/// The ray differentials of a camera: how its rays change from one sample to the next, to the right and down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelSteps {
    /// Change of the direction, where the image plane is at distance 1; 0 for parallel rays.
    pub direction: [DVec3; 2],
    /// Change of the origin; 0 where all rays start at the eye.
    pub origin: [DVec3; 2],
    /// The viewing direction, a unit vector.
    pub ahead: DVec3,
    /// The angle between neighbouring rays, in radians, for a camera without an image plane; roughly the same
    /// everywhere.
    pub angle: Option<f64>,
}

/// How wide a pixel is: in scene units, and in scene units for each at which it is seen.
pub fn pixel_width(scene: &Census<'_>) -> Result<[f64; 2], SceneError> {
    let pixel = 2.0 / f64::from(scene.table::<ImageFrame>()?.height);
    Ok(match camera_spread(scene)? {
        RaySpread::Central(half_height) => [0.0, pixel * half_height],
        RaySpread::Parallel(half_height) => [pixel * half_height, 0.0],
        RaySpread::Angular(pixel) => [0.0, pixel],
    })
}

impl Table for PixelSteps {
    const NAME: &'static str = "pixel steps";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        let (image, axes) = (*scene.table::<ImageFrame>()?, scene.table::<CameraAxes>()?.world_from_camera);
        // Pixels are square, on a screen of height 2.
        let fraction = (1.0 / f64::from(scene.table::<SamplingTable>()?.samples).sqrt()).max(MIN_FRACTION);
        let pixel = 2.0 / f64::from(image.height) * fraction;
        let steps = |length: f64| [axes.x_axis * length, -axes.y_axis * length];
        let none = [DVec3::ZERO; 2];
        let (direction, origin, angle) = match camera_spread(scene)? {
            RaySpread::Central(half_height) => (steps(pixel * half_height), none, None),
            RaySpread::Parallel(half_height) => (none, steps(pixel * half_height), None),
            RaySpread::Angular(pixel) => (none, none, Some(pixel * fraction)),
        };
        Ok(Self { direction, origin, ahead: -axes.z_axis, angle })
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// The range of numbers of an aperture's blades.
const BLADES: std::ops::RangeInclusive<u32> = 3..=64;
/// The largest aperture radius, such that its square can be represented in f32.
const WIDEST: f64 = 1e18;

/// The aperture of a thin lens.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LensTable {
    /// Its radius in scene units; for a polygonal aperture, the radius of its corners.
    pub radius: f64,
    /// Distance from the eye to the plane of focus along the camera's axis, in scene units.
    pub focus_distance: f64,
    /// The corners of an aperture of radius 1, anticlockwise, the first repeated at the end; empty where it is round.
    pub corners: Vec<DVec2>,
}

impl LensTable {
    /// The aperture of a lens.
    ///
    /// Errors: a parameter out of range; `who` is the entity's name in messages.
    pub fn of(lens: &Lens, who: &str) -> Result<Self, SceneError> {
        let radius = radius_of(lens.aperture, who)?;
        positive_length(who, "focus_distance", lens.focus_distance)?;
        if lens.blades != 0 && !BLADES.contains(&lens.blades) {
            let accepted = "it must be 0 for a round opening, or a number of straight edges from 3 to 64";
            return Err(SceneError::new(who, "blades", lens.blades, accepted));
        }
        if !(-360.0..=360.0).contains(&lens.turn.0) {
            let accepted = "it must lie from -360° to 360°";
            return Err(SceneError::new(who, "turn", format!("{}°", number(lens.turn.0)), accepted));
        }
        let corner = |blade: u32| {
            let fraction = f64::from(blade % lens.blades) / f64::from(lens.blades);
            let (sine, cosine) = libm::sincos(fraction * (2.0 * std::f64::consts::PI) + lens.turn.radians());
            DVec2::new(cosine, sine)
        };
        let corners = if lens.blades == 0 { Vec::new() } else { (0..=lens.blades).map(corner).collect() };
        Ok(Self { radius, focus_distance: lens.focus_distance, corners })
    }

    // ANCHOR: circle_of_confusion
    /// The circle of confusion of a point at a depth z, on the plane of focus: the diameter 2R |z − f| / z, in scene
    /// units.
    ///
    /// A ray from the lens point L through the point Q at depth z intersects the plane of focus at L + (Q − L) f / z =
    /// Q f / z + L (1 − f / z).
    /// As L varies over an aperture of radius R, that point varies over a disk of radius R |1 − f / z|.
    pub fn circle_of_confusion(&self, depth: f64) -> f64 {
        2.0 * self.radius * (depth - self.focus_distance).abs() / depth
    }
    // ANCHOR_END: circle_of_confusion
}

fn radius_of(aperture: Aperture, who: &str) -> Result<f64, SceneError> {
    let within = |field: &'static str, length: f64, what: &str| {
        if (0.0..=WIDEST).contains(&length) {
            return Ok(length);
        }
        Err(SceneError::new(
            who,
            field,
            number(length),
            format!("it must be a {what} from 0 to {WIDEST:e}, where 0 is a pinhole"),
        ))
    };
    match aperture {
        Aperture::Radius { radius } => within("aperture radius", radius, "length"),
        Aperture::FNumber { number: f_number, focal_length } => {
            positive_length(who, "aperture number", f_number).map_err(|scene_error| SceneError {
                accepted: "it must be an f-number from 1e-18 to 1e18, the focal length over the diameter".into(),
                ..scene_error
            })?;
            positive_length(who, "aperture focal_length", focal_length)?;
            within("aperture number", focal_length / (2.0 * f_number), "number that gives a radius")
        }
    }
}

impl Table for LensTable {
    const NAME: &'static str = "lens";

    fn extract(scene: &Census<'_>) -> Result<Self, SceneError> {
        check_owners(scene)?;
        let camera = camera_of(scene)?;
        let who = kind_and_name(scene, "camera", camera);
        let Some(lens) = scene.get::<Lens>(camera) else { return Ok(Self::default()) };
        let table = Self::of(lens, &who)?;
        let image = scene.table::<ImageFrame>()?;
        let pixel = 2.0 * scene.table::<PerspectiveProjection>()?.tan_half_vertical / f64::from(image.height);
        let seen = seen_from_edge(pixel, &table);
        if seen < SMALLEST_PIXEL {
            let value = format!(
                "of radius {} with focus_distance {}, {seen:.1e} rad a pixel from its edge",
                number(table.radius),
                number(table.focus_distance)
            );
            let accepted = format!(
                "a pixel on the plane in focus must seem at least {SMALLEST_PIXEL:.0e} rad wide for world rays in f32: \
                 take a smaller radius, a farther focus or fewer pixels"
            );
            return Err(SceneError::new(who, "aperture", value, accepted));
        }
        Ok(table)
    }

    fn bytes(&self) -> usize {
        size_of::<Self>() + size_of_val(&self.corners[..])
    }
}

/// The angle that a pixel on the plane of focus subtends for rays from the lens's edge, scaled to their accuracy in
/// f32, in radians.
///
/// A ray in f32 misses its point by u (R + √(f² + R²)), one term for its origin and one for its direction over the
/// distance; that is at most u (f + 2R), where for a pinhole it is uf, with u = 2⁻²⁴.
fn seen_from_edge(pixel: f64, lens: &LensTable) -> f64 {
    pixel * lens.focus_distance / (lens.focus_distance + 2.0 * lens.radius)
}

/// Only a perspective camera may carry a lens.
fn check_owners(scene: &Census<'_>) -> Result<(), SceneError> {
    let camera = camera_of(scene)?;
    for &entity in scene.entities::<With<Lens>>().iter() {
        if entity != camera || scene.get::<PerspectiveCamera>(entity).is_none() {
            let who = if entity == camera { kind_and_name(scene, "camera", entity) } else { called(scene, entity) };
            let kind = if entity == camera { "no PerspectiveCamera" } else { "no camera" };
            let accepted = "only an entity with a PerspectiveCamera may carry a Lens";
            return Err(SceneError::new(who, "lens", format!("given to {kind}"), accepted));
        }
    }
    Ok(())
}

/// Evidence that the camera has an aperture larger than a point.
pub fn lens_evidence(scene: &Census<'_>) -> Evidence {
    let open = |camera: EntityRef<'_>| {
        camera.get::<Lens>().and_then(|lens| radius_of(lens.aperture, "").ok()).is_none_or(|radius| radius > 0.0)
    };
    let evidence = Evidence::among::<(With<PerspectiveCamera>, With<Lens>)>(scene, "camera with a lens", open);
    let closed = scene.entities::<(With<PerspectiveCamera>, With<Lens>)>();
    match closed.first() {
        Some(&camera) if !evidence.needed => {
            Evidence { reason: format!("aperture 0: the lens of {} is a pinhole", called(scene, camera)), ..evidence }
        }
        _ => evidence,
    }
}

/// Says by its presence that camera rays start at more than one point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayOrigins;

impl Table for RayOrigins {
    const NAME: &'static str = "ray origins";

    fn extract(_scene: &Census<'_>) -> Result<Self, SceneError> {
        Ok(Self)
    }

    fn bytes(&self) -> usize {
        0
    }
}

/// Evidence that camera rays start at more than one point: on a window or on a lens.
pub fn ray_origins_evidence(scene: &Census<'_>) -> Evidence {
    match camera_kind(scene) {
        Ok(camera) if camera.has_many_origins => Evidence::always("rays that start on a window"),
        _ => lens_evidence(scene),
    }
}
