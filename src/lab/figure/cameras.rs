//! One scene through other lenses, other cameras, other shutters.

use super::Figure;
use super::gallery::{Exhibit, gallery_foot, hang};
use super::picture::Picture;
use super::svg::Drawing;
use crate::naive::lens::{onto_disk, radius_at_random};
use crate::naive::mistake::{moments_in_turn, opening_filled_by};
use bevy_ecs::prelude::*;
use pinhole::Chapter;
use pinhole::Result;
use pinhole::plan::Stage;
use pinhole::scene::{
    Aperture, Degrees, EquirectangularCamera, FisheyeCamera, FovAxis, Lens, PerspectiveCamera, Sampling, Shutter,
};

const SIZE: [u32; 2] = [276, 184];
/// Samples a pixel, fewer than in the chapter's own picture, for there are several.
const SAMPLES: u32 = 32;

fn fewer(camera: &mut EntityWorldMut<'_>) {
    let own = camera.get::<Sampling>().copied().unwrap_or_default();
    camera.insert(Sampling { samples: SAMPLES, ..own });
}

/// One place: sharp near, sharp far, and a pinhole.
pub fn draw_focus(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let own = own_lens(chapter);
    let exhibit = |lens: Lens, line: String| {
        let picture = Picture::of(chapter, SIZE, None, |camera| {
            fewer(camera);
            camera.insert(lens);
        })?;
        Ok(Exhibit { picture, lines: vec![line] })
    };
    let at = |fraction: f64| Lens { focus_distance: own.focus_distance * fraction, ..own };
    let told = |lens: &Lens| format!("focused at {:.1}", lens.focus_distance);
    let closed = Lens { aperture: Aperture::Radius { radius: 0.0 }, ..own };
    let exhibits = [(at(0.6), told(&at(0.6))), (at(1.5), told(&at(1.5))), (closed, "aperture 0: the pinhole".into())];
    let exhibits = exhibits.map(|(lens, line)| exhibit(lens, line)).into_iter().collect::<Result<Vec<_>>>()?;
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}

/// One lens, filled evenly and by a random radius; and with another number of edges.
pub fn draw_openings(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let round = Lens { blades: 0, ..own_lens(chapter) };
    let exhibit = |lens: Lens, stage: Option<Stage>, line: &str| {
        let picture = Picture::of(chapter, SIZE, stage, |camera| {
            fewer(camera);
            camera.insert(lens);
        })?;
        Ok(Exhibit { picture, lines: vec![line.into()] })
    };
    let exhibits = [
        exhibit(round, Some(opening_filled_by(onto_disk)), "equal areas"),
        exhibit(round, Some(opening_filled_by(radius_at_random)), "a random radius"),
        exhibit(Lens { blades: 3, turn: Degrees(90.0), ..round }, None, "three edges"),
    ];
    let exhibits = exhibits.into_iter().collect::<Result<Vec<_>>>()?;
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}

/// The chapter's own lens; the default one where it has none.
fn own_lens(chapter: &Chapter) -> Lens {
    let mut scene = chapter.world(&Default::default());
    scene.query::<&Lens>().iter(&scene).next().copied().unwrap_or_default()
}

/// One scene through three cameras that share the first stages.
pub fn draw_cameras(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let own = Picture::of(chapter, SIZE, None, fewer)?;
    let fisheye = Picture::of(chapter, SIZE, None, |camera| {
        fewer(camera);
        camera.remove::<(PerspectiveCamera, Lens)>();
        camera.insert(FisheyeCamera { fov: Degrees(180.0), axis: FovAxis::Smaller });
    })?;
    let round = Picture::of(chapter, SIZE, None, |camera| {
        fewer(camera);
        camera.remove::<(PerspectiveCamera, Lens)>();
        camera.insert(EquirectangularCamera);
    })?;
    let exhibit = |picture, line: &str| Exhibit { picture, lines: vec![line.into()] };
    let exhibits = [exhibit(own, "a lens"), exhibit(fisheye, "a fisheye of 180°"), exhibit(round, "all directions")];
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}

/// One motion through three shutters.
pub fn draw_shutters(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let mut scene = chapter.world(&Default::default());
    let own = scene.query::<&Shutter>().iter(&scene).next().copied().unwrap_or_default();
    let exhibit = |fraction: f64| {
        let shutter = Shutter { close: own.open + fraction * (own.close - own.open), ..own };
        let picture = Picture::of(chapter, SIZE, None, |camera| {
            fewer(camera);
            camera.insert(shutter);
        })?;
        Ok(Exhibit { picture, lines: vec![format!("open for {:.2}", shutter.close - shutter.open)] })
    };
    let exhibits = [0.0, 0.25, 1.0].map(exhibit).into_iter().collect::<Result<Vec<_>>>()?;
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}

/// The same few moments for all pixels, more of them, and a time for each ray.
pub fn draw_frames(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let exhibit = |stage: Option<Stage>, line: &str| {
        Ok(Exhibit { picture: Picture::of(chapter, SIZE, stage, fewer)?, lines: vec![line.into()] })
    };
    let exhibits = [
        exhibit(Some(moments_in_turn(4)), "the mean of 4 moments"),
        exhibit(Some(moments_in_turn(8)), "the mean of 8 moments"),
        exhibit(None, "a time for each ray"),
    ];
    let exhibits = exhibits.into_iter().collect::<Result<Vec<_>>>()?;
    Ok(hang(figure, &exhibits, 3, &gallery_foot(chapter, figure, SIZE)))
}
