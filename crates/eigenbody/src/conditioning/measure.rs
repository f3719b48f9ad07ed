//! What is measured in a configuration, and which way is worse.

/// What makes a configuration bad.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Measure {
    /// κ: gains, explicit time steps, gradients.
    Kappa,
    /// κ′: the accuracy of solves.
    KappaWeighted,
    /// λmin: the least inertia of any motion.
    LambdaMin,
}

impl Measure {
    /// All measures.
    pub const ALL: [Self; 3] = [Self::Kappa, Self::KappaWeighted, Self::LambdaMin];
}

/// The measures of one configuration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Values {
    /// Smallest eigenvalue in the metric of the study; zero if it cannot be told from zero.
    pub lambda_min: f64,
    /// Largest eigenvalue.
    pub lambda_max: f64,
    /// κ′; infinite if its smallest eigenvalue cannot be told from zero.
    pub kappa_weighted: f64,
}

impl Values {
    /// κ; infinite for a singular matrix.
    pub fn kappa(&self) -> f64 {
        self.lambda_max / self.lambda_min
    }

    /// The measure's value.
    pub fn of(&self, measure: Measure) -> f64 {
        match measure {
            Measure::Kappa => self.kappa(),
            Measure::KappaWeighted => self.kappa_weighted,
            Measure::LambdaMin => self.lambda_min,
        }
    }

    /// What a search makes small: 1/κ, 1/κ′ or λmin. Smooth where the matrix becomes singular, and zero there.
    pub fn cost(&self, measure: Measure) -> f64 {
        match measure {
            Measure::Kappa => self.lambda_min / self.lambda_max,
            Measure::KappaWeighted => 1.0 / self.kappa_weighted,
            Measure::LambdaMin => self.lambda_min,
        }
    }
}
