"""What walks on what: routes, dragons, speed profiles, and where every handle is."""
