//! Springs, dampers and feedback: `<joint>`, fixed tendons and actuators, as forces linear in q and v near rest.
//!
//! ```text
//! actuator   force = gain · u + b0 + b1 l + b2 l̇,   l̇ = gear · (joint's v, or Σ coef v)        k = −b1,  c = −b2
//! position   b1 = −kp, b2 = −kv;  velocity  b2 = −kv;  a positive b2 beside gain = −b1 is a damping ratio
//! springdamper (t, ζ)          k = m/(tζ)²,  c = 2m/t          m = 1/mean (H⁻¹)_dd at the file's own pose
//! damping ratio ζ              c = 2ζ √(k m)                   m = 1/aᵀH⁻¹a, a the moment arms
//! ```
//! Of polynomial springs and dampers the linear part counts. What saturates is taken as if it did not.

use super::attribute::{array, keyword, number, numbers, value_fault};
use super::coupling::{ACTUATORS, Sections};
use super::defaults::{MAIN, Styled};
use super::fault::Fault;
use crate::loaded::Stepping;
use crate::note::Note;
use crate::xml::{Element, Spot};
use eigenbody::factor::Ltl;
use eigenbody::model::JointSpec;
use eigenbody::stability::{Integrator, Spring, SpringSource};
use eigenbody::{Joint, Model, mass_matrix};
use std::collections::HashMap;

/// A joint's own spring and damper.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct JointSpring {
    pub stiffness: f64,
    pub damping: f64,
    /// Time constant and damping ratio, in place of the two.
    pub springdamper: Option<[f64; 2]>,
}

impl JointSpring {
    /// What a `<joint>` says.
    pub fn read(joint: &Styled<'_>) -> Result<Self, Fault> {
        let first = |name| -> Result<f64, Fault> {
            let found = numbers(joint.find(name), "joint", 1..=3)?;
            Ok(found.and_then(|all| all.first().copied()).unwrap_or(0.0))
        };
        let pair: Option<[f64; 2]> = array(joint.find("springdamper"), "joint")?;
        let springdamper = pair.filter(|pair| pair.iter().all(|&x| x > 0.0));
        Ok(Self { stiffness: first("stiffness")?, damping: first("damping")?, springdamper })
    }
}

/// How stiffness and damping are to be had.
#[derive(Debug, Clone, Copy)]
enum Rule {
    /// As they are.
    Given,
    /// From a time constant and a damping ratio.
    TimeConstant(f64, f64),
    /// Damping from a ratio.
    Ratio(f64),
}

/// Positions of joints, their DoFs, moment arms.
type Arms = Vec<(usize, usize, f64)>;

/// A spring on joints that are not built yet.
struct Found {
    name: String,
    source: SpringSource,
    arms: Arms,
    stiffness: f64,
    damping: f64,
    rule: Rule,
}

/// All springs of a file.
#[derive(Default)]
pub(super) struct Springs {
    found: Vec<Found>,
    pub notes: Vec<(Spot, Note)>,
}

impl Springs {
    /// Those of joints, each by its position among `joints`.
    pub fn of_joints(springs: &[(usize, JointSpring)], joints: &[JointSpec<f64>]) -> Self {
        let mut all = Self::default();
        for &(joint, JointSpring { stiffness, damping, springdamper }) in springs {
            let rule = springdamper.map_or(Rule::Given, |[time, ratio]| Rule::TimeConstant(time, ratio));
            if stiffness == 0.0 && damping == 0.0 && springdamper.is_none() {
                continue;
            }
            for dof in 0..joints[joint].kind.nv() {
                let (name, arms) = (joints[joint].name.clone(), vec![(joint, dof, 1.0)]);
                all.found.push(Found { name, source: SpringSource::Joint, arms, stiffness, damping, rule });
            }
        }
        all
    }

