"""What people hold in their hands: sheets for each bench, the chalk plan, timetable, permit annex."""
