use super::grid::Grid;
use super::pixel_ray::PixelRay;
use super::scenery::Scenery;
use super::sketch::{Extent, Frame};
use super::subject::{Lens, Subject};
use glam::{DVec2, DVec3};
use pinhole::Result;
use pinhole::scene::Degrees;

/// From where a scene is sketched, in degrees: 0 is from behind the camera, 90 from its right, −90 from its left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// Around the upward axis.
    pub around: f64,
    /// Above the horizon.
    pub above: f64,
}

impl Side {
    /// The direction to the viewer, and what points upward in the drawing.
    pub fn view(self, subject: &Subject) -> (DVec3, DVec3) {
        // The world's upward direction keeps the horizon level, unless the camera looks along it.
        let ahead = -subject.axes.z_axis;
        let up = if ahead.y.abs() < 0.9 { DVec3::Y } else { subject.axes.y_axis };
        let level = (ahead - up * ahead.dot(up)).normalize_or(ahead);
        let right = level.cross(up);
        let [around, above] = [self.around, self.above].map(|angle| Degrees(angle).radians());
        let horizontal = right * libm::sin(around) - level * libm::cos(around);
        (horizontal * libm::cos(above) + up * libm::sin(above), up)
    }

    /// All sides that a figure may be drawn from: obliquely from behind, where the image is the right way round.
    fn all() -> impl Iterator<Item = Self> {
        let around = (0..8).flat_map(|step| [1.0, -1.0].map(|hand| hand * (36.0 + 5.0 * f64::from(step))));
        around.flat_map(|around| [12.0, 18.0, 24.0, 30.0].map(|above| Self { around, above }))
    }
}

/// The scenery from the side, and with the image at the place, that shows these rays, the image and the spheres best.
pub fn best_scenery<'s>(
    subject: &'s Subject,
    grids: &[Grid],
    rays: &[&PixelRay],
    more: &[Extent],
    frame: Frame,
) -> Result<Scenery<'s>> {
    let mut best: Option<(f64, Scenery<'s>)> = None;
    for &grid in grids {
        for side in Side::all() {
            let scenery = Scenery::new(subject, grid, side, more, frame)?;
            let worth = worth(&scenery, rays);
            if best.as_ref().is_none_or(|(max, _)| worth > *max) {
                best = Some((worth, scenery));
            }
        }
    }
    match best {
        Some((_, scenery)) => Ok(scenery),
        None => Scenery::new(subject, Grid::of(subject, 1.0), Side { around: 54.0, above: 20.0 }, more, frame),
    }
}

/// More where little is hidden, the image is large, and rays are long.
fn worth(scenery: &Scenery<'_>, rays: &[&PixelRay]) -> f64 {
    let [a, b, _, d] = scenery.grid.corners().map(|corner| scenery.point(corner));
    let image = (b - a).perp_dot(d - a).abs();
    let upright = image / ((b - a).length() * (d - a).length());
    let length = |from: DVec3, to: DVec3| scenery.point(from).distance(scenery.point(to));
    let camera = rays.iter().filter_map(|ray| Some(length(ray.origin, ray.point()?)));
    let shadow = rays.iter().filter_map(|ray| ray.lit()).map(|on| length(on.from, on.to));
    let seen = seen(scenery, rays);
    // Rays side by side lie the farther apart, the less one looks along the plane that they lie in.
    let unit = |axis: DVec3| scenery.sketch.direction(axis) / scenery.sketch.scale;
    let apart = unit(scenery.subject.axes.z_axis).perp_dot(unit(scenery.subject.axes.x_axis)).abs().sqrt();
    // A camera's rays that spread by themselves need it less.
    let apart = if matches!(scenery.subject.lens, Lens::Perspective(_)) { apart.sqrt() } else { apart };
    // Where it makes little difference, the rays run in the direction in which one reads.
    let reads = if scenery.sketch.direction(-scenery.subject.axes.z_axis).x > 0.0 { 1.35 } else { 1.0 };
    let clear = reads * upright * libm::pow(seen, 6.0) * apart;
    clear * image.sqrt() * image.sqrt().sqrt() * mean(camera).sqrt() * mean(shadow).sqrt()
}

/// The mean of lengths; 1 where there are none, so that it can be a factor.
fn mean(lengths: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = lengths.fold((0.0, 0.0), |(sum, count), length| (sum + length, count + 1.0));
    if count > 0.0 { sum / count } else { 1.0 }
}

/// The fraction of what matters that nothing hides: the rims of spheres, where rays end, their segments to the light.
fn seen(scenery: &Scenery<'_>, rays: &[&PixelRay]) -> f64 {
    let [right, up, toward] = [scenery.sketch.axes.x_axis, scenery.sketch.axes.y_axis, scenery.sketch.axes.z_axis];
    let (mut seen, mut all) = (0.0, 0.0);
    let mut ask = |point: DVec3, weight: f64| {
        all += weight;
        seen += if scenery.veiled(point) { 0.0 } else { weight };
    };
    for ball in &scenery.subject.balls {
        for out in RIM {
            ask(ball.centre + (right * out.x + up * out.y) * ball.radius * 1.001, 2.5);
        }
    }
    for light in &scenery.subject.lights {
        // A light's sign is drawn over everything, so ask from far behind it: nothing may lie there either.
        ask(*light - toward * 1e3 * (light.length() + 1.0), 8.0);
    }
    for ray in rays {
        if let Some(point) = ray.point() {
            let centre = scenery.grid.centre(ray.pixel);
            [0.8, 1.0].into_iter().for_each(|fraction| ask(centre.lerp(point, fraction), 3.0));
        }
        if let Some(on) = ray.lit() {
            [0.15, 0.4, 0.7].into_iter().for_each(|fraction| ask(on.from.lerp(on.to, fraction), 1.0));
        }
    }
    seen / f64::max(all, 1.0)
}

/// Eight directions around.
const RIM: [DVec2; 8] = {
    const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;
    [
        DVec2::X,
        DVec2::new(HALF, HALF),
        DVec2::Y,
        DVec2::new(-HALF, HALF),
        DVec2::NEG_X,
        DVec2::new(-HALF, -HALF),
        DVec2::NEG_Y,
        DVec2::new(HALF, -HALF),
    ]
};
