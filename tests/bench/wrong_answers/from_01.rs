//! Of chapters 1 to 7.

use super::{Fresh, dot, length, over, sub, times, unit};
use pinhole_cli::checks::{
    chapter_01_image, chapter_02_ray, chapter_03_hit, chapter_04_orthographic, chapter_05_pinhole, chapter_06_ndc,
    chapter_07_screen,
};

pub fn fresh() -> Vec<Fresh> {
    vec![image(), ray(), hit(), orthographic(), pinhole(), ndc(), screen()]
}

fn image() -> Fresh {
    use chapter_01_image::check::exercise;
    Fresh {
        chapter: 1,
        wrong: vec![
            (exercise(|i, w| [(i % u64::from(w)) as f64 + 1.0, (i / u64::from(w)) as f64 + 1.0]), "adds 1"),
            (
                exercise(|i, w| {
                    let (i, w) = (i as f32, w as f32);
                    [f64::from(i % w + 0.5), f64::from((i / w).floor() + 0.5)]
                }),
                "f32",
            ),
            (
                exercise(|i, w| {
                    let w = u64::from(w - 1).max(1);
                    [(i % w) as f64 + 0.5, (i / w) as f64 + 0.5]
                }),
                "width - 1",
            ),
            (
                exercise(|i, w| {
                    let (x, y) = (i % u64::from(w), i / u64::from(w));
                    let x = if y % 2 == 1 { u64::from(w) - 1 - x } else { x };
                    [x as f64 + 0.5, y as f64 + 0.5]
                }),
                "every other row backwards",
            ),
            (exercise(|i, w| [(i % u64::from(w)) as f64 + 0.5, (i / u64::from(w)) as f64]), "half only in x"),
            (
                exercise(|i, w| {
                    [(i % u64::from(w)) as f64 + 0.5, (i / u64::from(w)) as f64 + 0.5].map(|part| part / f64::from(w))
                }),
                "divided by width",
            ),
            (
                exercise(|i, w| {
                    let x = i % u64::from(w);
                    [x as f64 + 0.5, (i - x) as f64 + 0.5]
                }),
                "y not divided by width",
            ),
            (exercise(|i, w| [(i % u64::from(w)) as f64 + 0.5, (i as f64 / f64::from(w)).round() + 0.5]), "y rounded"),
            (exercise(|i, w| [(i % u64::from(w)) as f64 - 0.5, (i / u64::from(w)) as f64 - 0.5]), "half subtracted"),
        ],
        right: vec![
            exercise(|i, w| {
                let (i, w) = (i as f64, f64::from(w));
                let y = (i / w).floor();
                [i - y * w + 0.5, y + 0.5]
            }),
            exercise(|i, w| [i % u64::from(w), i / u64::from(w)].map(|part| (2 * part + 1) as f64 / 2.0)),
        ],
    }
}

fn ray() -> Fresh {
    use chapter_02_ray::check::exercise;
    Fresh {
        chapter: 2,
        wrong: vec![
            (exercise(|v| Some(over(v, dot(v, v))).filter(|_| v != [0.0; 3])), "divided by squared length"),
            (exercise(|v| Some(over(v, v[0].abs().max(v[1].abs()).max(v[2].abs()))).filter(|_| v != [0.0; 3])), "max"),
            (exercise(|v| if length(v) < 1e-6 { None } else { Some(unit(v)) }), "epsilon"),
            (
                exercise(|v| {
                    let l = f64::from((dot(v, v) as f32).sqrt());
                    if l > 0.0 { Some(over(v, l)) } else { None }
                }),
                "f32",
            ),
            (
                exercise(|v| {
                    let l = v[0].hypot(v[1]);
                    if l > 0.0 { Some(over(v, l)) } else { None }
                }),
                "z left out of the length",
            ),
            (exercise(|v| if length(v) > 0.0 { Some(over(v, -length(v))) } else { None }), "turned round"),
            (
                exercise(|v| {
                    let l = length(v);
                    if l > 0.0 { Some(v.map(|part| part.abs() / l)) } else { None }
                }),
                "absolute",
            ),
            (exercise(|v| if v == [0.0; 3] { None } else { Some(times(v, length(v))) }), "multiplied"),
            (exercise(|v| if v.contains(&0.0) { None } else { Some(unit(v)) }), "none where any part is 0"),
            (exercise(|v| Some(unit(v))), "0 not looked at"),
            (exercise(|v| if dot(v, v) > 0.0 { Some(over(v, dot(v, [1.0; 3]))) } else { None }), "sum of parts"),
        ],
        right: vec![
            exercise(|v| {
                let most = v.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
                if v.iter().any(|part| !part.is_finite()) || most == 0.0 {
                    return None;
                }
                Some(unit(over(v, most)))
            }),
            exercise(|v| {
                if !v.iter().all(|part| part.is_finite()) || v == [0.0; 3] {
                    return None;
                }
                let small = v.iter().all(|part| part.abs() < 1.0);
                let v = times(v, if small { 1e200 } else { 1e-200 });
                let small = v.iter().all(|part| part.abs() < 1e-150);
                let v = times(v, if small { 1e180 } else { 1.0 });
                Some(over(v, v[0].hypot(v[1]).hypot(v[2])))
            }),
        ],
    }
}

