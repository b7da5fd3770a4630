use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| a * lambda + b * lambda + c * lambda)]
struct Model {
    #[unit]
    a: f64,
    #[unit(N)]
    b: f64,
    #[unit = "N"]
    c: f64,
}

fn main() {}
