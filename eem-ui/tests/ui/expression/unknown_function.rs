use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| {
    let a = lnn(lambda) + lambda.sqroot() + log(lambda) + pow(lambda, 2);
    let b = lambda.max(k) + asin(lambda) + erf(lambda) + sign(lambda) + grad(lambda * k, lambda);
    a + b
})]
struct Model {
    k: f64,
}

fn main() {}
