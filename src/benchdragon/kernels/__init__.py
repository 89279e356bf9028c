"""Compiled arithmetic: numbers and arrays in, numbers, arrays and a `Status` out."""
