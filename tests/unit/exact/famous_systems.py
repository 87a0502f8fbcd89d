"""Systems on which Groebner bases are measured, as exponents -> coefficients."""

Terms = dict[tuple[int, ...], int]


def katsura(n: int) -> list[Terms]:
    """Katsura-n in n + 1 unknowns: the sum of u_|i| u_|m-i| is u_m, and u_0 + 2 u_1 + ... + 2 u_n = 1."""
    width = n + 1

    def monomial(*places: int) -> tuple[int, ...]:
        return tuple(places.count(k) for k in range(width))

    found: list[Terms] = [{monomial(0): 1, monomial(): -1, **{monomial(k): 2 for k in range(1, width)}}]
    for m in range(n):
        terms: Terms = {monomial(m): -1}
        for i in range(-n, n + 1):
            if abs(m - i) <= n:
                place = monomial(abs(i), abs(m - i))
                terms[place] = terms.get(place, 0) + 1
        found.append(terms)
    return found


def cyclic(n: int) -> list[Terms]:
    """Cyclic n-roots."""
    found: list[Terms] = []
    for size in range(1, n):
        arcs = [{(start + k) % n for k in range(size)} for start in range(n)]
        found.append({tuple(int(k in arc) for k in range(n)): 1 for arc in arcs})
    return [*found, {(1,) * n: 1, (0,) * n: -1}]
