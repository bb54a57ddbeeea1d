//! Exposure and tone mapping: each curve against its published formula or table, and what must not change by either.

use crate::scenes;

use bevy_ecs::prelude::*;
use pinhole::extract::luminance;
use pinhole::film::{
    Curve, FIRST_SAMPLE_STEPS, Film, PngKind, exr_bytes, png_bytes, png_bytes_as, rgba_bytes, rgba_of, tone_mapped,
};
use pinhole::plan::Census;
use pinhole::render::{Execution, RenderInProgress, render};
use pinhole::scene::{Exposure, Name, PerspectiveCamera, ToneMapping, View};
use scenes::{Setup, full, offer};

const REINHARD: ToneMapping = ToneMapping::Reinhard { white: f64::INFINITY };
const REINHARD_TO_4: ToneMapping = ToneMapping::Reinhard { white: 4.0 };
const CURVES: [ToneMapping; 6] =
    [ToneMapping::None, REINHARD, REINHARD_TO_4, ToneMapping::Aces, ToneMapping::PbrNeutral, ToneMapping::Agx];

fn stops(stops: f64) -> Exposure {
    Exposure { stops, automatic: false }
}

const AUTOMATIC: Exposure = Exposure { stops: 0.0, automatic: true };

fn bits(film: &Film) -> Vec<u32> {
    let pixels = (0..film.height).flat_map(|y| (0..film.width).map(move |x| film.mean(x, y)));
    pixels.flatten().map(f32::to_bits).collect()
}

/// A film of these pixels, line by line.
fn film_of(width: u32, side: u32, pixels: &[[f32; 3]]) -> Film {
    let mut film = Film::new(width, pixels.len() as u32 / width, side);
    for tile in &mut film.tiles {
        for row in 0..tile.tile.rows() {
            let [x, y] = tile.tile.pixel_of(row);
            tile.add(row, pixels[(y * width + x) as usize]);
        }
    }
    film.done.fill(FIRST_SAMPLE_STEPS);
    film
}

/// The values are `exposure/write.py`'s, which reads the numbers of the curves out of the files of those who published
/// them, and takes the curve of AgX from Sobotka's table.
#[test]
fn the_curves_are_the_published_ones() {
    let mut tried = [0; 5];
    let mut largest = [0.0_f64; 5];
    for line in include_str!("exposure/curves.csv").lines().skip(1) {
        let (name, numbers) = line.split_once(',').expect("a name");
        let numbers: Vec<f64> = numbers.split(',').map(|number| number.parse().expect("a number")).collect();
        // The table has 7 digits after the point.
        let (at, curve, tolerance) = match name {
            "reinhard" => (0, REINHARD, 1e-14),
            "reinhard-4" => (1, REINHARD_TO_4, 1e-14),
            "aces" => (2, ToneMapping::Aces, 1e-14),
            "pbr-neutral" => (3, ToneMapping::PbrNeutral, 1e-14),
            _ => (4, ToneMapping::Agx, 5e-7),
        };
        let shown = tone_mapped([numbers[0], numbers[1], numbers[2]], curve);
        for (shown, &published) in shown.iter().zip(&numbers[3..]) {
            let error = (shown - published).abs() / published.max(1.0);
            largest[at] = largest[at].max(error);
            assert!(error <= tolerance, "{line}: {shown:e}");
        }
        tried[at] += 1;
    }
    assert!(tried.iter().all(|&tried| tried >= 20), "{tried:?}");
    eprintln!("curves: {tried:?} colours of reinhard, reinhard to 4, aces, pbr-neutral, agx; off by {largest:?}");
}

