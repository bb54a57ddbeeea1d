//! Of chapters 22 to 28.

use super::{Fresh, add, cross, dot, fresh, length, over, sub, times, unit};
use pinhole_cli::checks::{
    chapter_22_ambient_occlusion, chapter_23_depth_of_field, chapter_24_motion_blur, chapter_25_path_tracing,
    chapter_26_choosing_samples, chapter_27_caustics, chapter_28_meshes,
};
use std::f64::consts::{PI, TAU};

pub fn all() -> Vec<Fresh> {
    vec![cosines(), lens(), motion(), roulette(), heuristic(), caustics(), meshes()]
}

/// A direction of this radius of its foot and height, turned by an angle.
fn about_z(r: f64, z: f64, angle: f64) -> [f64; 3] {
    [r * angle.cos(), r * angle.sin(), z]
}

fn cosines() -> Fresh {
    use chapter_22_ambient_occlusion::check::exercise;
    fresh(
        22,
        exercise,
        &[
            ("u is taken for the radius", |u, v| about_z(u, (1.0 - u * u).sqrt(), TAU * v)),
            ("u and 1 − u are swapped", |u, v| about_z((1.0 - u).sqrt(), u.sqrt(), TAU * v)),
            ("v is taken for an angle", |u, v| about_z(u.sqrt(), (1.0 - u).sqrt(), v)),
            ("v makes half a turn only", |u, v| about_z(u.sqrt(), (1.0 - u).sqrt(), PI * v)),
            ("the turn is in degrees", |u, v| about_z(u.sqrt(), (1.0 - u).sqrt(), 360.0 * v)),
            ("u is taken for the height", |u, v| about_z((1.0 - u * u).sqrt(), u, TAU * v)),
            ("1 − u is taken for the height", |u, v| about_z((1.0 - (1.0 - u) * (1.0 - u)).sqrt(), 1.0 - u, TAU * v)),
            ("cosine and sine of the turn are swapped", |u, v| {
                let r = u.sqrt();
                [r * (TAU * v).sin(), r * (TAU * v).cos(), (1.0 - u).sqrt()]
            }),
            ("u and v are swapped", |u, v| about_z(v.sqrt(), (1.0 - v).sqrt(), TAU * u)),
            ("the height is not that of a unit vector", |u, v| about_z(u.sqrt(), 1.0 - u, TAU * v)),
            ("u is taken for the angle to +z", |u, v| {
                let theta = u * PI / 2.0;
                about_z(theta.sin(), theta.cos(), TAU * v)
            }),
            ("z points down", |u, v| about_z(u.sqrt(), -(1.0 - u).sqrt(), TAU * v)),
            ("z of the answer is left at 0", |u, v| about_z(u.sqrt(), 0.0, TAU * v)),
            ("the height is not that of a unit vector", |u, v| about_z(u.sqrt(), u.sqrt(), TAU * v)),
            ("x and y of the answer have the opposite sign", |u, v| about_z(u.sqrt(), (1.0 - u).sqrt(), TAU * v - PI)),
        ],
        &[
            |u, v| {
                let (sine, cosine) = (v * TAU).sin_cos();
                let foot = [cosine, sine].map(|part| part * u.powf(0.5));
                [foot[0], foot[1], (1.0 - foot[0] * foot[0] - foot[1] * foot[1]).max(0.0).sqrt()]
            },
            |u, v| {
                let theta = u.sqrt().asin();
                let phi = 2.0 * PI * v;
                [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()]
            },
        ],
    )
}

