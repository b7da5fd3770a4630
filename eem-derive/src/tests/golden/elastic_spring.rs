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
    /// ψ = 0.5*stiffness*(lambda - length)^2
    /// f = ∂ψ/∂lambda = stiffness*(lambda - length)
    /// ```
    #[automatically_derived]
    impl<__S: __eem::Scalar> __eem::FreeEnergy<__S> for ElasticSpring {
        const MEASURES: __eem::core::primitive::usize = 1;
        const DASHPOTS: __eem::core::primitive::usize = 0;
        const THERMAL: __eem::core::primitive::bool = false;
        const MODEL: &'static __eem::core::primitive::str = "ElasticSpring";
        const PARAMETERS: &'static [&'static __eem::core::primitive::str] = &[
            "stiffness",
            "length",
        ];
        type Variables = [__S; 1];
        type Hessian = [[__S; 1]; 1];
        type Viscosities = [__S; 0];
        type Drag = [__S; 0];
        type Corners = [__S; 0];
        type Response = [__S; 1];
        type Tangent = [[__S; 1]; 1];
        type EntropyFormOld = [__S; 2];
        type TemperatureFormOld = [__S; 2];
        fn parameter(&self, __index: __eem::core::primitive::usize) -> __S {
            let __parameters: [__S; 2] = [
                <__S as __eem::Scalar>::from_f64(self.stiffness),
                <__S as __eem::Scalar>::from_f64(self.length),
            ];
            __parameters[__index]
        }
        fn duplicate(&self) -> Self {
            Self {
                stiffness: __eem::core::clone::Clone::clone(&self.stiffness),
                length: __eem::core::clone::Clone::clone(&self.length),
            }
        }
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
        /// The sum of the magnitudes of the terms of ψ.
        ///
        /// 11 operations: 6 additions, 5 multiplications.
        fn energy_magnitude(&self, __x: &Self::Variables) -> __S {
            let __v0 = __x[0];
            let __v1 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v2 = <__S as __eem::Scalar>::abs(__v1);
            let __v3 = <__S as __eem::Scalar>::from_f64(self.stiffness);
            let __v4 = __v0 - __v1;
            let __v5 = __v3 * __v4;
            let __v6 = <__S as __eem::Scalar>::abs(__v5);
            let __v7 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v8 = __v3 * __v7;
            let __v9 = __v4 * __v4;
            let __v10 = __v8 * __v9;
            let __v11 = <__S as __eem::Scalar>::abs(__v10);
            let __v12 = __v0 + __v2;
            let __v13 = __v12 * __v6;
            let __v14 = __v11 + __v13;
            __v14
        }
        /// Internal energy e = ψ + θ s.
        ///
        /// 4 operations: 1 addition, 3 multiplications.
        fn internal_energy(&self, __x: &Self::Variables) -> __S {
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
        /// Gradient ∂ψ/∂x.
        ///
        /// 2 operations: 1 addition, 1 multiplication.
        fn gradient(&self, __x: &Self::Variables) -> Self::Variables {
            let __v0 = <__S as __eem::Scalar>::from_f64(self.stiffness);
            let __v1 = __x[0];
            let __v2 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v3 = __v1 - __v2;
            let __v4 = __v0 * __v3;
            [__v4]
        }
        /// Gradient ∂ψ/∂x and Hessian ∂²ψ/∂x².
        ///
        /// 2 operations: 1 addition, 1 multiplication.
        fn hessian(&self, __x: &Self::Variables) -> (Self::Variables, Self::Hessian) {
            let __v0 = <__S as __eem::Scalar>::from_f64(self.stiffness);
            let __v1 = __x[0];
            let __v2 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v3 = __v1 - __v2;
            let __v4 = __v0 * __v3;
            ([__v4], [[__v0]])
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
        /// 2 operations: 1 addition, 1 multiplication.
        fn rates(&self, __x: &Self::Variables) -> __eem::Rates<Self::Variables> {
            let __v0 = <__S as __eem::Scalar>::from_f64(self.stiffness);
            let __v1 = __x[0];
            let __v2 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v3 = __v1 - __v2;
            let __v4 = __v0 * __v3;
            __eem::Rates {
                forces: [__v4],
                slopes: [<__S as __eem::Scalar>::zero()],
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
            let __v0 = <__S as __eem::Scalar>::from_f64(self.stiffness);
            let __v1 = __x[0];
            let __v2 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v3 = __v1 - __v2;
            let __v4 = __v0 * __v3;
            let __v5 = __v3 * __v3;
            let __v6 = __v0 * __v5;
            let __v7 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v8 = __v6 * __v7;
            move |_| {
                (
                    __eem::Rates {
                        forces: [__v4],
                        slopes: [<__S as __eem::Scalar>::zero()],
                    },
                    [<__S as __eem::Scalar>::zero(), __v8],
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
        /// 2 operations: 1 addition, 1 multiplication.
        fn entropy_form_old(&self, __x0: &Self::Variables) -> Self::EntropyFormOld {
            let __v0 = <__S as __eem::Scalar>::from_f64(self.stiffness);
            let __v1 = __x0[0];
            let __v2 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v3 = __v1 - __v2;
            let __v7 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v8 = __v0 * __v7;
            [__v3, __v8]
        }
        /// Entropy form: algorithmic quantities and their tangent.
        ///
        /// 3 operations: 2 additions, 1 multiplication.
        fn entropy_form(
            &self,
            __old: &Self::EntropyFormOld,
            __x1: &Self::Variables,
            _: &Self::Corners,
        ) -> (Self::Response, Self::Tangent) {
            let __v4 = __x1[0];
            let __v2 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v5 = __v4 - __v2;
            let __v3 = __old[0];
            let __v6 = __v3 + __v5;
            let __v8 = __old[1];
            let __v9 = __v6 * __v8;
            ([__v9], [[__old[1]]])
        }
        /// Entropy form: the same algorithmic quantities without their tangent.
        ///
        /// 3 operations: 2 additions, 1 multiplication.
        fn entropy_form_response(
            &self,
            __old: &Self::EntropyFormOld,
            __x1: &Self::Variables,
            _: &Self::Corners,
        ) -> Self::Response {
            let __v4 = __x1[0];
            let __v2 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v5 = __v4 - __v2;
            let __v3 = __old[0];
            let __v6 = __v3 + __v5;
            let __v8 = __old[1];
            let __v9 = __v6 * __v8;
            [__v9]
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
    impl __eem::Describe for ElasticSpring {
        const DESCRIPTION: __eem::Description = __eem::Description {
            name: "ElasticSpring",
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
};
