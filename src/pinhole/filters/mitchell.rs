use super::kernel::{Kernel, within};
use crate::each::Each;
use crate::scene::SceneError;

/// The filter of Mitchell and Netravali.
#[derive(Clone, Copy, Debug)]
pub struct MitchellKernel {
    /// In pixels.
    pub radius: f64,
    /// B, which blurs.
    pub b: f64,
    /// C, which sharpens.
    pub c: f64,
}

impl Kernel for MitchellKernel {
    fn radius(self) -> f64 {
        self.radius
    }

    fn check(self, who: &str) -> Result<(), SceneError> {
        within(who, "filter b", self.b, [0.0, 1.0], "a number")?;
        within(who, "filter c", self.c, [0.0, 1.0], "a number")
    }

    fn value(self, x: f64) -> f64 {
        let [near, far] = mitchell(self.b, self.c);
        let t = 2.0 * x / self.radius;
        let [a0, a1, a2, a3] = if t < 1.0 { near } else { far };
        a0 + t * (a1 + t * (a2 + t * a3))
    }

    fn area(self, x: f64) -> f64 {
        let [near, far] = mitchell(self.b, self.c);
        let up_to = |[a0, a1, a2, a3]: [f64; 4], t: f64| t * (a0 + t * (a1 / 2.0 + t * (a2 / 3.0 + t * a3 / 4.0)));
        let t = 2.0 * x / self.radius;
        let area = if t < 1.0 { up_to(near, t) } else { up_to(near, 1.0) + up_to(far, t) - up_to(far, 1.0) };
        area * self.radius / 2.0
    }

    /// The outer cubic is (2 − t)² (b(2 − t) − 6c(t − 1)) / 6.
    fn sign_change(self) -> f64 {
        let Self { radius, b, c } = self;
        if c > 0.0 { radius / 2.0 * (2.0 * b + 6.0 * c) / (b + 6.0 * c) } else { radius }
    }
}

/// The coefficients of Mitchell and Netravali's two cubics, constant term first: for x up to 1, and from 1 to 2.
fn mitchell(b: f64, c: f64) -> [[f64; 4]; 2] {
    let near = [6.0 - 2.0 * b, 0.0, -18.0 + 12.0 * b + 6.0 * c, 12.0 - 9.0 * b - 6.0 * c];
    let far = [8.0 * b + 24.0 * c, -12.0 * b - 48.0 * c, 6.0 * b + 30.0 * c, -b - 6.0 * c];
    [near, far].each(|cubic| cubic.each(|part| part / 6.0))
}
