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
    /// Temperature form: what depends on the old state alone.
    ///
    /// 4 operations: 2 additions, 2 multiplications.
    fn temperature_form_old(&self, __x0: &Self::Variables) -> Self::TemperatureFormOld {
        let __v0 = __x0[2];
        let __v5 = <__S as __eem::Scalar>::from_f64(self.k);
        let __v6 = __x0[0];
        let __v7 = __x0[1];
        let __v8 = __v6 - __v7;
        let __v31 = <__S as __eem::Scalar>::from_f64(self.c);
        let __v32 = <__S as __eem::Scalar>::from_f64(2.0);
        let __v33 = __v31 * __v32;
        let __v38 = <__S as __eem::Scalar>::from_f64(0.5);
        let __v39 = __v5 * __v38;
        let __v44 = -__v39;
        [__v0, __v6, __v7, __v8, __v33, __v39, __v44]
    }
    /// Temperature form: algorithmic quantities and their tangent.
    ///
    /// 29 operations: 11 additions, 14 multiplications, 2 divisions, 2 divided differences. Transcendental functions: 0 calls for 1 argument.
    fn temperature_form(
        &self,
        __old: &Self::TemperatureFormOld,
        __x1: &Self::Variables,
    ) -> (Self::Response, Self::Tangent) {
        let __v1 = __x1[2];
        let __v0 = __old[0];
        let __v2 = __eem::kernel::ln_dds(__v0, __v1);
        let __v3 = __v2.first;
        let __v4 = __v2.second_b;
        let __v9 = __x1[0];
        let __v7 = __old[2];
        let __v10 = __v9 - __v7;
        let __v8 = __old[3];
        let __v11 = __v8 + __v10;
        let __v12 = __x1[1];
        let __v6 = __old[1];
        let __v13 = __v6 - __v12;
        let __v14 = __v9 - __v12;
        let __v15 = __v13 + __v14;
        let __v16 = <__S as __eem::Scalar>::from_f64(0.5);
        let __v17 = __v11 * __v16;
        let __v18 = __v15 * __v16;
        let __v19 = __v17 + __v18;
        let __v5 = <__S as __eem::Scalar>::from_f64(self.k);
        let __v20 = __v5 * __v19;
        let __v21 = __v16 * __v20;
        let __v22 = __v8 + __v13;
        let __v23 = __v10 + __v14;
        let __v24 = __v16 * __v22;
        let __v25 = __v16 * __v23;
        let __v26 = __v24 + __v25;
        let __v27 = __v5 * __v26;
        let __v28 = __v16 * __v27;
        let __v29 = <__S as __eem::Scalar>::from_f64(1.0);
        let __v30 = __v29 / __v3;
        let __v33 = __old[4];
        let __v34 = __v3 * __v33;
        let __v35 = __v1 - __v0;
        let __v36 = __v34 * __v35;
        let __v37 = __v16 * __v36;
        let __v40 = __v30 * __v30;
        let __v41 = __v4 * __v40;
        let __v42 = __v29 / __v1;
        let __v31 = <__S as __eem::Scalar>::from_f64(self.c);
        let __v43 = __v31 * __v42;
        let __v45 = <__S as __eem::Scalar>::from_f64(0.0);
        let __v46 = -__v41;
        (
            [__v21, __v28, __v30, __v37],
            [
                [__old[5], __old[6], __v45],
                [__old[5], __old[6], __v45],
                [__v45, __v45, __v46],
                [__v45, __v45, __v43],
            ],
        )
    }
}
