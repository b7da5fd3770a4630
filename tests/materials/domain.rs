//! The domain check finds what is wrong, says where, and looks only at what a model has.

use eem::{Domain, DomainError, FreeEnergy, check_domain};

/// Logarithmic stiffness, Conde Martín, Betsch & García Orden 2016, eq. 43 without β.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let stiffness = c0 - c1 * theta_ref * ln(theta / theta_ref);
    0.5 * stiffness * ln(lambda / length).powi(2)
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
struct LogarithmicStiffness {
    c0: f64,
    c1: f64,
    length: f64,
    capacity: f64,
    theta_ref: f64,
}

impl LogarithmicStiffness {
    const SOFT: Self = Self {
        c0: 5000.0,
        c1: 50.0,
        length: 1.0,
        capacity: 100.0,
        theta_ref: 300.0,
    };

    /// Below this temperature the heat capacity is negative.
    fn spinodal(&self, lambda: f64) -> f64 {
        let strain = (lambda / self.length).ln();
        self.c1 * self.theta_ref * strain.powi(2) / (2.0 * self.capacity)
    }
}

/// A dip of the heat capacity around one stretch and one temperature, away from every corner.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let bell = exp(-(lambda - 1.1).powi(2) / width.powi(2));
    -capacity * theta * ln(theta) + depth * bell * cos((theta - 300.0) / 60.0) + lambda
})]
struct Dip {
    capacity: f64,
    depth: f64,
    width: f64,
}

impl Dip {
    /// `C = c + (depth θ/60²) bell cos(…)`, least near 300 K + 60 π K at λ = 1.1.
    fn heat_capacity(&self, lambda: f64, theta: f64) -> f64 {
        let bell = (-((lambda - 1.1) / self.width).powi(2)).exp();
        self.capacity + self.depth * theta / 3600.0 * bell * ((theta - 300.0) / 60.0).cos()
    }
}

/// A viscosity that is linear in the temperature, and so negative somewhere.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, a: Viscous, b: Viscous, theta: Temperature| {
    0.5 * k * ((lambda - a).powi(2) + (lambda - b).powi(2)) - c * theta * ln(theta)
})]
#[viscosity(a = eta, b = eta * (theta - 250.0))]
struct Linear {
    k: f64,
    c: f64,
    eta: f64,
}

/// Elastic, defined for stretches below a limit only.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| -stiffness * ln(1.0 - (lambda / extent).powi(2)))]
struct Fene {
    stiffness: f64,
    extent: f64,
}

/// Its parameters are of a smaller type.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| stiffness * (lambda - gamma).powi(2))]
#[viscosity(gamma = eta)]
struct Single {
    stiffness: f32,
    eta: f32,
}

#[test]
fn the_spinodal_is_found() {
    let spring = LogarithmicStiffness::SOFT;
    let domain = Domain::of_stretch([0.9, 8.0]).with_temperature([200.0, 400.0]);
    let error = check_domain(&spring, &domain, 100).expect_err("a state below the spinodal");
    let DomainError::HeatCapacity { value, point } = &error else {
        panic!("{error}");
    };
    let theta = point.temperature.expect("a temperature");
    assert!(theta < spring.spinodal(point.measures[0]));
    assert!(*value < 0.0);
    let said = error.to_string();
    let expected = format!(
        "J/K at stretch {} m, temperature {theta} K",
        point.measures[0]
    );
    assert!(said.contains(&expected), "{said}");
}

#[test]
fn a_report_has_the_least_heat_capacity() {
    let spring = LogarithmicStiffness::SOFT;
    let domain = Domain::of_stretch([1.0, 2.0]).with_temperature([200.0, 400.0]);
    let report = check_domain(&spring, &domain, 0).expect("a sound material");
    let least = report.heat_capacity.expect("a temperature");
    // In a corner: longest and coldest.
    let expected = 100.0 * (1.0 - spring.spinodal(2.0) / 200.0);
    assert!((least.value - expected).abs() <= 8.0 * f64::EPSILON * 100.0);
    assert!(report.viscosities.is_empty());
}

