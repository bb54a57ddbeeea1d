//! Of chapters 22 to 28.

use super::{Fresh, add, cross, dot, length, over, sub, times, unit};
use pinhole_cli::checks::{
    chapter_22_ambient_occlusion, chapter_23_depth_of_field, chapter_24_motion_blur, chapter_25_path_tracing,
    chapter_26_choosing_samples, chapter_27_caustics, chapter_28_meshes,
};
use std::f64::consts::{PI, TAU};

pub fn fresh() -> Vec<Fresh> {
    vec![cosines(), lens(), motion(), roulette(), heuristic(), caustics(), meshes()]
}

/// A direction of this radius of its foot and height, turned by an angle.
fn about_z(r: f64, z: f64, angle: f64) -> [f64; 3] {
    [r * angle.cos(), r * angle.sin(), z]
}

fn cosines() -> Fresh {
    use chapter_22_ambient_occlusion::check::exercise;
    Fresh {
        chapter: 22,
        wrong: vec![
            (exercise(|u, v| about_z(u, (1.0 - u * u).sqrt(), TAU * v)), "radius u"),
            (exercise(|u, v| about_z((1.0 - u).sqrt(), u.sqrt(), TAU * v)), "radius and height swapped"),
            (exercise(|u, v| about_z(u.sqrt(), (1.0 - u).sqrt(), v)), "2π missing"),
            (exercise(|u, v| about_z(u.sqrt(), (1.0 - u).sqrt(), PI * v)), "half a turn"),
            (exercise(|u, v| about_z(u.sqrt(), (1.0 - u).sqrt(), 360.0 * v)), "degrees"),
            (exercise(|u, v| about_z((1.0 - u * u).sqrt(), u, TAU * v)), "uniform hemisphere"),
            (exercise(|u, v| about_z((1.0 - (1.0 - u) * (1.0 - u)).sqrt(), 1.0 - u, TAU * v)), "uniform, 1 - u"),
            (
                exercise(|u, v| {
                    let r = u.sqrt();
                    [r * (TAU * v).sin(), r * (TAU * v).cos(), (1.0 - u).sqrt()]
                }),
                "sine and cosine swapped",
            ),
            (exercise(|u, v| about_z(v.sqrt(), (1.0 - v).sqrt(), TAU * u)), "u and v swapped"),
            (exercise(|u, v| about_z(u.sqrt(), 1.0 - u, TAU * v)), "height without its root"),
            (
                exercise(|u, v| {
                    let theta = u * PI / 2.0;
                    about_z(theta.sin(), theta.cos(), TAU * v)
                }),
                "angle in proportion",
            ),
            (exercise(|u, v| about_z(u.sqrt(), -(1.0 - u).sqrt(), TAU * v)), "downwards"),
            (exercise(|u, v| about_z(u.sqrt(), 0.0, TAU * v)), "left on the disk"),
        ],
        right: vec![
            exercise(|u, v| {
                let (sine, cosine) = (v * TAU).sin_cos();
                let foot = [cosine, sine].map(|part| part * u.powf(0.5));
                [foot[0], foot[1], (1.0 - foot[0] * foot[0] - foot[1] * foot[1]).max(0.0).sqrt()]
            }),
            exercise(|u, v| {
                let theta = u.sqrt().asin();
                let phi = 2.0 * PI * v;
                [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()]
            }),
        ],
    }
}

