//! Animations → what they change of nodes at a time, as the specification's appendix C interpolates it.

use super::accessor::{Accessor, Meant};
use super::buffers::Buffers;
use super::document::{Document, Table};
use super::json::Json;
use super::object::Object;
use crate::memory::Memory;
use crate::model::{ModelAnimation, Moment};
use crate::model_error::{ModelError, shown};
use crate::remarks::Remarks;
use glam::DVec4;
use std::collections::hash_map::Entry;
use std::collections::{HashMap, HashSet};
use std::rc::Rc;

/// The word that stands for all animations of a file.
const ALL: &str = "all";
/// Below this angle between two rotations, in radians, the arc is as good as its chord.
const CHORD: f64 = 1e-6;
/// The most animations that a sentence names.
const MAX_NAMED: usize = 4;

/// What animations change of a node; they leave the rest of it as it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AnimatedNode {
    /// The translation.
    pub translation: Option<[f64; 3]>,
    /// The rotation, a unit quaternion.
    pub rotation: Option<[f64; 4]>,
    /// The scale.
    pub scale: Option<[f64; 3]>,
    /// The weights of the morph targets of its mesh.
    pub weights: Option<Vec<f64>>,
}

/// The nodes that animations change, by their indices; none where a file is read at rest.
pub type Animated = HashMap<usize, AnimatedNode>;

/// The property of a node that a channel changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Property {
    Translation,
    Rotation,
    Scale,
    Weights,
}

impl Property {
    fn of(path: &str) -> Option<Self> {
        Some(match path {
            "translation" => Self::Translation,
            "rotation" => Self::Rotation,
            "scale" => Self::Scale,
            "weights" => Self::Weights,
            _ => return None,
        })
    }

    fn is_in(self, node: &AnimatedNode) -> bool {
        match self {
            Self::Translation => node.translation.is_some(),
            Self::Rotation => node.rotation.is_some(),
            Self::Scale => node.scale.is_some(),
            Self::Weights => node.weights.is_some(),
        }
    }
}

/// How values between two keys follow from them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Interpolation {
    Linear,
    Step,
    CubicSpline,
}

/// The names of a file's animations and their lengths, as far as it says them: a file at rest needs none of them.
pub fn animations_of(document: &Document<'_>) -> Vec<ModelAnimation> {
    let read = |index| {
        let animation = document.row(Table::Animations, index)?;
        let name = animation.text("name")?.unwrap_or_default().to_owned();
        Ok::<_, ModelError>(ModelAnimation { name, seconds: length_of(document, &animation)? })
    };
    (0..document.rows(Table::Animations)).map(|index| read(index).unwrap_or_default()).collect()
}

/// The time of an animation's last key, which must be the greatest value of an accessor.
fn length_of(document: &Document<'_>, animation: &Object<'_>) -> Result<f64, ModelError> {
    let mut seconds = 0.0;
    for (number, json) in animation.list("samplers")?.iter().enumerate() {
        let sampler = animation.item("samplers", number, json)?;
        let times = document.refer(&sampler, "input", Table::Accessors)?;
        if let Some([Json::Number(last)]) = times.map(|times| times.list("max")).transpose()? {
            seconds = f64::max(seconds, *last);
        }
    }
    Ok(seconds)
}

/// What there is to say about the animations of a file, in one sentence.
pub fn said_of(animations: &[ModelAnimation], moment: Option<Moment<'_>>) -> Option<String> {
    let longest = animations.iter().map(|own| own.seconds).fold(0.0, f64::max);
    let longest = (1e3 * longest).round() / 1e3;
    let named: Vec<_> = animations.iter().filter(|own| !own.name.is_empty()).map(|own| shown(&own.name)).collect();
    let more = if named.len() > MAX_NAMED { ", …" } else { "" };
    let names = named[..named.len().min(MAX_NAMED)].join(", ");
    let names = if names.is_empty() { String::new() } else { format!(" ({names}{more})") };
    match (animations.len(), moment) {
        (0, _) | (1, Some(_)) | (_, Some(Moment { animation: Some(_), .. })) => None,
        (1, None) => Some(format!("1 animation{names} of {longest} s: shown at rest; --frames shows it.")),
        (count, None) => Some(format!(
            "{count} animations{names}, the longest of {longest} s: shown at rest; --frames shows the first, or what `animation` names."
        )),
        (count, Some(_)) => Some(format!("{count} animations{names}: the first is shown.")),
    }
}

/// What the animations of a moment change of the nodes.
///
/// Errors: there is no such animation, or one of its channels is not as the specification demands.
pub fn animated_at<'a>(
    document: &Document<'a>,
    buffers: &'a Buffers<'a>,
    moment: Moment<'_>,
    memory: &mut Memory,
    remarks: &mut Remarks,
) -> Result<Animated, ModelError> {
    let mut reader = Reader { document, buffers, seconds: moment.seconds, times: HashMap::new(), memory, remarks };
    let mut animated = Animated::new();
    for index in chosen(document, moment.animation)? {
        reader.animate(&document.row(Table::Animations, index)?, &mut animated)?;
    }
    Ok(animated)
}

