//! OBJ and GLB of a draped figure: the structure that readers rely on.

#![allow(clippy::disallowed_methods, clippy::print_stdout)]

use darzi::body::surface::{Surface as Body, SurfaceKind};
use darzi::drape::draped::{Draped, Stats};
use darzi::export::{glb, obj};
use darzi::garment::scene::Placement;
use darzi::mesh::compiled::{Atlas, Compiled, MeshPanel, MeshSeam, Region, Stretch, Surface};
use nalgebra::{Point3, Vector3};
use serde_json::Value;
use std::collections::BTreeMap;

/// Two panels of 2 × 1 cells of 10 cm, `front` in the plane z = 0 and `back` behind it, sewn
/// along x = 0.2 at a right angle; each with a triangle beside its cells. A tile of 4 × 2 pixels
/// shows on both, on `back` only to the left of u = 0.1.
fn figure() -> (Compiled, Draped) {
    let mut compiled = Compiled { name: "box".into(), ..Compiled::default() };
    let mut positions = Vec::new();
    for (number, name) in ["front", "back"].into_iter().enumerate() {
        let first = compiled.particles.len() as u32;
        for row in 0..2 {
            for column in 0..3 {
                let (u, v) = (0.1 * f64::from(column), 0.1 * f64::from(row));
                compiled.particles.push([u, v]);
                positions.push(match number {
                    0 => Point3::new(u, v, 0.0),
                    _ => Point3::new(0.2, v, u - 0.2),
                });
            }
        }
        compiled.particles.push([0.0, 0.2]);
        positions.push(positions[first as usize + 3] + Vector3::new(0.0, 0.1, 0.0));
        let stretch = |start: usize, end: usize| Stretch { start: start as u32, end: end as u32 };
        let (cells, triangles) = (compiled.cells.len(), compiled.triangles.len());
        let cell = |n: u32| [n, n + 1, n + 4, n + 3].map(|n| first + n);
        compiled.cells.extend([cell(0), cell(1)]);
        compiled.triangles.push([3, 4, 6].map(|n| first + n));
        let whole = Surface { area: None, face: 0, back: 1 };
        let left = Surface { area: Some([0.0, 0.0, 0.1, 1.0]), face: 0, back: 1 };
        let right = Surface { area: Some([0.1, 0.0, 0.3, 1.0]), face: 2, back: 2 };
        compiled.panels.push(MeshPanel {
            name: name.into(),
            fabric: 0,
            cell: 0.1,
            layer: 0,
            grain: 0.0,
            placement: Placement::Led,
            particles: stretch(first as usize, first as usize + 7),
            cells: stretch(cells, cells + 2),
            triangles: stretch(triangles, triangles + 1),
            loops: vec![],
            edges: vec![],
            surfaces: if number == 0 { vec![whole] } else { vec![left, right] },
        });
    }
    let pairs = vec![[2, 9], [5, 12]];
    compiled.seams.push(MeshSeam { name: "side".into(), pairs });
    let region = |name: &str, pixels, size, tiles| Region {
        name: name.into(),
        pixels,
        size,
        tiles,
        detail: None,
        shot: None,
    };
    let pixels = (0..16u8 * 8).flat_map(|n| [n, 2 * (n % 100), 77, 255]).collect();
    let regions = vec![
        region("tile.face", [1, 1, 4, 2], [0.05, 0.025], true),
        region("tile.back", [1, 4, 4, 2], [0.05, 0.025], true),
        region("sari.padar.face", [8, 1, 4, 6], [0.2, 1.0], false),
    ];
    compiled.atlas = Atlas { width: 16, height: 8, pixels, regions };
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let body = Body {
        name: "lady".into(),
        vertices: corners.map(Point3::from).to_vec(),
        normals: corners
            .map(|c| (Vector3::from(c) - Vector3::new(0.25, 0.25, 0.25)).normalize())
            .to_vec(),
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        kind: SurfaceKind::Body,
        ..Body::default()
    };
    let surfaces = vec![body];
    (compiled, Draped { positions, surfaces, stats: Stats::default() })
}