fn lens() -> Fresh {
    use chapter_23_depth_of_field::check::exercise;
    Fresh {
        chapter: 23,
        wrong: vec![
            (exercise(|[x, y], t, [a, b], f| unit([x * t * f + a, y * t * f + b, -f])), "lens added"),
            (exercise(|[x, y], t, [a, b], f| [x * t * f - a, y * t * f - b, -f]), "not normalised"),
            (
                exercise(|[x, y], t, [a, b], f| unit(sub(times(unit([x * t, y * t, -1.0]), f), [a, b, 0.0]))),
                "distance along the ray",
            ),
            (exercise(|[x, y], t, _, _| unit([x * t, y * t, -1.0])), "pinhole's"),
            (exercise(|[x, y], _, [a, b], f| unit([x * f - a, y * f - b, -f])), "no tangent"),
            (exercise(|[x, y], t, [a, b], f| unit([x * t * f - a, y * t * f - b, -1.0])), "z not scaled"),
            (exercise(|[x, y], t, [a, b], f| unit([x * t * f - a, y * t * f - b, f])), "z sign"),
            (exercise(|[x, y], t, [a, b], f| unit([(x * t - a) * f, (y * t - b) * f, -f])), "lens scaled too"),
            (exercise(|[x, y], t, [a, b], f| unit([a - x * t * f, b - y * t * f, f])), "backwards"),
            (exercise(|[x, y], t, [a, b], f| unit([x * t * f - a * t, y * t * f - b * t, -f])), "lens times tangent"),
            (exercise(|[x, y], t, [a, b], f| unit([x * t * f - b, y * t * f - a, -f])), "lens swapped"),
            (exercise(|[x, y], t, [a, b], f| unit([x * f - a, y * t * f - b, -f])), "tangent only on y"),
            (exercise(|[x, y], t, [a, b], f| unit([x * t - a, y * t - b, -f])), "place not scaled"),
        ],
        right: vec![
            exercise(|[x, y], t, lens, f| {
                let per = 1.0 / f;
                unit([x * t - lens[0] * per, y * t - lens[1] * per, -1.0])
            }),
            exercise(|[x, y], t, [a, b], f| {
                let focus = over([x * t, y * t, -1.0], 1.0 / f);
                let to = add(focus, [-a, -b, 0.0]);
                let l = to[0].hypot(to[1]).hypot(to[2]);
                to.map(|part| part / l)
            }),
        ],
    }
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
    Fresh {
        chapter: 24,
        wrong: vec![
            (exercise(|o, d, c, r, v, t| sphere(o, d, sub(c, times(v, t)), r)), "minus"),
            (exercise(|o, d, c, r, _, _| sphere(o, d, c, r)), "at rest"),
            (exercise(|o, d, c, r, v, t| sphere(sub(o, times(v, t)), d, add(c, times(v, t)), r)), "both moved"),
            (exercise(|o, d, c, r, v, _| sphere(o, d, add(c, v), r)), "time left out"),
            (exercise(|o, d, c, r, v, t| sphere(o, d, add(c, times(unit(v), t)), r)), "velocity normalised"),
            (
                exercise(|o, d, c, r, v, t| {
                    let f = sub(o, add(c, times(v, t)));
                    let b = dot(f, d);
                    let under = b * b - dot(f, f) + r * r;
                    if under < 0.0 || b > 0.0 { None } else { Some(-b + under.sqrt()) }
                }),
                "far root",
            ),
            (exercise(|o, d, c, r, v, t| sphere(o, d, add(c, times(v, t * t)), r)), "time squared"),
            (exercise(|o, d, c, r, v, t| sphere(o, d, add(c, times(v, t / 2.0)), r)), "half the time"),
            (
                exercise(|o, d, c, r, v, t| {
                    let c = add(c, times(v, t));
                    Some(sphere(o, d, c, r)? + t)
                }),
                "time added to t",
            ),
            (
                exercise(|o, d, c, r, v, t| {
                    let (f, d) = (sub(o, add(c, times(v, t))), sub(d, v));
                    let (a, b) = (dot(d, d), dot(f, d));
                    let under = b * b - a * (dot(f, f) - r * r);
                    if under < 0.0 {
                        return None;
                    }
                    [(-b - under.sqrt()) / a, (-b + under.sqrt()) / a].into_iter().find(|t| *t > 0.0)
                }),
                "as if light took time",
            ),
            (exercise(|o, d, c, r, v, t| sphere(o, unit(sub(d, times(v, t))), c, r)), "direction moved"),
            (exercise(|o, d, c, r, v, t| sphere(o, d, add(c, [v[0] * t, 0.0, 0.0]), r)), "x only"),
            (exercise(|o, d, c, r, v, t| sphere(o, d, add(c, times(v, t)), r * r)), "radius squared twice"),
        ],
        right: vec![
            exercise(|o, d, c, r, v, t| {
                let now = [c[0] + v[0] * t, c[1] + v[1] * t, c[2] + v[2] * t];
                let to = sub(now, o);
                let along = dot(to, d);
                let beside = length(cross(to, d));
                if beside > r || along < 0.0 { None } else { Some(along - ((r - beside) * (r + beside)).sqrt()) }
            }),
            exercise(|o, d, c, r, v, t| {
                let f = sub(sub(o, times(v, t)), c);
                let h = -dot(f, d);
                let near = add(f, times(d, h));
                let under = r * r - dot(near, near);
                if under < 0.0 || h < 0.0 {
                    return None;
                }
                Some((dot(f, f) - r * r) / (h + under.sqrt()))
            }),
        ],
    }
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
    Fresh {
        chapter: 25,
        wrong: vec![
            (exercise(|t, u| go(t, u, t[0].min(t[1]).min(t[2]).min(1.0))), "smallest"),
            (exercise(|t, u| go(t, u, (0.2126 * t[0] + 0.7152 * t[1] + 0.0722 * t[2]).min(1.0))), "luminance"),
            (
                exercise(|t, u| {
                    let q = most(t).min(1.0);
                    if u > q { over(t, q) } else { [0.0; 3] }
                }),
                "the wrong way",
            ),
            (
                exercise(|t, u| {
                    let q = most(t).min(1.0);
                    if u < q { over(t, 1.0 - q) } else { [0.0; 3] }
                }),
                "1 - q",
            ),
            (
                exercise(|t, u| {
                    let q = most(t).min(1.0);
                    if u < q { times(t, q) } else { [0.0; 3] }
                }),
                "times q",
            ),
            (exercise(|t, u| go(t, u, most(t).min(0.95))), "at most 0.95"),
            (
                exercise(|t, u| t.map(|part| if u < part.min(1.0) { part / part.min(1.0) } else { 0.0 })),
                "each by itself",
            ),
            (exercise(|t, u| go(t, u, t[0].min(1.0))), "red"),
            (exercise(|t, u| go(t, u, (t[0] + t[1] + t[2]).min(1.0))), "sum"),
            (
                exercise(|t, u| {
                    let q = most(t).min(1.0);
                    if u < q { over(t, q) } else { t }
                }),
                "one that ends is left as it is",
            ),
            (exercise(|t, u| go(t, u, most(t).clamp(0.05, 1.0))), "at least 0.05"),
            (exercise(|t, u| go(t, u, length(t).min(1.0))), "length"),
            (
                exercise(|t, u| {
                    let q = most(t).min(1.0);
                    if u < 1.0 - q { over(t, q) } else { [0.0; 3] }
                }),
                "probability of ending for that of going on",
            ),
            (exercise(|t, u| if u < most(t).min(1.0) { [1.0; 3] } else { [0.0; 3] }), "colour lost"),
        ],
        right: vec![
            exercise(|t, u| {
                let most = t.into_iter().fold(0.0, f64::max);
                if most >= 1.0 {
                    t
                } else if u >= most {
                    [0.0, 0.0, 0.0]
                } else {
                    t.map(|part| part * most.recip())
                }
            }),
            exercise(|[r, g, b], u| {
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
            }),
        ],
    }
}

