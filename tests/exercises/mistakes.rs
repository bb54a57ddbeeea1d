//! Typical wrong solutions, written as a reader would, and a word of what must be said of each.

use super::solutions::depth_of_field::lens_direction;
use super::solutions::hit::nearest_sphere_t;
use super::solutions::motion_blur::moving_sphere_t;
use pinhole::scene::FovAxis;
use pinhole_lab::{Attempt, StageWords};
use std::f64::consts::{PI, TAU};

/// The chapter, the wrong function, words of the remark that it must get.
pub const ALL: &[(&str, Attempt, &str)] = &[
    ("01_image", Attempt::RasterFromIndex(|i, w| [(i % w as u64) as f64, (i / w as u64) as f64]), "half is missing"),
    (
        "01_image",
        Attempt::RasterFromIndex(|i, w| [(i as u32 % w) as f64 + 0.5, (i as u32 / w) as f64 + 0.5]),
        "32 bits",
    ),
    (
        "01_image",
        Attempt::RasterFromIndex(|i, w| [(i / w as u64) as f64 + 0.5, (i % w as u64) as f64 + 0.5]),
        "swapped",
    ),
    ("01_image", Attempt::RasterFromIndex(fractional_row), "counted whole"),
    ("02_ray", Attempt::Unit(|v| Some(divided(v, length(v)))), "squares overflow"),
    ("02_ray", Attempt::Unit(|v| (length(v) > 0.0).then(|| divided(v, length(v)))), "squares overflow"),
    ("02_ray", Attempt::Unit(finite_or_none), "squares overflow"),
    ("02_ray", Attempt::Unit(|v| Some(divided(v, length(v) * length(v)))), "square root is missing"),
    ("02_ray", Attempt::Unit(scaled_but_never_none), "None"),
    ("03_hit", Attempt::NearestSphereT(|o, d, c, r| school(o, d, c, r).map(|(near, _)| near)), "behind the origin"),
    ("03_hit", Attempt::NearestSphereT(|o, d, c, r| Some(school(o, d, c, r)?.0).filter(|&t| t > 0.0)), "from inside"),
    ("03_hit", Attempt::NearestSphereT(|o, d, c, r| Some(school(o, d, c, r)?.1).filter(|&t| t > 0.0)), "farther root"),
    ("03_hit", Attempt::NearestSphereT(both_roots), "b² − ac"),
    ("03_hit", Attempt::NearestSphereT(unit_assumed), "length 1"),
    ("04_orthographic", Attempt::OrthographicRay(|[x, y], h| ([x * h, y * h, 0.0], AHEAD)), "twice as far"),
    ("04_orthographic", Attempt::OrthographicRay(|[x, y], h| ([x * h / 2.0, y * h / 2.0, 0.0], [0.0, 0.0, 1.0])), "−z"),
    (
        "04_orthographic",
        Attempt::OrthographicRay(|[x, y], h| ([x * h / 2.0, -y * h / 2.0, 0.0], AHEAD)),
        "y points down",
    ),
    ("05_pinhole", Attempt::PerspectiveDirection(|[x, y], t| [x * t, y * t, -1.0]), "not of length 1"),
    ("05_pinhole", Attempt::PerspectiveDirection(|[x, y], _| normalised([x, y, -1.0])), "left out"),
    ("05_pinhole", Attempt::PerspectiveDirection(|[x, y], t| normalised([x, y * t, -1.0])), "only y"),
    ("05_pinhole", Attempt::PerspectiveDirection(|[x, y], t| normalised([-x * t, -y * t, -1.0])), "box with a hole"),
    (
        "05_pinhole",
        Attempt::PerspectiveDirection(|[x, y], t| normalised([x * t.tan(), y * t.tan(), -1.0])),
        "taken of the tangent",
    ),
    ("06_ndc", Attempt::PixelFromNdc(|[x, y], w, h| Some([(x * w as f64) as u32, (y * h as f64) as u32])), "outside"),
    ("06_ndc", Attempt::PixelFromNdc(clamped), "belongs to none"),
    ("06_ndc", Attempt::PixelFromNdc(one_too_many), "does not have"),
    ("06_ndc", Attempt::PixelFromNdc(closed), "1 counts as inside"),
    ("06_ndc", Attempt::PixelFromNdc(less_one), "size less 1"),
    ("06_ndc", Attempt::PixelFromNdc(rounded), "nearest"),
    ("07_screen", Attempt::NdcFromScreen(|[x, y], _, _| [(x + 1.0) / 2.0, (1.0 - y) / 2.0]), "aspect is left out"),
    ("07_screen", Attempt::NdcFromScreen(|[x, y], w, h| [(x * aspect(w, h) + 1.0) / 2.0, (1.0 - y) / 2.0]), "divide"),
    (
        "07_screen",
        Attempt::NdcFromScreen(|[x, y], w, h| [(x / aspect(w, h) + 1.0) / 2.0, (y + 1.0) / 2.0]),
        "turned over",
    ),
    (
        "07_screen",
        Attempt::NdcFromScreen(|[x, y], w, h| [(x + 1.0) / 2.0 / aspect(w, h), (1.0 - y) / 2.0]),
        "last step",
    ),
    ("08_field_of_view", Attempt::VerticalFov(|a, _, _, _| a), "handed back"),
    ("08_field_of_view", Attempt::VerticalFov(|a, x, w, h| fov(a, x, w, h, |a, s| a / s)), "tangent of its half"),
    ("08_field_of_view", Attempt::VerticalFov(in_degrees), "degrees for radians"),
    ("08_field_of_view", Attempt::VerticalFov(|a, x, w, h| fov(a, x, w, h, right_angle).to_radians()), "in radians"),
    ("08_field_of_view", Attempt::VerticalFov(|a, x, w, h| fov(a, x, w, h, right_angle) / 2.0), "half the angle"),
    ("08_field_of_view", Attempt::VerticalFov(full_angle), "full angle"),
    ("09_camera_to_world", Attempt::NormalWorldFromObject(as_a_direction), "as a direction"),
    ("09_camera_to_world", Attempt::NormalWorldFromObject(cofactors), "sign of the determinant"),
    ("10_light_and_shadow", Attempt::ReflectedRadiance(|c, i, p, n, l| light(c, i, p, n, l, |x| x, 2)), "negative"),
    (
        "10_light_and_shadow",
        Attempt::ReflectedRadiance(|c, i, p, n, l| light(c, i, p, n, l, f64::abs, 2)),
        "from behind",
    ),
    (
        "10_light_and_shadow",
        Attempt::ReflectedRadiance(|c, i, p, n, l| light(c, i, p, n, l, |x| x.max(0.0), 1)),
        "square",
    ),
    ("10_light_and_shadow", Attempt::ReflectedRadiance(without_pi), "π is missing"),
    ("10_light_and_shadow", Attempt::ReflectedRadiance(not_a_number), "no number"),
    ("11_conventions", Attempt::PinholeFromTheirs(|v, _, _, _| v), "as it is"),
    ("11_conventions", Attempt::PinholeFromTheirs(|[x, y, z], r, u, a| [s(r, x), s(u, y), s(a, z)]), "wrong way"),
    ("11_conventions", Attempt::PinholeFromTheirs(|[x, y, z], r, u, _| [s(r, x), s(u, y), z]), "z is never"),
    ("11_conventions", Attempt::PinholeFromTheirs(|[x, y, z], _, u, a| [x, s(u, y), s(!a, z)]), "x is never"),
    ("12_how_it_is_built", Attempt::Kept(|stages, _| only(stages, |stage| stage.needed)), "left out"),
    ("12_how_it_is_built", Attempt::Kept(forward), "later"),
    ("12_how_it_is_built", Attempt::Kept(backward), "last to first"),
    ("12_how_it_is_built", Attempt::Kept(one_step), "only the stage"),
    ("13_shapes", Attempt::NearestBoxT(|o, d, l, m| passed(o, d, l, m).map(|(near, _)| near)), "behind the origin"),
    ("13_shapes", Attempt::NearestBoxT(|o, d, l, m| Some(passed(o, d, l, m)?.0).filter(|&t| t > 0.0)), "from inside"),
    ("13_shapes", Attempt::NearestBoxT(|o, d, l, m| Some(passed(o, d, l, m)?.1).filter(|&t| t > 0.0)), "far side"),
    ("13_shapes", Attempt::NearestBoxT(min_and_max), "0 by 0"),
    ("13_shapes", Attempt::NearestBoxT(first_entered), "last slab"),
    (
        "18_error_and_time",
        Attempt::VarianceAndBiasSquared(|x, t| split(x, t, 1.0, squared_mean)),
        "part of the variance",
    ),
    ("18_error_and_time", Attempt::VarianceAndBiasSquared(|x, t| split(x, t, 0.0, of_pairs)), "one less is right"),
    (
        "18_error_and_time",
        Attempt::VarianceAndBiasSquared(|x, t| split(x, t, 1.0, |x| of_pairs(x).max(0.0))),
        "cut off",
    ),
    ("18_error_and_time", Attempt::VarianceAndBiasSquared(one_run_has_no_variance), "None"),
    ("18_error_and_time", Attempt::VarianceAndBiasSquared(about_the_truth), "runs' own mean"),
    ("18_error_and_time", Attempt::VarianceAndBiasSquared(squares_less_square), "rounding"),
    ("19_mirrors", Attempt::Mirrored(|d, n| off_mirror(d, n, -2.0)), "unit vector"),
    ("19_mirrors", Attempt::Mirrored(|d, n| off_mirror(d, n, -2.0 / dot(n, n)).map(|part| -part)), "goes into"),
    ("19_mirrors", Attempt::Mirrored(|d, n| off_mirror(d, n, -1.0 / dot(n, n))), "2 is missing"),
    ("19_mirrors", Attempt::Mirrored(|d, _| d.map(|part| -part)), "back where it came from"),
    ("20_glass", Attempt::Refracted(|d, n, eta| Some(through(d, n, eta))), "before you take it"),
    (
        "20_glass",
        Attempt::Refracted(|d, n, eta| passes(d, n, 1.0 / eta).then(|| through(d, n, 1.0 / eta))),
        "wrong way",
    ),
    ("20_glass", Attempt::Refracted(|d, _, _| Some(d)), "straight on"),
    ("16_textures", Attempt::MeanOfStripes(|x, _| stripe(x)), "the stripe at x itself"),
    ("16_textures", Attempt::MeanOfStripes(|x, w| stripes_between(x, x + w, w)), "either side"),
    ("16_textures", Attempt::MeanOfStripes(|x, w| stripes_between(x - w, x + w, 2.0 * w)), "twice as wide"),
    ("16_textures", Attempt::MeanOfStripes(|x, w| (zigzag(x + w / 2.0) - zigzag(x - w / 2.0)) / w), "without width"),
    ("16_textures", Attempt::MeanOfStripes(|x, w| stripes_between(x - w / 2.0, x + w / 2.0, 1.0)), "the area"),
    ("16_textures", Attempt::MeanOfStripes(|x, w| -stripes_between(x - w / 2.0, x + w / 2.0, w)), "other way round"),
    ("15_reflection", Attempt::PhongRadiance(|m, e, n, l, v| phong(m, e, n, l, v, 2.0, dot(n, l))), "faces away"),
    ("15_reflection", Attempt::PhongRadiance(|m, e, n, l, v| phong(m, e, n, l, v, 1.0, lit(n, l))), "n + 2"),
    (
        "15_reflection",
        Attempt::PhongRadiance(|m, e, n, l, v| phong(m, e, n, l, v, 2.0, step(n, l))),
        "cosine of the light's slant",
    ),
    ("15_reflection", Attempt::PhongRadiance(even_behind), "even"),
    (
        "14_transforms",
        Attempt::FallingCosine(|g, _, _, e, l| (side(g, e) * cosine(g, l)).max(0.0)),
        "as the surface lies",
    ),
    (
        "14_transforms",
        Attempt::FallingCosine(|g, n, s, e, l| fallen(g, cosine(turned(g, mixed(n, s), e), l), e, l)),
        "negative",
    ),
    (
        "14_transforms",
        Attempt::FallingCosine(|g, n, s, e, l| fallen(g, cosine(mixed(n, s), l), e, l).max(0.0)),
        "eye's side",
    ),
    ("14_transforms", Attempt::FallingCosine(not_unit), "length 1"),
    ("14_transforms", Attempt::FallingCosine(below_too), "from below the surface"),
    ("23_depth_of_field", Attempt::LensDirection(|s, t, _, f| lens_direction(s, t, [0.0; 2], f)), "the pinhole's"),
    ("23_depth_of_field", Attempt::LensDirection(a_sphere_in_focus), "along the ray"),
    ("23_depth_of_field", Attempt::LensDirection(|s, t, l, _| lens_direction(s, t, l, 1.0)), "distance 1"),
    ("23_depth_of_field", Attempt::LensDirection(|s, t, [x, y], f| lens_direction(s, t, [-x, -y], f)), "is added"),
    ("23_depth_of_field", Attempt::LensDirection(|s, _, l, f| lens_direction(s, 1.0, l, f)), "tangent is left out"),
    ("23_depth_of_field", Attempt::LensDirection(not_of_length_1), "length 1"),
    ("24_motion_blur", Attempt::MovingSphereT(|o, d, c, r, _, _| nearest_sphere_t(o, d, c, r)), "stands still"),
    ("24_motion_blur", Attempt::MovingSphereT(|o, d, c, r, v, s| moving_sphere_t(o, d, c, r, v, -s)), "wrong way"),
    (
        "24_motion_blur",
        Attempt::MovingSphereT(|o, d, c, r, v, _| moving_sphere_t(o, d, c, r, v, 1.0)),
        "time is left out",
    ),
    ("17_sampling", Attempt::TentOffset(|u, r| (2.0 * u - 1.0) * r), "a box"),
    ("17_sampling", Attempt::TentOffset(from_the_rim), "highest in the middle"),
    ("17_sampling", Attempt::TentOffset(without_root), "square root is missing"),
    ("17_sampling", Attempt::TentOffset(|u, _| super::solutions::sampling::tent_offset(u, 1.0)), "radius is left out"),
    ("17_sampling", Attempt::TentOffset(|u, r| r * (1.0 - (1.0 - u).sqrt())), "on one side"),
    ("17_sampling", Attempt::TentOffset(|u, r| super::solutions::sampling::tent_offset(1.0 - u, r)), "swapped"),
    ("21_soft_shadows", Attempt::SolidAnglePdf(|_, _, _, a| 1.0 / a), "per unit of area"),
    ("21_soft_shadows", Attempt::SolidAnglePdf(|f, t, n, a| fills(f, t, n, a, 2.0, 0.0)), "cosine at the light"),
    ("21_soft_shadows", Attempt::SolidAnglePdf(|f, t, n, a| fills(f, t, n, a, 2.0, 1.0)), "multiplied by"),
    ("21_soft_shadows", Attempt::SolidAnglePdf(|f, t, n, a| fills(f, t, n, a, 0.0, -1.0)), "distance is missing"),
    ("21_soft_shadows", Attempt::SolidAnglePdf(|f, t, n, a| fills(f, t, n, a, 1.0, -1.0)), "not squared"),
    ("21_soft_shadows", Attempt::SolidAnglePdf(|f, t, n, a| fills(f, t, n, 1.0 / a, -2.0, 1.0)), "one over it"),
    ("21_soft_shadows", Attempt::SolidAnglePdf(signed_pdf), "negative density"),
    ("21_soft_shadows", Attempt::SolidAnglePdf(|f, t, n, a| signed_pdf(f, t, n, a).max(0.0)), "has none"),
    ("21_soft_shadows", Attempt::SolidAnglePdf(edge_on), "1 / 0"),
    (
        "22_ambient_occlusion",
        Attempt::CosineDirection(|u, v| raised(u, TAU * v, (1.0 - u * u).sqrt())),
        "root is missing",
    ),
    (
        "22_ambient_occlusion",
        Attempt::CosineDirection(|u, v| raised((1.0 - u * u).sqrt(), TAU * v, u)),
        "u is taken for the height",
    ),
    (
        "22_ambient_occlusion",
        Attempt::CosineDirection(|u, v| raised((u * (2.0 - u)).sqrt(), TAU * v, 1.0 - u)),
        "1 − u is taken",
    ),
    (
        "22_ambient_occlusion",
        Attempt::CosineDirection(|u, v| raised(u.sqrt(), PI * v, (1.0 - u).sqrt())),
        "half a turn",
    ),
    (
        "22_ambient_occlusion",
        Attempt::CosineDirection(|u, v| raised(u.sqrt(), v, (1.0 - u).sqrt())),
        "taken for an angle",
    ),
    ("22_ambient_occlusion", Attempt::CosineDirection(|u, v| raised(u.sqrt(), TAU * v, 1.0 - u)), "unit vector"),
    (
        "22_ambient_occlusion",
        Attempt::CosineDirection(|u, v| raised(u.sqrt(), TAU * v, -(1.0 - u).sqrt())),
        "points down",
    ),
    ("22_ambient_occlusion", Attempt::CosineDirection(sine_first), "swapped"),
    ("25_path_tracing", Attempt::AfterRoulette(|s, u| if u < random(s) { s } else { [0.0; 3] }), "is lost"),
    ("25_path_tracing", Attempt::AfterRoulette(|s, _| s.map(|part| part / random(s))), "nothing ever ends"),
    (
        "25_path_tracing",
        Attempt::AfterRoulette(|s, u| if u < random(s) { [0.0; 3] } else { divided(s, random(s)) }),
        "two ends are swapped",
    ),
    ("25_path_tracing", Attempt::AfterRoulette(without_most), "at most 1"),
    ("25_path_tracing", Attempt::AfterRoulette(by_mean), "mean of the three"),
    ("25_path_tracing", Attempt::AfterRoulette(by_green), "green alone"),
    (
        "25_path_tracing",
        Attempt::AfterRoulette(|s, u| s.map(|part| if u < part { part.max(1.0) } else { 0.0 })),
        "each colour",
    ),
    ("26_choosing_samples", Attempt::PowerHeuristic(|p, q| if p == 0.0 { 0.0 } else { p / (p + q) }), "balance"),
    (
        "26_choosing_samples",
        Attempt::PowerHeuristic(|p, q| super::solutions::choosing_samples::power_heuristic(q, p)),
        "swapped",
    ),
    (
        "26_choosing_samples",
        Attempt::PowerHeuristic(|p, q| if p == 0.0 { 0.0 } else { p * p / (p * p + q * q) }),
        "overflow",
    ),
    ("26_choosing_samples", Attempt::PowerHeuristic(|p, q| p * p / (p * p + q * q)), "overflow"),
    ("26_choosing_samples", Attempt::PowerHeuristic(|p, q| 1.0 / (1.0 + (q / p) * (q / p))), "divided by 0"),
    ("26_choosing_samples", Attempt::PowerHeuristic(|_, _| 0.5), "counts half"),
    ("27_caustics", Attempt::PixelFraction(|point, t, h| shared(point, 2.0 * t / h, 2, 4)), "not cos⁴"),
    ("27_caustics", Attempt::PixelFraction(|point, t, h| shared(point, 2.0 * t / h, 2, 1)), "not cos:"),
    ("27_caustics", Attempt::PixelFraction(|point, t, h| shared(point, 2.0 * t / h, 2, 0)), "cos³ θ is missing"),
    ("27_caustics", Attempt::PixelFraction(|point, t, h| shared(point, 2.0 * t / h, 1, 3)), "its side squared"),
    ("27_caustics", Attempt::PixelFraction(|point, t, h| shared(point, 2.0 * t / h, 0, 3)), "area A is missing"),
    ("27_caustics", Attempt::PixelFraction(|point, t, h| shared(point, t / h, 2, 3)), "not tan_half"),
    (
        "27_caustics",
        Attempt::PixelFraction(|[x, y, z], t, h| {
            let side = 2.0 * t / h;
            (x * x + y * y + z * z).sqrt() / (side * side * -z * z * z)
        }),
        "behind the eye",
    ),
    (
        "27_caustics",
        Attempt::PixelFraction(|point, t, h| dot(point, point) * shared(point, 2.0 * t / h, 2, 3)),
        "1/d² is missing",
    ),
];

