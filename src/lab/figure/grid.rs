use super::subject::{Lens, Subject};
use glam::DVec3;

/// The rectangle that the image is, standing in render space with its pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// The image's top left corner.
    pub corner: DVec3,
    /// From there to the top right corner.
    pub right: DVec3,
    /// From there to the bottom left corner.
    pub down: DVec3,
    /// Pixels across and down.
    pub size: [u32; 2],
}

impl Grid {
    /// The image plane at this distance before the eye; an orthographic camera's rectangle is where it is.
    pub fn of(subject: &Subject, distance: f64) -> Self {
        let (half_height, ahead) = match subject.lens {
            Lens::Perspective(tan_half) => (tan_half * distance, distance),
            Lens::Orthographic(half) => (half, 0.0),
        };
        let half_width = half_height * subject.image.aspect();
        let [x, y, z] = [subject.axes.x_axis, subject.axes.y_axis, subject.axes.z_axis];
        Self {
            corner: -z * ahead - x * half_width + y * half_height,
            right: x * half_width * 2.0,
            down: -y * half_height * 2.0,
            size: [subject.image.width, subject.image.height],
        }
    }

    /// The raster point (x, y), in pixels, as a point of the scene.
    pub fn point(&self, x: f64, y: f64) -> DVec3 {
        self.corner + self.right * (x / f64::from(self.size[0])) + self.down * (y / f64::from(self.size[1]))
    }

    /// The centre of a pixel.
    pub fn centre(&self, [x, y]: [u32; 2]) -> DVec3 {
        self.point(f64::from(x) + 0.5, f64::from(y) + 0.5)
    }

    /// The four corners of a pixel, around.
    pub fn cell(&self, [x, y]: [u32; 2]) -> [DVec3; 4] {
        let (x, y) = (f64::from(x), f64::from(y));
        [self.point(x, y), self.point(x + 1.0, y), self.point(x + 1.0, y + 1.0), self.point(x, y + 1.0)]
    }

    /// The four corners of the image, around from the top left.
    pub fn corners(&self) -> [DVec3; 4] {
        [self.corner, self.corner + self.right, self.corner + self.right + self.down, self.corner + self.down]
    }

    /// The middle of the image.
    pub fn middle(&self) -> DVec3 {
        self.corner + (self.right + self.down) / 2.0
    }

    /// Whether the rectangle stands between a point and a viewer in this direction.
    pub fn hides(&self, point: DVec3, toward_viewer: DVec3) -> bool {
        let normal = self.right.cross(self.down);
        let steps = normal.dot(self.corner - point) / normal.dot(toward_viewer);
        let hit = point + steps * toward_viewer - self.corner;
        let across = hit.dot(self.right) / self.right.length_squared();
        let down = hit.dot(self.down) / self.down.length_squared();
        steps > 1e-6 * self.right.length() && (0.0..=1.0).contains(&across) && (0.0..=1.0).contains(&down)
    }
}

/// How far before the eye the image plane can be drawn so that it is large, yet before every sphere and above every
/// plane; any distance gives the same rays.
pub fn drawn_distance(subject: &Subject) -> f64 {
    let ahead = -subject.axes.z_axis;
    let before = |ball: &super::subject::Ball| (ball.centre.dot(ahead) - ball.radius) * 0.72;
    let spheres = subject.balls.iter().map(before).filter(|&distance| distance > 0.0);
    let at_one = Grid::of(subject, 1.0);
    let planes = subject.planar_shapes.iter().flat_map(|planar| {
        at_one
            .corners()
            .map(|corner| pinhole::shapes::plane_t(DVec3::ZERO, corner, planar.normal, planar.offset) * 0.88)
    });
    let room = spheres.chain(planes).fold(f64::INFINITY, f64::min);
    // One decimal, since the figure's foot says it.
    if room.is_finite() { ((room * 10.0).floor() / 10.0).max(0.1) } else { 1.0 }
}
