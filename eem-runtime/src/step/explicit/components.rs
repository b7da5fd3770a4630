//! The connected components of a scene: masses and elements joined by springs or by paths of heat.
//!
//! Anchors and reservoirs join nothing. Energy and momenta of each component have targets of their own, so
//! that nothing is moved between bodies that do not touch.

use core::ops::Range;

use super::guard::PerWeight;
use crate::algebra::{ascending, vector};
use crate::element::conduction::{Conduction, Partner};
use crate::element::ends::Ends;
use crate::element::group::first_reservoir;
use crate::element::layout::Layout;
use crate::element::masses::Masses;
use crate::element::state::{Energy, State};
use eem_material::number::compact::compact;

/// The anchors of a component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Support {
    /// None: both momenta are conserved.
    Free,
    /// One anchor at this place, about which the angular momentum is conserved.
    Anchor(usize),
    /// Several: no momentum is conserved.
    Several,
}

/// A connected component.
#[derive(Clone, Debug)]
pub(super) struct Component {
    /// Its masses among the [places](Components::nodes), its thermal slots and its paths of heat in the
    /// lists of [`Components`].
    pub(super) masses: Range<usize>,
    pub(super) slots: Range<usize>,
    pub(super) paths: Range<usize>,
    /// Its [`shares`](Components::shares).
    pub(super) shares: Range<usize>,
    pub(super) support: Support,
    /// The mass of all its masses, kg.
    pub(super) mass: f64,
    /// `Σ (1 + 1/m)` of its masses, and one more for each element.
    pub(super) products: f64,
}

impl Component {
    /// The velocity of the centre of mass for a linear momentum, m/s; zero with an anchor.
    pub(super) fn velocity<const D: usize>(&self, linear: &[f64; D]) -> [f64; D] {
        if self.support != Support::Free {
            return [0.0; D];
        }
        vector(|axis| linear[axis] / self.mass)
    }
}

/// A path of heat.
#[derive(Clone, Copy, Debug)]
pub(super) struct Path {
    /// The thermal slots at both ends; reservoirs are numbered from [`first_reservoir`] on.
    pub(super) ends: [usize; 2],
    /// Whether each end stores entropy: neither reservoirs do, nor elements with a thermostat.
    pub(super) stores: [bool; 2],
    pub(super) component: usize,
    /// Its first link in the list of all.
    pub(super) link: usize,
    /// For a reservoir, which of the [shares](Components::shares) receives its entropy.
    pub(super) share: Option<usize>,
    /// κ, W/K.
    pub(super) conductance: f64,
    /// The temperatures of both ends at the stages with weights, K.
    pub(super) temperatures: [PerWeight; 2],
    /// Its production Π in the step, J/K.
    pub(super) production: f64,
}

/// The entropy that a reservoir receives from a component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Share {
    pub(super) component: usize,
    pub(super) reservoir: usize,
}

/// A dashpot.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dashpot {
    pub(super) component: usize,
    /// The thermal slot of its element; without temperature its heat leaves the scene.
    pub(super) slot: Option<usize>,
}

/// All components of a scene; in each list, the entries of one component are consecutive.
#[derive(Clone, Debug)]
pub(super) struct Components {
    pub(super) all: Vec<Component>,
    /// The node of the scene at each place: first the masses of the first component, then those of the next; after all
    /// masses the anchors, once per component that they hold.
    pub(super) nodes: Vec<usize>,
    /// The component of each place.
    pub(super) of_place: Vec<usize>,
    /// Number of masses.
    pub(super) masses: usize,
    pub(super) slots: Vec<usize>,
    pub(super) paths: Vec<Path>,
    pub(super) shares: Vec<Share>,
    /// The component of each element.
    pub(super) of_element: Vec<u32>,
    pub(super) dashpots: Vec<Dashpot>,
    /// The element of each thermal slot.
    pub(super) elements: Vec<usize>,
    /// See [`first_reservoir`].
    pub(super) first_reservoir: usize,
}

/// Disjoint sets that are merged: each member points to another one of its set, the first to itself.
struct Sets(Vec<usize>);