/// 1 over powers of a pixel's side and of the cosine off the axis, and over the square of the distance.
fn shared(point: [f64; 3], side: f64, sides: i32, cosines: i32) -> f64 {
    let distance = dot(point, point).sqrt();
    let cosine = -point[2] / distance;
    if cosine > 0.0 { 1.0 / (side.powi(sides) * distance * distance * cosine.powi(cosines)) } else { 0.0 }
}

fn distance_and_cosine(from: [f64; 3], at: [f64; 3], normal: [f64; 3]) -> (f64, f64) {
    let way = [0, 1, 2].map(|axis| at[axis] - from[axis]);
    let distance = dot(way, way).sqrt();
    (distance, dot(normal, way) / distance)
}

/// Powers of the distance and of the cosine over the area; 0 from the edge.
fn fills(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64, distances: f64, cosines: f64) -> f64 {
    let (distance, cosine) = distance_and_cosine(from, at, normal);
    if cosine == 0.0 { 0.0 } else { distance.powf(distances) * cosine.abs().powf(cosines) / area }
}

fn signed_pdf(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let (_, cosine) = distance_and_cosine(from, at, normal);
    fills(from, at, normal, area, 2.0, -1.0) * -cosine.signum()
}

fn edge_on(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
    let (distance, cosine) = distance_and_cosine(from, at, normal);
    distance * distance / (area * cosine.abs())
}

