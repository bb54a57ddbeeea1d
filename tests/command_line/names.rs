//! Names are escaped on every path: no letter of a file's or an entity's name does anything to a terminal.

use super::model::glb;
use super::pinhole;
use std::ffi::OsString;
use std::fs;
use std::os::unix::ffi::OsStringExt;

/// What a terminal obeys, or shows others differently because of; those that a scene's names may not have, and the rest.
const HIDDEN: [&str; 2] = ["\u{1b}[31m\u{9b}31m\t\r\u{7f}", "\u{202e}\u{2028}\u{200b}"];

/// Commands with `SCENE` in place of the scene's file.
const COMMANDS: [&str; 23] = [
    "render SCENE --size 8x5",
    "render SCENE --size 8x5 -v",
    "render SCENE --size 8x5 -n 2 --write-every 1ms",
    "render SCENE --size 8x5 -n 2 --resume",
    "render SCENE --size 8x5 -q -o SCENE.png",
    "render SCENE --size 8x5 --format json",
    "render SCENE --size 8x5 -o SCENE",
    "plan SCENE",
    "plan SCENE --format json",
    "trace SCENE --pixel 3,2 --size 8x5",
    "trace SCENE --pixel 3,2 --size 8x5 --format json",
    "preflight SCENE",
    "angles SCENE",
    "angles SCENE --format json",
    "conventions SCENE",
    "conventions SCENE --mistake mirrored --size 8x5",
    "export SCENE",
    "export SCENE -o SCENE",
    "compare SCENE SCENE",
    "render SCENE/none.ron",
    "render none-SCENE",
    "sweep SCENE",
    "methods SCENE --size 8x5 --quick",
];

#[test]
fn no_command_sends_a_hidden_letter_to_the_terminal() {
    let text = |name: &str| {
        format!(
            "[(name: \"camera{name}\", perspective_camera: (fov: 40.0), placement: (position: (0, 0, 6))),\n\
             (name: \"ball{name}\", sphere: (radius: 1.0), matte: ()),\n\
             (name: \"lamp{name}\", point_light: (intensity: (9, 9, 9)), placement: (position: (0, 5, 5)))]"
        )
    };
    let (mut tried, mut shown) = (0, 0);
    for hidden in HIDDEN {
        let folder = tempfile::tempdir().expect("a temporary folder");
        // Scene files refuse control letters in names, and model files do not.
        let within = if hidden.contains(char::is_control) { "" } else { hidden };
        let scene = format!("s{hidden}cene.ron");
        fs::write(folder.path().join(&scene), text(within)).expect("written");
        let model = format!("m{hidden}odel.glb");
        let odd = String::from_utf8_lossy(&glb()).len();
        assert!(odd > 0);
        fs::write(folder.path().join(&model), glb()).expect("written");
        for name in [&scene, &model] {
            for command in COMMANDS {
                if name == &model && ["sweep", "export SCENE -o"].iter().any(|own| command.starts_with(own)) {
                    continue;
                }
                let words = command.split(' ').map(|word| word.replace("SCENE", name));
                let ended = pinhole(folder.path()).args(words).output().expect("the program starts");
                for stream in [ended.stdout, ended.stderr] {
                    let said = String::from_utf8(stream).expect("UTF-8");
                    let bad = said.chars().find(|letter| {
                        (letter.is_control() && *letter != '\n')
                            || HIDDEN.iter().any(|own| own.contains(*letter) && !letter.is_ascii_graphic())
                    });
                    assert_eq!(bad, None, "{command} with {hidden:?}: {said:?}");
                    shown += usize::from(
                        said.contains("\\u{") || said.contains("\\u0") || said.contains("\\t") || said.contains("\\r"),
                    );
                }
                tried += 1;
            }
        }
    }
    // A name that is no UTF-8 at all.
    let folder = tempfile::tempdir().expect("a temporary folder");
    let name = OsString::from_vec(b"s\xff\x1b[2J.ron".to_vec());
    fs::write(folder.path().join(&name), text("")).expect("written");
    for command in ["render", "plan", "angles", "conventions", "preflight", "export"] {
        let ended = pinhole(folder.path()).arg(command).arg(&name).output().expect("the program starts");
        assert!(!ended.stdout.contains(&0x1b) && !ended.stderr.contains(&0x1b), "{command}");
    }
    assert!(shown * 3 > tried, "only {shown} of {tried} named the file");
    eprintln!("names: {tried} commands, {shown} texts with an escaped letter");
}
