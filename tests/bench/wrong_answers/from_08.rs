//! Of chapters 8 to 14.

use super::{Fresh, add, cross, dot, fresh, length, over, sub, times, unit};
use pinhole::scene::FovAxis;
use pinhole_cli::checks::{
    chapter_08_field_of_view, chapter_09_camera_to_world, chapter_10_light_and_shadow, chapter_11_conventions,
    chapter_12_how_it_is_built, chapter_13_shapes, chapter_14_transforms,
};
use std::f64::consts::PI;

pub fn all() -> Vec<Fresh> {
    vec![field_of_view(), normals(), light(), conventions(), plan(), boxes(), transforms()]
}

/// The length that the angle spans, in pixels.
fn spanned(axis: FovAxis, w: u32, h: u32) -> f64 {
    let (w, h) = (f64::from(w), f64::from(h));
    match axis {
        FovAxis::Vertical => h,
        FovAxis::Horizontal => w,
        FovAxis::Smaller => w.min(h),
        FovAxis::Larger => w.max(h),
        FovAxis::Diagonal => w.hypot(h),
    }
}

fn angle_of(angle: f64, ratio: f64) -> f64 {
    2.0 * ((angle.to_radians() / 2.0).tan() * ratio).atan().to_degrees()
}

fn field_of_view() -> Fresh {
    use chapter_08_field_of_view::check::exercise;
    fresh(
        8,
        exercise,
        &[
            ("the angle itself is divided by the aspect", |a, axis, w, h| a * f64::from(h) / spanned(axis, w, h)),
            ("the tangent is taken of the full angle", |a, axis, w, h| {
                (a.to_radians().tan() * f64::from(h) / spanned(axis, w, h)).atan().to_degrees()
            }),
            ("the answer is in radians", |a, axis, w, h| angle_of(a, f64::from(h) / spanned(axis, w, h)).to_radians()),
            ("tan takes the degrees for radians", |a, axis, w, h| {
                2.0 * ((a / 2.0).tan() * f64::from(h) / spanned(axis, w, h)).atan().to_degrees()
            }),
            ("the tangent is multiplied by the aspect", |a, axis, w, h| {
                angle_of(a, spanned(axis, w, h) / f64::from(h))
            }),
            ("the smaller and the larger side are swapped", |a, axis, w, h| {
                let axis = match axis {
                    FovAxis::Smaller => FovAxis::Larger,
                    FovAxis::Larger => FovAxis::Smaller,
                    other => other,
                };
                angle_of(a, f64::from(h) / spanned(axis, w, h))
            }),
            ("the diagonal is taken for something else", |a, axis, w, h| {
                let spanned = if axis == FovAxis::Diagonal { f64::from(w + h) } else { spanned(axis, w, h) };
                angle_of(a, f64::from(h) / spanned)
            }),
            ("the answer is half the angle", |a, axis, w, h| angle_of(a, f64::from(h) / spanned(axis, w, h)) / 2.0),
            ("the diagonal is taken for something else", |a, axis, w, h| {
                if axis == FovAxis::Diagonal { a } else { angle_of(a, f64::from(h) / spanned(axis, w, h)) }
            }),
            ("sines are taken to be in proportion to the sides", |a, axis, w, h| {
                let sine = (a.to_radians() / 2.0).sin() * f64::from(h) / spanned(axis, w, h);
                2.0 * sine.asin().to_degrees()
            }),
            ("the vertical angle is changed", |a, axis, w, h| {
                let axis = if axis == FovAxis::Vertical { FovAxis::Horizontal } else { axis };
                angle_of(a, f64::from(h) / spanned(axis, w, h))
            }),
            (/* atan2 with its arguments swapped */ "", |a, axis, w, h| {
                2.0 * spanned(axis, w, h).atan2((a.to_radians() / 2.0).tan() * f64::from(h)).to_degrees()
            }),
            ("the smaller and the larger side are taken to be the height and the wid", |a, axis, w, h| {
                let spanned = match axis {
                    FovAxis::Smaller => f64::from(h),
                    FovAxis::Larger => f64::from(w),
                    other => spanned(other, w, h),
                };
                angle_of(a, f64::from(h) / spanned)
            }),
        ],
        &[
            |a, axis, w, h| {
                let focal = spanned(axis, w, h) / (a * PI / 360.0).tan();
                360.0 / PI * f64::from(h).atan2(focal)
            },
            |a, axis, w, h| {
                let (sine, cosine) = (a.to_radians() / 2.0).sin_cos();
                let (w, h) = (f64::from(w), f64::from(h));
                let of = |l: f64| (sine * h).atan2(cosine * l).to_degrees() * 2.0;
                match axis {
                    FovAxis::Vertical => a,
                    FovAxis::Horizontal => of(w),
                    FovAxis::Diagonal => of((w * w + h * h).sqrt()),
                    FovAxis::Smaller => {
                        if h <= w {
                            a
                        } else {
                            of(w)
                        }
                    }
                    FovAxis::Larger => {
                        if w < h {
                            a
                        } else {
                            of(w)
                        }
                    }
                }
            },
        ],
    )
}

