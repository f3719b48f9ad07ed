//! `eigenbody` alone: a report on a built-in robot, and what to try next.

use crate::failure::Failure;
use crate::output::deliver;
use eigenbody::{Conditioning, Error, Metric, Model, Question, conditioning_at, family};
use eigenbody_report::{SpectrumReport, Subject, significant};

/// The arm stretched out and lifted a little, elbow and wrist bent: an everyday configuration.
const Q: [f64; 6] = [0.0, -0.5, 0.3, 0.0, 0.8, 0.0];

/// Prints the report on the PUMA 560.
pub fn run() -> Result<(), Failure> {
    let arm = family::puma560::<f64>()?;
    let page = page(&arm).map_err(|source| Failure::Numbers { model: "puma560".into(), source })?;
    deliver(None, |out| out.write_all(page.as_bytes()))
}

fn page(arm: &Model<f64>) -> Result<String, Error> {
    let result = judge(arm)?;
    let subject = Subject {
        model: "puma560".into(),
        bodies: arm.bodies().len(),
        base: "fixed".into(),
        configuration: format!("q = {Q:?}"),
        q: Q.to_vec(),
    };
    let names: Vec<String> = (0..arm.nv()).map(|d| arm.dof_name(d)).collect();
    let report = SpectrumReport::new(subject, &Metric::Euclidean, "kg m²", &result, names);

    let bare = arm.clone().with_armature(vec![0.0; arm.nv()])?;
    let without = judge(&bare)?;
    let kappa =
        |c: &Conditioning<f64>| c.kappa.map_or_else(|| "unresolved".into(), |kappa| significant(kappa, 4));
    Ok(format!(
        "{}\n  With its motors at the joints (0.18 to 4.7 kg m² each) κ = {}, without them {}.\n  {}\n\n{NEXT}",
        report.to_text(),
        kappa(&result),
        kappa(&without),
        "Printed for a PUMA 600 along trajectories: 1275 to 1399 (Angeles & Ma 1988, in Featherstone 2004).",
    ))
}

fn judge(arm: &Model<f64>) -> Result<Conditioning<f64>, Error> {
    conditioning_at(arm, &Q, &Question::default())
}

const NEXT: &str = "\
Try next:
  eigenbody check your_robot.urdf                          your own robot, over all that its joints allow
  eigenbody spectrum your_robot.urdf --at 'random(1)'      the same in one configuration
  eigenbody spectrum 'hydra(10,1,0,1)' --at 'zag(0)'       ten links in line: κ near 4 N⁴
  eigenbody matrix puma560 --at 'joint_2=-0.5'             the matrix itself
  eigenbody spectrum --help                                everything it takes
";
