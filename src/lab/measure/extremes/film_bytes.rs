//! Bytes: is every one the one that the sRGB curve rounds to?

use super::{Group, Method, Tally, Trial};
use crate::measure::draws::Draws;
use crate::measure::exact::Dyadic;
use crate::naive::film::{byte_by_curve_f32, byte_by_gamma, byte_cut_off};
use num_bigint::BigInt;
use pinhole::film::{Curve, byte_from_linear, linear_from_srgb};
use std::cmp::Ordering;
use std::ops::Range;

const METHODS: [Method; 4] = [
    Method::pinhole("pinhole, least light of each byte", "", 0.0),
    Method::naive("naive, power 1 / 2.2", "", 0.0),
    Method::naive("naive, curve in f32, rounded", "", 0.0),
    Method::naive("naive, curve in f32, cut off", "", 0.0),
];
/// Lights next to a boundary that are tried, in steps of f32 to each side.
const STEPS: u64 = 8;
/// Boundaries between bytes, times the lights about each.
const ABOUT_BOUNDARIES: u64 = 255 * (2 * STEPS + 1);

/// The cases of bytes.
pub fn trials() -> Vec<Trial> {
    let bytes = |name: &str, check: fn(Range<u64>) -> Tally| Trial::new(Group::Film, name, &METHODS, check);
    vec![
        bytes("sRGB, 0 to 255 to light and back", |range| check(range, every_byte)).at_most(256),
        bytes("the byte of light within 8 steps of where it changes", |range| check(range, about_a_boundary))
            .at_most(ABOUT_BOUNDARIES),
        bytes("the byte of light from 1e-6 to 2", |range| check(range, any_light)),
        Trial::new(Group::Film, "more light, no smaller byte", &METHODS[..1], check_order),
    ]
}

fn check(range: Range<u64>, light: fn(u64) -> f32) -> Tally {
    let mut tally = Tally::new(METHODS.len());
    for index in range {
        let light = light(index);
        tally.count(true);
        let bytes = bytes(light);
        // One byte only is right, so that most often the exact oracle is asked once.
        let pinhole_is_right = is_byte_of(bytes[0], light);
        for (score, byte) in tally.scores.iter_mut().zip(bytes) {
            score.check(if pinhole_is_right { byte == bytes[0] } else { byte != bytes[0] && is_byte_of(byte, light) });
        }
    }
    tally
}

/// What each method makes of a light.
fn bytes(light: f32) -> [u8; 4] {
    [byte_from_linear(light, Curve::Srgb), byte_by_gamma(light), byte_by_curve_f32(light), byte_cut_off(light)]
}

/// The light of a byte, as close as f32 has it.
fn every_byte(byte: u64) -> f32 {
    linear_from_srgb(byte as f64 / 255.0) as f32
}

/// The light where a byte changes to the next, a few steps of f32 up or down.
fn about_a_boundary(index: u64) -> f32 {
    let (byte, step) = (index / (2 * STEPS + 1), index % (2 * STEPS + 1));
    let boundary = linear_from_srgb((byte as f64 + 0.5) / 255.0) as f32;
    f32::from_bits(boundary.to_bits() + step as u32 - STEPS as u32)
}

fn any_light(index: u64) -> f32 {
    Draws::new(111, index).power_of_ten(-6.0, 0.301) as f32
}

/// A light and one that is a little or much brighter: the brighter one's byte is not smaller.
fn check_order(range: Range<u64>) -> Tally {
    let mut tally = Tally::new(1);
    for index in range {
        let mut draws = Draws::new(112, index);
        let light = draws.power_of_ten(-6.0, 0.1) as f32;
        let brighter = f32::from_bits(light.to_bits() + draws.power_of_ten(0.0, 7.0) as u32);
        tally.count(true);
        let [byte, brighter] = [light, brighter].map(|light| byte_from_linear(light, Curve::Srgb));
        tally.scores[0].check(byte <= brighter);
    }
    tally
}

/// Whether the curve, rounded to the nearest byte, gives this one; half way goes up.
fn is_byte_of(byte: u8, light: f32) -> bool {
    let reached = byte == 0 || against_boundary(light, byte - 1) != Ordering::Less;
    reached && (byte == 255 || against_boundary(light, byte) == Ordering::Less)
}

/// A light against the one where `byte` changes to the next, exactly.
///
/// There the number sent is s = (2b + 1) / 510. On the straight part the light is s / 12.92; on the curve it is x^(12/5)
/// with x = (s + 0.055) / 1.055 = (1000 (2b + 1) + 28050) / 538050, so fifth powers of light equal twelfth powers of x.
/// 0.04045 lies between s of bytes 9 and 10.
fn against_boundary(light: f32, byte: u8) -> Ordering {
    let (light, odd) = (Dyadic::of(light), 2 * i64::from(byte) + 1);
    let whole = |number: BigInt| Dyadic { mantissa: number, exponent: 0 };
    if byte < 10 {
        return (&light * &whole(BigInt::from(510 * 1292))).cmp(&whole(BigInt::from(100 * odd)));
    }
    let fifth = Dyadic { mantissa: light.mantissa.pow(5), exponent: 5 * light.exponent };
    let below = whole(BigInt::from(538_050).pow(12));
    (&fifth * &below).cmp(&whole(BigInt::from(1000 * odd + 28_050).pow(12)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_byte_and_its_neighbours_are_told_apart() {
        for byte in 0..=255_u8 {
            let light = linear_from_srgb(f64::from(byte) / 255.0) as f32;
            assert!(is_byte_of(byte, light), "{byte}");
            assert!(byte == 0 || !is_byte_of(byte - 1, light), "{byte}");
            assert!(byte == 255 || !is_byte_of(byte + 1, light), "{byte}");
        }
        assert!(is_byte_of(255, 7.0) && !is_byte_of(254, 7.0));
        assert!(is_byte_of(0, -1.0));
    }
}
