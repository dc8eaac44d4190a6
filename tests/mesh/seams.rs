//! Sewing partners carry equal counts of points, whatever else is sewn to them.

use crate::sewing::{cases, curve, garment, line, panel, polygon, rectangle, seam, whole};
use darzi::garment::Garment;
use darzi::garment::panel::{Loop, Run};
use darzi::garment::seam::{Attachment, PanelRun, Pin, PinTarget, Pinned};
use darzi::mesh::compiled::Compiled;
use darzi::mesh::validate::validate;
use darzi::mesh::{Options, compile};
use proptest::prelude::*;

fn compiled(garment: &Garment) -> Compiled {
    let compiled = compile(garment, &Options::default()).unwrap_or_else(|said| panic!("{said:?}"));
    let facts = validate(&compiled).unwrap_or_else(|flaws| panic!("{flaws:?}"));
    for (facts, panel) in facts.iter().zip(&compiled.panels) {
        assert_eq!(facts.sharp, 0, "{} {facts:?}", panel.name);
    }
    compiled
}

fn edge<'c>(compiled: &'c Compiled, panel: usize, name: &str) -> &'c [u32] {
    let edges = &compiled.panels[panel].edges;
    &edges.iter().find(|edge| edge.name == name).expect("the edge is there").points
}

/// Part of a piece of the outline.
fn part(panel: usize, piece: usize, from: f64, to: f64) -> PanelRun {
    PanelRun { panel, run: Run { ring: 0, piece, from, to } }
}

#[test]
fn two_edges_of_unequal_length_pair_from_end_to_end() {
    let panels = vec![
        panel("a", vec![rectangle(0.2, 0.1)], 8e-3),
        panel("b", vec![rectangle(0.15, 0.13)], 8e-3),
    ];
    // The right edge of a, upwards, meets the left edge of b, upwards.
    let sewn =
        seam("a.e1 -> b.e3", vec![whole(&panels, 0, 1, true)], vec![whole(&panels, 1, 3, false)]);
    let mesh = compiled(&garment(panels, vec![sewn]));
    let pairs = &mesh.seams[0].pairs;
    let (a, b) = (edge(&mesh, 0, "e1"), edge(&mesh, 1, "e3"));
    assert_eq!(a.len(), b.len());
    assert_eq!(pairs.iter().map(|pair| pair[0]).collect::<Vec<_>>(), a);
    assert_eq!(pairs.iter().map(|pair| pair[1]).rev().collect::<Vec<_>>(), b);
    // a comes out in whole cells of 20 cm / 26, so its edge is 13 cells long; b's are 8 mm, so
    // its edge is 16.25 cells long. The square root of 13 · 16.25 is 14.5, nearer to 15 by ratio
    // than to 14.
    assert_eq!(a.len(), 15 + 1);
}

#[test]
fn a_corner_is_carried_through_a_chain_of_seams() {
    // b has a corner 3 cm up its left side; c and a must have a point there too.
    let corner = Loop {
        pieces: vec![
            line([0.0, 0.0], [0.1, 0.0]),
            line([0.1, 0.0], [0.1, 0.1]),
            line([0.1, 0.1], [0.0, 0.1]),
            line([0.0, 0.1], [0.0, 0.03]),
            line([0.0, 0.03], [0.0, 0.0]),
        ],
    };
    let panels = vec![
        panel("a", vec![rectangle(0.1, 0.1)], 8e-3),
        panel("b", vec![corner], 8e-3),
        panel("c", vec![rectangle(0.1, 0.1)], 8e-3),
    ];
    let seams = vec![
        seam("a -> c", vec![whole(&panels, 0, 1, true)], vec![whole(&panels, 2, 1, true)]),
        seam(
            "c -> b",
            vec![whole(&panels, 2, 1, true)],
            vec![whole(&panels, 1, 4, false), whole(&panels, 1, 3, false)],
        ),
    ];
    let mesh = compiled(&garment(panels, seams));
    let at = |k: u32| mesh.particles[k as usize];
    for panel in [0, 2] {
        assert!(edge(&mesh, panel, "e1").iter().any(|&k| (at(k)[1] - 0.03).abs() < 1e-9));
    }
    assert_eq!(mesh.seams[0].pairs.len(), mesh.seams[1].pairs.len());
}

#[test]
fn a_dart_shares_its_tip_and_welds_its_mouth() {
    // A wedge of 2 cm cut 9 cm deep out of the upper edge.
    let outline = polygon(&[
        [0.0, 0.0],
        [0.24, 0.0],
        [0.24, 0.2],
        [0.13, 0.2],
        [0.12, 0.11],
        [0.11, 0.2],
        [0.0, 0.2],
    ]);
    let panels = vec![panel("front", vec![outline], 8e-3)];
    let mut sewn =
        seam("front.dart", vec![whole(&panels, 0, 3, true)], vec![whole(&panels, 0, 4, false)]);
    sewn.kind = darzi::garment::seam::SeamKind::Dart;
    let mut cloth = garment(panels, vec![sewn]);
    let waist = darzi::garment::panel::NamedEdge {
        name: "waist".into(),
        span: Default::default(),
        allowance: 0.01,
        corner: Default::default(),
        runs: [5, 2].map(|piece| whole(&cloth.panels, 0, piece, false).run).to_vec(),
    };
    cloth.panels[0].edges.push(waist);
    let mesh = compiled(&cloth);
    let pairs = &mesh.seams[0].pairs;
    let (&mouth, &tip) = (pairs.first().expect("pairs"), pairs.last().expect("pairs"));
    assert_eq!(tip[0], tip[1]);
    assert_ne!(mouth[0], mouth[1]);
    let waist = edge(&mesh, 0, "waist");
    let left = waist.iter().position(|&k| k == mouth[1]).expect("the mouth is on the waist");
    assert_eq!(waist[left + 1], mouth[0]);
}

