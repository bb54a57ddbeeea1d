//! The second set: written from the pages when the first had been seen to, before looking at what was known by then.
#![allow(clippy::suboptimal_flops, reason = "as a reader writes it")]

use super::{Fresh, add, cross, dot, fresh, length, over, sub, times, unit};
use pinhole::scene::FovAxis;
use pinhole_cli::checks::*;
use std::f64::consts::{PI, TAU};

pub fn all() -> Vec<Fresh> {
    [first(), shapes_and_light(), samples(), paths(), meshes(), raster()].into_iter().flatten().collect()
}

fn first() -> Vec<Fresh> {
    vec![
        fresh(
            1,
            chapter_01_image::check::exercise,
            &[
                ("y is the index over the width with its", |i, w| {
                    [(i % u64::from(w)) as f64 + 0.5, i as f64 / f64::from(w) + 0.5]
                }),
                ("the index was cut to 32 bits, which 65536 ×", |i, w| {
                    let i = i as u32;
                    [f64::from(i % w) + 0.5, f64::from(i / w) + 0.5]
                }),
                ("counted from 1", |i, w| {
                    let i = i.saturating_sub(1);
                    [(i % u64::from(w)) as f64 + 0.5, (i / u64::from(w)) as f64 + 0.5]
                }),
            ],
            &[|i, w| {
                let (i, w) = (i as f64, f64::from(w));
                let row = (i / w).floor();
                [i - row * w + 0.5, row + 0.5]
            }],
        ),
        fresh(
            2,
            chapter_02_ray::check::exercise,
            &[
                ("the length is taken for |x| + |y| + |z|; it is", |v| {
                    let sum = v[0].abs() + v[1].abs() + v[2].abs();
                    (sum > 0.0 && sum.is_finite()).then(|| over(v, sum))
                }),
                ("short vectors are taken for 0, and of long ones", |v| {
                    let length = length(v);
                    (length > 1e-9 && length.is_finite()).then(|| over(v, length))
                }),
                ("one part is left out of the length; it is √(x²", |v| {
                    let length = v[0].hypot(v[1]);
                    (length > 0.0 && length.is_finite()).then(|| over(v, length))
                }),
            ],
            &[|v| {
                let largest = v.into_iter().fold(0.0_f64, |most, part| most.max(part.abs()));
                if v.into_iter().any(|part| !part.is_finite()) || largest == 0.0 {
                    return None;
                }
                let v = over(v, largest);
                Some(over(v, v[0].hypot(v[1]).hypot(v[2])))
            }],
        ),
        fresh(
            3,
            chapter_03_hit::check::exercise,
            &[
                ("the formula with b and that with half of b are", |o, d, c, r| {
                    let oc = sub(o, c);
                    let (a, b, c) = (dot(d, d), dot(oc, d), dot(oc, oc) - r * r);
                    let root = (b * b - 4.0 * a * c).sqrt();
                    [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)].into_iter().find(|t| *t > 0.0)
                }),
                ("the radius is not squared", |o, d, c, r| {
                    let oc = sub(o, c);
                    let (a, b, c) = (dot(d, d), dot(oc, d), dot(oc, oc) - r);
                    let root = (b * b - a * c).sqrt();
                    [(-b - root) / a, (-b + root) / a].into_iter().find(|t| *t > 0.0)
                }),
                ("b has the wrong sign, so that what is behind", |o, d, c, r| {
                    let oc = sub(c, o);
                    let (a, b, c) = (dot(d, d), dot(oc, d), dot(oc, oc) - r * r);
                    let root = (b * b - a * c).sqrt();
                    [(-b - root) / a, (-b + root) / a].into_iter().find(|t| *t > 0.0)
                }),
            ],
            &[|o, d, c, r| {
                let to_centre = sub(c, o);
                let dd = dot(d, d);
                let middle = dot(to_centre, d) / dd;
                let beside = sub(to_centre, times(d, middle));
                let inside = r * r - dot(beside, beside);
                if inside < 0.0 {
                    return None;
                }
                let half = (inside / dd).sqrt();
                let power = (length(to_centre) - r) * (length(to_centre) + r) / dd;
                if power > 0.0 {
                    return (middle > 0.0).then(|| power / (middle + half));
                }
                let t = if middle > 0.0 { middle + half } else { -power / (half - middle) };
                (t > 0.0).then_some(t)
            }],
        ),
        fresh(
            4,
            chapter_04_orthographic::check::exercise,
            &[
                ("the screen point is divided by the height; a", |[x, y], h| {
                    ([x / (h / 2.0), y / (h / 2.0), 0.0], [0.0, 0.0, -1.0])
                }),
                ("the rectangle stands at z = −1; here it stands", |[x, y], h| {
                    ([x * h / 2.0, y * h / 2.0, -1.0], [0.0, 0.0, -1.0])
                }),
                ("only y is scaled", |[x, y], h| ([x, y * h / 2.0, 0.0], [0.0, 0.0, -1.0])),
            ],
            &[|screen, h| {
                let [x, y] = screen.map(|part| h * part * 0.5);
                ([x, y, -0.0], [-0.0, 0.0, -1.0])
            }],
        ),
        fresh(
            5,
            chapter_05_pinhole::check::exercise,
            &[
                ("the tangent is left out, or multiplies z as", |[x, y], t| unit([x * t, y * t, -t])),
                ("only y is scaled", |[x, y], t| unit([x, y * t, -1.0])),
            ],
            &[|[x, y], t| {
                let [x, y] = [t * x, t * y];
                let inverse = 1.0 / x.hypot(y).hypot(1.0);
                [x * inverse, inverse * y, -inverse]
            }],
        ),
        fresh(
            6,
            chapter_06_ndc::check::exercise,
            &[
                ("the point is scaled by the size less 1; n", |p, w, h| {
                    let at = |p: f64, n: u32| (0.0..1.0).contains(&p).then(|| (p * f64::from(n - 1)) as u32);
                    Some([at(p[0], w)?, at(p[1], h)?])
                }),
                ("1 counts as inside; the lower and right edges", |p, w, h| {
                    let at = |p: f64, n: u32| (0.0..=1.0).contains(&p).then(|| ((p * f64::from(n)) as u32).min(n - 1));
                    Some([at(p[0], w)?, at(p[1], h)?])
                }),
                ("the product is rounded up; a point on an edge", |p, w, h| {
                    let at = |p: f64, n: u32| {
                        (0.0..1.0).contains(&p).then(|| ((p * f64::from(n)).ceil() as u32).saturating_sub(1).min(n - 1))
                    };
                    Some([at(p[0], w)?, at(p[1], h)?])
                }),
            ],
            &[|ndc, w, h| {
                let mut pixel = [0; 2];
                for ((place, ndc), n) in pixel.iter_mut().zip(ndc).zip([w, h]) {
                    if !(ndc >= 0.0) || ndc >= 1.0 {
                        return None;
                    }
                    *place = ((ndc * f64::from(n)).trunc() as u32).min(n - 1);
                }
                Some(pixel)
            }],
        ),
        fresh(
            7,
            chapter_07_screen::check::exercise,
            &[
                ("the aspect divides whole numbers, 480 / 270 =", |[x, y], w, h| {
                    let aspect = f64::from((w / h).max(1));
                    [(x / aspect + 1.0) / 2.0, (1.0 - y) / 2.0]
                }),
                ("1 is added before the aspect is taken off; undo", |[x, y], w, h| {
                    [(x + 1.0) / (2.0 * f64::from(w) / f64::from(h)), (1.0 - y) / 2.0]
                }),
                ("the aspect is taken off y, too; on the screen y", |[x, y], w, h| {
                    let aspect = f64::from(w) / f64::from(h);
                    [(x / aspect + 1.0) / 2.0, (1.0 - y / aspect) / 2.0]
                }),
            ],
            &[|[x, y], w, h| [0.5 + 0.5 * x * f64::from(h) / f64::from(w), 0.5 - 0.5 * y]],
        ),
    ]
}

