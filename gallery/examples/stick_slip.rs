//! The page of [`gallery::models::stick_slip`] as a module of WebAssembly.

gallery::page!(gallery::models::stick_slip::Belt, 1);
