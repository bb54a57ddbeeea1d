//! `--format json`: every command prints one JSON value and nothing else, and in it what its text says.

use bevy_ecs::prelude::Query;
use pinhole::Chapter;
use pinhole::intersect::Hits;
use pinhole::plan::{Evidence, Stage, TileSystems};
use pinhole::shade::Radiance;
use pinhole_lab::report::table::short;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

/// What the text of a command must say, by what its JSON says.
type Says = fn(&Value) -> Vec<String>;

/// A quick command line for each thing that each command prints; @ stands for a folder of its own.
const LINES: &[(&[&str], Says)] = &[
    (&["list"], |it| each(it, "chapters", |it| format!("{} {}", word(it, "name"), word(it, "title")))),
    (&["plan", "cover"], plan),
    (&["preflight"], preflight),
    (&["preflight", "3"], |it| texts(it, "warnings")),
    (&["angles", "5"], angles),
    (&["trace", "21", "--pixel", "31,20", "--size", "64x36"], trace),
    (&["extremes", "film", "--case", "no light", "--rays", "600"], extremes),
    (&["extremes", "shapes", "--case", "planes", "--rays", "256", "--page", "@/page.html"], extremes),
    (&["closed-forms", "--case", "drinks that overlap"], closed_forms),
    (&["sweep", "4"], sweep),
    (&["export", "16"], |it| vec![word(it, "scene_file").into()]),
    (&["export", "5", "-o", "@/scene.ron"], wrote),
    (&["cost", "1"], |it| each(it, "stages", |it| format!("{} {} ", word(it, "stage"), it["rows"]))),
    (&["report", "18", "--kept"], report),
    (&["report", "18", "--kept", "-o", "@/plot.svg"], wrote),
    (&["report", "3", "--naive", "--size", "4x3"], naive),
    (&["methods", "tests/methods/fog.ron", "--size", "8x6", "--samples", "1", "--seeds", "4"], methods),
    (&["check"], |it| each(it, "exercises", |it| format!("{} {} ", word(it, "chapter"), word(it, "function")))),
    (&["check", "12"], check),
    (&["figure"], |it| each(it, "figures", |it| format!("{} {}", word(it, "name"), word(it, "about")))),
    (&["figure", "02_ray", "-o", "@/figure.svg"], wrote),
    (&["draw"], |it| {
        each(it, "images", |it| format!("{} {}; kept in {}", word(it, "name"), word(it, "about"), word(it, "folder")))
    }),
    (&["draw", "card.png", "-o", "@/card.png"], wrote),
    (&["conventions", "5"], conventions),
    (&["conventions", "5", "--round-trips", "9"], round_trips),
    (&["conventions", "5", "--mistake", "rolled", "--size", "8x6", "-o", "@/rolled.png"], wrote),
    (&["review", "--chapters", "@"], |_| vec!["no snapshot waits".into()]),
    (&["review", "accept", "all", "--chapters", "@"], |_| vec!["no snapshot waits".into()]),
    (&["review", "--mutate", "half-pixel", "-o", "@/page.html"], mutation),
    (&["compare", CARD, CARD, "-o", "@/difference.png"], compare),
    (&["farm", "5", "--parts", "4", "--to", "parallel", "-o", "@/a.png"], |it| {
        let written = list(it, "written").iter().map(|file| file.as_str().expect("a name"));
        vec![format!("wrote {}; to begin: {}", written.collect::<Vec<_>>().join(", "), word(it, "begin"))]
    }),
    (&["yours"], |it| each(it, "steps", |it| format!("{} {} lines", word(it, "chapter"), it["lines"]))),
    (&["yours", "5", "-o", "@/yours.png"], wrote),
    (&["yours", "5", "--program"], |it| vec![word(it, "program").into()]),
];
const CARD: &str = "chapters/16_textures/card.png";
/// Help and scripts for shells are no data; what `render` says is tried beside the pictures that it writes, and what
/// `measure` says beside the records.
const TRIED_ELSEWHERE: [&str; 7] = ["help", "completions", "render", "merge", "view", "live", "measure"];

/// What a command line prints, and the sentence that it ends with where it fails.
fn printed(chapters: &[Chapter], line: &[&str], format: &str) -> (String, Option<String>) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let place = folder.path().display().to_string();
    let mut words: Vec<String> = line.iter().map(|word| word.replace('@', &place)).collect();
    words.extend(["--format".into(), format.into()]);
    let (mut out, ended);
    if line[0] == "check" {
        // The reader's functions are known to the program only.
        let done = Command::new(env!("CARGO_BIN_EXE_pinhole")).args(&words).output().expect("the program runs");
        out = done.stdout;
        ended = (!done.status.success()).then(|| String::from_utf8_lossy(&done.stderr).into_owned());
    } else {
        out = Vec::new();
        ended = pinhole_cli::command::run(chapters, &words, &mut out).err().map(|error| error.to_string());
    }
    (String::from_utf8(out).expect("UTF-8").replace(&place, "@"), ended)
}

