//! The page of [`gallery::models::four_bar`] as a module of WebAssembly.

gallery::page!(gallery::models::four_bar::FourBar, 3);
