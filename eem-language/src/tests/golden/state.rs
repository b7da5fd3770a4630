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
    /// Gradient ∂ψ/∂x and Hessian ∂²ψ/∂x².
    ///
    /// 11 operations: 6 additions, 3 multiplications, 1 division, 1 function.
    fn hessian(&self, __x: &Self::Variables) -> (Self::Variables, Self::Hessian) {
        let __v0 = __x[2];
        let __v1 = <__S as __eem::Scalar>::ln(__v0);
        let __v2 = <__S as __eem::Scalar>::from_f64(self.k);
        let __v3 = __x[0];
        let __v4 = __x[1];
        let __v5 = __v3 - __v4;
        let __v6 = __v2 * __v5;
        let __v7 = <__S as __eem::Scalar>::from_f64(self.c);
        let __v8 = <__S as __eem::Scalar>::from_f64(1.0);
        let __v9 = __v1 + __v8;
        let __v10 = __v7 * __v9;
        let __v11 = __v8 / __v0;
        let __v12 = __v7 * __v11;
        let __v13 = -__v6;
        let __v14 = -__v10;
        let __v15 = -__v2;
        let __v16 = <__S as __eem::Scalar>::from_f64(0.0);
        let __v17 = -__v12;
        (
            [__v6, __v13, __v14],
            [[__v2, __v15, __v16], [__v15, __v2, __v16], [__v16, __v16, __v17]],
        )
    }
    /// Entropy s, heat capacity θ ∂s/∂θ, and the sum of the magnitudes of the terms of s.
    ///
    /// 7 operations: 4 additions, 2 multiplications, 1 function.
    fn caloric(&self, __x: &Self::Variables) -> __eem::Caloric<__S> {
        let __v0 = <__S as __eem::Scalar>::from_f64(self.c);
        let __v1 = __x[2];
        let __v2 = <__S as __eem::Scalar>::ln(__v1);
        let __v3 = <__S as __eem::Scalar>::abs(__v2);
        let __v4 = <__S as __eem::Scalar>::abs(__v0);
        let __v5 = <__S as __eem::Scalar>::from_f64(1.0);
        let __v6 = __v2 + __v5;
        let __v7 = __v0 * __v6;
        let __v8 = __v5 + __v3;
        let __v9 = __v8 * __v4;
        __eem::Caloric {
            entropy: __v7,
            heat_capacity: __v0,
            magnitude: __v9,
        }
    }
    /// Forces f and g, heat capacity c, slopes of the entropy.
    ///
    /// 2 operations: 1 addition, 1 multiplication.
    fn rates(&self, __x: &Self::Variables) -> __eem::Rates<Self::Variables> {
        let __v0 = <__S as __eem::Scalar>::from_f64(self.k);
        let __v1 = __x[0];
        let __v2 = __x[1];
        let __v3 = __v1 - __v2;
        let __v4 = __v0 * __v3;
        let __v5 = <__S as __eem::Scalar>::from_f64(self.c);
        let __v6 = <__S as __eem::Scalar>::from_f64(0.0);
        __eem::Rates {
            forces: [__v4, __v4, __v5],
            slopes: [__v6, __v6, <__S as __eem::Scalar>::zero()],
        }
    }
    /// Hessian of the entropy, ∂²s/∂x².
    ///
    /// 4 operations: 1 addition, 2 multiplications, 1 division.
    fn entropy_hessian(&self, __x: &Self::Variables) -> Self::Hessian {
        let __v0 = __x[2];
        let __v1 = <__S as __eem::Scalar>::from_f64(self.c);
        let __v2 = <__S as __eem::Scalar>::from_f64(1.0);
        let __v3 = __v2 / __v0;
        let __v4 = __v3 * __v3;
        let __v5 = __v1 * __v4;
        let __v6 = <__S as __eem::Scalar>::from_f64(0.0);
        let __v7 = -__v5;
        [[__v6, __v6, __v6], [__v6, __v6, __v6], [__v6, __v6, __v7]]
    }
    /// Viscosities η and dη/dθ.
    ///
    /// 9 operations: 1 addition, 5 multiplications, 2 divisions, 1 function.
    fn viscosity(&self, __theta: __S) -> (Self::Viscosities, Self::Viscosities) {
        let __v0 = __theta;
        let __v1 = <__S as __eem::Scalar>::from_f64(self.activation);
        let __v2 = __v1 / __v0;
        let __v3 = <__S as __eem::Scalar>::exp(__v2);
        let __v4 = <__S as __eem::Scalar>::from_f64(self.eta);
        let __v5 = __v4 * __v3;
        let __v6 = __v4 * __v1;
        let __v7 = <__S as __eem::Scalar>::from_f64(1.0);
        let __v8 = __v7 / __v0;
        let __v9 = __v8 * __v8;
        let __v10 = __v6 * __v9;
        let __v11 = __v3 * __v10;
        let __v12 = -__v11;
        ([__v5], [__v12])
    }
    /// Viscosity η of the stretch and dη/dθ.
    ///
    /// No operations.
    fn drag(&self, __theta: __S) -> (Self::Drag, Self::Drag) {
        let __v0 = <__S as __eem::Scalar>::from_f64(self.eta);
        let __v1 = <__S as __eem::Scalar>::from_f64(0.0);
        ([__v0], [__v1])
    }
}
