//! Calls of the program that pages show: the commands and their options exist.

use crate::page::Page;
use std::collections::BTreeMap;
use std::process::Command;

/// Calls on a page, each with the number of its line: lines of `sh` blocks, and code in prose.
fn calls(page: &Page) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for block in page.blocks.iter().filter(|block| block.language == "sh") {
        let lines = block.text.lines().enumerate();
        found.extend(lines.map(|(number, line)| (block.line + 1 + number, line.to_owned())));
    }
    for (number, line) in page.prose() {
        found.extend(line.split('`').skip(1).step_by(2).map(|code| (number, code.to_owned())));
    }
    found.retain(|(_, call)| call.starts_with("darzi "));
    found
}

/// What the program says of itself, by commands.
struct Helps(BTreeMap<String, Option<String>>);

impl Helps {
    /// The help of a command; none if there is no such command.
    fn of(&mut self, command: &str) -> Option<&str> {
        let help = self.0.entry(command.to_owned()).or_insert_with(|| {
            let mut call = Command::new(env!("CARGO_BIN_EXE_darzi"));
            let output = call.args(command.split(' ')).arg("--help").output().unwrap();
            output.status.success().then(|| String::from_utf8(output.stdout).unwrap())
        });
        help.as_deref()
    }
}

/// Calls whose command or option the program does not know.
pub fn unknown(pages: &[Page]) -> Vec<String> {
    let mut helps = Helps(BTreeMap::new());
    let mut wrong = Vec::new();
    for page in pages {
        for (line, call) in calls(page) {
            let place = format!("{}:{line}: `{call}`", page.path);
            let call = call.split(" #").next().unwrap_or(&call);
            let words: Vec<&str> = call.split_whitespace().collect();
            let mut command = words[1].to_owned();
            if command == "fabric" && words.len() > 2 {
                command = format!("fabric {}", words[2]);
            }
            let Some(help) = helps.of(&command) else {
                wrong.push(format!("{place}: there is no such command"));
                continue;
            };
            for option in words.iter().filter(|word| word.starts_with("--")) {
                let known =
                    help.split_whitespace().any(|word| word.trim_end_matches(',') == *option);
                if !known {
                    wrong.push(format!("{place}: `{command}` has no `{option}`"));
                }
            }
        }
    }
    wrong
}