/// What the matrix of these columns makes of a vector.
fn mapped([a, b, c]: [[f64; 3]; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    add(add(times(a, x), times(b, y)), times(c, z))
}

fn cofactors([a, b, c]: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    [cross(b, c), cross(c, a), cross(a, b)]
}

fn transposed(m: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|row| [m[0][row], m[1][row], m[2][row]])
}

fn determinant([a, b, c]: [[f64; 3]; 3]) -> f64 {
    dot(a, cross(b, c))
}

fn normals() -> Fresh {
    use chapter_09_camera_to_world::check::exercise;
    fresh(
        9,
        exercise,
        &[
            ("the inverse is not transposed, or the columns are taken for rows", |m, n| {
                unit(over(mapped(transposed(cofactors(m)), n), determinant(m)))
            }),
            ("the normal is not of length 1", |m, n| over(mapped(cofactors(m), n), determinant(m))),
            ("the normal is multiplied by the transpose", |m, n| unit(mapped(transposed(m), n))),
            ("the answer has lost its sign", |m, n| unit(over(mapped(cofactors(m), n), determinant(m))).map(f64::abs)),
            ("the normal points inward", |m, n| times(unit(over(mapped(cofactors(m), n), determinant(m))), -1.0)),
            ("the normal is divided by the length of each column", |m, n| {
                unit(mapped(m.map(|column| over(column, dot(column, column))), n))
            }),
            ("the normal is divided by its squared length", |m, n| {
                let v = over(mapped(cofactors(m), n), determinant(m));
                over(v, dot(v, v))
            }),
            ("the normal is handed back as it is", |_, n| n),
            ("Second, the normal is not of length 1", |m, n| mapped(m.map(unit), n)),
            ("the normal is turned to the side of the old one", |m, n| {
                let v = unit(mapped(cofactors(m), n));
                if dot(v, n) < 0.0 { times(v, -1.0) } else { v }
            }),
            ("a cross product is in the wrong order", |[a, b, c], n| {
                let m = [cross(b, c), cross(a, c), cross(a, b)];
                unit(over(mapped(m, n), determinant([a, b, c])))
            }),
            ("only the numbers on the diagonal count", |m, n| unit([n[0] / m[0][0], n[1] / m[1][1], n[2] / m[2][2]])),
            ("the scale is left out, as if the map only turned", |m, n| {
                let m = m.map(unit);
                unit(over(mapped(cofactors(m), n), determinant(m)))
            }),
        ],
        &[
            |m, n| {
                let most = if n[0].abs() < 0.5 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
                let t = cross(n, most);
                let v = unit(cross(mapped(m, t), mapped(m, cross(n, t))));
                if dot(v, mapped(m, n)) < 0.0 { times(v, -1.0) } else { v }
            },
            |m, n| {
                let mut rows = [0, 1, 2].map(|row| [m[row][0], m[row][1], m[row][2], n[row]]);
                for at in 0..3 {
                    let best = (at..3).max_by(|&i, &j| rows[i][at].abs().total_cmp(&rows[j][at].abs())).unwrap_or(at);
                    rows.swap(at, best);
                    for other in (0..3).filter(|other| *other != at) {
                        let factor = rows[other][at] / rows[at][at];
                        let pivot = rows[at];
                        rows[other].iter_mut().zip(pivot).for_each(|(part, of)| *part -= factor * of);
                    }
                }
                unit([0, 1, 2].map(|at| rows[at][3] / rows[at][at]))
            },
        ],
    )
}