    /// Adds those of a document's tendons and actuators.
    pub fn add(&mut self, sections: &Sections<'_>, joints: &[JointSpec<f64>]) -> Result<(), Fault> {
        let mut tendons = HashMap::new();
        for element in sections.all("tendon") {
            let styled = sections.defaults.styled_as(element, MAIN, &["tendon"])?;
            let first = |name| -> Result<f64, Fault> {
                let found = numbers(styled.find(name), &element.tag, 1..=3)?;
                Ok(found.and_then(|all| all.first().copied()).unwrap_or(0.0))
            };
            let (stiffness, damping) = (first("stiffness")?, first("damping")?);
            let coefficients = sections.tendon(element)?.joints;
            let arms = coefficients.map(|all| all.into_iter().map(|(joint, c)| (joint, 0, c)).collect());
            if stiffness != 0.0 || damping != 0.0 {
                let name = element.get("name").unwrap_or("tendon").to_owned();
                self.push(
                    element,
                    name,
                    SpringSource::Tendon,
                    arms.clone(),
                    (stiffness, damping, Rule::Given),
                );
            }
            if let Some(name) = element.get("name") {
                tendons.insert(name, arms);
            }
        }
        for element in sections.all("actuator") {
            self.actuator(element, sections, joints, &tendons)?;
        }
        Ok(())
    }

    fn push(
        &mut self,
        element: &Element,
        name: String,
        source: SpringSource,
        arms: Option<Arms>,
        (stiffness, damping, rule): (f64, f64, Rule),
    ) {
        match arms {
            Some(arms) => self.found.push(Found { name, source, arms, stiffness, damping, rule }),
            None => self.notes.push((element.at, Note::SpringIgnored { element: element.described() })),
        }
    }

    fn actuator(
        &mut self,
        element: &Element,
        sections: &Sections<'_>,
        joints: &[JointSpec<f64>],
        tendons: &HashMap<&str, Option<Arms>>,
    ) -> Result<(), Fault> {
        let styled = sections.defaults.styled_as(element, MAIN, &ACTUATORS)?;
        let Feedback { gain, bias, known } = Feedback::read(&styled)?;
        let own = numbers(styled.find("damping"), &element.tag, 1..=3)?;
        let own = own.and_then(|all| all.first().copied()).unwrap_or(0.0);
        let (mut damping, mut rule) = (own - bias[2], Rule::Given);
        if bias[2] > 0.0 && gain == -bias[1] {
            (damping, rule) = (own, Rule::Ratio(bias[2]));
        }
        let stiffness = -bias[1];
        if !known {
            self.notes.push((element.at, Note::SpringIgnored { element: element.described() }));
            return Ok(());
        }
        if stiffness == 0.0 && damping == 0.0 {
            return Ok(());
        }
        let gear = numbers(styled.find("gear"), &element.tag, 1..=6)?.unwrap_or(vec![1.0]);
        let gear = |k: usize| gear.get(k).copied().unwrap_or(0.0);
        let name = element.get("name").unwrap_or(&element.tag).to_owned();
        let on = element.get("joint").or(element.get("jointinparent"));
        let found = sections.joints(on).to_vec();
        let values = (stiffness, damping, rule);
        for known in &found {
            let arm = |dof: usize, arm: f64| (known.joint, dof, arm);
            let arms: Vec<Arms> = match joints[known.joint].kind {
                Joint::Spherical if element.tag == "orientation" => {
                    (0..3).map(|dof| vec![arm(dof, 1.0)]).collect()
                }
                Joint::Spherical => vec![(0..3).map(|dof| arm(dof, gear(dof))).collect()],
                Joint::Floating => {
                    self.push(element, name.clone(), SpringSource::Actuator, None, values);
                    continue;
                }
                _ => vec![vec![arm(0, gear(0))]],
            };
            for arms in arms {
                self.push(element, name.clone(), SpringSource::Actuator, Some(arms), values);
            }
        }
        if found.is_empty() {
            let tendon = element.get("tendon").and_then(|name| tendons.get(name)).cloned().flatten();
            let arms = tendon.map(|all| all.into_iter().map(|(j, dof, c)| (j, dof, c * gear(0))).collect());
            self.push(element, name, SpringSource::Actuator, arms, values);
        }
        Ok(())
    }

