"""`benchdragon` and `python -m benchdragon`: settle the language, then hand over to the door."""

import sys

from benchdragon.messages import preferred_language, use_language


def asked_language(arguments: list[str]) -> str | None:
    """What --lang says, read ahead because the help texts need it first."""
    for here, following in zip(arguments, [*arguments[1:], ""], strict=True):
        if here == "--":
            break
        if here == "--lang":
            return following
        if here.startswith("--lang="):
            return here.removeprefix("--lang=")
    return None


def main() -> None:
    """Run the command line and exit with its code."""
    use_language(preferred_language(asked_language(sys.argv[1:])))
    from benchdragon.cli import run  # click must meet the chosen language

    sys.exit(run(sys.argv[1:]))


if __name__ == "__main__":
    main()
