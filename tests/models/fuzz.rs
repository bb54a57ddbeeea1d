//! Model files made at random, by changing those of this folder, and what becomes of them.

use peak_alloc::PeakAlloc;
use pinhole::models::{AlphaMode, Model, Moment, read_model_at};
use std::collections::BTreeMap;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::{Duration, Instant};

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// What a reader may take: this many times the file and those beside it that it opened, and so much in any case.
const MAX_TIMES: usize = 100;
const MAX_IN_ANY_CASE: usize = 1 << 20;

/// When files are read: where a file has no animations, that is how it is at rest.
const MOMENT: Moment<'_> = Moment { seconds: 0.4, animation: Some("all") };

/// The endings of the files that are changed.
pub const FORMATS: [&str; 4] = ["gltf", "glb", "obj", "ply"];

/// Numbers that readers are known to trip over.
const NUMBERS: [&str; 24] = [
    "0",
    "-1",
    "1",
    "2",
    "3",
    "5",
    "255",
    "256",
    "65535",
    "65536",
    "2147483647",
    "2147483648",
    "4294967295",
    "4294967296",
    "9007199254740992",
    "9223372036854775807",
    "18446744073709551616",
    "-9223372036854775808",
    "1e9",
    "1e38",
    "-1e39",
    "1e308",
    "nan",
    "0.5",
];

/// The files of this folder, by name.
pub struct Bases {
    files: BTreeMap<String, Vec<u8>>,
}

impl Bases {
    pub fn read() -> Self {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/models");
        let mut files = BTreeMap::new();
        for entry in std::fs::read_dir(folder).expect("the folder") {
            let path = entry.expect("an entry").path();
            let name = path.file_name().expect("a name").to_string_lossy().into_owned();
            files.insert(name, std::fs::read(path).expect("a file"));
        }
        Self { files }
    }

    /// The names of the files with an ending.
    pub fn of(&self, ending: &str) -> Vec<&str> {
        let own = |name: &&str| name.rsplit('.').next() == Some(ending);
        self.files.keys().map(String::as_str).filter(own).collect()
    }
}

/// Random numbers: SplitMix64.
pub struct Draws(u64);

impl Draws {
    pub fn of(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15))
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^ (bits >> 31)
    }

    /// A number below a limit; 0 if there is none.
    pub fn below(&mut self, limit: usize) -> usize {
        (self.bits() % limit.max(1) as u64) as usize
    }
}

/// A file to read, and those beside it.
pub struct Case {
    pub name: String,
    pub bytes: Vec<u8>,
    beside: BTreeMap<String, Vec<u8>>,
}

/// The case of a seed.
pub fn case(bases: &Bases, ending: &str, seed: u64) -> Case {
    let mut draws = Draws::of(seed);
    let names = bases.of(ending);
    let name = names[draws.below(names.len())];
    let other = &bases.files[names[draws.below(names.len())]];
    let mut bytes = bases.files[name].clone();
    let is_text = match ending {
        "gltf" | "obj" => true,
        "ply" => draws.below(2) == 0,
        _ => false,
    };
    if ending == "glb" && draws.below(3) > 0 {
        bytes = with_changed_json(&bytes, other, &mut draws);
    } else {
        change(&mut bytes, other, is_text, &mut draws);
    }
    let mut beside = BTreeMap::new();
    for kind in ["bin", "mtl"] {
        for name in bases.of(kind) {
            let mut bytes = bases.files[name].clone();
            if draws.below(4) == 0 {
                let other = bytes.clone();
                change(&mut bytes, &other, kind == "mtl", &mut draws);
            }
            beside.insert(name.to_owned(), bytes);
        }
    }
    Case { name: name.into(), bytes, beside }
}

/// A binary glTF file whose JSON is changed and whose chunks are whole.
fn with_changed_json(bytes: &[u8], other: &[u8], draws: &mut Draws) -> Vec<u8> {
    let length = |bytes: &[u8]| u32::from_le_bytes(bytes[12..16].try_into().expect("four bytes")) as usize;
    let json_of = |bytes: &[u8]| bytes[20..20 + length(bytes)].to_vec();
    let (mut json, other) = (json_of(bytes), json_of(other));
    change(&mut json, &other, true, draws);
    let rest = &bytes[20 + length(bytes)..];
    let mut whole = b"glTF\x02\0\0\0".to_vec();
    whole.extend((20 + json.len() as u32 + rest.len() as u32).to_le_bytes());
    whole.extend((json.len() as u32).to_le_bytes());
    whole.extend(b"JSON");
    whole.extend(json);
    whole.extend(rest);
    whole
}

