//! Parametric robots and comparable configurations (Featherstone 2004, §3), and one real arm.

mod links;
mod posture;
mod puma560;

pub use posture::Posture;
pub use puma560::puma560;

use crate::joint::Joint;
use crate::model::{Base, BuildError, JointSpec, LinkId, MAX_BODIES, Model, ModelBuilder};
use crate::scalar::{Dd, Real, Scalar};
use crate::spatial::{Mat3, Transform, Vec3};
use thiserror::Error;

/// How the link of a family looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shape {
    Hydra,
    Onion,
    Rod,
    Auto,
}

/// A parametric family's member: which robot, not yet built.
///
/// ```text
/// P(i) = ⌊(i − 2 + ⌈B⌉)/B⌋      link i+1 = link i scaled: length ρ, mass ρ³, rotational inertia ρ⁵
/// ```
/// Gravity is 9.81 m/s² along −y: planar members lie in the x-y plane.
///
/// ```
/// use eigenbody::{Family, Model};
/// let robot: Model<f64> = Family::hydra(8, 1.0, 0.0, 1.0)?.model()?;
/// assert_eq!(robot.nv(), 8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Family {
    shape: Shape,
    n: usize,
    branching: f64,
    skew: f64,
    taper: Dd,
    mass: f64,
    length: f64,
    base: Base,
}

/// A parameter outside a family's range.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum FamilyError {
    /// No links, or too many.
    #[error("N = {}: the number of links is a whole number from 1 to {MAX_BODIES}", short(.0))]
    Links(f64),
    /// A branching factor below 1 gives links without a parent before them.
    #[error("B = {0}: the branching factor is a number of 1 or more")]
    Branching(f64),
    /// Not an angle.
    #[error("α = {0}: the skew is a finite angle in radians")]
    Skew(f64),
    /// A taper or a size ratio that is not positive.
    #[error("ρ = {0}: the taper is a positive number")]
    Taper(f64),
    /// A link without mass or length.
    #[error("{what} = {value}: expected a positive number")]
    Size {
        /// Parameter, with its unit.
        what: &'static str,
        /// Its value.
        value: f64,
    },
}

/// A number without three hundred digits.
fn short(x: &f64) -> String {
    format!("{x:?}").trim_end_matches(".0").to_owned()
}

impl Family {
    /// Spatial chains and trees of thin tubes; planar for α = 0.
    pub fn hydra(n: usize, branching: f64, skew: f64, taper: impl Into<Dd>) -> Result<Self, FamilyError> {
        Self::new(Shape::Hydra, n, branching, skew, taper.into())
    }

    /// Spherical robots: every axis through the origin; circular for α = 0.
    pub fn onion(n: usize, branching: f64, skew: f64, taper: impl Into<Dd>) -> Result<Self, FamilyError> {
        Self::new(Shape::Onion, n, branching, skew, taper.into())
    }

