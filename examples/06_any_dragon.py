"""A dragon and a route of one's own, from Python: where the handles are, and what drives them."""

import math

import benchdragon as bd

dragon = bd.Dragon.uniform(benches=30, head_length=2.6, body_length=1.8, tail_length=1.8)
route = bd.Route.joined(
    [
        bd.Line(80.0),
        bd.Clothoid(5.0, 0.0, 1.0 / 6.0),
        bd.Arc(6.0, math.pi),
        bd.Clothoid(5.0, 1.0 / 6.0, 0.0),
        bd.Line(40.0),
    ]
)
profile = bd.SpeedProfile(times=(0.0, 5.0, 90.0), speeds=(0.0, 1.0, 1.4))
walk = bd.Walk(dragon, route, profile, start=60.0)

motion = walk.motion([0.0, 40.0, 60.0])
print(f"tail at 60 s: ({motion.x[2, -1]:.3f}, {motion.y[2, -1]:.3f}) m")
print(f"fastest handle at 40 s: {motion.speed[1].argmax()}, {motion.speed[1].max():.4f} m/s")
print(f"quickest turn of a bench at 40 s: {abs(motion.turning_rate[1]).max():.4f} rad/s")
print(f"chords kept to {motion.chord_error:.0e} m")

# A dragon that cannot stand is an answer too.
late = walk.motion([60.0, 400.0], throw=False)
print([bd.Status(status).name for status in late.status])
