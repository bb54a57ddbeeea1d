use super::picture_pair::{PicturePair, Pixels};

/// The sides of a block of pixels.
const BLOCK: usize = 16;
/// A difference of a pixel that the eye finds where it looks at two pictures in turn, of 255.
const OF_PIXEL: f64 = 8.0;
/// The part of the pixels that must differ so much: about as many as a line across the picture has.
const PART: f64 = 0.005;
/// A difference of a block's mean that the eye finds, for neighbouring blocks show the step between them, of 255.
const OF_BLOCK: f64 = 3.0;
/// Standard errors of the noise that a difference must exceed.
const SIGNIFICANT: f64 = 4.0;

/// What a person sees of the difference between pinhole's picture and the reader's.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// The part of the pixels in which a difference is seen.
    pub part: f64,
    /// The largest difference of a block's mean beyond its noise, of 255.
    pub block: f64,
    /// The largest difference of a pixel, of 255.
    pub largest: u8,
    /// The part of the pixels that differ by more than 3 of 255.
    pub part_over_3: f64,
    /// How much brighter the reader's picture is on average, as a part of pinhole's light, and the standard error of that.
    pub brighter: (f64, f64),
    /// The middle of the block that differs most.
    pub most: [usize; 2],
    /// The light of pinhole's block there and of the reader's, in the colour that differs most, and which colour, where they
    /// are not alike.
    pub there: ([f64; 2], Option<&'static str>),
    /// The largest difference of a number, as a part of the brightest.
    pub apart: f64,
    /// How many pixels differ at all, of 255.
    pub differing: usize,
    /// The difference of a block's mean that noise could hide, of 255; none where there is no noise.
    pub hidden: Option<f64>,
}

/// One block of pixels, of 255, in the colour that differs most.
struct Block {
    middle: [usize; 2],
    mean: f64,
    noise: f64,
    channel: usize,
    light: [[f64; 3]; 2],
}

impl Seen {
    pub(super) fn of(pair: &PicturePair) -> Self {
        let bytes = pair.light.each_ref().map(|light| pair.bytes(light));
        let halves =
            pair.halves.as_ref().map(|halves| halves.each_ref().map(|half| half.each_ref().map(|l| pair.bytes(l))));
        let apart = |at: usize, channel: usize| f64::from(bytes[1][at][channel]) - f64::from(bytes[0][at][channel]);
        // By how much one half of the samples differs from the mean of both: in pinhole's picture, and in the difference.
        let noise = |at: usize, channel: usize| {
            halves.as_ref().map_or([0.0; 2], |halves| {
                let [[p, m], [q, n]] = halves.each_ref().map(|half| half.each_ref().map(|b| f64::from(b[at][channel])));
                [0.5 * (p - q), 0.5 * ((m - p) - (n - q))]
            })
        };
        let (mut blocks, mut seen, mut over_3, mut differing, mut largest) = (Vec::new(), 0, 0, 0, 0_u8);
        for (middle, places) in blocks_of(pair.size) {
            let count = places.len() as f64;
            let of_channel = |channel: usize| {
                let mean = places.iter().map(|&at| apart(at, channel)).sum::<f64>() / count;
                let squares = places.iter().map(|&at| noise(at, channel).map(|off| off * off));
                let squares = squares.fold([0.0; 2], |sum, own| [sum[0] + own[0], sum[1] + own[1]]);
                (mean, squares[0].max(squares[1]).sqrt())
            };
            let channels = [0, 1, 2].map(of_channel);
            for &at in &places {
                let off = [0, 1, 2].map(|channel| apart(at, channel).abs());
                let most = off.iter().fold(0.0, |max: f64, off| max.max(*off));
                let of_pixel = |channel: usize| SIGNIFICANT * channels[channel].1 / count.sqrt();
                seen += usize::from((0..3).any(|channel| off[channel] >= OF_PIXEL.max(of_pixel(channel))));
                over_3 += usize::from(most > 3.0);
                differing += usize::from(most > 0.0);
                largest = largest.max(most as u8);
            }
            let beyond = |&(mean, noise): &(f64, f64)| mean.abs() - SIGNIFICANT * noise / count;
            let channel = (0..3).max_by(|&a, &b| beyond(&channels[a]).total_cmp(&beyond(&channels[b]))).unwrap_or(0);
            let (mean, noise) = channels[channel];
            let light = pair.light.each_ref().map(|light| mean_light(light, &places));
            blocks.push(Block { middle, mean, noise: noise / count, channel, light });
        }
        let is_seen = |block: &Block| block.mean.abs() >= SIGNIFICANT * block.noise;
        let block = blocks.iter().filter(|block| is_seen(block)).map(|block| block.mean.abs()).fold(0.0, f64::max);
        let worst = |a: &&Block, b: &&Block| {
            (is_seen(a), a.mean.abs()).partial_cmp(&(is_seen(b), b.mean.abs())).unwrap_or(std::cmp::Ordering::Equal)
        };
        let (mut most, mut there) = ([0; 2], ([0.0; 2], None));
        if let Some(worst) = blocks.iter().max_by(worst) {
            most = worst.middle;
            let is_grey = worst.light.iter().all(|[r, g, b]| (r - g).abs().max((r - b).abs()) <= 0.02 * r.max(0.05));
            let name = ["red", "green", "blue"][worst.channel];
            there = (worst.light.map(|light| light[worst.channel]), (!is_grey).then_some(name));
        }
        let mut noises: Vec<f64> = blocks.iter().map(|block| SIGNIFICANT * block.noise).collect();
        noises.sort_by(f64::total_cmp);
        let pixels = bytes[0].len().max(1) as f64;
        Self {
            part: seen as f64 / pixels,
            block,
            largest,
            part_over_3: over_3 as f64 / pixels,
            brighter: brighter(pair),
            most,
            there,
            apart: largest_apart(&pair.light),
            differing,
            hidden: halves.is_some().then(|| noises.get(noises.len() / 2).copied().unwrap_or(0.0)),
        }
    }

