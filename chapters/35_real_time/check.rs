//! Chapter 35: how much a neighbouring pixel counts for the filter.

use glam::DVec3;
use pinhole::Overrides;
use pinhole::extract::camera_entity;
use pinhole::film::{GUIDES, Guides, denoise};
use pinhole::render::{Execution, render};
use pinhole::scene::{Layers, Sampling};
use pinhole_lab::exercise::apart::absolute;
use pinhole_lab::exercise::{
    Ask, Exercise, Mistakes, Part, Probe, Question, Setting, Shown, StandIn, extremes, probes,
};
use pinhole_lab::measure::draws::Draws;
use pinhole_lab::naive::denoise::{LEVELS, denoised, edge_weight, image_of};

/// The normal, the neighbour's, the offset to it.
type Input = ([f64; 3], [f64; 3], [f64; 3]);

/// What the reader writes.
pub type Yours = fn([f64; 3], [f64; 3], [f64; 3]) -> f64;

/// The exercise with this function in it.
pub fn exercise(yours: Yours) -> Exercise {
    let written = move |&(normal, neighbour, offset): &Input| yours(normal, neighbour, offset);
    Exercise::rendered("edge_weight", question, written, mine).and_in("angles; down: off a plane", |_| ())
}

fn question() -> Question<Input, f64> {
    Question {
        pinhole_has: ("src/pinhole/film/denoise.rs", "smooth_row"),
        probes: asked(),
        tell: |(normal, neighbour, offset)| {
            let [normal, neighbour, offset] = [normal, neighbour, offset].map(Shown::shown);
            format!("normal {normal}, neighbour {neighbour}, offset {offset}")
        },
        right: |input| {
            let [normal, neighbour, offset] = vectors(input);
            edge_weight(normal, neighbour, offset)
        },
        apart: |yours, right| absolute(&[*yours], &[*right]),
        allowed: 1e-9,
        measured: "of the weight",
        mistakes: mistakes(),
        hints: &[
            "the cosine of the angle between unit vectors is their dot product; below 0 the surfaces face away",
            "the 32nd power is five squarings, one after the other",
            "how far is the neighbour from the plane, and how far from the point? their quotient is the sine",
        ],
    }
}

