"""Python that knows texts, lists and records, and calls entries of kernels, as JavaScript for pages.

A part of the language, with types left out: functions and generators, records (dataclasses and
named tuples), comprehensions, regular expressions, `format`. Anything else is an error that names
its line, so that nothing is translated wrongly in silence. What differs between the two languages
(what counts as true, equal or part of something, places from the end, signs beyond 16 bits,
formats) is asked of `py`, in web/compute/python.js.
"""

import ast
import inspect
from collections.abc import Iterable, Iterator

from tools.translation.calls import Calls
from tools.translation.expressions import arguments_of
from tools.translation.names import WAITED, UntranslatableError, camel

# What methods may be marked with.
DECORATORS = {"cached_property", "classmethod", "property", "staticmethod"}
# Classes that records are built on in Python alone.
PLAIN = {"AskedPlan", "Table"}
# Methods that have another name there; what an error says is its message.
MADE = {"__init__": "constructor", "__str__": "get message"}


class Code(Calls):
    """Statements, functions and records."""

    # Statements

    def block(self, body: Iterable[ast.stmt]) -> str:
        """Statements, one a line."""
        return "\n".join(line for node in body for line in self.statement(node))

    def statement(self, node: ast.stmt) -> Iterator[str]:
        """The lines of a statement."""
        found = getattr(self, f"_{type(node).__name__.lower()}", None)
        if found is None:
            raise UntranslatableError(node)
        yield from found(node)

    def _expr(self, node: ast.Expr) -> Iterator[str]:
        if isinstance(node.value, ast.Call) and ast.unparse(node.value.func) == "object.__setattr__":
            at, name, value = node.value.args
            yield f"{self.expr(at)}[{self.expr(name)}] = {self.expr(value)};"
        elif not isinstance(node.value, ast.Constant) and not self._is_unasked(node.value):
            yield f"{self.expr(node.value)};"

    def _is_unasked(self, node: ast.expr) -> bool:
        """Whether something is but checked that Python is called with."""
        named = isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
        return named and self.waits(node.func.id) == "unasked"  # type: ignore[attr-defined]

    def _pass(self, _node: ast.Pass) -> Iterator[str]:
        yield from ()

    _nonlocal = _pass

    def _return(self, node: ast.Return) -> Iterator[str]:
        yield f"return {self.expr(node.value) if node.value else 'null'};"

    def _continue(self, _node: ast.Continue) -> Iterator[str]:
        yield "continue;"

    def _break(self, _node: ast.Break) -> Iterator[str]:
        yield "break;"

    def _raise(self, node: ast.Raise) -> Iterator[str]:
        yield f"throw {self.expr(node.exc) if node.exc else 'error'};"

    def _assign(self, node: ast.Assign) -> Iterator[str]:
        if ast.unparse(node.targets[0]).endswith(".flags.writeable"):
            return  # which arrays of pages do not know
        target, value = node.targets[0], node.value
        if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple) and _all_apart(target, value):
            for one, of in zip(target.elts, value.elts, strict=True):
                yield self._set(one, self.expr(of))
        elif len(node.targets) == 1:
            yield self._set(node.targets[0], self.expr(node.value))
        else:
            each = " ".join(self._set(target, "all") for target in node.targets)
            yield f"{{ const all = {self.expr(node.value)}; {each} }}"

    def _annassign(self, node: ast.AnnAssign) -> Iterator[str]:
        if node.value:
            yield self._set(node.target, self.expr(node.value))

    def _augassign(self, node: ast.AugAssign) -> Iterator[str]:
        name = {ast.Add: "extend", ast.BitOr: "merge"}.get(type(node.op))
        at, value = self.expr(node.target), self.expr(node.value)
        if name:
            yield self._set(node.target, f"py.{name}({at}, {value})")
        else:
            yield self._set(node.target, self._operation(node.op, node.target, node.value))

    def _delete(self, node: ast.Delete) -> Iterator[str]:
        for one in node.targets:
            if not isinstance(one, ast.Subscript):
                raise UntranslatableError(node)
            yield f"py.pop({self.expr(one.value)}, {self.expr(one.slice)});"

    def _set(self, target: ast.expr, value: str) -> str:
        if isinstance(target, ast.Subscript) and ast.unparse(target.value).endswith(".__dict__"):
            owner = target.value.value  # type: ignore[attr-defined]
            return f"py.keep({self.expr(owner)}, {self.expr(target.slice)}, {value});"
        if isinstance(target, ast.Subscript):
            return f"py.set({self.expr(target.value)}, {self.expr(target.slice)}, {value});"
        if isinstance(target, ast.Tuple | ast.List):
            return f"{self.pattern(target)} = py.list({value});"
        return f"{self.pattern(target)} = {value};"

    def _if(self, node: ast.If) -> Iterator[str]:
        yield f"if ({self.truth(node.test)}) {{\n{self.block(node.body)}\n}}"
        if node.orelse:
            yield f"else {{\n{self.block(node.orelse)}\n}}"

    def _while(self, node: ast.While) -> Iterator[str]:
        if node.orelse:
            raise UntranslatableError(node, "with else")
        yield f"while ({self.truth(node.test)}) {{\n{self.block(node.body)}\n}}"

    def _for(self, node: ast.For) -> Iterator[str]:
        if node.orelse:
            raise UntranslatableError(node, "with else")
        yield f"for ({self.pattern(node.target)} of py.iter({self.expr(node.iter)})) {{"
        yield f"{self.block(node.body)}\n}}"

    def _try(self, node: ast.Try) -> Iterator[str]:
        if node.orelse or node.finalbody:
            raise UntranslatableError(node, "with else or finally")
        yield f"try {{\n{self.block(node.body)}\n}} catch (error) {{"
        for handler in node.handlers:
            kinds = handler.type.elts if isinstance(handler.type, ast.Tuple) else [handler.type]
            tests = " || ".join(f"error instanceof {self.expr(kind)}" for kind in kinds if kind)
            named = (
                f"const {camel(handler.name)} = error;\n"
                if handler.name and handler.name != "error"
                else ""
            )
            self.scopes.append({handler.name or "error", "error"})
            yield f"if ({tests}) {{\n{named}{self.block(handler.body)}\n}} else"
            self.scopes.pop()
        yield "throw error;\n}"

    def _with(self, node: ast.With) -> Iterator[str]:
        """What is done with a function of pages: what it gives takes errors, or is freed at the end."""
        (item,) = node.items
        call, name = item.context_expr, item.optional_vars
        if ast.unparse(call).startswith("np.errstate("):  # JavaScript never warns
            yield self.block(node.body)
            return
        if not (isinstance(call, ast.Call) and isinstance(call.func, ast.Name)):
            raise UntranslatableError(node, "of more than a call")
        how = "freed" if isinstance(name, ast.Name) else "" if name else "around"
        if not how or self.waits(call.func.id) != how:
            raise UntranslatableError(node, "of a function that pages do not have")
        if how == "freed":
            made = self.expr(call)
        else:
            self.use(call.func.id)
            made = f"{camel(call.func.id)}({self._given(call, self.parameters(call.func.id))})"
        body = self.block(node.body)
        if isinstance(name, ast.Name):
            kept = camel(name.id)
            yield f"{kept} = {made};\ntry {{\n{body}\n}} finally {{\n{kept}.free();\n}}"
        else:
            yield f"{{\nconst caught = {made};\ntry {{"
            yield f"{body}\n}} catch (error) {{\ncaught(error);"
            yield "} finally {\ncaught.ended?.();\n}\n}"

    def _functiondef(self, node: ast.FunctionDef) -> Iterator[str]:
        yield self.function(node)

    # Functions and records

    def function(self, node: ast.FunctionDef, head: str = "", me: str = "") -> str:
        """A function; of a method, `head` stands in place of the word, and `me` is its first name."""
        names = [one.arg for one in arguments_of(node.args)]
        own = set(names) | ({me} if me else set())
        outer = {
            name for one in _within(node.body) if isinstance(one, ast.Nonlocal) for name in one.names
        }
        inside = set(_stored(node.body)) - own - outer
        nested = {one.name for one in _within(node.body) if isinstance(one, ast.FunctionDef)}
        self.scopes.append(own | inside | nested)
        self.me.append(me)
        parameters = self.taken(node.args, skip=bool(me.strip()))
        told = f"let {', '.join(camel(one) for one in sorted(inside))};\n" if inside else ""
        self.waited.append(False)
        body = self.block(node.body)
        wait = "async " if self.waited.pop() else ""
        if wait and me and node.name not in WAITED:
            raise UntranslatableError(node, "a method that waits: see WAITED")
        if wait and any(ast.unparse(one) == "budget.question()" for one in node.decorator_list):
            told, body = "", f"return py.scoped(async () => {{\n{told}{body}\n}});"
        self.waiting |= {node.name} if wait else set()
        self.me.pop()
        self.scopes.pop()
        star = (
            "*" if any(isinstance(one, ast.Yield | ast.YieldFrom) for one in _within(node.body)) else ""
        )
        word = f"{wait}{star}{head}" if me else f"{wait}function{star} {camel(node.name)}"
        return f"{word}({parameters}) {{\n{told}{body}\n}}"

    def record(self, node: ast.ClassDef) -> str:
        """A class of records, with their methods."""
        self.record_name = node.name
        kind = self.kind(node.name)
        base = self._base(node)
        told = [one for one in node.body if isinstance(one, ast.AnnAssign)]
        told = [one for one in told if not ast.unparse(one.annotation).startswith("InitVar")]
        shared = [one for one in told if ast.unparse(one.annotation).startswith("ClassVar")]
        functions = [one for one in node.body if isinstance(one, ast.FunctionDef)]
        functions = [one for one in functions if one.name != "__repr__"]
        self.of_class = {one.name for one in functions if _is_of_class(one)}
        lines = [line for one in shared for line in self._shared(one)]
        if not hasattr(kind, "model_fields"):
            fields = [one for one in told if one not in shared]
            lines += self._constructor(node, fields, base, hasattr(kind, "__post_init__"))
        lines += [line for one in functions if not _is_left_open(one) for line in self._method(one)]
        if base:
            self.use(base)
        head = f"class {node.name} extends {base}" if base else f"class {node.name}"
        return f"{head} {{\n" + "\n".join(lines) + "\n}"

    def _base(self, node: ast.ClassDef) -> str:
        """The class of the package that another is built on; of several the one that does something."""
        names = [one.id for one in node.bases if isinstance(one, ast.Name) and one.id not in PLAIN]
        found = [name for name in names if self.kind(name)]
        if len(found) > 1:
            found = [name for name in found if _does(self.kind(name))]
        if len(found) > 1:
            raise UntranslatableError(node, "built on several")
        return found[0] if found else ""

    def _shared(self, node: ast.AnnAssign) -> Iterator[str]:
        """What all records of a class have: said by the class, and by each."""
        name = ast.unparse(node.target)
        if node.value:
            yield f"static {name} = {self.expr(node.value)};"
        yield f"get {name}() {{\nreturn this.constructor.{name};\n}}"

    def _constructor(
        self, node: ast.ClassDef, fields: list[ast.AnnAssign], base: str, checked: bool
    ) -> Iterator[str]:
        """What makes a record; none without fields of its own, or where it is said by itself."""
        own = any(isinstance(one, ast.FunctionDef) and one.name == "__init__" for one in node.body)
        if own or not fields:
            return
        keys = [one.target.id for one in fields if isinstance(one.target, ast.Name)]
        taken = list(self.parameters(node.name) or keys)
        if base and taken[: len(keys)] != keys:
            raise UntranslatableError(node, "with fields of its own besides those of another")
        names = [camel(key) for key in keys]
        given = ", ".join(
            name + (f" = {self._default(one.value)}" if one.value else "")
            for name, one in zip(names, fields, strict=True)
        )
        sets = [f"this.{key} = {name};" for key, name in zip(keys, names, strict=True)]
        lines = [
            *(["super();"] if base else []),
            *sets,
            *(["this.__post_init__();"] if checked else []),
        ]
        yield f"constructor({given}) {{\n" + "\n".join(lines) + "\n}"
        if any(isinstance(one, ast.Name) and one.id == "NamedTuple" for one in node.bases):
            yield f"*[Symbol.iterator]() {{\nyield* [{', '.join(f'this.{key}' for key in keys)}];\n}}"
        if self.lists_fields:
            pairs = (
                f'{{ name: "{key}", default: {self._default(one.value) if one.value else "null"} }}'
                for key, one in zip(keys, fields, strict=True)
            )
            yield f"static __fields__ = [{', '.join(pairs)}];"

    def _method(self, node: ast.FunctionDef) -> Iterator[str]:
        how = {one.id for one in node.decorator_list if isinstance(one, ast.Name)}
        if len(how) != len(node.decorator_list) or not how <= DECORATORS:
            raise UntranslatableError(node, "with such a decorator")
        name = MADE.get(node.name, node.name)
        if "staticmethod" in how:
            yield self.function(node, f"static {name}", " ")
        elif "cached_property" in how:
            yield self.function(node, f"_{name}_", node.args.args[0].arg)
            yield f'get {name}() {{\nreturn py.keep(this, "{name}", this._{name}_());\n}}'
        else:
            head = "get " if "property" in how else "static " if "classmethod" in how else ""
            yield self.function(node, head + name, node.args.args[0].arg)

    def _default(self, node: ast.expr) -> str:
        """The default of a field."""
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "field":
            said = {one.arg: one.value for one in node.keywords}
            if "default" in said:
                return self.default(said["default"])
            return self.expr(ast.Call(said["default_factory"], [], []))
        return self.default(node)


