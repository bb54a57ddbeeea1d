//! The latest set: written from the pages alone by somebody who knew nothing of what is recognised, and tried once.
//! Without words are those that got none, or wrong ones, when they were first tried.
#![allow(clippy::pedantic, clippy::suboptimal_flops, reason = "as a reader writes it")]

use super::{Fresh, fresh};
use pinhole_cli::checks::*;

pub fn all() -> Vec<Fresh> {
    vec![
        fresh(
            1,
            chapter_01_image::check::exercise,
            &[("the index was cut to 32 bits, which 65536 × 65536 pixels nee", c01_b::raster_from_index)],
            &[c01_r::raster_from_index],
        ),
        fresh(
            2,
            chapter_02_ray::check::exercise,
            &[
                ("vectors whose squares overflow or vanish are given None, but", c02_a::unit),
                ("short vectors are taken for 0", c02_b::unit),
            ],
            &[c02_r::unit],
        ),
        fresh(
            3,
            chapter_03_hit::check::exercise,
            &[
                ("the direction is taken to be of length 1", c03_a::nearest_sphere_t),
                ("from inside, nothing is hit", c03_b::nearest_sphere_t),
                ("hits close to the origin are skipped", c03_sb::nearest_sphere_t),
            ],
            &[],
        ),
        fresh(5, chapter_05_pinhole::check::exercise, &[], &[c05_r::perspective_direction]),
        fresh(
            6,
            chapter_06_ndc::check::exercise,
            &[
                ("the point is scaled by the size less 1", c06_a::pixel_from_ndc),
                ("what lies outside is put into the nearest pixel", c06_sa::pixel_from_ndc),
            ],
            &[],
        ),
        fresh(
            7,
            chapter_07_screen::check::exercise,
            &[
                ("the aspect is put into y", c07_a::ndc_from_screen),
                ("the aspect divides whole numbers, 480 / 270 = 1", c07_b::ndc_from_screen),
            ],
            &[c07_r::ndc_from_screen],
        ),
        fresh(9, chapter_09_camera_to_world::check::exercise, &[], &[c09_r::normal_world_from_object]),
        fresh(
            10,
            chapter_10_light_and_shadow::check::exercise,
            &[("1 is added to d²", c10_b::reflected_radiance)],
            &[],
        ),
        fresh(
            11,
            chapter_11_conventions::check::exercise,
            &[("where y points down, y and z change places", c11_b::pinhole_from_theirs)],
            &[],
        ),
        fresh(
            14,
            chapter_14_transforms::check::exercise,
            &[("two things went wrong. First, the mixed normal is turned to ", c14_a::falling_cosine)],
            &[c14_r::falling_cosine],
        ),
        fresh(
            15,
            chapter_15_reflection::check::exercise,
            &[
                ("the factor is that of cosⁿ alone, (n + 1) / 2π", c15_b::phong_radiance),
                ("the cosine is forgotten in the highlight", c15_sb::phong_radiance),
            ],
            &[],
        ),
        fresh(16, chapter_16_textures::check::exercise, &[], &[c16_r::mean_of_stripes]),
        fresh(
            17,
            chapter_17_sampling::check::exercise,
            &[
                ("the root is of the area counted from the centre, not from th", c17_a::tent_offset),
                ("the digits of u are taken for two numbers", c17_b::tent_offset),
            ],
            &[],
        ),
        fresh(
            18,
            chapter_18_error_and_time::check::exercise,
            &[
                ("the variance is the mean of squares less the square of the m", c18_a::variance_and_bias_squared),
                ("bias² is the square of the mean's distance from the truth, o", c18_sa::variance_and_bias_squared),
            ],
            &[c18_r::variance_and_bias_squared],
        ),
        fresh(19, chapter_19_mirrors::check::exercise, &[], &[c19_r::mirrored]),
        fresh(20, chapter_20_glass::check::exercise, &[("η is inverted", c20_sa::refracted)], &[]),
        fresh(21, chapter_21_soft_shadows::check::exercise, &[], &[c21_r::solid_angle_pdf]),
        fresh(22, chapter_22_ambient_occlusion::check::exercise, &[], &[c22_r::cosine_direction]),
        fresh(23, chapter_23_depth_of_field::check::exercise, &[], &[c23_r::lens_direction]),
        fresh(
            24,
            chapter_24_motion_blur::check::exercise,
            &[("the sphere counts wherever it has been until then", c24_b::moving_sphere_t)],
            &[],
        ),
        fresh(
            25,
            chapter_25_path_tracing::check::exercise,
            &[("the probability is the mean of the three", c25_sb::after_roulette)],
            &[c25_r::after_roulette],
        ),
        fresh(
            26,
            chapter_26_choosing_samples::check::exercise,
            &[
                ("the larger pdf has all the weight", c26_b::power_heuristic),
                ("squares overflow to infinity or vanish to 0, and their quoti", c26_sa::power_heuristic),
            ],
            &[c26_r::power_heuristic],
        ),
        fresh(
            27,
            chapter_27_caustics::check::exercise,
            &[("cos⁴ is taken", c27_b::pixel_fraction)],
            &[c27_r::pixel_fraction],
        ),
        fresh(
            30,
            chapter_30_tree::check::exercise,
            &[
                ("None stands before a child", c30_a::to_visit),
                ("`closest` is compared with the farther child alone", c30_b::to_visit),
            ],
            &[c30_r::to_visit],
        ),
        fresh(31, chapter_31_wide_tree::check::exercise, &[], &[c31_r::entered]),
        fresh(
            32,
            chapter_32_projection::check::exercise,
            &[("it is divided by the distance from the eye", c32_a::raster_from_world)],
            &[],
        ),
        fresh(
            33,
            chapter_33_rasterisation::check::exercise,
            &[("the rule is turned round, to bottom and right edges", c33_b::is_inside_edge)],
            &[c33_r::is_inside_edge],
        ),
        fresh(
            34,
            chapter_34_both::check::exercise,
            &[
                ("this is the interval of a box around the sphere, taken at it", c34_a::sphere_interval),
                ("the two crossings are sorted", c34_b::sphere_interval),
            ],
            &[],
        ),
        fresh(
            36,
            chapter_36_film::check::exercise,
            &[
                ("that is the one cubic through all four keys", c36_a::value_between),
                ("the slope at a key is the mean of the slopes of the two line", c36_b::value_between),
                ("the keys are taken to be equally far apart", c36_sc::value_between),
            ],
            &[c36_r::value_between],
        ),
        fresh(
            37,
            chapter_37_rows::check::exercise,
            &[
                ("a parabola with the usual correction is near the circle, but", c37_a::circle),
                ("straight lines between eight places of the circle are off by", c37_sc::circle),
            ],
            &[c37_r::circle],
        ),
    ]
}
/// Cuts the index to 32 bits first, so the pixels of an image of more than 2^32 begin anew.
mod c01_b {
    pub fn raster_from_index(index: u64, width: u32) -> [f64; 2] {
        let small = index as u32;
        let width = width.max(1);
        [f64::from(small % width) + 0.5, f64::from(small / width) + 0.5]
    }
}

