//! Of chapters 29 to 35.

use super::{Fresh, dot, fresh, length, over, sub, times, unit};
use pinhole_cli::checks::{
    chapter_29_boxes, chapter_30_tree, chapter_31_wide_tree, chapter_32_projection, chapter_33_rasterisation,
    chapter_34_both, chapter_35_real_time,
};
use std::f64::consts::FRAC_PI_2;

pub fn all() -> Vec<Fresh> {
    vec![boxes(), tree(), wide_tree(), projection(), rasterisation(), both(), real_time()]
}

/// Where the line is between two faces of one axis.
fn slab(o: f64, inverse: f64, low: f64, high: f64) -> [f64; 2] {
    if inverse.is_infinite() {
        return if low <= o && o <= high {
            [f64::NEG_INFINITY, f64::INFINITY]
        } else {
            [f64::INFINITY, f64::NEG_INFINITY]
        };
    }
    let (a, b) = ((low - o) * inverse, (high - o) * inverse);
    [a.min(b), a.max(b)]
}

/// The last entry and the first exit.
fn span(o: [f64; 3], i: [f64; 3], low: [f64; 3], high: [f64; 3]) -> [f64; 2] {
    let [x, y, z] = [0, 1, 2].map(|at| slab(o[at], i[at], low[at], high[at]));
    [x[0].max(y[0]).max(z[0]), x[1].min(y[1]).min(z[1])]
}

fn boxes() -> Fresh {
    use chapter_29_boxes::check::exercise;
    fresh(
        29,
        exercise,
        &[
            ("a box beyond t_max counts", |o, i, low, high, _| {
                let [near, far] = span(o, i, low, high);
                near <= far && far >= 0.0
            }),
            ("a box behind the origin counts", |o, i, low, high, max| {
                let [near, far] = span(o, i, low, high);
                near <= far && near <= max
            }),
            ("a ray from inside the box is in it, too, though it entered before t = ", |o, i, low, high, max| {
                let [near, far] = span(o, i, low, high);
                near <= far && near >= 0.0 && near <= max
            }),
            ("only two of the three axes are looked at", |o, i, low, high, max| {
                let [x, y, _] = [0, 1, 2].map(|at| slab(o[at], i[at], low[at], high[at]));
                let (near, far) = (x[0].max(y[0]).max(0.0), x[1].min(y[1]).min(max));
                near <= far
            }),
            ("flat boxes and edges are lost", |o, i, low, high, max| {
                let [near, far] = span(o, i, low, high);
                near.max(0.0) < far.min(max)
            }),
            ("it is divided by `inverse`, which is 1 over the direction already", |o, d, low, high, max| {
                let [near, far] = span(o, d.map(f64::recip), low, high);
                near <= far && far >= 0.0 && near <= max
            }),
            ("a ray that goes towards smaller coordinates enters by the upper plane", |o, i, low, high, max| {
                let (mut near, mut far) = (0.0_f64, max);
                for at in 0..3 {
                    let [a, b] = slab(o[at], i[at], low[at], high[at]);
                    let [a, b] = if i[at] < 0.0 && i[at].is_finite() { [b, a] } else { [a, b] };
                    (near, far) = (near.max(a), far.min(b));
                }
                near <= far
            }),
            (/* each axis by itself */ "", |o, i, low, high, max| {
                let enters = |at: usize| {
                    let [near, far] = slab(o[at], i[at], low[at], high[at]);
                    near <= max && far >= 0.0
                };
                enters(0) && enters(1) && enters(2)
            }),
            ("where `inverse` is infinite nothing is asked", |o, i, low, high, max| {
                let mut near_far = [0.0, max];
                for at in (0..3).filter(|&at| i[at].is_finite()) {
                    let [a, b] = slab(o[at], i[at], low[at], high[at]);
                    near_far = [near_far[0].max(a), near_far[1].min(b)];
                }
                near_far[0] <= near_far[1]
            }),
            ("a box that reaches beyond t_max counts, too, where it begins before", |o, i, low, high, max| {
                let [near, far] = span(o, i, low, high);
                near <= far && far >= 0.0 && far <= max
            }),
            ("where `inverse` is infinite the ray is taken to miss", |o, i, low, high, max| {
                if i.iter().any(|part| part.is_infinite()) {
                    return false;
                }
                let [near, far] = span(o, i, low, high);
                near <= far && far >= 0.0 && near <= max
            }),
            (/* && and || mixed */ "", |o, i, low, high, max| {
                let [near, far] = span(o, i, low, high);
                near <= far && far >= 0.0 || near <= max && near > 0.0
            }),
            (/* returns after x */ "", |o, i, low, high, max| {
                let [near, far] = slab(o[0], i[0], low[0], high[0]);
                near.max(0.0) <= far.min(max)
            }),
        ],
        &[
            |o, i, low, high, max| {
                let (mut near, mut far) = (0.0_f64, max);
                for at in 0..3 {
                    let (first, last) = if i[at].is_sign_negative() { (high, low) } else { (low, high) };
                    let enter = (first[at] - o[at]) * i[at];
                    let leave = (last[at] - o[at]) * i[at];
                    near = near.max(enter);
                    far = far.min(leave);
                }
                near <= far
            },
            |o, i, low, high, max| {
                let mut left = (0.0, max);
                for at in [2, 0, 1] {
                    if i[at].is_infinite() {
                        if o[at] < low[at] || high[at] < o[at] {
                            return false;
                        }
                        continue;
                    }
                    let mut both = [low[at], high[at]].map(|face| (face - o[at]) * i[at]);
                    both.sort_by(f64::total_cmp);
                    left = (both[0].max(left.0), both[1].min(left.1));
                }
                left.0 <= left.1
            },
        ],
    )
}

