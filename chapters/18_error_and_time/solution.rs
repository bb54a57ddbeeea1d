//! A solution of the exercise of chapter 18; look here when you have done yours.

pub fn variance_and_bias_squared(runs: &[f64], truth: f64) -> Option<[f64; 2]> {
    if runs.len() < 2 {
        return None;
    }
    let n = runs.len() as f64;
    let off: Vec<f64> = runs.iter().map(|run| run - truth).collect();
    let sum: f64 = off.iter().sum();
    let mean = sum / n;
    let variance = off.iter().map(|off| (off - mean) * (off - mean)).sum::<f64>() / (n - 1.0);
    // All products of two runs, less those of a run with itself, are the pairs of different ones, each twice.
    let squares: f64 = off.iter().map(|off| off * off).sum();
    Some([variance, (sum * sum - squares) / (n * (n - 1.0))])
}
