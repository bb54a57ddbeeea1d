//! The strips: far spheres, shadows with constants, viewports far from the origin, angles up to 179.99°.

use super::shadows::with_start;
use super::{Picture, Strip};
use crate::measure::ray_aim::AimedRay;
use crate::measure::sweep::{scale, set_fov, set_size, shift};
use crate::naive::camera::{tan_half_f32, viewport_f32};
use crate::naive::shadow::{ShadowStart, start_after_constant, start_at_hit, start_off_surface};
use crate::naive::sphere::{hit_f32, hit_haines_f32};
use bevy_ecs::prelude::*;
use glam::{DVec3, Vec3};
use pinhole::Result;
use pinhole::extract::{CameraAxes, ImageFrame, PerspectiveProjection, PlaneTable, SphereTable, eye};
use pinhole::film::Curve;
use pinhole::plan::{Census, Stage, Table};
use pinhole::rays::WorldRays;
use pinhole::render::inspect;
use pinhole::scene::*;
use pinhole::shapes::{plane_t, sphere_t};

/// Pixels of a picture of the scene.
const SIZE: [u32; 2] = [144, 81];
/// Pixels of a picture of a far sphere, in each direction.
const FAR: u32 = 56;

/// All strips, of the scene that `make` makes.
///
/// Errors: what a render of it would be refused for.
pub fn strips(make: &dyn Fn() -> World, offer: &[Stage]) -> Result<Vec<Strip>> {
    let mut strips = vec![far_sphere(1e3, offer)?, far_sphere(1e4, offer)?];
    let starts: [(&str, fn(Vec3, Vec3) -> ShadowStart); 3] = [
        ("from the hit itself", |position, _| start_at_hit(position)),
        ("t > 1e-3", |position, _| start_after_constant(position)),
        ("hit + 1e-4 n", start_off_surface),
    ];
    for (k, (name, start)) in [(0, starts[0]), (17, starts[1]), (17, starts[2]), (-10, starts[1])] {
        strips.extend(shadows(make, offer, k, name, start)?);
    }
    for distance in [1e4, 1e5, 1e6] {
        strips.push(far_eye(make, offer, distance)?);
    }
    strips.push(angles(make, offer)?);
    strips.push(widest(make, offer)?);
    Ok(strips)
}

/// A strip of naive, pinhole and difference.
fn strip(title: String, says: impl Fn(usize, usize) -> String, naive: (&str, Picture), pinhole: Picture) -> Strip {
    let difference = pinhole.difference(&naive.1);
    let says = says(pinhole.differing(&naive.1), pinhole.pixels.len());
    let named = |(name, picture): (&str, Picture)| (name.to_string(), picture);
    let pictures = [naive, ("pinhole", pinhole), ("difference, 4 times", difference)].map(named).to_vec();
    Strip { title, says, pictures }
}

/// The frame's rays, line by line from the top.
fn rays_of(scene: &World, offer: &[Stage]) -> Result<Vec<AimedRay>> {
    let image = ImageFrame::extract(&Census::of(scene))?;
    // One tile, whose rows then are the image's lines.
    let frame = inspect(scene, offer, image.width.max(image.height))?;
    let Some(rays) = frame.world.get::<WorldRays>(frame.tiles[0]) else { return Ok(Vec::new()) };
    let ray = |row: usize| AimedRay { origin: rays.origin(row), direction: rays.direction(row) };
    Ok((0..rays.direction[0].len()).map(ray).collect())
}

