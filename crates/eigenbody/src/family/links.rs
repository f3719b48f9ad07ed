//! What one link of a family weighs and how long it is.

use super::{Family, Shape};
use crate::scalar::{Dd, Real, Scalar};
use crate::spatial::{RigidInertia, Sym3, Vec3};

impl Family {
    /// Inertia of the link of a size, 1 for link 1. Geometric scaling at constant density: length s, mass s³, inertia s⁵.
    pub(super) fn inertia<T: Real>(&self, size: Dd) -> RigidInertia<T> {
        let number = Dd::from_f64;
        let (s3, s5) = (size.powi(3), size.powi(5));
        let (m, c, I) = match self.shape {
            // A thin-walled tube on x from 0 to 1 m, radius 0.05 m: m r², m (r²/2 + l²/12) = 1.015/12.
            Shape::Hydra | Shape::Auto => {
                let across = number(1.015) / number(12.0);
                (s3, size * number(0.5), [number(0.0025) * s5, across * s5, across * s5])
            }
            Shape::Onion => (s3, Dd::ZERO, [s5; 3]),
            Shape::Rod => {
                let (m, l) = (number(self.mass), number(self.length));
                let across = m * l * l / number(12.0);
                (m, l * number(0.5), [Dd::ZERO, across, across])
            }
        };
        // Moved to the joint in double-double, rounded once.
        let [xx, yy, zz] = I;
        let inertia = RigidInertia::from_com(m, Vec3::new(c, Dd::ZERO, Dd::ZERO), Sym3::diagonal(xx, yy, zz));
        inertia.map(T::from_dd)
    }

    /// Distance along x from a link's own axis to its children's.
    pub(super) fn offset<T: Real>(&self, size: Dd) -> T {
        match self.shape {
            Shape::Hydra | Shape::Auto => T::from_dd(size),
            Shape::Onion => T::ZERO,
            Shape::Rod => T::from_f64(self.length),
        }
    }

    /// `hydra(8, 1, 0, 1)`: the expression that names the robot.
    pub fn name(&self) -> String {
        let Self { n, branching, skew, mass, length, .. } = self;
        let taper = self.taper.hi();
        match self.shape {
            Shape::Hydra => format!("hydra({n}, {branching}, {skew}, {taper})"),
            Shape::Onion => format!("onion({n}, {branching}, {skew}, {taper})"),
            Shape::Auto => format!("auto_tree({n}, {branching}, {skew}, {taper})"),
            Shape::Rod => format!("chain({n}, m={mass}, l={length})"),
        }
    }
}
