//! Fourier conduction between elements and to reservoirs.

use crate::element::handle::{Element, HeatPartner};
use crate::element::layout::Layout;
use eem_material::number::compact::compact;
use eem_material::number::compensated::Compensated;

/// The far end of a path of heat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Partner {
    /// The element with this thermal slot.
    Slot(usize),
    /// The reservoir with this index.
    Reservoir(usize),
}

/// A path of heat, as stored at one of its elements.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link {
    pub(crate) partner: Partner,
    /// κ, W/K.
    pub(crate) conductance: f64,
}

/// A path of heat.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Conductor {
    pub(crate) element: Element,
    pub(crate) partner: HeatPartner,
    pub(crate) conductance: f64,
}

/// All paths of heat of a scene, sorted by thermal slot.
#[derive(Clone, Debug)]
pub(crate) struct Conduction {
    links: Vec<Link>,
    /// Where the links of each slot begin and end; empty for a scene without paths.
    ranges: Vec<[u32; 2]>,
    /// Of each path in the order of creation: its first link, which is that of the lower of two slots, and whether this link
    /// is at the second of the ends with which the path was created.
    paths: Vec<(u32, bool)>,
    /// The element of each thermal slot, and its Σ κ to elements and half that to reservoirs, W/K; empty for a scene without
    /// paths.
    owners: Vec<u32>,
    settling: Vec<f64>,
    /// `θ_r`, K.
    pub(crate) reservoirs: Vec<f64>,
}

impl Conduction {
    /// The paths of a scene.
    pub(crate) fn new(conductors: &[Conductor], reservoirs: Vec<f64>, layout: &Layout) -> Self {
        let slots = if conductors.is_empty() {
            0
        } else {
            layout.thermal
        };
        let slot = |index: usize| layout.elements[index].thermal;
        // Each path as its two ends see it: their slot, and their partner.
        let ends = |conductor: &Conductor| {
            let near = slot(conductor.element.index());
            match conductor.partner {
                HeatPartner::Reservoir(far) => {
                    [near.map(|near| (near, Partner::Reservoir(far.index))), None]
                }
                HeatPartner::Element(far) => {
                    let both = near.zip(slot(far.index()));
                    [
                        both.map(|(near, far)| (near, Partner::Slot(far))),
                        both.map(|(near, far)| (far, Partner::Slot(near))),
                    ]
                }
            }
        };
        let mut ranges = vec![[0; 2]; slots];
        for (slot, _) in conductors.iter().flat_map(ends).flatten() {
            ranges[slot][1] += 1;
        }
        let mut count = 0;
        for range in &mut ranges {
            let own = range[1];
            *range = [count; 2];
            count += own;
        }
        let nothing = Link {
            partner: Partner::Reservoir(0),
            conductance: 0.0,
        };
        let mut links = vec![nothing; count as usize];
        let mut paths = Vec::with_capacity(conductors.len());
        for conductor in conductors {
            let conductance = conductor.conductance;
            let ends = ends(conductor).map(|end| {
                end.map(|(slot, partner)| {
                    let [_, end] = &mut ranges[slot];
                    let link = *end;
                    links[link as usize] = Link {
                        partner,
                        conductance,
                    };
                    *end += 1;
                    (slot, link)
                })
            });
            paths.push(match ends {
                [Some((near, _)), Some((far, link))] if far < near => (link, true),
                [near, _] => (near.map_or(0, |(_, link)| link), false),
            });
        }
        let mut owners = vec![0; slots];
        for (element, element_slots) in layout.elements.iter().enumerate() {
            if let Some(owner) = element_slots.thermal.and_then(|slot| owners.get_mut(slot)) {
                *owner = compact(element);
            }
        }
        let mut conduction = Self {
            links,
            ranges,
            paths,
            owners,
            settling: Vec::new(),
            reservoirs,
        };
        let settling = (0..slots).map(|slot| {
            let mut sum = 0.0;
            for link in conduction.links(slot) {
                sum += match link.partner {
                    Partner::Slot(_) => link.conductance,
                    Partner::Reservoir(_) => 0.5 * link.conductance,
                };
            }
            sum
        });
        conduction.settling = settling.collect();
        conduction
    }

