"""The `eigenbody` command, run as a user runs it."""

import json
import subprocess
from pathlib import Path


class CommandError(Exception):
    """The command failed or answered with something else than JSON."""


def ask(command: Path, task: str, model: Path, base: str, configuration: str) -> dict:
    """The JSON that `eigenbody TASK MODEL` prints, mimic joints moving freely."""
    options = ["--at", configuration, "--base", base, "--mimic", "off", "--json"]
    call = [command, task, model, *options]
    try:
        result = subprocess.run(call, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise CommandError(f"{task} {configuration}: {error}") from None
    if result.returncode != 0:
        talk = result.stderr.strip().splitlines() or ["no message"]
        raise CommandError(f"{task} {configuration}: exit status {result.returncode}: {talk[0]}")
    try:
        return json.loads(result.stdout)
    except json.JSONDecodeError as error:
        raise CommandError(f"{task} {configuration}: no JSON: {error}") from None
