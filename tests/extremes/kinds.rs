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

#[cfg(test)]
mod tests {
    use super::super::tally::Effort;

    /// Every family of a kind keeps the laws, or is refused, and keeps what it claims beside.
    fn assert(name: &str) {
        let kind = super::ALL.iter().find(|kind| kind.name == name).unwrap();
        for family in kind.families {
            family(Effort::Short).assert();
        }
    }

    #[test]
    fn steps_of_any_size_keep_the_laws_or_are_refused() {
        assert("steps");
    }

    #[test]
    fn rest_and_uniform_motion_stay_and_tangents_are_exact_there() {
        assert("rest");
    }

    #[test]
    fn ratios_of_stiffness_mass_and_viscosity_keep_the_laws() {
        assert("stiffness");
    }

    #[test]
    fn temperatures_conductances_and_capacities_keep_the_laws() {
        assert("heat");
    }

    #[test]
    fn lengths_of_any_size_keep_the_laws_or_are_refused() {
        assert("lengths");
    }

    #[test]
    fn energies_that_are_not_convex_are_lawful_or_refused() {
        assert("phases");
    }

    #[test]
    fn long_runs_keep_the_laws() {
        assert("long");
    }

    #[test]
    fn units_do_not_matter() {
        assert("units");
    }

    #[test]
    fn random_scenes_are_lawful_or_refused() {
        assert("scenes");
    }

    #[test]
    fn runs_have_the_same_bits_again_and_after_restoring() {
        assert("bits");
    }
}
