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

fn main() {
    let spring = Spring { stiffness: 1.0, name: "spring", data: 1.0_f32 };
    force(&spring, &[1.0]);
}
