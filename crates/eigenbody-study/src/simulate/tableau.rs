//! Coefficients of explicit Runge-Kutta methods.

/// An explicit method: its stages, its weights, its interpolant, and the weights of its error estimate if it has one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tableau {
    /// What the method is called.
    pub name: &'static str,
    /// Rows 2, 3, .. of the strictly lower triangular matrix a.
    pub a: &'static [&'static [f64]],
    /// Weights b.
    pub b: &'static [f64],
    /// b − b̂, b̂ the weights of the companion of lower order.
    pub error: Option<&'static [f64]>,
    /// Weights within the step, s from 0 to 1: b_i(s) is a polynomial in s without constant term; row i holds the coefficients of s, s², s³, s⁴.
    pub dense: &'static [[f64; 4]],
    /// Order of the method.
    pub order: u32,
}

impl Tableau {
    /// c_s = Σ a_sj: when, within the step, stage s is taken.
    pub fn node(&self, stage: usize) -> f64 {
        if stage == 0 { 0.0 } else { self.a[stage - 1].iter().sum() }
    }

    /// b_i(s).
    pub fn weight(&self, stage: usize, s: f64) -> f64 {
        self.dense[stage].iter().rev().fold(0.0, |sum, c| (sum + c) * s)
    }

    /// The last stage stands where the next step begins.
    pub fn is_first_same_as_last(&self) -> bool {
        self.a.last().is_some_and(|row| row.iter().eq(&self.b[..row.len()]))
    }
}

/// The classical method of order 4 (Kutta 1901); its interpolant has order 3.
pub const RK4: Tableau = Tableau {
    name: "Runge-Kutta 4",
    a: &[&[0.5], &[0.0, 0.5], &[0.0, 0.0, 1.0]],
    b: &[1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
    error: None,
    dense: &[
        [1.0, -3.0 / 2.0, 2.0 / 3.0, 0.0],
        [0.0, 1.0, -2.0 / 3.0, 0.0],
        [0.0, 1.0, -2.0 / 3.0, 0.0],
        [0.0, -1.0 / 2.0, 2.0 / 3.0, 0.0],
    ],
    order: 4,
};

/// Order 5 with a companion of order 4 (Dormand & Prince 1980) and an interpolant of order 4 (Shampine 1986).
pub const DORMAND_PRINCE: Tableau = Tableau {
    name: "Dormand-Prince 5(4)",
    a: &[
        &[1.0 / 5.0],
        &[3.0 / 40.0, 9.0 / 40.0],
        &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
        &[19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0],
        &[9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0],
        &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
    ],
    b: &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0, 0.0],
    error: Some(&[
        71.0 / 57600.0,
        0.0,
        -71.0 / 16695.0,
        71.0 / 1920.0,
        -17253.0 / 339200.0,
        22.0 / 525.0,
        -1.0 / 40.0,
    ]),
    dense: &[
        [1.0, -8048581381.0 / 2820520608.0, 8663915743.0 / 2820520608.0, -12715105075.0 / 11282082432.0],
        [0.0; 4],
        [0.0, 131558114200.0 / 32700410799.0, -68118460800.0 / 10900136933.0, 87487479700.0 / 32700410799.0],
        [0.0, -1754552775.0 / 470086768.0, 14199869525.0 / 1410260304.0, -10690763975.0 / 1880347072.0],
        [
            0.0,
            127303824393.0 / 49829197408.0,
            -318862633887.0 / 49829197408.0,
            701980252875.0 / 199316789632.0,
        ],
        [0.0, -282668133.0 / 205662961.0, 2019193451.0 / 616988883.0, -1453857185.0 / 822651844.0],
        [0.0, 40617522.0 / 29380423.0, -110615467.0 / 29380423.0, 69997945.0 / 29380423.0],
    ],
    order: 5,
};
