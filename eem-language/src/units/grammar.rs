//! Reads the text of a unit; what can be read in two ways is refused.
//!
//! ```text
//! unit     = factor { separator factor } { "/" factor }
//! factor   = ( symbol | "1" | "(" unit ")" ) [ power ]
//! power    = "^" integer | "^(" integer [ "/" digits ] ")" | superscripts
//! separator = blanks | "*" | "·"
//! ```

use std::iter::Peekable;
use std::str::Chars;

use eem_symbolic::Rational;

use crate::message::Message;
use crate::message::unit as message;
use crate::unit::Unit;
use crate::unit::table;

/// No exponent in a unit is larger, so that units of fields are far from overflowing.
const LARGEST_EXPONENT: i64 = 99;

/// The unit that `text` describes, or why it describes none.
pub(crate) fn parse(text: &str) -> Result<Unit, Message> {
    let mut parser = Parser {
        text,
        chars: text.chars().peekable(),
    };
    parser.blanks();
    if parser.chars.peek().is_none() {
        return Err(message::empty());
    }
    let unit = parser.unit()?;
    match parser.chars.next() {
        None => Ok(unit),
        Some(')') => Err(message::parenthesis(text)),
        Some(other) => Err(message::unexpected(text, other)),
    }
}

struct Parser<'t> {
    text: &'t str,
    chars: Peekable<Chars<'t>>,
}

impl Parser<'_> {
    fn unit(&mut self) -> Result<Unit, Message> {
        let mut unit = self.factor()?;
        let mut divided = false;
        loop {
            let blank = self.blanks();
            match self.chars.peek() {
                Some('/') => {
                    self.chars.next();
                    self.blanks();
                    divided = true;
                    let divisor = self.factor()?;
                    unit = self.fits(unit.over(&divisor))?;
                    continue;
                }
                None | Some(')') => return Ok(unit),
                Some('*' | '·' | '⋅') => {
                    self.chars.next();
                    if self.chars.peek() == Some(&'*') {
                        return Err(message::power_stars(self.text));
                    }
                    self.blanks();
                }
                Some(_) if blank => {}
                // A character that does not belong to a symbol, or a factor after `)`.
                Some(&other) => return Err(message::unexpected(self.text, other)),
            }
            if divided {
                return Err(message::ambiguous_quotient(self.text));
            }
            let factor = self.factor()?;
            unit = self.fits(unit.times(&factor))?;
        }
    }

    fn factor(&mut self) -> Result<Unit, Message> {
        let atom = match self.chars.peek() {
            Some('(') => {
                self.chars.next();
                self.blanks();
                let unit = self.unit()?;
                if self.chars.next() != Some(')') {
                    return Err(message::parenthesis(self.text));
                }
                unit
            }
            Some(c) if c.is_ascii_digit() || *c == '.' => self.number()?,
            Some(&c) if is_symbol(c) => self.symbol()?,
            Some(&other) => return Err(message::unexpected(self.text, other)),
            None => return Err(message::unfinished(self.text)),
        };
        let exponent = self.power()?;
        self.fits(atom.power(exponent))
    }

    /// The only number in a unit is 1: `1`, `1/s`.
    fn number(&mut self) -> Result<Unit, Message> {
        let number = self.take(|c| c.is_ascii_digit() || c == '.');
        if number == "1" {
            return Ok(Unit::one());
        }
        Err(message::number(self.text, &number))
    }

    fn symbol(&mut self) -> Result<Unit, Message> {
        let symbol = self.take(|c| is_symbol(c) || c.is_ascii_digit());
        if self.chars.peek() == Some(&'-') {
            return Err(message::minus(self.text, &symbol));
        }
        table::lookup(&symbol).ok_or_else(|| message::unknown(&symbol, table::advice(&symbol)))
    }

    fn power(&mut self) -> Result<Rational, Message> {
        match self.chars.peek() {
            Some('^') => {
                self.chars.next();
            }
            Some(&c) if superscript(c).is_some() => {
                let digits = self.take(|c| superscript(c).is_some());
                let digits: String = digits.chars().filter_map(superscript).collect();
                return self.exponent(&digits, "1");
            }
            _ => return Ok(Rational::ONE),
        }
        if self.chars.next_if_eq(&'(').is_none() {
            let digits = self.take(|c| c.is_ascii_digit() || "+-−".contains(c));
            return self.exponent(&digits, "1");
        }
        let fraction = self.take(|c| c != ')');
        if self.chars.next().is_none() {
            return Err(message::parenthesis(self.text));
        }
        let (numerator, denominator) = fraction.split_once('/').unwrap_or((&fraction, "1"));
        self.exponent(numerator, denominator)
    }

    fn exponent(&self, numerator: &str, denominator: &str) -> Result<Rational, Message> {
        let integer = |text: &str| {
            let value: i64 = text.trim().replace('−', "-").parse().ok()?;
            (value.abs() <= LARGEST_EXPONENT).then_some(value)
        };
        let pair = integer(numerator).zip(integer(denominator));
        let exponent = pair.and_then(|(n, d)| Rational::new(n.into(), d.into()));
        exponent.ok_or_else(|| message::exponent(self.text, LARGEST_EXPONENT))
    }

    fn fits(&self, unit: Option<Unit>) -> Result<Unit, Message> {
        unit.ok_or_else(|| message::exponent(self.text, LARGEST_EXPONENT))
    }

    fn take(&mut self, belongs: impl Fn(char) -> bool) -> String {
        let mut taken = String::new();
        while let Some(c) = self.chars.next_if(|&c| belongs(c)) {
            taken.push(c);
        }
        taken
    }

    /// Skips blanks; whether there were any.
    fn blanks(&mut self) -> bool {
        let mut any = false;
        while self.chars.next_if(|c| c.is_whitespace()).is_some() {
            any = true;
        }
        any
    }
}

fn is_symbol(c: char) -> bool {
    c.is_alphabetic() || "°%".contains(c)
}

/// The character that a superscript raises.
fn superscript(c: char) -> Option<char> {
    Some(match c {
        '⁻' => '-',
        '⁰' => '0',
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        '⁴' => '4',
        '⁵' => '5',
        '⁶' => '6',
        '⁷' => '7',
        '⁸' => '8',
        '⁹' => '9',
        _ => return None,
    })
}