    /// Whether another scene has the same paths, whatever their conductances.
    pub(crate) fn joins_like(&self, other: &Self) -> bool {
        let partners = self.links.iter().map(|link| link.partner);
        self.ranges == other.ranges
            && self.reservoirs.len() == other.reservoirs.len()
            && partners.eq(other.links.iter().map(|link| link.partner))
    }

    /// Number of links.
    pub(crate) const fn count(&self) -> usize {
        self.links.len()
    }

    /// The first link of a path, and whether it is at the second of its ends.
    pub(crate) fn path(&self, index: usize) -> (usize, bool) {
        let (link, is_second) = self.paths[index];
        (link as usize, is_second)
    }

    /// The slot of the first link of each path, and its partner.
    #[cfg(feature = "gradients")]
    pub(crate) fn path_ends(&self) -> Vec<(usize, Partner)> {
        let slots = self.ranges.iter().enumerate();
        let of_links = slots.flat_map(|(slot, &[start, end])| (start..end).map(move |_| slot));
        let of_links: Vec<usize> = of_links.collect();
        let links = self.paths.iter().map(|&(link, _)| link as usize);
        links
            .map(|link| (of_links[link], self.links[link].partner))
            .collect()
    }

    /// The first link of a slot.
    #[inline]
    pub(crate) fn first_link(&self, slot: usize) -> usize {
        self.ranges
            .get(slot)
            .map_or(0, |&[start, _]| start as usize)
    }

    /// The paths that end at a slot.
    #[inline]
    pub(crate) fn links(&self, slot: usize) -> &[Link] {
        let Some(&[start, end]) = self.ranges.get(slot) else {
            return &[];
        };
        self.links
            .get(start as usize..end as usize)
            .unwrap_or_default()
    }

    /// The index of the element of a slot of a scene with paths.
    #[inline]
    pub(crate) fn owner(&self, slot: usize) -> usize {
        self.owners[slot] as usize
    }

    /// Σ κ of a slot to elements and half that to reservoirs, W/K. If it is at most `c/h` at every slot, the rates of the network are
    /// at most `2/h`, and a step by the mean temperature does not alternate.
    #[inline]
    pub(crate) fn settling(&self, slot: usize) -> f64 {
        self.settling.get(slot).copied().unwrap_or(0.0)
    }

    /// Whether a slot exchanges heat with reservoirs.
    pub(crate) fn meets_reservoirs(&self, slot: usize) -> bool {
        let mut links = self.links(slot).iter();
        links.any(|link| matches!(link.partner, Partner::Reservoir(_)))
    }

    /// Whether a slot exchanges heat with other slots.
    pub(crate) fn meets_slots(&self, slot: usize) -> bool {
        let mut links = self.links(slot).iter();
        links.any(|link| matches!(link.partner, Partner::Slot(_)))
    }

    /// The heat flow from reservoirs into a slot with the temperature θ, `Σ κ (θ_r − θ)`.
    #[inline]
    pub(crate) fn reservoir_flow(&self, slot: usize, theta: f64) -> HeatFlow {
        let mut flow = HeatFlow::none();
        for link in self.links(slot) {
            if let Partner::Reservoir(index) = link.partner {
                flow.conductance += link.conductance;
                flow.heat += link.conductance * (self.reservoirs[index] - theta);
            }
        }
        flow
    }

    /// The heat flow into a slot, `Σ κ (Θ_partner − Θ) + Σ κ (θ_r − θ)`.
    ///
    /// Flows between elements are computed from interface temperatures Θ at both ends, so that one end
    /// receives exactly what the other gives, whatever rounding does to a large κ; flows
    /// from reservoirs from the temperature θ of the slot.
    #[inline]
    pub(crate) fn heat_flow(&self, slot: usize, theta: f64, interface: &[f64]) -> HeatFlow {
        let mut flow = self.reservoir_flow(slot, theta);
        for link in self.links(slot) {
            if let Partner::Slot(partner) = link.partner {
                flow.heat += link.conductance * (interface[partner] - interface[slot]);
            }
        }
        flow
    }
}

