//! Texels that are out of their range → the nearest in it, counted.

use super::Texels;

/// The range of values that an image may hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    /// Reflectances, from 0 to 1: a surface gives back no more than it gets.
    Reflectances,
    /// Radiance, or a factor of it: finite, at least 0.
    Radiance,
    /// Normals: from 0 to 1, blue more than a half, for a normal points out of the surface.
    Normals,
    /// Numbers that are no light, such as roughness: from 0 to 1.
    Factors,
    /// Alphas, from 0 to 1.
    Alphas,
}

/// Blue of a normal that points out of the surface at the lowest angle.
const LOWEST_BLUE: f32 = 0.5 + 1.0 / 256.0;
/// How much the parts of a texel of a grey image may differ, where it was compressed.
const GREY: f32 = 2.5 / 255.0;
/// How high white is above black in a map of heights, in widths of the image.
const HEIGHT: f32 = 0.02;

impl Numbers {
    /// Whether they are taken as they are in the file, without the sRGB curve.
    pub fn are_no_light(self) -> bool {
        matches!(self, Self::Normals | Self::Factors | Self::Alphas)
    }

    /// Replaces what is out of range by what is nearest in it; says how many texels that were, if any.
    pub fn bring_into_range(self, texels: &mut Texels) -> Vec<String> {
        let largest = texels.rgb.iter().flatten().copied().filter(|part| part.is_finite()).fold(0.0, f32::max);
        let [min, max] = match self {
            Self::Radiance => [0.0, largest],
            _ => [0.0, 1.0],
        };
        let (mut not_numbers, mut below, mut above, mut inward) = (0, 0, 0, 0);
        for texel in &mut texels.rgb {
            let is_any = |such: &dyn Fn(&f32) -> bool| u64::from(texel.iter().any(such));
            not_numbers += is_any(&|part| part.is_nan());
            below += is_any(&|part| *part < min);
            above += is_any(&|part| *part > max);
            for part in texel.iter_mut() {
                *part = if part.is_nan() { 0.0 } else { part.clamp(min, max) };
            }
            if self == Self::Normals && texel[2] <= 0.5 {
                inward += 1;
                texel[2] = LOWEST_BLUE;
            }
        }
        let now =
            if self == Self::Radiance { "the greatest number that the image has".into() } else { format!("{max}") };
        let said = [
            (not_numbers, "with a part that is not a number, which became 0".to_owned()),
            (below, "with a part below 0, which became 0".into()),
            (above, format!("with a part above {now}, which became that")),
            (
                inward,
                "with a normal that does not point out of the surface, blue at most a half, which now does".into(),
            ),
        ];
        let said = said.into_iter().filter(|(count, _)| *count > 0);
        said.map(|(count, what)| format!("it has {count} {} {what}", if count == 1 { "texel" } else { "texels" }))
            .collect()
    }
}

/// Whether an image has no colours: as a normal map it is one of heights, for no two directions in it would differ.
pub fn is_grey(texels: &Texels) -> bool {
    texels.rgb.iter().all(|[r, g, b]| (r - g).abs() <= GREY && (g - b).abs() <= GREY && (r - b).abs() <= GREY)
}

