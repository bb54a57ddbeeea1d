//! Area lights: their points are distributed as their pdfs say, and light surfaces as closed forms say.

#[path = "emitters/closed_forms.rs"]
mod closed_forms;
#[path = "emitters/environment.rs"]
mod environment;
#[path = "emitters/pdfs.rs"]
mod pdfs;
#[path = "emitters/pictures.rs"]
mod pictures;
#[path = "emitters/shadow_rays.rs"]
mod shadow_rays;
#[path = "emitters/sides.rs"]
mod sides;

use glam::DVec3;
use pinhole::shapes::emitter::{EmittingCuboid, EmittingDisk, EmittingTriangle, LightPoint, Parallelogram};
use pinhole::shapes::{Emitter, pdf_towards, point_on};
use pinhole_lab::measure::draws::Draws;

/// The mean and the standard deviation of what a surface at a point receives of a light of radiance 1, told by one
/// direction at a time, and by how much at most the pdf given there differs from the one computed afterwards.
struct Received {
    mean: f64,
    deviation: f64,
    tried: u32,
    mismatch: f64,
}

impl Received {
    fn of(emitter: &Emitter, from: DVec3, normal: DVec3, tried: u32, seed: u64) -> Self {
        let again = |to: DVec3| pdf_towards(emitter, from, from + to);
        Self::by(&|u| point_on(emitter, from, u), &again, normal, tried, seed)
    }

    /// The same by points sampled so, and the pdf of the direction to one.
    fn by(
        choose: &dyn Fn([f64; 2]) -> LightPoint,
        pdf: &dyn Fn(DVec3) -> f64,
        normal: DVec3,
        tried: u32,
        seed: u64,
    ) -> Self {
        let (mut sum, mut squares, mut mismatch) = (0.0, 0.0, 0.0_f64);
        // Counted from the first, so that no digits of a small spread are lost.
        let mut first = None;
        for number in 0..tried {
            let mut draws = Draws::new(seed, u64::from(number));
            // 24 bits, as pinhole's own numbers have.
            let u = [draws.unit(), draws.unit()].map(|u| (u * 16_777_216.0).floor() / 16_777_216.0);
            let point = choose(u);
            let cosine = normal.dot(point.to / point.to.length()).max(0.0);
            assert!(point.pdf > 0.0 && cosine.is_finite(), "{number} at {u:?}: {point:?}");
            let told = cosine / point.pdf;
            let more = told - *first.get_or_insert(told);
            sum += more;
            squares += more * more;
            if point.pdf.is_finite() {
                mismatch = mismatch.max((pdf(point.to) / point.pdf - 1.0).abs());
            }
        }
        let more = sum / f64::from(tried);
        let deviation = (squares / f64::from(tried) - more * more).max(0.0).sqrt();
        Self { mean: first.unwrap_or(0.0) + more, deviation, tried, mismatch }
    }

    /// The standard error of the mean.
    fn error(&self) -> f64 {
        self.deviation / f64::from(self.tried).sqrt()
    }

    /// By how many standard errors the mean is off the truth; where there is hardly any spread, rounding counts as one.
    fn off(&self, truth: f64) -> f64 {
        (self.mean - truth) / self.error().max(1e-12 * truth.abs())
    }
}

/// A rectangle about a point with these half edges.
fn rectangle(centre: DVec3, half_edges: [DVec3; 2], side: DVec3) -> Emitter {
    Emitter::Rectangle(Parallelogram::new(centre, half_edges, side))
}

/// A disk, or an ellipse.
fn disk(centre: DVec3, half_edges: [DVec3; 2], side: DVec3) -> Emitter {
    Emitter::Disk(EmittingDisk(Parallelogram::about_ellipse(centre, half_edges, side)))
}

fn triangle(corners: [DVec3; 3]) -> Emitter {
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
    Emitter::Triangle(EmittingTriangle { corners, normal })
}

fn cuboid(centre: DVec3, half_edges: [DVec3; 3]) -> Emitter {
    Emitter::Cuboid(EmittingCuboid::new(centre, half_edges))
}

/// What a polygon of radiance 1 above the horizon sends to a surface: half the sum over its edges of the angle that each
/// fills times how far the edge's plane leans from the surface's (Lambert 1760).
fn polygon_irradiance(corners: &[DVec3], from: DVec3, normal: DVec3) -> f64 {
    let mut sum = 0.0;
    for (i, &corner) in corners.iter().enumerate() {
        let [a, b] = [corner, corners[(i + 1) % corners.len()]].map(|corner| (corner - from).normalize());
        // By the edge, so that a short one far away keeps its digits.
        let cross = (corner - from).cross(corners[(i + 1) % corners.len()] - corner).normalize_or_zero();
        let angle = 2.0 * libm::atan2((a - b).length(), (a + b).length());
        sum += angle * cross.dot(normal);
    }
    0.5 * sum.abs()
}

/// The corners of a rectangle or triangle.
fn corners_of(emitter: &Emitter) -> Vec<DVec3> {
    match emitter {
        Emitter::Rectangle(planar) => {
            let (centre, [x, y]) = (planar.centre, planar.half_edges);
            vec![centre - x - y, centre + x - y, centre + x + y, centre - x + y]
        }
        Emitter::Triangle(EmittingTriangle { corners, .. }) => corners.to_vec(),
        _ => Vec::new(),
    }
}
