"""Inverse questions about a walk: sizes, the head's speed, turns, and tolerance to imprecision."""