#[test]
fn part_of_an_edge_may_be_sewn_held_and_pinned() {
    let panels = vec![
        panel("a", vec![rectangle(0.2, 0.1)], 8e-3),
        panel("b", vec![rectangle(0.05, 0.1)], 8e-3),
    ];
    let seams = vec![seam("s", vec![part(0, 0, 0.03, 0.08)], vec![whole(&panels, 1, 0, true)])];
    let mut cloth = garment(panels, seams);
    cloth.attachments.push(Attachment {
        span: Default::default(),
        runs: vec![part(0, 2, 0.021, 0.093)],
        body: 0,
        landmark: "waist".into(),
    });
    cloth.pins.push(Pin {
        span: Default::default(),
        what: Pinned::Point { panel: 0, at: [0.2, 0.1] },
        to: PinTarget::Here,
    });
    cloth.pins.push(Pin {
        span: Default::default(),
        what: Pinned::Runs(vec![part(0, 3, 0.1, 0.0)]),
        to: PinTarget::Here,
    });
    let mesh = compiled(&cloth);
    let u = |k: u32| mesh.particles[k as usize][0];
    let pairs = &mesh.seams[0].pairs;
    assert!((u(pairs[0][0]) - 0.03).abs() < 1e-9);
    assert!((u(pairs[pairs.len() - 1][0]) - 0.08).abs() < 1e-9);
    let held = &mesh.attachments[0].points;
    assert!((u(held[0]) - 0.179).abs() < 1e-9);
    assert!((u(held[held.len() - 1]) - 0.107).abs() < 1e-9);
    assert_eq!(mesh.particles[mesh.pins[0].points[0] as usize], [0.2, 0.1]);
    assert!(mesh.pins[1].points.iter().all(|&k| u(k).abs() < 1e-12));
}

#[test]
fn an_edge_sewn_to_itself_in_ever_shorter_steps_is_refused() {
    // The lower edge is sewn to its own first half: every point asks for one half as far along.
    let panels = vec![panel("a", vec![rectangle(0.2, 0.1)], 8e-3)];
    let seams = vec![seam("s", vec![whole(&panels, 0, 0, true)], vec![part(0, 0, 0.0, 0.1)])];
    let said = compile(&garment(panels, seams), &Options::default()).expect_err("no end");
    assert_eq!(said[0].code, "E0814");
}

fn gore(width: f64, height: f64, belly: f64, lean: f64) -> Loop {
    let (w, h) = (width, height);
    Loop {
        pieces: vec![
            line([0.0, 0.0], [w, 0.0]),
            curve([w, 0.0], [w + belly, h * 0.3], [w + belly, h * 0.7], [w + lean, h]),
            line([w + lean, h], [-lean, h]),
            curve([-lean, h], [-belly, h * 0.7], [-belly, h * 0.3], [0.0, 0.0]),
        ],
    }
}

proptest! {
    #![proptest_config(cases(48))]

    /// Gores in a ring, sewn side to side and all to one band: counts agree everywhere.
    #[test]
    fn gores_in_a_ring(
        gores in prop::collection::vec(
            (0.06..0.2f64, 0.1..0.4f64, -0.01..0.04f64, -0.02..0.05f64, -1.6..1.6f64), 2..5),
    ) {
        let mut panels = Vec::new();
        for (number, &(width, height, belly, lean, grain)) in gores.iter().enumerate() {
            let mut gore = panel(&format!("g{number}"), vec![gore(width, height, belly, lean)], 8e-3);
            gore.grain = grain;
            panels.push(gore);
        }
        let around: f64 = gores.iter().map(|gore| gore.0 + 2.0 * gore.3).sum();
        let count = gores.len();
        panels.push(panel("band", vec![rectangle(around * 1.02, 0.04)], 8e-3));
        let mut seams = Vec::new();
        for k in 0..count {
            let next = (k + 1) % count;
            let (a, b) = (whole(&panels, k, 1, true), whole(&panels, next, 3, false));
            seams.push(seam("side", vec![a], vec![b]));
        }
        let tops = (0..count).map(|k| whole(&panels, k, 2, false)).collect();
        seams.push(seam("waist", vec![whole(&panels, count, 0, true)], tops));
        let mesh = compile(&garment(panels, seams), &Options::default())
            .map_err(|said| TestCaseError::fail(format!("{said:?}")))?;
        let facts = validate(&mesh).map_err(|flaws| TestCaseError::fail(format!("{flaws:?}")))?;
        for (facts, panel) in facts.iter().zip(&mesh.panels) {
            prop_assert_eq!(facts.sharp, 0, "{} {:?}", panel.name, facts);
        }
        for (k, seam) in mesh.seams[..count].iter().enumerate() {
            let side = |panel: usize, name: &str| edge(&mesh, panel, name).to_vec();
            let (a, mut b) = (side(k, "e1"), side((k + 1) % count, "e3"));
            b.reverse();
            prop_assert_eq!(&seam.pairs, &a.into_iter().zip(b).map(|(a, b)| [a, b]).collect::<Vec<_>>());
        }
        // On the band the tops follow each other; where two meet, one point of the band has two.
        let tops: usize = (0..count).map(|k| edge(&mesh, k, "e2").len()).sum();
        prop_assert_eq!(mesh.seams[count].pairs.len(), tops);
        prop_assert_eq!(edge(&mesh, count, "e0").len(), tops - (count - 1));
    }
}
