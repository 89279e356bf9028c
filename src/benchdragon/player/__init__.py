"""A dance as one page for any browser."""
