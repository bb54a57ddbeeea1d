use super::error::{Error, Result};
use super::options::RenderOptions;
use super::subject::Subject;
use pinhole::film::{
    Curve, FileAttributes, Film, PngKind, Replaces, Target, check_place, denoise_picture, film_of_radiance,
    may_be_written, png_bytes_as, write_exr_with, write_png_as,
};
use pinhole::render::{RenderInProgress, samples_after};
use pinhole::scene::printable_path;
use pinhole_lab::exercise::Mine;
use std::borrow::Cow;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Where a picture goes.
#[derive(Clone, Default)]
pub struct Targets {
    /// The files, each PNG or EXR.
    pub pictures: Vec<PathBuf>,
    /// Whether a PNG goes to standard output.
    pub standard_output: bool,
    /// Whether the reader has named them, so that they replace what is there.
    pub named: bool,
    /// What is to be said of where they go.
    pub note: Option<String>,
}

/// How many names are tried in `out/`.
const MAX_NAMES: u32 = 99;

impl Targets {
    /// What is asked for, or both kinds in `out/`.
    pub fn of(subject: &Subject<'_>, options: &RenderOptions) -> Result<Self> {
        if options.output.is_empty() {
            let column = options.scene.view.as_ref().map(|column| column.replace([' ', '/', '\\'], "_"));
            let naive = options.naive.map(|method| method.name.to_owned());
            let stem = [Some(subject.stem()), naive, column].into_iter().flatten().collect::<Vec<_>>().join("_");
            return Ok(Self::in_out(&stem));
        }
        let mut targets = Self { named: !options.output_is_chosen, ..Self::default() };
        for file in &options.output {
            if file.as_os_str() == "-" {
                targets.standard_output = true;
            } else if !is(file, "png") && !is(file, "exr") {
                return Err(Error::CommandLine(format!(
                    "cannot write {}: the name must end in .png, for a picture to look at, or .exr, for its light in full",
                    printable_path(file)
                )));
            } else if !targets.pictures.contains(file) {
                targets.pictures.push(file.clone());
            }
        }
        if options.bits.is_some() && !targets.standard_output && targets.pictures.iter().all(|file| is(file, "exr")) {
            let what = "--bits is the depth of a PNG, and no PNG is written: an EXR holds floats of 32 bits";
            return Err(Error::CommandLine(what.into()));
        }
        Ok(targets)
    }

    /// Both kinds in `out/`, under the first name that belongs to no file of others.
    fn in_out(stem: &str) -> Self {
        let pictures = |number: u32| {
            let stem = if number == 1 { stem.to_owned() } else { format!("{stem}-{number}") };
            ["png", "exr"].map(|ending| Path::new("out").join(format!("{stem}.{ending}")))
        };
        let is_free = |number: &u32| pictures(*number).iter().all(|file| may_be_written(Replaces::Own.at(file)));
        // Where none is, writing says why.
        let number = (1..=MAX_NAMES).find(is_free).unwrap_or(1);
        let mut targets = Self { pictures: pictures(number).to_vec(), ..Self::default() };
        if let (2.., Some(taken)) = (number, pictures(1).iter().find(|file| !may_be_written(Replaces::Own.at(file)))) {
            let taken = printable_path(taken);
            let told = targets.told(None);
            targets.note =
                Some(format!("note: {taken} is not pinhole's to replace and stays, so this picture is {told}"));
        }
        targets
    }

    /// Checks that all of them can be written.
    ///
    /// Errors: the first that cannot, and why.
    pub fn check(&self) -> pinhole::Result {
        self.pictures.iter().try_for_each(|picture| check_place(self.place(picture)))
    }

    fn place<'p>(&self, picture: &'p Path) -> Target<'p> {
        Replaces::if_named(self.named).at(picture)
    }

    /// Whether one of them holds layers.
    pub fn hold_layers(&self) -> bool {
        self.pictures.iter().any(|file| is(file, "exr"))
    }

    /// The checkpoint: beside the first picture, with its name; none where only standard output is written to.
    pub fn checkpoint(&self) -> Option<PathBuf> {
        self.pictures.first().map(|picture| picture.with_extension("checkpoint"))
    }

    /// All of them by name, with `and` before the last; one that differs from the first in its ending only is told by
    /// that.
    pub fn told(&self, checkpoint: Option<&Path>) -> String {
        let first = self.pictures.first();
        let name = |file: &Path| match (first, file.extension()) {
            (Some(first), Some(ending)) if file != first && first.with_extension("") == file.with_extension("") => {
                format!(".{}", ending.to_string_lossy())
            }
            _ => printable_path(file),
        };
        let files = self.pictures.iter().map(PathBuf::as_path).chain(checkpoint).map(name);
        let names: Vec<String> =
            self.standard_output.then(|| "standard output".into()).into_iter().chain(files).collect();
        match names.split_last() {
            Some((last, [])) => last.clone(),
            Some((last, before)) => format!("{} and {last}", before.join(", ")),
            None => String::new(),
        }
    }
}