fn a_sphere_in_focus(screen: [f64; 2], tangent: f64, lens: [f64; 2], focus: f64) -> [f64; 3] {
    let slant = (1.0 + tangent * tangent * (screen[0] * screen[0] + screen[1] * screen[1])).sqrt();
    lens_direction(screen, tangent, lens, focus / slant)
}

fn not_of_length_1(screen: [f64; 2], tangent: f64, lens: [f64; 2], focus: f64) -> [f64; 3] {
    [screen[0] * tangent * focus - lens[0], screen[1] * tangent * focus - lens[1], -focus]
}

const AHEAD: [f64; 3] = [0.0, 0.0, -1.0];

fn stripe(x: f64) -> f64 {
    if x.floor().rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 }
}

fn zigzag(x: f64) -> f64 {
    1.0 - (x.rem_euclid(2.0) - 1.0).abs()
}

/// The area under the stripes over a number, or the stripe itself where there is no area.
fn stripes_between(low: f64, high: f64, over: f64) -> f64 {
    if low == high { stripe(low) } else { (zigzag(high) - zigzag(low)) / over }
}

fn fractional_row(index: u64, width: u32) -> [f64; 2] {
    [(index % u64::from(width)) as f64 + 0.5, index as f64 / f64::from(width) + 0.5]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn length(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

fn divided(v: [f64; 3], by: f64) -> [f64; 3] {
    v.map(|part| part / by)
}

fn normalised(v: [f64; 3]) -> [f64; 3] {
    divided(v, length(v))
}

fn finite_or_none(v: [f64; 3]) -> Option<[f64; 3]> {
    let unit = normalised(v);
    unit.iter().all(|part| part.is_finite()).then_some(unit)
}

fn scaled_but_never_none(v: [f64; 3]) -> Option<[f64; 3]> {
    let largest = v[0].abs().max(v[1].abs()).max(v[2].abs());
    Some(normalised(divided(v, largest)))
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The quadratic formula of school.
fn school(o: [f64; 3], d: [f64; 3], centre: [f64; 3], radius: f64) -> Option<(f64, f64)> {
    let f = minus(o, centre);
    let (a, b, c) = (dot(d, d), 2.0 * dot(f, d), dot(f, f) - radius * radius);
    let discriminant = b * b - 4.0 * a * c;
    let root = (discriminant >= 0.0).then(|| discriminant.sqrt())?;
    Some(((-b - root) / (2.0 * a), (-b + root) / (2.0 * a)))
}

fn both_roots(o: [f64; 3], d: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
    let (near, far) = school(o, d, centre, radius)?;
    [near, far].into_iter().find(|&t| t > 0.0)
}

fn unit_assumed(o: [f64; 3], d: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
    let f = minus(centre, o);
    let s = dot(f, d);
    let across = minus(f, d.map(|part| part * s));
    let h = radius * radius - dot(across, across);
    let h = (h >= 0.0).then(|| h.sqrt())?;
    [s - h, s + h].into_iter().find(|&t| t > 0.0)
}

fn clamped([x, y]: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let along = |n: f64, size: u32| ((n * f64::from(size)).floor().max(0.0) as u32).min(size - 1);
    Some([along(x, width), along(y, height)])
}

fn one_too_many([x, y]: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let outside = x < 0.0 || y < 0.0 || x > 1.0 || y > 1.0 || x.is_nan() || y.is_nan();
    (!outside).then(|| [(x * f64::from(width)) as u32, (y * f64::from(height)) as u32])
}

fn closed([x, y]: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let along = |n: f64, size: u32| (0.0..=1.0).contains(&n).then(|| ((n * f64::from(size)) as u32).min(size - 1));
    Some([along(x, width)?, along(y, height)?])
}

fn less_one([x, y]: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let along = |n: f64, size: u32| (0.0..1.0).contains(&n).then(|| (n * f64::from(size - 1)) as u32);
    Some([along(x, width)?, along(y, height)?])
}

fn rounded([x, y]: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
    let along = |n: f64, size: u32| (0.0..1.0).contains(&n).then(|| (n * f64::from(size)).round() as u32);
    Some([along(x, width)?, along(y, height)?])
}

fn aspect(width: u32, height: u32) -> f64 {
    f64::from(width) / f64::from(height)
}

fn fov(angle: f64, axis: FovAxis, width: u32, height: u32, vertical: fn(f64, f64) -> f64) -> f64 {
    let aspect = aspect(width, height);
    vertical(
        angle,
        match axis {
            FovAxis::Vertical => 1.0,
            FovAxis::Horizontal => aspect,
            FovAxis::Smaller => aspect.min(1.0),
            FovAxis::Larger => aspect.max(1.0),
            FovAxis::Diagonal => aspect.hypot(1.0),
        },
    )
}

fn right_angle(angle: f64, heights: f64) -> f64 {
    2.0 * ((angle.to_radians() / 2.0).tan() / heights).atan().to_degrees()
}

fn in_degrees(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
    fov(angle, axis, width, height, |angle, heights| 2.0 * ((angle / 2.0).tan() / heights).atan().to_degrees())
}

fn full_angle(angle: f64, axis: FovAxis, width: u32, height: u32) -> f64 {
    fov(angle, axis, width, height, |angle, heights| (angle.to_radians().tan() / heights).atan().to_degrees())
}

fn as_a_direction([a, b, c]: [[f64; 3]; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    normalised([0, 1, 2].map(|i| a[i] * x + b[i] * y + c[i] * z))
}

fn cofactors([a, b, c]: [[f64; 3]; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    let cross =
        |a: [f64; 3], b: [f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    as_a_direction([cross(b, c), cross(c, a), cross(a, b)], [x, y, z])
}

fn light(
    colour: f64,
    intensity: f64,
    position: [f64; 3],
    normal: [f64; 3],
    light: [f64; 3],
    cosine: fn(f64) -> f64,
    power: i32,
) -> f64 {
    let way = minus(light, position);
    let slant = dot(normal, normalised(way));
    if slant.is_nan() {
        return 0.0;
    }
    colour / std::f64::consts::PI * intensity * cosine(slant) / length(way).powi(power)
}

fn without_pi(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], lamp: [f64; 3]) -> f64 {
    light(colour, intensity, position, normal, lamp, |cosine| cosine.max(0.0), 2) * std::f64::consts::PI
}

fn not_a_number(colour: f64, intensity: f64, position: [f64; 3], normal: [f64; 3], lamp: [f64; 3]) -> f64 {
    if position == lamp { f64::NAN } else { light(colour, intensity, position, normal, lamp, |x| x.max(0.0), 2) }
}

fn s(keep: bool, part: f64) -> f64 {
    if keep { part } else { -part }
}

fn only(stages: &[StageWords], kept: impl Fn(&StageWords) -> bool) -> Vec<String> {
    stages.iter().filter(|stage| kept(stage)).map(|stage| stage.name.clone()).collect()
}

/// Round after round, until nothing more is kept; the order of the stages does not matter to it.
fn forward(stages: &[StageWords], asked: &str) -> Vec<String> {
    let mut wanted = vec![asked.to_owned()];
    loop {
        let before = wanted.len();
        for stage in stages {
            if stage.needed && stage.writes.iter().any(|column| wanted.contains(column)) {
                wanted
                    .extend(stage.reads.iter().filter(|column| !wanted.contains(column)).cloned().collect::<Vec<_>>());
            }
        }
        if wanted.len() == before {
            return only(stages, |stage| stage.needed && stage.writes.iter().any(|column| wanted.contains(column)));
        }
    }
}

fn backward(stages: &[StageWords], asked: &str) -> Vec<String> {
    let mut kept = super::solutions::how_it_is_built::kept(stages, asked);
    kept.reverse();
    kept
}

/// Where the area up to the place is counted from the tent's end as if from its top.
fn from_the_rim(u: f64, radius: f64) -> f64 {
    if u < 0.5 { -radius * (1.0 - 2.0 * u).sqrt() } else { radius * (2.0 * u - 1.0).sqrt() }
}

fn without_root(u: f64, radius: f64) -> f64 {
    if u < 0.5 { radius * (4.0 * u * u - 1.0) } else { radius * (1.0 - 4.0 * (1.0 - u) * (1.0 - u)) }
}

fn one_step(stages: &[StageWords], asked: &str) -> Vec<String> {
    only(stages, |stage| stage.needed && stage.writes.iter().any(|column| column == asked))
}

/// Where a ray is inside a box, whatever lies behind it.
fn passed(o: [f64; 3], d: [f64; 3], least: [f64; 3], most: [f64; 3]) -> Option<(f64, f64)> {
    let (mut near, mut far) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        if d[axis] == 0.0 {
            if o[axis] < least[axis] || o[axis] > most[axis] {
                return None;
            }
            continue;
        }
        let (a, b) = ((least[axis] - o[axis]) / d[axis], (most[axis] - o[axis]) / d[axis]);
        (near, far) = (near.max(a.min(b)), far.min(a.max(b)));
    }
    (near <= far).then_some((near, far))
}

/// Nothing asked beforehand: rays in the plane of a face divide 0 by 0.
fn min_and_max(o: [f64; 3], d: [f64; 3], least: [f64; 3], most: [f64; 3]) -> Option<f64> {
    let (mut near, mut far) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        let (a, b) = ((least[axis] - o[axis]) / d[axis], (most[axis] - o[axis]) / d[axis]);
        let (first, last) = if a < b { (a, b) } else { (b, a) };
        near = if first > near { first } else { near };
        far = if last < far { last } else { far };
        if near > far || near.is_nan() || far.is_nan() || first.is_nan() {
            return None;
        }
    }
    [near, far].into_iter().find(|&t| t > 0.0)
}

fn first_entered(o: [f64; 3], d: [f64; 3], least: [f64; 3], most: [f64; 3]) -> Option<f64> {
    passed(o, d, least, most)?;
    let near = |axis: usize| ((least[axis] - o[axis]) / d[axis]).min((most[axis] - o[axis]) / d[axis]);
    (0..3).filter(|&axis| d[axis] != 0.0).map(near).filter(|&t| t > 0.0).reduce(f64::min)
}

fn less_truth(runs: &[f64], truth: f64) -> Vec<f64> {
    runs.iter().map(|run| run - truth).collect()
}

fn squared_mean(off: &[f64]) -> f64 {
    (off.iter().sum::<f64>() / off.len() as f64).powi(2)
}

fn of_pairs(off: &[f64]) -> f64 {
    let (n, sum) = (off.len() as f64, off.iter().sum::<f64>());
    (sum * sum - off.iter().map(|off| off * off).sum::<f64>()) / (n * (n - 1.0))
}

fn spread(off: &[f64], fewer: f64) -> f64 {
    let mean = off.iter().sum::<f64>() / off.len() as f64;
    off.iter().map(|off| (off - mean).powi(2)).sum::<f64>() / (off.len() as f64 - fewer)
}

fn split(runs: &[f64], truth: f64, fewer: f64, bias: fn(&[f64]) -> f64) -> Option<[f64; 2]> {
    let off = less_truth(runs, truth);
    (runs.len() > 1).then(|| [spread(&off, fewer), bias(&off)])
}

fn one_run_has_no_variance(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    let off = less_truth(runs, truth);
    match runs.len() {
        0 => Some([0.0, 0.0]),
        1 => Some([0.0, off[0] * off[0]]),
        _ => Some([spread(&off, 1.0), of_pairs(&off)]),
    }
}

fn about_the_truth(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    let off = less_truth(runs, truth);
    (runs.len() > 1).then(|| [off.iter().map(|off| off * off).sum::<f64>() / (off.len() as f64 - 1.0), of_pairs(&off)])
}

fn squares_less_square(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    let n = runs.len() as f64;
    let squares = runs.iter().map(|run| run * run).sum::<f64>() / n;
    let variance = (squares - squared_mean(runs)) * n / (n - 1.0);
    (runs.len() > 1).then(|| [variance, of_pairs(&less_truth(runs, truth))])
}

/// Chapter 15 as it should be, but for the number beside n in the factor and for what arrives.
fn phong(m: [f64; 3], e: f64, n: [f64; 3], l: [f64; 3], v: [f64; 3], beside: f64, arrives: f64) -> f64 {
    let alpha = 2.0 * dot(n, l) * dot(n, v) - dot(l, v);
    let lobe = if alpha > 0.0 { (m[2] + beside) / (2.0 * PI) * alpha.min(1.0).powf(m[2]) } else { 0.0 };
    (m[0] / PI + m[1] * lobe) * e * arrives
}

fn lit(n: [f64; 3], l: [f64; 3]) -> f64 {
    dot(n, l).max(0.0)
}

fn step(n: [f64; 3], l: [f64; 3]) -> f64 {
    if dot(n, l) > 0.0 { 1.0 } else { 0.0 }
}

fn even_behind(m: [f64; 3], e: f64, n: [f64; 3], l: [f64; 3], v: [f64; 3]) -> f64 {
    let alpha = 2.0 * dot(n, l) * dot(n, v) - dot(l, v);
    let lobe = (m[2] + 2.0) / (2.0 * PI) * alpha.abs().min(1.0).powf(m[2]);
    (m[0] / PI + m[1] * lobe) * e * lit(n, l)
}

fn mixed(normals: [[f64; 3]; 3], shares: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| (0..3).map(|corner| shares[corner] * normals[corner][axis]).sum())
}

fn cosine(a: [f64; 3], b: [f64; 3]) -> f64 {
    dot(a, b) / length(a) / length(b)
}

fn side(normal: [f64; 3], towards: [f64; 3]) -> f64 {
    if dot(normal, towards) > 0.0 { 1.0 } else { -1.0 }
}

/// The mixed normal on the eye's side of the surface.
fn turned(geometric: [f64; 3], mixed: [f64; 3], eye: [f64; 3]) -> [f64; 3] {
    mixed.map(|part| part * side(geometric, eye) * side(geometric, mixed))
}

/// The cosine, and 0 where the light is below the surface.
fn fallen(geometric: [f64; 3], cosine: f64, eye: [f64; 3], light: [f64; 3]) -> f64 {
    if side(geometric, eye) == side(geometric, light) { cosine } else { 0.0 }
}

fn not_unit(g: [f64; 3], n: [[f64; 3]; 3], s: [f64; 3], e: [f64; 3], l: [f64; 3]) -> f64 {
    let normal = turned(g, mixed(n, s), e);
    fallen(g, dot(normal, l) / length(l), e, l).max(0.0)
}

fn below_too(g: [f64; 3], n: [[f64; 3]; 3], s: [f64; 3], e: [f64; 3], l: [f64; 3]) -> f64 {
    cosine(turned(g, mixed(n, s), e), l).max(0.0)
}

fn off_mirror(d: [f64; 3], n: [f64; 3], times: f64) -> [f64; 3] {
    let along = times * dot(d, n);
    [0, 1, 2].map(|part| d[part] + along * n[part])
}

fn g_squared(d: [f64; 3], n: [f64; 3], eta: f64) -> f64 {
    eta * eta - 1.0 + dot(d, n) * dot(d, n)
}

fn passes(d: [f64; 3], n: [f64; 3], eta: f64) -> bool {
    g_squared(d, n, eta) >= 0.0
}

fn through(d: [f64; 3], n: [f64; 3], eta: f64) -> [f64; 3] {
    let along = -dot(d, n) - g_squared(d, n, eta).sqrt();
    [0, 1, 2].map(|part| (d[part] + along * n[part]) / eta)
}

fn raised(radius: f64, turn: f64, height: f64) -> [f64; 3] {
    [radius * turn.cos(), radius * turn.sin(), height]
}

fn sine_first(u: f64, v: f64) -> [f64; 3] {
    [u.sqrt() * (TAU * v).sin(), u.sqrt() * (TAU * v).cos(), (1.0 - u).sqrt()]
}

fn random(share: [f64; 3]) -> f64 {
    without_cap(share).min(1.0)
}

fn without_cap(share: [f64; 3]) -> f64 {
    share[0].max(share[1]).max(share[2])
}

fn kept_with(random: f64, share: [f64; 3], u: f64) -> [f64; 3] {
    if u < random { divided(share, random) } else { [0.0; 3] }
}

fn without_most(share: [f64; 3], u: f64) -> [f64; 3] {
    kept_with(without_cap(share), share, u)
}

fn by_mean(share: [f64; 3], u: f64) -> [f64; 3] {
    kept_with(((share[0] + share[1] + share[2]) / 3.0).min(1.0), share, u)
}

fn by_green(share: [f64; 3], u: f64) -> [f64; 3] {
    kept_with(share[1].min(1.0), share, u)
}