/// What an OBJ file says, line by line.
fn lines(bytes: &[u8]) -> Vec<Vec<String>> {
    let text = String::from_utf8(bytes.to_vec()).unwrap();
    text.lines().map(|line| line.split(' ').map(str::to_owned).collect()).collect()
}

#[test]
fn obj_has_the_particles_in_order_and_an_object_a_panel() {
    let (compiled, draped) = figure();
    let files = obj::write(&compiled, &draped, true, "box");
    let lines = lines(&files.obj);
    let of = |what: &str| lines.iter().filter(|line| line[0] == what).collect::<Vec<_>>();
    let names: Vec<&str> = of("o").iter().map(|line| line[1].as_str()).collect();
    assert_eq!(names, ["front", "back", "body.lady"]);
    assert_eq!(of("v").len(), 14 + 4);
    for (line, place) in of("v").iter().zip(&draped.positions) {
        for (word, value) in line[1..].iter().zip(place.coords.iter()) {
            assert!((word.parse::<f64>().unwrap() - value).abs() < 1e-6);
        }
    }
    // Two quads and a triangle a panel, four triangles of the body; all corners exist.
    let faces = of("f");
    assert_eq!(
        faces.iter().map(|f| f.len() - 1).collect::<Vec<_>>(),
        [4, 4, 3, 4, 3, 4, 3, 3, 3, 3]
    );
    let (places, marks, normals) = (of("v").len(), of("vt").len(), of("vn").len());
    for corner in faces.iter().flat_map(|face| &face[1..]) {
        let numbers: Vec<usize> = corner.split('/').map(|n| n.parse().unwrap_or(1)).collect();
        let [v, t, n] = numbers[..] else { panic!("{corner}") };
        assert!(
            (1..=places).contains(&v) && (1..=marks).contains(&t) && (1..=normals).contains(&n)
        );
    }
    // vt of particle (0.2, 0.1) on a tile of 0.05 × 0.025 m: four across, four up.
    assert_eq!(of("vt")[5][1..], ["4.000000", "4.000000"]);
    let text = String::from_utf8(files.obj).unwrap();
    assert!(
        text.contains("unit: metre") && text.contains("up: +y") && text.contains("mtllib box.mtl")
    );
}

#[test]
fn obj_without_body_has_none_and_its_materials_name_pictures_that_are_there() {
    let (compiled, draped) = figure();
    let files = obj::write(&compiled, &draped, false, "box");
    assert!(!String::from_utf8_lossy(&files.obj).contains("body."));
    let mtl = lines(&files.mtl);
    let value = |what: &str| {
        let of = mtl.iter().filter(|line| line[0] == what).map(|line| line[1].clone());
        of.collect::<Vec<_>>()
    };
    assert_eq!(value("newmtl"), ["tile.face", "sari.padar.face"]);
    let written: Vec<&String> = files.pictures.iter().map(|(name, _)| name).collect();
    assert_eq!(value("map_Kd").iter().collect::<Vec<_>>(), written);
    let picture = image::load_from_memory(&files.pictures[0].1).unwrap().to_rgba8();
    assert_eq!(picture.dimensions(), (4, 2));
    // Left and top of the region are 1, 1; the atlas is 16 wide.
    assert_eq!(picture.get_pixel(0, 0).0, [17, 34, 77, 255]);
}

/// A GLB file taken apart: its description and its buffer.
fn opened(glb: &[u8]) -> (Value, Vec<u8>) {
    let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!(&glb[..4], b"glTF");
    assert_eq!((word(4), word(8)), (2, glb.len()));
    let text = word(12);
    assert_eq!(&glb[16..20], b"JSON");
    assert_eq!(text % 4, 0);
    let file: Value = serde_json::from_slice(&glb[20..20 + text]).unwrap();
    let buffer = word(20 + text);
    assert_eq!(&glb[24 + text..28 + text], b"BIN\0");
    assert_eq!(buffer % 4, 0);
    assert_eq!(28 + text + buffer, glb.len());
    (file, glb[28 + text..].to_vec())
}

