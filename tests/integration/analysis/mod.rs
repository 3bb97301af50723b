//! What a model can tell about itself: equilibria, linear models, modes, sensitivities.

mod classical;
mod constrained;
mod derivatives;
mod floquet;
mod modes;
mod scalars;
mod seeds;
mod sensitivities;
mod variational;
mod written_out;
