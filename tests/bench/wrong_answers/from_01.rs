//! Of chapters 1 to 7.

use super::{Fresh, dot, fresh, length, over, sub, times, unit};
use pinhole_cli::checks::{
    chapter_01_image, chapter_02_ray, chapter_03_hit, chapter_04_orthographic, chapter_05_pinhole, chapter_06_ndc,
    chapter_07_screen,
};

pub fn all() -> Vec<Fresh> {
    vec![image(), ray(), hit(), orthographic(), pinhole(), ndc(), screen()]
}

fn image() -> Fresh {
    use chapter_01_image::check::exercise;
    fresh(
        1,
        exercise,
        &[
            ("1 is added instead of a half", |i, w| [(i % u64::from(w)) as f64 + 1.0, (i / u64::from(w)) as f64 + 1.0]),
            ("f32 is computed in, which has too few digits", |i, w| {
                let (i, w) = (i as f32, w as f32);
                [f64::from(i % w + 0.5), f64::from((i / w).floor() + 0.5)]
            }),
            ("rows are taken to be one pixel shorter", |i, w| {
                let w = u64::from(w - 1).max(1);
                [(i % w) as f64 + 0.5, (i / w) as f64 + 0.5]
            }),
            ("every other row runs backwards", |i, w| {
                let (x, y) = (i % u64::from(w), i / u64::from(w));
                let x = if y % 2 == 1 { u64::from(w) - 1 - x } else { x };
                [x as f64 + 0.5, y as f64 + 0.5]
            }),
            ("the half is missing in y", |i, w| [(i % u64::from(w)) as f64 + 0.5, (i / u64::from(w)) as f64]),
            ("the place is divided by the width, which gives NDC", |i, w| {
                [(i % u64::from(w)) as f64 + 0.5, (i / u64::from(w)) as f64 + 0.5].map(|part| part / f64::from(w))
            }),
            ("what is left after the column is not divided by the width", |i, w| {
                let x = i % u64::from(w);
                [x as f64 + 0.5, (i - x) as f64 + 0.5]
            }),
            ("the row is rounded", |i, w| [(i % u64::from(w)) as f64 + 0.5, (i as f64 / f64::from(w)).round() + 0.5]),
            ("the half is taken off", |i, w| [(i % u64::from(w)) as f64 - 0.5, (i / u64::from(w)) as f64 - 0.5]),
            ("width is taken for a power of two", |i, w| {
                let w = u64::from(w);
                [(i & (w - 1)) as f64 + 0.5, (i >> w.ilog2()) as f64 + 0.5]
            }),
            ("x is counted from the right", |i, w| {
                let w = u64::from(w);
                [(w - i % w) as f64 - 0.5, (i / w) as f64 + 0.5]
            }),
        ],
        &[
            |i, w| {
                let (i, w) = (i as f64, f64::from(w));
                let y = (i / w).floor();
                [i - y * w + 0.5, y + 0.5]
            },
            |i, w| [i % u64::from(w), i / u64::from(w)].map(|part| (2 * part + 1) as f64 / 2.0),
        ],
    )
}

