//! Contacts, dry friction and kinks: published cases (N01 to N14) and what their laws imply.

mod balls;
mod bearings;
mod belts;
mod bounces;
mod bowls;
mod breakaway;
mod changing_coefficients;
mod coincident;
mod corners;
mod dead_centres;
mod directions;
mod edges;
mod feet;
mod friction;
mod grooves;
mod growing;
mod indeterminate;
mod inputs;
mod joins;
mod kinked_gaps;
mod kinks;
mod laws;
mod leashes;
mod legs;
mod letting_go;
mod linkages;
mod nested;
mod normals;
mod onsets;
mod piles;
mod random;
mod reactions;
mod refused;
mod rocking;
mod sides;
mod slider_crank;
mod slips;
mod steps;
mod steps_of_floors;
mod stribeck;
mod tables;
mod three_points;
mod woodpecker;
mod zero_loads;

/// Tolerance of the motions.
const TIGHT: f64 = 1e-13;
