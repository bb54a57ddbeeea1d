//! The channels of a film's OpenEXR file: how they are called, and what they hold.

use super::cryptomatte::{RANKS, ranked};
use super::develop::finite;
use super::{FileAttributes, Film};
use crate::rays::Tile;
use crate::scene::LayerKind;
use exr::prelude::{ChannelDescription, SampleType, Text, Vec2};
use std::ops::Range;

/// Whose names the channels of a file have.
///
/// A layer that a program has no name for keeps pinhole's.
/// Normals and positions are in the space that their layer says, whatever the names.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LayerNames {
    /// Pinhole's: the layer's word, a dot, a letter; R, G, B, and A beside the layer `coverage`, without a layer; and Z for
    /// the depth along the axis.
    #[default]
    Pinhole,
    /// Those of Blender's compositor: the passes of `CyclesRender` under the view layer `ViewLayer`, as Blender 5.0 writes
    /// them: `Combined`, `Depth`, `Normal` (the shading normal), `Position`, `UV`, `Denoising Albedo`, `Denoising Normal`
    /// (in camera space, whose z axis points forward in Cycles and backward here), `Debug Sample Count`, `CryptoObject00`.
    Blender,
    /// Those of PBRT's `GBufferFilm` in world space (film.cpp), which its `imgtool denoise-optix` looks for: `Albedo`, `P`,
    /// `N`, `Ns`, `u` and `v`.
    Pbrt,
    /// Those that `split_exr.py` of Open Image Denoise takes a picture apart by: `albedo` and `normal`, for which the
    /// library's manual wants the shading normal; beside that, the geometric one is `geometric_normal`.
    Oidn,
}

impl LayerNames {
    /// All of them, each with its word on the command line.
    pub const ALL: [(&str, Self); 4] =
        [("pinhole", Self::Pinhole), ("blender", Self::Blender), ("pbrt", Self::Pbrt), ("oidn", Self::Oidn)];

    /// The view layer that a name begins with.
    pub(super) fn view_layer(self) -> &'static str {
        if self == Self::Blender { "ViewLayer." } else { "" }
    }

    /// The name of a channel of radiance.
    fn of_radiance(self, letter: &str) -> String {
        match self {
            Self::Blender => format!("ViewLayer.Combined.{letter}"),
            _ => letter.into(),
        }
    }

    fn of_noisy(self, letter: &str) -> String {
        match self {
            Self::Blender => format!("ViewLayer.Noisy Image.{letter}"),
            _ => format!("noisy.{letter}"),
        }
    }

    /// The name of a channel of a layer; `kinds` are all layers of the file.
    fn of_layer(self, kind: LayerKind, channel: usize, kinds: &[LayerKind]) -> String {
        let own = kind.channels()[channel];
        let (layer, letter) = own.rsplit_once('.').unwrap_or(("", own));
        let layer = match (self, kind) {
            (Self::Blender, LayerKind::DepthAlongAxis) => "Depth",
            (_, LayerKind::DepthAlongAxis) => return letter.into(),
            (Self::Blender, LayerKind::Samples) => return "ViewLayer.Debug Sample Count.X".into(),
            (Self::Blender, LayerKind::Position) => "Position",
            (Self::Blender, LayerKind::ShadingNormal) => "Normal",
            (Self::Blender, LayerKind::ShadingNormalCamera) => "Denoising Normal",
            (Self::Blender, LayerKind::Uv) => "UV",
            (Self::Blender, LayerKind::Albedo) => "Denoising Albedo",
            // Beside Blender's own `Normal`, which differs from it by more than a letter.
            (Self::Blender, LayerKind::Normal) => "Geometric Normal",
            (Self::Pbrt, LayerKind::Position) => "P",
            (Self::Pbrt, LayerKind::Normal) => "N",
            (Self::Pbrt, LayerKind::ShadingNormal) => "Ns",
            (Self::Pbrt, LayerKind::Albedo) => "Albedo",
            (Self::Pbrt, LayerKind::Uv) => return letter.to_lowercase(),
            (Self::Oidn, LayerKind::ShadingNormal) => "normal",
            (Self::Oidn, LayerKind::Normal) if kinds.contains(&LayerKind::ShadingNormal) => "geometric_normal",
            _ => layer,
        };
        format!("{}{layer}.{letter}", self.view_layer())
    }
}

/// What a channel holds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Held {
    /// A component of the picture's radiance.
    Radiance(usize),
    /// A component of the film's radiance, beside the denoised.
    Noisy(usize),
    /// How much of what is behind the picture it hides; radiance has been multiplied by it.
    Alpha {
        /// Whether that is everything, since light comes from where nothing is hit.
        has_sky: bool,
    },
    /// A channel of a layer.
    Layer(LayerKind, usize),
}

/// A channel of a film's file.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ExrChannel {
    name: String,
    held: Held,
}

/// The depth where nothing is hit, as Blender writes it.
pub const NO_DEPTH: f32 = 1e10;

