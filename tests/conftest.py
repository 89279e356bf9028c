"""One hypothesis profile for all tests: the same examples each time, however slow the compiler."""

from hypothesis import HealthCheck, settings

settings.register_profile(
    "benchdragon",
    deadline=None,
    derandomize=True,
    max_examples=40,
    print_blob=True,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("benchdragon")
