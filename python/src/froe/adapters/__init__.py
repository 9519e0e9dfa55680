"""Scenes from the objects of other libraries. Each module imports its partner when a function of it is called."""