/// The row by a floating-point division and floor, the column by what is left.
mod c01_r {
    pub fn raster_from_index(index: u64, width: u32) -> [f64; 2] {
        let (i, w) = (index as f64, width as f64);
        let row = (i / w).floor();
        [i - row * w + 0.5, row + 0.5]
    }
}

/// Squares and adds as in every book, so long vectors overflow and short ones become nothing.
mod c02_a {
    pub fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
        let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
        if length > 0.0 && length.is_finite() { Some(v.map(|c| c / length)) } else { None }
    }
}

/// Treats all vectors shorter than a small epsilon as if they pointed nowhere.
mod c02_b {
    pub fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
        if v.iter().any(|c| !c.is_finite()) {
            return None;
        }
        let most = v.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
        if most < 1e-12 {
            return None;
        }
        let w = v.map(|c| c / most);
        let length = (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]).sqrt();
        Some(w.map(|c| c / length))
    }
}

/// Scales vectors of tiny and of huge parts by powers of two first, so that nothing is rounded, then squares and adds.
mod c02_r {
    pub fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
        let [x, y, z] = v;
        if !(x.is_finite() && y.is_finite() && z.is_finite()) || (x == 0.0 && y == 0.0 && z == 0.0) {
            return None;
        }
        // Powers of two, so that nothing is rounded.
        let biggest = x.abs().max(y.abs()).max(z.abs());
        let k = if biggest < 1e-100 {
            2_f64.powi(900)
        } else if biggest > 1e100 {
            2_f64.powi(-900)
        } else {
            1.0
        };
        let k2 = if biggest < 1e-290 { 2_f64.powi(100) } else { 1.0 };
        let (x, y, z) = (x * k * k2, y * k * k2, z * k * k2);
        let length = (x * x + y * y + z * z).sqrt();
        Some([x / length, y / length, z / length])
    }
}

/// Uses the geometric solution for directions of length 1 and never divides by the length.
mod c03_a {
    pub fn nearest_sphere_t(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
        let l: Vec<f64> = (0..3).map(|i| centre[i] - origin[i]).collect();
        let tca: f64 = (0..3).map(|i| l[i] * direction[i]).sum();
        let miss: Vec<f64> = (0..3).map(|i| l[i] - tca * direction[i]).collect();
        let d2: f64 = miss.iter().map(|m| m * m).sum();
        if d2 > radius * radius {
            return None;
        }
        let thc = (radius * radius - d2).sqrt();
        if tca - thc > 0.0 {
            Some(tca - thc)
        } else if tca + thc > 0.0 {
            Some(tca + thc)
        } else {
            None
        }
    }
}

