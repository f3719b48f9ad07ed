//! Systems with H − σB, by the factors of one sweep.
//!
//! ```text
//! for i = N..1, d last to first:    u_d = b_d − S_dᵀ p_i      p_i += U_d D_d⁻¹ u_d      then p_parent += X_upᵀ p_i
//! for i = 1..N, d first to last:    x_d = D_d⁻¹ (u_d − U_dᵀ a_i)      a_i += S_d x_d         a_i starts as X_up a_parent
//! ```
//! The articulated-body algorithm on a robot at rest, with −σB in its hinges. Two shifts side by side, each with its own system.

use super::carry::Carry;
use super::hinge::Hinge;
use super::pencil::Pencil;
use super::sweep::{Pivots, sweep};
use crate::joint::Column;
use crate::scalar::{Array, PairAlgorithm, Scalar, Unit, dispatch_pair};
use crate::spatial::{ArticulatedInertia, Force, Motion};

/// L and D of H − σB, of two shifts.
#[derive(Debug, Clone)]
pub(crate) struct Factors {
    unit: Unit,
    U: Vec<Force<Array<2>>>,
    D_inverse: Vec<Array<2>>,
    /// Number of negative pivots: eigenvalues below the shift.
    pub below: Array<2>,
    /// N: a.
    a: Vec<Motion<Array<2>>>,
    waiting: (Vec<ArticulatedInertia<Array<2>>>, Vec<Force<Array<2>>>),
}

impl Factors {
    /// Room for them, to be computed on no wider a unit than this.
    pub fn new(pencil: &Pencil<'_, f64>, unit: Unit) -> Self {
        let (n, nv) = (pencil.nodes.len(), pencil.S.len());
        Self {
            unit,
            U: vec![Force::ZERO; nv],
            D_inverse: vec![Array::ZERO; nv],
            below: Array::ZERO,
            a: vec![Motion::ZERO; n],
            waiting: (Vec::new(), Vec::new()),
        }
    }

    /// Factorises H − σB.
    pub fn factor(&mut self, pencil: &Pencil<'_, f64>, shift: Array<2>) {
        dispatch_pair(self.unit, Factor { factors: self, pencil, shift });
    }

    /// x ← (H − σB)⁻¹ x.
    pub fn solve(&mut self, pencil: &Pencil<'_, f64>, x: &mut [Array<2>]) {
        dispatch_pair(self.unit, Solve { factors: self, pencil, x });
    }

    /// Sets the bodies in motion with the rates x.
    pub fn set_moving(&mut self, pencil: &Pencil<'_, f64>, x: &[Array<2>]) {
        dispatch_pair(self.unit, Move { a: &mut self.a, pencil, x });
    }

    /// xᵀHx of the last solution: twice its kinetic energy. A sum of squares, so that what the factors lost to cancellation is not in it.
    pub fn energy(&self, pencil: &Pencil<'_, f64>, x: &[Array<2>]) -> Array<2> {
        dispatch_pair(self.unit, Energy { a: &self.a, pencil, x })
    }

    /// Scales what [`motions`](Self::motions) tells.
    pub fn scale_motions(&mut self, s: Array<2>) {
        self.a.iter_mut().for_each(|a| *a = *a * s);
    }

    /// The motion of every body under the last solution.
    pub fn motions(&self) -> &[Motion<Array<2>>] {
        &self.a
    }
}

struct Factor<'a> {
    factors: &'a mut Factors,
    pencil: &'a Pencil<'a, f64>,
    shift: Array<2>,
}

impl PairAlgorithm for Factor<'_> {
    type Output = ();

    #[inline(always)]
    fn run<T: Scalar<Constant = f64, Stored = Array<2>>>(self) {
        let Factors { U, D_inverse, waiting, below, .. } = self.factors;
        let mut keep = Keep { U, D_inverse, below: T::ZERO };
        sweep(self.pencil, T::load(self.shift), &mut waiting.0, &mut keep);
        *below = keep.below.store();
    }
}

struct Keep<'a, T: Scalar> {
    U: &'a mut [Force<T::Stored>],
    D_inverse: &'a mut [T::Stored],
    below: T,
}

impl<T: Scalar> Pivots<T> for Keep<'_, T> {
    #[inline(always)]
    fn pivot(&mut self, d: usize, _: Column, hinge: &Hinge<T>) {
        self.U[d] = hinge.U.map(T::store);
        self.D_inverse[d] = hinge.D_inverse.store();
        self.below += hinge.D.select_lt(T::ZERO, T::ONE, T::ZERO);
    }
    #[inline(always)]
    fn body(&mut self, _: usize, _: &ArticulatedInertia<T>) {}
}

struct Solve<'a> {
    factors: &'a mut Factors,
    pencil: &'a Pencil<'a, f64>,
    x: &'a mut [Array<2>],
}

