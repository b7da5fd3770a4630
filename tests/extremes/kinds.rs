//! The kinds of extremes by number, as they are named in the published table.

use super::tally::Family;
use super::{bits, heat, lengths, long, phases, rest, scenes, steps, stiffness, units};

/// A kind: its name, what it asks, and the families of runs that answer.
pub(crate) struct Kind {
    pub(crate) name: &'static str,
    pub(crate) question: &'static str,
    pub(crate) families: &'static [Family],
}

/// All of them, from 1.
pub(crate) const ALL: [Kind; 10] = [
    Kind {
        name: "steps",
        question: "Step sizes from 1e-12 to 1e6 s on the published cases, by all schemes",
        families: steps::FAMILIES,
    },
    Kind {
        name: "rest",
        question: "Rest, uniform motion, rigid rotation, equilibrium, increments of one ulp",
        families: rest::FAMILIES,
    },
    Kind {
        name: "stiffness",
        question: "Ratios of stiffness, mass and viscosity",
        families: stiffness::FAMILIES,
    },
    Kind {
        name: "heat",
        question: "Temperatures, conductances and heat capacities over many decades",
        families: heat::FAMILIES,
    },
    Kind {
        name: "lengths",
        question: "Stretches, ways past an anchor, lengths of any size",
        families: lengths::FAMILIES,
    },
    Kind {
        name: "phases",
        question: "Free energies that are not convex",
        families: phases::FAMILIES,
    },
    Kind {
        name: "long",
        question: "Many steps, and motions that return",
        families: long::FAMILIES,
    },
    Kind {
        name: "units",
        question: "One scene in other units",
        families: units::FAMILIES,
    },
    Kind {
        name: "scenes",
        question: "Scenes at random, and fresh steps of hot springs",
        families: scenes::FAMILIES,
    },
    Kind {
        name: "bits",
        question: "The same bits again",
        families: bits::FAMILIES,
    },
];
