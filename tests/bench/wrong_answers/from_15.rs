//! Of chapters 15 to 21.

use super::{Fresh, add, cross, dot, fresh, length, over, sub, times, unit};
use pinhole_cli::checks::{
    chapter_15_reflection, chapter_16_textures, chapter_17_sampling, chapter_18_error_and_time, chapter_19_mirrors,
    chapter_20_glass, chapter_21_soft_shadows,
};
use std::f64::consts::PI;

pub fn all() -> Vec<Fresh> {
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
    fresh(
        15,
        exercise,
        &[
            ("mirror direction the other way", |m, e, n, l, v| phong_by(m, e, dot(n, l), -lobe_cosine(n, l, v))),
            ("normal and eye", |m, e, n, l, v| phong_by(m, e, dot(n, l), dot(n, v))),
            ("matte only", |[c, _, n], e, nn, l, v| phong_by([c, 0.0, n], e, dot(nn, l), lobe_cosine(nn, l, v))),
            ("lobe only", |[_, s, n], e, nn, l, v| phong_by([0.0, s, n], e, dot(nn, l), lobe_cosine(nn, l, v))),
            ("no cosine on the lobe", |[c, s, n], e, nn, l, v| {
                let cosine = dot(nn, l);
                let lobe = lobe_cosine(nn, l, v).max(0.0).powf(n);
                if cosine > 0.0 { (c / PI * cosine + s * (n + 2.0) / (2.0 * PI) * lobe) * e } else { 0.0 }
            }),
            ("matte not divided by π", |[c, s, n], e, nn, l, v| {
                let cosine = dot(nn, l);
                let lobe = lobe_cosine(nn, l, v).max(0.0).powf(n);
                if cosine > 0.0 { (c + s * (n + 2.0) / (2.0 * PI) * lobe) * e * cosine } else { 0.0 }
            }),
            ("lobe's cosine absolute", |[c, s, n], e, nn, l, v| {
                let cosine = dot(nn, l);
                let lobe = lobe_cosine(nn, l, v).abs().powf(n);
                if cosine > 0.0 { (c / PI + s * (n + 2.0) / (2.0 * PI) * lobe) * e * cosine } else { 0.0 }
            }),
            ("Blinn's (n + 8) / 8π", |[c, s, n], e, nn, l, v| {
                let cosine = dot(nn, l);
                let lobe = lobe_cosine(nn, l, v).max(0.0).powf(n);
                if cosine > 0.0 { (c / PI + s * (n + 8.0) / (8.0 * PI) * lobe) * e * cosine } else { 0.0 }
            }),
            ("times n instead of to the power", |[c, s, n], e, nn, l, v| {
                let cosine = dot(nn, l);
                let lobe = lobe_cosine(nn, l, v).max(0.0);
                if cosine > 0.0 { (c / PI + s * (n + 2.0) / (2.0 * PI) * lobe * n) * e * cosine } else { 0.0 }
            }),
            ("multiplied", |[c, s, n], e, nn, l, v| {
                let cosine = dot(nn, l);
                let lobe = lobe_cosine(nn, l, v).max(0.0).powf(n);
                if cosine > 0.0 { c / PI * s * (n + 2.0) / (2.0 * PI) * lobe * e * cosine } else { 0.0 }
            }),
            ("half the exponent", |[c, s, n], e, nn, l, v| {
                phong_by([c, s, n / 2.0], e, dot(nn, l), lobe_cosine(nn, l, v))
            }),
            ("irradiance left out", |m, _, n, l, v| phong_by(m, 1.0, dot(n, l), lobe_cosine(n, l, v))),
            ("2: lobe times the colour", |[c, s, n], e, nn, l, v| {
                phong_by([c, s * c, n], e, dot(nn, l), lobe_cosine(nn, l, v))
            }),
            ("2: matte times 1 - specular", |[c, s, n], e, nn, l, v| {
                phong_by([c * (1.0 - s), s, n], e, dot(nn, l), lobe_cosine(nn, l, v))
            }),
        ],
        &[
            |[c, s, n], e, nn, l, v| {
                let (facing, alpha) = (dot(nn, l), 2.0 * dot(nn, l) * dot(nn, v) - dot(l, v));
                if facing <= 0.0 {
                    return 0.0;
                }
                let highlight = if alpha <= 0.0 { 0.0 } else { (n * alpha.ln()).exp() * (0.5 * n + 1.0) };
                facing * e * (c + s * highlight) / PI
            },
            |m, e, n, l, v| {
                let mirrored_eye = sub(times(n, 2.0 * dot(n, v)), v);
                phong_by(m, e, dot(n, l), dot(mirrored_eye, l))
            },
        ],
    )
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
    fresh(
        16,
        exercise,
        &[
            ("width on both sides", |x, w| mean(x, 2.0 * w)),
            ("mean of both ends", |x, w| (stripe(x - w / 2.0) + stripe(x + w / 2.0)) / 2.0),
            (
                "not divided by the width",
                |x, w| if w == 0.0 { stripe(x) } else { area(x + w / 2.0) - area(x - w / 2.0) },
            ),
            ("from x on", |x, w| mean(x + w / 2.0, w)),
            ("remainder of negative numbers", |x, w| {
                let area = |x: f64| 1.0 - (x % 2.0 - 1.0).abs();
                if w == 0.0 { stripe(x) } else { (area(x + w / 2.0) - area(x - w / 2.0)) / w }
            }),
            ("absolute", |x, w| mean(x, w).abs()),
            ("sign", |x, w| -mean(x, w)),
            ("0 from a width of 1", |x, w| if w >= 1.0 { 0.0 } else { mean(x, w) }),
            ("0 / 0", |x, w| (area(x + w / 2.0) - area(x - w / 2.0)) / w),
            ("four samples", |x, w| {
                (0..4).map(|at| stripe(x + w * (f64::from(at) + 0.5) / 4.0 - w / 2.0)).sum::<f64>() / 4.0
            }),
            ("from 0 to 1", |x, w| 0.5 + 0.5 * mean(x, w)),
            ("stripes half as wide", |x, w| mean(2.0 * x, 2.0 * w)),
            ("2: only the sign of the mean", |x, w| if mean(x, w) >= 0.0 { 1.0 } else { -1.0 }),
            ("2: half the width as a whole number", |x, w| {
                let half = (w / 2.0).floor();
                if half == 0.0 { stripe(x) } else { (area(x + half) - area(x - half)) / (2.0 * half) }
            }),
        ],
        &[
            |x, w| {
                let (a, b) = (x - w / 2.0, x + w / 2.0);
                if a.floor() == b.floor() {
                    return stripe(a);
                }
                let (first, last) = (a.ceil(), b.floor());
                let whole = if (last - first).rem_euclid(2.0) == 0.0 { 0.0 } else { stripe(first) };
                (stripe(a) * (first - a) + whole + stripe(last) * (b - last)) / w
            },
            |x, w| {
                let period = |x: f64| {
                    let inside = x - 2.0 * (x / 2.0).floor();
                    if inside < 1.0 { inside } else { 2.0 - inside }
                };
                match w {
                    0.0 => 1.0 - 2.0 * (x.floor() - 2.0 * (x.floor() / 2.0).floor()),
                    _ => (period(x + 0.5 * w) - period(x - 0.5 * w)) / w,
                }
            },
        ],
    )
}

