use super::emitting::{ANY_WAY, AreaSample, Emitting, LightPoint, WayVisitor, angle_of, pdf_from_area};
use super::triangle::{MIN_SOLID_ANGLE, TriangleSeen, triangle_solid_angle};
use crate::each::Each;
use crate::sample::circle_point;
use crate::shapes::l1_norm;
use glam::DVec3;
use std::f64::consts::TAU;

/// From farther away than this many half diagonals, a parallelogram is sampled by area: its points then have nearly the
/// same distance and cosine, and the angles of [`RectangleSeen`] would cost more than they gain.
const FAR: f64 = 3.0;
/// A rectangle that subtends less than this many sr is sampled as its two triangles.
///
/// Its solid angle is the excess of four angles over 360°, and so is off by some 10⁻¹⁵ sr.
const MIN_OF_FOUR_ANGLES: f64 = 1e-4;

/// The ways to sample a parallelogram of which the position of the lit point says that they apply: over its area, by the four
/// angles of a rectangle.
const BY_AREA: usize = 0;
const BY_ANGLES: usize = 1;

/// Edges with a cosine of no more than this between them count as perpendicular.
const SQUARE: f64 = 1e-9;

/// A planar parallelogram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parallelogram {
    /// Its centre, relative to the eye.
    pub centre: DVec3,
    /// From its centre to the midpoints of two edges.
    pub half_edges: [DVec3; 2],
    /// The unit normal on its own side.
    pub normal: DVec3,
    /// Whether its edges are perpendicular.
    pub is_rectangle: bool,
}

impl Parallelogram {
    /// The parallelogram with these half edges; `side` is on the side of its normal.
    pub fn new(centre: DVec3, half_edges: [DVec3; 2], side: DVec3) -> Self {
        let cross = half_edges[0].cross(half_edges[1]).normalize();
        let normal = if cross.dot(side) < 0.0 { -cross } else { cross };
        Self { centre, half_edges, normal, is_rectangle: across(half_edges[0], half_edges[1]) }
    }

    /// The bounding rectangle, along the ellipse's axes, of the ellipse with points centre + a cos φ + b sin φ.
    pub fn about_ellipse(centre: DVec3, [a, b]: [DVec3; 2], side: DVec3) -> Self {
        let turn = 0.5 * libm::atan2(2.0 * a.dot(b), a.length_squared() - b.length_squared());
        // A circle has no distinguished axes, so it keeps the given ones.
        let turn = if across(a, b) { 0.0 } else { turn };
        let (sin, cos) = (libm::sin(turn), libm::cos(turn));
        Self::new(centre, [a * cos + b * sin, b * cos - a * sin], side)
    }

    /// Its area, in square scene units.
    #[inline(always)]
    pub fn area(&self) -> f64 {
        4.0 * self.half_edges[0].cross(self.half_edges[1]).length()
    }

    /// The point with these coordinates, which are −1 or 1 at its edges.
    #[inline(always)]
    pub(super) fn spot_at(&self, [x, y]: [f64; 2]) -> AreaSample {
        let position = self.centre + x * self.half_edges[0] + y * self.half_edges[1];
        let size = l1_norm(self.centre) + l1_norm(self.half_edges[0]) + l1_norm(self.half_edges[1]);
        AreaSample { position, normal: self.normal, area: self.area(), size }
    }
}

impl Emitting for Parallelogram {
    const IS_CLOSED: bool = false;
    const IN_BLOCKS: bool = true;
    const HAS_WAYS: bool = true;

    fn area(&self) -> f64 {
        self.area()
    }

    #[inline(always)]
    fn faces(&self, point: DVec3) -> bool {
        self.normal.dot(point - self.centre) > 0.0
    }

    fn plane_normal(&self) -> Option<DVec3> {
        Some(self.normal)
    }

    #[inline(always)]
    fn point(&self, from: DVec3, u: [f64; 2]) -> LightPoint {
        parallelogram_point(self, from, u)
    }

    #[inline(always)]
    fn way(&self, from: DVec3) -> usize {
        Seen::way(self, from)
    }

