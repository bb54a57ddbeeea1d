//! Every number that theory knows, by whole renders with so many samples that a thousandth of noise is left.
//!
//! `cargo bench --bench closed_forms` prints them; `-- --seed 7` takes other random numbers.
#![allow(clippy::print_stdout, reason = "a benchmark's product is what it prints")]

use pinhole_lab::measure::closed_form::closed_forms;

/// 1 % after `few` samples, and a tenth of that after 100 times as many; a little more, for the error is itself measured.
const TIMES: u32 = 110;
/// The largest standard error, as a fraction of the truth.
const ERROR: f64 = 1e-3;

fn main() {
    let words: Vec<String> = std::env::args().collect();
    let asked = words.iter().position(|word| word == "--seed").and_then(|at| words.get(at + 1));
    let seed = asked.map_or(1, |word| word.parse().expect("--seed takes a whole number"));
    let (mut missed, mut forms, mut exact, mut tried) = (Vec::new(), 0, 0, 0);
    for form in closed_forms() {
        let truth = (form.truth)();
        let measured = form.measure(form.few.saturating_mul(TIMES), seed).expect("measured");
        let (off, error) = (measured.deviation(truth), measured.standard_error / truth);
        let unit = if measured.is_exact(truth) { "times rounding" } else { "SE" };
        println!("{:<46} {truth:>10.6} {:>10.6} ± {:.4} % {off:+.2} {unit}", form.name, measured.mean, 100.0 * error);
        if off.abs() > 4.0 || error > ERROR {
            missed.push(form.name);
        }
        (forms, exact, tried) = (forms + 1, exact + u32::from(measured.is_exact(truth)), tried + measured.count);
    }
    println!("{forms} closed forms, {exact} of them without noise, {tried} samples, seed {seed}");
    assert!(missed.is_empty(), "more than 4 standard errors off, or an error above {ERROR}: {missed:?}");
}
