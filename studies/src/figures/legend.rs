//! Where the entries of the legend go: rows above the chart, so that it never covers a curve.
//!
//! No font is measured (none may be needed): the width of a text is estimated.

/// A legend takes at most this part of the height of a picture.
const PART: i32 = 5;

/// Sizes of the legend, the largest first.
const SIZES: [Size; 4] = [Size::of(28), Size::of(24), Size::of(20), Size::of(16)];

/// How large a legend is written, in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Size {
    pub(super) font: i32,
    /// Height of one row.
    pub(super) row: i32,
    /// Length of the sample of a line.
    pub(super) sample: i32,
    /// Distance between a sample and its text.
    pub(super) gap: i32,
    /// Distance between a text and the next sample.
    between: i32,
}

impl Size {
    const fn of(font: i32) -> Self {
        Self {
            font,
            row: font * 23 / 14,
            sample: font * 45 / 14,
            gap: font / 2,
            between: font * 10 / 7,
        }
    }
}

/// Mean width of a character as a share of the font's size, in tenths: 0.53 to 0.60 in the
/// usual sans-serif fonts.
const CHARACTER_TENTHS: i32 = 6;

/// The largest size in which the legend takes no more than its part of the picture, and the places
/// of its entries.
pub(super) fn layout(labels: &[&str], [width, height]: [i32; 2]) -> (Size, Vec<(i32, i32)>) {
    let fits = |size: &Size| {
        let places = places(labels, width, *size);
        let rows = places.last().map_or(0, |&(_, y)| y + size.row);
        PART * rows <= height
    };
    let size = SIZES
        .into_iter()
        .find(fits)
        .unwrap_or(SIZES[SIZES.len() - 1]);
    (size, places(labels, width, size))
}

/// Upper left corner (x, y) of every entry, relative to the legend's; rows are filled in order
/// and centred in `width` pixels.
fn places(labels: &[&str], width: i32, size: Size) -> Vec<(i32, i32)> {
    let widths: Vec<i32> = labels
        .iter()
        .map(|label| entry_width(label, size))
        .collect();
    let mut places = Vec::new();
    let mut rest = widths.as_slice();
    let mut y = 0;
    while !rest.is_empty() {
        let (row, row_width) = first_row(rest, width - 2 * size.between, size.between);
        let mut x = (width - row_width) / 2;
        for entry in &rest[..row] {
            places.push((x, y));
            x += entry + size.between;
        }
        rest = &rest[row..];
        y += size.row;
    }
    places
}

/// How many entries fit into the first row, at least one, and how wide they are together.
fn first_row(entries: &[i32], width: i32, between: i32) -> (usize, i32) {
    let (mut count, mut used) = (1, entries[0]);
    for entry in &entries[1..] {
        if used + between + entry > width {
            break;
        }
        used += between + entry;
        count += 1;
    }
    (count, used)
}

fn entry_width(label: &str, size: Size) -> i32 {
    let characters = i32::try_from(label.chars().count()).unwrap_or(i32::from(i16::MAX));
    size.sample + size.gap + text_width(characters, size.font)
}

/// The estimated width in pixels of so many characters.
pub(super) const fn text_width(characters: i32, font: i32) -> i32 {
    characters * font * CHARACTER_TENTHS / 10
}
