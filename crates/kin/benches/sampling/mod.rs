//! How the benchmarks sample: many different inputs, and medians that other work on the machine leaves alone.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, SamplingMode};

/// The bytes that the inputs of one benchmark may take: many different ones, so that no branch predictor learns
/// them by heart, but not so many that the time is that of a cold memory.
const INPUT_BYTES: usize = 128 << 10;

/// Samples of a millisecond or two: shorter than what a scheduler gives another process, so that the median is of
/// samples that ran undisturbed.
pub fn many_short() -> Criterion {
    Criterion::default()
        .sample_size(1000)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_millis(1500))
        .nresamples(2000)
}

/// Many inputs, and a benchmark that goes through them one by one.
pub fn each<T, R>(c: &mut Criterion, name: &str, mut make: impl FnMut() -> T, run: impl Fn(&T) -> R) {
    let many = (INPUT_BYTES / size_of::<T>()).min(512);
    let inputs: Vec<T> = (0..many).map(|_| make()).collect();
    let mut at = 0;
    let mut group = c.benchmark_group(env!("CARGO_PKG_NAME"));
    group.sampling_mode(SamplingMode::Flat);
    group.bench_function(name, |b| {
        b.iter(|| {
            at = (at + 1) % many;
            black_box(run(black_box(&inputs[at])))
        });
    });
    group.finish();
}
