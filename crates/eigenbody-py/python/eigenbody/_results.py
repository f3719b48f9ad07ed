"""Results as small typed objects: they print well, become dictionaries, and plot themselves where matplotlib is installed.

Each is equal to itself alone: arrays have no one answer to ==. Numbers are compared as `to_dict()`.
"""

from __future__ import annotations

import html
import json
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from eigenbody._errors import InputError

if TYPE_CHECKING:
    from eigenbody._eigenbody import Examination, Model

Floats = NDArray[np.float64]

# Okabe and Ito's colours: told apart by the colour-blind.
BLUE, ORANGE = "#0072B2", "#D55E00"
SHOWN = 6  # entries of a mode that are printed
MEASURES = {"kappa": "κ", "kappa_weighted": "κ′", "lambda_min": "λmin"}


def _number(x: float | None, unit: str = "") -> str:
    return "–" if x is None or np.isnan(x) else f"{x:.6g} {unit}".rstrip()


def _html(title: str, rows: list[tuple[str, str]]) -> str:
    body = "".join(f"<tr><th scope='row' style='text-align:left'>{html.escape(a)}</th><td style='text-align:left'>{html.escape(b)}</td></tr>" for a, b in rows)
    return f"<table><caption style='text-align:left;font-weight:bold'>{html.escape(title)}</caption>{body}</table>"


def _text(title: str, rows: list[tuple[str, str]]) -> str:
    width = max((len(name) for name, _ in rows), default=0)
    return "\n".join([title, *(f"  {name:<{width}}  {value}" for name, value in rows)])


@dataclass(frozen=True, eq=False)
class Mode:
    """An eigenvector of H x = λ B x over the degrees of freedom, xᵀ B x = 1, and each one's share of it."""

    vector: Floats
    share: Floats
    joints: tuple[str, ...]

    def __str__(self) -> str:
        order = np.argsort(-self.share, kind="stable")[:SHOWN]
        parts = [f"{self.joints[i]} {self.share[i]:.1%}" for i in order if self.share[i] >= 5e-4]
        more = len(self.joints) - len(parts)
        return ", ".join(parts) + (f" and {more} more" if more > 0 else "")


def _mode(found: dict[str, Any] | None) -> Mode | None:
    if found is None:
        return None
    return Mode(np.array(found["vector"]), np.array(found["share"]), tuple(found["joints"]))


@dataclass(frozen=True, eq=False)
class Conditioning:
    """κ and what belongs to it, of one robot in one configuration. None: the number does not exist, and `note` says why."""

    kappa: float | None
    kappa_weighted: float | None
    lambda_min: float | None
    lambda_max: float | None
    diagonal_ratio: float | None
    bracket: tuple[float, float] | None
    error_estimate: tuple[float | None, float | None]
    softest: Mode | None
    stiffest: Mode | None
    eigenvalues: Floats | None
    unit: str
    method: str
    note: str | None
    _dict: dict[str, Any] = field(repr=False, compare=False)

    @classmethod
    def _of_json(cls, text: str) -> Conditioning:
        found = json.loads(text)
        bracket, error, values = found["bracket"], found["error_estimate"], found.get("eigenvalues")
        return cls(
            kappa=found["kappa"],
            kappa_weighted=found["kappa_weighted"],
            lambda_min=found["lambda_min"],
            lambda_max=found["lambda_max"],
            diagonal_ratio=found["diagonal_ratio"],
            bracket=None if bracket is None else (bracket[0], bracket[1]),
            error_estimate=(error["lambda_min"], error["lambda_max"]),
            softest=_mode(found["softest"]),
            stiffest=_mode(found["stiffest"]),
            eigenvalues=None if values is None else np.array(values),
            unit=found["unit"],
            method=found["method"],
            note=found.get("note"),
            _dict=found,
        )

    def to_dict(self) -> dict[str, Any]:
        """What `eigenbody spectrum --json` prints."""
        return json.loads(json.dumps(self._dict))  # type: ignore[no-any-return]

    def _rows(self) -> list[tuple[str, str]]:
        rows = [
            ("κ", _number(self.kappa)),
            ("κ′", _number(self.kappa_weighted)),
            ("λmin", _number(self.lambda_min, self.unit)),
            ("λmax", _number(self.lambda_max, self.unit)),
            ("softest", str(self.softest) if self.softest else "–"),
            ("stiffest", str(self.stiffest) if self.stiffest else "–"),
        ]
        return rows + ([("note", self.note)] if self.note else [])

    def _title(self) -> str:
        return f"{self._dict['model']} at {self._dict['configuration']}: {self._dict['dofs']} DoFs, {self._dict['base']} base"

    def __repr__(self) -> str:
        return _text(self._title(), self._rows())

    def _repr_html_(self) -> str:
        return _html(self._title(), self._rows())

    def plot(self, ax: Any = None) -> Any:
        """The shares of the softest and stiffest mode, as bars on `ax`; returns the axes."""
        ax = _axes(ax)
        modes = [(mode, name, colour) for mode, name, colour in [(self.softest, "softest", BLUE), (self.stiffest, "stiffest", ORANGE)] if mode]
        for k, (mode, name, colour) in enumerate(modes):
            places = np.arange(len(mode.joints)) + 0.4 * k - 0.2
            ax.barh(places, mode.share, height=0.38, color=colour, label=name)
            ax.set_yticks(np.arange(len(mode.joints)), mode.joints)
        ax.invert_yaxis()
        ax.set_xlabel("share of the mode")
        ax.set_title(f"κ = {_number(self.kappa)}")
        ax.legend()
        return ax


