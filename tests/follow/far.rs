//! Scenes far from the world's origin: right, or refused, and nothing between.

use super::*;
use crate::scenes::{Setup, full, shapes_of_all_kinds, stretched};
use glam::DVec3;
use pinhole::render::prepare;

/// Scenes of every kind of shape, moved ever further away: each is rendered as where it was, up to the pixels whose rays
/// pass an edge, until it is refused; once refused, it stays so.
#[test]
fn a_scene_is_right_or_refused_wherever_it_is_moved() {
    type Scene = fn(Setup) -> World;
    let scenes: [(&str, Scene); 3] =
        [("full", full), ("stretched", stretched), ("shapes of all kinds", shapes_of_all_kinds)];
    let (mut right, mut refused) = (0, 0);
    for (name, scene) in scenes {
        let render_at = |shift: DVec3| {
            let world = scene(Setup { shift, size: [64, 40], ..Setup::default() });
            prepare(&Census::of(&world), &offer()).map(|_| {
                numbers(&render(&world, &offer(), &Execution::default(), &()).expect("prepared, so rendered").film)
            })
        };
        let here = render_at(DVec3::ZERO).expect("accepted where it is");
        let mut was_refused = false;
        for exponent in 0..=17 {
            for axis in [DVec3::X, DVec3::new(-0.6, 0.3, 0.9)] {
                let shift = axis * 10_f64.powi(exponent);
                match render_at(shift) {
                    Ok(there) => {
                        assert!(!was_refused, "{name} at {shift}: refused nearer to the origin, and not here");
                        let off = |(a, b): (&[f64; 3], &[f64; 3])| (0..3).any(|part| (a[part] - b[part]).abs() > 0.02);
                        let differ = here.pixels.iter().zip(&there.pixels).filter(|&pair| off(pair)).count();
                        // A displacement of a thousandth of a shape moves its outline by far less than a pixel here.
                        assert!(differ <= 64 * 40 / 20, "{name} at {shift}: {differ} pixels differ");
                        right += 1;
                    }
                    Err(error) => {
                        let told = error.to_string();
                        let collapsed = told.contains("it must be a point other than eye");
                        assert!(collapsed || told.contains("64-bit numbers are"), "{told}");
                        assert!(exponent >= 10, "{name} at {shift} is refused: {told}");
                        (was_refused, refused) = (true, refused + 1);
                    }
                }
            }
        }
        assert!(was_refused, "{name} is never refused");
    }
    eprintln!("far away: {right} scenes as they were, {refused} refused");
}
