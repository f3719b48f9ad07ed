//! The diagonal of H or H* in O(N): what the unit-diagonal metric and the bounds on the spectrum need.
//!
//! ```text
//! for i = N..1:   Ic_p += X_upᵀ Ic_i X_up              H_dd = S_dᵀ Ic_i S_d + armature_d
//! H*_dd = H_dd − F_dᵀ I₀⁻¹ F_d,   F_d = Ic_i S_d in the base's frame,  I₀ = Ic of the base
//! ```

use super::pencil::Pencil;
use crate::scalar::Real;
use crate::spatial::{Force, RigidInertia, Transform};

pub(super) fn diagonal<T: Real>(pencil: &Pencil<T>) -> Vec<T> {
    let Pencil { nodes, S, B, armature, .. } = pencil;
    let mut Ic: Vec<RigidInertia<T>> = nodes.iter().map(|node| node.I).collect();
    for (i, node) in nodes.iter().enumerate().rev() {
        if let Some(p) = node.parent() {
            let carried = node.X_up.transpose_rigid(Ic[i]);
            Ic[p] += carried;
        }
    }
    let mut H = vec![T::ZERO; S.len()];
    for (node, Ic) in nodes.iter().zip(&Ic) {
        for d in node.dofs() {
            H[d] = S[d].dot(Ic.times(S[d])) + armature[d];
        }
    }
    let has_free_base = nodes.first().is_some_and(|base| base.dofs().all(|d| B[d] == T::ZERO));
    if has_free_base {
        remove_base(pencil, &Ic, &mut H);
    }
    H
}

fn remove_base<T: Real>(Pencil { nodes, S, .. }: &Pencil<T>, Ic: &[RigidInertia<T>], H: &mut [T]) {
    let base = Cholesky6::new(&Ic[0]);
    let mut from_base: Vec<Transform<T>> = Vec::with_capacity(nodes.len());
    for (i, node) in nodes.iter().enumerate() {
        let X = node.parent().map_or(Transform::IDENTITY, |p| node.X_up * from_base[p]);
        if i > 0 {
            for d in node.dofs() {
                H[d] -= base.squared(X.transpose_force(Ic[i].times(S[d])));
            }
        }
        from_base.push(X);
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