fn lens() -> Fresh {
    use chapter_23_depth_of_field::check::exercise;
    fresh(
        23,
        exercise,
        &[
            ("the lens point is added", |[x, y], t, [a, b], f| unit([x * t * f + a, y * t * f + b, -f])),
            ("the direction is not of length 1", |[x, y], t, [a, b], f| [x * t * f - a, y * t * f - b, -f]),
            ("the focus is taken along the ray", |[x, y], t, [a, b], f| {
                unit(sub(times(unit([x * t, y * t, -1.0]), f), [a, b, 0.0]))
            }),
            ("the direction is the pinhole's", |[x, y], t, _, _| unit([x * t, y * t, -1.0])),
            ("the tangent is left out", |[x, y], _, [a, b], f| unit([x * f - a, y * f - b, -f])),
            ("only x and y are multiplied by the focus distance", |[x, y], t, [a, b], f| {
                unit([x * t * f - a, y * t * f - b, -1.0])
            }),
            ("the plane in focus stands at z = +f", |[x, y], t, [a, b], f| unit([x * t * f - a, y * t * f - b, f])),
            ("the plane in focus is always at distance 1", |[x, y], t, [a, b], f| {
                unit([(x * t - a) * f, (y * t - b) * f, -f])
            }),
            ("the direction goes from the focus to the lens", |[x, y], t, [a, b], f| {
                unit([a - x * t * f, b - y * t * f, f])
            }),
            ("the lens point is multiplied by the tangent", |[x, y], t, [a, b], f| {
                unit([x * t * f - a * t, y * t * f - b * t, -f])
            }),
            ("x of `lens` and y of `lens` are swapped", |[x, y], t, [a, b], f| {
                unit([x * t * f - b, y * t * f - a, -f])
            }),
            ("only y is multiplied by the tangent", |[x, y], t, [a, b], f| unit([x * f - a, y * t * f - b, -f])),
            ("only the depth is multiplied by the focus distance", |[x, y], t, [a, b], f| {
                unit([x * t - a, y * t - b, -f])
            }),
            ("the lens stands at z = 0, not on the image plane at z = −1", |[x, y], t, [a, b], f| {
                unit([x * t * f - a, y * t * f - b, 1.0 - f])
            }),
            ("the focus is taken along the ray", |[x, y], t, [a, b], f| {
                let d = unit([x * t, y * t, -1.0]);
                unit([d[0] - a / f, d[1] - b / f, d[2]])
            }),
        ],
        &[
            |[x, y], t, lens, f| {
                let per = 1.0 / f;
                unit([x * t - lens[0] * per, y * t - lens[1] * per, -1.0])
            },
            |[x, y], t, [a, b], f| {
                let focus = over([x * t, y * t, -1.0], 1.0 / f);
                let to = add(focus, [-a, -b, 0.0]);
                let l = to[0].hypot(to[1]).hypot(to[2]);
                to.map(|part| part / l)
            },
        ],
    )
}

/// The nearest t of a unit direction, as in chapter 3.
fn sphere(o: [f64; 3], d: [f64; 3], c: [f64; 3], r: f64) -> Option<f64> {
    let f = sub(o, c);
    let b = dot(f, d);
    let under = r * r - dot(sub(f, times(d, b)), sub(f, times(d, b)));
    if under < 0.0 {
        return None;
    }
    [-b - under.sqrt(), -b + under.sqrt()].into_iter().find(|t| *t > 0.0)
}

