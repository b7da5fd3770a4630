//! A text of lines that keeps every bit: a name and its items per line.
//!
//! Numbers are the shortest decimals that are read as the same number. Every function writes the value `own` and returns it;
//! if `own` is `None`, it reads the value from the next line.

use core::fmt::{Display, Write};
use core::str::{FromStr, Lines};

use eem_material::number::compensated::{Compensated, Sum};

/// The number, from 1, of a line that is not as expected, and the name that it should have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Fault {
    pub(super) line: usize,
    pub(super) expected: &'static str,
}

/// What a function of the text returns.
pub(super) type Read<T> = Result<T, Fault>;

/// A text that is written or read.
pub(super) struct Text<'a> {
    written: String,
    lines: Lines<'a>,
    /// The number of the last line.
    number: usize,
}

impl<'a> Text<'a> {
    /// A text to write, or to read: `rest` follows after `number` lines.
    pub(super) fn new(rest: &'a str, number: usize) -> Self {
        Self {
            written: String::new(),
            lines: rest.lines(),
            number,
        }
    }

    /// All that has been written.
    pub(super) fn written(self) -> String {
        self.written
    }

    /// A line of so many items, of which `show` writes one, or of any number, of which `read` reads one.
    fn line(
        &mut self,
        name: &'static str,
        count: Option<usize>,
        show: &dyn Fn(usize, &mut String),
        read: &mut dyn FnMut(&str) -> Option<()>,
    ) -> Read<()> {
        self.number += 1;
        if let Some(count) = count {
            self.written.push_str(name);
            self.written.push(':');
            for index in 0..count {
                self.written.push(' ');
                show(index, &mut self.written);
            }
            self.written.push('\n');
            return Ok(());
        }
        let fault = self.fault(name);
        let line = self.lines.next().ok_or(fault)?;
        let items = line
            .strip_prefix(name)
            .and_then(|rest| rest.strip_prefix(':'));
        for item in items.ok_or(fault)?.split_ascii_whitespace() {
            read(item).ok_or(fault)?;
        }
        Ok(())
    }

    /// A line of items, written as `show` does.
    fn list<T: FromStr + Clone>(
        &mut self,
        name: &'static str,
        own: Option<&[T]>,
        show: fn(&T, &mut String),
    ) -> Read<Vec<T>> {
        let mut items = own.unwrap_or_default().to_vec();
        let mut found = Vec::new();
        let count = own.map(<[T]>::len);
        self.line(
            name,
            count,
            &|at, text| show(&items[at], text),
            &mut |item| {
                found.push(item.parse().ok()?);
                Some(())
            },
        )?;
        items.append(&mut found);
        Ok(items)
    }

    /// A list of numbers.
    pub(super) fn numbers(&mut self, name: &'static str, own: Option<&[f64]>) -> Read<Vec<f64>> {
        // Writing to a string does not fail.
        self.list(name, own, |number, text| _ = write!(text, "{number:?}"))
    }

    /// N numbers.
    pub(super) fn array<const N: usize>(
        &mut self,
        name: &'static str,
        own: Option<[f64; N]>,
    ) -> Read<[f64; N]> {
        let numbers = self.numbers(name, own.as_ref().map(|own| &own[..]))?;
        numbers.try_into().map_err(|_| self.fault(name))
    }

    /// One number.
    pub(super) fn number(&mut self, name: &'static str, own: Option<f64>) -> Read<f64> {
        let [number] = self.array(name, own.map(|own| [own]))?;
        Ok(number)
    }

    /// N numbers or none.
    pub(super) fn few<const N: usize>(
        &mut self,
        name: &'static str,
        own: Option<&Option<[f64; N]>>,
    ) -> Read<Option<[f64; N]>> {
        let own = own.map(|own| own.as_ref().map_or(&[][..], |own| &own[..]));
        let numbers = self.numbers(name, own)?;
        if numbers.is_empty() {
            return Ok(None);
        }
        numbers.try_into().map(Some).map_err(|_| self.fault(name))
    }

    /// Items without blanks: counts, words, digests.
    pub(super) fn items<T: Display + FromStr + Clone>(
        &mut self,
        name: &'static str,
        own: Option<&[T]>,
    ) -> Read<Vec<T>> {
        self.list(name, own, |item, text| _ = write!(text, "{item}"))
    }

    /// One such item.
    pub(super) fn item<T: Display + FromStr + Clone>(
        &mut self,
        name: &'static str,
        own: Option<T>,
    ) -> Read<T> {
        let own = own.map(|own| [own]);
        let items = self.items(name, own.as_ref().map(|own| &own[..]))?;
        let items: Result<[T; 1], _> = items.try_into();
        items.map(|[item]| item).map_err(|_| self.fault(name))
    }

    /// A part that may be absent.
    pub(super) fn part<T>(
        &mut self,
        name: &'static str,
        own: Option<&Option<T>>,
        pass: impl FnOnce(&mut Self, Option<&T>) -> Read<T>,
    ) -> Read<Option<T>> {
        let is_there = self.item(name, own.map(Option::is_some))?;
        let own = own.and_then(Option::as_ref);
        is_there.then(|| pass(self, own)).transpose()
    }

    /// A sum and its compensation.
    pub(super) fn sum(&mut self, name: &'static str, own: Option<Sum>) -> Read<Sum> {
        let [value, carry] = self.array(name, own.map(|own| [own.value, own.carry]))?;
        Ok(Sum { value, carry })
    }

    /// Sums, and their compensations in the next line.
    pub(super) fn sums(
        &mut self,
        names: [&'static str; 2],
        own: Option<&Compensated>,
    ) -> Read<Compensated> {
        let carries: Option<Vec<f64>> = own.map(|own| own.sums().map(|(_, carry)| carry).collect());
        let values = self.numbers(names[0], own.map(Compensated::values))?;
        let carries = self.numbers(names[1], carries.as_deref())?;
        Compensated::of(values, carries).ok_or_else(|| self.fault(names[1]))
    }

    /// Pairs of a value and its compensation.
    pub(super) fn pairs(&mut self, name: &'static str, own: Option<&[Sum]>) -> Read<Vec<Sum>> {
        let numbers = self.numbers(name, own.map(flat).as_deref())?;
        let (pairs, []) = numbers.as_chunks::<2>() else {
            return Err(self.fault(name));
        };
        let pairs = pairs.iter();
        Ok(pairs.map(|&[value, carry]| Sum { value, carry }).collect())
    }

    /// The fault that the last line is not as expected.
    pub(super) const fn fault(&self, expected: &'static str) -> Fault {
        let line = self.number;
        Fault { line, expected }
    }
}

/// The values of sums, each with its compensation behind it.
pub(super) fn flat(sums: &[Sum]) -> Vec<f64> {
    let mut numbers = Vec::with_capacity(2 * sums.len());
    for sum in sums {
        numbers.extend([sum.value, sum.carry]);
    }
    numbers
}
