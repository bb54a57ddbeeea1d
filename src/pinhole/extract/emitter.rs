use glam::DVec3;

/// Edges with a cosine of no more than this between them count as perpendicular.
const SQUARE: f64 = 1e-9;

/// The shape of an area light that can be sampled, in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Emitter {
    /// A sphere.
    Sphere {
        /// Relative to the eye.
        centre: DVec3,
        /// In scene units.
        radius: f64,
    },
    /// A rectangle, or the parallelogram that a non-uniform scale makes of it.
    Rectangle(Parallelogram),
    /// A disk, or the ellipse that a non-uniform scale makes of it, given by its bounding rectangle with sides along
    /// its axes.
    Disk(Parallelogram),
    /// A triangle.
    Triangle {
        /// Relative to the eye.
        corners: [DVec3; 3],
        /// The unit normal on its own side.
        normal: DVec3,
    },
    /// A cuboid.
    Cuboid(EmittingCuboid),
}

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
}

/// A cuboid as a light, sampled face by face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmittingCuboid {
    /// Relative to the eye.
    pub centre: DVec3,
    /// From the centre to the midpoints of three faces.
    pub half_edges: [DVec3; 3],
    /// The outward unit normals of these faces.
    pub normals: [DVec3; 3],
    /// Whether its edges are perpendicular.
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

    /// Whether a point is inside it.
    #[inline(always)]
    pub fn contains(&self, point: DVec3) -> bool {
        (0..3).all(|axis| {
            let normal = self.normals[axis];
            normal.dot(point - self.centre).abs() < normal.dot(self.half_edges[axis])
        })
    }
}

impl Emitter {
    /// The area that emits, on one side, in square scene units.
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

    /// Whether a point is on the side of the shape's own normal, which is the outside of a sphere or a cuboid.
    #[inline(always)]
    pub fn faces(&self, point: DVec3) -> bool {
        match self {
            Self::Sphere { centre, radius } => (point - *centre).length_squared() > radius * radius,
            Self::Rectangle(planar) | Self::Disk(planar) => planar.normal.dot(point - planar.centre) > 0.0,
            Self::Triangle { corners, normal } => normal.dot(point - corners[0]) > 0.0,
            Self::Cuboid(cuboid) => !cuboid.contains(point),
        }
    }
}

/// Whether two vectors are perpendicular.
fn across(a: DVec3, b: DVec3) -> bool {
    a.dot(b).abs() <= SQUARE * a.length() * b.length()
}
