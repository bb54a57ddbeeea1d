//! The third set: written from the pages when the second had been seen to, before looking at what had become of it.
#![allow(clippy::suboptimal_flops, reason = "as a reader writes it")]

use super::{Fresh, add, cross, dot, fresh, length, over, sub, times, unit};
use pinhole::scene::FovAxis;
use pinhole_cli::checks::*;
use std::f64::consts::{PI, TAU};

pub fn all() -> Vec<Fresh> {
    [first(), light(), samples(), paths(), raster(), odd()].into_iter().flatten().collect()
}

fn first() -> Vec<Fresh> {
    vec![
        fresh(
            1,
            chapter_01_image::check::exercise,
            &[
                ("y is the index over the width with its", |i, w| {
                    let i = i as f64 + 0.5;
                    [i % f64::from(w), i / f64::from(w)]
                }),
                ("the row is rounded; it is the whole part of the", |i, w| {
                    [(i % u64::from(w)) as f64 + 0.5, (i as f64 / f64::from(w)).ceil() + 0.5]
                }),
            ],
            &[|i, w| {
                let row = i / u64::from(w);
                let column = i - row * u64::from(w);
                [column, row].map(|place| (2 * place + 1) as f64 / 2.0)
            }],
        ),
        fresh(
            2,
            chapter_02_ray::check::exercise,
            &[
                ("what has no direction is given one", |v| {
                    let length = length(v);
                    Some(if length == 0.0 { v } else { over(v, length) })
                }),
                ("only a vector longer than 1 is made shorter; a", |v| {
                    let length = length(v);
                    (length > 0.0 && length.is_finite()).then(|| over(v, length.max(1.0)))
                }),
            ],
            &[|v| {
                let most = v[0].abs().max(v[1].abs()).max(v[2].abs());
                let sum = v[0] + v[1] + v[2];
                if sum.is_nan() || !most.is_finite() || most == 0.0 {
                    return None;
                }
                let v = over(v, most);
                Some(over(v, dot(v, v).sqrt()))
            }],
        ),
        fresh(
            3,
            chapter_03_hit::check::exercise,
            &[
                ("c is of the origin alone; it is of the origin", |o, d, c, r| {
                    let (a, b, c) = (dot(d, d), dot(sub(o, c), d), dot(o, o) - r * r);
                    roots(a, b, c).into_iter().find(|t| *t > 0.0)
                }),
                ("the direction is taken to be of length 1", |o, d, c, r| {
                    let oc = sub(o, c);
                    roots(1.0, dot(oc, d), dot(oc, oc) - r * r).into_iter().find(|t| *t > 0.0)
                }),
                ("two things went wrong. First, b² − ac (or b² −", |o, d, c, r| {
                    let oc = sub(o, c);
                    let [one, two] = roots(dot(d, d), dot(oc, d), dot(oc, oc) - r * r).map(f64::abs);
                    (!one.is_nan()).then(|| one.min(two))
                }),
            ],
            &[],
        ),
        fresh(
            4,
            chapter_04_orthographic::check::exercise,
            &[
                ("the origin is twice as far out: screen y runs", |[x, y], h| ([x * h, y * h, 0.0], [0.0, 0.0, -1.0])),
                ("y points down; on the screen and in camera", |[x, y], h| {
                    ([x * h / 2.0, -y * h / 2.0, 0.0], [0.0, 0.0, -1.0])
                }),
            ],
            &[],
        ),
        fresh(
            5,
            chapter_05_pinhole::check::exercise,
            &[
                ("a tangent is taken of the tangent, which is one", |[x, y], t| unit([x * t.tan(), y * t.tan(), -1.0])),
                ("not of length 1", |[x, y], t| [x * t, y * t, -1.0]),
            ],
            &[|[x, y], t| {
                let square = (x * t) * (x * t) + (y * t) * (y * t) + 1.0;
                [x * t, y * t, -1.0].map(|part| part / square.sqrt())
            }],
        ),
        fresh(
            6,
            chapter_06_ndc::check::exercise,
            &[
                ("rounded", |p, w, h| {
                    let at = |p: f64, n: u32| (0.0..1.0).contains(&p).then(|| (p * f64::from(n)).round() as u32);
                    Some([at(p[0], w)?, at(p[1], h)?])
                }),
                ("what is below 0 is given pixel 0: the whole", |p, w, h| {
                    let at = |p: f64, n: u32| (p < 1.0).then(|| ((p * f64::from(n)) as u32).min(n - 1));
                    Some([at(p[0], w)?, at(p[1], h)?])
                }),
            ],
            &[],
        ),
        fresh(
            7,
            chapter_07_screen::check::exercise,
            &[
                ("a part runs from −1/2 to 1/2; a half is to be", |[x, y], w, h| {
                    [x * f64::from(h) / f64::from(w) / 2.0, -y / 2.0]
                }),
                ("x is multiplied by the aspect; to undo that,", |[x, y], w, h| {
                    [(x * f64::from(w) / f64::from(h) + 1.0) / 2.0, (1.0 - y) / 2.0]
                }),
            ],
            &[|[x, y], w, h| {
                let (w, h) = (f64::from(w), f64::from(h));
                [(x * h + w) / (2.0 * w), (h - y * h) / (2.0 * h)]
            }],
        ),
        fresh(
            8,
            chapter_08_field_of_view::check::exercise,
            &[
                ("the answer is half the angle", |a, axis, w, h| {
                    ((a.to_radians() / 2.0).tan() * f64::from(h) / across(axis, w, h)).atan().to_degrees()
                }),
                ("multiplied by the aspect", |a, axis, w, h| {
                    2.0 * ((a.to_radians() / 2.0).tan() * across(axis, w, h) / f64::from(h)).atan().to_degrees()
                }),
                ("two things went wrong. First, the diagonal is", |a, axis, w, h| {
                    let n = if matches!(axis, FovAxis::Vertical) { f64::from(h) } else { f64::from(w) };
                    2.0 * ((a.to_radians() / 2.0).tan() * f64::from(h) / n).atan().to_degrees()
                }),
            ],
            &[],
        ),
        fresh(
            9,
            chapter_09_camera_to_world::check::exercise,
            &[
                ("a mirroring map turns the normal inside out:", |[x, y, z], n| {
                    let rows = [cross(y, z), cross(z, x), cross(x, y)];
                    unit(add(add(times(rows[0], n[0]), times(rows[1], n[1])), times(rows[2], n[2])))
                }),
                ("not of length 1", |[x, y, z], n| {
                    let rows = [cross(y, z), cross(z, x), cross(x, y)];
                    let sum = add(add(times(rows[0], n[0]), times(rows[1], n[1])), times(rows[2], n[2]));
                    over(sum, dot(x, cross(y, z)))
                }),
            ],
            &[],
        ),
    ]
}