fn motion() -> Fresh {
    use chapter_24_motion_blur::check::exercise;
    fresh(
        24,
        exercise,
        &[
            ("the sphere moves backwards", |o, d, c, r, v, t| sphere(o, d, sub(c, times(v, t)), r)),
            ("the sphere stands still", |o, d, c, r, _, _| sphere(o, d, c, r)),
            ("the motion counts twice", |o, d, c, r, v, t| sphere(sub(o, times(v, t)), d, add(c, times(v, t)), r)),
            ("the time is left out", |o, d, c, r, v, _| sphere(o, d, add(c, v), r)),
            (/* velocity normalised */ "", |o, d, c, r, v, t| sphere(o, d, add(c, times(unit(v), t)), r)),
            ("that is where the ray leaves the sphere", |o, d, c, r, v, t| {
                let f = sub(o, add(c, times(v, t)));
                let b = dot(f, d);
                let under = b * b - dot(f, f) + r * r;
                if under < 0.0 || b > 0.0 { None } else { Some(-b + under.sqrt()) }
            }),
            ("the time is squared", |o, d, c, r, v, t| sphere(o, d, add(c, times(v, t * t)), r)),
            ("the time is halved", |o, d, c, r, v, t| sphere(o, d, add(c, times(v, t / 2.0)), r)),
            ("the time is added to t", |o, d, c, r, v, t| {
                let c = add(c, times(v, t));
                Some(sphere(o, d, c, r)? + t)
            }),
            ("the direction is changed by the velocity", |o, d, c, r, v, t| {
                let (f, d) = (sub(o, add(c, times(v, t))), sub(d, v));
                let (a, b) = (dot(d, d), dot(f, d));
                let under = b * b - a * (dot(f, f) - r * r);
                if under < 0.0 {
                    return None;
                }
                [(-b - under.sqrt()) / a, (-b + under.sqrt()) / a].into_iter().find(|t| *t > 0.0)
            }),
            ("the direction is changed by the velocity", |o, d, c, r, v, t| sphere(o, unit(sub(d, times(v, t))), c, r)),
            ("only one component of the velocity counts", |o, d, c, r, v, t| {
                sphere(o, d, add(c, [v[0] * t, 0.0, 0.0]), r)
            }),
            ("`radius` is squared", |o, d, c, r, v, t| sphere(o, d, add(c, times(v, t)), r * r)),
            (
                /* the sphere grows along its way */ "",
                |o, d, c, r, v, t| sphere(o, d, add(c, times(v, t)), r + length(v) * t),
            ),
            ("1 less `time` is taken instead", |o, d, c, r, v, t| sphere(o, d, add(c, times(v, 1.0 - t)), r)),
        ],
        &[
            |o, d, c, r, v, t| {
                let now = [c[0] + v[0] * t, c[1] + v[1] * t, c[2] + v[2] * t];
                let to = sub(now, o);
                let along = dot(to, d);
                let beside = length(cross(to, d));
                if beside > r || along < 0.0 { None } else { Some(along - ((r - beside) * (r + beside)).sqrt()) }
            },
            |o, d, c, r, v, t| {
                let f = sub(sub(o, times(v, t)), c);
                let h = -dot(f, d);
                let near = add(f, times(d, h));
                let under = r * r - dot(near, near);
                if under < 0.0 || h < 0.0 {
                    return None;
                }
                Some((dot(f, f) - r * r) / (h + under.sqrt()))
            },
        ],
    )
}

fn most(t: [f64; 3]) -> f64 {
    t[0].max(t[1]).max(t[2])
}

/// Goes on with this probability, and then with this throughput.
fn go(t: [f64; 3], u: f64, q: f64) -> [f64; 3] {
    if u < q { over(t, q) } else { [0.0; 3] }
}

fn roulette() -> Fresh {
    use chapter_25_path_tracing::check::exercise;
    fresh(
        25,
        exercise,
        &[
            ("the probability is the smallest of the three", |t, u| go(t, u, t[0].min(t[1]).min(t[2]).min(1.0))),
            ("the probability is the luminance", |t, u| {
                go(t, u, (0.2126 * t[0] + 0.7152 * t[1] + 0.0722 * t[2]).min(1.0))
            }),
            ("the two ends are swapped", |t, u| {
                let q = most(t).min(1.0);
                if u > q { over(t, q) } else { [0.0; 3] }
            }),
            ("a path that goes on is divided by the probability of its end", |t, u| {
                let q = most(t).min(1.0);
                if u < q { over(t, 1.0 - q) } else { [0.0; 3] }
            }),
            ("a path that goes on is multiplied by the probability", |t, u| {
                let q = most(t).min(1.0);
                if u < q { times(t, q) } else { [0.0; 3] }
            }),
            ("the probability is cut off below 1", |t, u| go(t, u, most(t).min(0.95))),
            ("each colour plays for itself", |t, u| {
                t.map(|part| if u < part.min(1.0) { part / part.min(1.0) } else { 0.0 })
            }),
            ("the probability is that of red alone", |t, u| go(t, u, t[0].min(1.0))),
            ("the probability is the sum of the three", |t, u| go(t, u, (t[0] + t[1] + t[2]).min(1.0))),
            ("nothing ever ends", |t, u| {
                let q = most(t).min(1.0);
                if u < q { over(t, q) } else { t }
            }),
            ("the probability is kept above a smallest one", |t, u| go(t, u, most(t).clamp(0.05, 1.0))),
            ("the probability is the length of the throughput", |t, u| go(t, u, length(t).min(1.0))),
            ("a path goes on where the number lies below 1 − p", |t, u| {
                let q = most(t).min(1.0);
                if u < 1.0 - q { over(t, q) } else { [0.0; 3] }
            }),
            ("each colour is divided by itself", |t, u| if u < most(t).min(1.0) { [1.0; 3] } else { [0.0; 3] }),
            ("1 less `u` is taken instead", |t, u| {
                let q = most(t).min(1.0);
                if u > 1.0 - q { over(t, q) } else { [0.0; 3] }
            }),
            ("the probability is the middle one of the three", |t, u| {
                let mut sorted = t;
                sorted.sort_by(f64::total_cmp);
                go(t, u, sorted[1].min(1.0))
            }),
        ],
        &[
            |t, u| {
                let most = t.into_iter().fold(0.0, f64::max);
                if most >= 1.0 {
                    t
                } else if u >= most {
                    [0.0, 0.0, 0.0]
                } else {
                    t.map(|part| part * most.recip())
                }
            },
            |[r, g, b], u| {
                let mut q = r;
                if g > q {
                    q = g;
                }
                if b > q {
                    q = b;
                }
                if q > 1.0 {
                    q = 1.0;
                }
                let kept = f64::from(u8::from(u < q));
                if kept == 0.0 { [0.0; 3] } else { [kept * r / q, kept * g / q, kept * b / q] }
            },
        ],
    )
}