fn hit() -> Fresh {
    use chapter_03_hit::check::exercise;
    Fresh {
        chapter: 3,
        wrong: vec![
            (
                exercise(|o, d, c, r| {
                    let f = sub(o, c);
                    nearest(dot(d, d), dot(f, d), dot(f, f) - r * r)
                }),
                "b without its 2",
            ),
            (
                exercise(|o, d, c, r| {
                    let f = sub(c, o);
                    nearest(dot(d, d), 2.0 * dot(f, d), dot(f, f) - r * r)
                }),
                "centre - origin",
            ),
            (
                exercise(|o, d, c, r| {
                    let f = sub(o, c);
                    nearest(dot(d, d), 2.0 * dot(f, d), dot(f, f) - r)
                }),
                "radius not squared",
            ),
            (
                exercise(|o, d, c, r| {
                    let f = sub(o, c);
                    if dot(f, f) < r * r {
                        return None;
                    }
                    nearest(dot(d, d), 2.0 * dot(f, d), dot(f, f) - r * r)
                }),
                "none from inside",
            ),
            (
                exercise(|o, d, c, r| {
                    let f = sub(o, c);
                    Some(nearest(dot(d, d), 2.0 * dot(f, d), dot(f, f) - r * r)? * length(d))
                }),
                "distance instead of t",
            ),
            (
                exercise(|o, d, c, r| {
                    let f = sub(o, c);
                    let (a, b, c) = (dot(d, d), 2.0 * dot(f, d), dot(f, f) - r * r);
                    let root = (b * b - 4.0 * a * c).sqrt();
                    [(-b - root) / 2.0 * a, (-b + root) / 2.0 * a].into_iter().find(|t| *t > 0.0)
                }),
                "/ 2 * a",
            ),
            (
                exercise(|o, d, c, r| {
                    let f = sub(o, c);
                    let (a, b, c) = (dot(d, d), 2.0 * dot(f, d), dot(f, f) - r * r);
                    let under = b * b - 4.0 * a * c;
                    if under < 0.0 {
                        return None;
                    }
                    [(-b - under) / (2.0 * a), (-b + under) / (2.0 * a)].into_iter().find(|t| *t > 0.0)
                }),
                "root forgotten",
            ),
            (
                exercise(|o, d, c, r| {
                    let f = sub(c, o);
                    let t = dot(f, d) / dot(d, d);
                    let near = sub(f, times(d, t));
                    if dot(near, near) <= r * r && t > 0.0 { Some(t) } else { None }
                }),
                "closest approach instead of the hit",
            ),
            (
                exercise(|o, d, c, r| {
                    let f = sub(o, c);
                    let (a, b, c) = (dot(d, d), 2.0 * dot(f, d), dot(f, f) - r * r);
                    let root = (b * b - 4.0 * a * c).sqrt();
                    [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)].into_iter().find(|t| *t > 0.001)
                }),
                "epsilon",
            ),
            (
                exercise(|o, d, c, r| {
                    let f = sub(o, c);
                    let (a, b, c) = (dot(d, d), 2.0 * dot(f, d), dot(f, f) - r * r);
                    let under = b * b - 4.0 * a * c;
                    if under < 0.0 {
                        return None;
                    }
                    Some(((-b - under.sqrt()) / (2.0 * a)).abs())
                }),
                "absolute of the near root",
            ),
            (
                exercise(|o, d, c, r| {
                    let f = sub(o, c);
                    nearest(dot(d, d), 2.0 * dot(f, d), dot(f, f) - (r / 2.0) * (r / 2.0))
                }),
                "radius taken as a diameter",
            ),
        ],
        right: vec![
            exercise(|o, d, c, r| {
                let (f, l) = (over(sub(o, c), r), length(d));
                let u = over(d, l);
                let along = -dot(f, u);
                let beside = length(super::cross(f, u));
                if beside > 1.0 {
                    return None;
                }
                let half = ((1.0 - beside) * (1.0 + beside)).sqrt();
                let inside = (1.0 - length(f)) * (1.0 + length(f));
                let far = if along > 0.0 { along + half } else { along - half };
                let mut both = [far, if far == 0.0 { 0.0 } else { -inside / far }];
                both.sort_by(f64::total_cmp);
                both.into_iter().find(|t| *t > 0.0).map(|t| t * r / l)
            }),
            exercise(|o, d, c, r| {
                let f = sub(o, c);
                let (a, h) = (dot(d, d), -dot(f, d));
                let nearest = sub(f, times(d, -h / a));
                let squared = r * r - dot(nearest, nearest);
                if squared < 0.0 {
                    return None;
                }
                let (c, root) = ((length(f) - r) * (length(f) + r), (a * squared).sqrt());
                let (first, second) =
                    if h > 0.0 { (c / (h + root), (h + root) / a) } else { ((h - root) / a, c / (h - root)) };
                if first > 0.0 { Some(first) } else { Some(second).filter(|t| *t > 0.0) }
            }),
        ],
    }
}

