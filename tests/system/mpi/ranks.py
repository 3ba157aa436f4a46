# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
"""Runs osgbindem under mpirun: the same bytes at any number of ranks and after an update, one line for each error, and a
run that lost a rank or was told to stop is completed by the same command, with or without mpirun. Exit code 77:
skipped."""

import argparse
import contextlib
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "crash"))
from crash import Failed, require, run, succeed, tree, write_grid  # noqa: E402

SKIPPED = 77
# -q: mpirun adds nothing of its own to the errors of programs
MPIRUN = ["mpirun", "-q", "--oversubscribe", "--bind-to", "none"]


def cut_void(file):
    """Voids that are filled from their rim and from the globe."""
    lines = file.read_text(encoding="ascii").splitlines()
    rows = [line.split() for line in lines[5:]]
    for row in range(8, 30):
        rows[row][10:32] = ["-9999"] * 22
    rows[3][3:6] = ["-9999"] * 3
    lines = lines[:5] + ["NODATA_value -9999"] + [" ".join(row) for row in rows]
    file.write_text("\n".join(lines) + "\n", encoding="ascii")


class Ranks:
    def __init__(self, work, osgbindem):
        self.work, self.osgbindem = work, osgbindem
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
        write_grid(work / "globe.asc", 720, 360, -180, -90, 0.5)
        write_grid(work / "inset.asc", 40, 40, 10, 40, 0.1)
        cut_void(work / "inset.asc")
        succeed(self.build(self.folder("alone")) + ["--quiet"])
        self.expected = tree(work / "alone")
        require(len(self.expected) > 100, "the database is too small to be shared")

    def folder(self, name):
        folder = self.work / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        return folder

    def build(self, folder, *rasters):
        rasters = rasters or (self.work / "globe.asc", self.work / "inset.asc")
        images = ("--image", self.work / "globe.asc", "--image", self.work / "inset.asc")
        options = ("--cells", "16", *images, "-o", folder / "earth.osgb", "--overwrite")
        return [str(word) for word in (self.osgbindem, *rasters, *options)]

    def complete(self, folder, command):
        done = succeed(command)
        require(tree(folder) == self.expected, f"files differ from those of a program alone in {folder}")
        return done.stdout

    def same_bytes(self):
        for count in (1, 4):
            folder = self.folder("ranks")
            said = self.complete(folder, MPIRUN + ["-n", str(count)] + self.build(folder))
            require(said.count("100 - done") == 1, f"progress is not shown once: {said}")
        folder = self.folder("ranks")
        self.complete(folder, MPIRUN + ["-n", "2"] + self.build(folder) + ["--threads", "2", "--quiet"])

    def updates(self):
        folder = self.folder("update")
        update = ["--update" if word == "--overwrite" else word for word in self.build(folder)]
        succeed(self.build(folder, self.work / "globe.asc"))
        require("parts stay" in self.complete(folder, MPIRUN + ["-n", "3"] + update), "no part was taken over")
        require("nothing has changed" in self.complete(folder, MPIRUN + ["-n", "2"] + update), "what is the same was built")

    def one_line(self, done, words):
        require(done.returncode != 0, "an error ended with 0")
        require(done.stderr.count("\n") == 1 and words in done.stderr, f"not one line with \"{words}\": {done.stderr}")

    def errors(self):
        folder = self.folder("errors")
        self.one_line(run(MPIRUN + ["-n", "3"] + self.build(folder) + ["--lod-factor", "1"]), "--lod-factor")
        self.one_line(run(MPIRUN + ["-n", "3"] + self.build(folder, "absent.tif")), "absent.tif")
        require(not any(folder.iterdir()), "an error left something behind")
        # a raster that one machine alone does not have
        both = ["-n", "1"] + self.build(folder, self.work / "globe.asc") + ["--quiet", ":", "-n", "1"] + \
            self.build(folder, "absent.tif") + ["--quiet"]
        done = run(MPIRUN + both)  # the first rank may say that it was ended
        require(done.returncode != 0 and done.stderr.count("absent.tif") == 1, f"\"absent.tif\" is not said once: {done.stderr}")
        require(not (folder / "earth.osgb").exists(), "a failed run left a root file")

    def running(self, folder, parts):
        """mpirun at work, saying all that it has to say, some parts finished."""
        command = [word for word in MPIRUN if word != "-q"] + ["-n", "3"] + self.build(folder) + ["--quiet"]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        while process.poll() is None and len(list(folder.rglob("*.task"))) < parts:
            time.sleep(0.01)
        require(process.poll() is None, "the run was over too early")
        return process

    def stopped(self, folder, process):
        try:
            said = process.communicate(timeout=60)[0]
        except subprocess.TimeoutExpired:  # an mpirun that hangs without ranks is a fault of its own, and rare
            require(not (left := self.ranks_of(folder)), f"ranks do not end: {left}")
            process.kill()
            said = process.communicate()[0]
        require(process.returncode != 0, "a run that was stopped ended with 0")
        # mpirun gives programs a second to end, and may end itself before it has passed on what they say
        require(said.count("osgbindem: ") == ("the same command goes on" in said), f"not one clear message: {said}")
        # in the second that mpirun grants, a short run may come to its end
        require(not (folder / "earth.osgb").exists() or tree(folder) == self.expected,
                "a run that was stopped left what looks complete and is not")
        return said

    def ranks_of(self, folder):
        """Rank -> process, of those that write into the folder."""
        ranks = {}
        for found in pathlib.Path("/proc").glob("[0-9]*/environ"):
            try:
                words = found.read_bytes().split(b"\0")
                command = (found.parent / "cmdline").read_bytes()
            except OSError:
                continue
            for word in words:
                if word.startswith(b"OMPI_COMM_WORLD_RANK=") and str(folder).encode() in command:
                    ranks[int(word.split(b"=")[1])] = int(found.parent.name)
        return ranks

    @contextlib.contextmanager
    def held_still(self, folder, wait=5):
        """No rank comes to its end meanwhile, however fast the machine is. `wait`: seconds that ranks get to disappear in
        before the others go on."""
        ranks = self.ranks_of(folder)
        for process in ranks.values():
            os.kill(process, signal.SIGSTOP)
        require(not (folder / "earth.osgb").exists(), "the run was over too early")
        yield ranks
        # mpirun sees what happened, and ends those that do not end by themselves
        end = time.monotonic() + wait
        while time.monotonic() < end and self.ranks_of(folder):
            time.sleep(0.05)
        for process in ranks.values():
            with contextlib.suppress(ProcessLookupError):
                os.kill(process, signal.SIGCONT)

    def a_lost_rank(self):
        folder = self.folder("lost")
        process = self.running(folder, 2)
        with self.held_still(folder) as ranks:
            os.kill(ranks[2], signal.SIGKILL)
        said = self.stopped(folder, process)
        require("noticed that process rank 2" in said, f"nothing is said of the lost rank: {said}")
        require("resumes: " in self.complete(folder, self.build(folder)), "a program alone does not go on")

    def a_stopped_run(self):
        folder = self.folder("stopped")
        process = self.running(folder, 2)
        with self.held_still(folder):
            process.send_signal(signal.SIGTERM)
        self.stopped(folder, process)
        was_complete = (folder / "earth.osgb").exists()
        said = self.complete(folder, MPIRUN + ["-n", "2"] + self.build(folder))
        require(was_complete or "resumes: " in said, "ranks do not go on")

    def two_at_once(self):
        folder = self.folder("twice")
        process = self.running(folder, 1)
        with self.held_still(folder, wait=0):
            self.one_line(run(MPIRUN + ["-n", "2"] + self.build(folder)), "another osgbindem")
        require(process.wait() == 0 and tree(folder) == self.expected, "a second run disturbed the first")


    def two_machines(self):
        """As far as the network goes: a network namespace for each rank, with a cable between them."""
        with TwoNetworks(self.work) as networks:
            folder = self.folder("machines")
            self.complete(folder, networks.mpirun(self.build(folder) + ["--quiet"]))


