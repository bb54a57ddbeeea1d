//! Of chapters 15 to 21.

use super::{Fresh, add, cross, dot, length, over, sub, times, unit};
use pinhole_cli::checks::{
    chapter_15_reflection, chapter_16_textures, chapter_17_sampling, chapter_18_error_and_time, chapter_19_mirrors,
    chapter_20_glass, chapter_21_soft_shadows,
};
use std::f64::consts::PI;

pub fn fresh() -> Vec<Fresh> {
    vec![phong(), stripes(), tent(), variance(), mirror(), glass(), soft_shadows()]
}

/// Matte and lobe, times irradiance and cosine; of the lobe its angle's cosine is given.
fn phong_by([colour, specular, n]: [f64; 3], e: f64, cosine: f64, lobe: f64) -> f64 {
    let lobe = if lobe > 0.0 { (n + 2.0) / (2.0 * PI) * lobe.powf(n) } else { 0.0 };
    if cosine > 0.0 { (colour / PI + specular * lobe) * e * cosine } else { 0.0 }
}

fn lobe_cosine(normal: [f64; 3], light: [f64; 3], eye: [f64; 3]) -> f64 {
    dot(sub(times(normal, 2.0 * dot(normal, light)), light), eye)
}

fn phong() -> Fresh {
    use chapter_15_reflection::check::exercise;
    Fresh {
        chapter: 15,
        wrong: vec![
            (
                exercise(|m, e, n, l, v| phong_by(m, e, dot(n, l), -lobe_cosine(n, l, v))),
                "mirror direction the other way",
            ),
            (exercise(|m, e, n, l, v| phong_by(m, e, dot(n, l), dot(n, v))), "normal and eye"),
            (
                exercise(|[c, _, n], e, nn, l, v| phong_by([c, 0.0, n], e, dot(nn, l), lobe_cosine(nn, l, v))),
                "matte only",
            ),
            (
                exercise(|[_, s, n], e, nn, l, v| phong_by([0.0, s, n], e, dot(nn, l), lobe_cosine(nn, l, v))),
                "lobe only",
            ),
            (
                exercise(|[c, s, n], e, nn, l, v| {
                    let cosine = dot(nn, l);
                    let lobe = lobe_cosine(nn, l, v).max(0.0).powf(n);
                    if cosine > 0.0 { (c / PI * cosine + s * (n + 2.0) / (2.0 * PI) * lobe) * e } else { 0.0 }
                }),
                "no cosine on the lobe",
            ),
            (
                exercise(|[c, s, n], e, nn, l, v| {
                    let cosine = dot(nn, l);
                    let lobe = lobe_cosine(nn, l, v).max(0.0).powf(n);
                    if cosine > 0.0 { (c + s * (n + 2.0) / (2.0 * PI) * lobe) * e * cosine } else { 0.0 }
                }),
                "matte not divided by π",
            ),
            (
                exercise(|[c, s, n], e, nn, l, v| {
                    let cosine = dot(nn, l);
                    let lobe = lobe_cosine(nn, l, v).abs().powf(n);
                    if cosine > 0.0 { (c / PI + s * (n + 2.0) / (2.0 * PI) * lobe) * e * cosine } else { 0.0 }
                }),
                "lobe's cosine absolute",
            ),
            (
                exercise(|[c, s, n], e, nn, l, v| {
                    let cosine = dot(nn, l);
                    let lobe = lobe_cosine(nn, l, v).max(0.0).powf(n);
                    if cosine > 0.0 { (c / PI + s * (n + 8.0) / (8.0 * PI) * lobe) * e * cosine } else { 0.0 }
                }),
                "Blinn's (n + 8) / 8π",
            ),
            (
                exercise(|[c, s, n], e, nn, l, v| {
                    let cosine = dot(nn, l);
                    let lobe = lobe_cosine(nn, l, v).max(0.0);
                    if cosine > 0.0 { (c / PI + s * (n + 2.0) / (2.0 * PI) * lobe * n) * e * cosine } else { 0.0 }
                }),
                "times n instead of to the power",
            ),
            (
                exercise(|[c, s, n], e, nn, l, v| {
                    let cosine = dot(nn, l);
                    let lobe = lobe_cosine(nn, l, v).max(0.0).powf(n);
                    if cosine > 0.0 { c / PI * s * (n + 2.0) / (2.0 * PI) * lobe * e * cosine } else { 0.0 }
                }),
                "multiplied",
            ),
            (
                exercise(|[c, s, n], e, nn, l, v| phong_by([c, s, n / 2.0], e, dot(nn, l), lobe_cosine(nn, l, v))),
                "half the exponent",
            ),
            (exercise(|m, _, n, l, v| phong_by(m, 1.0, dot(n, l), lobe_cosine(n, l, v))), "irradiance left out"),
        ],
        right: vec![
            exercise(|[c, s, n], e, nn, l, v| {
                let (facing, alpha) = (dot(nn, l), 2.0 * dot(nn, l) * dot(nn, v) - dot(l, v));
                if facing <= 0.0 {
                    return 0.0;
                }
                let highlight = if alpha <= 0.0 { 0.0 } else { (n * alpha.ln()).exp() * (0.5 * n + 1.0) };
                facing * e * (c + s * highlight) / PI
            }),
            exercise(|m, e, n, l, v| {
                let mirrored_eye = sub(times(n, 2.0 * dot(n, v)), v);
                phong_by(m, e, dot(n, l), dot(mirrored_eye, l))
            }),
        ],
    }
}

