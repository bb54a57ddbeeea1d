use super::pilot::Pilot;
use crate::shade::point_evidence;
use bevy_ecs::prelude::*;

/// From so many seconds on it is said before a render how long it is likely to take.
const LONG: f64 = 600.0;
/// From so many rays after one of the camera's on it is said that surfaces absorb too little; rooms with white walls and
/// a ball of glass stay below a quarter of that.
const MANY_BOUNCES: f64 = 64.0;

/// How much there is to render, and by how many.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Samples of all pixels together; none where the time is given instead.
    pub samples: Option<f64>,
    /// Workers.
    pub threads: usize,
}

/// Says that a picture is likely to take very long, by what one ray took with all that followed from it.
pub fn slow(seconds_a_ray: f64, effort: Effort) -> Option<String> {
    let samples = effort.samples?;
    let seconds = samples * seconds_a_ray / effort.threads.max(1) as f64;
    (seconds >= LONG).then(|| {
        format!(
            "the picture is likely to take about {}: {} samples at {} each, on {}; --time 5m stops after five minutes \
             with what there is by then, and --resume goes on from there",
            long_span(seconds),
            many(samples),
            short_span(seconds_a_ray),
            if effort.threads == 1 { "1 thread".into() } else { format!("{} threads", effort.threads) }
        )
    })
}

/// Says that surfaces hand light on to one another for very long, which makes a picture slow without making it better.
pub fn many_bounces(pilot: &Pilot, max_depth: u32) -> Option<String> {
    (pilot.followed_by >= MANY_BOUNCES).then(|| {
        format!(
            "each ray from the camera is followed by {:.0} more on average, because the surfaces that it comes by absorb \
             next to no light; darker surfaces, or a max_depth below the {max_depth} that the integrator allows, render faster",
            pilot.followed_by
        )
    })
}

/// Says that not one of the small pieces of the picture that were tried was finished.
pub fn never_done(pilot: &Pilot, why: &str, effort: Effort) -> String {
    let seconds = pilot.seconds_a_ray;
    let picture = effort.samples.map(|samples| samples * seconds / effort.threads.max(1) as f64);
    let picture = picture.filter(|&picture| picture >= LONG).map(long_span);
    let picture =
        picture.map_or_else(String::new, |span| format!(", so the picture is likely to take more than {span}"));
    format!(
        "none of {} rays tried had come to its end when the time for trying was up: a ray takes more than {}{picture}; \
         {why}",
        pilot.tried,
        short_span(seconds)
    )
}

/// What makes a ray slow in this scene.
pub fn why_slow(scene: &World, pilot: &Pilot, max_depth: u32, shapes: usize) -> String {
    if f64::from(pilot.deepest) >= MANY_BOUNCES {
        return format!(
            "after {} bounces its path still went on, and the integrator allows {max_depth} max_depth; a smaller number, or surfaces \
             that absorb more, would end it",
            pilot.deepest
        );
    }
    let lights = point_evidence(scene).count;
    let tests = if lights > 1 { format!(", for each of {lights} lights") } else { String::new() };
    format!("each ray is tested against {shapes} shapes{tests}")
}

/// Minutes, hours, days or years, whichever gives a number that is easily taken in.
fn long_span(seconds: f64) -> String {
    let units = [("minutes", 60.0, 120.0), ("hours", 3600.0, 48.0), ("days", 86_400.0, 730.0)];
    for (unit, length, most) in units {
        if seconds < length * most {
            return format!("{:.0} {unit}", seconds / length);
        }
    }
    format!("{:.0} years", seconds / (365.25 * 86_400.0))
}

fn short_span(seconds: f64) -> String {
    match seconds {
        ..1e-3 => format!("{:.1} µs", 1e6 * seconds),
        ..1.0 => format!("{:.1} ms", 1e3 * seconds),
        _ => format!("{seconds:.1} s"),
    }
}

fn many(count: f64) -> String {
    match count {
        ..1e6 => format!("{count}"),
        ..1e9 => format!("{:.0} million", count / 1e6),
        _ => format!("{:.1} thousand million", count / 1e9),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_renders_are_told() {
        let of = |samples, seconds, threads| slow(seconds, Effort { samples: Some(samples), threads });
        assert_eq!(of(1e8, 1e-5, 2), None, "500 s");
        assert_eq!(slow(1e9, Effort { samples: None, threads: 1 }), None, "the time is given");
        let told = of(1.2e8, 1e-5, 2).expect("600 s");
        assert!(
            told.starts_with("the picture is likely to take about 10 minutes: 120 million samples at 10.0 µs each")
        );
        assert!(told.contains(", on 2 threads; --time 5m"), "{told}");
        for (samples, seconds, threads, words) in [
            (1e6, 7.1e-3, 1, ["about 118 minutes", "1 million samples", "7.1 ms", "on 1 thread;"]),
            (1e6, 7.2e-3, 1, ["about 2 hours", "1 million samples", "7.2 ms", "on 1 thread;"]),
            (6e10, 2e-6, 4, ["about 8 hours", "60.0 thousand million samples", "2.0 µs", "on 4 threads;"]),
            (9e5, 1.5, 4, ["about 4 days", "900000 samples", "1.5 s", "on 4 threads;"]),
            (1.1e9 * 1.6e7, 1e-6, 1, ["about 558 years", "thousand million", "1.0 µs", "on 1 thread;"]),
        ] {
            let told = of(samples, seconds, threads).expect("long");
            assert!(words.iter().all(|word| told.contains(word)), "{told}");
        }
        assert_eq!(of(1e9, f64::NAN, 1), None);
    }
}
