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
            ("the mirrored direction points into the surface", |m, e, n, l, v| {
                phong_by(m, e, dot(n, l), -lobe_cosine(n, l, v))
            }),
            ("the highlight is about the normal", |m, e, n, l, v| phong_by(m, e, dot(n, l), dot(n, v))),
            ("the highlight is left out", |[c, _, n], e, nn, l, v| {
                phong_by([c, 0.0, n], e, dot(nn, l), lobe_cosine(nn, l, v))
            }),
            ("the matte part is left out", |[_, s, n], e, nn, l, v| {
                phong_by([0.0, s, n], e, dot(nn, l), lobe_cosine(nn, l, v))
            }),
            ("the cosine is forgotten in the highlight", |[c, s, n], e, nn, l, v| {
                let cosine = dot(nn, l);
                let lobe = lobe_cosine(nn, l, v).max(0.0).powf(n);
                if cosine > 0.0 { (c / PI * cosine + s * (n + 2.0) / (2.0 * PI) * lobe) * e } else { 0.0 }
            }),
            ("Second, 0 to the power 0 is taken for 1", |[c, s, n], e, nn, l, v| {
                let cosine = dot(nn, l);
                let lobe = lobe_cosine(nn, l, v).max(0.0).powf(n);
                if cosine > 0.0 { (c + s * (n + 2.0) / (2.0 * PI) * lobe) * e * cosine } else { 0.0 }
            }),
            ("more than 90° from the mirrored light there is no highlight, also wher", |[c, s, n], e, nn, l, v| {
                let cosine = dot(nn, l);
                let lobe = lobe_cosine(nn, l, v).abs().powf(n);
                if cosine > 0.0 { (c / PI + s * (n + 2.0) / (2.0 * PI) * lobe) * e * cosine } else { 0.0 }
            }),
            ("the factor of the highlight is another one", |[c, s, n], e, nn, l, v| {
                let cosine = dot(nn, l);
                let lobe = lobe_cosine(nn, l, v).max(0.0).powf(n);
                if cosine > 0.0 { (c / PI + s * (n + 8.0) / (8.0 * PI) * lobe) * e * cosine } else { 0.0 }
            }),
            ("cos α is multiplied by the exponent", |[c, s, n], e, nn, l, v| {
                let cosine = dot(nn, l);
                let lobe = lobe_cosine(nn, l, v).max(0.0);
                if cosine > 0.0 { (c / PI + s * (n + 2.0) / (2.0 * PI) * lobe * n) * e * cosine } else { 0.0 }
            }),
            ("the matte part is multiplied by the highlight", |[c, s, n], e, nn, l, v| {
                let cosine = dot(nn, l);
                let lobe = lobe_cosine(nn, l, v).max(0.0).powf(n);
                if cosine > 0.0 { c / PI * s * (n + 2.0) / (2.0 * PI) * lobe * e * cosine } else { 0.0 }
            }),
            ("`exponent` is halved", |[c, s, n], e, nn, l, v| {
                phong_by([c, s, n / 2.0], e, dot(nn, l), lobe_cosine(nn, l, v))
            }),
            ("the irradiance is left out", |m, _, n, l, v| phong_by(m, 1.0, dot(n, l), lobe_cosine(n, l, v))),
            ("the highlight has the colour, too", |[c, s, n], e, nn, l, v| {
                phong_by([c, s * c, n], e, dot(nn, l), lobe_cosine(nn, l, v))
            }),
            ("one part is lessened by what the other reflects", |[c, s, n], e, nn, l, v| {
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
            ("the range reaches width to either side of x, which is twice as wide as", |x, w| mean(x, 2.0 * w)),
            ("only a few points of the range are looked at", |x, w| (stripe(x - w / 2.0) + stripe(x + w / 2.0)) / 2.0),
            ("this is the area", |x, w| if w == 0.0 { stripe(x) } else { area(x + w / 2.0) - area(x - w / 2.0) }),
            ("the range reaches from x to x + width", |x, w| mean(x + w / 2.0, w)),
            ("below 0 the remainder or the cast has the wrong sign", |x, w| {
                let area = |x: f64| 1.0 - (x % 2.0 - 1.0).abs();
                if w == 0.0 { stripe(x) } else { (area(x + w / 2.0) - area(x - w / 2.0)) / w }
            }),
            ("the mean has lost its sign", |x, w| mean(x, w).abs()),
            ("odd stripes count as 1 and even ones as −1", |x, w| -mean(x, w)),
            ("wide ranges are given 0", |x, w| if w >= 1.0 { 0.0 } else { mean(x, w) }),
            ("a range without width has no mean by division", |x, w| (area(x + w / 2.0) - area(x - w / 2.0)) / w),
            ("the range is sampled at many points", |x, w| {
                (0..4).map(|at| stripe(x + w * (f64::from(at) + 0.5) / 4.0 - w / 2.0)).sum::<f64>() / 4.0
            }),
            ("odd stripes count as 0", |x, w| 0.5 + 0.5 * mean(x, w)),
            ("a stripe is taken to be half as wide", |x, w| mean(2.0 * x, 2.0 * w)),
            (
                "the mean is rounded to the stripe that there is more of",
                |x, w| if mean(x, w) >= 0.0 { 1.0 } else { -1.0 },
            ),
            (/* half the width as a whole number */ "", |x, w| {
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
            ("all samples land on one side", |u, r| r * (1.0 - (1.0 - u).sqrt())),
            ("left and right are swapped", |u, r| {
                r * if u < 0.5 { 1.0 - (2.0 * u).sqrt() } else { (2.0 - 2.0 * u).sqrt() - 1.0 }
            }),
            (
                "the radius is left out",
                |u, _| if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).sqrt() },
            ),
            ("the left slope goes on beyond the centre", |u, r| r * ((2.0 * u).sqrt() - 1.0)),
            ("the 2 under the root is another number", |u, r| {
                r * if u < 0.5 { u.sqrt() - 1.0 } else { 1.0 - (1.0 - u).sqrt() }
            }),
            ("the square root is missing", |u, r| {
                r * if u < 0.5 { 4.0 * u * u - 1.0 } else { 1.0 - (2.0 - 2.0 * u) * (2.0 - 2.0 * u) }
            }),
            ("the cube root is taken", |u, r| {
                r * if u < 0.5 { (2.0 * u).cbrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).cbrt() }
            }),
            ("this is how high the tent is, not the place up to which its area is u", |u, r| {
                r * (1.0 - (2.0 * u - 1.0).abs())
            }),
            ("the place is counted from the pixel's edge", |u, r| {
                0.5 + r * if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).sqrt() }
            }),
            ("the root of what is left to 1 is subtracted from that of u", |u, r| r * (u.sqrt() - (1.0 - u).sqrt())),
            ("the radius is doubled", |u, r| {
                2.0 * r * if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 - 2.0 * u).sqrt() }
            }),
            ("the right half is not the mirror image of the left one", |u, r| {
                r * if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { (2.0 * u - 1.0).sqrt() }
            }),
            ("squares draw the samples to the centre too strongly", |u, r| r * (2.0 * u - 1.0) * (2.0 * u - 1.0).abs()),
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
            ("the variance is taken about the truth", |runs, truth| {
                both(runs, |runs, n| [spread(runs, truth) / (n - 1.0), pairs(runs, truth) / (n * (n - 1.0))])
            }),
            ("this is the standard deviation", |runs, truth| {
                let of = |runs: &[f64], n: f64| {
                    [(spread(runs, mean_of(runs)) / (n - 1.0)).sqrt(), pairs(runs, truth) / (n * (n - 1.0))]
                };
                both(runs, of)
            }),
            ("the pairs are miscounted", |runs, truth| {
                both(runs, |runs, n| [spread(runs, mean_of(runs)) / (n - 1.0), pairs(runs, truth)])
            }),
            ("the pairs are miscounted", |runs, truth| {
                both(runs, |runs, n| [spread(runs, mean_of(runs)) / (n - 1.0), pairs(runs, truth) / (n * n)])
            }),
            ("the pairs are miscounted", |runs, truth| {
                let of = |runs: &[f64], n: f64| {
                    [spread(runs, mean_of(runs)) / (n - 1.0), pairs(runs, truth) / 2.0 / (n * (n - 1.0))]
                };
                both(runs, of)
            }),
            ("the two numbers are swapped", |runs, truth| {
                let of = |runs: &[f64], n: f64| {
                    [pairs(runs, truth) / (n * (n - 1.0)), spread(runs, mean_of(runs)) / (n - 1.0)]
                };
                both(runs, of)
            }),
            ("only neighbours are paired", |runs, truth| {
                let of = |runs: &[f64], n: f64| {
                    let next: f64 = runs.windows(2).map(|two| (two[0] - truth) * (two[1] - truth)).sum();
                    [spread(runs, mean_of(runs)) / (n - 1.0), next / (n - 1.0)]
                };
                both(runs, of)
            }),
            ("this is the variance of the mean of all runs", |runs, truth| {
                let of = |runs: &[f64], n: f64| {
                    [spread(runs, mean_of(runs)) / (n - 1.0) / n, pairs(runs, truth) / (n * (n - 1.0))]
                };
                both(runs, of)
            }),
            ("the distances are not squared", |runs, truth| {
                let of = |runs: &[f64], n: f64| {
                    let apart: f64 = runs.iter().map(|run| (run - mean_of(runs)).abs()).sum();
                    [apart / (n - 1.0), pairs(runs, truth) / (n * (n - 1.0))]
                };
                both(runs, of)
            }),
            ("the variance is not divided", |runs, truth| {
                let of = |runs: &[f64], n: f64| [spread(runs, mean_of(runs)), pairs(runs, truth) / (n * (n - 1.0))];
                both(runs, of)
            }),
            ("bias² is taken about the runs' own mean", |runs, _| {
                let of = |runs: &[f64], n: f64| {
                    let mean = mean_of(runs);
                    [spread(runs, mean) / (n - 1.0), pairs(runs, mean) / (n * (n - 1.0))]
                };
                both(runs, of)
            }),
            ("one run tells no variance, and none tells nothing", |runs, truth| {
                let n = runs.len() as f64;
                if runs.is_empty() {
                    return None;
                }
                Some([spread(runs, mean_of(runs)) / (n - 1.0), pairs(runs, truth) / (n * (n - 1.0))])
            }),
            (/* about the median */ "", |runs, truth| {
                both(runs, |runs, n| {
                    let mut sorted = runs.to_vec();
                    sorted.sort_by(f64::total_cmp);
                    [spread(runs, sorted[sorted.len() / 2]) / (n - 1.0), pairs(runs, truth) / (n * (n - 1.0))]
                })
            }),
            (/* absolute distances in the pairs */ "", |runs, truth| {
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
            ("the normal is taken for a unit vector", |d, n| sub(d, times(n, 2.0 * dot(d, n)))),
            ("what comes out is divided by the normal's length once, but n is in the", |d, n| {
                sub(d, times(n, 2.0 * dot(d, n) / length(n)))
            }),
            ("the 2 is missing", |d, n| sub(d, times(unit(n), dot(d, unit(n))))),
            ("the part along the normal is added", |d, n| add(d, times(unit(n), 2.0 * dot(d, unit(n))))),
            ("the direction is sent back where it came from", |d, _| times(d, -1.0)),
            ("it is the normal that comes out", |_, n| unit(n)),
            ("the absolute value of d · n is taken off", |d, n| sub(d, times(unit(n), 2.0 * dot(d, unit(n)).abs()))),
            ("what comes out goes into the mirror", |d, n| sub(times(unit(n), 2.0 * dot(d, unit(n))), d)),
            ("the result is normalised instead of the normal", |d, n| unit(sub(d, times(n, 2.0 * dot(d, n))))),
            ("from behind a mirror works too", |d, n| {
                let n = unit(n);
                let c = dot(d, n);
                let n = if c > 0.0 { times(n, -1.0) } else { n };
                sub(d, times(n, 2.0 * c))
            }),
            (/* cross product */ "", |d, n| unit(cross(d, n))),
            ("d · n is missing", |d, n| unit(add(d, unit(n)))),
            ("only the component along which the normal is longest is turned round", |d, n| {
                let most = (0..3).max_by(|&a, &b| n[a].abs().total_cmp(&n[b].abs())).unwrap_or(0);
                let mut out = d;
                out[most] = -out[most];
                out
            }),
            ("d · n is missing", |d, n| sub(d, times(unit(n), 2.0))),
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
            ("only d is divided by η, and (c − g) n is not", |d, n, eta| {
                by(d, n, eta, |c, g2| add(over(d, eta), times(n, c - g2.sqrt())))
            }),
            ("1 less the sine is taken for the cosine", |d, n, eta| {
                let c = -dot(d, n);
                let sine = (1.0 - c * c).max(0.0).sqrt() / eta;
                if sine > 1.0 {
                    return None;
                }
                Some(add(over(d, eta), times(n, c / eta - (1.0 - sine))))
            }),
            ("the root is missing", |d, n, eta| by(d, n, eta, |c, g2| over(add(d, times(n, c - g2)), eta))),
            ("what comes out goes back to the near side", |d, n, eta| {
                by(d, n, eta, |c, g2| over(add(d, times(n, c + g2.sqrt())), eta))
            }),
            ("nothing is divided by η", |d, n, eta| by(d, n, eta, |c, g2| add(d, times(n, c - g2.sqrt())))),
            ("η is not squared under the root", |d, n, eta| {
                let c = -dot(d, n);
                let g2 = eta - 1.0 + c * c;
                if g2 < 0.0 { None } else { Some(over(add(d, times(n, c - g2.sqrt())), eta)) }
            }),
            ("a root of a negative number is cut off at 0", |d, n, eta| {
                let c = -dot(d, n);
                let g2 = (eta * eta - 1.0 + c * c).max(0.0);
                Some(over(add(d, times(n, c - g2.sqrt())), eta))
            }),
            ("the part along the normal is left out", |d, n, eta| by(d, n, eta, |_, _| over(d, eta))),
            ("the direction goes straight on", |d, n, eta| by(d, n, eta, |_, _| d)),
            ("the minus is missing", |d, n, eta| by(d, n, eta, |c, g2| over(sub(d, times(n, c - g2.sqrt())), eta))),
            ("c is not squared under the root", |d, n, eta| {
                let c = -dot(d, n);
                let g2 = eta * eta - 1.0 + c;
                if g2 < 0.0 { None } else { Some(over(add(d, times(n, c - g2.sqrt())), eta)) }
            }),
            ("out of a medium of a higher index some light passes, too", |d, n, eta| {
                if eta < 1.0 {
                    return None;
                }
                by(d, n, eta, |c, g2| over(add(d, times(n, c - g2.sqrt())), eta))
            }),
            ("only g is divided by η, and then all is normalised", |d, n, eta| {
                by(d, n, eta, |c, g2| unit(add(d, times(n, c - g2.sqrt() / eta))))
            }),
            (
                /* mixed with the normal */ "",
                |d, n, eta| by(d, n, eta, |_, _| unit(sub(times(d, 1.0 / eta), times(n, 1.0 - 1.0 / eta)))),
            ),
            ("direction and normal are swapped", |d, n, eta| {
                by(n, d, eta, |c, g2| over(add(n, times(d, c - g2.sqrt())), eta))
            }),
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
            ("a light that faces away has a negative pdf", |f, at, n, a| by(f, at, n, |d, c| d * d / (c * a))),
            ("a light that faces away has none", |f, at, n, a| {
                by(f, at, n, |d, c| if c > 0.0 { d * d / (c * a) } else { 0.0 })
            }),
            ("the distance counts once, not squared", |f, at, n, a| by(f, at, n, |d, c| d / (c.abs() * a))),
            ("the pdf is multiplied by the cosine", |f, at, n, a| by(f, at, n, |d, c| d * d * c.abs() / a)),
            ("that is the solid angle of the area", |f, at, n, a| by(f, at, n, |d, c| a * c.abs() / (d * d))),
            ("the area is missing", |f, at, n, _| by(f, at, n, |d, c| d * d / c.abs())),
            ("it is divided by π, which belongs to cosine-weighted directions", |f, at, n, a| {
                by(f, at, n, |d, c| d * d / (c.abs() * a * PI))
            }),
            ("the area is taken twice", |f, at, n, a| by(f, at, n, |d, c| d * d / (c.abs() * a * 2.0))),
            ("the cosine is squared", |f, at, n, a| by(f, at, n, |d, c| d * d / (c * c * a))),
            ("that is the pdf per unit of area", |_, _, _, a| 1.0 / a),
            ("the cosine at the light is missing", |f, at, n, a| by(f, at, n, |d, _| d * d / a)),
            ("Second, seen from its edge the area fills no direction, and the answer", |f, at, n, a| {
                let v = sub(f, at);
                dot(v, v) / (dot(v, n).abs() * a)
            }),
            ("seen from its edge the area fills no direction, and the answer is to b", |f, at, n, a| {
                let v = sub(f, at);
                dot(v, v) / (dot(unit(v), n).abs() * a)
            }),
            (/* sine */ "", |f, at, n, a| by(f, at, n, |d, c| d * d / ((1.0 - c * c).sqrt() * a))),
            (/* the light's place as a direction */ "", |f, at, n, a| {
                let d2 = dot(sub(f, at), sub(f, at));
                let c = dot(unit(at), n).abs();
                if c > 0.0 { d2 / (c * a) } else { 0.0 }
            }),
            (/* area taken for a radius */ "", |f, at, n, a| by(f, at, n, |d, c| d * d / (c.abs() * PI * a * a))),
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
