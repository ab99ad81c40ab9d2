"""Many pairs by the workers of a Dask cluster: vkhausdorff.distances() over shards, on an existing distributed.Client."""

import itertools
import os
import pathlib
import tempfile
import threading
import zlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

from vkhausdorff._many import Progress

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

__all__ = ["distances"]


def distances(client: Any, pairs: Iterable[Any], *, shard: int = 1000, ahead: int = 2, retries: int = 3,
              devices: Sequence[str] = (), on_progress: Callable[[float, float, float], Any] | None = None,
              **options: Any) -> Iterator[Any]:
    """Yields what vkhausdorff.distances(pairs, **options) gives, in the order in which shards end: see a result's index and id.

    client: a distributed.Client, not an asynchronous one. Its workers have this package, and see the files that pairs
    name; names are of this process's folder. shard: pairs of a task; take from 100 to 10,000, as a task costs Dask longer
    than a pair takes. ahead: shards submitted for each worker. retries: so often a shard is done again after an error,
    besides what Dask does again because a worker was lost; a pair's own error is in its result. devices: of each machine,
    as distances() takes one; each worker's process there takes one that no other has. Without them every worker takes the
    best. Arrays travel with their task; names of files are quicker. on_progress(fraction, lower, upper) is called in this
    process, on the thread of next(), as distances() has it, for each pair of a shard that has ended. Return False to end:
    shards that run are cancelled.
    """
    if getattr(client, "asynchronous", False):
        raise TypeError("client: expected one that is not asynchronous")
    if isinstance(devices, str) or "device" in options:
        raise TypeError("devices: expected a sequence of devices, such as ('0', '1'), in place of device")
    if shard < 1 or ahead < 1:
        raise ValueError("shard, ahead: expected whole numbers from 1")
    if options.get("against") is not None:
        options["against"] = _absolute(options["against"])
    progress = None if on_progress is None else Progress(on_progress, pairs)
    shards = _dealt(pairs, shard, "against" in options, progress)
    return _as_they_end(client, shards, ahead, retries, (tuple(devices), options), progress)


def _as_they_end(client: Any, shards: Iterator["_Shard"], ahead: int, retries: int, how: tuple[Any, ...],
                 progress: Any) -> Iterator[Any]:
    from distributed import as_completed

    ending: Any = as_completed(loop=client.loop)
    running: set[Any] = set()

    def submit() -> None:
        most = ahead * max(1, len(client.scheduler_info()["workers"]))  # now: workers come and go
        for pairs in itertools.islice(shards, max(0, most - len(running))):
            running.add(future := client.submit(_do, pairs, *how, retries=retries, pure=False))
            ending.add(future)

    try:
        submit()
        for future in ending:
            running.remove(future)
            results = future.result()
            future.release()
            submit()
            for result in results:
                is_last = progress is not None and not progress.hear(result)
                yield result
                if is_last:
                    return
        if progress is not None:
            progress.end()
    finally:
        client.cancel(list(running))


class _Shard(list[Any]):
    """A part of all pairs; its first pair has the number first_index."""

    first_index = 0


def _dealt(pairs: Iterable[Any], size: int, has_one: bool, progress: Any) -> Iterator[_Shard]:
    rest, first = iter(pairs), 0
    while some := _Shard(_there(pair, has_one) for pair in itertools.islice(rest, size)):
        some.first_index = first
        first += len(some)
        yield some
    if progress is not None:
        progress.know_count(first)


def _there(pair: Any, has_one: bool) -> Any:
    """A pair as a worker understands it, since its folder may be another. Errors are left to its result."""
    if has_one:
        named = isinstance(pair, (tuple, list)) and len(pair) == 2 and isinstance(pair[0], (str, int))
        return (pair[0], _absolute(pair[1])) if named else _absolute(pair)
    if not isinstance(pair, (tuple, list)) or len(pair) not in (2, 3):
        return pair
    return (*pair[:-2], _absolute(pair[-2]), _absolute(pair[-1]))


def _absolute(mesh: Any) -> Any:
    return os.path.abspath(mesh) if isinstance(mesh, (str, os.PathLike)) else mesh


# The rest runs in workers.
_one_at_a_time = threading.Lock()  # distances() takes all cores, and a worker may have many threads
_mine: dict[tuple[str, ...], tuple[str, Any]] = {}


def _do(pairs: _Shard, devices: tuple[str, ...], options: dict[str, Any]) -> list[Any]:
    import vkhausdorff

    with _one_at_a_time:
        return list(vkhausdorff.distances(pairs, device=_device_of(devices), **options))


def _device_of(devices: tuple[str, ...]) -> str:
    """A device of this machine that no other worker's process has; it is free again when the process ends, however it does."""
    if not devices:
        return ""
    if devices not in _mine:
        shared = zlib.crc32(b"%d" % os.getpid()) % len(devices)
        _mine[devices] = next(filter(None, map(_claimed, devices)), (devices[shared], None))
    return _mine[devices][0]


def _claimed(device: str) -> Any:
    """The device and the lock on it, or None where another process has it."""
    if fcntl is None:
        return None
    folder = pathlib.Path(tempfile.gettempdir()) / f"vkhausdorff-{os.getuid()}"
    folder.mkdir(mode=0o700, exist_ok=True)
    if folder.lstat().st_uid != os.getuid():
        return None  # another user has made it
    lock = open(folder / f"device-{device.encode().hex()}", "ab")
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        lock.close()
        return None
    return device, lock
