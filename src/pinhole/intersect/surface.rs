use crate::plan::column;
use crate::rays::WorldRays;
use glam::{DVec3, Vec3};

column! {
    /// What is known of the surface that each ray hit; all 0 where nothing is met.
    pub struct Surfaces("surface", "world, from the eye", "scene units", Ray, begun in Classify) {
        /// Position, x.
        px: f32,
        /// Position, y.
        py: f32,
        /// Position, z.
        pz: f32,
        /// Normal on the side the ray came from, x; the three are a unit vector.
        nx: f32,
        /// Normal, y.
        ny: f32,
        /// Normal, z.
        nz: f32,
        /// How far along the normal a new ray must start to be off the surface for certain.
        bound: f32,
        /// The row of the material table.
        material: u32,
    }
}

column! {
    /// Where on its shape each ray hit, in the shape's own two coordinates; exists where something reads it.
    pub struct SurfaceUvs("uv", "on the shape", "of the shape's own", Ray) {
        /// The first coordinate.
        u: f64,
        /// The second.
        v: f64,
    }
}

impl SurfaceUvs {
    /// Writes a row.
    #[inline(always)]
    pub fn set(&mut self, row: usize, uv: [f64; 2]) {
        [self.u[row], self.v[row]] = uv;
    }

    /// Each coordinate's part after the point.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.u[row], self.v[row], 0.0].map(|part| (part - part.floor()) as f32)
    }
}

column! {
    /// From which side each ray met its shape; exists where something reads it.
    ///
    /// A shape's own outward side is: for a sphere (also an unevenly scaled one) and a cuboid the outside; for a plane the
    /// side of its `normal`; for a disk and a rectangle the side of the entity's +y; for a triangle the side of its
    /// corners' normals, or else the one from which its corners go round anticlockwise.
    /// It stays that side where a placement mirrors; mirrored corners of a triangle without normals go round the other
    /// way.
    /// It says which way the normal in [`Surfaces`], which is always on the ray's side, was turned.
    pub struct SurfaceSides("side", "on the shape", "1 or 0", Ray) {
        /// 1 where the ray came from the shape's own outward side, so a ray that goes on enters; 0 where it came from
        /// inside or behind, and where nothing is met.
        outside: u32,
    }
}

impl SurfaceSides {
    /// White where met from outside, black from inside or behind and where nothing is met.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        [self.outside[row] as f32; 3]
    }
}

/// One row of [`Surfaces`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Surface {
    /// Where, in render space.
    pub position: Vec3,
    /// The unit normal on the side that the ray came from.
    pub normal: Vec3,
    /// The hit's error bound along the normal.
    pub bound: f32,
    /// The row of the material table.
    pub material: u32,
}

impl Surface {
    // ANCHOR: facing
    /// The surface at an f64 point, its normal turned to the side that a ray of this direction came from.
    #[inline(always)]
    pub fn facing(direction: DVec3, point: DVec3, normal: DVec3, bound: f32, material: u32) -> Self {
        let normal = if normal.dot(direction) > 0.0 { -normal } else { normal };
        Self { position: point.as_vec3(), normal: normal.as_vec3(), bound, material }
    }
    // ANCHOR_END: facing
}

/// |x| + |y| + |z|.
#[inline(always)]
pub fn sum_of_parts(v: DVec3) -> f64 {
    v.x.abs() + v.y.abs() + v.z.abs()
}

// ANCHOR: offset_bound
/// How far along its normal a hit must be moved for the next ray to start off the surface for certain.
///
/// With u = 2⁻²⁴: rounding a point p to f32 moves it by at most u(|x| + |y| + |z|), and rounding the moved point by as
/// much again; twice that sum is the first part.
/// The second is what f64 lost on the way to p, from numbers as large as the ray's origin and the shape's own
/// (a sphere's centre and radius, a plane's offset); the third is the floor of f32.
/// The bound grows and shrinks with the scene: it has no length in it.
#[inline(always)]
pub fn offset_bound(point: DVec3, origin: DVec3, shape_size: f64) -> f32 {
    const ROUNDING: f64 = 4.0 / (1_u64 << 24) as f64;
    const COMPUTING: f64 = 1.0 / (1_u64 << 48) as f64;
    const FLOOR: f64 = f32::from_bits(8) as f64;
    (ROUNDING * sum_of_parts(point) + COMPUTING * (sum_of_parts(origin) + shape_size) + FLOOR) as f32
}

/// Where a new ray from a surface starts: its position, moved along the normal by its bound.
#[inline(always)]
pub fn offset_origin(position: Vec3, normal: Vec3, bound: f32) -> Vec3 {
    position + normal * bound
}
// ANCHOR_END: offset_bound

impl Surfaces {
    /// The normal: each part from −1 to 1 becomes 0 to 1; black where nothing is met.
    fn paint_row(&self, row: usize, _size: [u32; 2]) -> [f32; 3] {
        let normal = [self.nx[row], self.ny[row], self.nz[row]];
        if normal == [0.0; 3] { normal } else { normal.map(|part| 0.5 + 0.5 * part) }
    }

    /// Writes a row.
    #[inline(always)]
    pub fn set(&mut self, row: usize, surface: Surface) {
        (self.px[row], self.py[row], self.pz[row]) = surface.position.into();
        (self.nx[row], self.ny[row], self.nz[row]) = surface.normal.into();
        self.bound[row] = surface.bound;
        self.material[row] = surface.material;
    }

    /// Reads a row.
    #[inline(always)]
    pub fn get(&self, row: usize) -> Surface {
        Surface {
            position: Vec3::new(self.px[row], self.py[row], self.pz[row]),
            normal: Vec3::new(self.nx[row], self.ny[row], self.nz[row]),
            bound: self.bound[row],
            material: self.material[row],
        }
    }
}

impl WorldRays {
    /// The direction of a row, exact in f64.
    #[inline(always)]
    pub fn direction_of(&self, row: usize) -> DVec3 {
        DVec3::new(f64::from(self.dx[row]), f64::from(self.dy[row]), f64::from(self.dz[row]))
    }

    /// The origin of a row, exact in f64.
    #[inline(always)]
    pub fn origin_of(&self, row: usize) -> DVec3 {
        DVec3::new(f64::from(self.ox[row]), f64::from(self.oy[row]), f64::from(self.oz[row]))
    }

    // ANCHOR: point_at
    /// r(t) = O + tR of a row, in f64.
    #[inline(always)]
    pub fn point_at(&self, row: usize, t: f64) -> DVec3 {
        self.origin_of(row) + t * self.direction_of(row)
    }
    // ANCHOR_END: point_at
}
