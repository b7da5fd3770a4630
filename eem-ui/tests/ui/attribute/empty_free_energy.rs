use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy]
struct Bare {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy()]
struct Empty {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(crate = ::eem)]
struct OnlyThePath {
    k: f64,
}

fn main() {}
