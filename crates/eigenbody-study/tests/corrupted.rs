//! A reproduction that cannot fail proves nothing: robots that are a little wrong are found out.

use eigenbody::dynamics::link_pose;
use eigenbody::model::{JointSpec, LinkId};
use eigenbody::spatial::RigidInertia;
use eigenbody::{BuildError, Family, Joint, Model, ModelBuilder};
use eigenbody_study::{Lab, Robots, Verdict, select};

/// Every family's robots on fixed bases, the rotational inertia of each link times a factor.
struct Scaled(f64);

impl Robots for Scaled {
    fn model(&self, family: &Family) -> Result<Model<f64>, BuildError> {
        let right: Model<f64> = family.model()?;
        if right.has_floating_base() {
            return Ok(right);
        }
        let mut robot = ModelBuilder::new(right.name());
        robot.gravity(right.gravity());
        let base = robot.link("base", RigidInertia::ZERO);
        let neutral = right.neutral();
        let pose = |link: usize| link_pose(&right, &neutral, link).unwrap();
        let mut links: Vec<LinkId> = Vec::new();
        for (i, body) in right.bodies().iter().enumerate() {
            let mut inertia = *body.inertia();
            // About the joint, com and mass unchanged: that of the com is off by more.
            inertia.I = inertia.I.map(|entry| entry * self.0);
            let link = robot.link(format!("link_{i}"), inertia);
            let (parent, placement) = match body.parent() {
                Some(p) => (links[p], pose(body.link()) * pose(right.bodies()[p].link()).inverse()),
                None => (base, pose(body.link())),
            };
            robot.joint(JointSpec::new(format!("joint_{i}"), Joint::Revolute, parent, link).at(placement));
            links.push(link);
        }
        robot.build(eigenbody::Base::Fixed)
    }
}

fn failing(robots: &dyn Robots, ids: &[&str]) -> Vec<&'static str> {
    let lab = Lab { robots, quick: true };
    let readings =
        select(ids).unwrap().into_iter().flat_map(|experiment| experiment.run(&lab).unwrap().readings);
    readings.filter(|reading| reading.verdict == Verdict::Fails).map(|reading| reading.claim.id).collect()
}

const TRIED: [&str; 6] = ["F-eq1", "F-fig6", "F-fig11", "F-fig16", "F-Hprime", "S-eq7"];

/// The same builder with the factor 1 is right: what fails below fails for the inertia alone.
#[test]
fn rebuilt_robots_pass() {
    assert_eq!(failing(&Scaled(1.0), &TRIED), [""; 0]);
}

#[test]
fn an_inertia_off_by_one_percent_makes_claims_fail() {
    let failed = failing(&Scaled(1.01), &TRIED);
    let expected = [
        "F-eq1-tau",
        "F-eq1-qdd",
        "F-eq1-kappa",
        "F-fig6-values",
        "F-fig11",
        "F-Hprime-1",
        "F-Hprime-half",
        "S-eq7",
        "S-eq8",
        "S-eq9",
        "S-kappa",
    ];
    assert_eq!(failed, expected);
}