    #[inline(always)]
    fn point_in<const WAY: usize>(&self, from: DVec3, u: [f64; 2]) -> LightPoint {
        match WAY {
            BY_AREA => parallelogram_area_point(self, from, u),
            BY_ANGLES => RectangleSeen::new(self.centre, self.half_edges, from).point(u),
            _ => parallelogram_point(self, from, u),
        }
    }

    fn in_ways(&self, visitor: &mut impl WayVisitor) {
        visitor.visit::<Self, BY_AREA>(self);
        if self.is_rectangle {
            visitor.visit::<Self, BY_ANGLES>(self);
        }
        visitor.visit::<Self, ANY_WAY>(self);
    }

    #[inline(always)]
    fn pdf(&self, from: DVec3, at: DVec3) -> f64 {
        parallelogram_pdf(self, from, at - from)
    }

    #[inline(always)]
    fn distance(&self, from: DVec3, direction: DVec3) -> f64 {
        self.normal.dot(self.centre - from) / self.normal.dot(direction)
    }

    #[inline(always)]
    fn spot(&self, u: [f64; 2]) -> AreaSample {
        self.spot_at([2.0 * u[0] - 1.0, 2.0 * u[1] - 1.0])
    }
}

/// Whether two vectors are perpendicular.
pub(super) fn across(a: DVec3, b: DVec3) -> bool {
    a.dot(b).abs() <= SQUARE * a.length() * b.length()
}

/// A rectangle as seen from the lit point, in its own axes: from x₀ to x₁, from y₀ to y₁, at the depth z below 0.
#[derive(Clone, Copy, Debug)]
pub struct RectangleSeen {
    x: [f64; 2],
    y: [f64; 2],
    z: f64,
    axes: [DVec3; 3],
    /// Cosine and sine of a full turn minus the angles at the last two corners.
    first_angle: [f64; 2],
    /// The z components of the unit normals of the planes through the lit point and the edges y₀ and y₁.
    lean: [f64; 2],
    /// Its solid angle, in sr.
    pub solid_angle: f64,
}

impl RectangleSeen {
    // ANCHOR: rectangle_seen
    /// The rectangle with these perpendicular half edges, seen from a point.
    ///
    /// The unit normal of the plane through the lit point and an edge at y has the z component −y / √(y² + z²); two
    /// such planes intersect at an angle whose cosine is minus the product of these, and the four angles add up to 2π
    /// plus the solid angle.
    /// They are added as rotations, pairs of a cosine and a sine, so that only their sum needs an arc tangent.
    #[inline(always)]
    pub fn new(centre: DVec3, half_edges: [DVec3; 2], from: DVec3) -> Self {
        let [a, b] = half_edges.each(|half| half.length());
        let (right, up) = (half_edges[0] / a, half_edges[1] / b);
        let ahead = right.cross(up);
        let to = centre - from;
        let (x, y, height) = (right.dot(to), up.dot(to), ahead.dot(to));
        let axes = if height > 0.0 { [right, up, -ahead] } else { [right, up, ahead] };
        let (x, y, z) = ([x - a, x + a], [y - b, y + b], -height.abs());
        let lean = |at: f64| at / (at * at + z * z).sqrt();
        let steep = |at: f64| z * z / (at * at + z * z);
        // In the order of the edges y₀, x₁, y₁, x₀.
        let leans = [-lean(y[0]), lean(x[1]), lean(y[1]), -lean(x[0])];
        let steeps = [steep(y[0]), steep(x[1]), steep(y[1]), steep(x[0])];
        let corner = |i: usize, j: usize| {
            let sine_squared = steeps[i] + leans[i] * leans[i] * steeps[j];
            [-leans[i] * leans[j], sine_squared.sqrt()]
        };
        let [before, after] = [add_turns(corner(0, 1), corner(1, 2)), add_turns(corner(2, 3), corner(3, 0))];
        let [cosine, sine] = add_turns(before, after);
        let angle = angle_of(sine, cosine);
        // More than half a turn is possible only from nearby; otherwise a value below 0 is rounding.
        let near = z * z < a * a + b * b;
        let angle = if angle < 0.0 && near { angle + TAU } else { angle.max(0.0) };
        let solid_angle = if z < 0.0 { angle } else { 0.0 };
        Self { x, y, z, axes, first_angle: [after[0], -after[1]], lean: [leans[0], leans[2]], solid_angle }
    }
    // ANCHOR_END: rectangle_seen

