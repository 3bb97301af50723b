//! The options and the pictures of the examples of many motions.
#![allow(dead_code)]

use std::error::Error;
use std::fs::{self, File};
use std::io::BufWriter;
use std::path::{Path, PathBuf};

/// Options of the command line.
#[derive(Clone, Debug)]
pub struct Options {
    /// Pixels.
    pub width: u64,
    /// Pixels.
    pub height: u64,
    /// The folder of the files.
    pub out: PathBuf,
    /// `--part k/n`: only this share of the motions.
    pub part: Option<(u64, u64)>,
    /// Threads; one a core if zero.
    pub threads: usize,
}

impl Options {
    /// Takes `--width W --height H --out DIR --part K/N --threads T` from the command line. In tests the
    /// command line is the test's, so nothing is taken from it.
    pub fn from_command_line(name: &str, width: u64, height: u64) -> Result<Self, Box<dyn Error>> {
        let out = Path::new(env!("CARGO_MANIFEST_DIR")).join("target").join(name);
        let mut options = Self { width, height, out, part: None, threads: 0 };
        let mut words = std::env::args().skip(if cfg!(test) { usize::MAX } else { 1 });
        while let Some(option) = words.next() {
            let value = words.next().ok_or_else(|| format!("{option} needs a value"))?;
            match option.as_str() {
                "--width" => options.width = value.parse()?,
                "--height" => options.height = value.parse()?,
                "--out" => options.out = value.into(),
                "--threads" => options.threads = value.parse()?,
                "--part" => {
                    let (k, n) = value.split_once('/').ok_or("--part takes k/n, as 2/3")?;
                    options.part = Some((k.parse()?, n.parse()?));
                }
                _ => {
                    return Err(
                        format!("no option {option}: --width, --height, --out, --part, --threads").into()
                    );
                }
            }
        }
        fs::create_dir_all(&options.out)?;
        Ok(options)
    }
}

/// Writes a picture of pixels in rows, the lowest row first.
pub fn save(path: &Path, width: u64, pixels: &[[u8; 3]]) -> Result<(), Box<dyn Error>> {
    let width = usize::try_from(width)?.max(1);
    let rows = pixels.chunks(width).rev().flatten().flatten().copied().collect::<Vec<u8>>();
    // Whoever looks while another job writes sees a whole picture.
    let temporary = path.with_extension(format!("{}.tmp", std::process::id()));
    let mut encoder = png::Encoder::new(
        BufWriter::new(File::create(&temporary)?),
        u32::try_from(width)?,
        u32::try_from(pixels.len() / width)?,
    );
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&rows)?;
    writer.finish()?;
    fs::rename(&temporary, path)?;
    println!("wrote {}", path.display());
    Ok(())
}

/// A colour between 0, dark violet, and 1, yellow: viridis at nine places.
pub fn colour(share: f64) -> [u8; 3] {
    const PLACES: [[f64; 3]; 9] = [
        [68.0, 1.0, 84.0],
        [71.0, 44.0, 122.0],
        [59.0, 81.0, 139.0],
        [44.0, 113.0, 142.0],
        [33.0, 144.0, 141.0],
        [39.0, 173.0, 129.0],
        [92.0, 200.0, 99.0],
        [170.0, 220.0, 50.0],
        [253.0, 231.0, 37.0],
    ];
    let at = share.clamp(0.0, 1.0) * 8.0;
    let below = (at as usize).min(7);
    let between = at - below as f64;
    std::array::from_fn(|k| {
        (PLACES[below][k] * (1.0 - between) + PLACES[below + 1][k] * between).round() as u8
    })
}
