//! Warnings of forms that lose digits.

use crate::message::Message;

pub(crate) fn logarithm(text: &str) -> Message {
    Message::new(
        format!("`{text}` is inaccurate for small strains: adding 1 rounds their digits off"),
        "write `ln_1p(x)` for `ln(1 + x)`",
    )
}

pub(crate) fn difference(text: &str, help: &str) -> Message {
    Message::new(
        format!(
            "`{text}` is inaccurate for small strains: it subtracts numbers that are nearly equal"
        ),
        help,
    )
}
