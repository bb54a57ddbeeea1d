//! Light that is followed, held against what is known of it.

use pinhole::measure::closed_form::closed_forms;

#[test]
fn closed_forms_hold() {
    let (mut forms, mut tried) = (0, 0);
    for form in closed_forms() {
        let (truth, measured) = ((form.truth)(), form.measure(form.few, 5).expect("measured"));
        let off = measured.deviation(truth);
        eprintln!(
            "{:<46} {:.5} ± {:.5} for {truth:.5}: {off:+.1} SE",
            form.name, measured.mean, measured.standard_error
        );
        assert!(off.abs() <= 4.0, "{}: {} for {truth}", form.name, measured.mean);
        assert!(measured.standard_error <= 0.01 * truth, "{}: a standard error above 1 %", form.name);
        (forms, tried) = (forms + 1, tried + measured.count);
    }
    eprintln!("closed forms: {forms} with {tried} samples");
}
