"""The contest's problem and a paper on it: claims, their evidence, the report."""