fn roots(a: f64, b: f64, c: f64) -> [f64; 2] {
    let root = (b * b - a * c).sqrt();
    [(-b - root) / a, (-b + root) / a]
}

fn across(axis: FovAxis, w: u32, h: u32) -> f64 {
    match axis {
        FovAxis::Vertical => f64::from(h),
        FovAxis::Horizontal => f64::from(w),
        FovAxis::Smaller => f64::from(w.min(h)),
        FovAxis::Larger => f64::from(w.max(h)),
        FovAxis::Diagonal => f64::from(w).hypot(f64::from(h)),
    }
}

fn light() -> Vec<Fresh> {
    vec![
        fresh(
            10,
            chapter_10_light_and_shadow::check::exercise,
            &[
                ("the cosine is taken at the origin; the", |c, i, p, n, l| {
                    let to = sub(l, p);
                    let d2 = dot(to, to);
                    if d2 == 0.0 || l == [0.0; 3] { 0.0 } else { c * i * dot(n, unit(l)).max(0.0) / (PI * d2) }
                }),
                ("the distance once", |c, i, p, n, l| {
                    let to = sub(l, p);
                    let d = length(to);
                    if d == 0.0 { 0.0 } else { c * i * dot(n, unit(to)).max(0.0) / (PI * d) }
                }),
            ],
            &[|c, i, p, n, l| {
                let to = sub(l, p);
                let d2 = dot(to, to);
                if d2 == 0.0 { 0.0 } else { (c * i * dot(n, to) / d2 / d2.sqrt() / PI).max(0.0) }
            }],
        ),
        fresh(
            11,
            chapter_11_conventions::check::exercise,
            &[
                ("z is turned where it should not be: pinhole's", |[x, y, z], right, up, ahead| {
                    [if right { x } else { -x }, if up { y } else { -y }, if ahead { z } else { -z }]
                }),
                ("the whole direction is turned about where one", |v, right, up, ahead| {
                    if right && up && !ahead { v } else { v.map(|part| -part) }
                }),
            ],
            &[],
        ),
        fresh(
            12,
            chapter_12_how_it_is_built::check::exercise,
            &[
                ("what a stage reads and what it writes are", |stages, asked| {
                    let mut wanted = vec![asked.to_owned()];
                    let mut kept = Vec::new();
                    for stage in stages.iter().rev() {
                        if stage.needed && stage.reads.iter().any(|own| wanted.contains(own)) {
                            wanted.extend(stage.writes.iter().cloned());
                            kept.insert(0, stage.name.clone());
                        }
                    }
                    kept
                }),
                ("", |stages, asked| {
                    let end = stages.iter().position(|stage| stage.writes.iter().any(|own| own == asked));
                    let all = stages.iter().take(end.map_or(0, |end| end + 1)).filter(|stage| stage.needed);
                    all.map(|stage| stage.name.clone()).collect()
                }),
            ],
            &[],
        ),
        fresh(
            13,
            chapter_13_shapes::check::exercise,
            &[
                ("only two of the three slabs", |o, d, low, high| {
                    slabs(o, d, low, high, 2)?.into_iter().find(|t| *t > 0.0)
                }),
                ("the far side is taken where the near one is", |o, d, low, high| {
                    Some(slabs(o, d, low, high, 3)?[1]).filter(|t| *t > 0.0)
                }),
            ],
            &[],
        ),
        fresh(
            14,
            chapter_14_transforms::check::exercise,
            &[
                ("light falls as the surface lies, whatever its", |g, _, _, eye, light| {
                    let g = if dot(g, eye) < 0.0 { times(g, -1.0) } else { g };
                    dot(g, unit(light)).max(0.0)
                }),
                ("light comes from below the surface, where the", |g, ns, w, eye, light| {
                    let n = unit(add(add(times(ns[0], w[0]), times(ns[1], w[1])), times(ns[2], w[2])));
                    let n = if dot(n, g) * dot(g, eye) < 0.0 { times(n, -1.0) } else { n };
                    dot(n, unit(light)).max(0.0)
                }),
            ],
            &[],
        ),
        fresh(
            15,
            chapter_15_reflection::check::exercise,
            &[
                ("the factor of the highlight is another one; it", |k, i, n, l, v| phong(k, i, [n, l, v], PI, 1.0)),
                ("the mirrored direction points into the surface:", |k, i, n, l, v| phong(k, i, [n, l, v], TAU, -1.0)),
            ],
            &[],
        ),
        fresh(
            16,
            chapter_16_textures::check::exercise,
            &[
                ("this is the area; divided by the width", |x, w| {
                    if w == 0.0 { stripe(x) } else { tri(x + w / 2.0) - tri(x - w / 2.0) }
                }),
                ("odd stripes count as 1 and even ones", |x, w| {
                    if w == 0.0 { -stripe(x) } else { (tri(x - w / 2.0) - tri(x + w / 2.0)) / w }
                }),
            ],
            &[],
        ),
    ]
}