/// The numbers of an accessor of single precision.
fn numbers(file: &Value, buffer: &[u8], accessor: &Value) -> Vec<Vec<f32>> {
    let accessor = &file["accessors"][accessor.as_u64().unwrap() as usize];
    let view = &file["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
    let width = match accessor["type"].as_str().unwrap() {
        "VEC2" => 2,
        "VEC3" => 3,
        other => panic!("{other}"),
    };
    let start = view["byteOffset"].as_u64().unwrap() as usize;
    let bytes = &buffer[start..start + view["byteLength"].as_u64().unwrap() as usize];
    let all: Vec<f32> =
        bytes.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
    let vectors: Vec<Vec<f32>> = all.chunks_exact(width).map(<[f32]>::to_vec).collect();
    assert_eq!(vectors.len() as u64, accessor["count"].as_u64().unwrap());
    vectors
}

#[test]
fn glb_keeps_the_rules_of_its_format() {
    let (compiled, draped) = figure();
    let (file, buffer) = opened(&glb::write(&compiled, &draped, true));
    assert_eq!(file["asset"]["version"], "2.0");
    assert_eq!(file["buffers"][0]["byteLength"], buffer.len());
    let names: Vec<&str> =
        file["nodes"].as_array().unwrap().iter().map(|n| n["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["front", "back", "body.lady"]);
    for view in file["bufferViews"].as_array().unwrap() {
        let (start, length) = (&view["byteOffset"], &view["byteLength"]);
        assert_eq!(start.as_u64().unwrap() % 4, 0);
        assert!(start.as_u64().unwrap() + length.as_u64().unwrap() <= buffer.len() as u64);
    }
    for mesh in file["meshes"].as_array().unwrap() {
        for primitive in mesh["primitives"].as_array().unwrap() {
            let attributes = &primitive["attributes"];
            let places = numbers(&file, &buffer, &attributes["POSITION"]);
            let normals = numbers(&file, &buffer, &attributes["NORMAL"]);
            assert_eq!(places.len(), normals.len());
            for normal in &normals {
                let length: f32 = normal.iter().map(|v| v * v).sum();
                assert!((length - 1.0).abs() < 1e-5);
            }
            let stated = &file["accessors"][attributes["POSITION"].as_u64().unwrap() as usize];
            for axis in 0..3 {
                let over = places.iter().map(|p| p[axis]);
                let least = over.clone().fold(f32::INFINITY, f32::min);
                let greatest = over.fold(f32::NEG_INFINITY, f32::max);
                assert_eq!(stated["min"][axis].as_f64().unwrap(), f64::from(least));
                assert_eq!(stated["max"][axis].as_f64().unwrap(), f64::from(greatest));
            }
            let indices = &file["accessors"][primitive["indices"].as_u64().unwrap() as usize];
            let view = &file["bufferViews"][indices["bufferView"].as_u64().unwrap() as usize];
            let start = view["byteOffset"].as_u64().unwrap() as usize;
            for n in 0..indices["count"].as_u64().unwrap() as usize {
                let bytes = buffer[start + 4 * n..start + 4 * n + 4].try_into().unwrap();
                assert!((u32::from_le_bytes(bytes) as usize) < places.len());
            }
            let material = &file["materials"][primitive["material"].as_u64().unwrap() as usize];
            assert_eq!(material["pbrMetallicRoughness"]["metallicFactor"], 0.0);
        }
    }
}

#[test]
fn glb_repeats_tiles_at_true_scale_and_lays_parts_once() {
    let (compiled, draped) = figure();
    let (file, buffer) = opened(&glb::write(&compiled, &draped, false));
    assert_eq!(file["nodes"].as_array().unwrap().len(), 2, "no body unless asked for");
    let mut wraps = BTreeMap::new();
    for material in file["materials"].as_array().unwrap() {
        assert_eq!(material["doubleSided"], true);
        let texture = &material["pbrMetallicRoughness"]["baseColorTexture"]["index"];
        let texture = &file["textures"][texture.as_u64().unwrap() as usize];
        let sampler = &file["samplers"][texture["sampler"].as_u64().unwrap() as usize];
        wraps.insert(material["name"].as_str().unwrap().to_owned(), sampler["wrapS"].clone());
        let image = &file["images"][texture["source"].as_u64().unwrap() as usize];
        let view = &file["bufferViews"][image["bufferView"].as_u64().unwrap() as usize];
        let start = view["byteOffset"].as_u64().unwrap() as usize;
        let bytes = &buffer[start..start + view["byteLength"].as_u64().unwrap() as usize];
        assert!(image::load_from_memory(bytes).is_ok());
    }
    assert_eq!(wraps["tile.face"], 10497, "tiles repeat");
    assert_eq!(wraps["sari.padar.face"], 33071, "parts lie once");
    // Front: rest place (0.2, 0.1) lies four tiles to the right and four up; v counts down.
    let front = &file["meshes"][0]["primitives"][0]["attributes"];
    let on_picture = numbers(&file, &buffer, &front["TEXCOORD_0"]);
    assert!((on_picture[5][0] - 4.0).abs() < 1e-6 && (on_picture[5][1] + 3.0).abs() < 1e-6);
    // The back has a patch of each surface.
    assert_eq!(file["meshes"][1]["primitives"].as_array().unwrap().len(), 2);
}

/// Over a seam at a right angle the two sides share one normal half way between theirs.
#[test]
fn normals_are_smooth_over_a_seam() {
    let (compiled, draped) = figure();
    let (file, buffer) = opened(&glb::write(&compiled, &draped, false));
    let of = |mesh: usize, primitive: usize| {
        let mesh = &file["meshes"][mesh]["primitives"][primitive];
        let places = numbers(&file, &buffer, &mesh["attributes"]["POSITION"]);
        let normals = numbers(&file, &buffer, &mesh["attributes"]["NORMAL"]);
        places.into_iter().zip(normals).collect::<Vec<_>>()
    };
    // Front lies in the plane z = 0 facing +z; back turns at x = 0.2 to face −x.
    let half = std::f32::consts::FRAC_1_SQRT_2;
    for (vertices, flat) in [(of(0, 0), [0.0, 0.0, 1.0]), (of(1, 1), [-1.0, 0.0, 0.0])] {
        let sewn = |place: &[f32]| (place[0] - 0.2).abs() < 1e-6 && place[2].abs() < 1e-6;
        assert_eq!(vertices.iter().filter(|(place, _)| sewn(place)).count(), 2);
        for (place, normal) in vertices {
            let expected = if sewn(&place) { [-half, 0.0, half] } else { flat };
            for (value, expected) in normal.iter().zip(expected) {
                // The triangle beside the cells does not touch the seam, so both sides weigh the
                // same; single precision rounds.
                assert!((value - expected).abs() < 1e-6, "{place:?}: {normal:?}");
            }
        }
    }
}

/// Neither a drape that went wrong nor a garment without anything makes a broken file.
#[test]
fn odd_figures_still_give_whole_files() {
    let (compiled, mut draped) = figure();
    draped.positions[0].x = f64::NAN;
    draped.positions[1].y = f64::INFINITY;
    let text = String::from_utf8(obj::write(&compiled, &draped, false, "a").obj).unwrap();
    assert!(!text.contains("NaN") && !text.contains("inf"));
    let (file, _) = opened(&glb::write(&compiled, &draped, false));
    assert!(file["accessors"].as_array().is_some_and(|list| list.len() > 3));

    draped.positions.truncate(3);
    assert!(!glb::write(&compiled, &draped, false).is_empty());
    assert!(!obj::write(&compiled, &draped, true, "a").obj.is_empty());

    let empty = Draped { positions: vec![], surfaces: vec![], stats: Stats::default() };
    let glb = glb::write(&Compiled::default(), &empty, true);
    assert_eq!(&glb[..4], b"glTF");
    assert_eq!(glb.len() % 4, 0);
}

/// The file lies in the target folder afterwards, for the validator of the format.
#[test]
fn glb_is_the_same_every_time() {
    let (compiled, draped) = figure();
    let glb = glb::write(&compiled, &draped, true);
    assert_eq!(glb, glb::write(&compiled, &draped, true));
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    std::fs::write(folder.join("box.glb"), &glb).unwrap();
}
