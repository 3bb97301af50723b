//! Mistakes that the compiler finds in types and names, see `ui.rs`: each case is a crate. They take as long
//! as all others together, so `cargo test` leaves them to `scripts/check.sh ui`.
//!
//! `TRYBUILD=overwrite cargo test --test ui_types` writes the outputs anew.

// What the macro reports is the other test's.
#[allow(dead_code)]
#[path = "ui/cases/mod.rs"]
mod cases;

#[test]
fn the_compiler_reports_mistakes_where_they_are() {
    if !cases::is_known_compiler() {
        return;
    }
    let of_the_macro = &cases::of_the_macro() & &cases::stems("stderr");
    let tests = trybuild::TestCases::new();
    let own = &cases::stems("rs") - &of_the_macro;
    assert!(own.len() > 30, "{own:?}");
    for name in own {
        tests.compile_fail(format!("tests/ui/{name}.rs"));
    }
}
