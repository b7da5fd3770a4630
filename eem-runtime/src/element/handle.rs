//! Handles: what a scene returns for the things put into it.
//!
//! A handle is a small copyable value that knows its scene, so that a handle of another scene is
//! an error and never somebody else's node.

use core::fmt;
use core::sync::atomic::{AtomicU64, Ordering};

/// Which scene a handle belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct SceneId(u64);

impl SceneId {
    /// An identity that no other scene of this process has.
    pub(crate) fn unique() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        Self(NEXT.fetch_add(1, Ordering::Relaxed))
    }
}

macro_rules! handle {
    ($(#[$docs:meta])* $name:ident, $text:literal) => {
        $(#[$docs])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name {
            pub(crate) scene: SceneId,
            pub(crate) index: usize,
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, concat!($text, " {}"), self.index)
            }
        }
    };
}

handle! {
    /// An anchor or a mass of a scene. Shown as `node 0`, counted in the order of creation.
    Node, "node"
}
handle! {
    /// A spring of a scene. Shown as `element 0`, counted in the order of creation.
    Element, "element"
}
handle! {
    /// A heat reservoir of a scene. Shown as `reservoir 0`, counted in the order of creation.
    Reservoir, "reservoir"
}

/// What an element can exchange heat with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum HeatPartner {
    /// Another element.
    Element(Element),
    /// A reservoir.
    Reservoir(Reservoir),
}

impl From<Element> for HeatPartner {
    fn from(element: Element) -> Self {
        Self::Element(element)
    }
}

impl From<Reservoir> for HeatPartner {
    fn from(reservoir: Reservoir) -> Self {
        Self::Reservoir(reservoir)
    }
}

impl fmt::Display for HeatPartner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Element(element) => element.fmt(f),
            Self::Reservoir(reservoir) => reservoir.fmt(f),
        }
    }
}