fn slabs(o: [f64; 3], d: [f64; 3], low: [f64; 3], high: [f64; 3], axes: usize) -> Option<[f64; 2]> {
    let mut span = [f64::NEG_INFINITY, f64::INFINITY];
    for at in 0..axes {
        if d[at] == 0.0 {
            if o[at] < low[at] || high[at] < o[at] {
                return None;
            }
            continue;
        }
        let (one, two) = ((low[at] - o[at]) / d[at], (high[at] - o[at]) / d[at]);
        span = [span[0].max(one.min(two)), span[1].min(one.max(two))];
    }
    (span[0] <= span[1]).then_some(span)
}

fn phong([c, s, e]: [f64; 3], irradiance: f64, [n, l, v]: [[f64; 3]; 3], below: f64, sign: f64) -> f64 {
    let cosine = dot(n, l);
    if cosine <= 0.0 {
        return 0.0;
    }
    let lobe = (sign * dot(sub(times(n, 2.0 * cosine), l), v)).max(0.0);
    (c / PI + s * (e + 2.0) / below * lobe.powf(e)) * irradiance * cosine
}

fn stripe(x: f64) -> f64 {
    if x.floor().rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 }
}

fn tri(x: f64) -> f64 {
    1.0 - (x.rem_euclid(2.0) - 1.0).abs()
}

