//! One axis: evenly divided, or by powers of ten.
//!
//! A logarithmic axis has the decimal logarithm for its coordinate, so that everything which is
//! drawn along straight lines, and clipped, stays straight.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::coord::types::RangedCoordf64;

use super::Axes;
use super::ticks;

/// Up to this many decades the numbers between powers of ten are written, too, and none as a power.
const FEW_DECADES: f64 = 3.0;

/// How one axis is divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scale {
    Even,
    Logarithmic,
    /// Evenly, with numbers at whole ones only.
    Whole,
}

impl Scale {
    /// The scales of the horizontal and the vertical axis.
    pub(super) const fn of(axes: Axes) -> [Self; 2] {
        match axes {
            Axes::Even | Axes::Map | Axes::Named => [Self::Even, Self::Even],
            Axes::Logarithmic | Axes::NamedLogarithmic => [Self::Even, Self::Logarithmic],
            Axes::Counted => [Self::Whole, Self::Even],
            Axes::LogarithmicAcross => [Self::Logarithmic, Self::Even],
            Axes::DoublyLogarithmic => [Self::Logarithmic, Self::Logarithmic],
        }
    }

    /// Where a value lies along the axis; no finite place for what a logarithm cannot show.
    pub(super) fn place(self, value: f64) -> f64 {
        match self {
            Self::Even | Self::Whole => value,
            Self::Logarithmic => value.log10(),
        }
    }
}

/// An axis over a range of places.
#[derive(Clone)]
pub(super) struct Axis {
    scale: Scale,
    range: Range<f64>,
    places: RangedCoordf64,
}

impl Axis {
    pub(super) fn new(scale: Scale, range: Range<f64>) -> Self {
        let places = range.clone().into();
        Self {
            scale,
            range,
            places,
        }
    }

    fn is_short(&self) -> bool {
        self.range.end - self.range.start <= FEW_DECADES
    }

    /// The places of the numbers at a logarithmic axis: at most `most` of them.
    fn decades(&self, most: usize) -> Vec<f64> {
        let Range { start, end } = self.range;
        let digits: &[f64] = if self.is_short() {
            &[1.0, 2.0, 5.0]
        } else {
            &[1.0]
        };
        let (mut places, mut decade) = (Vec::new(), start.floor());
        while decade <= end {
            places.extend(digits.iter().map(|digit| decade + digit.log10()));
            decade += 1.0;
        }
        places.retain(|place| (start..=end).contains(place));
        thinned(places, most)
    }

    /// The whole numbers within the range: at most `most` of them.
    fn whole_numbers(&self, most: usize) -> Vec<f64> {
        let (mut places, mut next) = (Vec::new(), self.range.start.ceil());
        while next <= self.range.end {
            places.push(next);
            next += 1.0;
        }
        thinned(places, most)
    }
}

/// Every n-th of the places, so that at most `most` are left.
fn thinned(places: Vec<f64>, most: usize) -> Vec<f64> {
    let every = places.len().div_ceil(most.max(1)).max(1);
    places.into_iter().step_by(every).collect()
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, place: &f64, pixels: (i32, i32)) -> i32 {
        self.places.map(place, pixels)
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        match self.scale {
            Scale::Even => self.places.key_points(hint),
            Scale::Logarithmic => self.decades(hint.bold_points()),
            Scale::Whole => self.whole_numbers(hint.bold_points()),
        }
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, place: &f64) -> String {
        match self.scale {
            Scale::Even => ticks::even(&self.range, *place),
            Scale::Logarithmic => ticks::logarithmic(*place, self.is_short()),
            Scale::Whole => place.to_string(),
        }
    }
}
