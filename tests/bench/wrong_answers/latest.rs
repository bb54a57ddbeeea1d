//! The latest set: written from the pages when the ones before had been seen to, before looking at what had become of them.
//! Without words are those that got none, or wrong ones, when they were first tried.
#![allow(clippy::suboptimal_flops, reason = "as a reader writes it")]

use super::{Fresh, add, cross, dot, fresh, length, over, sub, times, unit};
use pinhole::scene::FovAxis;
use pinhole_cli::checks::*;
use std::f64::consts::{PI, TAU};

pub fn all() -> Vec<Fresh> {
    [first(), light(), paths(), last()].into_iter().flatten().collect()
}

fn first() -> Vec<Fresh> {
    vec![
        fresh(
            1,
            chapter_01_image::check::exercise,
            &[
                (/* a row has one pixel more */ "rows are taken to be one pixel longer; a row", |i, w| {
                    let w = u64::from(w) + 1;
                    [i % w, i / w].map(|place| place as f64 + 0.5)
                }),
                (/* pixels are counted from 1 */ "pixels are counted from 1; the first is number", |i, w| {
                    let (i, w) = (i.saturating_sub(1), u64::from(w));
                    [i % w, i / w].map(|place| place as f64 + 0.5)
                }),
            ],
            &[],
        ),
        fresh(
            3,
            chapter_03_hit::check::exercise,
            &[
                (
                    /* the distance, and not t */ "the direction is brought to length 1 and t is",
                    |o, d, c, r| Some(hit(o, d, c, r, 0.0)? * length(d)),
                ),
                (
                    /* nothing nearer than a small number */ "hits close to the origin are skipped; every t",
                    |o, d, c, r| hit(o, d, c, r, 1e-3),
                ),
            ],
            &[],
        ),
        fresh(
            4,
            chapter_04_orthographic::check::exercise,
            &[
                (
                    /* x and y of the screen are swapped */ "x and y are",
                    |[x, y], h| ([y * h / 2.0, x * h / 2.0, 0.0], [0.0, 0.0, -1.0]),
                ),
                (/* the rectangle is at z = 1 */ "the rectangle stands at z = 1; here it stands", |[x, y], h| {
                    ([x * h / 2.0, y * h / 2.0, 1.0], [0.0, 0.0, -1.0])
                }),
            ],
            &[],
        ),
        fresh(
            5,
            chapter_05_pinhole::check::exercise,
            &[
                (
                    /* the image plane is behind the eye */ "the image plane stands at z = +1; the camera",
                    |[x, y], t| unit([x * t, y * t, 1.0]),
                ),
                (
                    /* the depth is multiplied as well */ "the tangent is left out, or multiplies z as",
                    |[x, y], t| unit([x * t, y * t, -t]),
                ),
            ],
            &[|[x, y], t| unit([x, y, -1.0 / t])],
        ),
        fresh(
            6,
            chapter_06_ndc::check::exercise,
            &[
                (/* y is counted from below */ "y is counted from the bottom; in NDC it points", |[x, y], w, h| {
                    let is_inside = (0.0..1.0).contains(&x) && (0.0..1.0).contains(&y);
                    is_inside.then(|| [(x * f64::from(w)) as u32, h - 1 - (y * f64::from(h)) as u32])
                }),
                (/* width and height are swapped */ "width and height are", |[x, y], w, h| {
                    let is_inside = (0.0..1.0).contains(&x) && (0.0..1.0).contains(&y);
                    is_inside.then(|| [(x * f64::from(h)) as u32, (y * f64::from(w)) as u32])
                }),
            ],
            &[],
        ),
        fresh(
            7,
            chapter_07_screen::check::exercise,
            &[
                (/* not halved */ "a part runs from 0 to 2; its division by 2 is", |[x, y], w, h| {
                    [x * f64::from(h) / f64::from(w) + 1.0, 1.0 - y]
                }),
                (/* the aspect belongs to y */ "the aspect is put into y; only x is as much", |[x, y], w, h| {
                    [(x + 1.0) / 2.0, (1.0 - y * f64::from(w) / f64::from(h)) / 2.0]
                }),
            ],
            &[],
        ),
        fresh(
            8,
            chapter_08_field_of_view::check::exercise,
            &[
                (/* in radians */ "the answer is in radians; degrees are asked", |a, axis, w, h| {
                    2.0 * ((a.to_radians() / 2.0).tan() * f64::from(h) / across(axis, w, h)).atan()
                }),
                (
                    /* the diagonal is taken for the width */ "the diagonal is taken for something else: it is",
                    |a, axis, w, h| {
                        let axis = if matches!(axis, FovAxis::Diagonal) { FovAxis::Horizontal } else { axis };
                        2.0 * ((a.to_radians() / 2.0).tan() * f64::from(h) / across(axis, w, h)).atan().to_degrees()
                    },
                ),
            ],
            &[],
        ),
        fresh(
            9,
            chapter_09_camera_to_world::check::exercise,
            &[
                (
                    /* the inverse, not transposed */ "the inverse is not transposed, or the columns",
                    |[a, b, c], n| {
                        let det = dot(a, cross(b, c));
                        let rows = [cross(b, c), cross(c, a), cross(a, b)];
                        unit(times(rows.map(|row| dot(row, n)), det.signum()))
                    },
                ),
                (
                    /* mirrored maps turn it inside */ "a mirroring map turns the normal inside out:",
                    |[a, b, c], n| {
                        let [x, y, z] = [cross(b, c), cross(c, a), cross(a, b)];
                        unit(add(add(times(x, n[0]), times(y, n[1])), times(z, n[2])))
                    },
                ),
            ],
            &[],
        ),
    ]
}

