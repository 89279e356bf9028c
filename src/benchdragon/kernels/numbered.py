"""Names of whole numbers: the columns of a record that is a row of numbers, states, kinds, endings.

`boxes[row, Box.CX]` is the row's number at `Box.CX`; `len(Box)` says how many names there are. A class
that follows another has the names of that, too. Compiled, a name is the number that it stands for; in
plain Python it is an attribute: members of an `IntEnum` would take three times as long as an index.
"""


class Names(type):
    """The class of such classes."""

    def __len__(cls) -> int:
        """The number of names, those of the classes that it follows included."""
        return sum(name.isupper() for name in dir(cls))


class Numbered(metaclass=Names):
    """The values of its names in capitals: a whole number each."""
