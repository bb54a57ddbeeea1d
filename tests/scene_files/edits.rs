//! A chapter exported and edited as a person would: what must change changes, and nothing else does.

use super::typed;
use crate::scenes;
use glam::DVec3;
use pinhole::Overrides;
use pinhole::scene::{LookAt, Resolution, SceneFile};
use std::path::Path;

/// Where a picture may differ, in parts of its width and height: x from, x to, y from, y to.
type Region = [f64; 4];
const NOWHERE: Region = [1.0, 0.0, 1.0, 0.0];
const ANYWHERE: Region = [0.0, 1.0, 0.0, 1.0];
const FAR_RIGHT: Region = [0.6, 1.0, 0.0, 1.0];

type Edit = (&'static str, Region, fn(&str) -> String);

fn swap(text: &str, from: &str, to: &str) -> String {
    assert_eq!(text.matches(from).count(), 1, "{from} stands once in\n{text}");
    text.replace(from, to)
}

/// The lines of the entity of this name, with what comes before and after it.
fn around<'t>(text: &'t str, name: &str) -> [&'t str; 3] {
    let named = text.find(&format!("name: \"{name}\"")).expect("the entity is there");
    let start = text[..named].rfind("    (").expect("it begins");
    let end =
        named + text[named..].find("),\n    (").unwrap_or_else(|| text[named..].rfind("),\n]").expect("it ends")) + 3;
    [&text[..start], &text[start..end], &text[end..]]
}

fn add(text: &str, entity: &str) -> String {
    format!("{}    {entity},\n]\n", text.trim_end().strip_suffix(']').expect("a list"))
}

const EDITS: [Edit; 20] = [
    ("nothing", NOWHERE, |t| t.into()),
    ("the far ball moved", FAR_RIGHT, |t| swap(t, "(2.3, 0.8, -2.0)", "(2.3, 1.4, -2.0)")),
    ("the far ball in another colour", FAR_RIGHT, |t| swap(t, "(0.25, 0.5, 0.75)", "(0.75, 0.5, 0.25)")),
    ("the far ball larger", FAR_RIGHT, |t| {
        let [before, ball, after] = around(t, "far ball");
        format!("{before}{}{after}", swap(ball, "radius: 0.8", "radius: 0.9"))
    }),
    ("the far ball away", FAR_RIGHT, |t| {
        let [before, _, after] = around(t, "far ball");
        format!("{before}{after}")
    }),
    ("the far ball disabled", FAR_RIGHT, |t| swap(t, "name: \"far ball\"", "name: \"far ball\", disabled: true")),
    ("a ball added far right", FAR_RIGHT, |t| {
        add(t, "(name: \"new\", sphere: (radius: 0.3), placement: (position: (2.6, 0.3, 0.5)), matte: ())")
    }),
    ("a ball added behind the eye", NOWHERE, |t| {
        add(t, "(name: \"new\", sphere: (), placement: (position: (0, 0, 50)), matte: ())")
    }),
    ("renamed", NOWHERE, |t| swap(t, "\"far ball\"", "\"marble, blue\"")),
    ("names taken away", NOWHERE, |t| {
        let lines = t.lines().filter(|line| !line.trim_start().starts_with("name:"));
        lines.collect::<Vec<_>>().join("\n").replace("(name: \"ground\", ", "(").replace("(name: \"night\", ", "(")
    }),
    ("comments", NOWHERE, |t| format!("/* mine */ {}// the end", t.replace("),\n    (", "), // one /* \" */\n    ("))),
    ("words in another order", NOWHERE, |t| {
        swap(
            t,
            "        name: \"far ball\",\n        sphere: (radius: 0.8),",
            "        sphere: (radius: 0.8),\n        name: \"far ball\",",
        )
    }),
    ("fields in another order", NOWHERE, |t| {
        swap(t, "eye: (0.0, 2.6, 6.0), target: (0.0, 0.8, 0.0)", "target: (0.0, 0.8, 0.0), eye: (0.0, 2.6, 6.0)")
    }),
    ("numbers written otherwise", NOWHERE, |t| t.replace("0.0,", "0,").replace("95.0", "9.5e1").replace("0.25", ".25")),
    ("all on one line", NOWHERE, |t| t.lines().filter(|line| !line.starts_with("//")).map(str::trim).collect()),
    ("a smaller angle", ANYWHERE, |t| swap(t, "fov: 40.0", "fov: 35.0")),
    ("the angle across the other axis", ANYWHERE, |t| swap(t, "Vertical", "Horizontal")),
    ("no shadows", ANYWHERE, |t| swap(t, "casts_shadows: true", "casts_shadows: false")),
    ("a shared material", FAR_RIGHT, |t| {
        add(
            &swap(t, "matte: (colour: (0.25, 0.5, 0.75))", "material: \"gold\""),
            "(name: \"gold\", matte: (colour: (0.9, 0.7, 0.2)))",
        )
    }),
    ("the far ball on a parent", FAR_RIGHT, |t| {
        let t = swap(t, "name: \"far ball\",", "name: \"far ball\", parent: \"lift\",");
        add(&t, "(name: \"lift\", placement: (position: (0, 0.5, 0)))")
    }),
];

