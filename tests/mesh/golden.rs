//! Small garments keep their meshes to the last byte.

use crate::sewing::{circle, curve, garment, line, panel, polygon, rectangle, seam, whole};
use darzi::garment::Garment;
use darzi::garment::panel::Loop;
use darzi::geometry::polygon::distance;
use darzi::mesh::compiled::Compiled;
use darzi::mesh::validate::validate;
use darzi::mesh::{Options, compile, json};
use std::fmt::Write;

fn compiled(garment: &Garment) -> Compiled {
    compile(garment, &Options::default()).unwrap_or_else(|said| panic!("{said:?}"))
}

fn text(mesh: &Compiled) -> Vec<u8> {
    let mut text = Vec::new();
    json::write(mesh, &mut text).expect("a list of bytes takes all");
    text
}

/// Counts, box, area, smallest angle and edge lengths of each panel; seams; the hash of the
/// whole file.
fn summary(mesh: &Compiled) -> String {
    let mut said = String::new();
    let facts = validate(mesh).unwrap_or_else(|flaws| panic!("{flaws:?}"));
    for (panel, facts) in mesh.panels.iter().zip(&facts) {
        let places = &mesh.particles[panel.particles.range()];
        let side = |axis: usize| {
            let low = places.iter().map(|place| place[axis]).fold(f64::INFINITY, f64::min);
            let high = places.iter().map(|place| place[axis]).fold(f64::NEG_INFINITY, f64::max);
            (high - low) * 1e3
        };
        let _ = writeln!(
            said,
            "{}: {} particles, {} cells of {:.3} mm, {} triangles; {:.1} x {:.1} mm, {:.2} cm2, \
             least angle {:.1} deg",
            panel.name,
            places.len(),
            panel.cells.range().len(),
            panel.cell * 1e3,
            panel.triangles.range().len(),
            side(0),
            side(1),
            facts.area * 1e4,
            facts.smallest_angle,
        );
        for edge in &panel.edges {
            let along = edge.points.windows(2).map(|ends| {
                distance(mesh.particles[ends[0] as usize], mesh.particles[ends[1] as usize])
            });
            let length = along.sum::<f64>() * 1e3;
            let _ = writeln!(said, "  {}: {} points, {length:.2} mm", edge.name, edge.points.len());
        }
    }
    for seam in &mesh.seams {
        let _ = writeln!(said, "seam {}: {} pairs", seam.name, seam.pairs.len());
    }
    let _ = writeln!(said, "blake3 {}", blake3::hash(&text(mesh)).to_hex());
    said
}

/// Two gores with bent sides and a dart each, side to side.
fn skirt() -> Garment {
    let gore = |depth: f64| Loop {
        pieces: vec![
            line([-0.22, 0.0], [0.22, 0.0]),
            curve([0.22, 0.0], [0.2, 0.2], [0.17, 0.3], [0.16, 0.4]),
            line([0.16, 0.4], [0.01, 0.41]),
            line([0.01, 0.41], [0.0, 0.41 - depth]),
            line([0.0, 0.41 - depth], [-0.01, 0.41]),
            line([-0.01, 0.41], [-0.16, 0.4]),
            curve([-0.16, 0.4], [-0.17, 0.3], [-0.2, 0.2], [-0.22, 0.0]),
        ],
    };
    let panels =
        vec![panel("front", vec![gore(0.09)], 0.012), panel("back", vec![gore(0.12)], 0.012)];
    let side = |a: usize, b: usize| {
        seam("side", vec![whole(&panels, a, 1, true)], vec![whole(&panels, b, 6, false)])
    };
    let dart = |k: usize| {
        seam("dart", vec![whole(&panels, k, 3, true)], vec![whole(&panels, k, 4, false)])
    };
    let seams = vec![side(0, 1), side(1, 0), dart(0), dart(1)];
    garment(panels, seams)
}

#[test]
fn a_skirt() {
    insta::assert_snapshot!(summary(&compiled(&skirt())));
}

#[test]
fn a_ring_on_the_bias() {
    let loops = vec![circle([0.0, 0.0], 0.16, true), circle([0.0, 0.0], 0.05, false)];
    let mut ring = panel("ring", loops, 0.01);
    ring.grain = std::f64::consts::FRAC_PI_4;
    insta::assert_snapshot!(summary(&compiled(&garment(vec![ring], Vec::new()))));
}

#[test]
fn a_handkerchief() {
    let cloth = panel("handkerchief", vec![rectangle(0.3, 0.3)], 0.01);
    insta::assert_snapshot!(summary(&compiled(&garment(vec![cloth], Vec::new()))));
}

#[test]
fn the_bytes_do_not_depend_on_the_threads() {
    let garment = skirt();
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads").install(|| text(&compiled(&garment)))
    };
    assert!(with(1) == with(5));
}

#[test]
fn the_file_says_what_the_mesh_holds() {
    let mesh = compiled(&skirt());
    let file: serde_json::Value = serde_json::from_slice(&text(&mesh)).expect("JSON");
    assert_eq!(file["darzi-mesh"], 1);
    let list = |name: &str| file[name].as_array().expect("a list").clone();
    let particles: Vec<f64> = list("particles").iter().filter_map(|x| x.as_f64()).collect();
    // The reader may miss the last bit of a number; the writer does not.
    let written = mesh.particles.concat();
    assert_eq!(particles.len(), written.len());
    assert!(particles.iter().zip(&written).all(|(a, b)| (a - b).abs() < 1e-15));
    let corners: Vec<u64> = list("triangles").iter().filter_map(|x| x.as_u64()).collect();
    assert_eq!(corners.len(), 3 * mesh.triangles.len());
    assert_eq!(list("lattice").len(), 2 * mesh.particles.len());
    let pairs = file["seams"][2]["pairs"].as_array().expect("a list");
    assert_eq!(pairs.len(), 2 * mesh.seams[2].pairs.len());
    assert_eq!(pairs[pairs.len() - 1], pairs[pairs.len() - 2], "the tip of the dart");
    assert_eq!(file["panels"][1]["edges"][0]["name"], "e0");
}

#[test]
fn halves_mirror_each_other() {
    let corners = [[0.0, 0.0], [0.13, 0.02], [0.11, 0.2], [0.03, 0.17]];
    let mut mirrored = corners.map(|[x, y]| [-x, y]);
    mirrored.reverse();
    let panels = vec![
        panel("left", vec![polygon(&corners)], 0.01),
        panel("right", vec![polygon(&mirrored)], 0.01),
    ];
    let mesh = compiled(&garment(panels, Vec::new()));
    let grid = |number: usize, sense: f64| {
        let range = mesh.panels[number].particles.range();
        let on_grid = range.filter(|&k| mesh.lattice[k][0] != i32::MIN);
        let mut places: Vec<[i64; 2]> = on_grid
            .map(|k| [sense * mesh.particles[k][0], mesh.particles[k][1]])
            .map(|place| place.map(|x| (x * 1e9).round() as i64))
            .collect();
        places.sort_unstable();
        places
    };
    assert_eq!(grid(0, 1.0), grid(1, -1.0));
}