/// The integral of the stripes from 0.
fn area(x: f64) -> f64 {
    1.0 - (x.rem_euclid(2.0) - 1.0).abs()
}

fn stripe(x: f64) -> f64 {
    if x.floor().rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 }
}

fn mean(x: f64, w: f64) -> f64 {
    if w == 0.0 { stripe(x) } else { (area(x + w / 2.0) - area(x - w / 2.0)) / w }
}

fn stripes() -> Fresh {
    use chapter_16_textures::check::exercise;
    Fresh {
        chapter: 16,
        wrong: vec![
            (exercise(|x, w| mean(x, 2.0 * w)), "width on both sides"),
            (exercise(|x, w| (stripe(x - w / 2.0) + stripe(x + w / 2.0)) / 2.0), "mean of both ends"),
            (
                exercise(|x, w| if w == 0.0 { stripe(x) } else { area(x + w / 2.0) - area(x - w / 2.0) }),
                "not divided by the width",
            ),
            (exercise(|x, w| mean(x + w / 2.0, w)), "from x on"),
            (
                exercise(|x, w| {
                    let area = |x: f64| 1.0 - (x % 2.0 - 1.0).abs();
                    if w == 0.0 { stripe(x) } else { (area(x + w / 2.0) - area(x - w / 2.0)) / w }
                }),
                "remainder of negative numbers",
            ),
            (exercise(|x, w| mean(x, w).abs()), "absolute"),
            (exercise(|x, w| -mean(x, w)), "sign"),
            (exercise(|x, w| if w >= 1.0 { 0.0 } else { mean(x, w) }), "0 from a width of 1"),
            (exercise(|x, w| (area(x + w / 2.0) - area(x - w / 2.0)) / w), "0 / 0"),
            (
                exercise(|x, w| {
                    (0..4).map(|at| stripe(x + w * (f64::from(at) + 0.5) / 4.0 - w / 2.0)).sum::<f64>() / 4.0
                }),
                "four samples",
            ),
            (exercise(|x, w| 0.5 + 0.5 * mean(x, w)), "from 0 to 1"),
            (exercise(|x, w| mean(2.0 * x, 2.0 * w)), "stripes half as wide"),
        ],
        right: vec![
            exercise(|x, w| {
                let (a, b) = (x - w / 2.0, x + w / 2.0);
                if a.floor() == b.floor() {
                    return stripe(a);
                }
                let (first, last) = (a.ceil(), b.floor());
                let whole = if (last - first).rem_euclid(2.0) == 0.0 { 0.0 } else { stripe(first) };
                (stripe(a) * (first - a) + whole + stripe(last) * (b - last)) / w
            }),
            exercise(|x, w| {
                let period = |x: f64| {
                    let inside = x - 2.0 * (x / 2.0).floor();
                    if inside < 1.0 { inside } else { 2.0 - inside }
                };
                match w {
                    0.0 => 1.0 - 2.0 * (x.floor() - 2.0 * (x.floor() / 2.0).floor()),
                    _ => (period(x + 0.5 * w) - period(x - 0.5 * w)) / w,
                }
            }),
        ],
    }
}