/// The cosine, cut at 0, and the distance.
fn towards(p: [f64; 3], n: [f64; 3], light: [f64; 3]) -> (f64, f64) {
    let l = sub(light, p);
    let d = length(l);
    (if d > 0.0 { (dot(n, l) / d).max(0.0) } else { 0.0 }, d)
}

fn light() -> Fresh {
    use chapter_10_light_and_shadow::check::exercise;
    fresh(
        10,
        exercise,
        &[
            ("the light thins out with the distance once, not twice", |c, i, p, n, light| {
                let l = sub(light, p);
                let d2 = dot(l, l);
                if d2 > 0.0 { c / PI * i * dot(n, l).max(0.0) / d2 } else { 0.0 }
            }),
            ("the intensity is divided by 4π", |c, i, p, n, light| {
                let (cosine, d) = towards(p, n, light);
                if d > 0.0 { c / PI * i * cosine / (4.0 * PI * d * d) } else { 0.0 }
            }),
            ("the BRDF is colour / π, not colour / 2π", |c, i, p, n, light| {
                let (cosine, d) = towards(p, n, light);
                if d > 0.0 { c / (2.0 * PI) * i * cosine / (d * d) } else { 0.0 }
            }),
            ("the colour is left out", |_, i, p, n, light| {
                let (cosine, d) = towards(p, n, light);
                if d > 0.0 { i * cosine / (PI * d * d) } else { 0.0 }
            }),
            ("the direction leads from the light to the surface", |c, i, p, n, light| {
                let (cosine, d) = towards(light, n, p);
                if d > 0.0 { c / PI * i * cosine / (d * d) } else { 0.0 }
            }),
            ("the cosine is squared", |c, i, p, n, light| {
                let (cosine, d) = towards(p, n, light);
                if d > 0.0 { c / PI * i * cosine * cosine / (d * d) } else { 0.0 }
            }),
            ("the light thins out too fast", |c, i, p, n, light| {
                let (cosine, d) = towards(p, n, light);
                if d > 0.0 { c / PI * i * cosine / (d * d * d * d) } else { 0.0 }
            }),
            ("1 is added to d²", |c, i, p, n, light| {
                let (cosine, d) = towards(p, n, light);
                c / PI * i * cosine / (1.0 + d * d)
            }),
            ("the answer is cut off at 1", |c, i, p, n, light| {
                let (cosine, d) = towards(p, n, light);
                if d > 0.0 { (c / PI * i * cosine / (d * d)).min(1.0) } else { 0.0 }
            }),
            ("the cosine is taken at the origin", |c, i, p, n, light| {
                let d = length(sub(light, p));
                if d > 0.0 { c / PI * i * (dot(n, light) / length(light)).max(0.0) / (d * d) } else { 0.0 }
            }),
            ("the BRDF is colour / π", |c, i, p, n, light| {
                let (cosine, d) = towards(p, n, light);
                if d > 0.0 { c * PI * i * cosine / (d * d) } else { 0.0 }
            }),
            ("the light does not thin out with the distance", |c, i, p, n, light| {
                let (cosine, _) = towards(p, n, light);
                c / PI * i * cosine
            }),
            ("|x| + |y| + |z| is taken for the distance", |c, i, p, n, light| {
                let d: f64 = sub(light, p).iter().map(|part| part.abs()).sum();
                if d > 0.0 { c / PI * i * (dot(n, sub(light, p)) / d).max(0.0) / (d * d) } else { 0.0 }
            }),
            ("a gamma is applied", |c, i, p, n, light| {
                let (cosine, d) = towards(p, n, light);
                if d > 0.0 { (c / PI * i * cosine / (d * d)).powf(1.0 / 2.2) } else { 0.0 }
            }),
        ],
        &[
            |c, i, p, n, light| {
                let l = sub(light, p);
                let facing = dot(n, l);
                if facing <= 0.0 { 0.0 } else { i * c * facing / (PI * dot(l, l).powf(1.5)) }
            },
            |colour, intensity, p, n, light| {
                let l = [light[0] - p[0], light[1] - p[1], light[2] - p[2]];
                let d = l[0].hypot(l[1]).hypot(l[2]);
                if d == 0.0 {
                    return 0.0;
                }
                let irradiance = intensity * n.iter().zip(l).map(|(a, b)| a * (b / d)).sum::<f64>() / d / d;
                if irradiance < 0.0 { 0.0 } else { colour * irradiance * std::f64::consts::FRAC_1_PI }
            },
        ],
    )
}

