use crate::each::Each;
use crate::shapes::Bounds;
use glam::DVec3;

/// What is known of the light that one or several lights emit: from where, in which directions and how much.
///
/// After PBRT's `LightBounds` (Pharr, Jakob, Humphreys 2023, section 12.6.3), with cosines for its angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightBounds {
    /// Around all of them, relative to the eye.
    pub around: Bounds,
    /// The axis of a cone that contains the normals of all, a unit vector.
    pub axis: DVec3,
    /// The cosine of the cone's half angle; −1 where normals point everywhere.
    pub spread: f64,
    /// The cosine of the greatest angle from a normal at which there is light.
    pub edge: f64,
    /// The luminous intensity along the normals, summed.
    pub strength: f64,
    /// Whether all of them emit alike on the other side.
    pub two_sided: bool,
}

/// The box that contains nothing.
const NOWHERE: Bounds = Bounds { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

/// The box around two.
fn joined(one: Bounds, other: Bounds) -> Bounds {
    Bounds { min: one.min.min(other.min), max: one.max.max(other.max) }
}

impl LightBounds {
    /// A light that shines in all directions from somewhere in a box.
    pub fn everywhere(around: Bounds, strength: f64) -> Self {
        Self { around, axis: DVec3::Z, spread: -1.0, edge: 0.0, strength, two_sided: false }
    }

    /// A light that shines evenly within a cone, 1 − cos of whose half angle is `versine`, from a point.
    pub fn cone(at: DVec3, axis: DVec3, versine: f64, strength: f64) -> Self {
        let around = Bounds { min: at, max: at };
        Self { around, axis, spread: 1.0 - versine, edge: 1.0, strength, two_sided: false }
    }

    /// A planar light, whose radiance is the same in all directions.
    pub fn planar(around: Bounds, normal: DVec3, strength: f64, two_sided: bool) -> Self {
        Self { around, axis: normal, spread: 1.0, edge: 0.0, strength, two_sided }
    }

    /// Bounds of all of these.
    ///
    /// The axis is along the sum of theirs; those that emit on both sides are turned to the side of the first.
    pub fn of_all(all: &[Self]) -> Self {
        let mut around = NOWHERE;
        let (mut sum, mut strength, mut edge) = (DVec3::ZERO, 0.0, 1.0_f64);
        let (first, two_sided) = (all.first().map_or(DVec3::Z, |own| own.axis), all.iter().all(|own| own.two_sided));
        for own in all {
            around = joined(around, own.around);
            sum += if two_sided && own.axis.dot(first) < 0.0 { -own.axis } else { own.axis };
            strength += own.strength;
            edge = edge.min(own.edge);
        }
        let length = sum.length();
        let everywhere = Self { around, axis: DVec3::Z, spread: -1.0, edge, strength, two_sided: false };
        let is_mixed = !two_sided && all.iter().any(|own| own.two_sided);
        if is_mixed || !(length > 0.0 && length.is_finite()) {
            return everywhere;
        }
        let axis = sum / length;
        let spread = all.iter().map(|own| own.cosine_from(axis, two_sided)).fold(1.0, f64::min);
        if spread == -1.0 { everywhere } else { Self { axis, spread, two_sided, ..everywhere } }
    }

    /// The cosine of the angle from an axis to the farthest normal; −1 for half a turn.
    fn cosine_from(&self, axis: DVec3, two_sided: bool) -> f64 {
        if self.spread <= -1.0 {
            return -1.0;
        }
        let between = axis.dot(self.axis);
        let between = if two_sided { between.abs() } else { between }.clamp(-1.0, 1.0);
        let [sine, other] = [between, self.spread].each(|cosine| (1.0 - cosine * cosine).max(0.0).sqrt());
        // The sine of a sum of two angles is negative where it exceeds half a turn.
        if sine * self.spread + between * other < 0.0 { -1.0 } else { between * self.spread - sine * other }
    }
}

/// The sums over some lights from which the quality of a division is estimated, faster than bounds of them are found.
#[derive(Clone, Copy, Debug)]
pub(super) struct LightSums {
    around: Bounds,
    axis: DVec3,
    strength: f64,
    count: f64,
}

impl LightSums {
    /// Of no light.
    pub const NONE: Self = Self { around: NOWHERE, axis: DVec3::ZERO, strength: 0.0, count: 0.0 };

    /// Adds a light.
    pub fn add(&mut self, light: &LightBounds) {
        // Light towards everywhere leaves no axis, and where both sides emit, either will do.
        let turned = light.two_sided && light.axis.dot(DVec3::new(0.48, 0.6, 0.64)) < 0.0;
        let axis = if turned { -light.axis } else { light.axis };
        let sums = Self { around: light.around, axis: axis * light.spread, strength: light.strength, count: 1.0 };
        self.join(&Self { axis: if light.spread > 0.0 { sums.axis } else { DVec3::ZERO }, ..sums });
    }

    /// Adds the lights of other sums.
    #[inline]
    pub fn join(&mut self, other: &Self) {
        self.around = joined(self.around, other.around);
        self.axis += other.axis;
        self.strength += other.strength;
        self.count += other.count;
    }

    /// Whether it is of no light.
    pub fn is_empty(&self) -> bool {
        self.count == 0.0
    }

    /// The extent along each axis.
    pub fn extent(&self) -> DVec3 {
        self.around.max - self.around.min
    }

    /// The surface area orientation heuristic (Conty Estévez and Kulla 2018): strength, times the area around the lights,
    /// times the solid angle that they shine into.
    ///
    /// The area is that of the sphere by which importance is bounded.
    /// Normals spread evenly over a cap of half angle θ have a mean of length (1 + cos θ) / 2, by which θ is estimated.
    pub fn cost(&self) -> f64 {
        if self.is_empty() {
            return 0.0;
        }
        let cosine = (2.0 * self.axis.length() / self.count - 1.0).clamp(-1.0, 1.0);
        self.strength * self.extent().length_squared() * solid_angle(cosine)
    }
}

/// The solid angle into which surfaces shine whose normals fill a cone of this cosine, weighted by the cosine beyond
/// its edge: from π for a plane to 4π.
fn solid_angle(cosine: f64) -> f64 {
    use std::f64::consts::PI;
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let half_turn = 2.0 * PI + 0.5 * PI * PI;
    if cosine > 0.0 {
        2.0 * PI - PI * cosine + 0.5 * PI * PI * sine
    } else {
        half_turn + cosine * (half_turn - 4.0 * PI)
    }
}
