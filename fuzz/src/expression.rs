//! Any text as a formula: the front end answers with an implementation or with messages.

use syn::DeriveInput;

/// Bytes beyond this are ignored: the parser of Rust itself needs stack for every level.
const LONGEST: usize = 600;
/// Deeper brackets are not tried, for the same reason.
const DEEPEST: usize = 40;

/// What formulas are made of, and what looks like it.
pub(crate) const WORDS: [&str; 96] = [
    "lambda",
    "gamma",
    "theta",
    "k",
    "c",
    "eta",
    "count",
    "x",
    "y",
    "psi",
    "stiffness",
    "lamda",
    "+",
    "-",
    "*",
    "/",
    "(",
    ")",
    ",",
    ";",
    "{",
    "}",
    ".",
    "=",
    "let x = ",
    "let y = ",
    "; ",
    "ln(",
    "exp(",
    "sqrt(",
    "diff(",
    "powi(",
    "powf(",
    "abs(",
    "tanh(",
    "atan(",
    "sin(",
    "cosh(",
    ".powi(2)",
    ".powi(-3)",
    ".powf(0.5)",
    ".powf(theta)",
    ".sqrt()",
    ".recip()",
    ".ln()",
    ".exp()",
    ".abs()",
    ".cbrt()",
    "0",
    "1",
    "2",
    "0.5",
    "1.0",
    "1e308",
    "1e-308",
    "1e400",
    "300",
    "3",
    "0.1",
    "123456789012345678901234567890",
    "1_000",
    "2f64",
    "0x10",
    "-1",
    "1 / 2",
    "theta_ref",
    "if ",
    "match ",
    "for ",
    "while ",
    "return ",
    "as f64",
    "&",
    "|",
    "|z| z",
    "^",
    "%",
    "!",
    "?",
    "[",
    "]",
    "::",
    "f64::consts::PI",
    "\"text\"",
    "'c'",
    "true",
    "self",
    ".k",
    "#[a]",
    "unsafe ",
    "const ",
    "vec![1]",
    "=> ",
    "..",
    "log(",
    "max(",
];

/// The first byte, and the text of at most so many others; if the first is odd they are numbers of [`WORDS`], or `other`.
pub(crate) fn decode(data: &[u8], most: usize, other: &str) -> Option<(u8, String)> {
    let (&kind, data) = data.split_first()?;
    let data = &data[..data.len().min(most)];
    if kind % 2 == 0 {
        return Some((kind, String::from_utf8_lossy(data).into_owned()));
    }
    let word = |&byte: &u8| WORDS.get(usize::from(byte)).copied().unwrap_or(other);
    Some((kind, data.iter().map(word).collect()))
}

/// A struct with the first line as its free energy and the second as the law of its dashpot. If
/// the first byte is odd, the bytes are numbers of [`WORDS`].
///
/// # Panics
///
/// If the front end does, if what it prints is not Rust, or not the same twice.
pub fn expression(data: &[u8]) {
    let Some((kind, text)) = decode(data, LONGEST, "\n") else {
        return;
    };
    if depth(&text) > DEEPEST {
        return;
    }
    let (energy, law) = text.split_once('\n').unwrap_or((&text, "eta"));
    let arguments = match kind / 2 % 3 {
        0 => "lambda: Stretch, gamma: Viscous, theta: Temperature",
        1 => "lambda: Stretch, gamma: Viscous",
        _ => "lambda: Stretch, theta: Temperature",
    };
    let item = format!(
        "#[free_energy(|{arguments}| {{ {energy} }})] #[viscosity(gamma = {law})]
         struct Model {{ k: f64, c: f64, eta: f64, theta_ref: f32, count: usize }}"
    );
    let Ok(input) = syn::parse_str::<DeriveInput>(&item) else {
        return;
    };
    let expansion = eem_language::derive(&input);
    let file = syn::parse2::<syn::File>(expansion.clone());
    assert!(
        file.is_ok(),
        "the expansion of `{item}` is not Rust: {expansion}"
    );
    let again = eem_language::derive(&input);
    assert_eq!(
        expansion.to_string(),
        again.to_string(),
        "two expansions of `{item}`"
    );
}

/// How deep brackets and signs are nested, at most.
fn depth(text: &str) -> usize {
    let (mut depth, mut deepest) = (0_usize, 0);
    for character in text.chars() {
        match character {
            '(' | '{' | '[' | '|' | '!' | '&' | '-' | '*' => depth += 1,
            ')' | '}' | ']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        deepest = deepest.max(depth);
    }
    deepest
}
