use super::frustum::{FrustumShape, PlacedFrustum};
use super::kind::ShapeKind;
use super::shape::SceneShape;
use crate::scene::Cylinder;

/// A cylinder in render space.
pub type PlacedCylinder = PlacedFrustum<Cylinder>;

impl SceneShape for Cylinder {
    const NAME: &'static str = "Cylinder";
    const WORD: &'static str = "cylinder";

    fn scale(&mut self, by: f64) {
        self.radius *= by;
        self.height *= by;
    }

    fn examples() -> Vec<Self> {
        let of = |radius, height, capped| Self { radius, height, capped };
        vec![of(1.0, 2.0, true), of(1.0, 1.0, false), of(1.0, 0.01, true), of(0.01, 3.0, true), of(0.01, 3.0, false)]
    }
}

impl FrustumShape for Cylinder {
    const KIND: ShapeKind = ShapeKind::Cylinder;
    const PROFILE: [f64; 2] = [1.0, 0.0];

    fn extent(&self) -> [f64; 2] {
        [self.radius, self.height]
    }

    fn is_capped(&self) -> bool {
        self.capped
    }
}