fn shapes_and_light() -> Vec<Fresh> {
    vec![
        fresh(
            8,
            chapter_08_field_of_view::check::exercise,
            &[
                ("the angle itself is divided by the aspect; it", |a, axis, w, h| {
                    a * f64::from(h) / across(axis, w, h)
                }),
                ("the diagonal is taken for something else: it is", |a, axis, w, h| {
                    let n = if matches!(axis, FovAxis::Diagonal) {
                        f64::from(w) + f64::from(h)
                    } else {
                        across(axis, w, h)
                    };
                    2.0 * ((a.to_radians() / 2.0).tan() * f64::from(h) / n).atan().to_degrees()
                }),
                ("the smaller and the larger side are taken to be", |a, axis, w, h| {
                    let n = match axis {
                        FovAxis::Larger => f64::from(w),
                        FovAxis::Smaller => f64::from(h),
                        other => across(other, w, h),
                    };
                    2.0 * ((a.to_radians() / 2.0).tan() * f64::from(h) / n).atan().to_degrees()
                }),
            ],
            &[|a, axis, w, h| {
                let (sin, cos) = (a * PI / 360.0).sin_cos();
                360.0 / PI * (sin * f64::from(h)).atan2(cos * across(axis, w, h))
            }],
        ),
        fresh(
            9,
            chapter_09_camera_to_world::check::exercise,
            &[
                ("the inverse is not transposed, or the columns", |[x, y, z], n| {
                    let det = dot(x, cross(y, z));
                    let rows = [cross(y, z), cross(z, x), cross(x, y)];
                    unit(rows.map(|row| dot(row, n) / det))
                }),
                ("the transpose", |columns, n| unit(columns.map(|column| dot(column, n)))),
            ],
            &[|[x, y, z], n| {
                let map = |v: [f64; 3]| add(add(times(x, v[0]), times(y, v[1])), times(z, v[2]));
                let least = (0..3).min_by(|a, b| n[*a].abs().total_cmp(&n[*b].abs())).unwrap_or(0);
                let mut aside = [0.0; 3];
                aside[least] = 1.0;
                let one = cross(n, aside);
                let normal = unit(cross(map(one), map(cross(n, one))));
                if dot(normal, map(n)) < 0.0 { times(normal, -1.0) } else { normal }
            }],
        ),
        fresh(
            10,
            chapter_10_light_and_shadow::check::exercise,
            &[
                ("the intensity is divided by 4π; it is what the", |c, i, p, n, l| {
                    let to = sub(l, p);
                    let d2 = dot(to, to);
                    if d2 == 0.0 { 0.0 } else { c * i * dot(n, unit(to)).max(0.0) / (4.0 * PI * d2) }
                }),
                ("the BRDF is colour / π; it is not multiplied by", |c, i, p, n, l| {
                    let to = sub(l, p);
                    let d2 = dot(to, to);
                    if d2 == 0.0 { 0.0 } else { c * PI * i * dot(n, unit(to)).max(0.0) / d2 }
                }),
                ("the cosine is squared; the light spreads over a", |c, i, p, n, l| {
                    let to = sub(l, p);
                    let d2 = dot(to, to);
                    let cosine = dot(n, unit(to)).max(0.0);
                    if d2 == 0.0 { 0.0 } else { c * i * cosine * cosine / (PI * d2) }
                }),
            ],
            &[|c, i, p, n, l| {
                let to = sub(l, p);
                let d = to[0].hypot(to[1]).hypot(to[2]);
                let facing = n[0] * (to[0] / d) + n[1] * (to[1] / d) + n[2] * (to[2] / d);
                if facing > 0.0 { c / PI * facing * (i / d / d) } else { 0.0 }
            }],
        ),
        fresh(
            11,
            chapter_11_conventions::check::exercise,
            &[
                ("z of the answer has the opposite sign where", |[x, y, z], right, up, ahead| {
                    let z = if right == up { -z } else { z };
                    [if right { x } else { -x }, if up { y } else { -y }, if ahead { z } else { -z }]
                }),
                ("y of `direction` and z of `direction` are", |[x, y, z], right, up, ahead| {
                    [if right { x } else { -x }, if up { z } else { -z }, if ahead { -y } else { y }]
                }),
            ],
            &[|v, right, up, ahead| {
                let turned = [!right, !up, ahead];
                [0, 1, 2].map(|at| f64::from(1 - 2 * i8::from(turned[at])) * v[at])
            }],
        ),
        fresh(
            12,
            chapter_12_how_it_is_built::check::exercise,
            &[
                ("a column counts as provided for once a stage", |stages, asked| {
                    let mut wanted = vec![asked.to_owned()];
                    let mut kept = Vec::new();
                    for stage in stages.iter().rev() {
                        if stage.needed && stage.writes.iter().any(|own| wanted.contains(own)) {
                            wanted.retain(|own| !stage.writes.contains(own));
                            wanted.extend(stage.reads.iter().cloned());
                            kept.insert(0, stage.name.clone());
                        }
                    }
                    kept
                }),
                ("what a stage that the scene does not need reads", |stages, asked| {
                    let mut wanted = vec![asked.to_owned()];
                    let mut kept = Vec::new();
                    for stage in stages.iter().rev() {
                        if stage.writes.iter().any(|own| wanted.contains(own)) {
                            wanted.extend(stage.reads.iter().cloned());
                            if stage.needed {
                                kept.insert(0, stage.name.clone());
                            }
                        }
                    }
                    kept
                }),
                ("a stage is kept only if all that it writes is", |stages, asked| {
                    let mut wanted = vec![asked.to_owned()];
                    let mut kept = Vec::new();
                    for stage in stages.iter().rev() {
                        if stage.needed && stage.writes.iter().all(|own| wanted.contains(own)) {
                            wanted.extend(stage.reads.iter().cloned());
                            kept.insert(0, stage.name.clone());
                        }
                    }
                    kept
                }),
            ],
            &[|stages, asked| {
                let mut keeps = vec![false; stages.len()];
                loop {
                    let before = keeps.clone();
                    for at in 0..stages.len() {
                        let read = |column: &String| {
                            column == asked
                                || (at + 1..stages.len()).any(|then| keeps[then] && stages[then].reads.contains(column))
                        };
                        keeps[at] = stages[at].needed && stages[at].writes.iter().any(read);
                    }
                    if before == keeps {
                        break;
                    }
                }
                stages.iter().zip(keeps).filter(|pair| pair.1).map(|pair| pair.0.name.clone()).collect()
            }],
        ),
        fresh(
            13,
            chapter_13_shapes::check::exercise,
            &[
                ("an axis along which the direction is 0 is left", |o, d, low, high| {
                    let (mut enters, mut leaves) = (f64::NEG_INFINITY, f64::INFINITY);
                    for at in 0..3 {
                        if d[at] == 0.0 {
                            continue;
                        }
                        let (one, two) = ((low[at] - o[at]) / d[at], (high[at] - o[at]) / d[at]);
                        (enters, leaves) = (enters.max(one.min(two)), leaves.min(one.max(two)));
                    }
                    (enters <= leaves).then_some(())?;
                    [enters, leaves].into_iter().find(|t| *t > 0.0)
                }),
                ("from inside, the origin counts as the hit; the", |o, d, low, high| {
                    let [enters, leaves] = slabs(o, d, low, high)?;
                    (leaves > 0.0).then(|| enters.max(0.0))
                }),
                ("", |o, d, low, high| {
                    let [enters, _] = slabs(o, d, low, high)?;
                    let leaves = (0..3)
                        .filter(|at| d[*at] != 0.0)
                        .map(|at| ((low[at] - o[at]) / d[at]).max((high[at] - o[at]) / d[at]))
                        .fold(f64::NEG_INFINITY, f64::max);
                    [enters, leaves].into_iter().find(|t| *t > 0.0)
                }),
            ],
            &[|o, d, low, high| slabs(o, d, low, high)?.into_iter().find(|t| *t > 0.0)],
        ),
        fresh(
            14,
            chapter_14_transforms::check::exercise,
            &[
                ("the mixed normal is turned to the eye by its", |g, ns, w, eye, light| {
                    let n = mean(ns, w);
                    let n = if dot(n, eye) < 0.0 { times(n, -1.0) } else { n };
                    let g = if dot(g, eye) < 0.0 { times(g, -1.0) } else { g };
                    if dot(g, light) <= 0.0 { 0.0 } else { dot(n, unit(light)).max(0.0) }
                }),
                ("the weights are left out; each corner's normal", |g, ns, _, eye, light| {
                    shaded(g, mean(ns, [1.0; 3]), eye, light)
                }),
                (
                    "nothing is lit",
                    |g, ns, w, eye, light| {
                        if dot(g, eye) < 0.0 { 0.0 } else { shaded(g, mean(ns, w), eye, light) }
                    },
                ),
            ],
            &[|g, ns, w, eye, light| {
                let sum = add(add(times(ns[2], w[2]), times(ns[1], w[1])), times(ns[0], w[0]));
                let seen = dot(g, eye).signum();
                let lit = seen * dot(g, light);
                let cosine = seen * dot(g, sum).signum() * dot(sum, light) / length(sum) / length(light);
                if lit > 0.0 && cosine > 0.0 { cosine } else { 0.0 }
            }],
        ),
    ]
}

