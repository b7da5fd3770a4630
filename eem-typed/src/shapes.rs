//! The shapes of springs, and the choice among them when a program runs.

#[cfg(feature = "compiled")]
use eem_runtime::of_dimension;
use eem_runtime::{Element, Node, Scene};

use crate::error::LawError;
use crate::law::Law;
use crate::shape::{KEPT, MOST_DASHPOTS, Stretch};
use crate::typed::Typed;

/// A spring without temperature and dashpots.
pub type Spring0 = Typed<Stretch, 1, 0, 0, 0, 0, 1, 4>;

/// A spring with a temperature and without dashpots.
pub type ThermalSpring0 = Typed<Stretch, 2, 0, 0, 0, 2, 3, 16>;

/// A spring with a temperature and one dashpot, in series.
pub type ThermalSpring1 = Typed<Stretch, 3, 1, 1, 0, 4, 4, 24>;

/// Any spring with at most two dashpots in series and one in parallel, with a temperature or without.
///
/// Those that one of the shapes above fits step faster with that, and with the same bits.
pub type DampedSpring = Typed<Stretch, 4, 2, 2, 1, 6, 5, KEPT>;

/// Any spring with at most eight dashpots in series and one in parallel, with a temperature or without.
pub type Spring8 = Typed<Stretch, 10, 8, 8, 1, 18, 11, KEPT>;

impl Law {
    /// Whether [`add_spring`](Self::add_spring) has a shape for it.
    ///
    /// # Errors
    ///
    /// [`LawError::Solid`] if ψ is a function of strains, [`LawError::Dashpots`] for more than [`MOST_DASHPOTS`] dashpots in series.
    ///
    /// ```
    /// use eem::typed::{Law, LawError, Source, compile};
    ///
    /// let solid = Law::new(compile(&Source::new("|e2: StrainSquare| e2"))?, &[])?;
    /// assert_eq!(solid.check_spring(), Err(LawError::Solid));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn check_spring(&self) -> Result<(), LawError> {
        let shape = self.shape();
        if shape.strains > 0 {
            return Err(LawError::Solid);
        }
        if shape.dashpots > MOST_DASHPOTS {
            return Err(LawError::Dashpots {
                dashpots: shape.dashpots,
                most: MOST_DASHPOTS,
            });
        }
        Ok(())
    }

    /// Puts a spring of this law between two nodes of a scene, whatever its shape is: the smallest that fits.
    ///
    /// # Errors
    ///
    /// [`LawError::Solid`], [`LawError::Dashpots`], [`LawError::TooLarge`]; the scene is not changed then.
    ///
    /// ```
    /// use eem::prelude::*;
    /// use eem::typed::{Law, LawError, Source, compile};
    ///
    /// let elastic = Source::new("|lambda: Stretch| 0.5 * k * (lambda - 1).powi(2)");
    /// let damped = elastic.clone().viscosity("lambda", "k / 20");
    /// let mut scene = Scene::<1>::new();
    /// let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.5], [0.0])];
    /// for source in [elastic, damped] {
    ///     let law = Law::new(compile(&source.parameter("k", None))?, &[("k", 40.0)])?;
    ///     law.add_spring(&mut scene, ends)?;
    /// }
    /// let solid = Law::new(compile(&Source::new("|e2: StrainSquare| e2"))?, &[])?;
    /// assert_eq!(solid.add_spring(&mut scene, ends), Err(LawError::Solid));
    ///
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.01)?;
    /// run.run_until(5.0)?;
    /// // ω² = 80/s², damping rate 1/s
    /// let exact = 1.0 + 0.5 * (-5.0_f64).exp() * (79.0_f64.sqrt() * 5.0).cos();
    /// assert!((run.position(ends[1])?[0] - exact).abs() < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn add_spring<const D: usize>(
        &self,
        scene: &mut Scene<D>,
        nodes: [Node; 2],
    ) -> Result<Element, LawError> {
        self.check_spring()?;
        #[cfg(feature = "compiled")]
        if const { 1 <= D && D <= 3 } {
            let add: &AddSpring<D> = of_dimension(D, [&LINE, &PLANE, &SPACE]);
            return add(self, scene, nodes);
        }
        add_spring(self, scene, nodes)
    }
}

/// Puts a spring of a law between two nodes of a scene.
#[cfg(feature = "compiled")]
type AddSpring<const D: usize> = fn(&Law, &mut Scene<D>, [Node; 2]) -> Result<Element, LawError>;

