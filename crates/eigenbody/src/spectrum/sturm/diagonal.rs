//! The diagonal of H or H* in O(N): what the unit-diagonal metric and the bounds on the spectrum need.
//!
//! ```text
//! for i = N..1:   Ic_p += X_upᵀ Ic_i X_up              H_dd = S_dᵀ Ic_i S_d + armature_d
//! H*_dd = H_dd − F_dᵀ I₀⁻¹ F_d,   F_d = Ic_i S_d in the base's frame,  I₀ = Ic of the base
//! ```

use super::carry::Carry;
use super::pencil::Pencil;
use crate::scalar::Real;
use crate::spatial::{Force, RigidInertia, Transform};

/// The diagonal, with room for it.
#[derive(Debug, Clone)]
pub struct Diagonal<T> {
    /// N: composite inertias, and from the base to each body, where the base is removed.
    Ic: Vec<RigidInertia<T>>,
    from_base: Vec<Transform<T>>,
    waiting: Vec<RigidInertia<T>>,
    /// nv: H_dd or H*_dd.
    H: Vec<T>,
}

impl<T: Real> Diagonal<T> {
    /// Room for a pencil.
    pub fn new(pencil: &Pencil<'_, T>) -> Self {
        let n = if pencil.removed() > 0 { pencil.nodes.len() } else { 0 };
        let (Ic, from_base) = (vec![RigidInertia::ZERO; n], vec![Transform::IDENTITY; n]);
        Self { Ic, from_base, waiting: Vec::new(), H: vec![T::ZERO; pencil.S.len()] }
    }

    /// The diagonal of the pencil's matrix as it stands, one number a DoF; allocates nothing after the first time.
    pub fn update(&mut self, pencil: &Pencil<'_, T>) -> &[T] {
        let Pencil { nodes, S, armature, .. } = pencil;
        let Self { Ic, H, waiting, .. } = self;
        let mut carry = Carry::new(RigidInertia::ZERO, waiting);
        for (i, node) in nodes.iter().enumerate().rev() {
            let Ic_i = carry.collect(node, node.I);
            for d in node.dofs() {
                H[d] = S[d].dot(Ic_i.times(S[d])) + armature[d];
            }
            carry.hand_down(node.route, || node.X_up.transpose_rigid(Ic_i));
            if let Some(kept) = Ic.get_mut(i) {
                *kept = Ic_i;
            }
        }
        if pencil.removed() > 0 {
            self.remove_base(pencil);
        }
        &self.H
    }

    fn remove_base(&mut self, Pencil { nodes, S, .. }: &Pencil<'_, T>) {
        let Self { Ic, from_base, H, .. } = self;
        let base = Cholesky6::new(&Ic[0]);
        for (i, node) in nodes.iter().enumerate() {
            let Some(p) = node.parent() else { continue };
            let X = node.X_up * from_base[p];
            for d in node.dofs() {
                H[d] -= base.squared(X.transpose_force(Ic[i].times(S[d])));
            }
            from_base[i] = X;
        }
    }
}

/// L of I₀ = L Lᵀ.
struct Cholesky6<T>([[T; 6]; 6]);

impl<T: Real> Cholesky6<T> {
    fn new(I: &RigidInertia<T>) -> Self {
        use crate::spatial::{Motion, Vec3};
        let axes = [Vec3::X, Vec3::Y, Vec3::Z];
        let mut L = [[T::ZERO; 6]; 6];
        for (k, &axis) in axes.iter().enumerate() {
            L[k] = I.times(Motion::new(axis, Vec3::ZERO)).to_array();
            L[k + 3] = I.times(Motion::new(Vec3::ZERO, axis)).to_array();
        }
        for k in 0..6 {
            for j in 0..k {
                L[k][j] = (0..j).fold(L[k][j], |sum, m| sum - L[k][m] * L[j][m]) / L[j][j];
            }
            L[k][k] = (0..k).fold(L[k][k], |sum, m| sum - L[k][m] * L[k][m]).sqrt();
        }
        Self(L)
    }

    /// Fᵀ I₀⁻¹ F.
    fn squared(&self, F: Force<T>) -> T {
        let (L, mut y) = (&self.0, F.to_array());
        let mut sum = T::ZERO;
        for k in 0..6 {
            y[k] = (0..k).fold(y[k], |left, m| left - L[k][m] * y[m]) / L[k][k];
            sum += y[k] * y[k];
        }
        sum
    }
}
