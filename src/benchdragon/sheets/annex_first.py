"""The first page of the permit annex: the verdict, the crowd, and what was not considered."""

from collections.abc import Iterator

from benchdragon.analysis.check import sentence
from benchdragon.analysis.crowd import density_text
from benchdragon.export.document import Block, Heading, Paragraph, Table, say
from benchdragon.i18n import N_, _
from benchdragon.model.answer import Answer
from benchdragon.number_format import decimals_towards
from benchdragon.sheets.annex_facts import AnnexFacts

NOT_CONSIDERED = N_(
    "Not considered: how spectators move, press or run, and how long they need to leave; weather, "
    "light and the state of the ground, slopes, steps and kerbs; fire, from lanterns, fireworks, "
    "firecrackers and electricity; bearers who tire or fall, benches that break or come apart, a tail "
    "that swings out; weights and forces, and stands, stages and bridges that must bear them; "
    "vehicles, and anything that moves but the dragon; and what is not in the plan: obstacles, people "
    "and edges that nobody wrote down."
)


def first_page(facts: AnnexFacts) -> Iterator[Block]:
    """What an officer reads first."""
    briefing = facts.briefing
    yield Heading(_("At a glance"), "glance")
    yield Paragraph((sentence(briefing.report, briefing.clock),))
    for one in facts.findings:
        yield say(_("Attention, {code}: {what}."), code=one.code, what=one.text)
    yield say(_(NOT_CONSIDERED))
    yield crowd_table(facts)
    yield say(
        _(
            "People a square metre are counted as if they stood evenly; where one sees best they stand "
            "closer. Levels: Fruin, after the table in EPJ Data Science (2014): from 2 walking is "
            "slowed, from 3.6 people are touched against their will, from 5.6 dangerous forces begin, "
            "7.1 is critical even where nobody moves."
        )
    )


def crowd_table(facts: AnnexFacts) -> Table:
    """The numbers of the crowd, and when the dragon is nearest to its entrances."""
    crowd, unknown = facts.crowd, _("unknown: the plan has no venue")
    people = _("unknown: the plan does not say how many come")
    if crowd.people is not None:
        people = str(crowd.people)
    ground = unknown if crowd.ground is None else f"{crowd.ground:.0f} m²"
    way = unknown if crowd.way is None else f"{decimals_towards(crowd.way, 2, up=False)} m"
    if crowd.way == 0.0:
        way = _("none: the line reaches the edge of the venue")
    rows = (
        (_("spectators expected"), people),
        (_("ground in the venue outside the spectators' line"), ground),
        (_("people a square metre there"), _density(facts)),
        (_("narrowest way between the line and the edge of the venue"), way),
        *(_entrance(facts, n, found) for n, found in enumerate(facts.nearest, start=1)),
    )
    return Table("crowd", _("the crowd"), (_("item"), _("value")), (2.2, 2.4), rows)


def _density(facts: AnnexFacts) -> str:
    """How dense spectators stand, and what that means."""
    density, ground = facts.crowd.density, facts.crowd.ground
    if density is None:
        return _("unknown")
    if ground == 0.0 and density:
        return _("there is no ground for them")
    text = _("{density}: {level}")
    return text.format(density=decimals_towards(density, 1, up=True), level=_(density_text(density)))


def _entrance(facts: AnnexFacts, n: int, found: Answer) -> tuple[str, str]:
    """When the dragon's body is nearest to an entrance, with which bench, and how near."""
    name = _("the dragon's body nearest to entrance {n}").format(n=n)
    near = found.witness
    if near is None or near.time is None:
        return name, _("unknown")
    text = _("{bench}, at {time}: {away} m")
    return name, text.format(
        bench=facts.briefing.called(near.benches[0]), time=facts.briefing.clock.tell(near.time),
        away=decimals_towards(found.sure(up=False), 2, up=False),
    )  # fmt: skip
