use super::*;

/// Formats a text and checks that it is left alone the next time.
fn formatted(text: &str) -> String {
    let new = format(FileId(0), text).unwrap_or_else(|told| panic!("{told:?}"));
    assert_eq!(format(FileId(0), &new).as_deref(), Ok(new.as_str()));
    new
}

#[test]
fn statements_get_lines_of_their_own() {
    let text = "garment g { param a=1cm in 0cm .. 2cm; param long = 12cm in 1cm..20cm;;
      let x=a+2*long; seam f.a->b.a; seam front.side -> b.c ease 1cm }";
    assert_eq!(
        formatted(text),
        "\
garment g {
    param a    = 1cm  in 0cm..2cm
    param long = 12cm in 1cm..20cm
    let x = a + 2 * long
    seam f.a        -> b.a
    seam front.side -> b.c ease 1cm
}
"
    );
}

#[test]
fn a_short_block_stays_on_its_line_and_a_long_one_does_not() {
    let text = "\
yarn a {count:30Ne plies:2;twist: 850turns/m Z}
yarn longer { count: 7Ne   plies:1 }
panel p{rectangle 1cm x 2cm;pair as left, right;note: \"a note that is rather long, so that the line grows too wide\"}
";
    assert_eq!(
        formatted(text),
        "\
yarn a      { count: 30Ne   plies: 2   twist: 850turns/m Z }
yarn longer { count: 7Ne    plies: 1 }
panel p {
    rectangle 1cm x 2cm
    pair as left, right
    note: \"a note that is rather long, so that the line grows too wide\"
}
"
    );
}

#[test]
fn properties_share_a_line_as_they_did() {
    let text = "fabric f {\nmass:  62g/m2 thickness: 0.14mm\nbending: 2uN.m, 1uN.m; width: 1m\n}";
    assert_eq!(
        formatted(text),
        "\
fabric f {
    mass:    62g/m2   thickness: 0.14mm
    bending: 2uN.m, 1uN.m
    width:   1m
}
"
    );
}

#[test]
fn tables_stand_in_columns() {
    let text = "sizes s {\n measures: bust, waist_to_hip, hip\n \"EU 8\": 1cm, 2cm, 3cm\n \"S\": 10.5cm, 2cm, 3cm\n}";
    assert_eq!(
        formatted(text),
        "\
sizes s {
    measures: bust,   waist_to_hip, hip
    \"EU 8\":   1cm,    2cm,          3cm
    \"S\":      10.5cm, 2cm,          3cm
}
"
    );
}

#[test]
fn comments_stay_where_they_are() {
    let text = "
// a file
  //  of two lines


/// a thing
let a=1 // short
// between
let long_name = a+1   // behind
let b = 2 // 3
";
    assert_eq!(
        formatted(text),
        "\
// a file
//  of two lines

/// a thing
let a         = 1       // short
// between
let long_name = a + 1   // behind
let b         = 2       // 3
"
    );
}

#[test]
fn what_is_much_longer_sticks_out() {
    let text = "seam a -> b\nseam a.long + b.side + c.armhole -> d\nseam a.side -> b.side";
    assert_eq!(
        formatted(text),
        "\
seam a      -> b
seam a.long + b.side + c.armhole -> d
seam a.side -> b.side
"
    );
}

#[test]
fn a_statement_goes_on_in_the_next_line_where_it_did() {
    let text = "\
seam neck ->   // first
left + right ->
    // the lining
    lining
let l = [
1cm, 2cm,   // two
f(a,
b
)
]
";
    assert_eq!(
        formatted(text),
        "\
seam neck ->    // first
    left + right ->
    // the lining
    lining
let l = [
    1cm, 2cm,   // two
    f(a,
        b
    )
]
"
    );
}

#[test]
fn charts_and_strings_are_not_touched() {
    let text =
        "knit k {\nchart: |a  //b|\n\n\n  | c |   // row\nnote: \"a  //  b\"; matrix:|10|01|\n}";
    assert_eq!(
        formatted(text),
        "\
knit k {
    chart:
        |a  //b|

        | c |   // row
    note:   \"a  //  b\"
    matrix: |10|01|
}
"
    );
}

#[test]
fn operators_stand_between_blanks() {
    let text = "let a = (b+c)/2*-d@30deg..e\nlet f = 0cm .. 8cm\nlet g = not a<b  and c!=d\nweave w { twill 2/1/1 Z }";
    assert_eq!(
        formatted(text),
        "\
let a = (b + c) / 2 * -d @ 30deg .. e
let f = 0cm..8cm
let g = not a < b and c != d
weave w { twill 2/1/1 Z }
"
    );
}

#[test]
fn every_shape_of_statement_has_its_layout() {
    let text = "\
use   \"a.garment\" :: {b}, \"c.garment\"::{ d,e } , std::body::{female}, std::x  as  y
fn f(a:length,b : length=2cm):length=a+b
for i in 1 .. 6{panel gore[ i ] { }}
if hooded{a}else if not x {b;c: 1}else{
d: {e}
}
";
    assert_eq!(
        formatted(text),
        "\
use \"a.garment\"::b, \"c.garment\"::{d, e}, std::body::{female}, std::x as y
fn f(a: length, b: length = 2cm): length = a + b
for i in 1..6 { panel gore[i] { } }
if hooded {
    a
} else if not x {
    b
    c: 1
} else {
    d: { e }
}
"
    );
}

#[test]
fn a_comma_behind_the_last_of_a_list_goes() {
    let text = "let l = [\n1cm,\n2cm, // two\n]\nlet r = {a: [1,],\nb: f(2,)\n, }\n";
    let new = "let l = [\n    1cm,\n    2cm     // two\n]\nlet r = { a: [1],\n    b: f(2)\n}\n";
    assert_eq!(formatted(text), new);
    assert!(format(FileId(0), "let p = (1cm, 2cm,)").is_err(), "a point has no such comma");
    assert!(format(FileId(0), "let l = [,]").is_err(), "nor has an empty list");
}

#[test]
fn a_comma_at_the_end_does_not_swallow_the_next_statement() {
    assert_eq!(formatted("a x, ; b y; c: 1"), "a x,;\nb y\nc: 1\n");
    assert_eq!(formatted("a: x,\nc: 1"), "a: x,\nc: 1\n");
}

#[test]
fn names_of_other_scripts_take_the_columns_they_take_on_a_screen() {
    assert_eq!(formatted("let काठ = 1\nlet abc = 2"), "let काठ = 1\nlet abc = 2\n");
    assert_eq!(formatted("let 布 = 1\nlet a = 2"), "let 布 = 1\nlet a  = 2\n");
}

#[test]
fn empty_texts_and_line_ends() {
    assert_eq!(formatted(""), "");
    assert_eq!(formatted("\u{FEFF}\n \n"), "");
    assert_eq!(formatted("a\r\nb"), "a\r\nb\r\n");
    assert_eq!(formatted("a\rb"), "a\nb\n");
    assert!(format(FileId(0), "a }").is_err());
}
