#[allow(clippy::unreadable_literal, clippy::excessive_precision)]
#[allow(clippy::approx_constant)]
#[allow(clippy::many_single_char_names, clippy::similar_names)]
#[allow(clippy::too_many_lines, clippy::cognitive_complexity, clippy::let_and_return)]
#[allow(unused_qualifications)]
const _: () = {
    use ::eem::__private as __eem;
    /// Generated from the free energy of the model:
    ///
    /// ```text
    /// ψ = 0.5*e1^2*la + e2*mu
    /// f_1 = ∂ψ/∂e1 = e1*la
    /// f_2 = ∂ψ/∂e2 = mu
    /// ```
    ///
    /// | parameter | unit |
    /// |---|---|
    /// | `la` | `Pa` |
    /// | `mu` | `Pa` |
    #[automatically_derived]
    impl<__S: __eem::Scalar> __eem::FreeEnergy<__S> for ElasticSolid {
        const MEASURES: __eem::core::primitive::usize = 2;
        const DASHPOTS: __eem::core::primitive::usize = 0;
        const THERMAL: __eem::core::primitive::bool = false;
        const PER_VOLUME: __eem::core::primitive::bool = true;
        const MODEL: &'static __eem::core::primitive::str = "ElasticSolid";
        const PARAMETERS: &'static [&'static __eem::core::primitive::str] = &[
            "la",
            "mu",
        ];
        type Variables = [__S; 2];
        type Hessian = [[__S; 2]; 2];
        type Viscosities = [__S; 0];
        type Drag = [__S; 0];
        type Corners = [__S; 0];
        type Response = [__S; 2];
        type Tangent = [[__S; 2]; 2];
        type EntropyFormOld = [__S; 2];
        type TemperatureFormOld = [__S; 2];
        fn parameter(&self, __index: __eem::core::primitive::usize) -> __S {
            let __parameters: [__S; 2] = [
                <__S as __eem::Scalar>::from_f64(self.la),
                <__S as __eem::Scalar>::from_f64(self.mu),
            ];
            __parameters[__index]
        }
        fn duplicate(&self) -> Self {
            Self {
                la: __eem::core::clone::Clone::clone(&self.la),
                mu: __eem::core::clone::Clone::clone(&self.mu),
            }
        }
        /// Free energy ψ.
        ///
        /// 5 operations: 1 addition, 4 multiplications.
        fn free_energy(&self, __x: &Self::Variables) -> __S {
            let __v0 = __x[0];
            let __v1 = <__S as __eem::Scalar>::from_f64(self.la);
            let __v2 = __x[1];
            let __v3 = <__S as __eem::Scalar>::from_f64(self.mu);
            let __v4 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v5 = __v1 * __v4;
            let __v6 = __v0 * __v0;
            let __v7 = __v5 * __v6;
            let __v8 = __v2 * __v3;
            let __v9 = __v7 + __v8;
            __v9
        }
        /// The sum of the magnitudes of the terms of ψ.
        ///
        /// 7 operations: 3 additions, 4 multiplications.
        fn energy_magnitude(&self, __x: &Self::Variables) -> __S {
            let __v0 = __x[0];
            let __v1 = <__S as __eem::Scalar>::from_f64(self.la);
            let __v2 = __v0 * __v0;
            let __v3 = __v1 * __v2;
            let __v4 = <__S as __eem::Scalar>::abs(__v3);
            let __v5 = __x[1];
            let __v6 = <__S as __eem::Scalar>::from_f64(self.mu);
            let __v7 = __v5 * __v6;
            let __v8 = <__S as __eem::Scalar>::abs(__v7);
            let __v9 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v10 = __v4 * __v9;
            let __v11 = __v8 + __v10;
            __v11
        }
        /// Internal energy e = ψ + θ s.
        ///
        /// 5 operations: 1 addition, 4 multiplications.
        fn internal_energy(&self, __x: &Self::Variables) -> __S {
            let __v0 = __x[0];
            let __v1 = <__S as __eem::Scalar>::from_f64(self.la);
            let __v2 = __x[1];
            let __v3 = <__S as __eem::Scalar>::from_f64(self.mu);
            let __v4 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v5 = __v1 * __v4;
            let __v6 = __v0 * __v0;
            let __v7 = __v5 * __v6;
            let __v8 = __v2 * __v3;
            let __v9 = __v7 + __v8;
            __v9
        }
        /// Gradient ∂ψ/∂x.
        ///
        /// 1 multiplication.
        fn gradient(&self, __x: &Self::Variables) -> Self::Variables {
            let __v0 = __x[0];
            let __v1 = <__S as __eem::Scalar>::from_f64(self.la);
            let __v2 = __v0 * __v1;
            let __v3 = <__S as __eem::Scalar>::from_f64(self.mu);
            [__v2, __v3]
        }
        /// Gradient ∂ψ/∂x and Hessian ∂²ψ/∂x².
        ///
        /// 1 multiplication.
        fn hessian(&self, __x: &Self::Variables) -> (Self::Variables, Self::Hessian) {
            let __v0 = __x[0];
            let __v1 = <__S as __eem::Scalar>::from_f64(self.la);
            let __v2 = __v0 * __v1;
            let __v3 = <__S as __eem::Scalar>::from_f64(self.mu);
            let __v4 = <__S as __eem::Scalar>::from_f64(0.0);
            ([__v2, __v3], [[__v1, __v4], [__v4, __v4]])
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
        /// Forces f and g, heat capacity c, slopes of the entropy.
        ///
        /// 1 multiplication.
        fn rates(&self, __x: &Self::Variables) -> __eem::Rates<Self::Variables> {
            let __v0 = __x[0];
            let __v1 = <__S as __eem::Scalar>::from_f64(self.la);
            let __v2 = __v0 * __v1;
            let __v3 = <__S as __eem::Scalar>::from_f64(self.mu);
            __eem::Rates {
                forces: [__v2, __v3],
                slopes: [<__S as __eem::Scalar>::zero(), <__S as __eem::Scalar>::zero()],
            }
        }
        /// The same, the entropy s and the free energy ψ, as functions of the temperature.
        ///
        /// No operations.
        fn rates_at(
            &self,
            __x: Self::Variables,
        ) -> impl __eem::core::ops::Fn(
            __S,
        ) -> (__eem::Rates<Self::Variables>, [__S; 2]) {
            let __v0 = __x[0];
            let __v1 = <__S as __eem::Scalar>::from_f64(self.la);
            let __v2 = __v0 * __v1;
            let __v3 = <__S as __eem::Scalar>::from_f64(self.mu);
            let __v4 = __v0 * __v0;
            let __v5 = __v1 * __v4;
            let __v6 = __x[1];
            let __v7 = __v3 * __v6;
            let __v8 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v9 = __v5 * __v8;
            let __v10 = __v7 + __v9;
            move |_| {
                (
                    __eem::Rates {
                        forces: [__v2, __v3],
                        slopes: [
                            <__S as __eem::Scalar>::zero(),
                            <__S as __eem::Scalar>::zero(),
                        ],
                    },
                    [<__S as __eem::Scalar>::zero(), __v10],
                )
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
        /// Entropy form: what depends on the old state alone.
        ///
        /// 1 multiplication.
        fn entropy_form_old(&self, __x0: &Self::Variables) -> Self::EntropyFormOld {
            let __v0 = <__S as __eem::Scalar>::from_f64(self.la);
            let __v1 = __x0[0];
            let __v4 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v5 = __v0 * __v4;
            [__v1, __v5]
        }
        /// Entropy form: algorithmic quantities and their tangent.
        ///
        /// 2 operations: 1 addition, 1 multiplication.
        fn entropy_form(
            &self,
            __old: &Self::EntropyFormOld,
            __x1: &Self::Variables,
            _: &Self::Corners,
        ) -> (Self::Response, Self::Tangent) {
            let __v2 = __x1[0];
            let __v1 = __old[0];
            let __v3 = __v1 + __v2;
            let __v5 = __old[1];
            let __v6 = __v3 * __v5;
            let __v8 = <__S as __eem::Scalar>::from_f64(0.0);
            (
                [__v6, <__S as __eem::Scalar>::from_f64(self.mu)],
                [[__old[1], __v8], [__v8, __v8]],
            )
        }
        /// Entropy form: the same algorithmic quantities without their tangent.
        ///
        /// 2 operations: 1 addition, 1 multiplication.
        fn entropy_form_response(
            &self,
            __old: &Self::EntropyFormOld,
            __x1: &Self::Variables,
            _: &Self::Corners,
        ) -> Self::Response {
            let __v2 = __x1[0];
            let __v1 = __old[0];
            let __v3 = __v1 + __v2;
            let __v5 = __old[1];
            let __v6 = __v3 * __v5;
            [__v6, <__S as __eem::Scalar>::from_f64(self.mu)]
        }
        /// There is no temperature: the same as the entropy form.
        fn temperature_form_old(
            &self,
            __x0: &Self::Variables,
        ) -> Self::TemperatureFormOld {
            __eem::FreeEnergy::entropy_form_old(self, __x0)
        }
        /// There is no temperature: the same as the entropy form.
        fn temperature_form(
            &self,
            __old: &Self::TemperatureFormOld,
            __x1: &Self::Variables,
        ) -> (Self::Response, Self::Tangent) {
            __eem::FreeEnergy::entropy_form(self, __old, __x1, &[])
        }
        /// There is no temperature: the same as the entropy form.
        fn temperature_form_response(
            &self,
            __old: &Self::TemperatureFormOld,
            __x1: &Self::Variables,
        ) -> Self::Response {
            __eem::FreeEnergy::entropy_form_response(self, __old, __x1, &[])
        }
    }
    #[automatically_derived]
    impl __eem::StrainEnergy<2> for ElasticSolid {
        const STRAINS: [__eem::Strain; 2] = [
            __eem::Strain::Trace,
            __eem::Strain::Square,
        ];
        type AtPoint<__S: __eem::Real> = Self where Self: __eem::Material<__S>;
        fn at_point<__S: __eem::Real>(&self) -> Self::AtPoint<__S>
        where
            Self: __eem::Material<__S>,
        {
            __eem::FreeEnergy::<__S>::duplicate(self)
        }
    }
    #[automatically_derived]
    impl __eem::Describe for ElasticSolid {
        const DESCRIPTION: __eem::Description = __eem::Description {
            name: "ElasticSolid",
            arguments: &[
                __eem::describe::Argument::new("e1", "StrainTrace", "1"),
                __eem::describe::Argument::new("e2", "StrainSquare", "1"),
            ],
            parameters: &[
                __eem::describe::Parameter::new("la", "Pa"),
                __eem::describe::Parameter::new("mu", "Pa"),
            ],
            formulas: &[
                __eem::describe::Formula::new("ψ", "ψ = 0.5*e1^2*la + e2*mu", "J/m^3"),
                __eem::describe::Formula::new("f_1", "f_1 = ∂ψ/∂e1 = e1*la", "Pa"),
                __eem::describe::Formula::new("f_2", "f_2 = ∂ψ/∂e2 = mu", "Pa"),
            ],
            divided_differences: &[
                __eem::describe::Formula::new(
                    "ψ[e1]",
                    "ψ[e1⁰, e1¹] = 0.5*la*(e1⁰ + e1¹)",
                    "Pa",
                ),
                __eem::describe::Formula::new("ψ[e2]", "ψ[e2⁰, e2¹] = mu", "Pa"),
            ],
            costs: &[
                __eem::describe::Cost::new("free_energy", 0, 5),
                __eem::describe::Cost::new("energy_magnitude", 0, 7),
                __eem::describe::Cost::new("internal_energy", 0, 5),
                __eem::describe::Cost::new("gradient", 0, 1),
                __eem::describe::Cost::new("hessian", 0, 1),
                __eem::describe::Cost::new("entropy_form", 1, 2),
            ],
        };
    }
};