fn tent() -> Fresh {
    use chapter_17_sampling::check::exercise;
    Fresh {
        chapter: 17,
        wrong: vec![
            (exercise(|u, r| r * (1.0 - (1.0 - u).sqrt())), "1 - √(1 - u)"),
            (
                exercise(|u, r| r * if u < 0.5 { 1.0 - (2.0 * u).sqrt() } else { (2.0 - 2.0 * u).sqrt() - 1.0 }),
                "mirrored",
            ),
            (exercise(|u, _| if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).sqrt() }), "radius"),
            (exercise(|u, r| r * ((2.0 * u).sqrt() - 1.0)), "one half's formula for both"),
            (exercise(|u, r| r * if u < 0.5 { u.sqrt() - 1.0 } else { 1.0 - (1.0 - u).sqrt() }), "2 missing"),
            (
                exercise(|u, r| r * if u < 0.5 { 4.0 * u * u - 1.0 } else { 1.0 - (2.0 - 2.0 * u) * (2.0 - 2.0 * u) }),
                "squares for roots",
            ),
            (
                exercise(|u, r| r * if u < 0.5 { (2.0 * u).cbrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).cbrt() }),
                "cube roots",
            ),
            (exercise(|u, r| r * (1.0 - (2.0 * u - 1.0).abs())), "the tent's height"),
            (
                exercise(|u, r| 0.5 + r * if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).sqrt() }),
                "from the pixel's edge",
            ),
            (exercise(|u, r| r * (u.sqrt() - (1.0 - u).sqrt())), "roots subtracted"),
            (
                exercise(|u, r| 2.0 * r * if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).sqrt() }),
                "twice as wide",
            ),
        ],
        right: vec![
            exercise(|u, r| {
                let v = 2.0 * u - 1.0;
                r * v.signum() * (1.0 - (1.0 - v.abs()).sqrt())
            }),
            exercise(|u, r| {
                let (mut low, mut high) = (-1.0, 1.0);
                for _ in 0..200 {
                    let x: f64 = (low + high) / 2.0;
                    let below = if x < 0.0 { (1.0 + x) * (1.0 + x) / 2.0 } else { 1.0 - (1.0 - x) * (1.0 - x) / 2.0 };
                    if below < u {
                        low = x;
                    } else {
                        high = x;
                    }
                }
                r * (low + high) / 2.0
            }),
        ],
    }
}

fn mean_of(runs: &[f64]) -> f64 {
    runs.iter().sum::<f64>() / runs.len() as f64
}

fn spread(runs: &[f64], about: f64) -> f64 {
    runs.iter().map(|run| (run - about) * (run - about)).sum()
}

/// The sum over ordered pairs of two different runs.
fn pairs(runs: &[f64], truth: f64) -> f64 {
    let sum: f64 = runs.iter().map(|run| run - truth).sum();
    sum * sum - spread(runs, truth)
}

