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

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| { k * lambda; })]
struct Semicolon {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| let strain = k * lambda)]
struct NoBlock {
    k: f64,
}

// The name that an item or a closure declares is not reported again.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| {
    fn square(x: f64) -> f64 { x * x }
    let cube = |x| x * x * x;
    square(lambda) + cube(k)
})]
struct Functions {
    k: f64,
}

fn main() {}