@dataclass(frozen=True, eq=False, repr=False)
class Conditionings:
    """κ and what belongs to it along a batch: one array a quantity, NaN where it does not exist.

    `bracket` and `error_estimate` are pairs, (k, 2), modes and `eigenvalues` (k, n); `eigenvalues` is None unless ``all=True``.
    """

    kappa: Floats
    kappa_weighted: Floats
    lambda_min: Floats
    lambda_max: Floats
    diagonal_ratio: Floats
    bracket: Floats
    error_estimate: Floats
    softest: Floats
    stiffest: Floats
    eigenvalues: Floats | None

    def __init__(self, columns: dict[str, Floats]) -> None:
        pairs = {"bracket": ("bracket_low", "bracket_high"), "error_estimate": ("error_of_min", "error_of_max")}
        both = {name: np.stack([columns.pop(end) for end in ends], axis=-1) for name, ends in pairs.items()}
        for name, column in {"eigenvalues": None, **columns, **both}.items():
            object.__setattr__(self, name, column)

    def __len__(self) -> int:
        return len(self.kappa)

    def to_dict(self) -> dict[str, Floats]:
        """The arrays by name."""
        return {name: column for name, column in self.__dict__.items() if column is not None}

    def _rows(self) -> list[tuple[str, str]]:
        def row(x: Floats) -> str:
            x = x[np.isfinite(x)]
            return f"{x.min():.6g} … {np.median(x):.6g} … {x.max():.6g}" if x.size else "–"

        return [("κ", row(self.kappa)), ("κ′", row(self.kappa_weighted)), ("λmin", row(self.lambda_min)), ("λmax", row(self.lambda_max))]

    def __repr__(self) -> str:
        return _text(f"{len(self)} configurations: least … median … largest", self._rows())

    def _repr_html_(self) -> str:
        return _html(f"{len(self)} configurations: least … median … largest", self._rows())

    def plot(self, ax: Any = None) -> Any:
        """κ and κ′ along the batch, on `ax`; returns the axes."""
        ax = _axes(ax)
        ax.semilogy(self.kappa, color=BLUE, label="κ")
        ax.semilogy(self.kappa_weighted, color=ORANGE, linestyle="--", label="κ′")
        ax.set_xlabel("row")
        ax.legend()
        return ax


@dataclass(frozen=True, eq=False)
class WorstCase:
    """The worst of all configurations by one measure: `q` reproduces it."""

    measure: str
    worst: float
    q: Floats
    median: float
    tenth: float

    def to_dict(self) -> dict[str, Any]:
        """Numbers and lists."""
        return {"measure": self.measure, "worst": self.worst, "q": self.q.tolist(), "median": self.median, "tenth": self.tenth}

    def __repr__(self) -> str:
        return f"<worst {self.measure} {self.worst:.6g}, median {self.median:.6g}, one in ten beyond {self.tenth:.6g}>"

    def _repr_html_(self) -> str:
        rows = [("worst", self.worst), ("median", self.median), ("one in ten beyond", self.tenth)]
        return _html(MEASURES.get(self.measure, self.measure), [(name, _number(x)) for name, x in rows])


