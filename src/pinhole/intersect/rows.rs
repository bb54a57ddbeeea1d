use crate::plan::column;

column! {
    /// The rows that hit a sphere, ascending.
    pub struct SphereRows("sphere rows", "rows of the tile", "rows", Ray) {
        /// A row of the hits.
        row: u32,
    }
}

column! {
    /// The rows that hit an ellipsoid, ascending.
    pub struct EllipsoidRows("ellipsoid rows", "rows of the tile", "rows", Ray) {
        /// A row of the hits.
        row: u32,
    }
}

column! {
    /// The rows that hit a plane, ascending.
    pub struct PlaneRows("plane rows", "rows of the tile", "rows", Ray) {
        /// A row of the hits.
        row: u32,
    }
}

column! {
    /// The rows that hit a disk, ascending.
    pub struct DiskRows("disk rows", "rows of the tile", "rows", Ray) {
        /// A row of the hits.
        row: u32,
    }
}

column! {
    /// The rows that hit a rectangle, ascending.
    pub struct RectangleRows("rectangle rows", "rows of the tile", "rows", Ray) {
        /// A row of the hits.
        row: u32,
    }
}

column! {
    /// The rows that hit a cuboid, ascending.
    pub struct CuboidRows("cuboid rows", "rows of the tile", "rows", Ray) {
        /// A row of the hits.
        row: u32,
    }
}

column! {
    /// The rows that hit a triangle, ascending.
    pub struct TriangleRows("triangle rows", "rows of the tile", "rows", Ray) {
        /// A row of the hits.
        row: u32,
    }
}

column! {
    /// The rows whose surface has a non-specular material, which is every material but mirrors and glass; ascending.
    pub struct MaterialRows("material rows", "rows of the tile", "rows", Ray) {
        /// A row of the surfaces.
        row: u32,
    }
}

column! {
    /// The rows whose surface emits light, ascending.
    pub struct EmissiveRows("emissive rows", "rows of the tile", "rows", Ray) {
        /// A row of the hits.
        row: u32,
        /// A row of the table of emissive surfaces.
        emissive: u32,
    }
}

impl SphereRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}

impl EllipsoidRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}

impl PlaneRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}

impl EmissiveRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}

impl DiskRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}

impl RectangleRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}

impl CuboidRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}

impl TriangleRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}

impl MaterialRows {
    fn paint_row(&self, _row: usize, _size: [u32; 2]) -> [f32; 3] {
        [1.0; 3]
    }
}