/// Counts a ray that begins inside as no hit, because only front faces are seen.
mod c03_b {
    pub fn nearest_sphere_t(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let l = [origin[0] - centre[0], origin[1] - centre[1], origin[2] - centre[2]];
        let a = dot(direction, direction);
        let m = -dot(l, direction) / a;
        let p = [l[0] + m * direction[0], l[1] + m * direction[1], l[2] + m * direction[2]];
        let rest = (radius - dot(p, p).sqrt()) * (radius + dot(p, p).sqrt());
        if rest < 0.0 {
            return None;
        }
        let near = m - (rest / a).sqrt();
        (near > 0.0).then_some(near)
    }
}

/// Takes only hits at t above 1e-3, as a renderer does against self-shadowing.
mod c03_sb {
    pub fn nearest_sphere_t(origin: [f64; 3], direction: [f64; 3], centre: [f64; 3], radius: f64) -> Option<f64> {
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let l = [origin[0] - centre[0], origin[1] - centre[1], origin[2] - centre[2]];
        let a = dot(direction, direction);
        let m = -dot(l, direction) / a;
        let p = [l[0] + m * direction[0], l[1] + m * direction[1], l[2] + m * direction[2]];
        let rest = (radius - dot(p, p).sqrt()) * (radius + dot(p, p).sqrt());
        if rest < 0.0 {
            return None;
        }
        let half = (rest / a).sqrt();
        let (t_min, t_max) = (0.001, f64::INFINITY);
        [m - half, m + half].into_iter().find(|&t| t > t_min && t < t_max)
    }
}

/// The plane at the distance at which it is 2 high, from −1 to 1.
mod c05_r {
    pub fn perspective_direction(screen: [f64; 2], tan_half_vertical: f64) -> [f64; 3] {
        let far = tan_half_vertical.recip();
        let [x, y] = screen;
        let length = far.hypot(x.hypot(y));
        [x / length, y / length, -far / length]
    }
}

/// Lets 0 to 1 span from the first pixel's centre to the last one's, and takes the nearest pixel.
mod c06_a {
    pub fn pixel_from_ndc(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
        let inside = |c: f64| (0.0..1.0).contains(&c);
        if !inside(ndc[0]) || !inside(ndc[1]) {
            return None;
        }
        let place = |c: f64, n: u32| (c * (n - 1) as f64).round() as u32;
        Some([place(ndc[0], width), place(ndc[1], height)])
    }
}

/// Puts 1 into the last pixel by clamping, and everything outside into the pixels of the border.
mod c06_sa {
    pub fn pixel_from_ndc(ndc: [f64; 2], width: u32, height: u32) -> Option<[u32; 2]> {
        if ndc[0].is_nan() || ndc[1].is_nan() {
            return None;
        }
        let x = (ndc[0] * width as f64).floor().clamp(0.0, width as f64 - 1.0);
        let y = (ndc[1] * height as f64).floor().clamp(0.0, height as f64 - 1.0);
        Some([x as u32, y as u32])
    }
}

/// Takes the screen to be 2 wide and 2 / aspect high: the width is the measure.
mod c07_a {
    pub fn ndc_from_screen(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
        let aspect = width as f64 / height as f64;
        [(screen[0] + 1.0) / 2.0, (1.0 - screen[1] * aspect) / 2.0]
    }
}

/// The aspect is rounded to a whole number by dividing the two integers.
mod c07_b {
    pub fn ndc_from_screen(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
        let aspect = f64::from((width / height.max(1)).max(1));
        [(screen[0] / aspect + 1.0) * 0.5, (1.0 - screen[1]) * 0.5]
    }
}

/// By way of pixels: half a height is a unit, measured from the image's middle.
mod c07_r {
    pub fn ndc_from_screen(screen: [f64; 2], width: u32, height: u32) -> [f64; 2] {
        let (w, h) = (f64::from(width), f64::from(height));
        [0.5 + 0.5 * (screen[0] * h) / w, 0.5 - screen[1] / 2.0]
    }
}

