//! A scene whose dimension is known when the program runs, with the acts it was built by.

use std::sync::Arc;

use eem::{EquilibriumReport, Scheme};
use pyo3::prelude::*;

use crate::act::{Act, Rest};
use crate::built::{AnyScene, Built, Context};
use crate::error;
use crate::function::{Function, take_raised};
use crate::handle::{Lineage, random};
use crate::material::Material;
use crate::run::AnyRun;
use crate::setting::Pace;

/// What a pickle of a scene contains.
pub(crate) type State = (usize, String, Vec<Py<Material>>, Vec<Py<PyAny>>, Lineage);

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
            Err(refusal) => Some(error::refusal(refusal)),
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
                .map_err(error::refusal)?;
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

    /// A copy with the same lineage: it knows all handles so far, and none that come later.
    pub(crate) fn twin(&self) -> Self {
        self.copy(self.lineage.clone())
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

    /// The index of a material that springs or solids have.
    pub(crate) fn law(&self, material: &Bound<'_, Material>) -> PyResult<usize> {
        let known = self.materials.iter().position(|known| known.is(material));
        known.ok_or_else(|| {
            error::scene(format!(
                "no spring of the scene has the material {material}"
            ))
        })
    }

    /// The index of a new function.
    pub(crate) fn function(&mut self, callable: &Bound<'_, PyAny>) -> usize {
        let callable = Arc::new(callable.clone().unbind());
        self.context.functions.push(Function(callable));
        self.context.functions.len() - 1
    }

    /// A start of a run.
    pub(crate) fn start(&self, scheme: Scheme, pace: Pace) -> PyResult<Box<dyn AnyRun>> {
        _ = take_raised();
        self.scene.start(scheme, pace).map_err(|errors| {
            let all: Vec<_> = errors.iter().map(ToString::to_string).collect();
            let message = match &all[..] {
                [only] => only.clone(),
                all => {
                    let list = all.join("\n- ");
                    format!("{} things are wrong with the scene:\n- {list}", all.len())
                }
            };
            take_raised().unwrap_or_else(|| error::scenes(message, all))
        })
    }

    /// Its `repr`.
    pub(crate) fn shown(&self) -> String {
        let [nodes, elements, reservoirs, paths] = self.lineage.counts;
        let points = self.scene.parts().points();
        let (dim, springs) = (self.dim, elements - points);
        let points = if points > 0 {
            format!(", points={points}")
        } else {
            String::new()
        };
        format!(
            "Scene(dim={dim}, nodes={nodes}, springs={springs}{points}, reservoirs={reservoirs}, paths={paths})"
        )
    }

    /// What a pickle contains.
    pub(crate) fn state(&self, py: Python<'_>) -> PyResult<State> {
        let acts = serde_json::to_string(&*self.acts);
        let acts = acts.map_err(|error| error::checkpoint(error.to_string()))?;
        let materials = self.materials.iter().map(|one| one.clone_ref(py)).collect();
        let functions = self.context.functions.iter();
        let functions = functions.map(|function| function.0.clone_ref(py)).collect();
        Ok((self.dim, acts, materials, functions, self.lineage.clone()))
    }

    /// The scene of a pickle; it knows the handles of the one that was pickled.
    pub(crate) fn restored(
        py: Python<'_>,
        (dim, acts, materials, functions, lineage): State,
    ) -> PyResult<Self> {
        let acts: Vec<Act> = serde_json::from_str(&acts)
            .map_err(|error| error::checkpoint(format!("this is no pickled scene: {error}")))?;
        let mut world = Self::new(dim, lineage.copy(random(py)?))?;
        for material in &materials {
            world.material(material.bind(py));
        }
        for function in &functions {
            world.function(function.bind(py));
        }
        world.acts = acts.into();
        world.rebuild()?;
        Ok(world)
    }
}
