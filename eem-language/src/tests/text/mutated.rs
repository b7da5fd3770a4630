//! Texts of the zoo with random changes: right or wrong, there is an answer, and its places are in the texts.

use std::time::Instant;

use super::zoo;
use crate::text::{Compiled, Fault, Faults, Part, Source, compile};
use answers::check_answer;

#[path = "../../../../fuzz/src/answers.rs"]
mod answers;

/// What is put in: words of the language, and what looks like them.
const WORDS: [&str; 48] = [
    "lambda",
    "theta",
    "gamma",
    "k",
    "x",
    "(",
    ")",
    "{",
    "}",
    "[",
    "]",
    "|",
    ",",
    ";",
    ":",
    "=",
    ".",
    "..",
    "+",
    "-",
    "*",
    "/",
    "^",
    "&",
    "!",
    "?",
    "#",
    "'",
    "\"",
    "//",
    "/*",
    "let ",
    "if ",
    "ln(",
    "exp(",
    ".powi(2)",
    ".powf(",
    "diff(",
    "1e308",
    "1e-400",
    "0",
    "2f32",
    "PI",
    ": Stretch",
    ": Viscous",
    "J/K",
    "ψ",
    "\u{0}",
];

/// Random numbers by `SplitMix64`.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, most: usize) -> usize {
        usize::try_from(self.next() % u64::try_from(most.max(1)).unwrap_or(1)).unwrap_or(0)
    }

    /// A range of characters, most often a short one.
    fn range(&mut self, text: &[char]) -> [usize; 2] {
        let start = self.below(text.len() + 1);
        let longest = if self.below(4) == 0 { 60 } else { 4 };
        [start, text.len().min(start + self.below(longest))]
    }
}

/// One text changed at one place.
fn change(random: &mut Random, text: &str, other: &str) -> String {
    let letters: Vec<char> = text.chars().collect();
    let [start, end] = random.range(&letters);
    let other: Vec<char> = other.chars().collect();
    let [from, to] = random.range(&other);
    let [before, middle, behind] =
        [&letters[..start], &letters[start..end], &letters[end..]].map(String::from_iter);
    let word = WORDS[random.below(WORDS.len())];
    match random.below(6) {
        0 => before + &behind,
        1 => before + &middle.repeat(1 + random.below(4)) + &behind,
        2 => before + word + &behind,
        3 => before + word + &middle + &behind,
        4 => before + &String::from_iter(&other[from..to]) + &behind,
        _ => before + &middle.chars().rev().collect::<String>() + &behind,
    }
}

/// Some of its texts changed, with pieces of another source.
fn mutate(random: &mut Random, source: &Source, other: &Source) -> Source {
    let mut texts = vec![source.free_energy().to_owned()];
    texts.extend(
        source
            .viscosities()
            .flat_map(|(name, law)| [name.to_owned(), law.to_owned()]),
    );
    let laws = texts.len();
    let unit = |unit: Option<&str>| unit.unwrap_or_default().to_owned();
    texts.extend(
        source
            .parameters()
            .flat_map(|(name, of)| [name.to_owned(), unit(of)]),
    );
    // Half of the texts have one change, so that some are right.
    for _ in 0..=random.below(3) * random.below(2) {
        // Half of the changes are in ψ.
        let part = random.below(2 * texts.len()) % texts.len() * random.below(2);
        texts[part] = change(random, &texts[part], other.free_energy());
    }
    let pair = |pair: &[String]| (pair[0].clone(), pair[1].clone());
    let viscosities = texts[1..laws].chunks(2).map(pair);
    let parameters = texts[laws..].chunks(2).map(pair);
    let mutant = viscosities.fold(Source::new(&*texts[0]), |all, (name, law)| {
        all.viscosity(name, law)
    });
    parameters.fold(mutant, |all, (name, unit)| {
        all.parameter(name, Some(&*unit).filter(|unit| !unit.is_empty()))
    })
}

/// Answers so many texts, and returns how many of them were right.
fn answer(seed: u64, count: usize) -> usize {
    let sources = zoo::sources_of_all();
    let mut random = Random(seed);
    let mut right = 0;
    let start = Instant::now();
    for number in 1..=count {
        let [one, other] = [(); 2].map(|()| &sources[random.below(sources.len())]);
        let source = mutate(&mut random, one, other);
        let answer = compile(&source);
        right += usize::from(answer.is_ok());
        // Programs take a hundred times longer.
        let has_programs = answer.is_ok() && random.below(100) == 0;
        check_answer(&source, &answer, has_programs);
        if number % 100_000 == 0 {
            println!(
                "{number} texts, {right} of them right, {} s",
                start.elapsed().as_secs()
            );
        }
    }
    right
}

#[test]
fn changed_texts_are_answered() {
    let right = answer(1, 500);
    assert!(
        (100..400).contains(&right),
        "{right} of 500 texts are right"
    );
}

/// `EEM_TEXTS=10000000 cargo test --release -p eem-language more_changed -- --ignored --nocapture`
#[test]
#[ignore = "takes as long as one likes"]
fn more_changed_texts_are_answered() {
    let number = |name: &str| std::env::var(name).ok().and_then(|text| text.parse().ok());
    let [count, seed] = [
        number("EEM_TEXTS").unwrap_or(100_000),
        number("EEM_SEED").unwrap_or(2),
    ];
    answer(u64::try_from(seed).unwrap_or(2), count);
}
