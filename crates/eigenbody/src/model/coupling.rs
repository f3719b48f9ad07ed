//! Mimic joints as a linear map of coordinates.

use super::body::JointInfo;
use super::builder::{JointId, MimicSpec};
use super::error::BuildError;
use super::finding::Finding;
use crate::matrix::Matrix;
use crate::scalar::Real;
use std::collections::HashMap;

/// One coordinate as multiplier · p[source] + offset.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Follow<T> {
    source: u32,
    multiplier: T,
    offset: T,
}

/// The map of mimic joints, from independent coordinates p to all coordinates q.
///
/// ```text
/// q = G p + g      v = G ṗ      H_reduced = Gᵀ H G
/// ```
/// Every row of G has one entry, so applying it costs O(nv²) for a matrix and O(nq) for a vector.
#[derive(Debug, Clone, PartialEq)]
pub struct Coupling<T> {
    coordinates: Vec<Follow<T>>,
    dofs: Vec<Follow<T>>,
    independent_coordinates: Vec<usize>,
    independent_dofs: Vec<usize>,
}

impl<T: Real> Coupling<T> {
    /// Number of independent coordinates.
    pub fn nq(&self) -> usize {
        self.independent_coordinates.len()
    }

    /// Number of independent degrees of freedom.
    pub fn nv(&self) -> usize {
        self.independent_dofs.len()
    }

    /// Number of all degrees of freedom.
    pub(crate) fn of(&self) -> usize {
        self.dofs.len()
    }

    /// The independent degrees of freedom among all, ascending.
    pub fn independent_dofs(&self) -> &[usize] {
        &self.independent_dofs
    }

    /// The independent coordinates among all, ascending.
    pub fn independent_coordinates(&self) -> &[usize] {
        &self.independent_coordinates
    }

    /// Coordinate k as (which of all coordinates it follows, multiplier, offset); an independent one follows itself.
    pub fn follows(&self, k: usize) -> (usize, T, T) {
        let Follow { source, multiplier, offset } = self.coordinates[k];
        (self.independent_coordinates[source as usize], multiplier, offset)
    }

    /// q = G p + g.
    pub fn expand(&self, p: &[T]) -> Vec<T> {
        self.coordinates.iter().map(|f| f.multiplier * p[f.source as usize] + f.offset).collect()
    }

    /// v = G ṗ.
    pub fn push_forward(&self, p: &[T]) -> Vec<T> {
        self.dofs.iter().map(|f| f.multiplier * p[f.source as usize]).collect()
    }

    /// [`push_forward`](Self::push_forward) into `v`, one number a DoF of the model; allocates nothing and checks nothing.
    pub fn push_forward_into(&self, p: &[T], v: &mut [T]) {
        for (v, f) in v.iter_mut().zip(&self.dofs) {
            *v = f.multiplier * p[f.source as usize];
        }
    }

    /// Rates of all joints: the independent ones as they stand in `v`, of all degrees of freedom, and the others following them.
    pub fn follow(&self, v: &[T]) -> Vec<T> {
        let free: Vec<T> = self.independent_dofs.iter().map(|&d| v[d]).collect();
        self.push_forward(&free)
    }

    /// Gᵀ f: forces or gradients on the independent DoFs.
    pub fn pull_back(&self, f: &[T]) -> Vec<T> {
        let mut reduced = vec![T::ZERO; self.nv()];
        self.pull_back_into(f, &mut reduced);
        reduced
    }

    /// [`pull_back`](Self::pull_back) into `reduced`, [`nv`](Self::nv) numbers; allocates nothing and checks nothing.
    pub fn pull_back_into(&self, f: &[T], reduced: &mut [T]) {
        reduced.fill(T::ZERO);
        for (follow, &f) in self.dofs.iter().zip(f) {
            reduced[follow.source as usize] += follow.multiplier * f;
        }
    }

    /// H_reduced = Gᵀ H G.
    pub fn reduce(&self, H: &Matrix<T>) -> Matrix<T> {
        let mut reduced = Matrix::zeros(self.nv(), self.nv());
        self.reduce_into(H, &mut reduced);
        reduced
    }