/// The indices of the animations that a word stands for: a name, an index or all; none stands for the first.
fn chosen(document: &Document<'_>, word: Option<&str>) -> Result<std::ops::Range<usize>, ModelError> {
    let count = document.rows(Table::Animations);
    let Some(word) = word else { return Ok(0..count.min(1)) };
    if word == ALL {
        return Ok(0..count);
    }
    let names: Vec<String> = animations_of(document).into_iter().map(|own| own.name).collect();
    let named = names.iter().position(|name| name == word);
    if let Some(index) = named.or_else(|| word.parse().ok().filter(|index| *index < count)) {
        return Ok(index..index + 1);
    }
    let named: Vec<_> = names.iter().filter(|name| !name.is_empty()).take(MAX_NAMED).map(|name| shown(name)).collect();
    let accepted = match (count, named.join(", ")) {
        (0, _) => "the file has no animations".to_owned(),
        (_, names) => {
            let names = if names.is_empty() { names } else { format!(" ({names})") };
            format!("it must be a name{names}, a number from 0 to {}, or all", count - 1)
        }
    };
    Err(ModelError::new(document.root.file, "the animation", shown(word), accepted))
}

/// Reads animations at a time.
struct Reader<'r, 'a> {
    document: &'r Document<'a>,
    buffers: &'a Buffers<'a>,
    seconds: f64,
    /// The times of keys by their accessors: channels share them.
    times: HashMap<usize, Rc<[f32]>>,
    memory: &'r mut Memory,
    remarks: &'r mut Remarks,
}

