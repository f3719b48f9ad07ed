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
DIGITS = {"f32": 7.22, "f64": 15.95}
WAYS = {"H by CRBA": "factors of H", "articulated bodies": "the articulated-body algorithm"}

HEAD = """# Survey

What `eigenbody check` finds over the joint limits of robots that others have published, on their own base, mimic joints following as
in each file's own engine. Written by `cargo xtask survey`. Files that do not load by themselves, as their own engines do not either,
and those without joints are left out.

- **κ**, **κ′**, **λmin**: the worst found. λmin is in kg m², or in mixed units where some joints are prismatic.
- **softest motion**: at the worst κ′, the joints that have nine tenths of it, and how it comes about: a *light tip*, two joints that
  *cancel*, or *many* joints.
- **largest step**: stable everywhere, with the stiffness, damping and feedback of the file: by the integrator of an MJCF file, in
  parentheses its own step where that is longer; by semi-implicit Euler for URDF, where a file gives damping.
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


def step(report: dict) -> str:
    found = report["stepping"]
    own = [limit for limit in found["limits"] if limit["integrator"] == found["integrator"]] if found else []
    if not own:
        return "–"
    largest = own[0]["largest"]
    if largest is None:
        return "any"
    too_long = found["step"] is not None and found["step"] > largest
    return f"{largest:.1e} s" + (f" (own: {found['step']:g} s)" if too_long else "")


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
        step(report),
        verdict,
    ]
    return "| " + " | ".join(cells) + " |"


def apart(report: dict, precision: str, method: str) -> list[float]:
    """Digits that some ways of solving lose, less the digits that were predicted."""
    digits = report["digits"]
    if digits is None:
        return []
    all_there_are = DIGITS[precision]
    ways = [(way[precision], way["predicted"]) for way in digits["lost"] if way["method"].startswith(method)]
    # A failure loses them all.
    lost = [(all_there_are if x is None else min(x, all_there_are), predicted) for x, predicted in ways]
    return [x - min(predicted, all_there_are) for x, predicted in lost]


def main() -> int:
    command, page = Path(sys.argv[1]), Path(sys.argv[2])
    text, slowest, failures = HEAD, (0.0, ""), 0
    predicted = {(precision, way): [] for precision in DIGITS for way in WAYS}
    for package, kind in PACKAGES.items():
        files = packages.files(package, ".urdf") if kind == "URDF" else list(packages.mjcf(package))
        text += f"\n## {package} ({kind})\n\n| model | DoFs | κ | κ′ | λmin | softest motion | largest step | verdict |\n|---|---|---|---|---|---|---|---|\n"
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
            for (precision, way), all_models in predicted.items():
                if lost := apart(report, precision, way):
                    all_models.append(lost)
            text += row(name, report) + "\n"
        print(package, flush=True)
    text += f"\nThe slowest with at most 50 degrees of freedom: {slowest[1]}, {slowest[0]:.1f} s.\n"
    text += (
        "\nDigits lost, measured at the worst κ′ and held against the prediction, where H is not singular: log₁₀ (κ′/4) with factors of H, "
        "log₁₀ (e/6ε) with articulated bodies, e the error estimate of λ′min:\n\n"
        "| | models | within one digit | more than one digit worse |\n|---|---|---|---|\n"
    )
    for (precision, way), all_models in predicted.items():
        near = sum(all(abs(x) <= 1 for x in lost) for lost in all_models)
        worse = sum(any(x > 1 for x in lost) for lost in all_models)
        text += f"| {precision}, {WAYS[way]} | {len(all_models)} | {near} | {worse} |\n"
    page.write_text(text, encoding="utf-8")
    return 1 if failures or not math.isfinite(slowest[0]) else 0


if __name__ == "__main__":
    sys.exit(main())
