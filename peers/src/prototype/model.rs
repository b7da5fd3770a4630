//! What the pendulums have in common, and where their unknowns are.

/// A chain of one or two masses: spring k joins mass k to mass k − 1, the first one to a pivot at the origin.
///
/// Heat is conducted between two bodies: spring 0, and spring 1 or, if there is one spring only, a reservoir.
/// The unknowns of a stage are y = (q, p, γ, θ), `N` numbers; `X` integrals are taken over a step, see
/// [`quadrature`](super::quadrature).
pub(crate) trait Pendulum<const N: usize, const X: usize> {
    /// Of space, 2 or 3.
    const DIMENSION: usize;
    /// Of masses, and of springs.
    const COUNT: usize;
    /// Springs with a dashpot: 0 or 1.
    const DASHPOTS: usize;
    /// kg.
    const MASSES: [f64; 2];
    /// κ between the two bodies, W/K.
    const CONDUCTANCE: f64;
    /// θ of the reservoir, K.
    const RESERVOIR: f64 = 300.0;

    /// The first unknown of p.
    const P: usize = Self::DIMENSION * Self::COUNT;
    /// The first unknown of γ.
    const GAMMA: usize = 2 * Self::P;
    /// The first unknown of θ.
    const THETA: usize = Self::GAMMA + Self::DASHPOTS;
    /// Whether the second body is a reservoir.
    const HAS_RESERVOIR: bool = Self::COUNT == 1;

    /// A spring at (λ, γ, θ); its energy is not evaluated.
    fn at_temperature(spring: usize, lambda: f64, gamma: f64, theta: f64) -> Point;

    /// A spring at (λ, γ, s), with its energy; Newton's method for ln θ starts from `guess`, K.
    fn at_entropy(spring: usize, lambda: f64, gamma: f64, entropy: f64, guess: f64) -> Point;

    /// s(λ, γ, θ), J/K.
    fn entropy(spring: usize, lambda: f64, gamma: f64, theta: f64) -> f64;

    /// y at t = 0.
    fn start() -> [f64; N];
}

/// A spring in one state: derivatives of its free energy ψ(λ, γ, θ).
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Point {
    /// f = ∂ψ/∂λ, N.
    pub(super) force: f64,
    /// g = −∂ψ/∂γ, N.
    pub(super) dashpot_force: f64,
    /// η(θ), N s/m.
    pub(super) viscosity: f64,
    /// ∂s/∂λ = −∂²ψ/∂λ∂θ, J/(K m).
    pub(super) entropy_by_lambda: f64,
    /// ∂s/∂γ = −∂²ψ/∂γ∂θ, J/(K m).
    pub(super) entropy_by_gamma: f64,
    /// c = θ ∂s/∂θ, J/K.
    pub(super) capacity: f64,
    /// θ, K.
    pub(super) theta: f64,
    /// e = ψ + θ s, J; of [`Pendulum::at_entropy`] only.
    pub(super) energy: f64,
}

impl Point {
    /// Whether the state is admissible.
    #[inline(always)]
    pub(super) fn is_admissible(&self) -> bool {
        self.theta > 0.0 && self.capacity > 0.0
    }
}

/// A spring's direction n, zero in the third component in the plane, and its length λ, m.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Edge {
    pub(super) direction: [f64; 3],
    pub(super) length: f64,
}

/// The edges of all springs.
#[inline(always)]
pub(super) fn edges<C: Pendulum<N, X>, const N: usize, const X: usize>(y: &[f64; N]) -> [Edge; 2] {
    let mut edges = [Edge::default(); 2];
    for (spring, edge) in edges.iter_mut().enumerate().take(C::COUNT) {
        let mut arm = [0.0; 3];
        let mut squared = 0.0;
        for (d, component) in arm.iter_mut().enumerate().take(C::DIMENSION) {
            *component = relative::<C, N, X>(y, spring, d);
            squared += *component * *component;
        }
        edge.length = squared.sqrt();
        let inverse = 1.0 / edge.length;
        edge.direction = arm.map(|component| component * inverse);
    }
    edges
}

/// Component d of the difference of a vector of the masses (the first ones of `values`) over a spring.
#[inline(always)]
pub(super) fn relative<C: Pendulum<N, X>, const N: usize, const X: usize>(
    values: &[f64; N],
    spring: usize,
    d: usize,
) -> f64 {
    let end = values[C::DIMENSION * spring + d];
    if spring == 0 {
        end
    } else {
        end - values[C::DIMENSION * (spring - 1) + d]
    }
}

/// The vector of mass i in a block of unknowns that begins at `first`; its third component is zero in the plane.
#[inline(always)]
pub(super) fn vector<C: Pendulum<N, X>, const N: usize, const X: usize>(
    y: &[f64; N],
    first: usize,
    mass: usize,
) -> [f64; 3] {
    let mut vector = [0.0; 3];
    for (d, component) in vector.iter_mut().enumerate().take(C::DIMENSION) {
        *component = y[first + C::DIMENSION * mass + d];
    }
    vector
}

/// T = Σ |p|²/2m, J.
#[inline(always)]
pub(super) fn kinetic_energy<C: Pendulum<N, X>, const N: usize, const X: usize>(
    y: &[f64; N],
) -> f64 {
    let mut energy = 0.0;
    for mass in 0..C::COUNT {
        let [x, y, z] = vector::<C, N, X>(y, C::P, mass);
        energy += (x * x + y * y + z * z) * (0.5 / C::MASSES[mass]);
    }
    energy
}

/// J = Σ q × p about the pivot, N m s.
#[inline(always)]
pub(super) fn angular_momentum<C: Pendulum<N, X>, const N: usize, const X: usize>(
    y: &[f64; N],
) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for mass in 0..C::COUNT {
        let one = cross(
            vector::<C, N, X>(y, 0, mass),
            vector::<C, N, X>(y, C::P, mass),
        );
        for (sum, one) in sum.iter_mut().zip(one) {
            *sum += one;
        }
    }
    sum
}

/// a × b.
#[inline(always)]
pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
