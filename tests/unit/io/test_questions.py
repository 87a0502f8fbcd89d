"""Questions in words and commands of other systems: what they are read as, and what is left alone."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

import qe
from qe.io import text
from qe.io.questions import plainly


@pytest.mark.parametrize(
    ("typed", "meant"),
    (
        ("If $a,b,c>0$ and $abc=1$, prove that $a^2\\ge a$", "all a, b, c. a, b, c > 0 and a*b*c = 1 -> a^2 >= a"),
        ("Let a, b and c be positive reals with a = b. Prove a*b <= c", "all a, b, c > 0: a = b -> a*b <= c"),
        ("Let $x,y$ be real numbers. Show that $\\frac{x^{2}+y^2}{2} \\geq xy$.", "all x, y. (x^2 + y^2)/2 >= x*y"),
        ("For nonnegative reals x, y, prove $\\sqrt{xy} \\le \\frac{x+y}{2}$", "all x, y >= 0: (x*y)^.5 <= (x+y)/2"),
        ("$mx^2-2(m-1)x-m-1=0$ has only one root between $-1$ and $2$", "m <= 3/2 or m >= 3"),
        (r"Let $x,y,z\ge0$ with $x+y+z=1$. Prove $0\le xy+yz+zx-2xyz\le \frac{7}{27}$.", "true"),
        (r"for which $b$ is $\forall x\ x^2 > b$?", "b < 0"),
        ("$x2 + kx + 1 = 0$ has two roots", "$x2 + kx + 1 = 0$ has two roots"),
        ("prove that (x+y)^2 >= 4xy", "all x, y. (x + y)^2 >= 4*x*y"),
        ("Is it true that if ab > 0 then a + b > 0?", "all a, b. a*b > 0 -> a + b > 0"),
        ("prove(Implies(And(x > 0, y > 0), x + y > 0))", "all x, y. x > 0 and y > 0 -> x + y > 0"),
        ("solve([x + y > 1, y > 0], x)", "x + y > 1 and y > 0"),
        ("solve(x**2 - a, x)", "x^2 = a"),
        ("sympy.solveset(x**2 <= a, x, domain=S.Reals)", "x^2 <= a"),
        ("reduce_inequalities([x >= 2, x >= 7], [])", "x >= 2 and x >= 7"),
        ("is x^2 + x + a positive for all real x?", "all x. x^2 + x + a > 0"),
        ("is x^2 + y^2 + 1 always positive?", "all x, y. x^2 + y^2 + 1 > 0"),
        ("x^2 + 2ax + 1 >= 0 for all x in [0, 2]", "all x. x in [0, 2] -> x^2 + 2*a*x + 1 >= 0"),
        ("x^2 + kx + 1 = 0 has real and distinct roots", "at least two x. x^2 + k*x + 1 = 0"),
        ("For which values of $k$ does $x^2 + kx + 1 = 0$ have real roots?", "ex x. x^2 + k*x + 1 = 0"),
        ("x^2 + a x + b has two positive roots", "exactly two x. x^2 + a*x + b = 0 and x > 0"),
        ("find $m \\in \\mathbb{R}$ so that x^2 = m has both roots greater than -2", "0 <= m < 4"),
        ("x^2 - m has one root less than 1 and the other larger than 1", "m > 1"),
        ("x^2 - m = 0 has only one root between 1 and 2", "1 < m < 4"),
        ("for what a does the system x^2+y^2=1, x+y=a have a real solution?", "ex x, y. x^2 + y^2 = 1 and x + y = a"),
        ("theorem t (x y : ℝ) (h : 0 ≤ x ∧ x + y = 1) : x*y ≤ 1 := by sorry", "all x >= 0, y. x + y = 1 -> x*y <= 1"),
        ("example {a : ℝ} (h : 0 ≤ a) : Real.sqrt (4 * a) = (2:ℝ) * Real.sqrt a", "all a >= 0. sqrt(4*a) = 2*sqrt(a)"),
        ("Let a, b, c be the sides of a triangle. Prove a + b > c.", "true"),
        ("theorem t (n : ℕ) : n ≥ 0", "theorem t (n : ℕ) : n ≥ 0"),
        ("Does x^2 - a = 0 have two real roots?", "a > 0"),
        ("When does x^2 + bx + 1 = 0 have a solution?", "ex x. x^2 + b*x + 1 = 0"),
        ("Under what condition on a, b does ax^2 + bx + 1 = 0 have two roots?", "exactly two x. a*x^2 + b*x + 1 = 0"),
        ("Find conditions on p and q so that x^2 + px + q = 0 has a root", "ex x. x^2 + p*x + q = 0"),
        ("the condition for x^2 + px to have a positive root", "the condition for x^2 + px to have a positive root"),
        ("Find the condition for x^2 + px + 1 to have two positive roots", "p < -2"),
        ("if the equation x^2 + kx + 9 = 0 has equal roots, find k", "k^2 = 36"),
        ("Find the set of values of k for which x^2 + kx = -1 has no real roots", "k^2 < 4"),
        ("x^2 - 2mx + m + 2 = 0 has roots of opposite sign", "m < -2"),
        ("Given a + b + c = 0, is ab + bc + ca <= 0?", "true"),
        ("For all positive real numbers a and b, prove that a + b > a.", "true"),
        ("If a, b are positive reals, then a + b > a", "true"),
        ("True or false: for all real x, x^2 > x", "false"),
        ("Let a > 0. Prove that x^2 + a > b for all x", "all a, b. a > 0 -> all x. x^2 + a > b"),
        ("x^3 + a has a double root", "x^3 + a has a double root"),
        ("x^3 - x + a has both roots greater than 1", "x^3 - x + a has both roots greater than 1"),
        ("x^4 = a has roots of opposite sign", "x^4 = a has roots of opposite sign"),
        ("the system x^2 = a has no solution", "the system x^2 = a has no solution"),
        ("The system x + y = 1, x - y = a", "x + y = 1 and x - y = a"),
        ("kx^2+(k+2)x-3=0 has roots which are real and positive. Find the values k can have", "k<0<k+8, k^2+16k>=-4"),
        ("Find all values of $k$ for $kx^2+2x-3=0$ with positive roots.", "-1/3 <= k < 0"),
        ("Range of $k$ for which both the roots of the equation $kx^2-2x+k=0$ are positive.", "0 < k <= 1"),
        ("x^3 + kx + k has positive roots", "x^3 + kx + k has positive roots"),
        ("x^2 + mx + 1 has all roots real", "m^2 >= 4"),
        ("$x^2 + (m-3)x + m = 0$ has two roots. Determine the range of values for $m$.", "m^2 - 10*m > -9"),
        ("Determine m if the function f(x)=x^2+(m-1)x+2-m has two real distinct roots", "(m - 1)^2 > 4*(2 - m)"),
        ("x2 + kx + 1 = 0 has two roots", "x2 + kx + 1 = 0 has two roots"),
        ("mx2 + 2mx - 3 = 0 has real roots", "mx2 + 2mx - 3 = 0 has real roots"),
        ("x^2 + k has no distinct roots", "x^2 + k has no distinct roots"),
        ("there exists x integer > 0 such that x < y", "there exists x integer > 0 such that x < y"),
        ("there exist distinct numbers x, y with x = y", "there exist distinct numbers x, y with x = y"),
        ("dsolve(y' = y, y)", "dsolve(y' = y, y)"),
        ("x^2 - [x] = 2", "x^2 - [x] = 2"),  # the integer part
        ("solveset(x^2 < 2, x, domain=S.Integers)", "solveset(x^2 < 2, x, domain=S.Integers)"),
        ("prove x^2 >= x where x is an integer", "prove x^2 >= x where x is an integer"),
        ("Find what values of m is the line y=mx+5 a tangent to the parabola y=4-x^2?", "m^2 = 4"),
        ("for which k does the line y = x + k touch the curve y^2 = 4x?", "k = 1"),
        ("for which m is the line y = mx tangent to the hyperbola x*y = 1?", "false"),
        ("for which k does the line y = kx + 1 intersect x^2 - y^2 = 1 at two points?", "k^2 < 2 and k^2 /= 1"),
        ("Find the range of the constant $k$ for which $y = kx$ meets the curve $y = x ^ { 2 } + 1$", "k^2 >= 4"),
        ("for which a does the line y = a meet the parabola y = x^2 at only one point?", "a = 0"),
        ("y = x^2 + k and y = 2x meet in two points", "k < 1"),
        ("for which a do the parabola y = x^2 + a and the line y = x meet in two points?", "a < 1/4"),
        ("y = x^2 + a meets y = x", "a <= 1/4"),  # not the article
        ("the quadratic ax^2+bx+c has no real roots", "b^2 < 4*a*c"),
        ("the quadratic equation x^2+bx+c=0 has no real roots", "b^2 < 4*c"),
        ("Prove that (a+b+c)(1/a+1/b+1/c) >= 9 for positive a, b, c", "true"),
        ("prove that x^2 - 2x + 1 >= 0 for real numbers x", "true"),
        ("xy = k meets x - y = 1", "xy = k meets x - y = 1"),
        (r"y = x + \e is tangent to y = x^2", r"y = x + \e is tangent to y = x^2"),
        ("for which m are x^2 + mx + 1 = 0 and x^2 + x + m = 0 both solvable?", "m <= -2"),
        ("the range of values of k for which the expression kx - x^2 - 1 will be negative for all real x", "k^2 < 4"),
        ("What is the set of values of $p$ for which $p(x^2+2) < 2x^2+6x+1$ for all real values", "p < -1"),
        ("x < y for all real values", "x < y for all real values"),
        ("Prove (a+b)(1/a+1/b) >= 4 where a,b are positive.", "true"),
        ("Prove that $2ab \\le a^2 + b^2$. Note: $a$ and $b$ are positive real numbers.", "true"),
        ("$x,y$ are unequal positive quantities, prove that $2xy < x^2 + y^2$", "true"),
        ("Prove that for x > 0 we have x + 1/x >= 2", "true"),
        ("If x and y positive integers, show: x + y >= 2", "If x and y positive integers, show: x + y >= 2"),
        ("a, b, c are sides of a triangle and a > b + c", "false"),
        ("solveset(x**2 - 2*x - 15, symbol = x, domain = Interval(-oo, 0))", "x = -3"),
        ("solveset(x**2 <= 9, x, Interval.open(-3, 5))", "-3 < x <= 3"),
        ("solveset(x**2 <= 9, x, domain=Interval.Ropen(-3, 3))", "-3 <= x < 3"),
        ("solveset(x**2 <= 9, x, Interval(-3, 5, True))", "solveset(x**2 <= 9, x, Interval(-3, 5, True))"),
        ("nonlinsolve([x*y - 2, x - y - 1], x, y)", "x*y = 2 and x - y = 1"),
        ("SolveTools:-SemiAlgebraic({a*x < b}, [x])", "a*x < b"),
        ("Assuming[m > 0, Reduce[{$Assumptions, x^2 < m^2}]]", "m > 0 and x^2 < m^2"),
        ("Refine[x > m, m > 0 && x^2 < m]", "x > m and m > 0 and x^2 < m"),
        ("If the quadratic equation kx^2+kx+1=0 has no real roots, what values of k are possible?", "0 < k < 4"),
        ("The equation $$\\frac {3}{x} + 5 = c$$ where \\(c\\) is a constant, has no real roots.\nFind the range of "
         "possible values of \\(c\\).", "c = 5"),
        ("Given that \\(k x^{2} + 6 k x + 5 = 0 \\quad\\) where \\(k\\) is a non zero constant has no real roots, find "
         "the range of possible values for \\(k\\), giving your answer in surd form.", "0 < 9*k < 5"),
        ("Find the exact values of the constant \\(k\\) for which the line\n\\(y=2x+1\\)\nis a tangent to the curve\n"
         "\\(y=4x^2+kx+k-2.\\)", "k^2 - 20*k + 52 = 0"),
        ("Find the value of $k$ for which the inequality $x^2+2k>0$ is valid for ANY value of $x$.", "k > 0"),
        ("$x^2+k$, find the condition that must be satisfied by k in order that the expression may be positive for all "
         "real values of x.", "k > 0"),
        ("Let a,\\,b be positive real numbers satisfying a+b=1.\nProve that 4ab\\ge1.", "false"),
        ("Given the positive reals a,b and c,d satisfying the condition: a+c=b+d=1 Prove the inequality 1/(ac)>=4.",
         "true"),
        ("Let a, b, c three positive reals with product 1. Prove a + b + c >= 3.", "true"),
        ("Find all possible values of a for which exactly one root of x^2−a=0 lies in interval (0,3)", "0 < a < 9"),
        ("For the equation x^2 – a = 0 (a ∈ R), find the values of 'a' such that exactly one root lies in between 1 and"
         " 2.", "1 < a < 4"),
        ("For what values of a does x^2 - 2ax + a + 6 = 0 have both roots positive?", "a >= 3"),
        ("Let x, y be imaginary numbers. Show that x^2 >= 0", "Let x, y be imaginary numbers. Show that x^2 >= 0"),
        ("For which k never does x^2 = k have a root?", "For which k never does x^2 = k have a root?"),
        ("Let a, b > 0 with a negative = b. Prove a > b", "Let a, b > 0 with a negative = b. Prove a > b"),
        ("find a such that the system x + y = a has a negative solution",
         "find a such that the system x + y = a has a negative solution"),
        ("Reduce[x^2 < 1, x, Reals, Cubics -> True, Quartics -> False]", "x^2 < 1"),
        ("By considering the discriminant, or otherwise, find the range of values of 'k' that gives the equation 2 "
         "distinct roots. $$x^2+kx+1=0$$", "k^2 > 4"),
        ("Using x > 0, prove that x > -1", "Using x > 0, prove that x > -1"),
        ("By symmetry and for positive numbers, prove that x > -1",
         "By symmetry and for positive numbers, prove that x > -1"),
        ("The equation of a curve is \\(y = x^2 + mx\\), where \\(m\\) is a constant, and the equation of a line is "
         "\\(y = 1\\). Show that, for all values of \\(m\\), the line intersects the curve at two distinct points.",
         "true"),
        ("The curve $C$ has equation $y = x^2$ and the line $L$ has equation $y = mx - 1$. Given that $L$ intersects "
         "$C$ at two distinct points, find the range of values of $m$.", "m^2 > 4"),
        ("The equation of a curve is y = x^2 + k. The equation of a line is y = x. Find k such that it meets it",
         "The equation of a curve is y = x^2 + k. The equation of a line is y = x. Find k such that it meets it"),
        ("Given the circle x^2+y^2=1 and the line y = x, find k such that the line y = k meets the circle",
         "Given the circle x^2+y^2=1 and the line y = x, find k such that the line y = k meets the circle"),
        ("It is given that f(x) = x^2 - kx + k. If the equation f(x) = 0 has real roots find the range of k.",
         "k <= 0 or k >= 4"),
        ("Let f(x)=x^2+k. Find k such that f(2) = 0", "Let f(x)=x^2+k. Find k such that f(2) = 0"),
        ("Let kx^2+2x+1=0 be a quadratic equation. Find k such that it has real roots.", "k /= 0 and k <= 1"),
        ("The equation of a curve is y = x^2 - 6x + k, where k is a constant. Find the set of values of k for which "
         "the whole of the curve lies above the x-axis.", "k > 9"),
        ("Find k such that the curve y = x^2 + kx + 1 does not meet the x-axis", "k^2 < 4"),
        ("Find k such that the curve y = x^2 + k does not lie below the x-axis",
         "Find k such that the curve y = x^2 + k does not lie below the x-axis"),
        ("Determine the values of k for which the line y = 4x + k does not intersect the curve y = x^2", "k < -4"),
        ("for which k is x^2+kx+1 always positive?", "k^2 < 4"),
        ("Prove/disprove that $x+y>0$ with $x$ and $y$ are positives.", "true"),
        ("Prove that x^2 = k has two roots, where k is a positive constant", "true"),
        ("Show that the roots of x^2 + px - q^2 = 0 are real for all values of p and q.", "true"),
        ("Show that the roots of x^2 - 1 = 0 are not real", "Show that the roots of x^2 - 1 = 0 are not real"),
        ("Prove that all the roots of x^3+px+q=0 are real", "Prove that all the roots of x^3+px+q=0 are real"),
        ("Find all numbers a, such that x^2-ax-a = 0 has one positive root and one negative root.", "a > 0"),
        ("Let $a<b$ be positive numbers. Prove that $a^2<b^2$.", "true"),
        ("Solve the system of equations\n    x + yz = 2,    (1)\n    y + zx = 2,    (2)\n    z + xy = 2.    (3)",
         "x = 1 and y = 1 and z = 1 or x = -2 and y = -2 and z = -2"),
    ),
)  # fmt: skip
def test_what_is_read(typed: str, meant: str) -> None:
    if typed == meant:
        with pytest.raises(qe.InputError):
            text.read(typed)
        return
    assert qe.equivalent(text.read(typed), text.read(meant))


@pytest.mark.parametrize(
    ("typed", "names"),
    (
        ("solve({x^2+y^2=5, x*y=2}, [x,y])", ("x", "y")),
        ("solve(t*(t + 2*y) + x > 1000, t)", ("t",)),
        ("Solve for x and y: x + y = a, x - y = b", ("x", "y")),
        ("find all m and n such that x^2 + m x + n > 0 for all x", ("m", "n")),
        ("Find all real numbers x, y satisfying x^2 + y^2 = 2, x + y = 2", ("x", "y")),
        ("x + y = 1", ()),
        ("CylindricalDecomposition[x^2 + y^2 < 1, {x, y}];", ("x", "y")),
        ("Reduce[x^2 < a, x, Reals, Cubics -> True]", ("x",)),
        ("Reduce[x < 1, x] && y > 2", ()),
    ),
)
def test_the_variables_that_are_sought(typed: str, names: tuple[str, ...]) -> None:
    assert (text.solved_for(typed) or ()) == names


@pytest.mark.parametrize(
    "typed", ("x is positive", "let x = 2", "x has y", "solve", "$x", "if a > 0 then b > 0", "prove")
)
def test_what_is_no_question_stays_as_it_is(typed: str) -> None:
    assert plainly(typed).formula == typed


ENDS = st.integers(-4, 4)


@given(ENDS, ENDS, ENDS, ENDS, st.sampled_from(("no", "exactly one", "two", "only one", "a")))
def test_roots_in_an_interval_are_counted(p: int, q: int, low: int, high: int, many: str) -> None:
    typed = f"(x - ({p}))*(x - ({q})) has {many} roots in [{low}, {high}]"
    count = len({root for root in (p, q) if low <= root <= high})
    wanted = {"no": count == 0, "two": count == 2, "a": count > 0}.get(many, count == 1)
    assert bool(qe.decide(typed)) == wanted


@given(ENDS, ENDS, ENDS)
def test_both_roots_and_one_on_either_side(p: int, q: int, bound: int) -> None:
    quadratic = f"x^2 - ({p + q})*x + ({p * q}) = 0"
    assert bool(qe.decide(f"{quadratic} has both roots greater than {bound}")) == (min(p, q) > bound)
    sides = f"{quadratic} has one root smaller than {bound} and the other greater than {bound}"
    assert bool(qe.decide(sides)) == (min(p, q) < bound < max(p, q))


@pytest.mark.parametrize(
    "typed",
    (
        "x + 1/x, x > 0",
        "x + 1/x over x > 0",
        "the minimum of x + 1/x on (0, 5]",
        "What is the least value of x + 1/x when x > 0?",
        "Find the smallest possible value of x + 1/x if x > 0.",
        "If x > 0, find the minimum of x + 1/x",
        "Given x, y > 0 and x*y = 1, what is the least value of x + y?",
        "minimum of x + 1/x for positive x",
        "find x and y such that x + y is a minimum subject to the constraint that xy = 1, x > 0",
        "Find numbers \\(x\\) and y satisfying x*y = 1, x > 0 such that the sum of x and y is as small as possible",
        "Find the minimum of \\( f(x, y) = x + y \\) subject to the constraint \\( x*y=1 \\), x > 0",
        "Real numbers x and y satisfy the inequalities 2xy >= x + y > 0. What is the smallest value that x+y can take?",
        "$x$ is a positive number such that $x \\ge 1$. Find the minimum value of $x + 1/x$ to 2 decimal places.",
        "Find the minimum value of the following expression for positive real numbers \\(x\\): \\[x + \\frac{1}{x}\\]",
        "To minimize f(x) = x + 1/x subject to the constraint x > 0",
        "If x + 1/y = 2 where x and y are positive then the minimum value of x + 1/y is",
        "Know that x*y = 1 and x > 0 find the minimum of x + y ?",
        "Find the smallest possible value of $x + 1/x$ given that $x > 0$.",
        "minimize x + 1/x under x > 0",
        "minimize(x + 1/x, x=1/2..3, locus)",
        "minimize(x + y, [x*y = 1, x >= 0], [x, y])",
        "f := x + y; c := [x*y = 1, x >= 0]; minimize(f, c, [x, y])",
    ),
)
def test_optima(typed: str) -> None:
    assert qe.minimize(typed).value == 2


def test_without_variables_the_usual_unknowns_are_meant() -> None:
    with pytest.warns(qe.DoubtfulInput, match="solved for x; variables="):
        assert str(qe.solve("x^2 = a")) == "a >= 0 and (x = -sqrt(a) or x = sqrt(a))"
    assert qe.solve("a = b").order == ("a", "b") and qe.solve("y = x^2").order == ("x", "y")
    assert qe.solve("zeta = a").order == ("zeta", "a")  # which only begins with such a letter


@pytest.mark.parametrize(
    ("system", "cases"),
    (
        ("a*x + b*y = e, c*x + d*y = f", 6),
        ("a*x + b*y = 1 and b*x + a*y = 2", 1),
        ("x + a*y = 1, x + a*y = 2", 1),
        ("a*x + y = 1, x + a*y = b, b > 0", 2),
    ),
)
def test_linear_systems_by_their_determinant(system: str, cases: int) -> None:
    solutions = qe.solve(system, ["x", "y"], check=True)
    assert len(str(solutions).split(" or\n")) == cases and solutions.guarantee is qe.Guarantee.CHECKED


@given(
    ENDS, ENDS, ENDS, ENDS, st.sampled_from((" at two points", " at only one point", " at no points", "", "tangent"))
)
def test_lines_and_parabolas(a: int, b: int, c: int, m: int, how: str) -> None:
    """By the discriminant; a line has one point with another line, or is that line, and then they touch."""
    curve = f"the curve y = ({a})*x^2 + ({b})*x + ({c})"
    line = f"the line y = ({m})*x + 1"
    typed = f"{line} is tangent to {curve}" if how == "tangent" else f"{line} meets {curve}{how}"
    linear, constant = b - m, c - 1
    disc = linear**2 - 4 * a * constant
    if a:
        points: float = 0 if disc < 0 else 1 if disc == 0 else 2
    else:
        points = 1 if linear else 0 if constant else float("inf")
    touching = (points == 1 and a != 0) or points == float("inf")
    wanted = {
        " at two points": points == 2,
        " at only one point": points == 1,
        " at no points": points == 0,
        "": points > 0,
    }
    assert bool(qe.decide(typed)) == wanted.get(how, touching)


def test_words_that_are_not_understood_are_refused_in_one_line_that_says_so() -> None:
    with pytest.raises(qe.ParseError, match=r"the words of this question are not understood.*as in: for which k"):
        text.read("A line with slope m passes through the point of the curve y = x^2 that is nearest. Find m.")
    with pytest.raises(qe.InputError, match="as in: the least value of x"):
        qe.minimize("Find the least value of x^2 and the values of x at which it is reached")


@pytest.mark.parametrize(
    ("typed", "is_true"),
    (
        ("The equation x^2 + kx + 1 = 0 has two distinct real roots. Show that k^2 > 4.", True),
        ("The equation x^2 + kx + 1 = 0 has two distinct real roots. Show that k > 2.", False),
        ("Given that x^2 + kx + 1 = 0 has no real roots, show that k^2 < 4.", True),
        ("The line y = kx - 1 and the curve y = x^2 meet at two points. Show that k^2 > 4.", True),
        ("If x^2 + a is always positive, prove that a > 0.", True),
        ("If x^2 + a is always positive, prove that a > 1.", False),
        (
            "A curve has equation y = 2x^2 - x - 1 and a line has equation y = k(2x - 3), where k is a constant."
            " The curve and the line intersect at two distinct points. Show that 4k^2 - 20k + 9 > 0.",
            True,
        ),
    ),
)
def test_what_is_proved_of_roots_or_curves_that_are_supposed(typed: str, is_true: bool) -> None:
    assert qe.decide(typed) is is_true


@pytest.mark.parametrize(
    ("typed", "meant"),
    (
        (
            "If the line y+2x=p does not intersect the curve y^2=x+p , find the range of values of p.",
            "not ex x, y. y + 2*x = p and y^2 = x + p",
        ),
        (
            "The line y = 3x - p does not cross or touch the curve y = px^2, where p is a constant. "
            "Find the values of p.",
            "not ex x, y. y = 3*x - p and y = p*x^2",
        ),
        (
            "For which values of m, the line y = 2x - 4 is tangent to the curve y = (m + 3)x^2 + mx?",
            "ex x. (m + 3)*x^2 + m*x = 2*x - 4 and 2*(m + 3)*x + m = 2",
        ),
        (
            "For which values of $m$ is the line $y=2x-4$ tangent to the curve $y=(m+3)x^2+mx ?$",
            "ex x. (m + 3)*x^2 + m*x = 2*x - 4 and 2*(m + 3)*x + m = 2",
        ),
    ),
)
def test_lines_in_any_form(typed: str, meant: str) -> None:
    assert qe.equivalent(typed, meant)


@pytest.mark.parametrize("claim", ("x > 0", "kx > 0"))
def test_a_claim_about_a_root_that_has_no_name_is_refused(claim: str) -> None:
    with pytest.raises(qe.ParseError, match="not understood"):
        text.read(f"The equation x^2 + kx + 1 = 0 has two solutions for x. Show that {claim}.")


@pytest.mark.parametrize(
    "typed",
    (
        "The line y = mx + 1 is a tangent to the curve y^2 = 4x if the value of m is",
        "If the line y = mx + 1 is a tangent to the parabola y^2 = 4x then find the value of m",
        "For what value of m is the line y = mx + 1, a tangent to the curve y^2 = 4x?",
        "Find the two distinct values of m for which the line y = mx + 1 is a tangent to the curve y^2 = 4x.",
    ),
)
def test_tangents_as_they_are_asked_for(typed: str) -> None:
    assert str(qe.solve(typed)) == "m = 1"


def test_a_question_in_parts_is_refused_with_a_word_about_its_parts() -> None:
    with pytest.raises(qe.InputError, match="ask one part at a time"):
        text.read("x^2 + kx + 8 = k has no real roots. (a) Show that k^2 + 4k < 32. (b) Hence find the values of k.")
