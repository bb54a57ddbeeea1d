//! Textures as first ray tracers have them.

use glam::{DVec2, Vec3};
use pinhole::extract::Texels;

// ANCHOR: naive_checker
/// A checker's colour at the one point that the ray hit, in f32: 1 for the first, 0 for the second.
///
/// Where a pixel covers many cells, the one cell stands for all of them; and on a plane through cell borders rounding
/// decides between two layers.
#[must_use]
pub fn naive_checker(point: Vec3) -> f32 {
    let cells = point.floor();
    if (cells.x + cells.y + cells.z) as i32 % 2 == 0 { 1.0 } else { 0.0 }
}
// ANCHOR_END: naive_checker

/// The mean of a wave that is 1 over even cells and −1 over odd ones, from areas in f32.
///
/// Far from the origin the two areas are of numbers that f32 no longer tells apart.
#[must_use]
pub fn wave_mean_f32(x: f32, width: f32) -> f32 {
    let area = |x: f32| 1.0 - (x.rem_euclid(2.0) - 1.0).abs();
    (area(x + 0.5 * width) - area(x - 0.5 * width)) / width
}

/// What a pixel covers of a plane, as the offset from its own hit to its neighbour's, in f32; none where the neighbour's ray
/// passes above the horizon.
#[must_use]
pub fn step_to_neighbour(direction: Vec3, neighbour: Vec3, normal: Vec3, offset: f32) -> Option<Vec3> {
    let t = |direction: Vec3| Some(offset / normal.dot(direction)).filter(|&t| t > 0.0 && t < f32::INFINITY);
    Some(neighbour * t(neighbour)? - direction * t(direction)?)
}

/// The angle from the top over π as an arc cosine of y, as most formulas for environments have it.
#[must_use]
pub fn from_top_by_cosine(y: f64) -> f64 {
    libm::acos(y) / std::f64::consts::PI
}

/// The four texels around a point blended, none beyond the edges: at the seam of an environment the image ends.
#[must_use]
pub fn bilinear_to_the_edge(image: &Texels, at: DVec2) -> [f64; 3] {
    let point = at * DVec2::new(image.width as f64, image.height as f64) - 0.5;
    let texel = |x: f64, y: f64| {
        let x = x.clamp(0.0, image.width as f64 - 1.0) as usize;
        let y = y.clamp(0.0, image.height as f64 - 1.0) as usize;
        image.rgb[y * image.width + x].map(f64::from)
    };
    let (corner, fraction) = (point.floor(), point - point.floor());
    let blend =
        |a: [f64; 3], b: [f64; 3], fraction: f64| [0, 1, 2].map(|part| a[part] * (1.0 - fraction) + b[part] * fraction);
    let row = |y: f64| blend(texel(corner.x, y), texel(corner.x + 1.0, y), fraction.x);
    blend(row(corner.y), row(corner.y + 1.0), fraction.y)
}

/// The image at half the size, each texel the mean of four; the last row or column of an odd side falls away.
#[must_use]
pub fn halved_by_fours(image: &Texels) -> Texels {
    let (width, height) = ((image.width / 2).max(1), (image.height / 2).max(1));
    let texel = |x: usize, y: usize| image.rgb[y.min(image.height - 1) * image.width + x.min(image.width - 1)];
    let four = |x: usize, y: usize| {
        let [a, b, c, d] = [texel(x, y), texel(x + 1, y), texel(x, y + 1), texel(x + 1, y + 1)];
        [0, 1, 2].map(|part| (a[part] + b[part] + c[part] + d[part]) / 4.0)
    };
    let rgb = (0..width * height).map(|at| four(at % width * 2, at / width * 2)).collect();
    Texels { width, height, rgb }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_do_what_they_say_where_it_is_easy() {
        assert_eq!([naive_checker(Vec3::splat(0.5)), naive_checker(Vec3::new(1.5, 0.5, 0.5))], [1.0, 0.0]);
        assert_eq!(wave_mean_f32(1.25, 1.0), -0.5);
        let (down, steeper) = (Vec3::new(0.0, -1.0, -1.0), Vec3::new(0.0, -1.0, -0.5));
        assert_eq!(step_to_neighbour(down, steeper, Vec3::Y, -1.0), Some(Vec3::new(0.0, 0.0, 0.5)));
        assert_eq!(step_to_neighbour(down, Vec3::Y, Vec3::Y, -1.0), None);
        assert_eq!(from_top_by_cosine(0.0), 0.5);
        let image = Texels { width: 2, height: 2, rgb: vec![[0.0; 3], [1.0; 3], [1.0; 3], [0.0; 3]] };
        assert_eq!(bilinear_to_the_edge(&image, DVec2::splat(0.5)), [0.5; 3]);
        assert_eq!(halved_by_fours(&image).rgb, [[0.5; 3]]);
    }
}