/// A sphere so many radii away, filling the image; grey is how far before its centre it is hit.
fn far_sphere(distance: f64, offer: &[Stage]) -> Result<Strip> {
    let mut scene = World::new();
    let fov = 2.0 * libm::atan(1.15 / distance).to_degrees();
    scene.spawn((
        PerspectiveCamera { fov: Degrees(fov), axis: FovAxis::Vertical },
        Resolution { width: FAR, height: FAR },
    ));
    let centre = DVec3::new(0.0, 0.0, -distance);
    scene.spawn((Sphere { radius: 1.0 }, Placement::at(centre.x, centre.y, centre.z), Matte::default()));
    let rays = rays_of(&scene, offer)?;
    let grey = |t: Option<f64>| match t {
        Some(t) => [0.25 + 0.75 * (distance - t).clamp(0.0, 1.0) as f32; 3],
        None => [0.02; 3],
    };
    let paint = |hit: &dyn Fn(&AimedRay) -> Option<f64>| Picture {
        width: FAR,
        pixels: rays.iter().map(|ray| grey(hit(ray))).collect(),
        curve: Curve::Straight,
    };
    let naive = |method: fn(Vec3, Vec3, Vec3, f32) -> Option<f32>| {
        paint(&move |ray| method(ray.origin, ray.direction, centre.as_vec3(), 1.0).map(f64::from))
    };
    let pinhole = paint(&|ray| {
        Some(sphere_t(ray.origin.as_dvec3(), ray.direction.as_dvec3(), centre, 1.0)).filter(|t| t.is_finite())
    });
    let (school, perpendicular) = (naive(hit_f32), naive(hit_haines_f32));
    let (wrong, better, all) = (pinhole.differing(&school), pinhole.differing(&perpendicular), pinhole.pixels.len());
    let says = format!(
        "Grey is how far before its centre the sphere is hit. The formula from school in f32 is off in {wrong} of {all} \
         pixels, the perpendicular form in f32 in {better}."
    );
    let pictures = vec![
        ("naive b2 - 4ac, f32".to_string(), school.clone()),
        ("naive perpendicular form, f32".to_string(), perpendicular),
        ("pinhole".to_string(), pinhole.clone()),
        ("first and pinhole, 4 times".to_string(), pinhole.difference(&school)),
    ];
    Ok(Strip { title: format!("A sphere {distance:e} radii away"), says, pictures })
}

/// The scene in units 2ᵏ as short, with shadow rays that start by a constant; none where no light falls.
fn shadows(
    make: &dyn Fn() -> World,
    offer: &[Stage],
    k: i32,
    name: &str,
    start: fn(Vec3, Vec3) -> ShadowStart,
) -> Result<Option<Strip>> {
    let mut scene = make();
    set_size(&mut scene, SIZE);
    scale(&mut scene, k);
    let Some([pinhole, naive]) = with_start(&scene, offer, SIZE, start)? else { return Ok(None) };
    let size = match k {
        0 => "the scene as it is".to_string(),
        _ => format!("the scene 2^{k} times as large"),
    };
    let says = |wrong, all| {
        format!(
            "Only the start of the shadow ray differs. {wrong} of {all} pixels are wrong: where points lie behind their \
             own surface after rounding, it shadows them; where the constant is large, what is near casts no shadow."
        )
    };
    Ok(Some(strip(format!("Shadow rays, {name}: {size}"), says, (&format!("naive, {name}"), naive), pinhole)))
}

/// What rays from the eye hit, painted by its normal.
fn painted(scene: &World, rays: &[AimedRay], width: u32) -> Result<Picture> {
    let census = &Census::of(scene);
    let (spheres, planes) = (SphereTable::extract(census)?, PlaneTable::extract(census)?);
    let colour = |ray: &AimedRay| {
        let (o, d) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
        let mut nearest = (f64::INFINITY, DVec3::ZERO);
        for row in 0..spheres.row.len() {
            let (centre, t) =
                (spheres.row[row].centre, sphere_t(o, d, spheres.row[row].centre, spheres.row[row].radius));
            if t < nearest.0 {
                nearest = (t, (o + t * d - centre).normalize());
            }
        }
        for row in 0..planes.row.len() {
            let t = plane_t(o, d, planes.row[row].normal, planes.row[row].offset);
            if t < nearest.0 {
                nearest = (t, planes.row[row].normal);
            }
        }
        if nearest.0.is_infinite() { [0.05; 3] } else { (nearest.1 * 0.5 + 0.5).as_vec3().to_array() }
    };
    Ok(Picture { width, pixels: rays.iter().map(colour).collect(), curve: Curve::Straight })
}

