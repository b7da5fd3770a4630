//! Warnings of forms that lose digits.

use crate::message::Message;

pub(crate) fn logarithm(text: &str) -> Message {
    Message::new(
        format!(
            "`{text}` loses the digits of small strains: they are lost in the 1 of its argument"
        ),
        "write `ln_1p(x)` for `ln(1 + x)`",
    )
}

pub(crate) fn difference(text: &str, help: &str) -> Message {
    Message::new(
        format!(
            "`{text}` loses the digits of small strains: it is a difference of what is nearly equal"
        ),
        help,
    )
}
