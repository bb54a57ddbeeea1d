//! Frames that are the mean of moments: what turns, fades or is animated while the shutter is open, against closed forms.

use super::frames::killed;
use super::{run, text};
use pinhole::plan::Census;
use pinhole::render::{Execution, RenderInProgress};
use pinhole::scene::{ModelScene, SceneFile};
use pinhole::{Overrides, stages};
use std::fs;
use std::path::Path;

/// The film of a scene at so many moments of a frame, stopped and continued after every so many steps.
fn means(
    scene: impl Fn(u32, u32) -> bevy_ecs::prelude::World + Send + Sync + 'static,
    moments: u32,
    pause: u32,
) -> Vec<[f32; 3]> {
    let offer = pinhole::Chapter::new("scene", "", |_| ()).offer(stages::all()).stages();
    let world = scene(0, 1);
    let mut render = RenderInProgress::begin(&Census::of(&world), &offer, &Execution::default()).expect("begun");
    render.at_moments(moments, Box::new(move |number, of| Ok(scene(number, of))), offer);
    let steps = render.steps();
    for to in (1..steps).step_by(pause as usize).chain([steps]) {
        render.advance(to, &()).expect("rendered");
    }
    render.finish().film.means()
}

fn file(text: &str) -> SceneFile {
    SceneFile::parse(Path::new("a.ron"), text.into()).unwrap_or_else(|problem| panic!("{}: {text}", problem.what))
}

fn of_file(text: &str, frame: f64, moments: u32, frozen: bool) -> Vec<[f32; 3]> {
    let file = file(text);
    means(move |number, of| file.at_moment(frame, 1.0, [number, of], frozen).expect("keys").world(), moments, 1000)
}

fn mean_of(pixels: &[[f32; 3]]) -> f64 {
    pixels.iter().map(|pixel| f64::from(pixel[0])).sum::<f64>() / pixels.len() as f64
}