fn ray() -> Fresh {
    use chapter_02_ray::check::exercise;
    fresh(
        2,
        exercise,
        &[
            ("the vector is divided by its squared length", |v| Some(over(v, dot(v, v))).filter(|_| v != [0.0; 3])),
            ("the vector is divided by its largest part, which makes that part 1, no", |v| {
                Some(over(v, v[0].abs().max(v[1].abs()).max(v[2].abs()))).filter(|_| v != [0.0; 3])
            }),
            (/* epsilon */ "", |v| if length(v) < 1e-6 { None } else { Some(unit(v)) }),
            ("f32 is computed in, which has seven digits", |v| {
                let l = f64::from((dot(v, v) as f32).sqrt());
                if l > 0.0 { Some(over(v, l)) } else { None }
            }),
            (/* z left out of the length */ "", |v| {
                let l = v[0].hypot(v[1]);
                if l > 0.0 { Some(over(v, l)) } else { None }
            }),
            (
                "the direction points the opposite way",
                |v| if length(v) > 0.0 { Some(over(v, -length(v))) } else { None },
            ),
            ("the signs are lost", |v| {
                let l = length(v);
                if l > 0.0 { Some(v.map(|part| part.abs() / l)) } else { None }
            }),
            (
                "the vector is multiplied by its length",
                |v| if v == [0.0; 3] { None } else { Some(times(v, length(v))) },
            ),
            ("one part that is 0 is taken for the vector 0, which has three", |v| {
                if v.contains(&0.0) { None } else { Some(unit(v)) }
            }),
            ("the vector is divided by its length whatever that is", |v| Some(unit(v))),
            (
                "the length is taken for x + y + z",
                |v| if dot(v, v) > 0.0 { Some(over(v, dot(v, [1.0; 3]))) } else { None },
            ),
            ("each part is brought to 1 by itself", |v| {
                if dot(v, v) > 0.0 { Some(v.map(|part| part / (part * part).sqrt())) } else { None }
            }),
            ("a small number is added to the length, which makes the answer too shor", |v| {
                if v == [0.0; 3] { None } else { Some(over(v, length(v) + 1e-8)) }
            }),
        ],
        &[
            |v| {
                let most = v.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
                if v.iter().any(|part| !part.is_finite()) || most == 0.0 {
                    return None;
                }
                Some(unit(over(v, most)))
            },
            |v| {
                if !v.iter().all(|part| part.is_finite()) || v == [0.0; 3] {
                    return None;
                }
                let small = v.iter().all(|part| part.abs() < 1.0);
                let v = times(v, if small { 1e200 } else { 1e-200 });
                let small = v.iter().all(|part| part.abs() < 1e-150);
                let v = times(v, if small { 1e180 } else { 1.0 });
                Some(over(v, v[0].hypot(v[1]).hypot(v[2])))
            },
        ],
    )
}

fn hit() -> Fresh {
    use chapter_03_hit::check::exercise;
    fresh(
        3,
        exercise,
        &[
            ("the formula with b and that with half of b are mixed", |o, d, c, r| {
                let f = sub(o, c);
                nearest(dot(d, d), dot(f, d), dot(f, f) - r * r)
            }),
            ("b has the wrong sign, so that what is behind comes ahead", |o, d, c, r| {
                let f = sub(c, o);
                nearest(dot(d, d), 2.0 * dot(f, d), dot(f, f) - r * r)
            }),
            ("the radius is not squared", |o, d, c, r| {
                let f = sub(o, c);
                nearest(dot(d, d), 2.0 * dot(f, d), dot(f, f) - r)
            }),
            ("Second, from inside, nothing is hit", |o, d, c, r| {
                let f = sub(o, c);
                if dot(f, f) < r * r {
                    return None;
                }
                nearest(dot(d, d), 2.0 * dot(f, d), dot(f, f) - r * r)
            }),
            ("the direction is brought to length 1 and t is left so", |o, d, c, r| {
                let f = sub(o, c);
                Some(nearest(dot(d, d), 2.0 * dot(f, d), dot(f, f) - r * r)? * length(d))
            }),
            ("the quotient is multiplied by R·R", |o, d, c, r| {
                let f = sub(o, c);
                let (a, b, c) = (dot(d, d), 2.0 * dot(f, d), dot(f, f) - r * r);
                let root = (b * b - 4.0 * a * c).sqrt();
                [(-b - root) / 2.0 * a, (-b + root) / 2.0 * a].into_iter().find(|t| *t > 0.0)
            }),
            ("the square root is missing", |o, d, c, r| {
                let f = sub(o, c);
                let (a, b, c) = (dot(d, d), 2.0 * dot(f, d), dot(f, f) - r * r);
                let under = b * b - 4.0 * a * c;
                if under < 0.0 {
                    return None;
                }
                [(-b - under) / (2.0 * a), (-b + under) / (2.0 * a)].into_iter().find(|t| *t > 0.0)
            }),
            ("this is where the ray comes closest to the centre", |o, d, c, r| {
                let f = sub(c, o);
                let t = dot(f, d) / dot(d, d);
                let near = sub(f, times(d, t));
                if dot(near, near) <= r * r && t > 0.0 { Some(t) } else { None }
            }),
            ("Second, hits close to the origin are skipped", |o, d, c, r| {
                let f = sub(o, c);
                let (a, b, c) = (dot(d, d), 2.0 * dot(f, d), dot(f, f) - r * r);
                let root = (b * b - 4.0 * a * c).sqrt();
                [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)].into_iter().find(|t| *t > 0.001)
            }),
            ("Second, what lies behind the origin is hit too", |o, d, c, r| {
                let f = sub(o, c);
                let (a, b, c) = (dot(d, d), 2.0 * dot(f, d), dot(f, f) - r * r);
                let under = b * b - 4.0 * a * c;
                if under < 0.0 {
                    return None;
                }
                Some(((-b - under.sqrt()) / (2.0 * a)).abs())
            }),
            ("the radius is halved", |o, d, c, r| {
                let f = sub(o, c);
                nearest(dot(d, d), 2.0 * dot(f, d), dot(f, f) - (r / 2.0) * (r / 2.0))
            }),
            ("brackets are missing", |o, d, c, r| {
                let f = sub(o, c);
                let (a, b, c) = (dot(d, d), 2.0 * dot(f, d), dot(f, f) - r * r);
                let root = (b * b - 4.0 * a * c).sqrt();
                [-b - root / (2.0 * a), -b + root / (2.0 * a)].into_iter().find(|t| *t > 0.0)
            }),
            ("c is of the origin alone", |o, d, c, r| {
                let f = sub(o, c);
                nearest(dot(d, d), 2.0 * dot(f, d), dot(o, o) - r * r)
            }),
        ],
        &[
            |o, d, c, r| {
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
            },
            |o, d, c, r| {
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
            },
        ],
    )
}

