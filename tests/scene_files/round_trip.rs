//! Export → load: the same picture and the same digests, bit for bit, and the same text again.

use crate::{chapters, parsed, scenes};
use pinhole::plan::Stage;
use pinhole::render::{Execution, render};
use pinhole::scene::{Resolution, scene_text};
use pinhole::{Asked, review};

const SIZE: Resolution = Resolution { width: 96, height: 54 };

fn asked() -> Asked {
    Asked { resolution: Some(SIZE), ..Asked::default() }
}

/// The film's means as bits.
fn picture(scene: &bevy_ecs::world::World, offer: &[Stage]) -> Vec<[u32; 3]> {
    let film = render(scene, offer, &Execution::default(), &()).expect("renders").film;
    let pixels = (0..film.height).flat_map(|y| (0..film.width).map(move |x| (x, y)));
    pixels.map(|(x, y)| film.mean(x, y).map(f32::to_bits)).collect()
}

#[test]
fn every_chapter_comes_back_from_its_file_bit_for_bit() {
    for chapter in chapters::all() {
        let before = chapter.world(&asked());
        let text = scene_text(&before).expect("a chapter's scene can be exported");
        let file = parsed(&text).unwrap_or_else(|problem| panic!("{}: {problem}\n{text}", chapter.name));
        let after = file.world();
        assert_eq!(scene_text(&after).expect("exported again"), text, "{}", chapter.name);
        let pictures = [picture(&before, &chapter.stages()), picture(&after, &scenes::offer())];
        assert!(pictures[0] == pictures[1], "{}: another picture", chapter.name);
        let digests = [review::digests(&before, &chapter.stages()), review::digests(&after, &scenes::offer())];
        let [before, after] = digests.map(|digests| digests.expect("digests"));
        assert_eq!(before, after, "{}: another digest", chapter.name);
    }
    eprintln!("round trips: {} chapters, picture, digests and text the same", chapters::all().len());
}
