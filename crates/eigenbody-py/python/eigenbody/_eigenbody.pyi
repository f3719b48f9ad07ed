"""The native half: arrays in, arrays out."""

import os
import pathlib
from collections.abc import Mapping, Sequence
from typing import Any, Literal, TypeAlias, final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from eigenbody._results import Conditioning, Conditionings, Diagnosis, Motion, WorstCase

__all__ = ["Examination", "Model", "Parts", "SweepPlan", "Tracker", "__version__", "reproduce"]
__version__: str

_Floats: TypeAlias = NDArray[np.float64]
# float64, or float32 if all arrays that were given are float32: dynamics.
_Numbers: TypeAlias = NDArray[Any]
_Base: TypeAlias = Literal["fixed", "floating"]
_Path: TypeAlias = str | os.PathLike[str]
_Method: TypeAlias = Literal["auto", "dense", "sturm"]
_Precision: TypeAlias = Literal["auto", "f64", "dd"]
# A number for every joint, a text as the command line takes it, numbers by joint, or one a degree of freedom.
_Gains: TypeAlias = float | str | Mapping[str, float] | ArrayLike
# A file as the command line takes it, or times (k,) and rows (k, n).
_Table: TypeAlias = _Path | tuple[ArrayLike, ArrayLike]

@final
class Parts:
    """A robot given link by link, joints in the order of their degrees of freedom: `Model(parts)` builds it."""

    def __new__(cls, name: str, /, *, gravity: ArrayLike = ...) -> Parts: ...
    def link(
        self,
        name: str,
        /,
        *,
        mass: float = 0.0,
        com: ArrayLike = ...,
        inertia: ArrayLike = ...,
    ) -> int:
        """Adds a link; its number. Mass in kg, centre of mass in m, inertia (3, 3), symmetric, about it in kg m², in the link's axes."""

    def joint(
        self,
        name: str,
        kind: str,
        /,
        *,
        parent: int,
        child: int,
        rotation: ArrayLike = ...,
        position: ArrayLike = ...,
        axis: ArrayLike = ...,
        armature: ArrayLike = ...,
        limits: tuple[float, float] | None = None,
        stiffness: float = 0.0,
        damping: ArrayLike = ...,
    ) -> int:
        """Adds a joint between two links; its number.

        `kind`: fixed, revolute, continuous, prismatic, cylindrical, planar, spherical or floating. `rotation` (3, 3) and `position`
        (m) place the joint's frame, which is the child's, in the parent's. `armature` and `damping` have one number a degree of
        freedom; `stiffness` is that of each, slack at zero. Springs and dampers count in `check` and `simulate`.
        """

    def note(self, text: str, /) -> None:
        """Adds a remark to the model's `findings`."""