/// What an angle is measured across, in pixels.
fn across(axis: FovAxis, w: u32, h: u32) -> f64 {
    match axis {
        FovAxis::Vertical => f64::from(h),
        FovAxis::Horizontal => f64::from(w),
        FovAxis::Smaller => f64::from(w.min(h)),
        FovAxis::Larger => f64::from(w.max(h)),
        FovAxis::Diagonal => f64::from(w).hypot(f64::from(h)),
    }
}

fn slabs(o: [f64; 3], d: [f64; 3], low: [f64; 3], high: [f64; 3]) -> Option<[f64; 2]> {
    let mut span = [f64::NEG_INFINITY, f64::INFINITY];
    for at in 0..3 {
        if d[at] == 0.0 {
            if o[at] < low[at] || high[at] < o[at] {
                return None;
            }
            continue;
        }
        let mut own = [(low[at] - o[at]) / d[at], (high[at] - o[at]) / d[at]];
        own.sort_by(f64::total_cmp);
        span = [span[0].max(own[0]), span[1].min(own[1])];
    }
    (span[0] <= span[1]).then_some(span)
}

fn mean(ns: [[f64; 3]; 3], w: [f64; 3]) -> [f64; 3] {
    unit(add(add(times(ns[0], w[0]), times(ns[1], w[1])), times(ns[2], w[2])))
}

