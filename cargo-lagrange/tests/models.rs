//! `equations`, `structure`, `cost`, `expand`, `verify` and `new`.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const TEMPLATE: &str = "template/main.rs";
const CONTACTS: &str = "tests/files/contacts.rs";
const TREE: &str = "tests/files/models/main.rs";

fn lagrange(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cargo-lagrange"));
    command.current_dir(folder).args(arguments).output().expect("the command starts")
}

fn here(arguments: &[&str]) -> Output {
    lagrange(Path::new(env!("CARGO_MANIFEST_DIR")), arguments)
}

/// Standard output of a command that succeeds.
fn printed(arguments: &[&str]) -> String {
    let output = here(arguments);
    assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
    text(&output.stdout)
}

/// Standard error of a command that fails and prints nothing else.
fn refused(arguments: &[&str]) -> String {
    let output = here(arguments);
    assert!(!output.status.success() && output.stdout.is_empty(), "{arguments:?}");
    text(&output.stderr)
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A folder outside the workspace of this package.
fn outside() -> tempfile::TempDir {
    tempfile::tempdir().expect("the folder can be made")
}

#[test]
fn equations_are_text_latex_mathml_and_json() {
    let plain = "mass·length²·θ̈ + mass·length·gravity·sin θ = −damping·θ̇\n";
    assert_eq!(printed(&["equations", "--file", TEMPLATE]), plain);
    assert_eq!(printed(&["lagrange", "equations", "Pendulum", "--file", TEMPLATE]), plain);
    let latex = printed(&["equations", "--latex", "--file", TEMPLATE]);
    assert!(latex.starts_with("\\begin{aligned}") && latex.contains("\\ddot{\\theta}"), "{latex}");
    let values: serde_json::Value =
        serde_json::from_str(&printed(&["equations", "--json", "--file", TEMPLATE])).expect("it is JSON");
    assert_eq!(values[0]["text"], plain.trim_end());
    assert_eq!(values[0]["latex"], latex.trim_end());
    let mathml = printed(&["equations", "--mathml", "--file", TEMPLATE]);
    assert_eq!(values[0]["mathml"], mathml.trim_end());
    // The elements decide what a screen reader says. Products and functions have signs that are not seen.
    assert_eq!(
        row_of(&mathml),
        "mass⋅length^2⋅(θ over ¨)+mass⋅length⋅gravity⋅sin\u{2061}θ=−damping⋅(θ over ˙)"
    );
    assert_eq!((&values[0]["model"], &values[0]["line"]), (&"Pendulum".into(), &16.into()));
}

#[test]
fn equations_with_contacts_and_friction_have_all_forms() {
    let values: serde_json::Value =
        serde_json::from_str(&printed(&["equations", "--json", "--file", CONTACTS])).expect("it is JSON");
    // The equations between contacts. Reactions and friction come with the regimes.
    let form = |name: &str| values[0][name].as_str().unwrap_or_default().to_owned();
    assert!(form("text").contains("mass·y\u{308} + 9.81 mass"), "{}", form("text"));
    assert!(form("latex").contains("\\ddot{y}"), "{}", form("latex"));
    well_formed(&form("mathml"));
}

/// The only row of equations in MathML as one line.
fn row_of(mathml: &str) -> String {
    fn line(element: roxmltree::Node<'_, '_>) -> String {
        let parts = || element.children().filter(|child| child.is_element()).map(line);
        match element.tag_name().name() {
            "msup" => parts().collect::<Vec<_>>().join("^"),
            "mover" => format!("({})", parts().collect::<Vec<_>>().join(" over ")),
            "mi" | "mn" | "mo" => element.text().unwrap_or_default().to_owned(),
            _ => parts().collect(),
        }
    }
    well_formed(mathml);
    line(roxmltree::Document::parse(mathml).expect("it is XML").root_element())
}

/// Every element is one of MathML Core, with as many children as it takes.
fn well_formed(mathml: &str) {
    let document = roxmltree::Document::parse(mathml).expect("it is XML");
    assert_eq!(document.root_element().tag_name().name(), "math");
    for element in document.descendants().filter(roxmltree::Node::is_element) {
        let name = element.tag_name();
        assert_eq!(name.namespace(), Some("http://www.w3.org/1998/Math/MathML"));
        let children = element.children().filter(roxmltree::Node::is_element).count();
        let (least, most) = match name.name() {
            "mi" | "mn" | "mo" | "mtext" | "mspace" => (0, 0),
            "msup" | "msub" | "mover" | "mfrac" => (2, 2),
            "math" => (1, 1),
            "mtr" => (2, 2),
            "mtd" | "mrow" | "msqrt" | "mtable" => (0, usize::MAX),
            other => panic!("{other} is no element of MathML Core"),
        };
        assert!((least..=most).contains(&children), "{children} in {}: {mathml}", name.name());
        let has_text = element.text().is_some_and(|text| !text.is_empty());
        assert!(children > 0 || most > 0 || has_text != (name.name() == "mspace"), "{mathml}");
    }
}

#[test]
fn every_model_has_equations_in_mathml() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    for file in fs::read_dir(folder).expect("there are examples") {
        let path = file.expect("it can be listed").path();
        if path.extension().is_some_and(|extension| extension == "rs") {
            let shown = path.display().to_string();
            let values: serde_json::Value =
                serde_json::from_str(&printed(&["equations", "--json", "--file", &shown]))
                    .expect("it is JSON");
            let models = values.as_array().expect("it is a list");
            assert!(!models.is_empty(), "{shown}");
            models.iter().for_each(|model| well_formed(model["mathml"].as_str().unwrap_or_default()));
        }
    }
}