/// The power heuristic by ratio.
fn power(own: f64, other: f64) -> f64 {
    if own == 0.0 { 0.0 } else { 1.0 / (1.0 + (other / own) * (other / own)) }
}

fn heuristic() -> Fresh {
    use chapter_26_choosing_samples::check::exercise;
    Fresh {
        chapter: 26,
        wrong: vec![
            (exercise(|own, other| own / (own * own + other * other)), "numerator not squared"),
            (
                exercise(|own, other| if own == 0.0 { 0.0 } else { 1.0 / (1.0 + (other / own).abs().powf(3.0)) }),
                "cubed",
            ),
            (exercise(|own, other| power(own, other).sqrt()), "root"),
            (exercise(|own, other| if own > other { 1.0 } else { 0.0 }), "maximum heuristic"),
            (
                exercise(|own, other| {
                    let (own, other) = (own as f32, other as f32);
                    f64::from(own * own / (own * own + other * other))
                }),
                "f32",
            ),
            (exercise(|own, other| own * own / (other * other)), "ratio of squares"),
            (exercise(|own, other| own * own / (own + other)), "denominator not squared"),
            (exercise(|own, other| 1.0 - power(own, other)), "the other's"),
            (exercise(|own, other| own * own + other * other), "only the denominator"),
            (exercise(|own, other| 1.0 / (own * own + other * other)), "1 over"),
            (exercise(|own, other| 2.0 * power(own, other)), "twice"),
            (exercise(|own, other| if own > 0.0 && other > 0.0 { power(own, other) } else { 0.0 }), "0 for other 0"),
            (exercise(|_, _| 0.5), "half"),
            (exercise(|own, other| (own - other) * (own - other) / (own * own + other * other)), "difference"),
        ],
        right: vec![
            exercise(|own, other| {
                if own <= 0.0 {
                    return 0.0;
                }
                let sine = own / own.hypot(other);
                sine * sine
            }),
            exercise(|own, other| {
                let scale = own.max(other);
                if scale == 0.0 {
                    return 0.0;
                }
                let (a, b) = ((own / scale).powf(2.0), (other / scale).powf(2.0));
                a / (a + b)
            }),
        ],
    }
}