impl<'a> Reader<'_, 'a> {
    /// Adds what an animation changes to what those before it have.
    fn animate(&mut self, animation: &Object<'a>, animated: &mut Animated) -> Result<(), ModelError> {
        let samplers = animation.list("samplers")?;
        let mut targets = HashSet::new();
        for (number, json) in animation.list("channels")?.iter().enumerate() {
            let channel = animation.item("channels", number, json)?;
            let target = channel.needed("target", channel.object("target")?)?;
            let path = target.needed("path", target.text("path")?)?;
            let Some(property) = Property::of(path) else {
                self.remarks.add_unread(&format!("animation channels of {}", shown(path)), 1);
                continue;
            };
            let Some(index) = target.index("node", self.document.rows(Table::Nodes))? else {
                self.remarks.add_unread("animation channels without a node", 1);
                continue;
            };
            if !targets.insert((index, property)) {
                let accepted = format!("another channel of this animation changes it in nodes[{index}] already");
                return Err(target.refused("path", shown(path), accepted));
            }
            let own = channel.needed("sampler", channel.index("sampler", samplers.len())?)?;
            let sampler = animation.item("samplers", own, &samplers[own])?;
            let parts = self.parts(&target, index, property)?;
            if animated.get(&index).is_some_and(|node| property.is_in(node)) {
                continue;
            }
            let value = self.value(&channel, &sampler, property, parts)?;
            let node = animated.entry(index).or_default();
            match property {
                Property::Translation => node.translation = value.first_chunk().copied(),
                Property::Rotation => node.rotation = value.first_chunk().copied(),
                Property::Scale => node.scale = value.first_chunk().copied(),
                Property::Weights => node.weights = Some(value),
            }
        }
        Ok(())
    }

    /// How many rows a value of a node's property has: one, or one for each morph target.
    fn parts(&self, target: &Object<'a>, index: usize, property: Property) -> Result<u64, ModelError> {
        let node = self.document.row(Table::Nodes, index)?;
        if property != Property::Weights {
            if node.get("matrix").is_none() {
                return Ok(1);
            }
            let accepted = "that node has a matrix, in which nothing can be animated";
            return Err(target.refused("node", index, accepted));
        }
        let mesh = self.document.refer(&node, "mesh", Table::Meshes)?;
        let first = match &mesh {
            None => None,
            Some(mesh) => mesh.list("primitives")?.first().map(|json| mesh.item("primitives", 0, json)).transpose()?,
        };
        match first.map_or(Ok(0), |primitive| primitive.list("targets").map(<[_]>::len))? {
            0 => Err(target.refused("node", index, "that node has no morph targets whose weights could be animated")),
            targets => Ok(targets as u64),
        }
    }

    /// The value of a sampler at the time.
    fn value(
        &mut self,
        channel: &Object<'a>,
        sampler: &Object<'a>,
        property: Property,
        parts: u64,
    ) -> Result<Vec<f64>, ModelError> {
        let interpolation = match sampler.text("interpolation")? {
            None | Some("LINEAR") => Interpolation::Linear,
            Some("STEP") => Interpolation::Step,
            Some("CUBICSPLINE") => Interpolation::CubicSpline,
            Some(other) => {
                let accepted = "it must be \"LINEAR\", \"STEP\" or \"CUBICSPLINE\"";
                return Err(sampler.refused("interpolation", shown(other), accepted));
            }
        };
        let accessors = self.document.rows(Table::Accessors);
        let input = sampler.needed("input", sampler.index("input", accessors)?)?;
        let output = sampler.needed("output", sampler.index("output", accessors)?)?;
        let times = self.times(input)?;
        let meant = match property {
            Property::Translation | Property::Scale => Meant::Vectors,
            Property::Rotation => Meant::Fours,
            Property::Weights => Meant::Scalars,
        };
        let output = Accessor::of(self.document, self.buffers, output, meant)?;
        // A key of a spline has three values: the tangent before it, its own, and the tangent behind it.
        let rows = if interpolation == Interpolation::CubicSpline { 3 } else { 1 };
        let expected = (times.len() as u64).saturating_mul(rows * parts);
        if output.count != expected || u32::try_from(expected).is_err() {
            let each = match rows * parts {
                1 => String::new(),
                each => format!(" of {each} rows each"),
            };
            return Err(output.refused_count(format_args!("{} has {} keys{each}", sampler.path, times.len())));
        }
        // Keys are in f32: a time that rounds to a key's is that key's.
        let rounded = self.seconds as f32;
        let next = times.partition_point(|time| *time <= rounded);
        let key = next.saturating_sub(1);
        let is_between = next > 0 && next < times.len() && times[key] != rounded;
        let keys = if is_between && interpolation != Interpolation::Step { 2 } else { 1 };
        if property == Property::Weights {
            // They are kept as numbers twice as large, with the node and with its mesh.
            self.memory.take(parts, 24, || [channel.file.into(), channel.path.clone()])?;
        }
        let each = (rows * parts) as u32;
        let wanted: Vec<u32> = (key as u32 * each..(key as u32 + keys) * each).collect();
        let values: Vec<f64> = match property {
            Property::Translation | Property::Scale => flat(output.floats::<3>(Some(&wanted), self.memory)?),
            Property::Rotation => flat(output.floats::<4>(Some(&wanted), self.memory)?),
            Property::Weights => flat(output.floats::<1>(Some(&wanted), self.memory)?),
        };
        let refused = |value, accepted| {
            let place = format!("{} at {} s", channel.path, self.seconds);
            Err(ModelError::new(channel.file, place, value, accepted))
        };
        if values.iter().any(|part| !part.is_finite()) {
            return refused("infinite or not a number", "what an animation changes must be finite");
        }
        let value = if keys == 1 {
            let width = values.len() / rows as usize;
            values[(rows as usize / 2) * width..][..width].to_vec()
        } else {
            let [before, behind] = [times[key], times[key + 1]].map(f64::from);
            let length = behind - before;
            let at = ((self.seconds - before) / length).clamp(0.0, 1.0);
            match interpolation {
                Interpolation::CubicSpline => spline(&values, at, length),
                _ if property == Property::Rotation => arc(&values, at),
                _ => line(&values, at),
            }
        };
        if property != Property::Rotation {
            return Ok(value);
        }
        match unit(&value) {
            Some(rotation) => Ok(rotation.to_array().to_vec()),
            None => refused("the rotation (0, 0, 0, 0)", "it must be a unit quaternion"),
        }
    }

    /// The times of the keys of an accessor.
    fn times(&mut self, index: usize) -> Result<Rc<[f32]>, ModelError> {
        let entry = match self.times.entry(index) {
            Entry::Occupied(known) => return Ok(known.get().clone()),
            Entry::Vacant(entry) => entry,
        };
        let accessor = Accessor::of(self.document, self.buffers, index, Meant::Times)?;
        if accessor.count == 0 {
            return Err(accessor.refused_count("an animation has one key at least"));
        }
        let times: Rc<[f32]> = accessor.floats::<1>(None, self.memory)?.into_iter().flatten().collect();
        let before = std::iter::once(-1.0).chain(times.iter().copied());
        for (row, (time, before)) in times.iter().zip(before).enumerate() {
            if !(time.is_finite() && *time >= 0.0 && *time > before) {
                let place = format!("row {row} of accessors[{index}]");
                let accepted = "the times of keys must be finite, at least 0, and each later than the one before it";
                return Err(ModelError::new(self.document.root.file, place, time, accepted));
            }
        }
        Ok(entry.insert(times).clone())
    }
}

fn flat<const N: usize>(rows: Vec<[f32; N]>) -> Vec<f64> {
    rows.into_iter().flatten().map(f64::from).collect()
}

/// The value between two.
fn line(values: &[f64], at: f64) -> Vec<f64> {
    let (before, behind) = values.split_at(values.len() / 2);
    before.iter().zip(behind).map(|(before, behind)| (1.0 - at) * before + at * behind).collect()
}

/// The rotation between two, along the shorter arc.
fn arc(values: &[f64], at: f64) -> Vec<f64> {
    let (before, behind) = values.split_at(values.len() / 2);
    let (Some(before), Some(behind)) = (unit(before), unit(behind)) else { return line(values, at) };
    let cosine = before.dot(behind);
    let behind = if cosine < 0.0 { -behind } else { behind };
    let angle = libm::acos(cosine.abs().min(1.0));
    let [of_before, of_behind] = match angle {
        angle if angle < CHORD => [1.0 - at, at],
        angle => [(1.0 - at) * angle, at * angle].map(|part| libm::sin(part) / libm::sin(angle)),
    };
    (of_before * before + of_behind * behind).to_array().to_vec()
}