/// The smaller root above 0.
fn nearest(a: f64, b: f64, c: f64) -> Option<f64> {
    let root = (b * b - 4.0 * a * c).sqrt();
    [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)].into_iter().find(|t| *t > 0.0)
}

fn orthographic() -> Fresh {
    use chapter_04_orthographic::check::exercise;
    const AHEAD: [f64; 3] = [0.0, 0.0, -1.0];
    fresh(
        4,
        exercise,
        &[
            ("the origin is twice as far out", |[x, y], h| ([x * h, y * h, 0.0], AHEAD)),
            ("the direction is +z", |[x, y], h| ([x * h / 2.0, y * h / 2.0, 0.0], [0.0, 0.0, 1.0])),
            ("the rays spread", |[x, y], h| {
                let at = [x * h / 2.0, y * h / 2.0, 0.0];
                (at, unit([at[0], at[1], -1.0]))
            }),
            ("the rectangle stands at z = −1", |[x, y], h| ([x * h / 2.0, y * h / 2.0, -1.0], AHEAD)),
            ("only y is scaled by half the height", |[x, y], h| ([x, y * h / 2.0, 0.0], AHEAD)),
            ("y points down", |[x, y], h| ([x * h / 2.0, -y * h / 2.0, 0.0], AHEAD)),
            ("Second, the rays spread", |[x, y], h| ([0.0; 3], unit([x * h / 2.0, y * h / 2.0, -1.0]))),
            ("origin and direction are swapped", |[x, y], h| (AHEAD, [x * h / 2.0, y * h / 2.0, 0.0])),
            ("the screen point is divided by the height", |[x, y], h| ([x / h * 2.0, y / h * 2.0, 0.0], AHEAD)),
            ("half the height is added to the screen point", |[x, y], h| ([x + h / 2.0, y + h / 2.0, 0.0], AHEAD)),
            ("x and y are swapped", |[x, y], h| ([y * h / 2.0, x * h / 2.0, 0.0], AHEAD)),
            ("the screen point is counted from a corner", |[x, y], h| {
                ([(x + 1.0) * h / 2.0, (y + 1.0) * h / 2.0, 0.0], AHEAD)
            }),
            ("the direction is that from the centre to the place on the rectangle", |[x, y], h| {
                let at = [x * h / 2.0, y * h / 2.0, 0.0];
                (at, unit(at))
            }),
        ],
        &[
            |screen, h| {
                let at = screen.map(|part| 0.5 * part * h);
                ([at[0], at[1], -0.0], unit([0.0, 0.0, -h]))
            },
            |[x, y], h| {
                let half = h / 2.0;
                (times([x, y, 0.0], half), sub([0.0; 3], [0.0, 0.0, 1.0]))
            },
        ],
    )
}

