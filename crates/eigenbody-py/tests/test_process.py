"""Processes, signals and memory: forked children compute, Ctrl-C ends what is long, and what does not fit is a MemoryError."""

from __future__ import annotations

import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from eigenbody import Model, _eigenbody

FORK = """
import multiprocessing, eigenbody
robot = eigenbody.Model("puma560")
Q = robot.random(1, 2000)
calls = {
    "kappa": lambda: float(robot.kappa(Q).max()),
    "mass_matrix": lambda: float(robot.mass_matrix(Q).max()),
    "conditioning": lambda: float(robot.conditioning(Q[:100]).kappa.max()),
    "check": lambda: robot.check(samples=64).worst("kappa")["worst"],
}
def call(name):
    return calls[name]()
expected = [call(name) for name in calls]
with multiprocessing.get_context("fork").Pool(2) as pool:
    assert pool.map_async(call, list(calls)).get(60) == expected
print("done")
"""


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="no fork")
def test_a_forked_child_computes():
    """A parent that has computed a batch has threads; its children have none of them."""
    done = subprocess.run([sys.executable, "-c", FORK], capture_output=True, text=True, timeout=120, check=False)
    assert done.stdout == "done\n", done.stderr


LONG = {
    "conditioning": "eigenbody.Model.hydra(100).conditioning(Q)",
    "kappa": "eigenbody.Model.hydra(100).kappa(Q)",
    "kappa alone": "eigenbody.Model.hydra(100).kappa(Q, accuracy=0)",
    "spectrum": "eigenbody.Model.hydra(100).spectrum(Q)",
    "random": "eigenbody.Model.hydra(1).random(1, 300_000_000)",
}


@pytest.mark.parametrize("name", LONG)
def test_ctrl_c_is_heard(name):
    code = (
        "import signal, numpy, eigenbody\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "Q = numpy.random.default_rng(1).uniform(-1, 1, (100_000, 100))\n"
        "print('ready', flush=True)\n"
        f"try:\n    {LONG[name]}\nexcept KeyboardInterrupt:\n    print('heard')\n"
    )
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None and process.stdout.readline() == "ready\n"
    time.sleep(1.0)
    process.send_signal(signal.SIGINT)
    try:
        # The whole would take longer than that.
        assert process.communicate(timeout=20)[0] == "heard\n"
    finally:
        process.kill()


HUGE = 10**13  # rows: 480 terabytes of q for six joints


@pytest.mark.parametrize(
    "call",
    [
        lambda robot, Q: robot.mass_matrix(Q),
        lambda robot, Q: robot.rnea(Q, Q, Q),
        lambda robot, Q: robot.kappa(Q),
        lambda robot, Q: robot.extremes(Q),
        lambda robot, Q: robot.spectrum(Q),
        lambda robot, Q: robot.conditioning(Q),
        lambda robot, Q: robot.random(1, HUGE),
    ],
)
def test_what_does_not_fit_is_a_memory_error(call):
    robot = Model("puma560")
    with pytest.raises(MemoryError):
        call(robot, np.broadcast_to(robot.neutral(), (HUGE, 6)))


def test_numpy_is_needed_from_the_start(tmp_path):
    """Its absence, or Ctrl-C while it is being loaded, is seen at the import and not at the first array."""
    (tmp_path / "numpy").mkdir()
    (tmp_path / "numpy" / "__init__.py").write_text("__version__ = '2.0.0'\n")
    code = (
        "import importlib.machinery, importlib.util\n"
        f"loader = importlib.machinery.ExtensionFileLoader('_eigenbody', {_eigenbody.__file__!r})\n"
        "spec = importlib.util.spec_from_loader('_eigenbody', loader)\n"
        "try:\n    loader.exec_module(importlib.util.module_from_spec(spec))\n"
        "except (ImportError, AttributeError) as error:\n    print('refused')\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env={"PYTHONPATH": str(tmp_path)}, check=False)
    assert done.stdout == "refused\n", done.stderr
