//! Frames of bodies, turned and shifted so that what is constant between one and the next is simple.
//!
//! ```text
//! E_tree = Rz(γ) Rx(α) Rz(β)                z-x-z Euler angles
//! E = Rz(q) E_tree = Rz(q + γ) Rx(α)        once the frame of the body that carries it is turned by β about its axis
//! r' = r + λ z                              z the body's axis, along which its origin may be shifted by any λ
//! ```
//! A body on a hinge may be turned about its axis at will: it is turned by the β of the largest subtree that it carries
//! (Denavit and Hartenberg's choice of x). What is left is Rx(α), and α is often nothing or a quarter turn. Its origin may stand anywhere
//! on the axis: it stands where one coordinate of r' is zero. H, τ and v̇ do not depend on any of this. Nothing is rounded to a quarter
//! turn that is not one to the last digits.

use super::body::Body;
use super::mechanism::MotionKind;
use crate::joint::Joint;
use crate::scalar::Real;
use crate::spatial::{Mat3, Offset, PseudoInertia, Transform, Vec3, Zero};

/// A turn this many ε from a round one is a round one.
const ROUND: f64 = 4.0;
/// Sine of a steep twist: the origin is shifted by no more than twice what it is away from the carrier's.
const STEEP: f64 = 0.5;
/// Along parallel axes shifts add up: no further than so many times what a body and its carrier are long.
const FAR: f64 = 2.0;
/// Nor so far that Σ m z² is as many times the moment of inertia about the axis, unless it was.
const THIN: f64 = 256.0;

/// What is known of C and r.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Twist {
    /// C = 1; of a hinge, r_z = 0.
    Straight,
    /// A quarter turn about x, and r_y = 0.
    Quarter,
    /// The other quarter turn about x, and r_y = 0.
    ThreeQuarters,
    /// A quarter turn about z, then one about x, and r_x = 0.
    Corner,
    /// A quarter turn about z, then the other one about x, and r_x = 0.
    OtherCorner,
    /// Rx(α), and r_y = 0.
    Steep,
    /// Rx(α), and r_z = 0.
    Flat,
    Any,
}

/// Runs `$step` with `$C` the constant rotation of `$member`, its type as narrow as is known; over two scalars, if asked.
macro_rules! with_twist {
    ($member:expr, $($C:ident: $S:ty),+ => $step:expr) => {{
        use $crate::model::Twist;
        use $crate::spatial::{AboutX, Corner, Quarter, Straight};
        match $member.twist {
            Twist::Straight => {
                $(let $C = Straight;)+
                $step
            }
            Twist::Quarter => {
                $(let $C = Quarter::<true>;)+
                $step
            }
            Twist::ThreeQuarters => {
                $(let $C = Quarter::<false>;)+
                $step
            }
            Twist::Corner => {
                $(let $C = Corner::<true>;)+
                $step
            }
            Twist::OtherCorner => {
                $(let $C = Corner::<false>;)+
                $step
            }
            Twist::Steep => {
                $(let $C = AboutX::<_, true>(<$S>::constant($member.C.y.z), <$S>::constant($member.C.y.y));)+
                $step
            }
            Twist::Flat => {
                $(let $C = AboutX::<_, false>(<$S>::constant($member.C.y.z), <$S>::constant($member.C.y.y));)+
                $step
            }
            Twist::Any => {
                $(let $C = $member.C.map(<$S>::constant);)+
                $step
            }
        }
    }};
}
pub(crate) use with_twist;

/// The same for a body that slides, of which r is not known: with fewer types.
macro_rules! with_turn {
    ($member:expr, $C:ident: $S:ty => $step:expr) => {{
        use $crate::model::Twist;
        use $crate::spatial::Quarter;
        match $member.twist {
            Twist::Quarter => {
                let $C = Quarter::<true>;
                $step
            }
            Twist::ThreeQuarters => {
                let $C = Quarter::<false>;
                $step
            }
            _ => {
                let $C = $member.C.map(<$S>::constant);
                $step
            }
        }
    }};
}
pub(crate) use with_turn;

/// How a body stands against the one that carries it, in the frames of both.
pub(super) struct Standing<T> {
    pub motion: MotionKind,
    /// Sine and cosine of γ, and of a turn about z that comes last.
    pub offset: (T, T),
    pub twist: Twist,
    pub C: Mat3<T>,
    pub r: Vec3<T>,
    pub I: PseudoInertia<T>,
}

