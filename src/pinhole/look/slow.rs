use super::pilot::Pilot;
use crate::extract::delta_light_rays;
use crate::plan::Census;

/// A warning about time is given from this many seconds on.
const LONG: f64 = 600.0;
/// A warning that surfaces absorb too little is given from this many rays per camera ray on; a room with white walls
/// and a glass ball stays below a quarter of it.
const MANY_BOUNCES: f64 = 64.0;

/// How much there is to render, and with how many threads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// The number of samples of all pixels together; none where a time limit is given instead.
    pub samples: Option<f64>,
    /// The number of light paths for each of them.
    pub light_paths: f64,
    /// Workers.
    pub threads: usize,
}

/// A warning that a picture will take very long, estimated from the cost of one camera ray and all that follows from
/// it in processor seconds: what else the machine does makes it longer still.
pub fn slow(seconds_a_ray: f64, is_least: bool, effort: Effort) -> Option<String> {
    let samples = effort.samples?;
    let seconds = samples * seconds_a_ray / effort.threads.max(1) as f64;
    (seconds >= LONG).then(|| {
        format!(
            "the picture will take {} {}, if nothing else runs: {} samples at {} each, on {}; --time 5m stops after five \
             minutes with the picture as it is by then, and --resume continues from there",
            if is_least { "more than" } else { "about" },
            long_span(seconds),
            many(samples),
            short_span(seconds_a_ray),
            if effort.threads == 1 { "1 thread".into() } else { format!("{} threads", effort.threads) }
        )
    })
}

/// A warning that paths are very long because surfaces absorb little, which makes a picture slow without making it
/// better.
pub fn many_bounces(pilot: &Pilot, max_depth: u32) -> Option<String> {
    (pilot.followed_by >= MANY_BOUNCES).then(|| {
        format!(
            "each camera ray is followed by {:.0} more on average, because the surfaces that it hits absorb \
             next to no light; darker surfaces, or a max_depth below {max_depth}, render faster",
            pilot.followed_by
        )
    })
}

/// The same for paths from the lights: glass and mirrors around a light can keep its light for very long.
pub fn many_light_bounces(pilot: &Pilot, max_depth: u32) -> Option<String> {
    (pilot.light_followed_by >= MANY_BOUNCES).then(|| {
        format!(
            "a path from a light has {:.0} segments or more on average, because what surrounds the light keeps it (a \
             light inside glass, or on its surface, does not leave beyond the critical angle); another place for the \
             light, or a max_depth below {max_depth}, renders faster",
            1.0 + pilot.light_followed_by
        )
    })
}

/// A warning that none of the small tiles that were traced was finished.
pub fn never_done(pilot: &Pilot, why: &str, effort: Effort) -> String {
    let min = pilot.seconds_a_ray.map_or_else(String::new, |seconds| {
        let picture = effort.samples.map(|samples| samples * seconds / effort.threads.max(1) as f64);
        let picture = picture.filter(|&picture| picture >= LONG).map(long_span);
        let picture = picture.map_or_else(String::new, |span| format!(", so the picture will take more than {span}"));
        format!(": a ray takes more than {}{picture}", short_span(seconds))
    });
    format!("none of {} test rays was finished when the time for them was up{min}; {why}", pilot.tried)
}

/// The reason why a ray takes long in this scene.
pub fn why_slow(scene: &Census<'_>, pilot: &Pilot, max_depth: u32, shapes: usize) -> String {
    if f64::from(pilot.deepest) >= MANY_BOUNCES {
        return format!(
            "after {} bounces its path had not ended, and the integrator allows a max_depth of {max_depth}; a smaller one, or \
             surfaces that absorb more, would end it",
            pilot.deepest
        );
    }
    let lights = delta_light_rays(scene);
    let tests = if lights > 1 { format!(", for each of {lights} lights") } else { String::new() };
    format!("each ray is tested against {shapes} shapes{tests}")
}

/// A time in minutes, hours, days or years, whichever gives a number that is easy to grasp.
fn long_span(seconds: f64) -> String {
    let units = [("minutes", 60.0, 120.0), ("hours", 3600.0, 48.0), ("days", 86_400.0, 730.0)];
    for (unit, length, max) in units {
        if seconds < length * max {
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
        _ => format!("{:.1} billion", count / 1e9),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_renders_are_announced() {
        let of = |samples, seconds, threads| {
            slow(seconds, false, Effort { samples: Some(samples), light_paths: 0.0, threads })
        };
        assert_eq!(of(1e8, 1e-5, 2), None, "500 s");
        assert_eq!(slow(1e9, false, Effort { samples: None, light_paths: 0.0, threads: 1 }), None, "the time is given");
        let warning = of(1.2e8, 1e-5, 2).expect("600 s");
        assert!(warning.starts_with(
            "the picture will take about 10 minutes, if nothing else runs: 120 million samples at 10.0 µs each"
        ));
        assert!(warning.contains(", on 2 threads; --time 5m"), "{warning}");
        for (samples, seconds, threads, words) in [
            (1e6, 7.1e-3, 1, ["about 118 minutes", "1 million samples", "7.1 ms", "on 1 thread;"]),
            (1e6, 7.2e-3, 1, ["about 2 hours", "1 million samples", "7.2 ms", "on 1 thread;"]),
            (6e10, 2e-6, 4, ["about 8 hours", "60.0 billion samples", "2.0 µs", "on 4 threads;"]),
            (9e5, 1.5, 4, ["about 4 days", "900000 samples", "1.5 s", "on 4 threads;"]),
            (1.1e9 * 1.6e7, 1e-6, 1, ["about 558 years", "billion", "1.0 µs", "on 1 thread;"]),
        ] {
            let warning = of(samples, seconds, threads).expect("long");
            assert!(words.iter().all(|word| warning.contains(word)), "{warning}");
        }
        assert_eq!(of(1e9, f64::NAN, 1), None);
    }
}