/// The scene and its camera far from the world's origin, with a viewport of f32 points there.
fn far_eye(make: &dyn Fn() -> World, offer: &[Stage], distance: f64) -> Result<Strip> {
    let mut scene = make();
    set_size(&mut scene, SIZE);
    shift(&mut scene, DVec3::splat(distance));
    let rays = rays_of(&scene, offer)?;
    let pinhole = painted(&scene, &rays, SIZE[0])?;
    let census = &Census::of(&scene);
    let (eye, axes) = (eye(census)?.as_vec3(), CameraAxes::extract(census)?.world_from_camera.as_mat3());
    let vertical = 2.0 * libm::atan(PerspectiveProjection::extract(census)?.tan_half_vertical).to_degrees();
    let naive_ray = |pixel: u32| {
        let pixel = [pixel % SIZE[0], pixel / SIZE[0]];
        let direction = viewport_f32(eye, axes, vertical as f32, SIZE, pixel);
        AimedRay { origin: Vec3::ZERO, direction }
    };
    let naive: Vec<AimedRay> = (0..SIZE[0] * SIZE[1]).map(naive_ray).collect();
    let says = |wrong, all| {
        format!(
            "Both eyes stand at the same place; only directions differ, and both are traced from the eye by pinhole's \
             kernels. Painted by normals. {wrong} of {all} pixels differ."
        )
    };
    let naive = ("naive viewport of world points, f32", painted(&scene, &naive, SIZE[0])?);
    Ok(strip(format!("The scene moved by {distance:e} along x, y and z"), says, naive, pinhole))
}

/// The scene through several angles.
fn angles(make: &dyn Fn() -> World, offer: &[Stage]) -> Result<Strip> {
    let picture = |degrees: f64| {
        let mut scene = make();
        set_size(&mut scene, SIZE);
        set_fov(&mut scene, degrees);
        Ok((format!("pinhole, {degrees} degrees"), painted(&scene, &rays_of(&scene, offer)?, SIZE[0])?))
    };
    let pictures = [0.1, 5.0, 40.0, 90.0, 150.0, 170.0, 179.0, 179.99].map(picture);
    Ok(Strip {
        title: "Fields of view".into(),
        says:
            "From 0.1 to 179.99 degrees down the image, painted by normals. A narrower angle would give pixels finer \
               than f32 directions and is refused; 180 degrees have no image plane and are refused too."
                .into(),
        pictures: pictures.into_iter().collect::<Result<_>>()?,
    })
}

/// The widest angle beside the tangent in f32, and that of 180 degrees, which turns the image over.
fn widest(make: &dyn Fn() -> World, offer: &[Stage]) -> Result<Strip> {
    const WIDEST: f64 = 179.99;
    let mut scene = make();
    set_size(&mut scene, SIZE);
    set_fov(&mut scene, WIDEST);
    let pinhole = painted(&scene, &rays_of(&scene, offer)?, SIZE[0])?;
    let axes = CameraAxes::extract(&Census::of(&scene))?.world_from_camera.as_mat3();
    let naive = |degrees: f32| {
        let (tangent, [width, height]) = (tan_half_f32(degrees), SIZE.map(|side| side as f32));
        let ray = |pixel: u32| {
            let [x, y] = [pixel % SIZE[0], pixel / SIZE[0]].map(|at| at as f32 + 0.5);
            let screen = [(2.0 * x - width) / height, (height - 2.0 * y) / height];
            let direction = axes * Vec3::new(screen[0] * tangent, screen[1] * tangent, -1.0);
            AimedRay { origin: Vec3::ZERO, direction: (direction / direction.abs().max_element()).normalize() }
        };
        let rays: Vec<AimedRay> = (0..SIZE[0] * SIZE[1]).map(ray).collect();
        painted(&scene, &rays, SIZE[0])
    };
    let (near, turned) = (naive(WIDEST as f32)?, naive(180.0)?);
    let says = format!(
        "At {WIDEST} degrees the tangent in f32 is wrong in its fourth digit, which so wide an image hardly shows: {} of {} \
         pixels differ. At 180 degrees it is negative, and the image stands on its head; pinhole refuses that angle.",
        pinhole.differing(&near),
        pinhole.pixels.len()
    );
    let pictures = vec![
        (format!("naive tan in f32, {WIDEST} degrees"), near),
        (format!("pinhole, {WIDEST} degrees"), pinhole),
        ("naive tan in f32, 180 degrees".into(), turned),
    ];
    Ok(Strip { title: "The widest angle".into(), says, pictures })
}