class TwoNetworks:
    """Namespaces with hosts of their own, joined by a pair of virtual devices."""

    ADDRESSES = ("10.77.0.1", "10.77.0.2")

    def __init__(self, work):
        self.names = [f"osgbindem{i}-{os.getpid()}" for i in (1, 2)]
        self.agent = work / "agent.sh"
        enter = 'exec ip netns exec "$name" unshare --uts sh -c "hostname $name; $*"'
        self.agent.write_text(f"""#!/bin/sh
[ "$1" = {self.ADDRESSES[0]} ] && name={self.names[0]} || name={self.names[1]}
shift
{enter}
""", encoding="ascii")
        self.agent.chmod(0o755)

    def __enter__(self):
        try:
            devices = [f"osgdem{i}-{os.getpid() % 10000}" for i in (1, 2)]
            for name in self.names:
                succeed(["ip", "netns", "add", name])
            succeed(["ip", "link", "add", devices[0], "netns", self.names[0], "type", "veth", "peer", "name", devices[1],
                     "netns", self.names[1]])
            for name, device, address in zip(self.names, devices, self.ADDRESSES):
                succeed(["ip", "-n", name, "addr", "add", f"{address}/24", "dev", device])
                succeed(["ip", "-n", name, "link", "set", device, "up"])
                succeed(["ip", "-n", name, "link", "set", "lo", "up"])
        except Failed:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for name in self.names:
            run(["ip", "netns", "del", name])

    def mpirun(self, command):
        network = ["--mca", "btl", "tcp,self", "--mca", "btl_tcp_if_include", "10.77.0.0/24", "--mca", "oob_tcp_if_include",
                   "10.77.0.0/24", "--mca", "plm_rsh_agent", str(self.agent)]
        return [str(self.agent), self.ADDRESSES[0], *MPIRUN, "--host", ",".join(self.ADDRESSES), "-n", "2", *network, *command]


