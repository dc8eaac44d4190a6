//! How long it takes to lay out a text anew, reading included, and how the time grows with it.
//! `cargo bench --bench format`

#![allow(clippy::disallowed_methods, clippy::print_stdout)]

use darzi::diagnostic::FileId;
use darzi::syntax::format::format;
use divan::counter::ItemsCount;

fn main() {
    divan::main();
}

/// A garment of 25 lines as nobody should leave it.
const PIECE: &str = "\
garment skirt_NUMBER {
  /// wearing ease at the waist
  param ease = 2cm in 0cm..6cm
  param length=60cm in 40cm .. 90cm   // from the waist
  wearer lady=female{size: EU 38}
  let hip_y = -lady.waist_to_hip

  panel front of denim {
    outline from (0,0) {
      waist: curve to ((lady.waist+ease)/4+2cm, rise) leaving square arriving square
      side: curve to ((lady.hip + 3cm) / 4, hip_y) arriving -90deg + spread // the hip
      flare: line by (length+hip_y-2cm)@(-90deg+spread)   // straight
      fold: line to start
    }
    shaping: dart on waist at 50% width 2cm depth 9cm
    // the other half
    unfold across fold
  }
  panel back = front with { let intake = 35mm; unfold across fold }
  seam front.right.(side+flare) -> back.right.(side+flare)
  seam front.left.side -> back.left.side zip 18cm from waist
  yarn merino { count: 4Nm  plies: 4  fibre: wool }
  knit checks { chart: |RL|LR|  gauge: 22 x 30 per 10cm }
  picture { views: front, side   size: 1200 x 1600 }
}
";

/// A text of so many lines.
fn text(lines: usize) -> String {
    let pieces = lines / PIECE.lines().count();
    (0..pieces).map(|number| PIECE.replace("NUMBER", &number.to_string())).collect()
}

#[divan::bench(args = [1_000, 2_500, 5_000, 10_000, 20_000], sample_count = 20, sample_size = 1)]
fn lines(bencher: divan::Bencher, lines: usize) {
    let text = text(lines);
    bencher.counter(ItemsCount::new(lines)).bench(|| format(FileId(0), &text));
}