/// The normal map of a map of heights, by its slopes: white is 1/50 of the image's width above black.
pub fn normals_of_heights(heights: &Texels) -> Texels {
    let Texels { width, height, rgb } = heights;
    let at = |x: usize, y: usize| rgb[y % height * width + x % width][0];
    // Half the difference of the texels on both sides, over the width of a texel.
    let slope = |difference: f32, side: usize| HEIGHT * difference * 0.5 * side as f32;
    let texel = |row: usize| {
        let (x, y) = (row % width, row / width);
        let right = slope(at(x + 1, y) - at(x + width - 1, y), *width);
        let down = slope(at(x, y + 1) - at(x, y + height - 1), *height);
        let length = (right * right + down * down + 1.0).sqrt();
        [-right, down, 1.0].map(|part| 0.5 + 0.5 * part / length)
    };
    Texels { width: *width, height: *height, rgb: (0..width * height).map(texel).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(rgb: &[[f32; 3]]) -> Texels {
        Texels { width: rgb.len(), height: 1, rgb: rgb.to_vec() }
    }

    #[test]
    fn what_is_out_of_range_becomes_the_nearest_in_it_and_is_said() {
        let odd = [[-1e-7, 0.5, 0.5], [f32::NAN, 0.5, 0.75], [f32::INFINITY, 0.5, 9.0], [0.25, 0.5, 0.75]];
        let mut found = image(&odd);
        let said = Numbers::Radiance.bring_into_range(&mut found);
        assert_eq!(found.rgb, [[0.0, 0.5, 0.5], [0.0, 0.5, 0.75], [9.0, 0.5, 9.0], [0.25, 0.5, 0.75]]);
        let sentences = [
            "it has 1 texel with a part that is not a number, which became 0",
            "it has 1 texel with a part below 0, which became 0",
            "it has 1 texel with a part above the greatest number that the image has, which became that",
        ];
        assert_eq!(said, sentences);
        for numbers in [Numbers::Reflectances, Numbers::Factors] {
            let mut found = image(&odd);
            assert_eq!(numbers.bring_into_range(&mut found).len(), 3);
            assert_eq!(found.rgb, [[0.0, 0.5, 0.5], [0.0, 0.5, 0.75], [1.0, 0.5, 1.0], [0.25, 0.5, 0.75]]);
        }
        let mut found = image(&[[0.5, 0.5, 0.5], [0.0; 3], [0.5, 0.5, 1.0], [0.1, 0.9, 0.51]]);
        let said = Numbers::Normals.bring_into_range(&mut found);
        let lowest = LOWEST_BLUE;
        assert_eq!(found.rgb, [[0.5, 0.5, lowest], [0.0, 0.0, lowest], [0.5, 0.5, 1.0], [0.1, 0.9, 0.51]]);
        assert_eq!(said.len(), 1);
        assert!(said[0].starts_with("it has 2 texels with a normal that does not point out"), "{said:?}");
        for numbers in [Numbers::Reflectances, Numbers::Factors, Numbers::Radiance, Numbers::Normals] {
            assert_eq!(numbers.bring_into_range(&mut image(&[[0.1, 0.9, 0.51]])), Vec::<String>::new());
        }
    }

    /// The heights of a plane that rises to the right by its own width: 1/50.
    #[test]
    fn heights_become_the_normals_of_their_slopes() {
        let side = 16;
        let of = |height: &dyn Fn(usize, usize) -> f32| {
            let rgb = (0..side * side).map(|at| [height(at % side, at / side); 3]).collect();
            normals_of_heights(&Texels { width: side, height: side, rgb })
        };
        let normal = |map: &Texels| map.rgb[5 * side + 7].map(|part| 2.0 * part - 1.0);
        let flat = of(&|_, _| 0.7);
        assert!(flat.rgb.iter().all(|texel| *texel == [0.5, 0.5, 1.0]));
        let [x, y, z] = normal(&of(&|x, _| x as f32 / side as f32));
        assert!((x / z + HEIGHT).abs() < 1e-6 && y == 0.0, "{x}, {y}, {z}");
        // Up is against v: what rises downward falls upward, so its normal leans up.
        let [x, y, z] = normal(&of(&|_, y| y as f32 / side as f32));
        assert!((y / z - HEIGHT).abs() < 1e-6 && x == 0.0, "{x}, {y}, {z}");
        let map = of(&|x, y| ((x * 7 + y * 13) % 5) as f32 / 4.0);
        assert!(map.rgb.iter().all(|[r, g, b]| (0.0..=1.0).contains(r) && (0.0..=1.0).contains(g) && *b > 0.5));
        assert!(is_grey(&image(&[[0.5; 3], [0.1, 0.105, 0.1]])) && !is_grey(&image(&[[0.5, 0.5, 1.0]])));
    }
}
