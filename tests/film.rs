//! The film: what may not join it, what it sums, and what it leaves on disk.

use crate::scenes;

use exr::prelude::{FlatSamples, read_first_flat_layer_from_file};
use pinhole::film::{
    Curve, FIRST_SAMPLE_STEPS, Film, FilmLayers, FilmMoments, FilmSplats, FilmTile, Rejected, SplatFilter,
    byte_from_linear, png_bytes, write_exr, write_png,
};
use pinhole::plan::VectorRows;
use pinhole::rays::Tile;
use pinhole::scene::{Filter, LayerKind};
use scenes::{Setup, full, offer};
use std::fs;

#[test]
fn samples_that_are_no_light_are_counted_and_kept_out() {
    let tile = Tile { x: 32, y: 64, width: 4, height: 3 };
    let mut film = FilmTile::new(tile);
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, -f32::MIN_POSITIVE];
    let mut expected = Vec::new();
    for row in 0..tile.rows() {
        film.add(row, [0.25, 0.5, 1.0]);
        for (turn, value) in bad.into_iter().enumerate() {
            let mut radiance = [0.125; 3];
            radiance[(row + turn) % 3] = value;
            expected.push(Rejected { pixel: tile.pixel_of(row), sample: 1, radiance });
            film.add(row, radiance);
        }
        film.add(row, [0.75, 0.5, 0.0]);
        film.add(row, [-0.0, f32::MAX, 1e-45]);
    }
    let rows = tile.rows();
    assert_eq!(film.rejected, (bad.len() * rows) as u64);
    assert!(!film.first_rejected.is_empty());
    for (found, expected) in film.first_rejected.iter().zip(&expected) {
        assert_eq!((found.pixel, found.sample), (expected.pixel, expected.sample));
        assert_eq!(found.radiance.map(f32::to_bits), expected.radiance.map(f32::to_bits), "as it came");
    }
    for row in 0..rows {
        assert_eq!(film.count[row], 3);
        let sums = [1.0, 1.0 + f64::from(f32::MAX), 1.0 + f64::from(1e-45_f32)];
        assert_eq!(film.sum.at(row), sums, "only what is light is summed");
    }
    let film = Film { width: 4, height: 3, tile_side: 4, tiles: vec![film], ..Film::default() };
    assert_eq!(film.rejected().0, (bad.len() * rows) as u64);
    let splats = FilmSplats { rejected: 7, ..FilmSplats::new(4, 3) };
    let with_splats = Film { splats: Some(splats), ..film.clone() };
    assert_eq!(with_splats.rejected().0, film.rejected().0 + 7, "those of light paths, too");
    assert_eq!(film.rejected().1[0].pixel, [32, 64], "by the pixel of the image, not of the tile");
    eprintln!("rejected: {} samples of {} kinds in {rows} pixels", bad.len() * rows, bad.len());
}

#[test]
fn many_ones_have_the_mean_one() {
    const SAMPLES: u32 = (1 << 24) + 16;
    let mut film = FilmTile::new(Tile { x: 0, y: 0, width: 1, height: 1 });
    for _ in 0..SAMPLES {
        film.add(0, [1.0; 3]);
    }
    assert_eq!((film.sum[0][0], film.count[0], film.mean(0)), (f64::from(SAMPLES), SAMPLES, [1.0; 3]));
    eprintln!("sums: (2^24 + 16) × 1.0 has the mean 1.0; in f32 the sum would stop at 2^24");
}

#[test]
fn files_read_back_as_the_film() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for size in [[97, 31], [1, 1], [33, 65]] {
        let scene = full(Setup { size, ..Setup::default() });
        let film = pinhole::render::render(&scene, &offer(), &scenes::one_world(), &()).expect("renders").film;
        let [width, height] = size;
        for curve in [Curve::Srgb, Curve::Straight] {
            let path = folder.path().join("picture.png");
            write_png(&film, curve, &path).expect("written");
            assert_eq!(fs::read(&path).expect("read"), png_bytes(&film, curve).expect("encoded"));
            let image = image::open(&path).expect("a PNG");
            assert_eq!(image.color(), image::ColorType::Rgb8);
            let image = image.into_rgb8();
            assert_eq!(image.dimensions(), (width, height));
            for (x, y, pixel) in image.enumerate_pixels() {
                assert_eq!(pixel.0, film.mean(x, y).map(|part| byte_from_linear(part, curve)), "{x},{y}");
            }
        }
        let path = folder.path().join("picture.exr");
        write_exr(&film, &path).expect("written");
        let layer = read_first_flat_layer_from_file(&path).expect("an EXR").layer_data;
        assert_eq!((layer.size.x(), layer.size.y()), (width as usize, height as usize));
        let names: Vec<String> = layer.channel_data.list.iter().map(|channel| channel.name.to_string()).collect();
        assert_eq!(names, ["B", "G", "R"], "as the format orders them");
        for (channel, part) in layer.channel_data.list.iter().zip([2, 1, 0]) {
            let FlatSamples::F32(values) = &channel.sample_data else { panic!("{} is not f32", channel.name) };
            for (at, value) in values.iter().enumerate() {
                let (x, y) = (at as u32 % width, at as u32 / width);
                assert_eq!(value.to_bits(), film.mean(x, y)[part].to_bits(), "{} of {x},{y}", channel.name);
            }
        }
    }
    eprintln!("files: 3 sizes, PNG by two curves and EXR, every pixel equal to the film");
}

