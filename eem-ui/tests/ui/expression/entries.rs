use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| {
    let strain = lambda / length;
    k[0] * strain + k[3] * strain.powi(2) + k[i] + k[-1] + k[1.0] + k + lambda[0] + length[0] + strain[1]
        + (k)[0] + (2 * length)[0] + stiff[0] + K[0] + k[99999999999999999999999]
})]
struct Model {
    k: [f64; 3],
    length: f64,
}

fn main() {}