/// The power heuristic by ratio.
fn power(own: f64, other: f64) -> f64 {
    if own == 0.0 { 0.0 } else { 1.0 / (1.0 + (other / own) * (other / own)) }
}

fn heuristic() -> Fresh {
    use chapter_26_choosing_samples::check::exercise;
    fresh(
        26,
        exercise,
        &[
            ("own stands above the line unsquared, or the weight is divided by own a", |own, other| {
                own / (own * own + other * other)
            }),
            ("each pdf is cubed instead of squared", |own, other| {
                if own == 0.0 { 0.0 } else { 1.0 / (1.0 + (other / own).abs().powf(3.0)) }
            }),
            ("it is divided by the root of the sum of squares", |own, other| power(own, other).sqrt()),
            ("the larger pdf has all the weight", |own, other| if own > other { 1.0 } else { 0.0 }),
            ("f32 is computed in, which has seven digits", |own, other| {
                let (own, other) = (own as f32, other as f32);
                f64::from(own * own / (own * own + other * other))
            }),
            ("own² is divided by the other's alone", |own, other| own * own / (other * other)),
            ("own² is divided by the sum of the pdfs", |own, other| own * own / (own + other)),
            ("the two are swapped", |own, other| 1.0 - power(own, other)),
            ("that is the sum of the squares alone", |own, other| own * own + other * other),
            ("1 is divided by the sum of the squares", |own, other| 1.0 / (own * own + other * other)),
            ("the answer is twice what it should be", |own, other| 2.0 * power(own, other)),
            ("where the other technique never samples the path, the own one has all ", |own, other| {
                if own > 0.0 && other > 0.0 { power(own, other) } else { 0.0 }
            }),
            ("each counts half", |_, _| 0.5),
            ("it is the difference that stands above the line", |own, other| {
                (own - other) * (own - other) / (own * own + other * other)
            }),
            ("own² is divided by the larger of the two squares", |own, other| {
                let most = own.max(other);
                if most > 0.0 { (own / most) * (own / most) } else { 0.0 }
            }),
            ("the larger pdf has all the weight", |own, other| (power(own, other) + 0.5).floor()),
        ],
        &[
            |own, other| {
                if own <= 0.0 {
                    return 0.0;
                }
                let sine = own / own.hypot(other);
                sine * sine
            },
            |own, other| {
                let scale = own.max(other);
                if scale == 0.0 {
                    return 0.0;
                }
                let (a, b) = ((own / scale).powf(2.0), (other / scale).powf(2.0));
                a / (a + b)
            },
        ],
    )
}

