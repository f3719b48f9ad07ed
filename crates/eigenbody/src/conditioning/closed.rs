//! The verdict on a robot with closed loops: among the motions that its loops allow.
//!
//! ```text
//! A(q) v = 0      v = N y, Nᵀ B N = 1      H_c = Nᵀ H N
//! λ: the stationary values of xᵀHx / xᵀBx over all x with A x = 0
//! ```
//! So κ depends on the metric B as it does for a tree, and not on the choice of N.

use super::{Conditioning, Question, conditioning, ratio};
use crate::dynamics::{BASE, Closure, Reduction, closure_jacobian, closure_residual, closure_sizes};
use crate::error::{Error, InputError};
use crate::matrix::Matrix;
use crate::model::{Model, Random};
use crate::spectrum::{Metric, NullSpace, eigen, null_space};

/// Rows of A shorter than this against the longest, outside the rows before them, count as dependent.
pub const RANK_TOLERANCE: f64 = 1e-9;
/// How far a closed loop may be open (m, rad), anchors within a metre of the world's origin.
const CLOSED: f64 = 1e-11;
/// Steps after which closing is given up.
const MAX_STEPS: usize = 100;
/// Steps after which the loops must be half as open.
const PATIENCE: usize = 8;
/// How far a configuration is moved aside where they are not (rad, m).
const KICK: f64 = 0.1;
/// Longest step of closing (rad, m).
const STRIDE: f64 = 0.5;

/// A configuration in which loops are closed.
#[derive(Debug, Clone, PartialEq)]
pub struct ClosedAt {
    /// All coordinates.
    pub q: Vec<f64>,
    /// max |φ| in the configuration that was given (m, rad).
    pub before: f64,
    /// max |φ| here.
    pub after: f64,
    /// Gauss–Newton steps between the two.
    pub steps: usize,
}

/// A mass matrix among the motions that loops allow.
#[derive(Debug, Clone, PartialEq)]
pub struct Allowed {
    /// n × k: B-orthonormal columns over the DoFs of the reduction.
    pub basis: Matrix<f64>,
    /// k × k: Nᵀ H N.
    pub H: Matrix<f64>,
    /// Number of independent rows of A.
    pub rank: usize,
}

/// The closed configuration near q: Gauss–Newton on φ(q) = 0, each step the shortest that closes φ to first order.
///
/// Mimic joints of the reduction keep following. A closed q is returned as it is.
///
/// Method: v = −Aᵀ (A Aᵀ)⁺ φ, at most half a radian or metre a step; q ← q ⊕ v. Where eight steps do not halve φ, a small step aside
/// (pseudo-random, always the same): links in line can close to second order only. Cost O(rows³) a step.
///
/// Errors: [`InputError`] if q does not fit the model; [`Error::Open`] if φ does not go below 1e-11, times the
/// anchors' distance from the world's origin where that is more than a metre.
///
/// ```
/// use eigenbody::dynamics::{Anchor, Closure, Tie};
/// use eigenbody::spatial::{Transform, Vec3};
/// use eigenbody::{Family, Reduction, conditioning::close_loops};
/// let arm = Family::hydra(3, 1.0, 0.0, 1.0)?.model::<f64>()?;
/// let tip = Anchor { link: Some(3), pose: Transform::translation(Vec3::X) };
/// let there = Anchor { link: None, pose: Transform::translation(Vec3::new(2.0, 0.0, 0.0)) };
/// let tied = Closure { name: "tip".into(), tie: Tie::Ball, anchors: [there, tip] };
/// let closed = close_loops(&arm, &[0.3, 0.5, 0.2], &[tied], Reduction::default())?;
/// assert!(closed.before > 0.5 && closed.after < 1e-11);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn close_loops(
    model: &Model<f64>,
    q: &[f64],
    closures: &[Closure],
    reduction: Reduction,
) -> Result<ClosedAt, Error> {
    let coupling = model.coupling().filter(|_| reduction.mimic);
    let mut q = q.to_vec();
    let mut residual = closure_residual(model, &q, closures)?;
    let before = largest(&residual);
    let (mut steps, mut lately) = (0, before);
    while !is_closed(&residual, &closure_sizes(model, &q, closures)?) {
        if steps == MAX_STEPS {
            let after = largest(&residual);
            return Err(Error::Open { closure: worst(closures, &residual), before, after, steps });
        }
        let A = coupled(&closure_jacobian(model, &q, closures)?, model, reduction);
        let mut v = shortest(&A, &residual)?;
        if steps % PATIENCE == PATIENCE - 1 {
            if largest(&residual) > 0.5 * lately {
                // A configuration from which the loops close to second order only, such as links in line: aside, always the same way.
                let mut random = Random::new(steps as u64);
                v.iter_mut().for_each(|v| *v += random.between(-KICK, KICK));
            }
            lately = largest(&residual);
        }
        let longest = largest(&v);
        let scale = if longest > STRIDE { STRIDE / longest } else { 1.0 };
        let step: Vec<f64> = v.iter().map(|v| -scale * v).collect();
        let step = coupling.map_or(step.clone(), |coupling| coupling.push_forward(&step));
        q = model.integrate(&q, &step)?;
        residual = closure_residual(model, &q, closures)?;
        steps += 1;
    }
    Ok(ClosedAt { q, before, after: largest(&residual), steps })
}

