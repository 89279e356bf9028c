"""Expressions of Python in JavaScript."""

import ast
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from tools.translation.names import (
    FUNCTIONS,
    NUMBERS,
    TRUTHS,
    UntranslatableError,
    camel,
    number,
    text,
)

ARITHMETIC = {ast.Mult: "*", ast.Div: "/", ast.Pow: "**"}
ASKED = {
    ast.Add: "add", ast.Sub: "sub", ast.Mod: "mod", ast.BitOr: "union", ast.BitAnd: "both",
    ast.FloorDiv: "div", ast.Mult: "times",
}  # fmt: skip
ORDER = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">="}


@dataclass
class Expressions:
    """How the names of a module are said elsewhere.

    Attributes:
        parameters: what a function or a record takes, in order; None where that is unknown.
        use: called with each name that the code takes from outside of functions.
        hoist: makes a constant of a regular expression, and says its name.
        function_for: what the function takes that stands for a method of that name; None if none does.
        plain: of records that are plain data the keys, with what each holds by default, and a function
            that changes what is said; None of any other.
        waits: "made" of a function that gives way between its steps, "around" or "freed" of one that is
            a context, "unasked" of one that checks what Python is called with, or "".
        entry: what the kernels' entry of that name, with points, is called, and whether it gives one
            number; None if it is none.
        group: the fields of a group of arrays of that name, with points; None if it is none.
        owned: a function of a module, named with a point, and what it takes; None if it is none.
        member: a number of a module, named with a point; None if it is none.
        lists_fields: whether classes must tell their fields.
        kind: the class of that name, which the module defines; None if there is none.
    """

    parameters: Callable[[str], Sequence[str] | None]
    use: Callable[[str], None]
    hoist: Callable[[str, int], str]
    function_for: Callable[[str], Sequence[str] | None] = lambda _method: None
    plain: Callable[[str], dict[str, tuple[str | None, str]] | None] = lambda _name: None
    waits: Callable[[str], str] = lambda _name: ""
    entry: Callable[[str], tuple[str, bool] | None] = lambda _name: None
    group: Callable[[str], Sequence[str] | None] = lambda _name: None
    owned: Callable[[str], tuple[str, Sequence[str]] | None] = lambda _name: None
    member: Callable[[str], str | None] = lambda _name: None
    kind: Callable[[str], type | None] = lambda _name: None
    lists_fields: bool = False
    scopes: list[set[str]] = field(default_factory=list)
    me: list[str] = field(default_factory=list)
    record_name: str = ""
    of_class: set[str] = field(default_factory=set)
    # Whether each function on the way in waits, None within expressions that cannot; and their names.
    waited: list[bool | None] = field(default_factory=list)
    waiting: set[str] = field(default_factory=set)

    def pattern(self, target: ast.expr) -> str:
        """What is assigned to."""
        match target:
            case ast.Name() | ast.Attribute():
                return self.expr(target)
            case ast.Tuple(elts=elts) | ast.List(elts=elts):
                if any(isinstance(one, ast.Starred) for one in elts[:-1]):
                    raise UntranslatableError(target, "with more after the rest")
                return f"[{', '.join(map(self.pattern, elts))}]"
            case ast.Starred(value=value):
                return f"...{self.pattern(value)}"
        raise UntranslatableError(target, "as a target")

    def taken(self, arguments: ast.arguments, skip: bool = False) -> str:
        """What a function takes, with what it takes where nothing is given."""
        if arguments.vararg or arguments.kwarg:
            raise UntranslatableError(arguments, "with stars")
        own = [*arguments.posonlyargs, *arguments.args]
        defaults = [None] * (len(own) - len(arguments.defaults)) + list(arguments.defaults)
        pairs = [*zip(own, defaults, strict=True)][skip:]
        pairs += zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True)
        return ", ".join(
            camel(one.arg) + (f" = {self.default(default)}" if default else "")
            for one, default in pairs
        )

    def default(self, node: ast.expr) -> str:
        """What is taken where nothing is given; types of pages are guessed from it."""
        said = self.expr(node)
        return "/** @type {any} */ (null)" if said == "null" else said

    def truth(self, node: ast.expr) -> str:
        """An expression where only its truth counts."""
        match node:
            case ast.BoolOp(op=op, values=values):
                sign = " && " if isinstance(op, ast.And) else " || "
                return f"({sign.join(map(self.truth, values))})"
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return f"!{self.truth(operand)}"
        return self.expr(node) if _is_truth(node) else f"py.truth({self.expr(node)})"

    def expr(self, node: ast.expr) -> str:
        """An expression."""
        found = getattr(self, f"_of_{type(node).__name__.lower()}", None)
        if found is None:
            raise UntranslatableError(node)
        said: str = found(node)
        return said

    def _of_constant(self, node: ast.Constant) -> str:
        match node.value:
            case bool() | None:
                return {None: "null", True: "true", False: "false"}[node.value]
            case str():
                return text(node.value)
            case int() | float():
                return number(node.value)
        raise UntranslatableError(node)

    def _of_name(self, node: ast.Name) -> str:
        if self.me and node.id == self.me[-1]:
            return "this"
        if not any(node.id in scope for scope in self.scopes):
            if node.id in FUNCTIONS:
                return f"py.{node.id}"
            if entry := self.entry(node.id):
                return f'py.entered("{entry[0]}")'
            self.use(node.id)
        return camel(node.id)

    def _of_attribute(self, node: ast.Attribute) -> str:
        if (known := NUMBERS.get(ast.unparse(node))) is not None:
            return known
        if self._is_outside(node.value):
            if (known := self.member(ast.unparse(node))) is not None:
                return known
            if entry := self.entry(ast.unparse(node)):
                return f'py.entered("{entry[0]}")'
        if self.function_for(node.attr) is not None:
            return f"{node.attr}({self.expr(node.value)})"
        return f"{self.expr(node.value)}.{node.attr}"

    def _is_outside(self, node: ast.expr) -> bool:
        """Whether a name is not that of something in a function."""
        return isinstance(node, ast.Name) and not any(node.id in scope for scope in self.scopes)

    def _of_starred(self, node: ast.Starred) -> str:
        return f"...py.iter({self.expr(node.value)})"

    def _of_tuple(self, node: ast.Tuple | ast.List) -> str:
        return f"[{', '.join(map(self.expr, node.elts))}]"

    _of_list = _of_tuple

    def _of_set(self, node: ast.Set) -> str:
        return f"py.set_of([{', '.join(map(self.expr, node.elts))}])"

    def _of_dict(self, node: ast.Dict) -> str:
        pairs = [
            f"[{self.expr(key)}, {self.expr(value)}]" if key else f"...py.items({self.expr(value)})"
            for key, value in zip(node.keys, node.values, strict=True)
        ]
        return f"py.dict([{', '.join(pairs)}])"

    def _of_joinedstr(self, node: ast.JoinedStr) -> str:
        parts = [
            _raw(one.value) if isinstance(one, ast.Constant) else f"${{{self.expr(one)}}}"
            for one in node.values
        ]
        return f"`{''.join(parts)}`"

    def _of_formattedvalue(self, node: ast.FormattedValue) -> str:
        value = self.expr(node.value)
        if node.conversion == ord("r"):
            return f"py.repr({value})"
        return (
            f"py.format({value}, {self.expr(node.format_spec)})"
            if node.format_spec
            else f"py.str({value})"
        )

    def _of_ifexp(self, node: ast.IfExp) -> str:
        return f"({self.truth(node.test)} ? {self.expr(node.body)} : {self.expr(node.orelse)})"

    def _of_boolop(self, node: ast.BoolOp) -> str:
        name = "and" if isinstance(node.op, ast.And) else "or"
        if _is_truth(node):
            return self.truth(node)
        self.waited.append(None)
        *others, found = map(self.expr, node.values)
        self.waited.pop()
        for one in reversed(others):
            found = f"py.{name}({one}, () => {found})"
        return found

    def _of_unaryop(self, node: ast.UnaryOp) -> str:
        if isinstance(node.op, ast.Not):
            return self.truth(node)
        if isinstance(node.op, ast.USub):
            return f"-{self.expr(node.operand)}"
        raise UntranslatableError(node)

    def _of_binop(self, node: ast.BinOp) -> str:
        return self._operation(node.op, node.left, node.right)

    def _operation(self, op: ast.operator, left: ast.expr, right: ast.expr) -> str:
        a, b = self.expr(left), self.expr(right)
        lists = any(
            isinstance(one, ast.List | ast.JoinedStr)
            or (isinstance(one, ast.Constant) and isinstance(one.value, str))
            for one in (left, right)
        )
        if type(op) in ARITHMETIC and not lists:
            return f"({a} {ARITHMETIC[type(op)]} {b})"
        if isinstance(op, ast.Add | ast.Sub) and any(
            isinstance(one, ast.Constant) for one in (left, right)
        ):
            return f"({a} {'+' if isinstance(op, ast.Add) else '-'} {b})"
        if (asked := ASKED.get(type(op))) is None:
            raise UntranslatableError(op)
        return f"py.{asked}({a}, {b})"

    def _of_compare(self, node: ast.Compare) -> str:
        terms = [node.left, *node.comparators]
        said = [self._comparison(op, *pair) for op, pair in zip(node.ops, pairwise(terms), strict=True)]
        return said[0] if len(said) == 1 else f"({' && '.join(said)})"

    def _comparison(self, op: ast.cmpop, left: ast.expr, right: ast.expr) -> str:
        a, b = self.expr(left), self.expr(right)
        nothing = isinstance(right, ast.Constant) and right.value is None
        plain = any(isinstance(one, ast.Constant) for one in (left, right))
        no = "!" if isinstance(op, ast.NotEq | ast.IsNot | ast.NotIn) else ""
        match op:
            case ast.Is() | ast.IsNot():
                return f"({a} {no or '='}={'' if nothing else '='} {b})"
            case ast.Eq() | ast.NotEq():
                return f"({a} {no or '='}== {b})" if plain else f"{no}py.eq({a}, {b})"
            case ast.In() | ast.NotIn():
                return f"{no}py.has({b}, {a})"
        return f"({a} {ORDER[type(op)]} {b})"

    def _of_subscript(self, node: ast.Subscript) -> str:
        value = self.expr(node.value)
        if isinstance(node.slice, ast.Slice):
            if node.slice.step:
                raise UntranslatableError(node, "with a step")
            ends = [self.expr(one) if one else "null" for one in (node.slice.lower, node.slice.upper)]
            return f"py.slice({value}, {', '.join(ends)})"
        return f"py.at({value}, {self.expr(node.slice)})"

    def _of_namedexpr(self, node: ast.NamedExpr) -> str:
        return f"({self.expr(node.target)} = {self.expr(node.value)})"

    def _of_yield(self, node: ast.Yield) -> str:
        return f"yield {self.expr(node.value) if node.value else 'null'}"

    def _of_yieldfrom(self, node: ast.YieldFrom) -> str:
        return f"yield* py.iter({self.expr(node.value)})"

    def _of_lambda(self, node: ast.Lambda) -> str:
        self.scopes.append({one.arg for one in arguments_of(node.args)})
        self.waited.append(None)
        said = f"({self.taken(node.args)}) => {self.expr(node.body)}"
        self.waited.pop()
        self.scopes.pop()
        return said

    # Comprehensions

    def _of_listcomp(self, node: ast.ListComp | ast.GeneratorExp) -> str:
        return self._comprehended(node.generators, lambda: self.expr(node.elt))

    _of_generatorexp = _of_listcomp

    def _of_setcomp(self, node: ast.SetComp) -> str:
        return f"py.set_of({self._comprehended(node.generators, lambda: self.expr(node.elt))})"

    def _of_dictcomp(self, node: ast.DictComp) -> str:
        pairs = self._comprehended(
            node.generators, lambda: f"[{self.expr(node.key)}, {self.expr(node.value)}]"
        )
        return f"py.dict({pairs})"

    def _comprehended(
        self, generators: list[ast.comprehension], last: Callable[[], str], how: str = ""
    ) -> str:
        """A list; with `how` "some" or "every", whether something holds of those in it."""
        first, *others = generators
        over = self.expr(first.iter)
        self.scopes.append(set(_targets(first.target)))
        self.waited.append(None)
        name = self.pattern(first.target)
        tests = [self.truth(one) for one in first.ifs]
        found = self._comprehended(others, last, how) if others else last()
        self.waited.pop()
        self.scopes.pop()
        if how:
            glue = " && " if how == "some" else " || !"
            guards = glue.join(tests)
            told = f"({guards}) && {found}" if how == "some" and tests else found
            if how == "every" and tests:
                told = f"!({' && '.join(tests)}) || {found}"
            return f"py.list({over}).{how}(({name}) => {told})"
        if tests:
            empty = f"({' && '.join(tests)}) ? {found if others else f'[{found}]'} : []"
            return f"py.list({over}).flatMap(({name}) => ({empty}))"
        return f"py.list({over}).{'flatMap' if others else 'map'}(({name}) => {found})"


def _raw(value: object) -> str:
    """A piece of a template."""
    return (
        re.sub(r"[`\\]|\$(?=\{)", lambda one: "\\" + one[0], str(value))
        .replace("\n", "\\n")
        .replace("\r", "\\r")
    )


def _is_truth(node: ast.expr) -> bool:
    """Whether an expression is true or false, and nothing else."""
    match node:
        case ast.Compare() | ast.UnaryOp(op=ast.Not()):
            return True
        case ast.Constant(value=value):
            return isinstance(value, bool)
        case ast.BoolOp(values=values):
            return all(map(_is_truth, values))
        case ast.Call(func=ast.Name(id=name)) | ast.Call(func=ast.Attribute(attr=name)):
            return name in TRUTHS
    return False


def arguments_of(arguments: ast.arguments) -> list[ast.arg]:
    """What a function takes, in order."""
    return [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs]


def _targets(target: ast.expr) -> Iterator[str]:
    return (one.id for one in ast.walk(target) if isinstance(one, ast.Name))
