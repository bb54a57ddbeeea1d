use pinhole::scene::FovAxis;

/// The function that a chapter asks of its reader, as the reader has it now; its parts are what the chapter's
/// `exercise.rs` says.
#[derive(Clone, Copy, Debug)]
pub enum Attempt {
    /// Chapter 01: the index of a pixel, the image's width.
    RasterFromIndex(fn(u64, u32) -> [f64; 2]),
    /// Chapter 02: a vector.
    Unit(fn([f64; 3]) -> Option<[f64; 3]>),
    /// Chapter 03: origin, direction, centre, radius.
    NearestSphereT(fn([f64; 3], [f64; 3], [f64; 3], f64) -> Option<f64>),
    /// Chapter 04: a screen point, the view's height.
    OrthographicRay(fn([f64; 2], f64) -> ([f64; 3], [f64; 3])),
    /// Chapter 05: a screen point, the tangent of half the vertical angle.
    PerspectiveDirection(fn([f64; 2], f64) -> [f64; 3]),
    /// Chapter 06: an NDC point, the image's width and height.
    PixelFromNdc(fn([f64; 2], u32, u32) -> Option<[u32; 2]>),
    /// Chapter 07: a screen point, the image's width and height.
    NdcFromScreen(fn([f64; 2], u32, u32) -> [f64; 2]),
    /// Chapter 08: an angle in degrees, across what it is measured, the image's width and height.
    VerticalFov(fn(f64, FovAxis, u32, u32) -> f64),
    /// Chapter 09: the columns of a map, a normal.
    NormalWorldFromObject(fn([[f64; 3]; 3], [f64; 3]) -> [f64; 3]),
    /// Chapter 10: colour, intensity, position, normal, light.
    ReflectedRadiance(fn(f64, f64, [f64; 3], [f64; 3], [f64; 3]) -> f64),
    /// Chapter 11: a direction, and whether their x points right, their y up, their z ahead.
    PinholeFromTheirs(fn([f64; 3], bool, bool, bool) -> [f64; 3]),
    /// Chapter 12: stages in order, the column asked for.
    Kept(fn(&[StageWords], &str) -> Vec<String>),
    /// Chapter 13: origin, direction, the box's corners of least and of most coordinates.
    NearestBoxT(fn([f64; 3], [f64; 3], [f64; 3], [f64; 3]) -> Option<f64>),
    /// Chapter 18: a pixel's values in runs of different seeds, the truth.
    VarianceAndBiasSquared(fn(&[f64], f64) -> Option<[f64; 2]>),
    /// Chapter 16: the middle of a range, its width.
    MeanOfStripes(fn(f64, f64) -> f64),
    /// Chapter 15: colour, specular and exponent; irradiance, normal, direction to the light, direction to the eye.
    PhongRadiance(fn([f64; 3], f64, [f64; 3], [f64; 3], [f64; 3]) -> f64),
    /// Chapter 14: the surface's normal, the corners' normals, their shares, the ways to the eye and to the light.
    FallingCosine(fn([f64; 3], [[f64; 3]; 3], [f64; 3], [f64; 3], [f64; 3]) -> f64),
    /// Chapter 17: a number from 0 to below 1, the tent's radius.
    TentOffset(fn(f64, f64) -> f64),
    /// Chapter 19: a direction, a normal.
    Mirrored(fn([f64; 3], [f64; 3]) -> [f64; 3]),
    /// Chapter 20: a direction, a normal, the far side's index over the near side's.
    Refracted(fn([f64; 3], [f64; 3], f64) -> Option<[f64; 3]>),
    /// Chapter 21: the lit point, a light's point, its normal, its area.
    SolidAnglePdf(fn([f64; 3], [f64; 3], [f64; 3], f64) -> f64),
    /// Chapter 23: a screen point, the tangent of half the vertical angle, a point of the lens, the focus distance.
    LensDirection(fn([f64; 2], f64, [f64; 2], f64) -> [f64; 3]),
    /// Chapter 24: origin, direction, centre, radius, velocity, time.
    MovingSphereT(fn([f64; 3], [f64; 3], [f64; 3], f64, [f64; 3], f64) -> Option<f64>),
    /// Chapter 22: two numbers from 0 to below 1.
    CosineDirection(fn(f64, f64) -> [f64; 3]),
    /// Chapter 25: the throughput of a path, a number from 0 to below 1.
    AfterRoulette(fn([f64; 3], f64) -> [f64; 3]),
    /// Chapter 26: two pdfs, that of the technique that was sampled first.
    PowerHeuristic(fn(f64, f64) -> f64),
    /// Chapter 27: a point in camera space, the tangent of half the vertical angle, the image's height in pixels.
    PixelFraction(fn([f64; 3], f64, f64) -> f64),
}

impl Attempt {
    /// The function's name.
    pub fn function(&self) -> &'static str {
        match self {
            Self::RasterFromIndex(_) => "raster_from_index",
            Self::Unit(_) => "unit",
            Self::NearestSphereT(_) => "nearest_sphere_t",
            Self::OrthographicRay(_) => "orthographic_ray",
            Self::PerspectiveDirection(_) => "perspective_direction",
            Self::PixelFromNdc(_) => "pixel_from_ndc",
            Self::NdcFromScreen(_) => "ndc_from_screen",
            Self::VerticalFov(_) => "vertical_fov",
            Self::NormalWorldFromObject(_) => "normal_world_from_object",
            Self::ReflectedRadiance(_) => "reflected_radiance",
            Self::PinholeFromTheirs(_) => "pinhole_from_theirs",
            Self::Kept(_) => "kept",
            Self::NearestBoxT(_) => "nearest_box_t",
            Self::VarianceAndBiasSquared(_) => "variance_and_bias_squared",
            Self::MeanOfStripes(_) => "mean_of_stripes",
            Self::PhongRadiance(_) => "phong_radiance",
            Self::FallingCosine(_) => "falling_cosine",
            Self::TentOffset(_) => "tent_offset",
            Self::Mirrored(_) => "mirrored",
            Self::Refracted(_) => "refracted",
            Self::SolidAnglePdf(_) => "solid_angle_pdf",
            Self::LensDirection(_) => "lens_direction",
            Self::MovingSphereT(_) => "moving_sphere_t",
            Self::CosineDirection(_) => "cosine_direction",
            Self::AfterRoulette(_) => "after_roulette",
            Self::PowerHeuristic(_) => "power_heuristic",
            Self::PixelFraction(_) => "pixel_fraction",
        }
    }
}

/// A stage on offer, in words alone: what chapter 12's exercise plans with.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StageWords {
    /// What it is called.
    pub name: String,
    /// Whether the scene holds what the stage is for.
    pub needed: bool,
    /// The columns it reads.
    pub reads: Vec<String>,
    /// The columns it writes.
    pub writes: Vec<String>,
}
