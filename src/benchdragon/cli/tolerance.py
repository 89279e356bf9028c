"""The verb `margins`: how much room imprecise people need."""

import math
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from benchdragon.cli.answers import about
from benchdragon.cli.console import (
    print_explanation,
    print_files,
    print_json,
    print_rows,
    shown_progress,
)
from benchdragon.cli.options import (
    dances_options,
    folder_option,
    only_with,
    plan_to_walk,
    take,
    together,
    verb,
)
from benchdragon.i18n import N_, _, language
from benchdragon.number_format import finite_or_none, outward
from benchdragon.progress import stages

if TYPE_CHECKING:
    from benchdragon.plans.schema import Plan
    from benchdragon.solve.tolerance import Tolerance

DEVIATIONS = {
    "aside": N_("Handles off the route, to either side: standard deviation in metres."),
    "stray": N_("The route that is walked off the one that is drawn, smoothly, in metres."),
    "play": N_("Pin play and pull: how far they change a bench's link, in metres."),
    "height": N_("Height of a handle over the one before, in metres."),
    "length": N_("Lengths of benches, in metres."),
    "width": N_("Widths of benches, in metres."),
}


# An option for each way to be imprecise.
deviation_options = together(
    *(
        click.option(f"--{name}", type=click.FloatRange(0.0, 1.0), help=text)
        for name, text in DEVIATIONS.items()
    )
)


def given_deviations(options: dict[str, Any]) -> dict[str, float]:
    """The deviations that were given."""
    return {name: options[name] for name in DEVIATIONS if options[name] is not None}


@verb("margins spiral-in --set disc.radius=4.5 --aside 0.03")
@take("plan")
@deviation_options
@dances_options(N_("Seed of the random dances."), N_("Number of random dances."))
@take("place")
@folder_option()
@take("json", "explain", "shared")
def margins(plan: str, settings: tuple[str, ...], quiet: bool, **options: Any) -> int:
    """The tolerance that imprecise people need, as the pitch at which benches rarely touch.

    Random dances are walked: handles off the route, routes that drift, benches that vary; the
    smallest pitch that each needs is sought. Without options each deviation is tried by itself, then
    all together. A spiral needs an end: --set disc.radius=4.5, for example.
    """
    from benchdragon.files import refuse_existing

    only_with("-o", options["output"] is not None, "force")
    read = plan_to_walk(plan, settings, quiet)
    folder: Path | None = options["output"]
    files = [] if folder is None else [folder / f"margins.{kind}" for kind in ("png", "svg", "pdf")]
    refuse_existing(files, options["force"])
    found, texts = _walked(read, options, quiet)
    _write_pictures(read, found, texts, files)
    pitch = read.value("route.pitch")
    lines = _lines(read, found, texts) if options["explain"] else []
    if options["as_json"]:
        cases = {name: as_json(one, pitch) for name, one in found.items()}
        counted = {"counts_obstacles": False} if read.obstacles() else {}
        told = {"cases": cases, **about(read, lines), "seed": options["seed"], **counted}
        print_json(told, files)
        return 0
    print_margins(found, texts, pitch, read.limits.margin)
    if read.obstacles():
        click.echo(_("benches alone are asked about: the venue and obstacles do not count here"))
    print_files(files)
    print_explanation(lines)
    return 0


def _walked(
    plan: "Plan", options: dict[str, Any], quiet: bool
) -> tuple[dict[str, "Tolerance"], dict[str, str]]:
    """What each case needs, and what to call it."""
    from benchdragon.parallel import kept, place
    from benchdragon.solve.tolerance import CASES, Case, Deviations, tolerance

    given = given_deviations(options)
    cases = {"given": Case(N_("as given"), Deviations(**given))} if given else CASES
    found = {}
    with shown_progress(quiet) as progress, kept(place(options["on"], options["workers"])) as executor:
        stage = stages(progress, len(cases))
        for name, case in cases.items():
            found[name] = tolerance(
                plan, case.deviations, options["draws"], own=True, seed=options["seed"],
                executor=executor, progress=stage(_(case.text)),
            )  # fmt: skip
    return found, {name: _(case.text) for name, case in cases.items()}


def _write_pictures(
    plan: "Plan", found: dict[str, "Tolerance"], texts: dict[str, str], files: list[Path]
) -> None:
    if not files:
        return
    from benchdragon.figures.style import write_picture
    from benchdragon.figures.tolerance import margin_picture

    title = plan.title(language())
    for path in files:
        write_picture(margin_picture(found, texts, title), path, title, plan.sha256)


def _lines(plan: "Plan", found: dict[str, "Tolerance"], texts: dict[str, str]) -> list[str]:
    """The derivation of the last case: all deviations together if none was given."""
    from benchdragon.explain.tolerance import margin_lines

    name, one = list(found.items())[-1]
    return [f"{texts[name]}:", *margin_lines(plan, one)]


def as_json(one: "Tolerance", pitch: float) -> dict[str, Any]:
    """One case as plain data, in metres."""
    from benchdragon.solve.tolerance import RISKS

    share, low, high = one.touching()
    safe = {f"{risk:g}": finite_or_none(one.pitch_for(risk)) for risk in RISKS}
    least = {f"{risk:g}": one.pitch_from(risk) or None for risk in RISKS}
    return {
        "deviations": asdict(one.deviations),
        "draws": one.needed.size,
        "exact": one.exact,
        "touching": {"pitch": pitch, "share": share, "lower": low, "upper": high},
        "pitch_for": safe,
        "pitch_from": least,
        "needed": one.needed.tolist(),
    }


def print_margins(
    found: dict[str, "Tolerance"], texts: dict[str, str], pitch: float, margin: float
) -> None:
    """A row a case: chance at the plan's pitch, pitches for smaller chances."""
    from benchdragon.solve.tolerance import RISKS

    columns = [
        _("deviations"),
        _("chance at {pitch} m (%)").format(pitch=f"{pitch:g}"),
        *(f"{100.0 * risk:g} %" for risk in RISKS),
    ]
    rows = []
    for name, one in found.items():
        share, low, high = (100.0 * part for part in one.touching())
        chance = f"{share:.1f} ({outward(low, high, 1)})"
        ends = ((one.pitch_from(risk) or -math.inf, one.pitch_for(risk)) for risk in RISKS)
        rows.append((texts[name], chance, *(outward(*pair) for pair in ends)))
    title = _(
        "Chance that benches touch; pitch (m) at which they touch so often: from..to, with 95 % "
        "confidence at either end"
    )
    print_rows(title, columns, rows)
    first = next(iter(found.values()))
    text = _(
        "without deviations: {pitch} m; {draws} random dances each, more bring the two ends "
        "nearer (-: too few to say); the larger pitch is the one to take"
    )
    click.echo(text.format(pitch=f"{first.exact:.4f}", draws=first.needed.size))
    click.echo(
        _(
            "the chance counts dances walked at that pitch; the pitches take for granted that a "
            "dance free of contact with its pitch is so with larger ones"
        )
    )
    if margin:
        said = _("benches count as touching where they come nearer than {margin} m")
        click.echo(said.format(margin=f"{margin:g}"))
