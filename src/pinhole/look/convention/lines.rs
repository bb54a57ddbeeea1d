use super::{Described, Opening, PlacedCamera, Program, theirs_from_pinhole};
use crate::each::Each;
use crate::scene::FovAxis;
use glam::{DMat3, DQuat, DVec3};

/// What to type in another program to place the same camera, line by line; numbers have twelve digits.
pub fn lines(program: Program, camera: &PlacedCamera) -> Vec<String> {
    let theirs = theirs_from_pinhole(program, camera);
    let opening = short(theirs.opening);
    let (width, height) = (camera.image.width, camera.image.height);
    let [eye, target, up] = [camera.look.eye, camera.look.target, camera.look.up].each(|point| parts(point, ", "));
    match program {
        Program::OneWeekend => vec![
            format!("cam.image_width = {width}; cam.aspect_ratio = {width}.0 / {};", rows_divisor(width, height)),
            format!("cam.vfov = {opening};"),
            format!("cam.lookfrom = point3({eye}); cam.lookat = point3({target});"),
            format!("cam.vup = vec3({up});"),
        ],
        Program::GroundUp => vec![
            format!("vp.set_hres({width}); vp.set_vres({height}); vp.set_pixel_size(1.0);"),
            format!("camera_ptr->set_eye({eye}); camera_ptr->set_lookat({target});"),
            format!("camera_ptr->set_view_distance({opening});"),
        ],
        Program::OpenGl => vec![
            format!("gluPerspective({opening}, {width}.0 / {height}.0, near, far);"),
            format!("gluLookAt({eye}, {target}, {up});"),
        ],
        Program::Gltf => gltf(&theirs, &opening, camera),
        Program::Pbrt => vec![
            "Scale -1 1 1".into(),
            format!("LookAt {}", [&eye, &target, &up].each(|point| point.replace(", ", " ")).join("  ")),
            format!("Camera \"perspective\" \"float fov\" [ {opening} ]"),
            format!("Film \"rgb\" \"integer xresolution\" [ {width} ] \"integer yresolution\" [ {height} ]"),
        ],
        Program::Mitsuba => vec![
            format!("'type': 'perspective', 'fov_axis': 'x', 'fov': {opening},"),
            "'to_world': mi.ScalarTransform4f().look_at(".into(),
            format!("    origin=[{eye}], target=[{target}], up=[{up}]),"),
            format!("'film': {{'type': 'hdrfilm', 'width': {width}, 'height': {height}}}"),
        ],
        Program::OpenCv => open_cv(&theirs, &opening, camera),
        Program::Blender => blender(&theirs, &opening, camera),
    }
}

/// What *One Weekend* has to divide the width by, so that its `int(image_width / aspect_ratio)` is the height: the height
/// itself, or half a row more where the quotients round to less than it.
fn rows_divisor(width: u32, height: u32) -> String {
    let [across, down] = [width, height].each(f64::from);
    if (across / (across / down)) as u32 == height { format!("{height}.0") } else { format!("{height}.5") }
}

/// How to write a camera from another program in pinhole: its field of view, then its placement.
pub fn back(program: Program) -> [String; 2] {
    let words = match program.opening() {
        Opening::Degrees(axis) => format!("axis {axis:?}, the same number"),
        Opening::Radians(axis) => format!("axis {axis:?}, the number times 180 / π"),
        Opening::Pixels => "axis Vertical, 2 atan(height / (2 number))".into(),
        Opening::Millimetres(film, axis) => format!("axis {axis:?}, 2 atan({film} / (2 number))"),
    };
    let place = match program {
        Program::Gltf => "translation and rotation as position and orientation",
        Program::OpenCv => "eye −Rᵀt; the rows of R are x right, y down, z ahead",
        Program::Blender => "the columns are x right, y up, z back, eye; each (x, y, z) is pinhole's (x, z, −y)",
        Program::Pbrt => "eye, target and up as they stand if Scale -1 1 1 is above them",
        _ => "eye, target and up as they stand",
    };
    [words, place.into()]
}

fn gltf(theirs: &Described, opening: &str, camera: &PlacedCamera) -> Vec<String> {
    let q = DQuat::from_mat3(&theirs.axes);
    let rotation = [q.x, q.y, q.z, q.w].each(short).join(", ");
    vec![
        "\"cameras\": [{ \"type\": \"perspective\", \"perspective\": {".into(),
        format!("    \"yfov\": {opening}, \"aspectRatio\": {}, \"znear\": 0.01 }} }}],", short(camera.image.aspect())),
        format!("\"nodes\": [{{ \"camera\": 0, \"translation\": [{}],", parts(theirs.eye, ", ")),
        format!("    \"rotation\": [{rotation}] }}]"),
    ]
}

fn open_cv(theirs: &Described, opening: &str, camera: &PlacedCamera) -> Vec<String> {
    // OpenCV puts pixel centres at integers, so the image's centre is half a pixel less than half its size.
    let [cx, cy] = [camera.image.width, camera.image.height].each(|side| short((f64::from(side) - 1.0) / 2.0));
    let camera_from_world = theirs.axes.transpose();
    let t = camera_from_world * -theirs.eye;
    vec![
        format!("K = [[{opening}, 0, {cx}], [0, {opening}, {cy}], [0, 0, 1]]"),
        format!("R = [[{}],", rows(camera_from_world, 0)),
        format!("     [{}],", rows(camera_from_world, 1)),
        format!("     [{}]]", rows(camera_from_world, 2)),
        format!("t = [{}]", parts(t, ", ")),
    ]
}

fn blender(theirs: &Described, opening: &str, camera: &PlacedCamera) -> Vec<String> {
    let row = |row: usize| format!("{}, {}", rows(theirs.axes, row), short(theirs.eye[row]));
    let Opening::Millimetres(film, FovAxis::Larger) = Program::Blender.opening() else { return Vec::new() };
    vec![
        format!("render.resolution_x, render.resolution_y = {}, {}", camera.image.width, camera.image.height),
        format!("cam.data.sensor_fit, cam.data.sensor_width, cam.data.lens = 'AUTO', {film}, {opening}"),
        format!("cam.matrix_world = Matrix([[{}],", row(0)),
        format!("                           [{}],", row(1)),
        format!("                           [{}], [0, 0, 0, 1]])", row(2)),
    ]
}

fn rows(matrix: DMat3, row: usize) -> String {
    parts(matrix.row(row), ", ")
}

fn parts(vector: DVec3, between: &str) -> String {
    vector.to_array().each(short).join(between)
}

/// A number to twelve digits: more than a 32-bit float has, fewer than rounding errors show in.
fn short(number: f64) -> String {
    let rounded: f64 = format!("{number:.11e}").parse().unwrap_or(number);
    // −0 is written as 0.
    (rounded + 0.0).to_string()
}