@final
class Model:
    """A robot: a tree of rigid bodies and joints.

    `model` is a URDF, MJCF or SDF file, `puma560`, a family such as ``'hydra(40,1,0,1)'``, or `Parts`. `mimic`: mimic joints follow
    (None: as the command line); `reduced`: a floating base is removed, H is H*; `rotors`: rotor inertia of URDF transmissions
    counts. Raises ModelError with file, line and column.

    Every function of q takes ``(nq,)`` or a batch ``(k, nq)``; a single row stands in for every row of a batch; `out` takes
    the result. If all arrays are float32, dynamics are computed and given in it; spectra are always float64.
    """

    def __new__(
        cls, model: _Path | Parts, /, *, base: _Base = "fixed", mimic: bool | None = None, reduced: bool = False, rotors: bool = False
    ) -> Model: ...
    @staticmethod
    def from_urdf(
        path: _Path, /, *, base: _Base = "fixed", mimic: bool | None = None, reduced: bool = False, rotors: bool = False
    ) -> Model:
        """A URDF file."""

    @staticmethod
    def from_mjcf(path: _Path, /, *, base: _Base = "fixed", mimic: bool | None = None, reduced: bool = False) -> Model:
        """An MJCF file."""

    @staticmethod
    def from_sdf(path: _Path, /, *, base: _Base = "fixed", mimic: bool | None = None, reduced: bool = False) -> Model:
        """An SDF file."""

    @staticmethod
    def hydra(n: int, /, branching: float = 1.0, skew: float = 0.0, taper: float = 1.0, *, base: _Base = "fixed") -> Model:
        """Featherstone's hydra: n tubes of 1 m and 1 kg, each `taper` times as large as its parent."""

    @staticmethod
    def onion(n: int, /, branching: float = 1.0, skew: float = 0.0, taper: float = 1.0, *, base: _Base = "fixed") -> Model:
        """Featherstone's onion: hydra with all joints in one place."""

    @staticmethod
    def auto_tree(n: int, /, branching: float = 1.0, skew: float = 0.0, taper: float = 1.0, *, base: _Base = "fixed") -> Model:
        """Hydra's links with joints of every kind."""

    @staticmethod
    def chain(n: int, /, *, mass: float = 1.0, length: float = 1.0) -> Model:
        """n slender rods, horizontal at q = 0."""

    @staticmethod
    def puma560() -> Model:
        """The PUMA 560."""

    @staticmethod
    def from_pinocchio(model: Any, /) -> Model:
        """A live `pinocchio.Model`: joints in its order. Coordinates are ours; see `Layout`."""

    @staticmethod
    def from_mujoco(model: Any, /) -> Model:
        """A live `mujoco.MjModel`: joints in its order, with stiffness and damping. Coordinates are ours; see `Layout`.

        Actuators, tendons, keyframes and the time step are left out; `findings` says so.
        """

    def __reduce__(self) -> tuple[Any, ...]: ...
    def __copy__(self) -> Model: ...
    def __deepcopy__(self, memo: Any, /) -> Model: ...
    @property
    def name(self) -> str:
        """What it was made of."""

    @property
    def nq(self) -> int:
        """Numbers in q."""

    @property
    def nv(self) -> int:
        """Degrees of freedom: numbers in v."""

    @property
    def nbodies(self) -> int:
        """Moving bodies."""

    @property
    def has_floating_base(self) -> bool:
        """The first joint is a floating base."""

    @property
    def dof_names(self) -> list[str]:
        """One name a row of H."""

    @property
    def link_names(self) -> list[str]:
        """All links, merged ones included."""

    @property
    def joints(self) -> list[tuple[str, str, int, int]]:
        """Name, kind, first coordinate and first degree of freedom of every moving joint, among all of them."""

    @property
    def limits(self) -> _Floats:
        """(2, nq): lower and upper limits, infinite where there is none."""

    @property
    def armature(self) -> _Floats:
        """Rotor inertia reflected to each degree of freedom (kg m², kg), those of mimic joints and a floating base included."""

    @property
    def gravity(self) -> _Floats:
        """(3,): m/s²."""

    @property
    def findings(self) -> list[str]:
        """What is suspicious about the model, with file and line."""

    @property
    def keyframes(self) -> dict[str, _Floats]:
        """Configurations that the file names."""

    def neutral(self) -> _Floats:
        """(nq,): zero, quaternions the identity."""

    def random(self, seed: int = 1, count: int | None = None) -> _Floats:
        """A random configuration within limits, (nq,), or `count` of them, (count, nq): of seeds seed, seed + 1, .."""

    def configuration(self, text: str, /) -> _Floats:
        """What the command line's `--at` takes: 'zag(pi/2)', 'elbow=0.3', 'random(7)', a keyframe's name."""

    def with_armature(self, armature: ArrayLike, /) -> Model:
        """The same with other armature, one number for each that `armature` has."""

    def with_gravity(self, gravity: ArrayLike, /) -> Model:
        """The same with other gravity, (3,), m/s²."""

    def to_urdf(self, *, rotors: bool = False) -> str:
        """As URDF, fixed joints merged; `rotors`: armature as rotors of transmissions, which `Model(.., rotors=True)` reads."""

    def patched(self) -> str:
        """The text of the URDF or MJCF file that it was read from, with what was changed since and all else as it stands there. Armature
        of URDF is added as rotors of transmissions, which `Model(.., rotors=True)` reads."""

    def to_mjcf(self) -> str:
        """As MJCF, fixed joints merged."""

    def mass_matrix(self, q: ArrayLike, /, *, out: _Numbers | None = None) -> _Numbers:
        """H(q): (n, n) or (k, n, n), both triangles; by composite rigid bodies."""

    def crba(self, q: ArrayLike, /, *, out: _Numbers | None = None) -> _Numbers:
        """`mass_matrix`."""

    def inverse_dynamics(self, q: ArrayLike, v: ArrayLike, a: ArrayLike, /, *, out: _Numbers | None = None) -> _Numbers:
        """τ = H a + C: (nv,) or (k, nv); by recursive Newton-Euler. Where mimic joints follow, of the independent ones: Gᵀ (H G a + C)."""

    def rnea(self, q: ArrayLike, v: ArrayLike, a: ArrayLike, /, *, out: _Numbers | None = None) -> _Numbers:
        """`inverse_dynamics`."""

    def forward_dynamics(self, q: ArrayLike, v: ArrayLike, tau: ArrayLike, /, *, out: _Numbers | None = None) -> _Numbers:
        """a = H⁻¹ (τ − C): (nv,) or (k, nv); by articulated bodies. Where mimic joints follow, (GᵀHG)⁻¹ (τ − GᵀC), by Cholesky."""

    def aba(self, q: ArrayLike, v: ArrayLike, tau: ArrayLike, /, *, out: _Numbers | None = None) -> _Numbers:
        """`forward_dynamics`."""

    def bias_force(self, q: ArrayLike, v: ArrayLike, /, *, out: _Numbers | None = None) -> _Numbers:
        """C(q, v): gravity, Coriolis and centrifugal forces; (nv,) or (k, nv)."""

    def gravity_force(self, q: ArrayLike, /, *, out: _Numbers | None = None) -> _Numbers:
        """C(q, 0): (nv,) or (k, nv)."""

    def spectrum(self, q: ArrayLike, /, *, metric: str = "euclidean", out: _Floats | None = None) -> _Floats:
        """All eigenvalues of H x = λ B x, ascending: (n,) or (k, n)."""

    def extremes(self, q: ArrayLike, /, *, metric: str = "euclidean", accuracy: float = 1e-8, out: _Floats | None = None) -> _Floats:
        """λmin and λmax: (2,) or (k, 2); NaN where λmin cannot be told from zero.

        Rows of a batch are computed side by side, λmin to a relative `accuracy`; 0 computes each as if it were alone, digit for
        digit, at several times the cost.
        """

    @overload
    def kappa(self, q: ArrayLike, /, *, metric: str = "euclidean", accuracy: float = 1e-8, out: _Floats) -> _Floats: ...
    @overload
    def kappa(self, q: ArrayLike, /, *, metric: str = "euclidean", accuracy: float = 1e-8, out: None = None) -> Any:
        """κ: a number, or (k,); with ``metric="unit-diagonal"`` κ′. NaN where λmin cannot be told from zero. `accuracy`: see `extremes`."""

    @overload
    def conditioning(
        self,
        q: str | None = None,
        /,
        *,
        metric: str = "euclidean",
        method: _Method = "auto",
        precision: _Precision = "auto",
        all: bool = False,
    ) -> Conditioning:
        """κ, κ′, bracket and modes: a `Conditioning`, or `Conditionings` of a batch. None: zero. `all`: all eigenvalues too."""

    @overload
    def conditioning(
        self,
        q: ArrayLike,
        /,
        *,
        metric: str = "euclidean",
        method: _Method = "auto",
        precision: _Precision = "auto",
        all: bool = False,
    ) -> Any: ...
    def check(
        self,
        *,
        metric: str = "euclidean",
        samples: int = 2048,
        seed: int = 1,
        max_kappa_weighted: float | None = None,
        max_kappa: float | None = None,
        f32_digits: float | None = None,
        kp: _Gains | None = None,
        kd: _Gains | None = None,
        step: float | None = None,
        integrator: Literal["semi-implicit", "damped", "implicit", "rk4"] | None = None,
        want_kappa: float | None = None,
        want_lambda_min: float | None = None,
        want_step: float | None = None,
        baseline: Diagnosis | dict[str, Any] | _Path | None = None,
    ) -> Diagnosis:
        """What is wrong over all that the joints allow: as `eigenbody check`, whose options these are; `step` is its `--dt`.

        `kp`, `kd`: gains in place of those of the file's actuators. One of the `want_` options asks for advice: the least armature
        with which κ is at most, λmin at least, or a step stable everywhere. `baseline`: an earlier `Diagnosis`, or its JSON.
        """

    def simulate(
        self,
        time: float = 10.0,
        *,
        rate: float = 100.0,
        q: str | ArrayLike | None = None,
        v: str | ArrayLike | None = None,
        method: Literal["euler", "rk4", "dopri5", "midpoint"] = ...,
        step: float = 1e-3,
        tolerance: float = 1e-9,
        dynamics: Literal["aba", "crba"] = ...,
        gravity: bool = True,
        springs: bool = True,
        damping: _Gains | None = None,
        stiffness: _Gains | None = None,
        rest: str | ArrayLike | None = None,
        hold: str | ArrayLike | None = None,
        follow: _Table | None = None,
        bandwidth: float = 2.0,
        damping_ratio: float = 1.0,
        kp: _Gains | None = None,
        kd: _Gains | None = None,
        torque: _Table | None = None,
        monitors: Sequence[str] = ...,
        events: Sequence[str] = ...,
    ) -> Motion:
        """Moves for `time` seconds from (q, v) and gives `rate` rows a second: as `eigenbody simulate`, whose options these are.

        `method`: "dopri5" (if left out) takes steps by its `tolerance`, the others fixed ones of `step` seconds. `springs`: those of
        the file; `damping` and `stiffness` add more, slack at `rest`. A controller pulls to the posture `hold` or along `follow`,
        with gains for `bandwidth` (Hz) and `damping_ratio`, or `kp` and `kd`. `torque`: forces over time. `monitors`: kappa,
        kappa_weighted (these if left out), lambda_min, lambda_max, modes, diagonal_ratio, scaled_diagonal_ratio, pivot_ratio,
        bracket, eigenvalues, energy, momentum. `events`: crossings to report, as "kappa=1e5". Ctrl-C is heard.
        """

    def worst_case(self, *, metric: str = "euclidean", samples: int = 2048, seed: int = 1) -> dict[str, WorstCase]:
        """The worst configuration by `kappa`, `kappa_weighted` and `lambda_min`."""

    def _repr_html_(self) -> str: ...