fn light() -> Vec<Fresh> {
    vec![
        fresh(
            10,
            chapter_10_light_and_shadow::check::exercise,
            &[
                (
                    /* a light farther than 10 does not count */
                    "the answer is 0.0 where `position` and `light`",
                    |c, i, p, n, l| {
                        let to = sub(l, p);
                        let d2 = dot(to, to);
                        if d2 == 0.0 || d2 > 100.0 { 0.0 } else { c / PI * i * dot(n, unit(to)).max(0.0) / d2 }
                    },
                ),
                (/* the colour is squared */ "`colour` is", |c, i, p, n, l| {
                    let to = sub(l, p);
                    let d2 = dot(to, to);
                    if d2 == 0.0 { 0.0 } else { c * c / PI * i * dot(n, unit(to)).max(0.0) / d2 }
                }),
            ],
            &[],
        ),
        fresh(
            13,
            chapter_13_shapes::check::exercise,
            &[
                (
                    /* z is left out */ "z is left out: a box has three",
                    |o, d, low, high| slabs(o, d, low, high, 2, 0.0),
                ),
                (/* nothing nearer than a small number */ "", |o, d, low, high| slabs(o, d, low, high, 3, 1e-3)),
            ],
            &[],
        ),
        fresh(
            14,
            chapter_14_transforms::check::exercise,
            &[
                (
                    /* the weights are left out */ "the weights are left out; each corner's normal",
                    |g, n, _, eye, light| falling(g, n, [1.0 / 3.0; 3], eye, light),
                ),
                (
                    /* the cosine is squared */ "the answer is",
                    |g, n, w, eye, light| falling(g, n, w, eye, light).powi(2),
                ),
            ],
            &[],
        ),
        fresh(
            15,
            chapter_15_reflection::check::exercise,
            &[
                (
                    /* the eye is taken for the light */ "`to_eye` is taken in place of",
                    |c, i, n, _, v| phong(c, i, n, v, v),
                ),
                (
                    /* colour and specular are swapped */ "colour and specular are",
                    |[c, s, e], i, n, l, v| phong([s, c, e], i, n, l, v),
                ),
            ],
            &[],
        ),
        fresh(
            16,
            chapter_16_textures::check::exercise,
            &[
                (/* x is the left end */ "the range reaches from x to x + width; half of", |x, w| {
                    if w == 0.0 { stripe(x) } else { (ramp(x + w) - ramp(x)) / w }
                }),
                (/* below 0 as above */ "below 0 the stripes are mirrored; stripe −1,", |x, w| {
                    let x = x.abs();
                    if w == 0.0 { stripe(x) } else { (ramp(x + w / 2.0) - ramp(x - w / 2.0)) / w }
                }),
            ],
            &[],
        ),
        fresh(
            17,
            chapter_17_sampling::check::exercise,
            &[
                (
                    /* from the left rim, and not from the centre */
                    "the place is counted from the tent's left end;",
                    |u, r| r + tent(u, r),
                ),
                (
                    /* the radius is squared */ "the radius is a factor twice; the tent ends at",
                    |u, r| r * tent(u, r),
                ),
            ],
            &[],
        ),
        fresh(
            19,
            chapter_19_mirrors::check::exercise,
            &[
                (/* back along the other side */ "what comes out goes into the mirror: it is d −", |d, n| {
                    sub(times(n, 2.0 * dot(d, n) / dot(n, n)), d)
                }),
                (/* only the part along the normal is left */ "", |d, n| times(n, -dot(d, n) / dot(n, n))),
            ],
            &[],
        ),
    ]
}