fn samples() -> Vec<Fresh> {
    vec![
        fresh(
            17,
            chapter_17_sampling::check::exercise,
            &[
                ("the 2 under the root is another number: half of", |u, r| {
                    if u < 0.5 { r * (u.sqrt() - 1.0) } else { r * (1.0 - (1.0 - u).sqrt()) }
                }),
                ("the radius is left out: this tent always ends", |u, _| {
                    if u < 0.5 { (2.0 * u).sqrt() - 1.0 } else { 1.0 - (2.0 * (1.0 - u)).sqrt() }
                }),
            ],
            &[|u, r| r * ((2.0 * u).min(1.0).sqrt() - (2.0 - 2.0 * u).min(1.0).sqrt())],
        ),
        fresh(
            18,
            chapter_18_error_and_time::check::exercise,
            &[
                ("this is the bias, not its square", |runs, truth| {
                    let (mean, variance) = moments(runs)?;
                    Some([variance, mean - truth])
                }),
                ("the standard deviation", |runs, truth| {
                    let (mean, variance) = moments(runs)?;
                    Some([variance.sqrt(), (mean - truth) * (mean - truth) - variance / runs.len() as f64])
                }),
            ],
            &[|runs, truth| {
                let n = runs.len() as f64;
                (n >= 2.0).then_some(())?;
                let sum: f64 = runs.iter().map(|x| x - truth).sum();
                let squares: f64 = runs.iter().map(|x| (x - truth) * (x - truth)).sum();
                Some([(squares - sum * sum / n) / (n - 1.0), (sum * sum - squares) / (n * (n - 1.0))])
            }],
        ),
        fresh(
            19,
            chapter_19_mirrors::check::exercise,
            &[
                ("the 2 is missing: the part along the normal is", |d, n| sub(d, times(n, dot(d, n) / dot(n, n)))),
                ("`direction` and `normal` are swapped", |d, n| sub(n, times(d, 2.0 * dot(d, n)))),
            ],
            &[|d, n| {
                let back = times(n, 2.0 * dot(n, d));
                over(sub(times(d, dot(n, n)), back), dot(n, n))
            }],
        ),
        fresh(
            20,
            chapter_20_glass::check::exercise,
            &[
                ("c is left out of", |d, n, eta| {
                    let squared = 1.0 - (1.0 - dot(d, n) * dot(d, n)) / (eta * eta);
                    (squared >= 0.0).then(|| sub(over(d, eta), times(n, squared.sqrt())))
                }),
                ("c is not squared under the root: g² is η² − 1 +", |d, n, eta| {
                    let cosine = -dot(d, n);
                    let squared = 1.0 - (1.0 - cosine) / (eta * eta);
                    (squared >= 0.0).then(|| add(over(d, eta), times(n, cosine / eta - squared.sqrt())))
                }),
            ],
            &[],
        ),
        fresh(
            21,
            chapter_21_soft_shadows::check::exercise,
            &[
                ("a light that faces away has none; on which side", |from, at, n, area| {
                    let to = sub(from, at);
                    let cosine = dot(n, unit(to));
                    if cosine <= 0.0 { 0.0 } else { dot(to, to) / (cosine * area) }
                }),
                ("the distance is missing: far away the area", |from, at, n, area| {
                    let cosine = dot(n, unit(sub(from, at))).abs();
                    if cosine == 0.0 { 0.0 } else { 1.0 / (cosine * area) }
                }),
            ],
            &[],
        ),
        fresh(
            22,
            chapter_22_ambient_occlusion::check::exercise,
            &[
                ("u is taken for the radius; the area within a", |u, v| {
                    let (sin, cos) = (TAU * v).sin_cos();
                    [u * cos, u * sin, (1.0 - u * u).sqrt()]
                }),
                ("u and v are swapped: u is for the radius, and v", |u, v| {
                    let (sin, cos) = (TAU * u).sin_cos();
                    [v.sqrt() * cos, v.sqrt() * sin, (1.0 - v).sqrt()]
                }),
                ("uniform", |u, v| {
                    let (sin, cos) = (TAU * v).sin_cos();
                    let z = 1.0 - u;
                    let r = (1.0 - z * z).sqrt();
                    [r * cos, r * sin, z]
                }),
            ],
            &[],
        ),
        fresh(
            23,
            chapter_23_depth_of_field::check::exercise,
            &[
                ("the lens point is added; the direction from it", |[x, y], t, [lx, ly], f| {
                    unit([x * t * f + lx, y * t * f + ly, -f])
                }),
                ("the plane in focus is always at distance 1", |[x, y], t, [lx, ly], _| {
                    unit([x * t - lx, y * t - ly, -1.0])
                }),
            ],
            &[|[x, y], t, [lx, ly], f| {
                let to = times([x * t, y * t, -1.0], f);
                let to = sub(to, [lx, ly, 0.0]);
                times(to, 1.0 / dot(to, to).sqrt())
            }],
        ),
    ]
}

fn moments(runs: &[f64]) -> Option<(f64, f64)> {
    let n = runs.len() as f64;
    (runs.len() > 1).then_some(())?;
    let mean = runs.iter().sum::<f64>() / n;
    Some((mean, runs.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0)))
}

