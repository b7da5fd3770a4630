use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| {
    let a = 'label: { k };
    let b = unsafe { k };
    let c = { let d = k; };
    #[cfg(feature = "x")]
    let e = k;
    a * lambda
})]
struct Model {
    k: f64,
}

fn main() {}