fn paths() -> Vec<Fresh> {
    vec![
        fresh(
            20,
            chapter_20_glass::check::exercise,
            &[
                (
                    /* into a thinner medium all is reflected */ "out of a medium of a higher index some light",
                    |d, n, eta| if eta < 1.0 { None } else { refract(d, n, eta) },
                ),
                (
                    /* it goes on above the surface */ "what comes out goes back to the near side: the",
                    |d, n, eta| {
                        let beyond = refract(d, n, eta)?;
                        Some(sub(beyond, times(n, 2.0 * dot(beyond, n))))
                    },
                ),
            ],
            &[],
        ),
        fresh(
            21,
            chapter_21_soft_shadows::check::exercise,
            &[
                (
                    /* the cosine of a vector that is not of length 1 */
                    "the distance counts once, not squared; normal ·",
                    |from, at, n, area| {
                        let to = sub(from, at);
                        let cosine = dot(n, to).abs();
                        if cosine == 0.0 { 0.0 } else { dot(to, to) / (cosine * area) }
                    },
                ),
                (/* both sides are counted */ "the area is taken twice; though both sides", |from, at, n, area| {
                    let to = sub(from, at);
                    let cosine = dot(n, unit(to)).abs();
                    if cosine == 0.0 { 0.0 } else { dot(to, to) / (2.0 * cosine * area) }
                }),
            ],
            &[],
        ),
        fresh(
            22,
            chapter_22_ambient_occlusion::check::exercise,
            &[
                (/* half a turn */ "v makes half a turn only; a full one is", |u, v| {
                    let (sin, cos) = (PI * v).sin_cos();
                    [u.sqrt() * cos, u.sqrt() * sin, (1.0 - u).sqrt()]
                }),
                (/* the height lacks its root */ "the height is not that of a unit vector: x² +", |u, v| {
                    let (sin, cos) = (TAU * v).sin_cos();
                    [u.sqrt() * cos, u.sqrt() * sin, 1.0 - u]
                }),
            ],
            &[],
        ),
        fresh(
            23,
            chapter_23_depth_of_field::check::exercise,
            &[
                (
                    /* the lens is as wide as the focus is far */ "the plane in focus is always at distance",
                    |[x, y], t, [u, v], f| unit([f * x * t - f * u, f * y * t - f * v, -f]),
                ),
                (
                    /* x and y of the lens are swapped */ "x of `lens` and y of `lens` are",
                    |[x, y], t, [u, v], f| unit([f * x * t - v, f * y * t - u, -f]),
                ),
            ],
            &[],
        ),
        fresh(
            24,
            chapter_24_motion_blur::check::exercise,
            &[
                (
                    /* it moves in the opposite direction sideways */ "x of `velocity` has the opposite",
                    |o, d, c, r, v, time| hit(o, d, add(c, times([-v[0], v[1], v[2]], time)), r, 0.0),
                ),
                (/* no later than 1 */ "`time` is kept between 0 and", |o, d, c, r, v, time| {
                    hit(o, d, add(c, times(v, time.min(1.0))), r, 0.0)
                }),
            ],
            &[],
        ),
        fresh(
            25,
            chapter_25_path_tracing::check::exercise,
            &[
                (/* the smallest of the three */ "the probability is the smallest of the three;", |w, u| {
                    let p = w[0].min(w[1]).min(w[2]).min(1.0);
                    if u < p { over(w, p) } else { [0.0; 3] }
                }),
                (/* grey comes out */ "", |w, u| {
                    let p = w[0].max(w[1]).max(w[2]).min(1.0);
                    if u < p { [w[0].max(w[1]).max(w[2]) / p; 3] } else { [0.0; 3] }
                }),
            ],
            &[],
        ),
        fresh(
            26,
            chapter_26_choosing_samples::check::exercise,
            &[
                (
                    /* the square of the balance heuristic */ "that is the balance heuristic squared; square",
                    |own, other| {
                        if own == 0.0 { 0.0 } else { (1.0 / (1.0 + other / own)).powi(2) }
                    },
                ),
                (
                    /* the third power */ "each pdf is cubed instead of",
                    |own, other| {
                        if own == 0.0 { 0.0 } else { 1.0 / (1.0 + (other / own).powi(3)) }
                    },
                ),
            ],
            &[],
        ),
    ]
}

