//! How a robot is driven: what its file says, and what the command line says instead.

use super::option_gains;
use crate::args::{GainArgs, IntegratorArg};
use crate::failure::Failure;
use eigenbody::stability::Integrator;
use eigenbody_formats::Loaded;
use eigenbody_study::diagnosis::Drive;

/// Springs, step and integrator. Given gains stand in for those of the file's actuators; what joints and tendons have of their own
/// stays.
pub fn drive(args: &GainArgs, loaded: &Loaded) -> Result<Drive, Failure> {
    let mut drive = Drive::of(loaded);
    if let Some(text) = &args.kp {
        drive = drive.with_stiffness(&loaded.model, &option_gains("--kp", text, &loaded.model)?);
    }
    if let Some(text) = &args.kd {
        drive = drive.with_damping(&loaded.model, &option_gains("--kd", text, &loaded.model)?);
    }
    if let Some(step) = args.dt {
        drive.step = Some(super::positive("--dt", step)?);
    }
    if let Some(integrator) = args.integrator {
        drive.integrator = match integrator {
            IntegratorArg::SemiImplicit => Integrator::SemiImplicitEuler,
            IntegratorArg::Damped => Integrator::DampedEuler,
            IntegratorArg::Implicit => Integrator::ImplicitVelocity,
            IntegratorArg::Rk4 => Integrator::RungeKutta4,
        };
    }
    Ok(drive)
}