/// The smaller root above 0.
fn nearest(a: f64, b: f64, c: f64) -> Option<f64> {
    let root = (b * b - 4.0 * a * c).sqrt();
    [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)].into_iter().find(|t| *t > 0.0)
}

fn orthographic() -> Fresh {
    use chapter_04_orthographic::check::exercise;
    const AHEAD: [f64; 3] = [0.0, 0.0, -1.0];
    Fresh {
        chapter: 4,
        wrong: vec![
            (exercise(|[x, y], h| ([x * h, y * h, 0.0], AHEAD)), "not halved"),
            (exercise(|[x, y], h| ([x * h / 2.0, y * h / 2.0, 0.0], [0.0, 0.0, 1.0])), "+z"),
            (
                exercise(|[x, y], h| {
                    let at = [x * h / 2.0, y * h / 2.0, 0.0];
                    (at, unit([at[0], at[1], -1.0]))
                }),
                "perspective direction",
            ),
            (exercise(|[x, y], h| ([x * h / 2.0, y * h / 2.0, -1.0], AHEAD)), "origin at z -1"),
            (exercise(|[x, y], h| ([x, y * h / 2.0, 0.0], AHEAD)), "x not scaled"),
            (exercise(|[x, y], h| ([x * h / 2.0, -y * h / 2.0, 0.0], AHEAD)), "y down"),
            (exercise(|[x, y], h| ([0.0; 3], unit([x * h / 2.0, y * h / 2.0, -1.0]))), "pinhole"),
            (exercise(|[x, y], h| (AHEAD, [x * h / 2.0, y * h / 2.0, 0.0])), "swapped"),
            (exercise(|[x, y], h| ([x / h * 2.0, y / h * 2.0, 0.0], AHEAD)), "divided by half the height"),
            (exercise(|[x, y], h| ([x + h / 2.0, y + h / 2.0, 0.0], AHEAD)), "added"),
            (exercise(|[x, y], h| ([y * h / 2.0, x * h / 2.0, 0.0], AHEAD)), "x, y swapped"),
        ],
        right: vec![
            exercise(|screen, h| {
                let at = screen.map(|part| 0.5 * part * h);
                ([at[0], at[1], -0.0], unit([0.0, 0.0, -h]))
            }),
            exercise(|[x, y], h| {
                let half = h / 2.0;
                (times([x, y, 0.0], half), sub([0.0; 3], [0.0, 0.0, 1.0]))
            }),
        ],
    }
}

