"""Signatures of functions that pass their keywords on to the compiled part, which has them from its table of options."""

import inspect
import re


def takes_keywords_of(core):
    """A decorator: shows the function's own arguments, and in place of **options the keywords that `core` takes besides.

    Keywords that the function's text does not name are added to it.
    """

    def shown(function):
        own = list(inspect.signature(function).parameters.values())[:-1]
        names = {one.name for one in own}
        others = [one.replace(kind=one.KEYWORD_ONLY) for one in inspect.signature(core).parameters.values() if one.name not in names]
        function.__signature__ = inspect.Signature([*own, *others])
        text = function.__doc__ or ""
        more = ", ".join(one.name for one in others if not re.search(rf"\b{one.name}\b", text))
        if text and more:
            function.__doc__ = f"{text.rstrip()}\n\n    {more}: as distance() has them.\n    "
        return function

    return shown