/// The value between two keys, each of the tangent before it, its own value, and the tangent behind it; the keys are
/// this many seconds apart.
fn spline(values: &[f64], at: f64, seconds: f64) -> Vec<f64> {
    let width = values.len() / 6;
    let row = |row: usize| &values[row * width..][..width];
    let (square, cube) = (at * at, at * at * at);
    let of_before = 2.0 * cube - 3.0 * square + 1.0;
    let of_leaving = seconds * (cube - 2.0 * square + at);
    let of_arriving = seconds * (cube - square);
    let keys = row(1).iter().zip(row(4)).zip(row(2).iter().zip(row(3)));
    keys.map(|((before, behind), (leaving, arriving))| {
        of_before * before + of_leaving * leaving + (1.0 - of_before) * behind + of_arriving * arriving
    })
    .collect()
}

/// A quaternion of length 1.
fn unit(parts: &[f64]) -> Option<DVec4> {
    let quaternion = DVec4::from_slice(parts.get(..4)?);
    // Scaled by the largest part, no square is too large or too small.
    (quaternion / quaternion.abs().max_element()).try_normalize()
}

#[allow(clippy::disallowed_methods, reason = "what a test expects may come from the platform's functions")]
#[cfg(test)]
mod tests {
    use crate::written::{data, floats, read, read_at};
    use crate::{Model, Moment};
    use glam::{DQuat, DVec3};
    use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

