//! The codes of all messages. A code keeps its meaning for good; a new meaning gets a new code.

/// A code with its meaning in one line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Code {
    /// The code, such as `E0501`.
    pub code: &'static str,
    /// What it says, in one line.
    pub title: &'static str,
}

const fn code(code: &'static str, title: &'static str) -> Code {
    Code { code, title }
}

/// All codes in order: E01 text, E02 names and words, E03 values and units, E04 outlines,
/// E05 seams, E06 textiles, E07 saris and outfits, E08 placing and draping, E09 files,
/// W warnings of the same groups.
pub const CODES: &[Code] = &[
    code("E0101", "text that makes no sense here"),
    code("E0102", "a unit stands apart from its number"),
    code("E0103", "a block is not closed"),
    code("E0104", "a row of a chart is not closed"),
    code("E0105", "an operator has a blank on one side only"),
    code("E0106", "a closing brace closes nothing"),
    code("E0107", "two statements on one line without `;`"),
    code("E0108", "a doc comment stands at the end of a line"),
    code("E0109", "a decimal comma"),
    code("E0110", "a character that looks like another"),
    code("E0111", "nested too deep"),
    code("E0112", "the text is too long"),
    code("E0113", "a string is not closed or has a wrong escape"),
    code("E0114", "a colour with a wrong count of digits"),
    code("E0115", "a number out of reach"),
    code("E0116", "a word of the language used as a name"),
    code("E0117", "a bracket is not closed"),
    code("E0118", "most of a text makes no sense"),
    code("E0201", "a name that nobody declared"),
    code("E0202", "a property or action does not belong into this block"),
    code("E0203", "an unknown word"),
    code("E0204", "an unknown name"),
    code("E0205", "one name for two things"),
    code("E0206", "values that need each other"),
    code("E0207", "something is given that has no place here"),
    code("E0208", "something that must be given is missing"),
    code("E0209", "something said twice"),
    code("E0210", "a text that takes too long to work out"),
    code("E0211", "values that hang on each other too deep"),
    code("E0212", "a value set from outside that cannot be read"),
    code("E0213", "a value that grows too large"),
    code("E0301", "dimensions that do not go together"),
    code("E0302", "a value of another dimension is wanted"),
    code("E0303", "a value outside its range"),
    code("E0304", "a value of another kind is wanted"),
    code("E0305", "no such size"),
    code("E0306", "the wrong number of values"),
    code("E0307", "no such unit"),
    code("E0308", "a measure that no body has"),
    code("E0309", "measures that do not go together"),
    code("E0310", "a value that is not finite"),
    code("E0401", "an outline does not close"),
    code("E0402", "an outline crosses itself"),
    code("E0403", "directions of curves that wait for each other"),
    code("E0404", "an edge without length or direction"),
    code("E0405", "a fit out of reach"),
    code("E0406", "a dart outside the cloth"),
    code("E0407", "a cut that leaks"),
    code("E0408", "a fit with several answers"),
    code("E0409", "a fold that is not straight"),
    code("E0410", "a hole outside the cloth"),
    code("E0411", "a pleat that does not fit"),
    code("E0412", "a line that does not lie on the cloth"),
    code("E0413", "a cut that does not part the cloth as it is said"),
    code("E0501", "lengths of a seam that do not agree"),
    code("E0502", "a twisted seam"),
    code("E0503", "an edge sewn twice"),
    code("E0504", "edges in a sequence that do not join"),
    code("E0505", "halves that are not said"),
    code("E0506", "a patch that reaches beyond the cloth below it"),
    code("E0507", "seams that cross each other"),
    code("E0601", "rows of unequal length"),
    code("E0602", "an unknown symbol in a chart"),
    code("E0603", "stitches that do not add up"),
    code("E0604", "no such satin"),
    code("E0605", "a property of a fabric given twice"),
    code("E0606", "a thread or shaft number that does not exist"),
    code("E0607", "a row of a knit in words that cannot be read"),
    code("E0608", "a path that cannot be drawn"),
    code("E0609", "a picture that cannot be read"),
    code("E0621", "a part of a weaving file that is missing"),
    code("E0622", "a value of a weaving file that cannot be read"),
    code("E0623", "a treadle or colour that a weaving file does not have"),
    code("E0624", "a draft that is too large"),
    code("E0625", "a text that is no weaving file"),
    code("E0631", "a text that is no knitout"),
    code("E0632", "carriers that a knitout program does not say"),
    code("E0633", "an operation of knitout that cannot be read"),
    code("E0634", "a carrier that the machine does not have"),
    code("E0635", "a carrier that is not in action, or is already"),
    code("E0636", "needles that do not face each other"),
    code("E0637", "a slider that is to make a loop"),
    code("E0641", "a text that is no chart of KnitScape"),
    code("E0642", "a value of a KnitScape chart that cannot be used"),
    code("E0651", "a knit that a machine cannot make"),
    code("E0701", "a layout of a sari that does not exist"),
    code("E0702", "bands that do not fill their part"),
    code("E0706", "a motif higher than its border"),
    code("E0801", "a panel that is placed nowhere"),
    code("E0802", "cloth that is left inside a body"),
    code("E0803", "a drape that did not reach what is asked"),
    code("E0804", "steps of a drape in the wrong order"),
    code("E0805", "something that must be worn below is missing"),
    code("E0806", "a check that failed"),
    code("E0807", "a requirement that does not hold"),
    code("E0808", "cloth that passes through itself"),
    code("E0809", "a garment that fell off"),
    code("E0811", "too many particles"),
    code("E0812", "a panel smaller than its grid"),
    code("E0813", "an outline that encloses no cloth"),
    code("E0814", "points of a seam that cannot be matched"),
    code("E0815", "cloth that cannot be shown so"),
    code("E0901", "a file without the name that is used"),
    code("E0902", "files that use each other"),
    code("E0903", "a file that cannot be read"),
    code("E0911", "the machine has no room to work"),
    code("W0101", "a doc comment that describes nothing"),
    code("W0401", "pieces of cloth that fall off"),
    code("W0601", "long floats"),
    code("W0602", "yarns and mass that do not agree"),
    code("W0603", "a cloth that falls into layers"),
    code("W0604", "threads closer than they are thick"),
    code("W0605", "a motif without figure"),
    code("W0606", "a knit that does not go on above itself"),
    code("W0607", "long floats behind a knit"),
    code("W0621", "a weaving file that was mended"),
    code("W0622", "ends or picks that take no part"),
    code("W0623", "a draft beyond the loom"),
    code("W0624", "an edge that does not hold the weft"),
    code("W0625", "a sett beyond what can be woven"),
    code("W0631", "knitout that departs from its format"),
    code("W0632", "work on a needle without loops"),
    code("W0633", "a yarn left in action"),
    code("W0801", "a garment that nothing holds"),
];

