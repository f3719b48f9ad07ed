//! What to change, and a copy of the model with it.

use super::convert::Written;
use super::positive;
use crate::args::{CheckArgs, RemedyArg};
use crate::failure::Failure;
use crate::output::{deliver, say};
use eigenbody::search::Effort;
use eigenbody::stability::Integrator;
use eigenbody::{Model, Reduction};
use eigenbody_formats::{Format, Loaded, patched, write_mjcf, write_urdf_with_rotors};
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
        write(loaded, &mended, path, args)?;
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

/// The model's own file with the changes in it, or, in another format, a bare copy of the model.
fn write(loaded: &Loaded, mended: &Model<f64>, path: &Path, args: &CheckArgs) -> Result<(), Failure> {
    let model = || args.model.model.clone();
    let written = |source| Failure::Write { model: model(), source };
    let format = Written::of("--write-patch", path)?;
    let own = matches!(
        (loaded.format, format),
        (Some(Format::Urdf), Written::Urdf) | (Some(Format::Mjcf), Written::Mjcf)
    );
    let text = match format {
        _ if own => patched(loaded, mended).map_err(|source| Failure::Patch { model: model(), source })?,
        Written::Urdf => write_urdf_with_rotors(mended).map_err(written)?,
        Written::Mjcf => write_mjcf(mended).map_err(written)?,
    };
    deliver(Some(path), |out| out.write_all(text.as_bytes()))?;
    let rotors = match own {
        true => mended.armature() != loaded.model.armature(),
        false => mended.armature().iter().any(|&a| a > 0.0),
    };
    if format == Written::Urdf && rotors {
        say("note: URDF has no armature: it is written as rotors of transmissions, which --rotors on adds");
    }
    if own && elsewhere(Path::new(args.model.model.trim()), path) {
        say("note: files that it names are looked for beside it, in another folder than before");
    }
    Ok(())
}

/// Whether two files are in different folders.
fn elsewhere(one: &Path, other: &Path) -> bool {
    let folder = |file: &Path| std::fs::canonicalize(file).ok()?.parent().map(Path::to_owned);
    folder(one) != folder(other)
}
