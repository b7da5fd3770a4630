//! A scene whose dimension is known when the program runs, with the acts it was built by.

use std::sync::Arc;

use eem::typed::{Law, LawError};
use eem::{
    Element, Equilibrium, EquilibriumError, EquilibriumReport, HeatPartner, HeatPath,
    MemberFailure, Node, RefusedScene, Reservoir, Scene, SceneError, Scheme, Simulation,
};
use eem_springs::Springs;
use pyo3::prelude::*;

use crate::act::{Act, Course, Partner, Rest, Speed};
use crate::ensemble::{Plan, Rows};
use crate::error;
use crate::function::{Function, take_raised};
use crate::handle::{Counts, Lineage};
use crate::material::Material;
use crate::run::AnyRun;

/// The handles of the library, in the order of creation.
#[derive(Clone, Default)]
pub(crate) struct Parts {
    pub(crate) nodes: Vec<Node>,
    pub(crate) elements: Vec<Element>,
    pub(crate) reservoirs: Vec<Reservoir>,
    pub(crate) paths: Vec<HeatPath>,
    /// The number of dashpots in series of each element.
    pub(crate) dashpots: Vec<usize>,
    /// Whether each element has a temperature.
    pub(crate) thermal: Vec<bool>,
}

impl Parts {
    pub(crate) fn counts(&self) -> Counts {
        [
            self.nodes.len(),
            self.elements.len(),
            self.reservoirs.len(),
            self.paths.len(),
        ]
    }
}

/// What acts refer to.
#[derive(Clone, Default)]
pub(crate) struct Context {
    pub(crate) laws: Vec<Law>,
    pub(crate) functions: Vec<Function>,
}

/// Why an act was refused.
pub(crate) enum Refusal {
    Law(LawError),
    Rest(EquilibriumError),
}

impl From<LawError> for Refusal {
    fn from(error: LawError) -> Self {
        Self::Law(error)
    }
}

