"""What names, numbers and texts of Python are in JavaScript, and which functions are asked of `py`."""

import ast
import json

# What JavaScript keeps to itself, and `py`.
KEPT_SPELT = """
    arguments await break case catch class const continue debugger default delete do else enum eval
    export extends false finally for function if implements import in instanceof interface let new
    null package private protected public return static super switch this throw true try typeof var
    void while with yield py
"""
KEPT = frozenset(KEPT_SPELT.split())
# Functions that `py` holds under the same names, and methods of texts, lists, sets and dicts.
FUNCTIONS_SPELT = """
    abs bool chr dict divmod enumerate float frozenset groupby int len list max min next ord
    pairwise range repr round set sorted str sum tuple type vars zip
"""
FUNCTIONS = frozenset(FUNCTIONS_SPELT.split())
METHODS_SPELT = """
    add append as_integer_ratio copy count decode endswith extend get index isalpha isprintable isspace
    items join keys lower partition pop replace reshape setdefault split splitlines startswith strip
    tolist translate upper values
"""
METHODS = frozenset(METHODS_SPELT.split())
# Methods of regular expressions and of what they match, and of records that pages write by hand.
KNOWN_SPELT = """
    end findall finditer fullmatch group groups match search split start sub
    answer at called distance first_failure head_position head_where_tail moment moments motion obstacle
    obstacles own point profile progress said span tell time time_at told tried value
    walk ways whole with_value with_values without_square witness _changed
"""
KNOWN = frozenset(KNOWN_SPELT.split())
# Methods that give way between their steps.
WAITED_SPELT = """
    _found _sought ask best find least_distance limit near rest step surely_bad touches
    trial
"""
WAITED = frozenset(WAITED_SPELT.split())
# Functions of modules, by their own names.
OF_MODULES = {
    "unicodedata.normalize": "normalize", "unicodedata.category": "category",
    "math.floor": "floor", "math.ceil": "ceil", "math.isfinite": "isfinite", "math.dist": "dist",
    "math.hypot": "hypot", "math.atan2": "atan2", "math.cos": "cos", "math.sin": "sin",
    "math.sqrt": "sqrt", "math.ulp": "ulp", "math.lcm": "lcm", "np.interp": "interp",
    "np.where": "where", "np.maximum": "maximum", "np.asarray": "asarray",
    "np.searchsorted": "searchsorted", "math.copysign": "copysign", "np.array": "array",
    "np.concatenate": "concatenate", "np.empty": "empty", "np.shape": "shape", "np.zeros": "zeros",
    "math.degrees": "degrees", "math.remainder": "remainder", "itertools.islice": "islice",
    "itertools.pairwise": "pairwise", "dict.fromkeys": "fromkeys", "math.radians": "radians",
    "clock.perf_counter": "perf_counter", "np.full": "full", "np.linspace": "linspace",
    "math.exp": "exp", "math.isnan": "isnan", "math.log": "log",
}  # fmt: skip
# Numbers of modules; and what kind of numbers arrays hold, which pages need not say.
NUMBERS = {
    "math.inf": "Infinity",
    "math.pi": "Math.PI",
    "math.nan": "NaN",
    "np.float64": '"d"',
    "np.int64": '"q"',
}
# Calls that answer with a truth.
TRUTHS_SPELT = """
    any all isinstance endswith isalpha isfinite isnan isprintable isspace startswith bool
"""
TRUTHS = frozenset(TRUTHS_SPELT.split())
# What functions of `py` take by name.
BUILTIN = {
    "enumerate": ("iterable", "start"), "searchsorted": ("a", "v", "side"),
    "max": ("over", "key", "default"),
    "min": ("over", "key", "default"), "sorted": ("iterable", "key", "reverse"),
    "array": ("values", "dtype"), "empty": ("shape", "dtype"), "zeros": ("shape", "dtype"),
    "full": ("shape", "value", "dtype"),
}  # fmt: skip


class UntranslatableError(Exception):
    """Code beyond what is translated."""

    def __init__(self, node: ast.AST, why: str = "") -> None:
        line = getattr(node, "lineno", "?")
        super().__init__(f"line {line}: {type(node).__name__} {why}".strip())


def camel(name: str) -> str:
    """A name as JavaScript has it: snakeCase, unless it is a constant's or a class's."""
    if name.isupper() or not name.strip("_") or name[0].isupper() or name.startswith("__"):
        return name
    start = name[: len(name) - len(name.lstrip("_"))]
    words = name.lstrip("_").split("_")
    called = start + words[0] + "".join(word.capitalize() for word in words[1:])
    return f"{called}_" if called in KEPT else called


def text(value: str) -> str:
    """A string."""
    return json.dumps(value, ensure_ascii=False)


def number(value: float) -> str:
    """A number."""
    return {"inf": "Infinity", "-inf": "-Infinity", "nan": "NaN"}.get(repr(value), repr(value))
