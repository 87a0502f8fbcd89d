"""The links of an arm in a scene: against distances of samples, and certificates that say something else."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction as F
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import bezier
import qe
from bezier.arm.kinematics import skeleton
from bezier.arm.model import Angle, Arm, Convention, Joint, JointKind, Row
from bezier.arm.reader import load_arm
from bezier.arm.robot import Robot
from bezier.arm.tip import frames_of, is_fixed
from bezier.cli import main
from bezier.pictures.obstacles import signed_distances
from bezier.scenes.scene import load_table
from bezier.trajectories.command import Certified
from bezier.trajectories.links import Links, Touch
from bezier.trajectories.readers import from_scipy
from tests.tables import each

TIMES, SHARES = np.linspace(0, 2, 81), np.linspace(0, 1, 61)[:, None]
MOTION = CubicSpline([0, 1, 2], [[0, 0, 0], [0.5, 0.4, -0.3], [0.9, 0.2, 0.6]])
SMALL = CubicSpline([0, 1, 2], [[0, 0, 0], [0.1, 0.05, -0.02], [0.2, 0.1, -0.05]])
BALL = {"kind": "ball", "centre": [200, 150, 0], "radius": 20}
"""Clear of the planar arm, which has links of 100, 80 and 50 mm."""


def places(arm: str) -> Any:
    """Of all frames at all times."""
    return np.array([skeleton(load_arm(arm), q) for q in MOTION(TIMES)])


def distances(found: Links, arm: str) -> dict[tuple[int, int], Any]:
    """Of links and bodies, over the time."""
    at, result = places(arm), {}
    for k, i in found.spans:
        points = [(1 - SHARES) * p[k - 1] + SHARES * p[k] for p in at]
        result[k, i] = np.array([signed_distances(p, found.bodies[i][1]).min() for p in points])
    return result


@each(
    {"kind": "ball", "centre": [150, 60, 60], "radius": 30},
    {"kind": "box", "low": [150, 40, -10], "high": [170, 60, 200], "margin": 4},
    {"kind": "half_space", "normal": [-2, 0, 1], "offset": -300},
    {"kind": "cylinder", "centre": [120, 70], "radius": 25},
    {"kind": "capsule", "start": [180, 90, -50], "end": [150, 150, 200], "radius": 20},
    daily=2,
)
@pytest.mark.parametrize("arm", ["planar-3r", "ev3-120"])
def test_links_meet_what_samples_meet_and_when(obstacle: dict[str, Any], arm: str) -> None:
    found = bezier.certify(MOTION, robot=arm, obstacles=[obstacle]).links
    assert found is not None
    for pair, away in distances(found, arm).items():
        if pair not in found.touches:
            assert away.min() > 0
            continue
        k = int(np.searchsorted(TIMES, float(found.time(pair))))
        assert away[: max(k - 1, 0)].min(initial=1) > 0 > away[max(k - 1, 0) : k + 2].min() - 0.6


@each(-1, 1)
def test_a_ball_is_met_when_it_grows_by_a_hundredth(side: int) -> None:
    centre = [200, 60, 40]
    ends = (skeleton(load_arm("planar-3r"), SMALL(t)) for t in np.linspace(0, 2, 2001))
    nearest = (((1 - SHARES) * p[2] + SHARES * np.array(p[3])) - centre for p in ends)
    far = float(min(np.linalg.norm(points, axis=1).min() for points in nearest))
    result = bezier.certify(
        SMALL, robot="planar-3r", obstacles=[{**BALL, "centre": centre, "radius": far + side / 100}]
    )
    assert result.kept is (side < 0) and ("first at the time" in str(result)) is (side > 0)
    result.check(qe.Certificate.from_json(result.certificate.to_json()))
    assert "distance from ball 1" in result.page()


DOMAINS = {
    "a ball": ({"kind": "ball", "centre": [0, 0, 0], "radius": "R"}, lambda p: np.linalg.norm(p, axis=-1)),
    "a box": ({"low": [-300, -300, -300], "high": [300, "R", 300]}, lambda p: p[..., 1]),
    "a slanted side": (
        [{"low": [-300] * 3, "high": [300] * 3}, {"kind": "half_space", "normal": [3, 4, 0], "offset": "R"}],
        lambda p: p @ [3, 4, 0],
    ),
    "a tube": (
        {"kind": "cylinder", "centre": [10, 0], "radius": "R", "bottom": -300, "top": 300},
        lambda p: np.linalg.norm(p[..., :2] - [10, 0], axis=-1),
    ),
}


@pytest.mark.parametrize("name", DOMAINS)
def test_links_stay_in_a_convex_domain_that_samples_stay_in(name: str, tmp_path: Path) -> None:
    domain, level = DOMAINS[name]
    reached = max(level(np.array(skeleton(load_arm("planar-3r"), SMALL(t)))).max() for t in np.linspace(0, 2, 2001))
    for side in (1, -1):
        text = json.dumps({"domain": domain}).replace('"R"', repr(float(reached) + side / 100))
        (tmp_path / "scene.json").write_text(text)
        table, trajectory = load_table(tmp_path / "scene.json"), from_scipy(SMALL)
        result = Certified.of(trajectory, [], table, F(1, 10**9), load_arm("planar-3r"))
        assert result.kept is (side > 0), str(result)
        assert ("inside the domain for all t" in str(result)) is (side > 0)
        assert ("meets the outside of the workspace" in str(result)) is (side < 0)
        result.check(qe.Certificate.from_json(result.certificate.to_json()))
        assert "planar" in result.page("planar")
        other = Certified.of(trajectory, [], None, F(1, 10**9), load_arm("planar-3r"))
        with pytest.raises((qe.CertificateRejected, qe.Unable)):
            result.check(other.certificate)


HOLES = {
    "an annulus": {"kind": "annulus", "centre": [30, 120], "inner": "R", "outer": 900, "bottom": -900, "top": 900},
    "a formula": [
        {"low": [-900] * 3, "high": [900] * 3},
        {"kind": "formula", "formula": "(x - 30)^2 + (y - 120)^2 >= (R)^2 | z >= 5"},
    ],
}


@pytest.mark.parametrize("name", HOLES)
def test_links_stay_outside_of_a_hole_of_the_domain(name: str, tmp_path: Path) -> None:
    """Both ends of a link are in the domain, and its middle may be in the hole."""
    ends = (np.array(skeleton(load_arm("planar-3r"), SMALL(t))) for t in np.linspace(0, 2, 401))
    legs = ((1 - SHARES) * p[k] + SHARES * p[k + 1] - [30, 120, 0] for p in ends for k in range(3))
    far = min(np.linalg.norm(points, axis=1).min() for points in legs)
    for side in (1, -1):
        radius = repr(float(far) + side / 100)
        text = json.dumps({"domain": HOLES[name]}).replace('"R"', radius).replace("(R)", f"({radius})")
        (tmp_path / "scene.json").write_text(text)
        table = load_table(tmp_path / "scene.json")
        result = Certified.of(from_scipy(SMALL), [], table, F(1, 10**9), load_arm("planar-3r"))
        assert result.kept is ("inside the domain for all t" in str(result)) is (side < 0)
        assert ("meets hole" in str(result)) is (side > 0)
        result.check(qe.Certificate.from_json(result.certificate.to_json()))
        assert ("refuted" in result.page("planar")) is (side > 0)


FORMULAS = {
    "(x - 60)^2 + (y - 90)^2 + z^2 <= 1600 | x >= 220": lambda x, y, z: (
        ((x - 60) ** 2 + (y - 90) ** 2 <= 1600) | (x >= 220)
    ),
    "x*y >= 14000 & x <= 190 & z <= 5": lambda x, y, z: (x * y >= 14000) & (x <= 190) & (z <= 5),
    "y = 100 & x^3 <= 1000000": lambda x, y, z: (abs(y - 100) < 0.5) & (x**3 <= 1000000),
    "x^3 + y^3 >= 13000000 & z^2 <= 900 & y*z <= 2000": (
        lambda x, y, z: (x**3 + y**3 >= 13000000) & (z**2 <= 900) & (y * z <= 2000)
    ),
    "z >= 200 + x^2/100 | y <= -300": lambda x, y, z: (z >= 200 + x**2 / 100) | (y <= -300),
}


@each(*FORMULAS, daily=3)
@pytest.mark.parametrize("arm", ["planar-3r", "ev3-120"])
def test_links_meet_the_formulas_that_samples_meet_and_when(formula: str, arm: str) -> None:
    found = bezier.certify(MOTION, robot=arm, obstacles=[{"kind": "formula", "formula": formula}])
    found.check(qe.Certificate.from_json(found.certificate.to_json()))
    at, times = places(arm), {pair: float(found.links.time(pair)) for pair in found.links.touches}
    for k, i in found.links.spans:
        points = [(1 - SHARES) * p[k - 1] + SHARES * p[k] for p in at]
        met = [bool(np.any(FORMULAS[formula](*p.T))) for p in points]
        first = TIMES[met.index(True)] if any(met) else None
        assert (first is not None) is ((k, i) in times)
        assert first is None or times[k, i] - 0.05 < first < times[k, i] + 0.05


@pytest.mark.parametrize("margin", [0, 5])
def test_a_ball_is_met_at_the_same_time_as_its_formula(margin: int) -> None:
    body = {**BALL, "centre": [200, 60, 0]}
    text = f"(x - 200)^2 + (y - 60)^2 + z^2 <= {(20 - margin) ** 2}"
    formula = {"kind": "formula", "formula": text, "margin": margin}
    one, other = (bezier.certify(MOTION, robot="planar-3r", obstacles=[o]).links for o in (body, formula))
    assert one.touches.keys() == other.touches.keys() == {(3, 0)}
    assert abs(one.time((3, 0)) - other.time((3, 0))) < 1e-6


def test_formulas_that_are_not_decided_for_links_are_refused_in_a_line() -> None:
    with pytest.raises(qe.Unable, match="degree above 64"):
        bezier.certify(SMALL, robot="ev3-120", obstacles=[{"kind": "formula", "formula": "x^40 >= 10^120"}])


def test_a_contact_of_a_link_that_begins_at_the_base_has_a_certificate() -> None:
    """One end stays, the other moves: polynomials of different degrees."""
    result = bezier.certify(SMALL, robot="planar-3r", obstacles=[{**BALL, "centre": [50, 20, 0], "radius": 18}])
    result.check(result.certificate)
    assert min(result.links.touches) == (1, 0)


@pytest.mark.parametrize("is_within", [True, False])
def test_a_shift_along_two_axes_is_one_straight_link_where_it_is_one(is_within: bool) -> None:
    """The rows of a joint in URDF: along x, then along y."""
    joint = Joint("q", JointKind.REVOLUTE, None, None)
    lengths = (F(0), 0, joint), (F(100), 6, None), (F(100), -6, None)
    rows = [Row(a, Angle(), F(0), Angle(turn), moving) for a, turn, moving in lengths]
    rows[1] = replace(rows[1], is_within=is_within)
    arm = Robot(Arm("L", Convention.MODIFIED, tuple(rows), "test"))
    corner = [] if is_within else [[100, 0, 0]]
    assert np.allclose(skeleton(arm.arm, [0]), [[0, 0, 0], [0, 0, 0], *corner, [100, 100, 0]])  # as pages draw it
    moved = CubicSpline([0, 1, 2], [[0], [0.1], [0.2]])
    for centre, is_straight in (([80, 10, 0], False), ([50, 50, 0], True)):
        found = bezier.certify(moved, robot=arm, obstacles=[{**BALL, "centre": centre}])
        assert found.kept is (is_straight is not is_within)
        found.check(found.certificate)
        assert "distance from ball 1" in found.page()


@pytest.mark.parametrize("arm", ["ev3-120", "cylindrical", "six-joints"])
def test_frames_are_where_floating_point_has_them_and_fixed_ones_stay(arm: str) -> None:
    model, error = load_arm(arm), F(1, 2**20)
    q = CubicSpline([0, 1], np.random.default_rng(3).uniform(-0.5, 0.5, (2, len(model.joints))))
    frames = frames_of(model, from_scipy(q), error, range(len(model.rows) + 1))
    ends = np.array([skeleton(model, q(t)) for t in (0, 0.4, 1)])
    for k, frame in enumerate(frames):
        ours = [[float(p(F(length))) for p in row] for row, length in zip(frame.pieces, frame.lengths, strict=True)]
        assert np.linalg.norm(np.array(ours[-1]) - ends[2, k]) < float(error) + 1e-9
        assert is_fixed(model, k) is bool(np.ptp(ends[:, k], axis=0).max() < 1e-9)


def test_a_table_under_the_base_is_not_met_by_what_never_moves() -> None:
    table = {"kind": "half_space", "normal": [0, 0, 1], "offset": 0}
    assert bezier.certify(SMALL, robot="ev3-120", obstacles=[table]).kept


@pytest.fixture(scope="module")
def clear() -> Any:
    return bezier.certify(SMALL, robot="planar-3r", obstacles=[BALL])


def test_a_certificate_has_to_cover_the_time_with_parts_of_pieces(clear: Any) -> None:
    """What is proved is true, but it is less than what is claimed."""
    links: Links = clear.links
    pair, spans = next((pair, spans) for pair, spans in links.spans.items() if len(spans) > 1)
    wide = (*spans[:-2], replace(spans[-2], low=F(0), high=F(2)))  # beyond its piece
    for fewer in (spans[1:], spans[:-1], wide):
        members = list(replace(links, spans={**links.spans, pair: fewer}).members())
        with pytest.raises(qe.CertificateRejected, match=r"cover|no part"):
            clear.check(qe.Certificate.bundle(members))


@pytest.fixture(scope="module")
def beside() -> Any:
    """A motion that is clear of a formula."""
    formula = "(x - 180)^2 + (y - 60)^2 + z^2 <= 190 | x <= 228 & x >= 226 & y >= 45"
    return bezier.certify(SMALL, robot="planar-3r", obstacles=[{"kind": "formula", "formula": formula}])


def test_rectangles_have_to_cover_the_motion(beside: Any) -> None:
    links: Links = beside.links
    assert beside.kept and any(part.low for parts in links.spans.values() for part in parts)
    for pair, parts in links.spans.items():
        for k, part in enumerate(parts):
            for fewer in (
                (),
                (replace(part, last=(part.first + part.last) / 2),),
                (replace(part, low=(part.low + part.high) / 2),),
            ):
                changed = replace(links, spans={**links.spans, pair: (*parts[:k], *fewer, *parts[k + 1 :])})
                with pytest.raises(qe.CertificateRejected, match="cover"):
                    beside.check(qe.Certificate.bundle(list(changed.members())))


@each(
    "link 1, 0, piece 0 from 0 to 1, share 0 to 2: ",
    "link 1, 0, piece 7 from 0 to 1, share 0 to 1: ",
    "link 1, 0, piece -1 from 0 to 1, share 0 to 1: ",
    "link 1, 3, piece 0 from 0 to 1, share 0 to 1: ",
    "link 1, 1/2, piece 0 from 0 to 1, share 0 to 1: ",
    "link 1, 0, piece 0 from 0 to 1e999999, share 0 to 1: ",
    "link 1, 0, piece 0 from 1/2 to 1/2, share 0 to 1: ",
    "link 1, 0, piece 0 from 0 to 1, share 0 to 1: 1 0 0",
    "link 1, 0, piece 0 from 0 to 1, share 0 to 1: ",
)
def test_labels_about_no_rectangle_are_rejected(label: str, beside: Any) -> None:
    members = [(m.label, m.certificate) for m in beside.certificate.payload]
    with pytest.raises(qe.CertificateRejected):
        beside.check(qe.Certificate.bundle([*members, (label, members[0][1])]))


def test_a_contact_is_not_believed_and_neither_is_another_scene(clear: Any) -> None:
    other = bezier.certify(SMALL, robot="planar-3r", obstacles=[{**BALL, "radius": 21}])
    late = bezier.certify(SMALL, robot="planar-3r", obstacles=[{**BALL, "centre": [215, 70, 0]}])
    with pytest.raises(qe.CertificateRejected):
        other.check(clear.certificate)
    ((pair, touch),) = late.links.touches.items()
    for moved in (Touch(touch.piece, touch.t + F(1, 64), touch.share), Touch(touch.piece, touch.t, touch.share / 2)):
        forged = replace(late.links, touches={pair: moved})
        with pytest.raises((qe.CertificateRejected, qe.Unable)):
            late.check(qe.Certificate.bundle(list(forged.members())))


@each("", "1", "a b c", "0 0 0", "1 0 0 0", "1e999999 0 0", "1 0 0")
def test_labels_that_say_nothing_are_rejected(normal: str, clear: Any) -> None:
    """Some ended in an error of the reader."""
    members = [(m.label, m.certificate) for m in clear.certificate.payload]
    for piece in (0, 7):
        added = (f"link 1, 0, piece {piece} from 0 to 1, share 0 to 1: {normal}", members[0][1])
        with pytest.raises(qe.CertificateRejected):
            clear.check(qe.Certificate.bundle([*members, added]))


@each(*range(40), daily=6)
@pytest.mark.parametrize("name", ["clear", "beside"])
def test_altered_certificates_are_rejected(seed: int, name: str, request: pytest.FixtureRequest) -> None:
    clear = request.getfixturevalue(name)
    random, members = np.random.default_rng(seed), [(m.label, m.certificate) for m in clear.certificate.payload]
    i = random.integers(len(members))
    other = next(proof for _, proof in members[::-1] if proof != members[i][1])  # a fixed frame says the same twice
    label, digits = members[i][0], [k for k, c in enumerate(members[i][0]) if c.isdigit()]
    k = int(random.choice(digits))
    changed = label[:k] + str((int(label[k]) + 1 + seed % 9) % 10) + label[k + 1 :]
    for listed in (
        members[:i] + members[i + 1 :],
        [*members, members[i]],
        [*members, (label.replace("piece ", "piece 9", 1), other)],
        [(changed, m[1]) if m is members[i] else m for m in members],
        [(m[0], other) if m is members[i] else m for m in members],
    ):
        with pytest.raises(qe.CertificateRejected):
            clear.check(qe.Certificate.bundle(listed))


def test_both_doors_say_the_same_of_links(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, scene, proof = tmp_path / "q.csv", tmp_path / "s.json", tmp_path / "c.json"
    file.write_text("time,q1,q2,q3\n0,0,0,0\n1,1,0.5,0.5\n")
    scene.write_text(json.dumps({"obstacle": [BALL]}))
    words = ["certify", str(file), "--robot", "planar-3r", "--scene", str(scene)]
    assert main([*words, "--json", "--certificate", str(proof)]) == 0
    result = bezier.certify(str(file), robot="planar-3r", obstacles=[BALL])
    assert json.loads(capsys.readouterr().out) == json.loads(json.dumps(result.to_json()))
    assert main([*words, "--check", str(proof)]) == 0 and result.to_json()["links"]