/// Grey light that grows by a 64th of a stop at a time.
#[test]
fn more_light_is_never_shown_darker() {
    let mut tried = 0;
    for curve in CURVES {
        let mut last = [0.0; 3];
        for step in -64 * 24..=64 * 24 {
            let light = libm::exp2(f64::from(step) / 64.0);
            let shown = tone_mapped([light; 3], curve);
            for (last, shown) in last.into_iter().zip(shown) {
                assert!(shown >= last, "{curve:?} at {light:e}: {last:e}, then {shown:e}");
            }
            (last, tried) = (shown, tried + 1);
        }
        let white = if curve == REINHARD { 0.999 } else { 0.98 };
        assert!(last.iter().all(|&part| part > white), "{curve:?} ends at {last:?}");
        // To f64's last digits: cancellation leaves AgX no more than that.
        assert!(tone_mapped([0.0; 3], curve).iter().all(|part| part.abs() < 1e-15), "{curve:?} of black");
    }
    eprintln!("monotone: {tried} greys from 2^-24 to 2^24 by {} curves", CURVES.len());
}

/// Every number that a film can hold is shown by some byte, and never as one that is not a number.
#[test]
fn the_extremes_of_light_are_shown() {
    const PARTS: [f32; 8] = [0.0, f32::from_bits(1), f32::MIN_POSITIVE, 1e-30, 0.18, 1.0, 1e30, f32::MAX];
    let pixels: Vec<[f32; 3]> =
        (0..512_usize).map(|at| [at % 8, at / 8 % 8, at / 64].map(|place| PARTS[place])).collect();
    let film = film_of(32, 16, &pixels);
    let rows = [0, 1, 2].map(|part| pixels.iter().map(|pixel| pixel[part]).collect::<Vec<_>>());
    let mut tried = 0;
    for tone_mapping in CURVES {
        for pixel in &pixels {
            for scale in [-128.0, 0.0, 128.0].map(libm::exp2) {
                let shown = tone_mapped(pixel.map(|part| f64::from(part) * scale), tone_mapping);
                assert!(shown.iter().all(|part| part.is_finite()), "{tone_mapping:?}: {pixel:?} is {shown:?}");
                tried += 1;
            }
        }
        for exposure in [stops(-128.0), stops(0.0), stops(128.0), AUTOMATIC] {
            let curve = Curve::Exposed(exposure, tone_mapping);
            let bytes = rgba_bytes(&film, curve);
            assert_eq!(bytes, rgba_of(&rows, curve), "by rows, {curve:?}");
            let png = image::load_from_memory(&png_bytes(&film, curve).expect("encoded")).expect("a PNG").into_rgba8();
            assert!(bytes == png.into_raw(), "of the viewer and of a PNG, {curve:?}");
            assert_eq!(bytes[..4], [0, 0, 0, 255], "black stays black");
        }
    }
    eprintln!("extremes: {tried} colours by {} curves, finite", CURVES.len());
}

/// Whole stops are powers of two, by which floating-point numbers are multiplied without rounding.
#[test]
fn whole_stops_multiply_the_film_exactly() {
    let scene = full(Setup { size: [64, 36], ..Setup::default() });
    let film = render(&scene, &offer(), &Execution::default(), &()).expect("renders").film;
    let mut tried = 0;
    for whole in -12..=12 {
        let (exposure, factor) = (stops(f64::from(whole)), libm::exp2(f64::from(whole)));
        let mut brighter = film.clone();
        for sum in brighter.tiles.iter_mut().flat_map(|tile| &mut tile.sum).flatten() {
            *sum *= factor;
        }
        for tone_mapping in CURVES {
            let exposed = rgba_bytes(&film, Curve::Exposed(exposure, tone_mapping));
            let plain = Curve::Exposed(Exposure::default(), tone_mapping);
            assert_eq!(exposed, rgba_bytes(&brighter, plain), "{whole} stops, {tone_mapping:?}");
            tried += 1;
        }
        assert_eq!(rgba_bytes(&film, Curve::Exposed(exposure, ToneMapping::None)), rgba_bytes(&brighter, Curve::Srgb));
    }
    eprintln!("stops: {tried} pictures, each the same bytes as that of a film multiplied by 2^n");
}

