//! The page of [`gallery::models::cart_pole`] as a module of WebAssembly.

gallery::page!(gallery::models::cart_pole::CartPole, 2);
