"""Signatures of functions that pass their keywords on to the compiled part, which has them from its table of options."""

import inspect


def takes_keywords_of(core):
    """A decorator: shows the function's own arguments, and in place of **options the keywords that `core` takes besides."""

    def shown(function):
        own = list(inspect.signature(function).parameters.values())[:-1]
        names = {one.name for one in own}
        others = [one.replace(kind=one.KEYWORD_ONLY) for one in inspect.signature(core).parameters.values() if one.name not in names]
        function.__signature__ = inspect.Signature([*own, *others])
        return function

    return shown
