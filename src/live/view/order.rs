use super::attention::Attention;
use super::look::{Look, PageSize, Region};
use super::orbit::CameraAt;
use crate::answer::Answer;
use serde::Deserialize;
use std::sync::Arc;
use std::sync::mpsc::SyncSender;
use tokio::sync::oneshot;

/// What a page asks of the viewer; lengths are fractions of the picture's height, points fractions of its sides.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Order {
    /// Turn the camera around its target, to the right and down.
    Orbit([f64; 2]),
    /// Move the camera along the image.
    Pan([f64; 2]),
    /// Bring the target nearer by this factor.
    Zoom(f64),
    /// Turn around what is seen at a point of the picture from now on.
    Focus([f64; 2]),
    /// Go back to the camera as the scene says.
    Reset,
    /// Put the camera there.
    Camera(CameraAt),
    /// Take the last movement or edit back.
    Undo,
    /// Take that back in turn.
    Redo,
    /// Render as the mode of this key does.
    Mode(char),
    /// Paint this column, a component of it such as `ndc.x`, a number of the picture such as `.luminance`, or the picture
    /// again.
    Column(Option<String>),
    /// Show the film so.
    Look(Look),
    /// Keep the picture as the reference, or forget the reference.
    Reference(bool),
    /// Take no further samples, or go on.
    Pause(bool),
    /// Take further samples within this part of the picture alone, or everywhere.
    Region(Option<Region>),
    /// Render so many pixels, or as many as the scene or the command line says.
    Size(Option<PageSize>),
    /// Offer a stage, or take it out of the offer.
    Stage(String, bool),
    /// Show the scene of this text.
    Apply(String),
    /// The same, and write the text to its file.
    Save(String),
    /// Put the camera into the scene's text as it has been moved.
    PutView,
    /// Say what every stage wrote for the pixel at a point of the picture.
    Trace([f64; 2]),
    /// Read these pixels with every frame from now on, and say now what their rays hit.
    Pin(Vec<[f64; 2]>),
    /// Say what can be chosen and what is chosen.
    Sheet,
    /// Encode the picture so far.
    Picture(Kind),
}

/// A kind of picture file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// 8-bit sRGB.
    Png,
    /// Linear floats.
    Exr,
}

/// An order and where its answer goes.
pub(crate) type Letter = (Order, oneshot::Sender<Answer>);

/// Hands orders over to the viewer, and makes it look up from a frame that takes long.
#[derive(Clone)]
pub(crate) struct Orders {
    letters: SyncSender<Letter>,
    attention: Arc<Attention>,
}

impl Orders {
    /// Orders that wait here until the viewer takes them.
    pub fn new(letters: SyncSender<Letter>, attention: Arc<Attention>) -> Self {
        Self { letters, attention }
    }

    /// Somebody looks at the page.
    pub fn looked(&self) {
        self.attention.looked();
    }

    /// The viewer's answer; none where too many orders wait already, or nobody answers any more.
    pub async fn answer(&self, order: Order) -> Option<Answer> {
        let (send, receive) = oneshot::channel();
        self.letters.try_send((order, send)).ok()?;
        self.attention.order();
        receive.await.ok()
    }
}
