//! Null space of a matrix given by random samples.

/// A pivot counts as zero below this share of the largest entry of its given row.
const NEGLIGIBLE: f64 = 1e-9;

/// A basis of all x with `rows` x = 0. Each vector has a one in a column of its own, as far right as
/// possible, where the others have zeros. Rows are scaled to a largest entry of one, and those that are not
/// finite are left out.
pub(super) fn null_space(rows: Vec<Vec<f64>>, columns: usize) -> Vec<Vec<f64>> {
    let mut rows: Vec<Vec<f64>> = rows.into_iter().filter_map(scaled).collect();
    let mut pivots: Vec<Option<usize>> = vec![None; columns];
    let mut rank = 0;
    for column in 0..columns {
        let size = |row: usize| rows[row][column].abs();
        let Some(best) = (rank..rows.len()).max_by(|&a, &b| size(a).total_cmp(&size(b))) else { continue };
        if size(best) < NEGLIGIBLE {
            continue;
        }
        rows.swap(rank, best);
        let pivot = rows[rank][column];
        rows[rank].iter_mut().for_each(|entry| *entry /= pivot);
        let leading = rows[rank].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|&(place, _)| place != rank) {
            let factor = row[column];
            if factor != 0.0 {
                row[column..].iter_mut().zip(&leading[column..]).for_each(|(entry, &l)| *entry -= factor * l);
            }
        }
        pivots[column] = Some(rank);
        rank += 1;
    }
    (0..columns)
        .filter(|&column| pivots[column].is_none())
        .map(|free| {
            let entry = |column: usize| match pivots[column] {
                Some(row) => -rows[row][free],
                None => f64::from(u8::from(column == free)),
            };
            (0..columns).map(entry).collect()
        })
        .collect()
}

fn scaled(mut row: Vec<f64>) -> Option<Vec<f64>> {
    let largest = row.iter().fold(0.0, |largest: f64, entry| largest.max(entry.abs()));
    if !row.iter().all(|entry| entry.is_finite()) || largest == 0.0 {
        return None;
    }
    row.iter_mut().for_each(|entry| *entry /= largest);
    Some(row)
}

/// Pseudo-random numbers, the same in every run.
pub(super) struct Noise(pub u64);

impl Noise {
    /// The next number between two bounds (Vigna's splitmix64).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let share = ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * share
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_basis_is_reduced() {
        let mut noise = Noise(1);
        // Columns 1 and 2 add up to column 0, column 4 is twice column 3.
        let rows = (0..9)
            .map(|_| {
                let [a, b, c] = [0; 3].map(|_| noise.between(-1.0, 1.0));
                vec![a + b, a, b, c, 2.0 * c]
            })
            .collect();
        let basis = null_space(rows, 5);
        let expected = [[-1.0, 1.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, -2.0, 1.0]];
        assert_eq!(basis.len(), 2);
        for (found, expected) in basis.iter().flatten().zip(expected.iter().flatten()) {
            assert!((found - expected).abs() < 1e-12, "{basis:?}");
        }
    }

    #[test]
    fn a_regular_matrix_has_none() {
        let mut noise = Noise(2);
        let rows = (0..30).map(|_| (0..20).map(|_| noise.between(-1.0, 1.0)).collect()).collect();
        assert!(null_space(rows, 20).is_empty());
    }
}
