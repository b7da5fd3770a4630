use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let square = |x| x * x;
    let again = |x| again(x) + square(x, x) + square() + square + undefined;
    let exp = |x| x;
    let typed = move |x: f64| -> f64 { x };
    let (a, b) = |x| x;
    let pattern = |(a, b), &c, mut d| a + d;
    let constant = || 2 * k;
    let unused = |x, y| { let z = x; x };
    let hidden = |theta, k| theta * k;
    let direct = |x| diff(x, x) + diff(lambda * x, square) + square[0] + x[0] + x(2);
    let square_2 = square;
    again(k) + typed(k) + pattern(k, k, k) + constant() + hidden(k, k) + direct(k) + sqare(k) + |x| x
})]
struct Model {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| {
    let square = |x| x * x;
    k * square(lambda - gamma)
})]
#[viscosity(gamma = square(k))]
struct Law {
    k: f64,
}

fn main() {}
