"""Sweeps on whatever executes: threads of this process, processes, Dask, MPI."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from functools import lru_cache
from pathlib import Path
from typing import Any

from eigenbody._eigenbody import SweepPlan
from eigenbody._errors import InputError

# Chunks that wait with an executor, for each that is computed: enough to keep all busy, few enough to stop soon.
AHEAD = 64


def _read(text: str, folder: str, fingerprint: str) -> SweepPlan:
    """A worker's plan. It is kept as long as robots' files are those of the fingerprint."""
    plan = SweepPlan(text, folder)
    if plan.fingerprint != fingerprint:
        raise InputError("spec: a robot's file is not the same here as where the sweep was planned", what="spec")
    return plan


_plan = lru_cache(maxsize=4)(_read)


def _compute(text: str, folder: str, fingerprint: str, number: int) -> bytes:
    """What a worker does: its result depends on its arguments alone."""
    return _plan(text, folder, fingerprint).compute(number)


def sweep(
    spec: str | os.PathLike[str],
    output: str | os.PathLike[str],
    executor: Executor | None = None,
    *,
    progress: Callable[[int, int], Any] | None = None,
) -> Path:
    """Computes a sweep and returns the path of its Parquet table.

    `spec` is a TOML file, or its text; paths in it are seen from the file's folder, or from the current one. `output` is a folder,
    taken up where an earlier run left it. `executor` is any `concurrent.futures.Executor`: `ProcessPoolExecutor`, Dask's
    `Client.get_executor()`, mpi4py's `MPIPoolExecutor`; without one, chunks are computed here one by one. Workers send rows back
    and write nothing, so that they need no common file system, but robots' files must be in the same places on every one of
    them. `progress(done, all)` is called after every chunk.

    The rows do not depend on who computes them. A worker that dies is the executor's business: Dask starts its chunks
    elsewhere; a broken process pool raises, and the next call goes on with what is there.
    """
    path = Path(spec) if "\n" not in str(spec) else None
    text = path.read_text(encoding="utf-8") if path is not None else str(spec)
    folder = str(path.resolve().parent if path is not None else Path.cwd())
    plan = SweepPlan(text, folder)
    missing = plan.missing(output)
    done = plan.chunks - len(missing)

    def keep(number: int, rows: bytes) -> None:
        nonlocal done
        plan.keep(output, number, rows)
        done += 1
        if progress is not None:
            progress(done, plan.chunks)

    if executor is None:
        for number in missing:
            keep(number, plan.compute(number))
        return Path(plan.merge(output))

    waiting: dict[Future[bytes], int] = {}
    queue = iter(missing)
    try:
        while True:
            for number in queue:
                waiting[executor.submit(_compute, text, folder, plan.fingerprint, number)] = number
                if len(waiting) >= AHEAD:
                    break
            if not waiting:
                break
            finished, _ = wait(waiting, return_when=FIRST_COMPLETED)
            for future in finished:
                keep(waiting.pop(future), future.result())
    finally:
        for future in waiting:
            future.cancel()
    return Path(plan.merge(output))
