use eem::FreeEnergy;

/// What cannot be copied.
pub struct Lock;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * k * (lambda - 1.0).powi(2))]
pub struct Locked {
    pub k: f64,
    pub lock: Lock,
}

fn main() {}