@dataclass(frozen=True, eq=False)
class Finding:
    """One thing that is wrong with a robot."""

    id: str
    severity: str
    message: str
    advice: str
    joints: tuple[str, ...]
    value: float | None
    limit: float | None
    q: Floats


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """What is wrong with a robot over all that its joints allow: what `eigenbody check` finds."""

    findings: tuple[Finding, ...]
    model_findings: tuple[str, ...]
    _dict: dict[str, Any] = field(repr=False, compare=False)
    _examination: Examination | None = field(default=None, repr=False, compare=False)

    @classmethod
    def _of(cls, examination: Examination) -> Diagnosis:
        return cls._of_json(examination.to_json(), examination)

    @classmethod
    def _of_json(cls, text: str, examination: Examination | None = None) -> Diagnosis:
        found = json.loads(text)
        findings = tuple(
            Finding(
                id=one["id"],
                severity=one["severity"],
                message=one["message"],
                advice=one["advice"],
                joints=tuple(one["joints"]),
                value=one["value"],
                limit=one["limit"],
                q=np.array(one["q"]),
            )
            for one in found["findings"]
        )
        return cls(findings, tuple(found["model_findings"]), found, examination)

    def __reduce__(self) -> tuple[Any, ...]:
        return Diagnosis._of_json, (json.dumps(self._dict),)

    def __copy__(self) -> Diagnosis:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Diagnosis:
        return self

    def __bool__(self) -> bool:
        """True if nothing worse than a note was found."""
        return not any(finding.severity in ("warning", "error") for finding in self.findings)

    def to_dict(self) -> dict[str, Any]:
        """What `eigenbody check --format json` prints."""
        return json.loads(json.dumps(self._dict))  # type: ignore[no-any-return]

    def to_html(self) -> str:
        """What `eigenbody report` writes: one page that needs nothing else."""
        return self._examined().to_html()

    def to_sarif(self) -> str:
        """What `eigenbody check --format sarif` prints, for code hosts."""
        return self._examined().to_sarif()

    def to_text(self) -> str:
        """What `eigenbody check` prints for people."""
        return self._examined().to_text()

    def mended(self, change: Literal["armature", "link", "limit"] = "armature", /) -> Model:
        """The robot with what was advised for a `want_` option: `mended().patched()` is the model's own file with it."""
        return self._examined().mended(change)

    def _examined(self) -> Examination:
        if self._examination is None:
            raise InputError("a Diagnosis that was pickled has numbers only: call check again", what="diagnosis")
        return self._examination

    @property
    def advice(self) -> dict[str, Any] | None:
        """What to add, where something was wanted: `measure`, `wanted`, `reached`, `added` joint by joint, `links`, `limits`."""
        return self.to_dict().get("advice")

    @property
    def stepping(self) -> dict[str, Any] | None:
        """Stable steps and gains, where the robot has springs, gains or a step."""
        return self.to_dict()["stepping"]  # type: ignore[no-any-return]

    @property
    def comparison(self) -> dict[str, Any] | None:
        """What is new, worse and gone, where there was a baseline."""
        return self.to_dict().get("comparison")

    def worst(self, measure: str = "kappa_weighted") -> dict[str, Any]:
        """The worst by `kappa`, `kappa_weighted` or `lambda_min`."""
        for one in self._dict["worst"]:
            if one["measure"] == measure:
                return dict(one)
        raise KeyError(measure)

    def plot(self, measure: str = "kappa_weighted", ax: Any = None) -> Any:
        """Who moves in the softest motion where a measure is worst, as bars on `ax`; returns the axes."""
        worst = self.worst(measure)
        ax = _axes(ax)
        parts = worst["softest"][: 2 * SHOWN]
        places = np.arange(len(parts))
        ax.barh(places, [part["share"] for part in parts], color=BLUE)
        ax.set_yticks(places, [part["joint"] for part in parts])
        ax.invert_yaxis()
        ax.set_xlabel("share of the softest motion")
        ax.set_title(f"worst {MEASURES.get(measure, measure)} = {_number(worst['worst'])}")
        return ax

    def _rows(self) -> list[tuple[str, str]]:
        rows = [(f"worst {MEASURES.get(one['measure'], one['measure'])}", _number(one["worst"])) for one in self._dict["worst"]]
        rows += [(finding.severity, finding.message) for finding in self.findings]
        if not self.findings:
            rows.append(("findings", "none"))
        advice = self.advice
        if advice is not None:
            added = [f"{one['joint']} +{one['added']:.4g}" for one in advice["added"] if one["added"] > 0]
            rows.append(("armature", ", ".join(added) or ("nothing to add" if advice["added"] else "none does what is wanted")))
        return rows

    def _title(self) -> str:
        return f"{self._dict['model']}: {self._dict['dofs']} DoFs, {self._dict['evaluations']} configurations"

    def __repr__(self) -> str:
        return _text(self._title(), self._rows())

    def _repr_html_(self) -> str:
        return _html(self._title(), self._rows())