fn variance() -> Fresh {
    use chapter_18_error_and_time::check::exercise;
    fn both(runs: &[f64], of: impl Fn(&[f64], f64) -> [f64; 2]) -> Option<[f64; 2]> {
        if runs.len() < 2 { None } else { Some(of(runs, runs.len() as f64)) }
    }
    Fresh {
        chapter: 18,
        wrong: vec![
            (
                exercise(|runs, truth| {
                    both(runs, |runs, n| [spread(runs, truth) / (n - 1.0), pairs(runs, truth) / (n * (n - 1.0))])
                }),
                "variance about the truth",
            ),
            (
                exercise(|runs, truth| {
                    let of = |runs: &[f64], n: f64| {
                        [(spread(runs, mean_of(runs)) / (n - 1.0)).sqrt(), pairs(runs, truth) / (n * (n - 1.0))]
                    };
                    both(runs, of)
                }),
                "standard deviation",
            ),
            (
                exercise(|runs, truth| {
                    both(runs, |runs, n| [spread(runs, mean_of(runs)) / (n - 1.0), pairs(runs, truth)])
                }),
                "sum over the pairs",
            ),
            (
                exercise(|runs, truth| {
                    both(runs, |runs, n| [spread(runs, mean_of(runs)) / (n - 1.0), pairs(runs, truth) / (n * n)])
                }),
                "pairs over n²",
            ),
            (
                exercise(|runs, truth| {
                    let of = |runs: &[f64], n: f64| {
                        [spread(runs, mean_of(runs)) / (n - 1.0), pairs(runs, truth) / 2.0 / (n * (n - 1.0))]
                    };
                    both(runs, of)
                }),
                "each pair once, over n (n - 1)",
            ),
            (
                exercise(|runs, truth| {
                    let of = |runs: &[f64], n: f64| {
                        [pairs(runs, truth) / (n * (n - 1.0)), spread(runs, mean_of(runs)) / (n - 1.0)]
                    };
                    both(runs, of)
                }),
                "swapped",
            ),
            (
                exercise(|runs, truth| {
                    let of = |runs: &[f64], n: f64| {
                        let next: f64 = runs.windows(2).map(|two| (two[0] - truth) * (two[1] - truth)).sum();
                        [spread(runs, mean_of(runs)) / (n - 1.0), next / (n - 1.0)]
                    };
                    both(runs, of)
                }),
                "neighbours only",
            ),
            (
                exercise(|runs, truth| {
                    let of = |runs: &[f64], n: f64| {
                        [spread(runs, mean_of(runs)) / (n - 1.0) / n, pairs(runs, truth) / (n * (n - 1.0))]
                    };
                    both(runs, of)
                }),
                "variance of the mean",
            ),
            (
                exercise(|runs, truth| {
                    let of = |runs: &[f64], n: f64| {
                        let apart: f64 = runs.iter().map(|run| (run - mean_of(runs)).abs()).sum();
                        [apart / (n - 1.0), pairs(runs, truth) / (n * (n - 1.0))]
                    };
                    both(runs, of)
                }),
                "absolute distances",
            ),
            (
                exercise(|runs, truth| {
                    let of = |runs: &[f64], n: f64| [spread(runs, mean_of(runs)), pairs(runs, truth) / (n * (n - 1.0))];
                    both(runs, of)
                }),
                "sum of squares",
            ),
            (
                exercise(|runs, _| {
                    let of = |runs: &[f64], n: f64| {
                        let mean = mean_of(runs);
                        [spread(runs, mean) / (n - 1.0), pairs(runs, mean) / (n * (n - 1.0))]
                    };
                    both(runs, of)
                }),
                "pairs about the mean",
            ),
            (
                exercise(|runs, truth| {
                    let n = runs.len() as f64;
                    if runs.is_empty() {
                        return None;
                    }
                    Some([spread(runs, mean_of(runs)) / (n - 1.0), pairs(runs, truth) / (n * (n - 1.0))])
                }),
                "one run gives NaN",
            ),
        ],
        right: vec![
            exercise(|runs, truth| {
                let (mut count, mut mean, mut squares) = (0.0, 0.0, 0.0);
                for run in runs {
                    count += 1.0;
                    let before = run - mean;
                    mean += before / count;
                    squares += before * (run - mean);
                }
                if count < 2.0 {
                    return None;
                }
                let variance = squares / (count - 1.0);
                Some([variance, (mean - truth) * (mean - truth) - variance / count])
            }),
            exercise(|runs, truth| {
                let mut number = 0.0;
                let mut sum = 0.0;
                for (at, x) in runs.iter().enumerate() {
                    for y in &runs[at + 1..] {
                        sum += (x - truth) * (y - truth);
                        number += 1.0;
                    }
                }
                let half_squares: f64 =
                    runs.iter().flat_map(|x| runs.iter().map(move |y| (x - y) * (x - y) / 2.0)).sum::<f64>() / 2.0;
                (number > 0.0).then(|| [half_squares / number, sum / number])
            }),
        ],
    }
}

