"""Elements and cards of types that are left out of a mesh, counted for messages."""

MOST_NAMED = 20  # types


class LeftOut:
    """Numbers of elements by type, with the place of the first of each."""

    def __init__(self):
        self.counts = {}  # type -> [count, place of the first]

    def __bool__(self):
        return bool(self.counts)

    def add(self, kind, count, where):
        """@param where: "line 12", or file and line"""
        self.counts.setdefault(kind, [0, where])[0] += count

    def join(self, other):
        for kind, (count, where) in other.counts.items():
            self.add(kind, count, where)

    def copy(self):
        result = type(self)()
        result.join(self)
        return result

    def text(self):
        """"3 MASS (the first at deck.inp:12), 2 SPRINGA (deck.inp:15)": each type with its number and its first place."""
        names = [f"{count} {kind} ({'the first ' if k == 0 else ''}at {where})" for k, (kind, (count, where)) in enumerate(self.counts.items())]
        rest = names[MOST_NAMED:]
        more = sum(count for count, _ in list(self.counts.values())[MOST_NAMED:])
        return ", ".join(names[:MOST_NAMED]) + (f", and {more} of {len(rest)} more types" if rest else "")