    /// A channel: the node, the path, the interpolation, the times, and the accessor of the values with its bytes.
    type Track<'t> = (usize, &'t str, &'t str, &'t [f32], (u32, &'t str, usize, Vec<u8>));

    fn vectors(values: &[f32]) -> (u32, &'static str, usize, Vec<u8>) {
        (5126, "VEC3", values.len() / 3, floats(values))
    }

    fn fours(values: &[f32]) -> (u32, &'static str, usize, Vec<u8>) {
        (5126, "VEC4", values.len() / 4, floats(values))
    }

    fn scalars(values: &[f32]) -> (u32, &'static str, usize, Vec<u8>) {
        (5126, "SCALAR", values.len(), floats(values))
    }

    /// A triangle at these nodes with an animation of these channels; its morph targets add (0, 0, 1) and (0, 1, 0).
    fn with(nodes: &str, tracks: &[Track<'_>]) -> String {
        let mut bytes = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
        bytes.extend(floats(&[0.0, 0.0, 1.0].repeat(3)));
        bytes.extend(floats(&[0.0, 1.0, 0.0].repeat(3)));
        let mut views: Vec<String> = Vec::new();
        let mut accessors: Vec<String> = Vec::new();
        let mut add = |offset: usize, length: usize, component: u32, kind: &str, count: usize, more: &str| {
            accessors.push(format!(
                "{{'bufferView':{},'componentType':{component},'count':{count},'type':'{kind}'{more}}}",
                views.len()
            ));
            views.push(format!("{{'buffer':0,'byteOffset':{offset},'byteLength':{length}}}"));
        };
        for target in 0..3 {
            add(36 * target, 36, 5126, "VEC3", 3, "");
        }
        let (mut samplers, mut channels) = (Vec::new(), Vec::new());
        for (number, (node, path, interpolation, times, (component, kind, count, values))) in tracks.iter().enumerate()
        {
            let last = times.iter().copied().filter(|time| time.is_finite()).fold(0.0, f32::max);
            add(bytes.len(), 4 * times.len(), 5126, "SCALAR", times.len(), &format!(",'max':[{last}]"));
            bytes.extend(floats(times));
            add(bytes.len(), values.len(), *component, kind, *count, ",'normalized':true");
            bytes.extend(values);
            bytes.resize(bytes.len().next_multiple_of(4), 0);
            let [input, output] = [3 + 2 * number, 4 + 2 * number];
            samplers.push(format!("{{'input':{input},'output':{output},'interpolation':'{interpolation}'}}"));
            channels.push(format!("{{'sampler':{number},'target':{{'node':{node},'path':'{path}'}}}}"));
        }
        format!(
            "'buffers':[{{'byteLength':{},'uri':'{}'}}],'bufferViews':[{}],'accessors':[{}],'meshes':[{{'primitives':[\
             {{'attributes':{{'POSITION':0}},'targets':[{{'POSITION':1}},{{'POSITION':2}}]}}]}}],'nodes':[{nodes}],\
             'animations':[{{'name':'own','samplers':[{}],'channels':[{}]}}]",
            bytes.len(),
            data(&bytes),
            views.join(","),
            accessors.join(","),
            samplers.join(","),
            channels.join(",")
        )
    }

    fn at(file: &str, seconds: f64) -> Model {
        read_at(file, Some(Moment { seconds, animation: None })).expect("read")
    }

    fn refused(file: &str, animation: Option<&str>) -> String {
        let sentence = read_at(file, Some(Moment { seconds: 0.5, animation })).expect_err("refused");
        sentence.strip_prefix("a.gltf: ").map_or(sentence.clone(), str::to_owned)
    }

    /// Where the first instance takes a point.
    fn placed(model: &Model, point: DVec3) -> DVec3 {
        model.instances[0].world_from_object.transform_point3(point)
    }

    #[test]
    fn a_line_a_step_and_what_is_beyond_the_keys() {
        let keys = vectors(&[1.0, 0.0, 0.0, 3.0, 0.0, 8.0, 3.0, 4.0, 0.0]);
        let with =
            |interpolation| with("{'mesh':0}", &[(0, "translation", interpolation, &[1.0, 2.0, 4.0], keys.clone())]);
        let (line, step) = (with("LINEAR"), with("STEP"));
        let expected = [
            (-1.0, [1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
            (1.0, [1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
            (1.25, [1.5, 0.0, 2.0], [1.0, 0.0, 0.0]),
            (2.0, [3.0, 0.0, 8.0], [3.0, 0.0, 8.0]),
            (3.5, [3.0, 3.0, 2.0], [3.0, 0.0, 8.0]),
            (4.0, [3.0, 4.0, 0.0], [3.0, 4.0, 0.0]),
            (f64::INFINITY, [3.0, 4.0, 0.0], [3.0, 4.0, 0.0]),
            (f64::NAN, [1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ];
        for (seconds, on_line, on_step) in expected {
            assert_eq!(placed(&at(&line, seconds), DVec3::ZERO).to_array(), on_line, "{seconds}");
            assert_eq!(placed(&at(&step, seconds), DVec3::ZERO).to_array(), on_step, "{seconds}");
        }
        // At rest nothing moves.
        assert_eq!(placed(&read(&line).expect("read"), DVec3::ZERO), DVec3::ZERO);
        // A time that the keys' precision rounds to a key's is that of the key.
        let tenths = [(0, "translation", "STEP", &[0.0, 0.1_f32, 0.7][..], keys.clone())];
        let tenths = super::tests::with("{'mesh':0}", &tenths);
        assert_eq!(placed(&at(&tenths, 0.1), DVec3::ZERO).x, 3.0);
        assert_eq!(placed(&at(&tenths, 0.7), DVec3::ZERO).y, 4.0);
    }

    /// The spline as a Bézier curve (de Casteljau), whose control points are a third of the tangents away.
    #[test]
    fn a_spline_is_the_bezier_curve_of_its_tangents() {
        let mut numbers = (1_u32..).map(|step| (step.wrapping_mul(2_654_435_761) >> 8) as f32 / 8_388_608.0 - 1.0);
        let times = [0.5_f32, 1.25, 3.0, 3.5];
        let keys: Vec<f32> = numbers.by_ref().take(4 * 9).collect();
        let weights: Vec<f32> = numbers.take(4 * 6).collect();
        let file = with(
            "{'mesh':0}",
            &[
                (0, "translation", "CUBICSPLINE", &times, vectors(&keys)),
                (0, "weights", "CUBICSPLINE", &times, scalars(&weights)),
            ],
        );
        let key = |all: &[f32], width: usize, key: usize, of: usize, part: usize| {
            f64::from(all[(3 * key + of) * width + part])
        };
        let mut tried = 0;
        for step in 0..=40 {
            let seconds = 0.4 + 0.08 * f64::from(step);
            let expected = |all: &[f32], width: usize, part: usize| {
                let within = seconds.clamp(0.5, 3.5);
                let from =
                    (0..2).rev().find(|key| f64::from(times[*key + 1]) <= within).map_or(0, |key| key + 1).min(2);
                let [before, behind] = [times[from], times[from + 1]].map(f64::from);
                let (third, at) = ((behind - before) / 3.0, (within - before) / (behind - before));
                let mut points = vec![
                    key(all, width, from, 1, part),
                    key(all, width, from, 1, part) + third * key(all, width, from, 2, part),
                    key(all, width, from + 1, 1, part) - third * key(all, width, from + 1, 0, part),
                    key(all, width, from + 1, 1, part),
                ];
                while points.len() > 1 {
                    points = points.windows(2).map(|two| two[0] + at * (two[1] - two[0])).collect();
                }
                points[0]
            };
            let model = at(&file, seconds);
            let moved = placed(&model, DVec3::ZERO).to_array();
            let first = model.meshes[0].positions[0];
            for part in 0..3 {
                assert!((moved[part] - expected(&keys, 3, part)).abs() < 1e-12, "{seconds} {part}");
            }
            // The first target adds to z, the second to y.
            assert!((f64::from(first[2]) - expected(&weights, 2, 0)).abs() < 1e-6, "{seconds}");
            assert!((f64::from(first[1]) - expected(&weights, 2, 1)).abs() < 1e-6, "{seconds}");
            tried += 1;
        }
        eprintln!("splines at {tried} times");
    }

    #[test]
    fn rotations_take_the_shorter_arc_at_constant_speed() {
        let mut tried = 0;
        for (axis, angle) in
            [(DVec3::Z, 1.5), (DVec3::new(1.0, 2.0, 2.0) / 3.0, 3.0), (DVec3::Y, 1e-8), (DVec3::X, 0.0)]
        {
            let [first, second] = [0.3, 0.3 + angle].map(|angle| DQuat::from_axis_angle(axis, angle));
            for sign in [1.0, -1.0] {
                let keys = [first, second * sign].map(|turn| turn.to_array().map(|part| part as f32));
                let file = with("{'mesh':0}", &[(0, "rotation", "LINEAR", &[0.0, 2.0], fours(&keys.concat()))]);
                for tenth in 0..=10 {
                    let part = f64::from(tenth) / 10.0;
                    let expected = DQuat::from_axis_angle(axis, 0.3 + part * angle) * DVec3::new(1.0, -1.0, 0.5);
                    let turned = placed(&at(&file, 2.0 * part), DVec3::new(1.0, -1.0, 0.5));
                    assert!((turned - expected).length() < 1e-6, "{axis} {angle} {sign} {part}: {turned} {expected}");
                    tried += 1;
                }
            }
        }
        eprintln!("rotations at {tried} places of their arcs");
        // A spline's quaternion is normalised: between opposite tangents it is the mean of its keys.
        let keys = [[0.0; 4], [0.0, 0.0, 0.0, 1.0], [0.0; 4], [0.0; 4], [0.0, 0.0, 1.0, 0.0], [0.0; 4]].concat();
        let file = with("{'mesh':0}", &[(0, "rotation", "CUBICSPLINE", &[0.0, 1.0], fours(&keys))]);
        assert!((placed(&at(&file, 0.5), DVec3::X) - DVec3::Y).length() < 1e-15);
        let opposite = [[0.0; 4], [0.0, 0.0, 0.0, 1.0], [0.0; 4], [0.0; 4], [0.0, 0.0, 0.0, -1.0], [0.0; 4]].concat();
        let file = with("{'mesh':0}", &[(0, "rotation", "CUBICSPLINE", &[0.0, 1.0], fours(&opposite))]);
        let none = "animations[0].channels[0] at 0.5 s is the rotation (0, 0, 0, 0), but it must be a unit quaternion";
        assert_eq!(refused(&file, None), none);
    }

    #[test]
    fn whole_numbers_stand_for_rotations_and_weights() {
        let half = (32_767.0 * FRAC_1_SQRT_2).round() as i16;
        let turn = [0, 0, 0, 32_767, 0, 0, half, half].map(i16::to_le_bytes).concat();
        let file = with(
            "{'mesh':0}",
            &[
                (0, "rotation", "LINEAR", &[0.0, 1.0], (5122, "VEC4", 2, turn)),
                (0, "weights", "LINEAR", &[0.0, 1.0], (5121, "SCALAR", 4, vec![0, 0, 255, 51])),
            ],
        );
        let model = at(&file, 0.5);
        let angle = placed(&model, DVec3::X).angle_between(DVec3::X);
        assert!((angle - 0.5 * FRAC_PI_2).abs() < 1e-4, "{angle}");
        assert_eq!(model.meshes[0].positions[0], [0.0, 0.1, 0.5]);
        assert_eq!(model.remarks.clamped, 0);
    }

    #[test]
    fn what_is_not_animated_stays_and_children_follow() {
        let nodes = "{'translation':[0,5,0],'scale':[2,2,2],'children':[1]},\
                     {'mesh':0,'rotation':[0,0,1,0],'weights':[1,0],'children':[2]},{'camera':0,'translation':[0,0,1]}";
        let tracks = [
            (0, "translation", "LINEAR", &[0.0, 1.0][..], vectors(&[0.0, 0.0, 0.0, 4.0, 0.0, 0.0])),
            (1, "scale", "LINEAR", &[0.0, 1.0][..], vectors(&[1.0, 1.0, 1.0, 1.0, 1.0, 3.0])),
        ];
        let camera = "'cameras':[{'type':'perspective','perspective':{'yfov':1}}]";
        let model = at(&format!("{},{camera}", with(nodes, &tracks)), 0.5);
        // Half a turn about z, then twice as large, then moved by (2, 0, 0) in place of (0, 5, 0).
        assert!((placed(&model, DVec3::new(1.0, 0.0, 1.0)) - DVec3::new(0.0, 0.0, 4.0)).length() < 1e-14);
        assert_eq!(model.meshes[0].positions[0], [0.0, 0.0, 1.0]);
        assert!((model.cameras[0].world_from_camera.translation - DVec3::new(2.0, 0.0, 4.0)).length() < 1e-14);
    }

    #[test]
    fn one_animation_is_chosen_by_its_name_or_its_number() {
        let move_to = |x: f32| (0, "translation", "LINEAR", &[0.0][..], vectors(&[x, 0.0, 0.0]));
        let turn = (0, "scale", "LINEAR", &[0.0][..], vectors(&[2.0, 2.0, 2.0]));
        let file = with("{'mesh':0}", &[move_to(1.0), move_to(2.0), turn]);
        let (head, tail) = file.split_once("'channels':[").expect("channels");
        let channels: Vec<&str> = tail.trim_end_matches("]}]").split("},{").collect();
        let samplers = head.split_once("'samplers'").expect("samplers").1;
        let whole = |own: &str| format!("{{{}}}", own.trim_matches(['{', '}'])).replace("1'}", "1'}}") + "}";
        let [walk, run, grow] = [0, 1, 2].map(|own: usize| whole(channels[own]));
        let file =
            format!("{head}'channels':[{walk}]}},{{'name':'run','samplers'{samplers}'channels':[{run},{grow}]}}]");
        let x = |animation| {
            let model = read_at(&file, Some(Moment { seconds: 0.0, animation })).expect("read");
            (placed(&model, DVec3::ZERO).x, placed(&model, DVec3::Y).y, model.remarks.sentences())
        };
        let first = "2 animations (\"own\", \"run\"): the first is shown.";
        assert_eq!(x(None).2[1], first);
        let two = |own: (f64, f64, Vec<String>)| (own.0, own.1);
        assert_eq!(two(x(None)), (1.0, 1.0));
        assert_eq!(two(x(Some("own"))), (1.0, 1.0));
        assert_eq!(two(x(Some("run"))), (2.0, 2.0));
        assert_eq!(two(x(Some("1"))), (2.0, 2.0));
        // Of two that move one node, the first counts.
        assert_eq!(two(x(Some("all"))), (1.0, 2.0));
        let accepted = "but it must be a name (\"own\", \"run\"), a number from 0 to 1, or all";
        assert_eq!(refused(&file, Some("jump")), format!("the animation is \"jump\", {accepted}"));
        let rest = "2 animations (\"own\", \"run\"), the longest of 0 s: shown at rest; --frames shows the first, or what \
                    `animation` names.";
        assert_eq!(read(&file).expect("read").remarks.sentences()[1], rest);
    }

    #[test]
    fn names_and_lengths_are_read_at_rest() {
        let tracks = [(0, "scale", "LINEAR", &[0.5, 1.25][..], vectors(&[1.0; 6]))];
        let model = read(&with("{'mesh':0}", &tracks)).expect("read");
        assert_eq!((model.animations.len(), &*model.animations[0].name, model.animations[0].seconds), (1, "own", 1.25));
        assert_eq!(model.remarks.sentences()[1], "1 animation (\"own\") of 1.25 s: shown at rest; --frames shows it.");
        // What is broken of them does not matter at rest.
        for broken in ["'animations':[1,{'name':2}]", "'animations':[{'samplers':[{'input':7}],'channels':3}]"] {
            assert!(read(broken).is_ok_and(|model| model.animations.iter().all(|own| own.seconds == 0.0)), "{broken}");
        }
    }

    #[test]
    fn broken_animations_are_refused_with_their_place() {
        let keys = vectors(&[0.0; 6]);
        let good = with("{'mesh':0}", &[(0, "translation", "LINEAR", &[0.0, 1.0], keys.clone())]);
        let changed = |from: &str, to: &str| {
            assert!(good.contains(from), "{from}");
            refused(&good.replacen(from, to, 1), None)
        };
        let target = "animations[0].channels[0].target";
        let cases = [
            (
                "'node':0",
                "'node':1",
                format!("{target}.node is 1, but it must be a whole number from 0 to 0, for there are 1"),
            ),
            (
                "'path':'translation'",
                "'path':'weights'",
                "accessors[4].type is \"VEC3\", but it is used as SCALAR".to_owned(),
            ),
            ("'path':'translation'", "'path':3", format!("{target}.path is 3, but it must be a text")),
            (
                "'sampler':0",
                "'sampler':2",
                "animations[0].channels[0].sampler is 2, but it must be a whole number from 0 to 0, for there are 1"
                    .into(),
            ),
            ("'sampler':0,", "", "animations[0].channels[0].sampler is missing, but it is needed".into()),
            (
                "LINEAR",
                "CUBIC",
                "animations[0].samplers[0].interpolation is \"CUBIC\", but it must be \"LINEAR\", \"STEP\" or \
                 \"CUBICSPLINE\""
                    .into(),
            ),
            (
                "LINEAR",
                "CUBICSPLINE",
                "accessors[4].count is 2, but animations[0].samplers[0] has 2 keys of 3 rows each".into(),
            ),
            ("'input':3", "'input':0", "accessors[0].type is \"VEC3\", but it is used as SCALAR".into()),
            (
                "'mesh':0",
                "'mesh':0,'matrix':[1]",
                format!("{target}.node is 0, but that node has a matrix, in which nothing can be animated"),
            ),
        ];
        for (from, to, sentence) in &cases {
            assert_eq!(&changed(from, to), sentence);
        }
        eprintln!("{} changed animations", cases.len());
        let weights = with("{'mesh':0},{}", &[(1, "weights", "LINEAR", &[0.0], scalars(&[0.0; 2]))]);
        let sentence =
            format!("{target}.node is 1, but that node has no morph targets whose weights could be animated");
        assert_eq!(refused(&weights, None), sentence);
        let few = with("{'mesh':0}", &[(0, "weights", "LINEAR", &[0.0, 1.0], scalars(&[0.0; 3]))]);
        let sentence = "accessors[4].count is 3, but animations[0].samplers[0] has 2 keys of 2 rows each";
        assert_eq!(refused(&few, None), sentence);
        let track = (0, "scale", "STEP", &[0.0][..], vectors(&[1.0; 3]));
        let twice = refused(&with("{'mesh':0}", &[track.clone(), track]), None);
        let sentence = "animations[0].channels[1].target.path is \"scale\", but another channel of this animation changes \
                        it in nodes[0] already";
        assert_eq!(twice, sentence);
        let times = "but the times of keys must be finite, at least 0, and each later than the one before it";
        for (own, row, shown) in [
            ([0.0, 0.0], 1, "0"),
            ([2.0, 1.0], 1, "1"),
            ([-1.0, 1.0], 0, "-1"),
            ([0.0, f32::NAN], 1, "NaN"),
            ([0.0, f32::INFINITY], 1, "inf"),
        ] {
            let file = with("{'mesh':0}", &[(0, "translation", "LINEAR", &own, keys.clone())]);
            assert_eq!(refused(&file, None), format!("row {row} of accessors[3] is {shown}, {times}"));
        }
        let none = with("{'mesh':0}", &[(0, "translation", "LINEAR", &[], vectors(&[]))]);
        assert_eq!(refused(&none, None), "accessors[3].count is 0, but an animation has one key at least");
        let infinite = vectors(&[0.0, f32::INFINITY, 0.0]);
        let infinite = with("{'mesh':0}", &[(0, "translation", "LINEAR", &[0.0], infinite)]);
        let sentence = "animations[0].channels[0] at 0.5 s is infinite or not a number, but what an animation changes must \
                        be finite";
        assert_eq!(refused(&infinite, None), sentence);
    }

    #[test]
    fn other_targets_are_said() {
        let track = (0, "pointer", "STEP", &[0.0][..], vectors(&[1.0; 3]));
        let file = with("{'mesh':0}", &[track.clone(), track.clone(), track]).replacen("'node':0,", "", 1);
        let file = file.replacen("'path':'pointer'", "'path':'scale'", 1);
        let sentences = at(&file, 0.0).remarks.sentences();
        let said = "Not read: animation channels without a node (1), animation channels of \"pointer\" (2).";
        assert!(sentences.iter().any(|sentence| sentence == said), "{sentences:?}");
    }

    /// A skin's joints are nodes like any other.
    #[test]
    fn skins_follow_their_joints() {
        let turn = fours(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0]);
        let nodes = "{'mesh':0,'skin':0},{'children':[2]},{'translation':[0,0,7]}";
        let file = with(nodes, &[(1, "rotation", "LINEAR", &[0.0, 1.0], turn)]);
        let weights: Vec<u8> = floats(&[1.0, 0.0, 0.0, 0.0].repeat(3));
        let joints = [1, 0, 0, 0].repeat(3);
        let more = format!("'uri':'{}'}},{{'byteLength':60,'uri':'{}'}}],", "{}", data(&[weights, joints].concat()));
        let (head, tail) = file.split_once("'uri':'").expect("a buffer");
        let (uri, tail) = tail.split_once("'}],").expect("its end");
        let file = format!("{head}{}{tail}", more.replacen("{}", uri, 1))
            .replacen(
                "'bufferViews':[",
                "'bufferViews':[{'buffer':1,'byteLength':48},{'buffer':1,'byteOffset':48,'byteLength':12},",
                1,
            )
            .replace("'bufferView':", "'bufferView':2");
        // The views of the accessors are two further on, and the weights and joints are the last two accessors.
        let mut file = (0..5).fold(file, |file, view| {
            file.replacen(&format!("'bufferView':2{view},"), &format!("'bufferView':{},", view + 2), 1)
        });
        file = file.replacen(
            "],'meshes'",
            ",{'bufferView':0,'componentType':5126,'count':3,'type':'VEC4'},\
             {'bufferView':1,'componentType':5121,'count':3,'type':'VEC4'}],'skins':[{'joints':[1,2]}],'meshes'",
            1,
        );
        file = file.replacen("'POSITION':0}", "'POSITION':0,'WEIGHTS_0':5,'JOINTS_0':6}", 1);
        let model = at(&file, 0.5);
        let corners = model.meshes[0].positions.clone();
        let expected = [[0.0, 0.0, 7.0], [0.0, 1.0, 7.0], [-1.0, 0.0, 7.0]];
        for (own, expected) in corners.iter().zip(expected) {
            let apart = DVec3::from(own.map(f64::from)) - DVec3::from(expected);
            assert!(apart.length() < 1e-6, "{corners:?}");
        }
    }
}
