//! A paraboloid: y = h (x² + z²) / r² up to its rim.

use pinhole::extend::*;
use pinhole::prelude::*;
use std::f64::consts::TAU;

/// A bowl that stands on its lowest point, at the origin of its entity.
#[derive(Component, Clone, Debug, PartialEq)]
pub struct Bowl {
    /// The radius of its rim, above 0.
    pub radius: f64,
    /// How high the rim is, above 0.
    pub height: f64,
}

impl Default for Bowl {
    fn default() -> Self {
        Self { radius: 1.0, height: 1.0 }
    }
}

impl SceneShape for Bowl {
    const NAME: &'static str = "Bowl";
    const WORD: &'static str = "bowl";

    fn scale(&mut self, by: f64) {
        self.radius *= by;
        self.height *= by;
    }
}

/// A bowl in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedBowl {
    object_from_world: DMat3,
    world_from_object: DMat3,
    position: DVec3,
    radius: f64,
    height: f64,
}

custom_shape!(PlacedBowl, 0, "bowls");

impl PlacedBowl {
    /// y over x² + z².
    fn steepness(&self) -> f64 {
        self.height / (self.radius * self.radius)
    }

    fn object_ray(&self, origin: DVec3, direction: DVec3) -> [DVec3; 2] {
        [self.object_from_world * (origin - self.position), self.object_from_world * direction]
    }
}

impl Shape for PlacedBowl {
    type Component = Bowl;
    type SurfaceData = ();
    type Emitter = NeverSampled;
    type Prepared = ();

    fn has_inside(_: &Bowl) -> bool {
        false
    }

    fn place(bowl: &Bowl, placed: &Placed<'_>) -> Result<(Self, ()), SceneError> {
        for (field, length) in [("radius", bowl.radius), ("height", bowl.height)] {
            if !(length > 0.0 && length.is_finite()) {
                return Err(SceneError::new(placed.who, field, length, "it must be finite and above 0"));
            }
        }
        let bowl = Self {
            object_from_world: placed.pose.entity_from_world,
            world_from_object: placed.pose.world_from_entity.matrix3,
            position: placed.position,
            radius: bowl.radius,
            height: bowl.height,
        };
        Ok((bowl, ()))
    }

    /// a t² + b t + c = 0 by the formula that subtracts no near numbers.
    #[inline(always)]
    fn intersection(&self, origin: DVec3, direction: DVec3) -> Intersection {
        let [o, d] = self.object_ray(origin, direction);
        let k = self.steepness();
        let a = k * (d.x * d.x + d.z * d.z);
        let b = 2.0 * k * (o.x * d.x + o.z * d.z) - d.y;
        let c = k * (o.x * o.x + o.z * o.z) - o.y;
        let q = -0.5 * (b + (b * b - 4.0 * a * c).sqrt().copysign(b));
        let (one, other) = (q / a, c / q);
        // A root counts before the eye and below the rim; comparisons with NaN are false.
        let hits = |t: f64| {
            let (x, z) = (o.x + t * d.x, o.z + t * d.z);
            t > 0.0 && x * x + z * z <= self.radius * self.radius
        };
        let t = [one, other].into_iter().filter(|&t| hits(t)).fold(f64::INFINITY, f64::min);
        Intersection { t, uncertain: false }
    }

    fn precise_t(&self, origin: DVec3, direction: DVec3) -> f64 {
        self.intersection(origin, direction).t
    }

    fn surface(&self, (): &(), hit: &RayHit) -> SurfacePoint {
        let [o, d] = self.object_ray(hit.origin, hit.direction);
        let (k, mut at) = (self.steepness(), o + hit.t * d);
        at.y = k * (at.x * at.x + at.z * at.z);
        let gradient = DVec3::new(2.0 * k * at.x, -1.0, 2.0 * k * at.z);
        let normal = normal_world_from_object(self.object_from_world, gradient).normalize();
        let point = self.world_from_object * at + self.position;
        let size = l1_norm(self.position) + l1_norm(self.world_from_object * DVec3::splat(self.radius + self.height));
        SurfacePoint { at, ..hit.facing(point, normal, size) }
    }

    /// u goes round, v up.
    fn uv(&self, (): &(), _: &RayHit, at: DVec3, _: DVec3) -> [f64; 2] {
        [libm::atan2(at.z, at.x) / TAU, libm::hypot(at.x, at.z) / self.radius]
    }

    fn uv_slope(&self, (): &(), _: DMat3) -> UvSlope {
        UvSlope::Nowhere
    }

    fn bounds(&self) -> Option<Bounds> {
        let half = DVec3::new(self.radius, 0.5 * self.height, self.radius);
        let DMat3 { x_axis, y_axis, z_axis } = self.world_from_object;
        let half_size = x_axis.abs() * half.x + y_axis.abs() * half.y + z_axis.abs() * half.z;
        let middle = self.world_from_object * DVec3::new(0.0, half.y, 0.0);
        Some(Bounds::about(self.position + middle, half_size))
    }
}
