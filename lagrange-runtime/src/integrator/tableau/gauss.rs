//! Gauss–Legendre collocation with 2, 3 and 4 stages: nodes, weights, and the modes that decouple the stages.
//!
//! J. C. Butcher, Math. Comp. 18 (1964) 50. The coefficients are written as μᵢⱼ = aᵢⱼ / bⱼ, because a method
//! is symplectic where μᵢⱼ + μⱼᵢ = 1, which rounding then cannot touch: M. Antoñana, J. Makazaga, A. Murua,
//! Numer. Algorithms 76 (2017) 861. A = T Λ T⁻¹ takes the linear system of all stages apart into one for each
//! eigenvalue: E. Hairer, G. Wanner, "Solving Ordinary Differential Equations II", 2nd ed., IV.8. Computed
//! with 40 digits.

/// A method with `S` stages, of order 2`S`.
pub(crate) struct Collocation<const S: usize> {
    /// Nodes.
    pub c: [f64; S],
    /// Weights.
    pub b: [f64; S],
    /// μᵢⱼ below the diagonal, where it is between ½ and 2, so that 1 − μᵢⱼ is exact.
    pub below: [[f64; S]; S],
    /// The eigenvalues of A with a positive or no imaginary part, and their vectors.
    pub modes: &'static [Mode<S>],
}

/// An eigenvalue of A.
pub(crate) struct Mode<const S: usize> {
    /// The eigenvalue.
    pub value: [f64; 2],
    /// The column of T, twice where it stands for its conjugate as well.
    pub column: [[f64; 2]; S],
    /// The row of T⁻¹.
    pub row: [[f64; 2]; S],
}

/// Order 4.
pub(crate) const GAUSS4: Collocation<2> = Collocation {
    c: [0.2113248654051871, 0.7886751345948129],
    b: [0.5, 0.5],
    below: [[0.0, 0.0], [1.0773502691896257, 0.0]],
    modes: &[Mode {
        value: [0.25, 0.14433756729740643],
        column: [[0.0, 0.5358983848622454], [2.0, 0.0]],
        row: [[0.0, -1.8660254037844386], [0.5, 0.0]],
    }],
};

/// Order 6.
pub(crate) const GAUSS6: Collocation<3> = Collocation {
    c: [0.11270166537925831, 0.5, 0.8872983346207417],
    b: [0.2777777777777778, 0.4444444444444444, 0.2777777777777778],
    below: [[0.0, 0.0, 0.0], [1.0809475019311126, 0.0, 0.0], [0.96475800154489, 1.0809475019311126, 0.0]],
    modes: &[
        Mode {
            value: [0.21531442311611218, 0.0],
            column: [[0.07215185205520017, 0.0], [0.11883257874127781, 0.0], [1.0, 0.0]],
            row: [[5.991698084937801, 0.0], [1.1392142951557354, 0.0], [0.43231211378385836, 0.0]],
        },
        Mode {
            value: [0.14234278844194392, 0.1357999257081538],
            column: [
                [-0.16448246114726134, -0.120241477238617],
                [0.10613018148412279, 0.6324101022645832],
                [2.0, 0.0],
            ],
            row: [
                [-2.9958490424689006, 0.6231066367931157],
                [-0.5696071475778677, -1.4627798230961568],
                [0.2838439431080708, 0.12886760063671623],
            ],
        },
    ],
};

/// Order 8.
pub(crate) const GAUSS8: Collocation<4> = Collocation {
    c: [0.06943184420297371, 0.33000947820757187, 0.6699905217924281, 0.9305681557970263],
    b: [0.17392742256872692, 0.32607257743127305, 0.32607257743127305, 0.17392742256872692],
    below: [
        [0.0, 0.0, 0.0, 0.0],
        [1.08158975003228, 0.0, 0.0, 0.0],
        [0.9612740734321142, 1.0855037514105192, 0.0, 0.0],
        [1.0204404206840407, 0.9612740734321142, 1.08158975003228, 0.0],
    ],
    modes: &[
        Mode {
            value: [0.09156624026571764, 0.11566261301312761],
            column: [
                [0.09848930855233592, -0.012068122458522207],
                [-0.244685642367975, -0.07869470921390644],
                [0.1940032619978687, 0.731926825627848],
                [2.0, 0.0],
            ],
            row: [
                [2.186080360673037, 3.932624629453582],
                [-2.3006021459944086, 2.215024987591394],
                [-0.21130982768185336, -1.063261831427951],
                [0.13138246938708745, 0.1804697975269985],
            ],
        },
        Mode {
            value: [0.15843375973428236, 0.047441012571108436],
            column: [
                [-0.024683519482727664, 0.046993836431206575],
                [0.05705036982327938, 0.024081867275201674],
                [0.3670183218938975, 0.2239815718998137],
                [2.0, 0.0],
            ],
            row: [
                [-2.186080360673037, -14.53967064494889],
                [2.3006021459944086, -5.461151912600695],
                [0.21130982768185336, -0.826899993815279],
                [0.3686175306129126, 0.12807897037104882],
            ],
        },
    ],
};
