//! The classical Runge–Kutta method of order 4, 4 stages. W. Kutta, Z. Math. Phys. 46 (1901) 435.

/// Nodes.
pub(crate) const C: [f64; 4] = [0.0, 0.5, 0.5, 1.0];

/// Weights. Stage i + 1 uses stage i alone, with coefficient `C[i + 1]`.
pub(crate) const B: [f64; 4] = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0];

/// The rests that the weights lack, for scalars of more digits.
pub(crate) const REST: [f64; 4] =
    [9.25185853854297e-18, 1.850371707708594e-17, 1.850371707708594e-17, 9.25185853854297e-18];
