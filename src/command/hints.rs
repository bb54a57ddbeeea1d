use super::called::{called, quoted};
use super::options::{MOMENTS, RenderOptions};
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
///
/// It is made of what its light depends on, so that neither the name of a file nor a stop changes it.
pub fn same_picture(subject: &Subject<'_>, options: &RenderOptions, mine: bool) -> Option<String> {
    let name = name(subject)?;
    let naive = options.naive.map(|method| format!(" --naive {}", method.name)).unwrap_or_default();
    let mine = if mine { " --mine" } else { "" };
    let size = options.scene.typed_size();
    let frame = options.frame.map(|frame| format!(" --frames {frame}..{frame} --fps {}", options.fps));
    let moments =
        options.frame.filter(|_| options.moments != MOMENTS).map(|_| format!(" --moments {}", options.moments));
    let frame = [frame, moments].into_iter().flatten().collect::<String>();
    let crop = options.crop.map(|Tile { x, y, width, height }| format!(" --crop {x},{y},{width},{height}"));
    let crop = crop.unwrap_or_default();
    Some(format!("pinhole render {name}{size}{}{frame}{crop}{naive}{mine}", options.scene.typed()))
}

/// What a PNG says of where it is from: the scene, the number of a frame, and the command that renders it.
pub fn provenance(subject: &Subject<'_>, options: &RenderOptions, mine: bool) -> Vec<(&'static str, String)> {
    let Some(command) = same_picture(subject, options, mine) else { return Vec::new() };
    let number = options.frame.map(|frame| ("Frame", frame.to_string()));
    [("Scene", subject.name().to_owned()), ("Command", command)].into_iter().chain(number).collect()
}

/// What names a subject again, for a shell; nothing does for what came through a pipe, or cannot be shown.
fn name(subject: &Subject<'_>) -> Option<String> {
    match subject.name() {
        "-" => None,
        name if name.contains(is_hidden) => None,
        name => Some(quoted(name)),
    }
}
