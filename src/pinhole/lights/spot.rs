use super::light::{Light, LightSample, LightStart, PlacedLight, SceneLight, StartDraws, luminance};
use super::light_bounds::LightBounds;
use super::targets::{Targets, direction_to_targets};
use crate::each::Each;
use crate::scene::{Degrees, SceneError, SpotLight, finite_point, light_colour, number};
use crate::shapes::emitter::cone_direction;
use glam::DVec3;
use std::f64::consts::PI;

/// A spot light in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedSpotLight {
    /// Its position, relative to the eye.
    pub position: DVec3,
    /// The direction of its axis: a unit vector.
    pub axis: DVec3,
    /// Radiant intensity along the axis, linear Rec. 709.
    pub intensity: [f64; 3],
    /// 1 − cos of the half angle of the inner cone.
    pub inner: f64,
    /// 1 − cos of the half angle of the outer cone.
    pub outer: f64,
}

impl SceneLight for SpotLight {
    const WORD: &'static str = "spot light";

    fn casts_shadows(&self) -> bool {
        self.casts_shadows
    }
}

impl Light for PlacedSpotLight {
    type Component = SpotLight;

    const IS_DISTANT: bool = false;

    fn place(light: &SpotLight, placed: &PlacedLight<'_>) -> Result<Self, SceneError> {
        let [inner, outer] = cone(placed.who, light)?;
        let position = finite_point(placed.who, "position", placed.position)?;
        let axis = (placed.ahead)()?;
        let intensity = light_colour(placed.who, "intensity", light.intensity)?.to_array();
        Ok(Self { position, axis, intensity, inner, outer })
    }

    #[inline(always)]
    fn sample(&self, from: DVec3) -> LightSample {
        let to_light = self.position - from;
        let distance = to_light.length();
        // A direction in f32 is too coarse for narrow cones.
        let along = (from - self.position) * (1.0 / distance);
        let falloff = spot_falloff(versine(along, self.axis), self.inner, self.outer);
        let strength = self.intensity.each(|part| part * falloff);
        LightSample { direction: (to_light * (1.0 / distance)).as_vec3(), distance, strength }
    }

    fn power(&self, _across: f64) -> [f64; 3] {
        self.intensity.each(|part| part * PI * (self.inner + self.outer))
    }

    fn bounds(&self) -> Option<LightBounds> {
        Some(LightBounds::cone(self.position, self.axis, self.outer, luminance(self.intensity)))
    }

    #[inline(always)]
    fn start(&self, targets: &Targets, draws: &StartDraws) -> LightStart {
        let whole = 2.0 * PI * self.outer;
        let to_targets = direction_to_targets(&targets.sphere, self.position, whole, draws.target, draws.direction);
        let in_cone = || (cone_direction(self.axis, self.outer, draws.direction), whole);
        let (direction, weight) = to_targets.unwrap_or_else(in_cone);
        let weight = spot_falloff(versine(direction, self.axis), self.inner, self.outer) * weight;
        LightStart { origin: self.position.as_vec3(), direction, power: self.intensity.each(|part| part * weight) }
    }
}

/// 1 − cos of the half angles of the inner and the outer cone.
fn cone(who: &str, light: &SpotLight) -> Result<[f64; 2], SceneError> {
    let (Degrees(inner), Degrees(outer)) = (light.inner_angle, light.outer_angle);
    if !(outer > 0.0 && outer <= 180.0) {
        let value = format!("{}°", number(outer));
        return Err(SceneError::new(who, "outer_angle", value, "it must be an angle above 0° and up to 180°"));
    }
    if !(inner >= 0.0 && inner <= outer) {
        let accepted = format!("it must be an angle from 0° to the outer angle, {}°", number(outer));
        return Err(SceneError::new(who, "inner_angle", format!("{}°", number(inner)), accepted));
    }
    Ok([versine_of_half(light.inner_angle), versine_of_half(light.outer_angle)])
}

