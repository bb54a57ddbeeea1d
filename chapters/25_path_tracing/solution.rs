//! A solution of the exercise of chapter 25; look here when you have done yours.

pub fn after_roulette(throughput: [f64; 3], u: f64) -> [f64; 3] {
    let survival = throughput[0].max(throughput[1]).max(throughput[2]).min(1.0);
    if u < survival { throughput.map(|part| part / survival) } else { [0.0; 3] }
}