/// The meaning of a code.
pub fn title(code: &str) -> Option<&'static str> {
    CODES.iter().find(|known| known.code == code).map(|known| known.title)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;
    use std::path::Path;

    /// The codes that stand in quotation marks in a source file.
    fn quoted(text: &str, found: &mut BTreeSet<String>) {
        for piece in text.split('"') {
            let mut letters = piece.chars();
            let group = letters.next();
            if piece.len() == 5
                && matches!(group, Some('E' | 'W'))
                && letters.all(|c| c.is_ascii_digit())
            {
                found.insert(piece.to_owned());
            }
        }
    }

    fn walk(folder: &Path, found: &mut BTreeSet<String>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                walk(&path, found);
            } else if path.extension().is_some_and(|end| end == "rs") {
                quoted(&std::fs::read_to_string(&path).unwrap(), found);
            }
        }
    }

    #[test]
    fn every_code_in_the_sources_stands_in_the_table() {
        let mut used = BTreeSet::new();
        walk(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut used);
        let unknown: Vec<_> = used.iter().filter(|code| title(code).is_none()).collect();
        assert!(unknown.is_empty(), "add to CODES: {unknown:?}");
    }

    #[test]
    fn the_table_is_in_order_and_names_nothing_twice() {
        assert!(CODES.windows(2).all(|pair| pair[0].code < pair[1].code));
    }
}