fn pinhole() -> Fresh {
    use chapter_05_pinhole::check::exercise;
    fresh(
        5,
        exercise,
        &[
            ("only y is scaled by the tangent", |[x, y], t| unit([x, y * t, -1.0])),
            ("a tangent is taken of the tangent, which is one already", |[x, y], t| {
                unit([x * t.tan(), y * t.tan(), -1.0])
            }),
            ("the tangent is halved", |[x, y], t| unit([x * t / 2.0, y * t / 2.0, -1.0])),
            ("the direction is divided by its squared length", |[x, y], t| {
                let v = [x * t, y * t, -1.0];
                over(v, dot(v, v))
            }),
            ("y points down", |[x, y], t| unit([x * t, -y * t, -1.0])),
            ("only x and y are divided by the length", |[x, y], t| {
                let v = [x * t, y * t, -1.0];
                [v[0] / length(v), v[1] / length(v), -1.0]
            }),
            ("the length is that of x and y alone", |[x, y], t| {
                let v = [x * t, y * t, -1.0];
                over(v, v[0].hypot(v[1]))
            }),
            ("angles are taken to be in proportion to the screen", |[x, y], t| {
                let [a, b] = [x * t.atan(), y * t.atan()];
                [a.sin() * b.cos(), b.sin(), -a.cos() * b.cos()]
            }),
            ("the tangent is left out", |[x, y], t| unit([x * t, y * t, -t])),
            ("x and y are swapped", |[x, y], t| unit([y * t, x * t, -1.0])),
            ("the tangent is a factor twice", |[x, y], t| unit([x * t * t, y * t * t, -1.0])),
            ("the direction is brought to length 1 before the tangent widens it", |[x, y], t| {
                let v = unit([x, y, -1.0]);
                [v[0] * t, v[1] * t, v[2]]
            }),
            ("`screen` is turned into radians", |[x, y], t| unit([x * t.to_radians(), y * t.to_radians(), -1.0])),
        ],
        &[
            |[x, y], t| {
                let z = -1.0 / (1.0 + t * t * (x * x + y * y)).sqrt();
                [-x * t * z, -y * t * z, z]
            },
            |screen, t| {
                let [x, y] = screen.map(|part| part * t);
                let l = x.hypot(y).hypot(1.0);
                [x / l, y / l, -l.recip()]
            },
        ],
    )
}

fn ndc() -> Fresh {
    use chapter_06_ndc::check::exercise;
    fresh(
        6,
        exercise,
        &[
            ("the product is rounded to the nearest", |p, w, h| {
                in_image(p).then(|| [(p[0] * f64::from(w)).round() as u32, (p[1] * f64::from(h)).round() as u32])
            }),
            ("the point is scaled by the size less 1", |p, w, h| {
                in_image(p).then(|| [(p[0] * f64::from(w - 1)) as u32, (p[1] * f64::from(h - 1)) as u32])
            }),
            ("what lies outside is put into the nearest pixel", |[x, y], w, h| {
                let at = |part: f64, size: u32| ((part * f64::from(size)) as u32).min(size - 1);
                Some([at(x, w), at(y, h)])
            }),
            ("1 counts as inside, and gives a pixel that the image does not have", |p, w, h| {
                let inside = p.iter().all(|part| (0.0..=1.0).contains(part));
                inside.then(|| [(p[0] * f64::from(w)) as u32, (p[1] * f64::from(h)) as u32])
            }),
            ("both are scaled by the width", |p, w, _| in_image(p).then(|| p.map(|part| (part * f64::from(w)) as u32))),
            ("y is counted from the bottom", |p, w, h| {
                in_image(p).then(|| [(p[0] * f64::from(w)) as u32, ((1.0 - p[1]) * f64::from(h)) as u32])
            }),
            ("x and y are swapped", |p, w, h| {
                in_image(p).then(|| [(p[1] * f64::from(h)) as u32, (p[0] * f64::from(w)) as u32])
            }),
            ("what is below 0 is given pixel 0", |[x, y], w, h| {
                (x < 1.0 && y < 1.0).then(|| [(x * f64::from(w)) as u32, (y * f64::from(h)) as u32])
            }),
            ("NaN passes for inside", |[x, y], w, h| {
                if x < 0.0 || y < 0.0 || x >= 1.0 || y >= 1.0 {
                    return None;
                }
                Some([(x * f64::from(w)) as u32, (y * f64::from(h)) as u32])
            }),
            ("pixels are counted from 1", |p, w, h| {
                in_image(p).then(|| [(p[0] * f64::from(w) + 1.0) as u32, (p[1] * f64::from(h) + 1.0) as u32])
            }),
            ("a half is put in or taken off", |p, w, h| {
                in_image(p).then(|| [(p[0] * f64::from(w) - 0.5) as u32, (p[1] * f64::from(h) - 0.5) as u32])
            }),
            ("the answer is left at 0", |p, w, h| in_image(p).then(|| [p[0] as u32 * w, p[1] as u32 * h])),
            (/* negative wraps round */ "", |p, w, h| {
                let at = |part: f64, size: u32| {
                    (part < 1.0).then(|| ((part.rem_euclid(1.0) * f64::from(size)) as u32).min(size - 1))
                };
                Some([at(p[0], w)?, at(p[1], h)?])
            }),
        ],
        &[
            |p, w, h| {
                let at = |part: f64, size: u32| {
                    if (0.0..1.0).contains(&part) {
                        Some(((part * f64::from(size)) as u32).min(size - 1))
                    } else {
                        None
                    }
                };
                Some([at(p[0], w)?, at(p[1], h)?])
            },
            |[x, y], w, h| {
                if !(x >= 0.0 && y >= 0.0 && x < 1.0 && y < 1.0) {
                    return None;
                }
                let [x, y] = [(x * f64::from(w)).floor(), (y * f64::from(h)).floor()];
                Some([(x as u64).min(u64::from(w) - 1) as u32, (y as u64).min(u64::from(h) - 1) as u32])
            },
        ],
    )
}

