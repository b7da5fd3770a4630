//! Operators of a type that packs lanes are those of the packed type.

/// Forwards operators to the packed type.
macro_rules! forward {
    ($own:ident: $($operator:ident $method:ident),*; $($unary:ident $unary_method:ident),*) => {
        $(
            impl $operator for $own {
                type Output = Self;

                #[inline]
                fn $method(self, other: Self) -> Self {
                    Self::from_packed($operator::$method(self.packed(), other.packed()))
                }
            }
        )*
        $(
            impl $unary for $own {
                type Output = Self;

                #[inline]
                fn $unary_method(self) -> Self {
                    Self::from_packed($unary::$unary_method(self.packed()))
                }
            }
        )*
    };
    ($own:ident: $($assign:ident $method:ident by $operator:ident $by:ident),*) => {
        $(
            impl $assign for $own {
                #[inline]
                fn $method(&mut self, other: Self) {
                    *self = $operator::$by(*self, other);
                }
            }
        )*
    };
}
pub(super) use forward;
