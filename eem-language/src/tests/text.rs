//! Models as texts against the derive: messages, places, programs.

mod cases;
mod drawing;
mod item;
mod limits;
mod mutated;
mod words;
mod zoo;
