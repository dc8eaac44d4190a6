//! Records, and values that are made of values.

use crate::garments::{sound, told};

/// Whether what is required of a text holds.
fn holds(text: &str) {
    let codes = told(text);
    assert!(codes.is_empty(), "{codes:?} in\n{text}");
}

#[test]
fn the_values_of_a_record_are_called_by_their_names() {
    holds(
        "let box = { width: 12cm, depth: 3cm, lid: { width: 1cm } }
         let table = [{ size: 36, bust: 82cm }, { size: 38, bust: 86cm }]
         let one = if box.width > 10cm then { a: 1 } else { a: 2 }
         fn area(of: record, times: number = 1): area = of.width * of.depth * times
         param given: record = {
             width: 2cm,  // a comment
             depth: box.lid.width
         }
         require box.lid.width == 1cm
         require table[2].bust == 86cm and table.count == 2
         require one.a == 1
         require abs(area(box) - 36cm2) < 1mm2 and abs(area(given, times: 2) - 4cm2) < 1mm2
         require abs(area({ width: 1cm, depth: 1cm }) - 1cm2) < 1mm2
         for row in table { require row.bust > 80cm }",
    );
}

#[test]
fn parts_and_copies_are_given_records() {
    let text = |of: &str, copy: &str| {
        format!(
            "block cuff {{
                 param size: record; param more: record = {{ lid: {{ a: 1cm }} }}
                 panel band of cotton {{ rectangle size.width x size.depth + more.lid.a }}
             }}
             garment g {{
                 wearer l = female {{ size: EU 38 }}
                 part c = cuff {{ {of} }}
                 panel p of cotton {{
                     param box = {{ width: 10cm, height: 10cm }}; rectangle box.width x box.height
                 }}
                 panel q = p with {{ {copy} }}
                 place c.band before l.waist; place p before l.waist; place q before l.waist
             }}"
        )
    };
    let sizes = |of: &str, copy: &str| {
        let right = sound(&text(of, copy), &[]).remove(0);
        let length = |panel: &str, edge: &str| {
            let panel = right.panels.iter().find(|p| p.name == panel).unwrap();
            let edge = panel.edges.iter().find(|e| e.name == edge).unwrap();
            edge.runs.iter().map(|run| run.length() * 1e3).sum::<f64>().round()
        };
        [length("c.band", "top"), length("c.band", "end"), length("q", "top")]
    };
    assert_eq!(
        sizes("size: { width: 12cm, depth: 3cm }", "box: { width: 20cm, height: 1cm }"),
        [120.0, 40.0, 200.0]
    );
    assert_eq!(
        sizes(
            "size: ({ width: 12cm, depth: 3cm })   more: { lid: { a: 2cm } }",
            "box: ({ width: 20cm, height: 1cm })"
        ),
        [120.0, 50.0, 200.0]
    );
}

/// Lists, texts and rows of edges that are named twice in every line: what they are made of
/// would fill any memory.
#[test]
fn values_that_double_are_stopped() {
    let doubled = |first: &str, next: &dyn Fn(usize) -> String| {
        let mut text = format!("let v0 = {first}\n");
        for n in 1..20 {
            text += &format!("let v{n} = {}\n", next(n - 1));
        }
        text
    };
    assert_eq!(told(&doubled("[1cm, 2cm]", &|n| format!("[v{n}, v{n}]"))), ["E0213"]);
    assert_eq!(told(&doubled("{ a: 1 }", &|n| format!("{{ a: v{n}, b: v{n} }}"))), ["E0213"]);
    assert_eq!(told(&doubled("\"thread\"", &|n| format!("\"{{v{n}}}{{v{n}}}\""))), ["E0213"]);
    let rows = doubled("p.top + p.top", &|n| format!("v{n} + v{n}"));
    let garment = format!("garment g {{ panel p of cotton {{ rectangle 1m x 1m }}\n{rows} }}");
    assert!(told(&garment).contains(&"E0213".to_owned()));
}