fn tent() -> Fresh {
    use chapter_17_sampling::check::exercise;
    fresh(
        17,
        exercise,
        &[
            ("1 - √(1 - u)", |u, r| r * (1.0 - (1.0 - u).sqrt())),
            ("mirrored", |u, r| r * if u < 0.5 { 1.0 - (2.0 * u).sqrt() } else { (2.0 - 2.0 * u).sqrt() - 1.0 }),
            ("radius", |u, _| if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).sqrt() }),
            ("one half's formula for both", |u, r| r * ((2.0 * u).sqrt() - 1.0)),
            ("2 missing", |u, r| r * if u < 0.5 { u.sqrt() - 1.0 } else { 1.0 - (1.0 - u).sqrt() }),
            ("squares for roots", |u, r| {
                r * if u < 0.5 { 4.0 * u * u - 1.0 } else { 1.0 - (2.0 - 2.0 * u) * (2.0 - 2.0 * u) }
            }),
            ("cube roots", |u, r| r * if u < 0.5 { (2.0 * u).cbrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).cbrt() }),
            ("the tent's height", |u, r| r * (1.0 - (2.0 * u - 1.0).abs())),
            ("from the pixel's edge", |u, r| {
                0.5 + r * if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).sqrt() }
            }),
            ("roots subtracted", |u, r| r * (u.sqrt() - (1.0 - u).sqrt())),
            ("twice as wide", |u, r| {
                2.0 * r * if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).sqrt() }
            }),
            ("2: right half from the centre", |u, r| {
                r * if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { (2.0 * u - 1.0).sqrt() }
            }),
            ("2: square with its sign", |u, r| r * (2.0 * u - 1.0) * (2.0 * u - 1.0).abs()),
        ],
        &[
            |u, r| {
                let v = 2.0 * u - 1.0;
                r * v.signum() * (1.0 - (1.0 - v.abs()).sqrt())
            },
            |u, r| {
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
            },
        ],
    )
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
    fresh(
        18,
        exercise,
        &[
            ("variance about the truth", |runs, truth| {
                both(runs, |runs, n| [spread(runs, truth) / (n - 1.0), pairs(runs, truth) / (n * (n - 1.0))])
            }),
            ("standard deviation", |runs, truth| {
                let of = |runs: &[f64], n: f64| {
                    [(spread(runs, mean_of(runs)) / (n - 1.0)).sqrt(), pairs(runs, truth) / (n * (n - 1.0))]
                };
                both(runs, of)
            }),
            ("sum over the pairs", |runs, truth| {
                both(runs, |runs, n| [spread(runs, mean_of(runs)) / (n - 1.0), pairs(runs, truth)])
            }),
            ("pairs over n²", |runs, truth| {
                both(runs, |runs, n| [spread(runs, mean_of(runs)) / (n - 1.0), pairs(runs, truth) / (n * n)])
            }),
            ("each pair once, over n (n - 1)", |runs, truth| {
                let of = |runs: &[f64], n: f64| {
                    [spread(runs, mean_of(runs)) / (n - 1.0), pairs(runs, truth) / 2.0 / (n * (n - 1.0))]
                };
                both(runs, of)
            }),
            ("swapped", |runs, truth| {
                let of = |runs: &[f64], n: f64| {
                    [pairs(runs, truth) / (n * (n - 1.0)), spread(runs, mean_of(runs)) / (n - 1.0)]
                };
                both(runs, of)
            }),
            ("neighbours only", |runs, truth| {
                let of = |runs: &[f64], n: f64| {
                    let next: f64 = runs.windows(2).map(|two| (two[0] - truth) * (two[1] - truth)).sum();
                    [spread(runs, mean_of(runs)) / (n - 1.0), next / (n - 1.0)]
                };
                both(runs, of)
            }),
            ("variance of the mean", |runs, truth| {
                let of = |runs: &[f64], n: f64| {
                    [spread(runs, mean_of(runs)) / (n - 1.0) / n, pairs(runs, truth) / (n * (n - 1.0))]
                };
                both(runs, of)
            }),
            ("absolute distances", |runs, truth| {
                let of = |runs: &[f64], n: f64| {
                    let apart: f64 = runs.iter().map(|run| (run - mean_of(runs)).abs()).sum();
                    [apart / (n - 1.0), pairs(runs, truth) / (n * (n - 1.0))]
                };
                both(runs, of)
            }),
            ("sum of squares", |runs, truth| {
                let of = |runs: &[f64], n: f64| [spread(runs, mean_of(runs)), pairs(runs, truth) / (n * (n - 1.0))];
                both(runs, of)
            }),
            ("pairs about the mean", |runs, _| {
                let of = |runs: &[f64], n: f64| {
                    let mean = mean_of(runs);
                    [spread(runs, mean) / (n - 1.0), pairs(runs, mean) / (n * (n - 1.0))]
                };
                both(runs, of)
            }),
            ("one run gives NaN", |runs, truth| {
                let n = runs.len() as f64;
                if runs.is_empty() {
                    return None;
                }
                Some([spread(runs, mean_of(runs)) / (n - 1.0), pairs(runs, truth) / (n * (n - 1.0))])
            }),
            ("2: about the median", |runs, truth| {
                both(runs, |runs, n| {
                    let mut sorted = runs.to_vec();
                    sorted.sort_by(f64::total_cmp);
                    [spread(runs, sorted[sorted.len() / 2]) / (n - 1.0), pairs(runs, truth) / (n * (n - 1.0))]
                })
            }),
            ("2: absolute distances in the pairs", |runs, truth| {
                both(runs, |runs, n| {
                    let sum: f64 = runs.iter().map(|run| (run - truth).abs()).sum();
                    [spread(runs, mean_of(runs)) / (n - 1.0), (sum * sum - spread(runs, truth)) / (n * (n - 1.0))]
                })
            }),
        ],
        &[
            |runs, truth| {
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
            },
            |runs, truth| {
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
            },
        ],
    )
}

