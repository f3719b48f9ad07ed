"""Motions: the command line's numbers to the last bit, physics that can be checked by hand, and Ctrl-C."""

from __future__ import annotations

import csv
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import eigenbody
from eigenbody import InputError, Model, ModelError


def table(*arguments: str) -> dict[str, np.ndarray]:
    """The rows that the command writes."""
    root = Path(__file__).resolve().parents[3]
    command = os.environ.get("EIGENBODY", str(root / "target" / "release" / "eigenbody"))
    done = subprocess.run([command, "simulate", *arguments], capture_output=True, text=True, check=True)
    heading, *rows = csv.reader(done.stdout.splitlines())
    return {name: np.array([float(row[k]) for row in rows]) for k, name in enumerate(heading)}


CASES = [
    (["puma560", "--initial", "random(3)", "--velocity", "random(2)", "--time", "0.3"], "puma560", {"q": "random(3)", "v": "random(2)", "time": 0.3}),
    (["hydra(6,2,0.3,0.9)", "--method", "rk4", "--step", "0.004", "--time", "0.2", "--gravity", "off", "--velocity", "random(1)"],
     "hydra(6,2,0.3,0.9)", {"method": "rk4", "step": 0.004, "time": 0.2, "gravity": False, "v": "random(1)"}),
    (["hydra(4,1,0.4,1)", "--method", "midpoint", "--time", "0.1", "--monitor", "energy,kappa,bracket"],
     "hydra(4,1,0.4,1)", {"method": "midpoint", "time": 0.1, "monitors": ["energy", "kappa", "bracket"]}),
    (["hydra(5,1.5,0.3,0.9)", "--method", "euler", "--time", "0.1", "--damping", "0.5", "--stiffness", "3", "--rest", "random(4)"],
     "hydra(5,1.5,0.3,0.9)", {"method": "euler", "time": 0.1, "damping": 0.5, "stiffness": 3, "rest": "random(4)"}),
    (["puma560", "--hold", "random(5)", "--bandwidth", "3", "--damping-ratio", "0.7", "--dynamics", "crba", "--rate", "30", "--time", "0.5"],
     "puma560", {"hold": "random(5)", "bandwidth": 3, "damping_ratio": 0.7, "dynamics": "crba", "rate": 30, "time": 0.5}),
]  # fmt: skip


@pytest.mark.parametrize(("arguments", "text", "options"), CASES, ids=lambda value: value if isinstance(value, str) else None)
def test_the_command_writes_the_same_bits(arguments, text, options):
    printed = table(*arguments)
    found = Model(text).simulate(**options).to_dict()
    assert list(found) == list(printed)
    for name, column in printed.items():
        assert np.array_equal(found[name], column), name


def test_tables_over_time_are_as_in_files(tmp_path):
    robot = Model("puma560")
    t = np.linspace(0, 0.4, 9)
    q = np.linspace(robot.random(1), robot.random(2), 9)
    tau = np.sin(np.outer(t, np.arange(1, 7)))
    for name, letter, rows in [("follow.csv", "q", q), ("torque.csv", "tau", tau)]:
        lines = [",".join(["t", *(f"{letter}{k}" for k in range(6))]), *(",".join(map(repr, [float(a), *map(float, row)])) for a, row in zip(t, rows))]
        (tmp_path / name).write_text("\n".join(lines) + "\n")
    files = [str(tmp_path / name) for name in ("follow.csv", "torque.csv")]
    printed = table("puma560", "--time", "0.4", "--follow", files[0], "--torque", files[1])
    for options in [{"follow": files[0], "torque": files[1]}, {"follow": (t, q), "torque": (t, tau)}]:
        found = robot.simulate(0.4, **options).to_dict()
        assert all(np.array_equal(found[name], column) for name, column in printed.items())


