//! Garments on a body, from panels to rest.

#![allow(clippy::disallowed_methods, clippy::print_stdout)]

mod hem;
mod patch;
mod pattern;

use darzi::drape::draped::{Draped, Verdict};
use darzi::drape::{Options, drape};
use darzi::garment::Garment;
use darzi::mesh::compiled::Compiled;
use darzi::mesh::{self, compile};
use darzi::progress::{Progress, Quiet};

struct Loud;
impl Progress for Loud {
    fn stage(&mut self, name: &str) {
        println!("-- {name}");
    }
    fn share(&mut self, done: f64, note: &str) {
        use std::sync::atomic::{AtomicUsize, Ordering};
        static N: AtomicUsize = AtomicUsize::new(0);
        if N.fetch_add(1, Ordering::Relaxed).is_multiple_of(10) {
            println!("{done:.3} {note}");
        }
    }
}

fn dress(garment: &Garment, cells: &[f64]) -> (Compiled, Draped) {
    let rungs: Vec<Compiled> = cells
        .iter()
        .map(|&cell| {
            compile(garment, &mesh::Options { cell: Some(cell), ..Default::default() })
                .expect("compiles")
        })
        .collect();
    let draped = drape(&rungs, &Options::default(), &mut Loud).expect("drapes");
    println!("{:#?}", draped.stats);
    let stats = &draped.stats;
    assert_eq!(stats.verdict, Verdict::Settled, "{:?}", stats.reason);
    assert_eq!(stats.self_intersections, 0);
    assert!(stats.largest_seam_gap < 1e-6, "{}", stats.largest_seam_gap);
    assert!(stats.deepest_penetration < 1e-4, "{}", stats.deepest_penetration);
    let strain = stats.largest_warp_strain.max(stats.largest_weft_strain);
    assert!(strain < 0.03, "{strain}");
    (rungs.last().expect("one").clone(), draped)
}

fn picture(name: &str, compiled: &Compiled, draped: &Draped) {
    let options = darzi::render::Options { paths: 6, ..Default::default() };
    let image = darzi::render::render(compiled, draped, &pattern::picture(), &options, &mut Quiet);
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.png"));
    image.save(path).expect("saved");
}

#[test]
fn a_skirt_hangs_on_the_waist() {
    let (compiled, draped) = dress(&pattern::skirt(0.10), &[0.04, 0.02]);
    picture("skirt", &compiled, &draped);
}

#[test]
fn a_tunic_hangs_on_the_shoulders() {
    let (compiled, draped) = dress(&pattern::tunic(), &[0.03, 0.015]);
    picture("tunic", &compiled, &draped);
}