/// Which child may hold something closer.
fn may(enters: Option<f64>, closest: f64) -> bool {
    enters.is_some_and(|t| t < closest)
}

fn tree() -> Fresh {
    use chapter_30_tree::check::exercise;
    fn ordered(first: u32, keep: [bool; 2]) -> [Option<u32>; 2] {
        let mut kept = [first, 1 - first].into_iter().filter(|&child| keep[child as usize]);
        [kept.next(), kept.next()]
    }
    fresh(
        30,
        exercise,
        &[
            ("child 1 is first where both are equally near", |[a, b], c| {
                ordered(u32::from(b <= a), [may(a, c), may(b, c)])
            }),
            ("the farther child comes first", |e, c| {
                let [a, b] = e.map(|t| t.unwrap_or(f64::INFINITY));
                ordered(u32::from(a < b), [may(e[0], c), may(e[1], c)])
            }),
            ("a child that begins behind the closest hit is visited", |e, _| {
                let [a, b] = e.map(|t| t.unwrap_or(f64::INFINITY));
                ordered(u32::from(b < a), [e[0].is_some(), e[1].is_some()])
            }),
            ("child 1 is first where both are equally near", |e, c| {
                let [a, b] = e.map(|t| t.unwrap_or(f64::INFINITY));
                ordered(u32::from(b <= a), [may(e[0], c), may(e[1], c)])
            }),
            ("the farther child is left out", |e, c| {
                let [a, b] = e.map(|t| t.unwrap_or(f64::INFINITY));
                [ordered(u32::from(b < a), [may(e[0], c), may(e[1], c)])[0], None]
            }),
            ("child 0 first, whichever is nearer", |e, c| ordered(0, [may(e[0], c), may(e[1], c)])),
            ("nothing is visited unless both children are", |e, c| {
                let (Some(a), Some(b)) = (e[0], e[1]) else { return [None, None] };
                ordered(u32::from(b < a), [a < c, b < c])
            }),
            ("a child is visited whose box the ray misses", |e, c| {
                let [a, b] = e.map(|t| t.unwrap_or(0.0));
                ordered(u32::from(b < a), [a < c, b < c])
            }),
            ("the comparison is the wrong way round", |e, c| {
                let [a, b] = e.map(|t| t.unwrap_or(f64::INFINITY));
                ordered(u32::from(b < a), [a > c, b > c])
            }),
            ("both are visited if the nearer one begins before the closest hit", |e, c| {
                let [a, b] = e.map(|t| t.unwrap_or(f64::INFINITY));
                if a.min(b) < c { ordered(u32::from(b < a), [e[0].is_some(), e[1].is_some()]) } else { [None; 2] }
            }),
            ("the children are counted from 1", |e, c| {
                let [a, b] = e.map(|t| t.unwrap_or(f64::INFINITY));
                ordered(u32::from(b < a), [may(e[0], c), may(e[1], c)]).map(|child| child.map(|child| child + 1))
            }),
            ("both are visited where either may hold a closer hit", |e, c| {
                let [a, b] = e.map(|t| t.unwrap_or(f64::INFINITY));
                ordered(u32::from(b < a), [a < c || b < c; 2])
            }),
            (/* compared as whole numbers */ "", |e, c| {
                let [a, b] = e.map(|t| t.map_or(u32::MAX, |t| t as u32));
                ordered(u32::from(b < a), [may(e[0], c), may(e[1], c)])
            }),
        ],
        &[
            |enters, closest| match enters.map(|t| t.filter(|t| *t < closest)) {
                [Some(a), Some(b)] if b < a => [Some(1), Some(0)],
                [Some(_), Some(_)] => [Some(0), Some(1)],
                [Some(_), None] => [Some(0), None],
                [None, Some(_)] => [Some(1), None],
                [None, None] => [None, None],
            },
            |enters, closest| {
                let mut list: Vec<(f64, u32)> =
                    enters.into_iter().zip(0..).filter_map(|(t, child)| Some((t?, child))).collect();
                list.retain(|(t, _)| !(*t >= closest));
                list.sort_by(|(a, _), (b, _)| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
                [0, 1].map(|at| list.get(at).map(|(_, child)| *child))
            },
        ],
    )
}

fn wide_tree() -> Fresh {
    use chapter_31_wide_tree::check::exercise;
    fn mask(hit: impl Fn(usize) -> bool) -> u32 {
        (0..8).filter(|&at| hit(at)).map(|at| 1 << at).sum()
    }
    fresh(
        31,
        exercise,
        &[
            ("a box that begins behind the closest hit is entered", |e, l, _| {
                mask(|at| e[at] <= l[at] && l[at] >= 0.0)
            }),
            ("a ray misses a box that it leaves before it enters it", |e, l, c| mask(|at| l[at] >= 0.0 && e[at] <= c)),
            ("the boxes are counted", |e, l, c| (0..8).filter(|&at| e[at].max(0.0) <= l[at].min(c)).count() as u32),
            ("flat boxes are lost", |e, l, c| mask(|at| e[at].max(0.0) < l[at].min(c))),
            ("the bits begin with bit 1", |e, l, c| mask(|at| e[at].max(0.0) <= l[at].min(c)) << 1),
            ("the mask is inverted", |e, l, c| mask(|at| e[at].max(0.0) > l[at].min(c))),
            ("only some of the boxes are asked", |e, l, c| mask(|at| at < 4 && e[at].max(0.0) <= l[at].min(c))),
            ("the numbers of the boxes are added", |e, l, c| {
                (0..8).filter(|&at| e[at].max(0.0) <= l[at].min(c)).map(|at| at as u32).sum()
            }),
            ("a box that reaches behind the closest hit counts, too, where it begins", |e, l, c| {
                mask(|at| e[at] <= l[at] && l[at] >= 0.0 && l[at] <= c)
            }),
            ("only the nearest box is in the mask", |e, l, c| {
                let hit = (0..8).filter(|&at| e[at].max(0.0) <= l[at].min(c));
                hit.min_by(|&a, &b| e[a].total_cmp(&e[b])).map_or(0, |at| 1 << at)
            }),
            ("the numbers of the boxes are added", |e, l, c| {
                let hit = (0..8).filter(|&at| e[at].max(0.0) <= l[at].min(c));
                hit.map(|at| 2 * at as u32).sum()
            }),
            ("nothing is asked after the first box that the ray misses", |e, l, c| {
                let mut bits = 0;
                for at in 0..8 {
                    if e[at].max(0.0) > l[at].min(c) {
                        break;
                    }
                    bits |= 1 << at;
                }
                bits
            }),
            ("only the last box is in the mask", |e, l, c| {
                let mut bits = 0;
                for at in 0..8 {
                    if e[at].max(0.0) <= l[at].min(c) {
                        bits = 1 << at;
                    }
                }
                bits
            }),
            ("nothing is asked after the first box behind the closest hit", |e, l, c| {
                let mut bits = 0;
                for at in 0..8 {
                    if e[at] > c {
                        break;
                    }
                    if e[at].max(0.0) <= l[at] {
                        bits |= 1 << at;
                    }
                }
                bits
            }),
        ],
        &[
            |e, l, c| {
                let mut bits = 0;
                for at in (0..8).rev() {
                    bits *= 2;
                    if e[at] <= l[at] && 0.0 <= l[at] && e[at] <= c {
                        bits += 1;
                    }
                }
                bits
            },
            |e, l, c| {
                e.iter().zip(l).enumerate().fold(0, |bits, (at, (enter, leave))| {
                    let missed = *enter > leave || leave < 0.0 || *enter > c;
                    bits | u32::from(!missed) << at
                })
            },
        ],
    )
}

/// In the camera's axes.
fn seen(p: [f64; 3], eye: [f64; 3], axes: [[f64; 3]; 3]) -> [f64; 3] {
    axes.map(|axis| dot(sub(p, eye), axis))
}

/// In pixels, of a point of the image plane.
fn pixels([x, y]: [f64; 2], t: f64, [w, h]: [u32; 2]) -> [f64; 2] {
    let (w, h) = (f64::from(w), f64::from(h));
    [w / 2.0 + x / t * h / 2.0, h / 2.0 - y / t * h / 2.0]
}

fn projection() -> Fresh {
    use chapter_32_projection::check::exercise;
    fresh(
        32,
        exercise,
        &[
            ("it is multiplied by tan_half", |p, eye, a, t, s| {
                let [x, y, z] = seen(p, eye, a);
                pixels([-x / z, -y / z], 1.0 / t, s)
            }),
            ("the size is taken for height and width", |p, eye, a, t, [w, h]| {
                let [x, y, z] = seen(p, eye, a);
                pixels([-x / z, -y / z], t, [h, w])
            }),
            ("the point goes from the camera to the world", |p, eye, a, t, s| {
                let v = sub(p, eye);
                let [x, y, z] = [0, 1, 2].map(|row| a[0][row] * v[0] + a[1][row] * v[1] + a[2][row] * v[2]);
                pixels([-x / z, -y / z], t, s)
            }),
            ("the eye is not subtracted", |p, _, a, t, s| {
                let [x, y, z] = seen(p, [0.0; 3], a);
                pixels([-x / z, -y / z], t, s)
            }),
            ("half a pixel is subtracted", |p, eye, a, t, s| {
                let [x, y, z] = seen(p, eye, a);
                pixels([-x / z, -y / z], t, s).map(|part| part - 0.5)
            }),
            ("the point is rounded to a whole pixel", |p, eye, a, t, s| {
                let [x, y, z] = seen(p, eye, a);
                pixels([-x / z, -y / z], t, s).map(f64::floor)
            }),
            ("nothing is divided by the depth, as for an orthographic camera", |p, eye, a, t, s| {
                let [x, y, _] = seen(p, eye, a);
                pixels([x, y], t, s)
            }),
            ("the aspect is left out", |p, eye, a, t, [w, h]| {
                let [x, y, z] = seen(p, eye, a);
                let (x, y) = (-x / z / t / f64::from(w / h.min(w).max(1)), -y / z / t);
                [(x + 1.0) / 2.0 * f64::from(w), (1.0 - y) / 2.0 * f64::from(h)]
            }),
            ("tan_half is halved or doubled", |p, eye, a, t, s| {
                let [x, y, z] = seen(p, eye, a);
                pixels([-x / z * 2.0, -y / z * 2.0], t, s)
            }),
            ("that is NDC, from 0 to 1", |p, eye, a, t, s| {
                let [x, y, z] = seen(p, eye, a);
                let [x, y] = pixels([-x / z, -y / z], t, s);
                [x / f64::from(s[0]), y / f64::from(s[1])]
            }),
            ("x is turned round", |p, eye, a, t, s| {
                let [x, y, z] = seen(p, eye, a);
                pixels([x / z, -y / z], t, s)
            }),
            ("`size` is taken to be 1 less", |p, eye, a, t, [w, h]| {
                let [x, y, z] = seen(p, eye, a);
                pixels([-x / z, -y / z], t, [w - 1, h - 1])
            }),
            ("tan_half is that of the vertical field of view", |p, eye, a, t, [w, h]| {
                let [x, y, z] = seen(p, eye, a);
                let (w, h) = (f64::from(w), f64::from(h));
                [w / 2.0 - x / z / t * w / 2.0, h / 2.0 + y / z / t * w / 2.0]
            }),
            (/* depth along the world's z */ "", |p, eye, a, t, s| {
                let [x, y, _] = seen(p, eye, a);
                pixels([-x / (p[2] - eye[2]), -y / (p[2] - eye[2])], t, s)
            }),
            (/* half the size as a whole number */ "", |p, eye, a, t, [w, h]| {
                let [x, y, z] = seen(p, eye, a);
                let [w, h] = [w / 2, h / 2].map(f64::from);
                [w - x / z / t * h, h + y / z / t * h]
            }),
        ],
        &[
            |p, eye, [right, up, back], t, [w, h]| {
                let to = sub(p, eye);
                let depth = -dot(to, back);
                let focal = f64::from(h) / (2.0 * t);
                [0.5 * f64::from(w) + focal * dot(to, right) / depth, 0.5 * f64::from(h) - focal * dot(to, up) / depth]
            },
            |p, eye, a, t, [w, h]| {
                let [x, y, z] = seen(p, eye, a);
                let aspect = f64::from(w) / f64::from(h);
                let clip = [x / (aspect * t), y / t, -z];
                let ndc = [(1.0 + clip[0] / clip[2]) / 2.0, (1.0 - clip[1] / clip[2]) / 2.0];
                [ndc[0] * f64::from(w), ndc[1] * f64::from(h)]
            },
        ],
    )
}

/// Above 0 to the right of an edge, with y down.
fn side(from: [i32; 2], to: [i32; 2], s: [i32; 2]) -> i64 {
    let part = |a: i32, b: i32| i64::from(a) - i64::from(b);
    part(to[0], from[0]) * part(s[1], from[1]) - part(to[1], from[1]) * part(s[0], from[0])
}

fn top_left(from: [i32; 2], to: [i32; 2]) -> bool {
    to[1] < from[1] || (to[1] == from[1] && to[0] > from[0])
}

fn rasterisation() -> Fresh {
    use chapter_33_rasterisation::check::exercise;
    fresh(
        33,
        exercise,
        &[
            ("the inside is to the left", |f, t, s| side(f, t, s) < 0 || (side(f, t, s) == 0 && top_left(f, t))),
            ("a level edge belongs to the triangle where it goes to the right, a top", |f, t, s| {
                let top = t[1] == f[1] && t[0] < f[0];
                side(f, t, s) > 0 || (side(f, t, s) == 0 && (t[1] < f[1] || top))
            }),
            ("the edge function is rounded", |f, t, s| {
                let [ax, ay, bx, by, x, y] = [f[0], f[1], t[0], t[1], s[0], s[1]].map(|part| part as f32);
                let side = (bx - ax) * (y - ay) - (by - ay) * (x - ax);
                side > 0.0 || (side == 0.0 && top_left(f, t))
            }),
            ("the rule is turned round, to bottom and right edges", |f, t, s| {
                side(f, t, s) > 0 || (side(f, t, s) == 0 && !top_left(f, t))
            }),
            ("level edges are forgotten", |f, t, s| side(f, t, s) > 0 || (side(f, t, s) == 0 && t[1] < f[1])),
            ("left edges are forgotten", |f, t, s| {
                side(f, t, s) > 0 || (side(f, t, s) == 0 && t[1] == f[1] && t[0] > f[0])
            }),
            ("the edge is taken to end at its two corners", |f, t, s| {
                let beside = s[1] >= f[1].min(t[1]) && s[1] <= f[1].max(t[1]);
                beside && (side(f, t, s) > 0 || (side(f, t, s) == 0 && top_left(f, t)))
            }),
            ("a level edge belongs to the triangle where it goes to the right, a top", |f, t, s| {
                side(f, t, s) >= 0 && (side(f, t, s) != 0 || t[1] <= f[1])
            }),
            ("the inside is to the left", |f, t, s| {
                let [f, t, s] = [f, t, s].map(|[x, y]| [y, x]);
                side(f, t, s) > 0 || (side(f, t, s) == 0 && top_left(f, t))
            }),
            ("the edge function's sign is not asked for", |f, t, s| side(f, t, s) != 0 || top_left(f, t)),
            ("all samples are inside a top or left edge", |f, t, s| side(f, t, s) > 0 || top_left(f, t)),
            ("half a pixel is added to the sample", |f, t, s| {
                let s = s.map(|part| part + 128);
                side(f, t, s) > 0 || (side(f, t, s) == 0 && top_left(f, t))
            }),
            (
                /* by the sample, not the edge */ "",
                |f, t, s| side(f, t, s) > 0 || (side(f, t, s) == 0 && (s[1] < f[1] || (s[1] == f[1] && s[0] > f[0]))),
            ),
            ("the coordinates are divided first, which drops their fractions", |f, t, s| {
                let [f, t, s] = [f, t, s].map(|p| p.map(|part| part / 256));
                side(f, t, s) > 0 || (side(f, t, s) == 0 && top_left(f, t))
            }),
        ],
        &[
            |f, t, s| {
                let [dx, dy, px, py] = [t[0] - f[0], t[1] - f[1], s[0] - f[0], s[1] - f[1]].map(f64::from);
                match (dx * py).partial_cmp(&(dy * px)) {
                    Some(std::cmp::Ordering::Greater) => true,
                    Some(std::cmp::Ordering::Equal) => dy < 0.0 || dy == 0.0 && dx > 0.0,
                    _ => false,
                }
            },
            |[ax, ay], [bx, by], [x, y]| {
                let wide = |part: i32| i128::from(part);
                let area = (wide(ax) - wide(x)) * (wide(by) - wide(y)) - (wide(ay) - wide(y)) * (wide(bx) - wide(x));
                let bias = if ay > by || (ay == by && ax < bx) { 0 } else { -1 };
                area + bias >= 0
            },
        ],
    )
}

fn both() -> Fresh {
    use chapter_34_both::check::exercise;
    /// As it should be.
    fn interval(x: f64, z: f64, r: f64, half: f64) -> [f64; 2] {
        let d = x.hypot(z);
        if d <= r {
            return [-half, half];
        }
        let (a, b) = (x.atan2(z), (r / d).asin());
        let at = |angle: f64| {
            if angle <= -FRAC_PI_2 {
                -half
            } else if angle >= FRAC_PI_2 {
                half
            } else {
                angle.tan().clamp(-half, half)
            }
        };
        [at(a - b), at(a + b)]
    }
    fresh(
        34,
        exercise,
        &[
            ("both ends are taken at the depth of the centre", |x, z, r, half| {
                [(x - r) / z, (x + r) / z].map(|at| at.clamp(-half, half))
            }),
            ("an end beyond the image's edge is left there", |x, z, r, _| interval(x, z, r, f64::INFINITY)),
            ("the centre's distance is taken for the tangents' length, which is √(ri", |x, z, r, half| {
                let (a, b) = (x.atan2(z), (r / x.hypot(z)).atan());
                [(a - b).tan(), (a + b).tan()].map(|at| at.clamp(-half, half))
            }),
            ("the radius is divided by how far the centre is ahead", |x, z, r, half| {
                let (a, b) = ((x / z).atan(), (r / z).asin());
                [(a - b).tan(), (a + b).tan()].map(|at| at.clamp(-half, half))
            }),
            ("those are angles, or their sines", |x, z, r, half| {
                let (a, b) = (x.atan2(z), (r / x.hypot(z)).asin());
                [a - b, a + b].map(|at| at.clamp(-half, half))
            }),
            ("the ends are swapped", |x, z, r, half| {
                let [a, b] = interval(x, z, r, half);
                [b, a]
            }),
            ("a tangent that is not in front of the eye is divided all the same", |x, z, r, half| {
                let (a, b) = (x.atan2(z), (r / x.hypot(z)).asin());
                [(a - b).tan(), (a + b).tan()].map(|at| at.clamp(-half, half))
            }),
            ("the two ends are as far from the centre's image as if it were straight", |x, z, r, half| {
                let b = r / x.hypot(z);
                [x / z - b, x / z + b].map(|at| at.clamp(-half, half))
            }),
            ("the ends are multiplied by `ahead`", |x, z, r, half| {
                let [a, b] = interval(x, z, r, half);
                [a * z, b * z].map(|at| at.clamp(-half, half))
            }),
            ("the sphere is on the wrong side", |x, z, r, half| {
                let [a, b] = interval(x, z, r, half);
                [-b, -a]
            }),
            ("with its centre behind the eye the sphere still reaches in front of it", |x, z, r, half| {
                if z <= 0.0 { [-half, half] } else { interval(x, z, r, half) }
            }),
            ("the whole image is taken as soon as the sphere reaches beside the eye", |x, z, r, half| {
                if z <= r { [-half, half] } else { interval(x, z, r, half) }
            }),
            ("the ends are in NDC", |x, z, r, half| {
                let [a, b] = interval(x, z, r, half);
                [(a / half + 1.0) / 2.0, (b / half + 1.0) / 2.0]
            }),
            ("the two ends are as far from the centre's image as if it were straight", |x, z, r, half| {
                let l = (x * x + z * z - r * r).max(0.0).sqrt();
                [x / z - r / l, x / z + r / l].map(|at| at.clamp(-half, half))
            }),
            (/* half taken for an angle */ "", |x, z, r, half| {
                let (a, b) = (x.atan2(z), (r / x.hypot(z)).min(1.0).asin());
                [a - b, a + b].map(|at| at.clamp(-half, half).tan())
            }),
        ],
        &[
            |x, z, r, half| {
                let d2 = x * x + z * z;
                if d2 <= r * r {
                    return [-half, half];
                }
                let l = ((d2.sqrt() - r) * (d2.sqrt() + r)).sqrt();
                let left = [x * l - z * r, z * l + x * r];
                let right = [x * l + z * r, z * l - x * r];
                let at = |[x, z]: [f64; 2], beyond: f64| if z > 0.0 { (x / z).clamp(-half, half) } else { beyond };
                [at(left, -half), at(right, half)]
            },
            interval,
        ],
    )
}

fn real_time() -> Fresh {
    use chapter_35_real_time::check::exercise;
    fn power(c: f64) -> f64 {
        if c > 0.0 { c.powf(32.0) } else { 0.0 }
    }
    fn sine(n: [f64; 3], o: [f64; 3]) -> f64 {
        if length(o) > 0.0 { dot(n, o) / length(o) } else { 0.0 }
    }
    fn flat(s2: f64) -> f64 {
        0.01 / (0.01 + s2)
    }
    fresh(
        35,
        exercise,
        &[
            ("surfaces that face away count", |n, m, o| dot(n, m).abs().powf(32.0) * flat(sine(n, o) * sine(n, o))),
            ("the power is not the 32nd", |n, m, o| power(dot(n, m)).sqrt() * flat(sine(n, o) * sine(n, o))),
            ("the sine is not squared", |n, m, o| power(dot(n, m)) * flat(sine(n, o).abs())),
            ("that is the cosine, the part along the plane", |n, m, o| {
                power(dot(n, m)) * flat(1.0 - sine(n, o) * sine(n, o))
            }),
            ("the factors are added", |n, m, o| power(dot(n, m)) + flat(sine(n, o) * sine(n, o))),
            ("the plane's factor lacks its 0.01 above the line", |n, m, o| {
                power(dot(n, m)) / (0.01 + sine(n, o) * sine(n, o))
            }),
            ("it is the neighbour's plane", |n, m, o| power(dot(n, m)) * flat(sine(m, o) * sine(m, o))),
            ("0.1 is taken for 0.01", |n, m, o| power(dot(n, m)) * 0.1 / (0.1 + sine(n, o) * sine(n, o))),
            ("an exponential is taken for the quotient", |n, m, o| {
                power(dot(n, m)) * (-sine(n, o) * sine(n, o) / 0.01).exp()
            }),
            ("only the normals count", |n, m, _| power(dot(n, m))),
            ("only the plane counts", |n, _, o| flat(sine(n, o) * sine(n, o))),
            ("the cosine is multiplied by 32", |n, m, o| 32.0 * dot(n, m).max(0.0) * flat(sine(n, o) * sine(n, o))),
            ("the answer lacks its square", |n, m, o| (power(dot(n, m)) * flat(sine(n, o) * sine(n, o))).sqrt()),
            ("the smaller factor is taken", |n, m, o| power(dot(n, m)).min(flat(sine(n, o) * sine(n, o)))),
            ("the power is not the 32nd", |n, m, o| dot(n, m).max(0.0).powf(5.0) * flat(sine(n, o) * sine(n, o))),
            ("the plane is taken across the mean of both normals", |n, m, o| {
                let both = unit([n[0] + m[0], n[1] + m[1], n[2] + m[2]]);
                power(dot(n, m)) * flat(sine(both, o) * sine(both, o))
            }),
        ],
        &[
            |n, m, o| {
                let mut c = dot(n, m).max(0.0);
                for _ in 0..5 {
                    c *= c;
                }
                let (along, whole) = (dot(n, o), dot(o, o));
                if whole == 0.0 { c } else { c * whole / (whole + 100.0 * along * along) }
            },
            |n, m, o| {
                if dot(n, m) <= 0.0 {
                    return 0.0;
                }
                let same = (32.0 * dot(n, m).ln()).exp();
                if o == [0.0; 3] {
                    return same;
                }
                let across = over(sub(o, times(n, dot(n, o))), length(o));
                let s2 = (1.0 - dot(across, across)).max(0.0);
                same / (1.0 + s2 / 0.01)
            },
        ],
    )
}
