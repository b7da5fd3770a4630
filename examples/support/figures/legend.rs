//! Where the entries of the legend go: rows above the chart, so that it never covers a curve.
//!
//! No font is measured (none may be needed): the width of a text is estimated.

/// Size of the legend's font in pixels.
pub(super) const FONT: i32 = 28;

/// Height of one row in pixels.
pub(super) const ROW: i32 = 46;

/// Length of the sample of the line in pixels.
pub(super) const SAMPLE: i32 = 90;

/// Distance between a sample and its text in pixels.
pub(super) const GAP: i32 = 14;

/// Distance between a text and the next sample in pixels.
const BETWEEN: i32 = 40;

/// Mean width of a character as a share of the font's size, in tenths: 0.53 to 0.60 in the
/// usual sans-serif fonts.
const CHARACTER_TENTHS: i32 = 6;

/// Upper left corner (x, y) of every entry, relative to the legend's; rows are filled in order
/// and centred in `width` pixels.
pub(super) fn places(labels: &[&str], width: i32) -> Vec<(i32, i32)> {
    let widths: Vec<i32> = labels.iter().map(|label| entry_width(label)).collect();
    let mut places = Vec::new();
    let mut rest = widths.as_slice();
    let mut y = 0;
    while !rest.is_empty() {
        let (row, row_width) = first_row(rest, width - 2 * BETWEEN);
        let mut x = (width - row_width) / 2;
        for entry in &rest[..row] {
            places.push((x, y));
            x += entry + BETWEEN;
        }
        rest = &rest[row..];
        y += ROW;
    }
    places
}

/// How many entries fit into the first row, at least one, and how wide they are together.
fn first_row(entries: &[i32], width: i32) -> (usize, i32) {
    let (mut count, mut used) = (1, entries[0]);
    for entry in &entries[1..] {
        if used + BETWEEN + entry > width {
            break;
        }
        used += BETWEEN + entry;
        count += 1;
    }
    (count, used)
}

fn entry_width(label: &str) -> i32 {
    let characters = i32::try_from(label.chars().count()).unwrap_or(i32::from(i16::MAX));
    SAMPLE + GAP + characters * FONT * CHARACTER_TENTHS / 10
}
