"""The command ``bezier`` and its commands: each reads its input here and leaves the work to a worker.

Exit status: 0 answered, 2 bad input, 3 unable or no solution, 4 certificate rejected, 1 a bug. An error is one
line on stderr.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Mapping, Sequence
from contextlib import nullcontext
from enum import Enum
from fractions import Fraction
from functools import partial, wraps
from inspect import Parameter, signature
from pathlib import Path
from typing import Annotated, Any

import typer

from bezier.motion.timelaw import Law, TimeLaw
from qe.arguments import mebibytes, seconds
from qe.cli.shell import OK, UNABLE, check_writable, enter, examples, limited, write_file
from qe.errors import InputError, Unable


def ending(option: str, *known: str, help: str) -> Any:
    """The option for a file that is written in one of these forms, by its ending; a device has none."""

    def checked(given: Path | None) -> Path | None:
        if given is not None and given.suffix.lower() not in known and not (given.exists() and not given.is_file()):
            raise InputError(f"{option} {given}: expected a name that ends in {' or '.join(known)}")
        return given

    return typer.Option(option, callback=checked, help=help)


ProblemFile = Annotated[Path, typer.Argument(metavar="PROBLEM.toml", help="The planning problem.", show_default=False)]
ArmName = Annotated[
    str, typer.Argument(metavar="ARM", help="ev3-112, ev3-120, … or a file ARM.toml.", show_default=False)
]
RouteFile = Annotated[Path, typer.Argument(metavar="PATH.toml", help="[[curve]] tables.", show_default=False)]
Out = Annotated[Path, typer.Option("--out", help="Folder for the report and all other files.")]
TimedPath = Annotated[Path, typer.Argument(metavar="FILE", help=".csv, .json, .yaml, .npz", show_default=False)]
Against = Annotated[Path | None, typer.Option("--check", help="Verify this certificate about the file.")]
Charts = Annotated[Path | None, ending("--page", ".html", help="Write a page with each quantity over time here.")]
Drawn = Annotated[Path | None, ending("--page", ".html", help="Write a page with pictures here.")]
Evidence = Annotated[Path | None, typer.Option("--certificate", help="Write the certificates here.")]
NoPlots = Annotated[bool, typer.Option("--no-plots", help="No pictures.")]
TIMEOUT = typer.Option(callback=lambda given: seconds(given, "--timeout"), help="Seconds; enforced.")
MEMORY = typer.Option(callback=lambda given: mebibytes(given, "--memory"), help="MiB of address space; enforced.")
COMMON = (
    Parameter(
        "json",
        Parameter.KEYWORD_ONLY,
        default=False,
        annotation=Annotated[bool, typer.Option("--json", help="One JSON object on stdout.")],
    ),
    Parameter("timeout", Parameter.KEYWORD_ONLY, default=None, annotation=Annotated[float | None, TIMEOUT]),
    Parameter("memory", Parameter.KEYWORD_ONLY, default=None, annotation=Annotated[int | None, MEMORY]),
)
"""What all commands take at last, as ``**common``."""
Said = tuple[str, bool]
"""What a command prints, and whether it found what was asked for."""


def answered(work: Callable[..., Any], common: Mapping[str, Any], *files: Path | None, lines: bool = False) -> Said:
    """What the work says in a worker, under the limits: JSON data and lines, of which one is wanted; its other results
    go into ``files``, those that are wanted and not empty, whole; one that is true or false at last says whether it
    found what was asked for."""
    check_writable(*files)
    limits = {"timeout": common["timeout"], "memory": common["memory"], "plain": common["json"], "lines": lines}
    data, listed, *rest = limited(work, **limits)
    text = json.dumps(data, indent=1, ensure_ascii=False) if common["json"] else "\n".join(listed)
    is_success = rest.pop() if rest and isinstance(rest[-1], bool) else True
    for name, content in zip(files, rest, strict=True):
        if name is not None and content:
            write_file(name, content)
    return text, is_success


def command(function: Callable[..., Said]) -> Callable[..., int]:
    """The command that a function is, with the options ``COMMON``; its exit status."""

    @wraps(function)
    def run(**given: Any) -> int:
        text, is_success = function(**given)
        print(text)
        return OK if is_success else UNABLE

    known = signature(function, eval_str=True)
    own = [p for p in known.parameters.values() if p.kind is not Parameter.VAR_KEYWORD]
    run.__signature__ = known.replace(parameters=[*own, *COMMON])  # type: ignore[attr-defined]
    return run


def coordinate(name: str) -> object:
    """The type of an argument that is a coordinate."""
    return typer.Argument(metavar=name, help='Exact, in mm: 3/4, 0.75, "44*sqrt(2)".', show_default=False)


def plan(problem: ProblemFile, out: Out, no_plots: NoPlots = False, **common: Any) -> Said:
    """Plan a path; write report.html, region, path and certificate files into a folder, all or none."""
    from bezier.planner.outputs import all_or_none
    from bezier.problem import load_problem

    read = load_problem(problem)
    with all_or_none(out) as folder:
        from bezier.planner import command

        work = partial(command.plan, problem=read, folder=folder, target=out, plots=not no_plots)
        return answered(partial(work, timeout=common["timeout"]), common)


def check(folder: Annotated[Path, typer.Argument(metavar="DIR", show_default=False)], **common: Any) -> Said:
    """Verify the certificates in a folder written by plan, prove its path again, and compare every entry."""
    from bezier.check import recheck

    return answered(partial(recheck.run, folder=folder), common)


def clearance(
    source: Annotated[Path, typer.Argument(metavar="DIR|PROBLEM.toml|CURVES.toml", show_default=False)],
    obstacles: Annotated[Path | None, typer.Option("--obstacles", help="A file with [[obstacle]] tables.")] = None,
    certificate: Evidence = None,
    **common: Any,
) -> Said:
    """Prove each curve clear of each obstacle for all t, or say where it first meets one."""
    from bezier.check.clearance import clearance as examine

    work = partial(examine, source=source, other=obstacles, evidence=certificate is not None)
    return answered(partial(work, timeout=common["timeout"]), common, certificate)


def compare(
    problem: ProblemFile,
    out: Annotated[Path | None, typer.Option("--out", help="Folder for the page, the pictures and the data.")] = None,
    no_plots: NoPlots = False,
    **common: Any,
) -> Said:
    """Quadratic and cubic curves on one problem, side by side."""
    from bezier.planner.outputs import all_or_none
    from bezier.problem import load_problem

    read = load_problem(problem)
    with nullcontext() if out is None else all_or_none(out) as folder:
        from bezier.compare import command

        work = partial(command.run, problem=read, folder=folder, target=out, plots=not no_plots)
        return answered(partial(work, timeout=common["timeout"]), common, lines=True)


def ik(
    arm: ArmName,
    x: Annotated[str, coordinate("X")],
    y: Annotated[str, coordinate("Y")],
    z: Annotated[str, coordinate("Z")],
    quaternion: Annotated[
        tuple[str, str, str, str] | None,
        typer.Option(metavar="W X Y Z", help="The orientation, of any length: a pose, for six joints or planar arms."),
    ] = None,
    certificate: Annotated[
        Path | None, typer.Option("--certificate", help="Write the certificate that these are all solutions here.")
    ] = None,
    **common: Any,
) -> Said:
    """All real joint positions that put the end effector of ARM at the point (X, Y, Z)."""
    from bezier.arm.command import inverse
    from bezier.arm.reader import load_arm, read_exact

    model, point = load_arm(arm), tuple(read_exact(text) for text in (x, y, z))
    turned = None if quaternion is None else tuple(read_exact(text) for text in quaternion)
    work = partial(inverse, arm=model, point=point, quaternion=turned, certified=certificate is not None)
    return answered(work, common, certificate)


def certify_path(arm: ArmName, path: RouteFile, certificate: Evidence = None, **common: Any) -> Said:
    """Prove that ARM can follow the path for all s in [0, 1], or say exactly where it stops; follow all branches."""
    from bezier.arm.command import certify
    from bezier.arm.reader import load_arm, load_route

    work = partial(certify, arm=load_arm(arm), curves=load_route(path), certified=certificate is not None)
    text, has_proof = answered(work, common, certificate)
    if not has_proof:
        print(text)
        raise Unable("there is no joint motion along a part of the path, so there is no certificate")
    return text, True


def joints(
    arm: ArmName,
    path: RouteFile,
    out: Out,
    duration: Annotated[str, typer.Option("--duration", help="Seconds, exactly.")] = "50",
    law: Annotated[Law, typer.Option("--law", help="Time law along the path.")] = Law.QUINTIC,
    samples: Annotated[int, typer.Option("--samples", help="Rows of the sequence.")] = 200,
    **common: Any,
) -> Said:
    """Find the joint sequence of least change, prove joint velocities and accelerations; write data and an
    animated page."""
    from bezier.arm.reader import load_arm, load_route
    from bezier.planner.outputs import all_or_none

    time = _number(duration, "--duration", above=True)
    model, curves = load_arm(arm), load_route(path)
    with all_or_none(out) as folder:
        from bezier.planner import arm as planner

        work = partial(planner.joints, arm=model, curves=curves, law=TimeLaw.of(law), duration=time)
        return answered(partial(work, samples=samples, file=path.name, folder=folder, target=out), common)


class Interpolation(Enum):
    """How states are joined."""

    LINEAR = "linear"
    CUBIC = "cubic"
    QUINTIC = "quintic"


def _number(text: str, option: str, *, above: bool = False) -> Fraction:
    """The exact number of an option, at least 0 or above it. Raises ``InputError``."""
    from bezier.input.numbers import NotANumber, parse

    try:
        value = parse(text)
    except NotANumber as error:
        raise InputError(f"{option}: expected a number, found {error}") from None
    if value < 0 or (above and not value):
        raise InputError(f"{option}: expected a number {'above 0' if above else 'of at least 0'}, found {text}")
    return value


def certify(
    file: TimedPath,
    limits: Annotated[Path | None, typer.Option("--limits", help="A TOML file, such as velocity = 1.")] = None,
    scene: Annotated[Path | None, typer.Option("--scene", help="A file with [[obstacle]] tables.")] = None,
    robot: Annotated[
        str | None, typer.Option("--robot", metavar="ARM", help="The axes are joints of this arm, within its limits.")
    ] = None,
    along: Annotated[Path | None, typer.Option("--along", help="A Cartesian path: [[curve]] tables, or timed.")] = None,
    within: Annotated[
        str | None, typer.Option("--within", metavar="MM", help="Largest distance of the end point from it.")
    ] = None,
    interpolation: Annotated[
        Interpolation | None, typer.Option("--interpolation", help="Between states; default: the highest.")
    ] = None,
    tolerance: Annotated[str, typer.Option("--tolerance", help="Largest jump that counts as continuous.")] = "1e-9",
    certificate: Evidence = None,
    check: Against = None,
    page: Charts = None,
    **common: Any,
) -> Said:
    """Prove for all t that a trajectory keeps its limits, is clear of a scene and stays near a path, or say exactly
    where it does not, and how much slower it has to be."""
    from bezier.trajectories import command

    if not any((limits, scene, robot, along)) and (certificate is not None or check is not None):
        raise InputError("--certificate and --check: expected --limits, --scene, --robot or --along, found none")
    if (along is None) != (within is None):
        raise InputError("--along and --within: expected both, found one of them")
    largest = _number(tolerance, "--tolerance")
    kind = None if interpolation is None else interpolation.value
    work = partial(command.certify, file=file, limits=limits, scene=scene, interpolation=kind, tolerance=largest)
    work = partial(work, evidence=certificate is not None, against=check, page=page is not None)
    if along is not None and within is not None:
        work = partial(work, along=along, within=_number(within, "--within", above=True))
    if robot is not None:
        from bezier.arm.reader import load_arm

        work = partial(work, robot=load_arm(robot))
    return answered(work, common, certificate, page)


def chain(
    file: Annotated[Path, typer.Argument(metavar="CHAIN.toml", help="Points and conditions.", show_default=False)],
    certificate: Evidence = None,
    check: Against = None,
    page: Drawn = None,
    region: Annotated[str | None, typer.Option("--region", help="Where a point may be: start, via[0], C2.1, …")] = None,
    **common: Any,
) -> Said:
    """Find the best chain of curves through many via points, both sides of the optimum proved; or say what excludes it
    and what repairs it."""
    from bezier.chains import command

    if check is not None:
        if certificate is not None or page is not None or region is not None:
            raise InputError("--check: expected no --certificate, --page and --region with it, found one")
        return answered(partial(command.check, file=file, against=check), common)
    planning = partial(command.run, file=file, region=region, evidence=certificate is not None, page=page is not None)
    return answered(planning, common, certificate, page)


def route(
    file: Annotated[Path, typer.Argument(metavar="SCENE", help="JSON or TOML.", show_default=False)],
    certificate: Evidence = None,
    check: Against = None,
    picture: Annotated[
        Path | None, ending("--picture", ".svg", ".png", ".pdf", help="Write a picture here (.svg, .png, .pdf).")
    ] = None,
    page: Drawn = None,
    shortest: Annotated[bool, typer.Option("--shortest", help="A short path, with a bound for all paths.")] = False,
    degree: Annotated[int, typer.Option("--degree", help="Degree of its curves; 1: segments.")] = 3,
    continuity: Annotated[int, typer.Option("--continuity", help="Number of continuous derivatives.")] = 1,
    gap: Annotated[str | None, typer.Option(help="Try more ways until the proved gap is so small, as in 5%.")] = None,
    **common: Any,
) -> Said:
    """Find a path from start to goal that is clear of all obstacles, or prove that there is none (status 3)."""
    from bezier.scenes import command
    from bezier.scenes.route import Wish

    if check is not None and certificate is not None:
        raise InputError("--check: expected no --certificate with it, found one")
    wish: Wish | None = Wish.of(degree, continuity, gap)
    kind = "" if picture is None else picture.suffix.lower().removeprefix(".") or "svg"
    wish = wish if shortest or gap is not None else None
    work = partial(command.run, file=file, against=check, picture=kind, page=page is not None, wish=wish)
    # no certificate where start or goal itself is in an obstacle
    return answered(work, common, certificate, picture, page)


def retime(
    file: TimedPath,
    limits: Annotated[Path, typer.Option("--limits", help="A TOML file: velocity, acceleration, …, as for certify.")],
    law: Annotated[Law, typer.Option("--law", help="The fastest motion, or a law with a formula.")] = Law.LEAST,
    accuracy: Annotated[str, typer.Option("--accuracy", help="Share above the bound at which to stop.")] = "1/250",
    out: Annotated[Path | None, ending("--out", ".csv", help="Write the motion here (.csv), for certify.")] = None,
    certificate: Evidence = None,
    check: Against = None,
    page: Charts = None,
    **common: Any,
) -> Said:
    """Find the fastest motion along the path of a trajectory that keeps all limits for all t, and seconds that every
    motion takes at least; both proved."""
    from bezier.retiming import command

    if check is not None and (certificate is not None or law is not Law.LEAST):
        raise InputError("--check: expected no --certificate and --law with it, found one")
    share = _number(accuracy, "--accuracy", above=True)
    work = partial(command.run, file=file, limits=limits, law=law, accuracy=share, against=check)
    work = partial(work, evidence=certificate is not None, page=page is not None)
    return answered(work, common, out, certificate, page)


COMMANDS: tuple[tuple[str, Callable[..., Said], str, str], ...] = (
    ("plan", plan, "Plan a path, with its page and proofs.", "examples/three_balls.toml --out out"),
    ("check", check, "Verify the folder of a plan.", "out"),
    ("clearance", clearance, "Curves clear of obstacles, for all t.", "examples/obstacle_curves.toml"),
    (
        "certify",
        certify,
        "Any trajectory within its limits, for all t.",
        "examples/joints/path.csv --limits examples/joints/limits.toml",
    ),
    (
        "retime",
        retime,
        "The least time along a path, from both sides.",
        "examples/joints/path.csv --limits examples/joints/limits.toml",
    ),
    ("chain", chain, "The best curves through many via points.", "examples/chains/plane.toml"),
    ("route", route, "A path through a scene, or proof of none.", "examples/scenes/slit.json"),
    ("compare", compare, "Quadratic and cubic curves side by side.", "examples/cubic_joins.toml --out out"),
    ("ik", ik, "All joint positions of an arm at a point.", "ev3-120 599/66 824/33 323/10"),
    ("certify-path", certify_path, "Whether an arm can follow a path.", "ev3-120 examples/arm_curve.toml"),
    ("joints", joints, "The joint sequence of an arm on a path.", "ev3-120 examples/arm_curve.toml --out arm"),
)
"""In the order in which the help lists them, each with its line there and an example."""

app = typer.Typer(pretty_exceptions_enable=False, rich_markup_mode=None)
for _name, _function, _short, _example in COMMANDS:
    app.command(_name, short_help=_short, epilog=examples(f"bezier {_name} {_example}"))(command(_function))


def _version(wanted: bool) -> None:
    if wanted:
        from bezier.report.html import package_version

        typer.echo(f"bezier {package_version()}")
        raise typer.Exit


@app.callback(epilog=examples(*(f"bezier {name} {example}" for name, _, _, example in COMMANDS)))
def whole(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and stop.")
    ] = False,
) -> None:
    """Certified paths of Bézier curves, planned by exact quantifier elimination."""


def main(argv: Sequence[str] | None = None) -> int:
    """The entry point of the console script; without words it shows the help."""
    return enter(app, (sys.argv[1:] if argv is None else argv) or ["--help"], name="bezier")
