//! Saving a scheme by its name.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serializer};

use crate::step::scheme::Scheme;

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "the signature that `serde(with)` calls"
)]
pub(super) fn serialize<T: Serializer>(scheme: &Scheme, serializer: T) -> Result<T::Ok, T::Error> {
    serializer.serialize_str(scheme.name())
}

pub(super) fn deserialize<'de, T: Deserializer<'de>>(deserializer: T) -> Result<Scheme, T::Error> {
    let name = String::deserialize(deserializer)?;
    Scheme::from_name(&name)
        .ok_or_else(|| T::Error::custom(format_args!("there is no scheme `{name}`")))
}
