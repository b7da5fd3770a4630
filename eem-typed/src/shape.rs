//! What a law must have in common with its type: its variables.

use core::fmt;

use eem_language::text::{Compiled, Joint};

/// Of what a law is a function besides its dashpots and its temperature: [`Stretch`], [`Strains`] or [`Flow`].
pub trait Measures: fmt::Debug + Copy + Send + Sync + 'static + sealed::Sealed {
    /// Strains, variables, dashpots and responses at a point of a solid; zeros of a spring.
    #[doc(hidden)]
    const AT_POINT: [usize; 4];
}

mod sealed {
    pub trait Sealed {}
}

/// A spring, whose one measure is its length.
#[derive(Clone, Copy, Debug)]
pub struct Stretch;

/// A solid with M strains.
#[derive(Clone, Copy, Debug)]
pub struct Strains<const M: usize>;

/// A solid with invariants of a viscous strain. At a point it has M strains with the components of E, N variables, K
/// dashpots with the components of Γ, and R responses.
#[derive(Clone, Copy, Debug)]
pub struct Flow<const M: usize, const N: usize, const K: usize, const R: usize>;

impl sealed::Sealed for Stretch {}
impl Measures for Stretch {
    const AT_POINT: [usize; 4] = [0; 4];
}

impl<const M: usize> sealed::Sealed for Strains<M> {}
impl<const M: usize> Measures for Strains<M> {
    const AT_POINT: [usize; 4] = [M, 0, 0, 0];
}

impl<const M: usize, const N: usize, const K: usize, const R: usize> sealed::Sealed
    for Flow<M, N, K, R>
{
}
impl<const M: usize, const N: usize, const K: usize, const R: usize> Measures for Flow<M, N, K, R> {
    const AT_POINT: [usize; 4] = [M, N, K, R];
}

/// The most values of the old state that any function keeps.
pub const KEPT: usize = 32;

/// The most dashpots in series of a spring made of texts.
pub const MOST_DASHPOTS: usize = 8;

/// The most dashpots in series of a spring with fewer numbers to compute.
const FEW_DASHPOTS: usize = 2;

/// The sizes of types of materials, of which a spring may have a larger one than it needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Size {
    /// The numbers of the law.
    Own,
    /// Room for a temperature, a dashpot in parallel, and two in series.
    Few,
    /// Likewise, and [`MOST_DASHPOTS`] in series.
    Many,
}

impl Size {
    pub(crate) const ALL: [Self; 3] = [Self::Own, Self::Few, Self::Many];
}

/// How many variables and viscosities of each kind a law has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shape {
    /// 0 for a spring.
    pub(crate) strains: usize,
    /// Invariants of a viscous strain.
    pub(crate) joints: usize,
    /// Viscosities of the viscous strain: 2 if the volume flows as well.
    pub(crate) flows: usize,
    /// Dashpots in series, and in parallel.
    pub(crate) dashpots: usize,
    pub(crate) drag: usize,
    pub(crate) thermal: bool,
}

impl Shape {
    /// The shape of compiled texts.
    pub(crate) fn of(compiled: &Compiled) -> Self {
        let (model, joints) = (compiled.model(), compiled.joints());
        let flows = if joints.contains(&Joint::Trace) { 2 } else { 1 };
        Self {
            strains: compiled.strains().len(),
            joints: joints.len(),
            flows: if joints.is_empty() { 0 } else { flows },
            dashpots: model.dashpots.len(),
            drag: usize::from(model.drag.is_some()),
            thermal: model.temperature.is_some(),
        }
    }

    /// The shape of a type of its materials.
    pub(crate) fn of_size(self, size: Size) -> Self {
        let dashpots = match size {
            Size::Own => return self,
            Size::Few => FEW_DASHPOTS,
            Size::Many => MOST_DASHPOTS,
        };
        Self {
            dashpots: self.dashpots.max(dashpots),
            drag: 1,
            thermal: true,
            ..self
        }
    }

    /// The smallest type of its materials: with its own numbers for solids, and for the springs whose groups are compiled with the
    /// runtime.
    pub(crate) fn least_size(&self) -> Size {
        if self.strains > 0 || self.is_exact_spring() {
            Size::Own
        } else if self.dashpots <= FEW_DASHPOTS {
            Size::Few
        } else {
            Size::Many
        }
    }

    /// Whether the groups of its springs are compiled with the runtime.
    const fn is_exact_spring(&self) -> bool {
        let is_without_drag = self.strains == 0 && self.drag == 0;
        is_without_drag && (self.dashpots == 0 || self.dashpots == 1 && self.thermal)
    }

    /// The most values of the old state that a form of its type keeps. If it needs more, the old variables are kept instead,
    /// and all is computed from them in every iteration.
    pub(crate) const fn kept(&self) -> usize {
        match (self.is_exact_spring(), self.variables()) {
            (true, 1) => 4,
            (true, 2) => 16,
            (true, _) => 24,
            (false, _) => KEPT,
        }
    }

    /// Which of the types of a law has this shape, if one has.
    pub(crate) fn size_for(&self, law: &Self) -> Option<Size> {
        let least = law.least_size();
        let mut sizes = Size::ALL.into_iter().filter(|&size| size >= least);
        sizes.find(|&size| law.of_size(size) == *self)
    }

    /// Number of variables: measures, dashpots, temperature.
    pub(crate) const fn variables(&self) -> usize {
        let stretch = if self.strains == 0 { 1 } else { 0 };
        stretch + self.strains + self.joints + self.dashpots + self.thermal as usize
    }

    /// The number of components of a viscous strain: six if the volume flows, else five; 0 without one.
    pub(crate) const fn components(&self) -> usize {
        match self.flows {
            0 => 0,
            flows => 4 + flows,
        }
    }

    /// Strains, variables, dashpots and responses at a point of a solid.
    pub(crate) const fn at_point(&self) -> [usize; 4] {
        if self.joints == 0 {
            return [self.strains, 0, 0, 0];
        }
        let components = self.components();
        let variables = self.variables() - self.joints + 2 * components;
        [
            self.strains + components,
            variables,
            self.dashpots + components,
            variables + self.thermal as usize,
        ]
    }
}

impl Shape {
    /// What laws a type of this shape is for.
    pub(crate) fn of_type(&self) -> String {
        if self.strains > 0 || self.is_exact_spring() {
            return self.to_string();
        }
        let dashpots = self.dashpots;
        format!(
            "1 stretch, at most {dashpots} dashpots in series, at most 1 beside, at most 1 temperature"
        )
    }
}

impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = Vec::new();
        let mut add = |count: usize, one: &str, several: &str| match count {
            0 => {}
            1 => parts.push(format!("1 {one}")),
            count => parts.push(format!("{count} {several}")),
        };
        add(usize::from(self.strains == 0), "stretch", "stretches");
        add(self.strains, "strain", "strains");
        let invariants = ["invariant", "invariants"].map(|word| match self.flows {
            2 => format!("{word} of a viscous strain with a trace"),
            _ => format!("{word} of a viscous strain"),
        });
        add(self.joints, &invariants[0], &invariants[1]);
        add(self.dashpots, "dashpot in series", "dashpots in series");
        add(self.drag, "dashpot beside", "dashpots beside");
        add(usize::from(self.thermal), "temperature", "temperatures");
        f.write_str(&parts.join(", "))
    }
}
