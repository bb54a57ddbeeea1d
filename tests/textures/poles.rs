//! Where texture coordinates end: at poles.

use super::*;

/// At the pole of a sphere u has no derivative, so that a pixel there shows the mean, whatever runs across the stripes.
#[test]
fn stripes_at_a_pole_are_their_mean() {
    for across in [DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 0.0), DVec3::new(1.0, -1.0, 0.0)] {
        let mut world = World::new();
        let look = LookAt { eye: DVec3::Y * 3.0, target: DVec3::ZERO, up: DVec3::Z };
        world.spawn((OrthographicCamera { view_height: 0.01 }, look, Resolution { width: 1, height: 1 }));
        let (first, second) = (Rgb::grey(0.75), Rgb::grey(0.25));
        let stripes = Stripes { first, second, across, by: TextureBy::Uv, ..Stripes::default() };
        world.spawn((Sphere { radius: 1.0 }, Matte::default(), stripes));
        assert_eq!(pixels(&world), [[0.5; 3]], "across {across}");
    }
}
