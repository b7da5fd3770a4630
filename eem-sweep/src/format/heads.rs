//! The columns of a table: id, kind of failure, inputs, outputs, time and message of the failure.

use crate::inputs::InputError;

/// The id of the member.
pub(super) const ID: &str = "id";
/// The kind of failure; empty if there is none.
pub(super) const FAILURE: &str = "failure";
/// The time at which the failed step began, s.
pub(super) const FAILED_AT: &str = "failed_at (s)";
/// The message of the failure.
pub(super) const MESSAGE: &str = "message";

/// The heads of the columns that differ between sweeps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Heads {
    pub(crate) inputs: Vec<String>,
    pub(crate) outputs: Vec<String>,
}

impl Heads {
    /// An error if two columns have the same name, or a name has a control character such as a line break.
    pub(crate) fn new(inputs: &[String], outputs: &[&str]) -> Result<Self, InputError> {
        let heads = Self {
            inputs: inputs.to_vec(),
            outputs: outputs.iter().map(|&head| head.to_owned()).collect(),
        };
        let mut all = heads.all();
        if let Some(name) = all.iter().find(|name| name.contains(char::is_control)) {
            return Err(InputError::ColumnName {
                name: (*name).to_owned(),
            });
        }
        all.sort_unstable();
        match all.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(InputError::DuplicateColumn {
                name: pair[0].to_owned(),
            }),
            None => Ok(heads),
        }
    }

    /// All heads in the order of the columns.
    pub(super) fn all(&self) -> Vec<&str> {
        let own = self.inputs.iter().chain(&self.outputs).map(String::as_str);
        let before = [ID, FAILURE].into_iter();
        before.chain(own).chain([FAILED_AT, MESSAGE]).collect()
    }
}
