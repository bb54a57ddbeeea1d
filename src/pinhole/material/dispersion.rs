//! The index of refraction as a function of the wavelength.

use super::glass::{MIN_INDEX, is_index};
use crate::check::number;
use crate::each::Each;
use crate::sample::SPECTRUM;
use crate::scene::{Dispersion, SceneError};

/// The wavelength at which a glass has the index that catalogues call n_d, in nm: the yellow line of helium.
pub const D_LINE: f64 = 587.5618;

/// The index of refraction of a glass as a function of the wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum IndexCurve {
    /// The coefficients a, b and c of Cauchy's equation, in µm², µm⁴.
    Cauchy([f64; 3]),
    /// The coefficients b and c of Sellmeier's equation, four pairs, c in µm².
    Sellmeier([f64; 4], [f64; 4]),
}

/// Schott, optical glass data sheets, N-BK7: valid from 300 to 2500 nm; relative to air.
const BK7: IndexCurve = IndexCurve::Sellmeier(
    [1.039_612_12, 0.231_792_344, 1.010_469_45, 0.0],
    [0.006_000_698_67, 0.020_017_914_4, 103.560_653, 0.0],
);

/// Schott, optical glass data sheets, SF11: valid from 390 to 2500 nm; relative to air.
const SF11: IndexCurve = IndexCurve::Sellmeier(
    [1.738_484_03, 0.311_168_974, 1.174_908_71, 0.0],
    [0.013_606_860_4, 0.061_596_046_3, 121.922_711, 0.0],
);

/// M. Daimon and A. Masumura, Applied Optics 46, 3811 (2007), at 20.0 °C: valid from 182 to 1129 nm.
const WATER: IndexCurve = IndexCurve::Sellmeier(
    [5.684_027_565e-1, 1.726_177_391e-1, 2.086_189_578e-2, 1.130_748_688e-1],
    [5.101_829_712e-3, 1.821_153_936e-2, 2.620_722_293e-2, 1.069_792_721e1],
);

/// F. Peter, Zeitschrift für Physik 15, 358 (1923): valid from 226 to 650 nm and smooth beyond; refractiveindex.info lists
/// the square roots of the second row.
const DIAMOND: IndexCurve =
    IndexCurve::Sellmeier([0.3306, 4.3356, 0.0, 0.0], [0.1750 * 0.1750, 0.1060 * 0.1060, 0.0, 0.0]);

impl IndexCurve {
    /// The curve of a dispersion.
    pub const fn of(dispersion: Dispersion) -> Self {
        match dispersion {
            Dispersion::Bk7 => BK7,
            Dispersion::Sf11 => SF11,
            Dispersion::Water => WATER,
            Dispersion::Diamond => DIAMOND,
            Dispersion::Cauchy { a, b, c } => Self::Cauchy([a, b, c]),
            Dispersion::Sellmeier { b: [b0, b1, b2], c: [c0, c1, c2] } => {
                Self::Sellmeier([b0, b1, b2, 0.0], [c0, c1, c2, 0.0])
            }
        }
    }

    // ANCHOR: index_at
    /// The index of refraction at a wavelength in nm.
    #[inline(always)]
    pub fn index(&self, wavelength: f64) -> f64 {
        let micrometres = 1e-3 * wavelength;
        let square = micrometres * micrometres;
        match self {
            Self::Cauchy([a, b, c]) => a + (b + c / square) / square,
            Self::Sellmeier(strengths, resonances) => {
                let terms = strengths.iter().zip(resonances).map(|(b, c)| b * square / (square - c));
                (1.0 + terms.sum::<f64>()).sqrt()
            }
        }
    }
    // ANCHOR_END: index_at
}

