//! The connected components of a scene: masses and elements joined by springs or by paths of heat.
//!
//! Anchors and reservoirs join nothing. Energy and momenta of each component have targets of their own, so
//! that nothing is moved between bodies that do not touch.

use core::ops::Range;
use std::collections::BTreeMap;

use super::guard::PerWeight;
use crate::algebra::vector;
use crate::element::conduction::{Conduction, Partner};
use crate::element::ends::Ends;
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
        let is_free = self.support == Support::Free;
        vector(|axis| {
            if is_free {
                linear[axis] / self.mass
            } else {
                0.0
            }
        })
    }
}

/// A path of heat.
#[derive(Clone, Copy, Debug)]
pub(super) struct Path {
    /// The thermal slots at both ends; reservoirs are numbered after all thermal slots.
    pub(super) ends: [u32; 2],
    /// The indices of their temperatures among the internal variables.
    pub(super) places: [u32; 2],
    pub(super) component: u32,
    /// Its first link in the list of all.
    pub(super) link: u32,
    /// For a reservoir, which of the [shares](Components::shares) receives its entropy.
    pub(super) share: Option<u32>,
    /// κ, W/K.
    pub(super) conductance: f64,
    /// The temperatures of both ends at the stages with weights, K.
    pub(super) temperatures: [PerWeight; 2],
}

impl Path {
    /// Its [`ends`](Self::ends) as indices.
    #[inline]
    pub(super) fn slots(&self) -> [usize; 2] {
        [self.ends[0] as usize, self.ends[1] as usize]
    }
}

/// The entropy that a reservoir receives from a component.
#[derive(Clone, Copy, Debug)]
pub(super) struct Share {
    pub(super) component: u32,
    pub(super) reservoir: u32,
}

/// All components of a scene; in each list, the entries of one component are consecutive.
#[derive(Clone, Debug)]
pub(super) struct Components {
    pub(super) all: Vec<Component>,
    /// The node of the scene at each place: first the masses of the first component, then those of the next; after all
    /// masses the anchors, once per component that they hold.
    pub(super) nodes: Vec<u32>,
    /// The component of each place.
    pub(super) of_place: Vec<u32>,
    /// Number of masses.
    pub(super) masses: usize,
    pub(super) slots: Vec<u32>,
    pub(super) paths: Vec<Path>,
    pub(super) shares: Vec<Share>,
    /// The component of each element.
    pub(super) of_element: Vec<u32>,
    pub(super) dashpots: Vec<Dashpot>,
    /// The element of each thermal slot.
    pub(super) elements: Vec<u32>,
}