/// Changes a file in one to six places, mostly few.
fn change(bytes: &mut Vec<u8>, other: &[u8], is_text: bool, draws: &mut Draws) {
    for _ in 0..=draws.below(6).min(draws.below(6)).min(draws.below(6)) {
        let length = bytes.len();
        let at = draws.below(length);
        match draws.below(if is_text { 24 } else { 8 }) {
            _ if length == 0 => return,
            0 => bytes[at] ^= 1 << draws.below(8),
            1 => bytes[at] = draws.bits() as u8,
            2 if draws.below(4) == 0 => bytes.truncate(at),
            2 => drop(bytes.drain(at..(at + draws.below(16)).min(length))),
            // A part of another file, here or in place of what is here.
            3 | 4 => {
                let from = draws.below(other.len());
                let part = &other[from..(from + draws.below(200)).min(other.len())];
                let over = if draws.below(2) == 0 { part.len() } else { 0 };
                bytes.splice(at..(at + over).min(length), part.iter().copied());
            }
            // The same again, many times.
            5 => {
                let part = bytes[at..(at + 1 + draws.below(60)).min(length)].repeat(1 + draws.below(40));
                bytes.splice(at..at, part);
            }
            6 | 7 if !is_text => {
                let word = [0, 1, 0x7fff_ffff, 0x8000_0000, u32::MAX, 0x7fc0_0000, 0x7f80_0000, draws.bits() as u32];
                let word = word[draws.below(8)].to_le_bytes();
                let end = (at + 4).min(length);
                bytes[at..end].copy_from_slice(&word[..end - at]);
            }
            _ => replace_number(bytes, at, draws),
        }
    }
}

/// Replaces the first number behind a place of a text.
fn replace_number(bytes: &mut Vec<u8>, at: usize, draws: &mut Draws) {
    let is_part = |byte: &u8| byte.is_ascii_digit() || b".-+".contains(byte);
    let Some(start) = bytes[at..].iter().position(is_part).map(|ahead| at + ahead) else { return };
    let end = bytes[start..].iter().position(|byte| !is_part(byte)).map_or(bytes.len(), |length| start + length);
    let number = match draws.below(3) {
        0 => draws.below(40).to_string(),
        _ => NUMBERS[draws.below(NUMBERS.len())].into(),
    };
    bytes.splice(start..end, number.bytes());
}

/// What became of one file.
pub struct Outcome {
    read: Option<bool>,
    broken: Option<String>,
    /// The memory it took at most, and what it may take, in bytes.
    memory: usize,
    max: usize,
    size: usize,
    time: Duration,
}

/// Reads a file; memory is counted for the whole process, so nothing else may run.
pub fn outcome(case: &Case) -> Outcome {
    let started = Instant::now();
    let before = ALLOCATOR.current_usage();
    ALLOCATOR.reset_peak_usage();
    let opened = std::cell::Cell::new(0);
    let open = |name: &str| {
        let bytes = case.beside.get(name).ok_or("there is none")?;
        opened.set(opened.get() + bytes.len());
        Ok(bytes.clone())
    };
    let read = catch_unwind(AssertUnwindSafe(|| read_model_at(&case.name, &case.bytes, Some(MOMENT), &open)));
    let memory = ALLOCATOR.peak_usage() - before;
    let time = started.elapsed();
    let size = case.bytes.len() + opened.get();
    let broken = match &read {
        Err(_) => Some("panic".into()),
        Ok(Ok(model)) => fault(model),
        Ok(Err(error)) => {
            let sentence = error.to_string();
            let is_sentence = sentence.len() < 2000 && !sentence.chars().any(char::is_control);
            (!is_sentence).then_some(sentence)
        }
    };
    let max = MAX_TIMES * size + MAX_IN_ANY_CASE;
    Outcome { read: read.ok().map(|read| read.is_ok()), broken, memory, max, size, time }
}

