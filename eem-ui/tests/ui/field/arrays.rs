use eem::FreeEnergy;

const ENTRIES: usize = 2;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| (k[0] + k[2]) * lambda.powi(2) + c[0] + names[1] + empty[0] + k + lambda[0])]
struct Model {
    k: [f64; 4],
    unused: [f64; 2],
    c: [f64; ENTRIES],
    names: [&'static str; 2],
    empty: [f64; 0],
    _kept: [f64; 2],
    #[free_energy(unused)]
    marked: [f64; 2],
    others: [u8; 2],
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| (k[0] + k[2]) * lambda.powi(2))]
struct Unused {
    k: [f64; 4],
    unused: [f64; 2],
    _kept: [f64; 2],
    #[free_energy(unused)]
    marked: [f64; 2],
    others: [u8; 2],
}

fn main() {}
