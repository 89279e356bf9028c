"""Answers derived step by step, with the numbers of the case."""