fn caustics() -> Fresh {
    use chapter_27_caustics::check::exercise;
    fn by(p: [f64; 3], t: f64, h: f64, of: impl Fn(f64, f64, f64) -> f64) -> f64 {
        let d = length(p);
        if p[2] < 0.0 { of(2.0 * t / h * (2.0 * t / h), d, -p[2] / d) } else { 0.0 }
    }
    fresh(
        27,
        exercise,
        &[
            ("the sine is taken for the cosine", |p, t, h| {
                by(p, t, h, |a, d, c| 1.0 / (a * d * d * (1.0 - c * c).sqrt().powf(3.0)))
            }),
            ("d counts once, or its root is missing", |p, t, h| by(p, t, h, |a, d, c| 1.0 / (a * d * c * c * c))),
            ("A is the area of a pixel, its side squared", |p, t, h| {
                by(p, t, h, |a, d, c| 1.0 / (a.sqrt() * d * d * c * c * c))
            }),
            ("cos² is taken", |p, t, h| by(p, t, h, |a, d, c| 1.0 / (a * d * d * c * c))),
            ("the fraction is multiplied by the pixel's area A", |p, t, h| {
                by(p, t, h, |a, d, c| a / (d * d * c * c * c))
            }),
            ("the camera looks down −z", |p, t, h| {
                let (d, a) = (length(p), 2.0 * t / h * (2.0 * t / h));
                let c = p[2] / d;
                if c > 0.0 { 1.0 / (a * d * d * c * c * c) } else { 0.0 }
            }),
            ("the camera looks down −z", |p, t, h| {
                let (d, a) = (length(p), 2.0 * t / h * (2.0 * t / h));
                let c = p[2] / d;
                1.0 / (a * d * d * c * c * c)
            }),
            ("the depth −z is taken for d, which is the distance to the eye", |p, t, h| {
                by(p, t, h, |a, d, c| 1.0 / (a * d * c * d * c * c * c * c))
            }),
            ("the fraction is multiplied by the cosines", |p, t, h| by(p, t, h, |a, d, c| c * c * c / (a * d * d))),
            ("the answer is 1/4π times what it should be", |p, t, h| {
                by(p, t, h, |a, d, c| 1.0 / (4.0 * PI * a * d * d * c * c * c))
            }),
            ("cos³ θ is missing", |p, t, h| by(p, t, h, |a, d, _| 1.0 / (a * d * d))),
            ("that is A d² cos³ θ", |p, t, h| by(p, t, h, |a, d, c| a * d * d * c * c * c)),
            ("tan_half is taken for an angle, or an angle is made of it", |p, t, h| {
                by(p, 2.0 * t.atan(), h, |a, d, c| 1.0 / (a * d * d * c * c * c))
            }),
            ("the angle θ is that off the axis, of x and y together", |p, t, h| {
                by(p, t, h, |a, d, _| {
                    let c = -p[2] / p[1].hypot(p[2]);
                    1.0 / (a * d * d * c * c * c)
                })
            }),
            ("height − 1 pixels are taken for height", |p, t, h| {
                by(p, t, h - 1.0, |a, d, c| 1.0 / (a * d * d * c * c * c))
            }),
        ],
        &[
            |p, t, h| {
                let (z, d) = (-p[2], length(p));
                if z <= 0.0 { 0.0 } else { d * h * h / (4.0 * t * t * z * z * z) }
            },
            |[x, y, z], t, h| {
                if z >= 0.0 {
                    return 0.0;
                }
                let per = h / (2.0 * t);
                let slant = (1.0 + (x / z) * (x / z) + (y / z) * (y / z)).sqrt();
                per * per * slant / (z * z)
            },
        ],
    )
}