@final
class Examination:
    """What a `Diagnosis` was made from."""

    def to_json(self) -> str:
        """What `eigenbody check --format json` prints."""

    def to_sarif(self) -> str:
        """What `eigenbody check --format sarif` prints."""

    def to_text(self) -> str:
        """What `eigenbody check` prints."""

    def to_html(self) -> str:
        """What `eigenbody report` writes."""

    def mended(self, change: str = "armature", /) -> Model:
        """The robot with what was advised."""

@final
class Tracker:
    """λmin and λmax along a motion, exact, at about one factorisation a step. Starts at q."""

    def __new__(cls, model: Model, q: ArrayLike, /, *, metric: str = "euclidean") -> Tracker: ...
    def update(self, q: ArrayLike, /) -> _Floats:
        """λmin and λmax at the next q, (2,), or at each row of a batch in turn, (k, 2)."""

    @property
    def softest(self) -> _Floats:
        """The latest mode of λmin, (nv,)."""

    @property
    def stiffest(self) -> _Floats:
        """The latest mode of λmax, (nv,)."""

@final
class SweepPlan:
    """The numbered cases of a sweep's text (TOML), in chunks that may be computed anywhere and in any order.

    Paths in the text are seen from `folder`, or from the current one.
    """

    def __new__(cls, text: str, /, folder: _Path = ...) -> SweepPlan: ...
    @property
    def cases(self) -> int:
        """Number of rows."""

    @property
    def chunks(self) -> int:
        """Number of chunks."""

    @property
    def fingerprint(self) -> str:
        """Of everything that a row depends on: spec, robots, version."""

    def compute(self, number: int, /) -> bytes:
        """The rows of a chunk, on one thread."""

    def missing(self, output: _Path, /) -> list[int]:
        """Chunks that a folder does not hold; makes the folder."""

    def keep(self, output: _Path, number: int, text: bytes, /) -> None:
        """Puts a chunk's rows into a folder, whole."""

    def merge(self, output: _Path, /) -> pathlib.Path:
        """Makes the table of a folder that holds every chunk."""

def reproduce(*ids: str, quick: bool = False) -> list[dict[str, Any]]:
    """The claims of Featherstone (2004) and Shah & Saha (2013), printed against computed; all, or those named."""