fn shaded(g: [f64; 3], n: [f64; 3], eye: [f64; 3], light: [f64; 3]) -> f64 {
    let g = if dot(g, eye) < 0.0 { times(g, -1.0) } else { g };
    let n = if dot(n, g) < 0.0 { times(n, -1.0) } else { n };
    if dot(g, light) <= 0.0 { 0.0 } else { dot(n, unit(light)).max(0.0) }
}

fn phong(factor: f64, [c, s, e]: [f64; 3], irradiance: f64, [n, l, v]: [[f64; 3]; 3]) -> f64 {
    let cosine = dot(n, l);
    if cosine <= 0.0 {
        return 0.0;
    }
    let lobe = dot(sub(times(n, 2.0 * cosine), l), v).max(0.0);
    (c / PI + s * (e + factor) / TAU * lobe.powf(e)) * irradiance * cosine
}

fn stripe(x: f64) -> f64 {
    if x.floor().rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 }
}

/// The integral of the stripes from 0.
fn tri(x: f64) -> f64 {
    1.0 - (x.rem_euclid(2.0) - 1.0).abs()
}

fn samples() -> Vec<Fresh> {
    vec![
        fresh(
            15,
            chapter_15_reflection::check::exercise,
            &[
                ("the half vector", |[c, s, e], i, n, l, v| {
                    let cosine = dot(n, l);
                    let half = dot(n, unit(add(l, v))).max(0.0);
                    if cosine <= 0.0 { 0.0 } else { (c / PI + s * (e + 2.0) / TAU * half.powf(e)) * i * cosine }
                }),
                ("the factor is that of cosⁿ alone, (n + 1) / 2π;", |k, i, n, l, v| phong(1.0, k, i, [n, l, v])),
                ("the cosine is forgotten in the highlight; it", |[c, s, e], i, n, l, v| {
                    let cosine = dot(n, l);
                    let lobe = dot(sub(times(n, 2.0 * cosine), l), v).max(0.0);
                    if cosine <= 0.0 { 0.0 } else { (c / PI * cosine + s * (e + 2.0) / TAU * lobe.powf(e)) * i }
                }),
            ],
            &[|[c, s, e], i, n, l, v| {
                let mirror = sub(times(n, 2.0 * dot(n, v)), v);
                let lobe = if dot(mirror, l) > 0.0 { (e * dot(mirror, l).ln()).exp() } else { 0.0 };
                (2.0 * c + s * (e + 2.0) * lobe) / TAU * i * dot(n, l).max(0.0)
            }],
        ),
        fresh(
            16,
            chapter_16_textures::check::exercise,
            &[
                ("only a few points of the range are looked at;", |x, w| {
                    (stripe(x - w / 2.0) + stripe(x + w / 2.0)) / 2.0
                }),
                ("the range reaches from x to x + width; half of", |x, w| {
                    if w == 0.0 { stripe(x) } else { (tri(x + w) - tri(x)) / w }
                }),
                ("twice as wide", |x, w| if w == 0.0 { stripe(x) } else { (tri(x + w) - tri(x - w)) / (2.0 * w) }),
            ],
            &[|x, w| {
                // From the start of the stripe that holds x, where numbers are small.
                let (start, sign) = (x.floor(), stripe(x));
                let (left, right) = (x - start - w / 2.0, x - start + w / 2.0);
                if left >= 0.0 && right <= 1.0 {
                    return sign;
                }
                let (below, above) = (tri(left), tri(right));
                sign * (above - below) / w
            }],
        ),
        fresh(
            17,
            chapter_17_sampling::check::exercise,
            &[
                ("left and right are swapped; the place must grow", |u, r| {
                    if u < 0.5 { r * (1.0 - (2.0 * u).sqrt()) } else { -r * (1.0 - (2.0 * (1.0 - u)).sqrt()) }
                }),
                ("the right half is not the mirror image of the", |u, r| {
                    if u < 0.5 { r * ((2.0 * u).sqrt() - 1.0) } else { r * (2.0 * u - 1.0).sqrt() }
                }),
                ("squares draw the samples to the centre too", |u, r| {
                    let v = 2.0 * u - 1.0;
                    r * v * v.abs()
                }),
            ],
            &[|u, r| {
                let v = 2.0 * u - 1.0;
                r * v.signum() * (1.0 - (1.0 - v.abs()).sqrt())
            }],
        ),
        fresh(
            18,
            chapter_18_error_and_time::check::exercise,
            &[
                ("the pairs are miscounted: n runs make n (n − 1)", |runs, truth| {
                    let n = runs.len() as f64;
                    (runs.len() > 1).then_some(())?;
                    let mean = runs.iter().sum::<f64>() / n;
                    let variance = runs.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
                    let mut pairs = 0.0;
                    for i in 0..runs.len() {
                        for j in i + 1..runs.len() {
                            pairs += (runs[i] - truth) * (runs[j] - truth);
                        }
                    }
                    Some([variance, pairs / (n * (n - 1.0))])
                }),
                ("the variance of the mean", |runs, truth| {
                    let [variance, bias] = apart(runs, truth)?;
                    Some([variance / runs.len() as f64, bias])
                }),
                ("a bias² below 0 is cut off; then its mean over", |runs, truth| {
                    let [variance, bias] = apart(runs, truth)?;
                    Some([variance, bias.max(0.0)])
                }),
            ],
            &[|runs, truth| {
                let (mut mean, mut squares, mut n) = (0.0, 0.0, 0.0);
                for run in runs {
                    n += 1.0;
                    let off = run - mean;
                    mean += off / n;
                    squares += off * (run - mean);
                }
                (n > 1.5).then(|| {
                    let variance = squares / (n - 1.0);
                    [variance, (mean - truth) * (mean - truth) - variance / n]
                })
            }],
        ),
        fresh(
            19,
            chapter_19_mirrors::check::exercise,
            &[
                ("what comes out is divided by the normal's", |d, n| sub(d, times(n, 2.0 * dot(d, n) / length(n)))),
                ("from behind a mirror works too; no sign of d ·", |d, n| {
                    let n = unit(n);
                    if dot(d, n) < 0.0 { sub(d, times(n, 2.0 * dot(d, n))) } else { d }
                }),
                ("the absolute value of d · n is taken off; the", |d, n| {
                    let n = unit(n);
                    sub(d, times(n, 2.0 * dot(d, n).abs()))
                }),
            ],
            &[|d, n| {
                let n = over(n, n[0].hypot(n[1]).hypot(n[2]));
                let across = times(n, dot(n, d));
                let along = sub(d, across);
                sub(along, across)
            }],
        ),
        fresh(
            20,
            chapter_20_glass::check::exercise,
            &[
                ("η is not squared under the root", |d, n, eta| {
                    let cosine = -dot(d, n);
                    let squared = 1.0 - (1.0 - cosine * cosine) / eta;
                    (squared >= 0.0).then(|| add(over(d, eta), times(n, cosine / eta - squared.sqrt())))
                }),
                ("where nothing passes the mirror's direction is", |d, n, eta| {
                    let cosine = -dot(d, n);
                    let squared = 1.0 - (1.0 - cosine * cosine) / (eta * eta);
                    if squared < 0.0 {
                        return Some(add(d, times(n, 2.0 * cosine)));
                    }
                    Some(add(over(d, eta), times(n, cosine / eta - squared.sqrt())))
                }),
                ("what comes out goes back to the near side: the", |d, n, eta| {
                    let cosine = -dot(d, n);
                    let squared = 1.0 - (1.0 - cosine * cosine) / (eta * eta);
                    (squared >= 0.0).then(|| add(over(d, eta), times(n, cosine / eta + squared.sqrt())))
                }),
            ],
            &[|d, n, eta| {
                let along = over(sub(d, times(n, dot(d, n))), eta);
                let left = 1.0 - dot(along, along);
                if left < 0.0 { None } else { Some(sub(along, times(n, left.sqrt()))) }
            }],
        ),
    ]
}