/// The curve of a dispersion whose index is accepted at every wavelength that paths may have.
///
/// Errors: a coefficient that is not finite; an index that no glass may have.
pub(crate) fn checked_curve(who: &str, dispersion: Dispersion) -> Result<IndexCurve, SceneError> {
    let coefficients: Vec<(&str, f64)> = match dispersion {
        Dispersion::Cauchy { a, b, c } => vec![("cauchy a", a), ("cauchy b", b), ("cauchy c", c)],
        Dispersion::Sellmeier { b, c } => {
            b.each(|own| ("sellmeier b", own)).into_iter().chain(c.each(|own| ("sellmeier c", own))).collect()
        }
        _ => Vec::new(),
    };
    if let Some(&(field, value)) = coefficients.iter().find(|(_, value)| !value.is_finite()) {
        return Err(SceneError::new(who, field, number(value), "it must be a finite number"));
    }
    let curve = IndexCurve::of(dispersion);
    let wavelengths = (SPECTRUM[0]..=SPECTRUM[1]).map(f64::from);
    match wavelengths.map(|own| (own, curve.index(own))).find(|&(_, index)| !is_index(index)) {
        None => Ok(curve),
        Some((wavelength, index)) => {
            let accepted = format!(
                "it must be a number from {MIN_INDEX} to {} at all wavelengths from {} to {} nm",
                1.0 / MIN_INDEX,
                SPECTRUM[0],
                SPECTRUM[1]
            );
            let value = format!("{} at {wavelength} nm", number(index));
            Err(SceneError::new(who, "index", value, accepted))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lines F and C of hydrogen, in nm.
    const F_LINE: f64 = 486.1327;
    const C_LINE: f64 = 656.2725;

    fn abbe(curve: IndexCurve) -> f64 {
        (curve.index(D_LINE) - 1.0) / (curve.index(F_LINE) - curve.index(C_LINE))
    }

    /// n_d and the Abbe number ν_d as Schott's catalogue and refractiveindex.info print them.
    #[test]
    fn named_glasses_have_the_index_and_the_abbe_number_of_their_catalogues() {
        let named = [
            (Dispersion::Bk7, 1.51680, 64.17, 5e-6, 5e-3),
            (Dispersion::Sf11, 1.78472, 25.76, 5e-6, 5e-3),
            (Dispersion::Water, 1.3334, 55.8, 5e-5, 0.05),
            (Dispersion::Diamond, 2.4175, 55.3, 5e-5, 0.05),
        ];
        for (glass, index, number, index_digit, number_digit) in named {
            let curve = IndexCurve::of(glass);
            let (own, own_number) = (curve.index(D_LINE), abbe(curve));
            eprintln!("{glass:?}: n_d {own:.6}, V_d {own_number:.3}");
            assert!((own - index).abs() <= index_digit, "{glass:?}: {own}");
            assert!((own_number - number).abs() <= number_digit, "{glass:?}: {own_number}");
        }
    }

    /// Schott's data sheet of N-BK7 lists the indices at the lines h, F', e, C' and r.
    #[test]
    fn bk7_is_that_of_the_data_sheet_at_other_lines_too() {
        let listed =
            [(404.6561, 1.53024), (479.9914, 1.52283), (546.0740, 1.51872), (643.8469, 1.51472), (706.5188, 1.51289)];
        for (wavelength, index) in listed {
            let own = IndexCurve::of(Dispersion::Bk7).index(wavelength);
            assert!((own - index).abs() <= 5e-6, "{wavelength} nm: {own}");
        }
    }

    #[test]
    fn coefficients_that_give_no_index_are_refused() {
        let cauchy = |a, b, c| checked_curve("dispersion \"x\"", Dispersion::Cauchy { a, b, c });
        assert!(cauchy(1.5, 0.004, 0.0).is_ok());
        for (refused, words) in [
            (cauchy(f64::NAN, 0.0, 0.0), "cauchy a is NaN"),
            (cauchy(1.5, f64::INFINITY, 0.0), "cauchy b is inf"),
            (cauchy(-1.5, 0.0, 0.0), "index is -1.5 at 380 nm"),
            (cauchy(1.0, -0.5, 0.0), "index is -2.46"),
            (
                // A resonance in the middle of the spectrum.
                checked_curve("dispersion \"x\"", Dispersion::Sellmeier { b: [1.0, 0.0, 0.0], c: [0.25, 0.0, 0.0] }),
                "index is NaN at 380 nm",
            ),
        ] {
            let said = refused.expect_err("refused").to_string();
            assert!(said.contains(words), "{said}");
        }
    }
}
