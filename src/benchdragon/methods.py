"""Public functions as methods: `plan.check()` is `check(plan)`, though plans know nothing of checks.

Records stand on low floors, what is asked about them higher up. The front door, which knows all public
names, says how one is fetched.
"""

from collections.abc import Callable
from types import MethodType
from typing import Any, ClassVar


class Method:
    """A method of a record that is a public function, whose first argument is the record.

    Args:
        name: of the function; as the method is called unless given.
    """

    fetch: ClassVar[Callable[[str], Any]]

    def __init__(self, name: str = "") -> None:
        self.name = name

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = self.name or name

    def __get__(self, record: object, kind: type | None = None) -> Any:
        function = type(self).fetch(self.name)
        return function if record is None else MethodType(function, record)