/// Carries two tangents over, takes their cross product, and turns it to the side on which the carried normal lies.
mod c09_r {
    pub fn normal_world_from_object(columns: [[f64; 3]; 3], normal: [f64; 3]) -> [f64; 3] {
        fn cross(u: [f64; 3], v: [f64; 3]) -> [f64; 3] {
            [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        }
        let carry = |v: [f64; 3]| -> [f64; 3] {
            std::array::from_fn(|i| columns[0][i] * v[0] + columns[1][i] * v[1] + columns[2][i] * v[2])
        };
        let helper = if normal[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let tangent = cross(normal, helper);
        let other = cross(normal, tangent);
        let n = cross(carry(tangent), carry(other));
        let side: f64 = n.iter().zip(carry(normal)).map(|(a, b)| a * b).sum();
        let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
        let k = if side < 0.0 { -1.0 / length } else { 1.0 / length };
        n.map(|x| x * k)
    }
}

/// Falls off as games do, with 1 / (1 + d²), so that nothing is infinite near the lamp.
mod c10_b {
    pub fn reflected_radiance(
        colour: f64,
        intensity: f64,
        position: [f64; 3],
        normal: [f64; 3],
        light: [f64; 3],
    ) -> f64 {
        let l: [f64; 3] = std::array::from_fn(|i| light[i] - position[i]);
        let d = l.iter().map(|x| x * x).sum::<f64>().sqrt();
        if d == 0.0 {
            return 0.0;
        }
        let cosine = l.iter().zip(normal).map(|(a, b)| a * b).sum::<f64>() / d;
        colour * intensity * cosine.max(0.0) / std::f64::consts::PI / (1.0 + d * d)
    }
}

/// With y down takes the second number for depth and the third for height, as in programs whose z is up.
mod c11_b {
    pub fn pinhole_from_theirs(direction: [f64; 3], x_right: bool, y_up: bool, z_ahead: bool) -> [f64; 3] {
        let [x, y, z] = direction;
        let x = if x_right { x } else { -x };
        let (y, z) = if y_up { (y, z) } else { (z, -y) };
        [x, y, if z_ahead { -z } else { z }]
    }
}

/// Turns the interpolated normal itself to the eye, instead of to the side of the triangle that the eye is on, and never asks the triangle.
mod c14_a {
    pub fn falling_cosine(
        geometric: [f64; 3],
        normals: [[f64; 3]; 3],
        weights: [f64; 3],
        to_eye: [f64; 3],
        to_light: [f64; 3],
    ) -> f64 {
        let _ = geometric;
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let mut n = [0.0; 3];
        for k in 0..3 {
            for i in 0..3 {
                n[i] += weights[k] * normals[k][i];
            }
        }
        let length = dot(n, n).sqrt();
        let side = if dot(n, to_eye) < 0.0 { -1.0 } else { 1.0 };
        (side * dot(n, to_light) / length / dot(to_light, to_light).sqrt()).max(0.0)
    }
}

/// Turns each corner's normal to the eye's side first, and divides by both lengths at the end.
mod c14_r {
    pub fn falling_cosine(
        geometric: [f64; 3],
        normals: [[f64; 3]; 3],
        weights: [f64; 3],
        to_eye: [f64; 3],
        to_light: [f64; 3],
    ) -> f64 {
        fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
            a.iter().zip(b).map(|(x, y)| x * y).sum()
        }
        let seen = dot(&geometric, &to_eye) > 0.0;
        let above = dot(&geometric, &to_light) > 0.0;
        if seen != above || dot(&geometric, &to_light) == 0.0 {
            return 0.0;
        }
        let along = (dot(&normals[0], &geometric) > 0.0) == seen;
        let turn = if along { 1.0 } else { -1.0 };
        let n: [f64; 3] = std::array::from_fn(|i| {
            turn * (normals[0][i] * weights[0] + normals[1][i] * weights[1] + normals[2][i] * weights[2])
        });
        let cosine = dot(&n, &to_light) / (dot(&n, &n) * dot(&to_light, &to_light)).sqrt();
        if cosine > 0.0 { cosine } else { 0.0 }
    }
}

/// The factor (n + 1) / 2π, which normalises the lobe itself instead of the lobe times the cosine.
mod c15_b {
    pub fn phong_radiance(
        [colour, specular, exponent]: [f64; 3],
        irradiance: f64,
        normal: [f64; 3],
        to_light: [f64; 3],
        to_eye: [f64; 3],
    ) -> f64 {
        use std::f64::consts::{FRAC_1_PI, TAU};
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let cosine = dot(normal, to_light).max(0.0);
        let alpha = 2.0 * cosine * dot(normal, to_eye) - dot(to_light, to_eye);
        let lobe = if alpha > 0.0 { alpha.powf(exponent) } else { 0.0 };
        irradiance * cosine * (colour * FRAC_1_PI + specular * (exponent + 1.0) / TAU * lobe)
    }
}

/// The highlight is added without the cosine at which the light falls, as in Phong's own paper.
mod c15_sb {
    pub fn phong_radiance(
        [colour, specular, exponent]: [f64; 3],
        irradiance: f64,
        normal: [f64; 3],
        to_light: [f64; 3],
        to_eye: [f64; 3],
    ) -> f64 {
        use std::f64::consts::PI;
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let cosine = dot(normal, to_light);
        if cosine <= 0.0 {
            return 0.0;
        }
        let mirror: [f64; 3] = std::array::from_fn(|i| 2.0 * cosine * normal[i] - to_light[i]);
        let alpha = dot(mirror, to_eye).max(0.0);
        let lobe = if alpha > 0.0 { alpha.powf(exponent) } else { 0.0 };
        irradiance * (colour / PI * cosine + specular * (exponent + 2.0) / (2.0 * PI) * lobe)
    }
}

/// Measures how much of the range lies on even stripes: the whole pairs first, then the two ends.
mod c16_r {
    pub fn mean_of_stripes(x: f64, width: f64) -> f64 {
        if width <= 0.0 {
            let n = x.floor();
            return 1.0 - 2.0 * (n - 2.0 * (n / 2.0).floor());
        }
        // How much of the line up to a place, counted from 0, is on even stripes.
        let even_until = |at: f64| {
            let pairs = (at / 2.0).floor();
            pairs + (at - 2.0 * pairs).min(1.0)
        };
        // For accuracy, move the range near 0 by whole pairs.
        let shift = 2.0 * (x / 2.0).floor();
        let (left, right) = (x - shift - width / 2.0, x - shift + width / 2.0);
        2.0 * (even_until(right) - even_until(left)) / width - 1.0
    }
}

/// Puts the roots the wrong way round, so places are most frequent at the edges.
mod c17_a {
    pub fn tent_offset(u: f64, radius: f64) -> f64 {
        let v = 2.0 * u - 1.0;
        v.signum() * v.abs().sqrt() * radius
    }
}

/// Uses the two-number trick with one number: u and its next digits as two uniform numbers.
mod c17_b {
    pub fn tent_offset(u: f64, radius: f64) -> f64 {
        let first = (u * 1024.0).floor() / 1024.0;
        let second = (u * 1024.0).fract();
        radius * (first + second - 1.0)
    }
}

/// The variance as the mean square minus the squared mean, in one pass, which cancels where runs lie close together.
mod c18_a {
    pub fn variance_and_bias_squared(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
        let n = runs.len() as f64;
        if n < 2.0 {
            return None;
        }
        let (mut sum, mut squares) = (0.0, 0.0);
        for x in runs {
            sum += x;
            squares += x * x;
        }
        let variance = (squares / n - (sum / n) * (sum / n)) * n / (n - 1.0);
        let (mut off, mut own) = (0.0, 0.0);
        for x in runs {
            off += x - truth;
            own += (x - truth) * (x - truth);
        }
        Some([variance, (off * off - own) / (n * (n - 1.0))])
    }
}

/// bias² as the squared distance of the mean less its own expected error, the variance over n.
mod c18_r {
    pub fn variance_and_bias_squared(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
        let [first, _, ..] = runs else { return None };
        // Welford's running mean, from the first run as zero.
        let (mut count, mut mean, mut scatter) = (0.0, 0.0, 0.0);
        for run in runs {
            let x = run - first;
            count += 1.0;
            let away = x - mean;
            mean += away / count;
            scatter += away * (x - mean);
        }
        let variance = scatter / (count - 1.0);
        let off = (first - truth) + mean;
        Some([variance, off * off - variance / count])
    }
}

/// bias² is the square of the mean's distance from the truth, which the variance makes too large.
mod c18_sa {
    pub fn variance_and_bias_squared(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
        if runs.len() < 2 {
            return None;
        }
        let n = runs.len() as f64;
        let mean = runs.iter().sum::<f64>() / n;
        let variance = runs.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
        Some([variance, (mean - truth) * (mean - truth)])
    }
}

/// Splits the direction in a part along the normal and one across it, and turns the first round.
mod c19_r {
    pub fn mirrored(direction: [f64; 3], normal: [f64; 3]) -> [f64; 3] {
        let length = normal[0].hypot(normal[1]).hypot(normal[2]);
        let n = normal.map(|c| c / length);
        let height = n[0] * direction[0] + n[1] * direction[1] + n[2] * direction[2];
        let upright = n.map(|c| c * height);
        let mut out = [0.0; 3];
        for axis in 0..3 {
            let level = direction[axis] - upright[axis];
            out[axis] = level - upright[axis];
        }
        out
    }
}

/// GLSL's refract, whose eta is the near index over the far one.
mod c20_sa {
    pub fn refracted(direction: [f64; 3], normal: [f64; 3], eta: f64) -> Option<[f64; 3]> {
        let d = direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2];
        let k = 1.0 - eta * eta * (1.0 - d * d);
        if k < 0.0 {
            return None;
        }
        Some(std::array::from_fn(|i| eta * direction[i] - (eta * d + k.sqrt()) * normal[i]))
    }
}

