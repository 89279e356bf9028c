"""Lines that somebody drew or surveyed: read from files, brought near the dance, made into routes."""
