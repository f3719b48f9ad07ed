"""A robot's own file with other armature, read by MuJoCo."""

import shutil
from pathlib import Path

import numpy as np
import pytest
from eigenbody import InputError, Model

mujoco = pytest.importorskip("mujoco")
suite = pytest.importorskip("dm_control.suite")

ROBOTS = ["acrobot", "cheetah", "dog", "fish", "hopper", "humanoid", "humanoid_CMU", "quadruped", "swimmer", "walker"]


def inertia(path: Path) -> np.ndarray:
    """H in the file's own configuration, as MuJoCo compiles it."""
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    H = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, H)
    return H


@pytest.mark.parametrize("name", ROBOTS)
def test_mujoco_finds_the_armature_and_nothing_else(tmp_path, name):
    folder = tmp_path / "suite"
    here = Path(suite.__file__).parent
    shutil.copytree(here, folder, ignore=lambda _, names: [n for n in names if n.endswith((".py", ".pyc"))])
    path = folder / f"{name}.xml"
    robot = Model(path)
    compiled = mujoco.MjModel.from_xml_path(str(path))
    # One number a joint; a free joint has none.
    added = 0.0123 * np.arange(1, compiled.njnt + 1)[compiled.dof_jntid]
    added[compiled.jnt_type[compiled.dof_jntid] == mujoco.mjtJoint.mjJNT_FREE] = 0
    text = robot.with_armature(robot.armature + added).patched()
    patched = folder / f"{name}-patched.xml"
    patched.write_text(text)
    before, after = inertia(path), inertia(patched)
    # A sum of three numbers, one of them printed: 8 ε of H
    assert np.allclose(after - before, np.diag(added), rtol=0, atol=8 * np.finfo(float).eps * np.abs(before).max())
    gone = set(path.read_text().splitlines()) - set(text.splitlines())
    assert 0 < len(gone) <= robot.nv and all("joint" in line for line in gone)


def test_a_family_has_no_file():
    with pytest.raises(InputError, match="is no URDF or MJCF file that could be changed"):
        Model.hydra(3).patched()
