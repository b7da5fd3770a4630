//! Symbolic mathematics.
