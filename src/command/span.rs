use std::time::Duration;

/// A span of time as it is typed: a number with its unit, such as `500ms`, `10s`, `2m` or `1h`.
pub fn span(text: &str) -> Result<Duration, String> {
    let refused =
        || "a time is a number with ms, s, m or h after it, above 0 and at most 1000h, such as 10s".to_string();
    let text = text.trim();
    let unit = text.find(|letter: char| letter.is_ascii_alphabetic()).ok_or_else(refused)?;
    let seconds = match &text[unit..] {
        "ms" => 1e-3,
        "s" => 1.0,
        "m" => 60.0,
        "h" => 3600.0,
        _ => return Err(refused()),
    };
    let number: f64 = text[..unit].trim().parse().map_err(|_| refused())?;
    let seconds = number * seconds;
    if seconds > 0.0 && seconds <= 3_600_000.0 { Ok(Duration::from_secs_f64(seconds)) } else { Err(refused()) }
}

/// A span of time as a person reads it.
pub fn told(span: Duration) -> String {
    match span.as_secs_f64() {
        seconds if seconds < 1.0 => format!("{:.0} ms", seconds * 1e3),
        seconds if seconds < 120.0 => format!("{seconds:.1} s"),
        seconds if seconds < 7200.0 => format!("{:.1} min", seconds / 60.0),
        seconds => format!("{:.1} h", seconds / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_has_a_number_and_a_unit() {
        let read = |text: &str| span(text).map(|span| span.as_millis());
        assert_eq!(["500ms", "10s", "2m", "1.5h", "0.25s"].map(read), [500, 10_000, 120_000, 5_400_000, 250].map(Ok));
        for bad in ["", "10", "s", "-1s", "0s", "1d", "1e9h", "NaNs", "infs", "ten s"] {
            assert!(span(bad).is_err(), "{bad}");
        }
    }
}
