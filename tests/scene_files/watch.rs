//! `render … --watch`: renders at every save, survives what is wrong, and ends with Ctrl-C.

use super::typed;
use std::fs;
use std::io::{BufRead, BufReader, Lines};
use std::process::{ChildStdout, Command, Stdio};

/// The next lines up to the one that says that it waits.
fn until_it_waits(lines: &mut Lines<BufReader<ChildStdout>>) -> Vec<String> {
    let mut said = Vec::new();
    for line in lines {
        let line = line.expect("UTF-8");
        if line.starts_with("waiting for the next save") {
            return said;
        }
        said.push(line);
    }
    panic!("it ended after {said:?}");
}

#[test]
#[cfg(unix)]
fn a_scene_file_is_rendered_again_at_every_save() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (file, picture) = (folder.path().join("scene.ron"), folder.path().join("a.png"));
    let first = typed(&["export", "05_pinhole"]).expect("exported");
    fs::write(&file, &first).expect("saved");
    let mut child = Command::new(env!("CARGO_BIN_EXE_pinhole"))
        .args(["render", "scene.ron", "--watch", "--size", "32x18", "-q", "-o", "a.png"])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut lines = BufReader::new(child.stdout.take().expect("piped")).lines();
    assert_eq!(until_it_waits(&mut lines), ["wrote a.png"]);
    let before = fs::read(&picture).expect("a picture");

    // As many editors save: written beside it, then renamed.
    let save = |text: &str| {
        fs::write(folder.path().join("scene.ron~"), text).expect("saved");
        fs::rename(folder.path().join("scene.ron~"), &file).expect("renamed");
    };
    save(&first.replace("fov: 40.0", "fov: 60.0"));
    assert_eq!(until_it_waits(&mut lines), ["wrote a.png"]);
    let after = fs::read(&picture).expect("a picture");
    assert!(before != after, "the angle changed and the picture did not");

    save(&first[..first.len() / 2]);
    let told = until_it_waits(&mut lines);
    assert!(told.len() == 1 && told[0].starts_with("scene.ron:") && told[0].contains("the file ends here"), "{told:?}");
    assert!(fs::read(&picture).expect("a picture") == after, "a file that is wrong leaves the picture alone");

    fs::remove_file(&file).expect("away");
    assert_eq!(until_it_waits(&mut lines), ["scene.ron: there is no such file"]);

    // As others save: in place; a slow machine may catch it half way, and then again.
    fs::write(&file, &first).expect("saved");
    while until_it_waits(&mut lines) != ["wrote a.png"] {}
    assert!(fs::read(&picture).expect("a picture") == before, "the same file gives the same picture");

    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(sent.is_ok_and(|sent| sent.success()), "Ctrl-C cannot be sent");
    assert_eq!(lines.next().expect("a last line").expect("UTF-8"), "stopped watching scene.ron");
    assert!(child.wait().expect("it ends").success());
    eprintln!("watch: 5 saves seen, 2 of them wrong, ended by Ctrl-C");
}
