"""What is asked of plans alone, as their methods: `plan.check()`. See `model.asked`."""

from benchdragon.methods import Method
from benchdragon.model.asked import Asked


class AskedPlan(Asked):
    """What questions about plans take first."""

    animate = Method()
    bench_walks = Method()
    best_place = Method()
    best_turn = Method()
    check = Method()
    greatest_head_speed = Method()
    limit = Method()
    plot = Method("plot_plan")
    smallest_pitch = Method()
    sweep = Method()
    timetable = Method()
    tolerance = Method()
