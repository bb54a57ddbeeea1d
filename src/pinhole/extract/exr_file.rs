//! EXR files → colours in linear Rec. 709: the channels that are there, the primaries that are meant.

use super::Texels;
use super::image_head::explained;
use exr::image::read::specific_channels::ReadSpecificChannel;
use exr::meta::attribute::{Chromaticities, EnvironmentMap, IntegerBounds};
use exr::meta::header::Header;
use exr::prelude::{Compression, MetaData, ReadChannels, ReadLayers, read};
use glam::{DMat3, DVec3};
use std::io::{BufRead, Cursor, Seek};

/// A texel that is not there.
const BLACK: [f32; 3] = [0.0; 3];

/// The names of channels that become a colour.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Wanted {
    /// Red, green and blue.
    Rgb([String; 3]),
    /// One for all three.
    Grey(String),
}

/// An EXR as colours, and what was done to make it so, one sentence each.
///
/// It is the first part that has R, G and B; or else Y; or else a layer such as `beauty.R`, `beauty.G`, `beauty.B`; or
/// else the only channel there is.
/// Errors: what it has instead, or the library's message, on one line.
pub fn exr_texels(bytes: &[u8]) -> Result<(Texels, Vec<String>), String> {
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(|error| explained(&error))?;
    let wanted = wanted(&meta.headers)?;
    let header = meta.headers.iter().find(|header| has(header, &wanted)).ok_or("it has no part with these channels")?;
    if let Compression::DWAA(_) | Compression::DWAB(_) = header.compression {
        return Err(format!(
            "its compression is {}, which is not read; save it with ZIP or PIZ, as `oiiotool in.exr --compression zip \
             -o out.exr` does",
            if matches!(header.compression, Compression::DWAA(_)) { "DWAA" } else { "DWAB" }
        ));
    }
    let mut remarks = Vec::new();
    let texels = match &wanted {
        Wanted::Rgb(names) if *names == ["R", "G", "B"] => read_exr(Cursor::new(bytes))?,
        Wanted::Rgb(names) => {
            let layer = names[0].rsplit_once('.').map_or("", |(layer, _)| layer);
            remarks.push(format!("its layer {} is read", crate::scene::printable(layer, 80)));
            read_channels(Cursor::new(bytes), names.each_ref().map(String::as_str))?
        }
        Wanted::Grey(name) => {
            remarks.push(format!("its channel {} is read as grey", crate::scene::printable(name, 80)));
            read_grey(bytes, name)?
        }
    };
    let own = &header.own_attributes;
    let window = IntegerBounds { position: own.layer_position, size: header.layer_size };
    let mut texels = framed(texels, window, header.shared_attributes.display_window, &mut remarks);
    if let Some(chromaticities) = header.shared_attributes.chromaticities {
        convert(&mut texels, &chromaticities, &mut remarks);
    }
    if own.environment_map == Some(EnvironmentMap::Cube) {
        remarks.push("it says it is a cube map, and is read as the plain image that it is".into());
    }
    Ok((texels, remarks))
}

fn has(header: &Header, wanted: &Wanted) -> bool {
    let names = match wanted {
        Wanted::Rgb(names) => &names[..],
        Wanted::Grey(name) => std::slice::from_ref(name),
    };
    !header.deep && names.iter().all(|name| header.channels.list.iter().any(|own| own.name.to_string() == *name))
}

fn wanted(headers: &[Header]) -> Result<Wanted, String> {
    let names = |header: &Header| header.channels.list.iter().map(|own| own.name.to_string()).collect::<Vec<_>>();
    let all: Vec<String> = headers.iter().flat_map(names).collect();
    let has = |wanted: &Wanted| headers.iter().any(|header| self::has(header, wanted));
    let of = |layer: &str, parts: [&str; 3]| Wanted::Rgb(parts.map(|part| format!("{layer}{part}")));
    let layers = || all.iter().filter_map(|name| Some(&name[..=name.rfind('.')?]));
    let mut candidates = vec![of("", ["R", "G", "B"]), of("", ["r", "g", "b"]), Wanted::Grey("Y".into())];
    candidates.extend(layers().map(|layer| of(layer, ["R", "G", "B"])));
    candidates.extend(layers().map(|layer| of(layer, ["r", "g", "b"])));
    candidates.extend(layers().map(|layer| Wanted::Grey(format!("{layer}Y"))));
    candidates.extend(all.first().filter(|_| all.len() == 1).cloned().map(Wanted::Grey));
    candidates.into_iter().find(has).ok_or_else(|| {
        let listed = crate::scene::printable(&all.join(", "), 200);
        format!("it has the channels {listed}, and an image needs R, G and B, of a layer or without one, or Y")
    })
}

