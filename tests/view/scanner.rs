//! The page finds the entities of a text in time that grows as the text does, whatever the text is.
//!
//! Where no Node.js is installed, the test says so and passes.

use super::{ended, folder_with};
use serde_json::Value;
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

/// The part of the page's script that finds entities, and what prints what it found in the text on standard input.
fn script() -> String {
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/live/view/page/text.js"))
        .expect("the page's script");
    let begin = page.find("/** Where what begins at a place").expect("its beginning");
    let end = page.find("const NUMBERS").expect("its end");
    let print = "const text = require('fs').readFileSync(0, 'utf8');\
                 const began = performance.now(); const found = entities(text);\
                 console.log(JSON.stringify([performance.now() - began, found]));";
    format!("{}\n{print}", &page[begin..end])
}

/// How many milliseconds it took, and the entities; none where there is no Node.js.
fn found(text: &str) -> Option<(f64, Vec<String>)> {
    let node = Command::new("node").args(["-e", &script()]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
    let mut node = node.ok()?;
    node.stdin.take().expect("piped").write_all(text.as_bytes()).expect("read");
    let answer = node.wait_with_output().expect("it ends").stdout;
    let answer: Value = serde_json::from_slice(&answer).expect("JSON");
    let units: Vec<u16> = text.encode_utf16().collect();
    let slice = |range: &Value| {
        let [start, end] = [0, 1].map(|at| range[at].as_u64().expect("a place") as usize);
        String::from_utf16(&units[start..end]).expect("whole letters")
    };
    Some((answer[0].as_f64().expect("a time"), answer[1].as_array().expect("a list").iter().map(slice).collect()))
}

#[test]
fn every_entity_of_a_text_is_found() {
    let folder = folder_with("25");
    let text = fs::read_to_string(folder.path().join("scene.ron")).expect("exported");
    let Some((_, entities)) = found(&text) else {
        eprintln!("no Node.js is installed, so the page's script is not run");
        return;
    };
    let plan = ended(folder.path(), &["plan", "scene.ron", "--format", "json"]);
    assert!(plan.status.success() && entities.len() > 5, "{} entities", entities.len());
    assert!(entities.iter().all(|own| own.starts_with('(') && own.ends_with(')')));
    let odd = "[ // (not: (this))\n /* nor /* (this) */ [ \" */ (name: \"a ) \\\" (\", sphere: ()), (name: r#\"b \" ) (\"#), (r: 1), ]";
    let (_, entities) = found(odd).expect("it ran before");
    assert_eq!(entities, ["(name: \"a ) \\\" (\", sphere: ())", "(name: r#\"b \" ) (\"#)", "(r: 1)"]);
}

#[test]
fn no_text_freezes_the_page() {
    let long = |part: &str| part.repeat((1 << 20) / part.len());
    let texts = [
        format!("/* /* */ \"{} */\n[(sphere: ())]", "\\\"".repeat(40_000)),
        long("\\\""),
        format!("\"{}", long("\\\"")),
        long("/*"),
        long("\"/*"),
        long("r#\""),
        format!("r{}\"", long("#")),
        long("([{"),
        long("//"),
        long("/* */"),
        long("\u{1f30d}"),
    ];
    let began = Instant::now();
    for text in &texts {
        let Some((milliseconds, _)) = found(text) else {
            eprintln!("no Node.js is installed, so the page's script is not run");
            return;
        };
        // The regular expression that once stood here took ten seconds for 80 kB of the first.
        assert!(
            milliseconds < 2000.0,
            "{milliseconds} ms for {} bytes of {:?}",
            text.len(),
            &text[..8.min(text.len())]
        );
    }
    eprintln!("page: {} texts of a MiB in {:?}", texts.len(), began.elapsed());
}
