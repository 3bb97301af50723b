//! The page of [`gallery::models::chain`] as a module of WebAssembly.

gallery::page!(gallery::models::chain::Chain, 10);
