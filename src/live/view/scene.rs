use bevy_ecs::prelude::World;
use pinhole::prelude::Stage;
use std::path::PathBuf;
use std::rc::Rc;

/// What is shown: a scene with its text, which can be edited and saved.
pub trait Scene {
    /// What a reader calls it.
    fn name(&self) -> String;

    /// The name of its pictures, without an ending.
    fn stem(&self) -> String;

    /// Its text as a scene file, with the reader's own layout and comments where there is a file.
    fn text(&self) -> String;

    /// The scene, made anew.
    fn world(&self) -> World;

    /// The stages on offer.
    fn stages(&self) -> Vec<Stage>;

    /// An error of the renderer as one sentence, with line and column where the text is at fault.
    fn explain(&self, error: pinhole::Error) -> String;

    /// The scene of another text.
    ///
    /// Errors: the first mistake in the text, with line and column.
    fn edited(&self, text: String) -> Result<Rc<dyn Scene>, String>;

    /// Writes its text to its file as a whole, and says where that is.
    ///
    /// Errors: why the file cannot be written; what was there is unchanged.
    fn save(&self) -> Result<PathBuf, String>;
}