/// The exchange and the production of a path of heat in a step, at one of its ends.
///
/// With the heat `Q = hκ D` that flows down the difference D of two temperatures, the entropy
///
/// ```text
/// u = Q/θ,     P = Q D/(θ (θ + D)) ≥ 0
/// ```
///
/// leaves one end and reaches the other, where P is produced. Both ends book the same u, and P has the
/// sign of D² to the last bit, so that the total entropy does not decrease even where D is far below the
/// rounding of the temperatures.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Exchange {
    /// Heat that this end receives, J.
    pub(crate) heat: f64,
    /// Entropy that this end receives, without what is produced, J/K.
    pub(crate) entropy: f64,
    /// D and θ, K.
    drop: f64,
    theta: f64,
}

impl Exchange {
    /// The end at the temperature θ of a path to one that is warmer by `drop`, K, with `hκ` in J/K.
    #[inline]
    fn at_cool_end(conducted: f64, drop: f64, theta: f64) -> Self {
        let heat = conducted * drop;
        Self {
            heat,
            entropy: heat / theta,
            drop,
            theta,
        }
    }

    /// P, J/K.
    #[inline]
    pub(crate) fn production(&self) -> f64 {
        // The heat at this end may have either sign.
        self.entropy.abs() * (self.drop.abs() / (self.theta + self.drop))
    }

    /// An element that is cooler by `drop` than a reservoir.
    #[inline]
    pub(crate) fn from_reservoir(conducted: f64, drop: f64, theta_r: f64) -> Self {
        Self::at_cool_end(conducted, -drop, theta_r).reversed()
    }

    /// The other end.
    #[inline]
    fn reversed(self) -> Self {
        Self {
            heat: -self.heat,
            entropy: -self.entropy,
            ..self
        }
    }
}

/// The interface temperatures Θ = θ* between which coupled elements exchange heat, per thermal slot, K.
///
/// Each is a compensated sum: where conduction is stiff, the heat `hκ(Θ_b − Θ_a)` needs more digits of
/// the difference than the temperatures have.
#[derive(Clone, Debug)]
pub(crate) struct InterfaceTemperatures(Compensated);

impl InterfaceTemperatures {
    /// Zeros, for this number of slots.
    pub(crate) fn new(slots: usize) -> Self {
        Self(Compensated::new(vec![0.0; slots]))
    }

    /// Their values, without compensations.
    #[inline]
    pub(crate) fn values(&self) -> &[f64] {
        self.0.values()
    }

    /// Sets one, without compensation.
    #[inline]
    pub(crate) fn set(&mut self, slot: usize, theta: f64) {
        self.0.set(slot, theta);
    }

    /// Adds to one.
    #[inline]
    pub(crate) fn add(&mut self, slot: usize, change: f64) {
        self.0.add(slot, change);
    }

    /// `Θ_far − Θ_near`, K.
    #[inline]
    pub(crate) fn drop(&self, near: usize, far: usize) -> f64 {
        self.0.sum(far).change(self.0.sum(near))
    }

    /// The exchange at a slot with another one in a step, given `hκ`, J/K. At both ends it is computed from the lower
    /// slot, so that u is the same.
    #[inline]
    pub(crate) fn exchange(&self, conducted: f64, slot: usize, other: usize) -> Exchange {
        let first = slot.min(other);
        let drop = self.drop(first, slot.max(other));
        let path = Exchange::at_cool_end(conducted, drop, self.values()[first]);
        if slot == first { path } else { path.reversed() }
    }
}

/// The heat flow into a slot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HeatFlow {
    /// Q, W.
    pub(crate) heat: f64,
    /// `−∂Q/∂θ = Σ κ` to reservoirs, W/K.
    pub(crate) conductance: f64,
}

impl HeatFlow {
    /// Nothing flows.
    #[inline]
    pub(crate) fn none() -> Self {
        Self {
            heat: 0.0,
            conductance: 0.0,
        }
    }
}