/// The cubed distance over the area and the unnormalised product with the normal.
mod c21_r {
    pub fn solid_angle_pdf(from: [f64; 3], at: [f64; 3], normal: [f64; 3], area: f64) -> f64 {
        let (x, y, z) = (from[0] - at[0], from[1] - at[1], from[2] - at[2]);
        let height = (x * normal[0] + y * normal[1] + z * normal[2]).abs();
        if height == 0.0 {
            return 0.0;
        }
        (x * x + y * y + z * z).powf(1.5) / (height * area)
    }
}

/// By the angle: twice the polar angle has the cosine 1 − 2u.
mod c22_r {
    pub fn cosine_direction(u: f64, v: f64) -> [f64; 3] {
        let theta = 0.5 * (1.0 - 2.0 * u).acos();
        let phi = 2.0 * std::f64::consts::PI * v;
        [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()]
    }
}

/// The place at distance 1 less the lens point over the focus distance: similar triangles.
mod c23_r {
    pub fn lens_direction(screen: [f64; 2], tan_half_vertical: f64, lens: [f64; 2], focus_distance: f64) -> [f64; 3] {
        let slope = |i: usize| tan_half_vertical * screen[i] - lens[i] / focus_distance;
        let (a, b) = (slope(0), slope(1));
        let back = -(1.0 + a * a + b * b).sqrt().recip();
        [-a * back, -b * back, back]
    }
}

