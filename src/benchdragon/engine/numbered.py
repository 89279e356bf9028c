"""Members of `Numbered` as numba has them: the numbers that they are, as if these stood there."""

from typing import Any

import numba as whole
from numba import extending
from numba.core import types
from numba.core.typing import templates

from benchdragon.kernels.numbered import Names

# Their annotations are partial.
compiler: Any = whole
numba: Any = extending
kinds: Any = types
typing: Any = templates


class NamesType(kinds.Dummy):  # type: ignore[misc]
    """The type of such a class: that class alone."""

    def __init__(self, names: Names) -> None:
        self.names = names
        super().__init__(name=f"Names[{names.__module__}.{names.__name__}]")


numba.register_model(NamesType)(numba.models.OpaqueModel)


@numba.typeof_impl.register(Names)  # type: ignore[untyped-decorator]
def _type_of(names: Names, _context: object) -> NamesType:
    return NamesType(names)


@typing.infer_getattr
class _Members(typing.AttributeTemplate):  # type: ignore[misc]
    key = NamesType

    def generic_resolve(self, kind: NamesType, name: str) -> Any:
        value = getattr(kind.names, name)
        return kinds.maybe_literal(value) or compiler.typeof(value)


@numba.lower_getattr_generic(NamesType)  # type: ignore[untyped-decorator]
def _member(context: Any, builder: Any, kind: NamesType, _value: object, name: str) -> Any:
    value = getattr(kind.names, name)
    return context.get_constant_generic(builder, compiler.typeof(value), value)