/// A light on a surface at right angles to it, whose strength has keys.
fn lit(keys: &str, curve: &str) -> String {
    format!(
        "[(name: \"camera\", orthographic_camera: (), look_at: (eye: (0, 5, 0), target: (0, 0, 0)), \
          resolution: (width: 4, height: 4), sampling: (samples: 64), shutter: (open: 0.25, close: 0.75)),
          (name: \"floor\", plane: (), matte: (colour: (1, 1, 1))),
          (name: \"sun\", directional_light: (casts_shadows: false), look_at: (eye: (0, 1, 0), target: (0, 0, 0)),
           keys: (values: {{\"directional_light.irradiance\": {keys}}}, curve: {curve}))]"
    )
}

#[test]
fn a_light_that_changes_has_the_mean_of_its_moments_and_in_the_limit_its_integral() {
    use std::f64::consts::PI;
    let linear = lit("[(0, (0, 0, 0)), (4, (4, 4, 4))]", "Linear");
    // The mean of a straight line is its middle, whatever the number of moments.
    for moments in [1, 2, 3, 16, 64] {
        for frame in [0.0, 2.0, 3.0] {
            let mean = mean_of(&of_file(&linear, frame, moments, false));
            let uneven = if 64 % moments == 0 { 1e-6 } else { 1.0 / 64.0 };
            assert!((mean * PI / (frame + 0.5) - 1.0).abs() < uneven, "{moments} moments, frame {frame}: {mean}");
        }
    }
    // Along a cubic from 0 to 4 in a unit of time, 4 (3 t² - 2 t³), between a quarter and three quarters.
    let smooth = lit("[(0, (0, 0, 0)), (1, (4, 4, 4))]", "Smooth");
    let (value, integral) = (|t: f64| 4.0 * t * t * (3.0 - 2.0 * t), |t: f64| 4.0 * t * t * t * (1.0 - 0.5 * t));
    let rising = smooth.replace("open: 0.25, close: 0.75", "open: 0, close: 0.5");
    let limit = 2.0 * (integral(0.5) - integral(0.0));
    let mut before = f64::INFINITY;
    for moments in [1_u32, 2, 4, 8, 16, 32, 64] {
        let mean = PI * mean_of(&of_file(&rising, 0.0, moments, false));
        let of_moments =
            (0..moments).map(|number| value(0.5 * (f64::from(number) + 0.5) / f64::from(moments))).sum::<f64>();
        assert!((mean * f64::from(moments) / of_moments - 1.0).abs() < 1e-6, "{moments} moments: {mean}");
        let error = (mean / limit - 1.0).abs();
        assert!(error < before / 3.5 || error < 1e-6, "{moments} moments: error {error}, before {before}");
        before = error;
    }
    eprintln!("moments: a light along a straight line is exact, along a cubic its error falls by 4 with each doubling");
}

/// A bar turns about the middle of the picture: what it covers of a place is the angle that it covers there.
#[test]
fn a_bar_that_turns_covers_each_place_for_as_long_as_it_is_there() {
    let bar = |turn: f64| {
        format!(
            "[(name: \"camera\", orthographic_camera: (view_height: 4), look_at: (eye: (0, 0, 5), target: (0, 0, 0)), \
              resolution: (width: 33, height: 33), sampling: (samples: 256), shutter: (open: 0, close: 1)),
              (name: \"bar\", rectangle: (width: 4, depth: 0.5), emissive: (radiance: (1, 1, 1)), \
               placement: (euler_xyz: (90, 0, 0)), \
               keys: (values: {{\"placement.euler_xyz\": [(0, (90, 0, 0)), (1, (90, 0, {turn}))]}}))]"
        )
    };
    let side = 4.0 / 33.0;
    let mut tried = 0;
    for turn in [90.0_f64, 180.0, 540.0] {
        for moments in [4_u32, 16, 64, 256] {
            let film = of_file(&bar(turn), 0.0, moments, false);
            let worst = (0..33 * 33).map(|at| (at, [f64::from(at % 33) - 16.0, 16.0 - f64::from(at / 33)])).filter_map(
                |(at, place)| {
                    let [x, y] = place.map(|number| number * side);
                    let radius = x.hypot(y);
                    // Far enough from the middle and the ends that the pixel is all but a point.
                    (0.8..1.8).contains(&radius).then(|| {
                        let half = (0.25 / radius).asin().to_degrees();
                        let angle = y.atan2(x).to_degrees();
                        // The bar has two ends, half a turn apart: it is there while its angle is within `half` of the place's.
                        let covered: f64 = (-8..=8)
                            .map(|turns| angle + 180.0 * f64::from(turns))
                            .map(|at| ((at + half).clamp(0.0, turn) - (at - half).clamp(0.0, turn)).max(0.0))
                            .sum();
                        (f64::from(film[at as usize][0]) - covered / turn).abs()
                    })
                },
            );
            let worst = worst.fold(0.0, f64::max);
            // One moment at each end of a passage, of which a turn may hold some, and the pixel's own width.
            let passages = (turn / 180.0).max(1.0);
            let pixel = (side / 0.8).to_degrees() / turn * passages;
            assert!(worst < passages / f64::from(moments) + pixel, "{turn}°, {moments} moments: {worst}");
            tried += 1;
        }
    }
    eprintln!("moments: bars by {tried} turns and numbers of moments within one moment of the covered time");
}

/// Whatever moves along a straight line is the same by moments as by a time for each ray.
#[test]
fn what_moves_along_a_line_is_the_same_by_moments_as_by_rays() {
    let scene = r#"[
        (name: "camera", perspective_camera: (fov: 40), resolution: (width: 32, height: 18), sampling: (samples: 256),
         shutter: (open: 0, close: 0.5), look_at: (eye: (0, 1, 6), target: (0, 0.5, 0))),
        (name: "ball", sphere: (radius: 0.5), placement: (), matte: (colour: (0.8, 0.2, 0.1)),
         keys: (values: {"placement.position": [(0, (-2, 0.5, 0)), (0.5, (2, 0.5, 0))]})),
        (name: "floor", plane: (), matte: ()), (name: "sky", background: (colour: (0.2, 0.4, 0.9))),
        (name: "sun", directional_light: (irradiance: (3, 3, 3)), look_at: (eye: (1, 2, 3), target: (0, 0, 0))),
    ]"#;
    let file = file(scene);
    assert!(!file.changes(0.0, 1.0, 16).expect("keys"), "a straight line needs no moments");
    let by_rays = {
        let file = file.clone();
        means(move |_, _| file.at(0.0, 1.0).expect("keys").world(), 1, 1000)
    };
    let error = |moments: u32, frozen: bool| {
        let by_moments = of_file(scene, 0.0, moments, frozen);
        let apart = by_moments.iter().zip(&by_rays).map(|(one, other)| f64::from(one[0] - other[0]).powi(2));
        (apart.sum::<f64>() / by_rays.len() as f64).sqrt()
    };
    let moving = [1, 4, 16, 64].map(|moments| error(moments, false));
    assert!(moving[0] == 0.0 && moving.iter().all(|error| *error < 0.003), "{moving:?}");
    let frozen = [4, 16, 64].map(|moments| error(moments, true));
    assert!(frozen[0] > 4.0 * frozen[1] && frozen[2] < 0.003, "{frozen:?}");
    eprintln!("moments: a ball by rays and by 4, 16, 64 moments apart by {moving:.4?}, frozen {frozen:.4?}");
}

#[test]
fn what_needs_moments_is_found() {
    let scene = |shutter: &str, keys: &str, curve: &str| {
        file(&format!(
            "[(name: \"camera\", perspective_camera: (), shutter: ({shutter}), sampling: (samples: 16), look_at: (eye: (0, 1, 6))),
              (name: \"ball\", sphere: (), matte: (), placement: (), keys: (values: {{{keys}}}, curve: {curve}))]"
        ))
    };
    let (line, turn) = (
        "\"placement.position\": [(0, (0, 0, 0)), (8, (8, 4, 0))]",
        "\"placement.euler_xyz\": [(0, (0, 0, 0)), (8, (0, 90, 0))]",
    );
    let corner = "\"placement.position\": [(0, (0, 0, 0)), (4, (4, 0, 0)), (8, (4, 4, 0))]";
    let short = "open: 0, close: 0.5";
    for (shutter, keys, curve, frame, expected) in [
        (short, line, "Linear", 3.0, false),
        (short, line, "Linear", 99.0, false),
        ("open: -1e6, close: 1e6", line, "Linear", 3.0, true),
        ("open: 0, close: 1e-9", line, "Linear", 3.0, false),
        ("open: 0, close: 1e-15", line, "Linear", 3.0, false),
        ("open: 0, close: 0", turn, "Linear", 3.0, false),
        ("open: 0, close: 1e-9", turn, "Linear", 3.0, true),
        (short, turn, "Linear", 3.0, true),
        (short, turn, "Linear", -2.0, false),
        (short, turn, "Linear", 8.0, false),
        ("open: -0.25, close: 0.25", turn, "Linear", 8.0, true),
        (short, turn, "Step", 3.0, false),
        (short, turn, "Step", 7.75, true),
        (short, line, "Step", 3.0, false),
        (short, line, "Step", 7.75, true),
        (short, corner, "Linear", 3.0, false),
        ("open: -0.5, close: 0.5", corner, "Linear", 4.0, true),
        // From rest it is far from an even speed, later it is all but even.
        (short, line, "Smooth", 0.0, true),
        (short, line, "Smooth", 3.75, false),
        (short, "\"matte.colour\": [(0, (0, 0, 0)), (8, (1, 1, 1))]", "Linear", 3.0, true),
        (short, "\"sphere.radius\": [(0, 1), (8, 1)]", "Linear", 3.0, false),
    ] {
        let needed = scene(shutter, keys, curve).changes(frame, 1.0, 16).expect("keys");
        assert_eq!(needed, expected, "{shutter}, {keys}, {curve}, frame {frame}");
    }
    // The settings of the picture change from frame to frame, never within one; the shutter itself has keys.
    let own = file(
        "[(name: \"camera\", perspective_camera: (), shutter: (), sampling: (samples: 16), resolution: (width: 4, height: 4),
           keys: (values: {\"sampling.seed\": [(0, 0), (1, 9), (2, 5)], \"shutter.close\": [(0, 0), (2, 1)],
             \"resolution.width\": [(0, 4), (1, 8)]}, curve: Step))]",
    );
    assert_eq!([0.0, 1.0, 2.0].map(|frame| own.exposure_time(frame)), [Ok(0.0), Ok(0.0), Ok(1.0)]);
    assert_eq!([0.0, 1.0, 2.0].map(|frame| own.changes(frame, 1.0, 16)), [Ok(false), Ok(false), Ok(false)]);
}

/// Half of the time here, half there, and nowhere between.
#[test]
fn a_step_is_seen_on_both_sides_for_its_time() {
    let scene = "[(name: \"camera\", orthographic_camera: (view_height: 2), look_at: (eye: (0, 0, 5), target: (0, 0, 0)), \
          resolution: (width: 3, height: 1), sampling: (samples: 64, filter: Box(radius: 0.5)), shutter: (open: 0, close: 1)),
          (name: \"card\", rectangle: (width: 1.9, depth: 1.9), emissive: (radiance: (1, 1, 1)), placement: (euler_xyz: (90, 0, 0)), \
           keys: (values: {\"placement.position\": [(0, (-2, 0, 0)), (0.75, (2, 0, 0))]}, curve: Step))]";
    let film = of_file(scene, 0.0, 16, false);
    let seen = |at: usize| f64::from(film[at][0]);
    let full = 0.95 * 0.95;
    assert!((seen(0) / full - 0.75).abs() < 0.05 && (seen(2) / full - 0.25).abs() < 0.05 && seen(1) == 0.0, "{film:?}");
}

/// Passes, stops and the pauses between them change no bit, with paths from the lights and without.
#[test]
fn the_bits_do_not_depend_on_how_a_frame_is_cut() {
    for (light_tracing, moments) in [("", 16), ("light_tracing: (), ", 4), ("", 7)] {
        let scene = format!(
            "[(name: \"camera\", perspective_camera: (fov: 40), resolution: (width: 16, height: 9), sampling: (samples: 100), \
              integrator: Path(), {light_tracing} shutter: (open: 0, close: 1), look_at: (eye: (0, 1, 6), target: (0, 0.5, 0)), \
              keys: (values: {{\"perspective_camera.fov\": [(0, 40), (1, 50)]}})),
              (name: \"ball\", sphere: (radius: 0.5), glass: (), placement: (position: (0, 0.6, 0))), \
              (name: \"floor\", plane: (), matte: ()), \
              (name: \"lamp\", sphere: (radius: 0.3), emissive: (radiance: (9, 9, 9)), placement: (position: (0, 3, 0)), \
               keys: (values: {{\"emissive.radiance\": [(0, (1, 1, 1)), (1, (20, 20, 20))]}}))]"
        );
        let scene = file(&scene);
        let all: Vec<Vec<[f32; 3]>> = [1000, 1, 5, 33]
            .into_iter()
            .map(|pause| {
                let scene = scene.clone();
                means(
                    move |number, of| scene.at_moment(0.0, 1.0, [number, of], true).expect("keys").world(),
                    moments,
                    pause,
                )
            })
            .collect();
        assert!(all.windows(2).all(|pair| pair[0] == pair[1]), "{light_tracing}{moments}");
        assert!(mean_of(&all[0]) > 0.0);
    }
}

/// A triangle that turns about the z axis by half a turn in a second, by its node's rotation.
fn turning_model(folder: &Path) {
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let numbers: [f32; 24] =
        [0., 0., 0., 3., -0.4, 0., 3., 0.4, 0., 0., 0.5, 1., 0., 0., 0., 1., 0., 0., half, half, 0., 0., 1., 0.];
    let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    fs::write(folder.join("a.bin"), bytes).expect("written");
    let text = "{'asset':{'version':'2.0'},'buffers':[{'byteLength':96,'uri':'a.bin'}],
        'bufferViews':[{'buffer':0,'byteLength':36},{'buffer':0,'byteOffset':36,'byteLength':12},
            {'buffer':0,'byteOffset':48,'byteLength':48}],
        'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3','min':[0,-0.4,0],'max':[3,0.4,0]},
            {'bufferView':1,'componentType':5126,'count':3,'type':'SCALAR','min':[0],'max':[1]},
            {'bufferView':2,'componentType':5126,'count':3,'type':'VEC4'}],
        'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],'nodes':[{'mesh':0}],
        'animations':[{'samplers':[{'input':1,'output':2}],
            'channels':[{'sampler':0,'target':{'node':0,'path':'rotation'}}]}]}";
    fs::write(folder.join("a.gltf"), text.replace('\'', "\"")).expect("written");
}

#[test]
fn a_model_whose_node_turns_is_blurred_and_one_at_rest_is_not() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    turning_model(folder.path());
    let model = ModelScene { shutter: 0.5, ..ModelScene::open(&folder.path().join("a.gltf")).expect("read") };
    let at = |seconds: f64| {
        let mut world = ModelScene { seconds: Some(seconds), ..model.clone() }.world();
        Overrides { size: Some(pinhole::Size::Width(48)), ..Overrides::default() }.put_on_camera(&mut world);
        world
    };
    assert!(pinhole::scene::animates_after(&at(0.0), 0.5) && !pinhole::scene::animates_after(&at(0.0), 1.0));
    // The picture is the mean of those of its moments, each with its own samples.
    let scenes = |number: u32, of: u32| {
        let own = model.clone();
        move |part: u32, parts: u32| {
            let moment = f64::from(number) + (f64::from(part) + 0.5) / f64::from(parts);
            let mut world = ModelScene { seconds: Some(0.5 * moment / f64::from(of)), ..own.clone() }.world();
            Overrides { size: Some(pinhole::Size::Width(48)), ..Overrides::default() }.put_on_camera(&mut world);
            world
        }
    };
    let blurred = means(scenes(0, 1), 16, 1000);
    let parts: Vec<Vec<[f32; 3]>> = (0..16).map(|number| means(scenes(number, 16), 1, 1000)).collect();
    let apart = (0..blurred.len()).map(|at| {
        let mean = parts.iter().map(|part| f64::from(part[at][0])).sum::<f64>() / 16.0;
        (mean - f64::from(blurred[at][0])).powi(2)
    });
    let apart = (apart.sum::<f64>() / blurred.len() as f64).sqrt();
    let still = (0..blurred.len()).map(|at| f64::from(parts[0][at][0] - blurred[at][0]).powi(2)).sum::<f64>();
    let still = (still / blurred.len() as f64).sqrt();
    assert!(apart < 0.25 * still, "from the mean of the moments {apart}, from the first {still}");

    // And by the program.
    let words = |more: &[&'static str]| {
        [&["render", "a.gltf", "--frames", "0..0", "--width", "48", "-o", "f.png"], more].concat()
    };
    let rendered = |more: &[&'static str]| {
        let done = run(folder.path(), &words(more));
        assert!(done.status.success(), "{}", text(&done.stderr));
        fs::read(folder.path().join("f_0000.png")).expect("a frame")
    };
    let still = rendered(&[]);
    let moving = rendered(&["--set", "shutter=0.5"]);
    let pixels = |bytes: &[u8]| image::load_from_memory(bytes).expect("a PNG");
    assert!(pixels(&still) != pixels(&moving));
    assert!(pixels(&still) == pixels(&rendered(&["--set", "shutter=0.5", "--moments", "1"])));
    assert!(text_of(&moving).contains("Moments\u{0}16") && !text_of(&still).contains("Moments\u{0}"));
    for bad in ["shutter=-1", "shutter=NaN", "shutter=long"] {
        let done = run(folder.path(), &["render", "a.gltf", "--frames", "0..0", "--set", bad]);
        assert!(text(&done.stderr).contains("a time in seconds from 0 to 1e6"), "{}", text(&done.stderr));
    }
}

fn text_of(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| char::from(*byte)).collect()
}

const WHEEL: &str = r#"[
    (name: "camera", perspective_camera: (fov: 40), resolution: (width: 48, height: 27), sampling: (samples: 20),
     shutter: (open: 0, close: 0.03125), look_at: (eye: (0, 1, 6), target: (0, 0.5, 0))),
    (name: "wheel", cuboid: (size: (2, 0.4, 0.4)), placement: (position: (0, 0.8, 0)), matte: (colour: (0.8, 0.2, 0.1)),
     keys: (values: {"placement.euler_xyz": [(0, (0, 0, 0)), (4, (0, 0, 360))]})),
    (name: "floor", plane: (), checker: (), matte: ()),
    (name: "lamp", point_light: (intensity: (9, 9, 9)), placement: (position: (0, 3, 1)),
     keys: (values: {"placement.position": [(0, (-2, 3, 1)), (4, (2, 3, 1))]})),
]"#;

const ALL: [&str; 6] = ["render", "a.ron", "--frames", "0..4", "-o", "f.png"];

fn pictures(folder: &Path) -> Vec<Vec<u8>> {
    (0..=4).map(|frame| fs::read(folder.join(format!("f_{frame:04}.png"))).expect("a frame")).collect()
}

#[test]
fn a_film_of_moments_has_the_same_bits_in_one_go_in_parts_and_after_kills() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("a.ron"), WHEEL).expect("written");
    let done = run(folder.path(), &ALL);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let expected = pictures(folder.path());
    // 20 samples at 16 moments: each has one or two. The last frame is at rest, and costs nothing.
    let said: Vec<bool> = expected.iter().map(|picture| text_of(picture).contains("Moments\u{0}16")).collect();
    assert_eq!(said, [true, true, true, true, false]);
    let again = run(folder.path(), &[&ALL[..], &["--resume"]].concat());
    assert_eq!(text(&again.stderr).matches("is done").count(), 5, "{}", text(&again.stderr));
    // Other moments or other samples make other pictures, of which nothing is done.
    for other in [["--moments", "5"], ["--samples", "32"]] {
        let others = run(folder.path(), &[&ALL[..], &["--resume"], &other[..]].concat());
        assert!(text(&others.stderr).contains("render without --resume to start over"), "{}", text(&others.stderr));
    }
    let others = run(folder.path(), &[&ALL[..], &["--moments", "5"]].concat());
    assert!(others.status.success(), "{}", text(&others.stderr));
    for (frame, (other, own)) in pictures(folder.path()).iter().zip(&expected).enumerate() {
        let [other, own] = [other, own].map(|picture| image::load_from_memory(picture).expect("a PNG"));
        assert_eq!(other == own, frame == 4, "frame {frame}");
    }

    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("a.ron"), WHEEL).expect("written");
    let done = run(folder.path(), &[&ALL[..], &["--part", "2/2"]].concat());
    assert!(done.status.success(), "{}", text(&done.stderr));
    let own = [&ALL[..], &["--part", "1/2", "--resume", "--write-every", "1ms", "-j", "1"]].concat();
    let stops = killed(folder.path(), &own);
    let done = run(folder.path(), &own);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert!(pictures(folder.path()) == expected);
    eprintln!("moments: 5 frames the same in one go, in 2 parts and after {stops} kills");
}

/// A frame in which only straight lines are drawn has the bits that it had before there were moments.
#[test]
fn a_film_that_needs_no_moments_has_none() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let scene = WHEEL.replace(
        "\"placement.euler_xyz\": [(0, (0, 0, 0)), (4, (0, 0, 360))]",
        "\"placement.position\": [(0, (0, 1, 0)), (4, (1, 1, 0))]",
    );
    let scene = scene.replace("(-2, 3, 1)", "(2, 3, 1)");
    fs::write(folder.path().join("a.ron"), scene).expect("written");
    let rendered = |more: &[&'static str]| {
        let done = run(folder.path(), &[&ALL[..], more].concat());
        assert!(done.status.success(), "{}", text(&done.stderr));
        pictures(folder.path())
    };
    let (own, without) = (rendered(&[]), rendered(&["--moments", "1"]));
    let pixels = |bytes: &Vec<u8>| image::load_from_memory(bytes).expect("a PNG");
    assert!(own.iter().zip(&without).all(|(one, other)| pixels(one) == pixels(other)));
    assert!(own.iter().all(|picture| !text_of(picture).contains("Moments\u{0}")));
}