@dataclass(frozen=True, eq=False, repr=False)
class Motion:
    """A motion, row by row, with what was watched along it: what `eigenbody simulate` writes.

    `t` (k,), `q` (k, nq) and `v` (k, nv); `monitors` one array a column, (k,) or (k, n), NaN where there is nothing, and their
    `units`; `events` as (t, what). `note` says why a motion ended before its time: it blew up, or its steps did not get on.
    """

    name: str
    t: Floats
    q: Floats
    v: Floats
    monitors: dict[str, Floats]
    units: dict[str, str]
    events: list[tuple[float, str]]
    note: str | None
    method: str
    steps: int
    refused: int
    evaluations: int

    def __len__(self) -> int:
        return len(self.t)

    def __getitem__(self, name: str) -> Floats:
        """A column of a monitor."""
        return self.monitors[name]

    def to_dict(self) -> dict[str, Any]:
        """Arrays by the names of `eigenbody simulate`'s columns: `t`, `q0`, `q1`, .., `v0`, .., then the monitors."""
        columns: dict[str, Any] = {"t": self.t}
        columns |= {f"q{k}": self.q[:, k] for k in range(self.q.shape[1])}
        columns |= {f"v{k}": self.v[:, k] for k in range(self.v.shape[1])}
        return columns | self.monitors

    def _rows(self) -> list[tuple[str, str]]:
        def row(name: str, x: Floats) -> tuple[str, str]:
            finite = x[np.isfinite(x)]
            unit = self.units[name] if self.units[name] != "1" else ""
            return name, f"{finite.min():.6g} … {finite.max():.6g} {unit}".rstrip() if finite.size else "–"

        rows = [("method", f"{self.method}: {self.steps} steps, {self.refused} refused, {self.evaluations} accelerations")]
        rows += [row(name, x) for name, x in self.monitors.items() if x.ndim == 1]
        rows += [("events", str(len(self.events)))] if self.events else []
        return rows + ([("ended early", self.note)] if self.note else [])

    def _title(self) -> str:
        return f"{self.name}: {len(self)} rows, {self.t[-1] if len(self) else 0:.6g} s"

    def __repr__(self) -> str:
        return _text(self._title(), self._rows())

    def _repr_html_(self) -> str:
        return _html(self._title(), self._rows())

    def plot(self, *names: str, ax: Any = None) -> Any:
        """Monitors over time on `ax`, all or those named; returns the axes. Energies stand on an even axis, all else on a logarithmic one."""
        ax = _axes(ax)
        chosen = names or [name for name, x in self.monitors.items() if x.ndim == 1]
        lines = zip(chosen, [BLUE, ORANGE, "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"] * len(chosen), ["-", "--", "-.", ":"] * len(chosen))
        for name, colour, line in lines:
            ax.plot(self.t, self.monitors[name], color=colour, linestyle=line, label=name)
        units = sorted({self.units[name] for name in chosen} - {"1"})
        if "J" not in units:
            ax.set_yscale("log")
        ax.set_ylabel(", ".join(units))
        ax.set_xlabel("time (s)")
        ax.set_title(self.name)
        ax.legend()
        return ax


def model_html(model: Model) -> str:
    """A model in a notebook."""
    rows = [
        ("bodies", str(model.nbodies)),
        ("nq, nv", f"{model.nq}, {model.nv}"),
        ("base", "floating" if model.has_floating_base else "fixed"),
        ("degrees of freedom", ", ".join(model.dof_names[:12]) + (" …" if len(model.dof_names) > 12 else "")),
        ("findings", str(len(model.findings))),
    ]
    return _html(model.name, rows)


def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    try:
        import matplotlib.pyplot as plt
    except ImportError as error:
        raise ImportError("plots need matplotlib: pip install 'eigenbody[plot]'") from error
    return plt.subplots(layout="constrained")[1]
