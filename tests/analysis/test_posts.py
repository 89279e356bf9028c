"""Posts for marshals: where places on the line around a dance are one post."""

from benchdragon.analysis.posts import Reason, _spaced


def test_places_on_both_sides_of_a_rings_seam_are_one_post() -> None:
    wanted = [(0.5, Reason("entrance")), (99.8, Reason("fastest")), (96.0, Reason("tightest"))]
    found = [(along, [one.why for one in why]) for along, why in _spaced(wanted, 100.0)]
    kept = [one for one in found if one[1] != ["line"]]
    assert kept == [(0.5, ["entrance", "fastest"]), (96.0, ["tightest"])]
