#[allow(clippy::unreadable_literal, clippy::excessive_precision)]
#[allow(clippy::many_single_char_names, clippy::similar_names)]
#[allow(clippy::too_many_lines, clippy::cognitive_complexity, clippy::let_and_return)]
#[allow(unused_qualifications)]
const _: () = {
    use ::eem::__private as __eem;
    /// Generated from the free energy of the model:
    ///
    /// ```text
    /// ψ = stiffness*(lambda - gamma)^2
    /// f = ∂ψ/∂lambda = 2*stiffness*(lambda - gamma)
    /// g = −∂ψ/∂gamma = -2*stiffness*(gamma - lambda)
    /// η = eta
    /// ```
    #[automatically_derived]
    impl<T> __eem::FreeEnergy<T> for MaxwellElement<T>
    where
        T: __eem::Scalar,
    {
        const MEASURES: __eem::core::primitive::usize = 1;
        const DASHPOTS: __eem::core::primitive::usize = 1;
        const THERMAL: __eem::core::primitive::bool = false;
        const PARAMETERS: &'static [&'static __eem::core::primitive::str] = &[
            "stiffness",
            "eta",
        ];
        type Variables = [T; 2];
        type Hessian = [[T; 2]; 2];
        type Viscosities = [T; 1];
        type Corners = [T; 0];
        type Response = [T; 2];
        type Tangent = [[T; 2]; 2];
        type EntropyFormOld = [T; 7];
        type TemperatureFormOld = [T; 7];
        fn parameter(&self, __index: __eem::core::primitive::usize) -> T {
            let __parameters: [T; 2] = [self.stiffness, self.eta];
            __parameters[__index]
        }
        /// Free energy ψ.
        ///
        /// 3 operations: 1 addition, 2 multiplications.
        fn free_energy(&self, __x: &Self::Variables) -> T {
            let __v0 = self.stiffness;
            let __v1 = __x[0];
            let __v2 = __x[1];
            let __v3 = __v1 - __v2;
            let __v4 = __v3 * __v3;
            let __v5 = __v0 * __v4;
            __v5
        }
        /// Internal energy e = ψ + θ s.
        ///
        /// 3 operations: 1 addition, 2 multiplications.
        fn internal_energy(&self, __x: &Self::Variables) -> T {
            let __v0 = self.stiffness;
            let __v1 = __x[0];
            let __v2 = __x[1];
            let __v3 = __v1 - __v2;
            let __v4 = __v3 * __v3;
            let __v5 = __v0 * __v4;
            __v5
        }
        /// Gradient ∂ψ/∂x.
        ///
        /// 6 operations: 2 additions, 4 multiplications.
        fn gradient(&self, __x: &Self::Variables) -> Self::Variables {
            let __v0 = self.stiffness;
            let __v1 = __x[0];
            let __v2 = __x[1];
            let __v3 = __v1 - __v2;
            let __v4 = __v0 * __v3;
            let __v5 = <T as __eem::Scalar>::from_f64(2.0);
            let __v6 = __v4 * __v5;
            let __v7 = __v2 - __v1;
            let __v8 = __v0 * __v7;
            let __v9 = __v5 * __v8;
            [__v6, __v9]
        }
        /// Gradient ∂ψ/∂x and Hessian ∂²ψ/∂x².
        ///
        /// 8 operations: 3 additions, 5 multiplications.
        fn hessian(&self, __x: &Self::Variables) -> (Self::Variables, Self::Hessian) {
            let __v0 = self.stiffness;
            let __v1 = __x[0];
            let __v2 = __x[1];
            let __v3 = __v1 - __v2;
            let __v4 = __v0 * __v3;
            let __v5 = <T as __eem::Scalar>::from_f64(2.0);
            let __v6 = __v4 * __v5;
            let __v7 = __v2 - __v1;
            let __v8 = __v0 * __v7;
            let __v9 = __v5 * __v8;
            let __v10 = <T as __eem::Scalar>::from_f64(2.0);
            let __v11 = __v0 * __v10;
            let __v12 = -__v11;
            ([__v6, __v9], [[__v11, __v12], [__v12, __v11]])
        }
        /// There is no temperature: zero.
        fn caloric(&self, _: &Self::Variables) -> __eem::Caloric<T> {
            let __zero = <T as __eem::Scalar>::zero();
            __eem::Caloric {
                entropy: __zero,
                heat_capacity: __zero,
                magnitude: __zero,
            }
        }
        /// Viscosities η and dη/dθ.
        ///
        /// No operations.
        fn viscosity(&self, _: T) -> (Self::Viscosities, Self::Viscosities) {
            let __v0 = self.eta;
            let __v1 = <T as __eem::Scalar>::from_f64(0.0);
            ([__v0], [__v1])
        }
        /// Entropy form: what the old state decides.
        ///
        /// 6 operations: 4 additions, 2 multiplications.
        fn entropy_form_old(&self, __x0: &Self::Variables) -> Self::EntropyFormOld {
            let __v0 = self.stiffness;
            let __v1 = __x0[0];
            let __v2 = __x0[1];
            let __v3 = __v1 - __v2;
            let __v25 = <T as __eem::Scalar>::from_f64(2.0);
            let __v26 = __v0 * __v25;
            let __v27 = -__v26;
            let __v28 = <T as __eem::Scalar>::from_f64(0.5);
            let __v29 = __v27 * __v28;
            let __v30 = -__v29;
            let __v31 = -__v0;
            [__v0, __v1, __v2, __v3, __v29, __v30, __v31]
        }
        /// Entropy form: algorithmic quantities at the corner temperatures, and their tangent.
        ///
        /// 18 operations: 12 additions, 6 multiplications.
        fn entropy_form(
            &self,
            __old: &Self::EntropyFormOld,
            __x1: &Self::Variables,
            _: &Self::Corners,
        ) -> (Self::Response, Self::Tangent) {
            let [__v0, __v1, __v2, __v3, __v29, __v30, __v31] = *__old;
            let __v4 = __x1[0];
            let __v5 = __v4 - __v2;
            let __v6 = __v3 + __v5;
            let __v7 = __v0 * __v6;
            let __v8 = __x1[1];
            let __v9 = __v1 - __v8;
            let __v10 = __v4 - __v8;
            let __v11 = __v9 + __v10;
            let __v12 = __v0 * __v11;
            let __v13 = __v7 + __v12;
            let __v14 = <T as __eem::Scalar>::from_f64(0.5);
            let __v15 = __v13 * __v14;
            let __v16 = __v5 + __v10;
            let __v17 = __v0 * __v16;
            let __v18 = -__v17;
            let __v19 = __v3 + __v9;
            let __v20 = __v0 * __v19;
            let __v21 = -__v20;
            let __v22 = __v18 + __v21;
            let __v23 = __v14 * __v22;
            let __v24 = -__v23;
            ([__v15, __v24], [[__v0, __v29], [__v30, __v31]])
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
    }
};
