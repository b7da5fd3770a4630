//! A model whose names are resolved.
//!
//! Output of the check phase. Indices are valid by construction. Wrong names, arguments and types
//! have been reported and leave holes: [`ExprKind::Wrong`], or a dashpot without a law. If nothing
//! has been reported, there are no holes, and roles and laws are complete.

use eem_symbolic::{Function, Number};
use proc_macro2::{Ident, TokenStream};

use crate::ast::{self, Joint, Operator, Role, Strain};

/// A checked model.
pub(crate) struct Checked<'a> {
    /// The item that carries the derive.
    pub(crate) original: &'a syn::DeriveInput,
    /// The path of the crate `eem`.
    pub(crate) krate: &'a syn::Path,
    /// The scalar that the implementation is for.
    pub(crate) scalar: Scalar<'a>,
    /// The fields that an expression mentions, in order of declaration, then the Rust constants, in
    /// order of appearance.
    pub(crate) parameters: Vec<Parameter<'a>>,
    /// The arguments in the order of the state: measures, dashpots, temperature.
    pub(crate) variables: Vec<Variable<'a>>,
    /// The free energy.
    pub(crate) energy: Body<'a>,
    /// One viscosity per dashpot, in the order of the dashpots, then those of the viscous strain; `None`
    /// where it is missing.
    pub(crate) viscosities: Vec<Option<Body<'a>>>,
    /// The viscosity of the stretch, if a dashpot acts in parallel with the spring.
    pub(crate) drag: Option<Body<'a>>,
    /// Whether the roles are complete and no expression has a hole.
    pub(crate) sound: bool,
}

impl Checked<'_> {
    /// Names and roles of the variables.
    pub(crate) fn arguments(&self) -> Vec<(String, Role)> {
        let variables = self.variables.iter();
        variables.map(|v| (ast::name(v.ident), v.role)).collect()
    }

    /// The measures of strain in the order of the state; none in a spring.
    pub(crate) fn strains(&self) -> impl Iterator<Item = Strain> {
        self.variables.iter().filter_map(|v| v.role.strain())
    }

    /// The invariants of the viscous strain in the order of the state.
    pub(crate) fn joints(&self) -> impl Iterator<Item = Joint> {
        self.variables.iter().filter_map(|v| v.role.joint())
    }

    /// The paths of the Rust constants, in order of appearance.
    pub(crate) fn constants(&self) -> impl Iterator<Item = &TokenStream> {
        self.parameters.iter().filter_map(|p| match &p.source {
            Source::Constant(path) => Some(path),
            Source::Field(..) | Source::Entry(..) => None,
        })
    }

    /// Whether ψ is an energy per volume, a function of strains.
    pub(crate) fn per_volume(&self) -> bool {
        self.strains().next().is_some()
    }
}

/// The scalar that the implementation is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scalar<'a> {
    /// All parameters are floats: the model works in any scalar.
    Any,
    /// Some parameters have this type parameter of the struct as their type.
    Parameter(&'a Ident),
}

/// A number that an expression mentions and whose value is known at run time only.
#[derive(Clone, Debug)]
pub(crate) struct Parameter<'a> {
    /// Where it comes from.
    pub(crate) origin: Origin,
    /// Its name in formulas: `stiffness`, `stiffness[2]`, `R`.
    pub(crate) name: String,
    /// How the generated code reads it.
    pub(crate) source: Source<'a>,
}

/// Where a parameter comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Origin {
    /// Index of a field of the struct.
    Field(usize),
    /// Index of a field that is an array, and of an entry of it.
    Entry(usize, usize),
    /// A Rust constant, in order of appearance.
    Constant(usize),
}

impl Origin {
    /// The field of the struct, unless it is a constant.
    pub(crate) fn field(self) -> Option<usize> {
        match self {
            Self::Field(field) | Self::Entry(field, _) => Some(field),
            Self::Constant(_) => None,
        }
    }
}

/// How the generated code reads a parameter.
#[derive(Clone, Debug)]
pub(crate) enum Source<'a> {
    /// `self.name`
    Field(&'a Ident, ParameterKind),
    /// `self.name[2]`
    Entry(&'a Ident, usize, ParameterKind),
    /// A path that Rust resolves.
    Constant(TokenStream),
}

/// How a field becomes a scalar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ParameterKind {
    /// `f64`: converted.
    Double,
    /// `f32`: widened and converted.
    Single,
    /// The type parameter that is the scalar.
    Scalar,
}

/// An argument of the free energy.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Variable<'a> {
    pub(crate) ident: &'a Ident,
    pub(crate) role: Role,
}

/// An expression and the `let` bindings before it, each of which uses earlier ones only.
///
/// Nested blocks are flattened: a name that two blocks bind is two bindings here.
pub(crate) struct Body<'a> {
    pub(crate) bindings: Vec<Expr<'a>>,
    pub(crate) value: Expr<'a>,
}

/// A resolved expression and the syntax it comes from.
pub(crate) struct Expr<'a> {
    pub(crate) original: &'a syn::Expr,
    pub(crate) kind: ExprKind<'a>,
}

/// A resolved expression.
pub(crate) enum ExprKind<'a> {
    Number(Number),
    /// One of [`Checked::parameters`].
    Parameter(Origin),
    /// Index into [`Checked::variables`].
    Variable(usize),
    /// Index into [`Body::bindings`].
    Binding(usize),
    Negate(Box<Expr<'a>>),
    Binary(Operator, Box<Expr<'a>>, Box<Expr<'a>>),
    Sqrt(Box<Expr<'a>>),
    Recip(Box<Expr<'a>>),
    /// The absolute value, with the token that asks for it.
    Abs(&'a Ident, Box<Expr<'a>>),
    Apply(Function, Box<Expr<'a>>),
    /// Base and exponent; the exponent must evaluate to an integer.
    Powi(Box<Expr<'a>>, Box<Expr<'a>>),
    Powf(Box<Expr<'a>>, Box<Expr<'a>>),
    /// The derivative with respect to a variable.
    Diff(Box<Expr<'a>>, usize),
    /// The value of a call of a helper, with the call, which messages about the value name.
    InCall(&'a syn::Expr, Box<Expr<'a>>),
    /// Something that has been reported, and the expressions in it.
    Wrong(Vec<Expr<'a>>),
}
