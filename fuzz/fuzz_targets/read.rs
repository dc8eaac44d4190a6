//! Texts are read, told of and formatted.

#![no_main]

#[path = "../../tests/fuzz/held.rs"]
#[allow(dead_code)]
mod held;
mod mutate;

use libfuzzer_sys::{fuzz_crossover, fuzz_mutator, fuzz_target};

fuzz_target!(|bytes: &[u8]| held::read(&String::from_utf8_lossy(bytes)));
fuzz_mutator!(|bytes: &mut [u8], size: usize, most: usize, seed: u32| {
    mutate::mutate(bytes, size, most, seed)
});
fuzz_crossover!(|one: &[u8], other: &[u8], out: &mut [u8], seed: u32| {
    mutate::cross(one, other, out, seed)
});
