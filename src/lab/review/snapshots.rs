use super::{BLOCK_SIDE, Difference, Place, digests, first_difference, probes};
use bevy_ecs::prelude::*;
use image::{ImageFormat, RgbImage};
use pinhole::film::{Curve, byte_from_linear, png_bytes_by};
use pinhole::plan::{Census, Stage};
use pinhole::render::{Execution, prepare, render};
use pinhole::scene::{self, FileKind, Resolution};
use pinhole::{Chapter, Overrides};
use pinhole::{Error, Result};
use std::path::{Path, PathBuf};

const SNAPSHOT: FileKind = FileKind { name: "a snapshot", max: 64 << 20 };

/// The size of a snapshot's picture.
pub const SNAPSHOT_SIZE: Resolution = Resolution { width: 96, height: 54 };

/// The files of a chapter's snapshots, as insta names them.
pub const SNAPSHOT_FILES: [&str; 5] = ["probes.snap", "digests.snap", "plan.snap", "image.snap", "image.snap.png"];

/// How a linear number of the film becomes a byte of the picture.
pub type Develop = fn(f32, Curve) -> u8;

/// The step from film to picture, which no stage makes, as messages name it.
pub const DEVELOP: &str = "Develop";

/// What a chapter computes; empty where nothing is kept.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Snapshots {
    /// A few pixels' rays in numbers: [`probes`].
    pub probes: String,
    /// A short word for every stage and column, and for every block of the film: [`digests`].
    pub digests: String,
    /// Which stages ran, and why.
    pub plan: String,
    /// The bytes of a PNG.
    pub picture: Vec<u8>,
}

impl Snapshots {
    /// What a chapter computes now.
    ///
    /// Errors: what a render would be refused for.
    pub fn of(chapter: &Chapter) -> Result<Self> {
        Self::with_stages(chapter, &chapter.stages(), byte_from_linear)
    }

    /// The same, with other stages on offer or developed otherwise.
    pub fn with_stages(chapter: &Chapter, stages: &[Stage], develop: Develop) -> Result<Self> {
        let world = chapter.world(&Overrides { resolution: Some(SNAPSHOT_SIZE), ..Overrides::default() });
        let rendered = render(&world, stages, &Execution::default(), &())?;
        let curve = rendered.curve();
        Ok(Self {
            probes: probes(&world, stages)?,
            digests: digests(&world, stages)?,
            plan: plan_text(chapter.name, chapter.title, &world, stages)?,
            picture: png_bytes_by(&rendered.film, curve, |part| develop(part, curve))?,
        })
    }

    /// What a folder of snapshots keeps; empty where there is no file.
    pub fn kept(folder: &Path) -> Self {
        Self::read(|file| read_file(&folder.join(file)).ok())
    }

    /// What a folder of snapshots would keep if all that is pending were accepted.
    pub fn pending(folder: &Path) -> Self {
        let pending = |file: &str| folder.join(file.replacen(".snap", ".snap.new", 1));
        Self::read(|file| read_file(&pending(file)).or_else(|_| read_file(&folder.join(file))).ok())
    }

    fn read(read: impl Fn(&str) -> Option<Vec<u8>>) -> Self {
        let text = |file| read(file).map(|bytes| contents(&String::from_utf8_lossy(&bytes))).unwrap_or_default();
        Self {
            probes: text("probes.snap"),
            digests: text("digests.snap"),
            plan: text("plan.snap"),
            picture: read("image.snap.png").unwrap_or_default(),
        }
    }

    /// Where this and a later run part: the first stage whose numbers differ, or else developing.
    pub fn first_difference(&self, now: &Self) -> Option<Difference> {
        first_difference(&self.digests, &now.digests).or_else(|| first_developed(&self.picture, &now.picture))
    }
}

/// What follows the head of a snapshot file, which stands between two lines of three dashes.
fn contents(file: &str) -> String {
    let lines: Vec<&str> = file.lines().skip(1).skip_while(|line| *line != "---").skip(1).collect();
    lines.join("\n")
}

