//! What every registered camera must hold, with no line for any of them.

use bevy_ecs::prelude::*;
use glam::{DVec2, DVec3};
use pinhole::cameras::{CameraRaySlices, ImageFrame, Listed, RaySpread, ScreenSlices, with_cameras};
use pinhole::extract::PixelSteps;
use pinhole::plan::Census;
use pinhole::rays::{ndc_from_raster, screen_from_ndc};
use pinhole::render_scene;
use pinhole::scene::{Background, Resolution, Rgb};
use pinhole_lab::measure::draws::Draws;

/// Odd and even, wide and high; the components of `EXTREMES` are accepted for all of them.
const SIZES: [[u32; 2]; 5] = [[64, 64], [33, 15], [15, 33], [2, 1], [1, 1]];

/// A camera, its image and its component in words.
struct Case<C> {
    camera: C,
    image: ImageFrame,
    said: String,
}

impl<C: Listed> Case<C> {
    fn all() -> Vec<Self> {
        let components = C::EXTREMES.iter().copied().chain([C::Component::default()]);
        let case = |component: C::Component, [width, height]: [u32; 2]| {
            let image = ImageFrame { width, height };
            let said = format!("{component:?} over {width} × {height}");
            let camera = C::project(&component, image, "camera").unwrap_or_else(|error| panic!("{said}: {error}"));
            Self { camera, image, said }
        };
        components.flat_map(|component| SIZES.map(|size| case(component, size))).collect()
    }

    fn screen(&self, raster: DVec2) -> DVec2 {
        screen_from_ndc(ndc_from_raster(raster, self.image.size()), self.image.aspect())
    }

    /// Origins and directions of the rays through screen points.
    fn rays(&self, points: &[DVec2]) -> Vec<(DVec3, DVec3)> {
        let [x, y] = [0, 1].map(|axis| points.iter().map(|point| point[axis]).collect::<Vec<f64>>());
        let mut columns = [(); 6].map(|()| vec![0.0; points.len()]);
        let [ox, oy, oz, dx, dy, dz] = columns.each_mut().map(|column| &mut column[..]);
        let rays = CameraRaySlices { origin: [ox, oy, oz], direction: [dx, dy, dz] };
        self.camera.generate(ScreenSlices { x: &x, y: &y }, rays);
        let at = |row: usize, first: usize| DVec3::from([0, 1, 2].map(|axis: usize| columns[first + axis][row]));
        (0..points.len()).map(|row| (at(row, 0), at(row, 3))).collect()
    }

    fn ray(&self, point: DVec2) -> (DVec3, DVec3) {
        self.rays(&[point])[0]
    }

    /// The rays through the centres of all pixels, row by row.
    fn pixels(&self) -> Vec<(DVec3, DVec3)> {
        let ImageFrame { width, height } = self.image;
        let centre = |x, y| self.screen(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5));
        self.rays(&(0..height).flat_map(|y| (0..width).map(move |x| centre(x, y))).collect::<Vec<_>>())
    }
}

/// Every ray is finite and its direction a unit vector, and a row is computed alike in a block of any length.
fn rays_are_finite_and_unit<C: Listed>() -> usize {
    let mut tried = 0;
    for (number, case) in Case::<C>::all().iter().enumerate() {
        let mut draws = Draws::new(1401, number as u64);
        // Filters place some points slightly outside the image.
        let mut random = || (DVec2::new(draws.unit(), draws.unit()) * 1.2 - 0.1) * case.image.size();
        let mut rasters: Vec<DVec2> = (0..1021).map(|_| random()).collect();
        rasters.extend([DVec2::ZERO, case.image.size(), case.image.size() / 2.0]);
        let points: Vec<DVec2> = rasters.into_iter().map(|raster| case.screen(raster)).collect();
        for (&point, (origin, direction)) in points.iter().zip(case.rays(&points)) {
            let said = &case.said;
            assert!(origin.is_finite() && direction.is_finite(), "{said}: {point} has {origin} {direction}");
            assert!((direction.length() - 1.0).abs() < 4.0 * f64::EPSILON, "{said}: {point} has {direction}");
            assert!(C::HAS_MANY_ORIGINS || origin == DVec3::ZERO, "{said}: {point} starts at {origin}");
            assert_eq!(case.ray(point), (origin, direction), "{said}: {point} alone");
            tried += 1;
        }
    }
    tried
}

