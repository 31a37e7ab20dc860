"""Runs the cases of a campaign on a Dask cluster: `python -m peenpose.dask study --scheduler tcp://...`.

The workers must see the folder of the campaign under the same path.
"""

from __future__ import annotations

import argparse
import os
import sys
from typing import Any

from . import campaigns
from ._problem import PathLike


def run(client: Any, folder: PathLike, shards: int | None = None) -> campaigns.Status:
    """Solves what is missing, a shard on each free thread of a worker; `client` is a distributed.Client."""
    folder = os.path.abspath(os.fspath(folder))
    if shards is None:
        threads = sum(client.nthreads().values())
        shards = max(1, min(campaigns.status(folder).cases, 8 * threads))
    names = [f"{number}/{shards}" for number in range(1, shards + 1)]
    tasks = client.map(lambda name: campaigns.run(folder, name, threads=1), names, pure=False)
    client.gather(tasks)
    return campaigns.status(folder)


def main(arguments: list[str] | None = None) -> int:
    """The command; its status is 2 where problems have faults."""
    from distributed import Client

    parser = argparse.ArgumentParser(prog="python -m peenpose.dask", description=__doc__)
    parser.add_argument("folder", help="the folder of the campaign")
    parser.add_argument("--scheduler", help="address of the scheduler; a cluster on this machine by default")
    parser.add_argument("--shards", type=int, help="tasks; eight for each thread of the cluster by default")
    given = parser.parse_args(arguments)
    connect: Any = Client
    with connect(given.scheduler) as client:
        found = run(client, given.folder, given.shards)
    print(f"{found.done} done, {found.missing} missing, {found.faulty} faulty")
    return 2 if found.faulty else 0


if __name__ == "__main__":
    sys.exit(main())
