"""Calls of Python in JavaScript: of functions, methods, records and entries of kernels."""

import ast
import re
from collections.abc import Sequence

from tools.translation.expressions import Expressions
from tools.translation.names import (
    BUILTIN,
    FUNCTIONS,
    KNOWN,
    METHODS,
    OF_MODULES,
    WAITED,
    UntranslatableError,
    camel,
)


class Calls(Expressions):
    """Calls besides."""

    def _of_call(self, node: ast.Call) -> str:
        entry = self.entry(ast.unparse(node.func))
        if entry and self._is_outside(getattr(node.func, "value", node.func)):
            said = f'py.entry("{entry[0]}", {self._given(node)})'
            return f"{said}[0]" if entry[1] else said
        if self._is_outside(getattr(node.func, "value", node.func)):
            name = ast.unparse(node.func)
            if (fields := self.group(name)) is not None:
                return self._grouped(node, fields)
            if owned := self.owned(name):
                return f"{owned[0]}({self._given(node, owned[1])})"
        match node.func:
            case ast.Attribute(value=ast.Call(func=ast.Name(id="super")), attr=attr):
                return f"super{'' if attr == '__init__' else f'.{attr}'}({self._given(node)})"
            case ast.Attribute(value=value, attr=attr):
                return self._method_call(node, value, attr)
            case ast.Name(id=name) if self.me and name == self.me[-1]:
                return f"new this({self._given(node, self.parameters(self.record_name))})"
            case ast.Name(id=name) if not any(name in scope for scope in self.scopes):
                return self._function_call(node, name)
        return f"{self.expr(node.func)}({self._given(node)})"

    def _grouped(self, node: ast.Call, fields: Sequence[str]) -> str:
        """A group of arrays for entries."""
        given = [*zip(fields, map(self.expr, node.args), strict=False)]
        given += [(str(one.arg), self.expr(one.value)) for one in node.keywords]
        if sorted(name for name, _said in given) != sorted(fields):
            raise UntranslatableError(node, "of other fields")
        return f"({{ {', '.join(f'{name}: {said}' for name, said in given)} }})"

    def _function_call(self, node: ast.Call, name: str) -> str:
        if (keys := self.plain(name)) is not None:
            return self._data(node, keys)
        match name:
            case "any" | "all":
                return self._whether(node.args[0], "some" if name == "any" else "every")
            case "map" | "filter":
                return self._mapped(name, *node.args)
            case "isinstance":
                return self._instance(*node.args)
            case "getattr" | "fields" | "partial" | "replace":
                return self._of_record(node, name)
            case "_" | "N_":
                self.use(name)
                return f"{name}({self.expr(node.args[0])})"
            case "set":
                return f"py.set_of({self._given(node)})"
            case _ if name in FUNCTIONS:
                return f"py.{name}({self._given(node, BUILTIN.get(name))})"
        return self._own_call(node, name)

    def _own_call(self, node: ast.Call, name: str) -> str:
        """A call of a function, or a record, of this module or taken from another."""
        self.use(name)
        if (how := self.waits(name)) and how not in ("freed", "unasked"):
            return self._awaited(node, name)
        made = "new " if name.lstrip("_")[:1].isupper() else ""
        return f"{made}{camel(name)}({self._given(node, self.parameters(name))})"

    def _bound(self, node: ast.Call) -> str:
        """A call that is made later, of what is given now."""
        function, *given = node.args
        if node.keywords:
            raise UntranslatableError(node, "by names")
        names = [f"given{n}" for n in range(len(given))]
        if isinstance(function, ast.Attribute):
            given, names = [function.value, *given], ["of", *names]
            function = ast.Attribute(ast.Name("of"), function.attr)
        self.scopes.append({*names})
        self.waited.append(None)
        call = self.expr(ast.Call(function, [ast.Name(one) for one in names if one != "of"], []))
        self.waited.pop()
        self.scopes.pop()
        return f"(({', '.join(names)}) => () => {call})({', '.join(map(self.expr, given))})"

    def _of_record(self, node: ast.Call, name: str) -> str:
        """What is asked of a record; and a call that is made later."""
        if name == "partial":
            return self._bound(node)
        first, *others = map(self.expr, node.args)
        if name == "replace":
            return f"py.replaced({first}, {self._object(node.keywords)})"
        if name == "fields":
            return f"{first}.__fields__"
        return f"{first}[{others[0]}]" if len(others) == 1 else f"py.get({first}, {', '.join(others)})"

    def _method_call(self, node: ast.Call, value: ast.expr, attr: str) -> str:
        if attr in self.of_class and ast.unparse(value) == "self":
            raise UntranslatableError(node, f".{attr}: a method of the class, asked of a record")
        if isinstance(value, ast.Name) and value.id == "re" and attr != "escape":
            return self._of_pattern(node, attr)
        if (names := self.function_for(attr)) is not None:
            return f"{attr}({self.expr(value)}, {self._given(node, names)})"
        return self._known_method(node, value, attr)

    def _of_pattern(self, node: ast.Call, attr: str) -> str:
        """A function of `re`."""
        pattern, *rest = node.args
        flags = next((one.value for one in node.keywords if one.arg == "flags"), None)
        if not isinstance(pattern, ast.Constant) or flags:
            raise UntranslatableError(node, "of no constant")
        return f"{self.hoist(str(pattern.value), 0)}.{attr}({', '.join(map(self.expr, rest))})"

    def _known_method(self, node: ast.Call, value: ast.expr, attr: str) -> str:
        whole = ast.unparse(node.func)
        if whole in OF_MODULES:
            name = OF_MODULES[whole]
            return f"py.{name}({self._given(node, BUILTIN.get(name))})"
        if attr == "format":
            if node.args:
                raise UntranslatableError(node, "by places")
            return f"py.filled({self.expr(value)}, {self._object(node.keywords)})"
        if attr == "_replace":
            return f"py.replaced({self.expr(value)}, {self._object(node.keywords)})"
        if attr in METHODS:
            given = self._given(node, ("sep", "maxsplit") if attr == "split" else None)
            return f"py.{attr}({self.expr(value)}{given and ', '}{given})"
        return self._own_method(node, value, attr)

    def _own_method(self, node: ast.Call, value: ast.expr, attr: str) -> str:
        """A call of a method of records, or of what pages write by hand."""
        if attr in WAITED and (self.waited or [None])[-1] is not None:
            self.waited[-1] = True
            return f"(await {self.expr(value)}.{attr}({self._given(node)}))"
        names = self.parameters(f".{attr}")
        if names is None and attr not in KNOWN:
            raise UntranslatableError(node, f".{attr}: a method of nothing known")
        return f"{self.expr(value)}.{attr}({self._given(node, names)})"

    def _awaited(self, node: ast.Call, name: str) -> str:
        """A call that gives way between its steps, as does who calls."""
        if not self.waited or self.waited[-1] is None:
            raise UntranslatableError(node, "where nothing can wait")
        self.waited[-1] = True
        return f"(await {camel(name)}({self._given(node, self.parameters(name))}))"

    def _data(self, node: ast.Call, keys: dict[str, tuple[str | None, str]]) -> str:
        """A record that is plain data."""
        given = {str(one.arg): self.expr(one.value) for one in node.keywords}
        said = {key: default for key, (default, _change) in keys.items()}
        for key in given.keys() & keys.keys():
            change = keys[key][1]
            said[key] = f"{change}({given[key]})" if change else given[key]
        if node.args or not given.keys() <= keys.keys() or None in said.values():
            raise UntranslatableError(node, "of plain data")
        return f"({{ {', '.join(f'{key}: {value}' for key, value in said.items())} }})"

    def _object(self, keywords: list[ast.keyword]) -> str:
        pairs = (
            f"{one.arg}: {self.expr(one.value)}" if one.arg else f"...py.object({self.expr(one.value)})"
            for one in keywords
        )
        return f"{{ {', '.join(pairs)} }}"

    def _given(self, node: ast.Call, names: Sequence[str] | None = None) -> str:
        """What a call is given, in the order of what the function takes."""
        said = [self.expr(one) for one in node.args]
        keywords = {one.arg: _called(one.value) for one in node.keywords if one.arg != "strict"}
        if keywords:
            starred = any(isinstance(one, ast.Starred) for one in node.args)
            if names is None or starred or not {*keywords} <= {*names}:
                raise UntranslatableError(node, f"by names: {', '.join(map(str, keywords))}")
            last = max(names.index(str(name)) for name in keywords)
            said += [
                self.expr(keywords[name]) if name in keywords else "undefined"
                for name in names[len(said) : last + 1]
            ]
        return ", ".join(said)

    def _whether(self, node: ast.expr, how: str) -> str:
        if isinstance(node, ast.GeneratorExp):
            return self._comprehended(node.generators, lambda: self.truth(node.elt), how)
        return f"py.list({self.expr(node)}).{how}((one) => py.truth(one))"

    def _mapped(self, name: str, function: ast.expr, *over: ast.expr) -> str:
        lists = self.expr(over[0])
        if name == "filter" and isinstance(function, ast.Constant):
            return f"py.list({lists}).filter((one) => py.truth(one))"
        self.scopes.append({"one"})
        self.waited.append(None)
        said = self.expr(ast.Call(function, [ast.Name("one")], []))
        self.waited.pop()
        self.scopes.pop()
        return f"py.list({lists}).{name}((one) => {said})"

    def _instance(self, value: ast.expr, kinds: ast.expr) -> str:
        named = {"str", "int", "float", "bool", "list", "dict", "tuple", "date", "datetime"}
        one = self.expr(value)
        tests = (
            f'py.is({one}, "{kind}")'
            if kind in named
            else f"{one} instanceof {self.expr(ast.Name(kind))}"
            for kind in re.findall(r"\w+", ast.unparse(kinds))
        )
        return f"({' || '.join(tests)})"


def _called(node: ast.expr) -> ast.expr:
    """A method that is handed on, as a function."""
    if isinstance(node, ast.Attribute) and node.attr in METHODS:
        call = ast.Call(node, [ast.Name("given")], [])
        return ast.Lambda(ast.arguments([], [ast.arg("given")], None, [], [], None, []), call)
    return node
