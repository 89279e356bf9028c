"""Tests of the rosters' room."""
