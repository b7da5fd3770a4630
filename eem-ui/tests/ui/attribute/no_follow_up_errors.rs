use eem::FreeEnergy;

// A wrong model implements the trait all the same: the use of it below adds no error.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * stifness * lambda * lambda)]
struct Spring<'a, T: Copy>
where
    T: Into<f64>,
{
    stiffness: f64,
    name: &'a str,
    data: T,
}

fn force<M: FreeEnergy<f64>>(model: &M, x: &M::Variables) -> M::Variables {
    model.gradient(x)
}

// The implementation has the shape of the model that was meant.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, delta: Viscous, theta: Temperature| {
    k * (lambda - gamma - delta).powi(2) - c * theta * lnn(theta)
})]
#[viscosity(gamma = k, delta = k)]
struct Branches {
    k: f64,
    c: f64,
}

fn main() {
    let spring = Spring { stiffness: 1.0, name: "spring", data: 1.0_f32 };
    force(&spring, &[1.0]);
    let branches = Branches { k: 1.0, c: 1.0 };
    let [_lambda, _gamma, _delta, _theta] = force(&branches, &[1.0, 0.0, 0.0, 300.0]);
    let (_viscosities, _slopes): ([f64; 2], [f64; 2]) = branches.viscosity(300.0);
    let _psi: f64 = branches.free_energy(&[1.0, 0.0, 0.0, 300.0]);
}
