use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let square = k * lambda * lambda;
    diff(square, k) + diff(square, square) + diff(square, 2) + diff(square, thet) + diff(square, lambda * theta) + diff(2, lambda) + diff(k * k, theta) + diff(square, R)
})]
struct Model {
    k: f64,
}

fn main() {}
