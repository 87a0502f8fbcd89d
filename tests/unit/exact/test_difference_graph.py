"""Bounds of differences: shortest paths as a naive computation has them, reasons that suffice, and the way back."""

from collections.abc import Sequence
from random import Random

from hypothesis import given
from hypothesis import strategies as st

from qe.exact.difference_graph import DifferenceGraph

SIZE = 5
EDGES = st.lists(
    st.tuples(st.integers(0, SIZE - 1), st.integers(0, SIZE - 1), st.integers(-4, 6)).filter(lambda e: e[0] != e[1]),
    max_size=14,
)
Edge = tuple[int, int, int]


def shortest(edges: Sequence[Edge]) -> list[list[float]] | None:
    """All distances (Floyd, Warshall), or None where a cycle is negative."""
    far = float("inf")
    found = [[0 if u == v else far for v in range(SIZE)] for u in range(SIZE)]
    for u, v, w in edges:
        found[u][v] = min(found[u][v], w)
    for k in range(SIZE):
        for u in range(SIZE):
            for v in range(SIZE):
                found[u][v] = min(found[u][v], found[u][k] + found[k][v])
    return None if any(found[u][u] < 0 for u in range(SIZE)) else found


def added(graph: DifferenceGraph, edges: Sequence[Edge]) -> list[Edge]:
    """The edges that were taken; of those that were not the reasons are looked at."""
    taken: list[Edge] = []
    for k, edge in enumerate(edges):
        found = graph.add(*edge, (k, edge))
        if isinstance(found, list):
            assert shortest([e for _, e in found]) is None  # type: ignore[misc]
            assert shortest([*taken, edge]) is None
        else:
            nearer = [] if found is None else list(zip(found.starts, found.ends, found.lengths))
            taken.append(edge)
            assert shortest(taken) is not None
            assert all(graph.length[u][v] < before for u, v, before in nearer)
    return taken


def same(graph: DifferenceGraph, edges: Sequence[Edge]) -> bool:
    expected = shortest(edges)
    assert expected is not None
    pairs = [(u, v) for u in range(SIZE) for v in range(SIZE)]
    return all(graph.length[u][v] == expected[u][v] or expected[u][v] == float("inf") for u, v in pairs)


@given(EDGES)
def test_lengths_are_those_of_shortest_paths(edges: list[Edge]) -> None:
    graph = DifferenceGraph(SIZE, 1000)
    taken = added(graph, edges)
    assert same(graph, taken)
    values = graph.potentials()
    assert all(values[v] - values[u] <= w for u, v, w in taken)


def test_lengths_in_dense_graphs_are_those_of_shortest_paths() -> None:
    """Where nearly all pairs have an edge, paths differ by little: a comparison that is off by one shows."""
    for seed in range(100):
        random = Random(seed)
        graph = DifferenceGraph(SIZE, 1000)
        ends = [random.sample(range(SIZE), 2) for _ in range(25)]
        edges = [(u, v, random.randint(-2, 9)) for u, v in ends]
        assert same(graph, added(graph, edges)), seed


@given(EDGES)
def test_reasons_are_a_path_of_this_length(edges: list[Edge]) -> None:
    graph = DifferenceGraph(SIZE, 1000)
    added(graph, edges)
    for count in range(len(graph.edges) + 1):
        earlier = DifferenceGraph(SIZE, 1000)
        for edge in graph.edges[:count]:
            earlier.add(*edge)
        for u in range(SIZE):
            for v in range(SIZE):
                if earlier.length[u][v] < 1000:
                    reasons = graph.reasons(u, v, count)
                    assert sum(e[2] for _, e in reasons) == earlier.length[u][v]  # type: ignore[misc]


@given(EDGES, EDGES, st.integers(0, 14))
def test_going_back_is_as_if_the_edges_had_never_been(first: list[Edge], second: list[Edge], count: int) -> None:
    graph = DifferenceGraph(SIZE, 1000)
    added(graph, first)
    kept = [(u, v, w) for u, v, w, _ in graph.edges[:count]]
    graph.keep(count)
    assert same(graph, kept)
    taken = [*kept]
    for edge in second:
        if not isinstance(graph.add(*edge, (0, edge)), list):
            taken.append(edge)
    assert same(graph, taken)
