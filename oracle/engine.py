"""eigenbody's matrices of many files, from one process (`crates/eigenbody-formats/examples/matrices.rs`)."""

import json
import subprocess
from pathlib import Path


class Refused(Exception):
    """eigenbody refuses the file, with this line."""


class Engine:
    """A running `matrices`."""

    def __init__(self, program: Path):
        self.process = subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def ask(self, path: Path, base: str = "fixed", mimic: bool = False, configurations: int = 10) -> dict:
        """DoFs, joints, coordinates and H of a file in some random configurations."""
        request = {"path": str(path), "base": base, "mimic": mimic, "configurations": configurations}
        self.process.stdin.write(json.dumps(request) + "\n")
        self.process.stdin.flush()
        line = self.process.stdout.readline()
        if not line:
            raise RuntimeError(f"{path}: eigenbody ended with status {self.process.wait()}")
        answer = json.loads(line)
        if "error" in answer:
            raise Refused(answer["error"])
        return answer
