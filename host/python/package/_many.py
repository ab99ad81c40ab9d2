"""distances(): pairs in, results out, as they end. The threads and devices are those of vkhausdorff._core."""

from vkhausdorff import _core, _result
from vkhausdorff._keywords import takes_keywords_of


@takes_keywords_of(_core._Stream)
def distances(pairs, *, on_progress=None, **options):
    """The distance of each of many pairs: an iterator of results, in the order in which pairs end.

    pairs: an iterable, which may be endless, of (a, b) or (id, a, b). Each of a and b is a mesh: what read() returns, the
    path of a file, (vertices, faces), or an object with .vertices and .faces (or .triangles). Files are read by threads.
    against: the B of all pairs; pairs then has meshes a, or (id, a), where id is a string or an int. B is prepared once on
    each device, and answers are those of Solver(b).distance(a); otherwise they are those of distance(a, b).

    A result has index, the pair's place in pairs, from 0, and id, or None. A pair that fails (a bad file, a wrong array)
    does not end the others: its result has error, the exception, and every other member raises that. Otherwise error is
    None. max: the limit of gate(), a number in the coordinates' unit or a string such as '0.1%' of A's diagonal; results
    then have verdict, and tol is 1e-7, otherwise 1e-6. tol, symmetric, memory, waves, disable, enable and preset are those
    of distance(), time is the seconds that each pair may take. device: as distance() has it, or several between commas such
    as '0,1', or 'all', every GPU. together: pairs in one submission; lanes: submissions at once on a device; None for what
    pays there. max_input, polygons and bodies are those of read(); field, statistics, signed, bands, effort, survey_time,
    unit_a, unit_b, transform, scale, align, max_distance and points those of distance(), for each pair.
    on_progress(fraction, lower, upper) is called as each pair ends, on the thread of next(): the share of pairs that have
    ended, which comes to 1, and the interval of the largest distance among them. Where pairs has no len(), the share is 0
    until the last pair is taken. Return False to end.

    Pairs are taken from the iterable by next(), on its thread, ahead of results: at most `ahead` that have no result yet or
    one that was not asked for. That is 2 * lanes * together of a GPU (96) a device if None. No pair is taken while meshes
    of those are above 2 GiB. An exception that pairs raises is raised after the results of what was taken before. To end
    early, leave the loop and drop the iterator, use it in a with statement, or call its close(), on any thread: what runs is
    cancelled and no device is left open. Ctrl-C does so, too. DeviceError if no device is left.
    """
    try:
        items = iter(pairs)
    except TypeError:
        raise TypeError(f"pairs: expected an iterable of (a, b) or (id, a, b), not {type(pairs).__name__}") from None
    first = getattr(pairs, "first_index", 0)  # vkhausdorff.dask's shards have it
    progress = None if on_progress is None else Progress(on_progress, pairs, first)
    if options.get("tol", 0) is None:  # the default depends on whether there is a limit
        del options["tol"]
    stream = _core._Stream(**options)
    split = _with_one if options.get("against") is not None else _with_two
    return _Results(stream, _results(stream, items, split, first, progress))


class _Results:
    """The result of distances(): an iterator, and a context manager that closes itself."""

    def __init__(self, stream, results):
        self._stream, self._results = stream, results

    def __iter__(self):
        return self

    def __next__(self):
        return next(self._results)

    def close(self):
        """Cancels what runs. Any thread may call it: one that waits for a result gets StopIteration."""
        self._stream.close()

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self.close()


def _with_two(item):
    """Returns (id, a, b) of an item of pairs."""
    if isinstance(item, (tuple, list)) and len(item) in (2, 3):
        return (None, *item) if len(item) == 2 else tuple(item)
    raise TypeError(f"pairs: expected (a, b) or (id, a, b), not {_shown(item)}")


def _with_one(item):
    """Does the same where all pairs have one B."""
    if isinstance(item, (tuple, list)) and len(item) == 2 and isinstance(item[0], (str, int)):
        return item[0], item[1], None
    return None, item, None


def _shown(item):
    kind = type(item).__name__
    return f"{kind} of {len(item)}" if isinstance(item, (tuple, list)) else kind


def _put(stream, index, item, split):
    """Puts a pair. Returns None, or the result of a pair that is wrong."""
    id = None
    try:
        id, a, b = split(item)
        stream.put(index, id, a, b)
    except Exception as error:
        return _result.made(index=index, id=id, error=error.with_traceback(None))
    return None


class Progress:
    """Tells a caller how many pairs have ended, and what they have shown."""

    def __init__(self, on_progress, pairs, first=0):
        if not callable(on_progress):
            raise TypeError("on_progress: expected a function of fraction, lower and upper, or None, "
                            f"not a value of type {type(on_progress).__name__}")
        self._on_progress, self._first = on_progress, first
        self._count = len(pairs) if hasattr(pairs, "__len__") else 0  # 0: not known
        self._ended, self._fraction, self._lower, self._upper = 0, 0.0, 0.0, 0.0

    def know_count(self, index):
        """No pair comes after those below this index."""
        self._count = index - self._first

    def hear(self, result):
        """Returns whether to go on."""
        self._ended += 1
        if result.error is None:
            self._lower, self._upper = max(self._lower, result.lower), max(self._upper, result.upper)
        return self._tell(self._ended / self._count if self._count else 0.0)

    def end(self):
        if self._fraction < 1:
            self._tell(1.0)

    def _tell(self, fraction):
        self._fraction = max(self._fraction, min(fraction, 1.0))
        answer = self._on_progress(self._fraction, self._lower, self._upper)
        return answer is None or bool(answer)


def _results(stream, items, split, index, progress):
    failure = None
    try:
        while True:
            result = None
            while result is None and items is not None and stream.has_room():
                try:
                    item = next(items)
                except StopIteration:
                    items = None
                    if progress is not None:
                        progress.know_count(index)
                except Exception as error:
                    items, failure = None, error
                else:
                    result = _put(stream, index, item, split) or stream.take(False)
                    index += 1
            item = None  # arrays are the caller's to drop
            if result is None:
                result = stream.take(True)
            if result is None:
                break
            is_last = progress is not None and not progress.hear(result)
            if is_last:
                stream.close()
            yield result
            if is_last:
                return
        if progress is not None and failure is None:
            progress.end()
        if failure is not None:
            raise failure
    finally:
        failure = None  # its traceback has this frame
        stream.close()


distances.__module__ = "vkhausdorff"
