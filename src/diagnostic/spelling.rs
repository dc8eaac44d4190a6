//! The word that was probably meant.

/// The candidate nearest to `word` by insertions, deletions, exchanges of letters and swaps of
/// neighbours (Damerau 1964, in the restricted form), if it is near enough: one mistake in
/// words of up to four letters, two up to eight, three beyond. Upper and lower case count as
/// half a mistake. Of equally near candidates the first counts.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word: Vec<char> = word.chars().take(LONGEST).collect();
    let bound = match word.len() {
        0 | 1 => return None,
        2..=4 => 2,
        5..=8 => 4,
        _ => 6,
    };
    let mut best: Option<(&str, usize)> = None;
    for candidate in candidates {
        let letters: Vec<char> = candidate.chars().take(LONGEST).collect();
        if letters.len().abs_diff(word.len()) * 2 > bound {
            continue;
        }
        let distance = distance(&word, &letters);
        let nearer = best.is_none_or(|(_, least)| distance < least);
        // A word that shares no letter in its place with a short one is not near it.
        if distance > 0 && distance <= bound && nearer && distance < 2 * letters.len() {
            best = Some((candidate, distance));
        }
    }
    best.map(|(candidate, _)| candidate)
}

/// Letters of a word that are compared.
const LONGEST: usize = 64;

/// Twice the number of mistakes between two words.
fn distance(a: &[char], b: &[char]) -> usize {
    // row[j] is the distance between the first i letters of a and the first j of b; the two rows
    // before it are those of fewer letters of a.
    let mut before = vec![0; b.len() + 1];
    let mut last: Vec<usize> = (0..=b.len()).map(|j| 2 * j).collect();
    let mut row = before.clone();
    for (i, &x) in a.iter().enumerate() {
        row[0] = 2 * (i + 1);
        for (j, &y) in b.iter().enumerate() {
            let differs = if x == y {
                0
            } else if x.to_lowercase().eq(y.to_lowercase()) {
                1
            } else {
                2
            };
            let exchanged = last[j] + differs;
            let deleted = last[j + 1] + 2;
            let inserted = row[j] + 2;
            let mut least = exchanged.min(deleted).min(inserted);
            if i > 0 && j > 0 && x == b[j - 1] && a[i - 1] == y && x != y {
                least = least.min(before[j - 1] + 2);
            }
            row[j + 1] = least;
        }
        (before, last, row) = (last, row, before);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_word_that_was_meant() {
        let words = ["width", "depth", "waist", "weave", "side", "shoulder"];
        assert_eq!(nearest("widht", words), Some("width"));
        assert_eq!(nearest("sied", words), Some("side"));
        assert_eq!(nearest("shuolder", words), Some("shoulder"));
        assert_eq!(nearest("Waist", words), Some("waist"));
        assert_eq!(nearest("trousers", words), None);
        assert_eq!(nearest("x", words), None);
        assert_eq!(nearest("काढ", ["काठ"]), Some("काठ"));
    }

    #[test]
    fn the_first_of_equals_counts() {
        assert_eq!(nearest("bost", ["bust", "best"]), Some("bust"));
        assert_eq!(nearest("bost", ["best", "bust"]), Some("best"));
    }
}