impl Sets {
    fn first(&mut self, mut of: usize) -> usize {
        while self.0[of] != of {
            // Path halving, for later calls.
            self.0[of] = self.0[self.0[of]];
            of = self.0[of];
        }
        of
    }

    fn merge(&mut self, one: usize, other: usize) {
        let [one, other] = [self.first(one), self.first(other)];
        self.0[one.max(other)] = one.min(other);
    }
}

impl Components {
    /// The components of a scene, and the places of the nodes of each element.
    pub(super) fn new(
        masses: &Masses,
        elements: &Ends,
        layout: &Layout,
        conduction: &Conduction,
    ) -> (Self, Ends) {
        let nodes = masses.len();
        let mut slot_elements = vec![0; layout.thermal];
        for (element, slots) in layout.elements.iter().enumerate() {
            if let Some(slot) = slots.thermal {
                slot_elements[slot] = element;
            }
        }
        let mut sets = Sets((0..nodes + elements.len()).collect());
        for element in 0..elements.len() {
            for &node in elements.of(element) {
                if masses.get(node as usize).is_some() {
                    sets.merge(node as usize, nodes + element);
                }
            }
        }
        for slot in 0..layout.thermal {
            for link in conduction.links(slot) {
                if let Partner::Slot(partner) = link.partner {
                    sets.merge(nodes + slot_elements[slot], nodes + slot_elements[partner]);
                }
            }
        }
        let (numbers, count) = numbered(&mut sets, masses, nodes);
        let mut of_element = Vec::with_capacity(elements.len());
        for &component in &numbers[nodes..] {
            of_element.push(compact(component));
        }
        let mut components = Self {
            all: Vec::with_capacity(count),
            nodes: Vec::new(),
            of_place: Vec::new(),
            masses: 0,
            slots: Vec::new(),
            paths: Vec::new(),
            shares: Vec::new(),
            dashpots: dashpots(layout, &numbers[nodes..]),
            of_element,
            elements: slot_elements,
            first_reservoir: first_reservoir(layout),
        };
        components.fill(&numbers, count, masses, conduction);
        let places = components.place_ends(masses, elements);
        (components, places)
    }

    /// The component of a thermal slot.
    pub(super) fn of_slot(&self, slot: usize) -> usize {
        self.of_element[self.elements[slot]] as usize
    }

