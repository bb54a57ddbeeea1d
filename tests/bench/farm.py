#!/usr/bin/env python3
"""A farm on one machine: parts on a Slurm of four nodes (two killed, one slow, one part forged), by Open Job
Description and by GNU parallel, each against one process, bit by bit; what parts cost; and many parts merged.

    cargo build --release && tests/bench/farm.py [--parts 64] [--scale 4] [--merge 1000] [FOLDER]

What is not installed is skipped, and that is said. Debian: apt-get install --no-install-recommends slurm-wlm
slurm-client munge parallel; pip install openjd-cli.
"""

import argparse
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
PINHOLE = pathlib.Path(os.environ.get("PINHOLE", ROOT / "target/release/pinhole"))

# A scene of every integrator, with what a film keeps beside its sums.
SCENES = [
    ("ray casting", "10 --size 240x135 -n 256"),
    ("Whitted", "20 --size 240x135 -n 128"),
    ("occlusion", "22 --size 240x135 -n 128"),
    ("distribution", "24 --size 240x135 -n 192"),
    ("paths", "25 --size 240x135 -n 256 --layers all"),
    ("paths, negative lobes", "26 --size 240x135 -n 200 --filter mitchell"),
    ("light tracing", "27 --size 240x135 -n 128"),
    ("adaptive", "21 --size 240x135 -n 512 --error 0.02"),
]

CONF = """
ClusterName=pinhole
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={dir}/munge/socket,cred_expire=5
CryptoType=crypto/munge
SlurmctldPort=16817
SlurmctldPidFile={dir}/pid/slurmctld
SlurmdPidFile={dir}/pid/%n
StateSaveLocation={dir}/state
SlurmdSpoolDir={dir}/spool.%n
SlurmctldLogFile={dir}/log/slurmctld
SlurmdLogFile={dir}/log/%n
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SchedulerType=sched/backfill
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
MaxArraySize=10001
MaxJobCount=20000
SlurmctldTimeout=30
SlurmdTimeout=10
InactiveLimit=0
KillWait=5
MinJobAge=3600
SchedulerParameters=sched_interval=1,batch_sched_delay=0,bf_interval=1,sched_min_interval=0
RequeueExit=75
JobRequeue=1
EpilogMsgTime=0
CompleteWait=0
NodeName=node[1-{nodes}] NodeHostname={host} NodeAddr=127.0.0.1 Port=[17001-{last}] CPUs=1 RealMemory=1000 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


class Slurm:
    """A Slurm of a few nodes on this machine, as root, without systemd."""

    def __init__(self, folder, nodes):
        self.folder, self.nodes = folder, nodes
        for name in ["munge", "state", "log", "pid"]:
            (folder / name).mkdir(parents=True)
        munge = folder / "munge"
        munge.chmod(0o700)
        (munge / "key").write_bytes(os.urandom(128))
        (munge / "key").chmod(0o400)
        run(["munged", "--force", f"--key-file={munge}/key", f"--socket={munge}/socket", f"--log-file={munge}/log",
             f"--pid-file={munge}/pid", f"--seed-file={munge}/seed"])
        host = socket.gethostname().split(".")[0]
        conf = CONF.format(host=host, dir=folder, nodes=nodes, last=17000 + nodes)
        (folder / "slurm.conf").write_text(conf)
        os.environ["SLURM_CONF"] = str(folder / "slurm.conf")
        run(["slurmctld"])
        for node in range(1, nodes + 1):
            run(["slurmd", "-N", f"node{node}"])
        for _ in range(100):
            if out(["sinfo", "--noheader", "--format=%D %t"]).split() == [str(nodes), "idle"]:
                return
            time.sleep(0.2)
        raise SystemExit(f"Slurm does not come up: {folder}/log")

    def kill(self, node):
        """As if the machine were gone: the daemon first, then what watches the jobs, then these, so that nobody reports."""
        named = f"SLURMD_NODENAME=node{node}".encode()
        jobs, watchers = [], []
        for line in out(["ps", "-eo", "pid,args"]).splitlines():
            pid, args = line.split(None, 1)
            if args.startswith("slurmd ") and args.endswith(f"-N node{node}"):
                kill(int(pid))
        for entry in pathlib.Path("/proc").glob("[0-9]*/environ"):
            try:
                if named in entry.read_bytes().split(b"\0"):
                    pid = int(entry.parent.name)
                    parent = int((entry.parent / "stat").read_text().rsplit(")", 1)[1].split()[1])
                    jobs.append(pid)
                    if b"slurmstepd" in pathlib.Path(f"/proc/{parent}/cmdline").read_bytes():
                        watchers.append(parent)
            except (OSError, ValueError):
                pass
        for pid in watchers + jobs:
            kill(pid)

    def back(self, node):
        run(["slurmd", "-N", f"node{node}"])

    def down(self):
        for name in [*(self.folder / "pid").iterdir(), self.folder / "munge/pid"]:
            try:
                os.kill(int(name.read_text()), signal.SIGTERM)
            except (OSError, ValueError):
                pass


def kill(pid):
    try:
        os.kill(pid, signal.SIGKILL)
    except OSError:
        pass


def run(words, **more):
    return subprocess.run(words, check=True, **more)


def out(words):
    return subprocess.run(words, check=False, capture_output=True, text=True).stdout


def cpu():
    """Processor seconds of all children that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def render(words, picture):
    began = cpu()
    run([PINHOLE, "render", *words.split(), "-j", "1", "-o", picture, "--quiet", "--no-preflight"], stdout=subprocess.DEVNULL)
    return cpu() - began