/// Takes what the sphere sweeps over until the ray leaves: the first hit at any of many moments.
mod c24_b {
    pub fn moving_sphere_t(
        origin: [f64; 3],
        direction: [f64; 3],
        centre: [f64; 3],
        radius: f64,
        velocity: [f64; 3],
        time: f64,
    ) -> Option<f64> {
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let mut first: Option<f64> = None;
        for step in 0..=16 {
            let now = time * f64::from(step) / 16.0;
            let o: [f64; 3] = std::array::from_fn(|i| origin[i] - (centre[i] + velocity[i] * now));
            let b = dot(o, direction);
            let disc = b * b - (dot(o, o) - radius * radius);
            let t = -b - disc.sqrt();
            if t > 0.0 && first.is_none_or(|f| t < f) {
                first = Some(t);
            }
        }
        first
    }
}

/// Multiplies by one over the probability where the path carries little, and leaves the others as they are.
mod c25_r {
    pub fn after_roulette(throughput: [f64; 3], u: f64) -> [f64; 3] {
        let [r, g, b] = throughput;
        let most = if r > g && r > b {
            r
        } else if g > b {
            g
        } else {
            b
        };
        if most >= 1.0 {
            return throughput;
        }
        match u >= most {
            true => [0.0, 0.0, 0.0],
            false => [r / most, g / most, b / most],
        }
    }
}

/// The mean of the three colours is the probability.
mod c25_sb {
    pub fn after_roulette(throughput: [f64; 3], u: f64) -> [f64; 3] {
        let p = ((throughput[0] + throughput[1] + throughput[2]) / 3.0).min(1.0);
        if u < p { throughput.map(|c| c / p) } else { [0.0; 3] }
    }
}

/// The maximum heuristic: all the weight to the technique whose pdf is larger.
mod c26_b {
    pub fn power_heuristic(own: f64, other: f64) -> f64 {
        if own > other {
            1.0
        } else if own == other && own > 0.0 {
            0.5
        } else {
            0.0
        }
    }
}

/// Divides both by the larger of the two first.
mod c26_r {
    pub fn power_heuristic(own: f64, other: f64) -> f64 {
        if !(own > 0.0) {
            return 0.0;
        }
        let larger = if own < other { other } else { own };
        let (p, q) = (own / larger, other / larger);
        p * p / (p * p + q * q)
    }
}

/// Squares and adds as written, which overflows at 1e200 and vanishes at 1e-200.
mod c26_sa {
    pub fn power_heuristic(own: f64, other: f64) -> f64 {
        let (a, b) = (own * own, other * other);
        if a + b == 0.0 { 0.0 } else { a / (a + b) }
    }
}

/// The fourth power of the cosine, as a photograph's corners darken.
mod c27_b {
    pub fn pixel_fraction(point: [f64; 3], tan_half: f64, height: f64) -> f64 {
        let d2: f64 = point.iter().map(|c| c * c).sum();
        let cosine = -point[2] / d2.sqrt();
        if !(cosine > 0.0) {
            return 0.0;
        }
        let side = 2.0 * tan_half / height;
        1.0 / (side * side * d2 * cosine.powi(4))
    }
}

/// d² cos³ θ is the cubed depth over the distance.
mod c27_r {
    pub fn pixel_fraction(point: [f64; 3], tan_half: f64, height: f64) -> f64 {
        let depth = -point[2];
        if depth <= 0.0 {
            return 0.0;
        }
        let far = point[0].hypot(point[1]).hypot(depth);
        let pixels = height / (2.0 * tan_half);
        pixels * pixels * far / depth.powi(3)
    }
}

