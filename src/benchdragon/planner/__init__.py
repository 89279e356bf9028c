"""The planner: a page that plans, checks and shows dances without a server, as one file."""
