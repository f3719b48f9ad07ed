"""Where the tests find the command and robots."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def command() -> Callable[..., Any]:
    """The released command: its JSON."""
    path = os.environ.get("EIGENBODY", str(ROOT / "target" / "release" / "eigenbody"))

    def run(*arguments: str) -> Any:
        done = subprocess.run([path, *arguments], capture_output=True, text=True, check=False)
        assert done.returncode in (0, 1), done.stderr
        return json.loads(done.stdout)

    return run
