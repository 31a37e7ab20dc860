"""Runs a command beside a Slurm of this machine alone, which ends with it: ``slurm_loopback.py sbatch --wait …``.

Needs Debian's packages ``slurmctld``, ``slurmd``, ``slurm-client`` and ``munge``; no service of them has to run.
"""

from __future__ import annotations

import getpass
import os
import secrets
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from contextlib import ExitStack
from pathlib import Path

PROGRAMS = ["munged", "slurmctld", "slurmd", "sbatch"]
# Where Debian keeps daemons, which is not on every user's path.
PATH = os.pathsep.join([os.environ.get("PATH", ""), "/usr/sbin", "/usr/local/sbin"])

# A head and one node, both here. Slurm's own defaults need a service manager, control groups and a user of its own.
CONFIGURATION = """
ClusterName=loopback
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={head_port}
SlurmdPort={node_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP
"""


def missing() -> list[str]:
    return [name for name in PROGRAMS if shutil.which(name, path=PATH) is None]


def free_ports() -> tuple[int, int]:
    with socket.socket() as one, socket.socket() as other:
        one.bind(("127.0.0.1", 0))
        other.bind(("127.0.0.1", 0))
        return one.getsockname()[1], other.getsockname()[1]


def run(command: list[str]) -> int:
    with tempfile.TemporaryDirectory(prefix="slurm-") as name, ExitStack() as daemons:
        folder = Path(name)
        for part in ("state", "spool"):
            (folder / part).mkdir()
        key = folder / "munge.key"
        key.touch(mode=0o600)
        key.write_bytes(secrets.token_bytes(128))
        configuration = folder / "slurm.conf"
        head_port, node_port = free_ports()
        configuration.write_text(
            CONFIGURATION.format(
                host=socket.gethostname().split(".")[0],
                head_port=head_port,
                node_port=node_port,
                user=getpass.getuser(),
                folder=folder,
                cores=os.cpu_count(),
            )
        )
        environment = {**os.environ, "PATH": PATH, "SLURM_CONF": str(configuration)}
        log = daemons.enter_context((folder / "log").open("w+"))

        def start(*daemon: str) -> None:
            process = subprocess.Popen(daemon, env=environment, stdout=log, stderr=log)
            daemons.callback(process.wait)
            daemons.callback(process.terminate)

        kept = {"key-file": "munge.key", "socket": "munge.socket", "pid-file": "munge.pid", "seed-file": "munge.seed"}
        kept["log-file"] = "munge.log"
        # By force: a folder for temporary files may be written to by everybody.
        start("munged", "--foreground", "--force", *(f"--{option}={folder / file}" for option, file in kept.items()))
        for daemon in ("slurmctld", "slurmd"):
            start(daemon, "-D", "-f", str(configuration))
        for _ in range(300):
            idle = subprocess.run(
                ["sinfo", "--noheader", "--states=idle"], env=environment, capture_output=True, text=True
            )
            if idle.stdout.strip():
                return subprocess.run(command, env=environment).returncode
            time.sleep(0.1)
        log.seek(0)
        print(f"no node of Slurm answers within half a minute:\n{log.read()}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    if absent := missing():
        sys.exit(f"not installed: {', '.join(absent)}")
    sys.exit(run(sys.argv[1:]))
