"""`check` with its options: the command line's numbers, pages, advice, baselines, mended robots."""

from __future__ import annotations

import json
import os
import pickle
import subprocess
from pathlib import Path

import numpy as np
import pytest

from eigenbody import Diagnosis, InputError, Model

ARM = """
<mujoco model="arm">
  <option timestep="0.01" integrator="implicitfast"/>
  <worldbody>
    <body name="upper">
      <joint name="shoulder" axis="0 1 0" range="-1.5 1.5" limited="true" damping="0.1"/>
      <inertial pos="0.2 0 0" mass="2" diaginertia="0.01 0.03 0.03"/>
      <body name="fore" pos="0.4 0 0">
        <joint name="elbow" axis="0 1 0" range="-2 2" limited="true"/>
        <inertial pos="0.1 0 0" mass="0.05" diaginertia="0.0001 0.0002 0.0002"/>
      </body>
    </body>
  </worldbody>
  <actuator><position joint="shoulder" kp="50"/><position joint="elbow" kp="20"/></actuator>
</mujoco>
"""


@pytest.fixture
def arm(tmp_path):
    path = tmp_path / "arm.xml"
    path.write_text(ARM)
    return path


def run(*arguments: str) -> str:
    root = Path(__file__).resolve().parents[3]
    command = os.environ.get("EIGENBODY", str(root / "target" / "release" / "eigenbody"))
    done = subprocess.run([command, *arguments], capture_output=True, text=True, check=False)
    assert done.returncode in (0, 1), done.stderr
    return done.stdout


OPTIONS = [
    ([], {}),
    (["--kp", "80", "--kd", "elbow=2"], {"kp": 80, "kd": {"elbow": 2}}),
    (["--dt", "0.004", "--integrator", "rk4"], {"step": 0.004, "integrator": "rk4"}),
    (["--want-kappa", "30"], {"want_kappa": 30}),
    (["--want-lambda-min", "0.01"], {"want_lambda_min": 0.01}),
    (["--want-step", "0.02"], {"want_step": 0.02}),
]


@pytest.mark.parametrize(("arguments", "options"), OPTIONS, ids=lambda value: " ".join(value) if isinstance(value, list) else "")
def test_the_command_prints_the_same(arm, arguments, options):
    printed = json.loads(run("check", str(arm), "--samples", "128", "--format", "json", *arguments))
    found = Model(arm).check(samples=128, **options)
    assert found.to_dict() == printed
    assert (found.advice is not None) == ("want" in str(options))


def test_pages_are_the_commands_own(arm):
    found = Model(arm).check(samples=128)
    for format, page in [("html", found.to_html()), ("sarif", found.to_sarif() + "\n"), ("human", found.to_text())]:
        assert page == run("check", str(arm), "--samples", "128", "--format", format), format


def test_a_mended_robot_is_mended(arm):
    robot = Model(arm)
    found = robot.check(samples=128, want_kappa=30)
    assert found.advice is not None and found.advice["measure"] == "kappa"
    mended = found.mended()
    assert mended.worst_case(samples=128)["kappa"].worst <= 30 * (1 + 1e-9)
    assert robot.worst_case(samples=128)["kappa"].worst > 30
    text = mended.to_mjcf()
    path = arm.with_name("patched.xml")
    path.write_text(text)
    assert np.allclose(Model(path).armature, mended.armature, rtol=1e-15)
    rotors = arm.with_name("patched.urdf")
    rotors.write_text(mended.to_urdf(rotors=True))
    assert np.allclose(Model(rotors, rotors=True).armature, mended.armature, rtol=1e-12)
    own = arm.with_name("own.xml")
    own.write_text(mended.patched())
    assert np.array_equal(Model(own).armature, mended.armature)
    assert "armature" in repr(found)
    with pytest.raises(InputError, match="'paint', expected armature, link or limit"):
        found.mended("paint")
    with pytest.raises(InputError, match="nothing was wanted"):
        robot.check(samples=64).mended()


def test_a_baseline_says_what_is_new(arm):
    robot = Model(arm)
    before = robot.check(samples=64, max_kappa=1e9, max_kappa_weighted=1e9)
    path = arm.with_name("before.json")
    path.write_text(json.dumps(before.to_dict()))
    options = {"samples": 64, "max_kappa": 2.0}
    printed = json.loads(run("check", str(arm), "--samples", "64", "--max-kappa", "2", "--baseline", str(path), "--format", "json"))
    assert robot.check(**options, baseline=path).to_dict() == printed
    for baseline in [before, before.to_dict()]:
        comparison = robot.check(**options, baseline=baseline).comparison
        assert comparison is not None and comparison["findings"] == printed["comparison"]["findings"]
        assert "new" in comparison["findings"]


def test_a_diagnosis_survives_pickling(arm):
    found = Model(arm).check(samples=64)
    again = pickle.loads(pickle.dumps(found))
    assert isinstance(again, Diagnosis)
    assert again.to_dict() == found.to_dict() and repr(again) == repr(found)
    with pytest.raises(InputError, match="pickled"):
        again.to_html()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"kp": -1}, "no number below zero"),
        ({"kd": {"wrist": 1.0}}, "no moving joint is named 'wrist'"),
        ({"step": 0.0}, "step: 0, expected a positive number"),
        ({"integrator": "magic"}, "integrator: 'magic'"),
        ({"want_kappa": -3.0}, "want_kappa"),
        ({"want_kappa": 3.0, "want_step": 0.1}, "one thing at a time"),
        ({"want_step": 0.01, "integrator": "rk4"}, "Euler's kind"),
        ({"want_kappa": 1.0000001}, "nothing was found"),
        ({"baseline": {"findings": 3}}, "no report of a check"),
        ({"baseline": "nowhere.json"}, "nowhere.json"),
    ],
)
def test_refusals(arm, options, words):
    with pytest.raises(InputError, match=words):
        Model(arm).check(samples=64, **options)


def test_a_family_has_no_springs():
    with pytest.raises(InputError, match="give kp and kd"):
        Model.hydra(3).check(samples=64, want_step=0.01)
    assert Model.hydra(3).check(samples=64, kp=100.0, step=0.01).stepping is not None
