"""Reference rows for families of robots: both ends of the spectrum, kappa and kappa', in ball arithmetic.

    python oracle/families.py > crates/eigenbody/tests/data/further.json

The families are those of Featherstone (2004), section 3, written here from the paper: links in the world's frame, composite
inertias about the world's origin, H_jk = s_j . I_k s_k. Decimals are exact decimals. Takes some minutes.
"""

import json
import math
import sys
from dataclasses import asdict, dataclass

from flint import arb, ctx

from spatial import Matrix, Vector, cross, dot, plus, spatial_inertia, times, transposed, turn_x, turn_z
from spectrum import ends

ctx.prec = 1400
PRINTED = 20

@dataclass(frozen=True)
class Robot:
    kind: str
    n: int
    branching: str
    skew: str
    taper: str
    posture: str
    theta: str
    floating: bool = False


def exact(text: str) -> arb:
    """A decimal, or `pi*` a decimal."""
    factor = text.removeprefix("pi*")
    whole, _, fraction = factor.partition(".")
    value = arb(int(whole + fraction)) / arb(10) ** len(fraction)
    return value * arb.pi() if factor != text else value


def along_x(origin: Vector, R: Matrix, length: arb) -> Vector:
    return [p + row[0] * length for p, row in zip(origin, R, strict=True)]


def own_inertia(robot: Robot, size: arb) -> tuple[arb, Vector]:
    """Where a link's centre of mass is along x, and its moments of inertia about it."""
    if robot.kind == "onion":
        return arb(0), [size**5] * 3
    across = arb(1015) / 12000
    return size / 2, [moment * size**5 for moment in (arb(25) / 10000, across, across)]


def mass_matrix(robot: Robot) -> Matrix:
    """H, or H* of the robot without its first joint."""
    n, B = robot.n, float(robot.branching)
    skew, taper, theta = exact(robot.skew), exact(robot.taper), exact(robot.theta)
    parents, rotations, origins, axes, composites = [], [], [], [], []
    for i in range(1, n + 1):
        parent = math.floor((i - 2 + math.ceil(B)) / B) - 1
        R = turn_z(-theta if robot.posture == "zag" and i % 2 == 0 else theta)
        origin = [arb(0)] * 3
        if parent >= 0:
            R = times(times(rotations[parent], turn_x(skew)), R)
            length = taper**parent if robot.kind == "hydra" else arb(0)
            origin = along_x(origins[parent], rotations[parent], length)
        size = taper ** (i - 1)
        c, moments = own_inertia(robot, size)
        turned = [[x * moment for x, moment in zip(row, moments, strict=True)] for row in R]
        z = [row[2] for row in R]
        parents.append(parent)
        rotations.append(R)
        origins.append(origin)
        axes.append(z + [dot(row, z) for row in cross(origin)])
        composites.append(spatial_inertia(size**3, along_x(origin, R, c), times(turned, transposed(R))))
    for i in reversed(range(1, n)):
        composites[parents[i]] = plus(composites[parents[i]], composites[i])
    momenta = [[dot(row, s) for row in I] for I, s in zip(composites, axes, strict=True)]
    H = [[arb(0)] * n for _ in range(n)]
    for k in range(n):
        j = k
        while j >= 0:
            H[j][k] = H[k][j] = dot(axes[j], momenta[k])
            j = parents[j]
    return without_base(H, composites[0], momenta) if robot.floating else H


def without_base(H: Matrix, base: Matrix, momenta: list[Vector]) -> Matrix:
    """Schur's complement of the base's six columns; joint 1 is gone."""
    rows = [base[i] + [momentum[i] for momentum in momenta[1:]] for i in range(6)]
    rows += [momenta[d] + H[d][1:] for d in range(1, len(H))]
    for k in range(6):
        for i in range(k + 1, len(rows)):
            ratio = rows[i][k] / rows[k][k]
            rows[i] = [a - ratio * b for a, b in zip(rows[i], rows[k], strict=True)]
    return [row[6:] for row in rows[6:]]


def row(robot: Robot) -> dict:
    H = mass_matrix(robot)
    n = len(H)
    least, greatest = ends(H)
    diagonal = sorted((H[i][i] for i in range(n)), key=lambda x: x.mid())
    unit = [1 / H[i][i].sqrt() for i in range(n)]
    own = ends([[unit[i] * H[i][j] * unit[j] for j in range(n)] for i in range(n)])
    figures = {
        "lambda_min": least,
        "lambda_max": greatest,
        "kappa": greatest / least,
        "kappa_weighted": own[1] / own[0],
        "diagonal_ratio": diagonal[-1] / diagonal[0],
    }
    texts = {name: x.mid().str(PRINTED, radius=False) for name, x in figures.items()}
    return asdict(robot) | {"size_ratio": None} | texts


def chain(n: int, taper: str, posture: str, theta: str, skew: str = "0", floating: bool = False) -> Robot:
    return Robot("hydra", n, "1", skew, taper, posture, theta, floating)


ROBOTS = [
    # Tapered up and down, far past what f64 resolves in H.
    chain(12, "10", "zag", "0"),
    chain(12, "10", "curl", "0.5"),
    chain(30, "1.5", "zag", "0"),
    chain(30, "1.5", "zag", "pi*0.5"),
    chain(24, "0.7", "curl", "0.25"),
    chain(40, "0.5", "zag", "1.5"),
    chain(60, "0.95", "zag", "2.75"),
    chain(60, "1.05", "curl", "0.125", skew="0.5"),
    # Long and level: kappa grows as the fourth power.
    chain(150, "1", "zag", "0"),
    chain(120, "1", "zag", "3"),
    chain(100, "1", "curl", "0.03125", skew="0.25"),
    # Branched and skewed.
    Robot("hydra", 60, "2", "0.5", "0.9", "zag", "0.5"),
    Robot("hydra", 60, "1.5", "1.25", "1.1", "zag", "2.5"),
    Robot("hydra", 80, "3", "0.25", "1", "curl", "0.75"),
    Robot("hydra", 45, "1.125", "0.75", "0.7", "zag", "1"),
    Robot("hydra", 40, "4", "1", "2", "curl", "1.5"),
    Robot("onion", 60, "1", "0.25", "0.8", "zag", "0.5"),
    Robot("onion", 50, "1.5", "1", "1.25", "curl", "0.375"),
    Robot("onion", 65, "64", "0.5", "1", "zag", "1"),
    # Free-floating.
    chain(3, "10", "zag", "0", floating=True),
    chain(3, "10", "zag", "pi*0.5", floating=True),
    chain(12, "10", "zag", "0.5", floating=True),
    chain(30, "1.5", "curl", "0.25", floating=True),
    chain(30, "0.7", "zag", "0", floating=True),
    chain(60, "1", "zag", "2.875", floating=True),
    chain(80, "1", "curl", "0.0625", skew="0.5", floating=True),
    Robot("hydra", 60, "2", "0.5", "0.9", "zag", "0.5", floating=True),
    Robot("hydra", 40, "1.5", "1", "1.5", "zag", "1.25", floating=True),
]


def main() -> int:
    rows = []
    for robot in ROBOTS:
        rows.append(row(robot))
        print(robot, rows[-1]["kappa"], file=sys.stderr, flush=True)
    print("[\n" + ",\n".join(json.dumps(row) for row in rows) + "\n]")
    return 0


if __name__ == "__main__":
    sys.exit(main())
