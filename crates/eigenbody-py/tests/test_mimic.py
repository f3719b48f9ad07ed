"""Mimic joints that follow: forces and accelerations of the independent joints, against Pinocchio's own mimic joints."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import eigenbody
from eigenbody import Model

pinocchio = pytest.importorskip("pinocchio")
metadata = pytest.importorskip("importlib.metadata")

NAMES = ["baxter.urdf", "panda.urdf", "pr2.urdf", "tiago_pro.urdf"]


def path_of(name: str) -> Path:
    for file in metadata.distribution("example-robot-data").files or []:
        if file.name == name:
            return Path(str(file.locate()))
    pytest.skip(name)


class Pair:
    """The same robot here and there, coordinates in the order of each."""

    def __init__(self, name: str) -> None:
        self.robot = Model(path_of(name))
        self.theirs = pinocchio.buildModelFromUrdf(str(path_of(name)), mimic=True)
        self.data = self.theirs.createData()
        names = list(self.theirs.names)
        free = [i for i in range(1, self.theirs.njoints) if self.theirs.joints[i].nv]
        ours = self.robot.dof_names
        self.order = [ours.index(names[i]) for i in free]
        self.joints = [self.theirs.joints[i] for i in free]
        assert len(self.order) == self.theirs.nv == self.robot.nv

    def q(self, q: np.ndarray) -> np.ndarray:
        numbers = []
        for joint, x in zip(self.joints, q[self.order]):
            numbers += [np.cos(x), np.sin(x)] if joint.nq == 2 else [x]
        return np.array(numbers)


@pytest.fixture(scope="module", params=NAMES)
def pair(request):
    return Pair(request.param)


def close(found, expected, size):
    # Two O(N) algorithms: a few N ε of the forces that meet.
    assert np.abs(found - expected).max() <= 1e-13 * size


def test_forces(pair):
    robot, n = pair.robot, pair.robot.nv
    rng = np.random.default_rng(3)
    for seed in range(1, 6):
        q, v, a = robot.random(seed), *rng.standard_normal((2, n))
        theirs = (pair.theirs, pair.data, pair.q(q))
        tau = np.array(pinocchio.rnea(*theirs, v[pair.order], a[pair.order]))
        size = np.abs(tau).max() * n
        close(robot.rnea(q, v, a)[pair.order], tau, size)
        C = np.array(pinocchio.nonLinearEffects(*theirs, v[pair.order]))
        close(robot.bias_force(q, v)[pair.order], C, size)
        g = np.array(pinocchio.computeGeneralizedGravity(*theirs))
        close(robot.gravity_force(q)[pair.order], g, size)
        M = np.array(pinocchio.crba(*theirs))
        M = np.triu(M) + np.triu(M, 1).T
        close(robot.mass_matrix(q)[np.ix_(pair.order, pair.order)], M, np.abs(M).max() * n)


def test_accelerations(pair):
    """ABA has no mimic joints in Pinocchio: its M and its bias force, and a dense solve."""
    robot, n = pair.robot, pair.robot.nv
    rng = np.random.default_rng(4)
    for seed in range(1, 6):
        q, v, tau = robot.random(seed), *rng.standard_normal((2, n))
        theirs = (pair.theirs, pair.data, pair.q(q))
        M = np.array(pinocchio.crba(*theirs))
        M = np.triu(M) + np.triu(M, 1).T
        C = np.array(pinocchio.nonLinearEffects(*theirs, v[pair.order]))
        a = robot.aba(q, v, tau)
        # The residual of a backward stable solve.
        size = np.abs(M).max() * np.abs(a).max() * n + np.abs(C).max()
        close(M @ a[pair.order], tau[pair.order] - C, size)


def test_batches_and_single_precision():
    robot = Pair("baxter.urdf").robot
    rng = np.random.default_rng(5)
    q, v, x = robot.random(1, 70), *rng.standard_normal((2, 70, robot.nv))
    for batch, rows in [
        (robot.rnea(q, v, x), [robot.rnea(*row) for row in zip(q, v, x)]),
        (robot.aba(q, v, x), [robot.aba(*row) for row in zip(q, v, x)]),
        (robot.bias_force(q, v), [robot.bias_force(*row) for row in zip(q, v)]),
        (robot.extremes(q), [robot.extremes(row) for row in q]),
    ]:
        assert np.array_equal(batch, np.stack(rows))
    single = robot.rnea(*(array.astype(np.float32) for array in (q, v, x)))
    assert single.dtype == np.float32
    assert np.allclose(single, robot.rnea(q, v, x), rtol=0, atol=1e-4)


def test_free_mimic_joints_are_joints():
    path = path_of("panda.urdf")
    follows, free = Model(path), Model(path, mimic=False)
    assert (follows.nv, free.nv) == (8, 9)
    assert follows.rnea(*[follows.neutral()] * 3).shape == (8,)
    with pytest.raises(eigenbody.InputError, match=r"v has shape \(9,\), expected \(8,\)"):
        follows.rnea(follows.neutral(), np.zeros(9), np.zeros(8))
