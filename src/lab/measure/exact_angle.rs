//! π and the tangent to far more digits than any kernel has.

use super::exact::{Dyadic, PRECISION};
use num_bigint::BigInt;

/// π, with a relative error below 2^-310, by Machin's formula 16 atan(1/5) − 4 atan(1/239).
#[must_use]
pub fn pi() -> Dyadic {
    let one = BigInt::from(1) << (PRECISION + 32);
    let arctangent_of_one_over = |whole: i64| {
        let (mut power, mut sum, mut odd) = (&one / whole, BigInt::ZERO, 1i64);
        while power != BigInt::ZERO {
            sum += if odd % 4 == 1 { &power / odd } else { -(&power / odd) };
            (power, odd) = (power / (whole * whole), odd + 2);
        }
        sum
    };
    let mantissa: BigInt = arctangent_of_one_over(5) * 16 - arctangent_of_one_over(239) * 4;
    Dyadic { mantissa, exponent: -(PRECISION + 32) as i32 }
}

/// The tangent of an angle strictly between −90 and 90 degrees, with a relative error below 2^-300.
///
/// The reduction tan(a) = 1 / tan(90° − a) is made in degrees, where the difference is exact, so
/// angles next to 0 and next to 90 degrees lose nothing.
///
/// # Panics
/// When the angle lies outside that range.
#[must_use]
pub fn tan_of_degrees(degrees: &Dyadic) -> Dyadic {
    let rest = &Dyadic::of(90) - &degrees.abs();
    assert!(rest.sign() > 0, "the angle lies strictly between -90 and 90 degrees");
    if degrees.abs() > Dyadic::of(45) {
        let cotangent = tan_of_degrees(&rest);
        let tangent = Dyadic::of(1).divided_by(&cotangent);
        return if degrees.sign() < 0 { -&tangent } else { tangent };
    }
    let angle = (degrees * &pi()).divided_by(&Dyadic::of(180));
    let sine = alternating_series(angle.clone(), &angle, 2);
    sine.divided_by(&alternating_series(Dyadic::of(1), &angle, 1))
}

/// first · (1 − a²/(k(k+1)) + a⁴/(k(k+1)(k+2)(k+3)) − …): the sine from (a, k = 2), the cosine from
/// (1, k = 1).
fn alternating_series(first: Dyadic, angle: &Dyadic, mut k: i32) -> Dyadic {
    let square = angle.squared().shortened();
    let (mut term, mut sum) = (first.clone(), first);
    // Below 45 degrees a term shrinks at least threefold, and the series ends when one no longer
    // reaches the sum.
    while term.sign() != 0 && term.abs() > sum.abs().scaled(-(PRECISION as i32)) {
        let divisor = Dyadic::of(-k * (k + 1));
        term = (&term * &square).divided_by(&divisor).shortened();
        sum = (&sum + &term).shortened();
        k += 2;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::exact::relative_error;
    use proptest::prelude::*;

    /// The number's first digits as a decimal fraction, cut off rather than rounded.
    fn digits(number: &Dyadic, count: u32) -> String {
        let scaled = number.mantissa.clone() * BigInt::from(10).pow(count);
        let text = (scaled >> -number.exponent).to_string();
        let whole = text.len() - count as usize;
        format!("{}.{}", &text[..whole], &text[whole..])
    }

    #[test]
    fn transcendentals_have_their_known_digits() {
        assert_eq!(digits(&pi(), 50), "3.14159265358979323846264338327950288419716939937510");
        let root = Dyadic::of(2).square_root();
        assert_eq!(digits(&root, 50), "1.41421356237309504880168872420969807856967187537694");
        let third = &Dyadic::of(1).divided_by(&Dyadic::of(3)) + &Dyadic::of(1);
        assert_eq!(digits(&third, 50), format!("1.{}", "3".repeat(50)));
        let one_degree = &tan_of_degrees(&Dyadic::of(1)) + &Dyadic::of(1);
        assert_eq!(digits(&one_degree, 50), "1.01745506492821758576512889521972782431410158883987");
        assert_eq!(relative_error(1.0, &tan_of_degrees(&Dyadic::of(45))), 0.0);
    }

    /// 2^-300 as an exact number.
    fn tiny() -> Dyadic {
        Dyadic::of(1).scaled(-300)
    }

    proptest! {
        #[test]
        fn the_double_angle_holds(degrees in -44.9..44.9f64) {
            let tangent = tan_of_degrees(&Dyadic::of(degrees));
            let one = Dyadic::of(1);
            let double = tangent.scaled(1).divided_by(&(&one - &tangent.squared()));
            let direct = tan_of_degrees(&Dyadic::of(degrees).scaled(1));
            prop_assert!((&double - &direct).abs() <= &direct.abs() * &tiny());
        }
    }
}
