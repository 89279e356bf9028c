"""Regular expressions of Python as those of JavaScript, in its Unicode mode."""

import re

# What Python takes for white, as `str.isspace`; JavaScript leaves some out and has one more.
WHITE = r"\t-\r\x1c-\x20\x85\xa0\u1680\u2000-\u200a\u2028\u2029\u202f\u205f\u3000"
# Signs that have to be marked where they stand for themselves.
SIGNS = r"^$\.*+?()[]{}|/"
ANYWHERE = {"Z": r"(?![\s\S])", "A": r"(?<![\s\S])"}
# A piece of a pattern: a marked sign, the beginning of a group, a count, or a sign.
PIECE = re.compile(
    r"\\U[0-9a-fA-F]{8}|\\u[0-9a-fA-F]{4}|\\x[0-9a-fA-F]{2}|\\.|\(\?P<|\(\?P=\w+\)|\{[0-9]*,?[0-9]*\}|.",
    re.DOTALL,
)


def javascript(pattern: str, flags: int = 0) -> str:
    """The same pattern.

    Raises:
        ValueError: for what is not known here.
    """
    if flags & re.VERBOSE:
        raise ValueError("a pattern with white signs that mean nothing")
    found, inside = [], -1
    for piece in PIECE.findall(pattern):
        inside += inside >= 0
        if inside == 1 and piece == "^":
            inside = 0
        said = _within(piece, inside) if inside >= 0 else _outside(piece, flags)
        if inside < 0 and piece == "[":
            inside = 0
        elif inside > 1 and piece == "]":
            inside = -1
        found.append(said)
    return "".join(found)


def _outside(piece: str, flags: int) -> str:
    """A piece that is in no class of signs."""
    if piece.startswith("\\"):
        return _marked(piece, flags)
    match piece:
        case "$" if not flags & re.MULTILINE:
            return r"(?=\n?(?![\s\S]))"
        case ".":
            return r"[\s\S]" if flags & re.DOTALL else r"[^\n]"
        case "{" | "}" | "]":
            return f"\\{piece}"
        case "(?P<":
            return "(?<"
    if piece.startswith("(?P="):
        return f"\\k<{piece[4:-1]}>"
    return piece.replace("{,", "{0,")


def _marked(piece: str, flags: int) -> str:
    """A piece that begins with a reversed stroke, in no class."""
    sign = piece[1]
    if sign in ANYWHERE:
        return ANYWHERE[sign]
    if sign == "s":
        return f"[{WHITE}]"
    if sign == "S":
        return f"[^{WHITE}]"
    if sign == "d":
        return "[0-9]" if flags & re.ASCII else r"\p{Nd}"
    if sign == "w":
        return r"[0-9A-Za-z_]" if flags & re.ASCII else r"[\p{L}\p{N}_]"
    return _sign(piece)


def _sign(piece: str) -> str:
    """A marked sign that stands for itself, or a code of one."""
    sign = piece[1]
    if sign == "U":
        return f"\\u{{{piece[2:].lstrip('0')}}}"
    if sign in SIGNS or sign in "nrtfv0xu" or sign.isdigit():
        return piece
    if sign.isalpha():
        raise ValueError(f"{piece} in a pattern")
    return sign


def _within(piece: str, place: int) -> str:
    """A piece of a class of signs, at a place in it."""
    if piece == r"\s":
        return WHITE
    if piece == r"\d":
        return r"\p{Nd}"
    if piece.startswith("\\"):
        return piece if piece[1] == "-" else _sign(piece)
    if piece == "[" or (piece == "]" and place == 1):
        return f"\\{piece}"
    return piece
