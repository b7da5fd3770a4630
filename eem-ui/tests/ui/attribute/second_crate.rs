use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(crate = ::eem)]
#[free_energy(crate = ::eem, |lambda: Stretch| k * lambda)]
struct Spring {
    k: f64,
}

fn main() {}
