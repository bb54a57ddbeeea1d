use super::library::unquoted;
use super::mtl::MtlImages;
use crate::model_material::{ModelTexture, TextureWrap};
use crate::number::finite;
use crate::remarks::Remarks;

/// The options of a map that come before its file name, and the greatest number of words each takes.
const OPTIONS: [(&str, usize); 14] = [
    ("-blendu", 1),
    ("-blendv", 1),
    ("-bm", 1),
    ("-boost", 1),
    ("-cc", 1),
    ("-clamp", 1),
    ("-colorspace", 1),
    ("-imfchan", 1),
    ("-mm", 2),
    ("-o", 3),
    ("-s", 3),
    ("-t", 3),
    ("-texres", 1),
    ("-type", 1),
];

/// The values with which an option that is not followed changes nothing.
const WITHOUT_EFFECT: [(&str, &[&str]); 5] = [
    ("-blendu", &["on"]),
    ("-blendv", &["on"]),
    ("-cc", &["off"]),
    ("-clamp", &["off", "on"]),
    ("-colorspace", &["sRGB"]),
];

/// A map of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Map {
    /// Its image.
    pub texture: ModelTexture,
    /// Its factor, from `-bm`.
    pub factor: f64,
}

impl Map {
    /// The map that the rest of a line describes, if it names a file.
    pub fn read(line: &str, is_srgb: bool, images: &mut MtlImages, remarks: &mut Remarks) -> Option<Self> {
        let mut rest = line;
        let (mut factor, mut wrap, mut scale, mut offset) = (1.0, TextureWrap::Repeat, [1.0; 2], [0.0; 2]);
        let cut = |text: &str| {
            let end = text.find(char::is_whitespace).unwrap_or(text.len());
            (text[..end].to_owned(), end)
        };
        while let (option, end) = cut(rest)
            && let Some((_, max)) = OPTIONS.iter().find(|(name, _)| *name == option)
        {
            rest = rest[end..].trim_start();
            let (mut numbers, mut word) = (Vec::new(), String::new());
            for taken in 0..*max {
                let (next, end) = cut(rest);
                let number = finite(next.as_bytes());
                // Of up to three numbers, those that are not numbers belong to what follows.
                if taken > 0 && number.is_none() {
                    break;
                }
                numbers.extend(number);
                word = next;
                rest = rest[end..].trim_start();
            }
            match (option.as_str(), &numbers[..]) {
                ("-bm", [number]) => factor = *number,
                ("-s", given @ [_, ..]) => scale.iter_mut().zip(given).for_each(|(own, given)| *own = *given),
                ("-o", given @ [_, ..]) => offset.iter_mut().zip(given).for_each(|(own, given)| *own = *given),
                _ if word == "on" && option == "-clamp" => wrap = TextureWrap::Clamp,
                _ if is_without_effect(&option, &word, &numbers) => {}
                _ => remarks.add_unread(&format!("the option `{option}` of a map"), 1),
            }
        }
        let file = unquoted(rest);
        if file.is_empty() {
            return None;
        }
        let image = images.index(file, is_srgb);
        // In the file v goes up: 1 − (s v + o) = s (1 − v) + 1 − s − o.
        let offset = [offset[0], 1.0 - scale[1] - offset[1]];
        let texture = ModelTexture { image, wrap: [wrap; 2], offset, scale, ..ModelTexture::default() };
        Some(Self { texture, factor })
    }
}

fn is_without_effect(option: &str, word: &str, numbers: &[f64]) -> bool {
    match option {
        "-mm" => numbers == [0.0, 1.0] || numbers == [0.0],
        "-t" | "-boost" => !numbers.is_empty() && numbers.iter().all(|number| *number == 0.0),
        _ => WITHOUT_EFFECT.iter().any(|(own, words)| *own == option && words.contains(&word)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(line: &str) -> Option<(String, Map, Vec<String>)> {
        let (mut images, mut remarks) = (MtlImages::default(), Remarks::default());
        let map = Map::read(line, true, &mut images, &mut remarks)?;
        Some((images.images[0].name.to_string(), map, remarks.sentences()))
    }

    #[test]
    fn options_come_before_a_map_s_file() {
        let found = |line: &str| map(line).map(|(name, map, said)| (name, map.factor, map.texture.wrap[0], said.len()));
        let expected = |name: &str, factor, wrap, said| Some((name.to_owned(), factor, wrap, said));
        assert_eq!(found("brick.png"), expected("brick.png", 1.0, TextureWrap::Repeat, 0));
        assert_eq!(found("red brick.png"), expected("red brick.png", 1.0, TextureWrap::Repeat, 0));
        assert_eq!(found("\"red brick.png\" "), expected("red brick.png", 1.0, TextureWrap::Repeat, 0));
        assert_eq!(found("-bm 0.5 -clamp on a/b.jpg"), expected("a/b.jpg", 0.5, TextureWrap::Clamp, 0));
        assert_eq!(found("-s 1 1 1 -o 0.5 -mm 0 1 b.png"), expected("b.png", 1.0, TextureWrap::Repeat, 0));
        assert_eq!(found("-clamp off -blendu on -t 0 0 0 b.png"), expected("b.png", 1.0, TextureWrap::Repeat, 0));
        for option in ["-imfchan r", "-mm 0.1 0.8", "-t 0.1", "-boost 2", "-cc on", "-blendu off", "-texres 64"] {
            let word = option.split(' ').next().expect("a word");
            let (name, _, said) = map(&format!("{option} b.png")).expect("a map");
            assert_eq!((&*name, said), ("b.png", vec![format!("Not read: the option `{word}` of a map (1).")]));
        }
        assert_eq!(map("-bm 0.5"), None);
        assert_eq!(map(""), None);
    }

    /// `-s` and `-o` scale and shift u and v, v up; what they do is the same in the texture's own coordinates.
    #[test]
    fn scale_and_offset_are_those_of_the_file_s_coordinates() {
        for (line, scale, offset) in [
            ("-s 4 2 1 a.png", [4.0, 2.0], [0.0, 0.0]),
            ("-o 0.5 a.png", [1.0, 1.0], [0.5, 0.0]),
            ("-s 4 -o 0.25 0.5 a.png", [4.0, 1.0], [0.25, 0.5]),
            ("-o 0 0.75 0 -s 2 3 a.png", [2.0, 3.0], [0.0, 0.75]),
        ] {
            let texture = map(line).expect("a map").1.texture;
            for [u, v] in [[0.0, 0.0], [1.0, 1.0], [0.3, 0.9]] {
                let up = [scale[0] * u + offset[0], scale[1] * v + offset[1]];
                let down = [u, 1.0 - v];
                let found = [0, 1].map(|axis| texture.scale[axis] * down[axis] + texture.offset[axis]);
                let error = (found[0] - up[0]).abs() + (found[1] - (1.0 - up[1])).abs();
                assert!(error < 1e-12, "{line} at ({u}, {v}): {found:?}, {up:?}");
            }
        }
        assert_eq!(map("a.png").expect("a map").1.texture, ModelTexture::default());
    }
}