const SIZE: Resolution = Resolution { width: 96, height: 54 };

fn film(text: &str, what: &str) -> scenes::FilmBits {
    let file = SceneFile::parse(Path::new("scene.ron"), text.into())
        .unwrap_or_else(|mistake| panic!("{what}: {mistake}\n{text}"));
    let mut world = file.world();
    Overrides { resolution: Some(SIZE), ..Overrides::default() }.put_on_camera(&mut world);
    scenes::film(&world)
}

#[test]
fn twenty_edits_change_what_they_must_and_nothing_else() {
    let text = typed(&["export", "05_pinhole"]).expect("exported");
    let before = film(&text, "the chapter");
    for (what, [x0, x1, y0, y1], edit) in EDITS {
        let after = film(&edit(&text), what);
        let mut changed = 0;
        for (at, (one, other)) in before.pixels.iter().zip(&after.pixels).enumerate() {
            if one == other {
                continue;
            }
            changed += 1;
            let (x, y) = (at % SIZE.width as usize, at / SIZE.width as usize);
            let [u, v] = [x as f64 / f64::from(SIZE.width), y as f64 / f64::from(SIZE.height)];
            assert!(x0 <= u && u <= x1 && y0 <= v && v <= y1, "{what}: pixel {x},{y} changed too");
        }
        assert_eq!(changed > 0, x0 < x1, "{what}: {changed} pixels changed");
        eprintln!("{changed:>5} pixels: {what}");
    }
    eprintln!("edits: {} rendered", EDITS.len());
}

