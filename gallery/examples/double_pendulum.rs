//! The page of [`gallery::models::double_pendulum`] as a module of WebAssembly.

gallery::page!(gallery::models::double_pendulum::DoublePendulum, 2);