/// A scene of any dimension.
pub(crate) trait AnyScene: Send + Sync {
    fn parts(&self) -> &Parts;
    fn errors(&self) -> &[SceneError];
    fn apply(&mut self, act: &Act, context: &Context) -> Result<(), Refusal>;
    fn find_rest(&mut self, rest: Rest) -> Result<EquilibriumReport, EquilibriumError>;
    fn duplicate(&self) -> Box<dyn AnyScene>;
    fn start(&self, scheme: Scheme, step: f64) -> Result<Box<dyn AnyRun>, Vec<SceneError>>;
    fn run_members(&self, plan: &Plan<'_>) -> Vec<Result<Rows, MemberFailure>>;
}

/// A scene and its handles.
#[derive(Clone)]
pub(crate) struct Built<const D: usize> {
    pub(crate) scene: Scene<D>,
    pub(crate) parts: Parts,
}

impl<const D: usize> Built<D>
where
    Scene<D>: Springs,
{
    fn new() -> Self {
        Self {
            scene: Scene::new(),
            parts: Parts::default(),
        }
    }

    /// The scene that these acts make.
    pub(crate) fn of(acts: &[Act], context: &Context) -> Result<Self, Refusal> {
        let mut built = Self::new();
        for act in acts {
            built.act(act, context)?;
        }
        Ok(built)
    }

    fn act(&mut self, act: &Act, context: &Context) -> Result<(), Refusal> {
        let Self { scene, parts } = self;
        match act {
            Act::Anchors { positions } => {
                let positions = vectors(positions);
                parts
                    .nodes
                    .extend(positions.map(|position| scene.anchor(position)));
            }
            Act::Masses {
                masses,
                positions,
                speed,
            } => {
                let first = parts.nodes.len();
                for (&mass, position) in masses.iter().zip(vectors(positions)) {
                    parts.nodes.push(scene.mass(mass, position, [0.0; D]));
                }
                let new = parts.nodes[first..].iter();
                match speed {
                    Speed::Zero => {}
                    Speed::Velocities(all) => {
                        new.zip(vectors(all))
                            .for_each(|(&node, v)| scene.set_velocity(node, v));
                    }
                    Speed::Momenta(all) => {
                        new.zip(vectors(all))
                            .for_each(|(&node, p)| scene.set_momentum(node, p));
                    }
                }
            }
            Act::Springs { material, .. } => return self.springs(act, &context.laws[*material]),
            Act::Temperatures { elements, values } => {
                for (&element, &value) in elements.iter().zip(values) {
                    scene.set_temperature(parts.elements[element], value);
                }
            }
            Act::Reservoirs { temperatures } => {
                let new = temperatures.iter().map(|&value| scene.reservoir(value));
                parts.reservoirs.extend(new);
            }
            Act::Oven { function } => {
                let function = context.functions[*function].clone();
                parts
                    .reservoirs
                    .push(scene.oven(move |time| function.number(time)));
            }
            Act::Paths {
                elements,
                partners,
                conductances,
            } => {
                let ends = elements.iter().zip(partners).zip(conductances);
                parts
                    .paths
                    .extend(ends.map(|((&element, partner), &conductance)| {
                        let partner: HeatPartner = match *partner {
                            Partner::Element(other) => parts.elements[other].into(),
                            Partner::Reservoir(other) => parts.reservoirs[other].into(),
                        };
                        scene.conduct(parts.elements[element], partner, conductance)
                    }));
            }
            Act::Start { time } => scene.start_at(*time),
            Act::Rest(rest) => {
                self.rest(*rest).map_err(Refusal::Rest)?;
            }
            Act::Gravity { .. }
            | Act::Force { .. }
            | Act::Rocket { .. }
            | Act::Motion { .. }
            | Act::Thermostat { .. } => self.load(act, context),
        }
        Ok(())
    }

    fn springs(&mut self, act: &Act, law: &Law) -> Result<(), Refusal> {
        let Act::Springs {
            pairs,
            temperatures,
            viscous_stretches,
            ..
        } = act
        else {
            return Ok(());
        };
        let Self { scene, parts } = self;
        let dashpots = dashpots(law);
        let is_thermal = law.compiled().model().temperature.is_some();
        for (index, &[first, second]) in pairs.iter().enumerate() {
            let nodes = [parts.nodes[first], parts.nodes[second]];
            let element = scene.add_spring(law, nodes)?;
            if let Some(&temperature) = temperatures.get(index) {
                scene.set_temperature(element, temperature);
            }
            if !viscous_stretches.is_empty() {
                let own = &viscous_stretches[dashpots * index..dashpots * (index + 1)];
                for (dashpot, &stretch) in own.iter().enumerate() {
                    scene.set_viscous_stretch(element, dashpot, stretch);
                }
            }
            parts.elements.push(element);
            parts.dashpots.push(dashpots);
            parts.thermal.push(is_thermal);
        }
        Ok(())
    }

    fn load(&mut self, act: &Act, context: &Context) {
        let Self { scene, parts } = self;
        let function = |index: &usize| context.functions[*index].clone();
        match act {
            Act::Gravity { gravity } => scene.set_gravity(one(gravity)),
            Act::Force { nodes, force } => {
                for &node in nodes {
                    let node = parts.nodes[node];
                    match force {
                        Course::Constant(force) => scene.dead_load(node, one(force)),
                        Course::Function(index) => {
                            let function = function(index);
                            scene.force(node, move |time| function.vector(time));
                        }
                    }
                }
            }
            Act::Rocket { nodes, thrust } => {
                let [node, tail, head] = nodes.map(|node| parts.nodes[node]);
                match thrust {
                    Course::Constant(thrust) => {
                        let [thrust] = one(thrust);
                        scene.rocket(node, [tail, head], move |_| thrust);
                    }
                    Course::Function(index) => {
                        let function = function(index);
                        scene.rocket(node, [tail, head], move |time| function.number(time));
                    }
                }
            }
            Act::Motion {
                anchor,
                function: index,
            } => {
                let function = function(index);
                scene.move_anchor(parts.nodes[*anchor], move |time| function.vector(time));
            }
            Act::Thermostat {
                element,
                temperature,
            } => {
                let element = parts.elements[*element];
                match temperature {
                    Course::Constant(value) => {
                        let [value] = one(value);
                        scene.hold_temperature(element, value);
                    }
                    Course::Function(index) => {
                        let function = function(index);
                        scene.prescribe_temperature(element, move |time| function.number(time));
                    }
                }
            }
            _ => {}
        }
    }

    fn rest(&mut self, rest: Rest) -> Result<EquilibriumReport, EquilibriumError> {
        let mut settings = Equilibrium::new().load_steps(rest.load_steps);
        if rest.held {
            settings = settings.held();
        }
        if rest.thermal_balance {
            settings = settings.thermal_balance();
        }
        self.scene.equilibrium(settings)
    }
}

impl<const D: usize> AnyScene for Built<D>
where
    Scene<D>: Springs,
{
    fn parts(&self) -> &Parts {
        &self.parts
    }

    fn errors(&self) -> &[SceneError] {
        self.scene.errors()
    }

    fn apply(&mut self, act: &Act, context: &Context) -> Result<(), Refusal> {
        self.act(act, context)
    }

    fn find_rest(&mut self, rest: Rest) -> Result<EquilibriumReport, EquilibriumError> {
        self.rest(rest)
    }

    fn duplicate(&self) -> Box<dyn AnyScene> {
        Box::new(self.clone())
    }

    fn start(&self, scheme: Scheme, step: f64) -> Result<Box<dyn AnyRun>, Vec<SceneError>> {
        let run = Simulation::new(self.scene.clone(), scheme, step);
        let refused = |refused: RefusedScene<D>| refused.errors().to_vec();
        Ok(Box::new(run.map_err(refused)?))
    }

    fn run_members(&self, plan: &Plan<'_>) -> Vec<Result<Rows, MemberFailure>> {
        plan.run::<D>()
    }
}

/// The number of dashpots in series.
pub(crate) fn dashpots(law: &Law) -> usize {
    law.compiled().model().dashpots.len()
}

/// The vectors that stand one after the other.
fn vectors<const D: usize>(values: &[f64]) -> impl Iterator<Item = [f64; D]> {
    values.as_chunks().0.iter().copied()
}

fn one<const D: usize>(values: &[f64]) -> [f64; D] {
    vectors(values).next().unwrap_or([f64::NAN; D])
}

/// A scene, what it was built by, and whose handles it knows.
pub(crate) struct World {
    pub(crate) dim: usize,
    pub(crate) acts: Arc<Vec<Act>>,
    pub(crate) context: Context,
    /// The materials of the laws of the context, in its order.
    pub(crate) materials: Vec<Arc<Py<Material>>>,
    pub(crate) lineage: Lineage,
    pub(crate) scene: Box<dyn AnyScene>,
}

impl World {
    pub(crate) fn new(dim: usize, lineage: Lineage) -> PyResult<Self> {
        let scene: Box<dyn AnyScene> = match dim {
            1 => Box::new(Built::<1>::new()),
            2 => Box::new(Built::<2>::new()),
            3 => Box::new(Built::<3>::new()),
            _ => return Err(error::scene(format!("dim is {dim}, it must be 1, 2 or 3"))),
        };
        Ok(Self {
            dim,
            acts: Arc::default(),
            context: Context::default(),
            materials: Vec::new(),
            lineage,
            scene,
        })
    }

