//! Lines and columns of a text.

/// Where the lines of a text begin. A line ends with LF or CRLF.
#[derive(Clone, Debug)]
pub struct Lines {
    starts: Vec<usize>,
}

/// A line and a column, counted from 1; columns count characters, not bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// The line.
    pub line: usize,
    /// The column.
    pub column: usize,
}

impl Lines {
    /// Finds the lines of `text`.
    pub fn of(text: &str) -> Self {
        let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        Lines { starts: std::iter::once(0).chain(ends.map(|(end, _)| end + 1)).collect() }
    }

    /// The number of the line that holds byte `at`, counted from 0.
    pub fn number(&self, at: usize) -> usize {
        self.starts.partition_point(|&start| start <= at).saturating_sub(1)
    }

    /// The first byte of the line that holds byte `at`.
    pub fn start(&self, at: usize) -> usize {
        self.start_of(self.number(at)).unwrap_or(0)
    }

    /// The first byte of line `number`, counted from 0.
    pub fn start_of(&self, number: usize) -> Option<usize> {
        self.starts.get(number).copied()
    }

    /// Line and column of byte `at` of `text`, which must be the text the lines were found in.
    /// A byte beyond the end counts as the end.
    pub fn place(&self, text: &str, at: usize) -> Place {
        let at = text.floor_char_boundary(at.min(text.len()));
        let number = self.number(at);
        let before = text.get(self.start(at)..at).unwrap_or("");
        // A byte order mark before the first line is no character of it.
        let column = before.trim_start_matches('\u{FEFF}').chars().count();
        Place { line: number + 1, column: column + 1 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters() {
        let text = "काठ x\r\ny";
        let lines = Lines::of(text);
        let x = text.find('x').unwrap();
        let y = text.find('y').unwrap();
        assert_eq!(lines.place(text, x), Place { line: 1, column: 5 });
        assert_eq!(lines.place(text, y), Place { line: 2, column: 1 });
        assert_eq!(lines.place(text, 999), Place { line: 2, column: 2 });
    }

    #[test]
    fn an_empty_text_has_one_line() {
        assert_eq!(Lines::of("").place("", 0), Place { line: 1, column: 1 });
    }
}
