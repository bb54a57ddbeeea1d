use super::camera_entity::camera_of;
use super::check::{kind_and_name, number, positive_length};
use super::{ImageFrame, PerspectiveProjection, SMALLEST_PIXEL};
use crate::plan::{Census, Evidence, Table};
use crate::scene::{Aperture, Lens, PerspectiveCamera, SceneError, called};
use bevy_ecs::prelude::*;
use glam::DVec2;

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
