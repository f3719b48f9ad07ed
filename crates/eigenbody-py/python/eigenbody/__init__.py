"""How well-conditioned is a robot?

The joint-space inertia matrix H(q) of any kinematic tree, its eigenvalues and condition number::

    import eigenbody
    robot = eigenbody.Model("robot.urdf")         # or MJCF, SDF, 'hydra(40,1,0,1)', 'puma560'
    H = robot.mass_matrix(robot.neutral())        # (n, n), kg m²
    print(robot.conditioning("zero"))             # κ, κ', λmin, λmax, and the joints to blame
    print(robot.check())                          # the worst case over all that the joints allow

SI units; spatial vectors are [angular; linear]; quaternions w, x, y, z. What takes one configuration ``(nq,)`` takes a batch
``(k, nq)`` and uses all cores for it.
"""

from eigenbody._eigenbody import Model, Parts, SweepPlan, Tracker, __version__, reproduce
from eigenbody._errors import EigenbodyError, InputError, ModelError, NotPositiveDefiniteError
from eigenbody._layout import Layout
from eigenbody._results import Conditioning, Conditionings, Diagnosis, Finding, Mode, Motion, WorstCase
from eigenbody._sweep import sweep

__all__ = [
    "Conditioning",
    "Conditionings",
    "Diagnosis",
    "EigenbodyError",
    "Finding",
    "InputError",
    "Layout",
    "Mode",
    "Model",
    "ModelError",
    "Motion",
    "NotPositiveDefiniteError",
    "Parts",
    "SweepPlan",
    "Tracker",
    "WorstCase",
    "__version__",
    "reproduce",
    "sweep",
]
