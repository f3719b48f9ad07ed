//! The position pass of the fast kernels: sines and cosines of all hinges at once, and where all other joints stand.

use crate::joint::Joint;
use crate::model::{COLUMNS, Mechanism, Member, MotionKind, Twist};
use crate::scalar::{Scalar, sin_cos_columns};
use crate::spatial::{Anywhere, Mat3, Motion, Placed, Rotation, Transform, Vec3};

/// A mechanism at q.
#[derive(Debug, Clone)]
pub(crate) struct Posture<T> {
    /// N, rounded up to whole columns: sine and cosine of each hinge's angle and offset.
    pub sin: Vec<T>,
    pub cos: Vec<T>,
    /// From the parent to the body, and columns of S by DoF: for joints that are neither hinge nor slide. Those of a free joint stay.
    pub X: Vec<Transform<T>>,
    pub S: Vec<Motion<T>>,
}

impl<T: Scalar> Posture<T> {
    pub fn new(mechanism: &Mechanism<T::Constant>) -> Self {
        let n = mechanism.members.len();
        let others = mechanism.members.iter().enumerate().filter(|(_, m)| m.motion == MotionKind::Other);
        let (bodies, dofs) = others
            .map(|(i, m)| (i + 1, m.v0 as usize + m.joint.nv()))
            .fold((0, 0), |(i, d), other| (i.max(other.0), d.max(other.1)));
        // Single numbers fill the columns of any scalar that they are stored for.
        let width = if size_of::<T>() == size_of::<T::Constant>() { COLUMNS } else { 1 };
        let zeros = vec![T::ZERO; n.next_multiple_of(width)];
        let mut S = vec![Motion::ZERO; dofs];
        for m in mechanism.members.iter().filter(|m| matches!(m.joint, Joint::Floating)) {
            for (S, column) in S[m.v0 as usize..].iter_mut().zip(m.joint.columns()) {
                *S = column.moved(Motion::ZERO, Motion::ZERO, T::ONE);
            }
        }
        Self { sin: zeros.clone(), cos: zeros, X: vec![Transform::IDENTITY; bodies], S }
    }

    #[inline(always)]
    pub fn update<S: Scalar<Stored = T>>(&mut self, mechanism: &Mechanism<S::Constant>, q: &[T]) {
        self.bend::<S, true>(mechanism, q);
    }

    /// All but where free bodies stand in the world, of which H knows nothing.
    #[inline(always)]
    pub fn update_shape<S: Scalar<Stored = T>>(&mut self, mechanism: &Mechanism<S::Constant>, q: &[T]) {
        self.bend::<S, false>(mechanism, q);
    }

    #[inline(always)]
    fn bend<S: Scalar<Stored = T>, const FREE: bool>(&mut self, mechanism: &Mechanism<S::Constant>, q: &[T]) {
        let Mechanism { angles, sin_offset, cos_offset, .. } = mechanism;
        let n = self.sin.len();
        let (s0, c0, angles) = (&sin_offset[..n], &cos_offset[..n], &angles[..n]);
        let (sin, cos) = (&mut self.sin[..n], &mut self.cos[..n]);
        let mut first = 0;
        while first + S::COLUMNS <= n {
            let block = first..first + S::COLUMNS;
            let mut of_block = [T::ZERO; COLUMNS];
            for (angle, &place) in of_block.iter_mut().zip(&angles[block.clone()]) {
                *angle = q[place as usize];
            }
            let (s, c) = sin_cos_columns::<S>(S::load_columns(&of_block));
            let (s0, c0) = (S::constant_columns(&s0[block.clone()]), S::constant_columns(&c0[block.clone()]));
            S::store_columns(s.mul_add(c0, c * s0), &mut sin[block.clone()]);
            S::store_columns(c.mul_add(c0, -(s * s0)), &mut cos[block]);
            first += S::COLUMNS;
        }
        for i in 0..self.X.len() {
            let m = &mechanism.members[i];
            if m.motion == MotionKind::Other && (FREE || !m.is_free_root()) {
                self.place::<S>(i, m, q);
            }
        }
    }

    #[inline(always)]
    fn place<S: Scalar<Stored = T>>(&mut self, i: usize, m: &Member<S::Constant>, q: &[T]) {
        let (mut numbers, mut columns) = ([S::ZERO; 7], [Motion::<S>::ZERO; 6]);
        let (nq, nv) = (m.joint.nq(), m.joint.nv());
        for (number, &q) in numbers.iter_mut().zip(&q[m.q0 as usize..][..nq]) {
            *number = S::load(q);
        }
        let joint = m.joint.map(S::constant);
        let X_J = joint.kinematics(&numbers[..nq], &mut columns[..nv]);
        let (C, r) = (m.C.map(S::constant), m.r.map(S::constant));
        let X = match m.twist {
            Twist::Straight => Transform::new(X_J.E, X_J.r + r),
            _ => X_J * Transform::new(C, r),
        };
        self.X[i] = X.map(S::store);
        if matches!(m.joint, Joint::Floating) {
            return;
        }
        for (S, column) in self.S[m.v0 as usize..][..nv].iter_mut().zip(columns) {
            *S = column.map(S::store);
        }
    }

    /// Sine and cosine of hinge i.
    #[inline(always)]
    pub fn turn<S: Scalar<Stored = T>>(&self, i: usize) -> (S, S) {
        (S::load(self.sin[i]), S::load(self.cos[i]))
    }

    /// From the parent to body i, on a joint that is neither hinge nor slide.
    #[inline(always)]
    pub fn placed<S: Scalar<Stored = T>>(&self, i: usize) -> Placed<S, Mat3<S>> {
        let X = self.X[i].map(S::load);
        Placed { E: X.E, r: X.r }
    }
}

/// From the parent to a body on a slide, which stands q along z.
#[inline(always)]
pub(crate) fn slide<S: Scalar, R: Rotation<S>>(
    m: &Member<S::Constant>,
    C: R,
    q: &[S::Stored],
) -> Placed<S, Anywhere<R>> {
    let z = m.C.z.map(S::constant);
    Placed { E: Anywhere(C), r: z.mul_add(S::load(q[m.q0 as usize]), position::<S>(m)) }
}

#[inline(always)]
pub(crate) fn position<S: Scalar>(m: &Member<S::Constant>) -> Vec3<S> {
    m.r.map(S::constant)
}