#[test]
fn what_does_not_go_together_is_refused_in_a_sentence() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("a.ron"), WHEEL).expect("written");
    for (words, because) in [
        (&["--moments", "0"][..], "a number of moments is a whole number from 1"),
        (&["--moments", "-1"], "a number of moments is a whole number from 1"),
        (&["--moments", "many"], "a number of moments is a whole number from 1"),
        (&["--moments", "1.5"], "a number of moments is a whole number from 1"),
        (&["--error", "0.1"], "the mean of moments, which have equal numbers of samples"),
        // A light may only be elsewhere from moment to moment.
        (&["--moments", "1"], "no light"),
    ] {
        let done = run(folder.path(), &[&ALL[..], words].concat());
        let said = text(&done.stderr);
        assert!(!done.status.success() && said.contains(because), "{words:?}: {said}");
    }
    let alone = run(folder.path(), &["render", "a.ron", "--moments", "4"]);
    assert!(text(&alone.stderr).contains("--frames"), "{}", text(&alone.stderr));
    // More moments than samples are as many as samples; layers, the denoiser and a crop work as ever.
    for more in [
        &["--moments", "64k"][..],
        &["--moments", "1000"],
        &["--layers", "all", "-o", "f.exr"],
        &["--denoise"],
        &["--crop", "8,8,16,9"],
        &["--samples", "1"],
        &["--view", "hit"],
    ] {
        let words = [&["render", "a.ron", "--frames", "1..1", "-o", "f.exr"], more].concat();
        let done = run(folder.path(), &words);
        let refused = more.contains(&"64k");
        assert_eq!(done.status.success(), !refused, "{more:?}: {}", text(&done.stderr));
        if !refused {
            let bytes = text_of(&fs::read(folder.path().join("f_0001.exr")).expect("a frame"));
            let expected = if more.contains(&"--samples") {
                "none"
            } else if more.contains(&"1000") {
                "20"
            } else {
                "16"
            };
            let said = bytes.find("moments\u{0}string").map(|at| bytes[at + 19..at + 21].to_owned());
            assert_eq!(said.unwrap_or("none".into()), expected, "{more:?}");
        }
    }
}

/// The shutter from no time to a million units.
#[test]
fn shutters_of_any_length_are_rendered() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (close, has_moments) in [("0", false), ("1e-9", true), ("0.02", true), ("1e6", true)] {
        let scene = WHEEL.replace("close: 0.03125", &format!("close: {close}"));
        fs::write(folder.path().join("a.ron"), scene).expect("written");
        let done = run(folder.path(), &["render", "a.ron", "--frames", "1..1", "-o", "f.png"]);
        assert!(done.status.success(), "{close}: {}", text(&done.stderr));
        let picture = fs::read(folder.path().join("f_0001.png")).expect("a frame");
        assert_eq!(text_of(&picture).contains("Moments\u{0}16"), has_moments, "{close}");
    }
}