/// The one value that a command line prints, and the sentence that it ends with.
fn one_value(chapters: &[Chapter], line: &[&str]) -> (Value, Option<String>) {
    let (json, ended) = printed(chapters, line, "json");
    let value = serde_json::from_str(&json).unwrap_or_else(|error| panic!("{line:?}: {error}\n{json}\n{ended:?}"));
    (value, ended)
}

#[test]
fn every_command_says_in_json_what_it_says_in_text() {
    let chapters = chapters::all();
    let mut missing = Vec::new();
    for (line, says) in LINES {
        let (value, ended) = one_value(&chapters, line);
        let (text, ended_text) = printed(&chapters, line, "text");
        assert!(value.is_object(), "{line:?}: {value}");
        assert_eq!(ended, ended_text, "{line:?} ends in another way");
        let text = on_one_line(&text);
        let untold = says(&value).into_iter().find(|told| !text.contains(&on_one_line(told)));
        missing.extend(untold.map(|told| format!("{line:?}: no \"{told}\" in\n{text}")));
        if let Some(files) = value.get("files").and_then(Value::as_array) {
            let placed = line.iter().filter(|word| word.starts_with("@/"));
            assert!(files.iter().eq(placed), "{line:?}: {files:?}");
        }
    }
    assert!(missing.is_empty(), "{}", missing.join("\n"));
    let (help, _) = printed(&chapters, &["--help"], "text");
    let commands = help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    let named = commands.filter_map(|line| line.strip_prefix("  ").filter(|line| !line.starts_with(' ')));
    let named = named.filter_map(|line| line.split_whitespace().next());
    let named: BTreeSet<&str> = named.filter(|name| !TRIED_ELSEWHERE.contains(name)).collect();
    assert_eq!(LINES.iter().map(|(line, _)| line[0]).collect::<BTreeSet<&str>>(), named);
}

/// Light that depends on a length of its own.
fn add_fog(mut tiles: Query<(&Hits, &mut Radiance)>) {
    for (hits, mut radiance) in &mut tiles {
        for row in 0..hits.t.len() {
            radiance.rgb[0][row] += if hits.t[row] < 7.0 { 0.25 } else { 0.0 };
        }
    }
}

#[test]
fn what_does_not_hold_is_printed_before_the_command_fails() {
    let fog = Stage::new("Add fog", TileSystems::Shade, add_fog);
    let fog = fog.when(|_| Evidence::always("the test asks for it"));
    let chapters: Vec<Chapter> = chapters::all().into_iter().map(|chapter| chapter.offer(fog.clone())).collect();
    let (value, ended) = one_value(&chapters, &["sweep", "5"]);
    assert!(ended.is_some_and(|ended| ended.contains("does not hold when scaled")));
    let lines = value["lines"].as_array().expect("lines");
    assert_eq!(value["held"], lines.iter().filter(|line| line["held"] == true).count());
    assert!(value["held"].as_u64() < value["tried"].as_u64(), "{value}");
    let (value, ended) = one_value(&chapters, &["check", "5"]);
    assert!(ended.is_some() && value["outcome"] != "right", "{value}");
    let (json, ended) = printed(&chapters, &["plan", "no-such-chapter"], "json");
    assert!(json.is_empty() && ended.is_some(), "{json}");
}

#[test]
fn a_name_that_turns_text_round_stands_escaped() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("scene.ron");
    let (value, _) = one_value(&chapters::all(), &["export", "10"]);
    let scene = word(&value, "scene_file").replace("name: \"camera\"", "name: \"\u{202e}aremac\u{200f}\"");
    assert!(scene.contains('\u{202e}'));
    std::fs::write(&file, scene).expect("written");
    let file = file.display().to_string();
    for command in [&["plan"][..], &["preflight"], &["trace", "--pixel", "9,9"]] {
        let line = [command, &[&*file]].concat();
        let (json, ended) = printed(&chapters::all(), &line, "json");
        assert!(ended.is_none() && serde_json::from_str::<Value>(&json).is_ok(), "{json}\n{ended:?}");
        assert!(!json.contains(['\u{202e}', '\u{200f}']), "{json}");
    }
}

fn on_one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn list<'v>(value: &'v Value, key: &str) -> &'v [Value] {
    value[key].as_array().unwrap_or_else(|| panic!("{key} is no list in {value}"))
}

