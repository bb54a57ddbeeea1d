use crate::printable;
use std::collections::BTreeMap;
use std::sync::Arc;

/// What the materials of a model say and its picture does not show, counted.
#[derive(Debug, Default)]
pub struct MaterialNotes {
    /// Glass with an alpha.
    pub glass_alphas: usize,
    /// Those that are meant to be seen from one side, of meshes that can be seen from the other.
    pub seen_from_behind: usize,
    /// Those that transmit a part of the light that enters.
    pub in_part: usize,
    /// Glass with an interior whose meshes are open.
    pub open_glass: usize,
    /// Panes that are rough.
    pub frosted: usize,
    /// Glass with an interior and a base colour.
    pub tinted: usize,
    /// Glass with a texture of colour.
    pub glass_colours: usize,
    /// Glass with a texture of roughness.
    pub glass_roughnesses: usize,
    /// Why images were replaced, one clause each, and the names of the materials that have them.
    pub missing_images: BTreeMap<String, Vec<Arc<str>>>,
}

/// How many missing images are named.
const NAMED: usize = 8;

impl MaterialNotes {
    /// What there is to say, in one sentence each.
    pub fn sentences(&self) -> Vec<String> {
        let counted = [
            (
                self.seen_from_behind,
                "is single-sided (doubleSided is false)",
                "are single-sided (doubleSided is false)",
                "the back, which the file wants left out, is seen (single_sided=true leaves it out)",
            ),
            (
                self.in_part,
                "transmits a part of the light",
                "transmit a part of the light",
                "more than half of it counts as all, and less as nothing",
            ),
            (
                self.open_glass,
                "is glass with a thickness on an open mesh",
                "are glass with a thickness on open meshes",
                "drawn as a thin pane, for an open mesh has no interior",
            ),
            (self.frosted, "is thin rough glass", "are thin rough glass", "drawn clear"),
            (
                self.tinted,
                "is solid glass with a base colour",
                "are solid glass with a base colour",
                "the colour is left out, for only absorption tints solid glass",
            ),
            (self.glass_alphas, "of glass has an alpha", "of glass have an alpha", LEFT_OUT),
            (self.glass_colours, "of glass has a texture of colour", "of glass have a texture of colour", LEFT_OUT),
            (
                self.glass_roughnesses,
                "of glass has a texture of metallic and roughness",
                "of glass have a texture of metallic and roughness",
                LEFT_OUT,
            ),
        ];
        let mut sentences: Vec<String> = counted
            .into_iter()
            .filter(|(count, ..)| *count > 0)
            .map(|(count, one, many, here)| match count {
                1 => format!("1 material {one}: {here}."),
                _ => format!("{count} materials {many}: {here}."),
            })
            .collect();
        sentences.extend(
            self.missing_images
                .iter()
                .take(NAMED)
                .map(|(why, materials)| format!("{} by the material's own numbers: {why}.", replaced(materials))),
        );
        let more = self.missing_images.len().saturating_sub(NAMED);
        if more > 0 {
            sentences.push(format!("{more} more images are replaced by their materials' own numbers."));
        }
        sentences
    }
}

/// Whose image is replaced: the first of several materials is named.
fn replaced(materials: &[Arc<str>]) -> String {
    let named = |name: &str| format!("An image of the material \"{}\"", printable(name, 80));
    match materials {
        [one] if !one.is_empty() => format!("{} is replaced", named(one)),
        [one, more @ ..] if !one.is_empty() => {
            let others = if more.len() == 1 { "another".to_owned() } else { format!("{} others", more.len()) };
            format!("{} and {others} is replaced", named(one))
        }
        _ => "An image is replaced".into(),
    }
}

const LEFT_OUT: &str = "left out";
