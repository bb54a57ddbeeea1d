use crate::chapter::{Asked, Chapter};
use crate::extract::camera_entity;
use crate::film::png_bytes;
use crate::plan::Stage;
use crate::render::{Execution, render};
use crate::scene::Resolution;
use crate::{Result, intersect, rays, shade};
use bevy_ecs::prelude::*;

/// A picture of a chapter's scene, rendered for a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels from left to right and from top to bottom.
    pub size: [u32; 2],
    /// The PNG as an address that holds it.
    pub data: String,
}

impl Picture {
    /// Renders a chapter's scene with all stages that the kit has, after `change` has had its camera.
    ///
    /// `instead` takes the place of the stages that stand where it stands in the order.
    /// Errors: what a render of that scene would be refused for.
    pub fn of(
        chapter: &Chapter,
        size: [u32; 2],
        instead: Option<Stage>,
        change: impl FnOnce(&mut EntityWorldMut<'_>),
    ) -> Result<Self> {
        let mut whole = chapter.clone();
        whole.view = None;
        whole.offer = [rays::stages(), intersect::stages(), shade::stages()].concat();
        if let Some(stage) = instead {
            whole.offer.retain(|other| other.set != stage.set);
            whole.offer.push(stage);
        }
        let [width, height] = size;
        let asked = Asked { resolution: Some(Resolution { width, height }), ..Asked::default() };
        let mut scene = whole.world(&asked);
        let camera = camera_entity(&scene)?;
        change(&mut scene.entity_mut(camera));
        let rendered = render(&scene, &whole.stages(), &Execution::default(), &())?;
        let png = png_bytes(&rendered.film, rendered.curve())?;
        Ok(Self { size, data: format!("data:image/png;base64,{}", base64(&png)) })
    }
}

/// Bytes as RFC 4648 writes them: six bits a letter, filled up with = to a multiple of four.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for three in bytes.chunks(3) {
        let bits = (0..3).fold(0_u32, |bits, place| bits << 8 | u32::from(*three.get(place).unwrap_or(&0)));
        for letter in 0..4 {
            let six = (bits >> (18 - 6 * letter) & 63) as usize;
            text.push(if letter <= three.len() { char::from(LETTERS[six]) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_written_as_rfc_4648_says() {
        let vectors =
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg=="), ("fooba", "Zm9vYmE=")];
        for (text, expected) in vectors {
            assert_eq!(base64(text.as_bytes()), expected);
        }
        assert_eq!(base64(&[0xfb, 0xff, 0xfe]), "+//+");
    }
}
