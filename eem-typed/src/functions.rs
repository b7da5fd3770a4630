//! All functions of a law as tapes, for one scalar.

mod by_parameters;
mod room;
mod staged;

use std::sync::{Arc, OnceLock};

use eem_language::text::Compiled;
use eem_material::{Caloric, Joint};
use eem_runtime::Strain;
use eem_symbolic::{Program, Programs, Value};

use crate::error::LawError;
use crate::names;
use crate::shape::{KEPT, Shape};
use crate::tape::Tape;
pub(crate) use by_parameters::{ByParameters, MOST_PARAMETERS};
use room::Room;
pub(crate) use staged::{Form, Staged};
use staged::{kept, of_state};

/// The functions of [`FreeEnergy`](eem_material::FreeEnergy).
#[derive(Debug)]
pub(crate) struct Functions {
    /// The name of the law, and the digest of its name and texts.
    pub(crate) name: &'static &'static str,
    pub(crate) kind: u64,
    /// Strains and joint invariants of a solid; empty for a spring.
    pub(crate) strains: Box<[Strain]>,
    pub(crate) joints: Box<[Joint]>,
    /// Dashpots in series, and in parallel.
    pub(crate) dashpots: usize,
    pub(crate) drags: usize,
    /// Where its numbers are in the arrays of its type, if that has room for more dashpots.
    room: Option<Room>,
    pub(crate) parameters: Box<[f64]>,
    pub(crate) has_constant_capacity: bool,
    pub(crate) free_energy: Tape,
    pub(crate) energy_magnitude: Tape,
    pub(crate) internal_energy: Tape,
    pub(crate) gradient: Tape,
    pub(crate) hessian: Tape,
    pub(crate) rates: Tape,
    pub(crate) caloric: Option<Tape>,
    pub(crate) entropy_hessian: Option<Tape>,
    pub(crate) viscosity: Option<Tape>,
    pub(crate) drag: Option<Tape>,
    pub(crate) caloric_at: Option<Staged>,
    /// `None` without a temperature.
    pub(crate) rates_at: Option<Staged>,
    /// Forces and ψ; `None` with a temperature.
    pub(crate) rates_of_state: Option<Tape>,
    pub(crate) entropy_form: Form,
    pub(crate) mixed_states: Option<Staged>,
    pub(crate) temperature_form: Option<Form>,
    compiled: Arc<Compiled>,
    /// Made at the first request; `None` if they cannot be made.
    by_parameters: OnceLock<Option<ByParameters>>,
}

