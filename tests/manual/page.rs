//! A page of documentation as the tests read it: fenced blocks with what stands behind their
//! fences, headings, and links.

use std::path::Path;

/// Begins and ends a block.
const FENCE: &str = "```";

/// The line of a frame in whose place a fragment comes.
pub const HOLE: &str = "…";

/// A page.
pub struct Page {
    /// From the root of the repository.
    pub path: String,
    /// All of it.
    pub text: String,
    /// Its fenced blocks in their order.
    pub blocks: Vec<Block>,
}

/// A fenced block.
#[derive(Clone, Default)]
pub struct Block {
    /// The word behind the fence, `garment`, `text` or another.
    pub language: String,
    /// The line of its fence, from 1.
    pub line: usize,
    /// What is in it.
    pub text: String,
    /// The frame in which it is read, behind `in`.
    pub frame: Option<String>,
    /// The name it gives to a frame, behind `frame`.
    pub names: Option<String>,
    /// The drawing of its pieces that the page shows, behind `picture`.
    pub picture: Option<String>,
    /// The file of which its lines are an excerpt, behind `of`.
    pub source: Option<String>,
    /// The file that it is.
    pub file: Option<String>,
    /// Codes that it must give.
    pub codes: Vec<String>,
    /// What is set from outside.
    pub set: Vec<(String, String)>,
    /// The size that is asked for.
    pub size: Option<String>,
}

fn is_code(word: &str) -> bool {
    let mut letters = word.chars();
    word.len() == 5
        && matches!(letters.next(), Some('E' | 'W'))
        && letters.all(|letter| letter.is_ascii_digit())
}

impl Block {
    /// `garment in panel E0404`, `garment --set length=75cm --for EU 42`, `garment parts/a.garment`
    fn new(info: &str, line: usize) -> Block {
        let mut block = Block { line, ..Block::default() };
        let (language, rest) = info.split_once(' ').unwrap_or((info, ""));
        block.language = language.to_owned();
        let mut words = rest.split_whitespace();
        while let Some(word) = words.next() {
            match word {
                "in" => block.frame = words.next().map(str::to_owned),
                "picture" => block.picture = words.next().map(str::to_owned),
                "of" => block.source = words.next().map(str::to_owned),
                "frame" => block.names = words.next().map(str::to_owned),
                "--set" => {
                    let pair = words.next().and_then(|pair| pair.split_once('=')).unwrap();
                    block.set.push((pair.0.to_owned(), pair.1.to_owned()));
                }
                "--for" => block.size = Some(words.by_ref().collect::<Vec<_>>().join(" ")),
                // Marks of the pages of messages, which have their own tests.
                "wrong" | "right" => {}
                word if is_code(word) => block.codes.push(word.to_owned()),
                word if [".garment", ".wif", ".json", ".ppm"]
                    .iter()
                    .any(|end| word.ends_with(end)) =>
                {
                    block.file = Some(word.to_owned())
                }
                other => panic!("line {line}: what does `{other}` say of a block?"),
            }
        }
        block
    }
}

impl Page {
    /// Reads a page.
    pub fn read(root: &Path, path: &str) -> Page {
        let text = std::fs::read_to_string(root.join(path))
            .unwrap_or_else(|error| panic!("{path}: {error}"));
        let mut blocks: Vec<Block> = Vec::new();
        let mut open = false;
        for (number, line) in text.lines().enumerate() {
            match line.strip_prefix(FENCE) {
                Some(_) if open => open = false,
                Some(info) if info.starts_with("garment") => {
                    blocks.push(Block::new(info, number + 1));
                    open = true;
                }
                Some(info) => {
                    let language = info.to_owned();
                    blocks.push(Block { language, line: number + 1, ..Block::default() });
                    open = true;
                }
                None if open => {
                    let block = blocks.last_mut().unwrap();
                    block.text.push_str(line);
                    block.text.push('\n');
                }
                None => {}
            }
        }
        assert!(!open, "{path}: a block is not closed");
        Page { path: path.to_owned(), text, blocks }
    }

    /// Its lines outside of blocks, each with its number from 1.
    pub fn prose(&self) -> impl Iterator<Item = (usize, &str)> {
        let mut open = false;
        self.text.lines().enumerate().filter_map(move |(number, line)| {
            let fence = line.starts_with(FENCE);
            let outside = !open && !fence;
            open ^= fence;
            outside.then_some((number + 1, line))
        })
    }

    /// The listing that follows a block: the next block, if only blank lines stand between.
    pub fn listing(&self, number: usize) -> Option<&Block> {
        let (block, next) = (self.blocks.get(number)?, self.blocks.get(number + 1)?);
        let end = block.line + block.text.lines().count() + 1;
        let mut between = self.text.lines().skip(end).take(next.line - 1 - end);
        (next.language == "text" && between.all(|line| line.trim().is_empty())).then_some(next)
    }

    /// The anchors of its headings, as they are made on the web.
    pub fn anchors(&self) -> Vec<String> {
        let headings = self.prose().filter(|(_, line)| line.starts_with('#'));
        headings.map(|(_, line)| anchor(line.trim_start_matches('#').trim())).collect()
    }

    /// Targets of its links, each with the number of its line.
    pub fn links(&self) -> Vec<(usize, &str)> {
        let mut found = Vec::new();
        for (number, line) in self.prose() {
            for rest in line.split("](").skip(1) {
                if let Some((target, _)) = rest.split_once(')') {
                    found.push((number, target));
                }
            }
        }
        found
    }
}

/// The anchor of a heading: small letters, digits, `-` and `_`, with `-` for blanks.
pub fn anchor(heading: &str) -> String {
    heading
        .to_lowercase()
        .chars()
        .filter_map(|sign| match sign {
            ' ' => Some('-'),
            sign if sign.is_alphanumeric() || sign == '-' || sign == '_' => Some(sign),
            _ => None,
        })
        .collect()
}
