"""What `eigenbody check` says of every robot of some packages: docs/survey.md.

    python oracle/survey.py path/to/eigenbody docs/survey.md
"""

import json
import math
import subprocess
import sys
import time
from pathlib import Path

import packages

PACKAGES = {"example-robot-data": "URDF", "dm-control": "MJCF", "robosuite": "MJCF"}
SECONDS = 60
F32_DIGITS = 7.22

HEAD = """# Survey

What `eigenbody check` finds over the joint limits of robots that others have published, on their own base, mimic joints following as
in each file's own engine. Written by `cargo xtask survey`. Files that do not load by themselves, as their own engines do not either,
and those without joints are left out.

- **κ**, **κ′**, **λmin**: the worst found. λmin is in kg m², or in mixed units where some joints are prismatic.
- **softest motion**: at the worst κ′, the joints that have nine tenths of it, and how it comes about: a *light tip*, two joints that
  *cancel*, or *many* joints.
- **verdict**: the findings, if any; `f32` stands for "not float32-safe".
"""

WORDS = {"light-tip": "light tip", "opposition": "cancel", "spread": "many"}
SHORT = {"single-precision": "f32", "moves-no-mass": "**moves no mass**"}


def number(x: float | None, none: str) -> str:
    return none if x is None else f"{x:.1e}"


def motion(report: dict) -> str:
    if report["null_motions"]:
        joints = sorted({rate["joint"] for motion in report["null_motions"] for rate in motion})
        return ", ".join(joints[:4]) + (" .." if len(joints) > 4 else "")
    worst = next((worst for worst in report["worst"] if worst["measure"] == "kappa_weighted"), None)
    if worst is None or worst["mechanism"] is None:
        return "–"
    names, share = [], 0.0
    for rate in worst["softest"]:
        if share >= 0.9 or len(names) == 2:
            break
        names.append(rate["joint"])
        share += rate["share"]
    more = "" if share >= 0.9 else " .."
    return f"{', '.join(names)}{more} ({WORDS[worst['mechanism']['kind']]})"


def row(name: str, report: dict) -> str:
    worst = {worst["measure"]: worst["worst"] for worst in report["worst"]}
    verdict = ", ".join(SHORT.get(finding["id"], finding["id"]) for finding in report["findings"]) or "fine"
    cells = [
        name,
        str(report["dofs"]),
        number(worst.get("kappa"), "∞" if worst else "–"),
        number(worst.get("kappa_weighted"), "∞" if worst else "–"),
        number(worst.get("lambda_min"), "–"),
        motion(report),
        verdict,
    ]
    return "| " + " | ".join(cells) + " |"


def near(report: dict) -> list[bool]:
    """Whether the prediction is within one digit of what f32 loses, for every way of solving with factors of H."""
    digits = report["digits"]
    if digits is None:
        return []
    lost = [way["f32"] for way in digits["lost"] if way["method"].startswith("H by CRBA")]
    # A failure loses them all.
    lost = [F32_DIGITS if x is None else min(x, F32_DIGITS) for x in lost]
    return [abs(min(digits["predicted_loss"], F32_DIGITS) - x) <= 1 for x in lost]


def main() -> int:
    command, page = Path(sys.argv[1]), Path(sys.argv[2])
    text, slowest, failures, predicted = HEAD, (0.0, ""), 0, []
    for package, kind in PACKAGES.items():
        files = packages.files(package, ".urdf") if kind == "URDF" else list(packages.mjcf(package))
        text += f"\n## {package} ({kind})\n\n| model | DoFs | κ | κ′ | λmin | softest motion | verdict |\n|---|---|---|---|---|---|---|\n"
        for path in files:
            call = [command, "check", path, "--format", "json", "--fail-on", "never"]
            start = time.perf_counter()
            answer = subprocess.run(call, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=SECONDS)
            seconds = time.perf_counter() - start
            name = packages.short(path, package)
            if answer.returncode == 2:
                # Includes and parts of models: their own engines refuse them too.
                continue
            if answer.returncode != 0:
                failures += 1
                print(f"{name}: exit status {answer.returncode}: {answer.stderr.strip()}")
                continue
            report = json.loads(answer.stdout)
            if report["dofs"] == 0:
                continue
            if report["dofs"] <= 50:
                slowest = max(slowest, (seconds, name))
            if ways := near(report):
                predicted.append(all(ways))
            text += row(name, report) + "\n"
        print(package, flush=True)
    text += f"\nThe slowest with at most 50 degrees of freedom: {slowest[1]}, {slowest[0]:.1f} s.\n"
    text += (
        "\nDigits that f32 loses with factors of H, measured at the worst κ′, are within one of the predicted log₁₀ (κ′/4) "
        f"for {sum(predicted)} of {len(predicted)} models with an H that is not singular there.\n"
    )
    page.write_text(text, encoding="utf-8")
    return 1 if failures or not math.isfinite(slowest[0]) else 0


if __name__ == "__main__":
    sys.exit(main())