fn mirror() -> Fresh {
    use chapter_19_mirrors::check::exercise;
    Fresh {
        chapter: 19,
        wrong: vec![
            (exercise(|d, n| sub(d, times(n, 2.0 * dot(d, n)))), "normal not normalised"),
            (exercise(|d, n| sub(d, times(n, 2.0 * dot(d, n) / length(n)))), "divided by the length once"),
            (exercise(|d, n| sub(d, times(unit(n), dot(d, unit(n))))), "2 missing"),
            (exercise(|d, n| add(d, times(unit(n), 2.0 * dot(d, unit(n))))), "plus"),
            (exercise(|d, _| times(d, -1.0)), "straight back"),
            (exercise(|_, n| unit(n)), "the normal"),
            (exercise(|d, n| sub(d, times(unit(n), 2.0 * dot(d, unit(n)).abs()))), "absolute dot product"),
            (exercise(|d, n| sub(times(unit(n), 2.0 * dot(d, unit(n))), d)), "direction towards the light"),
            (exercise(|d, n| unit(sub(d, times(n, 2.0 * dot(d, n))))), "answer normalised instead of the normal"),
            (
                exercise(|d, n| {
                    let n = unit(n);
                    let c = dot(d, n);
                    let n = if c > 0.0 { times(n, -1.0) } else { n };
                    sub(d, times(n, 2.0 * c))
                }),
                "normal turned, cosine kept",
            ),
            (exercise(|d, n| unit(cross(d, n))), "cross product"),
            (exercise(|d, n| unit(add(d, unit(n)))), "sum of both"),
        ],
        right: vec![
            exercise(|d, n| {
                let s = 2.0 / dot(n, n);
                [0, 1, 2]
                    .map(|row| (0..3).map(|at| (f64::from(u8::from(row == at)) - s * n[row] * n[at]) * d[at]).sum())
            }),
            exercise(|d, n| {
                let n = unit(n);
                let along = cross(n, cross(d, n));
                add(along, times(n, -dot(n, d)))
            }),
        ],
    }
}

fn glass() -> Fresh {
    use chapter_20_glass::check::exercise;
    fn by(d: [f64; 3], n: [f64; 3], eta: f64, of: impl Fn(f64, f64) -> [f64; 3]) -> Option<[f64; 3]> {
        let c = -dot(d, n);
        let g2 = eta * eta - 1.0 + c * c;
        if g2 < 0.0 { None } else { Some(of(c, g2)) }
    }
    Fresh {
        chapter: 20,
        wrong: vec![
            (
                exercise(|d, n, eta| by(d, n, eta, |c, g2| add(over(d, eta), times(n, c - g2.sqrt())))),
                "second term not divided",
            ),
            (
                exercise(|d, n, eta| {
                    let c = -dot(d, n);
                    let sine = (1.0 - c * c).max(0.0).sqrt() / eta;
                    if sine > 1.0 {
                        return None;
                    }
                    Some(add(over(d, eta), times(n, c / eta - (1.0 - sine))))
                }),
                "1 - sin for cos",
            ),
            (exercise(|d, n, eta| by(d, n, eta, |c, g2| over(add(d, times(n, c - g2)), eta))), "root forgotten"),
            (exercise(|d, n, eta| by(d, n, eta, |c, g2| over(add(d, times(n, c + g2.sqrt())), eta))), "plus g"),
            (exercise(|d, n, eta| by(d, n, eta, |c, g2| add(d, times(n, c - g2.sqrt())))), "not divided at all"),
            (
                exercise(|d, n, eta| {
                    let c = -dot(d, n);
                    let g2 = eta - 1.0 + c * c;
                    if g2 < 0.0 { None } else { Some(over(add(d, times(n, c - g2.sqrt())), eta)) }
                }),
                "eta not squared",
            ),
            (
                exercise(|d, n, eta| {
                    let c = -dot(d, n);
                    let g2 = (eta * eta - 1.0 + c * c).max(0.0);
                    Some(over(add(d, times(n, c - g2.sqrt())), eta))
                }),
                "cut at 0 instead of none",
            ),
            (exercise(|d, n, eta| by(d, n, eta, |c, _| over(add(d, times(n, c - c)), eta))), "straight on, over eta"),
            (exercise(|d, n, eta| by(d, n, eta, |_, _| d)), "straight on"),
            (
                exercise(|d, n, eta| by(d, n, eta, |c, g2| over(sub(d, times(n, c - g2.sqrt())), eta))),
                "second term subtracted",
            ),
            (
                exercise(|d, n, eta| {
                    let c = -dot(d, n);
                    let g2 = eta * eta - 1.0 + c;
                    if g2 < 0.0 { None } else { Some(over(add(d, times(n, c - g2.sqrt())), eta)) }
                }),
                "cosine not squared",
            ),
            (
                exercise(|d, n, eta| {
                    if eta < 1.0 {
                        return None;
                    }
                    by(d, n, eta, |c, g2| over(add(d, times(n, c - g2.sqrt())), eta))
                }),
                "none into the thinner medium",
            ),
            (exercise(|d, n, eta| by(d, n, eta, |c, g2| unit(add(d, times(n, c - g2.sqrt() / eta))))), "normalised"),
        ],
        right: vec![
            exercise(|d, n, eta| {
                let along = add(d, times(n, -dot(d, n)));
                let across = over(along, eta);
                let rest = 1.0 - dot(across, across);
                (rest >= 0.0).then(|| sub(across, times(n, rest.sqrt())))
            }),
            exercise(|d, n, eta| {
                let r = 1.0 / eta;
                let cos_i = -dot(n, d);
                let sin2_t = r * r * (1.0 - cos_i * cos_i);
                if sin2_t > 1.0 {
                    return None;
                }
                let cos_t = (1.0 - sin2_t).sqrt();
                let mut out = times(d, r);
                for at in 0..3 {
                    out[at] += (r * cos_i - cos_t) * n[at];
                }
                Some(out)
            }),
        ],
    }
}

