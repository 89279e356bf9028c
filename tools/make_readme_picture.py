"""Draw docs/turn.png, the picture at the top of the README."""

from pathlib import Path

from benchdragon.figures.style import write_picture
from benchdragon.figures.walk import dragon_picture
from benchdragon.plans.schema import read_plan

TARGET = Path(__file__).parent.parent / "docs" / "turn.png"


def main() -> None:
    """Draw the contest's dragon 5 s before its turn and 22 s into it."""
    plan = read_plan("turn")
    motion = plan.build().motion([-5.0, 22.0])
    figure = dragon_picture(motion, "", (0, 1), plan.disc.radius)
    write_picture(figure, TARGET, plan.title("en"), plan.sha256)


if __name__ == "__main__":
    main()
