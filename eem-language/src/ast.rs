//! The syntax tree of a model: what was written, reduced to what a free energy can contain.
//!
//! Output of the parse phase. The nodes borrow the syntax they come from, so that later phases can
//! point at the guilty token. Names are not resolved here. What could not be read has been reported
//! and leaves a hole behind ([`ExprKind::Wrong`], [`Argument::role`], [`Binding::ident`]): the phases
//! after it go on around the hole and say nothing about it.

use eem_symbolic::Number;
use proc_macro2::Ident;
use syn::ext::IdentExt as _;

/// A struct with its free energy and its viscosity laws.
pub(crate) struct Input<'a> {
    /// The item that carries the derive.
    pub(crate) original: &'a syn::DeriveInput,
    /// The path of the crate `eem`.
    pub(crate) krate: &'a syn::Path,
    /// All named fields, in order of declaration; `None` for an item that has none by its kind, such as an enum.
    pub(crate) fields: Option<Vec<Field<'a>>>,
    /// The arguments of the closure, in the order of the closure.
    pub(crate) arguments: Vec<Argument<'a>>,
    /// Whether every argument has a name and a role.
    pub(crate) arguments_complete: bool,
    /// The body of the closure: ψ.
    pub(crate) energy: Block<'a>,
    /// The closure as written, for errors about the whole of it.
    pub(crate) closure: &'a syn::ExprClosure,
    /// The viscosity laws, in order of appearance.
    pub(crate) laws: Vec<Law<'a>>,
    /// Whether every `viscosity` attribute could be read.
    pub(crate) laws_complete: bool,
}

impl Input<'_> {
    /// Whether the free energy is one per volume: it has strains.
    pub(crate) fn per_volume(&self) -> bool {
        let mut roles = self.arguments.iter().filter_map(|argument| argument.role);
        roles.any(|role| role.strain().is_some())
    }
}

/// A named field: a parameter if its type allows and an expression mentions it.
pub(crate) struct Field<'a> {
    pub(crate) ident: &'a Ident,
    pub(crate) ty: &'a syn::Type,
    /// Marked with `#[free_energy(unused)]`: no parameter, whatever its type.
    pub(crate) unused: bool,
    /// Whether a mark that could not be read has been reported.
    pub(crate) wrong: bool,
}

/// `name: Role` in the closure.
pub(crate) struct Argument<'a> {
    pub(crate) ident: &'a Ident,
    /// `None` if the role could not be read.
    pub(crate) role: Option<Role>,
}

/// What an argument of the closure stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// The kinematic measure of a spring: its length.
    Stretch,
    /// A kinematic measure of a point of a solid.
    Strain(Strain),
    /// An invariant of the viscous strain Γ of a point of a solid, or of it and E.
    Joint(Joint),
    /// An internal variable with a viscosity.
    Viscous,
    /// The absolute temperature.
    Temperature,
}

/// An invariant of the Green–Lagrange strain E.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strain {
    /// `tr E`
    Trace,
    /// `E:E`
    Square,
    /// `J − 1`
    Dilatation,
    /// `a·E a` along a fibre with the unit vector a
    Fibre,
}

impl Strain {
    /// All strains, in the order in which messages list them.
    pub(crate) const ALL: [Self; 4] = [Self::Trace, Self::Square, Self::Dilatation, Self::Fibre];

    /// Its variant of `Strain` in the runtime.
    pub(crate) fn variant(self) -> &'static str {
        match self {
            Self::Trace => "Trace",
            Self::Square => "Square",
            Self::Dilatation => "Dilatation",
            Self::Fibre => "Fibre",
        }
    }
}

/// An invariant of the viscous strain Γ, or of it and E.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joint {
    /// `tr Γ`
    Trace,
    /// `Γ:Γ`
    Square,
    /// `E:Γ`
    Strain,
}

impl Joint {
    /// All invariants, in the order in which messages list them.
    pub(crate) const ALL: [Self; 3] = [Self::Strain, Self::Square, Self::Trace];

    /// Its variant of `Joint` in the runtime.
    pub(crate) fn variant(self) -> &'static str {
        match self {
            Self::Trace => "Trace",
            Self::Square => "Square",
            Self::Strain => "Strain",
        }
    }
}

impl Role {
    /// All roles, in the order in which messages list them.
    pub(crate) const ALL: [Self; 10] = [
        Self::Stretch,
        Self::Strain(Strain::Trace),
        Self::Strain(Strain::Square),
        Self::Strain(Strain::Dilatation),
        Self::Strain(Strain::Fibre),
        Self::Joint(Joint::Strain),
        Self::Joint(Joint::Square),
        Self::Joint(Joint::Trace),
        Self::Viscous,
        Self::Temperature,
    ];