/// Against the log-mean as written in the paper, over the pixels that are not black.
#[test]
fn automatic_exposure_brings_the_log_mean_to_the_key() {
    let pixels: Vec<[f32; 3]> = (0..64 * 48_u32)
        .map(|at| match at % 3 {
            0 => [0.0; 3],
            _ => [0.7, 0.2, 1.3].map(|part| part * libm::exp2f(((at * 7919) % 97) as f32 / 8.0 - 6.0)),
        })
        .collect();
    let lit: Vec<f64> = pixels.iter().map(|pixel| luminance(pixel.map(f64::from))).filter(|&own| own > 0.0).collect();
    let log_mean = (lit.iter().map(|own| own.ln()).sum::<f64>() / lit.len() as f64).exp();
    let rows = [0, 1, 2].map(|part| pixels.iter().map(|pixel| pixel[part]).collect::<Vec<_>>());
    let automatic = Curve::Exposed(AUTOMATIC, ToneMapping::None);
    let by_hand = Curve::Exposed(stops((0.18 / log_mean).log2()), ToneMapping::None);
    let expected = rgba_bytes(&film_of(64, 64, &pixels), by_hand);
    let mut tried = 0;
    for side in [7, 16, 32, 64] {
        let film = film_of(64, side, &pixels);
        for threads in [1, 2, 3, 8] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("workers");
            assert_eq!(pool.install(|| rgba_bytes(&film, automatic)), expected, "tiles of {side}, {threads} workers");
            tried += 1;
        }
    }
    assert_eq!(rgba_of(&rows, automatic), expected);
    // The unit of light makes no difference, and stops come on top.
    for whole in [-20, -3, 5, 30] {
        let scaled: Vec<_> = pixels.iter().map(|pixel| pixel.map(|part| part * libm::exp2f(whole as f32))).collect();
        assert_eq!(rgba_bytes(&film_of(64, 32, &scaled), automatic), expected, "{whole} stops brighter");
        tried += 1;
    }
    let beside = Exposure { stops: 2.0, ..AUTOMATIC };
    let brighter: Vec<_> = pixels.iter().map(|pixel| pixel.map(|part| part * 4.0)).collect();
    let twice = rgba_bytes(&film_of(64, 32, &brighter), by_hand);
    assert_eq!(rgba_bytes(&film_of(64, 32, &pixels), Curve::Exposed(beside, ToneMapping::None)), twice);
    let black = film_of(4, 4, &[[0.0; 3]; 16]);
    assert_eq!(rgba_bytes(&black, automatic), rgba_bytes(&black, Curve::Srgb));
    eprintln!("automatic: {tried} films of one picture, {} of {} pixels lit, the same bytes", lit.len(), pixels.len());
}

#[test]
fn no_film_no_exr_and_no_view_depends_on_them() {
    let setup = Setup { size: [48, 27], ..Setup::default() };
    let of = |insert: &dyn Fn(&mut EntityWorldMut<'_>)| {
        let mut scene = full(setup);
        let camera = camera(&mut scene);
        insert(&mut scene.entity_mut(camera));
        let rendered = render(&scene, &offer(), &Execution::default(), &()).expect("renders");
        let begun = RenderInProgress::begin(&Census::of(&scene), &offer(), &Execution::default()).expect("begins");
        let key = begun.key(&scene, &()).expect("nobody stops it");
        (scene, rendered, key)
    };
    let (_, plain, plain_key) = of(&|_| ());
    let (_, plain_view, _) = of(&|camera| _ = camera.insert(View { column: "hit".into() }));
    let exr = exr_bytes(&plain.film, &plain.attributes).expect("encoded");
    assert_eq!(plain.curve(), Curve::Srgb);
    let mut tried = 0;
    for tone_mapping in CURVES {
        for exposure in [stops(-3.0), stops(2.5), AUTOMATIC] {
            let (_, rendered, key) = of(&|camera| _ = camera.insert((exposure, tone_mapping)));
            assert_eq!(rendered.curve(), Curve::Exposed(exposure, tone_mapping));
            assert_eq!(bits(&rendered.film), bits(&plain.film));
            assert!(
                exr_bytes(&rendered.film, &rendered.attributes).expect("encoded") == exr,
                "{exposure:?} {tone_mapping:?}"
            );
            assert_eq!(key, plain_key, "a checkpoint serves every exposure");
            let (_, viewed, _) =
                of(&|camera| _ = camera.insert((exposure, tone_mapping, View { column: "hit".into() })));
            assert_eq!(viewed.curve(), Curve::Straight);
            assert!(rgba_bytes(&viewed.film, viewed.curve()) == rgba_bytes(&plain_view.film, plain_view.curve()));
            let changed = rgba_bytes(&rendered.film, rendered.curve()) != rgba_bytes(&plain.film, plain.curve());
            assert!(changed, "a picture that can be told from the plain one: {exposure:?} {tone_mapping:?}");
            tried += 1;
        }
    }
    let (_, of_default, _) = of(&|camera| _ = camera.insert((Exposure::default(), ToneMapping::default())));
    assert_eq!(of_default.curve(), Curve::Srgb, "what changes nothing is not there");
    eprintln!("films: {tried} exposures, the same EXR, checkpoint key and view of a column");
}

