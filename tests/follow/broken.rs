//! Each chapter's mistake, measured where theory knows the answer: it must show, and by far.

use super::*;
use glam::DVec3;
use pinhole::film::{Curve, byte_from_linear};
use pinhole::material::cosine_direction;
use pinhole::plan::{Plan, Stage};
use pinhole::scene::Glass;
use pinhole_lab::measure::closed_form::{ClosedForm, every_stage};
use pinhole_lab::naive::lens::radius_at_random;
use pinhole_lab::naive::mistake::*;
use pinhole_lab::naive::path::{uniform_direction, weight_without_cosine, weight_without_pi};

/// From so many standard errors on a mistake counts as seen.
const SEEN: f64 = 10.0;

fn form(name: &str) -> &'static ClosedForm {
    closed_forms().find(|form| form.name == name).expect("a closed form of this name")
}

/// The stage in the place of those that stand where it stands.
fn instead(stage: Stage) -> Vec<Stage> {
    let mut stages = every_stage();
    stages.retain(|other| other.set != stage.set || stage.name.starts_with("Forget"));
    stages.push(stage);
    stages
}

/// How far off a closed form is by these stages, in standard errors; it must be the same scene as without a mistake.
fn off(name: &str, stages: &[Stage]) -> f64 {
    let form = form(name);
    let truth = (form.truth)();
    let measured = form.measure_by(stages, form.few, 5).expect("measured");
    let off = measured.deviation(truth);
    eprintln!("  {name}: {:.4} ± {:.4} for {truth:.4}: {off:+.0}", measured.mean, measured.standard_error);
    off
}

#[test]
fn mistakes_are_noticed_where_theory_knows_the_answer() {
    let alike = |u| DVec3::from(uniform_direction(u));
    let matte = |direction, weight| instead(scatter_matte_by(MatteSample { direction, weight }));
    let pentagon = "pentagon of triangles, BSDF sampling";
    let mistakes: Vec<(&str, &str, Vec<Stage>)> = vec![
        ("19, the wrong pdf", "rough metal, α = 1, seen along its normal", instead(metal_counted_as_matte())),
        ("20, beams kept narrow", "light through a pane, normal incidence", instead(glass_that_keeps_beams_narrow())),
        ("21, the light's cosine", "square light overhead, light sampling", instead(light_without_cosine())),
        ("21, the Jacobian", "square light overhead, light sampling", instead(light_without_jacobian())),
        ("22, the missing cosine", "sky past a ball overhead", instead(sky_in_all_directions_alike())),
        (
            "23, a random radius",
            "a coin in the circle of confusion, behind",
            instead(opening_filled_by(radius_at_random)),
        ),
        ("24, four moments", "an edge comes to a point and stays", instead(moments_in_turn(4))),
        ("25, the missing cosine", pentagon, matte(alike, |albedo, _| weight_without_cosine(albedo))),
        ("25, the forgotten π", pentagon, matte(cosine_direction, |albedo, _| weight_without_pi(albedo))),
        ("25, the wrong pdf", pentagon, matte(alike, |albedo, _| albedo)),
        ("25, the cosine twice", pentagon, matte(cosine_direction, |albedo, cosine| albedo * cosine)),
        ("26, counted in full", "square light overhead, MIS", instead(light_samples_counted_in_full())),
    ];
    let tried = mistakes.len();
    for (what, name, stages) in mistakes {
        eprintln!("{what}");
        let off = off(name, &stages);
        assert!(off.abs() > SEEN, "{what} is {off} standard errors off");
        assert!(self::off(name, &every_stage()).abs() <= 4.0, "{name} without the mistake");
    }
    // η upside down is the same as glass thinner than air.
    let upside_down = ClosedForm {
        scene: |world| {
            (form("a pane at 60° shifts an edge, once through").scene)(world);
            world.query::<&mut Glass>().iter_mut(world).for_each(|mut glass| glass.ior = 1.0 / glass.ior);
        },
        ..*form("a pane at 60° shifts an edge, once through")
    };
    let truth = (upside_down.truth)();
    let measured = upside_down.measure(upside_down.few, 5).expect("measured");
    assert!(measured.deviation(truth).abs() > SEEN, "20, η upside down: {}", measured.mean);
    eprintln!("broken: {} mistakes, each more than {SEEN} standard errors off", tried + 1);
}

/// A stage with a mistake must be in the plan, or a picture of it shows nothing wrong.
#[test]
fn mistakes_are_kept_by_the_plan() {
    let kept = |plan: &Plan, name: &str| plan.rows.iter().any(|row| row.stage == name && row.kept);
    for (chapter, stage) in [
        ("19_mirrors", metal_counted_as_matte()),
        ("20_glass", glass_that_keeps_beams_narrow()),
        ("22_ambient_occlusion", sky_in_all_directions_alike()),
        ("26_choosing_samples", light_samples_counted_in_full()),
    ] {
        let scene = chapters::all().into_iter().find(|own| own.name == chapter).expect("a chapter");
        let name = stage.name;
        let plan =
            pinhole::plan::plan(&Census::of(&scene.world(&Overrides::default())), &instead(stage)).expect("plans");
        assert!(kept(&plan, name), "{chapter}: {name}");
    }
}

/// Encoded twice, no grey comes back from its byte as it went in, but for black and white.
#[test]
fn gamma_twice_is_noticed() {
    let decoded = |byte: u8| pinhole::film::linear_from_srgb(f64::from(byte) / 255.0);
    let (mut once, mut twice) = (0.0_f64, f64::INFINITY);
    for step in 1..=16 {
        let light = f64::from(step) / 20.0;
        let byte = byte_from_linear(light as f32, Curve::Srgb);
        let again = byte_from_linear(f32::from(byte) / 255.0, Curve::Srgb);
        once = once.max((decoded(byte) - light).abs());
        twice = twice.min((decoded(again) - light).abs());
    }
    eprintln!("gamma: once at most {once:.4} off, twice at least {twice:.4}");
    assert!(twice > SEEN * once, "{once}, {twice}");
}
