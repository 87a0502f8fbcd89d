"""``bezier check``: what planning wrote is accepted without any search, and every altered entry is refused by name."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import qe
from bezier.methods.single import closed, program
from qe.errors import InputError, Unable
from qe.proof.certificate import digest
from tests.bezier.folder_mutation import EXAMPLES, Memory, alterations, not_certified, planned, refused, rejection
from tests.tables import each

QUICK = ("tight_radius", "single_leaves", "no_control_point", "obstacle_motion")
SAMPLE = 2
"""So many alterations of each file, about, in the quick test."""


@pytest.fixture(scope="module")
def folders(root: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Folders of plans, written once; tests leave them as they are."""
    base = tmp_path_factory.mktemp("folders")
    return {name: planned(root / "examples" / f"{name}.toml", base / name) for name in QUICK}


@pytest.fixture
def copied(folders: dict[str, Path], tmp_path: Path) -> Callable[[str], Path]:
    """A copy of a folder, to be changed."""

    def copy(name: str) -> Path:
        return Path(shutil.copytree(folders[name], tmp_path / name))

    return copy


@pytest.mark.parametrize("name", QUICK)
def test_a_folder_is_accepted_without_any_search(folders, monkeypatch, name):
    def forbidden(*arguments: Any, **keywords: Any) -> Any:
        raise AssertionError("a search")

    for function in ("eliminate", "minimize", "maximize", "region", "decide", "equivalent", "find_instance"):
        monkeypatch.setattr(qe, function, forbidden)
    for module in (closed, program):
        monkeypatch.setattr(module, "solve", forbidden)
    assert rejection(folders[name]) is None


def complaints(folder: Path, chosen: Any) -> list[str]:
    """The alterations that are accepted though certified, or refused without naming file and entry."""
    found = []
    for alteration in chosen:
        message = refused(folder, alteration)
        if message is None:
            if not not_certified(folder, alteration):
                found.append(f"{alteration.file}: {alteration.place}: accepted")
        elif "\n" in message or alteration.file not in message:
            found.append(f"{alteration.file}: {alteration.place}: {message}")
    return found