impl PairAlgorithm for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn run<T: Scalar<Constant = f64, Stored = Array<2>>>(self) {
        let Self { factors: Factors { U, D_inverse, a, waiting, .. }, pencil: Pencil { nodes, S, .. }, x } =
            self;
        let mut carry = Carry::new(Force::<T>::ZERO, &mut waiting.1);
        for node in nodes.iter().rev() {
            let mut p_i = carry.collect(node, Force::ZERO);
            for (d, &column) in node.dofs().zip(node.columns).rev() {
                let u = T::load(x[d]) - column.along(S[d].map(T::constant), p_i);
                p_i += U[d].map(T::load) * (T::load(D_inverse[d]) * u);
                x[d] = u.store();
            }
            carry.hand_down(
                node.route,
                #[inline(always)]
                || node.X_up.map(T::constant).transpose_force(p_i),
            );
        }
        for (i, node) in nodes.iter().enumerate() {
            let X_up = node.X_up.map(T::constant);
            let mut a_i = match node.parent() {
                Some(parent) => X_up.motion(a[parent].map(T::load)),
                None => Motion::ZERO,
            };
            for (d, &column) in node.dofs().zip(node.columns) {
                let x_d = (T::load(x[d]) - a_i.dot(U[d].map(T::load))) * T::load(D_inverse[d]);
                a_i = column.moved(a_i, S[d].map(T::constant), x_d);
                x[d] = x_d.store();
            }
            a[i] = a_i.map(T::store);
        }
    }
}

struct Move<'a> {
    a: &'a mut [Motion<Array<2>>],
    pencil: &'a Pencil<'a, f64>,
    x: &'a [Array<2>],
}

impl PairAlgorithm for Move<'_> {
    type Output = ();

    #[inline(always)]
    fn run<T: Scalar<Constant = f64, Stored = Array<2>>>(self) {
        let Self { a, pencil: Pencil { nodes, S, .. }, x } = self;
        for (i, node) in nodes.iter().enumerate() {
            let mut a_i = match node.parent() {
                Some(parent) => node.X_up.map(T::constant).motion(a[parent].map(T::load)),
                None => Motion::ZERO,
            };
            for (d, &column) in node.dofs().zip(node.columns) {
                a_i = column.moved(a_i, S[d].map(T::constant), T::load(x[d]));
            }
            a[i] = a_i.map(T::store);
        }
    }
}

struct Energy<'a> {
    a: &'a [Motion<Array<2>>],
    pencil: &'a Pencil<'a, f64>,
    x: &'a [Array<2>],
}

impl PairAlgorithm for Energy<'_> {
    type Output = Array<2>;

    #[inline(always)]
    fn run<T: Scalar<Constant = f64, Stored = Array<2>>>(self) -> Array<2> {
        let Self { a, pencil: Pencil { nodes, armature, .. }, x } = self;
        let mut twice = T::ZERO;
        for (node, a) in nodes.iter().zip(a) {
            let a = a.map(T::load);
            twice += a.dot(node.I.map(T::constant).times(a));
        }
        for (&armature, &x) in armature.iter().zip(x) {
            let x = T::load(x);
            twice = (T::constant(armature) * x).mul_add(x, twice);
        }
        twice.store()
    }
}

#[cfg(test)]
mod tests {
    use super::Factors;
    use crate::family::Family;
    use crate::scalar::{Array, Unit};
    use crate::spectrum::sturm::Pencil;

    /// Fused, as far as rounding goes: solutions, counts inside of the spectrum, and energy, which is that of the solution.
    #[test]
    fn units_agree() {
        let n = 40;
        let robot = Family::hydra(n, 1.5, 0.4, 1.0).unwrap().model::<f64>().unwrap();
        let q: Vec<f64> = (0..n).map(|d| (d as f64).sin()).collect();
        let pencil = Pencil::new(&robot, &q, vec![1.0; n]).unwrap();
        let b: Vec<Array<2>> = (0..n).map(|d| Array([1.0, (d as f64).cos()])).collect();
        let solved = |unit| {
            let mut factors = Factors::new(&pencil, unit);
            factors.factor(&pencil, Array([-1.0, -100.0]));
            let mut x = b.clone();
            factors.solve(&pencil, &mut x);
            let energy = factors.energy(&pencil, &x);
            factors.set_moving(&pencil, &x);
            let moved = factors.energy(&pencil, &x);
            factors.factor(&pencil, Array([10.0, 1000.0]));
            (x, energy, moved, factors.below)
        };
        let (plain, wide) = (solved(Unit::Plain), solved(Unit::Avx2));
        for k in 0..2 {
            let size = plain.0.iter().fold(0.0f64, |most, x| most.max(x.0[k].abs()));
            for (plain, wide) in plain.0.iter().zip(&wide.0) {
                assert!((plain.0[k] - wide.0[k]).abs() < 1e-12 * size, "{plain:?} {wide:?}");
            }
            for energy in [wide.1, wide.2, plain.2] {
                assert!((energy.0[k] / plain.1.0[k] - 1.0).abs() < 1e-11, "{energy:?} {plain:?}");
            }
        }
        assert_eq!(plain.3, wide.3);
        assert!(0.0 < plain.3.0[0] && plain.3.0[0] < plain.3.0[1] && plain.3.0[1] < n as f64, "{plain:?}");
    }
}
