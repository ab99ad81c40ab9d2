"""A Slurm of one's own: munged, slurmctld and slurmd as root in a temporary folder, with ports and a key of their own.

Of the machine's own Slurm, if there is one, nothing is used but the programs. Nothing outside the folder is written.
"""

import contextlib
import ctypes
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time

NODES = ("one", "two")
GPUS = 2  # pretended GPUs of a node: a file each; slurmd only needs it to exist
SECONDS = 30  # for a daemon to answer
CONFIGURATION = """
ClusterName=vkhausdorff
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={controller}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CredType=cred/munge
# A task that is requeued waits as long as its credential is good for.
AuthInfo=socket={folder}/munge/socket,cred_expire=5
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=2,batch_sched_delay=0,requeue_setup_env_fail
SlurmdParameters=config_overrides
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
KillWait=20
# sbatch --wait looks after 2 and 8 s, and then every 8 s: the least that is more than half of this.
MinJobAge=15
MaxArraySize={largest_array}
ReturnToService=2
MailProg=/bin/true
GresTypes=gpu
{nodes}
PartitionName=gpu Nodes=ALL Default=YES MaxTime=60 PriorityTier=1
PartitionName=day Nodes=ALL MaxTime=60 PriorityTier=9 PreemptMode=OFF
"""


PATH = os.environ.get("PATH", "/usr/bin:/bin") + ":/usr/sbin:/sbin"


def missing() -> str:
    """The missing parts of this machine, in words; nothing if none is missing."""
    for program in ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "scancel", "squeue"):
        if not shutil.which(program, path=PATH):
            return f"no {program} here (Debian: slurm-wlm, munge)"
    return "" if os.geteuid() == 0 else "munged and slurmd are started as root, and this is not root"


def end_with_parent() -> None:
    """Runs in a child: it gets SIGTERM when this process ends, even if that is killed, as ctest does after a
    time."""
    pr_set_pdeathsig = 1
    ctypes.CDLL(None).prctl(pr_set_pdeathsig, signal.SIGTERM)


def free_ports(count: int) -> list[int]:
    """Free ports above 16000; held together, so that no two are the same."""
    with contextlib.ExitStack() as held:
        ports = []
        for port in range(16100 + os.getpid() % 900 * 10, 32000):
            taken = held.enter_context(socket.socket())
            with contextlib.suppress(OSError):
                taken.bind(("127.0.0.1", port))
                ports.append(port)
            if len(ports) == count:
                return ports
    raise RuntimeError("no free ports above 16000")