/// Every body's frame against the one that the model gives it.
pub(super) struct Frames<T> {
    /// About z, first.
    turns: Vec<Turn<T>>,
    /// Along z: λ.
    shifts: Vec<T>,
}

impl<T: Real> Frames<T> {
    pub fn new(bodies: &[Body<T>]) -> Self {
        let mut turns: Vec<Turn<T>> = vec![Turn::NONE; bodies.len()];
        for body in bodies {
            // Children come by ascending size of their subtrees: the last one decides.
            if let (true, Some(p)) = (motion(body) != MotionKind::Other, body.parent())
                && motion(&bodies[p]) != MotionKind::Other
            {
                turns[p] = Euler::new(body.X_tree.E).beta;
            }
        }
        // What slides and carries nothing is turned so that a quarter turn is all that is left, where that can be.
        let carriers: Vec<usize> = bodies.iter().filter_map(Body::parent).collect();
        let mut leaf = vec![true; bodies.len()];
        carriers.iter().for_each(|&p| leaf[p] = false);
        for (i, body) in bodies.iter().enumerate() {
            if leaf[i] && motion(body) == MotionKind::Slide {
                let turn = body.parent().map_or(Turn::NONE, |p| turns[p]);
                turns[i] = Euler::new(body.X_tree.E * turn.matrix().transpose()).gamma.back();
            }
        }
        Self { turns, shifts: vec![T::ZERO; bodies.len()] }
    }

    /// Body i, after the one that carries it.
    pub fn place(&mut self, bodies: &[Body<T>], i: usize) -> Standing<T> {
        let (body, motion, own) = (&bodies[i], motion(&bodies[i]), self.turns[i]);
        let parent = body.parent();
        let (turn, shift) = parent.map_or((Turn::NONE, T::ZERO), |p| (self.turns[p], self.shifts[p]));
        let r = turn.matrix() * body.X_tree.r - Vec3::Z * shift;
        let E = body.X_tree.E * turn.matrix().transpose();
        let I = Transform::new(own.matrix().transpose(), Vec3::ZERO).transpose_rigid(body.I).into();
        let standing =
            |offset: Turn<T>, twist, C| Standing { motion, offset: (offset.s, offset.c), twist, C, r, I };
        match motion {
            MotionKind::Hinge => {
                let Euler { gamma, alpha, beta } = Euler::new(E).with_positive_corner();
                let C = alpha.about_x() * beta.matrix();
                let length = body.X_tree.r.norm() + parent.map_or(T::ZERO, |p| bodies[p].X_tree.r.norm());
                let mut hinge = standing(gamma.then(own), Twist::between(alpha, beta), C);
                self.shifts[i] = hinge.shift(T::from_f64(FAR) * length);
                hinge
            }
            MotionKind::Slide => {
                let C = rounded(own.matrix() * E);
                let twist = match C {
                    _ if C == Turn::QUARTER.about_x() => Twist::Quarter,
                    _ if C == Turn::QUARTER.back().about_x() => Twist::ThreeQuarters,
                    _ => Twist::Any,
                };
                standing(Turn::NONE, twist, C)
            }
            MotionKind::Other if E == Mat3::IDENTITY => standing(Turn::NONE, Twist::Straight, E),
            MotionKind::Other => standing(Turn::NONE, Twist::Any, rounded(E)),
        }
    }
}

impl<T: Real> Standing<T> {
    /// Shifts the origin along the body's axis until a coordinate of r is zero, if that is not too far; returns λ.
    fn shift(&mut self, far: T) -> T {
        let z = self.C.z;
        let shift = match self.twist {
            Twist::Straight | Twist::Flat => -self.r.z / z.z,
            Twist::Quarter | Twist::ThreeQuarters | Twist::Steep => -self.r.y / z.y,
            Twist::Corner | Twist::OtherCorner => -self.r.x / z.x,
            Twist::Any => return T::ZERO,
        };
        let shifted = self.I.shifted(Offset::new(Vec3::Z * -shift, Zero::None));
        let (before, after) = (self.I.P, shifted.P);
        let thin = after.zz > before.zz.max((before.xx + before.yy) * T::from_f64(THIN));
        if shift.abs() > far || thin {
            self.twist = Twist::Any;
            return T::ZERO;
        }
        self.r = z.mul_add(shift, self.r);
        match self.twist {
            Twist::Straight | Twist::Flat => self.r.z = T::ZERO,
            Twist::Corner | Twist::OtherCorner => self.r.x = T::ZERO,
            _ => self.r.y = T::ZERO,
        }
        self.I = shifted;
        shift
    }
}

