"""Layouts of other libraries by their documentation alone: energy of point masses, positions and velocities written out.

Drake, QuaternionFloatingJoint: q = [qw qx qy qz, x y z], v = [ω, v], both measured and expressed in the world.
MuJoCo, free joint: qpos = [x y z, qw qx qy qz], qvel = [v in the world, ω in the body].
Pinocchio, JointModelFreeFlyer: q = [x y z, qx qy qz qw], v = [v, ω], both in the body.
"""

from __future__ import annotations

import numpy as np
import pytest

from eigenbody import InputError, Layout, Model, Parts

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


def test_planar_joints():
    """Energy of a disc on a table, by the velocity of its centre in the table's axes and in its own."""
    parts = Parts("disc")
    table, disc = parts.link("table"), parts.link("disc", mass=2.0, com=[0.1, 0.0, 0.0], inertia=np.eye(3).tolist())
    parts.joint("slide", "planar", parent=table, child=disc)
    robot = Model(parts)
    q, v = np.array([0.3, -0.2, 2.5]), np.array([0.4, 0.7, -1.1])
    energy = 0.5 * v @ robot.mass_matrix(q) @ v
    pinocchio = Layout(robot, "pinocchio")
    assert np.allclose(pinocchio.q_to(q), [0.3, -0.2, np.cos(2.5), np.sin(2.5)], rtol=0, atol=1e-15)
    assert np.allclose(pinocchio.q_from(pinocchio.q_to([q, q])), [q, q], rtol=0, atol=1e-15)
    assert np.array_equal(pinocchio.v_to(q, v), v)
    turn = np.array([[np.cos(2.5), -np.sin(2.5)], [np.sin(2.5), np.cos(2.5)]])
    for engine in ["mujoco", "drake"]:
        layout = Layout(robot, engine)
        there = layout.v_to(q, v)
        assert np.array_equal(layout.q_to(q), q)
        assert np.allclose(there, [*(turn @ v[:2]), v[2]], rtol=0, atol=1e-15)
        assert 0.5 * there @ layout.matrix_to(q, robot.mass_matrix(q)) @ there == pytest.approx(energy, rel=1e-14)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda layout, q: layout.q_to(np.zeros(12)), r"q has shape \(12,\), expected \(..., 8\)"),
        (lambda layout, q: layout.q_from(np.zeros((2, 12))), "q has shape"),
        (lambda layout, q: layout.q_from(0.0), "q has shape"),
        (lambda layout, q: layout.v_to(q, np.zeros(3)), r"v has shape \(3,\), expected \(..., 7\)"),
        (lambda layout, q: layout.jacobian(np.zeros(7)), "q has shape"),
        (lambda layout, q: layout.matrix_to(q, np.eye(1)), r"H has shape \(1, 1\), expected \(..., 7, 7\)"),
    ],
)
def test_widths_are_checked(robot, call, words):
    with pytest.raises(InputError, match=words):
        call(Layout(robot, "mujoco"), robot.neutral())


def test_no_layout_where_mimic_joints_follow(tmp_path):
    path = tmp_path / "arm.urdf"
    text = Model.hydra(3).to_urdf()
    names = [name for name, *_ in Model.hydra(3).joints]
    head, tail = text.split(f'<joint name="{names[2]}"')
    first, rest = tail.split("</joint>", 1)
    path.write_text(f'{head}<joint name="{names[2]}"{first}<mimic joint="{names[1]}"/></joint>{rest}')
    assert Model(path).nq == 2
    with pytest.raises(InputError, match="mimic=False"):
        Layout(Model(path), "pinocchio")
    assert Layout(Model(path, mimic=False), "mujoco").q_to(np.zeros(3)).shape == (3,)
