use super::pen::{Fill, INK, Pen};
use super::pixel_ray::PixelRay;
use super::sketch::Frame;
use super::subject::Ball;
use super::svg::Svg;
use glam::{DVec2, DVec3};

/// The plane through a ray and a sphere's centre, laid flat: the first coordinate is t along the ray, the second is
/// across it, both in scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// Where the ray's origin comes to lie in the drawing.
    pub origin: DVec2,
    /// The ray's direction in the drawing, a unit vector.
    pub along: DVec2,
    /// Units of the drawing for one scene unit.
    pub scale: f64,
    /// The sphere's centre: how far along, how far across.
    pub centre: DVec2,
    /// The sphere's radius.
    pub radius: f64,
}

impl Section {
    /// Lays the section into a frame, the ray rising by `rise` radians; the points named must be in it too.
    pub fn new(ray: &PixelRay, ball: &Ball, rise: f64, points: &[DVec2], frame: Frame) -> Self {
        let to_centre: DVec3 = ball.centre - ray.origin;
        let s = to_centre.dot(ray.direction) / ray.direction.length_squared();
        let across = (to_centre - s * ray.direction).length();
        let centre = DVec2::new(s, across);
        let along = DVec2::new(libm::cos(rise), -libm::sin(rise));
        let unscaled = Self { origin: DVec2::ZERO, along, scale: 1.0, centre, radius: ball.radius };
        let at = unscaled.point(centre.x, centre.y);
        let (mut low, mut high) = (at - ball.radius, at + ball.radius);
        for point in points.iter().chain([&DVec2::ZERO]) {
            let at = unscaled.point(point.x, point.y);
            (low, high) = (low.min(at), high.max(at));
        }
        let scale = ((frame.high - frame.low) / (high - low)).min_element();
        Self { origin: (frame.low + frame.high) / 2.0 - scale * (low + high) / 2.0, scale, ..unscaled }
    }

    /// The drawing's point at t along and so far across.
    pub fn point(&self, t: f64, across: f64) -> DVec2 {
        self.origin + self.scale * (self.along * t + self.up() * across)
    }

    /// Across, to the side on which the sphere's centre lies.
    pub fn up(&self) -> DVec2 {
        DVec2::new(self.along.y, -self.along.x)
    }

    /// The sphere, cut through.
    pub fn paint_sphere(&self, svg: &mut Svg, colour: &str) {
        let (at, radius) = (self.point(self.centre.x, self.centre.y), self.radius * self.scale);
        svg.circle(at, radius, Some(&Fill::new(colour, 0.3)), Some(Pen::new(INK, 1.4)));
        // Labels may stand within the section, but not on its edge.
        svg.obstacles.discs.pop();
        let edge = |step: usize| {
            let angle = step as f64 * std::f64::consts::TAU / 36.0;
            at + radius * DVec2::new(libm::cos(angle), libm::sin(angle))
        };
        svg.obstacles.strokes.extend((0..36).map(|step| [edge(step), edge(step + 1)]));
    }

    /// A length along the ray, marked this many units of the drawing to the side on which the centre does not lie.
    ///
    /// Answers the middle of the mark.
    pub fn measure(&self, svg: &mut Svg, from: f64, to: f64, aside: f64, pen: Pen) -> DVec2 {
        let [from, to] = [from, to].map(|t| self.point(t, 0.0) - self.up() * aside);
        let tick = self.up() * 4.5;
        for end in [from, to] {
            svg.line(end - tick, end + tick, pen);
        }
        svg.line(from, to, pen);
        svg.head(from, -self.along, pen);
        svg.head(to, self.along, pen);
        (from + to) / 2.0
    }

    /// A thin line from a point of the ray down to its marks.
    pub fn drop(&self, svg: &mut Svg, t: f64, aside: f64) {
        let at = self.point(t, 0.0);
        svg.line(at, at - self.up() * aside, Pen::new(INK, 0.7).faint(0.4).dashed("3 3"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_scene_unit_along_the_ray_is_one_scale_long() {
        let ray = PixelRay {
            pixel: [0, 0],
            origin: DVec3::X,
            direction: DVec3::NEG_Z,
            hit: None,
            surface: None,
            colour: String::new(),
            onward: Vec::new(),
        };
        let ball = Ball { centre: DVec3::new(1.0, 0.5, -4.0), radius: 1.0, colour: [1.0; 3], shape: 0 };
        let frame = Frame { low: DVec2::ZERO, high: DVec2::new(600.0, 300.0) };
        let section = Section::new(&ray, &ball, 0.1, &[], frame);
        assert!((section.centre - DVec2::new(4.0, 0.5)).length() < 1e-12);
        let arrow = section.point(1.0, 0.0) - section.point(0.0, 0.0);
        assert!((arrow.length() - section.scale).abs() < 1e-9);
    }
}
