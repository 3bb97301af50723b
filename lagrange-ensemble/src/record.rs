//! [`Record`]: what a motion leaves in the table of a study, a row of numbers in named columns.

use lagrange_runtime::State;
use serde::{Deserialize, Serialize};

/// The type of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Doubles; no number in rows without a result.
    F64,
    /// Singles; no number in rows without a result.
    F32,
    /// Signed integers of 64 bits; zero in rows without a result.
    I64,
    /// Signed integers of 32 bits; zero in rows without a result.
    I32,
    /// Integers of 64 bits without a sign; zero in rows without a result.
    U64,
    /// Integers of 32 bits without a sign; zero in rows without a result.
    U32,
    /// Bytes; zero in rows without a result.
    U8,
    /// True or false; false in rows without a result.
    Bool,
}

impl Kind {
    /// Bytes of a value in the file.
    pub(crate) fn size(self) -> usize {
        match self {
            Self::F64 | Self::I64 | Self::U64 => 8,
            Self::F32 | Self::I32 | Self::U32 => 4,
            Self::U8 | Self::Bool => 1,
        }
    }
}

/// A column: a name and a type.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Column {
    /// The name, as it stands in files.
    pub name: String,
    /// The type.
    pub kind: Kind,
}

/// The result of a motion: a fixed number of values.
///
/// Numbers, `bool`, `Option<f64>` (`None` is stored as NaN), [`State`], arrays and tuples of records are
/// records. A type of yours becomes one by three short functions that go through its fields in the same
/// order:
///
/// ```
/// use lagrange_ensemble::{Cells, Column, Record};
///
/// struct Landing {
///     time: f64,
///     upright: bool,
/// }
///
/// impl Record for Landing {
///     fn columns() -> Vec<Column> {
///         [f64::named("time"), bool::named("upright")].concat()
///     }
///
///     fn store(&self, row: &mut Vec<u8>) {
///         self.time.store(row);
///         self.upright.store(row);
///     }
///
///     fn load(row: &mut Cells<'_>) -> Self {
///         Self { time: Record::load(row), upright: Record::load(row) }
///     }
/// }
/// ```
pub trait Record: Sized {
    /// The columns, in order.
    fn columns() -> Vec<Column>;

    /// Appends the values to a row.
    fn store(&self, row: &mut Vec<u8>);

    /// Takes the values from a row, in the order in which they were stored.
    fn load(row: &mut Cells<'_>) -> Self;

    /// The columns as parts of a larger record. A single number has this name; other names begin with it.
    fn named(name: &str) -> Vec<Column> {
        let columns = Self::columns();
        let single = columns.len() == 1;
        let rename = |column: Column| {
            let name = if single { name.to_owned() } else { format!("{name}_{}", column.name) };
            Column { name, ..column }
        };
        columns.into_iter().map(rename).collect()
    }
}

/// The values of a row, one after the other. Beyond the last one everything is zero.
#[derive(Debug)]
pub struct Cells<'a>(pub(crate) &'a [u8]);

impl Cells<'_> {
    /// The next bytes.
    pub(crate) fn take<const N: usize>(&mut self) -> [u8; N] {
        match self.0.split_first_chunk() {
            Some((bytes, rest)) => {
                self.0 = rest;
                *bytes
            }
            None => [0; N],
        }
    }
}

macro_rules! numbers {
    ($($number:ty as $kind:ident),*) => {$(
        impl Record for $number {
            fn columns() -> Vec<Column> {
                vec![Column { name: "value".to_owned(), kind: Kind::$kind }]
            }

            fn store(&self, row: &mut Vec<u8>) {
                row.extend_from_slice(&self.to_le_bytes());
            }

            fn load(row: &mut Cells<'_>) -> Self {
                Self::from_le_bytes(row.take())
            }
        }
    )*};
}

numbers!(f64 as F64, f32 as F32, i64 as I64, i32 as I32, u64 as U64, u32 as U32, u8 as U8);

/// Stored as `u64`, the same on all machines.
impl Record for usize {
    fn columns() -> Vec<Column> {
        u64::columns()
    }

    fn store(&self, row: &mut Vec<u8>) {
        (*self as u64).store(row);
    }

    fn load(row: &mut Cells<'_>) -> Self {
        Self::try_from(u64::load(row)).unwrap_or(Self::MAX)
    }
}

impl Record for bool {
    fn columns() -> Vec<Column> {
        vec![Column { name: "value".to_owned(), kind: Kind::Bool }]
    }

    fn store(&self, row: &mut Vec<u8>) {
        row.push(u8::from(*self));
    }

    fn load(row: &mut Cells<'_>) -> Self {
        row.take::<1>() != [0]
    }
}

/// `None` is stored as NaN, and NaN is read back as `None`.
impl Record for Option<f64> {
    fn columns() -> Vec<Column> {
        f64::columns()
    }

    fn store(&self, row: &mut Vec<u8>) {
        self.unwrap_or(f64::NAN).store(row);
    }

    fn load(row: &mut Cells<'_>) -> Self {
        Some(f64::load(row)).filter(|value| !value.is_nan())
    }
}

impl<T: Record, const N: usize> Record for [T; N] {
    fn columns() -> Vec<Column> {
        Self::named(if T::columns().len() == 1 { "value" } else { "" })
    }

    fn named(name: &str) -> Vec<Column> {
        (0..N).flat_map(|i| T::named(&format!("{name}{i}"))).collect()
    }

    fn store(&self, row: &mut Vec<u8>) {
        self.iter().for_each(|value| value.store(row));
    }

    fn load(row: &mut Cells<'_>) -> Self {
        std::array::from_fn(|_| T::load(row))
    }
}

/// Columns `t`, `q0`, `q1`, …, `v0`, `v1`, ….
impl<R: Record, const N: usize> Record for State<R, N> {
    fn columns() -> Vec<Column> {
        [R::named("t"), <[R; N]>::named("q"), <[R; N]>::named("v")].concat()
    }

    fn store(&self, row: &mut Vec<u8>) {
        self.t.store(row);
        self.q.store(row);
        self.v.store(row);
    }

    fn load(row: &mut Cells<'_>) -> Self {
        Self { t: R::load(row), q: Record::load(row), v: Record::load(row) }
    }
}

macro_rules! tuples {
    ($(($($part:ident $index:tt $name:literal),*);)*) => {$(
        impl<$($part: Record),*> Record for ($($part,)*) {
            fn columns() -> Vec<Column> {
                [$($part::named($name)),*].concat()
            }

            fn store(&self, row: &mut Vec<u8>) {
                $(self.$index.store(row);)*
            }

            fn load(row: &mut Cells<'_>) -> Self {
                ($($part::load(row),)*)
            }
        }
    )*};
}

tuples! {
    (A 0 "a", B 1 "b");
    (A 0 "a", B 1 "b", C 2 "c");
    (A 0 "a", B 1 "b", C 2 "c", D 3 "d");
    (A 0 "a", B 1 "b", C 2 "c", D 3 "d", E 4 "e");
    (A 0 "a", B 1 "b", C 2 "c", D 3 "d", E 4 "e", F 5 "f");
}