/// The chunks of a PNG: their names and what is in them.
fn chunks(png: &[u8]) -> Vec<(String, Vec<u8>)> {
    let mut rest = &png[8..];
    let mut found = Vec::new();
    while let Some((head, after)) = rest.split_at_checked(8) {
        let length = u32::from_be_bytes([head[0], head[1], head[2], head[3]]) as usize;
        found.push((String::from_utf8_lossy(&head[4..]).into_owned(), after[..length].to_vec()));
        rest = &after[length + 4..];
    }
    found
}

#[test]
fn a_png_of_16_bits_is_read_back_as_the_film() {
    let scene = full(Setup { size: [61, 33], ..Setup::default() });
    let film = render(&scene, &offer(), &Execution::default(), &()).expect("renders").film;
    let deep = PngKind { is_deep: true, ..PngKind::default() };
    let srgb = |linear: f64| if linear <= 0.0031308 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    let (mut tried, mut distinct) = (0, 0);
    for (curve, light) in [
        (Curve::Srgb, None),
        (Curve::Straight, None),
        (Curve::Exposed(stops(1.5), ToneMapping::Agx), Some((1.5, ToneMapping::Agx))),
        (Curve::Exposed(stops(-2.0), REINHARD), Some((-2.0, REINHARD))),
    ] {
        let png = png_bytes_as(&film, curve, &deep).expect("encoded");
        assert_eq!(png, png_bytes_as(&film, curve, &deep).expect("encoded"), "twice the same");
        let image = image::load_from_memory(&png).expect("a PNG");
        assert_eq!(image.color(), image::ColorType::Rgb16);
        let mut values = std::collections::BTreeSet::new();
        for (x, y, pixel) in image.into_rgb16().enumerate_pixels() {
            let mean = film.mean(x, y).map(f64::from);
            let light = light.map_or(mean, |(stops, by)| tone_mapped(mean.map(|part| part * f64::exp2(stops)), by));
            for (&value, light) in pixel.0.iter().zip(light) {
                let light = light.clamp(0.0, 1.0);
                let encoded = if curve == Curve::Straight { light } else { srgb(light) };
                let error = (f64::from(value) / 65535.0 - encoded).abs();
                assert!(error <= 0.51 / 65535.0, "{curve:?} at {x},{y}: {value}, and {encoded} was to be stored");
                values.insert(value);
                tried += 1;
            }
        }
        distinct = distinct.max(values.len());
    }
    assert!(distinct > 300, "{distinct} values would fit 8 bits");
    eprintln!("16 bits: {tried} values within half a step of 1/65535, up to {distinct} different ones in a picture");
}

