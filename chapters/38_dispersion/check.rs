//! Chapter 38: the index of refraction at a wavelength.

use bevy_ecs::prelude::*;
use pinhole::extract::GlassTable;
use pinhole::material::IndexCurve;
use pinhole::plan::Shared;
use pinhole::rays::{self, Wavelengths};
use pinhole_lab::exercise::apart::relative;
use pinhole_lab::exercise::{Ask, Exercise, Mistakes, Part, Probe, Question, Setting, Shown, StandIn, probes};
use pinhole_lab::measure::draws::Draws;

/// Strengths, squared resonances in µm², and a wavelength in nm.
type Input = ([f64; 3], [f64; 3], f64);

/// What the reader writes.
pub type Yours = fn([f64; 3], [f64; 3], f64) -> f64;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    Exercise::rendered("refractive_index", question, move |&(b, c, wavelength)| yours(b, c, wavelength), mine)
        .and_in("SF11 from 380 nm to 780 nm", |_| ())
}

/// Schott's SF11, and N-BK7.
const SF11: ([f64; 3], [f64; 3]) =
    ([1.738_484_03, 0.311_168_974, 1.174_908_71], [0.013_606_860_4, 0.061_596_046_3, 121.922_711]);
const BK7: ([f64; 3], [f64; 3]) =
    ([1.039_612_12, 0.231_792_344, 1.010_469_45], [0.006_000_698_67, 0.020_017_914_4, 103.560_653]);

fn question() -> Question<Input, f64> {
    Question {
        pinhole_has: ("src/pinhole/material/dispersion.rs", "index"),
        probes: asked(),
        tell: |(b, c, wavelength)| format!("b {}, c {}, wavelength {}", b.shown(), c.shown(), wavelength.shown()),
        right: right_index,
        apart: |yours, right| relative(&[*yours], &[*right]),
        allowed: 1e-10,
        measured: "of the index",
        mistakes: mistakes(),
        hints: &[
            "the wavelength comes in nanometres: divide it by 1000, and then square it",
            "each of the three terms is b λ² / (λ² − c); their sum and 1 are n²",
            "is there anything left to do to n², to have n?",
        ],
    }
}

fn right_index(&(b, c, wavelength): &Input) -> f64 {
    let four = |[x, y, z]: [f64; 3]| [x, y, z, 0.0];
    IndexCurve::Sellmeier(four(b), four(c)).index(wavelength)
}

/// λ² in µm².
fn square(input: &Input) -> f64 {
    (1e-3 * input.2) * (1e-3 * input.2)
}

/// The sum of three terms of this strength, this square of the wavelength and this resonance.
fn terms(input: &Input, squared: f64, term: fn(f64, f64, f64) -> f64) -> f64 {
    (0..3).map(|at| term(input.0[at], squared, input.1[at])).sum()
}

fn usual(b: f64, square: f64, c: f64) -> f64 {
    b * square / (square - c)
}

