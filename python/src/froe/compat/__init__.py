"""Classes that take the place of classes of other libraries, with the same methods and the same shapes of results."""
