"""How benches and handles are numbered, and what the contest's tables call them.

Benches have numbers from 1, the head, to N, the tail; handle 0 is the head's front, handle i joins
benches i and i + 1, handle N is the tail's rear. The contest counts bodies from the head on: "Body i"
is bench i + 1, and its row holds that bench's front handle, handle i.
"""

from benchdragon.i18n import N_, _


def handle_names(handles: int) -> list[str]:
    """What the contest calls each of `handles` handles, head first."""
    bodies = [_("Body {number}").format(number=i) for i in range(1, handles - 2)]
    tail = [_("Tail")] if handles > 2 else []
    return [_("Head"), *bodies, *tail, _("Tail (rear)")]


def contest_names(handles: int) -> list[str]:
    """The same as the contest's own files have it, in whatever language."""
    bodies = [f"第{i}节龙身" for i in range(1, handles - 2)]
    return ["龙头", *bodies, *(["龙尾"] if handles > 2 else []), "龙尾（后）"]


def handle_place(handle: int, benches: int) -> str:
    """Where a handle is in a dragon of so many benches, by the numbers of the benches."""
    words = handle_words(handle, benches)
    where = words["where"]
    return _(where).format(**words)


def handle_words(handle: int, benches: int) -> dict[str, str]:
    """A handle's number, and where it is: a text to be translated, with the numbers that it takes."""
    where = N_("between benches {a} and {b}")
    if handle == 0:
        where = N_("front of bench 1")
    elif handle == benches:
        where = N_("rear of bench {bench}")
    numbers = {"a": handle, "b": handle + 1, "bench": benches, "handle": handle}
    return {"where": where, **{name: str(value) for name, value in numbers.items()}}


def handle_text(handle: int, benches: int) -> str:
    """A handle of a dragon of so many benches: its number, and where it is."""
    return _("handle {handle} ({where})").format(handle=handle, where=handle_place(handle, benches))


def numbering_text() -> str:
    """A sentence or two on the numbers, and on the contest's names beside them."""
    return _(
        "Bench 1 is the head. Handle 0 is its front, handle i joins benches i and i + 1. The contest's "
        "tables count the bodies behind the head: Body i is bench i + 1, and its row is that bench's "
        "front handle, handle i."
    )
