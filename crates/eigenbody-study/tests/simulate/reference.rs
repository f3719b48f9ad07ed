//! A double pendulum against its textbook equations, integrated apart from everything else in double-double.

use super::chain;
use eigenbody::scalar::{Dd, Real, Scalar};
use eigenbody_study::simulate::{DORMAND_PRINCE, Method, Schedule, Steps, simulate};

const GRAVITY: f64 = 9.81;

/// Two slender rods of equal mass and 1 m, absolute angles a from the horizontal (Δ = a₂ − a₁):
/// 4/3 ä₁ + ½ cos Δ ä₂ = ½ sin Δ ȧ₂² − 3/2 g cos a₁        ½ cos Δ ä₁ + 1/3 ä₂ = −½ sin Δ ȧ₁² − ½ g cos a₂
fn rate([a1, a2, w1, w2]: [Dd; 4]) -> [Dd; 4] {
    let c = Dd::from_f64;
    let (half, g) = (c(0.5), c(GRAVITY));
    let (s, k) = (a2 - a1).sin_cos();
    let (m11, m12, m22) = (c(4.0) / c(3.0), half * k, c(1.0) / c(3.0));
    let f1 = half * s * w2 * w2 - c(1.5) * g * a1.sin_cos().1;
    let f2 = -(half * s * w1 * w1) - half * g * a2.sin_cos().1;
    let det = m11 * m22 - m12 * m12;
    [w1, w2, (m22 * f1 - m12 * f2) / det, (m11 * f2 - m12 * f1) / det]
}

/// Runge-Kutta 4 in steps of 2⁻¹⁴ s: errs by 1e-14, by halving.
fn reference(mut y: [Dd; 4], span_s: f64) -> [Dd; 4] {
    let steps = (span_s * 16384.0) as usize;
    let h = Dd::from_f64(1.0 / 16384.0);
    let go = |y: [Dd; 4], k: [Dd; 4], by: Dd| [0, 1, 2, 3].map(|i| y[i] + by * k[i]);
    let (half, third, sixth) = (h * Dd::from_f64(0.5), h / Dd::from_f64(3.0), h / Dd::from_f64(6.0));
    for _ in 0..steps {
        let k1 = rate(y);
        let k2 = rate(go(y, k1, half));
        let k3 = rate(go(y, k2, half));
        let k4 = rate(go(y, k3, h));
        y = go(go(go(go(y, k1, sixth), k2, third), k3, third), k4, sixth);
    }
    y
}

#[test]
fn a_double_pendulum_is_where_its_equations_say() {
    let model = chain(2);
    let start = [0.3, 0.8];
    let mut y = [start[0], start[0] + start[1], 0.0, 0.0].map(Dd::from_f64);
    let schedule = Schedule {
        method: Method::RungeKutta(DORMAND_PRINCE),
        steps: Steps::Adaptive(1e-13),
        span_s: 2.0,
        intervals: 8,
    };
    let motion = simulate(&model, &start, &[0.0; 2], &schedule).unwrap();
    for state in &motion[1..] {
        y = reference(y, 0.25);
        let [a1, a2, w1, w2] = y.map(Real::to_f64);
        let expected = [a1, a2 - a1, w1, w2 - w1];
        let found = [state.q[0], state.q[1], state.v[0], state.v[1]];
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-9, "t = {}: {found} is not {expected}", state.t);
        }
    }
}
