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
            ("t_max left out", |o, i, low, high, _| {
                let [near, far] = span(o, i, low, high);
                near <= far && far >= 0.0
            }),
            ("behind", |o, i, low, high, max| {
                let [near, far] = span(o, i, low, high);
                near <= far && near <= max
            }),
            ("inside lost", |o, i, low, high, max| {
                let [near, far] = span(o, i, low, high);
                near <= far && near >= 0.0 && near <= max
            }),
            ("z left out", |o, i, low, high, max| {
                let [x, y, _] = [0, 1, 2].map(|at| slab(o[at], i[at], low[at], high[at]));
                let (near, far) = (x[0].max(y[0]).max(0.0), x[1].min(y[1]).min(max));
                near <= far
            }),
            ("edges lost", |o, i, low, high, max| {
                let [near, far] = span(o, i, low, high);
                near.max(0.0) < far.min(max)
            }),
            ("divides by the inverse", |o, d, low, high, max| {
                let [near, far] = span(o, d.map(f64::recip), low, high);
                near <= far && far >= 0.0 && near <= max
            }),
            ("negative directions not swapped", |o, i, low, high, max| {
                let (mut near, mut far) = (0.0_f64, max);
                for at in 0..3 {
                    let [a, b] = slab(o[at], i[at], low[at], high[at]);
                    let [a, b] = if i[at] < 0.0 && i[at].is_finite() { [b, a] } else { [a, b] };
                    (near, far) = (near.max(a), far.min(b));
                }
                near <= far
            }),
            ("each axis by itself", |o, i, low, high, max| {
                let enters = |at: usize| {
                    let [near, far] = slab(o[at], i[at], low[at], high[at]);
                    near <= max && far >= 0.0
                };
                enters(0) && enters(1) && enters(2)
            }),
            ("parallel faces skipped", |o, i, low, high, max| {
                let mut near_far = [0.0, max];
                for at in (0..3).filter(|&at| i[at].is_finite()) {
                    let [a, b] = slab(o[at], i[at], low[at], high[at]);
                    near_far = [near_far[0].max(a), near_far[1].min(b)];
                }
                near_far[0] <= near_far[1]
            }),
            ("must be left before t_max", |o, i, low, high, max| {
                let [near, far] = span(o, i, low, high);
                near <= far && far >= 0.0 && far <= max
            }),
            ("false for any 0", |o, i, low, high, max| {
                if i.iter().any(|part| part.is_infinite()) {
                    return false;
                }
                let [near, far] = span(o, i, low, high);
                near <= far && far >= 0.0 && near <= max
            }),
            ("2: && and || mixed", |o, i, low, high, max| {
                let [near, far] = span(o, i, low, high);
                near <= far && far >= 0.0 || near <= max && near > 0.0
            }),
            ("2: returns after x", |o, i, low, high, max| {
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
            ("option order", |[a, b], c| ordered(u32::from(b <= a), [may(a, c), may(b, c)])),
            ("farther first", |e, c| {
                let [a, b] = e.map(|t| t.unwrap_or(f64::INFINITY));
                ordered(u32::from(a < b), [may(e[0], c), may(e[1], c)])
            }),
            ("closest left out", |e, _| {
                let [a, b] = e.map(|t| t.unwrap_or(f64::INFINITY));
                ordered(u32::from(b < a), [e[0].is_some(), e[1].is_some()])
            }),
            ("child 1 at a tie", |e, c| {
                let [a, b] = e.map(|t| t.unwrap_or(f64::INFINITY));
                ordered(u32::from(b <= a), [may(e[0], c), may(e[1], c)])
            }),
            ("nearer only", |e, c| {
                let [a, b] = e.map(|t| t.unwrap_or(f64::INFINITY));
                [ordered(u32::from(b < a), [may(e[0], c), may(e[1], c)])[0], None]
            }),
            ("gap in front", |e, c| {
                let [a, b] = e.map(|t| t.unwrap_or(f64::INFINITY));
                let both = if b < a { [1, 0] } else { [0, 1] };
                both.map(|child: u32| may(e[child as usize], c).then_some(child))
            }),
            ("child 0 always first", |e, c| ordered(0, [may(e[0], c), may(e[1], c)])),
            ("none where one is missed", |e, c| {
                let (Some(a), Some(b)) = (e[0], e[1]) else { return [None, None] };
                ordered(u32::from(b < a), [a < c, b < c])
            }),
            ("a miss counts as 0", |e, c| {
                let [a, b] = e.map(|t| t.unwrap_or(0.0));
                ordered(u32::from(b < a), [a < c, b < c])
            }),
            ("closest compared the wrong way", |e, c| {
                let [a, b] = e.map(|t| t.unwrap_or(f64::INFINITY));
                ordered(u32::from(b < a), [a > c, b > c])
            }),
            ("closest only for the nearer", |e, c| {
                let [a, b] = e.map(|t| t.unwrap_or(f64::INFINITY));
                if a.min(b) < c { ordered(u32::from(b < a), [e[0].is_some(), e[1].is_some()]) } else { [None; 2] }
            }),
            ("counted from 1", |e, c| {
                let [a, b] = e.map(|t| t.unwrap_or(f64::INFINITY));
                ordered(u32::from(b < a), [may(e[0], c), may(e[1], c)]).map(|child| child.map(|child| child + 1))
            }),
            ("2: both where either", |e, c| {
                let [a, b] = e.map(|t| t.unwrap_or(f64::INFINITY));
                ordered(u32::from(b < a), [a < c || b < c; 2])
            }),
            ("2: compared as whole numbers", |e, c| {
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
            ("closest left out", |e, l, _| mask(|at| e[at] <= l[at] && l[at] >= 0.0)),
            ("misses not looked at", |e, l, c| mask(|at| l[at] >= 0.0 && e[at] <= c)),
            ("count", |e, l, c| (0..8).filter(|&at| e[at].max(0.0) <= l[at].min(c)).count() as u32),
            ("touched boxes lost", |e, l, c| mask(|at| e[at].max(0.0) < l[at].min(c))),
            ("from bit 1", |e, l, c| mask(|at| e[at].max(0.0) <= l[at].min(c)) << 1),
            ("those missed", |e, l, c| mask(|at| e[at].max(0.0) > l[at].min(c))),
            ("first four", |e, l, c| mask(|at| at < 4 && e[at].max(0.0) <= l[at].min(c))),
            ("sum of indices", |e, l, c| (0..8).filter(|&at| e[at].max(0.0) <= l[at].min(c)).map(|at| at as u32).sum()),
            ("left before the closest", |e, l, c| mask(|at| e[at] <= l[at] && l[at] >= 0.0 && l[at] <= c)),
            ("nearest only", |e, l, c| {
                let hit = (0..8).filter(|&at| e[at].max(0.0) <= l[at].min(c));
                hit.min_by(|&a, &b| e[a].total_cmp(&e[b])).map_or(0, |at| 1 << at)
            }),
            ("2 i for 2^i", |e, l, c| {
                let hit = (0..8).filter(|&at| e[at].max(0.0) <= l[at].min(c));
                hit.map(|at| 2 * at as u32).sum()
            }),
            ("stops at the first miss", |e, l, c| {
                let mut bits = 0;
                for at in 0..8 {
                    if e[at].max(0.0) > l[at].min(c) {
                        break;
                    }
                    bits |= 1 << at;
                }
                bits
            }),
            ("2: the last only", |e, l, c| {
                let mut bits = 0;
                for at in 0..8 {
                    if e[at].max(0.0) <= l[at].min(c) {
                        bits = 1 << at;
                    }
                }
                bits
            }),
            ("2: stops at the first beyond the closest", |e, l, c| {
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
            ("times the tangent", |p, eye, a, t, s| {
                let [x, y, z] = seen(p, eye, a);
                pixels([-x / z, -y / z], 1.0 / t, s)
            }),
            ("width and height swapped", |p, eye, a, t, [w, h]| {
                let [x, y, z] = seen(p, eye, a);
                pixels([-x / z, -y / z], t, [h, w])
            }),
            ("axes transposed", |p, eye, a, t, s| {
                let v = sub(p, eye);
                let [x, y, z] = [0, 1, 2].map(|row| a[0][row] * v[0] + a[1][row] * v[1] + a[2][row] * v[2]);
                pixels([-x / z, -y / z], t, s)
            }),
            ("eye left out", |p, _, a, t, s| {
                let [x, y, z] = seen(p, [0.0; 3], a);
                pixels([-x / z, -y / z], t, s)
            }),
            ("half a pixel", |p, eye, a, t, s| {
                let [x, y, z] = seen(p, eye, a);
                pixels([-x / z, -y / z], t, s).map(|part| part - 0.5)
            }),
            ("whole pixels", |p, eye, a, t, s| {
                let [x, y, z] = seen(p, eye, a);
                pixels([-x / z, -y / z], t, s).map(f64::floor)
            }),
            ("not divided by depth", |p, eye, a, t, s| {
                let [x, y, _] = seen(p, eye, a);
                pixels([x, y], t, s)
            }),
            ("aspect of whole numbers", |p, eye, a, t, [w, h]| {
                let [x, y, z] = seen(p, eye, a);
                let (x, y) = (-x / z / t / f64::from(w / h.min(w).max(1)), -y / z / t);
                [(x + 1.0) / 2.0 * f64::from(w), (1.0 - y) / 2.0 * f64::from(h)]
            }),
            ("half missing", |p, eye, a, t, s| {
                let [x, y, z] = seen(p, eye, a);
                pixels([-x / z * 2.0, -y / z * 2.0], t, s)
            }),
            ("NDC", |p, eye, a, t, s| {
                let [x, y, z] = seen(p, eye, a);
                let [x, y] = pixels([-x / z, -y / z], t, s);
                [x / f64::from(s[0]), y / f64::from(s[1])]
            }),
            ("x mirrored", |p, eye, a, t, s| {
                let [x, y, z] = seen(p, eye, a);
                pixels([x / z, -y / z], t, s)
            }),
            ("size - 1", |p, eye, a, t, [w, h]| {
                let [x, y, z] = seen(p, eye, a);
                pixels([-x / z, -y / z], t, [w - 1, h - 1])
            }),
            ("scaled by the width", |p, eye, a, t, [w, h]| {
                let [x, y, z] = seen(p, eye, a);
                let (w, h) = (f64::from(w), f64::from(h));
                [w / 2.0 - x / z / t * w / 2.0, h / 2.0 + y / z / t * w / 2.0]
            }),
            ("2: depth along the world's z", |p, eye, a, t, s| {
                let [x, y, _] = seen(p, eye, a);
                pixels([-x / (p[2] - eye[2]), -y / (p[2] - eye[2])], t, s)
            }),
            ("2: half the size as a whole number", |p, eye, a, t, [w, h]| {
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
            ("left of the edge", |f, t, s| side(f, t, s) < 0 || (side(f, t, s) == 0 && top_left(f, t))),
            ("top edge leftwards", |f, t, s| {
                let top = t[1] == f[1] && t[0] < f[0];
                side(f, t, s) > 0 || (side(f, t, s) == 0 && (t[1] < f[1] || top))
            }),
            ("f32", |f, t, s| {
                let [ax, ay, bx, by, x, y] = [f[0], f[1], t[0], t[1], s[0], s[1]].map(|part| part as f32);
                let side = (bx - ax) * (y - ay) - (by - ay) * (x - ax);
                side > 0.0 || (side == 0.0 && top_left(f, t))
            }),
            ("bottom and right", |f, t, s| side(f, t, s) > 0 || (side(f, t, s) == 0 && !top_left(f, t))),
            ("top edges left out", |f, t, s| side(f, t, s) > 0 || (side(f, t, s) == 0 && t[1] < f[1])),
            ("left edges left out", |f, t, s| side(f, t, s) > 0 || (side(f, t, s) == 0 && t[1] == f[1] && t[0] > f[0])),
            ("only beside the edge", |f, t, s| {
                let beside = s[1] >= f[1].min(t[1]) && s[1] <= f[1].max(t[1]);
                beside && (side(f, t, s) > 0 || (side(f, t, s) == 0 && top_left(f, t)))
            }),
            ("any level edge", |f, t, s| side(f, t, s) >= 0 && (side(f, t, s) != 0 || t[1] <= f[1])),
            ("x and y swapped", |f, t, s| {
                let [f, t, s] = [f, t, s].map(|[x, y]| [y, x]);
                side(f, t, s) > 0 || (side(f, t, s) == 0 && top_left(f, t))
            }),
            ("both sides", |f, t, s| side(f, t, s) != 0 || top_left(f, t)),
            ("all of a top or left edge", |f, t, s| side(f, t, s) > 0 || top_left(f, t)),
            ("half a pixel added", |f, t, s| {
                let s = s.map(|part| part + 128);
                side(f, t, s) > 0 || (side(f, t, s) == 0 && top_left(f, t))
            }),
            ("2: by the sample, not the edge", |f, t, s| {
                side(f, t, s) > 0 || (side(f, t, s) == 0 && (s[1] < f[1] || (s[1] == f[1] && s[0] > f[0])))
            }),
            ("2: whole pixels", |f, t, s| {
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
            ("silhouette at the centre", |x, z, r, half| [(x - r) / z, (x + r) / z].map(|at| at.clamp(-half, half))),
            ("not cut", |x, z, r, _| interval(x, z, r, f64::INFINITY)),
            ("arctangent for arcsine", |x, z, r, half| {
                let (a, b) = (x.atan2(z), (r / x.hypot(z)).atan());
                [(a - b).tan(), (a + b).tan()].map(|at| at.clamp(-half, half))
            }),
            ("depth for distance", |x, z, r, half| {
                let (a, b) = ((x / z).atan(), (r / z).asin());
                [(a - b).tan(), (a + b).tan()].map(|at| at.clamp(-half, half))
            }),
            ("angles", |x, z, r, half| {
                let (a, b) = (x.atan2(z), (r / x.hypot(z)).asin());
                [a - b, a + b].map(|at| at.clamp(-half, half))
            }),
            ("swapped", |x, z, r, half| {
                let [a, b] = interval(x, z, r, half);
                [b, a]
            }),
            ("behind and around not looked at", |x, z, r, half| {
                let (a, b) = (x.atan2(z), (r / x.hypot(z)).asin());
                [(a - b).tan(), (a + b).tan()].map(|at| at.clamp(-half, half))
            }),
            ("centre ± r / d", |x, z, r, half| {
                let b = r / x.hypot(z);
                [x / z - b, x / z + b].map(|at| at.clamp(-half, half))
            }),
            ("at the sphere's distance", |x, z, r, half| {
                let [a, b] = interval(x, z, r, half);
                [a * z, b * z].map(|at| at.clamp(-half, half))
            }),
            ("mirrored", |x, z, r, half| {
                let [a, b] = interval(x, z, r, half);
                [-b, -a]
            }),
            (
                "whole image where the centre is behind",
                |x, z, r, half| if z <= 0.0 { [-half, half] } else { interval(x, z, r, half) },
            ),
            ("whole image where the sphere reaches the eye's plane", |x, z, r, half| {
                if z <= r { [-half, half] } else { interval(x, z, r, half) }
            }),
            ("NDC", |x, z, r, half| {
                let [a, b] = interval(x, z, r, half);
                [(a / half + 1.0) / 2.0, (b / half + 1.0) / 2.0]
            }),
            ("2: tangents of both angles added", |x, z, r, half| {
                let l = (x * x + z * z - r * r).max(0.0).sqrt();
                [x / z - r / l, x / z + r / l].map(|at| at.clamp(-half, half))
            }),
            ("2: half taken for an angle", |x, z, r, half| {
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
            ("absolute cosine", |n, m, o| dot(n, m).abs().powf(32.0) * flat(sine(n, o) * sine(n, o))),
            ("16th power", |n, m, o| power(dot(n, m)).sqrt() * flat(sine(n, o) * sine(n, o))),
            ("sine not squared", |n, m, o| power(dot(n, m)) * flat(sine(n, o).abs())),
            ("cosine for sine", |n, m, o| power(dot(n, m)) * flat(1.0 - sine(n, o) * sine(n, o))),
            ("sum", |n, m, o| power(dot(n, m)) + flat(sine(n, o) * sine(n, o))),
            ("numerator 1", |n, m, o| power(dot(n, m)) / (0.01 + sine(n, o) * sine(n, o))),
            ("neighbour's normal", |n, m, o| power(dot(n, m)) * flat(sine(m, o) * sine(m, o))),
            ("0.1", |n, m, o| power(dot(n, m)) * 0.1 / (0.1 + sine(n, o) * sine(n, o))),
            ("exponential", |n, m, o| power(dot(n, m)) * (-sine(n, o) * sine(n, o) / 0.01).exp()),
            ("normals only", |n, m, _| power(dot(n, m))),
            ("plane only", |n, _, o| flat(sine(n, o) * sine(n, o))),
            ("times 32", |n, m, o| 32.0 * dot(n, m).max(0.0) * flat(sine(n, o) * sine(n, o))),
            ("root", |n, m, o| (power(dot(n, m)) * flat(sine(n, o) * sine(n, o))).sqrt()),
            ("smaller of both", |n, m, o| power(dot(n, m)).min(flat(sine(n, o) * sine(n, o)))),
            ("2: 5th power", |n, m, o| dot(n, m).max(0.0).powf(5.0) * flat(sine(n, o) * sine(n, o))),
            ("2: plane across the mean normal", |n, m, o| {
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
