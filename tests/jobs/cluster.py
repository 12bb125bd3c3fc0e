"""A Slurm cluster of two nodes on this machine, for tests: its own configuration, folder and ports, nothing beyond the
loopback address, and no system service. Every process is ended by its id."""

import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol", "scancel", "sinfo")
CONFIGURATION = """
ClusterName=nusselt
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmUser={user}
SlurmdUser={user}
# A requeued job waits until the credential of its last start has expired: two minutes unless that is changed here.
AuthInfo=socket={folder}/munge.socket,cred_expire=5
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
# Short times: a test must not wait for a scheduler that saves its strength.
SchedulerParameters=sched_interval=1,batch_sched_delay=0,sched_min_interval=0
SlurmdTimeout=20
KillWait=2
# Nodes may claim more processors than the machine has.
SlurmdParameters=config_overrides
NodeName=n[1-2] NodeHostname={host} NodeAddr=127.0.0.1 Port=[{node_port}-{last_node_port}] CPUs={cpus}
PartitionName=p Nodes=ALL Default=YES State=UP OverSubscribe=NO
"""
CGROUPS = """
CgroupPlugin=cgroup/v1
CgroupMountpoint=/sys/fs/cgroup
ConstrainCores=no
ConstrainRAMSpace=no
"""


def missing_programs():
    return [name for name in PROGRAMS if shutil.which(name, path=search_path()) is None]


def search_path():
    return os.environ["PATH"] + ":/usr/sbin:/sbin"


def free_ports(count):
    """The first of `count` ports in a row that are free now."""
    for first in range(20000 + os.getpid() % 20000, 60000, 7):
        sockets = []
        try:
            for port in range(first, first + count):
                sockets.append(socket.socket())
                sockets[-1].bind(("127.0.0.1", port))
            return first
        except OSError:
            continue
        finally:
            for one in sockets:
                one.close()
    raise RuntimeError("no free ports")


class Cluster:
    """\\param cpus  that each node claims to have"""

    def __init__(self, folder, cpus):
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True)
        self.daemons = {}
        port = free_ports(3)
        host = socket.gethostname().split(".")[0]
        user = subprocess.run(["id", "-un"], check=True, capture_output=True, text=True).stdout.strip()
        (self.folder / "state").mkdir()
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(
            host=host, user=user, folder=self.folder, controller_port=port, node_port=port + 1, last_node_port=port + 2,
            cpus=cpus))
        (self.folder / "cgroup.conf").write_text(CGROUPS)
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        self.environment = {**os.environ, "PATH": search_path(), "SLURM_CONF": str(self.folder / "slurm.conf")}

    def __enter__(self):
        try:
            self.start("munged", "munged", "--foreground", "--force", f"--socket={self.folder}/munge.socket",
                       f"--key-file={self.folder}/munge.key", f"--pid-file={self.folder}/munged.pid",
                       f"--log-file={self.folder}/munged.log", f"--seed-file={self.folder}/munge.seed")
            wait_for(lambda: (self.folder / "munge.socket").exists(), 10, "munged")
            self.start_controller("-c")
            for node in ("n1", "n2"):
                self.start(node, "slurmd", "-D", "-N", node)
            wait_for(lambda: self.output("sinfo", "--noheader", "--format=%T %D", check=False) == "idle 2", 30,
                     "two idle nodes")
        except BaseException:
            self.stop()
            raise
        return self

    def __exit__(self, *_):
        self.stop()

    def start(self, name, *command):
        with open(self.folder / f"{name}.out", "ab") as log:
            self.daemons[name] = subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=log,
                                                  stderr=log, start_new_session=True)

    def start_controller(self, *options):
        self.start("slurmctld", "slurmctld", "-D", *options)

    def end(self, name):
        """Ends a daemon in order. A controller that crashes also forgets the last seconds, and learns from nodes what
        became of their tasks only after minutes."""
        daemon = self.daemons.pop(name)
        daemon.terminate()
        daemon.wait(30)

    def run(self, *command, **options):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, **options)

    def output(self, *command, check=True):
        result = self.run(*command)
        if check and result.returncode != 0:
            raise RuntimeError(f"{command}: {result.stderr}")
        return result.stdout.strip()

    def stop(self):
        if "slurmctld" in self.daemons:
            self.run("scancel", "--user", str(os.getuid()))
            time.sleep(0.5)
        for name in ("n1", "n2", "slurmctld", "munged"):
            if name in self.daemons:
                self.daemons[name].send_signal(signal.SIGTERM)
        for daemon in self.daemons.values():
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
        self.daemons = {}


def wait_for(condition, seconds, what):
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        if condition():
            return
        time.sleep(0.1)
    raise RuntimeError(f"{what} did not happen within {seconds} s")