fn last() -> Vec<Fresh> {
    vec![
        fresh(
            27,
            chapter_27_caustics::check::exercise,
            &[
                (
                    /* the plane is tan_half high */ "the plane at distance 1 is 2 tan_half high, not",
                    |p, t, h| fraction(p, t / 2.0, h),
                ),
                (
                    /* the side of a pixel is taken for its area */ "A is the area of a pixel, its side",
                    |p, t, h| fraction(p, t, h) * 2.0 * t / h,
                ),
            ],
            &[],
        ),
        fresh(
            28,
            chapter_28_meshes::check::exercise,
            &[
                (
                    /* the factors are in the opposite order */ "x of `scale` and z of `scale` are",
                    |o, d, p, axes, [a, b, c]| own(o, d, p, axes, [c, b, a]),
                ),
                (
                    /* the origin stays in the world */ "`position` makes no difference to your answers;",
                    |o, d, p, axes, s| [o, own(o, d, p, axes, s)[1]],
                ),
            ],
            &[],
        ),
        fresh(
            29,
            chapter_29_boxes::check::exercise,
            &[
                (
                    /* wholly before t_max */ "a box that reaches beyond t_max counts, too,",
                    |o, inverse, low, high, t_max| {
                        let (enters, leaves) = interval(o, inverse, low, high);
                        enters.max(0.0) <= leaves && leaves <= t_max
                    },
                ),
                (
                    /* it must be entered */ "a ray from inside the box is in it, too, though",
                    |o, inverse, low, high, t_max| {
                        let (enters, leaves) = interval(o, inverse, low, high);
                        enters >= 0.0 && enters <= leaves.min(t_max)
                    },
                ),
            ],
            &[],
        ),
        fresh(
            32,
            chapter_32_projection::check::exercise,
            &[
                (
                    /* from the middle of the image */ "the middle of the image is at half its size: x",
                    |p, eye, axes, t, size| {
                        let [x, y] = placed(p, eye, axes, t, size, 1.0);
                        [x - f64::from(size[0]) / 2.0, y - f64::from(size[1]) / 2.0]
                    },
                ),
                (
                    /* y is squeezed, too */ "tan_half is that of the vertical field of view:",
                    |p, eye, axes, t, size| placed(p, eye, axes, t, size, f64::from(size[1]) / f64::from(size[0])),
                ),
            ],
            &[],
        ),
        fresh(
            35,
            chapter_35_real_time::check::exercise,
            &[
                (/* the mean of both factors */ "the mean of the factors is taken; they are to", |n, m, o| {
                    let (faces, plane) = weights(n, m, o);
                    (faces + plane) / 2.0
                }),
                (/* the other's normal in both */ "two things went wrong. First, only the plane", |_, m, o| {
                    let (faces, plane) = weights(m, m, o);
                    faces * plane
                }),
            ],
            &[],
        ),
    ]
}

fn hit(o: [f64; 3], d: [f64; 3], c: [f64; 3], r: f64, least: f64) -> Option<f64> {
    let oc = sub(c, o);
    let (a, b) = (dot(d, d), dot(oc, d));
    let aside = sub(oc, times(d, b / a));
    let root = ((r * r - dot(aside, aside)) / a).sqrt();
    [b / a - root, b / a + root].into_iter().find(|t| *t > least)
}

fn across(axis: FovAxis, w: u32, h: u32) -> f64 {
    let (w, h) = (f64::from(w), f64::from(h));
    match axis {
        FovAxis::Vertical => h,
        FovAxis::Horizontal => w,
        FovAxis::Smaller => w.min(h),
        FovAxis::Larger => w.max(h),
        FovAxis::Diagonal => w.hypot(h),
    }
}

