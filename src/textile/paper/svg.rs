//! A sheet as SVG.

use super::{Area, Shape, Sheet, digit};
use crate::textile::Colour;
use crate::units::trimmed;
use std::fmt::Write;

/// Writes a sheet as SVG 1.1, one shape a line.
pub fn svg(sheet: &Sheet) -> String {
    let (width, height) = (sheet.width, sheet.height);
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\">"
    );
    if !sheet.title.is_empty() {
        let _ = writeln!(out, "<title>{}</title>", escaped(&sheet.title));
    }
    out.push_str(LIGHT);
    let _ = writeln!(out, "<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>");
    for shape in &sheet.shapes {
        draw(&mut out, shape);
    }
    out.push_str("</svg>\n");
    out
}

/// The light on a round thread across it, and the shade in which its ends dip.
const LIGHT: &str = r##"<defs>
<linearGradient id="h" x1="0" y1="0" x2="0" y2="1"><stop offset="0" stop-opacity="0.5"/><stop offset="0.15" stop-opacity="0.2"/><stop offset="0.4" stop-color="#fff" stop-opacity="0.16"/><stop offset="0.75" stop-opacity="0.15"/><stop offset="1" stop-opacity="0.55"/></linearGradient>
<linearGradient id="v" x1="0" y1="0" x2="1" y2="0"><stop offset="0" stop-opacity="0.5"/><stop offset="0.15" stop-opacity="0.2"/><stop offset="0.4" stop-color="#fff" stop-opacity="0.16"/><stop offset="0.75" stop-opacity="0.15"/><stop offset="1" stop-opacity="0.55"/></linearGradient>
</defs>
"##;

fn draw(out: &mut String, shape: &Shape) {
    let _ = match shape {
        Shape::Fill { area, colour } => {
            writeln!(out, "<rect {} fill=\"{}\"/>", place(*area), hex(*colour))
        }
        Shape::Marks { corner, cell, inset, runs, colour } => {
            if runs.is_empty() {
                return;
            }
            let mut path = String::new();
            let high = number(cell - 2.0 * inset);
            for [column, row, length] in runs {
                let x = corner[0] + f64::from(*column) * cell + inset;
                let y = corner[1] + f64::from(*row) * cell + inset;
                let wide = number(f64::from(*length) * cell - 2.0 * inset);
                let _ = write!(path, "M{} {}h{wide}v{high}h-{wide}z", number(x), number(y));
            }
            writeln!(out, "<path fill=\"{}\" d=\"{path}\"/>", hex(*colour))
        }
        Shape::Ties { corner, cell, cells, crosses, colour } => {
            let thick = number((cell / 7.0).max(1.0));
            let half = cell * 0.28;
            let mut path = String::new();
            for [column, row] in cells {
                let x = corner[0] + (f64::from(*column) + 0.5) * cell + 0.5;
                let y = corner[1] + (f64::from(*row) + 0.5) * cell + 0.5;
                let _ = if *crosses {
                    let [n, m] = [number(2.0 * half), number(-2.0 * half)];
                    let (x, y) = (x - half, y - half);
                    write!(
                        path,
                        "M{} {}l{n} {n}M{} {}l{m} {n}",
                        number(x),
                        number(y),
                        number(x + 2.0 * half),
                        number(y)
                    )
                } else {
                    let (r, d) = (number(half), number(2.0 * half));
                    write!(
                        path,
                        "M{} {}a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0 -{d} 0z",
                        number(x - half),
                        number(y)
                    )
                };
            }
            writeln!(
                out,
                "<path fill=\"none\" stroke=\"{}\" stroke-width=\"{thick}\" d=\"{path}\"/>",
                hex(*colour)
            )
        }
        Shape::Thread { area, upright, colour, dips } => {
            let light = if *upright { "v" } else { "h" };
            let place = place(*area);
            let mut lines = format!(
                "<rect {place} fill=\"{}\"/><rect {place} fill=\"url(#{light})\"/>",
                hex(*colour)
            );
            for (dip, first) in [(dips[0], true), (dips[1], false)] {
                if dip > 0.0 {
                    let mut end = *area;
                    let (at, length) = match upright {
                        true => (&mut end.y, &mut end.height),
                        false => (&mut end.x, &mut end.width),
                    };
                    if !first {
                        *at += *length - dip / 2.0;
                    }
                    *length = dip / 2.0;
                    let place = self::place(end);
                    let _ = write!(lines, "<rect {place} fill-opacity=\"0.28\"/>");
                }
            }
            writeln!(out, "{lines}")
        }
        Shape::Line { points, thick, colour } => writeln!(
            out,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" \
             stroke-linecap=\"round\" stroke-linejoin=\"round\"/>",
            pairs(points),
            hex(*colour),
            number(*thick)
        ),
        Shape::Polygon { points, colour } => {
            writeln!(out, "<polygon points=\"{}\" fill=\"{}\"/>", pairs(points), hex(*colour))
        }
        Shape::Digits { middle, height, text, colour } => {
            let size = height / 0.72;
            writeln!(
                out,
                "<text x=\"{}\" y=\"{}\" textLength=\"{}\" font-size=\"{}\" \
                 font-family=\"sans-serif\" text-anchor=\"middle\" fill=\"{}\">{}</text>",
                number(middle[0]),
                number(middle[1] + height / 2.0),
                number(digit::width(text, *height)),
                number(size),
                hex(*colour),
                escaped(text)
            )
        }
    };
}

fn place(area: Area) -> String {
    let [x, y, width, height] = [area.x, area.y, area.width, area.height].map(number);
    format!("x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"")
}

fn pairs(points: &[[f64; 2]]) -> String {
    let pairs: Vec<String> =
        points.iter().map(|[x, y]| format!("{},{}", number(*x), number(*y))).collect();
    pairs.join(" ")
}

fn number(pixels: f64) -> String {
    trimmed((pixels * 100.0).round() / 100.0, 2)
}

fn hex(Colour([red, green, blue, _]): Colour) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// A text without the signs of markup and those that XML does not know.
fn escaped(text: &str) -> String {
    text.chars()
        .filter(|c| !c.is_control())
        .map(|c| match c {
            '&' => "&amp;".to_owned(),
            '<' => "&lt;".to_owned(),
            '>' => "&gt;".to_owned(),
            c => c.to_string(),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::textile::draft::Draft;
    use crate::textile::drawdown::Cloth;
    use crate::textile::paper::drawing;
    use crate::textile::weave::Weave;

    #[test]
    fn a_drawing_is_sound_markup() {
        let mut draft = Draft::of_weave(&Weave::satin(5, 2).unwrap());
        draft.title = "a < b & \u{1}c".to_owned();
        draft.rising = false;
        let cloth = Cloth::new(draft.drawdown().unwrap());
        let text = svg(&drawing(&draft, &cloth).sheet);
        assert!(text.contains("<title>a &lt; b &amp; c</title>"), "{text}");
        assert!(text.ends_with("</svg>\n"));
        assert_eq!(text.matches('<').count(), text.matches('>').count());
        assert!(!text.contains("NaN") && !text.contains("inf"));
        // Five ends, each lowered on one pick of five: crosses in the tie-up.
        let ties = text.lines().find(|line| line.contains("fill=\"none\"")).unwrap();
        assert_eq!(ties.matches('M').count(), 2 * 20);
    }
}