fn soft_shadows() -> Fresh {
    use chapter_21_soft_shadows::check::exercise;
    fn by(from: [f64; 3], at: [f64; 3], n: [f64; 3], of: impl Fn(f64, f64) -> f64) -> f64 {
        let v = sub(from, at);
        let (d, c) = (length(v), dot(unit(v), n));
        if c == 0.0 { 0.0 } else { of(d, c) }
    }
    Fresh {
        chapter: 21,
        wrong: vec![
            (exercise(|f, at, n, a| by(f, at, n, |d, c| d * d / (c * a))), "cosine's sign"),
            (exercise(|f, at, n, a| by(f, at, n, |d, c| if c > 0.0 { d * d / (c * a) } else { 0.0 })), "one side"),
            (exercise(|f, at, n, a| by(f, at, n, |d, c| d / (c.abs() * a))), "distance not squared"),
            (exercise(|f, at, n, a| by(f, at, n, |d, c| d * d * c.abs() / a)), "times the cosine"),
            (exercise(|f, at, n, a| by(f, at, n, |d, c| a * c.abs() / (d * d))), "solid angle"),
            (exercise(|f, at, n, _| by(f, at, n, |d, c| d * d / c.abs())), "area left out"),
            (exercise(|f, at, n, a| by(f, at, n, |d, c| d * d / (c.abs() * a * PI))), "over π"),
            (exercise(|f, at, n, a| by(f, at, n, |d, c| d * d / (c.abs() * a * 2.0))), "both sides' area"),
            (exercise(|f, at, n, a| by(f, at, n, |d, c| d * d / (c * c * a))), "cosine squared"),
            (exercise(|_, _, _, a| 1.0 / a), "pdf per area"),
            (exercise(|f, at, n, a| by(f, at, n, |d, _| d * d / a)), "no cosine"),
            (
                exercise(|f, at, n, a| {
                    let v = sub(f, at);
                    dot(v, v) / (dot(v, n).abs() * a)
                }),
                "dot product of what is not normalised",
            ),
            (
                exercise(|f, at, n, a| {
                    let v = sub(f, at);
                    dot(v, v) / (dot(unit(v), n).abs() * a)
                }),
                "infinite at the edge",
            ),
            (exercise(|f, at, n, a| by(f, at, n, |d, c| d * d / ((1.0 - c * c).sqrt() * a))), "sine"),
        ],
        right: vec![
            exercise(|f, at, n, a| {
                let v = sub(at, f);
                let facing = dot(v, n).abs();
                if facing > 0.0 { dot(v, v).powf(1.5) / (facing * a) } else { 0.0 }
            }),
            exercise(|f, at, n, a| {
                let d2: f64 = f.iter().zip(at).map(|(f, at)| (f - at) * (f - at)).sum();
                let projected = a * dot(sub(f, at), n).abs() / d2.sqrt();
                if projected == 0.0 { 0.0 } else { (projected / d2).recip() }
            }),
        ],
    }
}