// Compiled with this crate: the explicit scheme, which is compiled for each type, takes most of it.
#[cfg(feature = "compiled")]
static LINE: AddSpring<1> = add_spring;
#[cfg(feature = "compiled")]
static PLANE: AddSpring<2> = add_spring;
#[cfg(feature = "compiled")]
static SPACE: AddSpring<3> = add_spring;

fn add_spring<const D: usize>(
    law: &Law,
    scene: &mut Scene<D>,
    nodes: [Node; 2],
) -> Result<Element, LawError> {
    let shape = law.shape();
    Ok(match (shape.dashpots, shape.drag, shape.thermal) {
        (0, 0, false) => scene.spring::<Spring0>(law.model()?, nodes),
        (0, 0, true) => scene.spring::<ThermalSpring0>(law.model()?, nodes),
        (1, 0, true) => scene.spring::<ThermalSpring1>(law.model()?, nodes),
        (0..=2, _, _) => scene.spring::<DampedSpring>(law.model()?, nodes),
        _ => scene.spring::<Spring8>(law.model()?, nodes),
    })
}

/// The type of the material of a solid, made from a law: a [`Typed`](crate::Typed).
///
/// ```text
/// solid!(strains: 2)
/// solid!(strains: 3, invariants: 3, volume_flow: 1, dashpots: 1, temperature: 1)
/// ```
///
/// The arguments, in this order, are the numbers of strains and of invariants of a viscous strain in ψ, of dashpots in series
/// and of temperatures (0 or 1). All but the first may be left out.
/// Write `volume_flow: 1` if one of the invariants is the trace.
///
/// ```
/// use eem::kinematics::Quad4;
/// use eem::prelude::*;
/// use eem::typed::{Law, Source, compile, solid};
///
/// let source = Source::new("|e1: StrainTrace, e2: StrainSquare, m3: ViscousStrain, m2: ViscousSquare| {
///     0.5 * lame * e1.powi(2) + branch * (e2 - 2 * m3 + m2)
/// }")
/// .viscosity("m3", "eta")
/// .parameter("lame", Some("Pa"))
/// .parameter("branch", Some("Pa"))
/// .parameter("eta", Some("Pa s"));
/// let law = Law::new(compile(&source)?, &[("lame", 2000.0), ("branch", 800.0), ("eta", 40.0)])?;
/// let putty: solid!(strains: 2, invariants: 2) = law.model()?;
///
/// let mut scene = Scene::<2>::new();
/// let mesh = Mesh::<Quad4, 2>::block([1; 2], [[0.0, 1.0]; 2])?;
/// let block = scene.solid(putty, &mesh, &Bulk::new(10.0));
/// for (&node, [x, ..]) in block.nodes().iter().zip(mesh.nodes()) {
///     scene.set_velocity(node, [*x, 0.0]);
/// }
/// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.05)?;
/// let before = run.ledger();
/// run.step()?;
/// assert!((run.ledger().balance - before.balance).abs() < 1e-14 * before.energy);
/// assert!(run.viscous_strain(block.points()[0])?.norm() > 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[macro_export]
macro_rules! solid {
    (@of $measures:ty, $n:expr, $k:expr, $v:expr, $t:expr) => {
        $crate::Typed<
            $measures,
            { $n }, { $k }, { $v }, 0, { 2 * ($n - 1) * $t }, { $n + $t }, { $crate::KEPT }
        >
    };
    (
        strains: $m:literal $(, dashpots: $k:literal)? $(, temperature: $t:literal)?
    ) => {
        $crate::solid!(
            @of $crate::Strains<$m>,
            $m $(+ $k)? $(+ $t)?, 0 $(+ $k)?, 0 $(+ $k)?, (0 $(+ $t)?)
        )
    };
    (
        strains: $m:literal, invariants: $j:literal $(, volume_flow: $f:literal)?
        $(, dashpots: $k:literal)? $(, temperature: $t:literal)?
    ) => {
        $crate::solid!(
            @of $crate::Flow<
                { $m + 5 $(+ $f)? },
                { $m + 2 * (5 $(+ $f)?) $(+ $k)? $(+ $t)? },
                { 5 $(+ $f)? $(+ $k)? },
                { $m + 2 * (5 $(+ $f)?) $(+ $k)? $(+ 2 * $t)? }
            >,
            $m + $j $(+ $k)? $(+ $t)?, 0 $(+ $k)?, 1 $(+ $f)? $(+ $k)?, (0 $(+ $t)?)
        )
    };
}
