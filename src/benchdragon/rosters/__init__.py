"""Rosters: who carries which bench, read from villages' lists of names."""