    /// On the built model. `reference`: the pose of the file, for springs that are given by times and ratios.
    pub fn resolve(self, model: &Model<f64>, joints: &[JointSpec<f64>], reference: &[f64]) -> Vec<Spring> {
        let start: HashMap<&str, usize> =
            model.joints().iter().map(|joint| (joint.name(), joint.dofs().start)).collect();
        let relative = self.found.iter().any(|found| !matches!(found.rule, Rule::Given));
        let inverse = if relative { inverse(model, reference) } else { None };
        let mut springs = Vec::new();
        for Found { name, source, arms, mut stiffness, mut damping, rule } in self.found {
            let place = |&(joint, dof, arm): &(usize, usize, f64)| {
                start.get(joints[joint].name.as_str()).map(|&first| (first + dof, arm))
            };
            // A floating base has no springs of its own.
            let Some(placed) = arms.iter().map(place).collect::<Option<Vec<_>>>() else { continue };
            match (rule, &inverse) {
                (Rule::Given, _) => {}
                (Rule::TimeConstant(time, ratio), Some(inverse)) => {
                    let joint = &joints[arms[0].0];
                    let first = placed[0].0 - arms[0].1;
                    let nv = joint.kind.nv();
                    let mean = (first..first + nv).map(|d| inverse[d][d]).sum::<f64>() / nv as f64;
                    stiffness = 1.0 / (mean * (time * ratio).powi(2));
                    damping = 2.0 / (mean * time);
                }
                (Rule::Ratio(ratio), Some(inverse)) => {
                    let along = |&(d, a): &(usize, f64)| -> f64 {
                        placed.iter().map(|&(e, b)| a * b * inverse[d][e]).sum()
                    };
                    let mobility: f64 = placed.iter().map(along).sum();
                    damping += 2.0 * ratio * (stiffness / mobility).sqrt();
                }
                // Without an inverse there is no mass to speak of.
                (_, None) => continue,
            }
            springs.push(Spring { name, source, arms: placed, stiffness, damping });
        }
        springs
    }
}

/// H⁻¹ at the file's pose; none where H is singular.
fn inverse(model: &Model<f64>, reference: &[f64]) -> Option<Vec<Vec<f64>>> {
    let H = mass_matrix(model, reference).ok()?;
    let mut factor = Ltl::new(model.dofs());
    factor.factor(&H).ok()?;
    let column = |d: usize| {
        let mut x = vec![0.0; model.nv()];
        x[d] = 1.0;
        factor.solve(&mut x).ok()?;
        Some(x)
    };
    (0..model.nv()).map(column).collect()
}

/// gain and bias of an actuator, as its class and itself leave them.
struct Feedback {
    gain: f64,
    bias: [f64; 3],
    /// False for kinds whose feedback is not that of an affine bias.
    known: bool,
}

