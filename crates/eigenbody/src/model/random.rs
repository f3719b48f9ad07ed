//! Random numbers that never change: the stream is part of the interface.

/// SplitMix64 (Steele, Lea, Flood 2014): the n-th number is a hash of seed + n·γ, so any of them can be had at once.
///
/// ```
/// use eigenbody::model::Random;
/// let (mut a, mut b) = (Random::new(7), Random::new(7));
/// assert_eq!(a.uniform(), b.uniform());
/// ```
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    /// The stream of a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1), 53 bits.
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (-53f64).exp2()
    }

    /// Uniform in [lower, upper).
    pub fn between(&mut self, lower: f64, upper: f64) -> f64 {
        lower + (upper - lower) * self.uniform()
    }

    /// A rotation uniform over all rotations, as a unit quaternion w, x, y, z (Shoemake 1992).
    pub fn quaternion(&mut self) -> [f64; 4] {
        use std::f64::consts::TAU;
        let u = self.uniform();
        let (s1, c1) = (TAU * self.uniform()).sin_cos();
        let (s2, c2) = (TAU * self.uniform()).sin_cos();
        let (a, b) = ((1.0 - u).sqrt(), u.sqrt());
        [b * c2, a * s1, a * c1, b * s2]
    }
}