/// What a model that was read must hold.
fn fault(model: &Model) -> Option<String> {
    for mesh in &model.meshes {
        let vertices = mesh.positions.len();
        let finite = |row: &[f32]| row.iter().all(|part| part.is_finite());
        let columns = [mesh.normals.as_ref().map(Vec::len), mesh.uvs.as_ref().map(Vec::len)];
        let unit = |normal: &[f32; 3]| {
            let length = normal.iter().map(|part| part * part).sum::<f32>();
            length == 0.0 || (length - 1.0).abs() < 1e-5
        };
        let holds = !mesh.triangles.is_empty()
            && mesh.triangles.iter().flatten().all(|index| (*index as usize) < vertices)
            && mesh.positions.iter().all(|row| finite(row))
            && columns.iter().flatten().all(|length| *length == vertices)
            && mesh.normals.iter().flatten().all(unit)
            && mesh.uvs.iter().flatten().all(|row| finite(row));
        if !holds {
            return Some("a mesh does not hold".into());
        }
    }
    let image = |index: usize| index < model.images.len();
    for material in &model.materials {
        let unit = |part: &f64| (0.0..=1.0).contains(part);
        let textures = [
            material.base_colour_texture,
            material.metallic_roughness_texture,
            material.normal_texture,
            material.emission_texture,
        ];
        let cutoff = if let AlphaMode::Mask { cutoff } = material.alpha_mode { cutoff } else { 0.0 };
        let parts = [material.alpha, material.metallic, material.roughness, material.transmission];
        let holds = material.base_colour.iter().chain(&parts).all(unit)
            && material.emission.iter().all(|part| part.is_finite() && *part >= 0.0)
            && (material.ior == 0.0 || material.ior >= 1.0)
            && cutoff >= 0.0
            && textures.iter().flatten().all(|texture| image(texture.image));
        if !holds {
            return Some(format!("a material does not hold: {material:?}"));
        }
    }
    let instance_holds = model.instances.iter().all(|instance| {
        instance.mesh < model.meshes.len()
            && instance.material.is_none_or(|index| index < model.materials.len())
            && instance.world_from_object.is_finite()
    });
    let matrices = model.cameras.iter().map(|camera| camera.world_from_camera);
    let all_finite = matrices.chain(model.lights.iter().map(|light| light.world_from_light)).all(|own| own.is_finite());
    let lights = model.lights.iter().all(|light| light.intensity >= 0.0 && light.intensity.is_finite());
    let remarks = model.remarks.sentences().iter().all(|sentence| sentence.len() < 5000);
    (!(instance_holds && all_finite && lights && remarks)).then(|| "an instance, camera or light does not hold".into())
}

/// How many files ended in each outcome.
#[derive(Default)]
pub struct Counts {
    read: u64,
    refused: u64,
    /// The seeds of files that brought the reader down, and why.
    pub broken: Vec<(u64, String)>,
    /// The seeds of files that took too much memory.
    pub large: Vec<u64>,
    /// The seeds of files that took more than a second.
    pub slow: Vec<u64>,
    ratio: f64,
    ratio_of_large: f64,
    slowest: Duration,
}

impl Counts {
    pub fn add(&mut self, seed: u64, outcome: Outcome) {
        match outcome.read {
            Some(true) => self.read += 1,
            Some(false) => self.refused += 1,
            None => {}
        }
        self.broken.extend(outcome.broken.map(|why| (seed, why)));
        if outcome.memory > outcome.max {
            self.large.push(seed);
        }
        if outcome.time > Duration::from_secs(1) {
            self.slow.push(seed);
        }
        let ratio = outcome.memory as f64 / outcome.size.max(1) as f64;
        self.ratio = self.ratio.max(ratio);
        if outcome.size > 1000 {
            self.ratio_of_large = self.ratio_of_large.max(ratio);
        }
        self.slowest = self.slowest.max(outcome.time);
    }

    /// Whether all is well.
    pub fn hold(&self) -> bool {
        self.broken.is_empty() && self.large.is_empty() && self.slow.is_empty()
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { read, refused, broken, large, slow, ratio, ratio_of_large, slowest } = self;
        write!(
            f,
            "{read} read, {refused} refused, {} broken {broken:?}, {} too large {large:?}, {} over 1 s {slow:?}, at \
             most \
             {ratio:.1} times a file's size in memory, {ratio_of_large:.1} times that of one of 1000 bytes or more, \
             slowest {slowest:?}",
            broken.len(),
            large.len(),
            slow.len(),
        )
    }
}

