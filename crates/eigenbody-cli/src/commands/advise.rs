//! What to change, and a copy of the model with it.

use super::positive;
use crate::args::{CheckArgs, RemedyArg};
use crate::failure::Failure;
use crate::output::{deliver, say};
use eigenbody::search::Effort;
use eigenbody::stability::Integrator;
use eigenbody::{Model, Reduction};
use eigenbody_formats::{Loaded, write_mjcf, write_urdf_with_rotors};
use eigenbody_study::StudyError;
use eigenbody_study::diagnosis::{Change, Drive, Goal, Remedies, Wish, remedies};
use std::path::Path;

/// The goal of the command line, what fulfils it, and a model with that where one is asked for.
pub fn advise(
    args: &CheckArgs,
    loaded: &Loaded,
    reduction: Reduction,
    effort: Effort,
    drive: &Drive,
) -> Result<Option<(Goal, Remedies)>, Failure> {
    let Some(goal) = goal(args, drive)? else { return Ok(None) };
    let name = &args.model.model;
    let wish = Wish { reduction, goal, effort, springs: &drive.springs };
    let failed = |error: StudyError| Failure::Usage(format!("{name}: {error}"));
    let found = remedies(&loaded.model, &wish).map_err(failed)?;
    if found.is_empty() {
        return Err(Failure::Usage(format!("{name}: nothing was found that does what is wanted")));
    }
    if let Some(path) = &args.write_patch {
        let mended = mended(&loaded.model, &found, args)?;
        write(&mended, path, name)?;
    }
    Ok(Some((goal, found)))
}

fn goal(args: &CheckArgs, drive: &Drive) -> Result<Option<Goal>, Failure> {
    Ok(match (args.want_kappa, args.want_lambda_min, args.want_step) {
        (Some(kappa), ..) => Some(Goal::Kappa(positive("--want-kappa", kappa)?)),
        (_, Some(least), _) => Some(Goal::LambdaMin(positive("--want-lambda-min", least)?)),
        (.., Some(step)) => {
            let step = positive("--want-step", step)?;
            if drive.springs.is_empty() {
                let problem = "--want-step: the file has no stiffness, damping or gains; give --kp and --kd";
                return Err(Failure::Usage(problem.into()));
            }
            match drive.integrator {
                Integrator::RungeKutta4 => {
                    let problem = "--want-step is for methods of Euler's kind; choose one with --integrator";
                    return Err(Failure::Usage(problem.into()));
                }
                integrator => Some(Goal::Step(step, integrator)),
            }
        }
        _ if args.write_patch.is_some() => {
            let problem = "--write-patch: say what is wanted, --want-kappa, --want-lambda-min or --want-step";
            return Err(Failure::Usage(problem.into()));
        }
        _ => None,
    })
}

fn mended(model: &Model<f64>, found: &Remedies, args: &CheckArgs) -> Result<Model<f64>, Failure> {
    let name = &args.model.model;
    let (change, what) = match args.remedy {
        RemedyArg::Armature => (Change::Armature, "armature"),
        RemedyArg::Link => (Change::Link, "link"),
        RemedyArg::Limit => (Change::Limit, "limit"),
    };
    let mended = found.mend(model, change);
    mended
        .map_err(|source| Failure::Numbers { model: name.clone(), source: source.into() })?
        .ok_or_else(|| Failure::Usage(format!("{name}: no {what} was found that does what is wanted")))
}

fn write(model: &Model<f64>, path: &Path, name: &str) -> Result<(), Failure> {
    let is_urdf = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("urdf"));
    let text = if is_urdf { write_urdf_with_rotors(model) } else { write_mjcf(model) };
    let text = text.map_err(|source| Failure::Write { model: name.to_owned(), source })?;
    deliver(Some(path), |out| out.write_all(text.as_bytes()))?;
    if is_urdf && model.armature().iter().any(|&a| a > 0.0) {
        say("note: URDF has no armature: it is written as rotors of transmissions, which --rotors on adds");
    }
    Ok(())
}
