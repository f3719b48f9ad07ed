"""The guide's notebook runs, block by block."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

GUIDE = Path(__file__).resolve().parents[3] / "docs" / "guide" / "src" / "notebook.md"


def test_the_notebook_runs(tmp_path, monkeypatch):
    pytest.importorskip("matplotlib")
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", GUIDE.read_text(encoding="utf-8"), flags=re.DOTALL)
    assert len(blocks) >= 6
    names: dict[str, object] = {}
    for number, block in enumerate(blocks):
        exec(compile(block, f"notebook block {number}", "exec"), names)
    assert (tmp_path / "heat.png").stat().st_size > 10_000


def test_results_plot_themselves():
    pytest.importorskip("matplotlib").use("Agg")
    import eigenbody

    robot = eigenbody.Model("puma560")
    assert robot.conditioning().plot().get_xlabel() == "share of the mode"
    assert robot.conditioning(robot.random(1, 20)).plot().get_yscale() == "log"
    found = robot.check(samples=64)
    assert len(found.plot().patches) == len(found.worst()["softest"]) > 1
    assert robot.worst_case(samples=64)["kappa"]._repr_html_().startswith("<table>")


def test_results_are_readable():
    import eigenbody

    robot = eigenbody.Model.hydra(10)
    for thing in [robot, robot.conditioning(), robot.conditioning(robot.random(1, 3)), robot.check(samples=64)]:
        page = thing._repr_html_()
        assert page.startswith("<table>") and "hydra" in page or "configurations" in page
        assert "0x" not in repr(thing)
