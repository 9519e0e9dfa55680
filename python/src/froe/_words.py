"""Numbers of things in words."""


def counted(count: int, one: str) -> str:
    """1 object, 2 objects.

    >>> counted(1, "object"), counted(0, "object")
    ('1 object', '0 objects')
    """
    return f"{count} {one if count == 1 else one + 's'}"
