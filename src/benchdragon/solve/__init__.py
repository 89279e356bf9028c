"""What a walk may be: sizes, the head's speed, turns, and tolerance to imprecision."""