fn word<'v>(value: &'v Value, key: &str) -> &'v str {
    value[key].as_str().unwrap_or_else(|| panic!("{key} is no text in {value}"))
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("{key} is not a number in {value}"))
}

fn each(value: &Value, key: &str, says: impl Fn(&Value) -> String) -> Vec<String> {
    let rows: Vec<String> = list(value, key).iter().map(says).collect();
    assert!(!rows.is_empty(), "no {key} in {value}");
    rows
}

fn texts(value: &Value, key: &str) -> Vec<String> {
    list(value, key).iter().map(|text| text.as_str().expect("a text").into()).collect()
}

fn wrote(value: &Value) -> Vec<String> {
    each(value, "files", |file| format!("wrote {}", file.as_str().expect("a path")))
}

fn plan(value: &Value) -> Vec<String> {
    let mut says = each(value, "stages", |stage| {
        let kept = if stage["kept"] == true { "kept" } else { "dropped" };
        format!("{kept} {} {}", word(stage, "stage"), word(stage, "reason"))
    });
    says.extend(each(value, "columns", |column| format!("{} {} B", word(column, "name"), column["bytes_per_row"])));
    says.extend(each(value, "tables", |table| word(table, "name").into()));
    says.push(format!("(together {})", value["column_bytes_per_row"]));
    says.push(format!("tables take {} bytes", value["table_bytes"]));
    let [stages, tables] = ["bytes_per_row", "bytes"].map(|key| {
        let rows = if key == "bytes" { list(value, "tables") } else { list(value, "columns") };
        rows.iter().map(|row| number(row, key)).sum::<f64>()
    });
    assert_eq!([stages, tables], [number(value, "column_bytes_per_row"), number(value, "table_bytes")]);
    says
}

fn preflight(value: &Value) -> Vec<String> {
    let mut says = each(value, "scenes", |scene| word(scene, "scene").into());
    for scene in list(value, "scenes") {
        says.extend(texts(scene, "warnings").iter().map(|warning| format!("before rendering: {warning}")));
        says.extend(scene["refused"].as_str().map(|refused| format!("refused: {refused}")));
    }
    assert!(says.iter().any(|line| line.starts_with("refused")) && says.len() > 20, "{says:?}");
    says
}

fn angles(value: &Value) -> Vec<String> {
    let size = format!("{} x {} pixels, aspect {:.6}", value["width"], value["height"], number(value, "aspect"));
    let mut says = each(value, "axes", |axis| {
        let [extent, tangent] = ["half_heights", "tan_half_angle"].map(|key| number(axis, key));
        format!("{} {extent:.6} {tangent:.6} {:.4}°", word(axis, "axis"), number(axis, "degrees"))
    });
    says.extend([size, format!("{}° across {}", number(&value["asked"], "degrees"), word(&value["asked"], "axis"))]);
    says
}

/// What the text prints: of every column, what its last stage wrote on each bounce, but for lists of rows.
fn trace(value: &Value) -> Vec<String> {
    let mut last: BTreeMap<(u64, &str), &Value> = BTreeMap::new();
    for stage in list(value, "stages").iter().filter(|stage| stage["unit"] != "rows") {
        last.insert((stage["bounce"].as_u64().expect("a bounce"), word(stage, "column")), stage);
    }
    let (mut says, mut shapes) = (Vec::new(), 0);
    for ((_, column), stage) in last {
        says.push(format!("{column} {} {}", word(stage, "space"), word(stage, "unit")));
        for (name, component) in list(stage, "rows").iter().flat_map(|row| row.as_object().expect("a row")) {
            shapes += usize::from(name == "shape" && component.is_string());
            let shown = match component {
                Value::Null => "none".into(),
                Value::String(shape) if name == "shape" => shape.clone(),
                Value::String(_) => "+inf".into(),
                Value::Number(whole) if whole.is_u64() => whole.to_string(),
                component => shown(component.as_f64().expect("a number")),
            };
            says.push(format!("{name} {shown}"));
        }
    }
    assert!(shapes > 0 && says.len() > 30, "{says:?}");
    says
}

/// A number as a trace shows it; where it has the digits of an f32, it is one.
fn shown(value: f64) -> String {
    let single = value as f32;
    let value = if single.to_string() == value.to_string() { f64::from(single) } else { value };
    let is_plain = value == 0.0 || (1e-4..1e7).contains(&value.abs());
    if is_plain { format!("{value:+.6}") } else { format!("{value:+.6e}") }
}