/// What `--set` does to the text is what a person would do by hand.
#[test]
fn a_value_is_set_by_the_path_to_it() {
    let text = "[(name: \"camera\", perspective_camera: (fov: 45.0), look_at: (eye: (0.0, 1.0, 4.0), target: (0.0, 1.0, \
                0.0)), integrator: RayCasting), (name: \"ball 1.5\", sphere: ()), (name: \"post\"), (name: \"post\")]";
    let file = SceneFile::parse(Path::new("scene.ron"), text.into()).expect("a scene");
    let set = |setting: &str| file.set(setting).map(|file| file.text().to_owned());
    for (setting, from, to) in [
        ("camera.perspective_camera.fov=62", "fov: 45.0", "fov: 62"),
        ("camera.look_at.eye.y=2.5", "(0.0, 1.0, 4.0)", "(0.0, 2.5, 4.0)"),
        ("camera.look_at.target.2=-1", "1.0, 0.0))", "1.0, -1))"),
        ("ball 1.5.sphere.radius=3", "sphere: ()", "sphere: (radius: 3, )"),
        ("camera.perspective_camera.axis=Larger", "(fov: 45.0)", "(axis: Larger, fov: 45.0)"),
        ("camera.integrator.Path.max_depth=3", "RayCasting", "Path(max_depth: 3)"),
        ("ball 1.5.disabled=true", "(name: \"ball", "(disabled: true, name: \"ball"),
    ] {
        assert_eq!(set(setting), Ok(swap(text, from, to)), "{setting}");
    }
    for (setting, said) in [
        ("camera.perspective_camera.fox=1", "a field `fox` is given, but its fields are `fov`, `axis`"),
        ("camera.perspective_camera.fov=x", "fov is x, but it must be a number"),
        ("camra.perspective_camera.fov=1", "no entity is named \"camra\"; the nearest is \"camera\""),
        ("post.sphere.radius=1", "2 entities are named \"post\", but a value is set on one"),
        ("ball 1.5.spere.radius=1", "the nearest is `sphere`"),
        ("ball 1.5.sphere.radius=1, radius: 2", "is not one value"),
        ("ball 1.5.sphere.radius=1) // ", "is not one value"),
        ("camera.look_at.eye.7=1", "has no element `7`"),
        ("ball 1.5.sphere", "a value is set as ENTITY.COMPONENT.FIELD=VALUE"),
    ] {
        let told = set(setting).expect_err(setting);
        assert!(told.starts_with("cannot set `") && told.contains(said) && !told.contains('\n'), "{setting}: {told}");
    }
    assert_eq!(file.value("camera.look_at.eye.z").as_deref(), Ok("4.0"));
    assert_eq!(file.value("camera.resolution.width").as_deref(), Ok("480"), "what is left out has its default");
    assert!(file.value("camera.look_at.ey").is_err());
}

/// The view that a reader keeps is what a person would have typed, and is seen from there.
#[test]
fn a_camera_is_put_where_it_was_moved_to() {
    let view = LookAt { eye: DVec3::new(1.5, 2.0, -3.0), ..LookAt::default() };
    let look = "look_at: (eye: (1.5, 2.0, -3.0), target: (0.0, 0.0, -1.0))";
    let put = |camera: &str| {
        let text = format!("[(name: \"ball\", sphere: ()), ({camera})]");
        let file = SceneFile::parse(Path::new("scene.ron"), text).expect("a scene");
        file.with_view(&view, 7.5).map(|file| file.text().to_owned())
    };
    let text = |camera: &str| Ok(format!("[(name: \"ball\", sphere: ()), ({camera})]"));
    for (camera, then) in [
        ("perspective_camera: (), look_at: (eye: (9, 9, 9))".to_owned(), format!("perspective_camera: (), {look}")),
        ("placement: (position: (9, 9, 9)), fisheye_camera: ()".to_owned(), format!("{look}, fisheye_camera: ()")),
        ("name: \"c\", perspective_camera: ()".to_owned(), format!("{look}, name: \"c\", perspective_camera: ()")),
        (
            "look_at: (), orthographic_camera: (view_height: 3.0)".to_owned(),
            format!("{look}, orthographic_camera: (view_height: 7.5)"),
        ),
        (
            "orthographic_camera: (), look_at: ()".to_owned(),
            format!("orthographic_camera: (view_height: 7.5, ), {look}"),
        ),
    ] {
        assert_eq!(put(&camera), text(&then), "{camera}");
    }
    let turned = LookAt { up: DVec3::X, ..view };
    let file = SceneFile::parse(Path::new("scene.ron"), "[(perspective_camera: ())]".into()).expect("a scene");
    let world = file.with_view(&turned, 1.0).expect("a camera").world();
    let seen = world.try_query::<&LookAt>().and_then(|mut query| query.iter(&world).next().copied());
    assert_eq!(seen, Some(turned));
    for (camera, said) in [
        ("perspective_camera: (), parent: \"ball\"", "its camera has a parent"),
        ("perspective_camera: (), motion: (velocity: (1, 0, 0))", "its camera has a motion"),
        ("disabled: true, perspective_camera: ()", "there is no camera in it"),
    ] {
        let told = put(camera).expect_err(camera);
        assert!(told.starts_with("the view cannot be put into the text: ") && told.contains(said), "{camera}: {told}");
    }
}
