//! Spheres scaled unevenly, lit by wrong normals and by right ones.

use super::Figure;
use super::acne::Occluders;
use super::label::Label;
use super::pen::{Pen, RAY, WIDTH};
use super::picture::Picture;
use super::svg::{Drawing, Svg};
use crate::naive::ellipsoid::normal_as_direction;
use glam::DVec2;
use pinhole::Result;
use pinhole::extract::{EllipsoidTable, MaterialTable, PointLightTable};
use pinhole::film::FilmTile;
use pinhole::intersect::{Hits, Surface, Surfaces};
use pinhole::lights::irradiance_from_point;
use pinhole::material::lambertian;
use pinhole::plan::{Census, Table};
use pinhole::rays::WorldRays;
use pinhole::render::inspect;
use pinhole::scene::Resolution;
use pinhole::shade::shadow_t_max;
use pinhole::shapes::{normal_world_from_object, offset_origin};
use pinhole::{Chapter, Overrides};

/// Pixels of each of the two pictures.
const SIZE: [u32; 2] = [320, 180];
const GAP: f64 = 10.0;
const HEAD: f64 = 32.0;

/// A chapter's ellipsoids lit by normals that were transformed like directions, beside the right ones.
pub fn draw(chapter: &Chapter, figure: &Figure) -> Result<Drawing> {
    let across = (WIDTH - 3.0 * GAP) / 2.0;
    let panel = DVec2::new(across, across * f64::from(SIZE[1]) / f64::from(SIZE[0]));
    let mut svg = Svg::new(figure.name, HEAD + panel.y + 64.0);
    let (right, naive, worst) = pictures(chapter, figure)?;
    let off = format!("the worst normal is off by {:.0}°", worst.degrees);
    let told = [
        ("transformed like a direction", &naive, off.as_str()),
        ("by the inverse transpose", &right, "as pinhole renders"),
    ];
    for (column, (title, picture, below)) in told.into_iter().enumerate() {
        let low = DVec2::new(GAP + column as f64 * (across + GAP), HEAD);
        svg.picture(low, panel, &Picture::painted(SIZE, picture)?);
        let middle = DVec2::X * (across / 2.0);
        svg.label(Label::near(low + middle - DVec2::Y * 6.0, title, DVec2::NEG_Y, 0.0).title(1.0));
        svg.label(Label::near(low + middle + DVec2::Y * (panel.y + 5.0), below, DVec2::Y, 0.0).title(0.92));
    }
    let (x, y) = (worst.row as u32 % SIZE[0], worst.row as u32 / SIZE[0]);
    let place = (DVec2::new(f64::from(x), f64::from(y)) + 0.5) / DVec2::new(f64::from(SIZE[0]), f64::from(SIZE[1]));
    let at = DVec2::new(GAP, HEAD) + place * panel;
    svg.circle(at, 5.0, None, Some(Pen::new(RAY, 1.6)));
    svg.label(Label::near(at, "here", DVec2::X, 9.0).coloured(RAY));
    Ok(svg.finish(figure.about, &figure.stamp(SIZE, "")))
}

/// The normal that is off most.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Worst {
    /// By how much.
    degrees: f64,
    /// Its pixel's row.
    row: usize,
}

/// What pinhole renders, the same with naive normals, and the worst of these.
fn pictures(chapter: &Chapter, figure: &Figure) -> Result<(Vec<[f32; 3]>, Vec<[f32; 3]>, Worst)> {
    let [width, height] = SIZE;
    let scene = chapter.world(&Overrides { resolution: Some(Resolution { width, height }), ..Overrides::default() });
    let inspection = inspect(&scene, &chapter.stages(), width.max(height))?;
    let tile = inspection.tiles.first().map(|&tile| inspection.world.entity(tile));
    let columns = tile.as_ref().and_then(|tile| {
        Some(((tile.get::<WorldRays>()?, tile.get::<Hits>()?), tile.get::<Surfaces>()?, tile.get::<FilmTile>()?))
    });
    let lacks = || figure.unsuited("a lit sphere that is scaled unevenly");
    let ((rays, hits), surfaces, film) = columns.ok_or_else(lacks)?;
    let census = &Census::of(&scene);
    let (lights, materials) = (PointLightTable::extract(census)?, MaterialTable::extract(census)?);
    let (ellipsoids, occluders) = (EllipsoidTable::extract(census)?, Occluders::of(&scene)?);
    let right: Vec<[f32; 3]> = (0..film.count.len()).map(|row| film.mean(row)).collect();
    let (mut naive, mut worst) = (right.clone(), None::<Worst>);
    for (row, naive) in naive.iter_mut().enumerate() {
        let Some(number) = ellipsoids.shape.iter().position(|&shape| shape == hits.shape[row]) else { continue };
        let ellipsoid = &ellipsoids.row[number];
        let surface = surfaces.get(row);
        let point = rays.point_at(row, hits.t[row]);
        let (map, from_centre) = (ellipsoid.unit_from_world, point - ellipsoid.centre);
        // The unit sphere's own normal, taken out of it as a direction is.
        let turned = normal_as_direction(map.inverse(), map * from_centre);
        let facing = if turned.dot(rays.direction_of(row)) > 0.0 { -turned } else { turned };
        let wrong = Surface { normal: facing.as_vec3(), ..surface };
        let outward = normal_world_from_object(map, map * from_centre).normalize();
        let degrees = libm::acos(turned.dot(outward).clamp(-1.0, 1.0)).to_degrees();
        if worst.is_none_or(|worst| degrees > worst.degrees) {
            worst = Some(Worst { degrees, row });
        }
        *naive = lit(&wrong, &lights, &materials, &occluders);
    }
    Ok((right, naive, worst.ok_or_else(lacks)?))
}

/// What all lights together make of a surface.
fn lit(surface: &Surface, lights: &PointLightTable, materials: &MaterialTable, occluders: &Occluders) -> [f32; 3] {
    let origin = offset_origin(surface.position, surface.normal, surface.bound).as_dvec3();
    let mut sum = [0.0_f32; 3];
    for light in &lights.row {
        let to_light = light.position - origin;
        let distance = to_light.length();
        let direction = to_light / distance;
        let cosine = surface.normal.as_dvec3().dot(direction);
        if cosine > 0.0 && !occluders.block(origin, direction, f64::from(shadow_t_max(distance))) {
            let colour = materials.parameters.get(surface.material as usize).copied().unwrap_or_default().colour;
            let irradiance = irradiance_from_point(light.intensity, cosine, distance * distance);
            let brings = [0, 1, 2].map(|part| lambertian(colour)[part] * irradiance[part]);
            sum.iter_mut().zip(brings).for_each(|(sum, part)| *sum += part as f32);
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::trial;

    #[test]
    fn naive_normals_change_the_scaled_sphere_and_the_right_ones_are_shaded_as_pinhole_does() {
        let figure = trial::figure(draw);
        let (right, naive, worst) = pictures(&trial::chapter(trial::central), &figure).expect("pictures");
        let differ = right.iter().zip(&naive).filter(|(right, naive)| right != naive).count();
        eprintln!("{differ} of {} pixels differ, the worst normal by {:.1} degrees", right.len(), worst.degrees);
        assert!(differ > 100 && differ < right.len() / 4 && worst.degrees > 20.0 && worst.degrees < 90.0);
    }
}
