use super::subject::Ball;
use glam::{DMat3, DVec2, DVec3};
use pinhole::extract::look_at_axes;
use pinhole::scene::LookAt;
use pinhole::{Error, Result};

/// How many parts a line is first cut into when it is asked what hides it.
const STEPS: usize = 160;
/// How often the place where a line disappears is halved.
const HALVINGS: usize = 24;

/// A scene seen in parallel projection, so that parallel lines stay parallel and lengths along an axis compare.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sketch {
    /// Columns: to the right of the drawing, up, and towards the viewer, as unit vectors of render space.
    pub axes: DMat3,
    /// Units of the drawing for one scene unit.
    pub scale: f64,
    /// Where render space's origin comes to lie.
    pub origin: DVec2,
}

/// A rectangle of the drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Upper left.
    pub low: DVec2,
    /// Lower right.
    pub high: DVec2,
}

impl Frame {
    /// As much higher and lower.
    pub fn taller(self, more: f64) -> Self {
        Self { low: self.low - DVec2::Y * more, high: self.high + DVec2::Y * more }
    }
}

/// A point, and how far a thing reaches around it.
pub type Extent = (DVec3, f64);

impl Sketch {
    /// Seen from the side that `toward_viewer` points to, as large as the frame allows, at its top and in its middle.
    ///
    /// Errors: the direction is 0 or along `up`.
    pub fn fitting(toward_viewer: DVec3, up: DVec3, things: &[Extent], frame: Frame) -> Result<Self> {
        let look = LookAt { eye: toward_viewer, target: DVec3::ZERO, up };
        let axes = look_at_axes("the figure", &look).map_err(Error::from)?;
        let unscaled = Self { axes, scale: 1.0, origin: DVec2::ZERO };
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for &(centre, extent) in things {
            let at = unscaled.point(centre);
            (low, high) = (low.min(at - extent), high.max(at + extent));
        }
        let room = (frame.high - frame.low) / (high - low).max(DVec2::splat(1e-9));
        let scale = room.min_element();
        let middle = (frame.low.x + frame.high.x) / 2.0 - scale * (low.x + high.x) / 2.0;
        let origin = DVec2::new(middle, frame.low.y - scale * low.y);
        Ok(Self { axes, scale, origin })
    }

    /// Where a point comes to lie; y down.
    pub fn point(&self, point: DVec3) -> DVec2 {
        let seen = self.axes.transpose() * point;
        self.origin + self.scale * DVec2::new(seen.x, -seen.y)
    }

    /// Where a direction leads in the drawing.
    pub fn direction(&self, direction: DVec3) -> DVec2 {
        self.point(direction) - self.point(DVec3::ZERO)
    }

    /// How near a point is to the viewer: more is nearer.
    pub fn nearness(&self, point: DVec3) -> f64 {
        self.axes.z_axis.dot(point)
    }

    /// Whether a sphere stands between the viewer and a point, or around it.
    pub fn hidden(&self, point: DVec3, balls: &[Ball]) -> bool {
        balls.iter().any(|ball| {
            let from_centre = point - ball.centre;
            let along = self.axes.z_axis.dot(from_centre);
            let inside = ball.radius * ball.radius - (from_centre.length_squared() - along * along);
            // A point on the side that faces the viewer is seen, though rounding may put it a little inside.
            inside > 0.0 && inside.sqrt() - along > 1e-3 * ball.radius
        })
    }

    /// Cuts a straight line where `class` changes along it.
    pub fn cut<C: PartialEq + Copy>(
        &self,
        from: DVec3,
        to: DVec3,
        class: impl Fn(DVec3) -> C,
    ) -> Vec<(DVec3, DVec3, C)> {
        let at = |fraction: f64| from.lerp(to, fraction);
        let fraction = |step: usize| (step as f64 + 0.5) / STEPS as f64;
        let mut parts = Vec::new();
        let (mut start, mut current) = (0.0, class(at(fraction(0))));
        for step in 1..STEPS {
            let next = class(at(fraction(step)));
            if next == current {
                continue;
            }
            let (mut low, mut high) = (fraction(step - 1), fraction(step));
            for _ in 0..HALVINGS {
                let middle = (low + high) / 2.0;
                if class(at(middle)) == current { low = middle } else { high = middle }
            }
            parts.push((at(start), at(high), current));
            (start, current) = (high, next);
        }
        parts.push((at(start), to, current));
        parts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sketch() -> Sketch {
        let frame = Frame { low: DVec2::ZERO, high: DVec2::splat(100.0) };
        let things = [(DVec3::ZERO, 1.0)];
        Sketch::fitting(DVec3::Z, DVec3::Y, &things, frame).expect("a sketch")
    }

    #[test]
    fn what_is_drawn_fills_its_frame() {
        let sketch = sketch();
        assert_eq!(sketch.scale, 50.0);
        assert_eq!(sketch.point(DVec3::new(1.0, 1.0, 7.0)), DVec2::new(100.0, 0.0));
    }

    #[test]
    fn a_sphere_hides_what_is_behind_it_and_within_it_but_not_its_own_front() {
        let ball = Ball { centre: DVec3::ZERO, radius: 1.0, colour: [1.0; 3], shape: 0 };
        let hidden = |z| sketch().hidden(DVec3::new(0.0, 0.0, z), std::slice::from_ref(&ball));
        assert_eq!([-2.0, 0.0, 1.0, 2.0].map(hidden), [true, true, false, false]);
    }

    #[test]
    fn a_line_is_cut_where_it_disappears() {
        let parts = sketch().cut(DVec3::ZERO, DVec3::X * 3.0, |point| point.x > 1.25);
        assert_eq!(parts.len(), 2);
        assert!((parts[0].1.x - 1.25).abs() < 1e-6 && parts[1].2);
    }
}