fn pinhole() -> Fresh {
    use chapter_05_pinhole::check::exercise;
    Fresh {
        chapter: 5,
        wrong: vec![
            (exercise(|[x, y], t| unit([x, y * t, -1.0])), "tangent only on y"),
            (exercise(|[x, y], t| unit([x * t.tan(), y * t.tan(), -1.0])), "tangent of the tangent"),
            (exercise(|[x, y], t| unit([x * t / 2.0, y * t / 2.0, -1.0])), "halved again"),
            (
                exercise(|[x, y], t| {
                    let v = [x * t, y * t, -1.0];
                    over(v, dot(v, v))
                }),
                "divided by the squared length",
            ),
            (exercise(|[x, y], t| unit([x * t, -y * t, -1.0])), "y down"),
            (
                exercise(|[x, y], t| {
                    let v = [x * t, y * t, -1.0];
                    [v[0] / length(v), v[1] / length(v), -1.0]
                }),
                "z not divided",
            ),
            (
                exercise(|[x, y], t| {
                    let v = [x * t, y * t, -1.0];
                    over(v, v[0].hypot(v[1]))
                }),
                "z left out of the length",
            ),
            (
                exercise(|[x, y], t| {
                    let [a, b] = [x * t.atan(), y * t.atan()];
                    [a.sin() * b.cos(), b.sin(), -a.cos() * b.cos()]
                }),
                "angles",
            ),
            (exercise(|[x, y], t| unit([x * t, y * t, -t])), "z times tangent too"),
            (exercise(|[x, y], t| unit([y * t, x * t, -1.0])), "x and y swapped"),
            (exercise(|[x, y], t| unit([x * t * t, y * t * t, -1.0])), "tangent squared"),
        ],
        right: vec![
            exercise(|[x, y], t| {
                let z = -1.0 / (1.0 + t * t * (x * x + y * y)).sqrt();
                [-x * t * z, -y * t * z, z]
            }),
            exercise(|screen, t| {
                let [x, y] = screen.map(|part| part * t);
                let l = x.hypot(y).hypot(1.0);
                [x / l, y / l, -l.recip()]
            }),
        ],
    }
}

fn ndc() -> Fresh {
    use chapter_06_ndc::check::exercise;
    Fresh {
        chapter: 6,
        wrong: vec![
            (
                exercise(|p, w, h| {
                    in_image(p).then(|| [(p[0] * f64::from(w)).round() as u32, (p[1] * f64::from(h)).round() as u32])
                }),
                "rounds",
            ),
            (
                exercise(|p, w, h| {
                    in_image(p).then(|| [(p[0] * f64::from(w - 1)) as u32, (p[1] * f64::from(h - 1)) as u32])
                }),
                "width - 1",
            ),
            (
                exercise(|[x, y], w, h| {
                    let at = |part: f64, size: u32| ((part * f64::from(size)) as u32).min(size - 1);
                    Some([at(x, w), at(y, h)])
                }),
                "outside is clamped",
            ),
            (
                exercise(|p, w, h| {
                    let inside = p.iter().all(|part| (0.0..=1.0).contains(part));
                    inside.then(|| [(p[0] * f64::from(w)) as u32, (p[1] * f64::from(h)) as u32])
                }),
                "1 inside",
            ),
            (exercise(|p, w, _| in_image(p).then(|| p.map(|part| (part * f64::from(w)) as u32))), "width for both"),
            (
                exercise(|p, w, h| {
                    in_image(p).then(|| [(p[0] * f64::from(w)) as u32, ((1.0 - p[1]) * f64::from(h)) as u32])
                }),
                "y up",
            ),
            (
                exercise(|p, w, h| in_image(p).then(|| [(p[1] * f64::from(h)) as u32, (p[0] * f64::from(w)) as u32])),
                "swapped",
            ),
            (
                exercise(|[x, y], w, h| {
                    (x < 1.0 && y < 1.0).then(|| [(x * f64::from(w)) as u32, (y * f64::from(h)) as u32])
                }),
                "negative gets pixel 0",
            ),
            (
                exercise(|[x, y], w, h| {
                    if x < 0.0 || y < 0.0 || x >= 1.0 || y >= 1.0 {
                        return None;
                    }
                    Some([(x * f64::from(w)) as u32, (y * f64::from(h)) as u32])
                }),
                "NaN gets pixel 0",
            ),
            (
                exercise(|p, w, h| {
                    in_image(p).then(|| [(p[0] * f64::from(w) + 1.0) as u32, (p[1] * f64::from(h) + 1.0) as u32])
                }),
                "from 1",
            ),
            (
                exercise(|p, w, h| {
                    in_image(p).then(|| [(p[0] * f64::from(w) - 0.5) as u32, (p[1] * f64::from(h) - 0.5) as u32])
                }),
                "minus a half",
            ),
        ],
        right: vec![
            exercise(|p, w, h| {
                let at = |part: f64, size: u32| {
                    if (0.0..1.0).contains(&part) {
                        Some(((part * f64::from(size)) as u32).min(size - 1))
                    } else {
                        None
                    }
                };
                Some([at(p[0], w)?, at(p[1], h)?])
            }),
            exercise(|[x, y], w, h| {
                if !(x >= 0.0 && y >= 0.0 && x < 1.0 && y < 1.0) {
                    return None;
                }
                let [x, y] = [(x * f64::from(w)).floor(), (y * f64::from(h)).floor()];
                Some([(x as u64).min(u64::from(w) - 1) as u32, (y as u64).min(u64::from(h) - 1) as u32])
            }),
        ],
    }
}

