"""Live models of Pinocchio and MuJoCo: the same H, entry by entry, in their own order and frames."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from eigenbody import Layout, Model

pinocchio = pytest.importorskip("pinocchio")
mujoco = pytest.importorskip("mujoco")
metadata = pytest.importorskip("importlib.metadata")

TOLERANCE = 1e-12  # of the largest entry


def listed(package: str, suffix: str) -> list[Path]:
    try:
        files = metadata.distribution(package).files or []
    except metadata.PackageNotFoundError:
        return []
    return sorted({Path(str(file.locate())) for file in files if file.suffix == suffix})


URDF = [path for path in listed("example-robot-data", ".urdf") if path.stat().st_size > 200][::2][:30]
MJCF = [path for path in listed("dm-control", ".xml") if "<worldbody" in path.read_text(errors="replace")][:40]


def close(found: np.ndarray, expected: np.ndarray) -> None:
    assert found.shape == expected.shape
    if found.size:
        assert np.abs(found - expected).max() <= TOLERANCE * (np.abs(expected).max() or 1.0)


@pytest.mark.parametrize("path", URDF, ids=lambda path: path.stem)
@pytest.mark.parametrize("floating", [False, True])
def test_pinocchio(path, floating):
    live = pinocchio.buildModelFromUrdf(str(path), *([pinocchio.JointModelFreeFlyer()] if floating else []))
    robot = Model.from_pinocchio(live)
    names = [name for name in list(live.names)[1:]]
    layout = Layout(robot, "pinocchio", names)
    data = live.createData()
    for seed in range(1, 6):
        q = robot.random(seed)
        theirs = layout.q_to(q)
        M = np.array(pinocchio.crba(live, data, theirs))
        M = np.triu(M) + np.triu(M, 1).T
        close(layout.matrix_to(q, robot.mass_matrix(q)), M)
        rng = np.random.default_rng(seed)
        v, a = rng.standard_normal((2, live.nv))
        tau = np.array(pinocchio.rnea(live, data, theirs, v, a))
        ours = robot.rnea(q, layout.v_from(q, v), layout.v_from(q, a))
        close(layout.v_to(q, ours), tau)


@pytest.mark.parametrize("path", MJCF, ids=lambda path: path.stem)
def test_mujoco(path):
    try:
        live = mujoco.MjModel.from_xml_path(str(path))
    except ValueError as error:
        pytest.skip(str(error).splitlines()[0])
    robot = Model.from_mujoco(live)
    layout = Layout(robot, "mujoco")
    data = mujoco.MjData(live)
    moving = np.zeros((live.nv, live.nv))
    for seed in range(1, 6):
        q = robot.random(seed)
        data.qpos[:] = layout.q_to(q)
        mujoco.mj_kinematics(live, data)
        mujoco.mj_comPos(live, data)
        if live.ntendon:
            mujoco.mj_tendon(live, data)
            if np.any(live.tendon_armature):
                pytest.skip("armature of tendons")
        mujoco.mj_makeM(live, data)
        mujoco.mj_fullM(live, data, moving)
        close(layout.matrix_to(q, robot.mass_matrix(q)), moving)


def test_coordinates_come_back():
    robot = Model.hydra(3, base="floating")
    q = robot.random(1, 4)
    v = np.random.default_rng(1).standard_normal((4, robot.nv))
    for engine in ["pinocchio", "mujoco", "drake"]:
        layout = Layout(robot, engine)
        assert np.array_equal(layout.q_from(layout.q_to(q)), q)
        assert np.allclose(layout.v_from(q, layout.v_to(q, v)), v, atol=1e-15)
