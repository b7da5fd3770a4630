//! What was put into a scene, act by act: scenes are copied, pickled and built again from it.

use serde::{Deserialize, Serialize};

/// Many nodes, elements or reservoirs by their indices.
pub(crate) type Indices = Vec<usize>;

/// A partner of a path of heat.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) enum Partner {
    Element(usize),
    Reservoir(usize),
}

/// A quantity that is given once, or by the function of time with this index.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Course {
    Constant(Vec<f64>),
    Function(usize),
}

/// One call. Vectors of many nodes stand one after the other.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Act {
    Anchors {
        positions: Vec<f64>,
    },
    Masses {
        masses: Vec<f64>,
        positions: Vec<f64>,
        speed: Speed,
    },
    /// Springs of the material with this index.
    Springs {
        material: usize,
        pairs: Vec<[usize; 2]>,
        temperatures: Vec<f64>,
        /// Those of all dashpots of the first spring, of the second, and so on; or none.
        viscous_stretches: Vec<f64>,
    },
    /// A solid of the material with this index; cells one after the other.
    Solid {
        material: usize,
        positions: Vec<f64>,
        cells: Indices,
        bulk: Bulk,
        /// Those of all nodes, or none.
        velocities: Vec<f64>,
        /// Those of all points, or none.
        temperatures: Vec<f64>,
    },
    /// Nodes that are held where they are.
    Fixed {
        nodes: Indices,
    },
    Temperatures {
        elements: Indices,
        values: Vec<f64>,
    },
    Reservoirs {
        temperatures: Vec<f64>,
    },
    Oven {
        function: usize,
    },
    Paths {
        elements: Indices,
        partners: Vec<Partner>,
        conductances: Vec<f64>,
    },
    Gravity {
        gravity: Vec<f64>,
    },
    Force {
        nodes: Indices,
        force: Course,
    },
    Rocket {
        nodes: [usize; 3],
        thrust: Course,
    },
    Motion {
        anchor: usize,
        function: usize,
    },
    Thermostat {
        element: usize,
        temperature: Course,
    },
    /// Times at which steps end.
    Stops {
        times: Vec<f64>,
    },
    ShortestLoad {
        duration: f64,
    },
    Start {
        time: f64,
    },
    Rest(Rest),
}

/// The properties of a solid besides its material and its mesh.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Bulk {
    pub(crate) density: f64,
    /// In the plane.
    pub(crate) thickness: f64,
    pub(crate) conductivity: Option<f64>,
    /// Directions one after the other.
    pub(crate) fibres: Vec<f64>,
    pub(crate) lumped: bool,
    pub(crate) allow_skew_cells: bool,
}

/// How masses move at the start.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Speed {
    Zero,
    Velocities(Vec<f64>),
    Momenta(Vec<f64>),
}

/// The settings with which a state at rest is found.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Rest {
    pub(crate) held: bool,
    pub(crate) thermal_balance: bool,
    pub(crate) load_steps: u32,
}
