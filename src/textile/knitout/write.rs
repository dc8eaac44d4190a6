//! A program as text.

use super::program::{Carrier, Content, Direction, Needle, Operation, Program};
use std::fmt::Write;

/// Writes a program as knitout, with its headers, comments and blank lines. What is written reads
/// back as the same program.
pub fn write(program: &Program) -> String {
    let mut out = format!(";!knitout-{}\n", program.version);
    let mut begun = false;
    for line in &program.lines {
        begun |= matches!(line.content, Content::Operation(_));
        match &line.content {
            // What is not at the beginning of its line is no header.
            Content::Nothing if !begun && line.comment.as_ref().is_some_and(is_like_header) => {
                out.push(' ');
            }
            Content::Nothing => {}
            // Writing to a string cannot fail.
            Content::Header { name, value } => {
                let _ = write!(out, ";;{name}: {value}");
            }
            Content::Operation(operation) => {
                said(&mut out, program, operation);
                if line.comment.is_some() {
                    out.push(' ');
                }
            }
        }
        if let Some(comment) = &line.comment {
            let _ = write!(out, ";{comment}");
        }
        out.push('\n');
    }
    out
}

/// Whether a comment would be read as a header.
fn is_like_header(comment: &String) -> bool {
    comment.starts_with(';') && comment.contains(':')
}

fn said(out: &mut String, program: &Program, operation: &Operation) {
    let names = |out: &mut String, carriers: &[Carrier]| {
        for carrier in carriers {
            let name = program.carriers.get(usize::from(*carrier)).map_or("?", String::as_str);
            let _ = write!(out, " {name}");
        }
    };
    let at = |out: &mut String, word: &str, direction: Direction, needle: Needle| {
        let _ = write!(out, "{word} {} {needle}", direction.sign());
    };
    let _ = match operation {
        Operation::Yarn(yarn, carriers) => {
            out.push_str(yarn.word());
            names(out, carriers);
            Ok(())
        }
        Operation::Stitch([leading, trailing]) => {
            write!(out, "stitch {leading} {trailing}")
        }
        Operation::Rack(racking) => write!(out, "rack {racking}"),
        Operation::Make { making, direction, needle, carriers } => {
            at(out, making.word(), *direction, *needle);
            names(out, carriers);
            Ok(())
        }
        Operation::Split { direction, from, to, carriers } => {
            at(out, "split", *direction, *from);
            let _ = write!(out, " {to}");
            names(out, carriers);
            Ok(())
        }
        Operation::Drop(needle) => write!(out, "drop {needle}"),
        Operation::Amiss(needle) => write!(out, "amiss {needle}"),
        Operation::Xfer(from, to) => write!(out, "xfer {from} {to}"),
        Operation::Pause(text) if text.is_empty() => write!(out, "pause"),
        Operation::Pause(text) => write!(out, "pause {text}"),
        Operation::Extension(word, text) if text.is_empty() => write!(out, "{word}"),
        Operation::Extension(word, text) => write!(out, "{word} {text}"),
    };
}