fn motion<T: Real>(body: &Body<T>) -> MotionKind {
    match body.joint {
        Joint::Revolute | Joint::Continuous => MotionKind::Hinge,
        Joint::Prismatic => MotionKind::Slide,
        _ => MotionKind::Other,
    }
}

/// Without what is left of π/2 − π/2: its square would be slow to compute with in single precision.
fn rounded<T: Real>(E: Mat3<T>) -> Mat3<T> {
    let round = T::from_f64(ROUND * T::EPSILON);
    E.map(|x| if x.abs() < round { T::ZERO } else { x })
}

/// A turn by the angle with this sine and cosine.
#[derive(Clone, Copy, PartialEq)]
struct Turn<T> {
    s: T,
    c: T,
}

impl<T: Real> Turn<T> {
    const NONE: Self = Self { s: T::ZERO, c: T::ONE };
    const QUARTER: Self = Self { s: T::ONE, c: T::ZERO };

    /// The turn of the direction (c, s), made unit; round where it is so to the last digits.
    fn new(s: T, c: T) -> Self {
        let norm = s.mul_add(s, c * c).sqrt();
        let (s, c) = (s / norm, c / norm);
        let sign = |x: T| if x < T::ZERO { -T::ONE } else { T::ONE };
        let round = T::from_f64(ROUND * T::EPSILON);
        if s.abs() < round {
            Self { s: T::ZERO, c: sign(c) }
        } else if c.abs() < round {
            Self { s: sign(s), c: T::ZERO }
        } else {
            Self { s, c }
        }
    }

    fn back(self) -> Self {
        Self { s: -self.s, c: self.c }
    }

    fn then(self, b: Self) -> Self {
        Self { s: self.s * b.c + self.c * b.s, c: self.c * b.c - self.s * b.s }
    }

    /// About z.
    fn matrix(self) -> Mat3<T> {
        Mat3::rotation_z((self.s, self.c))
    }

    fn about_x(self) -> Mat3<T> {
        let Self { s, c } = self;
        Mat3::from_rows(Vec3::X, Vec3::new(T::ZERO, c, s), Vec3::new(T::ZERO, -s, c))
    }
}

impl Twist {
    /// Of Rx(α) Rz(β).
    fn between<T: Real>(alpha: Turn<T>, beta: Turn<T>) -> Self {
        let (forwards, round) = (alpha.s > T::ZERO, alpha.c == T::ZERO);
        match (beta == Turn::NONE, beta.c == T::ZERO) {
            (true, _) if alpha == Turn::NONE => Self::Straight,
            (true, _) if round => [Self::ThreeQuarters, Self::Quarter][usize::from(forwards)],
            (true, _) if alpha.s.abs() >= T::from_f64(STEEP) => Self::Steep,
            (true, _) => Self::Flat,
            (_, true) if round => [Self::OtherCorner, Self::Corner][usize::from(forwards)],
            _ => Self::Any,
        }
    }
}

/// E = Rz(γ) Rx(α) Rz(β), with β in the right half turn.
struct Euler<T> {
    gamma: Turn<T>,
    alpha: Turn<T>,
    beta: Turn<T>,
}

impl<T: Real> Euler<T> {
    fn new(E: Mat3<T>) -> Self {
        // The last row is (sin α sin β, −sin α cos β, cos α).
        let sine = E.z.x.mul_add(E.z.x, E.z.y * E.z.y).sqrt();
        let sine = if E.z.y > T::ZERO { -sine } else { sine };
        let alpha = Turn::new(sine, E.z.z);
        let beta = match alpha.s == T::ZERO || E.z.x.abs() < T::from_f64(ROUND * T::EPSILON) {
            true => Turn::NONE,
            false => Turn::new(E.z.x / sine, -E.z.y / sine),
        };
        // The first column of what is left is (cos γ, −sin γ, 0).
        let left = E * beta.matrix().transpose();
        Self { gamma: Turn::new(-left.y.x, left.x.x), alpha, beta }
    }

    /// β a quarter turn forwards, where it is one backwards: Rx(α) Rz(−90°) = Rz(180°) Rx(−α) Rz(90°).
    fn with_positive_corner(self) -> Self {
        let Self { gamma, alpha, beta } = self;
        match beta.c == T::ZERO && beta.s < T::ZERO {
            true => Self {
                gamma: gamma.then(Turn { s: T::ZERO, c: -T::ONE }),
                alpha: alpha.back(),
                beta: Turn::QUARTER,
            },
            false => self,
        }
    }
}
