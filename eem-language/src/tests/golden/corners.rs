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
    /// Entropy form: what depends on the old state alone.
    ///
    /// 4 operations: 2 additions, 1 multiplication, 1 division.
    fn entropy_form_old(&self, __x0: &Self::Variables) -> Self::EntropyFormOld {
        let __form: [__S; 7] = {
            let __v4 = __x0[2];
            let __v11 = <__S as __eem::Scalar>::from_f64(self.k);
            let __v12 = __x0[0];
            let __v13 = __x0[1];
            let __v14 = __v12 - __v13;
            let __v18 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v19 = __v11 * __v18;
            let __v40 = <__S as __eem::Scalar>::from_f64(self.c);
            let __v44 = <__S as __eem::Scalar>::from_f64(1.0);
            let __v45 = __v44 / __v40;
            let __v61 = -__v19;
            [__v4, __v12, __v13, __v14, __v19, __v45, __v61]
        };
        let __mixed: [__S; 1] = {
            let __v0 = __x0[2];
            [__v0]
        };
        [
            __form[0],
            __form[1],
            __form[2],
            __form[3],
            __form[4],
            __form[5],
            __form[6],
            __mixed[0],
        ]
    }
    /// Entropy form: the same algorithmic quantities without their tangent.
    ///
    /// 25 operations: 11 additions, 9 multiplications, 2 divisions, 3 divided differences. Transcendental functions: 0 calls for 3 arguments.
    fn entropy_form_response(
        &self,
        __old: &Self::EntropyFormOld,
        __x1: &Self::Variables,
        __corners: &Self::Corners,
    ) -> Self::Response {
        let __v0 = __x1[2];
        let __v1 = __corners[1];
        let __v2 = __eem::kernel::ln_dd(__v0, __v1);
        let __v4 = __corners[3];
        let __v3 = __old[0];
        let __v5 = __eem::kernel::ln_dd(__v3, __v4);
        let __v6 = __eem::kernel::ln_dd(__v3, __v0);
        let __v11 = __x1[0];
        let __v9 = __old[2];
        let __v12 = __v11 - __v9;
        let __v10 = __old[3];
        let __v13 = __v10 + __v12;
        let __v15 = __old[4];
        let __v16 = __v13 * __v15;
        let __v17 = __x1[1];
        let __v8 = __old[1];
        let __v18 = __v8 - __v17;
        let __v19 = __v11 - __v17;
        let __v20 = __v18 + __v19;
        let __v21 = __v15 * __v20;
        let __v22 = __v16 + __v21;
        let __v23 = <__S as __eem::Scalar>::from_f64(0.5);
        let __v24 = __v22 * __v23;
        let __v25 = __v12 + __v19;
        let __v26 = __v15 * __v25;
        let __v27 = __v10 + __v18;
        let __v28 = __v15 * __v27;
        let __v29 = __v26 + __v28;
        let __v30 = __v23 * __v29;
        let __v31 = <__S as __eem::Scalar>::from_f64(1.0);
        let __v32 = __v31 / __v2;
        let __v33 = __v31 / __v5;
        let __v34 = __v32 + __v33;
        let __v35 = __v23 * __v34;
        let __v36 = <__S as __eem::Scalar>::from_f64(self.c);
        let __v37 = __v36 * __v6;
        let __v38 = __v0 - __v3;
        let __v39 = __v37 * __v38;
        [__v24, __v30, __v35, __v39]
    }
    /// By how much the entropies of the corners are too large, and their heat capacities.
    ///
    /// 18 operations: 6 additions, 8 multiplications, 4 divided differences. Transcendental functions: 0 calls for 5 arguments.
    fn mixed_states(
        &self,
        _: &Self::Variables,
        __old: &Self::EntropyFormOld,
        __x1: &Self::Variables,
        __corners: &Self::Corners,
    ) -> [Self::Corners; 2] {
        let __v1 = __corners[0];
        let __v0 = __old[7];
        let __v2 = __eem::kernel::ln_dd(__v0, __v1);
        let __v3 = __corners[1];
        let __v4 = __eem::kernel::ln_dd(__v1, __v3);
        let __v5 = __x1[2];
        let __v6 = __corners[2];
        let __v7 = __eem::kernel::ln_dd(__v5, __v6);
        let __v8 = __corners[3];
        let __v9 = __eem::kernel::ln_dd(__v6, __v8);
        let __v10 = <__S as __eem::Scalar>::from_f64(self.c);
        let __v11 = __v10 * __v2;
        let __v12 = __v1 - __v0;
        let __v13 = __v11 * __v12;
        let __v14 = __v10 * __v4;
        let __v15 = __v3 - __v1;
        let __v16 = __v14 * __v15;
        let __v17 = __v13 + __v16;
        let __v18 = __v10 * __v7;
        let __v19 = __v6 - __v5;
        let __v20 = __v18 * __v19;
        let __v21 = __v10 * __v9;
        let __v22 = __v8 - __v6;
        let __v23 = __v21 * __v22;
        let __v24 = __v20 + __v23;
        [
            [__v13, __v17, __v20, __v24],
            [
                <__S as __eem::Scalar>::from_f64(self.c),
                <__S as __eem::Scalar>::from_f64(self.c),
                <__S as __eem::Scalar>::from_f64(self.c),
                <__S as __eem::Scalar>::from_f64(self.c),
            ],
        ]
    }
}
