"""Papers for the dancers: sheets for each bench, the chalk plan, timetable."""
