use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(krate = ::eem, |lambda: Stretch| k * lambda)]
struct Spring {
    k: f64,
}

fn main() {}
