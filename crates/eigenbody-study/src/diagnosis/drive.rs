//! How a robot is driven and stepped: what its file says, or what is said instead.

use eigenbody::Model;
use eigenbody::stability::{Integrator, Spring, SpringSource};
use eigenbody_formats::Loaded;

/// How a robot is driven and simulated.
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    /// Springs, dampers and feedback.
    pub springs: Vec<Spring>,
    /// The step of simulation or control (s), if it is known.
    pub step: Option<f64>,
    /// How a step is made.
    pub integrator: Integrator,
}

impl Default for Drive {
    fn default() -> Self {
        Self { springs: Vec::new(), step: None, integrator: Integrator::SemiImplicitEuler }
    }
}

impl Drive {
    /// As a robot's own file drives and steps it.
    pub fn of(loaded: &Loaded) -> Self {
        let springs = loaded.springs.clone();
        match loaded.stepping {
            Some(own) => Self { springs, step: Some(own.step), integrator: own.integrator },
            None => Self { springs, ..Self::default() },
        }
    }

    /// The same with other stiffness on the degrees of freedom for which one is given, in place of that of actuators; what joints and
    /// tendons have of their own stays.
    pub fn with_stiffness(self, model: &Model<f64>, given: &[Option<f64>]) -> Self {
        self.with_gains(model, given, |spring| &mut spring.stiffness)
    }

    /// The same for damping.
    pub fn with_damping(self, model: &Model<f64>, given: &[Option<f64>]) -> Self {
        self.with_gains(model, given, |spring| &mut spring.damping)
    }

    fn with_gains(
        mut self,
        model: &Model<f64>,
        given: &[Option<f64>],
        part: impl Fn(&mut Spring) -> &mut f64,
    ) -> Self {
        for spring in self.springs.iter_mut().filter(|spring| spring.source == SpringSource::Actuator) {
            if spring.arms.iter().all(|&(d, _)| given[d].is_some()) {
                *part(spring) = 0.0;
            }
        }
        for (d, gain) in given.iter().enumerate().filter_map(|(d, gain)| Some((d, (*gain)?))) {
            let (name, arms, source) = (model.dof_name(d), vec![(d, 1.0)], SpringSource::Actuator);
            let mut spring = Spring { name, source, arms, stiffness: 0.0, damping: 0.0 };
            *part(&mut spring) = gain;
            self.springs.push(spring);
        }
        self
    }
}