/// Sorts but does not close the gap: a child that is alone and missed leaves its place empty.
mod c30_a {
    pub fn to_visit(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
        let open = |i: usize| enters[i].filter(|&t| t < closest);
        let (one, two) = (open(0), open(1));
        let name = |t: Option<f64>, n: u32| t.map(|_| n);
        match (one, two) {
            (Some(a), Some(b)) if b < a => [Some(1), Some(0)],
            _ => [name(one, 0), name(two, 1)],
        }
    }
}

/// Compares with the closest hit only for the second child; the first is always visited.
mod c30_b {
    pub fn to_visit(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
        let (a, b) = (enters[0].unwrap_or(f64::INFINITY), enters[1].unwrap_or(f64::INFINITY));
        let ((near, first), (far, second)) = if b < a { ((b, 1), (a, 0)) } else { ((a, 0), (b, 1)) };
        [(near < f64::INFINITY).then_some(first), (far < closest).then_some(second)]
    }
}

/// Collects those that may hold something, sorts them stably by t, and fills up with none.
mod c30_r {
    pub fn to_visit(enters: [Option<f64>; 2], closest: f64) -> [Option<u32>; 2] {
        let mut open: Vec<(f64, u32)> = Vec::new();
        for n in [0_u32, 1] {
            match enters[n as usize] {
                Some(t) if t < closest => open.push((t, n)),
                _ => {}
            }
        }
        open.sort_by(|a, b| a.0.partial_cmp(&b.0).unwrap_or(std::cmp::Ordering::Equal));
        let mut order = open.into_iter().map(|(_, n)| n);
        [order.next(), order.next()]
    }
}

/// Cuts each interval to that of the ray and keeps those that are not empty.
mod c31_r {
    pub fn entered(enters: [f64; 8], leaves: [f64; 8], closest: f64) -> u32 {
        let mut bits = 0;
        let mut bit = 1;
        for i in 0..8 {
            let begin = if enters[i] > 0.0 { enters[i] } else { 0.0 };
            let end = if leaves[i] < closest { leaves[i] } else { closest };
            if enters[i] <= leaves[i] && begin <= end {
                bits += bit;
            }
            bit *= 2;
        }
        bits
    }
}

/// Divides by the distance from the eye instead of by the depth along the view.
mod c32_a {
    pub fn raster_from_world(
        point: [f64; 3],
        eye: [f64; 3],
        axes: [[f64; 3]; 3],
        tan_half: f64,
        size: [u32; 2],
    ) -> [f64; 2] {
        let v: [f64; 3] = std::array::from_fn(|i| point[i] - eye[i]);
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let depth = dot(v, v).sqrt();
        let (w, h) = (f64::from(size[0]), f64::from(size[1]));
        let k = h / (2.0 * tan_half * depth);
        [w / 2.0 + k * dot(v, axes[0]), h / 2.0 - k * dot(v, axes[1])]
    }
}

/// Keeps samples on right and lower edges instead of left and upper ones.
mod c33_b {
    pub fn is_inside_edge(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
        let (dx, dy) = (i64::from(to[0] - from[0]), i64::from(to[1] - from[1]));
        let side = dx * i64::from(sample[1] - from[1]) - dy * i64::from(sample[0] - from[0]);
        let keep = dy > 0 || dy == 0 && dx < 0;
        if keep { side >= 0 } else { side > 0 }
    }
}

/// As a determinant of the three points, with a bias of one for edges that do not own their samples.
mod c33_r {
    pub fn is_inside_edge(from: [i32; 2], to: [i32; 2], sample: [i32; 2]) -> bool {
        let [[x0, y0], [x1, y1], [x2, y2]] = [from, to, sample].map(|p| p.map(i128::from));
        let twice_area = x0 * (y1 - y2) + x1 * (y2 - y0) + x2 * (y0 - y1);
        let owned = (y1, x0) < (y0, x1) && y1 != y0 || (y1 == y0 && x0 < x1);
        twice_area >= if owned { 0 } else { 1 }
    }
}

/// The box around the sphere, seen at its near face: safe, but too wide.
mod c34_a {
    pub fn sphere_interval(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
        let cut = |x: f64| x.max(-half).min(half);
        let near = ahead - radius;
        if near <= 0.0 {
            return [-half, half];
        }
        let far = ahead + radius;
        let (l, r) = (right - radius, right + radius);
        [cut((l / near).min(l / far)), cut((r / near).max(r / far))]
    }
}

/// Solves the quadratic for the two tangents and sorts them, though beside the eye one of them belongs behind it.
mod c34_b {
    pub fn sphere_interval(right: f64, ahead: f64, radius: f64, half: f64) -> [f64; 2] {
        let cut = |x: f64| x.max(-half).min(half);
        if right * right + ahead * ahead <= radius * radius {
            return [-half, half];
        }
        // (a² − r²) x² − 2 a b x + b² − r² = 0
        let a = ahead * ahead - radius * radius;
        let root = radius * (right * right + ahead * ahead - radius * radius).sqrt();
        let (one, two) = ((ahead * right - root) / a, (ahead * right + root) / a);
        if one.is_nan() || two.is_nan() {
            return [-half, half];
        }
        [cut(one.min(two)), cut(one.max(two))]
    }
}

