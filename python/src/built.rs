//! A scene of the library that is built by acts, with its handles.

use eem::typed::{Law, LawError};
use eem::{
    Bulk, Element, Equilibrium, EquilibriumError, EquilibriumReport, HeatPartner, HeatPath, Node,
    RefusedScene, Reservoir, Scene, SceneError, Scheme, Simulation, StudyReport,
};
use eem_gradients::Gradients;
use eem_solids::{Refused, Solids};
use pyo3::PyResult;

use crate::act::{self, Act, Course, Partner, Rest, Speed};
use crate::function::Function;
use crate::handle::Counts;
use crate::run::AnyRun;
use crate::setting::Pace;
use crate::study::Plan;

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
    /// The indices of their laws.
    pub(crate) laws: Vec<usize>,
    /// Whether each is a spring; the others are points of solids.
    pub(crate) springs: Vec<bool>,
}

impl Parts {
    /// Points of solids.
    pub(crate) fn points(&self) -> usize {
        self.springs.iter().filter(|&&is_spring| !is_spring).count()
    }

    fn element(&mut self, element: Element, index: usize, law: &Law) {
        let model = law.compiled().model();
        self.elements.push(element);
        self.dashpots.push(model.dashpots.len());
        self.thermal.push(model.temperature.is_some());
        self.laws.push(index);
        self.springs.push(law.compiled().strains().is_empty());
    }

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
    Solid(Refused),
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
    fn start(&self, scheme: Scheme, pace: Pace) -> Result<Box<dyn AnyRun>, Vec<SceneError>>;
    fn study(&self, plan: &Plan) -> PyResult<StudyReport>;
}

/// A scene and its handles.
#[derive(Clone)]
pub(crate) struct Built<const D: usize> {
    pub(crate) scene: Scene<D>,
    pub(crate) parts: Parts,
}

impl<const D: usize> Built<D>
where
    Scene<D>: Solids<D>,
{
    pub(crate) fn new() -> Self {
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
            Act::Springs { .. } => return self.springs(act, context),
            Act::Solid { .. } => return self.solid(act, context),
            Act::Fixed { nodes } => nodes.iter().for_each(|&node| scene.fix(parts.nodes[node])),
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
            Act::Stops { times } => scene.stop_at(times.iter().copied()),
            Act::ShortestLoad { duration } => scene.shortest_load(*duration),
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

    fn springs(&mut self, act: &Act, context: &Context) -> Result<(), Refusal> {
        let Act::Springs {
            material,
            pairs,
            temperatures,
            viscous_stretches,
        } = act
        else {
            return Ok(());
        };
        let Self { scene, parts } = self;
        let law = &context.laws[*material];
        law.check_spring()?;
        let dashpots = dashpots(law);
        for (index, &[first, second]) in pairs.iter().enumerate() {
            let nodes = [parts.nodes[first], parts.nodes[second]];
            let element = law.add_spring(scene, nodes)?;
            if let Some(&temperature) = temperatures.get(index) {
                scene.set_temperature(element, temperature);
            }
            if !viscous_stretches.is_empty() {
                let own = &viscous_stretches[dashpots * index..dashpots * (index + 1)];
                for (dashpot, &stretch) in own.iter().enumerate() {
                    scene.set_viscous_stretch(element, dashpot, stretch);
                }
            }
            parts.element(element, *material, law);
        }
        Ok(())
    }

    fn solid(&mut self, act: &Act, context: &Context) -> Result<(), Refusal> {
        let Act::Solid {
            material,
            positions,
            cells,
            bulk,
            velocities,
            temperatures,
        } = act
        else {
            return Ok(());
        };
        let Self { scene, parts } = self;
        let law = &context.laws[*material];
        let places = vectors(positions).collect();
        let section = (as_bulk(bulk), bulk.thickness);
        let (nodes, points) = scene
            .add_solid(law, places, cells, section)
            .map_err(Refusal::Solid)?;
        for (&node, velocity) in nodes.iter().zip(vectors(velocities)) {
            scene.set_velocity(node, velocity);
        }
        for (&point, &temperature) in points.iter().zip(temperatures) {
            scene.set_temperature(point, temperature);
        }
        parts.nodes.extend(nodes);
        for point in points {
            parts.element(point, *material, law);
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
    Scene<D>: Solids<D>,
    Simulation<D>: Gradients<D>,
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

    fn start(&self, scheme: Scheme, pace: Pace) -> Result<Box<dyn AnyRun>, Vec<SceneError>> {
        let scene = self.scene.clone();
        let run = match pace {
            Pace::Constant(step) | Pace::Controlled(step, _) => {
                Simulation::new(scene, scheme, step)
            }
            Pace::Free(tolerance) => Simulation::with_tolerance(scene, scheme, tolerance),
        };
        let mut run = run.map_err(|refused: RefusedScene<D>| refused.errors().to_vec())?;
        if let Pace::Controlled(_, tolerance) = pace {
            run.control_steps(tolerance).map_err(|error| vec![error])?;
        }
        Ok(Box::new(run))
    }

    fn study(&self, plan: &Plan) -> PyResult<StudyReport> {
        plan.run(&self.scene)
    }
}

/// The properties of a solid as the library takes them.
fn as_bulk<const D: usize>(given: &act::Bulk) -> Bulk<D> {
    let mut bulk = Bulk::new(given.density);
    if let Some(conductivity) = given.conductivity {
        bulk = bulk.conductivity(conductivity);
    }
    for fibre in vectors(&given.fibres) {
        bulk = bulk.fibre(fibre);
    }
    if given.lumped {
        bulk = bulk.lumped();
    }
    if given.allow_skew_cells {
        bulk = bulk.allow_skew_cells();
    }
    bulk
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