def same(one, other):
    return pathlib.Path(one).read_bytes() == pathlib.Path(other).read_bytes()


def overhead(folder, parts):
    """Processor seconds of all parts with their merge over those of one process."""
    ratios = []
    for name, words in SCENES:
        whole = render(words, folder / "whole.exr")
        began = cpu()
        run([PINHOLE, "farm", *words.split(), "--parts", str(parts), "--local", "--no-preflight", "-o", folder / "parts.exr"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        spent = cpu() - began
        ratios.append(spent / whole)
        told = "the same bits" if same(folder / "whole.exr", folder / "parts.exr") else "OTHER BITS"
        print(f"{name}: one process {whole:.2f} s, {parts} parts {spent:.2f} s, {spent / whole:.3f}; {told}", flush=True)
        for file in folder.glob("parts*"):
            file.unlink()
    return ratios


def on_slurm(folder, parts):
    missing = [name for name in ["sbatch", "slurmctld", "slurmd", "munged"] if not shutil.which(name)]
    if missing or os.geteuid() != 0:
        print(f"Slurm: skipped, {', '.join(missing) or 'it needs root'} is missing")
        return
    slurm = Slurm(folder / "slurm", 4)
    try:
        for number, (name, words) in enumerate(SCENES):
            whole, picture = folder / f"whole{number}.exr", folder / f"farm{number}.exr"
            render(words, whole)
            began = time.time()
            farm = [PINHOLE, "farm", *words.split(), "--parts", str(parts), "--to", "slurm", "-o", picture, "--write-every", "1s"]
            run(farm, stdout=subprocess.DEVNULL)
            run(["sh", picture.with_suffix(".submit.sh")], stdout=subprocess.DEVNULL)
            # Two nodes die at work; a third is slowed down; they come back later.
            time.sleep(2)
            slurm.kill(1)
            slurm.kill(2)
            slow = [pid for pid in out(["pgrep", "-f", "render .*--part"]).split()][:1]
            for pid in slow:
                subprocess.run(["renice", "19", pid], check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            forged = None
            back = time.time() + 15
            while True:
                time.sleep(1)
                if back and time.time() > back:
                    slurm.back(1)
                    slurm.back(2)
                    back = None
                done = sorted(folder.glob(f"farm{number}.part-*"))
                if done and forged is None:
                    # A part that somebody else has written: whole, but of another seed.
                    forged = done[0]
                if not out(["squeue", "--noheader"]).strip():
                    break
            number_of = forged.name.split("part-")[1].split("-of-")[0]
            kept = forged.read_bytes()
            render(f"{words} --seed 77 --part {number_of}/{parts}", folder / "forged.exr")
            shutil.copy(next(folder.glob("forged.part-*")), forged)
            refused = subprocess.run([PINHOLE, "merge", *words.split(), "-o", picture], capture_output=True, text=True)
            assert refused.returncode == 75 and forged.name in refused.stderr, refused
            forged.write_bytes(kept)
            merged = subprocess.run([PINHOLE, "merge", *words.split(), "-o", picture], capture_output=True, text=True)
            told = "the same bits" if merged.returncode == 0 and same(whole, picture) else f"OTHER BITS: {merged}"
            print(f"Slurm, {name}: {parts} parts in {time.time() - began:.0f} s, two nodes killed, a forged part refused; {told}", flush=True)
            for file in [*folder.glob(f"farm{number}*"), *folder.glob("forged*")]:
                file.unlink()
    finally:
        slurm.down()


def on_others(folder, parts):
    name, words = SCENES[min(4, len(SCENES) - 1)]
    whole = folder / "whole_others.exr"
    render(words, whole)
    for engine, program in [("openjd", "openjd"), ("parallel", "parallel")]:
        if not shutil.which(program):
            print(f"{engine}: skipped, {program} is not installed")
            continue
        picture = folder / f"{engine}.exr"
        began = time.time()
        run([PINHOLE, "farm", *words.split(), "--parts", str(parts), "--to", engine, "--submit", "-o", picture],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        told = "the same bits" if same(whole, picture) else "OTHER BITS"
        print(f"{engine}: {parts} parts of {name} in {time.time() - began:.0f} s; {told}", flush=True)


def many(folder, parts):
    """Many parts of a large picture, merged: seconds and memory."""
    words = "5 --size 1920x1080 -n 2"
    run([PINHOLE, "farm", *words.split(), "--parts", str(parts), "--local", "-o", folder / "many.exr"],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    began = time.time()
    merged = subprocess.run(["/usr/bin/time", "-v", PINHOLE, "merge", *words.split(), "-o", folder / "many.exr"],
                            capture_output=True, text=True)
    seconds = time.time() - began
    peak = [line.split(":")[1].strip() for line in merged.stderr.splitlines() if "Maximum resident" in line]
    megabytes = int(peak[0]) / 1024 if peak else float("nan")
    render(words, folder / "many_whole.exr")
    told = "the same bits" if same(folder / "many.exr", folder / "many_whole.exr") else "OTHER BITS"
    print(f"{parts} parts at 1920 × 1080: merged in {seconds:.1f} s and {megabytes:.0f} MB; {told}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--parts", type=int, default=64)
    parser.add_argument("--merge", type=int, default=1000)
    parser.add_argument("--only", choices=["overhead", "slurm", "others", "merge"])
    parser.add_argument("--scenes", help="the numbers of the scenes, from 1, such as 1,3,4")
    parser.add_argument("--times", type=int, default=1, help="how many times as many samples")
    parser.add_argument("--scale", type=int, default=1, help="how many times as wide and as high the pictures are")
    parser.add_argument("folder", nargs="?", default=pathlib.Path(tempfile.gettempdir()) / "pinhole-farm")
    asked = parser.parse_args()
    if asked.scenes:
        SCENES[:] = [SCENES[int(number) - 1] for number in asked.scenes.split(",")]
    size = f"--size {240 * asked.scale}x{135 * asked.scale}"
    more = lambda words: re.sub(r"-n (\d+)", lambda found: f"-n {int(found[1]) * asked.times}", words)
    SCENES[:] = [(name, more(words.replace("--size 240x135", size))) for name, words in SCENES]
    folder = pathlib.Path(asked.folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    if not PINHOLE.exists():
        raise SystemExit("first: cargo build --release")
    print(json.dumps({"load": os.getloadavg(), "cores": os.cpu_count(), "program": str(PINHOLE)}))
    if asked.only in (None, "overhead"):
        ratios = overhead(folder, asked.parts)
        print(f"overhead: {min(ratios):.3f} to {max(ratios):.3f}")
    if asked.only in (None, "slurm"):
        on_slurm(folder, asked.parts)
    if asked.only in (None, "others"):
        on_others(folder, asked.parts)
    if asked.only in (None, "merge"):
        many(folder, asked.merge)


if __name__ == "__main__":
    sys.exit(main())