fn apart(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    let n = runs.len() as f64;
    (runs.len() > 1).then_some(())?;
    let mean = runs.iter().sum::<f64>() / n;
    let variance = runs.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
    let mut pairs = 0.0;
    for i in 0..runs.len() {
        for j in (0..runs.len()).filter(|j| *j != i) {
            pairs += (runs[i] - truth) * (runs[j] - truth);
        }
    }
    Some([variance, pairs / (n * (n - 1.0))])
}

fn paths() -> Vec<Fresh> {
    vec![
        fresh(
            21,
            chapter_21_soft_shadows::check::exercise,
            &[
                ("the distance counts once, not squared; normal ·", |from, at, n, area| {
                    let to = sub(at, from);
                    let cosine = dot(n, to).abs();
                    if cosine == 0.0 { 0.0 } else { dot(to, to) / (cosine * area) }
                }),
                ("the pdf is multiplied by the area; the larger", |from, at, n, area| {
                    let to = sub(at, from);
                    let cosine = dot(n, unit(to)).abs();
                    if cosine == 0.0 { 0.0 } else { dot(to, to) * area / cosine }
                }),
                ("seen from its edge the area fills no direction,", |from, at, n, area| {
                    let to = sub(at, from);
                    dot(to, to) / (dot(n, unit(to)).abs() * area)
                }),
            ],
            &[|from, at, n, area| {
                let to = sub(from, at);
                let (d2, depth) = (dot(to, to), dot(n, to).abs());
                if depth > 0.0 { d2 / area * (d2.sqrt() / depth) } else { 0.0 }
            }],
        ),
        fresh(
            22,
            chapter_22_ambient_occlusion::check::exercise,
            &[
                ("half a turn", |u, v| {
                    let (sin, cos) = (PI * v).sin_cos();
                    [u.sqrt() * cos, u.sqrt() * sin, (1.0 - u).sqrt()]
                }),
                ("the height is not that of a unit vector: x² +", |u, v| {
                    let (sin, cos) = (TAU * v).sin_cos();
                    [u.sqrt() * cos, u.sqrt() * sin, 1.0 - u.sqrt()]
                }),
                ("degrees", |u, v| {
                    let (sin, cos) = (360.0 * v).sin_cos();
                    [u.sqrt() * cos, u.sqrt() * sin, (1.0 - u).sqrt()]
                }),
            ],
            &[|u, v| {
                let (sin, cos) = (PI * v).sin_cos();
                let r = u.sqrt();
                [r * (cos * cos - sin * sin), 2.0 * r * sin * cos, (1.0 - u).sqrt()]
            }],
        ),
        fresh(
            23,
            chapter_23_depth_of_field::check::exercise,
            &[
                ("the focus is taken along the ray: what is sharp", |[x, y], t, [lx, ly], f| {
                    let to = times(unit([x * t, y * t, -1.0]), f);
                    unit(sub(to, [lx, ly, 0.0]))
                }),
                ("only x and y are multiplied by the focus", |[x, y], t, [lx, ly], f| {
                    unit([x * t * f - lx, y * t * f - ly, -1.0])
                }),
                ("the lens point is multiplied by the tangent; it", |[x, y], t, [lx, ly], f| {
                    unit([(x * f - lx) * t, (y * f - ly) * t, -f])
                }),
            ],
            &[|[x, y], t, [lx, ly], f| unit([x * t - lx / f, y * t - ly / f, -1.0])],
        ),
        fresh(
            24,
            chapter_24_motion_blur::check::exercise,
            &[
                ("the direction is changed by the velocity; light", |o, d, c, r, v, time| {
                    first_of(o, sub(d, v), add(c, times(v, time)), r)
                }),
                ("the time is left out: the sphere has always", |o, d, c, r, v, _| first_of(o, d, add(c, v), r)),
                ("that is where the ray leaves the sphere; the", |o, d, c, r, v, time| {
                    let oc = sub(o, add(c, times(v, time)));
                    let (b, c) = (dot(oc, d), dot(oc, oc) - r * r);
                    let t = -b + (b * b - c).sqrt();
                    (t > 0.0).then_some(t)
                }),
            ],
            &[|o, d, c, r, v, time| {
                let to = sub(c, sub(o, times(v, time)));
                let ahead = dot(to, d);
                let beside = sub(to, times(d, ahead));
                let inside = r * r - dot(beside, beside);
                (inside >= 0.0 && ahead > 0.0).then(|| ahead - inside.sqrt())
            }],
        ),
        fresh(
            25,
            chapter_25_path_tracing::check::exercise,
            &[
                ("the mean of the three", |w, u| {
                    let p = ((w[0] + w[1] + w[2]) / 3.0).min(1.0);
                    if u < p { over(w, p) } else { [0.0; 3] }
                }),
                ("a probability above 1 divides light away; it is", |w, u| {
                    let p = w[0].max(w[1]).max(w[2]);
                    if u < p { over(w, p) } else { [0.0; 3] }
                }),
                ("a path that goes on is divided by the", |w, u| {
                    let p = w[0].max(w[1]).max(w[2]).min(1.0);
                    if u < p { over(w, 1.0 - p) } else { [0.0; 3] }
                }),
                ("the probability is the luminance; asked is the", |w, u| {
                    let p = (0.2126 * w[0] + 0.7152 * w[1] + 0.0722 * w[2]).min(1.0);
                    if u < p { over(w, p) } else { [0.0; 3] }
                }),
            ],
            &[|w, u| {
                let most = w.into_iter().fold(0.0_f64, f64::max);
                match most {
                    1.0.. => w,
                    _ if u / most < 1.0 => w.map(|part| part / most),
                    _ => [0.0; 3],
                }
            }],
        ),
        fresh(
            26,
            chapter_26_choosing_samples::check::exercise,
            &[
                ("that is the balance heuristic squared; square", |own, other| {
                    let part = own / (own + other);
                    if own == 0.0 { 0.0 } else { part * part }
                }),
                ("squares overflow to infinity", |own, other| {
                    if own == 0.0 { 0.0 } else { own * own / (own * own + other * other) }
                }),
                ("0 is divided by 0 where neither technique", |own, other| {
                    let ratio = other / own;
                    1.0 / (1.0 + ratio * ratio)
                }),
            ],
            &[|own, other| {
                if own == 0.0 {
                    return 0.0;
                }
                if own > other {
                    1.0 / (1.0 + (other / own) * (other / own))
                } else {
                    let part = own / other;
                    part * part / (1.0 + part * part)
                }
            }],
        ),
        fresh(
            27,
            chapter_27_caustics::check::exercise,
            &[
                ("the plane at distance 1 is 2 tan_half high, not", |p, t, h| {
                    let a = (t / h) * (t / h);
                    let d2 = dot(p, p);
                    let cosine = -p[2] / d2.sqrt();
                    if cosine <= 0.0 { 0.0 } else { 1.0 / (a * d2 * cosine * cosine * cosine) }
                }),
                ("cos⁴ is taken; it is cos³: the fourth belongs", |p, t, h| {
                    let a = (2.0 * t / h) * (2.0 * t / h);
                    let d2 = dot(p, p);
                    let cosine = -p[2] / d2.sqrt();
                    if cosine <= 0.0 { 0.0 } else { 1.0 / (a * d2 * cosine * cosine * cosine * cosine) }
                }),
                ("a point behind the eye counts; it reaches no", |p, t, h| {
                    let a = (2.0 * t / h) * (2.0 * t / h);
                    let d2 = dot(p, p);
                    let cosine = -p[2] / d2.sqrt();
                    1.0 / (a * d2 * cosine * cosine * cosine)
                }),
            ],
            &[|p, t, h| {
                let side = 2.0 * t / h;
                let depth = -p[2];
                if depth > 0.0 { length(p) / (depth * side * depth * side * depth) } else { 0.0 }
            }],
        ),
    ]
}

