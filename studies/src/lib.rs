//! What the instruments share: free energies, and scenes for numbers of any type.

pub mod build;
pub mod models;
pub mod published;
