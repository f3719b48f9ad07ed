"""Layouts of other libraries by their documentation alone: energy of point masses, positions and velocities written out.

Drake, QuaternionFloatingJoint: q = [qw qx qy qz, x y z], v = [ω, v], both measured and expressed in the world.
MuJoCo, free joint: qpos = [x y z, qw qx qy qz], qvel = [v in the world, ω in the body].
Pinocchio, JointModelFreeFlyer: q = [x y z, qx qy qz qw], v = [v, ω], both in the body.
"""

from __future__ import annotations

import numpy as np
import pytest

from eigenbody import Layout, Model, Parts

RNG = np.random.default_rng(7)
# Point masses of a base and of a link on a hinge, in the frame of each.
BASE, TIP = RNG.standard_normal((2, 5, 3))
MASSES = RNG.uniform(0.2, 2.0, (2, 5))
PLACE, AXIS = np.array([0.3, -0.2, 0.5]), np.array([2.0, -1.0, 2.0]) / 3


def weight(points: np.ndarray, masses: np.ndarray) -> dict:
    com = masses @ points / masses.sum()
    r = points - com
    inertia = sum(m * (np.dot(x, x) * np.eye(3) - np.outer(x, x)) for m, x in zip(masses, r))
    return {"mass": masses.sum(), "com": com.tolist(), "inertia": inertia.tolist()}


@pytest.fixture(scope="module")
def robot() -> Model:
    parts = Parts("points")
    world = parts.link("world")
    base = parts.link("base", **weight(BASE, MASSES[0]))
    tip = parts.link("tip", **weight(TIP, MASSES[1]))
    parts.joint("hinge", "revolute", parent=base, child=tip, position=PLACE.tolist(), axis=AXIS.tolist())
    parts.joint("root", "floating", parent=world, child=base)
    return Model(parts)


def turned(axis: np.ndarray, angle: float) -> np.ndarray:
    """Rodrigues."""
    K = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


class State:
    """A random pose and its rates in the world."""

    def __init__(self, seed: int) -> None:
        rng = np.random.default_rng(seed)
        axis = rng.standard_normal(3)
        self.axis, self.angle = axis / np.linalg.norm(axis), rng.uniform(-3, 3)
        self.R = turned(self.axis, self.angle)
        self.p, self.omega, self.velocity = rng.standard_normal((3, 3))
        self.theta, self.rate = rng.standard_normal(2)

    def energy(self) -> float:
        A = turned(AXIS, self.theta)
        total = 0.0
        for m, r in zip(MASSES[0], BASE):
            total += 0.5 * m * np.sum((self.velocity + np.cross(self.omega, self.R @ r)) ** 2)
        for m, r in zip(MASSES[1], TIP):
            at = self.R @ (PLACE + A @ r)
            own = self.R @ np.cross(AXIS * self.rate, A @ r)
            total += 0.5 * m * np.sum((self.velocity + np.cross(self.omega, at) + own) ** 2)
        return float(total)

    def coordinates(self, engine: str) -> tuple[np.ndarray, np.ndarray]:
        """q and v as the library's own documentation has them, the floating joint before the hinge."""
        s, w = np.sin(self.angle / 2) * self.axis, np.cos(self.angle / 2)
        R = self.R.T
        if engine == "drake":
            return np.hstack([w, s, self.p, self.theta]), np.hstack([self.omega, self.velocity, self.rate])
        if engine == "mujoco":
            return np.hstack([self.p, w, s, self.theta]), np.hstack([self.velocity, R @ self.omega, self.rate])
        return np.hstack([self.p, s, w, self.theta]), np.hstack([R @ self.velocity, R @ self.omega, self.rate])


@pytest.mark.parametrize("engine", ["drake", "mujoco", "pinocchio"])
@pytest.mark.parametrize("seed", range(1, 6))
def test_energy_in_their_coordinates(robot, engine, seed):
    layout, state = Layout(robot, engine, ["root", "hinge"]), State(seed)
    theirs, v = state.coordinates(engine)
    q = layout.q_from(theirs)
    assert np.array_equal(layout.q_to(q), theirs)
    M = layout.matrix_to(q, robot.mass_matrix(q))
    size = np.abs(M).max() * np.abs(v).max() ** 2
    assert abs(0.5 * v @ M @ v - state.energy()) <= 64 * np.finfo(float).eps * size
    # Not by chance: M is the energy's only matrix, entry by entry.
    for i in range(len(v)):
        for j in range(i):
            for sign in (1, -1):
                w = v.copy()
                w[i] += 0.5
                w[j] -= 0.25 * sign
                changed = state_of(state, engine, w)
                assert abs(0.5 * w @ M @ w - changed.energy()) <= 256 * np.finfo(float).eps * size


def state_of(state: State, engine: str, v: np.ndarray) -> State:
    """The same pose with the rates that v means there."""
    changed = State.__new__(State)
    changed.__dict__.update(state.__dict__)
    if engine == "drake":
        changed.omega, changed.velocity = v[:3], v[3:6]
    elif engine == "mujoco":
        changed.velocity, changed.omega = v[:3], state.R @ v[3:6]
    else:
        changed.velocity, changed.omega = state.R @ v[:3], state.R @ v[3:6]
    changed.rate = v[6]
    return changed


def test_coordinates_come_back(robot):
    q = robot.random(1, 4)
    v = RNG.standard_normal((4, robot.nv))
    for engine in ["pinocchio", "mujoco", "drake"]:
        layout = Layout(robot, engine)
        assert np.array_equal(layout.q_from(layout.q_to(q)), q)
        assert np.allclose(layout.v_from(q, layout.v_to(q, v)), v, atol=1e-15)