fn mistakes() -> Mistakes<Input, f64> {
    let sum = Part::<Input, f64>::new(|i| terms(i, square(i), usual))
        .say("the wavelength is left in nanometres; the coefficients are for micrometres")
        .when(|i| terms(i, i.2 * i.2, usual))
        .say("the wavelength is not squared")
        .when(|i| terms(i, 1e-3 * i.2, usual))
        .say("the wavelength is left in nanometres, and not squared")
        .when(|i| terms(i, i.2, usual))
        .say("the square is divided by 1000, not the wavelength: 1 µm² are 1,000,000 nm²")
        .when(|i| terms(i, 1e-3 * i.2 * i.2, usual))
        .say("the wavelength is multiplied by 1000: 1000 nm are 1 µm, so it is divided")
        .when(|i| terms(i, 1e6 * i.2 * i.2, usual))
        .say("c is squared; the catalogue gives it as a square already, in µm²")
        .when(|i| terms(i, square(i), |b, square, c| b * square / (square - c * c)))
        .say("λ² is missing above the fraction's line")
        .when(|i| terms(i, square(i), |b, square, c| b / (square - c)))
        .say("λ, not λ², stands above the fraction's line")
        .when(|i| terms(i, square(i), |b, square, c| b * square.sqrt() / (square - c)))
        .say("λ² + c stands below the fraction's line; it is λ² − c")
        .when(|i| terms(i, square(i), |b, square, c| b * square / (square + c)))
        .say("the sign is turned round: below the fraction's line stands λ² − c, not c − λ²")
        .when(|i| -terms(i, square(i), usual))
        .say("b and c are exchanged")
        .when(|i| terms(i, square(i), |b, square, c| usual(c, square, b)))
        .say("only the first of the three terms is there")
        .when(|i| usual(i.0[0], square(i), i.1[0]))
        .say("the third term is missing")
        .when(|i| usual(i.0[0], square(i), i.1[0]) + usual(i.0[1], square(i), i.1[1]))
        .say("the terms are multiplied; they are added")
        .when(|i| (0..3).map(|at| usual(i.0[at], square(i), i.1[at])).product())
        .say("b is squared")
        .when(|i| terms(i, square(i), |b, square, c| usual(b * b, square, c)));
    let one = Part::<Input, f64>::new(|_| 1.0)
        .say("1 is missing: without any resonance a vacuum is left, whose index is 1")
        .when(|_| 0.0)
        .say("1 is taken off instead of added")
        .when(|_| -1.0);
    let whole = Part::<[f64; 2], f64>::new(|&[sum, one]| (one + sum).sqrt())
        .say("that is n²; the index is its root")
        .when(|&[sum, one]| one + sum)
        .say("the root is taken of the sum alone, and 1 added to it; it is √(1 + sum)")
        .when(|&[sum, one]| one + sum.sqrt())
        .say("n² is squared; its root is the index")
        .when(|&[sum, one]| (one + sum) * (one + sum))
        .say("half of n² is taken for its root")
        .when(|&[sum, one]| 0.5 * (one + sum));
    Mistakes::<Input, f64>::new().of_parts([sum, one], whole)
}

fn asked() -> Vec<Probe<Input>> {
    let of = |(b, c): ([f64; 3], [f64; 3]), wavelength: f64| (b, c, wavelength);
    let mut asked: Vec<_> = probes("no glass at all", [([0.0; 3], [0.01, 0.02, 100.0], 550.0)]).collect();
    asked.extend(probes("BK7 at five lines", [404.7, 486.1, 587.6, 656.3, 706.5].map(|line| of(BK7, line))));
    asked.extend(probes("SF11", (0..=40).map(|step| of(SF11, 380.0 + 10.0 * f64::from(step)))));
    let any = (0..60).map(|index| {
        let mut draws = Draws::new(3801, index);
        let b = [draws.between(0.2, 2.0), draws.between(0.0, 0.5), draws.between(0.0, 2.0)];
        let c = [draws.between(0.002, 0.02), draws.between(0.02, 0.08), draws.between(50.0, 200.0)];
        (b, c, draws.between(380.0, 780.0))
    });
    asked.extend(probes("glasses that nobody has melted", any));
    asked
}

/// Each path's wavelength is replaced by the one at which the glass has the reader's index.
fn mine(ask: Ask<Input, f64>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::after(rays::wavelength_stage, move |glass: Res<Shared<GlassTable>>, mut tiles: Query<&mut Wavelengths>| {
        let Some(IndexCurve::Sellmeier([b0, b1, b2, _], [c0, c1, c2, _])) = glass.curve.iter().flatten().next() else {
            return;
        };
        let (b, c) = ([*b0, *b1, *b2], [*c0, *c1, *c2]);
        for mut wavelengths in &mut tiles {
            for nm in &mut wavelengths.nm {
                let Some(own) = ask.once((b, c, *nm)) else { continue };
                *nm = wavelength_of(b, c, *nm, own);
            }
        }
    })
}

/// The wavelength in nm at which a glass has an index: the given one, if it does.
///
/// Between the resonances of SF11, at 248 nm and 11 µm, its index falls from infinity to 0.
fn wavelength_of(b: [f64; 3], c: [f64; 3], near: f64, index: f64) -> f64 {
    let off = |wavelength: f64| right_index(&(b, c, wavelength)) - index;
    if off(near).abs() < 1e-9 {
        return near;
    }
    let (mut low, mut high) = (249.0, 9000.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if off(middle) > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The index of SF11 from 380 nm on the left to 780 nm on the right: black for 1.7, white for 1.9.
fn painted(ask: Ask<Input, f64>) -> StandIn {
    StandIn::painted([64, 32], move |[x, _]| {
        let (b, c) = SF11;
        let index = ask.once((b, c, 380.0 + 400.0 * (f64::from(x) + 0.5) / 64.0)).unwrap_or_default();
        [(index - 1.7) / 0.2; 3]
    })
}
