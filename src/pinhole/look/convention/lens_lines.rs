use super::{PlacedCamera, Program, lines, theirs_from_pinhole};
use crate::extract::LensTable;

/// The lines of `lines` with the camera's lens, or with a word that a program has none.
pub fn lines_with_lens(program: Program, camera: &PlacedCamera, lens: Option<&LensTable>) -> Vec<String> {
    let mut lines = lines(program, camera);
    let Some(LensTable { radius, focus_distance, corners }) = lens.filter(|lens| lens.radius > 0.0) else {
        return lines;
    };
    let after = |lines: &[String], word: &str| lines.iter().position(|line| line.contains(word)).map_or(0, |at| at + 1);
    let is_known = match program {
        Program::OneWeekend => {
            // The cone of rays from a point in focus to the lens.
            let angle = 2.0 * libm::atan(radius / focus_distance).to_degrees();
            lines.push(format!("cam.defocus_angle = {angle}; cam.focus_dist = {focus_distance};"));
            true
        }
        Program::GroundUp => {
            lines.push(format!(
                "camera_ptr->set_lens_radius({radius}); camera_ptr->set_focal_distance({focus_distance});"
            ));
            true
        }
        Program::Pbrt => {
            let own = format!("    \"float lensradius\" [ {radius} ] \"float focaldistance\" [ {focus_distance} ]");
            lines.insert(after(&lines, "Camera "), own);
            true
        }
        Program::Mitsuba => {
            lines[0] = lines[0].replace("'perspective'", "'thinlens'");
            lines.insert(1, format!("'aperture_radius': {radius}, 'focus_distance': {focus_distance},"));
            true
        }
        Program::Blender => {
            // Blender takes a focal length of millimetres for metres of the scene.
            let number = 1e-3 * theirs_from_pinhole(program, camera).opening / (2.0 * radius);
            lines.push("cam.data.dof.use_dof = True".into());
            lines
                .push(format!("cam.data.dof.focus_distance, cam.data.dof.aperture_fstop = {focus_distance}, {number}"));
            if !corners.is_empty() {
                lines.push(format!("cam.data.dof.aperture_blades = {}", corners.len() - 1));
            }
            true
        }
        Program::OpenGl | Program::Gltf | Program::OpenCv => false,
    };
    if !is_known {
        lines.push(format!("(the lens is left out: {program} has none, and shows everything in focus)"));
    } else if !corners.is_empty() && program != Program::Blender {
        lines.push(format!("(the lens is round there: its {} straight edges are left out)", corners.len() - 1));
    }
    lines
}