/// Small files that ask for much: a name, the bytes, and how many times.
pub fn greedy() -> Vec<Case> {
    let asset = "{\"asset\":{\"version\":\"2.0\"},";
    let many = |what: &str, count: usize| vec![what; count].join(",");
    let list = |table: &str, row: &str| format!("{asset}\"{table}\":[{}]}}", many(row, 100_000));
    let buffer = format!(
        "\"buffers\":[{{\"byteLength\":11988,\"uri\":\"data:;base64,{}\"}}]",
        "AACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/".repeat(333)
    );
    let views = "\"bufferViews\":[{\"buffer\":0,\"byteLength\":11988}]";
    let accessor = "{\"bufferView\":0,\"componentType\":5126,\"count\":999,\"type\":\"VEC3\"}";
    let primitives = (0..3000).map(|index| format!("{{\"attributes\":{{\"POSITION\":{}}}}}", index % 1000));
    let primitives = primitives.collect::<Vec<_>>().join(",");
    let shared = format!(
        "{asset}{buffer},{views},\"accessors\":[{}],\"meshes\":[{{\"primitives\":[{primitives}]}}]}}",
        many(accessor, 1000)
    );
    let product = format!(
        "{asset}{buffer},{views},\"accessors\":[{accessor}],\"meshes\":[{{\"primitives\":[{}]}}],\"nodes\":[{}]}}",
        many("{\"attributes\":{\"POSITION\":0}}", 2000),
        many("{\"mesh\":0}", 2000),
    );
    let chain: Vec<String> = (1..=100_000).map(|child| format!("{{\"children\":[{child}]}}")).collect();
    let chain = format!("{asset}\"nodes\":[{},{{}}]}}", chain.join(","));
    let ply = |rows: &str| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex {rows}\nproperty float x\nproperty float y\nproperty float \
             z\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n"
        )
    };
    let zeros = format!(
        "{asset}\"accessors\":[{{\"componentType\":5126,\"count\":1000000000000,\"type\":\"VEC3\"}}],\
         \"meshes\":[{{\"primitives\":[{{\"attributes\":{{\"POSITION\":0}}}}]}}]}}"
    );
    let materials: String = (0..50_000).map(|name| format!("usemtl {name}\nf 1 1 1\n")).collect();
    let files = [
        ("numbers.gltf", format!("{asset}\"extras\":[{}]}}", many("0", 300_000))),
        ("objects.gltf", format!("{asset}\"extras\":[{}]}}", many("{}", 300_000))),
        ("fields.gltf", format!("{asset}\"extras\":[{}]}}", many("{\"\":0}", 300_000))),
        ("deep.gltf", format!("{asset}\"extras\":{}", "[".repeat(300_000))),
        ("nodes.gltf", list("nodes", "{}")),
        ("materials.gltf", list("materials", "{}")),
        ("meshes.gltf", list("meshes", "{\"primitives\":[]}")),
        ("shared.gltf", shared),
        ("product.gltf", product),
        ("chain.gltf", chain),
        ("zeros.gltf", zeros),
        ("rows.ply", ply("1000000000000")),
        (
            "none.ply",
            "ply\nformat ascii 1.0\nelement a 999999999999999999\nelement vertex 0\nproperty float \
          x\nproperty float y\nproperty float z\nelement face 0\nproperty list uchar int \
          vertex_indices\nend_header\n"
                .into(),
        ),
        ("polygon.obj", format!("v 0 0 0\nv 1 0 0\nf{}\n", " 1 2".repeat(100_000))),
        ("materials.obj", format!("v 0 0 0\n{materials}")),
        ("libraries.obj", "mtllib blender_scene.mtl\n".repeat(10_000)),
        ("keywords.obj", (0..100_000).map(|word| format!("k{word}\n")).collect()),
        ("newmtl.obj", format!("mtllib {}\n", "a ".repeat(100_000))),
    ];
    let maps: String = (0..30_000).map(|map| format!("map_Kd {map}\n")).collect();
    let case = |(name, text): (&str, String)| Case { name: name.into(), bytes: text.into(), beside: BTreeMap::new() };
    let mut cases: Vec<Case> = files.into_iter().map(case).collect();
    for (name, materials) in [("few.obj", 300), ("many.obj", 100_000)] {
        let library = format!("{}{maps}", "newmtl a\n".repeat(materials));
        let beside = BTreeMap::from([("a.mtl".to_owned(), library.into_bytes())]);
        cases.push(Case { name: name.into(), bytes: b"mtllib a.mtl\n".to_vec(), beside });
    }
    cases
}
