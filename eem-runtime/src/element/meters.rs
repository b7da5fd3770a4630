//! Heat of dashpots, entropy production of elements and heat of paths: sums per dashpot, element and path, kept from the
//! time at which they are switched on.

use crate::element::conduction::Exchange;
use eem_material::number::compensated::{Compensated, Sum};

/// Sums since the meters were switched on; empty before.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[derive(Default)]
pub(crate) struct Meters {
    pub(crate) are_on: bool,
    /// The heat of each dashpot in series, then per element that of the dashpots in parallel, J.
    pub(crate) dissipated: Compensated,
    /// The entropy that dashpots and paths of heat have produced, per thermal slot, J/K.
    pub(crate) produced: Compensated,
    /// The heat that each path has brought to its first thermal slot, by the index of its link there, J.
    pub(crate) conducted: Compensated,
}

impl Meters {
    /// Sums of zero, for these numbers of entries.
    pub(crate) fn new(counts: [usize; 3]) -> Self {
        let [dissipated, produced, conducted] =
            counts.map(|count| Compensated::new(vec![0.0; count]));
        Self {
            are_on: true,
            dissipated,
            produced,
            conducted,
        }
    }

    /// The numbers of entries.
    pub(crate) fn counts(&self) -> [usize; 3] {
        [&self.dissipated, &self.produced, &self.conducted].map(|sums| sums.values().len())
    }

    /// Adds heat of a dashpot, J.
    #[inline]
    pub(crate) fn dissipate(&mut self, dashpot: usize, heat: f64) {
        if self.are_on {
            self.dissipated.add(dashpot, heat);
        }
    }

    /// Adds entropy that is produced at a thermal slot, J/K.
    #[inline]
    pub(crate) fn produce(&mut self, slot: usize, entropy: f64) {
        if self.are_on {
            self.produced.add(slot, entropy);
        }
    }

    /// Adds entropy that a path of heat between two thermal slots produces, J/K: half at each.
    #[inline]
    pub(crate) fn produce_between(&mut self, slots: [usize; 2], entropy: f64) {
        if self.are_on {
            for slot in slots {
                self.produced.add(slot, 0.5 * entropy);
            }
        }
    }

    /// Adds a path between two slots, as booked at the first of them, where it has this link.
    #[cold]
    pub(crate) fn see_path(&mut self, [slot, other]: [usize; 2], link: usize, path: &Exchange) {
        if slot > other {
            self.produce_between([slot, other], path.production());
        } else {
            self.conduct(link, path.heat);
        }
    }

    /// Adds a path from a slot to a reservoir.
    #[cold]
    pub(crate) fn see_path_outside(&mut self, slot: usize, link: usize, path: &Exchange) {
        self.produce(slot, path.production());
        self.conduct(link, path.heat);
    }

    /// Adds heat that a path brings to its first slot, J.
    #[inline]
    pub(crate) fn conduct(&mut self, path: usize, heat: f64) {
        if self.are_on {
            self.conducted.add(path, heat);
        }
    }

    /// Copies the meters of a state of the same scene.
    #[inline]
    pub(crate) fn copy_from(&mut self, other: &Self) {
        if self.are_on || other.are_on {
            self.copy_kept(other);
        }
    }

    #[cold]
    fn copy_kept(&mut self, other: &Self) {
        if self.are_on && other.are_on {
            self.dissipated.copy_from(&other.dissipated);
            self.produced.copy_from(&other.produced);
            self.conducted.copy_from(&other.conducted);
        } else {
            self.clone_from(other);
        }
    }
}

/// Adds sums to a sum.
pub(crate) fn total(sums: impl Iterator<Item = Sum>) -> Sum {
    sums.fold(Sum::new(0.0), |mut total, sum| {
        total.add(sum.value);
        total.add(sum.carry);
        total
    })
}
