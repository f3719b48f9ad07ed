"""A float32 simulator that diverges on some robots and not on others: what `eigenbody check` measures on each.

    python oracle/newton.py path/to/eigenbody docs/guide/src/newton.md
"""

import json
import subprocess
import sys
from pathlib import Path

import packages

# Name, file in example-robot-data, its base in a simulation, and what the report says of it.
ROBOTS = (
    ("a1", "a1_description/urdf/a1.urdf", "floating", "stable"),
    ("laikago", "laikago_description/urdf/laikago.urdf", "floating", "stable"),
    ("go1", "go1_description/urdf/go1.urdf", "floating", "stable"),
    ("go2", "go2_description/urdf/go2.urdf", "floating", "stable"),
    ("so100", "so_arm_description/urdf/so100.urdf", "fixed", "diverges"),
    ("so101", "so_arm_description/urdf/so101.urdf", "fixed", "diverges"),
    ("z1", "z1_description/urdf/z1.urdf", "fixed", "diverges"),
    ("g1", "g1_description/urdf/g1_29dof_rev_1_0.urdf", "floating", "diverges"),
)

PAGE = """# A case study: arms that diverge

[newton #4269](https://github.com/newton-physics/newton/issues/4269) reports that a float32 solver of Featherstone's kind, without
contacts and actuation, ends in NaN within 0.3 s on every serial arm and humanoid of a collection, and on no quadruped, while another
solver is stable on all. It is no matter of size: twelve joints of a quadruped go well, six of an arm do not.

What does `eigenbody check` measure on these robots? Quadrupeds and the humanoid on a floating base, arms on a fixed one; the
robot files are those of the Python package example-robot-data 6.0.0, which need not be the very files of the report (its g1 has 23
joints, this one 29; aliengo, b2 and h1 of the report are not in the package). Written by `cargo xtask newton`.

| robot | base | DoFs | κ | κ′ | λmin | λmin at rest | f32 keeps | reported |
|---|---|---|---|---|---|---|---|---|
{rows}

κ, κ′ and λmin (kg m²) are the worst over the joint limits; *at rest* is the pose with all coordinates zero, which need not lie within
the limits. *f32 keeps*: digits of an
acceleration that the worst of three ways of solving keeps in single precision at the worst κ′, measured against double-double.

Does a measure tell the two kinds apart? For one that does, the worst of the stable robots is better than the best of those that
diverge:

| measure | worst of the stable | best of the diverging | tells them apart |
|---|---|---|---|
{verdicts}

{words}

This is a correlation over eight robots, not a cause. Nothing here was run in that solver. A small λmin means that some motion of the
joints has next to no inertia: rounding errors of joint forces are large accelerations there, and whatever stiffness or damping acts
along it, of a solver's own making too, bears small steps only ([time steps and gains](check.md#time-steps-and-gains)): the largest
damping of a joint at a step is 2 λmin/h at worst. `--want-lambda-min 2e-3` says how much armature would lift a robot to where the
quadrupeds are:

| robot | armature for λmin ≥ 2e-3 kg m² | more energy at equal joint rates |
|---|---|---|
{advice}
"""


def ask(command: Path, *options: str | Path) -> dict:
    answer = subprocess.run([command, *options], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120)
    if answer.returncode == 2:
        raise RuntimeError(answer.stderr.strip())
    return json.loads(answer.stdout)


def number(x: float) -> str:
    return f"{x:.2g}" if 0.01 <= x < 1000 else f"{x:.1e}"


def main() -> int:
    command, page = Path(sys.argv[1]), Path(sys.argv[2])
    files = packages.files("example-robot-data", ".urdf")
    rows, found, advice = [], {"κ": {}, "κ′": {}, "λmin": {}, "λmin at rest": {}, "f32 digits": {}}, []
    for name, ending, base, reported in ROBOTS:
        (path,) = [path for path in files if path.as_posix().endswith(f"/{ending}")]
        options = ["--base", base]
        report = ask(command, "check", path, *options, "--format", "json", "--fail-on", "never")
        rest = ask(command, "spectrum", path, *options, "--json")
        worst = {worst["measure"]: worst["worst"] for worst in report["worst"]}
        own = {
            "κ": worst["kappa"],
            "κ′": worst["kappa_weighted"],
            "λmin": worst["lambda_min"],
            "λmin at rest": rest["lambda_min"],
            "f32 digits": report["digits"]["left_in_f32"],
        }
        for measure, value in own.items():
            found[measure].setdefault(reported, []).append((value, name))
        cells = [name, base, str(report["dofs"]), *(number(own[key]) for key in ("κ", "κ′", "λmin", "λmin at rest"))]
        rows.append("| " + " | ".join([*cells, f"{own['f32 digits']:.1f}", reported]) + " |")
        if reported == "diverges":
            options += ["--want-lambda-min", "2e-3", "--format", "json", "--fail-on", "never"]
            wanted = ask(command, "check", path, *options)["advice"]
            added = [(one["joint"], one["added"]) for one in wanted["added"] if one["added"] > 0]
            added.sort(key=lambda one: -one[1])
            some = ", ".join(f"{joint} {number(value)}" for joint, value in added[:3])
            more = f" and {len(added) - 3} more" if len(added) > 3 else ""
            advice.append(f"| {name} | {some}{more} | {100 * wanted['energy']:.2g}% |")
        print(name, flush=True)
    verdicts, apart = [], []
    for measure, kinds in found.items():
        # Small λmin and few digits are bad, large κ and κ′.
        sign = -1 if measure.startswith("κ") else 1
        stable = min(kinds["stable"], key=lambda one: sign * one[0])
        diverging = max(kinds["diverges"], key=lambda one: sign * one[0])
        tells = sign * stable[0] > sign * diverging[0]
        apart.append((measure, tells, stable[0] / diverging[0] if sign > 0 else diverging[0] / stable[0]))
        verdicts.append(
            f"| {measure} | {number(stable[0])} ({stable[1]}) | {number(diverging[0])} ({diverging[1]}) | {'yes' if tells else 'no'} |"
        )
    yes = [f"{measure} (by a factor of {factor:.1f})" for measure, tells, factor in apart if tells and measure != "f32 digits"]
    yes += ["f32 digits" for measure, tells, _ in apart if tells and measure == "f32 digits"]
    no = [measure for measure, tells, _ in apart if not tells]
    words = f"Told apart by: {', '.join(yes) or 'nothing'}. Not by: {', '.join(no) or 'nothing'}."
    text = PAGE.format(
        rows="\n".join(rows), verdicts="\n".join(verdicts), words=words, advice="\n".join(advice)
    )
    page.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
