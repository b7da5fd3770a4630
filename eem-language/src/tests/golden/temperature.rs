/// Generated from the free energy of the model:
///
/// ```text
/// ψ = 0.5*k*(lambda - gamma)^2 - theta*c*ln(theta)
/// s = −∂ψ/∂theta = c*(ln(theta) + 1)
/// e = ψ + theta s = theta*c + 0.5*k*(lambda - gamma)^2
/// f = ∂ψ/∂lambda = k*(lambda - gamma)
/// g = −∂ψ/∂gamma = -k*(gamma - lambda)
/// c = theta ∂s/∂theta = c
/// η = eta*exp(activation/theta)
/// η[lambda] = eta
/// ```
#[automatically_derived]
impl<__S: __eem::Scalar> __eem::FreeEnergy<__S> for Thermal {
    /// The same, and the free energy ψ, as functions of the temperature.
    ///
    /// 9 operations: 4 additions, 4 multiplications, 1 function. Transcendental functions: 1 call for 1 argument.
    fn caloric_at(
        &self,
        __x: Self::Variables,
    ) -> impl __eem::core::ops::Fn(__S) -> (__eem::Caloric<__S>, __S) {
        let __v0 = <__S as __eem::Scalar>::from_f64(self.c);
        let __v4 = <__S as __eem::Scalar>::abs(__v0);
        let __v10 = <__S as __eem::Scalar>::from_f64(self.k);
        let __v11 = __x[0];
        let __v12 = __x[1];
        let __v13 = __v11 - __v12;
        let __v14 = __v13 * __v13;
        let __v15 = __v10 * __v14;
        let __v16 = <__S as __eem::Scalar>::from_f64(0.5);
        let __v17 = __v15 * __v16;
        move |__theta| {
            let __v1 = __theta;
            let __v2 = <__S as __eem::Scalar>::ln(__v1);
            let __v3 = <__S as __eem::Scalar>::abs(__v2);
            let __v5 = <__S as __eem::Scalar>::from_f64(1.0);
            let __v6 = __v2 + __v5;
            let __v7 = __v0 * __v6;
            let __v8 = __v5 + __v3;
            let __v9 = __v8 * __v4;
            let __v18 = __v0 * __v1;
            let __v19 = __v2 * __v18;
            let __v20 = __v17 - __v19;
            let __caloric = __eem::Caloric {
                entropy: __v7,
                heat_capacity: __v0,
                magnitude: __v9,
            };
            (__caloric, __v20)
        }
    }
    /// The same, the entropy s and the free energy ψ, as functions of the temperature.
    ///
    /// 6 operations: 2 additions, 3 multiplications, 1 function. Transcendental functions: 1 call for 1 argument.
    fn rates_at(
        &self,
        __x: Self::Variables,
    ) -> impl __eem::core::ops::Fn(__S) -> (__eem::Rates<Self::Variables>, [__S; 2]) {
        let __v2 = <__S as __eem::Scalar>::from_f64(self.k);
        let __v3 = __x[0];
        let __v4 = __x[1];
        let __v5 = __v3 - __v4;
        let __v6 = __v2 * __v5;
        let __v7 = __v4 - __v3;
        let __v8 = __v2 * __v7;
        let __v9 = <__S as __eem::Scalar>::from_f64(self.c);
        let __v13 = __v5 * __v5;
        let __v14 = __v2 * __v13;
        let __v15 = <__S as __eem::Scalar>::from_f64(0.5);
        let __v16 = __v14 * __v15;
        let __v20 = -__v8;
        move |__theta| {
            let __v0 = __theta;
            let __v1 = <__S as __eem::Scalar>::ln(__v0);
            let __v10 = <__S as __eem::Scalar>::from_f64(1.0);
            let __v11 = __v1 + __v10;
            let __v12 = __v9 * __v11;
            let __v17 = __v9 * __v0;
            let __v18 = __v1 * __v17;
            let __v19 = __v16 - __v18;
            let __v21 = <__S as __eem::Scalar>::from_f64(0.0);
            (
                __eem::Rates {
                    forces: [__v6, __v20, __v9],
                    slopes: [__v21, __v21, <__S as __eem::Scalar>::zero()],
                },
                [__v12, __v19],
            )
        }
    }
}