#[test]
fn structure_and_cost_are_those_of_the_constants() {
    let structure = printed(&["structure", "--file", TEMPLATE]);
    assert!(structure.starts_with("mass matrix: constant"), "{structure}");
    assert!(structure.contains("\nskipped:\n  - time: nothing depends on it\n"), "{structure}");
    let values: serde_json::Value =
        serde_json::from_str(&printed(&["cost", "--json", "--file", TEMPLATE])).expect("it is JSON");
    // θ̈ = −(m l g sin θ + c θ̇) / (m l²), with products and quotients of parameters made before;
    // the sign counts as a subtraction.
    let after = serde_json::json!({ "additions": 2, "multiplications": 3, "divisions": 0, "square_roots": 0, "functions": 1 });
    assert_eq!(values[0]["after"], after);
}

#[test]
fn one_generated_function_is_printed_or_all_of_the_code() {
    let function = printed(&["expand", "accelerations_at", "--file", TEMPLATE]);
    assert!(function.contains("fn accelerations_at(") && !function.contains("fn energy_at("), "{function}");
    let all = printed(&["expand", "--file", TEMPLATE]);
    assert!(all.contains("fn accelerations_at(") && all.contains("fn energy_at("));
    let message = refused(&["expand", "acceleration", "--file", TEMPLATE]);
    assert!(message.contains("no generated function `acceleration`; there are accelerations, "), "{message}");
}

#[test]
fn models_are_found_in_the_modules_of_a_file() {
    let message = refused(&["structure", "Missing", "--file", TREE]);
    let names: Vec<&str> = ["Spring", "Wrong", "Deep", "Elsewhere", "Leaf"].to_vec();
    assert!(message.starts_with(&format!("error: no model `Missing` in {TREE}; there are ")), "{message}");
    for name in names {
        assert!(message.contains(&format!("{name} (")), "{name}: {message}");
    }
    assert!(message.contains("inline/leaf.rs:1") && message.contains("elsewhere.rs:1"), "{message}");
    assert!(printed(&["structure", "Leaf", "--file", TREE]).contains("constant"));
}

