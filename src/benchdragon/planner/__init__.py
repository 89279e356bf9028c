"""The planner: a page that plans, judges and shows dances without a server, as one file."""