fn first_of(o: [f64; 3], d: [f64; 3], c: [f64; 3], r: f64) -> Option<f64> {
    let oc = sub(o, c);
    let (a, b, c) = (dot(d, d), dot(oc, d), dot(oc, oc) - r * r);
    let root = (b * b - a * c).sqrt();
    [(-b - root) / a, (-b + root) / a].into_iter().find(|t| *t > 0.0)
}

fn meshes() -> Vec<Fresh> {
    vec![
        fresh(
            28,
            chapter_28_meshes::check::exercise,
            &[
                ("the direction is of length 1 in object space", |o, d, p, axes, s| {
                    let to = |v: [f64; 3]| [0, 1, 2].map(|at| dot(axes[at], v) / s[at]);
                    [to(sub(o, p)), unit(to(d))]
                }),
                ("the vector is taken from object to world space;", |o, d, p, axes, s| {
                    let to = |v: [f64; 3]| {
                        let turned = add(add(times(axes[0], v[0]), times(axes[1], v[1])), times(axes[2], v[2]));
                        [0, 1, 2].map(|at| turned[at] / s[at])
                    };
                    [to(sub(o, p)), to(d)]
                }),
                ("the turn is to be undone before the scale,", |o, d, p, axes, s| {
                    let to = |v: [f64; 3]| {
                        let v = [0, 1, 2].map(|at| v[at] / s[at]);
                        axes.map(|axis| dot(axis, v))
                    };
                    [to(sub(o, p)), to(d)]
                }),
            ],
            &[|o, d, p, [x, y, z], [a, b, c]| {
                let [x, y, z] = [times(x, a), times(y, b), times(z, c)];
                let volume = dot(x, cross(y, z));
                let rows = [cross(y, z), cross(z, x), cross(x, y)];
                [sub(o, p), d].map(|v| rows.map(|row| dot(row, v) / volume))
            }],
        ),
        fresh(
            29,
            chapter_29_boxes::check::exercise,
            &[
                ("a box that reaches beyond t_max counts, too,", |o, inverse, low, high, t_max| {
                    within(o, inverse, low, high).is_some_and(|[a, b]| a <= b && b >= 0.0 && b <= t_max)
                }),
                ("flat boxes and edges are lost: where a ray", |o, inverse, low, high, t_max| {
                    within(o, inverse, low, high).is_some_and(|[a, b]| a < b && b >= 0.0 && a <= t_max)
                }),
                ("a box beyond t_max counts", |o, inverse, low, high, _| {
                    within(o, inverse, low, high).is_some_and(|[a, b]| a <= b && b >= 0.0)
                }),
            ],
            &[|o, inverse, low, high, t_max| {
                let spans = [0, 1, 2].map(|at| {
                    if inverse[at].is_infinite() {
                        let between = low[at] <= o[at] && o[at] <= high[at];
                        return if between { [0.0, t_max] } else { [1.0, -1.0] };
                    }
                    let both = [(low[at] - o[at]) * inverse[at], (high[at] - o[at]) * inverse[at]];
                    if inverse[at] > 0.0 { both } else { [both[1], both[0]] }
                });
                let begins = spans.iter().map(|span| span[0]).fold(0.0, f64::max);
                let ends = spans.iter().map(|span| span[1]).fold(t_max, f64::min);
                begins <= ends
            }],
        ),
        fresh(
            30,
            chapter_30_tree::check::exercise,
            &[
                ("None stands before a child; where only one is", |enters, closest| {
                    let [a, b] = enters.map(|t| t.filter(|t| *t < closest));
                    match (a, b) {
                        (Some(a), Some(b)) if b < a => [Some(1), Some(0)],
                        (a, b) => [a.map(|_| 0), b.map(|_| 1)],
                    }
                }),
                ("both are visited if the nearer one begins", |enters, closest| match enters {
                    [Some(a), Some(b)] if a.min(b) < closest => {
                        if b < a {
                            [Some(1), Some(0)]
                        } else {
                            [Some(0), Some(1)]
                        }
                    }
                    [Some(a), None] if a < closest => [Some(0), None],
                    [None, Some(b)] if b < closest => [Some(1), None],
                    _ => [None, None],
                }),
                ("child 1 is first where both are equally near;", |enters, closest| {
                    let [a, b] = enters.map(|t| t.filter(|t| *t < closest));
                    match (a, b) {
                        (Some(a), Some(b)) if b <= a => [Some(1), Some(0)],
                        (Some(_), b) => [Some(0), b.map(|_| 1)],
                        (None, b) => [b.map(|_| 1), None],
                    }
                }),
            ],
            &[|enters, closest| {
                let mut order: Vec<(f64, u32)> = enters
                    .into_iter()
                    .zip(0..)
                    .filter_map(|(t, at)| Some((t?, at)))
                    .filter(|hit| closest > hit.0)
                    .collect();
                order.sort_by(|a, b| a.0.partial_cmp(&b.0).unwrap_or(std::cmp::Ordering::Equal));
                [order.first().map(|hit| hit.1), order.get(1).map(|hit| hit.1)]
            }],
        ),
        fresh(
            31,
            chapter_31_wide_tree::check::exercise,
            &[
                ("the bits begin with bit 1: bit 0 is the first", |enters, leaves, closest| {
                    (0..8).map(|i| u32::from(is_entered(enters[i], leaves[i], closest)) << (i + 1)).sum()
                }),
                ("a box that reaches behind the closest hit", |enters, leaves, closest| {
                    (0..8)
                        .map(|i| {
                            let is = enters[i] <= leaves[i] && leaves[i] >= 0.0 && leaves[i] <= closest;
                            u32::from(is) << i
                        })
                        .sum()
                }),
                ("the boxes are counted; asked is a mask, with", |enters, leaves, closest| {
                    (0..8).map(|i| u32::from(is_entered(enters[i], leaves[i], closest))).sum()
                }),
            ],
            &[|enters, leaves, closest| {
                let mut mask = 0;
                for i in (0..8).rev() {
                    let (begins, ends) = (enters[i].max(0.0), leaves[i].min(closest));
                    mask = mask * 2 + u32::from(ends >= begins);
                }
                mask
            }],
        ),
    ]
}

