"""Tests of the papers that people hold in their hands."""