fn conventions() -> Fresh {
    use chapter_11_conventions::check::exercise;
    fresh(
        11,
        exercise,
        &[
            ("z is turned where it should not be", |[x, y, z], r, u, a| [x * s(r), y * s(u), z * s(a)]),
            ("x is turned where it points right, as it does in pinhole's", |[x, y, z], r, u, a| {
                [x * s(!r), y * s(u), z * s(!a)]
            }),
            ("y and z of the answer are swapped", |[x, y, z], r, u, a| [x * s(r), z * s(!a), y * s(u)]),
            ("y is never turned", |[x, y, z], r, _, a| [x * s(r), y, z * s(!a)]),
            ("z is always turned", |[x, y, z], r, u, _| [x * s(r), y * s(u), -z]),
            ("a bool is taken for a factor of 0 or 1", |[x, y, z], r, u, a| {
                [x * f64::from(u8::from(r)), y * f64::from(u8::from(u)), z * f64::from(u8::from(!a))]
            }),
            ("only the first axis that differs is turned", |[x, y, z], r, u, a| {
                if !r {
                    return [-x, y, z];
                }
                if !u {
                    return [x, -y, z];
                }
                [x, y, z * s(!a)]
            }),
            ("`x_right` and `z_ahead` are swapped", |[x, y, z], r, u, a| [x * s(a), y * s(u), z * s(!r)]),
            ("a left-handed camera is mended by its z alone", |[x, y, z], r, u, a| {
                let right_handed = r == (u != a);
                [x, y, if right_handed { z } else { -z }]
            }),
            ("the direction's own signs are lost", |[x, y, z], r, u, a| {
                [x.abs() * s(r), y.abs() * s(u), z.abs() * s(!a)]
            }),
            ("y is turned where it points up, as it does in pinhole's", |[x, y, z], r, u, a| {
                [x * s(r), y * s(!u), z * s(!a)]
            }),
            ("the whole direction is reversed where one flag asks for it", |v, r, u, a| {
                if r && u && !a { v } else { times(v, -1.0) }
            }),
            ("a flag is asked for only where another one is set", |[x, y, z], r, u, a| {
                [x * s(r), y * s(u), if r && a { -z } else { z }]
            }),
        ],
        &[
            |v, r, u, a| {
                let mut out = v;
                for (at, turned) in [!r, !u, a].into_iter().enumerate() {
                    if turned {
                        out[at] = 0.0 - out[at];
                    }
                }
                out
            },
            |[x, y, z], r, u, a| {
                let signed = |plus: bool| f64::from(i8::from(plus) * 2 - 1);
                [x * signed(r), signed(u) * y, -signed(a) * z]
            },
        ],
    )
}

fn s(plus: bool) -> f64 {
    if plus { 1.0 } else { -1.0 }
}

