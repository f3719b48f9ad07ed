//! Four numbers in one register that are one thing: a vector in space, or a row of a matrix.

use super::{Array, Real, Wide};

/// x, y, z and a fourth number, zero for a vector.
///
/// Numbers change places through arrays: compilers know these for shuffles.
pub trait Quad<T: Real>: Wide<Constant = T> {
    /// (x, y, z, w).
    #[inline(always)]
    fn of(x: [T; 4]) -> Self {
        Self::from_slice(&x)
    }

    /// [x, y, z, w].
    #[inline(always)]
    fn numbers(self) -> [T; 4] {
        let mut x = [T::ZERO; 4];
        self.to_slice(&mut x);
        x
    }

    /// x in all four places, and so on.
    #[inline(always)]
    fn each(self) -> [Self; 4] {
        let [x, y, z, w] = self.numbers();
        [Self::of([x; 4]), Self::of([y; 4]), Self::of([z; 4]), Self::of([w; 4])]
    }

    /// x + y + z + w in all four places.
    #[inline(always)]
    fn total(self) -> Self {
        let [x, y, z, w] = self.numbers();
        let pairs = self + Self::of([y, x, w, z]);
        let [x, y, z, w] = pairs.numbers();
        pairs + Self::of([z, w, x, y])
    }

    /// a × b; the fourth numbers are zero.
    #[inline(always)]
    fn cross(self, b: Self) -> Self {
        (self.mul_add(b.yzx(), -(self.yzx() * b))).yzx()
    }

    /// (y, z, x, w).
    #[inline(always)]
    fn yzx(self) -> Self {
        let [x, y, z, w] = self.numbers();
        Self::of([y, z, x, w])
    }

    /// Columns of a matrix from its rows.
    #[inline(always)]
    fn transpose(rows: [Self; 4]) -> [Self; 4] {
        let [a, b, c, d] = rows;
        let (a, b, c, d) = (a.numbers(), b.numbers(), c.numbers(), d.numbers());
        [
            Self::of([a[0], b[0], c[0], d[0]]),
            Self::of([a[1], b[1], c[1], d[1]]),
            Self::of([a[2], b[2], c[2], d[2]]),
            Self::of([a[3], b[3], c[3], d[3]]),
        ]
    }
}

impl<T: Real> Quad<T> for Array<4, T> {}
