//! Constrained systems: reactions, motions on their constraints, and what cannot be.
//!
//! | module | what |
//! | --- | --- |
//! | [`cases`] | reference digits from outside |
//! | [`starts`] | where a motion may begin, and the projection of other starts |
//! | [`drift`] | steps, samples and the way back stay on the constraints |
//! | [`redundancy`] | redundant constraints: the same motion, the shortest multipliers |
//! | [`beside`] | rows that depend on each other only where the constraints hold |
//! | [`singular`] | constraints that become dependent on the way; what is held altogether |
//! | [`single_row`] | a single constraint whose gradient vanishes on the way |
//! | [`passages`] | through configurations in which constraints become dependent, straight on |
//! | [`slider_cranks`] | through such a configuration again and again, at every tolerance |
//! | [`snakeboard`] | through one of nonholonomic constraints |
//! | [`cell`] | such a passage at the finest tolerances |
//! | [`far`] | small differences of large coordinates |
//! | [`linkages`] | four-bar linkages, flat configurations |
//! | [`many`] | many constraints that have few coordinates in common |
//! | [`inputs`] | inputs, feedback, dissipation, constraints that move |
//! | [`balanced`] | forces that balance each other: what moves are their roundings |
//! | [`contradictions`] | constraints that no state satisfies together, and other ends of motions by their names |
//! | [`baumgarte`] | stabilisation instead of projection |
//! | [`formulations`] | Lagrangians as a whole, Chetaev's rule |
//! | [`scalars`], [`units`], [`masses`] | single precision; units of mass, length and time; masses of very different sizes |

mod balanced;
mod baumgarte;
mod beside;
mod cases;
mod cell;
mod contradictions;
mod drift;
mod far;
mod formulations;
mod inputs;
mod linkages;
mod many;
mod masses;
mod passages;
mod redundancy;
mod scalars;
mod single_row;
mod singular;
mod slider_cranks;
mod snakeboard;
mod starts;
mod units;
