use super::develop::Scale;
use super::reading::Reading;
use hyper::body::Bytes;
use serde::Serialize;

/// What a page is told beside the pixels of a frame.
#[derive(Serialize)]
pub struct FrameHead<'a> {
    /// The frame's number, from 1.
    pub frame: u64,
    /// The number of the last movement or change that it shows.
    pub change: u64,
    /// The size in pixels.
    pub size: [u32; 2],
    /// The samples of each pixel, and how many there will be.
    pub samples: [u32; 2],
    /// How long the frame took, in milliseconds, from the scene to the pixels.
    pub milliseconds: f64,
    /// What the stages took for it, each by its name, in milliseconds summed over the workers.
    pub stages: Vec<(&'a str, f64)>,
    /// What the colours of false colour mean.
    pub scale: Option<Scale>,
    /// How far the picture is from the reference.
    pub rel_mse: Option<f64>,
    /// The pixel under the pointer, and those that are pinned.
    pub pixels: Vec<Option<Reading>>,
    /// Why there is no newer picture.
    pub error: Option<String>,
}

/// A frame as it is sent: the length of what is told, that as JSON, and the pixels, 8-bit RGBA row by row.
#[derive(Clone, Default)]
pub struct Shown {
    /// The frame's number; 0 before the first.
    pub frame: u64,
    /// What is sent.
    pub body: Bytes,
}

impl Shown {
    /// Puts it together.
    pub fn new(head: &FrameHead<'_>, pixels: &[u8]) -> Self {
        let json = serde_json::to_vec(head).unwrap_or_default();
        let mut body = Vec::with_capacity(4 + json.len() + pixels.len());
        body.extend_from_slice(&(json.len() as u32).to_le_bytes());
        body.extend_from_slice(&json);
        body.extend_from_slice(pixels);
        Self { frame: head.frame, body: body.into() }
    }
}