/// The one cubic through all four keys (Lagrange).
mod c36_a {
    pub fn value_between(times: [f64; 4], values: [f64; 4], time: f64) -> f64 {
        let mut sum = 0.0;
        for i in 0..4 {
            let mut part = values[i];
            for j in 0..4 {
                if j != i {
                    part *= (time - times[j]) / (times[i] - times[j]);
                }
            }
            sum += part;
        }
        sum
    }
}

/// The slope at a key is the mean of those of the two lines that meet there.
mod c36_b {
    pub fn value_between(times: [f64; 4], values: [f64; 4], time: f64) -> f64 {
        let line = |i: usize| (values[i + 1] - values[i]) / (times[i + 1] - times[i]);
        let (m1, m2) = ((line(0) + line(1)) / 2.0, (line(1) + line(2)) / 2.0);
        let h = times[2] - times[1];
        let u = (time - times[1]) / h;
        let (u2, u3) = (u * u, u * u * u);
        (2.0 * u3 - 3.0 * u2 + 1.0) * values[1]
            + (u3 - 2.0 * u2 + u) * h * m1
            + (3.0 * u2 - 2.0 * u3) * values[2]
            + (u3 - u2) * h * m2
    }
}

/// As a Bézier curve with two control values a third of the way along the slopes, by de Casteljau.
mod c36_r {
    pub fn value_between(times: [f64; 4], values: [f64; 4], time: f64) -> f64 {
        let third = (times[2] - times[1]) / 3.0;
        let slope = |i: usize| (values[i + 1] - values[i - 1]) / (times[i + 1] - times[i - 1]);
        let mut points = vec![values[1], values[1] + third * slope(1), values[2] - third * slope(2), values[2]];
        let u = (time - times[1]) / (times[2] - times[1]);
        while points.len() > 1 {
            points = points.windows(2).map(|two| two[0] * (1.0 - u) + two[1] * u).collect();
        }
        points[0]
    }
}

/// The Catmull–Rom polynomial for keys at equal distances, at whatever distances they are.
mod c36_sc {
    pub fn value_between(times: [f64; 4], values: [f64; 4], time: f64) -> f64 {
        let [a, b, c, d] = values;
        let u = (time - times[1]) / (times[2] - times[1]);
        0.5 * (2.0 * b + u * (c - a + u * (2.0 * a - 5.0 * b + 4.0 * c - d + u * (3.0 * (b - c) + d - a))))
    }
}

/// The well-known parabola with its correction, which is off by a thousandth.
mod c37_a {
    pub fn circle(turn: f64) -> [f64; 2] {
        // sin(2π t) for t from −1/2 to 1/2.
        let sine = |t: f64| {
            let t = t - t.round();
            let y = 8.0 * t - 16.0 * t * t.abs();
            0.775 * y + 0.225 * y * y.abs()
        };
        [sine(turn + 0.25), sine(turn)]
    }
}

/// A small angle of a 64th of the turn by series, doubled six times.
mod c37_r {
    pub fn circle(turn: f64) -> [f64; 2] {
        let a = (turn - turn.round()) * std::f64::consts::TAU * (1.0 / 64.0);
        let q = a * a;
        // 1 − cos and sin of the 64th part.
        let mut versed = q * (1.0 / 2.0 - q * (1.0 / 24.0 - q * (1.0 / 720.0)));
        let mut sine = a * (1.0 - q * (1.0 / 6.0 - q * (1.0 / 120.0 - q * (1.0 / 5040.0))));
        for _ in 0..6 {
            let cosine = 1.0 - versed;
            versed = 2.0 * sine * sine;
            sine = 2.0 * sine * cosine;
        }
        [1.0 - versed, sine]
    }
}

/// Walks around the eight corners of an octagon and interpolates in straight lines between them.
mod c37_sc {
    pub fn circle(turn: f64) -> [f64; 2] {
        const R: f64 = std::f64::consts::FRAC_1_SQRT_2;
        const CORNERS: [[f64; 2]; 9] =
            [[1.0, 0.0], [R, R], [0.0, 1.0], [-R, R], [-1.0, 0.0], [-R, -R], [0.0, -1.0], [R, -R], [1.0, 0.0]];
        let place = (turn - turn.floor()) * 8.0;
        let at = (place.floor() as usize).min(7);
        let u = place - at as f64;
        [0, 1].map(|i| CORNERS[at][i] * (1.0 - u) + CORNERS[at + 1][i] * u)
    }
}