    /// The dashpots of a component.
    pub(super) fn dashpots_of(&self, index: usize) -> impl Iterator<Item = usize> + '_ {
        let all = self.dashpots.iter().enumerate();
        all.filter_map(move |(dashpot, of)| (of.component == index).then_some(dashpot))
    }

    /// The energies of the elements of a component in a state.
    pub(super) fn energies_in<'a>(
        &'a self,
        state: &'a State,
        index: usize,
    ) -> impl Iterator<Item = &'a Energy> {
        let elements = self.of_element.iter().zip(&state.energies);
        let own = elements.filter(move |&(&component, _)| component as usize == index);
        own.map(|(_, energy)| energy)
    }

    /// Lists masses, thermal slots and paths of heat, component after component.
    fn fill(&mut self, numbers: &[usize], count: usize, masses: &Masses, conduction: &Conduction) {
        // Nodes, then slots.
        let mut own = vec![Vec::new(); 2 * count];
        for node in 0..masses.len() {
            if masses.get(node).is_some() {
                own[numbers[node]].push(node);
            }
        }
        for slot in 0..self.elements.len() {
            own[count + self.of_slot(slot)].push(slot);
        }
        for component in 0..count {
            let [mut mass, mut products] = [0.0; 2];
            let first = self.nodes.len();
            for &node in &own[component] {
                self.nodes.push(node);
                self.of_place.push(component);
                if let Some(own) = masses.get(node) {
                    mass += own;
                    products += 1.0 + own.recip();
                }
            }
            let starts = [self.slots.len(), self.paths.len(), self.shares.len()];
            for &slot in &own[count + component] {
                self.slots.push(slot);
                self.add_paths(component, slot, conduction);
            }
            self.all.push(Component {
                masses: first..self.nodes.len(),
                slots: starts[0]..self.slots.len(),
                paths: starts[1]..self.paths.len(),
                shares: starts[2]..self.shares.len(),
                support: Support::Free,
                mass,
                products,
            });
        }
        for &component in &self.of_element {
            self.all[component as usize].products += 1.0;
        }
        self.masses = self.nodes.len();
    }

    /// Gives each anchor a place for every component that it holds. Returns the places of the nodes of each element.
    fn place_ends(&mut self, masses: &Masses, elements: &Ends) -> Ends {
        let mut of_mass = vec![0; masses.len()];
        for (place, &node) in self.nodes.iter().enumerate() {
            of_mass[node] = place;
        }
        let mut held = Vec::new();
        for element in 0..elements.len() {
            for &node in elements.of(element) {
                if masses.get(node as usize).is_none() {
                    held.push([self.of_element[element] as usize, node as usize]);
                }
            }
        }
        let held = ascending(held);
        let mut of_held = vec![usize::MAX; held.len()];
        let mut places = Ends::none();
        for element in 0..elements.len() {
            let component = self.of_element[element] as usize;
            places.push(elements.of(element).iter().map(|&node| {
                let node = node as usize;
                if masses.get(node).is_some() {
                    return compact(of_mass[node]);
                }
                let pair = held.partition_point(|&pair| pair < [component, node]);
                if of_held[pair] == usize::MAX {
                    of_held[pair] = self.hold(component, node);
                }
                compact(of_held[pair])
            }));
        }
        places
    }

    /// Gives an anchor a place for a component; returns the place.
    fn hold(&mut self, component: usize, anchor: usize) -> usize {
        let place = self.nodes.len();
        self.nodes.push(anchor);
        self.of_place.push(component);
        let support = &mut self.all[component].support;
        *support = match *support {
            Support::Free => Support::Anchor(place),
            Support::Anchor(_) | Support::Several => Support::Several,
        };
        place
    }

    /// Adds the paths that begin at a slot; each is linked at both ends, and added at the first one.
    fn add_paths(&mut self, component: usize, slot: usize, conduction: &Conduction) {
        let first = conduction.first_link(slot);
        for (at, own) in conduction.links(slot).iter().enumerate() {
            let (far, share) = match own.partner {
                Partner::Slot(partner) if partner < slot => continue,
                Partner::Slot(partner) => (partner, None),
                Partner::Reservoir(reservoir) => {
                    let share = Share {
                        component,
                        reservoir,
                    };
                    (self.first_reservoir + reservoir, Some(self.index_of(share)))
                }
            };
            self.paths.push(Path {
                ends: [slot, far],
                stores: [true, share.is_none()],
                component,
                link: first + at,
                share,
                conductance: own.conductance,
                temperatures: [[1.0; _]; 2],
                production: 0.0,
            });
        }
    }

    /// The index of a share of the last component, which is added unless it is there.
    fn index_of(&mut self, share: Share) -> usize {
        for (index, other) in self.shares.iter().enumerate().rev() {
            if other.component != share.component {
                break;
            }
            if *other == share {
                return index;
            }
        }
        self.shares.push(share);
        self.shares.len() - 1
    }
}

/// Numbers the components in the order of their first members. Returns the number of each member, and their count.
fn numbered(sets: &mut Sets, masses: &Masses, nodes: usize) -> (Vec<usize>, usize) {
    let mut numbers = vec![0; sets.0.len()];
    let mut count = 0;
    for member in 0..sets.0.len() {
        let is_anchor = member < nodes && masses.get(member).is_none();
        if is_anchor {
            continue;
        }
        let first = sets.first(member);
        if first == member {
            numbers[member] = count;
            count += 1;
        } else {
            numbers[member] = numbers[first];
        }
    }
    (numbers, count)
}

/// All dashpots, given the component of each element.
fn dashpots(layout: &Layout, components: &[usize]) -> Vec<Dashpot> {
    let mut all = Vec::with_capacity(layout.viscous);
    for (element, &component) in components.iter().enumerate() {
        let slot = layout.elements[element].thermal;
        let next = layout.elements.get(element + 1);
        let end = next.map_or(layout.viscous, |next| next.viscous);
        all.resize(end, Dashpot { component, slot });
    }
    all
}