/// The channels of a film, sorted by name, as the format wants them.
pub(super) fn channels(film: &Film, has_denoised: bool, about: &FileAttributes) -> Vec<ExrChannel> {
    let kinds = film.layers.first().map_or(&[][..], |layers| &layers.kinds);
    let names = about.layer_names;
    let channel = |name: String, held: Held| ExrChannel { name, held };
    let mut channels = Vec::new();
    for (at, letter) in ["R", "G", "B"].into_iter().enumerate() {
        channels.push(channel(names.of_radiance(letter), Held::Radiance(at)));
        if has_denoised {
            channels.push(channel(names.of_noisy(letter), Held::Noisy(at)));
        }
    }
    if kinds.contains(&LayerKind::Coverage) {
        channels.push(channel(names.of_radiance("A"), Held::Alpha { has_sky: about.has_sky }));
    }
    for &kind in kinds {
        let of_kind = (0..kind.channels().len()).map(|at| (names.of_layer(kind, at, kinds), Held::Layer(kind, at)));
        channels.extend(of_kind.map(|(name, held)| channel(name, held)));
    }
    channels.sort_by(|one, other| one.name.as_bytes().cmp(other.name.as_bytes()));
    channels
}

impl ExrChannel {
    pub fn description(&self) -> ChannelDescription {
        let is_count = matches!(self.held, Held::Layer(LayerKind::Entity | LayerKind::Samples, _));
        ChannelDescription {
            name: Text::from_slice_unchecked(self.name.as_bytes()),
            sample_type: if is_count { SampleType::U32 } else { SampleType::F32 },
            quantize_linearly: false,
            sampling: Vec2(1, 1),
        }
    }

    /// Appends a line of all channels, one after the other, in the machine's order of bytes.
    pub fn write_line(
        (channels, hashes): (&[Self], &[u32]),
        film: &Film,
        denoised: Option<&[Vec<f32>; 3]>,
        y: u32,
        bytes: &mut Vec<u8>,
    ) {
        let pieces: Vec<Piece> = pieces(film, y).collect();
        let pixels = || pieces.iter().flat_map(|piece| piece.rows.clone().zip(piece.x..).map(|at| (piece.tile, at)));
        let means: Vec<[f32; 3]> = pixels().map(|(tile, (row, x))| film.mean_in(tile, row, [x, y])).collect();
        let is_matte = |channel: &Self| matches!(channel.held, Held::Layer(LayerKind::Cryptomatte, _));
        let ranked: Vec<[f32; 2 * RANKS]> = match channels.iter().any(is_matte) {
            true => pixels().map(|(tile, (row, _))| ranked(&film.layers[tile], row, hashes)).collect(),
            false => Vec::new(),
        };
        let line = y as usize * means.len()..(y as usize + 1) * means.len();
        for channel in channels {
            match (channel.held, denoised) {
                (Held::Radiance(part), Some(shown)) => put(bytes, shown[part][line.clone()].iter().copied()),
                (Held::Radiance(part), None) | (Held::Noisy(part), _) => {
                    put(bytes, means.iter().map(|mean| mean[part]))
                }
                (Held::Alpha { has_sky: true }, _) => put(bytes, means.iter().map(|_| 1.0)),
                (Held::Alpha { has_sky: false }, _) => {
                    pieces.iter().for_each(|piece| put_layer(bytes, film, LayerKind::Coverage, 0, piece));
                }
                (Held::Layer(LayerKind::Cryptomatte, part), _) => put(bytes, ranked.iter().map(|own| own[part])),
                (Held::Layer(kind, part), _) => {
                    pieces.iter().for_each(|piece| put_layer(bytes, film, kind, part, piece));
                }
            }
        }
    }
}

/// A part of a line that lies in one tile: its rows there, and the place of its first pixel in the line.
struct Piece {
    tile: usize,
    rows: Range<usize>,
    x: u32,
}

/// The parts of a line, from left to right.
fn pieces(film: &Film, y: u32) -> impl Iterator<Item = Piece> + '_ {
    let side = film.tile_side;
    let across = film.width.div_ceil(side);
    (0..across).map(move |column| {
        let tile = (y / side * across + column) as usize;
        let Tile { width, .. } = film.tiles[tile].tile;
        let first = (y % side * width) as usize;
        Piece { tile, rows: first..first + width as usize, x: column * side }
    })
}

/// Appends numbers.
fn put(bytes: &mut Vec<u8>, values: impl Iterator<Item = f32>) {
    values.for_each(|value| bytes.extend_from_slice(&value.to_ne_bytes()));
}

/// Appends a channel of a layer.
fn put_layer(bytes: &mut Vec<u8>, film: &Film, kind: LayerKind, channel: usize, Piece { tile, rows, .. }: &Piece) {
    let (layers, film_tile) = (&film.layers[*tile], &film.tiles[*tile]);
    let mut put_counts = |counts: &[u32]| counts.iter().for_each(|count| bytes.extend_from_slice(&count.to_ne_bytes()));
    match kind {
        LayerKind::Entity => put_counts(&layers.entity[rows.clone()]),
        LayerKind::Samples => put_counts(&film_tile.count[rows.clone()]),
        LayerKind::Variance => {
            put(bytes, rows.clone().map(|row| finite(film.variance_of_mean(*tile, row)[channel])));
        }
        LayerKind::Coverage => put(bytes, rows.clone().map(|row| finite(layers.mean(kind, channel, row)))),
        _ => {
            let nothing = if kind == LayerKind::DepthAlongAxis { NO_DEPTH } else { 0.0 };
            let mean =
                |row: usize| if layers.hits[row] == 0 { nothing } else { finite(layers.mean(kind, channel, row)) };
            put(bytes, rows.clone().map(mean));
        }
    }
}