fn mirror() -> Fresh {
    use chapter_19_mirrors::check::exercise;
    fresh(
        19,
        exercise,
        &[
            ("normal not normalised", |d, n| sub(d, times(n, 2.0 * dot(d, n)))),
            ("divided by the length once", |d, n| sub(d, times(n, 2.0 * dot(d, n) / length(n)))),
            ("2 missing", |d, n| sub(d, times(unit(n), dot(d, unit(n))))),
            ("plus", |d, n| add(d, times(unit(n), 2.0 * dot(d, unit(n))))),
            ("straight back", |d, _| times(d, -1.0)),
            ("the normal", |_, n| unit(n)),
            ("absolute dot product", |d, n| sub(d, times(unit(n), 2.0 * dot(d, unit(n)).abs()))),
            ("direction towards the light", |d, n| sub(times(unit(n), 2.0 * dot(d, unit(n))), d)),
            ("answer normalised instead of the normal", |d, n| unit(sub(d, times(n, 2.0 * dot(d, n))))),
            ("normal turned, cosine kept", |d, n| {
                let n = unit(n);
                let c = dot(d, n);
                let n = if c > 0.0 { times(n, -1.0) } else { n };
                sub(d, times(n, 2.0 * c))
            }),
            ("cross product", |d, n| unit(cross(d, n))),
            ("sum of both", |d, n| unit(add(d, unit(n)))),
            ("2: only the normal's largest part is turned", |d, n| {
                let most = (0..3).max_by(|&a, &b| n[a].abs().total_cmp(&n[b].abs())).unwrap_or(0);
                let mut out = d;
                out[most] = -out[most];
                out
            }),
            ("2: no dot product", |d, n| sub(d, times(unit(n), 2.0))),
        ],
        &[
            |d, n| {
                let s = 2.0 / dot(n, n);
                [0, 1, 2]
                    .map(|row| (0..3).map(|at| (f64::from(u8::from(row == at)) - s * n[row] * n[at]) * d[at]).sum())
            },
            |d, n| {
                let n = unit(n);
                let along = cross(n, cross(d, n));
                add(along, times(n, -dot(n, d)))
            },
        ],
    )
}

