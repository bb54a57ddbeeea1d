//! Adaptive sampling: right on average, where the naive way is not, and as exact as it says.

use super::*;
use pinhole::plan::Census;
use pinhole::render::Outcome;
use pinhole::sample::{Purpose, uniform};
use pinhole_lab::naive::adaptive::mean_until;

const SIDE: u32 = 24;
const RADIUS: f64 = 1.3;
const HEIGHT: f64 = 4.0;

/// A white disc on black, by parallel rays: a pixel's light is the share of it that the disc covers.
fn disc(seed: u64, samples: u32, adaptive: Adaptive) -> World {
    let mut world = World::new();
    let sampling = Sampling { samples, seed, sampler: Sampler::Independent, filter: Filter::Box { radius: 0.5 } };
    let resolution = Resolution { width: SIDE, height: SIDE };
    let camera = (OrthographicCamera { view_height: HEIGHT }, Placement::at(0.0, 0.0, 5.0), resolution);
    world.spawn((Name::new("camera"), camera, sampling, adaptive));
    world.spawn((Name::new("ball"), Sphere { radius: RADIUS }, Matte { colour: Rgb::grey(1.0) }));
    world
}

/// Where a raster point is on the plane of the disc.
fn along(raster: f64) -> f64 {
    (raster / f64::from(SIDE) - 0.5) * HEIGHT
}

/// The share of a pixel that the disc covers: lengths of chords, summed across the pixel.
fn covered(x: u32, y: u32) -> f64 {
    const LINES: u32 = 4096;
    let (top, bottom) = (along(f64::from(y)), along(f64::from(y + 1)));
    let chord = |line: u32| {
        let x = along(f64::from(x) + (f64::from(line) + 0.5) / f64::from(LINES));
        let half = (RADIUS * RADIUS - x * x).max(0.0).sqrt();
        (half.min(bottom) - (-half).max(top)).max(0.0) / (bottom - top)
    };
    (0..LINES).map(chord).sum::<f64>() / f64::from(LINES)
}

fn run(seed: u64, samples: u32, adaptive: Adaptive) -> (Film, Outcome) {
    let scene = disc(seed, samples, adaptive);
    let mut in_progress =
        RenderInProgress::begin(&Census::of(&scene), &offer(), &Execution::default()).expect("begins");
    let limits = Limits { adaptive: Some(adaptive), ..Limits::default() };
    let outcome = render_in_passes(&mut in_progress, &limits, &(), &mut |_| Ok(())).expect("renders");
    (in_progress.film, outcome)
}

/// Mean, and its standard error.
fn mean_of(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / (n - 1.0);
    (mean, (variance / n).sqrt())
}

#[test]
fn the_naive_way_is_wrong_on_average_and_the_two_stages_are_not() {
    const RENDERS: u64 = 48;
    let adaptive = Adaptive { error: 0.1, pilot: 8 };
    let truth: Vec<f64> = (0..SIDE * SIDE).map(|pixel| covered(pixel % SIDE, pixel / SIDE)).collect();
    let all: f64 = truth.iter().sum::<f64>() / f64::from(SIDE * SIDE);
    let area = std::f64::consts::PI * RADIUS * RADIUS / (HEIGHT * HEIGHT);
    assert!((all - area).abs() < 1e-6, "{all} is not {area}");
    // Pixels that the disc only just reaches, where samples that are all black are likely.
    let thin: Vec<usize> = (0..truth.len()).filter(|&pixel| truth[pixel] > 0.0 && truth[pixel] < 0.2).collect();
    let thin_truth: f64 = thin.iter().map(|&pixel| truth[pixel]).sum();

    let (mut ours, mut pinhole_thin, mut naive_thin) = (Vec::new(), Vec::new(), Vec::new());
    let mut samples = [0.0; 2];
    for seed in 0..RENDERS {
        let (film, outcome) = run(seed, 400, adaptive);
        samples[0] += outcome.achieved.expect("measured").samples.0 + f64::from(adaptive.pilot);
        let value = |pixel: usize| {
            let (tile, row) = film.place(pixel as u32 % SIDE, pixel as u32 / SIDE);
            film.tiles[tile].mean_f64(row)[0]
        };
        ours.push((0..truth.len()).map(value).sum::<f64>() / truth.len() as f64);
        pinhole_thin.push(thin.iter().map(|&pixel| value(pixel)).sum());
        let naive = |pixel: usize| {
            let at = [pixel as u32 % SIDE, pixel as u32 / SIDE];
            let inside = |sample: u32| {
                let x = along(f64::from(at[0]) + uniform(seed, at, sample, Purpose::Pixel));
                let y = along(f64::from(at[1]) + uniform(seed + 1000, at, sample, Purpose::Pixel));
                f64::from(u8::from(x * x + y * y < RADIUS * RADIUS))
            };
            mean_until(inside, adaptive.pilot, 400, adaptive.error)
        };
        samples[1] += (0..truth.len()).map(|pixel| f64::from(naive(pixel).samples)).sum::<f64>() / truth.len() as f64;
        naive_thin.push(thin.iter().map(|&pixel| naive(pixel).mean).sum());
    }
    let [ours, pinhole_thin, naive_thin] = [ours, pinhole_thin, naive_thin].map(|values: Vec<f64>| mean_of(&values));
    let off = |(mean, error): (f64, f64), truth: f64| (mean - truth) / error;
    eprintln!(
        "adaptive: the whole disc {:+.1} standard errors from πr²; its {} thin pixels: two stages {:+.1} ({:+.1} %), \
         naive {:+.1} ({:+.1} %); {:.1} and {:.1} samples a pixel",
        off(ours, area),
        thin.len(),
        off(pinhole_thin, thin_truth),
        (pinhole_thin.0 / thin_truth - 1.0) * 100.0,
        off(naive_thin, thin_truth),
        (naive_thin.0 / thin_truth - 1.0) * 100.0,
        samples[0] / RENDERS as f64,
        samples[1] / RENDERS as f64
    );
    assert!(off(ours, area).abs() < 4.0 && off(pinhole_thin, thin_truth).abs() < 4.0, "the two stages are biased");
    assert!(off(naive_thin, thin_truth) < -6.0, "the bias of the naive way was not found");
}