fn extremes(value: &Value) -> Vec<String> {
    let mut says = vec![format!("held: {} of {} cases", value["held"], value["tried"])];
    for case in list(value, "cases") {
        says.push(format!("{}: {} tried, {} ", word(case, "case"), case["inputs"], case["checked"]));
        says.extend(each(case, "methods", |method| format!("{} {} ", word(method, "name"), method["wrong"])));
        let naive = &case["naive_at_its_worst"];
        if naive.is_null() {
            continue;
        }
        says.push(format!("at input {}: {}", naive["input"], word(naive, "method")));
        says.extend(naive["answers"]["exact"].as_f64().map(|exact| {
            let is_plain = exact == 0.0 || (1e-3..1e6).contains(&exact.abs());
            if is_plain { format!("exact {exact:.10}") } else { format!("exact {exact:.10e}") }
        }));
    }
    says
}

fn closed_forms(value: &Value) -> Vec<String> {
    each(value, "closed_forms", |form| {
        assert_eq!(form["held"], true);
        let [truth, measured] = ["truth", "measured"].map(|key| number(form, key));
        let (name, formula) = (word(form, "name"), word(form, "formula"));
        format!("{name} {truth:.5} {measured:.5} rounding {:+.1} r {formula}", number(form, "off_by"))
    })
}

fn sweep(value: &Value) -> Vec<String> {
    let mut says = each(value, "lines", |line| {
        if let Some(found) = line["difference"].as_object() {
            let told = format!("{} of {} changed hands", found["changed_hands"], found["hits"]);
            assert!(word(line, "came").contains(&told), "{line}");
        }
        format!("{} {} held {}", word(line, "done"), word(line, "came"), word(line, "asked"))
    });
    says.push(format!("held: {} of {} lines", value["held"], value["tried"]));
    says
}

fn report(value: &Value) -> Vec<String> {
    each(&value["variants"][0], "levels", |level| {
        let [error, seconds] = [number(level, "rel_mse"), level["render"]["median"][1].as_f64().expect("seconds")];
        format!("{} {}", short(error), short(1e3 * seconds))
    })
}

fn naive(value: &Value) -> Vec<String> {
    let mut says = each(value, "measurements", |row| word(row, "measurement").into());
    let first = &list(value, "measurements")[0];
    says.push(format!("{} {}", says[0], short(number(&first["gives"], "value"))));
    assert_eq!(says.len(), 6);
    says
}

fn methods(value: &Value) -> Vec<String> {
    let mut says = vec![format!("{}: {}", word(value, "chosen"), word(value, "why")), word(value, "ask").into()];
    let refused = list(value, "methods").iter().filter(|row| row["refused"].is_string());
    says.extend(refused.map(|row| format!("{} refused: {}", word(row, "method"), word(row, "refused"))));
    assert_eq!(says.len(), 3, "{value}");
    says
}

fn check(value: &Value) -> Vec<String> {
    let answer = &value["answer"];
    vec![
        format!("{} is wrong for {} of {} inputs", word(value, "function"), value["wrong_inputs"], value["inputs"]),
        format!("yours {} expected {}", word(answer, "yours"), word(answer, "expected")),
        word(&value["input"], "arguments").into(),
    ]
}

fn conventions(value: &Value) -> Vec<String> {
    let mut says = vec![format!("{} x {} pixels", value["width"], value["height"])];
    for program in list(value, "programs") {
        says.push(word(program, "program").into());
        says.extend(texts(program, "lines"));
        let back = &program["back"];
        says.push(format!("back: {}; {}", word(back, "field_of_view"), word(back, "placement")));
    }
    let eye = list(value, "eye").iter().map(|part| part.as_f64().expect("a number").to_string());
    says.push(format!("lookfrom = point3({})", eye.collect::<Vec<_>>().join(", ")));
    says.push(format!("cam.vfov = {:.0}", number(value, "vertical_fov_degrees")));
    says
}

fn round_trips(value: &Value) -> Vec<String> {
    each(value, "programs", |trip| {
        let worst = number(trip, "worst_tangent_error_epsilons");
        format!("{} {} {} {worst:.1} ε", word(trip, "program"), trip["moved"], trip["other_tangent"])
    })
}

fn mutation(value: &Value) -> Vec<String> {
    let difference = &value["difference"];
    assert_eq!(difference["first_difference"]["stage"], "Place raster points");
    vec![format!("{}: {}", word(difference, "chapter"), word(difference, "headline"))]
}

fn compare(value: &Value) -> Vec<String> {
    let size = format!("{} × {} pixels; {} of", value["width"], value["height"], value["pixels_differing"]);
    vec![size, format!("MAE {:.6e}", number(value, "mae")), format!("PSNR {}", word(value, "psnr_decibels"))]
}