/// Light from the lights is summed in f64, and the squares of f32 do not fit f32: a picture holds no infinite number.
#[test]
fn more_light_than_a_picture_holds_is_its_largest_number() {
    let (width, height) = (3, 2);
    let mut film = Film::new(width, height, 32);
    for row in 0..6 {
        film.tiles[0].add(row, [f32::MAX, 1.0, 0.0]);
    }
    film.done[0] = FIRST_SAMPLE_STEPS;
    assert_eq!((film.mean(0, 0), film.too_bright()), ([f32::MAX, 1.0, 0.0], 0));
    let mut splats = FilmSplats::new(width, height);
    let mut filter = SplatFilter::new(Filter::Box { radius: 0.5 });
    splats.add(&mut filter, [0.5, 0.5], [1e38, 1e300, 1.0]);
    splats.paths = 1;
    film.splats = Some(splats);
    assert_eq!(film.mean(0, 0), [f32::MAX, f32::MAX, 1.0]);
    assert_eq!(film.mean(1, 0), [f32::MAX, 1.0, 0.0]);
    assert_eq!(film.too_bright(), 1);

    let kinds = [LayerKind::Variance];
    film.layers = vec![FilmLayers::new(6, &kinds)];
    film.moments =
        vec![FilmMoments { sum: [vec![1e77; 6], vec![0.0; 6], vec![f64::MAX; 6]], ..FilmMoments::default() }];
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("bright.exr");
    write_exr(&film, &path).expect("written");
    let layer = read_first_flat_layer_from_file(&path).expect("an EXR").layer_data;
    let (mut values, mut largest) = (0, 0);
    for channel in &layer.channel_data.list {
        let FlatSamples::F32(numbers) = &channel.sample_data else { panic!("{} is not f32", channel.name) };
        assert!(numbers.iter().all(|number| number.is_finite()), "{}: {numbers:?}", channel.name);
        values += numbers.len();
        largest += numbers.iter().filter(|&&number| number == f32::MAX).count();
    }
    assert_eq!((values, largest), (36, 6 + 1 + 12), "red, one green, and two variances");
    eprintln!("bright: {values} numbers of a file, {largest} of them as large as there are");
}

/// The variance that a film states of a pixel's mean, against the variance of that mean over many films: samples of a
/// known spread, some of which count negatively, as a filter with negative lobes has them.
#[test]
fn stated_variances_are_those_of_many_films() {
    const FILMS: u32 = 10_000;
    let mut tried = 0;
    for (samples, negative) in [(16, 0.0), (64, 0.0), (16, 0.05), (64, 0.1), (256, 0.1)] {
        let (mut sum, mut squares, mut stated, mut of_sample) = (0.0, 0.0, 0.0, 0.0);
        for number in 0..FILMS {
            let mut film = Film::new(1, 1, 1);
            film.moments = vec![FilmMoments::new(1)];
            for sample in 0..samples {
                let uniform = |salt: u64| {
                    let pixel = [number, sample];
                    pinhole::sample::uniform(40 + salt, pixel, 0, pinhole::sample::Purpose::Pixel)
                };
                let radiance = [(2.0 + uniform(0)) as f32; 3];
                film.moments[0].add(&film.tiles[0], 0, radiance);
                if uniform(1) < negative {
                    film.tiles[0].add_negative(0, radiance);
                } else {
                    film.tiles[0].add(0, radiance);
                }
            }
            let mean = film.tiles[0].shown_f64(0)[0] - 2.5;
            sum += mean;
            squares += mean * mean;
            stated += film.variance_of_mean(0, 0)[0];
            of_sample += film.moments[0].variance(&film.tiles[0], 0)[0] / f64::from(samples);
        }
        let films = f64::from(FILMS);
        let variance = squares / films - (sum / films) * (sum / films);
        let [stated, of_sample] = [stated, of_sample].map(|stated| stated / films / variance);
        eprintln!(
            "{samples} samples, {negative} of them negative: stated {stated:.3} and, by a sample's, {of_sample:.3} of \
             the true variance"
        );
        // A variance of so many means is known to 1.4 %.
        assert!((stated - 1.0).abs() < 0.04, "{samples} samples, {negative} negative: stated {stated} of the truth");
        assert!((of_sample - 1.0).abs() < 0.04, "{samples} samples, {negative} negative: {of_sample} of the truth");
        tried += FILMS;
    }
    eprintln!("variances: {tried} films");
}
