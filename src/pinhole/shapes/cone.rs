use super::frustum::{FrustumShape, PlacedFrustum};
use super::kind::ShapeKind;
use super::shape::SceneShape;
use crate::scene::Cone;

/// A cone in render space.
pub type PlacedCone = PlacedFrustum<Cone>;

impl SceneShape for Cone {
    const NAME: &'static str = "Cone";
    const WORD: &'static str = "cone";

    fn scale(&mut self, by: f64) {
        self.radius *= by;
        self.height *= by;
    }

    fn examples() -> Vec<Self> {
        let of = |radius, height, capped| Self { radius, height, capped };
        vec![of(1.0, 2.0, true), of(1.0, 1.0, false), of(1.0, 0.01, true), of(0.01, 3.0, true), of(0.01, 3.0, false)]
    }
}

impl FrustumShape for Cone {
    const KIND: ShapeKind = ShapeKind::Cone;
    /// 1 at the base, 0 at the apex.
    const PROFILE: [f64; 2] = [0.5, -0.5];

    fn extent(&self) -> [f64; 2] {
        [self.radius, self.height]
    }

    fn is_capped(&self) -> bool {
        self.capped
    }
}