class LocalSlurm:
    """Use it as a context: daemons run inside it, and none outlives it."""

    def __init__(self, folder: pathlib.Path, largest_array: int) -> None:
        self.folder, self.largest_array = folder, largest_array
        self.daemons: dict[str, subprocess.Popen] = {}
        self.environment = {name: value for name, value in os.environ.items()
                            if not name.startswith(("SLURM", "SBATCH", "SALLOC", "SRUN", "SQUEUE", "SCANCEL", "VKH_"))}
        self.environment |= {"SLURM_CONF": str(folder / "slurm.conf"), "PATH": PATH}

    def __enter__(self) -> "LocalSlurm":
        try:
            self.start()
        except BaseException:
            self.stop()
            raise
        return self

    def __exit__(self, *_) -> None:
        self.stop()

    def start(self) -> None:
        for name in ("munge", "state"):
            (self.folder / name).mkdir(mode=0o755)
        key = self.folder / "munge" / "key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        controller, *ports = free_ports(1 + len(NODES))
        nodes = "\n".join(f"NodeName={name} NodeHostname=localhost NodeAddr=127.0.0.1 Port={port} CPUs=4 Gres=gpu:{GPUS} State=UNKNOWN"
                          for name, port in zip(NODES, ports))
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(folder=self.folder, largest_array=self.largest_array, controller=controller, nodes=nodes))
        (self.folder / "gres.conf").write_text(
            "".join(f"NodeName={name} Name=gpu File={self.folder}/gpu[0-{GPUS - 1}]\n" for name in NODES))
        for i in range(GPUS):
            (self.folder / f"gpu{i}").touch()
        munge = {"key-file": key, **{f"{kind}-file": self.folder / "munge" / kind for kind in ("log", "pid", "seed")}}
        # --force: it wants a socket that all users reach, and a temporary folder is only its owner's.
        self.daemon("munged", "--foreground", "--force", f"--socket={self.folder}/munge/socket",
                    *(f"--{option}={path}" for option, path in munge.items()))
        self.until(lambda: (self.folder / "munge" / "socket").exists(), "munged's socket")
        self.daemon("slurmctld", "-D")
        self.until(lambda: self.run("scontrol", "ping", check=False).returncode == 0, "slurmctld")
        for name in NODES:
            self.daemon("slurmd", "-D", "-N", name, as_name=f"slurmd-{name}")
        self.until(lambda: self.run("sinfo", "--noheader", "--states=idle", "--format=%D", "--partition=gpu").stdout.strip()
                   == str(len(NODES)), "idle nodes")

    def daemon(self, *words: str, as_name: str = "") -> None:
        name = as_name or words[0]
        with open(self.folder / f"{name}.said", "wb") as said:
            self.daemons[name] = subprocess.Popen(words, env=self.environment, stdin=subprocess.DEVNULL, stdout=said,
                                                  stderr=said, start_new_session=True, preexec_fn=end_with_parent)

    def until(self, true, what: str, seconds: float = SECONDS) -> None:
        """Waits until `true()`; a daemon that has ended is reported at once."""
        end = time.monotonic() + seconds
        while not true():
            for name, daemon in self.daemons.items():
                if daemon.poll() is not None:
                    raise RuntimeError(f"{name} ended with {daemon.returncode}: {self.said(name)}")
            if time.monotonic() > end:
                raise TimeoutError(f"{what}: not after {seconds} s\n" + "\n".join(map(self.said, self.daemons)))
            time.sleep(0.1)

    def said(self, name: str) -> str:
        """The end of a daemon's log."""
        files = [self.folder / f"{name}.said", self.folder / f"{name}.log", self.folder / "munge" / "log"]
        lines = [line for path in files if path.exists() for line in path.read_text(errors="replace").splitlines()]
        return f"{name}: " + "\n".join(lines[-12:])

    def run(self, *words, check: bool = True, seconds: float = 60) -> subprocess.CompletedProcess:
        done = subprocess.run([str(word) for word in words], env=self.environment, capture_output=True, text=True, timeout=seconds)
        if check and done.returncode:
            raise RuntimeError(f"{words}: {done.returncode}\n{done.stdout}{done.stderr}")
        return done

    def stop(self) -> None:
        """Ends jobs first, then the daemons that would start them again, then munged, on which all rely. Each
        has five seconds."""
        if "slurmctld" in self.daemons:
            with contextlib.suppress(Exception):
                self.run("scancel", "--user=root", "--full", "--signal=KILL", seconds=10)
                self.run("scancel", "--user=root", seconds=10)
        for daemon in (*[self.daemons[name] for name in self.daemons if name != "munged"],
                       *[self.daemons[name] for name in self.daemons if name == "munged"]):
            daemon.terminate()
            with contextlib.suppress(subprocess.TimeoutExpired):
                daemon.wait(5)
        for pid in self.stray():
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        for daemon in self.daemons.values():
            daemon.wait(5)

    def stray(self) -> list[int]:
        """The processes with our slurm.conf in their environment: slurmstepd, and the children of a
        task."""
        mark = f"SLURM_CONF={self.environment['SLURM_CONF']}\0".encode()
        out = []
        for entry in pathlib.Path("/proc").iterdir():
            with contextlib.suppress(OSError):
                if entry.name.isdigit() and int(entry.name) != os.getpid() and mark in (entry / "environ").read_bytes() + b"\0":
                    out.append(int(entry.name))
        return out
