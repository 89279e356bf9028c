"""What is asked of plans and of walks alike, as their methods: `plan.first_contact()`.

Their types stand in `asked.pyi`, which `make generate` makes from those of the functions.
"""

from benchdragon.methods import Method


class Asked:
    """What questions are about: each is a public function, which takes this first."""

    clearance_curve = Method()
    contact_windows = Method()
    enclosing = Method()
    first_contact = Method()
    first_touch = Method()
    greatest_speed = Method()
    least_clearance = Method()
    least_distance = Method()
    show = Method()
    swept_area = Method()
    _repr_html_ = Method("as_html")
