//! The methods for special systems: symplectic splittings, implicit collocation, and the derivatives it
//! needs.

mod collocation;
mod jacobians;
mod splittings;
