//! The mutations that `cargo bench --bench mutations` chooses: in code alone, everywhere, and the same by the same seed.

#[path = "bench/mutations/choose.rs"]
mod choose;
#[path = "bench/mutations/source.rs"]
mod source;

use choose::{FOLDERS, candidates};
use std::collections::BTreeSet;
use std::path::Path;

#[test]
fn mutations_change_code_and_nothing_else() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders: Vec<String> = FOLDERS.split(',').map(String::from).collect();
    let found = candidates(root, &folders, 1);
    assert!(found.len() > 2000, "only {} mutations", found.len());
    let mut changed = BTreeSet::new();
    for mutation in &found {
        assert!(mutation.before != mutation.after && mutation.from < mutation.to, "{mutation:?}");
        let comment = mutation.before.starts_with("//") || mutation.before.starts_with("#[");
        assert!(!comment && mutation.number == 0, "{} {}", mutation.place(), mutation.before);
        assert!(
            changed.insert((&mutation.file, mutation.from, &mutation.by)) || mutation.by.is_empty(),
            "{mutation:?}"
        );
    }
    for folder in &folders {
        let here = found.iter().filter(|mutation| mutation.folder().starts_with(folder.as_str())).count();
        assert!(here > 30, "{folder} has {here} mutations only");
    }
    // The first of each function come before any second one.
    let functions: BTreeSet<_> = found.iter().map(|mutation| (&mutation.file, mutation.function)).collect();
    let first: BTreeSet<_> =
        found[..functions.len()].iter().map(|mutation| (&mutation.file, mutation.function)).collect();
    assert_eq!(first.len(), functions.len());
    let order = |seed| candidates(root, &folders, seed).iter().map(|mutation| mutation.from).collect::<Vec<_>>();
    assert!(order(1) == order(1) && order(1) != order(2));
    let boundaries = found.iter().filter(|mutation| mutation.is_boundary()).count();
    eprintln!("mutations: {} of {} functions, {boundaries} at boundaries", found.len(), functions.len());
}

#[test]
fn comments_and_texts_are_no_code() {
    let source = "fn a() -> f64 { let b = \"1 + 2 \\\" }\"; /* kept */ b.len() as f64 * 2.0 } // {\nfn c<'a>(d: &'a [u8; 3]) \
                  { '{' } const fn e() {} fn f() -> impl Fn() { || {} }";
    let code = source::masked(source);
    let text = String::from_utf8(code.clone()).expect("text");
    assert!(!text.contains("1 + 2") && text.contains("* 2.0") && text.len() == source.len());
    let bodies: Vec<&str> = source::functions(&code).iter().map(|own| &source[own.body.clone()]).collect();
    assert_eq!(bodies.len(), 2, "{bodies:?}");
    assert!(bodies[0].ends_with("* 2.0 }") && bodies[1] == "{ '{' }", "{bodies:?}");
    assert!(source::functions(&code).iter().all(|own| source[own.start..].starts_with("fn ")));
}