    /// Does something to the scene; an error leaves it as it was.
    pub(crate) fn act(&mut self, act: Act) -> PyResult<()> {
        _ = take_raised();
        let applied = self.scene.apply(&act, &self.context);
        let wrong = match applied {
            Ok(()) => self.scene.errors().first().cloned().map(error::of_scene),
            Err(Refusal::Law(error)) => Some(error::law(error)),
            Err(Refusal::Rest(error)) => Some(error::equilibrium(error)),
        };
        let Some(wrong) = wrong else {
            Arc::make_mut(&mut self.acts).push(act);
            self.lineage.counts = self.scene.parts().counts();
            return Ok(());
        };
        self.rebuild()?;
        Err(take_raised().unwrap_or(wrong))
    }

    /// Builds the scene from its acts again.
    pub(crate) fn rebuild(&mut self) -> PyResult<()> {
        let empty = Self::new(self.dim, self.lineage.clone())?.scene;
        self.scene = empty;
        for act in self.acts.iter() {
            self.scene
                .apply(act, &self.context)
                .map_err(|refusal| match refusal {
                    Refusal::Law(error) => error::law(error),
                    Refusal::Rest(error) => error::equilibrium(error),
                })?;
        }
        Ok(())
    }

    /// Finds a state at rest, which leaves the scene unchanged if there is none.
    pub(crate) fn find_rest(&mut self, rest: Rest) -> PyResult<EquilibriumReport> {
        _ = take_raised();
        let found = self.scene.find_rest(rest);
        let report =
            found.map_err(|error| take_raised().unwrap_or_else(|| error::equilibrium(error)))?;
        Arc::make_mut(&mut self.acts).push(Act::Rest(rest));
        Ok(report)
    }

    /// A copy, whose scene has this lineage.
    pub(crate) fn copy(&self, lineage: Lineage) -> Self {
        Self {
            dim: self.dim,
            acts: Arc::clone(&self.acts),
            context: self.context.clone(),
            materials: self.materials.clone(),
            lineage,
            scene: self.scene.duplicate(),
        }
    }

    /// The index of a material, which is added if it is new.
    pub(crate) fn material(&mut self, material: &Bound<'_, Material>) -> usize {
        let same = |known: &Arc<Py<Material>>| known.is(material);
        self.materials.iter().position(same).unwrap_or_else(|| {
            self.materials.push(Arc::new(material.clone().unbind()));
            self.context.laws.push(material.get().law.clone());
            self.materials.len() - 1
        })
    }

    /// The index of a new function.
    pub(crate) fn function(&mut self, callable: &Bound<'_, PyAny>) -> usize {
        let callable = Arc::new(callable.clone().unbind());
        self.context.functions.push(Function(callable));
        self.context.functions.len() - 1
    }

    /// A start of a run.
    pub(crate) fn start(&self, scheme: Scheme, step: f64) -> PyResult<Box<dyn AnyRun>> {
        _ = take_raised();
        self.scene.start(scheme, step).map_err(|errors| {
            let all: Vec<_> = errors.iter().map(ToString::to_string).collect();
            let message = match &all[..] {
                [only] => only.clone(),
                all => {
                    let list: String = all.iter().map(|error| format!("\n- {error}")).collect();
                    format!("{} things are wrong with the scene:{list}", all.len())
                }
            };
            take_raised().unwrap_or_else(|| error::scenes(message, all))
        })
    }
}
