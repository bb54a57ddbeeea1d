//! Raster → NDC at the widest and the smallest image, beside three formulas that first programs use.

use super::camera::STAGE_BOUND;
use super::camera_chain::{CameraCase, CameraChain, Pose};
use super::{Group, Method, Tally, Trial};
use crate::measure::draws::Draws;
use crate::naive::ndc::{by_steps, raster_of_sample, to_last_pixel};
use glam::{DQuat, DVec2, DVec3};
use pinhole::rays::ndc_from_raster;
use pinhole::scene::FovAxis;
use std::ops::Range;

/// The widest image.
const WIDEST: u32 = 65_536;

/// The cases of NDC.
pub fn trials() -> Vec<Trial> {
    vec![of_all_pixels("ndc, 1 x 1", 1), of_all_pixels("ndc, 65535 x 1, every pixel", WIDEST - 1), of_samples()]
}

/// Every pixel of one line: pinhole's stage, the division by W − 1 and the running sum, against exact quotients.
fn of_all_pixels(name: &'static str, width: u32) -> Trial {
    let methods = [
        Method::pinhole("pinhole, ndc", "px", STAGE_BOUND),
        Method::naive("naive division by W - 1, f32", "px", STAGE_BOUND),
        Method::naive("naive sum of steps 1 / W, f32", "px", STAGE_BOUND),
    ];
    // One pixel is one step of 0, which a sum cannot miss.
    let methods = methods[..if width == 1 { 2 } else { 3 }].to_vec();
    let rows = methods.len();
    let check = move |range: Range<u64>| {
        let (mut tally, mut chain) = (Tally::new(rows), CameraChain::new());
        let asked = CameraCase {
            size: [width, 1],
            fov: 40.0,
            axis: FovAxis::Vertical,
            pose: Pose::Turned(DVec3::ZERO, DQuat::IDENTITY),
        };
        let taken = chain.set(asked).is_ok();
        let wrote = chain.pixels([range.start as u32, 0], (range.end - range.start) as u32);
        let edges = by_steps(width).skip(range.start as usize);
        for ((pixel, wrote), edge) in (range.start as u32..).zip(&wrote).zip(edges) {
            tally.count(taken);
            // Twice the exact number of pixels from the left edge is a whole number.
            let off = |ndc: f64, twice: u32| (2.0 * ndc * f64::from(width) - f64::from(twice)).abs() / 2.0;
            tally.scores[0].measure(off(wrote.ndc.x, 2 * pixel + 1));
            tally.scores[1].measure(off(f64::from(to_last_pixel(pixel, width)), 2 * pixel + 1));
            if let Some(sum) = tally.scores.get_mut(2) {
                sum.measure(off(f64::from(edge), 2 * pixel));
            }
        }
        tally
    };
    Trial::new(Group::Camera, name, &methods, check).at_most(u64::from(width))
}

/// A random point within a pixel must stay within it.
fn of_samples() -> Trial {
    const ROWS: [Method; 2] = [
        Method::pinhole("pinhole, ndc of pixel + jitter, f64", "", 0.0),
        Method::naive("naive pixel + jitter, f32", "", 0.0),
    ];
    Trial::new(Group::Camera, "ndc, 65536 x 1, points within their pixels", &ROWS, |range| {
        let mut tally = Tally::new(ROWS.len());
        for index in range {
            let mut draws = Draws::new(79, index);
            let pixel = (draws.unit() * f64::from(WIDEST)) as u32;
            // What a generator of 24-bit numbers gives: the largest is 1 − 2⁻²⁴.
            let jitter = (draws.unit() * f64::from(1 << 24)).floor() as f32 / (1 << 24) as f32;
            let within = |raster: f64| raster.floor() == f64::from(pixel);
            let size = DVec2::new(f64::from(WIDEST), 1.0);
            let ndc = ndc_from_raster(DVec2::new(f64::from(pixel) + f64::from(jitter), 0.5), size);
            tally.count(true);
            tally.scores[0].check(within(ndc.x * size.x));
            tally.scores[1].check(within(f64::from(raster_of_sample(pixel, jitter))));
        }
        tally
    })
}
