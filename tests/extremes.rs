//! The extremes with few rays: the very code that `cargo run --release -- extremes` runs with many.

use pinhole::measure::extremes::{Group, Outcome, try_group, unbroken};

/// Tries a group, prints its table, and asks that the kit holds everywhere and each naive method breaks somewhere.
fn holds(group: Group, rays: u64) {
    let cases = try_group(group, "", rays, &());
    for case in &cases {
        eprint!("{case}");
        assert!(case.held(), "the kit does not hold in:\n{case}");
        assert!(case.rays > 0, "nothing was tried in {}", case.name);
        let too_long = case.to_string().lines().find(|line| line.chars().count() > 100).map(String::from);
        assert_eq!(too_long, None, "a line is longer than a page is wide");
    }
    assert_eq!(unbroken(&cases), Vec::<&str>::new(), "these prove nothing, for no case breaks them");
    let tried: u64 = cases.iter().map(|case| case.rays).sum();
    eprintln!("{group}: {} cases, {tried} rays", cases.len());
}

#[test]
fn spheres_hold() {
    holds(Group::Sphere, 4096);
}

#[test]
fn planes_hold() {
    holds(Group::Plane, 8192);
}

#[test]
fn shadow_rays_hold() {
    holds(Group::Shadow, 4096);
}

#[test]
fn cameras_hold() {
    holds(Group::Camera, 2048);
}

#[test]
fn transforms_hold() {
    holds(Group::Transform, 2048);
}

#[test]
fn results_do_not_depend_on_threads() {
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| try_group(Group::Plane, "", 3000, &()))
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn a_kit_that_misses_would_be_seen() {
    let mut cases = try_group(Group::Plane, "", 512, &());
    let first: &mut Outcome = &mut cases[0].outcomes[0];
    first.score.judge(false);
    assert!(!cases[0].held() && cases[1].held());
}