fn glass() -> Fresh {
    use chapter_20_glass::check::exercise;
    fn by(d: [f64; 3], n: [f64; 3], eta: f64, of: impl Fn(f64, f64) -> [f64; 3]) -> Option<[f64; 3]> {
        let c = -dot(d, n);
        let g2 = eta * eta - 1.0 + c * c;
        if g2 < 0.0 { None } else { Some(of(c, g2)) }
    }
    fresh(
        20,
        exercise,
        &[
            ("second term not divided", |d, n, eta| by(d, n, eta, |c, g2| add(over(d, eta), times(n, c - g2.sqrt())))),
            ("1 - sin for cos", |d, n, eta| {
                let c = -dot(d, n);
                let sine = (1.0 - c * c).max(0.0).sqrt() / eta;
                if sine > 1.0 {
                    return None;
                }
                Some(add(over(d, eta), times(n, c / eta - (1.0 - sine))))
            }),
            ("root forgotten", |d, n, eta| by(d, n, eta, |c, g2| over(add(d, times(n, c - g2)), eta))),
            ("plus g", |d, n, eta| by(d, n, eta, |c, g2| over(add(d, times(n, c + g2.sqrt())), eta))),
            ("not divided at all", |d, n, eta| by(d, n, eta, |c, g2| add(d, times(n, c - g2.sqrt())))),
            ("eta not squared", |d, n, eta| {
                let c = -dot(d, n);
                let g2 = eta - 1.0 + c * c;
                if g2 < 0.0 { None } else { Some(over(add(d, times(n, c - g2.sqrt())), eta)) }
            }),
            ("cut at 0 instead of none", |d, n, eta| {
                let c = -dot(d, n);
                let g2 = (eta * eta - 1.0 + c * c).max(0.0);
                Some(over(add(d, times(n, c - g2.sqrt())), eta))
            }),
            ("straight on, over eta", |d, n, eta| by(d, n, eta, |c, _| over(add(d, times(n, c - c)), eta))),
            ("straight on", |d, n, eta| by(d, n, eta, |_, _| d)),
            ("second term subtracted", |d, n, eta| by(d, n, eta, |c, g2| over(sub(d, times(n, c - g2.sqrt())), eta))),
            ("cosine not squared", |d, n, eta| {
                let c = -dot(d, n);
                let g2 = eta * eta - 1.0 + c;
                if g2 < 0.0 { None } else { Some(over(add(d, times(n, c - g2.sqrt())), eta)) }
            }),
            ("none into the thinner medium", |d, n, eta| {
                if eta < 1.0 {
                    return None;
                }
                by(d, n, eta, |c, g2| over(add(d, times(n, c - g2.sqrt())), eta))
            }),
            ("normalised", |d, n, eta| by(d, n, eta, |c, g2| unit(add(d, times(n, c - g2.sqrt() / eta))))),
            ("2: mixed with the normal", |d, n, eta| {
                by(d, n, eta, |_, _| unit(sub(times(d, 1.0 / eta), times(n, 1.0 - 1.0 / eta))))
            }),
            ("2: arguments swapped", |d, n, eta| by(n, d, eta, |c, g2| over(add(n, times(d, c - g2.sqrt())), eta))),
        ],
        &[
            |d, n, eta| {
                let along = add(d, times(n, -dot(d, n)));
                let across = over(along, eta);
                let rest = 1.0 - dot(across, across);
                (rest >= 0.0).then(|| sub(across, times(n, rest.sqrt())))
            },
            |d, n, eta| {
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
            },
        ],
    )
}

