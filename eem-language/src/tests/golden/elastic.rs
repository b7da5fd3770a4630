/// Generated from the free energy of the model:
///
/// ```text
/// ψ = 0.5*stiffness*(lambda - length)^2
/// f = ∂ψ/∂lambda = stiffness*(lambda - length)
/// ```
#[automatically_derived]
impl<__S: __eem::Scalar> __eem::FreeEnergy<__S> for Elastic {
    const MEASURES: __eem::core::primitive::usize = 1;
    const DASHPOTS: __eem::core::primitive::usize = 0;
    const THERMAL: __eem::core::primitive::bool = false;
    const MODEL: &'static __eem::core::primitive::str = "Elastic";
    const PARAMETERS: &'static [&'static __eem::core::primitive::str] = &[
        "stiffness",
        "length",
    ];
    type Parameters = [__S; 2];
    type Variables = [__S; 1];
    type Hessian = [[__S; 1]; 1];
    type Viscosities = [__S; 0];
    type Drag = [__S; 0];
    type Corners = [__S; 0];
    type Response = [__S; 1];
    type Tangent = [[__S; 1]; 1];
    type EntropyFormOld = [__S; 2];
    type TemperatureFormOld = [__S; 2];
    /// Free energy ψ.
    ///
    /// 4 operations: 1 addition, 3 multiplications.
    fn free_energy(&self, __x: &Self::Variables) -> __S {
        let __v0 = <__S as __eem::Scalar>::from_f64(self.stiffness);
        let __v1 = __x[0];
        let __v2 = <__S as __eem::Scalar>::from_f64(self.length);
        let __v3 = __v1 - __v2;
        let __v4 = <__S as __eem::Scalar>::from_f64(0.5);
        let __v5 = __v0 * __v4;
        let __v6 = __v3 * __v3;
        let __v7 = __v5 * __v6;
        __v7
    }
    /// There is no temperature: zero.
    fn caloric(&self, _: &Self::Variables) -> __eem::Caloric<__S> {
        let __zero = <__S as __eem::Scalar>::zero();
        __eem::Caloric {
            entropy: __zero,
            heat_capacity: __zero,
            magnitude: __zero,
        }
    }
    /// There is no temperature: zero.
    fn entropy_hessian(&self, _: &Self::Variables) -> Self::Hessian {
        let __row = __eem::Array::filled(<__S as __eem::Scalar>::zero());
        __eem::Array::filled(__row)
    }
    /// There is no dashpot: nothing.
    fn viscosity(&self, _: __S) -> (Self::Viscosities, Self::Viscosities) {
        ([], [])
    }
    /// No dashpot stands beside the spring: nothing.
    fn drag(&self, _: __S) -> (Self::Drag, Self::Drag) {
        ([], [])
    }
    /// There is no temperature: the same as the entropy form.
    fn temperature_form(
        &self,
        __old: &Self::TemperatureFormOld,
        __x1: &Self::Variables,
    ) -> (Self::Response, Self::Tangent) {
        __eem::FreeEnergy::entropy_form(self, __old, __x1, &[])
    }
}
#[automatically_derived]
impl __eem::Describe for Elastic {
    const DESCRIPTION: __eem::Description = __eem::Description {
        name: "Elastic",
        arguments: &[__eem::describe::Argument::new("lambda", "Stretch", "m")],
        parameters: &[
            __eem::describe::Parameter::without_unit("stiffness"),
            __eem::describe::Parameter::without_unit("length"),
        ],
        formulas: &[
            __eem::describe::Formula::new(
                "ψ",
                "ψ = 0.5*stiffness*(lambda - length)^2",
                "J",
            ),
            __eem::describe::Formula::new(
                "f",
                "f = ∂ψ/∂lambda = stiffness*(lambda - length)",
                "N",
            ),
        ],
        divided_differences: &[
            __eem::describe::Formula::new(
                "ψ[lambda]",
                "ψ[lambda⁰, lambda¹] = 0.5*stiffness*(lambda⁰ - length + lambda¹ - length)",
                "N",
            ),
        ],
        costs: &[
            __eem::describe::Cost::new("free_energy", 0, 4),
            __eem::describe::Cost::new("energy_magnitude", 0, 11),
            __eem::describe::Cost::new("internal_energy", 0, 4),
            __eem::describe::Cost::new("gradient", 0, 2),
            __eem::describe::Cost::new("hessian", 0, 2),
            __eem::describe::Cost::new("entropy_form", 2, 3),
        ],
    };
}
