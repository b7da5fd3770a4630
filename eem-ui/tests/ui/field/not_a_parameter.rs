use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda + n + table + name + number)]
struct Model {
    k: &'static f64,
    n: usize,
    table: &'static [f64],
    name: String,
    number: Option<f64>,
    unused: Vec<String>,
}

fn main() {}