#[test]
fn the_search_goes_down_into_a_dip() {
    let dip = |depth: f64| Dip {
        capacity: 10.0,
        depth,
        width: 0.1,
    };
    let domain = Domain::of_stretch([0.5, 2.0]).with_temperature([250.0, 700.0]);
    let shallow = dip(50.0);
    let report = check_domain(&shallow, &domain, 200).expect("a sound material");
    let least = report.heat_capacity.expect("a temperature");
    let [lambda, theta] = [
        least.point.measures[0],
        least.point.temperature.unwrap_or(0.0),
    ];
    assert!((least.value - shallow.heat_capacity(lambda, theta)).abs() < 1e-12);
    // The lowest point, by a fine grid along θ at λ = 1.1.
    let grid = (2500..7000).map(|tenth| shallow.heat_capacity(1.1, f64::from(tenth) / 10.0));
    let lowest = grid.fold(f64::INFINITY, f64::min);
    // The search ends with steps of a millionth of the box; the bottom is flat.
    assert!(
        (least.value - lowest).abs() < 1e-6,
        "{} and {lowest}",
        least.value
    );

    let deep = dip(120.0);
    let error = check_domain(&deep, &domain, 200).expect_err("a negative heat capacity");
    assert!(matches!(error, DomainError::HeatCapacity { value, .. } if value <= 0.0));
}

#[test]
fn a_negative_viscosity_is_found() {
    let model = Linear {
        k: 2.0,
        c: 3.0,
        eta: 0.1,
    };
    let domain = |coldest| {
        let stretches = Domain::of_stretch([0.5, 2.0]).with_viscous([-1.0, 1.0]);
        stretches
            .with_viscous([-1.0, 1.0])
            .with_temperature([coldest, 400.0])
    };
    let report = check_domain(&model, &domain(260.0), 50).expect("a sound material");
    let [a, b] = [0, 1].map(|dashpot| report.viscosities[dashpot].value);
    assert!((a - 0.1).abs() <= 0.0 && (b - 1.0).abs() < 1e-14);

    let error = check_domain(&model, &domain(240.0), 50).expect_err("a negative viscosity");
    let DomainError::Viscosity {
        dashpot: 1,
        value,
        point,
    } = &error
    else {
        panic!("{error}");
    };
    assert!(*value <= 0.0 && point.temperature <= Some(250.0));
    assert_eq!(point.viscous.len(), 2);
}

#[test]
fn what_is_not_finite_is_found() {
    let bond = Fene {
        stiffness: 30.0,
        extent: 1.5,
    };
    assert!(check_domain(&bond, &Domain::of_stretch([0.1, 1.4]), 50).is_ok());
    let error = check_domain(&bond, &Domain::of_stretch([0.1, 1.6]), 50).expect_err("ln(-1)");
    let DomainError::NotFinite {
        quantity,
        value,
        point,
    } = error
    else {
        panic!("{error}");
    };
    assert_eq!(quantity, "free energy");
    assert!(value.is_nan() && point.measures[0] > 1.5 && point.temperature.is_none());
}

#[test]
fn isothermal_dashpots_are_checked() {
    let model = Single {
        stiffness: 2.0,
        eta: -1.0,
    };
    let domain = Domain::of_stretch([0.5, 2.0]).with_viscous([0.0, 0.0]);
    let error = check_domain(&model, &domain, 10).expect_err("a negative viscosity");
    assert!(
        matches!(error, DomainError::Viscosity { dashpot: 0, .. }),
        "{error}"
    );
}

#[test]
fn boxes_that_do_not_fit_are_refused() {
    let spring = LogarithmicStiffness::SOFT;
    let stretch = Domain::of_stretch([0.5, 2.0]);
    let said = |domain: &Domain| {
        let error = check_domain(&spring, domain, 10).expect_err("a box that does not fit");
        error.to_string()
    };
    assert_eq!(
        said(&stretch),
        "the model has 1 of role `Temperature`, the domain 0"
    );
    let with_dashpot = stretch
        .clone()
        .with_viscous([0.0, 1.0])
        .with_temperature([200.0, 300.0]);
    assert_eq!(
        said(&with_dashpot),
        "the model has 0 of role `Viscous`, the domain 1"
    );
    assert_eq!(
        said(&stretch.clone().with_temperature([0.0, 300.0])),
        "the temperature from 0 to 300 is no interval of positive and finite numbers"
    );
    assert_eq!(
        said(&Domain::of_stretch([2.0, 1.0]).with_temperature([200.0, 300.0])),
        "the stretch from 2 to 1 is no interval of positive and finite numbers"
    );
    let endless = stretch.with_temperature([200.0, f64::INFINITY]);
    assert!(said(&endless).starts_with("the temperature from 200 to inf"));
}

