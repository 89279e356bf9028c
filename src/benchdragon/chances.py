"""The verb `margins`: how much room imprecise people need."""

import json
from dataclasses import fields
from pathlib import Path
from typing import Any

import click

from benchdragon import __version__
from benchdragon.messages import N_, _, language
from benchdragon.options import (
    announce_compiling,
    folder_option,
    json_option,
    plan_options,
    shared_options,
    workers_option,
)
from benchdragon.show import print_files, print_rows, progress

# Chances of touching for which a pitch is told.
RISKS = (0.5, 0.1, 0.05, 0.02)
SLIPS = {
    "aside": N_("Handles off the line, to either side: standard deviation in metres."),
    "stray": N_("The trodden line off the drawn one, smoothly, in metres."),
    "play": N_("Play of the pins and pull, in metres of a bench's link."),
    "height": N_("Height of a handle over the one before, in metres."),
    "length": N_("Lengths of benches, in metres."),
    "width": N_("Widths of benches, in metres."),
}


def slip_options(command: Any) -> Any:
    """An option for each way to be imprecise."""
    for name, text in reversed(SLIPS.items()):
        command = click.option(f"--{name}", type=click.FloatRange(0.0, 1.0), help=text)(command)
    return command


@click.command(
    help=N_(
        "How much room imprecise people need: the pitch at which benches rarely touch.\n\nRandom "
        "dances are walked, handles off the line, lines that drift, benches that vary, and the "
        "smallest pitch that each needs is sought. Without options each slip is tried by itself, "
        "then all together. PLAN is a *.dragon.toml file or the name of a built-in plan."
    )
)
@plan_options
@slip_options
@click.option(
    "--draws",
    type=click.IntRange(1, 100_000),
    default=200,
    show_default=True,
    help=N_("Random dances."),
)
@click.option(
    "--seed", type=click.IntRange(0, 2**31), default=1, show_default=True, help=N_("Of the draws.")
)
@workers_option(2)
@folder_option
@json_option
@shared_options
def margins(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """Print pitches and chances, as a table or JSON, and draw them."""
    from benchdragon.files import refuse_existing
    from benchdragon.imprecision import CASES, Case, Slips
    from benchdragon.imprecision import margins as found_margins
    from benchdragon.plan import read_plan
    from benchdragon.speeds import part_of

    read = read_plan(plan, settings)
    announce_compiling(quiet)
    given = {name: options[name] for name in SLIPS if options[name] is not None}
    cases = {"given": Case(N_("as given"), Slips(**given))} if given else CASES
    folder: Path | None = options["output"]
    files = [] if folder is None else [folder / f"margins.{kind}" for kind in ("png", "svg", "pdf")]
    refuse_existing(files, options["force"])
    found = {}
    with progress(quiet, len(cases)) as advance:
        for name, case in cases.items():
            found[name] = found_margins(
                read, case.slips, options["draws"], seed=options["seed"], workers=options["workers"],
                advance=part_of(advance, _(case.text)),
            )  # fmt: skip
    texts = {name: _(case.text) for name, case in cases.items()}
    if files:
        from benchdragon.evidence_pictures import margin_picture
        from benchdragon.pictures import write_picture

        title = read.title(language())
        for path in files:
            write_picture(margin_picture(found, texts, title), path, title, read.sha256)
    pitch = read.value("route.pitch")
    if options["as_json"]:
        about = {"plan_sha256": read.sha256, "version": __version__, "seed": options["seed"]}
        click.echo(
            json.dumps({"cases": {name: as_json(one, pitch) for name, one in found.items()}, **about})
        )
        return 0
    print_margins(found, texts, pitch)
    if files:
        print_files(files)
    return 0


def as_json(one: Any, pitch: float) -> dict[str, Any]:
    """One case as plain data, in metres."""
    share, low, high = one.touching(pitch)
    safe = {f"{risk:g}": _finite(one.pitch_for(risk)) for risk in RISKS}
    return {
        "slips": {field.name: getattr(one.slips, field.name) for field in fields(one.slips)},
        "draws": one.needed.size,
        "exact": one.exact,
        "touching": {"pitch": pitch, "share": share, "lower": low, "upper": high},
        "pitch_for": safe,
        "needed": one.needed.tolist(),
    }


def _finite(value: float) -> float | None:
    return value if value < float("inf") else None


def print_margins(found: dict[str, Any], texts: dict[str, str], pitch: float) -> None:
    """A row a case: chance at the plan's pitch, pitches for smaller chances."""
    columns = [
        _("slips"),
        _("chance at {pitch} m (%)").format(pitch=f"{pitch:g}"),
        *(f"{100.0 * risk:g} %" for risk in RISKS),
    ]
    rows = []
    for name, one in found.items():
        chance = "{:.1f} ({:.1f}..{:.1f})".format(*(100.0 * part for part in one.touching(pitch)))
        safe = [one.pitch_for(risk) for risk in RISKS]
        rows.append((texts[name], chance, *(f"{size:.4f}" if _finite(size) else "-" for size in safe)))
    title = _(
        "Chance that benches touch; pitch (m) at which they touch no more often, with 95 % confidence"
    )
    print_rows(title, columns, rows)
    first = next(iter(found.values()))
    click.echo(
        _(
            "exact people need {pitch} m; {draws} dances each, more allow surer answers (-: too "
            "few to say)"
        ).format(pitch=f"{first.exact:.4f}", draws=first.needed.size)
    )