fn meshes() -> Fresh {
    use chapter_28_meshes::check::exercise;
    fn turned(v: [f64; 3], axes: [[f64; 3]; 3]) -> [f64; 3] {
        axes.map(|axis| dot(v, axis))
    }
    fn shrunk(v: [f64; 3], scale: [f64; 3]) -> [f64; 3] {
        [v[0] / scale[0], v[1] / scale[1], v[2] / scale[2]]
    }
    fn grown(v: [f64; 3], scale: [f64; 3]) -> [f64; 3] {
        [v[0] * scale[0], v[1] * scale[1], v[2] * scale[2]]
    }
    fn across(v: [f64; 3], axes: [[f64; 3]; 3]) -> [f64; 3] {
        add(add(times(axes[0], v[0]), times(axes[1], v[1])), times(axes[2], v[2]))
    }
    fresh(
        28,
        exercise,
        &[
            ("the ray is multiplied by the scale", |o, d, p, a, s| {
                [grown(turned(sub(o, p), a), s), grown(turned(d, a), s)]
            }),
            ("the vector is taken from object to world space", |o, d, p, a, s| {
                [shrunk(across(sub(o, p), a), s), shrunk(across(d, a), s)]
            }),
            ("the direction is of length 1 in object space too", |o, d, p, a, s| {
                [shrunk(turned(sub(o, p), a), s), unit(shrunk(turned(d, a), s))]
            }),
            ("the position is left out", |o, d, _, a, s| [shrunk(turned(o, a), s), shrunk(turned(d, a), s)]),
            ("the position is added", |o, d, p, a, s| [shrunk(turned(add(o, p), a), s), shrunk(turned(d, a), s)]),
            ("the direction is moved by the position", |o, d, p, a, s| {
                [shrunk(turned(sub(o, p), a), s), shrunk(turned(sub(d, p), a), s)]
            }),
            ("the turn is to be undone before the scale, which is along the turned a", |o, d, p, a, s| {
                [turned(shrunk(sub(o, p), s), a), turned(shrunk(d, s), a)]
            }),
            ("the direction is not divided by the scale", |o, d, p, a, s| {
                [shrunk(turned(sub(o, p), a), s), turned(d, a)]
            }),
            ("one factor is taken for all three axes", |o, d, p, a, s| {
                [over(turned(sub(o, p), a), s[0]), over(turned(d, a), s[0])]
            }),
            ("the position is subtracted last", |o, d, p, a, s| {
                [sub(shrunk(turned(o, a), s), p), shrunk(turned(d, a), s)]
            }),
            ("the two are swapped", |o, d, p, a, s| [shrunk(turned(d, a), s), shrunk(turned(sub(o, p), a), s)]),
            ("the direction stays as it is in the world", |o, d, p, a, s| [shrunk(turned(sub(o, p), a), s), d]),
            ("`scale` is taken without its sign", |o, d, p, a, s| {
                [shrunk(turned(sub(o, p), a), s.map(f64::abs)), shrunk(turned(d, a), s.map(f64::abs))]
            }),
            ("the turn is left out", |o, d, p, _, s| [shrunk(sub(o, p), s), shrunk(d, s)]),
            ("the place at t = 1 is taken for the direction", |o, d, p, a, s| {
                [shrunk(turned(sub(o, p), a), s), shrunk(turned(sub(add(o, d), p), a), s)]
            }),
            ("y of `axes` and z of `axes` are swapped", |o, d, p, a, s| {
                let a = [a[0], a[2], a[1]];
                [shrunk(turned(sub(o, p), a), s), shrunk(turned(d, a), s)]
            }),
        ],
        &[
            |o, d, p, [x, y, z], s| {
                let m = [times(x, s[0]), times(y, s[1]), times(z, s[2])];
                let volume = dot(m[0], cross(m[1], m[2]));
                [sub(o, p), d].map(|v| {
                    let solved = [dot(v, cross(m[1], m[2])), dot(m[0], cross(v, m[2])), dot(m[0], cross(m[1], v))];
                    over(solved, volume)
                })
            },
            |o, d, p, axes, s| {
                let (mut from, mut to) = ([0.0; 3], [0.0; 3]);
                for at in 0..3 {
                    for part in 0..3 {
                        from[at] += axes[at][part] * (o[part] - p[part]);
                        to[at] += axes[at][part] * d[part];
                    }
                    from[at] *= s[at].recip();
                    to[at] *= s[at].recip();
                }
                [from, to]
            },
        ],
    )
}
