use super::sketch::Extent;
use super::subject::{Ball, Flat};
use glam::{DVec2, DVec3};

/// The most lines that a patch is ruled with in one direction.
const MOST_LINES: f64 = 16.0;
/// How many points outline a shadow.
const OUTLINE: usize = 48;

/// The part of an endless plane that a figure shows, ruled in whole scene units.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// A point of the plane.
    pub origin: DVec3,
    /// The plane's unit normal.
    pub normal: DVec3,
    /// A unit vector in the plane.
    pub u: DVec3,
    /// Another, perpendicular to it.
    pub v: DVec3,
    /// The least u and v, scene units.
    pub low: DVec2,
    /// The greatest u and v, scene units.
    pub high: DVec2,
    /// The share of light that the plane sends on, linear Rec. 709.
    pub colour: [f64; 3],
}

impl Patch {
    /// What lies under these things, with its lines along `right` as near as may be.
    pub fn under(flat: &Flat, right: DVec3, things: &[Extent]) -> Self {
        let along = right - flat.normal * flat.normal.dot(right);
        let u = along.try_normalize().unwrap_or_else(|| flat.normal.any_orthonormal_vector());
        let v = flat.normal.cross(u);
        let origin = flat.normal * flat.offset;
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for &(centre, reach) in things {
            let foot = DVec2::new((centre - origin).dot(u), (centre - origin).dot(v));
            (low, high) = (low.min(foot - reach), high.max(foot + reach));
        }
        let colour = flat.colour;
        let margin = 0.04 * (high - low).max_element();
        Self { origin, normal: flat.normal, u, v, low: low - margin, high: high + margin, colour }
    }

    /// The distance between lines: 1 scene unit, or 2, 5, 10, … where that would be too dense.
    pub fn step(&self) -> f64 {
        let longest = (self.high - self.low).max_element();
        let mut decade = 1.0;
        loop {
            if let Some(factor) = [1.0, 2.0, 5.0].into_iter().find(|factor| longest / (factor * decade) <= MOST_LINES) {
                return factor * decade;
            }
            decade *= 10.0;
        }
    }

    /// The point at u and v.
    pub fn point(&self, at: DVec2) -> DVec3 {
        self.origin + self.u * at.x + self.v * at.y
    }

    /// The four corners, around.
    pub fn corners(&self) -> [DVec3; 4] {
        let (low, high) = (self.low, self.high);
        [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)].map(|corner| self.point(corner))
    }

    /// The lines it is ruled with.
    pub fn lines(&self) -> Vec<[DVec3; 2]> {
        let step = self.step();
        let mut lines = Vec::new();
        for (axis, other) in [(0, 1), (1, 0)] {
            let first = (self.low[axis] / step).ceil();
            let count = (self.high[axis] / step).floor() - first;
            for line in 0..=count.max(0.0) as u32 {
                let mut ends = [self.low, self.low];
                for (end, far) in ends.iter_mut().zip([self.low[other], self.high[other]]) {
                    end[axis] = (first + f64::from(line)) * step;
                    end[other] = far;
                }
                lines.push(ends.map(|end| self.point(end)));
            }
        }
        lines
    }

    /// The outline of the shadow that a sphere casts here, cut at the patch's edges; none where none falls.
    ///
    /// Its edge is where the rays from the light that only just touch the sphere meet the plane.
    pub fn shadow(&self, light: DVec3, ball: &Ball) -> Vec<DVec3> {
        let to_light = light - ball.centre;
        let distance = to_light.length();
        if distance <= ball.radius || self.normal.dot(light - self.origin) <= 0.0 {
            return Vec::new();
        }
        let axis = to_light / distance;
        let sine = ball.radius / distance;
        let touch = ball.centre + axis * ball.radius * sine;
        let (a, b) = axis.any_orthonormal_pair();
        let rim = ball.radius * (1.0 - sine * sine).sqrt();
        let mut outline = Vec::new();
        for step in 0..OUTLINE {
            let angle = step as f64 / OUTLINE as f64 * std::f64::consts::TAU;
            let edge = touch + rim * (libm::cos(angle) * a + libm::sin(angle) * b);
            let t = crate::intersect::plane_t(light, edge - light, self.normal, self.normal.dot(self.origin));
            // Cut by the plane, or cast past the horizon: no outline that closes.
            if !t.is_finite() || t < 1.0 - 1e-9 {
                return Vec::new();
            }
            let met = light + t * (edge - light) - self.origin;
            outline.push(DVec2::new(met.dot(self.u), met.dot(self.v)));
        }
        self.trimmed(outline).into_iter().map(|at| self.point(at)).collect()
    }

    /// A convex outline cut at the four edges, one after the other.
    fn trimmed(&self, mut outline: Vec<DVec2>) -> Vec<DVec2> {
        for (axis, bound, side) in
            [(0, self.low.x, 1.0), (0, self.high.x, -1.0), (1, self.low.y, 1.0), (1, self.high.y, -1.0)]
        {
            let depth = |at: DVec2| side * (at[axis] - bound);
            let mut kept = Vec::new();
            for (index, &from) in outline.iter().enumerate() {
                let to = outline[(index + 1) % outline.len()];
                if depth(from) >= 0.0 {
                    kept.push(from);
                }
                if depth(from) * depth(to) < 0.0 {
                    kept.push(from.lerp(to, depth(from) / (depth(from) - depth(to))));
                }
            }
            outline = kept;
        }
        outline
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ground() -> Patch {
        let flat = Flat { normal: DVec3::Y, offset: 0.0, colour: [0.5; 3] };
        Patch::under(&flat, DVec3::X, &[(DVec3::ZERO, 3.0)])
    }

    #[test]
    fn a_patch_lies_in_its_plane_and_under_its_things() {
        let patch = ground();
        assert!(patch.corners().iter().all(|corner| corner.y.abs() < 1e-12 && corner.x.abs() >= 3.0));
        assert_eq!(patch.step(), 1.0);
    }

    #[test]
    fn the_shadow_of_a_sphere_straight_below_the_light_is_a_disc() {
        let ball = Ball { centre: DVec3::Y, radius: 0.5, colour: [1.0; 3], shape: 0 };
        let shadow = ground().shadow(DVec3::Y * 3.0, &ball);
        // The rays that touch have the sine 1/4, so the disc's radius is 3 tan.
        let radius = 3.0 * 0.25 / (1.0_f64 - 0.0625).sqrt();
        assert!(shadow.len() == OUTLINE && shadow.iter().all(|at| (at.length() - radius).abs() < 1e-9));
    }
}