fn plan() -> Fresh {
    use chapter_12_how_it_is_built::check::{StageWords, exercise};
    fn backwards(stages: &[StageWords], asked: &str, keep: fn(&StageWords, &[String]) -> bool) -> Vec<String> {
        let (mut wanted, mut kept) = (vec![asked.to_owned()], Vec::new());
        for stage in stages.iter().rev().filter(|stage| stage.needed) {
            if keep(stage, &wanted) {
                wanted.extend(stage.reads.iter().cloned());
                kept.insert(0, stage.name.clone());
            }
        }
        kept
    }
    fresh(
        12,
        exercise,
        &[
            ("the stages are gone through first to last", |stages, asked| {
                let mut wanted = vec![asked.to_owned()];
                let mut kept = Vec::new();
                for stage in stages {
                    if stage.needed && stage.writes.iter().any(|column| wanted.contains(column)) {
                        wanted.extend(stage.reads.iter().cloned());
                        kept.push(stage.name.clone());
                    }
                }
                kept
            }),
            ("what a dropped stage reads is wanted too", |stages, asked| {
                let read = |column: &String| stages.iter().any(|stage| stage.reads.contains(column));
                let keep = |stage: &&StageWords| {
                    stage.needed && stage.writes.iter().any(|column| column == asked || read(column))
                };
                stages.iter().filter(keep).map(|stage| stage.name.clone()).collect()
            }),
            ("whether anything reads what a stage writes is left out", |stages, _| {
                stages.iter().filter(|stage| stage.needed).map(|stage| stage.name.clone()).collect()
            }),
            ("a column counts as provided for once a stage writes it", |stages, asked| {
                let (mut wanted, mut kept) = (vec![asked.to_owned()], Vec::new());
                for stage in stages.iter().rev().filter(|stage| stage.needed) {
                    if stage.writes.iter().any(|column| wanted.contains(column)) {
                        wanted.retain(|column| !stage.writes.contains(column));
                        wanted.extend(stage.reads.iter().cloned());
                        kept.insert(0, stage.name.clone());
                    }
                }
                kept
            }),
            (/* readers too */ "", |stages, asked| {
                backwards(stages, asked, |stage, wanted| {
                    stage.writes.iter().chain(&stage.reads).any(|column| wanted.contains(column))
                })
            }),
            ("a stage is kept only if all that it writes is wanted", |stages, asked| {
                backwards(stages, asked, |stage, wanted| stage.writes.iter().all(|column| wanted.contains(column)))
            }),
            ("only the stages that those of the column asked for read are kept", |stages, asked| {
                let last: Vec<_> = stages.iter().filter(|stage| stage.writes.iter().any(|c| c == asked)).collect();
                let keep = |stage: &&StageWords| {
                    let read = |column: &String| last.iter().any(|last| last.needed && last.reads.contains(column));
                    stage.needed && stage.writes.iter().any(|column| column == asked || read(column))
                };
                stages.iter().filter(keep).map(|stage| stage.name.clone()).collect()
            }),
            ("the stages come out in another order", |stages, asked| {
                let mut kept =
                    backwards(stages, asked, |stage, wanted| stage.writes.iter().any(|c| wanted.contains(c)));
                kept.sort();
                kept
            }),
            ("a stage counts as read if an earlier one reads what it writes", |stages, asked| {
                let mut wanted = vec![asked.to_owned()];
                for _ in stages {
                    for stage in stages.iter().filter(|stage| stage.needed) {
                        if stage.writes.iter().any(|column| wanted.contains(column)) {
                            wanted.extend(stage.reads.iter().cloned());
                            wanted.sort();
                            wanted.dedup();
                        }
                    }
                }
                let keep = |stage: &&StageWords| stage.needed && stage.writes.iter().any(|c| wanted.contains(c));
                stages.iter().filter(keep).map(|stage| stage.name.clone()).collect()
            }),
            ("what a stage that the scene does not need reads is wanted too", |stages, asked| {
                let (mut wanted, mut kept) = (vec![asked.to_owned()], Vec::new());
                for stage in stages.iter().rev() {
                    if stage.writes.iter().any(|column| wanted.contains(column)) {
                        wanted.extend(stage.reads.iter().cloned());
                        if stage.needed {
                            kept.insert(0, stage.name.clone());
                        }
                    }
                }
                kept
            }),
            (/* a stage once for each column */ "", |stages, asked| {
                let (mut wanted, mut kept) = (vec![asked.to_owned()], Vec::new());
                for stage in stages.iter().rev().filter(|stage| stage.needed) {
                    for column in &stage.writes {
                        if wanted.contains(column) {
                            wanted.extend(stage.reads.iter().cloned());
                            kept.insert(0, stage.name.clone());
                        }
                    }
                }
                kept
            }),
            (/* at most two */ "", |stages, asked| {
                let mut kept =
                    backwards(stages, asked, |stage, wanted| stage.writes.iter().any(|c| wanted.contains(c)));
                kept.reverse();
                kept.truncate(2);
                kept.reverse();
                kept
            }),
        ],
        &[
            |stages, asked| {
                fn keeps(stages: &[StageWords], at: usize, asked: &str) -> bool {
                    let later = |column: &String| {
                        let mut after = at + 1..stages.len();
                        column == asked || after.any(|of| stages[of].reads.contains(column) && keeps(stages, of, asked))
                    };
                    stages[at].needed && stages[at].writes.iter().any(later)
                }
                let kept = (0..stages.len()).filter(|&at| keeps(stages, at, asked));
                kept.map(|at| stages[at].name.to_string()).collect()
            },
            |stages, asked| {
                let mut wanted = std::collections::HashSet::from([asked]);
                let mut marks = vec![false; stages.len()];
                let mut at = stages.len();
                while at > 0 {
                    at -= 1;
                    let StageWords { needed, reads, writes, .. } = &stages[at];
                    marks[at] = *needed && writes.iter().filter(|column| wanted.contains(column.as_str())).count() > 0;
                    if marks[at] {
                        wanted.extend(reads.iter().map(String::as_str));
                    }
                }
                stages.iter().zip(marks).filter(|(_, mark)| *mark).map(|(stage, _)| stage.name.clone()).collect()
            },
        ],
    )
}

