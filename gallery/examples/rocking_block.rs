//! The page of [`gallery::models::rocking_block`] as a module of WebAssembly.

gallery::page!(gallery::models::rocking_block::Block, 3);