fn mistakes() -> Mistakes<Input, f64> {
    let facing = Part::<Input, f64>::new(normals)
        .say(
            "surfaces that face away count: 32 is even, so a negative cosine has a positive power; make it 0 \
                 first",
        )
        .when(|i| power(cosine(i)))
        .say("only the plane counts: faces that meet at an edge are mixed along it")
        .when(|_| 1.0)
        .say("the cosine lacks its 32nd power")
        .when(|i| cosine(i).max(0.0))
        .say("the power is not the 32nd: five squarings make it")
        .when(|i| cosine(i).max(0.0).powi(2))
        .when(|i| cosine(i).max(0.0).powi(5))
        .when(|i| cosine(i).max(0.0).powi(16))
        .when(|i| cosine(i).max(0.0).powi(31))
        .when(|i| cosine(i).max(0.0).powi(33))
        .when(|i| cosine(i).max(0.0).powi(64));
    let near = Part::<Input, f64>::new(plane)
        .say("an offset of length 0 divides by 0: two pixels may show the same point, which lies in the plane")
        .when(|i| if length(i) == 0.0 { f64::NAN } else { plane(i) })
        .say("the same point lies in the plane: s is 0, and the normals alone count")
        .when(|i| if length(i) == 0.0 { 0.0 } else { plane(i) })
        .when(|i| if length(i) == 0.0 { 1.0 / normals(i) } else { plane(i) })
        .say(
            "the distance from the plane is not divided by the offset's length: the weight then depends on the \
                 scene's units",
        )
        .when(|i| falloff(across(i)))
        .say(
            "the distance from the plane is divided by the offset's length squared: divide once, or square the \
                 distance, too",
        )
        .when(|i| falloff(across(i) / length(i).powi(2)))
        .say(
            "the distance from the plane is not squared, but the offset's length is: s² is (normal · offset)² \
                 over it",
        )
        .when(|i| 0.01 / (0.01 + across(i).abs() / length(i).powi(2)))
        .say("s² is (normal · offset)² over the offset's length squared, not over the length")
        .when(|i| 0.01 / (0.01 + across(i).powi(2) / length(i)))
        .say("it is the neighbour's plane: take the one across the pixel's own normal")
        .when(|&(normal, neighbour, offset)| plane(&(neighbour, normal, offset)))
        .say("only the normals count: light is carried across every step between parallel faces")
        .when(|_| 1.0)
        .say("the sine is not squared: at 0.1 the weight must be one half")
        .when(|i| 0.01 / (0.01 + sine(i).abs()))
        .when(|i| 0.01 / (0.01 + sine(i)))
        .say("what lies below the plane counts in full; the sine is squared, so its sign makes no difference")
        .when(|i| falloff(sine(i).max(0.0)))
        .say(
            "that is the angle to the normal; s is the sine of the angle to the plane, normal · offset over \
                 the length",
        )
        .when(|i| falloff(libm::acos(sine(i).clamp(-1.0, 1.0))))
        .say("s is taken for an angle; it is the sine itself")
        .when(|i| falloff(libm::asin(sine(i).clamp(-1.0, 1.0))))
        .say("the plane's factor lacks its 0.01 above the line: in the plane it is 1")
        .when(|i| 1.0 / (0.01 + sine(i).powi(2)))
        .say("0.1 is taken for 0.01: a sine of 0.1 makes one half")
        .when(|i| 0.1 / (0.1 + sine(i).powi(2)))
        .when(|i| 0.01 / (0.1 + sine(i).powi(2)))
        .say("brackets are missing: it is 0.01 / (0.01 + s²)")
        .when(|i| 1.0 + sine(i).powi(2))
        .say("the plane's factor is upside down: it is 1 in the plane, and less off it")
        .when(|i| 1.0 - plane(i))
        .say("that is the cosine, the part along the plane; what must be small is the part across it")
        .when(|i| 0.01 / (0.01 + (1.0 - sine(i) * sine(i))))
        .when(|i| 0.01 / (0.01 + if length(i) == 0.0 { 0.0 } else { 1.0 - sine(i).powi(2) }));
    let whole = Part::<[f64; 2], f64>::new(|[facing, near]| facing * near)
        .say("the factors are added; they are to be multiplied")
        .when(|[facing, near]| facing + near)
        .say("the mean of the factors is taken; they are to be multiplied")
        .when(|[facing, near]| 0.5 * (facing + near))
        .say("the smaller factor is taken; they are to be multiplied")
        .when(|[facing, near]| facing.min(*near));
    Mistakes::<Input, f64>::new()
        .say("the plane is taken across the mean of both normals; it is across the pixel's own")
        .when(|i| {
            let [normal, neighbour, offset] = vectors(i);
            normals(i) * falloff((normal + neighbour).normalize_or_zero().dot(offset.normalize_or_zero()))
        })
        .say("an exponential is taken for the quotient: it is 0.01 / (0.01 + s²)")
        .when(|i| normals(i) * libm::exp(-sine(i) * sine(i) / 0.01))
        .say("the cosine is multiplied by 32; it is raised to the 32nd power")
        .when(|i| 32.0 * cosine(i).max(0.0) * plane(i))
        .say("both factors are raised to the 32nd power; only the cosine is")
        .when(|i| power(cosine(i).max(0.0) * plane(i)))
        .say("the plane's factor is raised to the 32nd power instead of the cosine")
        .when(|i| cosine(i).max(0.0) * power(plane(i)))
        .say("brackets are missing: it is 0.01 / (0.01 + s²)")
        .when(|i| normals(i) + sine(i).powi(2))
        .of_parts([facing, near], whole)
}

fn vectors(&(normal, neighbour, offset): &Input) -> [DVec3; 3] {
    [normal, neighbour, offset].map(DVec3::from)
}

/// The 32nd power.
fn power(cosine: f64) -> f64 {
    (0..5).fold(cosine, |power, _| power * power)
}

fn cosine(input: &Input) -> f64 {
    let [normal, neighbour, _] = vectors(input);
    normal.dot(neighbour)
}

/// How far the neighbour is from the plane.
fn across(input: &Input) -> f64 {
    let [normal, _, offset] = vectors(input);
    normal.dot(offset)
}

fn length(input: &Input) -> f64 {
    vectors(input)[2].length()
}

fn falloff(sine: f64) -> f64 {
    0.01 / (0.01 + sine * sine)
}

fn sine(input: &Input) -> f64 {
    let [normal, _, offset] = vectors(input);
    normal.dot(offset.normalize_or_zero())
}

/// The factor of the normals.
fn normals(input: &Input) -> f64 {
    power(cosine(input).max(0.0))
}

/// The factor of the plane.
fn plane(input: &Input) -> f64 {
    falloff(sine(input))
}

