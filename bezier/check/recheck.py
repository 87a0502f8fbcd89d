"""``bezier check``: verify a folder that ``bezier plan`` wrote, from the exact numbers in its files.

Beyond ``qe check`` on the certificates, this links the files. The plan is found again from the problem and the
certificates, without any search: the certificates have to be about this problem, the path is proved again from its
control points, and lengths, speeds, distances and the motion are computed again. Then every data file is compared,
entry by entry, with what planning would write about that plan. What no certificate covers (``not_certified`` in the
summary) is only read.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any, TypeVar, cast

from bezier.arm.path_report import number_in_words
from bezier.check.agreement import same_data, same_rows, stated_problem
from bezier.input import stored
from bezier.obstacles import survey
from bezier.planner import avoid
from bezier.planner.arm import with_joints
from bezier.planner.derivations import with_stated
from bezier.planner.outputs import COMPARISON, DATA, LISTED_IN, PICTURES, PROBLEM, REPORT, SUMMARY, data_texts, facts
from bezier.planner.planning import with_findings, with_quality
from bezier.planner.radius_rule import stated_rule
from bezier.planner.table import method_for
from bezier.planner.words import NONE
from bezier.plans import Outcome, Plan, Stated
from bezier.problem import Problem, ends_inside, to_json
from qe.certify.verify import verify
from qe.errors import CertificateRejected, InputError
from qe.kernel.verdict import Verdict
from qe.processes.channel import Channel
from qe.progress import Event
from qe.proof.certificate import Certificate

CERTIFICATE, PATH = "certificate.json", "path.json"
T = TypeVar("T")
ROUNDING = Fraction(1, 10**6)
"""Times are rounded to microseconds."""


def run(channel: Channel, folder: FilePath) -> tuple[dict[str, Any], list[str]]:
    """``bezier check``: what to print, as data and as lines."""
    lines = recheck(channel, folder)
    return {"status": "accepted", "checked": lines}, lines


def recheck(channel: Channel, folder: FilePath) -> list[str]:
    """Lines saying what was checked. Raises ``CertificateRejected`` naming the first entry that is wrong."""
    _check_presence(folder)
    certificate = _certificate(folder)
    path = folder / PATH
    stated = Stated(stored.table(folder / SUMMARY), stored.table(path) if path.exists() else None)
    channel.event(Event("certificates", 0, None))
    # a plan need not have any certificate, and an empty bundle proves nothing: then the other files are all there is
    verdict = verify(certificate) if certificate.payload else Verdict(True)
    if not verdict.accepted:
        raise CertificateRejected(f"{CERTIFICATE}: {verdict.step}", verdict.reason)
    problem = _problem(folder, stated)
    channel.event(Event("plan", 0, None))
    plan, lines = restored(problem, certificate, stated)
    plan = replace(plan, checks={"all": verdict, **plan.checks})
    channel.event(Event("files", 0, None))
    _check_files(plan, folder, certificate)
    _check_summary(plan, stated.summary, folder)
    return [f"{CERTIFICATE}: accepted", *lines, *_path_lines(plan)]


def restored(problem: Problem, certificate: Certificate, stated: Stated) -> tuple[Plan, tuple[str, ...]]:
    """The plan that the certificates and the stated path prove, and what was checked for that."""
    made = _of_certificate(lambda: method_for(problem).restore(problem, certificate, stated))
    plan, lines = cast("tuple[Plan, tuple[str, ...]]", made)
    if problem.obstacles:
        plan = avoid.with_stated_attempts(avoid.examined(plan), stated.summary.get("attempts"))
    larger = stated_radius(stated.summary)
    plan = with_findings(plan, lambda solvable: stated_rule(problem, solvable, larger))
    whole = _of_certificate(lambda: with_stated(with_joints(with_quality(plan, certificate)), certificate))
    if whole.derivations:
        several = "s" * (len(whole.derivations) > 1)
        lines = (*lines, f"the derivation{several} of {', '.join(whole.derivations)}: every step")
    return whole, lines


def _of_certificate(work: Callable[[], T]) -> T:
    """What ``work`` finds; what it rejects is in the certificate, where it does not name another file."""
    try:
        return work()
    except CertificateRejected as error:
        step = error.step if ".json" in error.step else f"{CERTIFICATE}: {error.step}"
        raise CertificateRejected(step, error.reason) from None


def stated_radius(summary: Mapping[str, Any]) -> Fraction | None:
    """The larger radius that a summary states, if it does; it is not certified."""
    rule = summary.get("radius_rule")
    text = rule.get("larger_radius") if isinstance(rule, dict) else None
    return None if text is None else stored.rational(text, f"{SUMMARY}: radius_rule.larger_radius")


def _data(value: Any) -> Any:
    """What ``stored.parsed`` reads when this is written as JSON."""
    return stored.parsed(json.dumps(value))


# --- reading -------------------------------------------------------------------------------------------------------


def _check_presence(folder: FilePath) -> None:
    """Whether this is a folder of ``bezier plan`` with the files that all plans have.

    Raises ``InputError`` for a folder without any of them.
    """
    needed = (CERTIFICATE, SUMMARY, PROBLEM)
    missing = [name for name in needed if not (folder / name).exists()]
    if len(missing) == len(needed):
        if (folder / COMPARISON).exists():
            raise InputError(
                f"{folder}: expected a folder of bezier plan, found a comparison (qe check reads its certificates)"
            )
        raise InputError(f"{folder}: expected a folder of bezier plan, with {CERTIFICATE} and {SUMMARY}")
    if missing:
        raise CertificateRejected(missing[0], "missing")


def _certificate(folder: FilePath) -> Certificate:
    text = stored.text(folder / CERTIFICATE)
    try:
        return Certificate.from_json(text)
    except CertificateRejected as error:
        raise CertificateRejected(f"{CERTIFICATE}: {error.step}", error.reason) from None
    except InputError as error:
        raise CertificateRejected(CERTIFICATE, str(error)) from None


def _problem(folder: FilePath, stated: Stated) -> Problem:
    """The problem of ``problem.json``, which the summary repeats."""
    table = stored.table(folder / PROBLEM)
    problem = stated_problem(table, PROBLEM)
    same_data(PROBLEM, table, _data(to_json(problem)))
    same_data(f"{SUMMARY} and {PROBLEM}", stated.summary.get("problem"), table, "problem")
    return problem


# --- comparing -----------------------------------------------------------------------------------------------------


def _check_files(plan: Plan, folder: FilePath, certificate: Certificate) -> None:
    """Every data file says what follows from the plan, and there is no data file of another plan. ``certificate``: that
    of the folder, in the form of today."""
    expected = data_texts(plan)
    for name in DATA:
        file = folder / name
        if name not in expected:
            if file.exists():
                raise CertificateRejected(name, "this plan has no such file: it is left from another one")
            continue
        if not file.exists():
            raise CertificateRejected(name, "missing")
        if name.endswith(".json"):
            stated = _data(json.loads(certificate.to_json())) if name == CERTIFICATE else stored.table(file)
            same_data(name, stated, stored.parsed(expected[name]))
        else:
            same_rows(name, stored.text(file), expected[name])


def _check_summary(plan: Plan, summary: Mapping[str, Any], folder: FilePath) -> None:
    """Every entry of the summary follows from the plan; the times cannot, but add up."""
    expected = _data(facts(plan))
    rest = {key: value for key, value in summary.items() if key not in ("files", "seconds")}
    same_data(SUMMARY, rest, expected)
    written = [*data_texts(plan), *plan.derivation_pages.values(), REPORT, SUMMARY]
    _check_listing(stored.entry(summary, "files", list, f"{SUMMARY}: "), written, folder)
    _check_times(stored.entry(summary, "seconds", dict, f"{SUMMARY}: "))


def _check_listing(files: list[Any], data: list[str], folder: FilePath) -> None:
    """The files that planning lists: the data, the page, and perhaps pictures, all of them there, in one folder."""
    for i, file in enumerate(files):
        if not isinstance(file, str) or FilePath(file).parent != FilePath(files[0]).parent:
            raise CertificateRejected(f"{SUMMARY}: files[{i}]", "expected a file in the same folder as the others")
    names = [FilePath(file).name for file in files]
    drawn = [name for name in names if name.endswith(".png")]
    same_data(SUMMARY, names, sorted({*data, *drawn}), "files")
    for name in names:
        if not (folder / name).is_file():
            raise CertificateRejected(f"{SUMMARY}: files", f"{name} is missing")
    for name in LISTED_IN[SUMMARY]:
        if name in PICTURES and name not in names and (folder / name).exists():
            raise CertificateRejected(f"{SUMMARY}: files", f"{name} is there, but not of this plan")


def _check_times(seconds: Mapping[str, Any]) -> None:
    """Times that are not negative, the total not below the sum of the others."""
    times = {name: _seconds(value, f"{SUMMARY}: seconds.{name}") for name, value in seconds.items()}
    total = times.pop("total", Fraction(-1))
    if sum(times.values()) > total + ROUNDING * len(times):
        raise CertificateRejected(f"{SUMMARY}: seconds.total", "missing, or less than the sum of the steps")


def _seconds(value: Any, place: str) -> Fraction:
    text = str(value) if type(value) is int and abs(value) < 10**12 else value
    result = stored.rational(text, place)
    if not isinstance(value, int | str) or "/" in str(value) or result < 0:
        raise CertificateRejected(place, "expected a number of seconds")
    return result


# --- for people ----------------------------------------------------------------------------------------------------


def _path_lines(plan: Plan) -> list[str]:
    """What the checks of the path showed."""
    if plan.path is None:
        inside = "by any method" if ends_inside(plan.problem) else ""
        return [f"{NONE}: {inside or 'no control point exists: the conditions contradict each other'}"]
    lines = []
    if plan.outcome is Outcome.BLOCKED:
        lines += [f"{PATH}: {survey.in_words(finding)}" for finding in survey.contacts(plan.findings)]
    elif plan.problem.obstacles:
        lines.append(f"{PATH}: every curve proved clear of every obstacle ({len(plan.problem.obstacles)})")
    motion = plan.quality.motion if plan.quality is not None else None
    if motion is not None:
        kept = [key.replace("_", " ") for key, value in motion.kept.items() if value]
        lines.append(f"motion.json: {' and '.join(kept) or 'no limit'} proved to be kept at all times")
    if motion is not None and motion.reason:
        lines.append(f"motion.json: {motion.reason}")
    if plan.joints is not None:
        lines.append(f"joints_certificate.json: {number_in_words(plan.joints.path)} from start to goal")
    joins = f"{plan.path.smoothness.name} at every join, " if plan.path.joins else ""
    return [*lines, f"{PATH}: {joins}every curve proved to lie in the workspace", f"{SUMMARY}: every entry but times"]