/// The shear modulus falls faster than linearly, which costs heat capacity.
#[derive(FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare, g: Viscous, theta: Temperature| {
    let heating = theta - 300;
    0.5 * la * (e1 - g).powi(2) + (mu + 0.5 * curvature * heating.powi(2)) * e2
        + capacity * (heating - theta * ln(theta / 300))
})]
#[viscosity(g = eta)]
struct Solid {
    la: f64,
    mu: f64,
    curvature: f64,
    capacity: f64,
    eta: f64,
}

#[test]
fn solids_are_checked_per_volume() {
    let solid = Solid {
        la: 2000.0,
        mu: 1000.0,
        curvature: 2.0,
        capacity: 100.0,
        eta: 5.0,
    };
    let domain = |largest| {
        Domain::of_strains([[-0.1, 0.2], [0.0, largest]])
            .with_viscous([-0.1, 0.1])
            .with_temperature([250.0, 400.0])
    };
    // C = c − curvature θ e2
    let report = check_domain(&solid, &domain(0.1), 50).expect("a sound material");
    let least = report.heat_capacity.as_ref().expect("a temperature");
    assert!((least.value - 20.0).abs() < 1e-12);
    let said = report.to_string();
    assert!(
        said.contains("J/(K m³) or more, least at strain 0 "),
        "{said}"
    );
    assert!(said.contains("5.000000 Pa s or more"), "{said}");
    let error = check_domain(&solid, &domain(0.2), 50).expect_err("no heat capacity");
    let said = error.to_string();
    assert!(said.contains(", strain 1 0.2, viscous strain "), "{said}");
    assert!(said.contains(" J/(K m³) at strain 0 "), "{said}");
}

/// Everything flows; the free energy does not mention the trace.
#[derive(FreeEnergy)]
#[free_energy(|e2: StrainSquare, m3: ViscousStrain, m2: ViscousSquare, _m1: ViscousTrace| k * (e2 - 2 * m3 + m2))]
#[viscosity(m3 = eta, _m1 = volumetric)]
struct Flowing {
    k: f64,
    eta: f64,
    volumetric: f64,
}

#[test]
fn viscosities_of_a_viscous_strain_are_checked() {
    let mut solid = Flowing {
        k: 2000.0,
        eta: 5.0,
        volumetric: 7.0,
    };
    let domain = Domain::of_strains([[0.0, 0.1], [-0.1, 0.1], [0.0, 0.1], [-0.1, 0.1]]);
    let report = check_domain(&solid, &domain, 50).expect("a sound material");
    let values: Vec<f64> = report.viscosities.iter().map(|least| least.value).collect();
    assert_eq!(values, [5.0, 7.0]);
    assert!(report.drag.is_none());
    solid.volumetric = 0.0;
    let error = check_domain(&solid, &domain, 50).expect_err("no viscosity");
    let said = error.to_string();
    assert!(
        said.starts_with("the viscosity of dashpot 1 is 0 Pa s"),
        "{said}"
    );
}

#[test]
fn a_solid_is_no_spring() {
    let spring = LogarithmicStiffness::SOFT;
    let strains = Domain::of_strains([[0.0, 0.1]]).with_temperature([200.0, 300.0]);
    let error = check_domain(&spring, &strains, 10).expect_err("a solid");
    assert_eq!(
        error.to_string(),
        "the model has 1 of role `Stretch`, the domain 0"
    );
    let bond = Domain::of_strains([[0.2, 0.1]]);
    assert_eq!(bond.ranges().count(), 1);
}

#[test]
fn the_same_check_gives_the_same_report() {
    let spring = LogarithmicStiffness::SOFT;
    let domain = Domain::of_stretch([1.0, 2.0]).with_temperature([200.0, 400.0]);
    let report = || check_domain(&spring, &domain, 100);
    assert_eq!(report(), report());
}