/// The plan of a scene, with its name and title, as the command line prints it.
///
/// Errors: what a render would be refused for.
pub fn plan_text(name: &str, title: &str, scene: &World, stages: &[Stage]) -> Result<String> {
    let (plan, tables) = prepare(&Census::of(scene), stages)?;
    let bytes: usize = tables.iter().map(|table| table.bytes).sum();
    Ok(format!("plan of {name}, {title}\n{plan}tables take {bytes} bytes\n"))
}

/// The first block of pixels that was developed otherwise, where both pictures have the same size.
fn first_developed(old: &[u8], new: &[u8]) -> Option<Difference> {
    let decode = |bytes| image::load_from_memory_with_format(bytes, ImageFormat::Png).map(|image| image.to_rgb8());
    let (old, new): (RgbImage, RgbImage) = (decode(old).ok()?, decode(new).ok()?);
    let (width, height) = old.dimensions();
    if new.dimensions() != (width, height) {
        return None;
    }
    let [across, down] = [width, height].map(|pixels| pixels.div_ceil(BLOCK_SIDE));
    let pixels_of = |block: [u32; 2]| {
        [(block[0], width), (block[1], height)]
            .map(|(block, side)| block * BLOCK_SIDE..=(block * BLOCK_SIDE + BLOCK_SIDE - 1).min(side - 1))
    };
    let differs = |block: &[u32; 2]| {
        let [xs, ys] = pixels_of(*block);
        ys.flat_map(|y| xs.clone().map(move |x| (x, y))).any(|(x, y)| old.get_pixel(x, y) != new.get_pixel(x, y))
    };
    let blocks = (0..down).flat_map(|y| (0..across).map(move |x| [x, y]));
    let differing: Vec<[u32; 2]> = blocks.filter(differs).collect();
    let block = *differing.first()?;
    let (differing, blocks) = (differing.len(), (across * down) as usize);
    let place = Place::Block { block, pixels: pixels_of(block), differing, blocks };
    Some(Difference { stage: DEVELOP.into(), column: "picture".into(), place })
}

/// The folder of a chapter's snapshots.
pub fn snapshot_folder(chapters: &Path, chapter: &str) -> PathBuf {
    chapters.join(chapter).join("snapshots")
}

/// A file's bytes.
///
/// Errors: the file and what the system said.
pub(super) fn read_file(path: &Path) -> Result<Vec<u8>> {
    scene::read_file(path, SNAPSHOT).map_err(|error| Error::Usage(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;
    use std::io::Cursor;

    #[test]
    fn the_head_of_a_snapshot_file_is_left_out() {
        assert_eq!(contents("---\nsource: a.rs\n---\none\n\n---\ntwo\n"), "one\n\n---\ntwo");
        assert_eq!(contents("---\r\nsource: a.rs\r\n---\r\none\r\n"), "one");
    }

    #[test]
    fn where_only_bytes_differ_developing_is_named_and_the_first_block() {
        let png = |change: Option<(u32, u32)>| {
            let mut image = RgbImage::from_pixel(20, 10, Rgb([1, 2, 3]));
            if let Some((x, y)) = change {
                image.put_pixel(x, y, Rgb([1, 2, 4]));
            }
            let mut bytes = Cursor::new(Vec::new());
            image.write_to(&mut bytes, ImageFormat::Png).expect("encodes");
            Snapshots { picture: bytes.into_inner(), ..Snapshots::default() }
        };
        assert_eq!(png(None).first_difference(&png(None)), None);
        let told = png(None).first_difference(&png(Some((17, 9)))).map(|difference| difference.to_string());
        let expected = "the first stage whose numbers differ is \"Develop\" (column picture); \
            in the picture 1 of 6 blocks differ, the first at pixels 16..19, 8..9";
        assert_eq!(told.as_deref(), Some(expected));
    }
}