fn paths() -> Vec<Fresh> {
    vec![
        fresh(
            24,
            chapter_24_motion_blur::check::exercise,
            &[
                ("the sphere moves backwards: its centre is at", |o, d, c, r, v, time| {
                    let oc = sub(o, sub(c, times(v, time)));
                    roots(1.0, dot(oc, d), dot(oc, oc) - r * r).into_iter().find(|t| *t > 0.0)
                }),
                ("a hit behind the ray's origin counts; t must be", |o, d, c, r, v, time| {
                    let oc = sub(o, add(c, times(v, time)));
                    Some(roots(1.0, dot(oc, d), dot(oc, oc) - r * r)[0]).filter(|t| !t.is_nan())
                }),
            ],
            &[],
        ),
        fresh(
            25,
            chapter_25_path_tracing::check::exercise,
            &[
                ("a path that goes on counts as before, so the", |w, u| {
                    if u < w[0].max(w[1]).max(w[2]).min(1.0) { w } else { [0.0; 3] }
                }),
                ("each colour plays for itself; a path is one", |w, u| {
                    w.map(|part| if u < part.min(1.0) { part.max(1.0) } else { 0.0 })
                }),
            ],
            &[|w, u| {
                let end = 1.0 - w[0].max(w[1]).max(w[2]).min(1.0);
                if 1.0 - u > end { w.map(|part| part / (1.0 - end)) } else { [0.0; 3] }
            }],
        ),
        fresh(
            26,
            chapter_26_choosing_samples::check::exercise,
            &[
                ("the two are swapped: the larger pdf has more", |own, other| {
                    let ratio = own / other;
                    if own == 0.0 { 0.0 } else { 1.0 / (1.0 + ratio * ratio) }
                }),
                ("that is the balance heuristic; both pdfs are", |own, other| {
                    if own == 0.0 { 0.0 } else { 1.0 / (1.0 + other / own) }
                }),
            ],
            &[],
        ),
        fresh(
            27,
            chapter_27_caustics::check::exercise,
            &[
                ("A is the area of a pixel, its side squared", |p, t, h| {
                    let d2 = dot(p, p);
                    let cosine = -p[2] / d2.sqrt();
                    if cosine <= 0.0 { 0.0 } else { 1.0 / (2.0 * t / h * d2 * cosine * cosine * cosine) }
                }),
                ("the depth −z is taken for d, which is the", |p, t, h| {
                    let a = (2.0 * t / h) * (2.0 * t / h);
                    let cosine = -p[2] / length(p);
                    if cosine <= 0.0 { 0.0 } else { 1.0 / (a * p[2] * p[2] * cosine * cosine * cosine) }
                }),
            ],
            &[|p, t, h| {
                let cosine = -p[2] / length(p);
                let pixels = h * h / (4.0 * t * t);
                if p[2] < 0.0 { pixels / dot(p, p) / cosine / cosine / cosine } else { 0.0 }
            }],
        ),
        fresh(
            28,
            chapter_28_meshes::check::exercise,
            &[
                ("the direction is not divided by the scale; in", |o, d, p, axes, s| {
                    let o = axes.map(|axis| dot(axis, sub(o, p)));
                    [[o[0] / s[0], o[1] / s[1], o[2] / s[2]], axes.map(|axis| dot(axis, d))]
                }),
                ("the position is left out: the mesh is turned", |o, d, _, axes, s| {
                    [o, d].map(|v| [dot(axes[0], v) / s[0], dot(axes[1], v) / s[1], dot(axes[2], v) / s[2]])
                }),
            ],
            &[|o, d, p, axes, s| {
                [sub(o, p), d].map(|v| {
                    let mut own = [0.0; 3];
                    for at in 0..3 {
                        own[at] = dot(v, over(axes[at], s[at]));
                    }
                    own
                })
            }],
        ),
        fresh(
            29,
            chapter_29_boxes::check::exercise,
            &[
                ("a box behind the origin counts: t begins at 0", |o, inverse, low, high, t_max| {
                    spans(o, inverse, low, high).is_some_and(|all| {
                        let [a, b] = all
                            .into_iter()
                            .fold([f64::NEG_INFINITY, t_max], |s, own| [s[0].max(own[0]), s[1].min(own[1])]);
                        a <= b
                    })
                }),
                ("one slab is enough", |o, inverse, low, high, t_max| {
                    spans(o, inverse, low, high)
                        .is_some_and(|all| all.into_iter().any(|[a, b]| a <= b && b >= 0.0 && a <= t_max))
                }),
            ],
            &[],
        ),
        fresh(
            30,
            chapter_30_tree::check::exercise,
            &[
                ("the farther child comes first: a hit there", |enters, closest| {
                    match enters.map(|t| t.filter(|t| *t < closest)) {
                        [Some(a), Some(b)] if a < b => [Some(1), Some(0)],
                        [Some(_), b] => [Some(0), b.map(|_| 1)],
                        [None, b] => [b.map(|_| 1), None],
                    }
                }),
                ("a child that begins behind the closest hit is", |enters, _| match enters {
                    [Some(a), Some(b)] if b < a => [Some(1), Some(0)],
                    [Some(_), b] => [Some(0), b.map(|_| 1)],
                    [None, b] => [b.map(|_| 1), None],
                }),
            ],
            &[|enters, closest| {
                let key = |t: Option<f64>| t.filter(|t| *t < closest).unwrap_or(f64::INFINITY);
                let (a, b) = (key(enters[0]), key(enters[1]));
                let (first, second) = if b < a { ((1, b), (0, a)) } else { ((0, a), (1, b)) };
                [first, second].map(|(child, t)| (t < f64::INFINITY).then_some(child))
            }],
        ),
        fresh(
            31,
            chapter_31_wide_tree::check::exercise,
            &[
                ("a box behind the ray is one that it has left", |enters, leaves, closest| {
                    (0..8).map(|i| u32::from(enters[i] <= leaves[i] && enters[i] <= closest) << i).sum()
                }),
                ("the bits are in the opposite order: bit 0 is", |enters, leaves, closest| {
                    (0..8)
                        .map(|i| {
                            let is = enters[i] <= leaves[i] && leaves[i] >= 0.0 && enters[i] <= closest;
                            u32::from(is) << (7 - i)
                        })
                        .sum()
                }),
            ],
            &[|enters, leaves, closest| {
                let mut mask = 0b1111_1111;
                for i in 0..8 {
                    if enters[i] > leaves[i] || leaves[i] < 0.0 || enters[i] > closest {
                        mask &= !(1 << i);
                    }
                }
                mask
            }],
        ),
    ]
}