    /// A planar chain of n slender rods of `mass` (kg) and `length` (m) each (Shah & Saha 2013, §2).
    pub fn slender_chain(n: usize, mass: f64, length: f64) -> Result<Self, FamilyError> {
        for (what, value) in [("m (kg)", mass), ("l (m)", length)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(FamilyError::Size { what, value });
            }
        }
        Ok(Self { mass, length, ..Self::new(Shape::Rod, n, 1.0, 0.0, Dd::ONE)? })
    }

    /// Hydra's links on joints that run through every kind in turn: revolute, prismatic, helical, cylindrical, universal,
    /// planar, spherical, floating.
    pub fn auto_tree(n: usize, branching: f64, skew: f64, taper: impl Into<Dd>) -> Result<Self, FamilyError> {
        Self::new(Shape::Auto, n, branching, skew, taper.into())
    }

    fn new(shape: Shape, n: usize, branching: f64, skew: f64, taper: Dd) -> Result<Self, FamilyError> {
        if n == 0 || n > MAX_BODIES {
            return Err(FamilyError::Links(n as f64));
        }
        if !(branching >= 1.0 && branching.is_finite()) {
            return Err(FamilyError::Branching(branching));
        }
        if !skew.is_finite() {
            return Err(FamilyError::Skew(skew));
        }
        let base = Base::Fixed;
        let family = Self { shape, n, branching, skew, taper: Dd::ONE, mass: 1.0, length: 1.0, base };
        family.with_taper(taper)
    }

    fn with_taper(self, taper: Dd) -> Result<Self, FamilyError> {
        match taper > Dd::ZERO && taper.is_finite() {
            true => Ok(Self { taper, ..self }),
            false => Err(FamilyError::Taper(taper.hi())),
        }
    }

    /// The same robot with ρ = R^(1/(N−1)): the last link is R times the size of the first.
    pub fn with_size_ratio(self, ratio: impl Into<Dd>) -> Result<Self, FamilyError> {
        let n = self.n as u32;
        let family = self.with_taper(ratio.into())?;
        let taper = if n > 1 { family.taper.root(n - 1) } else { Dd::ONE };
        Ok(Self { taper, ..family })
    }

    /// The same robot without its first joint: link 1 is a floating base (Featherstone 2004, §4.6).
    #[must_use]
    pub fn floating(self) -> Self {
        Self { base: Base::Floating, ..self }
    }

    /// N: number of links.
    pub fn links(&self) -> usize {
        self.n
    }

    /// What carries link 1; floating is [`floating`](Self::floating)'s.
    pub fn base(&self) -> Base {
        self.base
    }

    /// Link that carries link i, both counted from 1; 0 is the base.
    ///
    /// ```
    /// let robot = eigenbody::Family::hydra(5, 2.0, 0.0, 1.0)?;
    /// assert_eq!([1, 2, 3, 4, 5].map(|i| robot.parent(i)), [0, 1, 1, 2, 2]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn parent(&self, i: usize) -> usize {
        (((i as f64) - 2.0 + self.branching.ceil()) / self.branching).floor() as usize
    }

    /// The robot. N bodies; N joints on a fixed base, N − 1 and the base's six DoFs on a floating one.
    ///
    /// Lengths, masses and inertias are computed in double-double and rounded once. Errors: [`BuildError`], if a taper drives
    /// a link's inertia out of the scalar's range.
    pub fn model<T: Real>(&self) -> Result<Model<T>, BuildError> {
        let mut robot = ModelBuilder::new(self.name());
        robot.gravity(Vec3::from_f64([0.0, -9.81, 0.0])).reserve(self.n + 1);
        let mut links: Vec<LinkId> = Vec::with_capacity(self.n + 1);
        let mut sizes = Vec::with_capacity(self.n + 1);
        let skew = Mat3::rotation_about(Vec3::X, T::from_f64(self.skew).sin_cos());
        let mut size = Dd::ONE;
        let mut inertia = self.inertia(size);
        for i in 1..=self.n {
            let link = robot.link(format!("link_{i}"), inertia);
            if i == 1 && self.base == Base::Fixed {
                let base = robot.link("base", crate::spatial::RigidInertia::ZERO);
                robot.joint(JointSpec::new("joint_1", self.joint(1), base, link).about(Vec3::Z));
            } else if i > 1 {
                let parent = self.parent(i) - 1;
                let placement = Transform::new(skew, Vec3::X * self.offset(sizes[parent]));
                let kind = self.joint(i);
                robot.joint(JointSpec::new(format!("joint_{i}"), kind, links[parent], link).at(placement));
            }
            links.push(link);
            sizes.push(size);
            if self.taper != Dd::ONE {
                size *= self.taper;
                inertia = self.inertia(size);
            }
        }
        robot.build(self.base)
    }

    /// Kind of joint i.
    fn joint<T: Real>(&self, i: usize) -> Joint<T> {
        if self.shape != Shape::Auto {
            return Joint::Revolute;
        }
        match (i - 1) % 8 {
            0 => Joint::Revolute,
            1 => Joint::Prismatic,
            2 => Joint::Helical { pitch: T::from_f64(0.1) },
            3 => Joint::Cylindrical,
            4 => Joint::Universal { first: Vec3::X },
            5 => Joint::Planar,
            6 => Joint::Spherical,
            _ => Joint::Floating,
        }
    }
}