def test_a_pendulum_swings():
    """Small swings of a slender rod about its end: ω² = 3 g / 2 l."""
    rod = Model.chain(1, mass=2.0, length=1.5)
    omega = np.sqrt(1.5 * 9.81 / 1.5)
    hanging = rod.gravity_force([-np.pi / 2])  # horizontal at 0, gravity along -y
    assert abs(hanging[0]) < 1e-12
    motion = rod.simulate(2.0, q=[-np.pi / 2 + 1e-4], tolerance=1e-12, monitors=["energy"])
    expected = 1e-4 * np.cos(omega * motion.t)
    assert np.abs(motion.q[:, 0] + np.pi / 2 - expected).max() < 1e-11
    assert np.ptp(motion["energy"]) < 1e-11 * np.ptp(motion["kinetic_energy"]) + 1e-12
    assert motion.units["energy"] == "J"


def test_gains_may_be_given_in_every_form():
    robot = Model("puma560")
    names = robot.dof_names
    by_text = robot.simulate(0.1, damping="joint_2=3,joint_4=1")
    by_name = robot.simulate(0.1, damping={"joint_2": 3.0, "joint_4": 1.0})
    by_number = robot.simulate(0.1, damping=[3.0 * (name == "joint_2") + 1.0 * (name == "joint_4") for name in names])
    assert np.array_equal(by_text.q, by_name.q)
    assert np.array_equal(by_text.q, by_number.q)
    held = robot.simulate(1.0, q="random(2)", hold="random(2)", gravity=False)
    assert np.abs(held.q - held.q[0]).max() < 1e-12
    stiff = robot.simulate(0.1, hold="random(2)", kp=100.0, kd=20 * np.ones(6))
    assert not np.array_equal(stiff.q, robot.simulate(0.1, hold="random(2)").q)


def test_mimic_joints_follow_in_motion():
    metadata = pytest.importorskip("importlib.metadata")
    try:
        files = metadata.distribution("example-robot-data").files or []
    except metadata.PackageNotFoundError:
        pytest.skip("no robots")
    path = next(str(file.locate()) for file in files if file.name == "panda.urdf")
    robot = Model(path)
    motion = robot.simulate(0.05, v="random(3)", tolerance=1e-11, monitors=["kappa", "energy"], damping=0.0)
    assert motion.q.shape[1] == robot.nq == 8
    # Independent of the simulation's own algorithm: the first step's acceleration is that of aba.
    again = robot.simulate(1e-4, v=motion.v[0], rate=1e4, tolerance=1e-13, springs=False)
    a = robot.aba(motion.q[0], motion.v[0], np.zeros(8))
    assert np.allclose((again.v[1] - again.v[0]) / 1e-4, a, rtol=0, atol=2e-3 * np.abs(a).max())
    assert motion["kappa"][0] == pytest.approx(robot.kappa(motion.q[0]), rel=1e-12)
    printed = table(path, "--velocity", "random(3)", "--time", "0.05", "--tolerance", "1e-11", "--monitor", "kappa,energy")
    assert np.array_equal(printed["kappa"], motion["kappa"])


def test_events_and_ends():
    robot = Model("puma560")
    level = float(np.median(robot.simulate(1.0)["kappa"]))
    motion = robot.simulate(1.0, events=[f"kappa={level}"])
    crossings = [t for t, what in motion.events if what == f"kappa rises above {level}"]
    assert crossings and all(0 <= t <= 1 for t, _ in motion.events)
    below, above = motion["kappa"][:-1] <= level, motion["kappa"][1:] > level
    for k in np.flatnonzero(below & above):
        assert any(motion.t[k] <= t <= motion.t[k + 1] for t in crossings)
    wild = Model.hydra(3).simulate(5.0, method="euler", step=0.05, stiffness=1e7, q=[1, 1, 1])
    assert wild.note is not None and "blown up" in wild.note
    assert 0 < len(wild) < 501
    assert "ended early" in repr(wild)


def test_motions_are_readable_and_plot(tmp_path):
    motion = Model("puma560").simulate(0.2, monitors=["kappa", "kappa_weighted", "eigenvalues", "modes"])
    assert len(motion) == 21
    assert motion["eigenvalues"].shape == (21, 6)
    assert "21 rows" in repr(motion) and "0x" not in repr(motion)
    assert motion._repr_html_().startswith("<table>")
    pytest.importorskip("matplotlib").use("Agg")
    ax = motion.plot()
    assert ax.get_yscale() == "log" and len(ax.lines) == 2
    ax.figure.savefig(tmp_path / "motion.png")
    assert motion.plot("kappa", ax=ax) is ax


