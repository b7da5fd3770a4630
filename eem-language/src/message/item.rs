//! Messages about the item that carries the derive.

use super::Message;

pub(crate) fn enumeration() -> Message {
    Message::new(
        "a free energy belongs to a struct, and this is an `enum`",
        "derive `FreeEnergy` for one struct per material; a scene can mix materials",
    )
}

pub(crate) fn union() -> Message {
    Message::new(
        "a free energy belongs to a struct, and this is a `union`",
        "use a struct with one named field per parameter",
    )
}

pub(crate) fn tuple_struct() -> Message {
    Message::new(
        "the fields of a tuple struct have no names to use in the free energy",
        "name them: `{ pub stiffness: f64, pub rest_length: f64 }`",
    )
}
