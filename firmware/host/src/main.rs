//! Prints the bits of all motions.
fn main() {
    let mut text = String::new();
    systems::bits::report(&mut text).unwrap();
    print!("{text}");
}
