//! Constrained systems: reactions, motions on their constraints, and what cannot be.
//!
//! | module | what |
//! | --- | --- |
//! | [`cases`] | reference digits from outside |

mod cases;
