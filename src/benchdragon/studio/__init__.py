"""The studio: plans, verdicts and long questions in a browser, computed by workers."""
