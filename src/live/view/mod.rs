//! A scene in the browser: its page, the orders that the page sends, and the viewer that carries them out.

mod attention;
mod colours;
mod develop;
mod figure;
mod look;
mod memory;
mod modes;
mod orbit;
mod order;
mod pace;
mod painted;
mod reading;
mod reference;
mod scene;
mod serve;
mod sheet;
mod shown;
mod source;
mod traced;
mod undo;
mod viewer;

pub use figure::LiveFigure;
pub use modes::{MODES, Mode};
pub use reference::Reference;
pub use scene::Scene;
pub use source::{FrameSource, Progress, Shot};

use crate::guard::Guard;
use crate::http::{MAX_CONNECTIONS, PATIENCE, start};
use attention::Attention;
use order::{Letter, Orders};
use serve::Desk;
use shown::Shown;
use std::net::TcpListener;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, sync_channel};
use viewer::Viewer;

/// A scene that is shown at an address of this machine.
pub struct View {
    /// The address to open, with the token in it.
    pub address: String,
    viewer: Viewer,
    letters: Receiver<Letter>,
}

/// How a scene is shown.
#[derive(Default)]
pub struct Showing {
    /// The size of the picture; none for the scene's own.
    pub size: Option<pinhole::Size>,
    /// The number of workers; none for one per core.
    pub threads: Option<usize>,
    /// What the picture is compared with.
    pub reference: Option<Reference>,
}

impl View {
    /// Answers from now on; the first picture comes with [`run`](Self::run).
    ///
    /// Errors: the scene cannot be rendered, or the server cannot be started, in one sentence.
    pub fn open(scene: Rc<dyn Scene>, showing: Showing, listener: TcpListener) -> Result<Self, String> {
        let refused = |error: std::io::Error| format!("the viewer cannot be started: {error}");
        let guard = Guard::new(listener.local_addr().map_err(refused)?.port()).map_err(refused)?;
        let address = guard.address();
        let (letters, received) = sync_channel(MAX_CONNECTIONS);
        let attention = Arc::new(Attention::default());
        let (shown, frames) = tokio::sync::watch::channel(Shown::default());
        let viewer = Viewer::new(scene, showing, shown, Arc::clone(&attention))?;
        attention::keep(&attention).map_err(refused)?;
        let desk = Desk::new(guard, Orders::new(letters, attention), frames);
        start(listener, PATIENCE, move |request| desk.clone().answer(request)).map_err(refused)?;
        Ok(Self { address, viewer, letters: received })
    }

    /// Renders what is asked for, for as long as the program runs.
    pub fn run(mut self) {
        self.viewer.run(&self.letters);
    }
}
