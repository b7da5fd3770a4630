//! The inversion `S(θ) = s` on entropies that break plain Newton: it finds every
//! temperature within the promised number of evaluations, and knows where a branch ends.

use eem_material::{Caloric, InversionError, invert};

/// Random cold starts per family, and as many warm ones.
const CASES: usize = 400;

/// The promised bound on evaluations per inversion.
const MOST_EVALUATIONS: usize = 30;

/// The start of all cold cases, in K.
const ROOM_TEMPERATURE: f64 = 300.0;

/// How well an entropy is met: noise of its evaluation, 4ε Σ|terms|, in two places.
const ENTROPY_TOLERANCE: f64 = 16.0 * f64::EPSILON;

/// A xorshift generator (Marsaglia 2003), so that every run sees the same numbers.
struct Random(u64);

impl Random {
    #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
    fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 * 2.0_f64.powi(-53)
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

/// Entropy, heat capacity and Σ|terms|.
fn caloric(entropy: f64, heat_capacity: f64, magnitude: f64) -> Caloric<f64> {
    Caloric {
        entropy,
        heat_capacity,
        magnitude,
    }
}

fn constant_capacity(theta: f64) -> Caloric<f64> {
    let s = 7.5 * theta.ln();
    caloric(s, 7.5, s.abs())
}

fn nearly_no_capacity(theta: f64) -> Caloric<f64> {
    let s = 1e-12 * theta.ln();
    caloric(1.0 + s, 1e-12, 1.0 + s.abs())
}

/// Einstein solid with the characteristic temperature 600 K.
fn einstein(theta: f64) -> Caloric<f64> {
    let x = 600.0 / theta;
    let occupation = 1.0 / x.exp_m1();
    let (first, second) = (x * occupation, -(-(-x).exp()).ln_1p());
    caloric(
        first + second,
        x * x * occupation * (1.0 + occupation),
        first + second,
    )
}

fn debye(theta: f64) -> Caloric<f64> {
    let s = 1e-3 * theta.powi(3);
    caloric(s, 3.0 * s, s)
}

fn metal(theta: f64) -> Caloric<f64> {
    let (electrons, lattice) = (0.7 * theta, 1e-4 * theta.powi(3));
    let s = electrons + lattice;
    caloric(s, electrons + 3.0 * lattice, s)
}

/// Two levels 10 K apart on a small constant capacity.
fn schottky(theta: f64) -> Caloric<f64> {
    let x = 10.0 / theta;
    let occupation = 1.0 / (1.0 + x.exp());
    let (first, second) = ((-x).exp().ln_1p(), x * occupation);
    let background = 1e-3 * theta.ln();
    caloric(
        first + second + background,
        1e-3 + x * x * occupation * (1.0 - occupation),
        first + second + background.abs(),
    )
}

/// The temperature of the step, in K.
const STEP: f64 = 350.0;

/// A step of 5 within 1e-5 in `ln θ`.
fn step(theta: f64) -> Caloric<f64> {
    let y = (theta / STEP).ln() / 1e-5;
    let s = theta.ln() + 2.5 * (1.0 + y.tanh());
    caloric(
        s,
        1.0 + 2.5e5 / y.cosh().powi(2),
        theta.ln().abs() + 2.5 * (1.0 + y.tanh().abs()),
    )
}

/// Logarithmic stiffness: `S = c ln(θ/θr) + a θr/θ`, stable above `θ = a θr/c`.
fn logarithmic_stiffness(theta: f64) -> Caloric<f64> {
    let (c, pull) = (1.5, 0.9 * 300.0);
    let (thermal, elastic) = (c * (theta / 300.0).ln(), pull / theta);
    caloric(thermal + elastic, c - elastic, thermal.abs() + elastic)
}

const SPINODAL: f64 = 0.9 * 300.0 / 1.5;

/// Maps the unit interval to `ln θ` between two bounds.
fn uniform(low: f64, high: f64) -> impl Fn(f64) -> f64 {
    move |unit| low + (high - low) * unit
}

/// Inverts at random temperatures `e^x`, cold and warm, and reports the counts.
fn check_family(name: &str, entropy: fn(f64) -> Caloric<f64>, sample: impl Fn(f64) -> f64) {
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    for warm in [false, true] {
        let (mut total, mut most) = (0, 0);
        for _ in 0..CASES {
            let theta = sample(random.unit()).exp();
            let wanted = entropy(theta);
            let start = if warm {
                let near = theta * random.within(0.9, 1.1);
                // A start must be stable: past a spinodal it is not.
                if entropy(near).heat_capacity > 0.0 {
                    near
                } else {
                    theta
                }
            } else {
                ROOM_TEMPERATURE
            };
            let found = invert(entropy, wanted.entropy, start)
                .unwrap_or_else(|error| panic!("{name} at {theta:e} from {start:e}: {error}"));
            let got = entropy(found.temperature);
            let miss = (got.entropy - wanted.entropy).abs();
            // A temperature is a rounded number: one ulp of it moves S by C ε.
            let allowed = ENTROPY_TOLERANCE * (wanted.magnitude + wanted.heat_capacity);
            assert!(
                miss <= allowed,
                "{name} at {theta:e}: entropy off by {miss:e}"
            );
            total += found.evaluations;
            most = most.max(found.evaluations);
        }
        let start = if warm { "warm" } else { "cold" };
        #[expect(clippy::cast_precision_loss, reason = "small counts")]
        let mean = total as f64 / CASES as f64;
        println!("{name:24} {start}: {mean:5.2} evaluations on average, {most} at most");
        assert!(
            most <= MOST_EVALUATIONS,
            "{name} {start}: {most} evaluations"
        );
    }
}

#[test]
fn constant_capacity_over_the_whole_range() {
    check_family(
        "constant capacity",
        constant_capacity,
        uniform(-690.0, 690.0),
    );
}

#[test]
fn nearly_vanishing_capacity() {
    check_family(
        "nearly no capacity",
        nearly_no_capacity,
        uniform(-10.0, 15.0),
    );
}

#[test]
fn einstein_solid_frozen_out() {
    check_family("Einstein solid", einstein, uniform(0.0, 12.0));
}

#[test]
fn debye_solid_from_e_minus_200_to_e_200() {
    check_family("Debye solid", debye, uniform(-200.0, 200.0));
}

#[test]
fn metal_with_two_regimes() {
    check_family("metal", metal, uniform(-20.0, 20.0));
}

#[test]
fn schottky_anomaly_on_a_small_capacity() {
    check_family("Schottky anomaly", schottky, uniform(-2.0, 9.0));
}

#[test]
fn sharp_step() {
    // Entropies that are evenly distributed over the step.
    let on_the_step = |unit: f64| STEP.ln() + 1e-5 * (2.0 * unit - 1.0).atanh();
    check_family("sharp step", step, on_the_step);
    check_family("around a sharp step", step, uniform(4.5, 7.5));
}

#[test]
fn logarithmic_stiffness_above_its_spinodal() {
    check_family(
        "logarithmic stiffness",
        logarithmic_stiffness,
        uniform(SPINODAL.ln(), 12.0),
    );
    let next_to_it = |unit: f64| SPINODAL.ln() + (-30.0 * unit).exp();
    check_family("next to a spinodal", logarithmic_stiffness, next_to_it);
}

#[test]
fn found_temperatures_are_stable_down_to_the_spinodal() {
    let mut random = Random(7);
    for _ in 0..CASES {
        let theta = SPINODAL * (1.0 + random.within(-36.0, 0.0).exp());
        let wanted = logarithmic_stiffness(theta).entropy;
        match invert(logarithmic_stiffness, wanted, ROOM_TEMPERATURE) {
            Ok(found) => assert!(found.temperature >= SPINODAL),
            // Next to the spinodal the wanted entropy may round to less than the smallest.
            Err(InversionError::NoSuchTemperature { residual, .. }) => {
                assert!(residual.abs() < ENTROPY_TOLERANCE);
            }
            Err(error) => panic!("{theta}: {error}"),
        }
    }
}

#[test]
fn entropy_below_the_spinodal_is_a_clean_error() {
    let least = logarithmic_stiffness(SPINODAL).entropy;
    let mut random = Random(11);
    let mut most = 0;
    for case in 0..CASES {
        let start = SPINODAL * (1.0 + random.within(-12.0, 6.0).exp());
        let missing = random.within(-25.0, 10.0).exp();
        let wanted = least - missing;
        let error = invert(logarithmic_stiffness, wanted, start).unwrap_err();
        let InversionError::NoSuchTemperature {
            entropy,
            temperature,
            residual,
            evaluations,
        } = error
        else {
            panic!("case {case}: {error}");
        };
        assert_eq!(entropy.to_bits(), wanted.to_bits());
        // S is stationary at the spinodal: the temperature is found to √ε only.
        assert!((temperature / SPINODAL - 1.0).abs() < 1e-5, "{error}");
        assert!((residual / missing - 1.0).abs() < 1e-4, "{error}");
        most = most.max(evaluations);
    }
    println!("below a spinodal: at most {most} evaluations");
}

/// Two stable branches, `y < −1` and `y > 1` with `y = ln(θ/300 K)`, and none between.
fn two_branches(theta: f64) -> Caloric<f64> {
    let y = (theta / ROOM_TEMPERATURE).ln();
    let (cubic, linear) = (y.powi(3), 3.0 * y);
    caloric(
        cubic - linear,
        3.0 * (y * y - 1.0),
        cubic.abs() + linear.abs(),
    )
}

#[test]
fn solution_is_on_the_branch_of_the_start() {
    let mut random = Random(13);
    for case in 0..CASES {
        let side = if case % 2 == 0 { 1.0 } else { -1.0 };
        let on_branch = |y: f64| ROOM_TEMPERATURE * (side * y).exp();
        let theta = on_branch(random.within(1.01, 4.0));
        // Near enough for the first free step, a factor e, not to lead to the other branch.
        let start = on_branch(random.within(1.01, 2.0));
        let wanted = two_branches(theta).entropy;
        let found = invert(two_branches, wanted, start).unwrap();
        assert!((found.temperature / theta - 1.0).abs() < 1e-12);
        assert!(
            found.evaluations <= MOST_EVALUATIONS,
            "{}",
            found.evaluations
        );
        // The other branch has this entropy too, but not the branch of the start.
        let beyond = side * -(2.0 + random.within(0.01, 5.0));
        let error = invert(two_branches, beyond, start).unwrap_err();
        let InversionError::NoSuchTemperature { temperature, .. } = error else {
            panic!("case {case}: {error}");
        };
        assert!((temperature / on_branch(1.0) - 1.0).abs() < 1e-5, "{error}");
    }
}

#[test]
fn bad_input_has_its_own_error() {
    for entropy in [f64::NAN, f64::INFINITY] {
        let error = invert(debye, entropy, 300.0).unwrap_err();
        assert!(
            matches!(error, InversionError::EntropyNotFinite { .. }),
            "{error}"
        );
    }
    for start in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = invert(debye, 1.0, start).unwrap_err();
        assert!(
            matches!(error, InversionError::InvalidStart { .. }),
            "{error}"
        );
    }
    let unstable = 0.5 * SPINODAL;
    let error = invert(logarithmic_stiffness, 1.0, unstable).unwrap_err();
    assert_eq!(
        error,
        InversionError::UnstableStart {
            start: unstable,
            heat_capacity: -1.5
        }
    );
    let not_a_number = |_: f64| caloric(f64::NAN, 1.0, 1.0);
    let error = invert(not_a_number, 1.0, 300.0).unwrap_err();
    assert!(
        matches!(error, InversionError::UnstableStart { .. }),
        "{error}"
    );
    // No temperature has a negative entropy here.
    let error = invert(debye, -1.0, 300.0).unwrap_err();
    assert!(
        matches!(error, InversionError::NoSuchTemperature { .. }),
        "{error}"
    );
}

#[test]
fn an_entropy_that_contradicts_its_capacity_ends() {
    let mut calls = 0;
    let nonsense = |theta: f64| {
        calls += 1;
        caloric(-theta.ln(), 1.0, 1e-30)
    };
    let result = invert(nonsense, 1.0, 300.0);
    assert!(result.is_err(), "{result:?}");
    assert!(calls <= 128);
}