/// H among the motions that loops allow at a closed q.
///
/// | name | shape | unit |
/// |------|-------|------|
/// | `q` | `nq`, closed | rad, m, unit quaternion |
/// | `metric` | the metric in which N is orthonormal | – |
///
/// Method: null space of A B^-½ by Householder reflections with pivoting, [`RANK_TOLERANCE`]. O(n³); allocates.
///
/// Errors: as [`Reduction::mass_matrix`](Reduction::mass_matrix) and [`Metric::weights`];
/// [`InputError::LoopHoldsBase`] if the base is removed and a loop ties it to the world.
pub fn allowed_motions(
    model: &Model<f64>,
    q: &[f64],
    closures: &[Closure],
    reduction: Reduction,
    metric: &Metric<f64>,
) -> Result<Allowed, Error> {
    let H = reduction.mass_matrix(model, q)?;
    let A = rows(model, q, closures, reduction)?;
    let dofs = reduction.dofs(model);
    let weights = metric.weights_of(&H, |row| model.is_translation(dofs[row]))?;
    Ok(among(&H, &A, &weights)?)
}

/// κ, κ′ and modes of a robot among the motions that its loops allow, at a closed q; modes over the DoFs of the reduction.
///
/// κ′ is taken with every DoF in units of its own inertia in the tree. r and the bracket are those of a matrix over joints, which
/// Nᵀ H N is not: they are `None`.
///
/// Method: dense; see [`allowed_motions`], [`conditioning`]. Errors: the same.
pub fn conditioning_closed(
    model: &Model<f64>,
    q: &[f64],
    closures: &[Closure],
    question: &Question,
) -> Result<(Conditioning<f64>, Allowed), Error> {
    let Question { metric, reduction, .. } = question;
    let H = reduction.mass_matrix(model, q)?;
    let A = rows(model, q, closures, *reduction)?;
    let dofs = reduction.dofs(model);
    let weights = metric.weights_of(&H, |row| model.is_translation(dofs[row]))?;
    let allowed = among(&H, &A, &weights)?;
    let one = |n: usize| vec![1.0; n];
    let within = conditioning(&allowed.H, &one(allowed.H.rows()))?;
    let diagonal: Vec<f64> = (0..H.rows()).map(|d| H[(d, d)]).collect();
    let mut notes: Vec<String> =
        within.notes.into_iter().filter(|note| !note.contains("κ′") && !note.contains("λ′")).collect();
    let kappa_weighted = if diagonal.iter().all(|&h| h > 0.0) {
        let own = among(&H, &A, &diagonal)?;
        let own = conditioning(&own.H, &one(own.H.rows()))?;
        notes.extend(
            own.notes
                .into_iter()
                .filter(|note| note.starts_with("λmin"))
                .map(|n| n.replacen("λmin", "λ′min", 1)),
        );
        ratio(own.lambda_max, own.lambda_min)
    } else {
        notes.push("a DoF has no inertia: κ′ does not exist".into());
        None
    };
    let lift = |y: Vec<f64>| lifted(&allowed.basis, &y, &weights);
    let result = Conditioning {
        kappa_weighted,
        diagonal_ratio: None,
        bracket: None,
        softest: within.softest.map(lift),
        stiffest: within.stiffest.map(lift),
        eigenvalues: within.eigenvalues.filter(|_| question.all),
        weights,
        notes,
        ..within
    };
    Ok((result, allowed))
}

