use glam::DVec3;

/// Edges whose cosine is no more than this count as across each other.
const SQUARE: f64 = 1e-9;

/// A shape that emits light and whose points can be aimed at, in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Emitter {
    /// A sphere.
    Sphere {
        /// From the eye.
        centre: DVec3,
        /// Scene units.
        radius: f64,
    },
    /// A rectangle, or the parallelogram that uneven scales make of it.
    Rectangle(Parallelogram),
    /// A disk, or the ellipse that uneven scales make of it, given by a box about it with sides along its axes.
    Disk(Parallelogram),
    /// A triangle.
    Triangle {
        /// From the eye.
        corners: [DVec3; 3],
        /// The unit normal on its own side.
        normal: DVec3,
    },
    /// A cuboid.
    Cuboid(EmittingCuboid),
}

/// A flat piece with four corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parallelogram {
    /// Its middle, from the eye.
    pub centre: DVec3,
    /// From its middle to the middles of two edges.
    pub half_edges: [DVec3; 2],
    /// The unit normal on its own side.
    pub normal: DVec3,
    /// Whether its edges are across each other.
    pub is_rectangle: bool,
}

impl Parallelogram {
    /// The piece with these half edges; `side` is on its own side.
    pub fn new(centre: DVec3, half_edges: [DVec3; 2], side: DVec3) -> Self {
        let cross = half_edges[0].cross(half_edges[1]).normalize();
        let normal = if cross.dot(side) < 0.0 { -cross } else { cross };
        Self { centre, half_edges, normal, is_rectangle: across(half_edges[0], half_edges[1]) }
    }

    /// The box about the ellipse whose points are the centre and cos, sin of the two half edges, along the ellipse's axes.
    pub fn about_ellipse(centre: DVec3, [a, b]: [DVec3; 2], side: DVec3) -> Self {
        let turn = 0.5 * libm::atan2(2.0 * a.dot(b), a.length_squared() - b.length_squared());
        // A circle has no axes of its own; it keeps the ones it has.
        let turn = if across(a, b) { 0.0 } else { turn };
        let (sin, cos) = (libm::sin(turn), libm::cos(turn));
        Self::new(centre, [a * cos + b * sin, b * cos - a * sin], side)
    }

    /// Its area, in square scene units.
    #[inline(always)]
    pub fn area(&self) -> f64 {
        4.0 * self.half_edges[0].cross(self.half_edges[1]).length()
    }
}

/// A cuboid, as its faces are aimed at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmittingCuboid {
    /// From the eye.
    pub centre: DVec3,
    /// From the centre to the middles of three faces.
    pub half_edges: [DVec3; 3],
    /// The outward unit normals there.
    pub normals: [DVec3; 3],
    /// Whether its edges are across each other.
    pub is_square: bool,
}

impl EmittingCuboid {
    /// The cuboid with these half edges.
    pub fn new(centre: DVec3, half_edges: [DVec3; 3]) -> Self {
        let normals = [0, 1, 2].map(|axis| {
            let normal = half_edges[(axis + 1) % 3].cross(half_edges[(axis + 2) % 3]).normalize();
            if normal.dot(half_edges[axis]) < 0.0 { -normal } else { normal }
        });
        let is_square = (0..3).all(|axis| across(half_edges[axis], half_edges[(axis + 1) % 3]));
        Self { centre, half_edges, normals, is_square }
    }

    /// Whether a point lies inside it.
    #[inline(always)]
    pub fn holds(&self, point: DVec3) -> bool {
        (0..3).all(|axis| {
            let normal = self.normals[axis];
            normal.dot(point - self.centre).abs() < normal.dot(self.half_edges[axis])
        })
    }
}

impl Emitter {
    /// How much surface emits, one side of it, in square scene units.
    pub fn area(&self) -> f64 {
        match self {
            Self::Sphere { radius, .. } => 4.0 * std::f64::consts::PI * radius * radius,
            Self::Rectangle(planar) => planar.area(),
            Self::Disk(planar) => std::f64::consts::FRAC_PI_4 * planar.area(),
            Self::Triangle { corners: [a, b, c], .. } => 0.5 * (*b - *a).cross(*c - *a).length(),
            Self::Cuboid(cuboid) => {
                let face = |axis: usize| {
                    let [a, b] = [cuboid.half_edges[(axis + 1) % 3], cuboid.half_edges[(axis + 2) % 3]];
                    8.0 * a.cross(b).length()
                };
                face(0) + face(1) + face(2)
            }
        }
    }

    /// Whether a point lies on the side of the shape's own normal, which of a sphere and a cuboid is the outside.
    #[inline(always)]
    pub fn faces(&self, point: DVec3) -> bool {
        match self {
            Self::Sphere { centre, radius } => (point - *centre).length_squared() > radius * radius,
            Self::Rectangle(planar) | Self::Disk(planar) => planar.normal.dot(point - planar.centre) > 0.0,
            Self::Triangle { corners, normal } => normal.dot(point - corners[0]) > 0.0,
            Self::Cuboid(cuboid) => !cuboid.holds(point),
        }
    }
}

/// Whether two vectors are across each other.
fn across(a: DVec3, b: DVec3) -> bool {
    a.dot(b).abs() <= SQUARE * a.length() * b.length()
}
