use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(krate = ::eem, |lambda: Stretch| k * lambda)]
struct Spring {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(crate = "eem", |lambda: Stretch| k * lambda)]
struct Quoted {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(crate = ::eem |lambda: Stretch, theta: Temperature| k * lambda)]
struct NoComma {
    k: f64,
}

fn main() {}