/// A over the DoFs of the reduction.
fn rows(
    model: &Model<f64>,
    q: &[f64],
    closures: &[Closure],
    reduction: Reduction,
) -> Result<Matrix<f64>, Error> {
    let A = coupled(&closure_jacobian(model, q, closures)?, model, reduction);
    if !(reduction.base && model.has_floating_base()) {
        return Ok(A);
    }
    if (0..A.rows()).any(|i| A.row(i)[..BASE].iter().any(|&a| a != 0.0)) {
        return Err(InputError::LoopHoldsBase.into());
    }
    Ok(Matrix::from_fn(A.rows(), A.cols() - BASE, |i, j| A[(i, j + BASE)]))
}

/// A G: over the independent DoFs where mimic joints follow.
fn coupled(A: &Matrix<f64>, model: &Model<f64>, reduction: Reduction) -> Matrix<f64> {
    match model.coupling().filter(|_| reduction.mimic) {
        None => A.clone(),
        Some(coupling) => {
            let reduced: Vec<Vec<f64>> = (0..A.rows()).map(|i| coupling.pull_back(A.row(i))).collect();
            Matrix::from_fn(A.rows(), coupling.nv(), |i, j| reduced[i][j])
        }
    }
}

fn among(H: &Matrix<f64>, A: &Matrix<f64>, weights: &[f64]) -> Result<Allowed, InputError> {
    let units: Vec<f64> = weights.iter().map(|b| 1.0 / b.sqrt()).collect();
    let scaled = Matrix::from_fn(A.rows(), A.cols(), |i, j| A[(i, j)] * units[j]);
    let NullSpace { basis, rank } = null_space(&scaled, RANK_TOLERANCE)?;
    let (n, k) = (basis.rows(), basis.cols());
    let basis = Matrix::from_fn(n, k, |i, j| units[i] * basis[(i, j)]);
    let HN = Matrix::<f64>::from_fn(n, k, |i, j| (0..n).map(|l| H[(i, l)] * basis[(l, j)]).sum());
    let mut reduced = Matrix::zeros(k, k);
    for i in 0..k {
        for j in 0..=i {
            let entry = (0..n).map(|l| basis[(l, i)] * HN[(l, j)]).sum();
            (reduced[(i, j)], reduced[(j, i)]) = (entry, entry);
        }
    }
    Ok(Allowed { basis, H: reduced, rank })
}

/// N y with its largest part, weighed by B, positive.
fn lifted(N: &Matrix<f64>, y: &[f64], weights: &[f64]) -> Vec<f64> {
    let x = N.times(y);
    let part = |d: usize| weights[d] * x[d] * x[d];
    let most = (0..x.len()).max_by(|&a, &b| part(a).total_cmp(&part(b)));
    let sign = if most.is_some_and(|d| x[d] < 0.0) { -1.0 } else { 1.0 };
    x.iter().map(|x| sign * x).collect()
}

/// The shortest v with A v = b, in the least-squares sense.
fn shortest(A: &Matrix<f64>, b: &[f64]) -> Result<Vec<f64>, Error> {
    let m = A.rows();
    let AAt = Matrix::<f64>::from_fn(m, m, |i, j| A.row(i).iter().zip(A.row(j)).map(|(a, b)| a * b).sum());
    let pairs = eigen(&AAt, &vec![1.0; m])?;
    let cut = pairs.values.last().copied().unwrap_or(0.0) * 1e-12;
    let mut v = vec![0.0; A.cols()];
    for (k, &lambda) in pairs.values.iter().enumerate().filter(|(_, lambda)| **lambda > cut) {
        let u = pairs.vectors.row(k);
        let part = u.iter().zip(b).map(|(u, b)| u * b).sum::<f64>() / lambda;
        for (i, u) in u.iter().enumerate() {
            v.iter_mut().zip(A.row(i)).for_each(|(v, a)| *v += part * u * a);
        }
    }
    Ok(v)
}

/// True if what is left of φ is rounding.
fn is_closed(residual: &[f64], sizes: &[f64]) -> bool {
    residual.iter().zip(sizes).all(|(open, size)| open.abs() <= CLOSED * size)
}

fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |m, x| f64::max(m, x.abs()))
}

/// The closure that is open the farthest.
fn worst(closures: &[Closure], residual: &[f64]) -> String {
    let (mut row, mut found) = (0, (0.0, ""));
    for closure in closures {
        let own = largest(&residual[row..row + closure.rows()]);
        if own >= found.0 {
            found = (own, &closure.name);
        }
        row += closure.rows();
    }
    found.1.to_owned()
}