fn soft_shadows() -> Fresh {
    use chapter_21_soft_shadows::check::exercise;
    fn by(from: [f64; 3], at: [f64; 3], n: [f64; 3], of: impl Fn(f64, f64) -> f64) -> f64 {
        let v = sub(from, at);
        let (d, c) = (length(v), dot(unit(v), n));
        if c == 0.0 { 0.0 } else { of(d, c) }
    }
    fresh(
        21,
        exercise,
        &[
            ("cosine's sign", |f, at, n, a| by(f, at, n, |d, c| d * d / (c * a))),
            ("one side", |f, at, n, a| by(f, at, n, |d, c| if c > 0.0 { d * d / (c * a) } else { 0.0 })),
            ("distance not squared", |f, at, n, a| by(f, at, n, |d, c| d / (c.abs() * a))),
            ("times the cosine", |f, at, n, a| by(f, at, n, |d, c| d * d * c.abs() / a)),
            ("solid angle", |f, at, n, a| by(f, at, n, |d, c| a * c.abs() / (d * d))),
            ("area left out", |f, at, n, _| by(f, at, n, |d, c| d * d / c.abs())),
            ("over π", |f, at, n, a| by(f, at, n, |d, c| d * d / (c.abs() * a * PI))),
            ("both sides' area", |f, at, n, a| by(f, at, n, |d, c| d * d / (c.abs() * a * 2.0))),
            ("cosine squared", |f, at, n, a| by(f, at, n, |d, c| d * d / (c * c * a))),
            ("pdf per area", |_, _, _, a| 1.0 / a),
            ("no cosine", |f, at, n, a| by(f, at, n, |d, _| d * d / a)),
            ("dot product of what is not normalised", |f, at, n, a| {
                let v = sub(f, at);
                dot(v, v) / (dot(v, n).abs() * a)
            }),
            ("infinite at the edge", |f, at, n, a| {
                let v = sub(f, at);
                dot(v, v) / (dot(unit(v), n).abs() * a)
            }),
            ("sine", |f, at, n, a| by(f, at, n, |d, c| d * d / ((1.0 - c * c).sqrt() * a))),
            ("2: the light's place as a direction", |f, at, n, a| {
                let d2 = dot(sub(f, at), sub(f, at));
                let c = dot(unit(at), n).abs();
                if c > 0.0 { d2 / (c * a) } else { 0.0 }
            }),
            ("2: area taken for a radius", |f, at, n, a| by(f, at, n, |d, c| d * d / (c.abs() * PI * a * a))),
        ],
        &[
            |f, at, n, a| {
                let v = sub(at, f);
                let facing = dot(v, n).abs();
                if facing > 0.0 { dot(v, v).powf(1.5) / (facing * a) } else { 0.0 }
            },
            |f, at, n, a| {
                let d2: f64 = f.iter().zip(at).map(|(f, at)| (f - at) * (f - at)).sum();
                let projected = a * dot(sub(f, at), n).abs() / d2.sqrt();
                if projected == 0.0 { 0.0 } else { (projected / d2).recip() }
            },
        ],
    )
}