/// 1 − cos of half an angle, as 2 sin² of its quarter, which keeps the digits of a small angle.
pub fn versine_of_half(angle: Degrees) -> f64 {
    let sine = libm::sin(angle.radians() / 4.0);
    2.0 * sine * sine
}

// ANCHOR: versine
/// 1 − cos of the angle between two unit vectors: half the squared distance between their tips.
///
/// In a narrow cone the cosine itself would lose the angle, since it is 1 but for its last digits.
#[inline(always)]
pub fn versine(a: DVec3, b: DVec3) -> f64 {
    0.5 * (a - b).length_squared()
}
// ANCHOR_END: versine

// ANCHOR: spot_falloff
/// The falloff of a spot light's intensity where 1 − cos θ is `versine`: 1 in the inner cone, 0 outside the outer one,
/// and 3s² − 2s³ in between, with s running from 0 at the outer edge to 1 at the inner.
///
/// It interpolates in 1 − cos θ, which is proportional to solid angle, so the light's power is πI(inner + outer).
#[inline(always)]
pub fn spot_falloff(versine: f64, inner: f64, outer: f64) -> f64 {
    let s = (outer - versine) / (outer - inner);
    if s >= 1.0 {
        1.0
    } else if s > 0.0 {
        s * s * (3.0 - 2.0 * s)
    } else {
        0.0
    }
}
// ANCHOR_END: spot_falloff

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lights::irradiance_from_point;
    use crate::measure::hemisphere::Quadrature;
    use crate::scene::Degrees;
    use std::f64::consts::{PI, TAU};

    /// The power received by a sphere around a spot light, by quadrature, is the light's power at any radius.
    #[test]
    fn a_sphere_around_a_spot_receives_its_whole_power() {
        let quadrature = Quadrature::default();
        let mut tried = 0;
        for (inner, outer) in [(0.0, 1e-4), (1e-4, 1e-4), (20.0, 35.0), (0.0, 180.0), (179.0, 179.99), (180.0, 180.0)] {
            let [inner, outer] = [inner, outer].map(|angle| versine_of_half(Degrees(angle)));
            for radius in [1e-8, 0.3, 1e8] {
                // Rings of equal area: dA = 2π r² dv, v = 1 − cos θ.
                let received = |v: f64| {
                    let intensity = [spot_falloff(v, inner, outer), 0.0, 0.0];
                    irradiance_from_point(intensity, 1.0, radius * radius)[0] * TAU * radius * radius
                };
                let sum = quadrature.sum_of_panels(&[0.0, inner, outer, 2.0], received);
                let power = PI * (inner + outer);
                assert!((sum / power - 1.0).abs() < 1e-12, "{inner} {outer} {radius}: {sum} for {power}");
                tried += 1;
            }
        }
        eprintln!("spots: {tried} spheres receive a spot light's whole power");
    }

    #[test]
    fn edges_are_where_the_angles_say() {
        for outer in [1e-4, 1.0, 90.0, 179.99] {
            let edges = [outer * 0.5, outer].map(|angle| versine_of_half(Degrees(angle)));
            let at = |fraction: f64| {
                let angle = Degrees(outer * fraction).radians() / 2.0;
                let direction = DVec3::new(libm::sin(angle), 0.0, libm::cos(angle));
                spot_falloff(versine(direction, DVec3::Z), edges[0], edges[1])
            };
            assert_eq!([at(0.0), at(0.49), at(1.000_001)], [1.0, 1.0, 0.0], "outer {outer}");
            let fading = [0.51, 0.6, 0.75, 0.9, 0.99].map(at);
            assert!(fading.windows(2).all(|pair| pair[0] > pair[1] && pair[1] > 0.0 && pair[0] < 1.0), "{fading:?}");
        }
        assert_eq!([0.1, 0.5, 0.6].map(|v| spot_falloff(v, 0.5, 0.5)), [1.0, 0.0, 0.0], "a sharp edge");
    }
}
