//! The list of all stages: each once, in the order of the sets, whichever was offered first.

use pinhole::plan::Stage;
use pinhole::stages::{all, sort};
use std::any::TypeId;
use std::collections::BTreeSet;

#[test]
fn every_stage_stands_in_the_list_once_and_the_list_follows_the_sets() {
    let all = all();
    let ids: BTreeSet<TypeId> = all.iter().map(|stage| stage.id).collect();
    let names: BTreeSet<&str> = all.iter().map(|stage| stage.name).collect();
    assert_eq!((ids.len(), names.len()), (all.len(), all.len()));
    for pair in all.windows(2) {
        assert!(pair[0].set <= pair[1].set, "\"{}\" stands before \"{}\"", pair[0].name, pair[1].name);
    }
}

#[test]
fn the_order_of_the_offer_does_not_matter() {
    let mut reversed: Vec<Stage> = all().into_iter().rev().collect();
    sort(&mut reversed);
    assert_eq!(reversed, all());
}