fn is_entered(enters: f64, leaves: f64, closest: f64) -> bool {
    enters <= leaves && leaves >= 0.0 && enters <= closest
}

fn within(o: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3]) -> Option<[f64; 2]> {
    let (mut enters, mut leaves) = (f64::NEG_INFINITY, f64::INFINITY);
    for at in 0..3 {
        if inverse[at].is_infinite() {
            if o[at] < low[at] || o[at] > high[at] {
                return None;
            }
            continue;
        }
        let (one, two) = ((low[at] - o[at]) * inverse[at], (high[at] - o[at]) * inverse[at]);
        (enters, leaves) = (enters.max(one.min(two)), leaves.min(one.max(two)));
    }
    Some([enters, leaves])
}

fn raster() -> Vec<Fresh> {
    vec![
        fresh(
            32,
            chapter_32_projection::check::exercise,
            &[
                ("half a pixel is subtracted: x and y are counted", |p, eye, axes, t, [w, h]| {
                    let [x, y] = placed(p, eye, axes, t, [w, h]);
                    [x - 0.5, y - 0.5]
                }),
                ("divided by the distance", |p, eye, axes, t, [w, h]| {
                    let to = sub(p, eye);
                    let (w, h, d) = (f64::from(w), f64::from(h), length(to));
                    let [x, y] = [dot(to, axes[0]) / d / t, dot(to, axes[1]) / d / t];
                    [(w + x * h) / 2.0, (1.0 - y) * h / 2.0]
                }),
                ("the point goes from the camera to the world:", |p, eye, [a, b, c], t, size| {
                    placed(p, eye, [[a[0], b[0], c[0]], [a[1], b[1], c[1]], [a[2], b[2], c[2]]], t, size)
                }),
            ],
            &[|p, eye, [right, up, back], t, [w, h]| {
                let to = sub(eye, p);
                let scale = f64::from(h) / (2.0 * t * dot(to, back));
                [f64::from(w) * 0.5 - scale * dot(to, right), f64::from(h) * 0.5 + scale * dot(to, up)]
            }],
        ),
        fresh(
            33,
            chapter_33_rasterisation::check::exercise,
            &[
                ("the products overflow i32: two numbers of 25", |from, to, at| {
                    let cross = (to[0] - from[0])
                        .wrapping_mul(at[1] - from[1])
                        .wrapping_sub((to[1] - from[1]).wrapping_mul(at[0] - from[0]));
                    cross > 0 || (cross == 0 && is_own(from, to))
                }),
                ("a level edge belongs to the triangle where it", |from, to, at| {
                    let cross = edge(from, to, at);
                    cross > 0 || (cross == 0 && (to[1] < from[1] || to[1] == from[1]))
                }),
                ("the edge function is rounded: f32 has 24 bits,", |from, to, at| {
                    let [from, to, at] = [from, to, at].map(|p| p.map(|part| part as f32));
                    let cross = (to[0] - from[0]) * (at[1] - from[1]) - (to[1] - from[1]) * (at[0] - from[0]);
                    cross > 0.0 || (cross == 0.0 && (to[1] < from[1] || (to[1] == from[1] && to[0] > from[0])))
                }),
            ],
            &[|from, to, at| {
                let [[fx, fy], [tx, ty], [x, y]] = [from, to, at].map(|p| p.map(i128::from));
                let twice = (tx * y - ty * x) - (fx * y - fy * x) + (fx * ty - fy * tx);
                let own = ty < fy || (ty == fy && tx > fx);
                2 * twice + i128::from(own) > 0
            }],
        ),
        fresh(
            34,
            chapter_34_both::check::exercise,
            &[
                ("the radius over the distance is the sine of the", |right, ahead, r, half| {
                    let d = right.hypot(ahead);
                    if d <= r {
                        return [-half, half];
                    }
                    tangents(right.atan2(ahead), (r / d).atan(), half)
                }),
                ("those are angles, or their sines; on a plane at", |right, ahead, r, half| {
                    let d = right.hypot(ahead);
                    if d <= r {
                        return [-half, half];
                    }
                    let (middle, spread) = (right.atan2(ahead), (r / d).asin());
                    [(middle - spread).clamp(-half, half), (middle + spread).clamp(-half, half)]
                }),
                ("the answer is (0.0, 0.0) where all parts of the", |right, ahead, r, half| {
                    let [a, b] = interval(right, ahead, r, half);
                    if a == b { [0.0; 2] } else { [a, b] }
                }),
            ],
            &[interval],
        ),
        fresh(
            35,
            chapter_35_real_time::check::exercise,
            &[
                ("surfaces that face away count: 32 is even, so a", |n, m, o| {
                    power(dot(n, m), 32) * planar(n, o, true)
                }),
                ("the sine is not squared", |n, m, o| power(dot(n, m).max(0.0), 32) * planar(n, o, false)),
                ("the mean of the factors is taken; they are to", |n, m, o| {
                    (power(dot(n, m).max(0.0), 32) + planar(n, o, true)) / 2.0
                }),
            ],
            &[|n, m, o| {
                let mut cosine = dot(n, m).clamp(0.0, 1.0);
                for _ in 0..5 {
                    cosine *= cosine;
                }
                let (rise, long) = (dot(n, o), dot(o, o));
                if long == 0.0 { cosine } else { cosine * 0.01 * long / (0.01 * long + rise * rise) }
            }],
        ),
    ]
}