/// The channels R, G and B of the first part of an EXR that has them, at full size.
///
/// Errors: the library's message, on one line.
pub fn read_exr(reader: impl BufRead + Seek) -> Result<Texels, String> {
    read_channels(reader, ["R", "G", "B"])
}

fn read_channels(reader: impl BufRead + Seek, [r, g, b]: [&str; 3]) -> Result<Texels, String> {
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .required(r)
        .required(g)
        .required(b)
        .collect_pixels(
            |size, _| Texels { width: size.0, height: size.1, rgb: vec![BLACK; size.area()] },
            |texels: &mut Texels, at, (r, g, b): (f32, f32, f32)| {
                let row = at.1 * texels.width;
                texels.rgb[row + at.0] = [r, g, b];
            },
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(reader)
        .map_err(|error| explained(&error))?;
    Ok(image.layer_data.channel_data.pixels)
}

fn read_grey(bytes: &[u8], name: &str) -> Result<Texels, String> {
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .specific_channels()
        .required(name)
        .collect_pixels(
            |size, _| Texels { width: size.0, height: size.1, rgb: vec![BLACK; size.area()] },
            |texels: &mut Texels, at, (grey,): (f32,)| {
                let row = at.1 * texels.width;
                texels.rgb[row + at.0] = [grey; 3];
            },
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(|error| explained(&error))?;
    Ok(image.layer_data.channel_data.pixels)
}

/// The image in its display window: what is stored beyond that is cut off, and what is not stored is black.
fn framed(texels: Texels, data: IntegerBounds, display: IntegerBounds, remarks: &mut Vec<String>) -> Texels {
    let (width, height) = (display.size.0, display.size.1);
    // A window as large as this would have been refused if it were stored.
    let is_odd = width == 0 || height == 0 || width.saturating_mul(height) > 4 * texels.rgb.len();
    if data == display || is_odd {
        return texels;
    }
    let offset = [data.position.0 - display.position.0, data.position.1 - display.position.1].map(i64::from);
    let texel = |x: usize, y: usize| {
        let (x, y) = (x as i64 - offset[0], y as i64 - offset[1]);
        let inside = (0..texels.width as i64).contains(&x) && (0..texels.height as i64).contains(&y);
        if inside { texels.rgb[y as usize * texels.width + x as usize] } else { BLACK }
    };
    remarks.push(format!(
        "{} × {} texels of its {width} × {height} are stored, and the rest is black",
        texels.width, texels.height
    ));
    Texels { width, height, rgb: (0..width * height).map(|at| texel(at % width, at / width)).collect() }
}

/// CIE XYZ of a chromaticity, but for its size.
fn xyz(at: exr::math::Vec2<f32>) -> DVec3 {
    let (x, y) = (f64::from(at.0), f64::from(at.1));
    DVec3::new(x, y, 1.0 - x - y)
}

/// The matrix from linear RGB with these primaries to CIE XYZ; white has Y = 1.
fn xyz_from_rgb([red, green, blue, white]: [DVec3; 4]) -> DMat3 {
    let primaries = DMat3::from_cols(red, green, blue);
    primaries * DMat3::from_diagonal(primaries.inverse() * (white / white.y))
}

/// Primaries and white point D65 of Rec. 709.
const REC_709: [DVec3; 4] = [
    DVec3::new(0.64, 0.33, 0.03),
    DVec3::new(0.3, 0.6, 0.1),
    DVec3::new(0.15, 0.06, 0.79),
    DVec3::new(0.3127, 0.329, 0.3583),
];
/// The responses of cones of the Bradford chromatic adaptation, row by row.
const BRADFORD: [[f64; 3]; 3] = [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]];

/// The matrix from linear RGB with these primaries and white to Rec. 709, whose white is adapted to D65 (Bradford).
fn rec_709_from(own: [DVec3; 4]) -> DMat3 {
    let bradford = DMat3::from_cols_array_2d(&BRADFORD).transpose();
    let white = |of: [DVec3; 4]| bradford * (of[3] / of[3].y);
    let adapted = bradford.inverse() * DMat3::from_diagonal(white(REC_709) / white(own)) * bradford;
    xyz_from_rgb(REC_709).inverse() * adapted * xyz_from_rgb(own)
}

fn convert(texels: &mut Texels, from: &Chromaticities, remarks: &mut Vec<String>) {
    let own = [from.red, from.green, from.blue, from.white].map(xyz);
    let apart = own.iter().zip(REC_709).map(|(own, other)| (*own - other).abs().max_element()).fold(0.0, f64::max);
    if apart < 1e-3 {
        return;
    }
    let matrix = rec_709_from(own);
    if !matrix.is_finite() || matrix.determinant() == 0.0 {
        remarks.push("its chromaticities are those of no colour space, and are left out".into());
        return;
    }
    for texel in &mut texels.rgb {
        *texel = (matrix * DVec3::from(texel.map(f64::from))).as_vec3().to_array();
    }
    remarks.push("its colours are converted from its own primaries to those of Rec. 709".into());
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of XYZ as primaries, white of equal energy: the red of Rec. 709 comes back as red, adapted to D65.
    #[test]
    fn primaries_are_converted_with_their_white() {
        let equal = DVec3::splat(1.0 / 3.0);
        let matrix = rec_709_from([DVec3::X, DVec3::Y, DVec3::Z, equal]);
        assert!((matrix * DVec3::ONE - DVec3::ONE).abs().max_element() < 1e-9, "white stays white");
        let own = rec_709_from(REC_709);
        assert!((own - DMat3::IDENTITY).to_cols_array().iter().all(|part| part.abs() < 1e-12));
        // The luminances of the primaries of Rec. 709, as its text has them.
        let luminances = xyz_from_rgb(REC_709).row(1);
        assert!((luminances - DVec3::new(0.2126, 0.7152, 0.0722)).abs().max_element() < 1e-4, "{luminances}");
        // ACES AP0 to Rec. 709, by the matrix of SMPTE ST 2065-1 and a Bradford transform from its white to D65.
        let ap0 = [[0.7347, 0.2653], [0.0, 1.0], [0.0001, -0.077], [0.32168, 0.33767]];
        let ap0 = ap0.map(|[x, y]| DVec3::new(x, y, 1.0 - x - y));
        let found = rec_709_from(ap0);
        let expected = [2.521_7, -1.134_1, -0.387_6];
        for (axis, expected) in expected.into_iter().enumerate() {
            assert!((found.row(0)[axis] - expected).abs() < 2e-3, "{found}");
        }
    }

    #[test]
    fn the_display_window_is_what_is_seen() {
        let bounds = |x: i32, y: i32, width: usize, height: usize| IntegerBounds::new((x, y), (width, height));
        let texels = Texels { width: 2, height: 1, rgb: vec![[1.0; 3], [2.0; 3]] };
        let mut remarks = Vec::new();
        let found = framed(texels.clone(), bounds(1, 1, 2, 1), bounds(0, 0, 3, 2), &mut remarks);
        let grey: Vec<f32> = found.rgb.iter().map(|texel| texel[0]).collect();
        assert_eq!((found.width, found.height, grey), (3, 2, vec![0.0, 0.0, 0.0, 0.0, 1.0, 2.0]));
        let found = framed(texels.clone(), bounds(-1, 0, 2, 1), bounds(0, 0, 1, 1), &mut remarks);
        assert_eq!((found.rgb, remarks.len()), (vec![[2.0; 3]], 2));
        assert_eq!(framed(texels.clone(), bounds(0, 0, 2, 1), bounds(0, 0, 2, 1), &mut remarks), texels);
        assert_eq!(remarks.len(), 2);
    }
}
