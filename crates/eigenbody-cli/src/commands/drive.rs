//! How a robot is driven: what its file says, and what the command line says instead.

use crate::args::{GainArgs, IntegratorArg};
use crate::failure::Failure;
use eigenbody::stability::{Integrator, Spring, SpringSource};
use eigenbody_formats::{Loaded, gains};
use eigenbody_study::diagnosis::Drive;

/// Springs, step and integrator. Given gains stand in for those of the file's actuators; what joints and tendons have of their own
/// stays.
pub fn drive(args: &GainArgs, loaded: &Loaded) -> Result<Drive, Failure> {
    let Drive { mut springs, step: own_step, integrator: own } = Drive::from(loaded);
    if let Some(text) = &args.kp {
        replace(&mut springs, &gains(text, &loaded.model)?, loaded, |spring| &mut spring.stiffness);
    }
    if let Some(text) = &args.kd {
        replace(&mut springs, &gains(text, &loaded.model)?, loaded, |spring| &mut spring.damping);
    }
    let step = match args.dt {
        Some(step) => Some(super::positive("--dt", step)?),
        None => own_step,
    };
    let integrator = match args.integrator {
        None => own,
        Some(IntegratorArg::SemiImplicit) => Integrator::SemiImplicitEuler,
        Some(IntegratorArg::Damped) => Integrator::DampedEuler,
        Some(IntegratorArg::Implicit) => Integrator::ImplicitVelocity,
        Some(IntegratorArg::Rk4) => Integrator::RungeKutta4,
    };
    Ok(Drive { springs, step, integrator })
}

fn replace(
    springs: &mut Vec<Spring>,
    given: &[Option<f64>],
    loaded: &Loaded,
    part: impl Fn(&mut Spring) -> &mut f64,
) {
    for spring in springs.iter_mut().filter(|spring| spring.source == SpringSource::Actuator) {
        if spring.arms.iter().all(|&(d, _)| given[d].is_some()) {
            *part(spring) = 0.0;
        }
    }
    for (d, gain) in given.iter().enumerate().filter_map(|(d, gain)| Some((d, (*gain)?))) {
        let (name, arms) = (loaded.model.dof_name(d), vec![(d, 1.0)]);
        let mut spring = Spring { name, source: SpringSource::Actuator, arms, stiffness: 0.0, damping: 0.0 };
        *part(&mut spring) = gain;
        springs.push(spring);
    }
}