fn placed(p: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], t: f64, [w, h]: [u32; 2]) -> [f64; 2] {
    let to = sub(p, eye);
    let (w, h, depth) = (f64::from(w), f64::from(h), -dot(to, axes[2]));
    let [x, y] = [dot(to, axes[0]) / depth / t, dot(to, axes[1]) / depth / t];
    [(w + x * h) / 2.0, (1.0 - y) * h / 2.0]
}

fn edge(from: [i32; 2], to: [i32; 2], at: [i32; 2]) -> i64 {
    let [from, to, at] = [from, to, at].map(|p| p.map(i64::from));
    (to[0] - from[0]) * (at[1] - from[1]) - (to[1] - from[1]) * (at[0] - from[0])
}

fn is_own(from: [i32; 2], to: [i32; 2]) -> bool {
    to[1] < from[1] || (to[1] == from[1] && to[0] > from[0])
}

fn tangents(middle: f64, spread: f64, half: f64) -> [f64; 2] {
    [middle - spread, middle + spread].map(|angle| match angle {
        a if a <= -PI / 2.0 => -half,
        a if a >= PI / 2.0 => half,
        a => a.tan().clamp(-half, half),
    })
}

fn interval(right: f64, ahead: f64, r: f64, half: f64) -> [f64; 2] {
    let d = right.hypot(ahead);
    if d <= r { [-half, half] } else { tangents(right.atan2(ahead), (r / d).asin(), half) }
}

fn power(base: f64, n: u32) -> f64 {
    (0..n).fold(1.0, |product, _| product * base)
}

fn planar(n: [f64; 3], o: [f64; 3], squared: bool) -> f64 {
    if dot(o, o) == 0.0 {
        return 1.0;
    }
    let sine = dot(n, unit(o)).abs();
    0.01 / (0.01 + if squared { sine * sine } else { sine })
}
