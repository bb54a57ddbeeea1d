use super::called::{called, quoted};
use super::options::RenderOptions;
use super::subject::Subject;
use super::visible::is_hidden;
use pinhole::rays::Tile;

/// The command that says which stages a render's scene needs, and why the others were left out.
pub fn plan(subject: &Subject<'_>, options: &RenderOptions) -> String {
    match name(subject) {
        Some(name) => called(&format!("plan {name}{}", options.scene.typed())),
        None => "-v".into(),
    }
}

/// A command to go on with, which works as it stands: one pixel of what was rendered, in numbers; a lit one, where one is
/// known.
pub fn next(
    subject: &Subject<'_>,
    options: &RenderOptions,
    [width, height]: [u32; 2],
    lit_pixel: Option<[u32; 2]>,
) -> Option<String> {
    let name = name(subject)?;
    let [x, y] = lit_pixel.unwrap_or([width / 2, height * 3 / 5]);
    let pixel = format!("{x},{y}");
    let size = if options.scene.sets_resolution() { format!(" --size {width}x{height}") } else { String::new() };
    Some(called(&format!("trace {name} --pixel {pixel}{size}{}", options.scene.typed_settings())))
}

/// The command that renders the same picture, on any machine and however it is stopped on the way.
pub fn same_picture(subject: &Subject<'_>, options: &RenderOptions, [width, height]: [u32; 2]) -> Option<String> {
    let name = name(subject)?;
    let naive = options.naive.map(|method| format!(" --naive {}", method.name)).unwrap_or_default();
    let crop = options.crop.map(|Tile { x, y, width, height }| format!(" --crop {x},{y},{width},{height}"));
    let crop = crop.unwrap_or_default();
    Some(format!("pinhole render {name} --size {width}x{height}{}{crop}{naive}", options.scene.typed()))
}

/// What names a subject again, for a shell; nothing does for what came through a pipe, or cannot be shown.
fn name(subject: &Subject<'_>) -> Option<String> {
    match subject.name() {
        "-" => None,
        name if name.contains(is_hidden) => None,
        name => Some(quoted(name)),
    }
}