    /// A point of the rectangle, uniform in solid angle.
    #[inline(always)]
    fn point(&self, u: [f64; 2]) -> LightPoint {
        LightPoint { to: self.at(u), pdf: 1.0 / self.solid_angle }
    }

    // ANCHOR: rectangle_at
    /// The offset to a point of the rectangle, uniform in solid angle (Ureña, Fajardo and King 2013).
    ///
    /// The first number selects x such that the part to its left subtends that fraction of the solid angle; the second
    /// selects y, where the sine of the elevation from the plane y = 0 is uniform.
    #[inline(always)]
    pub fn at(&self, u: [f64; 2]) -> DVec3 {
        let ([x0, x1], [y0, y1], z) = (self.x, self.y, self.z);
        let [cosine, sine] = circle_point(u[0] * self.solid_angle / TAU);
        let [cosine, sine] = add_turns([cosine, sine], self.first_angle);
        let f = (cosine * self.lean[0] - self.lean[1]) / sine;
        // f² + lean² − 1, with 1 − lean² computed as one term.
        let rest = f * f - z * z / (y0 * y0 + z * z);
        let x = -f.signum() * z / rest.max(0.0).sqrt();
        let x = if x.is_nan() { x0 + u[0] * (x1 - x0) } else { within(x, [x0, x1]) };
        self.along(x, [y0, y1], u[1])
    }
    // ANCHOR_END: rectangle_at

    /// The offset to the point at this x and at a y between two, uniform in the sine of its elevation.
    #[inline(always)]
    fn along(&self, x: f64, y: [f64; 2], u: f64) -> DVec3 {
        let [low, high] = self.sines(x, y);
        let sine = low + u * (high - low);
        let depth = (x * x + self.z * self.z).sqrt();
        let at = sine * depth / (1.0 - sine * sine).max(f64::MIN_POSITIVE).sqrt();
        let at = within(at, y);
        self.axes[0] * x + self.axes[1] * at + self.axes[2] * self.z
    }

    /// The sines of the elevations of two points at this x above the plane y = 0.
    #[inline(always)]
    fn sines(&self, x: f64, y: [f64; 2]) -> [f64; 2] {
        let depth_squared = x * x + self.z * self.z;
        y.each(|y| y / (y * y + depth_squared).sqrt())
    }

    /// Half the chord at x of the ellipse inscribed in this rectangle.
    #[inline(always)]
    fn half_chord(&self, x: f64) -> f64 {
        let [half_x, half_y] = [self.x, self.y].each(|ends| 0.5 * (ends[1] - ends[0]));
        let product = (x - self.x[0]) * (self.x[1] - x);
        half_y * (product.max(0.0)).sqrt() / half_x
    }

    /// Samples a point of the ellipse inscribed in this rectangle: x as for the rectangle, y within the ellipse.
    #[inline(always)]
    pub(super) fn in_ellipse(&self, u: [f64; 2]) -> LightPoint {
        let x = self.axes[0].dot(self.at(u));
        let (middle, half) = (0.5 * (self.y[0] + self.y[1]), self.half_chord(x));
        let to = self.along(x, [middle - half, middle + half], u[1]);
        LightPoint { to, pdf: self.ellipse_pdf(to) }
    }

    /// The pdf of a direction sampled by [`Self::in_ellipse`], in 1/sr; infinite at the two ends, where the chord is a
    /// point.
    #[inline(always)]
    pub(super) fn ellipse_pdf(&self, to: DVec3) -> f64 {
        let x = self.axes[0].dot(to) * (self.z / self.axes[2].dot(to));
        let (middle, half) = (0.5 * (self.y[0] + self.y[1]), self.half_chord(x));
        let [low, high] = self.sines(x, self.y);
        let [chord_low, chord_high] = self.sines(x, [middle - half, middle + half]);
        (high - low) / ((chord_high - chord_low) * self.solid_angle)
    }
}