fn in_image(p: [f64; 2]) -> bool {
    p.iter().all(|part| (0.0..1.0).contains(part))
}

fn screen() -> Fresh {
    use chapter_07_screen::check::exercise;
    fresh(
        7,
        exercise,
        &[
            ("the aspect is taken off y, too", |[x, y], w, h| {
                [(x / aspect(w, h) + 1.0) / 2.0, (1.0 - y / aspect(w, h)) / 2.0]
            }),
            ("1 is added where the aspect belongs", |[x, y], w, h| [(x + aspect(w, h)) / 2.0, (1.0 - y) / 2.0]),
            ("a part runs from 0 to 2", |[x, y], w, h| [x / aspect(w, h) + 1.0, 1.0 - y]),
            ("this is the raster point", |[x, y], w, h| {
                [(x / aspect(w, h) + 1.0) / 2.0 * f64::from(w), (1.0 - y) / 2.0 * f64::from(h)]
            }),
            ("this is screen_from_ndc itself, not what undoes it", |[x, y], w, h| {
                [(2.0 * x - 1.0) * aspect(w, h), 1.0 - 2.0 * y]
            }),
            ("x is turned over", |[x, y], w, h| [(1.0 - x / aspect(w, h)) / 2.0, (1.0 - y) / 2.0]),
            ("the brackets are missing", |[x, y], w, h| [x / aspect(w, h) + 0.5, 0.5 - y]),
            ("x and y are swapped", |[x, y], w, h| [(1.0 - y) / 2.0, (x / aspect(w, h) + 1.0) / 2.0]),
            ("the aspect is taken of width − 1 and height − 1", |[x, y], w, h| {
                [(x / aspect(w - 1, h.max(2) - 1).max(1e-9) + 1.0) / 2.0, (1.0 - y) / 2.0]
            }),
            ("the brackets are missing", |[x, y], w, h| [x / aspect(w, h) + 1.0 / 2.0, 1.0 - y / 2.0]),
            ("1 is added before the aspect is taken off", |[x, y], w, h| {
                [(x + 1.0) / 2.0 / aspect(w, h), (1.0 - y) / 2.0]
            }),
            ("the aspect is taken off y, too", |[x, y], w, h| {
                [(x / aspect(w, h) + 1.0) / 2.0, 1.0 - (y / aspect(h, w) + 1.0) / 2.0]
            }),
        ],
        &[
            |[x, y], w, h| [0.5 + x * f64::from(h) / (2.0 * f64::from(w)), 0.5 - 0.5 * y],
            |[x, y], w, h| {
                let a = aspect(w, h);
                [(x + a) / (2.0 * a), (y - 1.0) / -2.0]
            },
        ],
    )
}

fn aspect(width: u32, height: u32) -> f64 {
    f64::from(width) / f64::from(height)
}