    /// Whether a person who looks at the two pictures sees that they differ: half a per cent of the pixels by 8 of 255, or a
    /// block of 16 × 16 pixels by 3 of 255 on average, and beyond the noise.
    pub fn is_shown(&self) -> bool {
        self.part >= PART || self.block >= OF_BLOCK
    }

    /// Whether no byte of the pictures differs.
    pub fn is_same(&self) -> bool {
        self.differing == 0
    }

    /// The difference in a sentence with its numbers.
    pub fn sentence(&self) -> String {
        let Self { part, largest, brighter: (brighter, error), most: [x, y], apart, differing, .. } = *self;
        let average = |brighter: f64| {
            let told = percent(brighter.abs());
            match told.as_str() {
                "0" => "as bright as pinhole's on average".to_owned(),
                _ if brighter < 0.0 => format!("{told} % darker on average"),
                _ => format!("{told} % brighter on average"),
            }
        };
        let noise = if error > 0.0 { format!(" (noise alone: ± {} %)", percent(error)) } else { String::new() };
        if apart == 0.0 {
            return "yours is pinhole's picture, to the last bit".into();
        }
        if differing == 0 {
            let digits = (-libm::log10(apart)).floor().clamp(1.0, 16.0);
            return format!("yours is pinhole's picture, to 1 part in 10^{digits}");
        }
        if self.is_shown() {
            let ([pinholes, yours], colour) = self.there;
            let colour = colour.map_or(String::new(), |colour| format!("{colour} "));
            let where_seen = match percent(part).as_str() {
                "0" => "it is seen in blocks of pixels".to_owned(),
                part => format!("{part} % of the pixels differ visibly"),
            };
            let [yours, pinholes] = told_apart([yours, pinholes]);
            return format!(
                "yours is {}{noise}; {where_seen}, most about column {x}, row {y}: {colour}{yours} where pinhole has \
                 {pinholes}",
                average(brighter),
            );
        }
        match self.hidden {
            // Thin over the whole picture, so that only its mean tells.
            Some(_) if error > 0.0 && brighter.abs() > SIGNIFICANT * error => {
                format!("yours is {}{noise}, too thinly for any block of 16 × 16 pixels to show it", average(brighter))
            }
            Some(hidden) if error > 0.0 => format!(
                "yours is pinhole's picture as far as its noise lets one see: {}{noise}; more than {hidden:.1} of 255 in a \
                 block of 16 × 16 pixels would show",
                average(brighter),
            ),
            _ => format!(
                "yours differs by too little to be seen: in {differing} pixels, by {largest} of 255 at most, and it is {}",
                average(brighter),
            ),
        }
    }
}

