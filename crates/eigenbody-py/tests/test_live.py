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


def test_limits_of_pinocchio():
    """The largest number and infinity are none."""
    most = np.finfo(float).max
    live = pinocchio.Model()
    parent, ends = 0, [(-most, most), (-np.inf, np.inf), (-np.inf, 0.5), (-1.0, 2.0)]
    for k, (lower, upper) in enumerate(ends):
        one = [np.array([x]) for x in (1.0, 1.0, lower, upper)]
        parent = live.addJoint(parent, pinocchio.JointModelRX(), pinocchio.SE3.Identity(), f"j{k}", *one)
        live.appendBodyToJoint(parent, pinocchio.Inertia.Random(), pinocchio.SE3.Identity())
    robot = Model.from_pinocchio(live)
    assert robot.limits.T.tolist() == [[-np.inf, np.inf], [-np.inf, np.inf], [-np.inf, 0.5], [-1.0, 2.0]]
    assert np.isfinite(robot.random(1, 10)).all()


def test_angles_of_pinocchio():
    """Continuous joints from their own cosine and sine, there and back."""
    live = pinocchio.Model()
    parent = 0
    for k, joint in enumerate([pinocchio.JointModelRUBX(), pinocchio.JointModelRZ(), pinocchio.JointModelRUBY()]):
        parent = live.addJoint(parent, joint, pinocchio.SE3.Random(), f"j{k}")
        live.appendBodyToJoint(parent, pinocchio.Inertia.Random(), pinocchio.SE3.Identity())
    robot = Model.from_pinocchio(live)
    layout = Layout(robot, "pinocchio", list(live.names)[1:])
    q = robot.random(1, 5)
    theirs = layout.q_to(q)
    assert theirs.shape == (5, live.nq) == (5, 5)
    assert np.allclose(layout.q_from(theirs), q, rtol=0, atol=1e-15)
    for q, theirs in zip(q, theirs):
        M = np.array(pinocchio.crba(live, live.createData(), theirs))
        close(robot.mass_matrix(q), np.triu(M) + np.triu(M, 1).T)


SPRINGS = """
<mujoco>
  <option timestep="0.004"/>
  <worldbody>
    <body>
      <joint name="hinge" type="hinge" axis="0 1 0" stiffness="1000" damping="1"/>
      <geom size=".1" pos=".1 0 0"/>
      <body pos="0.3 0 0"><joint name="ball" type="ball" damping="0.5"/><geom size=".1" pos=".1 0 0"/></body>
    </body>
  </worldbody>
  <actuator><position joint="hinge" kp="50"/></actuator>
  <keyframe><key qpos="0 1 0 0 0"/></keyframe>
</mujoco>
"""


def test_springs_of_mujoco(tmp_path):
    path = tmp_path / "springs.xml"
    path.write_text(SPRINGS)
    robot, read = Model.from_mujoco(mujoco.MjModel.from_xml_path(str(path))), Model(path)
    q = read.random(1)
    motions = [one.simulate(0.2, q=q, monitors=[]).q for one in (robot, read)]
    assert np.allclose(*motions, rtol=0, atol=1e-8)
    assert not np.allclose(motions[0], robot.simulate(0.2, q=q, monitors=[], springs=False).q, rtol=0, atol=1e-3)
    stepping = robot.check(samples=16, step=0.004).stepping
    assert stepping is not None
    notes = "\n".join(robot.findings)
    for word in ["actuators", "keyframes", "time step of 0.004 s"]:
        assert word in notes
    assert "tendons" not in notes and "qpos_spring" not in notes