/// A dashpot.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dashpot {
    pub(super) component: u32,
    /// The thermal slot of its element; without temperature its heat leaves the scene.
    pub(super) slot: Option<u32>,
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
    /// The components of a scene.
    pub(super) fn new(
        masses: &Masses,
        elements: &Ends,
        layout: &Layout,
        conduction: &Conduction,
    ) -> Self {
        let nodes = masses.len();
        let mut slot_elements = vec![0; layout.thermal];
        let thermal = layout.elements.iter().enumerate();
        for (element, slots) in thermal {
            if let Some(slot) = slots.thermal {
                slot_elements[slot] = compact(element);
            }
        }
        let mut sets = Sets((0..nodes + elements.len()).collect());
        for (element, ends) in elements.iter().enumerate() {
            for node in ends.iter().map(|&node| node as usize) {
                if masses.get(node).is_some() {
                    sets.merge(node, nodes + element);
                }
            }
        }
        let element_of = |slot: usize| nodes + slot_elements[slot] as usize;
        for slot in 0..layout.thermal {
            for link in conduction.links(slot) {
                if let Partner::Slot(partner) = link.partner {
                    sets.merge(element_of(slot), element_of(partner));
                }
            }
        }
        let (numbers, count) = numbered(&mut sets, masses, nodes);
        let mut components = Self {
            all: Vec::with_capacity(count),
            nodes: Vec::new(),
            of_place: Vec::new(),
            masses: 0,
            slots: Vec::new(),
            paths: Vec::new(),
            shares: Vec::new(),
            dashpots: dashpots(layout, &numbers[nodes..]),
            of_element: numbers[nodes..].to_vec(),
            elements: slot_elements,
        };
        components.place_masses(&numbers, count, masses);
        components.fill(conduction);
        components.place_anchors(masses, elements);
        components
    }

    /// A function that finds the place of a node from a component and the node.
    pub(super) fn place_of(&self) -> impl Fn(u32, u32) -> u32 + use<> {
        let owners = self
            .of_place
            .iter()
            .copied()
            .zip(self.nodes.iter().copied());
        let places: BTreeMap<_, _> = owners.zip(0..).collect();
        move |component, node| places[&(component, node)]
    }

    /// The mass at each place, zero for anchors, kg.
    pub(super) fn masses_of(&self, masses: &Masses) -> Vec<f64> {
        let nodes = self.nodes.iter();
        nodes
            .map(|&node| masses.get(node as usize).unwrap_or(0.0))
            .collect()
    }

    /// Whether an element with a dashpot has no temperature, so that the heat leaves the scene.
    pub(super) fn loses_heat(&self) -> bool {
        self.dashpots.iter().any(|dashpot| dashpot.slot.is_none())
    }

    /// The places of an anchor.
    pub(super) fn anchors_of(&self, node: usize) -> Vec<usize> {
        let places = self.masses..self.nodes.len();
        places
            .filter(|&place| self.nodes[place] as usize == node)
            .collect()
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

    /// Gives the masses their places, component after component.
    fn place_masses(&mut self, numbers: &[u32], count: usize, masses: &Masses) {
        let mut own = vec![Vec::new(); count];
        for (node, mass) in masses.iter().enumerate() {
            if let Some(mass) = mass {
                own[numbers[node] as usize].push((compact(node), mass));
            }
        }
        for (component, own) in own.into_iter().enumerate() {
            let start = self.nodes.len();
            let [mut mass, mut products] = [0.0; 2];
            for (node, own) in own {
                self.nodes.push(node);
                self.of_place.push(compact(component));
                mass += own;
                products += 1.0 + own.recip();
            }
            self.all.push(Component {
                masses: start..self.nodes.len(),
                slots: 0..0,
                paths: 0..0,
                shares: 0..0,
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

    /// Lists thermal slots and paths of heat, component after component.
    fn fill(&mut self, conduction: &Conduction) {
        let mut own = vec![Vec::new(); self.all.len()];
        for (slot, &element) in self.elements.iter().enumerate() {
            own[self.of_element[element as usize] as usize].push(compact(slot));
        }
        for (component, own) in own.into_iter().enumerate() {
            let starts = [self.slots.len(), self.paths.len(), self.shares.len()];
            for slot in own {
                self.slots.push(slot);
                self.add_paths(component, slot, conduction);
            }
            self.all[component].slots = starts[0]..self.slots.len();
            self.all[component].paths = starts[1]..self.paths.len();
            self.all[component].shares = starts[2]..self.shares.len();
        }
    }

    /// Gives each anchor a place for every component that it holds.
    fn place_anchors(&mut self, masses: &Masses, elements: &Ends) {
        let mut places = BTreeMap::<_, u32>::new();
        for (element, ends) in elements.iter().enumerate() {
            let component = self.of_element[element];
            let is_anchor = |node: &&u32| masses.get(**node as usize).is_none();
            for &node in ends.iter().filter(is_anchor) {
                let key = (component, node);
                if places.contains_key(&key) {
                    continue;
                }
                let place = self.nodes.len();
                places.insert(key, compact(place));
                self.nodes.push(node);
                self.of_place.push(component);
                let support = &mut self.all[component as usize].support;
                *support = match *support {
                    Support::Free => Support::Anchor(place),
                    Support::Anchor(_) | Support::Several => Support::Several,
                };
            }
        }
    }

    /// Adds the paths that begin at a slot; each is linked at both ends, and added at the first one.
    fn add_paths(&mut self, component: usize, slot: u32, conduction: &Conduction) {
        let links = conduction.links(slot as usize).iter();
        for (link, place) in links.zip(conduction.first_link(slot as usize)..) {
            let (far, share) = match link.partner {
                Partner::Slot(partner) if partner < slot as usize => continue,
                Partner::Slot(partner) => (partner, None),
                Partner::Reservoir(reservoir) => {
                    let share = self.share(compact(component), compact(reservoir));
                    (self.elements.len() + reservoir, Some(share))
                }
            };
            let ends = [slot, compact(far)];
            // Temperatures are numbered after the stretches of all dashpots.
            let dashpots: u32 = compact(self.dashpots.len());
            self.paths.push(Path {
                component: compact(component),
                link: compact(place),
                ends,
                places: [dashpots + ends[0], dashpots + ends[1]],
                share,
                conductance: link.conductance,
                temperatures: [[1.0; _]; 2],
            });
        }
    }

    fn share(&mut self, component: u32, reservoir: u32) -> u32 {
        let own = self.shares.iter().rev();
        let mut own = own.take_while(|share| share.component == component);
        if let Some(back) = own.position(|share| share.reservoir == reservoir) {
            return compact(self.shares.len() - 1 - back);
        }
        self.shares.push(Share {
            component,
            reservoir,
        });
        compact(self.shares.len() - 1)
    }
}

/// Numbers the components in the order of their first members. Returns the number of each member, and their count.
fn numbered(sets: &mut Sets, masses: &Masses, nodes: usize) -> (Vec<u32>, usize) {
    let mut numbers = vec![0; sets.0.len()];
    let mut count = 0;
    for member in 0..sets.0.len() {
        let is_anchor = member < nodes && masses.get(member).is_none();
        if is_anchor {
            continue;
        }
        let first = sets.first(member);
        if first == member {
            numbers[member] = compact(count);
            count += 1;
        } else {
            numbers[member] = numbers[first];
        }
    }
    (numbers, count)
}

/// All dashpots, given the component of each element.
fn dashpots(layout: &Layout, components: &[u32]) -> Vec<Dashpot> {
    let mut all = Vec::with_capacity(layout.viscous);
    for (element, &component) in components.iter().enumerate() {
        let slot = layout.elements[element].thermal.map(compact);
        let next = layout.elements.get(element + 1);
        let end = next.map_or(layout.viscous, |next| next.viscous);
        all.resize(end, Dashpot { component, slot });
    }
    all
}
