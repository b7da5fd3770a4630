//! How a model is written: messages take their nouns from here.

/// How a model is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Dialect {
    /// As the attributes of a struct, whose fields are the parameters.
    #[default]
    Attribute,
    /// As texts, with a list of parameters.
    Text,
}

impl Dialect {
    /// The alternative for this dialect.
    pub(crate) fn choose<T>(self, attribute: T, text: T) -> T {
        match self {
            Self::Attribute => attribute,
            Self::Text => text,
        }
    }

    /// A free energy, in short.
    pub(crate) fn closure(self) -> &'static str {
        self.choose(
            "`#[free_energy(|lambda: Stretch, theta: Temperature| …)]`",
            "`|lambda: Stretch, theta: Temperature| …`",
        )
    }

    /// The noun for the free energy.
    pub(crate) fn free_energy(self) -> &'static str {
        self.choose("`#[free_energy]`", "a free energy")
    }

    /// The noun for the whole of a model.
    pub(crate) fn item(self) -> &'static str {
        self.choose("struct", "text")
    }

    /// The noun for the declaration of a parameter.
    pub(crate) fn field(self) -> &'static str {
        self.choose("field", "parameter")
    }

    /// The same with an article.
    pub(crate) fn a_field(self) -> &'static str {
        self.choose("a field", "a parameter")
    }

    /// `field, x: f64`, after "as a".
    pub(crate) fn field_named(self, name: &str) -> String {
        self.choose(
            format!("field, `{name}: f64`"),
            format!("parameter, `{name}`"),
        )
    }

    /// How to declare a parameter.
    pub(crate) fn declaration(self, name: &str) -> String {
        self.choose(
            format!("a parameter is a field, `{name}: f64`"),
            format!("a new parameter has to be declared, `{name}`"),
        )
    }

    /// How to declare an array of three parameters.
    pub(crate) fn array(self, name: &str) -> String {
        self.choose(format!("`{name}: [f64; 3]`"), format!("`{name}[3]`"))
    }

    /// How to say that a parameter is meant to be unused; an entry by its array.
    pub(crate) fn unused(self, name: &str) -> String {
        let array = name.split('[').next().unwrap_or_default();
        self.choose(
            "mark it: `#[free_energy(unused)]`".to_owned(),
            format!("call it `_{array}` to keep it"),
        )
    }

    /// How to give a dashpot its law.
    pub(crate) fn law(self, dashpot: &str) -> String {
        self.choose(
            format!("write `#[viscosity({dashpot} = …)]` on top of the struct"),
            format!("write a viscosity for `{dashpot}`"),
        )
    }

    /// A unit where it is written.
    pub(crate) fn unit(self, unit: &str) -> String {
        self.choose(format!("`#[unit(\"{unit}\")]`"), format!("`{unit}`"))
    }

    /// The same as a phrase.
    pub(crate) fn the_unit(self, unit: &str) -> String {
        self.choose(self.unit(unit), format!("the unit `{unit}`"))
    }

    /// Where the unit of a parameter is written.
    pub(crate) fn above(self) -> &'static str {
        self.choose(" above it", "")
    }
}
