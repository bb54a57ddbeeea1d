use super::*;
use bevy_ecs::prelude::*;
use pinhole::scene::{Matte, PerspectiveCamera, Placement, Sampling, Sphere};
use std::path::PathBuf;

struct Ball;

impl Scene for Ball {
    fn name(&self) -> String {
        "a ball".into()
    }

    fn stem(&self) -> String {
        "ball".into()
    }

    fn text(&self) -> String {
        String::new()
    }

    fn world(&self) -> World {
        let mut world = World::new();
        world.spawn((PerspectiveCamera::default(), Sampling::default(), Resolution { width: 640, height: 360 }));
        world.spawn((Sphere::default(), Placement::at(0.0, 0.0, -3.0), Matte::default()));
        world
    }

    fn stages(&self) -> Vec<Stage> {
        pinhole::stages::all()
    }

    fn explain(&self, error: pinhole::Error) -> String {
        error.to_string()
    }

    fn edited(&self, _: String) -> Result<Rc<dyn Scene>, String> {
        Err("it stays as it is".into())
    }

    fn save(&self) -> Result<PathBuf, String> {
        Err("it is not saved".into())
    }
}

#[test]
fn a_frame_that_an_order_stops_is_begun_again() {
    let (attention, (shown, frames)) = (Arc::<Attention>::default(), watch::channel(Shown::default()));
    let mut viewer = Viewer::new(Rc::new(Ball), Showing::default(), shown, Arc::clone(&attention)).expect("a scene");
    viewer.frame();
    assert!(viewer.done && viewer.begun != Some(viewer.full), "the first frame is coarse: {:?}", viewer.begun);
    std::thread::sleep(Duration::from_millis(400));
    attention.order();
    viewer.frame();
    assert!(!viewer.done && frames.borrow().frame == 1, "the order stopped it before anything was shown");
    attention.taken();
    viewer.frame();
    assert_eq!((viewer.begun, frames.borrow().frame), (Some(viewer.full), 2));
}