fn in_image(p: [f64; 2]) -> bool {
    p.iter().all(|part| (0.0..1.0).contains(part))
}

fn screen() -> Fresh {
    use chapter_07_screen::check::exercise;
    Fresh {
        chapter: 7,
        wrong: vec![
            (
                exercise(|[x, y], w, h| [(x / aspect(w, h) + 1.0) / 2.0, (1.0 - y / aspect(w, h)) / 2.0]),
                "aspect on y too",
            ),
            (exercise(|[x, y], w, h| [(x + aspect(w, h)) / 2.0, (1.0 - y) / 2.0]), "not divided by the width"),
            (exercise(|[x, y], w, h| [x / aspect(w, h) + 1.0, 1.0 - y]), "not halved"),
            (
                exercise(|[x, y], w, h| {
                    [(x / aspect(w, h) + 1.0) / 2.0 * f64::from(w), (1.0 - y) / 2.0 * f64::from(h)]
                }),
                "raster",
            ),
            (exercise(|[x, y], w, h| [(2.0 * x - 1.0) * aspect(w, h), 1.0 - 2.0 * y]), "the other way"),
            (exercise(|[x, y], w, h| [(1.0 - x / aspect(w, h)) / 2.0, (1.0 - y) / 2.0]), "x mirrored"),
            (exercise(|[x, y], w, h| [x / aspect(w, h) + 0.5, 0.5 - y]), "half added, not halved"),
            (exercise(|[x, y], w, h| [(1.0 - y) / 2.0, (x / aspect(w, h) + 1.0) / 2.0]), "swapped"),
            (
                exercise(|[x, y], w, h| [(x / aspect(w - 1, h.max(2) - 1).max(1e-9) + 1.0) / 2.0, (1.0 - y) / 2.0]),
                "aspect of size - 1",
            ),
            (exercise(|[x, y], w, h| [x / aspect(w, h) + 1.0 / 2.0, 1.0 - y / 2.0]), "brackets missing"),
        ],
        right: vec![
            exercise(|[x, y], w, h| [0.5 + x * f64::from(h) / (2.0 * f64::from(w)), 0.5 - 0.5 * y]),
            exercise(|[x, y], w, h| {
                let a = aspect(w, h);
                [(x + a) / (2.0 * a), (y - 1.0) / -2.0]
            }),
        ],
    }
}

fn aspect(width: u32, height: u32) -> f64 {
    f64::from(width) / f64::from(height)
}