/// Where the line is between the faces of one axis.
fn slab(o: f64, d: f64, min: f64, max: f64) -> [f64; 2] {
    if d == 0.0 {
        return if min <= o && o <= max {
            [f64::NEG_INFINITY, f64::INFINITY]
        } else {
            [f64::INFINITY, f64::NEG_INFINITY]
        };
    }
    let (a, b) = ((min - o) / d, (max - o) / d);
    [a.min(b), a.max(b)]
}

fn slabs(o: [f64; 3], d: [f64; 3], min: [f64; 3], max: [f64; 3]) -> [[f64; 2]; 3] {
    [0, 1, 2].map(|at| slab(o[at], d[at], min[at], max[at]))
}

/// The first above 0 of where the line enters and leaves.
fn first(near: f64, far: f64) -> Option<f64> {
    if near > far {
        return None;
    }
    [near, far].into_iter().find(|t| *t > 0.0)
}

fn boxes() -> Fresh {
    use chapter_13_shapes::check::exercise;
    fresh(
        13,
        exercise,
        &[
            ("the ray is taken to be inside while any slab has it", |o, d, min, max| {
                let [x, y, z] = slabs(o, d, min, max);
                first(x[0].min(y[0]).min(z[0]), x[1].max(y[1]).max(z[1]))
            }),
            ("the direction is brought to length 1 and t is left so", |o, d, min, max| {
                let [x, y, z] = slabs(o, d, min, max);
                first(x[0].max(y[0]).max(z[0]), x[1].min(y[1]).min(z[1])).map(|t| t * length(d))
            }),
            (/* z left out */ "", |o, d, min, max| {
                let [x, y, _] = slabs(o, d, min, max);
                first(x[0].max(y[0]), x[1].min(y[1]))
            }),
            ("a ray through an edge or in a face is lost", |o, d, min, max| {
                let [x, y, z] = slabs(o, d, min, max);
                let (near, far) = (x[0].max(y[0]).max(z[0]), x[1].min(y[1]).min(z[1]));
                if near < far { first(near, far) } else { None }
            }),
            ("an axis along which the direction is 0 is left out", |o, d, min, max| {
                let (mut near, mut far) = (f64::NEG_INFINITY, f64::INFINITY);
                for at in (0..3).filter(|&at| d[at] != 0.0) {
                    let [a, b] = slab(o[at], d[at], min[at], max[at]);
                    (near, far) = (near.max(a), far.min(b));
                }
                first(near, far)
            }),
            ("from inside, nothing is hit", |o, d, min, max| {
                let [x, y, z] = slabs(o, d, min, max);
                let (near, far) = (x[0].max(y[0]).max(z[0]), x[1].min(y[1]).min(z[1]));
                if near > far || near <= 0.0 { None } else { Some(near) }
            }),
            ("from inside, the origin counts as the hit", |o, d, min, max| {
                let [x, y, z] = slabs(o, d, min, max);
                let (near, far) = (x[0].max(y[0]).max(z[0]), x[1].min(y[1]).min(z[1]));
                if near > far || far < 0.0 { None } else { Some(near.max(0.0)) }
            }),
            ("a direction of 0 along an axis is taken for a miss", |o, d, min, max| {
                if d.contains(&0.0) {
                    return None;
                }
                let [x, y, z] = slabs(o, d, min, max);
                first(x[0].max(y[0]).max(z[0]), x[1].min(y[1]).min(z[1]))
            }),
            (/* min of the entries */ "", |o, d, min, max| {
                let [x, y, z] = slabs(o, d, min, max);
                let (near, far) = (x[0].min(y[0]).min(z[0]), x[1].min(y[1]).min(z[1]));
                first(near, far)
            }),
            ("`max` is taken for the box's size", |o, d, min, max| {
                let [x, y, z] = slabs(o, d, min, add(min, max));
                first(x[0].max(y[0]).max(z[0]), x[1].min(y[1]).min(z[1]))
            }),
            ("the far side is taken where the near one is ahead", |o, d, min, max| {
                let [x, y, z] = slabs(o, d, min, max);
                let (near, far) = (x[0].max(y[0]).max(z[0]), x[1].min(y[1]).min(z[1]));
                if near > far || far <= 0.0 { None } else { Some(far) }
            }),
            ("the slab is entered at its smaller coordinate", |o, d, min, max| {
                let [x, y, z] = slabs(o, d.map(f64::abs), min, max);
                first(x[0].max(y[0]).max(z[0]), x[1].min(y[1]).min(z[1]))
            }),
            ("what lies behind the origin is hit too", |o, d, min, max| {
                let all = slabs(o, d, min, max);
                let near = all[0][0].max(all[1][0]).max(all[2][0]);
                let far = all[0][1].min(all[1][1]).min(all[2][1]);
                if near > far || far < 0.0 { None } else { Some(near) }
            }),
        ],
        &[
            |o, d, min, max| {
                let (mut near, mut far) = (f64::NEG_INFINITY, f64::INFINITY);
                for at in 0..3 {
                    let to_min = min[at] - o[at];
                    let to_max = max[at] - o[at];
                    if d[at] == 0.0 {
                        if to_min > 0.0 || to_max < 0.0 {
                            return None;
                        }
                        continue;
                    }
                    let (enter, leave) = if d[at].is_sign_negative() {
                        (to_max / d[at], to_min / d[at])
                    } else {
                        (to_min / d[at], to_max / d[at])
                    };
                    if enter > near {
                        near = enter;
                    }
                    if leave < far {
                        far = leave;
                    }
                }
                match (near <= far, near > 0.0, far > 0.0) {
                    (true, true, _) => Some(near),
                    (true, false, true) => Some(far),
                    _ => None,
                }
            },
            |o, d, min, max| {
                let all = slabs(o, d, min, max);
                let crossings = all.iter().flatten().copied().filter(|t| t.is_finite() && *t > 0.0);
                let in_all = |t: f64| all.iter().all(|[a, b]| *a <= t && t <= *b);
                crossings.filter(|&t| in_all(t)).min_by(f64::total_cmp)
            },
        ],
    )
}

