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
    /// ψ = 0.5*stiffness*(lambda - length)^2 + 0.5*branch*(lambda - gamma - length)^2
    ///     + capacity*(theta - theta_ref - theta*ln(theta/theta_ref))
    ///     - coupling*(lambda - length)*(theta - theta_ref)
    /// s = −∂ψ/∂theta = coupling*(lambda - length) + capacity*ln(theta/theta_ref)
    /// e = ψ + theta s = 0.5*stiffness*(lambda - length)^2 + 0.5*branch*(lambda - gamma - length)^2
    ///     + capacity*(theta - theta_ref) + coupling*theta_ref*(lambda - length)
    /// f = ∂ψ/∂lambda = stiffness*(lambda - length) + branch*(lambda - gamma - length)
    ///     - coupling*(theta - theta_ref)
    /// g = −∂ψ/∂gamma = -branch*(gamma - lambda + length)
    /// c = theta ∂s/∂theta = capacity
    /// η = eta_ref*exp(activation*(1/theta - 1/theta_ref))
    /// ```
    #[automatically_derived]
    impl<__S: __eem::Scalar> __eem::FreeEnergy<__S> for ThermoViscoElasticSpring {
        const MEASURES: __eem::core::primitive::usize = 1;
        const DASHPOTS: __eem::core::primitive::usize = 1;
        const THERMAL: __eem::core::primitive::bool = true;
        const MODEL: &'static __eem::core::primitive::str = "ThermoViscoElasticSpring";
        const PARAMETERS: &'static [&'static __eem::core::primitive::str] = &[
            "stiffness",
            "branch",
            "length",
            "coupling",
            "capacity",
            "theta_ref",
            "eta_ref",
            "activation",
        ];
        type Variables = [__S; 3];
        type Hessian = [[__S; 3]; 3];
        type Viscosities = [__S; 1];
        type Drag = [__S; 0];
        type Corners = [__S; 4];
        type Response = [__S; 4];
        type Tangent = [[__S; 3]; 4];
        type EntropyFormOld = [__S; 11];
        type TemperatureFormOld = [__S; 10];
        fn parameter(&self, __index: __eem::core::primitive::usize) -> __S {
            let __parameters: [__S; 8] = [
                <__S as __eem::Scalar>::from_f64(self.stiffness),
                <__S as __eem::Scalar>::from_f64(self.branch),
                <__S as __eem::Scalar>::from_f64(self.length),
                <__S as __eem::Scalar>::from_f64(self.coupling),
                <__S as __eem::Scalar>::from_f64(self.capacity),
                <__S as __eem::Scalar>::from_f64(self.theta_ref),
                <__S as __eem::Scalar>::from_f64(self.eta_ref),
                <__S as __eem::Scalar>::from_f64(self.activation),
            ];
            __parameters[__index]
        }
        fn duplicate(&self) -> Self {
            Self {
                stiffness: __eem::core::clone::Clone::clone(&self.stiffness),
                branch: __eem::core::clone::Clone::clone(&self.branch),
                length: __eem::core::clone::Clone::clone(&self.length),
                coupling: __eem::core::clone::Clone::clone(&self.coupling),
                capacity: __eem::core::clone::Clone::clone(&self.capacity),
                theta_ref: __eem::core::clone::Clone::clone(&self.theta_ref),
                eta_ref: __eem::core::clone::Clone::clone(&self.eta_ref),
                activation: __eem::core::clone::Clone::clone(&self.activation),
            }
        }
        /// Free energy ψ.
        ///
        /// 19 operations: 7 additions, 10 multiplications, 1 division, 1 function.
        fn free_energy(&self, __x: &Self::Variables) -> __S {
            let __v0 = __x[2];
            let __v1 = <__S as __eem::Scalar>::from_f64(self.theta_ref);
            let __v2 = __v0 / __v1;
            let __v3 = <__S as __eem::Scalar>::ln(__v2);
            let __v4 = <__S as __eem::Scalar>::from_f64(self.stiffness);
            let __v5 = __x[0];
            let __v6 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v7 = __v6 - __v5;
            let __v8 = <__S as __eem::Scalar>::from_f64(self.branch);
            let __v9 = __x[1];
            let __v10 = __v7 + __v9;
            let __v11 = <__S as __eem::Scalar>::from_f64(self.capacity);
            let __v12 = __v0 * __v3;
            let __v13 = __v1 - __v0;
            let __v14 = __v12 + __v13;
            let __v15 = <__S as __eem::Scalar>::from_f64(self.coupling);
            let __v16 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v17 = __v4 * __v16;
            let __v18 = __v7 * __v7;
            let __v19 = __v17 * __v18;
            let __v20 = __v8 * __v16;
            let __v21 = __v10 * __v10;
            let __v22 = __v20 * __v21;
            let __v23 = __v11 * __v14;
            let __v24 = __v7 * __v15;
            let __v25 = __v13 * __v24;
            let __v26 = __v19 + __v22;
            let __v27 = __v26 - __v23;
            let __v28 = __v27 - __v25;
            __v28
        }
        /// The sum of the magnitudes of the terms of ψ.
        ///
        /// 54 operations: 33 additions, 19 multiplications, 1 division, 1 function.
        fn energy_magnitude(&self, __x: &Self::Variables) -> __S {
            let __v0 = __x[0];
            let __v1 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v2 = <__S as __eem::Scalar>::abs(__v1);
            let __v3 = <__S as __eem::Scalar>::from_f64(self.stiffness);
            let __v4 = __v0 - __v1;
            let __v5 = __v3 * __v4;
            let __v6 = <__S as __eem::Scalar>::abs(__v5);
            let __v7 = <__S as __eem::Scalar>::from_f64(self.coupling);
            let __v8 = __x[2];
            let __v9 = <__S as __eem::Scalar>::from_f64(self.theta_ref);
            let __v10 = __v9 - __v8;
            let __v11 = __v7 * __v10;
            let __v12 = -__v11;
            let __v13 = <__S as __eem::Scalar>::abs(__v12);
            let __v14 = <__S as __eem::Scalar>::abs(__v9);
            let __v15 = __v4 * __v7;
            let __v16 = <__S as __eem::Scalar>::abs(__v15);
            let __v17 = __x[1];
            let __v18 = <__S as __eem::Scalar>::abs(__v17);
            let __v19 = <__S as __eem::Scalar>::from_f64(self.branch);
            let __v20 = __v4 - __v17;
            let __v21 = __v19 * __v20;
            let __v22 = <__S as __eem::Scalar>::abs(__v21);
            let __v23 = __v8 / __v9;
            let __v24 = <__S as __eem::Scalar>::ln(__v23);
            let __v25 = __v8 * __v24;
            let __v26 = <__S as __eem::Scalar>::abs(__v25);
            let __v27 = <__S as __eem::Scalar>::from_f64(self.capacity);
            let __v28 = <__S as __eem::Scalar>::abs(__v27);
            let __v29 = __v4 * __v4;
            let __v30 = __v3 * __v29;
            let __v31 = <__S as __eem::Scalar>::abs(__v30);
            let __v32 = __v20 * __v20;
            let __v33 = __v19 * __v32;
            let __v34 = <__S as __eem::Scalar>::abs(__v33);
            let __v35 = __v10 * __v15;
            let __v36 = -__v35;
            let __v37 = <__S as __eem::Scalar>::abs(__v36);
            let __v38 = __v10 + __v25;
            let __v39 = __v27 * __v38;
            let __v40 = -__v39;
            let __v41 = <__S as __eem::Scalar>::abs(__v40);
            let __v42 = __v0 + __v2;
            let __v43 = __v8 + __v14;
            let __v44 = __v42 + __v18;
            let __v45 = <__S as __eem::Scalar>::from_f64(2.0);
            let __v46 = __v8 * __v45;
            let __v47 = __v14 + __v46;
            let __v48 = __v26 + __v47;
            let __v49 = __v42 * __v6;
            let __v50 = __v42 * __v13;
            let __v51 = __v43 * __v16;
            let __v52 = __v44 * __v22;
            let __v53 = __v48 * __v28;
            let __v54 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v55 = __v31 * __v54;
            let __v56 = __v34 * __v54;
            let __v57 = __v49 + __v50;
            let __v58 = __v51 + __v57;
            let __v59 = __v52 + __v58;
            let __v60 = __v53 + __v59;
            let __v61 = __v55 + __v60;
            let __v62 = __v56 + __v61;
            let __v63 = __v37 + __v62;
            let __v64 = __v41 + __v63;
            __v64
        }
        /// Internal energy e = ψ + θ s.
        ///
        /// 15 operations: 6 additions, 9 multiplications.
        fn internal_energy(&self, __x: &Self::Variables) -> __S {
            let __v0 = <__S as __eem::Scalar>::from_f64(self.stiffness);
            let __v1 = __x[0];
            let __v2 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v3 = __v2 - __v1;
            let __v4 = <__S as __eem::Scalar>::from_f64(self.branch);
            let __v5 = __x[1];
            let __v6 = __v3 + __v5;
            let __v7 = <__S as __eem::Scalar>::from_f64(self.capacity);
            let __v8 = __x[2];
            let __v9 = <__S as __eem::Scalar>::from_f64(self.theta_ref);
            let __v10 = __v8 - __v9;
            let __v11 = <__S as __eem::Scalar>::from_f64(self.coupling);
            let __v12 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v13 = __v0 * __v12;
            let __v14 = __v3 * __v3;
            let __v15 = __v13 * __v14;
            let __v16 = __v4 * __v12;
            let __v17 = __v6 * __v6;
            let __v18 = __v16 * __v17;
            let __v19 = __v7 * __v10;
            let __v20 = __v9 * __v11;
            let __v21 = __v3 * __v20;
            let __v22 = __v15 + __v18;
            let __v23 = __v19 + __v22;
            let __v24 = __v23 - __v21;
            __v24
        }
        /// Gradient ∂ψ/∂x.
        ///
        /// 14 operations: 7 additions, 5 multiplications, 1 division, 1 function.
        fn gradient(&self, __x: &Self::Variables) -> Self::Variables {
            let __v0 = __x[2];
            let __v1 = <__S as __eem::Scalar>::from_f64(self.theta_ref);
            let __v2 = __v0 / __v1;
            let __v3 = <__S as __eem::Scalar>::ln(__v2);
            let __v4 = <__S as __eem::Scalar>::from_f64(self.stiffness);
            let __v5 = __x[0];
            let __v6 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v7 = __v6 - __v5;
            let __v8 = <__S as __eem::Scalar>::from_f64(self.branch);
            let __v9 = __x[1];
            let __v10 = __v7 + __v9;
            let __v11 = <__S as __eem::Scalar>::from_f64(self.coupling);
            let __v12 = __v0 - __v1;
            let __v13 = __v4 * __v7;
            let __v14 = __v8 * __v10;
            let __v15 = __v11 * __v12;
            let __v16 = __v13 + __v14;
            let __v17 = __v15 + __v16;
            let __v18 = <__S as __eem::Scalar>::from_f64(self.capacity);
            let __v19 = __v7 * __v11;
            let __v20 = __v18 * __v3;
            let __v21 = __v19 - __v20;
            let __v22 = -__v17;
            [__v22, __v14, __v21]
        }
        /// Gradient ∂ψ/∂x and Hessian ∂²ψ/∂x².
        ///
        /// 20 operations: 11 additions, 6 multiplications, 2 divisions, 1 function.
        fn hessian(&self, __x: &Self::Variables) -> (Self::Variables, Self::Hessian) {
            let __v0 = __x[2];
            let __v1 = <__S as __eem::Scalar>::from_f64(self.theta_ref);
            let __v2 = __v0 / __v1;
            let __v3 = <__S as __eem::Scalar>::ln(__v2);
            let __v4 = <__S as __eem::Scalar>::from_f64(self.stiffness);
            let __v5 = __x[0];
            let __v6 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v7 = __v6 - __v5;
            let __v8 = <__S as __eem::Scalar>::from_f64(self.branch);
            let __v9 = __x[1];
            let __v10 = __v7 + __v9;
            let __v11 = <__S as __eem::Scalar>::from_f64(self.coupling);
            let __v12 = __v0 - __v1;
            let __v13 = __v4 * __v7;
            let __v14 = __v8 * __v10;
            let __v15 = __v11 * __v12;
            let __v16 = __v13 + __v14;
            let __v17 = __v15 + __v16;
            let __v18 = <__S as __eem::Scalar>::from_f64(self.capacity);
            let __v19 = __v7 * __v11;
            let __v20 = __v18 * __v3;
            let __v21 = __v19 - __v20;
            let __v22 = __v4 + __v8;
            let __v23 = <__S as __eem::Scalar>::from_f64(1.0);
            let __v24 = __v23 / __v0;
            let __v25 = __v18 * __v24;
            let __v26 = -__v17;
            let __v27 = -__v8;
            let __v28 = -__v11;
            let __v29 = <__S as __eem::Scalar>::from_f64(0.0);
            let __v30 = -__v25;
            (
                [__v26, __v14, __v21],
                [[__v22, __v27, __v28], [__v27, __v8, __v29], [__v28, __v29, __v30]],
            )
        }
        /// Entropy s, heat capacity θ ∂s/∂θ, and the sum of the magnitudes of the terms of s.
        ///
        /// 15 operations: 9 additions, 4 multiplications, 1 division, 1 function.
        fn caloric(&self, __x: &Self::Variables) -> __eem::Caloric<__S> {
            let __v0 = <__S as __eem::Scalar>::from_f64(self.coupling);
            let __v1 = __x[0];
            let __v2 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v3 = <__S as __eem::Scalar>::from_f64(self.capacity);
            let __v4 = __x[2];
            let __v5 = <__S as __eem::Scalar>::from_f64(self.theta_ref);
            let __v6 = __v4 / __v5;
            let __v7 = <__S as __eem::Scalar>::ln(__v6);
            let __v8 = <__S as __eem::Scalar>::abs(__v1);
            let __v9 = <__S as __eem::Scalar>::abs(__v2);
            let __v10 = <__S as __eem::Scalar>::abs(__v0);
            let __v11 = <__S as __eem::Scalar>::abs(__v3);
            let __v12 = <__S as __eem::Scalar>::abs(__v7);
            let __v13 = __v1 - __v2;
            let __v14 = __v0 * __v13;
            let __v15 = __v3 * __v7;
            let __v16 = __v14 + __v15;
            let __v17 = __v8 + __v9;
            let __v18 = __v17 * __v10;
            let __v19 = __v11 * __v12;
            let __v20 = __v18 + __v19;
            __eem::Caloric {
                entropy: __v16,
                heat_capacity: __v3,
                magnitude: __v20,
            }
        }
        /// The same, and the free energy ψ, as functions of the temperature.
        ///
        /// 14 operations: 7 additions, 5 multiplications, 1 division, 1 function. Transcendental functions: 1 call for 1 argument.
        fn caloric_at(
            &self,
            __x: Self::Variables,
        ) -> impl __eem::core::ops::Fn(__S) -> (__eem::Caloric<__S>, __S) {
            let __v0 = <__S as __eem::Scalar>::from_f64(self.coupling);
            let __v1 = __x[0];
            let __v2 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v3 = <__S as __eem::Scalar>::from_f64(self.capacity);
            let __v5 = <__S as __eem::Scalar>::from_f64(self.theta_ref);
            let __v8 = <__S as __eem::Scalar>::abs(__v1);
            let __v9 = <__S as __eem::Scalar>::abs(__v2);
            let __v10 = <__S as __eem::Scalar>::abs(__v0);
            let __v11 = <__S as __eem::Scalar>::abs(__v3);
            let __v13 = __v1 - __v2;
            let __v14 = __v0 * __v13;
            let __v17 = __v8 + __v9;
            let __v18 = __v17 * __v10;
            let __v21 = <__S as __eem::Scalar>::from_f64(self.stiffness);
            let __v22 = __v13 * __v13;
            let __v23 = __v21 * __v22;
            let __v24 = <__S as __eem::Scalar>::from_f64(self.branch);
            let __v25 = __x[1];
            let __v26 = __v1 - __v25;
            let __v27 = __v26 - __v2;
            let __v28 = __v27 * __v27;
            let __v29 = __v24 * __v28;
            let __v33 = __v23 + __v29;
            let __v34 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v35 = __v33 * __v34;
            move |__theta| {
                let __v4 = __theta;
                let __v6 = __v4 / __v5;
                let __v7 = <__S as __eem::Scalar>::ln(__v6);
                let __v12 = <__S as __eem::Scalar>::abs(__v7);
                let __v15 = __v3 * __v7;
                let __v16 = __v14 + __v15;
                let __v19 = __v11 * __v12;
                let __v20 = __v18 + __v19;
                let __v30 = __v4 * __v7;
                let __v31 = __v5 - __v4;
                let __v32 = __v30 + __v31;
                let __v36 = __v3 * __v32;
                let __v37 = __v14 * __v31;
                let __v38 = __v35 - __v36;
                let __v39 = __v37 + __v38;
                let __caloric = __eem::Caloric {
                    entropy: __v16,
                    heat_capacity: __v3,
                    magnitude: __v20,
                };
                (__caloric, __v39)
            }
        }
        /// Forces f and g, heat capacity c, slopes of the entropy.
        ///
        /// 10 operations: 7 additions, 3 multiplications.
        fn rates(&self, __x: &Self::Variables) -> __eem::Rates<Self::Variables> {
            let __v0 = <__S as __eem::Scalar>::from_f64(self.stiffness);
            let __v1 = __x[0];
            let __v2 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v3 = __v2 - __v1;
            let __v4 = <__S as __eem::Scalar>::from_f64(self.branch);
            let __v5 = __x[1];
            let __v6 = __v3 + __v5;
            let __v7 = <__S as __eem::Scalar>::from_f64(self.coupling);
            let __v8 = __x[2];
            let __v9 = <__S as __eem::Scalar>::from_f64(self.theta_ref);
            let __v10 = __v8 - __v9;
            let __v11 = __v0 * __v3;
            let __v12 = __v4 * __v6;
            let __v13 = __v7 * __v10;
            let __v14 = __v11 + __v12;
            let __v15 = __v13 + __v14;
            let __v16 = <__S as __eem::Scalar>::from_f64(self.capacity);
            let __v17 = -__v15;
            let __v18 = -__v12;
            let __v19 = <__S as __eem::Scalar>::from_f64(0.0);
            __eem::Rates {
                forces: [__v17, __v18, __v16],
                slopes: [__v7, __v19, <__S as __eem::Scalar>::zero()],
            }
        }
        /// The same, the entropy s and the free energy ψ, as functions of the temperature.
        ///
        /// 13 operations: 6 additions, 5 multiplications, 1 division, 1 function. Transcendental functions: 1 call for 1 argument.
        fn rates_at(
            &self,
            __x: Self::Variables,
        ) -> impl __eem::core::ops::Fn(
            __S,
        ) -> (__eem::Rates<Self::Variables>, [__S; 2]) {
            let __v1 = <__S as __eem::Scalar>::from_f64(self.theta_ref);
            let __v4 = <__S as __eem::Scalar>::from_f64(self.stiffness);
            let __v5 = __x[0];
            let __v6 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v7 = __v5 - __v6;
            let __v8 = __v4 * __v7;
            let __v9 = <__S as __eem::Scalar>::from_f64(self.branch);
            let __v10 = __x[1];
            let __v11 = __v5 - __v10;
            let __v12 = __v11 - __v6;
            let __v13 = __v9 * __v12;
            let __v14 = <__S as __eem::Scalar>::from_f64(self.coupling);
            let __v16 = __v8 + __v13;
            let __v19 = __v10 - __v5;
            let __v20 = __v6 + __v19;
            let __v21 = __v9 * __v20;
            let __v22 = <__S as __eem::Scalar>::from_f64(self.capacity);
            let __v23 = __v7 * __v14;
            let __v26 = __v7 * __v7;
            let __v27 = __v4 * __v26;
            let __v28 = __v12 * __v12;
            let __v29 = __v9 * __v28;
            let __v32 = __v27 + __v29;
            let __v33 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v34 = __v32 * __v33;
            let __v39 = -__v21;
            move |__theta| {
                let __v0 = __theta;
                let __v2 = __v0 / __v1;
                let __v3 = <__S as __eem::Scalar>::ln(__v2);
                let __v15 = __v1 - __v0;
                let __v17 = __v14 * __v15;
                let __v18 = __v16 + __v17;
                let __v24 = __v22 * __v3;
                let __v25 = __v23 + __v24;
                let __v30 = __v0 * __v3;
                let __v31 = __v15 + __v30;
                let __v35 = __v22 * __v31;
                let __v36 = __v15 * __v23;
                let __v37 = __v34 - __v35;
                let __v38 = __v36 + __v37;
                let __v40 = <__S as __eem::Scalar>::from_f64(0.0);
                (
                    __eem::Rates {
                        forces: [__v18, __v39, __v22],
                        slopes: [__v14, __v40, <__S as __eem::Scalar>::zero()],
                    },
                    [__v25, __v38],
                )
            }
        }
        /// Hessian of the entropy, ∂²s/∂x².
        ///
        /// 4 operations: 1 addition, 2 multiplications, 1 division.
        fn entropy_hessian(&self, __x: &Self::Variables) -> Self::Hessian {
            let __v0 = __x[2];
            let __v1 = <__S as __eem::Scalar>::from_f64(self.capacity);
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
        /// 11 operations: 2 additions, 6 multiplications, 2 divisions, 1 function.
        fn viscosity(&self, __theta: __S) -> (Self::Viscosities, Self::Viscosities) {
            let __v0 = <__S as __eem::Scalar>::from_f64(self.activation);
            let __v1 = __theta;
            let __v2 = <__S as __eem::Scalar>::from_f64(self.theta_ref);
            let __v3 = <__S as __eem::Scalar>::from_f64(1.0);
            let __v4 = __v3 / __v2;
            let __v5 = <__S as __eem::Scalar>::from_f64(1.0);
            let __v6 = __v5 / __v1;
            let __v7 = __v6 - __v4;
            let __v8 = __v0 * __v7;
            let __v9 = <__S as __eem::Scalar>::exp(__v8);
            let __v10 = <__S as __eem::Scalar>::from_f64(self.eta_ref);
            let __v11 = __v10 * __v9;
            let __v12 = __v10 * __v0;
            let __v13 = __v6 * __v6;
            let __v14 = __v12 * __v13;
            let __v15 = __v9 * __v14;
            let __v16 = -__v15;
            ([__v11], [__v16])
        }
        /// No dashpot stands beside the spring: nothing.
        fn drag(&self, _: __S) -> (Self::Drag, Self::Drag) {
            ([], [])
        }
        /// Entropy form: what depends on the old state alone.
        ///
        /// 10 operations: 4 additions, 5 multiplications, 1 division.
        fn entropy_form_old(&self, __x0: &Self::Variables) -> Self::EntropyFormOld {
            let __v0 = __x0[2];
            let __v21 = <__S as __eem::Scalar>::from_f64(self.coupling);
            let __v26 = <__S as __eem::Scalar>::from_f64(self.stiffness);
            let __v27 = __x0[0];
            let __v28 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v29 = __v28 - __v27;
            let __v33 = <__S as __eem::Scalar>::from_f64(self.branch);
            let __v34 = __x0[1];
            let __v35 = __v29 + __v34;
            let __v39 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v40 = __v26 * __v39;
            let __v42 = __v33 * __v39;
            let __v70 = <__S as __eem::Scalar>::from_f64(self.capacity);
            let __v76 = __v26 + __v33;
            let __v77 = __v39 * __v76;
            let __v78 = <__S as __eem::Scalar>::from_f64(1.0);
            let __v79 = __v78 / __v70;
            let __v81 = __v21 * __v79;
            let __v94 = <__S as __eem::Scalar>::from_f64(2.0);
            let __v95 = __v77 * __v94;
            let __v128 = -__v42;
            [__v0, __v27, __v29, __v34, __v35, __v40, __v42, __v79, __v81, __v95, __v128]
        }
        /// Entropy form: algorithmic quantities and their tangent.
        ///
        /// 95 operations: 29 additions, 50 multiplications, 5 divisions, 11 divided differences. Transcendental functions: 0 calls for 5 arguments.
        fn entropy_form(
            &self,
            __old: &Self::EntropyFormOld,
            __x1: &Self::Variables,
            __corners: &Self::Corners,
        ) -> (Self::Response, Self::Tangent) {
            let __v1 = __corners[0];
            let __v0 = __old[0];
            let __v2 = __eem::kernel::ln_dds(__v0, __v1);
            let __v3 = __v2.first;
            let __v4 = __x1[2];
            let __v5 = __corners[2];
            let __v6 = __eem::kernel::ln_dds(__v4, __v5);
            let __v7 = __v6.first;
            let __v8 = __corners[1];
            let __v9 = __eem::kernel::ln_dds(__v4, __v8);
            let __v10 = __v9.first;
            let __v11 = __corners[3];
            let __v12 = __eem::kernel::ln_dds(__v0, __v11);
            let __v13 = __v12.first;
            let __v14 = __eem::kernel::ln_dd(__v0, __v4);
            let __v15 = __v2.second_b;
            let __v16 = __v6.second_b;
            let __v17 = __v6.second_a;
            let __v18 = __v9.second_b;
            let __v19 = __v12.second_b;
            let __v20 = __v9.second_a;
            let __v23 = <__S as __eem::Scalar>::from_f64(1.0);
            let __v24 = __v23 / __v3;
            let __v22 = <__S as __eem::Scalar>::from_f64(self.theta_ref);
            let __v25 = __v24 - __v22;
            let __v30 = __x1[0];
            let __v28 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v31 = __v28 - __v30;
            let __v29 = __old[2];
            let __v32 = __v29 + __v31;
            let __v34 = __old[3];
            let __v36 = __v31 + __v34;
            let __v35 = __old[4];
            let __v37 = __v35 + __v36;
            let __v21 = <__S as __eem::Scalar>::from_f64(self.coupling);
            let __v38 = __v21 * __v25;
            let __v40 = __old[5];
            let __v41 = __v32 * __v40;
            let __v42 = __old[6];
            let __v43 = __v37 * __v42;
            let __v44 = __v38 + __v41;
            let __v45 = __v43 + __v44;
            let __v46 = __v23 / __v7;
            let __v47 = __v46 - __v22;
            let __v48 = __x1[1];
            let __v49 = __v29 + __v48;
            let __v50 = __v31 + __v48;
            let __v51 = __v49 + __v50;
            let __v52 = __v21 * __v47;
            let __v53 = __v42 * __v51;
            let __v54 = __v41 + __v52;
            let __v55 = __v53 + __v54;
            let __v56 = __v45 + __v55;
            let __v57 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v58 = __v56 * __v57;
            let __v59 = __v36 + __v50;
            let __v60 = __v42 * __v59;
            let __v61 = __v35 + __v49;
            let __v62 = __v42 * __v61;
            let __v63 = __v60 + __v62;
            let __v64 = __v57 * __v63;
            let __v65 = __v23 / __v10;
            let __v66 = __v23 / __v13;
            let __v67 = __v65 + __v66;
            let __v68 = __v57 * __v67;
            let __v27 = __old[1];
            let __v69 = __v30 - __v27;
            let __v70 = <__S as __eem::Scalar>::from_f64(self.capacity);
            let __v71 = __v70 * __v14;
            let __v72 = __v4 - __v0;
            let __v73 = __v21 * __v69;
            let __v74 = __v71 * __v72;
            let __v75 = __v73 + __v74;
            let __v79 = __old[7];
            let __v80 = __v1 * __v79;
            let __v81 = __old[8];
            let __v82 = __v24 * __v81;
            let __v83 = __v24 * __v70;
            let __v84 = __v15 * __v83;
            let __v85 = __v82 * __v84;
            let __v86 = __v80 * __v85;
            let __v87 = __v5 * __v79;
            let __v88 = __v46 * __v81;
            let __v89 = __v46 * __v70;
            let __v90 = __v16 * __v89;
            let __v91 = __v88 * __v90;
            let __v92 = __v87 * __v91;
            let __v93 = __v92 - __v86;
            let __v96 = __v21 * __v93;
            let __v95 = __old[9];
            let __v97 = __v95 + __v96;
            let __v98 = __v57 * __v97;
            let __v99 = __v89 * __v17;
            let __v100 = __v88 * __v99;
            let __v101 = __v23 / __v4;
            let __v102 = __v70 * __v101;
            let __v103 = __v92 * __v102;
            let __v104 = __v100 + __v103;
            let __v105 = __v57 * __v104;
            let __v106 = __v8 * __v79;
            let __v107 = __v65 * __v79;
            let __v108 = __v65 * __v70;
            let __v109 = __v18 * __v108;
            let __v110 = __v107 * __v109;
            let __v111 = __v106 * __v110;
            let __v112 = __v11 * __v79;
            let __v113 = __v66 * __v79;
            let __v114 = __v66 * __v70;
            let __v115 = __v19 * __v114;
            let __v116 = __v113 * __v115;
            let __v117 = __v112 * __v116;
            let __v118 = __v111 - __v117;
            let __v119 = __v21 * __v118;
            let __v120 = __v57 * __v119;
            let __v121 = __v108 * __v20;
            let __v122 = __v107 * __v121;
            let __v123 = __v102 * __v117;
            let __v124 = __v122 + __v123;
            let __v125 = __v57 * __v124;
            let __v126 = -__v58;
            let __v127 = -__v64;
            let __v129 = <__S as __eem::Scalar>::from_f64(0.0);
            let __v130 = -__v125;
            (
                [__v126, __v127, __v68, __v75],
                [
                    [__v98, __old[10], __v105],
                    [__old[6], __old[10], __v129],
                    [__v120, __v129, __v130],
                    [<__S as __eem::Scalar>::from_f64(self.coupling), __v129, __v102],
                ],
            )
        }
        /// Entropy form: the same algorithmic quantities without their tangent.
        ///
        /// 45 operations: 23 additions, 13 multiplications, 4 divisions, 5 divided differences. Transcendental functions: 0 calls for 5 arguments.
        fn entropy_form_response(
            &self,
            __old: &Self::EntropyFormOld,
            __x1: &Self::Variables,
            __corners: &Self::Corners,
        ) -> Self::Response {
            let __v1 = __corners[0];
            let __v0 = __old[0];
            let __v2 = __eem::kernel::ln_dd(__v0, __v1);
            let __v3 = __x1[2];
            let __v4 = __corners[2];
            let __v5 = __eem::kernel::ln_dd(__v3, __v4);
            let __v6 = __corners[1];
            let __v7 = __eem::kernel::ln_dd(__v3, __v6);
            let __v8 = __corners[3];
            let __v9 = __eem::kernel::ln_dd(__v0, __v8);
            let __v10 = __eem::kernel::ln_dd(__v0, __v3);
            let __v13 = <__S as __eem::Scalar>::from_f64(1.0);
            let __v14 = __v13 / __v2;
            let __v12 = <__S as __eem::Scalar>::from_f64(self.theta_ref);
            let __v15 = __v14 - __v12;
            let __v20 = __x1[0];
            let __v18 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v21 = __v18 - __v20;
            let __v19 = __old[2];
            let __v22 = __v19 + __v21;
            let __v24 = __old[3];
            let __v26 = __v21 + __v24;
            let __v25 = __old[4];
            let __v27 = __v25 + __v26;
            let __v11 = <__S as __eem::Scalar>::from_f64(self.coupling);
            let __v28 = __v11 * __v15;
            let __v30 = __old[5];
            let __v31 = __v22 * __v30;
            let __v32 = __old[6];
            let __v33 = __v27 * __v32;
            let __v34 = __v28 + __v31;
            let __v35 = __v33 + __v34;
            let __v36 = __v13 / __v5;
            let __v37 = __v36 - __v12;
            let __v38 = __x1[1];
            let __v39 = __v19 + __v38;
            let __v40 = __v21 + __v38;
            let __v41 = __v39 + __v40;
            let __v42 = __v11 * __v37;
            let __v43 = __v32 * __v41;
            let __v44 = __v31 + __v42;
            let __v45 = __v43 + __v44;
            let __v46 = __v35 + __v45;
            let __v47 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v48 = __v46 * __v47;
            let __v49 = __v26 + __v40;
            let __v50 = __v32 * __v49;
            let __v51 = __v25 + __v39;
            let __v52 = __v32 * __v51;
            let __v53 = __v50 + __v52;
            let __v54 = __v47 * __v53;
            let __v55 = __v13 / __v7;
            let __v56 = __v13 / __v9;
            let __v57 = __v55 + __v56;
            let __v58 = __v47 * __v57;
            let __v17 = __old[1];
            let __v59 = __v20 - __v17;
            let __v60 = <__S as __eem::Scalar>::from_f64(self.capacity);
            let __v61 = __v60 * __v10;
            let __v62 = __v3 - __v0;
            let __v63 = __v11 * __v59;
            let __v64 = __v61 * __v62;
            let __v65 = __v63 + __v64;
            let __v66 = -__v48;
            let __v67 = -__v54;
            [__v66, __v67, __v58, __v65]
        }
        /// Temperature form: what depends on the old state alone.
        ///
        /// 8 operations: 4 additions, 4 multiplications.
        fn temperature_form_old(
            &self,
            __x0: &Self::Variables,
        ) -> Self::TemperatureFormOld {
            let __v0 = __x0[2];
            let __v5 = <__S as __eem::Scalar>::from_f64(self.coupling);
            let __v10 = <__S as __eem::Scalar>::from_f64(self.stiffness);
            let __v11 = __x0[0];
            let __v12 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v13 = __v12 - __v11;
            let __v17 = <__S as __eem::Scalar>::from_f64(self.branch);
            let __v18 = __x0[1];
            let __v19 = __v13 + __v18;
            let __v30 = <__S as __eem::Scalar>::from_f64(2.0);
            let __v31 = __v5 * __v30;
            let __v45 = <__S as __eem::Scalar>::from_f64(self.capacity);
            let __v46 = __v30 * __v45;
            let __v54 = __v10 + __v17;
            let __v55 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v56 = __v54 * __v55;
            let __v57 = __v17 * __v55;
            let __v66 = -__v57;
            [__v0, __v11, __v13, __v18, __v19, __v31, __v46, __v56, __v57, __v66]
        }
        /// Temperature form: algorithmic quantities and their tangent.
        ///
        /// 43 operations: 20 additions, 19 multiplications, 2 divisions, 2 divided differences. Transcendental functions: 0 calls for 1 argument.
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
            let __v7 = <__S as __eem::Scalar>::from_f64(1.0);
            let __v8 = __v7 / __v3;
            let __v6 = <__S as __eem::Scalar>::from_f64(self.theta_ref);
            let __v9 = __v8 - __v6;
            let __v14 = __x1[0];
            let __v12 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v15 = __v12 - __v14;
            let __v13 = __old[2];
            let __v16 = __v13 + __v15;
            let __v18 = __old[3];
            let __v20 = __v15 + __v18;
            let __v19 = __old[4];
            let __v21 = __v19 + __v20;
            let __v22 = __x1[1];
            let __v23 = __v13 + __v22;
            let __v24 = __v15 + __v22;
            let __v25 = __v23 + __v24;
            let __v26 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v27 = __v21 * __v26;
            let __v28 = __v25 * __v26;
            let __v29 = __v27 + __v28;
            let __v31 = __old[5];
            let __v32 = __v9 * __v31;
            let __v10 = <__S as __eem::Scalar>::from_f64(self.stiffness);
            let __v33 = __v10 * __v16;
            let __v17 = <__S as __eem::Scalar>::from_f64(self.branch);
            let __v34 = __v17 * __v29;
            let __v35 = __v32 + __v33;
            let __v36 = __v34 + __v35;
            let __v37 = __v26 * __v36;
            let __v38 = __v19 + __v23;
            let __v39 = __v20 + __v24;
            let __v40 = __v26 * __v38;
            let __v41 = __v26 * __v39;
            let __v42 = __v40 + __v41;
            let __v43 = __v17 * __v42;
            let __v44 = __v26 * __v43;
            let __v46 = __old[6];
            let __v47 = __v3 * __v46;
            let __v48 = __v1 - __v0;
            let __v11 = __old[1];
            let __v49 = __v14 - __v11;
            let __v50 = __v47 * __v48;
            let __v51 = __v31 * __v49;
            let __v52 = __v50 + __v51;
            let __v53 = __v26 * __v52;
            let __v58 = __v8 * __v8;
            let __v59 = __v4 * __v58;
            let __v60 = __v31 * __v59;
            let __v61 = __v26 * __v60;
            let __v62 = __v7 / __v1;
            let __v45 = <__S as __eem::Scalar>::from_f64(self.capacity);
            let __v63 = __v45 * __v62;
            let __v64 = -__v37;
            let __v65 = -__v44;
            let __v67 = <__S as __eem::Scalar>::from_f64(0.0);
            let __v68 = -__v59;
            (
                [__v64, __v65, __v8, __v53],
                [
                    [__old[7], __old[9], __v61],
                    [__old[8], __old[9], __v67],
                    [__v67, __v67, __v68],
                    [<__S as __eem::Scalar>::from_f64(self.coupling), __v67, __v63],
                ],
            )
        }
        /// Temperature form: the same algorithmic quantities without their tangent.
        ///
        /// 35 operations: 19 additions, 14 multiplications, 1 division, 1 divided difference. Transcendental functions: 0 calls for 1 argument.
        fn temperature_form_response(
            &self,
            __old: &Self::TemperatureFormOld,
            __x1: &Self::Variables,
        ) -> Self::Response {
            let __v1 = __x1[2];
            let __v0 = __old[0];
            let __v2 = __eem::kernel::ln_dd(__v0, __v1);
            let __v5 = <__S as __eem::Scalar>::from_f64(1.0);
            let __v6 = __v5 / __v2;
            let __v4 = <__S as __eem::Scalar>::from_f64(self.theta_ref);
            let __v7 = __v6 - __v4;
            let __v12 = __x1[0];
            let __v10 = <__S as __eem::Scalar>::from_f64(self.length);
            let __v13 = __v10 - __v12;
            let __v11 = __old[2];
            let __v14 = __v11 + __v13;
            let __v16 = __old[3];
            let __v18 = __v13 + __v16;
            let __v17 = __old[4];
            let __v19 = __v17 + __v18;
            let __v20 = __x1[1];
            let __v21 = __v11 + __v20;
            let __v22 = __v13 + __v20;
            let __v23 = __v21 + __v22;
            let __v24 = <__S as __eem::Scalar>::from_f64(0.5);
            let __v25 = __v19 * __v24;
            let __v26 = __v23 * __v24;
            let __v27 = __v25 + __v26;
            let __v29 = __old[5];
            let __v30 = __v7 * __v29;
            let __v8 = <__S as __eem::Scalar>::from_f64(self.stiffness);
            let __v31 = __v8 * __v14;
            let __v15 = <__S as __eem::Scalar>::from_f64(self.branch);
            let __v32 = __v15 * __v27;
            let __v33 = __v30 + __v31;
            let __v34 = __v32 + __v33;
            let __v35 = __v24 * __v34;
            let __v36 = __v17 + __v21;
            let __v37 = __v18 + __v22;
            let __v38 = __v24 * __v36;
            let __v39 = __v24 * __v37;
            let __v40 = __v38 + __v39;
            let __v41 = __v15 * __v40;
            let __v42 = __v24 * __v41;
            let __v44 = __old[6];
            let __v45 = __v2 * __v44;
            let __v46 = __v1 - __v0;
            let __v9 = __old[1];
            let __v47 = __v12 - __v9;
            let __v48 = __v45 * __v46;
            let __v49 = __v29 * __v47;
            let __v50 = __v48 + __v49;
            let __v51 = __v24 * __v50;
            let __v52 = -__v35;
            let __v53 = -__v42;
            [__v52, __v53, __v6, __v51]
        }
    }
    #[automatically_derived]
    impl __eem::Describe for ThermoViscoElasticSpring {
        const DESCRIPTION: __eem::Description = __eem::Description {
            name: "ThermoViscoElasticSpring",
            arguments: &[
                __eem::describe::Argument::new("lambda", "Stretch", "m"),
                __eem::describe::Argument::new("gamma", "Viscous", "m"),
                __eem::describe::Argument::new("theta", "Temperature", "K"),
            ],
            parameters: &[
                __eem::describe::Parameter::without_unit("stiffness"),
                __eem::describe::Parameter::without_unit("branch"),
                __eem::describe::Parameter::without_unit("length"),
                __eem::describe::Parameter::without_unit("coupling"),
                __eem::describe::Parameter::without_unit("capacity"),
                __eem::describe::Parameter::without_unit("theta_ref"),
                __eem::describe::Parameter::without_unit("eta_ref"),
                __eem::describe::Parameter::without_unit("activation"),
            ],
            formulas: &[
                __eem::describe::Formula::new(
                    "ψ",
                    "ψ = 0.5*stiffness*(lambda - length)^2 + 0.5*branch*(lambda - gamma - length)^2\n    + capacity*(theta - theta_ref - theta*ln(theta/theta_ref))\n    - coupling*(lambda - length)*(theta - theta_ref)",
                    "J",
                ),
                __eem::describe::Formula::new(
                    "s",
                    "s = −∂ψ/∂theta = coupling*(lambda - length) + capacity*ln(theta/theta_ref)",
                    "J/K",
                ),
                __eem::describe::Formula::new(
                    "e",
                    "e = ψ + theta s = 0.5*stiffness*(lambda - length)^2 + 0.5*branch*(lambda - gamma - length)^2\n    + capacity*(theta - theta_ref) + coupling*theta_ref*(lambda - length)",
                    "J",
                ),
                __eem::describe::Formula::new(
                    "f",
                    "f = ∂ψ/∂lambda = stiffness*(lambda - length) + branch*(lambda - gamma - length)\n    - coupling*(theta - theta_ref)",
                    "N",
                ),
                __eem::describe::Formula::new(
                    "g",
                    "g = −∂ψ/∂gamma = -branch*(gamma - lambda + length)",
                    "N",
                ),
                __eem::describe::Formula::new(
                    "c",
                    "c = theta ∂s/∂theta = capacity",
                    "J/K",
                ),
                __eem::describe::Formula::new(
                    "η",
                    "η = eta_ref*exp(activation*(1/theta - 1/theta_ref))",
                    "N s/m",
                ),
            ],
            divided_differences: &[
                __eem::describe::Formula::new(
                    "ψ[lambda]",
                    "ψ[lambda⁰, lambda¹] = 0.5*stiffness*(lambda⁰ - length + lambda¹ - length)\n    - coupling*(theta - theta_ref)\n    + 0.5*branch*(lambda⁰ - gamma - length + lambda¹ - gamma - length)",
                    "N",
                ),
                __eem::describe::Formula::new(
                    "s[lambda]",
                    "s[lambda⁰, lambda¹] = coupling",
                    "N/K",
                ),
                __eem::describe::Formula::new(
                    "ψ[gamma]",
                    "ψ[gamma⁰, gamma¹] = -0.5*branch*(lambda - gamma⁰ - length + lambda - gamma¹ - length)",
                    "N",
                ),
                __eem::describe::Formula::new(
                    "s[gamma]",
                    "s[gamma⁰, gamma¹] = 0",
                    "N/K",
                ),
                __eem::describe::Formula::new(
                    "e[theta]",
                    "e[theta⁰, theta¹] = capacity",
                    "J/K",
                ),
                __eem::describe::Formula::new(
                    "s[theta]",
                    "s[theta⁰, theta¹] = capacity*ln[theta⁰, theta¹]",
                    "J/K^2",
                ),
            ],
            costs: &[
                __eem::describe::Cost::new("free_energy", 0, 19),
                __eem::describe::Cost::new("energy_magnitude", 0, 54),
                __eem::describe::Cost::new("internal_energy", 0, 15),
                __eem::describe::Cost::new("gradient", 0, 14),
                __eem::describe::Cost::new("hessian", 0, 20),
                __eem::describe::Cost::new("caloric", 0, 15),
                __eem::describe::Cost::new("entropy_hessian", 0, 4),
                __eem::describe::Cost::new("viscosity", 0, 11),
                __eem::describe::Cost::new("entropy_form", 10, 95),
                __eem::describe::Cost::new("temperature_form", 8, 43),
            ],
        };
    }
};