def has_namespaces():
    if os.geteuid() != 0 or not shutil.which("ip") or not shutil.which("unshare"):
        return False
    name = f"osgbindem0-{os.getpid()}"
    return run(["ip", "netns", "add", name]).returncode == 0 and run(["ip", "netns", "del", name]).returncode == 0


def skip_reason(osgbindem):
    if not shutil.which("mpirun"):
        return "no mpirun; install openmpi-bin"
    if "without its module for MPI" in run(["env", "OMPI_COMM_WORLD_SIZE=2", "OMPI_COMM_WORLD_RANK=0", osgbindem, "absent.tif", "-o", "absent/a.osgb"]).stderr:
        return "osgbindem's module for MPI was not built; install libopenmpi-dev"
    if run(MPIRUN + ["-n", "2", "true"]).returncode != 0:
        return "mpirun cannot start programs here"
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="folder with the programs")
    parser.add_argument("--work", type=pathlib.Path, required=True, help="scratch folder, emptied")
    arguments = parser.parse_args()
    osgbindem = arguments.bin.resolve() / "osgbindem"
    os.environ |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    os.environ.setdefault("OSG_LIBRARY_PATH", str(arguments.bin.resolve().parent / "lib"))
    if reason := skip_reason(osgbindem):
        print(f"skipped: {reason}")
        return SKIPPED
    try:
        ranks = Ranks(arguments.work.resolve(), osgbindem)
        for case in (ranks.same_bytes, ranks.updates, ranks.errors, ranks.a_lost_rank, ranks.a_stopped_run, ranks.two_at_once):
            begin = time.monotonic()
            case()
            print(f"{case.__name__}: {time.monotonic() - begin:.1f} s", flush=True)
        if has_namespaces():
            ranks.two_machines()
            print("two_machines: the same bytes across two network namespaces")
        else:
            print("two_machines: skipped, no network namespaces here")
    except Failed as failed:
        print(f"FAILED: {failed}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