fn caustics() -> Fresh {
    use chapter_27_caustics::check::exercise;
    fn by(p: [f64; 3], t: f64, h: f64, of: impl Fn(f64, f64, f64) -> f64) -> f64 {
        let d = length(p);
        if p[2] < 0.0 { of(2.0 * t / h * (2.0 * t / h), d, -p[2] / d) } else { 0.0 }
    }
    Fresh {
        chapter: 27,
        wrong: vec![
            (exercise(|p, t, h| by(p, t, h, |a, d, c| 1.0 / (a * d * d * (1.0 - c * c).sqrt().powf(3.0)))), "sine"),
            (exercise(|p, t, h| by(p, t, h, |a, d, c| 1.0 / (a * d * c * c * c))), "distance not squared"),
            (exercise(|p, t, h| by(p, t, h, |a, d, c| 1.0 / (a.sqrt() * d * d * c * c * c))), "area not squared"),
            (exercise(|p, t, h| by(p, t, h, |a, d, c| 1.0 / (a * d * d * c * c))), "cos²"),
            (exercise(|p, t, h| by(p, t, h, |a, d, c| a / (d * d * c * c * c))), "times the area"),
            (
                exercise(|p, t, h| {
                    let (d, a) = (length(p), 2.0 * t / h * (2.0 * t / h));
                    let c = p[2] / d;
                    if c > 0.0 { 1.0 / (a * d * d * c * c * c) } else { 0.0 }
                }),
                "looking down +z",
            ),
            (
                exercise(|p, t, h| {
                    let (d, a) = (length(p), 2.0 * t / h * (2.0 * t / h));
                    let c = p[2] / d;
                    1.0 / (a * d * d * c * c * c)
                }),
                "negative cosine",
            ),
            (exercise(|p, t, h| by(p, t, h, |a, d, c| 1.0 / (a * d * c * d * c * c * c * c))), "depth for distance"),
            (exercise(|p, t, h| by(p, t, h, |a, d, c| c * c * c / (a * d * d))), "times cos³"),
            (exercise(|p, t, h| by(p, t, h, |a, d, c| 1.0 / (4.0 * PI * a * d * d * c * c * c))), "4π"),
            (exercise(|p, t, h| by(p, t, h, |a, d, _| 1.0 / (a * d * d))), "no cosine"),
            (exercise(|p, t, h| by(p, t, h, |a, d, c| a * d * d * c * c * c)), "not inverted"),
            (exercise(|p, t, h| by(p, 2.0 * t.atan(), h, |a, d, c| 1.0 / (a * d * d * c * c * c))), "angle"),
        ],
        right: vec![
            exercise(|p, t, h| {
                let (z, d) = (-p[2], length(p));
                if z <= 0.0 { 0.0 } else { d * h * h / (4.0 * t * t * z * z * z) }
            }),
            exercise(|[x, y, z], t, h| {
                if z >= 0.0 {
                    return 0.0;
                }
                let per = h / (2.0 * t);
                let slant = (1.0 + (x / z) * (x / z) + (y / z) * (y / z)).sqrt();
                per * per * slant / (z * z)
            }),
        ],
    }
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
    Fresh {
        chapter: 28,
        wrong: vec![
            (exercise(|o, d, p, a, s| [grown(turned(sub(o, p), a), s), grown(turned(d, a), s)]), "multiplied by scale"),
            (exercise(|o, d, p, a, s| [shrunk(across(sub(o, p), a), s), shrunk(across(d, a), s)]), "transposed"),
            (exercise(|o, d, p, a, s| [shrunk(turned(sub(o, p), a), s), unit(shrunk(turned(d, a), s))]), "normalised"),
            (exercise(|o, d, _, a, s| [shrunk(turned(o, a), s), shrunk(turned(d, a), s)]), "position left out"),
            (exercise(|o, d, p, a, s| [shrunk(turned(add(o, p), a), s), shrunk(turned(d, a), s)]), "position added"),
            (
                exercise(|o, d, p, a, s| [shrunk(turned(sub(o, p), a), s), shrunk(turned(sub(d, p), a), s)]),
                "direction moved",
            ),
            (
                exercise(|o, d, p, a, s| [turned(shrunk(sub(o, p), s), a), turned(shrunk(d, s), a)]),
                "scale before the turn",
            ),
            (exercise(|o, d, p, a, s| [shrunk(turned(sub(o, p), a), s), turned(d, a)]), "direction not scaled"),
            (
                exercise(|o, d, p, a, s| [over(turned(sub(o, p), a), s[0]), over(turned(d, a), s[0])]),
                "x's factor for all",
            ),
            (exercise(|o, d, p, a, s| [sub(shrunk(turned(o, a), s), p), shrunk(turned(d, a), s)]), "position last"),
            (exercise(|o, d, p, a, s| [shrunk(turned(d, a), s), shrunk(turned(sub(o, p), a), s)]), "swapped"),
            (exercise(|o, d, p, a, s| [shrunk(turned(sub(o, p), a), s), d]), "direction untouched"),
            (
                exercise(|o, d, p, a, s| {
                    [shrunk(turned(sub(o, p), a), s.map(f64::abs)), shrunk(turned(d, a), s.map(f64::abs))]
                }),
                "absolute scale",
            ),
            (exercise(|o, d, p, _, s| [shrunk(sub(o, p), s), shrunk(d, s)]), "turn left out"),
        ],
        right: vec![
            exercise(|o, d, p, [x, y, z], s| {
                let m = [times(x, s[0]), times(y, s[1]), times(z, s[2])];
                let volume = dot(m[0], cross(m[1], m[2]));
                [sub(o, p), d].map(|v| {
                    let solved = [dot(v, cross(m[1], m[2])), dot(m[0], cross(v, m[2])), dot(m[0], cross(m[1], v))];
                    over(solved, volume)
                })
            }),
            exercise(|o, d, p, axes, s| {
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
            }),
        ],
    }
}
