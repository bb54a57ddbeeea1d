//! Samples as points, and what their means vary by.

use super::Figure;
use super::label::Label;
use super::pen::{Fill, IMAGE, INK, Pen, RAY, WIDTH};
use super::svg::{Drawing, Svg};
use glam::DVec2;
use pinhole::Chapter;
use pinhole::Result;
use pinhole::extract::{SamplingTable, camera_entity};
use pinhole::plan::{Census, Table};
use pinhole::sample::{
    Draw, INTEGRANDS, MeanError, PixelKey, Purpose, SampleIndex, mean_error, slope, unit, with_sampler,
};
use pinhole::scene::Sampler;

/// Points in each square.
const POINTS: u32 = 64;
/// Means for each dot of the drawing of variances.
const TRIALS: u32 = 400;

/// One pixel's points of each sampler, with the grid of as many boxes, and the counts along both axes below.
pub fn draw_points(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let scene = chapter.world(&Default::default());
    camera_entity(&scene)?;
    let pixel = PixelKey::new(SamplingTable::extract(&Census::of(&scene))?.seed, [240, 135]);
    let side = 206.0;
    let mut svg = Svg::new(figure.name, side + 96.0);
    for (number, (word, sampler)) in (0_u32..).zip(Sampler::ALL.into_iter().rev()) {
        let corner = DVec2::new(24.0 + f64::from(number) * (side + 28.0), 12.0);
        for line in 0..=8 {
            let along = f64::from(line) / 8.0 * side;
            let pen = Pen::new(IMAGE, 0.8).faint(if line % 8 == 0 { 1.0 } else { 0.5 });
            svg.quiet_line(corner + DVec2::new(along, 0.0), corner + DVec2::new(along, side), pen);
            svg.quiet_line(corner + DVec2::new(0.0, along), corner + DVec2::new(side, along), pen);
        }
        let mut columns = [0_u32; POINTS as usize];
        for sample in 0..POINTS {
            let sample = SampleIndex { number: sample, samples: POINTS, depth: 0 };
            let point = with_sampler!(sampler, D => D::of(sample, Purpose::Pixel).two(pixel));
            let at = corner + DVec2::from(point.map(unit)) * side;
            svg.circle(at, 2.4, Some(&Fill::new(RAY, 1.0)), None);
            columns[(unit(point[0]) * f64::from(POINTS)) as usize] += 1;
            svg.quiet_line(DVec2::new(at.x, corner.y + side + 5.0), DVec2::new(at.x, corner.y + side + 12.0), TICK);
        }
        let empty = columns.iter().filter(|&&count| count == 0).count();
        let below = corner + DVec2::new(side / 2.0, side + 28.0);
        svg.label(Label::near(below, word, DVec2::Y, 6.0));
        let told = format!("{empty} of {POINTS} columns empty");
        svg.label(Label::near(below + DVec2::new(0.0, 17.0), &told, DVec2::Y, 6.0).title(0.85));
    }
    let foot = format!("scene {}, pixel 240,135 · cargo run --release -- figure {}", chapter.name, figure.name);
    Ok(svg.finish(figure.about, &foot))
}

const TICK: Pen = Pen::new(INK, 0.9).faint(0.7);

/// The variance of the mean over its samples, on two logarithmic scales: a smooth function and one with an edge.
pub fn draw_variance(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let (wide, tall) = (250.0, 200.0);
    let mut svg = Svg::new(figure.name, tall + 92.0);
    for (number, integrand) in (0_u32..).zip([INTEGRANDS[1], INTEGRANDS[2]]) {
        let corner = DVec2::new(52.0 + f64::from(number) * (WIDTH / 2.0 - 6.0), 12.0);
        let at = |samples: f64, variance: f64| {
            let (x, y) = (libm::log2(samples) / 10.0, libm::log10(variance) / -10.0);
            corner + DVec2::new(x * wide, y * tall)
        };
        for power in 0..=5 {
            let (samples, variance) = (libm::exp2(2.0 * f64::from(power)), libm::pow(0.01, f64::from(power)));
            svg.quiet_line(at(samples, 1.0), at(samples, 1e-10), Pen::new(INK, 0.6).faint(0.3));
            svg.quiet_line(at(1.0, variance), at(1024.0, variance), Pen::new(INK, 0.6).faint(0.3));
            if power > 0 {
                let word = format!("{samples}");
                svg.label(Label::near(at(samples, 1e-10), &word, DVec2::Y, 5.0).title(0.8));
            }
            if power > 0 {
                let word = format!("1e−{}", 2 * power);
                svg.label(Label::near(at(1.0, variance), &word, -DVec2::X, 5.0).title(0.8));
            }
        }
        for (((word, sampler), colour), line) in Sampler::ALL.into_iter().zip([RAY, IMAGE, INK]).zip(0_u32..) {
            let level = |k: u32| mean_error(sampler, Purpose::Pixel, integrand, 1 << (2 * k), TRIALS, 17);
            let levels: Vec<MeanError> = (1..=5).map(level).collect();
            let places: Vec<DVec2> = levels.iter().map(|level| at(f64::from(level.samples), level.variance)).collect();
            for pair in places.windows(2) {
                svg.line(pair[0], pair[1], Pen::new(colour, 1.6));
            }
            places.iter().for_each(|&place| svg.dot(place, 2.6, colour));
            let (slope, half) = slope(&levels);
            let told = format!("{word} {} ± {half:.2}", format!("{slope:.2}").replace('-', "−"));
            let place = corner + DVec2::new(12.0, tall - 54.0 + 18.0 * f64::from(line));
            svg.line(place, place + DVec2::new(16.0, 0.0), Pen::new(colour, 1.6));
            svg.label(Label::near(place + DVec2::new(16.0, 0.0), &told, DVec2::X, 5.0).title(0.82).coloured(colour));
        }
        let below = at(32.0, 1e-10) + DVec2::new(0.0, 22.0);
        svg.label(Label::near(below, integrand.name, DVec2::Y, 6.0));
    }
    let foot = format!(
        "for chapter {} · {TRIALS} means a dot, slopes with 95 % intervals · cargo run --release -- figure {}",
        chapter.name, figure.name
    );
    Ok(svg.finish(figure.about, &foot))
}