impl Functions {
    /// The tapes of the programs of these texts of the shape `law`, for a type with the shape `all`.
    pub(crate) fn new(
        (name, kind): (&'static &'static str, u64),
        (strains, joints): (Box<[Strain]>, Box<[Joint]>),
        (compiled, programs): (&Arc<Compiled>, &Programs),
        parameters: Vec<f64>,
        [law, all]: [&Shape; 2],
    ) -> Result<Self, LawError> {
        let room = Room::new(law, all);
        let with_room = room.as_ref().map(|room| room.programs(programs));
        let programs = with_room.as_ref().unwrap_or(programs);
        let variables = all.variables();
        let responses = variables + usize::from(all.thermal);
        let of_state = |program: &Program| of_state(program, &parameters);
        let sometimes = |program: &Option<Program>| program.as_ref().map(of_state).transpose();
        let is_thermal = programs.caloric.is_some();
        let most = all.kept();
        let at_temperature = |program: &Program| {
            Staged::new(program, &parameters, variables - 1, &|kept| {
                kept.len() <= KEPT
            })
        };
        let caloric_at = programs.caloric_at.as_ref().map(at_temperature);
        let rates_at = is_thermal.then(|| at_temperature(&programs.rates_at));
        let (entropy_form, mixed_states) = {
            let form = &programs.entropy_form;
            let mut count = kept(form, &parameters).len();
            if let Some(mixed) = &programs.mixed_states {
                count += kept(mixed, &parameters).len();
            }
            let fits = |_: &[Value]| count <= most;
            let mixed = programs.mixed_states.as_ref();
            let mixed = mixed.map(|mixed| Staged::new(mixed, &parameters, variables, &fits));
            let form = Form::new(form, &parameters, [variables, responses], &fits)?;
            (form, mixed.transpose()?)
        };
        let temperature_form = programs.temperature_form.as_ref().map(|form| {
            let fits = |kept: &[Value]| kept.len() <= most;
            Form::new(form, &parameters, [variables, responses], &fits)
        });
        Ok(Self {
            name,
            kind,
            strains,
            joints,
            dashpots: law.dashpots,
            drags: law.drag,
            has_constant_capacity: programs.has_constant_capacity,
            free_energy: of_state(&programs.free_energy)?,
            energy_magnitude: of_state(&programs.energy_magnitude)?,
            internal_energy: of_state(&programs.internal_energy)?,
            gradient: of_state(&programs.gradient)?,
            hessian: of_state(&programs.hessian)?,
            rates: of_state(&programs.rates)?,
            caloric: sometimes(&programs.caloric)?,
            entropy_hessian: sometimes(&programs.entropy_hessian)?,
            viscosity: sometimes(&programs.viscosity)?,
            drag: sometimes(&programs.drag)?,
            caloric_at: caloric_at.transpose()?,
            rates_at: rates_at.transpose()?,
            rates_of_state: (!is_thermal)
                .then(|| of_state(&programs.rates_at))
                .transpose()?,
            entropy_form,
            mixed_states,
            temperature_form: temperature_form.transpose()?,
            room,
            parameters: parameters.into(),
            compiled: Arc::clone(compiled),
            by_parameters: OnceLock::new(),
        })
    }

    /// Whether there is a temperature.
    pub(crate) fn is_thermal(&self) -> bool {
        self.caloric.is_some()
    }

    /// Derivatives with respect to the parameters; `None` with too many parameters, too long formulas or too large factors.
    pub(crate) fn by_parameters(&self) -> Option<&ByParameters> {
        let make = || {
            if self.parameters.len() > MOST_PARAMETERS {
                return None;
            }
            let programs = self.compiled.parameter_programs().ok()?;
            let room = self.room.as_ref();
            let with_room =
                room.map(|room| room.parameter_programs(programs, self.parameters.len()));
            ByParameters::new(with_room.as_ref().unwrap_or(programs), &self.parameters).ok()
        };
        self.by_parameters.get_or_init(make).as_ref()
    }

    /// The strains of a solid at a point.
    pub(crate) fn strains_at_point<const M: usize>(&self) -> [Strain; M] {
        core::array::from_fn(|index| self.strains[index])
    }

    /// The entries of a direction for the parameters of this law.
    pub(crate) fn own<'a>(&self, direction: &'a [f64; MOST_PARAMETERS]) -> &'a [f64] {
        &direction[..self.parameters.len()]
    }

    /// A state of the law in the arrays of its type.
    pub(crate) fn spread(&self, x: &[f64]) -> Vec<f64> {
        let room = self.room.as_ref();
        room.map_or_else(|| x.to_vec(), |room| room.spread(x))
    }

    /// The numbers of the variables of the law, from an array of its type.
    pub(crate) fn gathered(&self, found: &[f64]) -> Vec<f64> {
        let room = self.room.as_ref();
        room.map_or_else(|| found.to_vec(), |room| room.gathered(found))
    }

    /// The names of the parameters with respect to which derivatives exist: all or none.
    pub(crate) fn parameter_names(&self) -> &'static [&'static str] {
        if self.by_parameters().is_none() {
            return &[];
        }
        let model = self.compiled.model();
        let parameters = model.parameters.iter();
        let names: Vec<_> = parameters
            .map(|&parameter| model.graph.name(parameter))
            .collect();
        names::list(&names)
    }
}

/// The results of a tape as caloric quantities.
pub(crate) fn caloric([entropy, heat_capacity, magnitude]: [f64; 3]) -> Caloric<f64> {
    Caloric {
        entropy,
        heat_capacity,
        magnitude,
    }
}
