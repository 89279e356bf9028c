"""Many questions about one plan: at which points, what comes out, and where to look closer."""