/// A point on the ray through a screen point leads back to it, and to the same ray.
fn points_lead_back_to_the_screen<C: Listed>() -> (usize, f64) {
    let (mut tried, mut worst) = (0, 0.0_f64);
    for (number, case) in Case::<C>::all().iter().enumerate() {
        let (mut draws, said) = (Draws::new(1402, number as u64), &case.said);
        for _ in 0..1000 {
            let point = case.screen(DVec2::new(draws.unit(), draws.unit()) * case.image.size());
            // At the very edge of an outline rounding may decide either way.
            if !case.camera.is_in_image(point * 1.001) {
                continue;
            }
            let (origin, direction) = case.ray(point);
            let size = origin.length().max(1.0);
            let found = case.camera.screen_from_camera(origin + direction * size * draws.power_of_ten(-2.0, 2.0));
            let found = found.unwrap_or_else(|| panic!("{said}: {point} is not seen"));
            worst = worst.max((found - point).length() / case.image.aspect().max(1.0));
            let (origin_again, direction_again) = case.ray(found);
            let off = (direction_again - direction).length() + (origin_again - origin).length() / size;
            assert!(off < 1e-13, "{said}: {point} leads back to {found}");
            tried += 1;
        }
        if C::HAS_IMAGE_PLANE {
            let behind = case.camera.screen_from_camera(DVec3::new(0.1, 0.2, 1.0));
            assert_eq!(behind, None, "{said}: what is behind is seen");
        }
    }
    assert!(worst < 1e-11, "{worst:e} of the image");
    (tried, worst)
}

/// The ray differentials of a scene are the differences of the rays of neighbouring pixels.
fn pixel_steps_are_differences<C: Listed>() -> usize {
    let mut tried = 0;
    let components = C::EXTREMES.iter().copied().chain([C::Component::default()]);
    for (component, [width, height]) in components.flat_map(|own| SIZES.map(|size| (own, size))) {
        let mut scene = World::new();
        scene.spawn((component, Resolution { width, height }));
        let census = &Census::of(&scene);
        let (steps, camera) = (census.table::<PixelSteps>(), census.table::<C>());
        let (steps, camera) = (*steps.expect("steps"), *camera.expect("a camera"));
        let image = ImageFrame { width, height };
        let case = Case { camera, image, said: format!("{component:?} over {width} × {height}") };
        let (rays, said) = (case.pixels(), &case.said);
        let plane = |(_, direction): (DVec3, DVec3)| direction / -direction.z;
        let mut largest = 0.0_f64;
        let columns = width as usize;
        for (index, &ray) in rays.iter().enumerate() {
            let (is_last, below) = ((index + 1) % columns == 0, rays.get(index + columns));
            let neighbours = [rays.get(index + 1).filter(|_| !is_last), below];
            for (axis, &next) in neighbours.into_iter().enumerate().filter_map(|(axis, next)| Some((axis, next?))) {
                let is_near = |found: DVec3, told: DVec3, size: f64| (found - told).length() <= 1e-14 * size;
                match camera.spread(image) {
                    RaySpread::Central(_) => {
                        let (from, to) = (plane(ray), plane(next));
                        let size = from.length().max(to.length());
                        assert!(is_near(to - from, steps.direction[axis], size * size), "{said}: {from} {to}");
                    }
                    RaySpread::Parallel(half) => {
                        let size = half * image.aspect().max(1.0);
                        assert!(is_near(next.0 - ray.0, steps.origin[axis], size), "{said}: {ray:?} {next:?}");
                        assert_eq!(ray.1, steps.ahead, "{said}");
                    }
                    RaySpread::Angular(_) => {
                        largest = largest.max(libm::atan2(ray.1.cross(next.1).length(), ray.1.dot(next.1)));
                    }
                }
                tried += 1;
            }
        }
        assert_eq!(C::HAS_IMAGE_PLANE, steps.angle.is_none(), "{said}");
        // Where a step is longer than a right angle, the chord is no measure of it.
        if let Some(angle) = steps.angle.filter(|&angle| rays.len() > 100 && angle < 0.5) {
            let ratio = largest / angle;
            assert!((0.98..1.0 + 1e-9).contains(&ratio), "{said}: the largest step is {ratio} of the one told");
        }
    }
    tried
}

/// A white background fills the image, or all that is inside its outline.
fn a_white_sky_fills_the_image<C: Listed>() -> usize {
    let mut tried = 0;
    for component in C::EXTREMES {
        let mut scene = World::new();
        scene.spawn((*component, Resolution { width: 31, height: 17 }));
        scene.spawn(Background { colour: Rgb::grey(1.0) });
        let film = render_scene(&scene).expect("renders").film;
        let white = (0..17).flat_map(|y| (0..31).map(move |x| (x, y))).filter(|&(x, y)| film.mean(x, y)[0] == 1.0);
        let white = white.count();
        assert!(white == 31 * 17 || (C::OUTLINE.is_some() && white > 100), "{component:?}: {white} pixels");
        assert_eq!(film.rejected().0, 0);
        tried += 31 * 17;
    }
    tried
}

fn check<C: Listed>() {
    let rays = rays_are_finite_and_unit::<C>();
    let (points, worst) = points_lead_back_to_the_screen::<C>();
    let (steps, pixels) = (pixel_steps_are_differences::<C>(), a_white_sky_fills_the_image::<C>());
    eprintln!(
        "{}: {rays} rays, {points} points back to {worst:.1e} of the image, {steps} pixel steps, {pixels} pixels",
        C::NAMES.noun
    );
    assert!(rays > 5000 && points > 1000 && steps > 1000);
}

macro_rules! every_camera {
    ($($component:ident($camera:ty) $noun:literal,)+) => {
        #[test]
        fn every_camera_keeps_what_is_asked_of_it() {
            $(check::<$camera>();)+
        }
    };
}
with_cameras!(every_camera);