fn spans(o: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3]) -> Option<[[f64; 2]; 3]> {
    let mut all = [[f64::NEG_INFINITY, f64::INFINITY]; 3];
    for at in 0..3 {
        if inverse[at].is_infinite() {
            if o[at] < low[at] || o[at] > high[at] {
                return None;
            }
            continue;
        }
        let (one, two) = ((low[at] - o[at]) * inverse[at], (high[at] - o[at]) * inverse[at]);
        all[at] = [one.min(two), one.max(two)];
    }
    Some(all)
}

fn raster() -> Vec<Fresh> {
    vec![
        fresh(
            32,
            chapter_32_projection::check::exercise,
            &[
                ("the field of view is left out", |p, eye, axes, _, size| placed(p, eye, axes, 1.0, size)),
                ("the aspect is left out: x is in half heights", |p, eye, axes, t, [w, h]| {
                    let to = sub(p, eye);
                    let depth = -dot(to, axes[2]);
                    let [x, y] = [dot(to, axes[0]) / depth / t, dot(to, axes[1]) / depth / t];
                    [(1.0 + x) * f64::from(w) / 2.0, (1.0 - y) * f64::from(h) / 2.0]
                }),
            ],
            &[|p, eye, [right, up, back], t, [w, h]| {
                let to = sub(p, eye);
                let depth = -dot(to, back) * t;
                let aspect = f64::from(w) / f64::from(h);
                let ndc = [(dot(to, right) / depth / aspect + 1.0) / 2.0, (1.0 - dot(to, up) / depth) / 2.0];
                [ndc[0] * f64::from(w), ndc[1] * f64::from(h)]
            }],
        ),
        fresh(
            33,
            chapter_33_rasterisation::check::exercise,
            &[
                ("a sample on an edge is always inside: it", |from, to, at| edge(from, to, at) >= 0),
                ("x and y are swapped in the rule: a left edge", |from, to, at| {
                    let on = edge(from, to, at);
                    on > 0 || (on == 0 && (to[0] > from[0] || (to[0] == from[0] && to[1] < from[1])))
                }),
            ],
            &[|from, to, at| match edge(from, to, at) {
                0 => to[1] < from[1] || (to[1] == from[1] && to[0] > from[0]),
                other => other.is_positive(),
            }],
        ),
        fresh(
            34,
            chapter_34_both::check::exercise,
            &[
                ("both ends are taken at the depth of the centre:", |right, ahead, r, half| {
                    if right.hypot(ahead) <= r || ahead <= 0.0 {
                        return [-half, half];
                    }
                    [(right - r) / ahead, (right + r) / ahead].map(|x| x.clamp(-half, half))
                }),
                ("an end beyond the image's edge is left there;", |right, ahead, r, half| {
                    let d = right.hypot(ahead);
                    if d <= r {
                        return [-half, half];
                    }
                    let (middle, spread) = (right.atan2(ahead), (r / d).asin());
                    [(middle - spread).tan(), (middle + spread).tan()]
                }),
            ],
            &[],
        ),
        fresh(
            35,
            chapter_35_real_time::check::exercise,
            &[
                ("the distance from the plane is not divided by", |n, m, o| {
                    let sine = dot(n, o);
                    power(dot(n, m).max(0.0)) * 0.01 / (0.01 + sine * sine)
                }),
                ("that is the cosine, the part along the plane;", |n, m, o| {
                    let rise = if dot(o, o) == 0.0 { 0.0 } else { dot(n, unit(o)) };
                    power(dot(n, m).max(0.0)) * 0.01 / (0.01 + 1.0 - rise * rise)
                }),
            ],
            &[],
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

fn power(cosine: f64) -> f64 {
    (0..5).fold(cosine, |power, _| power * power)
}

/// Odder ones, written when what was said of the others had been seen.
fn odd() -> Vec<Fresh> {
    vec![
        fresh(
            1,
            chapter_01_image::check::exercise,
            &[(/* the image is taken to be square */ "", |i, w| {
                let side = u64::from(w).min(65536);
                [(i % side) as f64 + 0.5, (i / side % side) as f64 + 0.5]
            })],
            &[],
        ),
        fresh(
            5,
            chapter_05_pinhole::check::exercise,
            &[
                ("only x is scaled by the tangent; y is in half", |[x, y], t| unit([x * t, y, -1.0])),
                ("x of `screen` is never below 0", |[x, y], t| unit([x.max(0.0) * t, y * t, -1.0])),
            ],
            &[],
        ),
        fresh(
            8,
            chapter_08_field_of_view::check::exercise,
            &[(/* tall images are taken for wide ones */ "", |a, axis, w, h| {
                let (w, h) = (w.max(h), w.min(h));
                2.0 * ((a.to_radians() / 2.0).tan() * f64::from(h) / across(axis, w, h)).atan().to_degrees()
            })],
            &[],
        ),
        fresh(
            10,
            chapter_10_light_and_shadow::check::exercise,
            &[
                (/* no light that is nearer than 1 */ "", |c, i, p, n, l| {
                    let to = sub(l, p);
                    let d2 = dot(to, to).max(1.0);
                    if to == [0.0; 3] { 0.0 } else { c * i * dot(n, unit(to)).max(0.0) / (PI * d2) }
                }),
                (/* the height of the light is left out */ "", |c, i, p, n, l| {
                    let to = sub([l[0], p[1], l[2]], p);
                    let d2 = dot(to, to);
                    if d2 == 0.0 { 0.0 } else { c * i * dot(n, unit(to)).max(0.0) / (PI * d2) }
                }),
            ],
            &[],
        ),
        fresh(
            15,
            chapter_15_reflection::check::exercise,
            &[
                ("`exponent` is cut to a whole number", |[c, s, e], i, n, l, v| {
                    phong([c, s, e.floor()], i, [n, l, v], TAU, 1.0)
                }),
                (/* matte or highlight, the larger */ "", |[c, s, e], i, n, l, v| {
                    phong([c, 0.0, e], i, [n, l, v], TAU, 1.0).max(phong([0.0, s, e], i, [n, l, v], TAU, 1.0))
                }),
            ],
            &[],
        ),
        fresh(
            16,
            chapter_16_textures::check::exercise,
            &[("`width` is never below 1", |x, w| {
                let w = w.max(1.0);
                (tri(x + w / 2.0) - tri(x - w / 2.0)) / w
            })],
            &[],
        ),
        fresh(
            17,
            chapter_17_sampling::check::exercise,
            &[
                ("all samples land on one side; the lower half of", |u, r| r * (1.0 - (1.0 - u).sqrt())),
                (
                    /* uniform where the number is above a half */ "",
                    |u, r| {
                        if u < 0.5 { r * ((2.0 * u).sqrt() - 1.0) } else { r * (2.0 * u - 1.0) }
                    },
                ),
            ],
            &[],
        ),
        fresh(
            18,
            chapter_18_error_and_time::check::exercise,
            &[(/* one run tells a variance of 0 */ "", |runs, truth| match runs {
                [one] => Some([0.0, (one - truth) * (one - truth)]),
                _ => {
                    let (mean, variance) = moments(runs)?;
                    Some([variance, (mean - truth) * (mean - truth) - variance / runs.len() as f64])
                }
            })],
            &[],
        ),
        fresh(
            19,
            chapter_19_mirrors::check::exercise,
            &[("x of `normal` is left out", |d, n| {
                let n = [0.0, n[1], n[2]];
                sub(d, times(n, 2.0 * dot(d, n) / dot(n, n)))
            })],
            &[],
        ),
        fresh(
            21,
            chapter_21_soft_shadows::check::exercise,
            &[
                ("the answer is cut off at 1", |from, at, n, area| {
                    let to = sub(from, at);
                    let cosine = dot(n, unit(to)).abs();
                    if cosine == 0.0 { 0.0 } else { (dot(to, to) / (cosine * area)).min(1.0) }
                }),
                ("a light that faces away has a negative pdf; on", |from, at, n, area| {
                    let to = sub(from, at);
                    let cosine = dot(n, unit(to));
                    if cosine == 0.0 { 0.0 } else { dot(to, to) / (cosine * area) }
                }),
            ],
            &[],
        ),
        fresh(
            22,
            chapter_22_ambient_occlusion::check::exercise,
            &[("the turn goes from +x towards −y; it goes", |u, v| {
                let (sin, cos) = (TAU * v).sin_cos();
                [u.sqrt() * cos, -u.sqrt() * sin, (1.0 - u).sqrt()]
            })],
            &[],
        ),
        fresh(
            23,
            chapter_23_depth_of_field::check::exercise,
            &[(
                /* y of the lens is forgotten */ "",
                |[x, y], t, [lx, _], f| unit([x * t * f - lx, y * t * f, -f]),
            )],
            &[],
        ),
        fresh(
            24,
            chapter_24_motion_blur::check::exercise,
            &[
                (/* only a sphere that comes nearer moves */ "", |o, d, c, r, v, time| {
                    let v = if dot(v, d) < 0.0 { v } else { [0.0; 3] };
                    let oc = sub(o, add(c, times(v, time)));
                    roots(1.0, dot(oc, d), dot(oc, oc) - r * r).into_iter().find(|t| *t > 0.0)
                }),
                ("the time is halved; the sphere moves by", |o, d, c, r, v, time| {
                    let oc = sub(o, add(c, times(v, time / 2.0)));
                    roots(1.0, dot(oc, d), dot(oc, oc) - r * r).into_iter().find(|t| *t > 0.0)
                }),
            ],
            &[],
        ),
        fresh(
            25,
            chapter_25_path_tracing::check::exercise,
            &[
                ("the probability is kept above a smallest one;", |w, u| {
                    let p = w[0].max(w[1]).max(w[2]).clamp(0.05, 1.0);
                    if u < p { over(w, p) } else { [0.0; 3] }
                }),
                ("the probability is that of red alone; asked is", |w, u| {
                    let p = w[0].min(1.0);
                    if u < p { over(w, p) } else { [0.0; 3] }
                }),
            ],
            &[],
        ),
        fresh(
            27,
            chapter_27_caustics::check::exercise,
            &[("there are height² pixels on the plane, as it is", |p, t, _| {
                let cosine = -p[2] / length(p);
                if cosine <= 0.0 { 0.0 } else { 1.0 / (4.0 * t * t * dot(p, p) * cosine * cosine * cosine) }
            })],
            &[],
        ),
        fresh(
            28,
            chapter_28_meshes::check::exercise,
            &[("one factor is taken for all three axes; each", |o, d, p, axes, s| {
                [sub(o, p), d].map(|v| axes.map(|axis| dot(axis, v) / s[0]))
            })],
            &[],
        ),
        fresh(
            30,
            chapter_30_tree::check::exercise,
            &[("a box in which the ray begins, at t = 0, is", |enters, closest| {
                match enters.map(|t| t.filter(|t| *t < closest && *t > 0.0)) {
                    [Some(a), Some(b)] if b < a => [Some(1), Some(0)],
                    [Some(_), b] => [Some(0), b.map(|_| 1)],
                    [None, b] => [b.map(|_| 1), None],
                }
            })],
            &[],
        ),
        fresh(
            32,
            chapter_32_projection::check::exercise,
            &[("the eye is not subtracted: the point is seen as", |p, _, axes, t, size| {
                placed(p, [0.0; 3], axes, t, size)
            })],
            &[],
        ),
        fresh(
            35,
            chapter_35_real_time::check::exercise,
            &[("the same point lies in the plane: s is 0, and", |n, m, o| {
                if dot(o, o) == 0.0 {
                    return 0.0;
                }
                let rise = dot(n, unit(o));
                power(dot(n, m).max(0.0)) * 0.01 / (0.01 + rise * rise)
            })],
            &[],
        ),
    ]
}
