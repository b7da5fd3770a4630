use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| a * lambda + b / lambda)]
struct Spring<S, T> {
    a: S,
    b: T,
}

fn main() {}
