use glam::{DVec3, Vec3};

/// A ray sampled on a light, and its power.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LightStart {
    /// The origin, relative to the eye, moved off a light with an area by its error bound.
    pub origin: Vec3,
    /// A unit vector.
    pub direction: DVec3,
    /// Power over the pdf of this ray, linear Rec. 709; a ray of power 0 is left out.
    pub power: [f64; 3],
}

/// The random numbers that start a light path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartDraws {
    /// Selects the light.
    pub light: u32,
    /// Selects the point on it, or the place of a parallel ray across a target.
    pub point: [f64; 2],
    /// Selects the direction.
    pub direction: [f64; 2],
    /// Selects one of the specular targets.
    pub target: f64,
    /// Selects the side of an area light.
    pub side: f64,
}