#[test]
fn the_error_that_is_measured_is_the_error_that_there_is() {
    let adaptive = Adaptive { error: 0.05, pilot: 16 };
    let (mut told, mut true_square) = (0.0, 0.0);
    const RENDERS: u64 = 12;
    let mut last = Outcome::default();
    for seed in 0..RENDERS {
        let (film, outcome) = run(seed + 500, 4096, adaptive);
        let found = outcome.achieved.expect("measured");
        told += found.error * found.error / RENDERS as f64;
        let square = |pixel: u32| {
            let (x, y) = (pixel % SIDE, pixel / SIDE);
            let (tile, row) = film.place(x, y);
            let (mean, truth) = (film.tiles[tile].mean_f64(row)[0], covered(x, y));
            (mean - truth) * (mean - truth) / (truth * truth + 0.01)
        };
        true_square += (0..SIDE * SIDE).map(square).sum::<f64>() / f64::from(SIDE * SIDE) / RENDERS as f64;
        last = outcome;
    }
    let ratio = (told / true_square).sqrt();
    let found = last.achieved.expect("measured");
    eprintln!("errors: {:.4} told, {:.4} true; the last: {found:?}", told.sqrt(), true_square.sqrt());
    assert!((0.8..1.25).contains(&ratio), "told {ratio} of the true error");
    assert!(found.error < 0.05 && found.cut_short == 0 && found.samples.1 == 4, "{found:?}");
}

#[test]
fn samples_that_run_out_are_told() {
    let (_, outcome) = run(3, 32, Adaptive { error: 0.01, pilot: 8 });
    let found = outcome.achieved.expect("measured");
    // Such pixels need more than a thousand samples, and 32 that all agree come about less than once in a thousand.
    let torn = (0..SIDE * SIDE).filter(|pixel| (0.2..0.8).contains(&covered(pixel % SIDE, pixel / SIDE))).count();
    assert!(torn > 20 && found.cut_short >= torn as u64 && found.samples.2 == 32, "{torn} torn pixels: {found:?}");
    eprintln!("samples ran out: {found:?}");
}

#[test]
fn a_pilot_and_its_plan_are_continued_to_the_same_bits() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("disc.checkpoint");
    let adaptive = Adaptive { error: 0.05, pilot: 8 };
    let (whole, _) = run(9, 200, adaptive);
    let mut tried = 0;
    for stop in 1..12 {
        let scene = disc(9, 200, adaptive);
        let census = &Census::of(&scene);
        let mut in_progress = RenderInProgress::begin(census, &offer(), &Execution::default()).expect("begins");
        let limits = Limits { adaptive: Some(adaptive), write_every: Some(Duration::ZERO), ..Limits::default() };
        let mut kept = 0;
        // The writing fails as a full disk would make it, after the checkpoint was written.
        let mut keep = |film: &Film| {
            write_checkpoint(film, 1, &path)?;
            kept += 1;
            if kept == stop { Err(Error::Interrupted) } else { Ok(()) }
        };
        let stopped = render_in_passes(&mut in_progress, &limits, &(), &mut keep).is_err();
        let mut next = RenderInProgress::begin(census, &offer(), &Execution::default()).expect("begins");
        next.take(read_checkpoint(1, &next.film, true, &path).expect("read"));
        render_in_passes(&mut next, &limits, &(), &mut |_| Ok(())).expect("renders");
        FilmBits::of(&next.film).assert_is(&FilmBits::of(&whole), &format!("stopped at writing {stop}"));
        assert!(next.film.moments == whole.moments && next.film.planned == whole.planned);
        tried += u32::from(stopped);
    }
    assert!(tried > 5, "only {tried} were stopped");
    eprintln!("adaptive: stopped at {tried} moments of pilot and plan, continued to the same bits");
}
