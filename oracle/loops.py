"""Closed loops against MuJoCo's constraint Jacobian: MJCF made at random, with connect and weld between bodies, sites and the world.

    python oracle/loops.py path/to/eigenbody

At the q that `matrix --loops closed` answers: MuJoCo's equality rows efc_J must vanish on N and leave no more than N, the loops must be
closed by MuJoCo's own measure efc_pos, and the rows must be N' H N with MuJoCo's H.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import mujoco
import numpy as np

from generated import Maker
from mjcf_reference import MjcfReference

SEEDS = 60
CONFIGURATIONS = ["zero", "random(1)", "random(2)"]
H_TOLERANCE = 1e-10  # of the largest entry of H
ROWS_TOLERANCE = 1e-9  # of the largest entry of efc_J: loops are closed to 1e-11, lengths are below 10
CLOSED = 1e-9  # m, rad: of efc_pos
RANK = 1e-7  # of the largest singular value, or of 1: between what is there and what rounding leaves


class LoopMaker(Maker):
    """A file with loops. Bodies, sites and points are named b1, s1, .. as they are made."""

    def body(self, depth: int, classes: list[str]) -> str:
        site = f'<site name="{self.name("s")}" {self.pose()}/>'
        name = self.name("b")
        contents = f'<geom size="0.1" mass="1" {self.pose()}/>{site}{self.joints(depth)}'
        if depth < 3:
            contents += "".join(self.body(depth + 1, classes) for _ in range(self.random.randint(1, 2)))
        return f'<body name="{name}" {self.pose()}>{contents}</body>\n'

    def file(self) -> str:
        text = super().file()
        bodies = [f"b{k}" for k in range(self.names + 1) if f'"b{k}"' in text]
        sites = [f"s{k}" for k in range(self.names + 1) if f'"s{k}"' in text]
        loops = []
        for _ in range(self.random.randint(1, 2)):
            first, second = self.random.sample(bodies, 2) if len(bodies) > 1 else (bodies[0], "world")
            s, t = self.random.sample(sites, 2) if len(sites) > 1 else (None, None)
            forms = [
                f'<connect body1="{first}" body2="{second}" anchor="{self.numbers(3, -0.3, 0.3)}"/>',
                f'<connect body1="{first}" anchor="{self.numbers(3, -0.3, 0.3)}"/>',
                f'<weld body1="{first}" body2="{second}"/>',
            ]
            if s:
                forms.append(f'<connect site1="{s}" site2="{t}"/>')
            loops.append(self.random.choice(forms))
        return text.replace("</mujoco>", f'<equality>{"".join(loops)}</equality></mujoco>')


def closed(command: Path, path: Path, configuration: str) -> dict | None:
    """What eigenbody answers; nothing if the loops do not close from there."""
    call = [command, "matrix", path, "--at", configuration, "--loops", "closed", "--json"]
    result = subprocess.run(call, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60)
    if result.returncode == 0:
        return json.loads(result.stdout)
    if "stays open by" in result.stderr:
        return None
    raise ValueError(result.stderr.strip())


def differences(answer: dict, reference: MjcfReference) -> tuple[float, float]:
    """Of N' H N, and of efc_J N; raises where the loops are open or N is not all that is left."""
    N = np.array(answer["basis"])
    n, k = N.shape if N.size else (len(answer["joints"]), 0)
    q = answer["q"]
    H = reference.mass_matrix(q)
    T = reference.velocities(q)
    data = reference.data
    equality = data.efc_type == mujoco.mjtConstraint.mjCNSTR_EQUALITY
    rows = data.efc_J[: data.nefc * reference.model.nv].reshape(data.nefc, reference.model.nv)  # room is left behind them
    J = rows[equality] @ T
    apart = np.abs(data.efc_pos[equality]).max(initial=0.0)
    if not apart <= CLOSED:
        raise ValueError(f"open by {apart:.1e}")
    singular = np.linalg.svd(J, compute_uv=False)
    rank = int((singular > RANK * singular.max(initial=1.0)).sum())
    if rank != answer["loops"]["rank"] or k != n - rank:
        raise ValueError(f"rank {answer['loops']['rank']}, MuJoCo's rows have {rank}")
    if k == 0:
        return 0.0, 0.0
    rows = np.array(answer["rows"]).reshape(k, k)
    of_H = np.abs(rows - N.T @ H @ N).max() / np.abs(H).max()
    of_rows = np.abs(J @ N).max(initial=0.0) / max(np.abs(J).max(initial=0.0), 1.0)
    return of_H, of_rows


def main() -> int:
    if len(sys.argv) != 2:
        print("usage: loops.py path/to/eigenbody", file=sys.stderr)
        return 2
    command = Path(sys.argv[1])
    compared, left_open, failures, worst_H, worst_rows = 0, 0, [], 0.0, 0.0
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(SEEDS):
            path = Path(folder) / f"loops_{seed}.xml"
            path.write_text(LoopMaker(seed).file())
            try:
                reference = MjcfReference(path)
            except ValueError:
                continue  # MuJoCo itself does not compile it
            reference.model.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
            for configuration in CONFIGURATIONS:
                try:
                    answer = closed(command, path, configuration)
                    if answer is None:
                        left_open += 1
                        continue
                    of_H, of_rows = differences(answer, reference)
                except ValueError as error:
                    failures.append(f"seed {seed} at {configuration}: {error}")
                    continue
                compared += 1
                worst_H, worst_rows = np.maximum(worst_H, of_H), np.maximum(worst_rows, of_rows)
                if not (of_H <= H_TOLERANCE and of_rows <= ROWS_TOLERANCE):
                    failures.append(f"seed {seed} at {configuration}: N'HN {of_H:.1e}, efc_J N {of_rows:.1e}")
    for failure in failures:
        print(f"  {failure}")
    print(f"loops: {compared} configurations compared, {left_open} do not close from where they start, {len(failures)} failed")
    print(f"largest differences: {worst_H:.1e} of max|H|, {worst_rows:.1e} of max|efc_J|")
    return 1 if failures or compared < SEEDS else 0


if __name__ == "__main__":
    sys.exit(main())
