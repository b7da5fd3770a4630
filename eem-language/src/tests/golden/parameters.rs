/// Generated from the free energy of the model:
///
/// ```text
/// ψ = 0.5*k*(lambda - gamma)^2
/// f = ∂ψ/∂lambda = k*(lambda - gamma)
/// g = −∂ψ/∂gamma = -k*(gamma - lambda)
/// η = eta
/// ```
#[automatically_derived]
impl<__S: __eem::Scalar> __eem::FreeEnergy<__S> for Maxwell {
    /// Entropy form: derivatives of weighted algorithmic quantities by the parameters.
    ///
    /// 18 operations: 11 additions, 7 multiplications.
    fn entropy_form_adjoint(
        &self,
        __x0: &Self::Variables,
        __x1: &Self::Variables,
        __corners: &Self::Corners,
        __weights: &Self::Response,
    ) -> Self::Parameters {
        let __v0 = __x0[0];
        let __v1 = __x0[1];
        let __v2 = __v0 - __v1;
        let __v3 = __x1[0];
        let __v4 = __v3 - __v1;
        let __v5 = __v2 + __v4;
        let __v6 = <__S as __eem::Scalar>::from_f64(0.5);
        let __v7 = __x1[1];
        let __v8 = __v0 - __v7;
        let __v9 = __v3 - __v7;
        let __v10 = __v8 + __v9;
        let __v11 = __v4 + __v9;
        let __v12 = __v2 + __v8;
        let __v13 = __weights[0];
        let __v14 = __weights[1];
        let __v15 = __v6 * __v14;
        let __v16 = __v12 * __v15;
        let __v17 = __v11 * __v15;
        let __v18 = __v16 + __v17;
        let __v19 = __v6 * __v13;
        let __v20 = __v10 * __v19;
        let __v21 = __v18 + __v20;
        let __v22 = __v5 * __v19;
        let __v23 = __v21 + __v22;
        let __v24 = __v6 * __v23;
        let __v25 = <__S as __eem::Scalar>::from_f64(0.0);
        [__v24, __v25]
    }
    /// There is no temperature: the same as the entropy form.
    fn temperature_form_tangent(
        &self,
        __x0: &Self::Variables,
        __x1: &Self::Variables,
        __direction: &Self::Parameters,
    ) -> Self::Response {
        __eem::FreeEnergy::entropy_form_tangent(self, __x0, __x1, &[], __direction)
    }
    /// Derivatives of weighted components of the gradient ∂ψ/∂x by the parameters.
    ///
    /// 3 operations: 2 additions, 1 multiplication.
    fn gradient_adjoint(
        &self,
        __x: &Self::Variables,
        __weights: &Self::Variables,
    ) -> Self::Parameters {
        let __v0 = __x[0];
        let __v1 = __x[1];
        let __v2 = __v0 - __v1;
        let __v3 = __weights[0];
        let __v4 = __weights[1];
        let __v5 = __v3 - __v4;
        let __v6 = __v2 * __v5;
        let __v7 = <__S as __eem::Scalar>::from_f64(0.0);
        [__v6, __v7]
    }
    /// Derivatives of the internal energy e by the parameters.
    ///
    /// 3 operations: 1 addition, 2 multiplications.
    fn energy_by_parameters(&self, __x: &Self::Variables) -> Self::Parameters {
        let __v0 = __x[0];
        let __v1 = __x[1];
        let __v2 = __v0 - __v1;
        let __v3 = <__S as __eem::Scalar>::from_f64(0.5);
        let __v4 = __v2 * __v2;
        let __v5 = __v3 * __v4;
        let __v6 = <__S as __eem::Scalar>::from_f64(0.0);
        [__v5, __v6]
    }
    /// Derivatives of weighted viscosities by the parameters.
    ///
    /// No operations.
    fn viscosity_adjoint(
        &self,
        __theta: __S,
        __weights: &Self::Viscosities,
    ) -> Self::Parameters {
        let __v0 = __weights[0];
        let __v1 = <__S as __eem::Scalar>::from_f64(0.0);
        [__v1, __v0]
    }
    /// There is no such viscosity: zero.
    fn drag_adjoint(&self, __theta: __S, __weights: &Self::Drag) -> Self::Parameters {
        __eem::Array::filled(<__S as __eem::Scalar>::zero())
    }
}