fn mixed(normals: [[f64; 3]; 3], weights: [f64; 3]) -> [f64; 3] {
    mapped(normals, weights)
}

/// The cosine of a shading normal as it should be used.
fn lit(geometric: [f64; 3], shading: [f64; 3], eye: [f64; 3], light: [f64; 3]) -> f64 {
    let g = if dot(geometric, eye) < 0.0 { times(geometric, -1.0) } else { geometric };
    let n = if dot(shading, g) < 0.0 { times(shading, -1.0) } else { shading };
    if dot(g, light) <= 0.0 { 0.0 } else { dot(n, unit(light)).max(0.0) }
}

fn transforms() -> Fresh {
    use chapter_14_transforms::check::exercise;
    fresh(
        14,
        exercise,
        &[
            ("the mixed normal is not brought to length 1", |g, n, w, eye, light| lit(g, mixed(n, w), eye, light)),
            ("the direction to the light is not brought to length 1", |g, n, w, eye, light| {
                lit(g, unit(mixed(n, w)), eye, light) * length(light)
            }),
            ("light falls as the surface lies, whatever its corners' normals are", |g, _, _, eye, light| {
                lit(g, g, eye, light)
            }),
            ("the cosines at the corners are mixed", |g, n, w, eye, light| {
                (0..3).map(|at| w[at] * lit(g, n[at], eye, light)).sum()
            }),
            ("the mixed normal is not turned to the eye's side, but light falls only", |g, n, w, _, light| {
                if dot(g, light) <= 0.0 { 0.0 } else { dot(unit(mixed(n, w)), unit(light)).max(0.0) }
            }),
            ("light falls on the mixed normal from behind, too", |_, n, w, _, light| {
                dot(unit(mixed(n, w)), unit(light)).abs()
            }),
            ("light comes from below the surface, where the mixed normal leans to it", |g, n, w, eye, light| {
                let g = if dot(g, eye) < 0.0 { times(g, -1.0) } else { g };
                let n = unit(mixed(n, w));
                let n = if dot(n, g) < 0.0 { times(n, -1.0) } else { n };
                dot(n, unit(light)).max(0.0)
            }),
            (/* nearest corner */ "", |g, n, w, eye, light| {
                let most = (0..3).max_by(|&a, &b| w[a].total_cmp(&w[b])).unwrap_or(0);
                lit(g, n[most], eye, light)
            }),
            ("the weights are left out", |g, n, _, eye, light| lit(g, unit(mixed(n, [1.0 / 3.0; 3])), eye, light)),
            ("the weights go with the wrong corners", |g, n, w, eye, light| {
                lit(g, unit(mixed(n, [w[1], w[2], w[0]])), eye, light)
            }),
            ("the mixed normal is turned to the eye by its own direction", |g, n, w, eye, light| {
                let n = unit(mixed(n, w));
                let n = if dot(n, eye) < 0.0 { times(n, -1.0) } else { n };
                let g = if dot(g, eye) < 0.0 { times(g, -1.0) } else { g };
                if dot(g, light) <= 0.0 { 0.0 } else { dot(n, unit(light)).max(0.0) }
            }),
            ("the side that is lit is the light's", |g, n, w, _, light| lit(g, unit(mixed(n, w)), light, light)),
            ("this is the cosine towards the eye", |g, n, w, eye, light| {
                if lit(g, unit(mixed(n, w)), eye, light) > 0.0 { lit(g, unit(mixed(n, w)), eye, eye) } else { 0.0 }
            }),
            ("that is the cosine to the half vector", |g, n, w, eye, light| {
                lit(g, unit(mixed(n, w)), eye, add(unit(eye), unit(light)))
            }),
        ],
        &[
            |g, n, w, eye, light| {
                let side = dot(g, eye).signum();
                if dot(g, light) * side <= 0.0 {
                    return 0.0;
                }
                let mut sum = [0.0; 3];
                for (normal, weight) in n.iter().zip(w) {
                    for at in 0..3 {
                        sum[at] += weight * normal[at];
                    }
                }
                let same = if dot(sum, g) * side < 0.0 { -1.0 } else { 1.0 };
                let cosine = same * dot(sum, light) / (dot(sum, sum) * dot(light, light)).sqrt();
                if cosine > 0.0 { cosine } else { 0.0 }
            },
            |g, n, w, eye, light| {
                let lit_side = (dot(g, eye) > 0.0) == (dot(g, light) > 0.0) && dot(g, light) != 0.0;
                let flipped = (dot(g, eye) < 0.0) != (dot(n[0], g) < 0.0);
                let s = unit(add(times(n[2], w[2]), add(times(n[1], w[1]), times(n[0], w[0]))));
                let l = length(light);
                let cosine = dot(s, light) / l * if flipped { -1.0 } else { 1.0 };
                f64::from(u8::from(lit_side)) * cosine.clamp(0.0, 1.0)
            },
        ],
    )
}
