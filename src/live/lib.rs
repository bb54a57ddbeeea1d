//! Shows what pinhole renders in a browser on the same machine, and takes the reader's input.
//!
//! A server on 127.0.0.1 answers within bounds of time, memory and connections.
//! With the feature `view`, it shows a scene to whoever knows the token in its address: a viewer renders what the reader
//! has chosen, and hands one frame after another to the page.
//! The page, its script and its style are part of the program; nothing is fetched from anywhere else.

mod answer;
mod guard;
mod http;
#[cfg_attr(not(feature = "view"), allow(dead_code, reason = "only the view asks whose a connection is"))]
mod peer;
#[cfg(feature = "view")]
mod view;

pub use answer::Answer;
pub use guard::Guard;
pub use http::{LONGEST_HEAD, MAX_CONNECTIONS, PATIENCE, start};
#[cfg(feature = "view")]
pub use view::{FrameSource, LiveFigure, MODES, Mode, Progress, Reference, Scene, Shot, Showing, View};
