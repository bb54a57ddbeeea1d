//! A ray tracer on one page, as a program of its own: no crate, no ECS, nothing but the idea.
//!
//! The book's first page includes it; the test below compiles and runs it as a reader does.
#![allow(dead_code, reason = "its main is run by a reader, and by the test as a program of its own")]

// ANCHOR: one_page
#[derive(Clone, Copy)]
struct V(f64, f64, f64); // a vector, a point or a colour

impl V {
    fn add(self, o: V) -> V {
        V(self.0 + o.0, self.1 + o.1, self.2 + o.2)
    }
    fn times(self, k: f64) -> V {
        V(self.0 * k, self.1 * k, self.2 * k)
    }
    fn sub(self, o: V) -> V {
        self.add(o.times(-1.0))
    }
    fn dot(self, o: V) -> f64 {
        self.0 * o.0 + self.1 * o.1 + self.2 * o.2
    }
    fn unit(self) -> V {
        self.times(1.0 / self.dot(self).sqrt())
    }
}

struct Sphere {
    centre: V,
    radius: f64,
    colour: V,
}

const SCENE: [Sphere; 2] = [
    Sphere { centre: V(0.0, 0.0, -3.0), radius: 1.0, colour: V(0.9, 0.3, 0.2) },
    // The ground is a large sphere.
    Sphere { centre: V(0.0, -101.0, -3.0), radius: 100.0, colour: V(0.5, 0.6, 0.5) },
];
const LIGHT: V = V(3.0, 4.0, 0.0);
const BRIGHTNESS: f64 = 20.0;

/// The first t > 0 at which origin + t * direction is on the sphere.
fn hit(origin: V, direction: V, sphere: &Sphere) -> Option<f64> {
    let from_centre = origin.sub(sphere.centre);
    let a = direction.dot(direction);
    let half_b = from_centre.dot(direction);
    let c = from_centre.dot(from_centre) - sphere.radius * sphere.radius;
    let root = (half_b * half_b - a * c).sqrt(); // NaN where the ray misses
    [(-half_b - root) / a, (-half_b + root) / a].into_iter().find(|&t| t > 1e-4)
}

/// The nearest sphere on a ray, and the t at which it is hit.
fn nearest(origin: V, direction: V) -> Option<(f64, &'static Sphere)> {
    let mut nearest = None;
    let mut min = f64::INFINITY;
    for sphere in &SCENE {
        let t = hit(origin, direction, sphere).unwrap_or(f64::INFINITY);
        if t < min {
            (min, nearest) = (t, Some((t, sphere)));
        }
    }
    nearest
}

/// The light that arrives from a direction.
fn radiance(origin: V, direction: V) -> V {
    let Some((t, sphere)) = nearest(origin, direction) else {
        return V(0.5, 0.7, 1.0); // the sky
    };
    let point = origin.add(direction.times(t));
    let normal = point.sub(sphere.centre).unit();
    let to_light = LIGHT.sub(point);
    let in_shadow = nearest(point, to_light).is_some_and(|(t, _)| t < 1.0);
    let cosine = normal.dot(to_light.unit()).max(0.0);
    let mut light = 0.1; // a little from everywhere
    if !in_shadow {
        light += BRIGHTNESS * cosine / to_light.dot(to_light);
    }
    sphere.colour.times(light)
}

fn main() {
    let (width, height) = (480, 270);
    let mut picture = format!("P3 {width} {height} 255\n");
    for y in 0..height {
        for x in 0..width {
            // Through the pixel's centre, one unit in front of the eye.
            let aspect = width as f64 / height as f64;
            let right = (2.0 * (x as f64 + 0.5) / width as f64 - 1.0) * aspect;
            let up = 1.0 - 2.0 * (y as f64 + 0.5) / height as f64;
            let V(r, g, b) = radiance(V(0.0, 0.0, 0.0), V(right, up, -1.0));
            let byte = |light: f64| (255.0 * light.clamp(0.0, 1.0).sqrt()) as u8;
            picture += &format!("{} {} {}\n", byte(r), byte(g), byte(b));
        }
    }
    std::fs::write("picture.ppm", picture).expect("the picture can be written");
}
// ANCHOR_END: one_page

/// The picture of the page's program, as light.
pub fn film([width, height]: [usize; 2]) -> pinhole::film::Film {
    let mut film = pinhole::film::Film::new(width as u32, height as u32, width.max(height) as u32);
    for row in 0..width * height {
        let (x, y) = ((row % width) as f64 + 0.5, (row / width) as f64 + 0.5);
        let right = (2.0 * x / width as f64 - 1.0) * width as f64 / height as f64;
        let V(r, g, b) = radiance(V(0.0, 0.0, 0.0), V(right, 1.0 - 2.0 * y / height as f64, -1.0));
        film.tiles[0].add(row, [r as f32, g as f32, b as f32]);
    }
    film
}

#[cfg(test)]
mod tests {
    use super::*;
    use bevy_ecs::prelude::*;
    use glam::DVec3;
    use pinhole::render::{Execution, render};
    use pinhole::scene::*;
    use pinhole::{Chapter, stages};

    /// The same scene as entities: a matte surface reflects ρ/π of what arrives, so the light is π times as strong.
    fn scene([width, height]: [u32; 2]) -> World {
        let mut world = World::new();
        let camera = PerspectiveCamera { fov: Degrees(90.0), axis: FovAxis::Vertical };
        world.spawn((camera, Resolution { width, height }, Integrator::RayCasting));
        for super::Sphere { centre, radius, colour } in SCENE {
            let matte = Matte { colour: Rgb::new(colour.0, colour.1, colour.2) };
            world.spawn((pinhole::scene::Sphere { radius }, matte, Placement::at(centre.0, centre.1, centre.2)));
        }
        let light = PointLight { intensity: Rgb::grey(std::f64::consts::PI * BRIGHTNESS), ..PointLight::default() };
        world.spawn((light, Placement::at(LIGHT.0, LIGHT.1, LIGHT.2)));
        world
    }

    #[test]
    fn the_page_s_program_finds_the_light_that_the_renderer_finds() {
        let [width, height] = [160, 90];
        let chapter = Chapter::new("page", "a page", |_| ()).offer(stages::all());
        let film =
            render(&scene([width, height]), &chapter.stages(), &Execution::default(), &()).expect("renders").film;
        let (mut lit, mut dark) = (0, 0);
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let right = (2.0 * (f64::from(x) + 0.5) / f64::from(width) - 1.0) * f64::from(width) / f64::from(height);
            let direction = V(right, 1.0 - 2.0 * (f64::from(y) + 0.5) / f64::from(height), -1.0);
            let origin = V(0.0, 0.0, 0.0);
            let Some((_, sphere)) = nearest(origin, direction) else { continue };
            let own = radiance(origin, direction).sub(sphere.colour.times(0.1));
            let [r, g, b] = film.mean(x, y).map(f64::from);
            let apart = (DVec3::new(own.0, own.1, own.2) - DVec3::new(r, g, b)).length();
            assert!(apart <= 1e-3 * (1.0 + r), "pixel {x}, {y}: {} and {r}", own.0);
            if r > 0.0 {
                lit += 1;
            } else {
                dark += 1;
            }
        }
        assert!(lit > 2000 && dark > 300, "{lit} lit, {dark} in shadow");
        eprintln!("one page: {lit} lit pixels and {dark} dark ones as the renderer has them");
    }
}
