//! The page of [`gallery::models::three_body`] as a module of WebAssembly.

gallery::page!(gallery::models::three_body::ThreeBody, 6);