#[test]
fn a_png_says_which_colours_it_has_and_where_it_is_from() {
    let film = film_of(2, 2, &[[0.25; 3]; 4]);
    let text = vec![("Scene", "room.ron".to_owned()), ("Command", "pinhole render Küche.ron".to_owned())];
    let mut kinds = 0;
    for is_deep in [false, true] {
        for curve in [Curve::Srgb, Curve::Straight, Curve::Exposed(AUTOMATIC, ToneMapping::Aces)] {
            let png = png_bytes_as(&film, curve, &PngKind { is_deep, text: text.clone() }).expect("encoded");
            let found = chunks(&png);
            let mut names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
            names.dedup_by(|one, other| one == other && *one == "IDAT");
            let colours = if curve == Curve::Straight { &[][..] } else { &["sRGB", "gAMA", "cHRM"] };
            let expected = [&["IHDR"], colours, &["tEXt", "tEXt", "iTXt", "IDAT", "IEND"]].concat();
            assert_eq!(names, expected, "{curve:?}");
            let of =
                |name: &str| found.iter().filter(|(own, _)| own == name).map(|(_, data)| &data[..]).collect::<Vec<_>>();
            assert_eq!(of("tEXt"), [&b"Software\0pinhole"[..], b"Scene\0room.ron"], "the program's mark comes first");
            assert!(of("iTXt")[0].ends_with("Küche.ron".as_bytes()), "what Latin-1 lacks is kept as UTF-8");
            if curve != Curve::Straight {
                assert_eq!(of("gAMA"), [45_455_u32.to_be_bytes()]);
                let primaries = [31270_u32, 32900, 64000, 33000, 30000, 60000, 15000, 6000];
                assert_eq!(of("cHRM"), [primaries.map(u32::to_be_bytes).as_flattened()], "those of Rec. 709");
            }
            kinds += 1;
        }
    }
    eprintln!("chunks: of {kinds} kinds of PNG, as the specification orders them");
}

#[test]
fn what_cannot_be_exposed_is_said_in_a_sentence() {
    type Change = fn(&mut World, Entity);
    let cases: [(&str, Change); 9] = [
        ("exposure stops is NaN", |world, camera| _ = world.entity_mut(camera).insert(stops(f64::NAN))),
        ("exposure stops is inf", |world, camera| _ = world.entity_mut(camera).insert(stops(f64::INFINITY))),
        ("exposure stops is -inf", |world, camera| _ = world.entity_mut(camera).insert(stops(f64::NEG_INFINITY))),
        ("exposure stops is 128.5", |world, camera| _ = world.entity_mut(camera).insert(stops(128.5))),
        ("tone_mapping white is NaN", |world, camera| {
            world.entity_mut(camera).insert(ToneMapping::Reinhard { white: f64::NAN });
        }),
        ("tone_mapping white is 0", |world, camera| {
            world.entity_mut(camera).insert(ToneMapping::Reinhard { white: 0.0 });
        }),
        ("tone_mapping white is -1", |world, camera| {
            world.entity_mut(camera).insert(ToneMapping::Reinhard { white: -1.0 });
        }),
        ("\"ball\": exposure is on no camera", |world, _| _ = world.spawn((Name::new("ball"), AUTOMATIC))),
        ("\"ball\": tone_mapping is on no camera", |world, _| {
            world.spawn((Name::new("ball"), ToneMapping::Agx));
        }),
    ];
    for (words, change) in cases {
        let mut scene = full(Setup { size: [4, 4], ..Setup::default() });
        let camera = camera(&mut scene);
        change(&mut scene, camera);
        let begun = RenderInProgress::begin(&Census::of(&scene), &offer(), &Execution::default());
        let said = begun.err().expect("refused").to_string();
        eprintln!("{said}");
        assert!(said.contains(words) && !said.ends_with('.') && said.lines().count() == 1, "{said}");
    }
}

fn camera(scene: &mut World) -> Entity {
    scene.query_filtered::<Entity, With<PerspectiveCamera>>().single(scene).expect("a camera")
}
