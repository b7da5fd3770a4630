//! How curves are told apart, also without colour: each has its own colour, dash and marker.

use plotters::style::RGBColor;

/// Colour, dash and marker of a curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look {
    pub(super) colour: RGBColor,
    /// Width of the line in pixels.
    pub(super) width: u32,
    pub(super) dash: Dash,
    pub(super) marker: Marker,
}

/// Lengths in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Dash {
    Solid,
    Dashed {
        length: u32,
        gap: u32,
    },
    /// Markers only.
    None,
    /// The area that the line encloses.
    Filled,
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Marker {
    None,
    Plus,
    Cross,
    Triangle,
    Diamond,
    Square,
    Circle,
    Dot,
}

/// A line of a marker, relative to the marked point, in pixels.
type Stroke = &'static [(i32, i32)];

impl Marker {
    /// The lines that draw the marker.
    pub(super) fn strokes(self) -> &'static [Stroke] {
        match self {
            Self::None => &[],
            Self::Plus => &[&[(-9, 0), (9, 0)], &[(0, -9), (0, 9)]],
            Self::Cross => &[&[(-7, -7), (7, 7)], &[(-7, 7), (7, -7)]],
            Self::Triangle => &[&[(-8, 6), (8, 6), (0, -9), (-8, 6)]],
            Self::Diamond => &[&[(-9, 0), (0, 9), (9, 0), (0, -9), (-9, 0)]],
            Self::Circle => &[&[
                (10, 0),
                (9, 5),
                (5, 9),
                (0, 10),
                (-5, 9),
                (-9, 5),
                (-10, 0),
                (-9, -5),
                (-5, -9),
                (0, -10),
                (5, -9),
                (9, -5),
                (10, 0),
            ]],
            Self::Dot => &[&[(-2, -1), (2, -1), (2, 1), (-2, 1)]],
            Self::Square => &[&[(-7, -7), (7, -7), (7, 7), (-7, 7), (-7, -7)]],
        }
    }
}

const LONG: Dash = Dash::Dashed {
    length: 24,
    gap: 10,
};
const SHORT: Dash = Dash::Dashed { length: 10, gap: 8 };
const DOTS: Dash = Dash::Dashed { length: 3, gap: 8 };

/// The first look is the reference's, the last three are those of what is no scheme; the colours are those of Okabe & Ito (2008), which
/// colour-blind readers can tell apart.
const LOOKS: [Look; 18] = [
    look((0, 0, 0), Dash::Solid, Marker::None),
    look((0, 114, 178), Dash::Solid, Marker::Plus),
    look((213, 94, 0), LONG, Marker::Cross),
    look((0, 158, 115), SHORT, Marker::Triangle),
    look((204, 121, 167), Dash::Solid, Marker::Diamond),
    look((230, 159, 0), LONG, Marker::Square),
    look((86, 180, 233), SHORT, Marker::Plus),
    look((140, 80, 20), DOTS, Marker::Cross),
    look((110, 110, 110), LONG, Marker::Triangle),
    look((120, 60, 160), DOTS, Marker::Diamond),
    look((190, 170, 0), Dash::Solid, Marker::Triangle),
    look((0, 80, 60), LONG, Marker::Square),
    look((0, 60, 140), LONG, Marker::Square),
    look((160, 30, 30), SHORT, Marker::Diamond),
    look((40, 40, 40), DOTS, Marker::Plus),
    look((200, 0, 80), Dash::Solid, Marker::Square),
    look((40, 90, 220), LONG, Marker::Diamond),
    look((120, 120, 120), SHORT, Marker::Triangle),
];

const fn look((red, green, blue): (u8, u8, u8), dash: Dash, marker: Marker) -> Look {
    Look {
        colour: RGBColor(red, green, blue),
        width: 3,
        dash,
        marker,
    }
}

/// The look of a wide light band behind the curves.
pub const BAND: usize = usize::MAX;

/// The look of a light area that a curve goes around; all of it must be within the axes.
pub const AREA: usize = usize::MAX - 1;

const LIGHT_BAND: Look = Look {
    colour: RGBColor(215, 215, 215),
    width: 22,
    dash: Dash::Solid,
    marker: Marker::None,
};

/// Added to the index of a look: a wide line of its colour without dash and marker.
pub const BOLD: usize = 2000;

/// Added to the index of a look: its colour without dash and marker.
pub const PLAIN: usize = 3000;

/// Added to the index of a look: open circles of its colour, without a line.
pub const OPEN: usize = 1000;

/// Added to the index of a look: dots of its colour at every point, without a line.
pub const DOTTED: usize = 4000;

impl Look {
    /// The look of that index; indices beyond the last start again after the reference.
    pub(super) fn of(index: usize) -> Self {
        if index == BAND {
            return LIGHT_BAND;
        }
        if index == AREA {
            return Self {
                dash: Dash::Filled,
                ..LIGHT_BAND
            };
        }
        if index >= DOTTED {
            return Self {
                dash: Dash::None,
                marker: Marker::Dot,
                ..Self::of(index - DOTTED)
            };
        }
        if index >= PLAIN {
            return Self::of(index - PLAIN).plain();
        }
        if index >= BOLD {
            return Self {
                width: 9,
                ..Self::of(index - BOLD).plain()
            };
        }
        if index >= OPEN {
            return Self {
                dash: Dash::None,
                marker: Marker::Circle,
                ..Self::of(index - OPEN)
            };
        }
        if index < LOOKS.len() {
            return LOOKS[index];
        }
        LOOKS[1 + (index - 1) % (LOOKS.len() - 1)]
    }

    /// The same colour without dash and marker.
    pub(super) const fn plain(self) -> Self {
        Self {
            dash: Dash::Solid,
            marker: Marker::None,
            ..self
        }
    }
}