    /// The name that the closure uses as a type.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Stretch => "Stretch",
            Self::Strain(Strain::Trace) => "StrainTrace",
            Self::Strain(Strain::Square) => "StrainSquare",
            Self::Strain(Strain::Dilatation) => "Dilatation",
            Self::Strain(Strain::Fibre) => "FibreStrain",
            Self::Joint(Joint::Strain) => "ViscousStrain",
            Self::Joint(Joint::Square) => "ViscousSquare",
            Self::Joint(Joint::Trace) => "ViscousTrace",
            Self::Viscous => "Viscous",
            Self::Temperature => "Temperature",
        }
    }

    /// The role that the literature usually gives a name.
    pub(crate) fn usual(name: &str) -> Option<Self> {
        match name {
            "lambda" | "λ" => Some(Self::Stretch),
            "e1" => Some(Self::Strain(Strain::Trace)),
            "e2" => Some(Self::Strain(Strain::Square)),
            "j" => Some(Self::Strain(Strain::Dilatation)),
            "e4" => Some(Self::Strain(Strain::Fibre)),
            "gamma" | "γ" => Some(Self::Viscous),
            "theta" | "θ" | "temperature" => Some(Self::Temperature),
            _ => None,
        }
    }

    /// The strain, if the role is one.
    pub(crate) fn strain(self) -> Option<Strain> {
        match self {
            Self::Strain(strain) => Some(strain),
            Self::Stretch | Self::Joint(_) | Self::Viscous | Self::Temperature => None,
        }
    }

    /// The invariant of the viscous strain, if the role is one.
    pub(crate) fn joint(self) -> Option<Joint> {
        match self {
            Self::Joint(joint) => Some(joint),
            Self::Stretch | Self::Strain(_) | Self::Viscous | Self::Temperature => None,
        }
    }

    /// Whether only a solid has arguments of this role.
    pub(crate) fn is_of_solid(self) -> bool {
        self.strain().is_some() || self.joint().is_some()
    }

    /// Whether an argument of this role needs a viscosity.
    pub(crate) fn flows(self) -> bool {
        match self {
            Self::Viscous | Self::Joint(Joint::Strain | Joint::Trace) => true,
            Self::Stretch | Self::Strain(_) | Self::Joint(Joint::Square) | Self::Temperature => {
                false
            }
        }
    }

    /// Whether several arguments may have this role.
    pub(crate) fn is_repeatable(self) -> bool {
        match self {
            Self::Viscous | Self::Strain(Strain::Fibre) => true,
            Self::Stretch | Self::Strain(_) | Self::Joint(_) | Self::Temperature => false,
        }
    }

    /// Whether it is a function of the positions of nodes, of the viscous strain, or of both.
    pub(crate) fn is_measure(self) -> bool {
        match self {
            Self::Stretch | Self::Strain(_) | Self::Joint(_) => true,
            Self::Viscous | Self::Temperature => false,
        }
    }
}

/// `name = expression` in a `viscosity` attribute.
pub(crate) struct Law<'a> {
    pub(crate) dashpot: &'a Ident,
    pub(crate) value: Expr<'a>,
}

/// `let` bindings followed by a value.
pub(crate) struct Block<'a> {
    pub(crate) bindings: Vec<Binding<'a>>,
    pub(crate) value: Box<Expr<'a>>,
}

/// `let name = value;`
pub(crate) struct Binding<'a> {
    /// `None` for a statement that could not be read and may have declared names.
    pub(crate) ident: Option<&'a Ident>,
    pub(crate) value: Bound<'a>,
}

/// The right side of a `let`.
pub(crate) enum Bound<'a> {
    Value(Expr<'a>),
    Helper(Helper<'a>),
}

/// `|x, y| body`, a function of the formula that stands for its body at every call.
pub(crate) struct Helper<'a> {
    /// `None` where an argument could not be read.
    pub(crate) arguments: Vec<Option<&'a Ident>>,
    pub(crate) body: Block<'a>,
}

/// An expression and the syntax it comes from.
pub(crate) struct Expr<'a> {
    pub(crate) original: &'a syn::Expr,
    pub(crate) kind: ExprKind<'a>,
}

impl<'a> Expr<'a> {
    /// The placeholder of an expression that could not be read at all.
    pub(crate) fn hole(original: &'a syn::Expr) -> Self {
        let kind = ExprKind::Wrong(Vec::new());
        Self { original, kind }
    }
}

/// The expressions of a free energy.
pub(crate) enum ExprKind<'a> {
    /// A literal, exact where 128-bit rationals can hold it.
    Number(Number),
    /// A field, an argument, a binding or a constant of the program.
    Name(&'a Ident),
    /// A constant of the program by its path, `crate::gas::R`.
    Constant(&'a syn::Path),
    /// `name[2]`, an entry of an array.
    Entry(Entry<'a>),
    /// `-x`
    Negate(Box<Expr<'a>>),
    /// `x + y` and its relatives.
    Binary(Operator, Box<Expr<'a>>, Box<Expr<'a>>),
    /// `f(x, y)` or `x.f(y)`: the receiver of a method is the first argument.
    Call(&'a Ident, Vec<Expr<'a>>),
    /// `{ let …; value }`
    Block(Block<'a>),
    /// Something that has been reported, and the expressions in it.
    Wrong(Vec<Expr<'a>>),
}

/// `name[index]`
#[derive(Clone, Copy)]
pub(crate) struct Entry<'a> {
    pub(crate) array: &'a Ident,
    pub(crate) index: usize,
    /// The index as written, for errors about it.
    pub(crate) literal: &'a syn::LitInt,
}

/// The arithmetic operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
}

/// Whether the name starts with an underscore: it may be unused.
pub(crate) fn is_underscored(ident: &Ident) -> bool {
    name(ident).starts_with('_')
}

/// Whether the name is in upper case, as those of constants are.
pub(crate) fn is_upper_case(ident: &Ident) -> bool {
    let name = name(ident);
    name.contains(char::is_uppercase) && !name.contains(char::is_lowercase)
}

/// The name without `r#`: `r#type` and `type` are the same name.
pub(crate) fn name(ident: &Ident) -> String {
    ident.unraw().to_string()
}
