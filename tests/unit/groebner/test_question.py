"""A parametric system with constants and side conditions, solved."""

from qe.exact.algebraic import RealAlgebraic
from qe.exact.block_order import BlockOrder
from qe.exact.ring import Ring
from qe.groebner.question import ParametricSystem
from qe.options import Budget
from tests.unit.exact.ideal_membership import in_ideal

RING = Ring.of(("a", "w", "x"))
A, W, X = (RING.var(name) for name in RING.names)
BLOCK = BlockOrder((2,), (0, 1))
ROOT_2 = RealAlgebraic.from_root([-2, 0, 1], 1, 2)


def test_constants_have_their_minimal_polynomials() -> None:
    given = ParametricSystem(RING, BLOCK, (W * X - A,), {"w": ROOT_2})
    assert given.moduli == (W**2 - 2,)
    found = given.solved(Budget(60))
    assert found.parameters == ("a",) and found.variables == ("x",) and found.constants == {"w": ROOT_2}
    assert all(in_ideal(W**2 - 2, s.equal) for s in found) and [s.leads for s in found] == [((1,),)]


def test_side_conditions() -> None:
    given = ParametricSystem(RING, BlockOrder((2,), (0, 1)), (A * X - 1,), {}, (W,), (A,))
    (only,) = given.solved(Budget(60))
    assert only.equal == (W,) and only.nonzero == (A,) and only.leads == ((1,),)


def test_faithful_elements_only_where_asked_for() -> None:
    given = ParametricSystem(RING, BLOCK, (A * X - 1, W * X), {})
    assert all(s.faithful is None for s in given.solved(Budget(60)))
    assert all(s.faithful is not None for s in given.solved(Budget(60), faithful=True))


def test_no_polynomials() -> None:
    (only,) = ParametricSystem(RING, BLOCK, (), {}).solved(Budget(60))
    assert only.basis == ()
