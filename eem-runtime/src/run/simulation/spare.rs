//! What a run leaves to the next one of an ensemble: memory, and the places of unknowns.

use super::start::{initial_state, write_initial_state};
use super::stepper::Newton;
use crate::element::conduction::Conduction;
use crate::element::layout::{Layout, Shape};
use crate::element::masses::Masses;
use crate::element::state::State;
use crate::scene::Scene;
use crate::scene::error::SceneError;
use crate::step::scheme::Scheme;
use crate::step::solver::Effort;
use eem_material::number::compact::compact;

/// The parts of a run that one of a similar scene begins with.
///
/// Numbers are written anew, so that the bits are those of a run without it.
pub(crate) struct Spare<const D: usize> {
    pub(super) scheme: Scheme,
    pub(super) has_weight: bool,
    pub(super) masses: Masses,
    pub(super) conduction: Conduction,
    pub(super) places: Vec<[u32; 2]>,
    pub(super) shapes: Vec<Shape>,
    pub(super) newton: Box<Newton<D>>,
    pub(super) effort: Effort,
    pub(super) state: Box<State>,
    pub(super) next: Box<State>,
}

/// What a run begins with, new or from a spare.
pub(super) struct Basis<const D: usize> {
    pub(super) places: Vec<[u32; 2]>,
    pub(super) shapes: Vec<Shape>,
    pub(super) newton: Option<Box<Newton<D>>>,
    pub(super) effort: Effort,
    /// The initial state, without entropies.
    pub(super) state: Box<State>,
    /// Used memory for the next one.
    pub(super) next: Option<Box<State>>,
}

impl<const D: usize> Basis<D> {
    pub(super) fn new(
        scene: &Scene<D>,
        scheme: Scheme,
        (layout, conduction): (&Layout, &Conduction),
        step: f64,
        spare: Option<Spare<D>>,
    ) -> Result<Self, Vec<SceneError>> {
        if let Some(mut spare) = spare.filter(|spare| spare.fits(scene, scheme, conduction)) {
            write_initial_state(scene, layout, Some(step), &mut spare.state)?;
            return Ok(Self {
                places: spare.places,
                shapes: spare.shapes,
                newton: Some(spare.newton),
                effort: spare.effort.renewed(),
                state: spare.state,
                next: Some(spare.next),
            });
        }
        let places = (scene.elements.iter()).map(|entry| [entry.group, entry.place].map(compact));
        Ok(Self {
            places: places.collect(),
            shapes: scene.groups.iter().map(|group| group.shape()).collect(),
            newton: None,
            effort: Effort::new(),
            state: Box::new(initial_state(scene, layout, Some(step))?),
            next: None,
        })
    }
}

/// A copy of a state, in used memory if there is some.
pub(super) fn copy(state: &State, used: Option<Box<State>>) -> Box<State> {
    let Some(mut copy) = used else {
        return Box::new(state.clone());
    };
    copy.copy_all_from(state);
    copy
}

impl<const D: usize> Spare<D> {
    /// Whether a scene with these paths of heat, stepped by this scheme, differs from that of the run in numbers only.
    pub(super) fn fits(&self, scene: &Scene<D>, scheme: Scheme, conduction: &Conduction) -> bool {
        let masses = scene.nodes.iter().map(|node| node.mass.is_some());
        let shapes = scene.groups.iter().map(|group| group.shape());
        let mut elements = scene.elements.iter().zip(&self.places);
        scheme == self.scheme
            && scene.pairs.is_empty()
            && scene.loads.are_at_most_weight()
            && scene.loads.have_weight() == self.has_weight
            && masses.eq(self.masses.iter().map(|mass| mass.is_some()))
            && shapes.eq(self.shapes.iter().copied())
            && scene.elements.len() == self.places.len()
            && elements.all(|(entry, &[group, place])| {
                let nodes = self.newton.groups[group as usize].elements();
                let nodes = nodes.nodes(place as usize).iter().copied();
                [entry.group, entry.place].map(compact) == [group, place]
                    && nodes.eq(entry.nodes.iter().map(|&node| compact(node)))
            })
            && conduction.joins_like(&self.conduction)
    }
}