@pytest.mark.parametrize("name", QUICK)
def test_some_entries_altered_once(folders, monkeypatch, name):
    Memory().use(monkeypatch, plans=True)
    for file in sorted(folders[name].iterdir()):
        if file.suffix in (".json", ".csv"):
            every = list(alterations(file))
            assert not complaints(folders[name], every[:: len(every) // SAMPLE + 1])


@pytest.mark.deep
@pytest.mark.parametrize("name", EXAMPLES)
def test_every_entry_altered_once(root, tmp_path, monkeypatch, name):
    folder = planned(root / "examples" / f"{name}.toml", tmp_path / name)
    assert rejection(folder) is None
    Memory().use(monkeypatch, plans=True)
    for file in sorted(folder.iterdir()):
        if file.suffix in (".json", ".csv"):
            every = list(alterations(file))
            step = len(every) // 4000 + 1  # the tables of large regions have a test of their own
            assert not complaints(folder, every[::step])


# --- bundles -------------------------------------------------------------------------------------------------------


def signed(folder: Path, change: Callable[[list[Any]], Any]) -> None:
    """Change the list of certificates in a folder and sign the result with its digest."""
    file = folder / "certificate.json"
    whole = json.loads(file.read_text())
    whole["certificates"] = change(whole["certificates"])
    whole["digest"] = digest(whole)
    file.write_text(json.dumps(whole, ensure_ascii=False))


CHANGES: tuple[Callable[[list[Any], int], list[Any]], ...] = (
    lambda found, i: [],
    lambda found, i: found[:i] + found[i + 1 :],
    lambda found, i: [*found[:i], {**found[i], "label": f"{found[i]['label']} again"}, *found[i + 1 :]],
    lambda found, i: [*found[: i + 1], *found[i:]],
    lambda found, i: [{**found[0], "label": found[i - 1]["label"]}, *found[1:]],
    lambda found, i: [*found[:i], *found[i:][1:2], found[i], *found[i + 2 :]],
)
"""Nothing left; one dropped, relabelled, doubled; another label on the first; neighbours swapped (but for the last)."""


def changed_bundles(folder: Path, step: int) -> list[str]:
    """Which of these changes, every ``step``-th of them, are accepted although something changed.

    Without a derivation the bundle is that of a plan without it, which the summary lists: that is named then.
    """
    original = (folder / "certificate.json").read_bytes()
    members = json.loads(original)["certificates"]
    accepted = []
    pairs = [(i, k) for i in range(len(members)) for k in range(len(CHANGES))]
    for i, k in pairs[::step]:
        if CHANGES[k](members, i) != members:
            signed(folder, lambda found, i=i, k=k: CHANGES[k](found, i))
            if not (rejection(folder) or "").startswith(("certificate.json", "summary.json: derivations.")):
                accepted.append(f"change {k} of {members[i]['label']}")
            (folder / "certificate.json").write_bytes(original)
    return accepted


@each("tight_radius", "single_leaves", "no_control_point", daily=3)
def test_members_dropped_relabelled_doubled_or_swapped_are_refused(name, copied):
    assert not changed_bundles(copied(name), 11)


@pytest.mark.deep
@pytest.mark.parametrize("name", EXAMPLES)
def test_all_changes_of_a_bundle_are_refused(root, tmp_path, name):
    assert not changed_bundles(planned(root / "examples" / f"{name}.toml", tmp_path / name), 1)


def test_heights_are_labelled_as_they_are_proved(copied):
    """The proofs of y >= h and z >= h under each other's labels are right, but not of what these say."""
    folder = copied("single_leaves")
    first, second = (f"P for t_a <= t <= t_b in {axis} >= h" for axis in "yz")
    turned = {first: second, second: first}
    signed(folder, lambda found: [{**m, "label": turned.get(m["label"], m["label"])} for m in found])
    assert f"label: expected {first!r}, found {second!r}" in (rejection(folder) or "")


@each("single_leaves", "no_control_point")
def test_certificates_without_content_are_refused(name, copied):
    folder = copied(name)
    for kind, payload in (("bundle", "certificates"), ("containment", "payload"), ("optimum", "payload")):
        empty: Any = [] if payload == "certificates" else {}
        signed(
            folder, lambda found, k=kind, p=payload, e=empty: [{"label": m["label"], "kind": k, p: e} for m in found]
        )
        assert "certificate.json" in (rejection(folder) or "")


@each(("tight_radius", "no_control_point"), ("no_control_point", "tight_radius"))
def test_certificates_of_another_problem_are_refused(ours, theirs, folders, copied):
    folder = copied(ours)
    others = {m["label"]: m for m in json.loads((folders[theirs] / "certificate.json").read_text())["certificates"]}
    original = (folder / "certificate.json").read_bytes()
    mine = [m["label"] for m in json.loads(original)["certificates"]]
    shared = [label for label in mine if label in others]
    assert {"elimination", "region", "optimum"} <= set(shared)
    for label in shared:
        signed(folder, lambda found, label=label: [others[label] if m["label"] == label else m for m in found])
        assert "certificate.json" in (rejection(folder) or ""), label
        (folder / "certificate.json").write_bytes(original)
    (folder / "certificate.json").write_bytes((folders[theirs] / "certificate.json").read_bytes())
    assert "certificate.json" in (rejection(folder) or "")


# --- files of other plans, and files that are none -----------------------------------------------------------------


@each(
    ("no_control_point", "tight_radius", "path.json"),
    ("no_control_point", "tight_radius", "path.csv"),
    ("single_leaves", "tight_radius", "region.json"),
    ("tight_radius", "obstacle_motion", "motion.json"),
    ("tight_radius", "obstacle_motion", "motion.csv"),
    ("tight_radius", "no_control_point", "region.json"),
    ("tight_radius", "obstacle_motion", "path.json"),
    ("tight_radius", "obstacle_motion", "problem.json"),
    ("tight_radius", "obstacle_motion", "summary.json"),
)
def test_a_file_of_another_plan_is_refused(ours, theirs, file, folders, copied):
    folder = copied(ours)
    shutil.copy(folders[theirs] / file, folder / file)
    assert file in (rejection(folder) or "")


def test_a_missing_file_is_refused(copied, monkeypatch):
    folder = copied("obstacle_motion")
    Memory().use(monkeypatch, plans=True)
    for file in sorted(folder.iterdir()):
        hidden = file.read_bytes()
        file.unlink()
        message = rejection(folder)
        assert message is not None and file.name in message and "missing" in message
        file.write_bytes(hidden)
    assert rejection(folder) is None


def test_a_picture_of_another_plan_is_refused_and_files_of_others_are_not(copied):
    folder = copied("no_control_point")
    (folder / "notes.txt").write_text("mine")
    (folder / "map.png").write_bytes(b"mine")
    assert rejection(folder) is None
    (folder / "motion.png").write_bytes(b"old")
    assert "motion.png" in (rejection(folder) or "")


CONTENTS = {
    "nothing": "",
    "half a file": '{"problem": {"method": "qua',
    "a list": "[]",
    "a number": "1",
    "no number": '{"status": NaN}',
    "endless": '{"status": Infinity}',
    "twice": '{"status": 1, "status": 2}',
    "empty": "{}",
    "deep": "[" * 100_000,
    "huge": '{"seconds": ' + "9" * 5000 + "}",
}


@pytest.mark.parametrize("what", CONTENTS)
def test_malformed_files_get_one_line(copied, monkeypatch, what):
    folder = copied("no_control_point")
    (folder / "path.json").write_text("{}")
    Memory().use(monkeypatch, plans=True)
    for name in ("summary.json", "path.json", "problem.json", "certificate.json"):
        original = (folder / name).read_bytes()
        (folder / name).write_text(CONTENTS[what])
        message = rejection(folder)
        assert message is not None and name in message and "\n" not in message
        (folder / name).write_bytes(original)
    (folder / "summary.json").write_bytes(b"\xff\xfe")
    assert "summary.json: expected UTF-8" in (rejection(folder) or "")


@each("single_leaves", "tight_radius", daily=2)
def test_wrong_types_get_one_line(name, copied, monkeypatch):
    """Every entry replaced by values of other types, some for each, in every file that states something."""
    kinds: tuple[Any, ...] = (None, True, -1, 10**400, "x", "1/0", [], {}, [[]], {"a": []}, [None])
    folder = copied(name)
    Memory().use(monkeypatch, plans=True)
    for file in ("summary.json", "path.json", "problem.json"):
        whole = json.loads((folder / file).read_text())
        for i, key in enumerate(whole):
            for value in kinds[i % 11 :: 11]:
                if value != whole[key]:
                    (folder / file).write_text(json.dumps({**whole, key: value}))
                    message = rejection(folder)
                    assert message is not None and "\n" not in message and ".json" in message
        (folder / file).write_text(json.dumps(whole))


@each(0, 2, 4)
@each("single_leaves", "tight_radius", daily=2)
def test_a_point_with_another_number_of_coordinates_is_refused(name, count, copied):
    folder = copied(name)
    found = json.loads((folder / "path.json").read_text())
    found["points"]["P1"] = (found["points"]["P1"] * 2)[:count]
    (folder / "path.json").write_text(json.dumps(found))
    assert "path.json: points.P1" in (rejection(folder) or "")


def test_a_summary_that_states_more_or_less_is_refused(copied, monkeypatch):
    folder = copied("no_control_point")
    Memory().use(monkeypatch, plans=True)
    told = json.loads((folder / "summary.json").read_text())
    for altered, place in (
        ({**told, "objective": {"exact": "0", "decimal": "0"}}, "objective"),
        ({**told, "guaranteed": True}, "guaranteed"),
        ({**told, "not_certified": ["seconds", "reason"]}, "not_certified"),
        ({**told, "files": [*told["files"], told["files"][0]]}, "files"),
        ({**told, "files": told["files"][1:]}, "files"),
        ({**told, "files": ["elsewhere/" + told["files"][0], *told["files"][1:]]}, "files"),
        ({**told, "seconds": {**told["seconds"], "region": "-1"}}, "seconds.region"),
        ({**told, "seconds": {}}, "seconds.total"),
    ):
        (folder / "summary.json").write_text(json.dumps(altered))
        message = rejection(folder)
        assert message is not None and "summary.json" in message and place in message


# --- any problem ---------------------------------------------------------------------------------------------------


def plan_texts() -> Any:
    """Strategy: problems of all methods, some without solution, with obstacles in the way, or with too short a time."""
    small, half = st.integers(-3, 3), st.integers(-4, 4)
    point = st.tuples(small, small, st.integers(0, 3)).map(list)
    free = st.builds(
        lambda method, kind, points, radius: (
            f'method = "{method}"\nworkspace = "{kind}"\nstart = {points[0]}\nvia = [{points[1]}, {points[2]}]\n'
            f'goal = {points[3]}\nradius = "{radius}"\n'
        ),
        st.sampled_from(["quadratic", "cubic"]),
        st.sampled_from(["ball", "hemisphere"]),
        st.lists(point, min_size=4, max_size=4, unique_by=tuple),
        st.sampled_from(["auto", "6", "sqrt(40)"]),
    )
    one = st.builds(
        'method = "single"\nstart = [-5, {}, 0]\ngoal = [5, {}, 1]\nradius = {}\n[single]\ndegree = {}\na = -1\nb = 2\n'
        "height_y = {}\n".format,
        st.integers(-1, 1),
        st.integers(-1, 3),
        st.sampled_from([6, 30]),
        st.integers(4, 6),
        st.integers(1, 4),
    )
    timing = st.sampled_from(["", '[timing]\nlaw = "cubic"\nduration = 3\nmax_speed = 2\n'])
    ball = st.builds(
        '[[obstacle]]\nkind = "ball"\ncentre = [{}, {}, 1]\nradius = "{}/4"\n'.format, half, half, st.integers(1, 4)
    )
    room = st.builds(
        '[[half_space]]\nnormal = [0, 0, {}]\noffset = "{}/2"\npoints = ["Q1"]\n'.format, st.sampled_from([1, -1]), half
    )
    more = st.tuples(timing, st.one_of(st.just(""), ball))
    return st.builds(
        lambda text, extra, rooms: text + "".join([*extra, *(rooms if "via" in text else [])]),
        st.one_of(free, one),
        more,
        st.lists(room, max_size=2),
    )


def check_any(text: str, folder: Path) -> bool:
    """Whether a plan was made, whose folder is then accepted."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    (folder / "p.toml").write_text(text)
    try:
        planned(folder / "p.toml", folder / "out")
    except (InputError, Unable):
        return False
    assert rejection(folder / "out") is None
    return True


@settings(max_examples=4)
@given(st.data())
def test_any_plan_is_found_again(tmp_path_factory, data):
    check_any(data.draw(plan_texts()), tmp_path_factory.getbasetemp() / "any")


@pytest.mark.deep
def test_many_plans_are_found_again(tmp_path):
    made = []

    @settings(max_examples=150)
    @given(plan_texts())
    def one(text: str) -> None:
        made.append(check_any(text, tmp_path / "any"))

    one()
    assert sum(made) >= len(made) // 4
