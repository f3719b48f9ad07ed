//! Every number and every statement about a curve that the two papers print.
//!
//! F: Featherstone (2004). S: Shah & Saha (2013).

use super::{Claim, Kind};

impl Claim {
    const EMPTY: Self = Self {
        id: "",
        what: "",
        kind: Kind::Exact,
        printed: &[],
        exact: &[],
        tolerance: (0.0, 0.0),
        exact_tolerance: 1e-9,
        note: "",
    };

    pub(super) const fn shape(id: &'static str, what: &'static str) -> Self {
        Self { id, what, kind: Kind::Shape, ..Self::EMPTY }
    }
}

/// All claims, in the order of the papers.
#[rustfmt::skip]
pub static CLAIMS: [Claim; 36] = [
    Claim {
        id: "F-eq1-tau",
        what: "τ = H·(1, .., 1) of hydra(8,1,0,1) at zag(π/2), at rest, without gravity (N m)",
        printed: &[302.0450, 250.2104, 200.54125, 151.0375, 105.699167, 64.52625, 31.51875, 8.6767],
        tolerance: (5e-5, 0.0),
        note: "the paper prints entries 1, 2 and 8",
        ..Claim::EMPTY
    },
    Claim {
        id: "F-eq1-qdd",
        what: "accelerations for τ rounded to three figures: up to 50% off (rad/s²)",
        printed: &[0.7917, 1.0281, 1.4904, 0.6886, 1.1026, 1.0911, 0.5626, 1.2384],
        tolerance: (5e-5, 0.0),
        ..Claim::EMPTY
    },
    Claim {
        id: "F-eq1-kappa",
        what: "κ is about 1500 there; other configurations exceed 10,000",
        kind: Kind::Rounded,
        printed: &[1500.0],
        exact: &[1514.643493110704],
        tolerance: (0.0, 0.02),
        ..Claim::EMPTY
    },
    Claim::shape("F-fig2", "P(i) = ⌊(i − 2 + ⌈B⌉)/B⌋: B = 2 gives [0, 1, 1, 2, 2, ..], B = 1.5 alternates one and two children"),
    Claim::shape("F-fig6", "κ of hydra(N,1,0,1) in zag(θ): slopes 4 and 2 only; transition at N = sec(θ/2), 14 for θ = 3.0; worst case about 4 N⁴"),
    Claim {
        id: "F-fig6-values",
        what: "κ = 44 at N = 2, 306 at N = 3, over 40,000 at N = 10, as high as 10⁷ at N = 40",
        kind: Kind::Rounded,
        printed: &[44.0, 306.0, 40_000.0, 1e7],
        exact: &[43.886461117396, 306.059931290818, 42907.97274937, 10230462.98289487],
        tolerance: (0.0, 0.075),
        ..Claim::EMPTY
    },
    Claim::shape("F-fig7", "in curl(θ): slope 4 until the arc nears a semicircle, first minimum of the slope just past a full circle N = 2π/θ, damped undulation, then slope 2"),
    Claim::shape("F-fig8", "hydra(N,1,0.5,1) in zag(θ): lower than planar by a factor of up to 2.5 on N⁴ curves, marginally on the N² curve; same asymptotes"),
    Claim::shape("F-fig9", "hydra(N,1,0,ρ): in double precision the curves for ρ = 0.7 end near a size ratio of 600:1, those for ρ = 0.99 at 28:1 in curl(0) and 280:1 in curl(π/2)"),
    Claim {
        id: "F-fig10",
        what: "κ(R=0.1)/κ(R=1) at N = 390: 227.5 in curl(0), 1587 in curl(π/2); κ(R=0.1)/κ(R=0.2): 8.15 and 15.62",
        kind: Kind::RoundOff,
        printed: &[227.5, 1587.0, 8.15, 15.62],
        exact: &[227.873901185077, 1587.10609685648, 8.16599870642824, 15.6198155581102],
        tolerance: (0.0, 2.5e-3),
        note: "the two ratios in curl(0) carry the round-off of a dense computation at κ of 2·10¹³",
        ..Claim::EMPTY
    },
    Claim {
        id: "F-fig11",
        what: "λmin of hydra(N,1,0,1) converges to 0.021 at zag(0) and is largest, 0.164, at zag(2.45) (kg m²); 5% of the eigenvalues lie above √(λmin λmax) at N = 200",
        kind: Kind::Rounded,
        printed: &[0.021, 0.164, 0.05],
        exact: &[0.02114603916771028, 0.164392851835818, 0.05],
        tolerance: (5e-4, 0.0),
        ..Claim::EMPTY
    },
    Claim::shape("F-fig12", "i-th largest eigenvalue against normalised period 1/i: parallel, nearly straight lines of slope about 4"),
    Claim::shape("F-fig13", "hydra(50,1,0,ρ) at curl(2.2): a staircase at R = 1, smoother with taper; λmin falls as R⁵, λmax slightly faster than H₁₁"),
    Claim::shape("F-fig14", "largest eigenvectors of hydra(20,1,0,1) and hydra(10,1,0,1) at zag(0) have one sign, their sum grows as √N; the second and third are like harmonics"),
    Claim::shape("F-fig15", "in 0.2 times the largest eigenvector N = 20 bends more than N = 10"),
    Claim::shape("F-asymptotic", "κ = O(N H₁₁/H_NN) for unbranched chains"),
    Claim::shape("F-fig16", "onion(N,B,0,1): slope 2 for B = 1, towards 1 for B > 1, lowest at B = 2, B = 3 and 4 close to it; onion(N,B,1,1): lower, lowest at B = 3"),
    Claim::shape("F-fig17", "largest eigenvectors of onion(33,B,0,1), B = 1 and 1.125: branch points at links 8, 16, 24; coordinates weighted by the number of links carried"),
    Claim::shape("F-fig18", "free-floating hydra(N+1,1,0,1) against fixed hydra(N,1,0,1) in zag(θ): lower by about 4 on N² slopes, 40 on N⁴ slopes, transition at about 3 times the N"),
    Claim {
        id: "F-fig18-extreme",
        what: "free-floating hydra(3,1,0,10) at zag(π/2): κ = 10⁵; fixed hydra(2,1,0,10): 136",
        kind: Kind::Rounded,
        printed: &[1e5, 136.0],
        exact: &[100222.262767586, 135.8111046598],
        tolerance: (0.5, 2.3e-3),
        ..Claim::EMPTY
    },
    Claim::shape("F-fig19", "in 0.2 times the largest eigenvector the free-floating robot bends symmetrically about a still centre of mass; less mass moves than in the fixed one"),
    Claim::shape("F-fig20", "κ′ and κ of hydra(N,1,0,1) in zag(θ) are nearly the same: κ′ slightly lower at small N, slightly higher at large N"),
    Claim::shape("F-fig21", "hydra(N,1,0,ρ) at curl(0): κ grows exponentially for ρ < 1, κ′ converges to a limit that depends on ρ"),
    Claim {
        id: "F-Hprime-1",
        what: "H′ of hydra(5,1,0,1) at curl(0)",
        printed: &[
            1.0, 0.984, 0.929, 0.822, 0.625,
            0.984, 1.0, 0.974, 0.884, 0.687,
            0.929, 0.974, 1.0, 0.952, 0.769,
            0.822, 0.884, 0.952, 1.0, 0.883,
            0.625, 0.687, 0.769, 0.883, 1.0,
        ],
        tolerance: (5e-4, 0.0),
        ..Claim::EMPTY
    },
    Claim {
        id: "F-Hprime-half",
        what: "H′ of hydra(5,1,0,0.5) at curl(0)",
        printed: &[
            1.0, 0.594, 0.252, 0.097, 0.034,
            0.594, 1.0, 0.593, 0.251, 0.092,
            0.252, 0.593, 1.0, 0.590, 0.238,
            0.097, 0.251, 0.590, 1.0, 0.559,
            0.034, 0.092, 0.238, 0.559, 1.0,
        ],
        tolerance: (5e-4, 0.0),
        ..Claim::EMPTY
    },
    Claim::shape("F-erratum", "§3 says that hydra becomes planar for α = 1; §4 and every figure mean α = 0"),
    Claim {
        id: "S-eq7",
        what: "inertia matrix of four slender rods of 1 m in line (kg m²)",
        kind: Kind::Rounded,
        printed: &[
            47.0822, 29.7942, 14.7132, 4.0462,
            29.7942, 19.8629, 10.2993, 2.9427,
            14.7132, 10.2993, 5.8854, 1.8392,
            4.0462, 2.9427, 1.8392, 0.7357,
        ],
        tolerance: (1.3e-4, 0.0),
        note: "the text rounds the mass to 2.2 kg; the entries need 2.20698 kg (8 m/3 = 5.8854 asks for 2.20703, the others for 2.20698)",
        ..Claim::EMPTY
    },
    Claim {
        id: "S-eq7-phi",
        what: "φ of the chain at rest at q = 0 (N m)",
        printed: &[-86.6015, -48.7133, -21.6504, -5.4126],
        tolerance: (1e-3, 0.0),
        note: "needs g/2 normal to the chain: 30° from the vertical, g = 9.81 m/s²",
        ..Claim::EMPTY
    },
    Claim {
        id: "S-eq8",
        what: "accelerations I⁻¹φ (rad/s²)",
        kind: Kind::Rounded,
        printed: &[-6.2189, 7.8864, -2.1226, 0.6071],
        tolerance: (0.0, 2e-3),
        note: "the printed numbers are those of entries rounded to four decimals",
        ..Claim::EMPTY
    },
    Claim {
        id: "S-eq9",
        what: "accelerations for φ rounded to [−86.0, −48.7, −21.6, −5.4]: 7%, 14%, 42% and 55% off (rad/s²)",
        kind: Kind::Rounded,
        printed: &[-5.7477, 6.7586, -1.2128, 0.2696],
        tolerance: (0.0, 5e-3),
        note: "the printed numbers are those of entries rounded to four decimals",
        ..Claim::EMPTY
    },
    Claim {
        id: "S-kappa",
        what: "κ = 1074 for that chain; worst case about 4 n⁴",
        printed: &[1074.0],
        exact: &[1074.4395314378532],
        tolerance: (0.5, 0.0),
        ..Claim::EMPTY
    },
    Claim::shape("S-eq11", "I_ij = p_iᵀ M̃_i A_ij p_j with M̃_i = M_i + A_jiᵀ M̃_j A_ji is the inertia matrix"),
    Claim::shape("S-fig2", "four links swinging from rest: I₁₁ follows the largest eigenvalue, I₁₁/I₄₄ follows κ"),
    Claim::shape("S-fig3", "the same for 10 and 20 links; the worst κ is of the order 4 n⁴"),
    Claim::shape("S-fig4", "the pivot ratio of Gaussian elimination does not follow κ for 10 and 20 links"),
    Claim::shape("S-fig5", "the scaled diagonal ratio δ_s = δ·κ(0)/δ(0) follows κ in trend and size for 4, 10 and 20 links"),
];