@pytest.mark.parametrize(
    ("options", "error", "words"),
    [
        ({"time": -1.0}, InputError, "time: -1, expected a positive number"),
        ({"rate": np.nan}, InputError, "rate"),
        ({"time": 1e9, "rate": 1e6}, InputError, "more than memory should hold"),
        ({"q": np.zeros(5)}, InputError, r"q has shape \(5,\)"),
        ({"q": np.zeros((2, 6))}, InputError, "is a batch"),
        ({"q": [np.nan] * 6}, InputError, r"q\[0\]"),
        ({"v": "elbow=1"}, ModelError, "no degree of freedom is named 'elbow'"),
        ({"v": [np.inf] * 6}, InputError, r"v\[0\]"),
        ({"method": "rk5"}, InputError, "'rk5', expected one of euler, rk4"),
        ({"method": "rk4", "step": 0.0}, InputError, "step"),
        ({"tolerance": -1e-9}, InputError, "tolerance"),
        ({"dynamics": "magic"}, InputError, "expected one of aba, crba"),
        ({"monitors": ["kapa"]}, InputError, "'kapa', expected one of kappa"),
        ({"events": ["kappa"]}, InputError, "expected QUANTITY=X"),
        ({"events": ["mass=3"]}, InputError, "known: kappa"),
        ({"damping": -1.0}, InputError, "no number below zero"),
        ({"damping": "elbow=3"}, ModelError, "no moving joint is named 'elbow'"),
        ({"damping": {"elbow": 3.0}}, InputError, "no moving joint is named 'elbow'"),
        ({"damping": np.ones(5)}, InputError, r"damping has shape \(5,\)"),
        ({"damping": object()}, TypeError, "no number, text, dict or array"),
        ({"kp": 3.0}, InputError, "say what to hold"),
        ({"hold": "zero", "follow": ([0.0], np.zeros((1, 6)))}, InputError, "holds or follows"),
        ({"follow": ([0.0, 0.0], np.zeros((2, 6)))}, InputError, "time"),
        ({"follow": ([0.0, 1.0], np.zeros((3, 6)))}, InputError, "times of follow has shape"),
        ({"torque": ([0.0, 1.0], np.full((2, 6), np.nan))}, InputError, "torque"),
        ({"torque": "nowhere.csv"}, InputError, "nowhere.csv"),
        ({"method": "midpoint", "dynamics": "crba"}, InputError, "articulated bodies only"),
    ],
)  # fmt: skip
def test_refusals(options, error, words):
    with pytest.raises(error, match=words):
        Model("puma560").simulate(**options)


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
@pytest.mark.parametrize(
    "call",
    [
        "hydra(40).simulate(1e5, rate=1e-4, method='rk4', step=1e-3, monitors=[])",
        "hydra(400, 1.5, 0.3, 0.9).check(samples=60_000)",
        "hydra(400, 1.5, 0.3, 0.9).worst_case(samples=60_000)",
    ],
)
def test_ctrl_c_is_heard(call):
    code = (
        "import eigenbody, signal\n"
        # What runs in the background of a shell ignores it from the start.
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "print('begun', flush=True)\n"
        f"eigenbody.Model.{call}\n"
    )
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout is not None and process.stdout.readline() == "begun\n"
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=20)
    assert process.returncode != 0
    assert "KeyboardInterrupt" in errors


def test_other_threads_run_meanwhile():
    import threading

    robot = Model.hydra(30)
    seen: list[float] = []
    thread = threading.Thread(target=lambda: robot.simulate(3.0, method="rk4", step=1e-3, monitors=[]))
    thread.start()
    while thread.is_alive():
        seen.append(time.perf_counter())
    # Without the interpreter's lock released there would be no turn but the first.
    assert len(seen) > 100


def test_simulate_leaves_the_model_alone():
    robot = Model("puma560")
    before = robot.gravity.copy()
    robot.simulate(0.01, gravity=False)
    assert np.array_equal(robot.gravity, before)
    assert eigenbody.Motion.__name__ == "Motion"
