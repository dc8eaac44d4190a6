//! Characters that look like those of the language and are not: digits of other scripts,
//! letters of another alphabet in a Latin word, typographic signs, invisible blanks.

/// The character of the language that `c` is easily taken for; an empty string where `c` should
/// simply go.
pub(super) fn meant(c: char) -> Option<&'static str> {
    digit(c).or_else(|| sign(c)).or_else(|| letter(c))
}

/// The ASCII digit with the same value.
fn digit(c: char) -> Option<&'static str> {
    const ASCII: [&str; 10] = ["0", "1", "2", "3", "4", "5", "6", "7", "8", "9"];
    // Each script's digits stand together in order, beginning with these zeros.
    const ZEROS: [char; 26] = [
        '\u{0660}', '\u{06F0}', '\u{07C0}', '\u{0966}', '\u{09E6}', '\u{0A66}', '\u{0AE6}',
        '\u{0B66}', '\u{0BE6}', '\u{0C66}', '\u{0CE6}', '\u{0D66}', '\u{0DE6}', '\u{0E50}',
        '\u{0ED0}', '\u{0F20}', '\u{1040}', '\u{17E0}', '\u{1810}', '\u{1946}', '\u{19D0}',
        '\u{1A80}', '\u{1B50}', '\u{1C40}', '\u{ABF0}', '\u{FF10}',
    ];
    ZEROS.iter().find_map(|&zero| {
        let value = u32::from(c).checked_sub(u32::from(zero))?;
        ASCII.get(usize::try_from(value).ok()?).copied()
    })
}

/// The sign of the language for a typographic one.
fn sign(c: char) -> Option<&'static str> {
    Some(match c {
        '\u{2010}'..='\u{2015}' | '\u{2212}' | '\u{FF0D}' => "-",
        '\u{D7}' | '\u{2715}' => "x",
        '\u{F7}' | '\u{2044}' | '\u{2215}' | '\u{FF0F}' => "/",
        '\u{2192}' | '\u{21D2}' => "->",
        '\u{2264}' => "<=",
        '\u{2265}' => ">=",
        '\u{2260}' => "!=",
        '\u{2026}' => "..",
        '\u{2018}' | '\u{2019}' | '\u{201C}'..='\u{201F}' | '\u{AB}' | '\u{BB}' | '\u{FF02}' => {
            "\""
        }
        '\u{B0}' => "deg",
        '\u{2033}' => "in",
        '\u{FF08}' => "(",
        '\u{FF09}' => ")",
        '\u{FF0B}' => "+",
        '\u{FF0C}' | '\u{3001}' => ",",
        '\u{FF0E}' => ".",
        '\u{FF1A}' => ":",
        '\u{FF1B}' | '\u{37E}' => ";",
        '\u{FF1D}' => "=",
        '\u{FF20}' => "@",
        '\u{FF05}' | '\u{66A}' => "%",
        '\u{FF3B}' => "[",
        '\u{FF3D}' => "]",
        '\u{FF5B}' => "{",
        '\u{FF5C}' | '\u{2502}' | '\u{A6}' => "|",
        '\u{FF5D}' => "}",
        '\u{A0}' | '\u{2000}'..='\u{200A}' | '\u{202F}' | '\u{205F}' | '\u{3000}' => " ",
        '\u{AD}'
        | '\u{200B}'..='\u{200F}'
        | '\u{202A}'..='\u{202E}'
        | '\u{2060}'..='\u{2069}'
        | '\u{FEFF}' => "",
        _ => return None,
    })
}

/// The Latin letter that a letter of another alphabet is drawn like.
fn letter(c: char) -> Option<&'static str> {
    Some(match c {
        'а' | 'α' | 'ａ' => "a",
        'е' | 'ｅ' => "e",
        'о' | 'ο' | 'ｏ' => "o",
        'р' | 'ρ' | 'ｐ' => "p",
        'с' | 'ｃ' => "c",
        'у' | 'ｙ' => "y",
        'х' | 'χ' | 'ｘ' => "x",
        'і' | 'ι' | 'ｉ' => "i",
        'ј' | 'ｊ' => "j",
        'ѕ' | 'ｓ' => "s",
        'ԁ' | 'ｄ' => "d",
        'ԛ' | 'ｑ' => "q",
        'ԝ' | 'ｗ' => "w",
        'һ' | 'ｈ' => "h",
        'м' | 'ｍ' => "m",
        'к' | 'κ' | 'ｋ' => "k",
        'т' | 'τ' | 'ｔ' => "t",
        'ν' | 'ｖ' => "v",
        'ｂ' => "b",
        'ｆ' => "f",
        'ｇ' => "g",
        'ｌ' => "l",
        'ｎ' => "n",
        'ｒ' => "r",
        'ｕ' => "u",
        'ｚ' => "z",
        'А' | 'Α' => "A",
        'В' | 'Β' => "B",
        'Е' | 'Ε' => "E",
        'Н' | 'Η' => "H",
        'К' | 'Κ' => "K",
        'М' | 'Μ' => "M",
        'О' | 'Ο' => "O",
        'Р' | 'Ρ' => "P",
        'С' => "C",
        'Т' | 'Τ' => "T",
        'Х' | 'Χ' => "X",
        'Ν' => "N",
        'Ζ' => "Z",
        'І' | 'Ι' => "I",
        _ => return None,
    })
}

/// Where a word that is otherwise in Latin letters has letters of another alphabet drawn like
/// Latin ones: the word as it was probably meant. A word all in one script is nobody's mistake.
pub(super) fn latin(word: &str) -> Option<String> {
    if word.is_ascii() || !word.chars().any(|c| c.is_ascii_alphabetic()) {
        return None;
    }
    let mut changed = false;
    let plain = word
        .chars()
        .map(|c| match letter(c) {
            Some(like) => {
                changed = true;
                like.to_owned()
            }
            None => c.to_string(),
        })
        .collect();
    changed.then_some(plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_keep_their_value() {
        assert_eq!(meant('१'), Some("1"));
        assert_eq!(meant('９'), Some("9"));
        assert_eq!(meant('٣'), Some("3"));
        assert_eq!(meant('5'), None);
    }

    #[test]
    fn only_words_of_two_alphabets_are_suspicious() {
        assert_eq!(latin("fr\u{43E}nt").as_deref(), Some("front"));
        assert_eq!(latin("काठ"), None);
        assert_eq!(latin("düğme"), None);
        assert_eq!(latin("рукав"), None);
    }
}