    /// [`reduce`](Self::reduce) into `reduced`; allocates nothing and checks nothing.
    pub fn reduce_into(&self, H: &Matrix<T>, reduced: &mut Matrix<T>) {
        reduced.fill(T::ZERO);
        for (d, a) in self.dofs.iter().enumerate() {
            for (e, b) in self.dofs.iter().enumerate() {
                let weight = a.multiplier * b.multiplier;
                reduced[(a.source as usize, b.source as usize)] += weight * H[(d, e)];
            }
        }
    }
}

/// The map of a model's mimic joints (id, what it follows, position among `joints`); none if all joints are independent.
pub(super) fn resolve<T: Real>(
    joints: &[JointInfo<T>],
    mimics: Vec<(JointId, MimicSpec<T>, usize)>,
    findings: &mut Vec<Finding>,
) -> Result<Option<Coupling<T>>, BuildError> {
    if mimics.is_empty() {
        return Ok(None);
    }
    let by_name: HashMap<&str, usize> = joints.iter().enumerate().map(|(j, info)| (info.name(), j)).collect();
    let mut leader: Vec<Option<(usize, T, T)>> = vec![None; joints.len()];
    let ids: HashMap<usize, JointId> = mimics.iter().map(|&(id, _, j)| (j, id)).collect();
    for (joint, mimic, j) in mimics {
        let of = by_name.get(mimic.joint.as_str()).copied();
        match (of, of.map_or(0, |of| joints[of].kind.nq())) {
            (Some(of), 1) => leader[j] = Some((of, mimic.multiplier, mimic.offset)),
            (_, coordinates) => findings.push(Finding::MimicUnknown {
                joint,
                name: joints[j].name.to_string(),
                follows: mimic.joint,
                coordinates,
            }),
        }
    }
    if leader.iter().all(Option::is_none) {
        return Ok(None);
    }

    let (mut q, mut v) = (0, 0);
    let mut own = Vec::with_capacity(joints.len());
    let (mut independent_coordinates, mut independent_dofs) = (Vec::new(), Vec::new());
    for (j, joint) in joints.iter().enumerate() {
        own.push((q, v));
        if leader[j].is_none() {
            independent_coordinates.extend(joint.coordinates());
            independent_dofs.extend(joint.dofs());
            (q, v) = (independent_coordinates.len() as u32, independent_dofs.len() as u32);
        }
    }

    let (mut coordinates, mut dofs) = (Vec::new(), Vec::new());
    for (j, joint) in joints.iter().enumerate() {
        // Chains of mimics compose: k₁(k₂ p + o₂) + o₁.
        let (mut top, mut multiplier, mut offset) = (j, T::ONE, T::ZERO);
        let mut steps = 0;
        while let Some((of, k, o)) = leader[top] {
            offset += multiplier * o;
            multiplier *= k;
            top = of;
            steps += 1;
            if steps > joints.len() {
                let name = joint.name.to_string();
                return Err(BuildError::MimicLoop { joint: ids[&j], name });
            }
        }
        let (q0, v0) = own[top];
        coordinates.extend((0..joint.kind.nq()).map(|k| Follow {
            source: q0 + k as u32,
            multiplier,
            offset,
        }));
        dofs.extend((0..joint.kind.nv()).map(|k| Follow { source: v0 + k as u32, multiplier, offset }));
    }
    Ok(Some(Coupling { coordinates, dofs, independent_coordinates, independent_dofs }))
}

impl Coupling<f64> {
    pub(super) fn cast<U: Real>(&self) -> Coupling<U> {
        let f = |x: &Follow<f64>| Follow {
            source: x.source,
            multiplier: U::from_f64(x.multiplier),
            offset: U::from_f64(x.offset),
        };
        Coupling {
            coordinates: self.coordinates.iter().map(f).collect(),
            dofs: self.dofs.iter().map(f).collect(),
            independent_coordinates: self.independent_coordinates.clone(),
            independent_dofs: self.independent_dofs.clone(),
        }
    }
}
