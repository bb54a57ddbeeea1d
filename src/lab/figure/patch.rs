use super::sketch::Extent;
use super::subject::{Ball, Planar};
use glam::{DVec2, DVec3};

/// The most lines that a patch is ruled with in one direction.
const MAX_LINES: f64 = 16.0;
/// How many points outline a shadow, and the surroundings of a thing.
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
    /// Its convex outline in u and v, scene units, counter-clockwise.
    pub outline: Vec<DVec2>,
    /// The fraction of light that the plane sends on, linear Rec. 709.
    pub colour: [f64; 3],
}

impl Patch {
    /// What lies under and around these things, with its lines along `right` as near as may be.
    pub fn under(planar: &Planar, right: DVec3, things: &[Extent]) -> Self {
        let along = right - planar.normal * planar.normal.dot(right);
        let u = along.try_normalize().unwrap_or_else(|| planar.normal.any_orthonormal_vector());
        let v = planar.normal.cross(u);
        let origin = planar.normal * planar.offset;
        let foot =
            |&(centre, extent): &Extent| (DVec2::new((centre - origin).dot(u), (centre - origin).dot(v)), extent);
        let feet: Vec<(DVec2, f64)> = things.iter().map(foot).collect();
        let (low, high) = bounds(feet.iter().map(|&(at, _)| at));
        let margin = 0.07 * (high - low).max_element().max(1e-9);
        let around = |&(at, extent): &(DVec2, f64)| circle(at, extent + margin);
        let outline = hull(feet.iter().flat_map(around).collect());
        Self { origin, normal: planar.normal, u, v, outline, colour: planar.colour }
    }

    /// The distance between lines: 1 scene unit, or 2, 5, 10, … where that would be too dense.
    pub fn step(&self) -> f64 {
        let (low, high) = bounds(self.outline.iter().copied());
        let longest = (high - low).max_element();
        let mut decade = 1.0;
        loop {
            if let Some(factor) = [1.0, 2.0, 5.0].into_iter().find(|factor| longest / (factor * decade) <= MAX_LINES) {
                return factor * decade;
            }
            decade *= 10.0;
        }
    }

    /// The point at u and v.
    pub fn point(&self, at: DVec2) -> DVec3 {
        self.origin + self.u * at.x + self.v * at.y
    }

    /// Its corners, around.
    pub fn corners(&self) -> Vec<DVec3> {
        self.outline.iter().map(|&corner| self.point(corner)).collect()
    }

    /// The lines it is ruled with.
    pub fn lines(&self) -> Vec<[DVec3; 2]> {
        let step = self.step();
        let (low, high) = bounds(self.outline.iter().copied());
        let mut lines = Vec::new();
        for (axis, other) in [(0, 1), (1, 0)] {
            let first = (low[axis] / step).ceil();
            let count = ((high[axis] / step).floor() - first).max(0.0) as u32;
            for line in 0..=count {
                let mut ends = [low, high];
                for end in &mut ends {
                    end[axis] = (first + f64::from(line)) * step;
                }
                ends[0][other] = low[other];
                ends[1][other] = high[other];
                if let [from, .., to] = self.trimmed(ends.to_vec())[..] {
                    lines.push([from, to].map(|end| self.point(end)));
                }
            }
        }
        lines
    }

    /// The outline of the shadow that a sphere casts here, cut at the patch's edges; none where none falls.
    ///
    /// Its edge is where the rays from the light that only just touch the sphere intersect the plane.
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
        for around in circle(DVec2::ZERO, rim) {
            let edge = touch + around.x * a + around.y * b;
            let t = pinhole::shapes::plane_t(light, edge - light, self.normal, self.normal.dot(self.origin));
            // Cut by the plane, or cast past the horizon: no outline that closes.
            if !t.is_finite() || t < 1.0 - 1e-9 {
                return Vec::new();
            }
            let edge_point = light + t * (edge - light) - self.origin;
            outline.push(DVec2::new(edge_point.dot(self.u), edge_point.dot(self.v)));
        }
        self.trimmed(outline).into_iter().map(|at| self.point(at)).collect()
    }

    /// A convex outline, or a straight line, cut at the patch's edges, one after the other.
    fn trimmed(&self, mut outline: Vec<DVec2>) -> Vec<DVec2> {
        for (index, &start) in self.outline.iter().enumerate() {
            let edge = self.outline[(index + 1) % self.outline.len()] - start;
            let depth = |at: DVec2| edge.perp_dot(at - start);
            let mut kept = Vec::new();
            // A line has one side, an outline as many as corners.
            let sides = if outline.len() == 2 { 1 } else { outline.len() };
            for (index, &from) in outline.iter().enumerate() {
                let to = outline[(index + 1) % outline.len()];
                if depth(from) >= 0.0 {
                    kept.push(from);
                }
                if index < sides && depth(from) * depth(to) < 0.0 {
                    kept.push(from.lerp(to, depth(from) / (depth(from) - depth(to))));
                }
            }
            outline = kept;
        }
        outline
    }
}

fn bounds(points: impl Iterator<Item = DVec2>) -> (DVec2, DVec2) {
    points.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)))
}

fn circle(centre: DVec2, radius: f64) -> Vec<DVec2> {
    let angle = |step: usize| step as f64 / OUTLINE as f64 * std::f64::consts::TAU;
    (0..OUTLINE).map(|step| centre + radius * DVec2::new(libm::cos(angle(step)), libm::sin(angle(step)))).collect()
}

/// The convex outline of points, counter-clockwise, by walking them from left to right and back.
pub(super) fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let walk = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for point in points {
            while let [.., before, last] = chain[..] {
                if (last - before).perp_dot(point - last) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut outline = walk(&mut points.iter().copied());
    outline.extend(walk(&mut points.iter().rev().copied()));
    outline
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ground() -> Patch {
        let planar = Planar { normal: DVec3::Y, offset: 0.0, colour: [0.5; 3] };
        Patch::under(&planar, DVec3::X, &[(DVec3::ZERO, 3.0)])
    }

    #[test]
    fn a_patch_lies_in_its_plane_and_under_its_things() {
        let patch = ground();
        assert!(patch.corners().iter().all(|corner| corner.y.abs() < 1e-12 && corner.length() >= 3.0));
        assert_eq!(patch.step(), 1.0);
    }

    #[test]
    fn its_lines_end_at_its_edge() {
        let patch = ground();
        let extent = patch.corners().iter().map(|corner| corner.length()).fold(0.0, f64::max);
        assert!(patch.lines().len() >= 10);
        assert!(
            patch.lines().iter().flatten().all(|end| end.length() <= extent + 1e-9 && end.length() > 0.95 * extent)
        );
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
