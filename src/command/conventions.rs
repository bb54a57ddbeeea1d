use super::arguments::CompareConventions;
use super::error::{Error, Result};
use super::format::{Format, number_or_word, print_json, shown};
use super::interrupt::Waiting;
use super::subject::Subject;
use bevy_ecs::prelude::World;
use pinhole::extract::{LensTable, angle_of_tan_half, camera_entity, validate};
use pinhole::film::{Replaces, check_place, write_png};
use pinhole::look::convention::{Mistake, PlacedCamera, Program, back, lines_with_lens, round_trip};
use pinhole::plan::Census;
use pinhole::render::{Execution, render};
use pinhole::scene::{Lens, printable_path};
use pinhole::{Chapter, Overrides};
use serde_json::{Value, json};
use std::io::Write;
use std::path::Path;

/// A scene's camera in the words of other programs, a picture of a mistake, or how exact the words are.
pub fn print_conventions(
    chapters: &[Chapter],
    asked: &CompareConventions,
    format: Format,
    out: &mut dyn Write,
) -> Result {
    let subject = Subject::find(chapters, &asked.chapter)?;
    let size = Overrides { size: asked.size, ..Overrides::default() };
    let scene = subject.world(&size);
    validate(&Census::of(&scene)).map_err(|scene_error| subject.placed(scene_error.into(), &size))?;
    match (asked.mistake, asked.round_trips) {
        (Some(mistake), _) => render_mistake(&subject, scene, mistake, asked, format, out),
        (None, Some(cameras)) => print_round_trips(cameras, format, out),
        (None, None) => {
            let census = &Census::of(&scene);
            let has_lens = scene.get::<Lens>(camera_entity(census)?).is_some();
            let lens = if has_lens { Some(census.table::<LensTable>().map_err(pinhole::Error::from)?) } else { None };
            print_lines(&subject, (&PlacedCamera::of(&scene)?, lens.as_deref()), format, out)
        }
    }
}

fn print_lines(
    subject: &Subject<'_>,
    (camera, lens): (&PlacedCamera, Option<&LensTable>),
    format: Format,
    out: &mut dyn Write,
) -> Result {
    if format.is_json() {
        return print_json(&as_json(subject.name(), camera, lens), out);
    }
    writeln!(out, "camera of {}, {} x {} pixels", subject.name(), camera.image.width, camera.image.height)?;
    for program in Program::ALL {
        writeln!(out, "\n{program}")?;
        for line in lines_with_lens(program, camera, lens) {
            writeln!(out, "    {line}")?;
        }
        let [whole, place] = back(program);
        writeln!(out, "  back: {whole};\n        {place}")?;
    }
    Ok(())
}

/// The camera in numbers, and each program's lines as they are typed.
fn as_json(scene: &str, camera: &PlacedCamera, lens: Option<&LensTable>) -> Value {
    let program = |program: Program| {
        let [field_of_view, placement] = back(program);
        let back = json!({ "field_of_view": field_of_view, "placement": placement });
        json!({ "program": program.to_string(), "lines": lines_with_lens(program, camera, lens), "back": back })
    };
    let [eye, target, up] = [camera.look.eye, camera.look.target, camera.look.up].map(|point| point.to_array());
    json!({
        "scene": scene, "width": camera.image.width, "height": camera.image.height,
        "eye": eye, "target": target, "up": up,
        "vertical_fov_degrees": angle_of_tan_half(camera.tan_half_vertical).0,
        "programs": Program::ALL.map(program),
    })
}

fn print_round_trips(cameras: u64, format: Format, out: &mut dyn Write) -> Result {
    if format.is_json() {
        let told = |program: Program| {
            let trip = round_trip(program, cameras);
            json!({
                "program": program.to_string(), "moved": trip.moved, "other_tangent": trip.widened,
                "worst_tangent_error_epsilons": number_or_word(trip.worst),
            })
        };
        return print_json(&json!({ "cameras": cameras, "programs": Program::ALL.map(told) }), out);
    }
    writeln!(out, "{cameras} cameras there and back; ε = 2^-52")?;
    writeln!(out, "{:<32} {:>8} {:>14} {:>16}", "", "moved", "other tangent", "worst tangent")?;
    for program in Program::ALL {
        let trip = round_trip(program, cameras);
        writeln!(out, "{:<32} {:>8} {:>14} {:>14.1} ε", program.to_string(), trip.moved, trip.widened, trip.worst)?;
    }
    Ok(())
}

/// The picture of a scene after a mistake.
fn render_mistake(
    subject: &Subject<'_>,
    mut scene: World,
    mistake: Mistake,
    asked: &CompareConventions,
    format: Format,
    out: &mut dyn Write,
) -> Result {
    let in_out = || Path::new("out").join(format!("{}_{mistake}.png", subject.stem()));
    let file = asked.output.clone().unwrap_or_else(in_out);
    if file.extension().is_none_or(|ending| !ending.eq_ignore_ascii_case("png")) {
        return Err(Error::CommandLine(format!("cannot write {}: the name must end in .png", printable_path(&file))));
    }
    let place = Replaces::if_named(asked.output.is_some()).at(&file);
    check_place(place)?;
    mistake.commit(&mut scene)?;
    let rendered = render(&scene, &subject.stages(), &Execution::default(), &Waiting::new(0, true))?;
    write_png(&rendered.film, rendered.curve(), place)?;
    if format.is_json() {
        let (mistake, made_by) = (mistake.to_string(), mistake.made_by());
        return print_json(&json!({ "mistake": mistake, "made_by": made_by, "files": [shown(&file)] }), out);
    }
    writeln!(out, "{mistake}: {}", mistake.made_by())?;
    writeln!(out, "wrote {}", printable_path(&file))?;
    Ok(())
}
