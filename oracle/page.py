"""The page of a humanoid: small, alone, and with the numbers of the JSON.

    python oracle/page.py path/to/eigenbody
"""

import json
import re
import subprocess
import sys
from pathlib import Path

import packages

ROBOTS = ["g1_29dof_rev_1_0.urdf", "g1_29dof_with_hand_rev_1_0.urdf", "icub.urdf", "romeo.urdf"]
LONGEST = 3_000_000  # bytes

NUMBER = re.compile(r'<data id="([^"]+)" value="([^"]+)">')
REQUEST = re.compile(r'<(?:script|link|img|iframe|object|embed|video|audio|source|base)\b|\bsrc=|@import|url\(|href="[^#]')


def check(command: Path, path: Path, form: str) -> str:
    call = [command, "check", path, "--format", form, "--fail-on", "never"]
    return subprocess.run(call, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=True).stdout


def numbers(report: dict) -> dict[str, float]:
    """What the page must have, by its ids."""
    expected = {}
    for worst in report["worst"]:
        expected |= {f"{worst['measure']}-{what}": worst[what] for what in ("worst", "median", "tenth")}
    if digits := report["digits"]:
        expected |= {"predicted-loss": digits["predicted_loss"]}
        expected |= {"left-f32": digits["left_in_f32"], "left-f64": digits["left_in_f64"]}
        for lost in digits["lost"]:
            method = lost["method"].replace(" ", "-")
            expected |= {f"lost-{method}-{kind}": lost[kind] for kind in ("f32", "f64")}
    return {name: value for name, value in expected.items() if value is not None}


def main() -> int:
    if len(sys.argv) != 2:
        print("usage: page.py path/to/eigenbody", file=sys.stderr)
        return 2
    command, failures = Path(sys.argv[1]), 0
    for path in packages.files("example-robot-data", ".urdf"):
        if path.name not in ROBOTS:
            continue
        page, report = check(command, path, "html"), json.loads(check(command, path, "json"))
        shown = {name: float(value) for name, value in NUMBER.findall(page)}
        faults = []
        if shown != numbers(report):
            faults.append("its numbers are not those of the JSON")
        if request := REQUEST.search(page):
            faults.append(f"it asks for something: {request[0]}")
        if len(page.encode()) > LONGEST:
            faults.append(f"longer than {LONGEST} bytes")
        failures += bool(faults)
        verdict = "; ".join(faults) or f"{len(shown)} numbers as in the JSON"
        print(f"{path.name:<34} {len(page.encode()) / 1e6:.2f} MB  {verdict}", flush=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