#[test]
fn mistakes_have_their_places() {
    let message = refused(&["equations", "--file", TREE]);
    assert!(message.contains(&format!("{TREE}:29:32: error: there is no coordinate `y`")), "{message}");
    assert!(message.contains(&format!("{TREE}:29:38: error: there is no coordinate `z`")), "{message}");
    assert!(refused(&["cost", "--file", "missing.rs"]).starts_with("error: missing.rs: "));
    let readme = refused(&["cost", "--file", "README.md"]);
    // Text with an unbalanced quote is no Rust from there on.
    assert!(readme.starts_with("error: README.md:3:"), "{readme}");
    let message = refused(&["cost", "--file", "tests/files/usage.rs"]);
    assert!(message.contains("no `#[lagrangian] impl` in tests/files/usage.rs"), "{message}");
    let message = refused(&["cost", "--package", "nothing"]);
    assert!(message.contains("no package `nothing`; there are "), "{message}");
}

#[test]
fn a_new_package_is_written_once() {
    let folder = outside();
    let folder = folder.path();
    let output = lagrange(folder, &["new", "swing"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let read = |file: &str| fs::read_to_string(folder.join("swing").join(file)).expect("the file is there");
    assert!(read("Cargo.toml").contains(concat!("lagrangian = \"", env!("CARGO_PKG_VERSION"), "\"")));
    assert!(read("Cargo.toml").contains("[profile.dev]"));
    assert_eq!(read("src/main.rs"), include_str!("../template/main.rs"));
    for (name, message) in
        [("swing", "already exists"), ("try", "keyword"), ("7up", "cannot start with a digit")]
    {
        let output = lagrange(folder, &["new", name]);
        assert!(
            !output.status.success() && text(&output.stderr).contains(message),
            "{}",
            text(&output.stderr)
        );
    }
    assert!(lagrange(folder, &["new", "7up", "--name", "seven"]).status.success());
    assert!(read("../7up/Cargo.toml").contains("name = \"seven\""));
}

/// Cargo makes the package a member, and reads profiles in the root alone.
#[test]
fn a_new_package_joins_the_workspace_around_it() {
    let folder = outside();
    let folder = folder.path();
    let root = folder.join("Cargo.toml");
    fs::write(&root, "[workspace]\nresolver = \"3\"\nmembers = []\n").expect("the file can be written");
    let output = lagrange(folder, &["new", "swing"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let read = |path: &Path| fs::read_to_string(path).expect("the file is there");
    assert!(read(&root).contains("swing"), "{}", read(&root));
    let manifest = read(&folder.join("swing/Cargo.toml"));
    assert!(manifest.contains("lagrangian = ") && !manifest.contains("[profile"), "{manifest}");
}

/// Builds the library several times; `scripts/check.sh command` runs it.
#[test]
#[ignore = "builds a package from nothing"]
fn a_new_package_runs_and_is_verified() {
    let folder = outside();
    let folder = folder.path();
    let checkout = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let output = lagrange(folder, &["new", "swing", "--lagrangian", &checkout.to_string_lossy()]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let package = folder.join("swing");
    let output = Command::new(env!("CARGO"))
        .args(["run", "--quiet"])
        .current_dir(&package)
        .output()
        .expect("cargo runs");
    assert!(text(&output.stdout).contains(" 10.00 "), "{}", text(&output.stderr));
    assert!(text(&lagrange(&package, &["structure"]).stdout).starts_with("mass matrix: "));

    let output = lagrange(&package, &["verify"]);
    assert!(!output.status.success() && text(&output.stderr).contains("says `verify = …`"));
    let system = "Self { mass: 1.0, length: 2.0, gravity: 9.81, damping: 0.1 }";
    let asking = include_str!("../template/main.rs")
        .replace("coordinates = [theta]", &format!("coordinates = [theta], verify = {system}"));
    fs::write(package.join("src/main.rs"), &asking).expect("the file can be written");
    let output = lagrange(&package, &["verify"]);
    assert!(output.status.success() && text(&output.stdout).contains("1 passed"), "{}", text(&output.stderr));

    let library = asking.split("fn main").next().expect("there is a part before it");
    fs::write(package.join("src/lib.rs"), library).expect("the file can be written");
    let output = lagrange(&package, &["verify", &system.replace("Self", "swing::Pendulum")]);
    assert!(text(&output.stdout).starts_with("verified: "), "{}", text(&output.stderr));
    let output = lagrange(&package, &["verify", "swing::Pendulum {"]);
    assert!(text(&output.stderr).contains("is not an expression"));
}
