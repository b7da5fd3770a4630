use eem::FreeEnergy;

struct Plain {
    stiffness: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| stiffness * lambda)]
struct Single {
    stiffness: f32,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| stiffness * lambda)]
struct Generic<T> {
    stiffness: T,
}

fn material<M: FreeEnergy<f64>>(_: &M) {}

fn main() {
    material(&Plain { stiffness: 1.0 });
    // All parameters are floats: such a model works in every scalar.
    material(&Single { stiffness: 1.0 });
    material(&Generic { stiffness: 1.0_f32 });
}