impl Feedback {
    /// Element by element, the outermost class first: each sets what its shorthand sets, as MuJoCo does. One kind of shorthand
    /// forgets what another one set; `general` forgets nothing.
    fn read(styled: &Styled<'_>) -> Result<Self, Fault> {
        let mut layers: Vec<&Element> = styled.layers().collect();
        layers.reverse();
        let (mut gain, mut bias, mut affine, mut known) = (1.0, [0.0; 3], false, true);
        let mut kind: Option<&str> = None;
        for element in layers {
            let tag = element.tag.as_str();
            let of = |name: &str| number(element.find(name), tag);
            known = true;
            if tag != "general" {
                if kind.is_some_and(|kind| kind != tag) {
                    (gain, bias) = (1.0, [0.0; 3]);
                }
                kind = Some(tag);
            }
            match tag {
                "general" => {
                    if let Some(prm) = numbers(element.find("gainprm"), tag, 1..=10)? {
                        gain = prm[0];
                    }
                    if let Some(prm) = numbers(element.find("biasprm"), tag, 1..=10)? {
                        prm.iter().take(3).enumerate().for_each(|(k, &b)| bias[k] = b);
                    }
                    // Other words are other kinds of bias.
                    if let Some(kind) = element.get("biastype") {
                        affine = kind == "affine";
                        known = matches!(kind, "affine" | "none");
                    }
                }
                "motor" => (gain, bias, affine) = (1.0, [0.0; 3], false),
                "position" | "intvelocity" | "orientation" | "pid" => {
                    gain = of("kp")?.unwrap_or(if tag == "pid" { 1.0 } else { gain });
                    bias[0] = 0.0;
                    bias[1] = -gain;
                    if let Some(kv) = of("kv")? {
                        bias[2] = -kv;
                    }
                    if let Some(ratio) = of("dampratio")? {
                        bias[2] = ratio;
                    }
                    affine = true;
                }
                "velocity" => {
                    gain = of("kv")?.unwrap_or(gain);
                    (bias, affine) = ([0.0, 0.0, -gain], true);
                }
                "cylinder" => {
                    if let Some(prm) = numbers(element.find("bias"), tag, 1..=3)? {
                        prm.iter().enumerate().for_each(|(k, &b)| bias[k] = b);
                    }
                    affine = true;
                }
                // Damping in proportion to a control that is zero at rest; forces without feedback.
                "damper" | "adhesion" => affine = false,
                _ => (affine, known) = (false, false),
            }
        }
        Ok(Self { gain, bias: if affine { bias } else { [0.0; 3] }, known })
    }
}

/// The step and integrator of `<option>`, and what its flags turn off.
pub(super) struct Options {
    pub stepping: Stepping,
    off: Vec<&'static str>,
}

/// Flags that touch springs.
const FLAGS: [&str; 5] = ["spring", "damper", "passive", "actuation", "eulerdamp"];

impl Options {
    pub fn read(root: &Element) -> Result<Self, Fault> {
        let mut stepping = Stepping::default();
        let mut off = Vec::new();
        for option in root.children_named("option") {
            if let Some(attribute) = option.find("timestep") {
                let step = number(Some(attribute), "option")?.filter(|&step| step > 0.0);
                let fault = || value_fault(attribute, "option", &attribute.value, "more than 0");
                stepping.step = step.ok_or_else(fault)?;
            }
            let words = ["Euler", "RK4", "implicit", "implicitfast"];
            match keyword(option.find("integrator"), "option", &words)? {
                Some(0) => stepping.integrator = Integrator::DampedEuler,
                Some(1) => stepping.integrator = Integrator::RungeKutta4,
                Some(_) => stepping.integrator = Integrator::ImplicitVelocity,
                None => {}
            }
            for flag in option.children_named("flag") {
                for name in FLAGS {
                    match keyword(flag.find(name), "flag", &["disable", "enable"])? {
                        Some(0) => off.push(name),
                        Some(_) => off.retain(|other| *other != name),
                        None => {}
                    }
                }
            }
        }
        if off.contains(&"eulerdamp") && stepping.integrator == Integrator::DampedEuler {
            stepping.integrator = Integrator::SemiImplicitEuler;
        }
        Ok(Self { stepping, off })
    }

    /// The springs that are left.
    pub fn applied(&self, springs: Vec<Spring>) -> Vec<Spring> {
        let off = |flag: &str| self.off.contains(&flag);
        let left = |mut spring: Spring| {
            if spring.source == SpringSource::Actuator {
                return (!off("actuation")).then_some(spring);
            }
            if off("spring") || off("passive") {
                spring.stiffness = 0.0;
            }
            if off("damper") || off("passive") {
                spring.damping = 0.0;
            }
            Some(spring)
        };
        springs.into_iter().filter_map(left).collect()
    }
}