def _all_apart(target: ast.Tuple, value: ast.Tuple) -> bool:
    """Whether what a record is to hold is told by names, so that each can be said by itself."""
    pairs = [*zip(target.elts, value.elts, strict=False)]
    named = (isinstance(one, ast.Attribute) and isinstance(of, ast.Name) for one, of in pairs)
    return len(target.elts) == len(value.elts) and all(named)


def _is_of_class(node: ast.FunctionDef) -> bool:
    """Whether a method belongs to the class, not to its records."""
    how = {"classmethod", "staticmethod"}
    return bool(how & {ast.unparse(one) for one in node.decorator_list})


def _does(kind: type | None) -> bool:
    """Whether a class has functions of its own."""
    own = vars(kind).items()
    return any(inspect.isfunction(one) and not name.startswith("__") for name, one in own)


def _is_left_open(node: ast.FunctionDef) -> bool:
    """Whether others say what a method does."""
    last = node.body[-1]
    return isinstance(last, ast.Raise) and ast.unparse(last) == "raise NotImplementedError"


def _within(body: Iterable[ast.stmt]) -> Iterator[ast.AST]:
    """All of a function, but for what is in functions, comprehensions and records within it."""
    waiting: list[ast.AST] = list(body)
    while waiting:
        node = waiting.pop()
        yield node
        if not isinstance(node, ast.FunctionDef | ast.Lambda | ast.ClassDef):
            waiting += ast.iter_child_nodes(node)


def _stored(body: Iterable[ast.stmt]) -> Iterator[str]:
    """The names that a function gives values to."""
    for node in _within(body):
        match node:
            case ast.Assign(targets=targets):
                yield from (name for one in targets for name in _bound(one))
            case ast.AnnAssign(target=target) | ast.AugAssign(target=target) | ast.For(target=target):
                yield from _bound(target)
            case ast.NamedExpr(target=target):
                yield target.id
            case ast.withitem(optional_vars=ast.Name(id=name)):
                yield name


def _bound(target: ast.expr) -> Iterator[str]:
    """The names in what is assigned to; not those of lists and records whose parts are."""
    match target:
        case ast.Name(id=name):
            yield name
        case ast.Tuple(elts=elts) | ast.List(elts=elts):
            for one in elts:
                yield from _bound(one)
        case ast.Starred(value=value):
            yield from _bound(value)