/// The blocks of a picture: their middles, and where their pixels are.
fn blocks_of([width, height]: [u32; 2]) -> Vec<([usize; 2], Vec<usize>)> {
    let [width, height] = [width as usize, height as usize];
    let span = |first: usize, end: usize| first..(first + BLOCK).min(end);
    let corners = (0..height).step_by(BLOCK).flat_map(|top| (0..width).step_by(BLOCK).map(move |left| [left, top]));
    let block = |[left, top]: [usize; 2]| {
        let places = span(top, height).flat_map(|y| span(left, width).map(move |x| y * width + x)).collect();
        let middle = |span: std::ops::Range<usize>| (span.start + span.end) / 2;
        ([middle(span(left, width)), middle(span(top, height))], places)
    };
    corners.map(block).collect()
}

/// Light as it is shown, none of it beyond white.
fn shown(part: f32) -> f64 {
    f64::from(part).clamp(0.0, 1.0)
}

fn mean_light(light: &Pixels, places: &[usize]) -> [f64; 3] {
    [0, 1, 2].map(|channel| places.iter().map(|&at| shown(light[at][channel])).sum::<f64>() / places.len() as f64)
}

/// How much brighter the reader's picture is, and the standard error of that.
fn brighter(pair: &PicturePair) -> (f64, f64) {
    let sum = |light: &Pixels| light.iter().flatten().map(|&part| shown(part)).sum::<f64>();
    let [pinholes, readers] = pair.light.each_ref().map(sum);
    let pinholes = pinholes.max(f64::MIN_POSITIVE);
    let error = pair.halves.as_ref().map_or(0.0, |halves| {
        let off = |at: usize, half: usize| {
            let of = |whose: usize| halves[half][whose][at].iter().map(|&part| shown(part)).sum::<f64>();
            of(1) - of(0)
        };
        let pixel = |at: usize| 0.25 * (off(at, 0) - off(at, 1)) * (off(at, 0) - off(at, 1));
        (0..pair.light[0].len()).map(pixel).sum::<f64>().sqrt() / pinholes
    });
    (readers / pinholes - 1.0, error)
}

/// The largest difference of a number, as a part of the brightest of pinhole's.
fn largest_apart([pinholes, readers]: &[Pixels; 2]) -> f64 {
    let brightest = pinholes.iter().flatten().fold(0.0_f32, |max, part| max.max(part.abs()));
    let off = pinholes.iter().flatten().zip(readers.iter().flatten()).map(|(a, b)| (a - b).abs());
    let largest = off.fold(0.0_f32, f32::max);
    if largest == 0.0 { 0.0 } else { f64::from(largest) / f64::from(brightest.max(f32::MIN_POSITIVE)) }
}

/// A part in per cent, to two digits.
fn percent(part: f64) -> String {
    let percent = 100.0 * part;
    match percent {
        ..0.005 => "0".into(),
        ..1.0 => format!("{percent:.2}"),
        ..10.0 => format!("{percent:.1}"),
        _ => format!("{percent:.0}"),
    }
}

/// Light to two digits, or to as many as it takes to tell one from the other.
fn told_apart(light: [f64; 2]) -> [String; 2] {
    let told = |digits: usize| {
        light.map(|light| match light >= 0.1 || light == 0.0 {
            true => format!("{light:.digits$}"),
            false => format!("{light:.*e}", digits - 1),
        })
    };
    (2..9).map(told).find(|[one, other]| one != other).unwrap_or_else(|| told(2))
}

#[cfg(test)]
mod tests {
    use super::told_apart;

    #[test]
    fn numbers_have_as_many_digits_as_tell_them_apart() {
        assert_eq!(told_apart([0.23, 0.43]), ["0.23", "0.43"]);
        assert_eq!(told_apart([0.1149, 0.1062]), ["0.115", "0.106"]);
        assert_eq!(told_apart([0.0, 0.001_234]), ["0.00", "1.2e-3"]);
        assert_eq!(told_apart([0.25, 0.25]), ["0.25", "0.25"]);
    }
}
