/// Generated from the free energy of the model:
///
/// ```text
/// ψ = mu*(e2 - 2*m3 + m2) + bulk[0]*ln_1p(j) + j^2*bulk[1]*NU
/// f_1 = ∂ψ/∂e2 = mu
/// f_2 = ∂ψ/∂j = bulk[0]/(j + 1) + 2*j*bulk[1]*NU
/// f_3 = ∂ψ/∂m3 = -2*mu
/// f_4 = ∂ψ/∂m2 = mu
/// η = eta
/// ```
#[automatically_derived]
impl<T> __eem::FreeEnergy<T> for Flowing<T>
where
    T: __eem::Scalar,
{
    const MEASURES: __eem::core::primitive::usize = 4;
    const DASHPOTS: __eem::core::primitive::usize = 0;
    const THERMAL: __eem::core::primitive::bool = false;
    const PER_VOLUME: __eem::core::primitive::bool = true;
    const MODEL: &'static __eem::core::primitive::str = "Flowing";
    const PARAMETERS: &'static [&'static __eem::core::primitive::str] = &[
        "mu",
        "bulk[0]",
        "bulk[1]",
        "eta",
        "NU",
    ];
    type Parameters = [T; 5];
    type Variables = [T; 4];
    type Hessian = [[T; 4]; 4];
    type Viscosities = [T; 1];
    type Drag = [T; 0];
    type Corners = [T; 0];
    type Response = [T; 4];
    type Tangent = [[T; 4]; 4];
    type EntropyFormOld = [T; 3];
    type TemperatureFormOld = [T; 3];
    fn parameter(&self, __index: __eem::core::primitive::usize) -> T {
        let __parameters: [T; 5] = [
            self.mu,
            self.bulk[0],
            self.bulk[1],
            <T as __eem::Scalar>::from_f64(__eem::core::convert::From::from(self.eta)),
            <T as __eem::Scalar>::from_f64(__eem::core::convert::From::from(NU)),
        ];
        __parameters[__index]
    }
    fn duplicate(&self) -> Self {
        Self {
            mu: __eem::core::clone::Clone::clone(&self.mu),
            bulk: __eem::core::clone::Clone::clone(&self.bulk),
            eta: __eem::core::clone::Clone::clone(&self.eta),
        }
    }
}
#[automatically_derived]
impl<T> __eem::JointEnergy for Flowing<T> {
    const JOINT: &'static [__eem::Joint] = &[__eem::Joint::Strain, __eem::Joint::Square];
}
#[automatically_derived]
impl<T> __eem::StrainEnergy<7> for Flowing<T> {
    const STRAINS: [__eem::Strain; 7] = [
        __eem::Strain::Square,
        __eem::Strain::Dilatation,
        __eem::Strain::Component(0),
        __eem::Strain::Component(1),
        __eem::Strain::Component(2),
        __eem::Strain::Component(3),
        __eem::Strain::Component(4),
    ];
    type AtPoint = __eem::ComponentEnergy<Self, 12, 5, 12, 13, 13>
    where
        Self: __eem::Material;
    fn at_point(&self) -> Self::AtPoint
    where
        Self: __eem::Material,
    {
        __eem::ComponentEnergy::new(
            __eem::FreeEnergy::<__eem::core::primitive::f64>::duplicate(self),
        )
    }
}
#[automatically_derived]
impl<T> __eem::Describe for Flowing<T> {
    const DESCRIPTION: __eem::Description = __eem::Description {
        name: "Flowing",
        arguments: &[
            __eem::describe::Argument::new("e2", "StrainSquare", "1"),
            __eem::describe::Argument::new("j", "Dilatation", "1"),
            __eem::describe::Argument::new("m3", "ViscousStrain", "1"),
            __eem::describe::Argument::new("m2", "ViscousSquare", "1"),
        ],
        parameters: &[
            __eem::describe::Parameter::without_unit("mu"),
            __eem::describe::Parameter::without_unit("bulk[0]"),
            __eem::describe::Parameter::without_unit("bulk[1]"),
            __eem::describe::Parameter::without_unit("eta"),
            __eem::describe::Parameter::without_unit("NU"),
        ],
        formulas: &[
            __eem::describe::Formula::new(
                "ψ",
                "ψ = mu*(e2 - 2*m3 + m2) + bulk[0]*ln_1p(j) + j^2*bulk[1]*NU",
                "J/m^3",
            ),
            __eem::describe::Formula::new("f_1", "f_1 = ∂ψ/∂e2 = mu", "Pa"),
            __eem::describe::Formula::new(
                "f_2",
                "f_2 = ∂ψ/∂j = bulk[0]/(j + 1) + 2*j*bulk[1]*NU",
                "Pa",
            ),
            __eem::describe::Formula::new("f_3", "f_3 = ∂ψ/∂m3 = -2*mu", "Pa"),
            __eem::describe::Formula::new("f_4", "f_4 = ∂ψ/∂m2 = mu", "Pa"),
            __eem::describe::Formula::new("η", "η = eta", "Pa s"),
        ],
        divided_differences: &[
            __eem::describe::Formula::new("ψ[e2]", "ψ[e2⁰, e2¹] = mu", "Pa"),
            __eem::describe::Formula::new(
                "ψ[j]",
                "ψ[j⁰, j¹] = bulk[0]*ln_1p[j⁰, j¹] + bulk[1]*NU*(j⁰ + j¹)",
                "Pa",
            ),
            __eem::describe::Formula::new("ψ[m3]", "ψ[m3⁰, m3¹] = -2*mu", "Pa"),
            __eem::describe::Formula::new("ψ[m2]", "ψ[m2⁰, m2¹] = mu", "Pa"),
        ],
        costs: &[
            __eem::describe::Cost::new("free_energy", 0, 11),
            __eem::describe::Cost::new("energy_magnitude", 0, 20),
            __eem::describe::Cost::new("internal_energy", 0, 11),
            __eem::describe::Cost::new("gradient", 0, 9),
            __eem::describe::Cost::new("hessian", 0, 14),
            __eem::describe::Cost::new("viscosity", 0, 0),
            __eem::describe::Cost::new("entropy_form", 3, 8),
        ],
    };
}