/// The picture's files, and how they are written.
pub struct Files {
    /// Where they go.
    pub targets: Targets,
    /// What an EXR says beside its pixels.
    attributes: FileAttributes,
    /// Whether the picture is smoothed along its surfaces.
    is_denoised: bool,
    curve: Curve,
    png: PngKind,
    /// The seed of the random numbers, where the camera takes any.
    seed: Option<u64>,
    /// The reader's function, where it stands in a stage; nothing is written once it fails.
    mine: Option<Mine>,
}

impl Files {
    /// The files of a scene's pictures.
    pub fn new(
        targets: Targets,
        (attributes, is_denoised): (FileAttributes, bool),
        render: &RenderInProgress,
        (png, mine): (PngKind, Option<Mine>),
    ) -> Self {
        let seed = render.is_sampled().then_some(render.sampling.seed);
        Self { targets, attributes, is_denoised, curve: render.curve, png, seed, mine }
    }

    /// Writes the files anew, each whole, and each whether or not another can be written.
    ///
    /// Errors: the first that there was.
    pub fn write(&self, film: &Film) -> pinhole::Result {
        let denoised = self.denoised(film);
        let written = self.targets.pictures.iter().map(|picture| self.write_one(film, denoised.as_ref(), picture));
        written.fold(Ok(()), pinhole::Result::and)
    }

    /// The film's radiance, denoised, where that is asked for.
    pub fn denoised(&self, film: &Film) -> Option<[Vec<f32>; 3]> {
        if self.is_denoised { denoise_picture(film) } else { None }
    }

    /// Writes one of them.
    pub fn write_one(&self, film: &Film, denoised: Option<&[Vec<f32>; 3]>, picture: &Path) -> pinhole::Result {
        self.mine.as_ref().map_or(Ok(()), Mine::answers)?;
        let place = self.targets.place(picture);
        match is(picture, "exr") {
            true => write_exr_with(film, denoised, &self.attributes, place),
            false => write_png_as(&shown(film, denoised), self.curve, &self.png_of(film), place),
        }
    }

    /// The kind of a PNG that says how far the film has come.
    fn png_of(&self, film: &Film) -> PngKind {
        let mut png = self.png.clone();
        png.text.extend(self.seed.map(|seed| ("Seed", seed.to_string())));
        let samples = film.done.iter().copied().min().map_or(0, samples_after);
        // Adaptive sampling gives each pixel another number.
        if self.seed.is_some() && film.planned.is_empty() {
            png.text.push(("Samples", samples.to_string()));
        }
        png
    }

    /// Sends the picture to standard output, where that is asked for.
    pub fn send(&self, film: &Film, out: &mut dyn Write) -> Result {
        self.mine.as_ref().map_or(Ok(()), Mine::answers)?;
        if self.targets.standard_output {
            let picture = shown(film, self.denoised(film).as_ref()).into_owned();
            out.write_all(&png_bytes_as(&picture, self.curve, &self.png_of(film))?)?;
            out.flush()?;
        }
        Ok(())
    }
}

/// The film that a PNG shows.
fn shown<'f>(film: &'f Film, denoised: Option<&[Vec<f32>; 3]>) -> Cow<'f, Film> {
    denoised.map_or(Cow::Borrowed(film), |radiance| Cow::Owned(film_of_radiance(radiance, film)))
}

fn is(file: &Path, ending: &str) -> bool {
    file.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_that_differ_in_their_ending_are_told_once() {
        let told = |files: &[&str], checkpoint: Option<&str>, standard_output: bool| {
            let pictures = files.iter().map(PathBuf::from).collect();
            Targets { pictures, standard_output, ..Targets::default() }.told(checkpoint.map(Path::new))
        };
        assert_eq!(told(&["out/a.png", "out/a.exr"], None, false), "out/a.png and .exr");
        assert_eq!(told(&["a.png", "a.exr"], Some("a.checkpoint"), false), "a.png, .exr and .checkpoint");
        assert_eq!(told(&["a.png", "b.exr"], None, false), "a.png and b.exr");
        assert_eq!(told(&["a.b.png"], None, false), "a.b.png");
        assert_eq!(told(&["a.exr"], None, true), "standard output and a.exr");
        assert_eq!(told(&["a\n.png"], None, false), "a\\n.png");
    }
}