/// A number, or the end of the interval that it is beyond; unlike `clamp`, without a check of the ends.
#[inline(always)]
fn within(x: f64, [low, high]: [f64; 2]) -> f64 {
    let at_least = if x < low { low } else { x };
    if at_least > high { high } else { at_least }
}

/// The sum of two rotations, each as its cosine and sine.
#[inline(always)]
fn add_turns(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// Samples a point on a parallelogram: uniform in solid angle, or over its area where it is far away.
#[inline(always)]
pub fn parallelogram_point(shape: &Parallelogram, from: DVec3, u: [f64; 2]) -> LightPoint {
    match Seen::of(shape, from) {
        Seen::Rectangle(seen) => seen.point(u),
        Seen::Triangles(solid_angles) => {
            let whole = solid_angles[0] + solid_angles[1];
            let at = u[0] * whole;
            let (which, before) = if at < solid_angles[0] { (0, 0.0) } else { (1, solid_angles[0]) };
            let first = ((at - before) / solid_angles[which]).clamp(0.0, 1.0);
            let corners = halves(shape)[which].each(|corner| corner - from);
            LightPoint { to: TriangleSeen::new(corners, solid_angles[which]).at([first, u[1]]), pdf: 1.0 / whole }
        }
        Seen::Small => parallelogram_area_point(shape, from, u),
    }
}

/// The pdf of a direction sampled by [`parallelogram_point`], in 1/sr; `to` is the offset to the light's point there.
#[inline(always)]
pub fn parallelogram_pdf(shape: &Parallelogram, from: DVec3, to: DVec3) -> f64 {
    match Seen::of(shape, from) {
        Seen::Rectangle(seen) => 1.0 / seen.solid_angle,
        Seen::Triangles(solid_angles) => 1.0 / (solid_angles[0] + solid_angles[1]),
        Seen::Small => parallelogram_area_pdf(shape, to),
    }
}

/// Samples a point on a parallelogram uniformly over its area.
#[inline(always)]
pub fn parallelogram_area_point(shape: &Parallelogram, from: DVec3, u: [f64; 2]) -> LightPoint {
    let [x, y] = shape.half_edges;
    let to = shape.centre - from + x * (2.0 * u[0] - 1.0) + y * (2.0 * u[1] - 1.0);
    LightPoint { to, pdf: parallelogram_area_pdf(shape, to) }
}

/// The pdf of [`parallelogram_area_point`], in 1/sr.
#[inline(always)]
pub fn parallelogram_area_pdf(shape: &Parallelogram, to: DVec3) -> f64 {
    pdf_from_area(to, shape.normal, shape.area())
}

/// The solid angle of a parallelogram, in sr; where it is small, that of its area seen at the distance of its centre.
#[inline(always)]
pub(super) fn parallelogram_solid_angle(shape: &Parallelogram, from: DVec3) -> f64 {
    match Seen::of(shape, from) {
        Seen::Rectangle(seen) => seen.solid_angle,
        Seen::Triangles(solid_angles) => solid_angles[0] + solid_angles[1],
        Seen::Small => {
            let to = shape.centre - from;
            shape.normal.dot(to).abs() * shape.area() / (to.length_squared() * to.length())
        }
    }
}

/// How a parallelogram is sampled from a point.
enum Seen {
    Rectangle(RectangleSeen),
    Triangles([f64; 2]),
    Small,
}

impl Seen {
    /// Which way is certain to be that of [`Self::of`], without computing a solid angle.
    ///
    /// That of a rectangle is at least its area, seen at the angle of its plane, at the distance of its farthest corner.
    #[inline(always)]
    fn way(shape: &Parallelogram, from: DVec3) -> usize {
        let half_diagonal_squared = half_diagonal_squared(shape);
        let farthest = (FAR + 1.0) * half_diagonal_squared.sqrt();
        let to = shape.centre - from;
        let seen = shape.area() * shape.normal.dot(to).abs();
        let is_large = seen >= 2.0 * MIN_OF_FOUR_ANGLES * farthest * farthest * farthest;
        let near = if shape.is_rectangle & is_large { BY_ANGLES } else { ANY_WAY };
        if to.length_squared() > FAR * FAR * half_diagonal_squared { BY_AREA } else { near }
    }

    #[inline(always)]
    fn of(shape: &Parallelogram, from: DVec3) -> Self {
        if (from - shape.centre).length_squared() > FAR * FAR * half_diagonal_squared(shape) {
            return Self::Small;
        }
        if shape.is_rectangle {
            let seen = RectangleSeen::new(shape.centre, shape.half_edges, from);
            if seen.solid_angle >= MIN_OF_FOUR_ANGLES {
                return Self::Rectangle(seen);
            }
        }
        let solid_angles = halves(shape).each(|half| triangle_solid_angle(&half.each(|corner| corner - from)));
        let enough = solid_angles[0] + solid_angles[1] >= MIN_SOLID_ANGLE;
        if enough { Self::Triangles(solid_angles) } else { Self::Small }
    }
}

/// The square of half the longer diagonal.
#[inline(always)]
fn half_diagonal_squared(shape: &Parallelogram) -> f64 {
    let [x, y] = shape.half_edges;
    x.length_squared() + y.length_squared() + 2.0 * x.dot(y).abs()
}

/// The two triangles of a parallelogram.
#[inline(always)]
fn halves(shape: &Parallelogram) -> [[DVec3; 3]; 2] {
    let (centre, [x, y]) = (shape.centre, shape.half_edges);
    let [a, b, c, d] = [centre - x - y, centre + x - y, centre + x + y, centre - x + y];
    [[a, b, c], [a, c, d]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::draws::Draws;

    /// Keeps the point of the way that applies.
    struct PointIn {
        from: DVec3,
        u: [f64; 2],
        points: Vec<LightPoint>,
    }

    impl WayVisitor for PointIn {
        fn visit<E: Emitting, const WAY: usize>(&mut self, emitter: &E) {
            if emitter.way(self.from) == WAY {
                self.points.push(emitter.point_in::<WAY>(self.from, self.u));
            }
        }
    }

    /// From anywhere, one way applies, and gives to the last bit what finding out gives.
    #[test]
    fn ways_give_the_points_that_finding_out_gives() {
        let mut tried = [0; 3];
        for number in 0..40_000 {
            let mut draws = Draws::new(4101, number);
            let across = draws.unit_vector();
            let other = if number % 3 == 0 { draws.unit_vector() } else { draws.unit_vector_across(across) };
            let [first, second] = [draws.power_of_ten(-3.0, 3.0), draws.power_of_ten(-3.0, 3.0)];
            let shape = Parallelogram::new(draws.unit_vector(), [across * first, other * second], draws.unit_vector());
            let away = shape.half_edges[0].length() * draws.power_of_ten(-4.0, 2.0);
            let from = match number % 4 {
                0 => shape.centre + shape.half_edges[0] * draws.between(-3.0, 3.0),
                _ => shape.centre + draws.unit_vector() * away,
            };
            let u = [draws.unit(), draws.unit()];
            let mut points = PointIn { from, u, points: Vec::new() };
            shape.in_ways(&mut points);
            let bits = |point: &LightPoint| [point.to.x, point.to.y, point.to.z, point.pdf].map(f64::to_bits);
            let own: Vec<_> = points.points.iter().map(bits).collect();
            assert_eq!(own, [bits(&shape.point(from, u))], "{number}: {shape:?} from {from}");
            tried[shape.way(from)] += 1;
        }
        eprintln!("parallelograms: {tried:?} points by area, by angles and by finding out");
        assert!(tried.iter().all(|tried| *tried > 1000), "{tried:?}");
    }
}