fn slabs(o: [f64; 3], d: [f64; 3], low: [f64; 3], high: [f64; 3], axes: usize, least: f64) -> Option<f64> {
    let (mut enters, mut leaves) = (f64::NEG_INFINITY, f64::INFINITY);
    for at in 0..axes {
        if d[at] == 0.0 {
            if o[at] < low[at] || o[at] > high[at] {
                return None;
            }
            continue;
        }
        let [one, two] = [low[at], high[at]].map(|face| (face - o[at]) / d[at]);
        (enters, leaves) = (enters.max(one.min(two)), leaves.min(one.max(two)));
    }
    if enters > leaves { None } else { [enters, leaves].into_iter().find(|t| *t > least && t.is_finite()) }
}

fn falling(g: [f64; 3], n: [[f64; 3]; 3], w: [f64; 3], eye: [f64; 3], light: [f64; 3]) -> f64 {
    let side = if dot(g, eye) < 0.0 { -1.0 } else { 1.0 };
    let g = times(g, side);
    let mixed = unit(add(add(times(n[0], w[0]), times(n[1], w[1])), times(n[2], w[2])));
    let mixed = if dot(mixed, g) < 0.0 { times(mixed, -1.0) } else { mixed };
    if dot(g, light) <= 0.0 { 0.0 } else { dot(mixed, unit(light)).max(0.0) }
}

fn phong([c, s, e]: [f64; 3], i: f64, n: [f64; 3], l: [f64; 3], v: [f64; 3]) -> f64 {
    let cosine = dot(n, l);
    if cosine <= 0.0 {
        return 0.0;
    }
    let along = dot(sub(times(n, 2.0 * cosine), l), v);
    let highlight = if along > 0.0 { s * (e + 2.0) / TAU * along.powf(e) } else { 0.0 };
    i * cosine * (c / PI + highlight)
}

fn stripe(x: f64) -> f64 {
    if x.floor().rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 }
}

fn ramp(x: f64) -> f64 {
    let x = x.rem_euclid(2.0);
    if x < 1.0 { x } else { 2.0 - x }
}

fn tent(u: f64, r: f64) -> f64 {
    if u < 0.5 { r * ((2.0 * u).sqrt() - 1.0) } else { r * (1.0 - (2.0 - 2.0 * u).sqrt()) }
}

fn refract(d: [f64; 3], n: [f64; 3], eta: f64) -> Option<[f64; 3]> {
    let cosine = -dot(d, n);
    let squared = 1.0 - (1.0 - cosine * cosine) / (eta * eta);
    (squared >= 0.0).then(|| add(over(d, eta), times(n, cosine / eta - squared.sqrt())))
}

fn fraction(p: [f64; 3], t: f64, h: f64) -> f64 {
    if p[2] >= 0.0 {
        return 0.0;
    }
    let (side, d) = (2.0 * t / h, length(p));
    let cosine = -p[2] / d;
    1.0 / (side * side * d * d * cosine * cosine * cosine)
}

fn own(o: [f64; 3], d: [f64; 3], p: [f64; 3], axes: [[f64; 3]; 3], s: [f64; 3]) -> [[f64; 3]; 2] {
    let turned = [sub(o, p), d].map(|v| axes.map(|axis| dot(axis, v)));
    turned.map(|[x, y, z]| [x / s[0], y / s[1], z / s[2]])
}

fn interval(o: [f64; 3], inverse: [f64; 3], low: [f64; 3], high: [f64; 3]) -> (f64, f64) {
    let (mut enters, mut leaves) = (f64::NEG_INFINITY, f64::INFINITY);
    for at in 0..3 {
        if inverse[at].is_infinite() {
            if o[at] < low[at] || o[at] > high[at] {
                return (1.0, 0.0);
            }
            continue;
        }
        let [one, two] = [low[at], high[at]].map(|face| (face - o[at]) * inverse[at]);
        (enters, leaves) = (enters.max(one.min(two)), leaves.min(one.max(two)));
    }
    (enters, leaves)
}

fn placed(p: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3], t: f64, size: [u32; 2], squeezed: f64) -> [f64; 2] {
    let [x, y, z] = axes.map(|axis| dot(axis, sub(p, eye)));
    let [w, h] = size.map(f64::from);
    [(1.0 + x / -z / t * h / w) / 2.0 * w, (1.0 - squeezed * y / -z / t) / 2.0 * h]
}

fn weights(n: [f64; 3], m: [f64; 3], o: [f64; 3]) -> (f64, f64) {
    let sine = if dot(o, o) == 0.0 { 0.0 } else { dot(n, unit(o)) };
    (dot(n, m).max(0.0).powi(32), 0.01 / (0.01 + sine * sine))
}
