//! The page of [`gallery::models::top`] as a module of WebAssembly.

gallery::page!(gallery::models::top::Top, 3);