fn asked() -> Vec<Probe<Input>> {
    const UP: [f64; 3] = [0.0, 1.0, 0.0];
    let tilted = |degrees: f64| [libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians()), 0.0];
    let mut asked: Vec<_> = probes("a neighbour on the same floor", [(UP, UP, [0.3, 0.0, 0.4])]).collect();
    asked.extend(probes(
        "a step up",
        [(UP, UP, [0.3, 0.3, 0.0]), (UP, UP, [0.3, 0.03, 0.0]), (UP, UP, [0.03, 0.003, 0.0])],
    ));
    asked.extend(probes(
        "another normal in the plane",
        [5.0, 15.0, 40.0].map(|degrees| (UP, tilted(degrees), [0.0, 0.0, 0.2])),
    ));
    asked.extend(probes(
        "two faces of an edge",
        [(UP, tilted(20.0), [0.3, -0.05, 0.0]), (UP, tilted(30.0), [0.3, -0.08, 0.1])],
    ));
    asked.extend(probes(
        "faces that look away",
        [(UP, [0.0, -1.0, 0.0], [0.2, 0.0, 0.0]), (UP, tilted(170.0), [0.1, 0.0, 0.3])],
    ));
    asked.extend(probes("straight off the plane", [(UP, UP, [0.0, 2.0, 0.0]), (UP, UP, [0.0, -0.001, 0.0])]));
    asked.extend(probes("anything", (0..200).map(drawn)));
    asked.extend(extremes("the same point", [(UP, UP, [0.0; 3]), (UP, tilted(10.0), [0.0; 3])]));
    asked
}

/// Normals that differ a little or a lot, an offset near the plane or not, in scenes of any size.
fn drawn(index: u64) -> Input {
    let mut draws = Draws::new(3501, index);
    let normal = draws.unit_vector();
    let other = (normal + draws.unit_vector() * draws.between(0.0, 1.6)).normalize();
    let across = draws.unit_vector_across(normal);
    let offset = (across + normal * draws.between(-0.3, 0.3)) * draws.power_of_ten(-3.0, 3.0);
    (normal.into(), other.into(), offset.into())
}

/// The picture through the filter, each neighbour counted as the reader's function says.
fn mine(ask: Ask<Input, f64>, setting: &Setting<'_>) -> StandIn {
    if setting.number == 1 {
        return painted(ask);
    }
    StandIn::film(smoothed(&ask, setting), setting.resolution().width)
}

/// The chapter's own film, smoothed in plain code; none where the function cannot answer, or nothing is rendered.
fn smoothed(ask: &Ask<Input, f64>, setting: &Setting<'_>) -> Option<Vec<[f32; 3]>> {
    // The same scene again, with the layers that guide the filter.
    let layers = Some(Layers { kinds: GUIDES.to_vec() });
    let asked = Overrides { resolution: Some(setting.resolution()), layers, ..Overrides::default() };
    let mut scene = setting.chapter.world(&asked);
    if let (Ok(camera), Some(sampling)) = (camera_entity(&scene), setting.camera::<Sampling>()) {
        scene.entity_mut(camera).insert(*sampling);
    }
    let rendered = render(&scene, &setting.chapter.stages(), &Execution::default(), &());
    let film = rendered.map_err(|error| ask.complain(error.to_string())).ok()?.film;
    let guides = Guides::of(&film)?;
    // Without levels the denoiser leaves a film as it is.
    let image = image_of(&denoise(&film, 0)?, &guides);
    let smooth = denoised(image, LEVELS, |own, other| {
        // The sky has no surface.
        if own.normal == DVec3::ZERO || other.normal == DVec3::ZERO {
            return 0.0;
        }
        let offset = other.position - own.position;
        ask.once((own.normal.into(), other.normal.into(), offset.into())).unwrap_or(0.0)
    });
    let albedo = |at: usize| guides.albedo.each_ref().map(|part| part[at]);
    let light = |(at, light): (usize, DVec3)| [0, 1, 2].map(|part| light[part] as f32 * albedo(at)[part]);
    Some(smooth.pixels.iter().map(|pixel| pixel.light).enumerate().map(light).collect())
}

/// Neighbours whose normals are turned ever farther from left to right, and which lie ever farther out of the plane
/// downward.
fn painted(ask: Ask<Input, f64>) -> StandIn {
    StandIn::painted([64, 32], move |[x, y]| {
        let [turned, out] = [(x, 64.0), (y, 64.0)].map(|(at, of)| (f64::from(at) + 0.5) / of * std::f64::consts::PI);
        let neighbour = [libm::sin(turned), 0.0, libm::cos(turned)];
        let offset = [0.2 * libm::cos(out), 0.0, 0.2 * libm::sin(out)];
        [ask.once(([0.0, 0.0, 1.0], neighbour, offset)).unwrap_or_default(); 3]
    })
}
