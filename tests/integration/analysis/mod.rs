//! What a model can tell about itself: equilibria, linear models, modes, sensitivities.

mod classical;
mod constrained;
mod derivatives;
mod detents;
mod downhill;
mod equilibria;
mod far;
mod flat;
mod floquet;
mod limits;
mod modes;
mod nonholonomic;
mod scalars;
mod seeds;
mod sensitivities;
mod stiff;
mod switches;
mod turning;
mod units;
mod variational;
mod written_out;
