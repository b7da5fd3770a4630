use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| (a + b + c + d + e + f) * lambda)]
struct Model {
    #[unit("Nm")]
    a: f64,
    #[unit("m2")]
    b: f64,
    #[unit("kj")]
    c: f64,
    #[unit("Newton")]
    d: f64,
    #[unit("°C")]
    e: f64,
    #[unit("wibble")]
    f: f64,
}

fn main() {}
