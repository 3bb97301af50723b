//! The developer's machine: the bits to compare those of the targets with, and tables of what was measured on
//! these.

mod errors;
mod table;

use std::error::Error;
use std::io::Read;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["bits"] => {
            let mut text = String::new();
            systems::bits::report(&mut text)?;
            print!("{text}");
        }
        ["errors"] => print!("{}", table::errors()?),
        ["figures", all, summary] => {
            let mut text = String::new();
            std::io::stdin().read_to_string(&mut text)?;
            let measurements = table::Measurements::parse(&text)?;
            table::write(all, &measurements.whole()?)?;
            table::write(summary, &measurements.summary())?;
        }
        _ => return Err("usage: host bits | host errors | host figures README CHAPTER < MEASUREMENTS".into()),
    }
    Ok(())
}
