# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
"""Kills osgbindem and osgbinconv at random moments, fills their disk, forbids them to write and runs two at once. At no
moment there is a database or an index that looks complete and is not; the same command then completes it, byte for byte
as an undisturbed run does. Disks of its own need root or a user namespace; where neither may mount, that part is
skipped, said in the last line, and the exit code is 77."""

import argparse
import contextlib
import ctypes
import fcntl
import hashlib
import math
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import time

CLONE_NEWNS, CLONE_NEWUSER = 0x00020000, 0x10000000
MS_RDONLY, MS_REMOUNT, MS_REC, MS_PRIVATE = 1, 0x20, 0x4000, 1 << 18
SKIPPED = 77  # as ctest is told
LIBC = ctypes.CDLL(None, use_errno=True)


def write_grid(file, columns, rows, west, south, size):
    lines = [f"ncols {columns}", f"nrows {rows}", f"xllcorner {west}", f"yllcorner {south}", f"cellsize {size}"]
    for row in range(rows):
        lines.append(" ".join(str(round(2000 * math.sin(c * 0.11) * math.cos(row * 0.07))) for c in range(columns)))
    file.write_text("\n".join(lines) + "\n", encoding="ascii")


def tree(folder):
    """Path below the folder -> checksum, of all files."""
    return {str(p.relative_to(folder)): hashlib.sha256(p.read_bytes()).hexdigest()
            for p in sorted(folder.rglob("*")) if p.is_file()}


def names(folder):
    return sorted(p.name for p in folder.iterdir())


class Failed(Exception):
    pass


def require(holds, what):
    if not holds:
        raise Failed(what)


def run(command):
    try:
        return subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
    except subprocess.TimeoutExpired as late:
        raise Failed(f"{late}; it said {late.stdout} {late.stderr}") from late


def succeed(command):
    done = run(command)
    require(done.returncode == 0, f"{' '.join(map(str, command))} ended with {done.returncode}: {done.stderr}")
    return done


def fail(command, words):
    """The command has to end with one line that has one of the words."""
    done = run(command)
    require(done.returncode == 1, f"exit code {done.returncode} where 1 is due: {done.stderr}")
    require(done.stderr.count("\n") == 1 and any(w in done.stderr for w in words), f"unclear message: {done.stderr}")


class Case:
    """One program with one way to use it, in a folder of its own."""

    def __init__(self, name, command, prepare, is_sound, expected):
        self.name = name
        self.command = command  # of the folder
        self.prepare = prepare  # fills the emptied folder; argument: whether with an older result
        self.is_sound = is_sound  # of the folder after a kill
        self.expected = expected  # tree after a complete run
        self.duration = 0.0
        self.growth = None  # bytes that it writes beside an older result, where those are fewer than all

    def start(self, folder, is_old):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        self.prepare(folder, is_old)

    def complete(self, folder):
        succeed(self.command(folder))
        require(tree(folder) == self.expected, f"{self.name}: files differ from an undisturbed run's in {folder}")

    def measure(self, folder):
        times = []
        for _ in range(2):
            self.start(folder, False)
            begin = time.monotonic()
            self.complete(folder)
            times.append(time.monotonic() - begin)
        self.duration = min(times)


def kills(case, folder, count, seed):
    """Kills until `count` runs were killed indeed; each is checked, and each recovers."""
    dice = random.Random(f"{seed} {case.name}")
    killed = recovered = 0
    is_fresh = True
    while killed < count:
        if is_fresh:
            case.start(folder, dice.random() < 0.5)
        # one in five near the end, where files take their last names
        moment = case.duration * (dice.uniform(0.9, 1.05) if dice.random() < 0.2 else dice.random())
        process = subprocess.Popen(case.command(folder), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(moment)
        process.send_signal(signal.SIGKILL)
        was_killed = process.wait() == -signal.SIGKILL
        killed += was_killed
        case.is_sound(folder)
        is_fresh = not was_killed or killed == count or dice.random() < 0.6
        if is_fresh or dice.random() < 0.5:
            if tree(folder) != case.expected:  # else it came to an end just before
                case.complete(folder)
            recovered = killed
            is_fresh = True
    require(recovered == killed, "a killed run was left behind")
    print(f"{case.name}: {recovered} of {killed} kills recovered byte for byte", flush=True)


def is_locked(file):
    try:
        with open(file, "rb") as handle:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except FileNotFoundError:
        return False
    except BlockingIOError:
        return True
    return False


def held_still(first, lock):
    """Stops a run. Returns: whether it was at work; it may not have locked its file yet, or have ended."""
    while first.poll() is None and not lock.exists():
        pass
    if first.poll() is not None:
        return False
    first.send_signal(signal.SIGSTOP)
    os.waitid(os.P_PID, first.pid, os.WSTOPPED | os.WEXITED | os.WNOWAIT)
    return is_locked(lock)


def both_at_once(case, folder, words, lock):
    """A second run is refused while the first, held still, is at work."""
    for _ in range(20):
        case.start(folder, False)
        with subprocess.Popen(case.command(folder), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as first:
            is_held = held_still(first, folder / lock)
            try:
                if is_held:
                    fail(case.command(folder), words)
            finally:
                if first.poll() is None:
                    first.send_signal(signal.SIGCONT)
            said = first.communicate()[1]
        if is_held:
            break
    require(is_held, f"{case.name}: the first run was never at work when it was stopped")
    require(first.returncode == 0, f"{case.name}: the first of two runs failed: {said}")
    require(tree(folder) == case.expected, f"{case.name}: files differ after two runs at once")
    print(f"{case.name}: a second run is refused", flush=True)


@contextlib.contextmanager
def small_disk(folder, size):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(folder)], check=True)
    try:
        yield folder
    finally:
        subprocess.run(["umount", str(folder)], check=True)


def remount(folder, size, flags=0):
    # not by mount(8): in a user namespace it repeats options that are refused there
    if LIBC.mount(b"tmpfs", os.fsencode(folder), b"tmpfs", MS_REMOUNT | flags, f"size={size}".encode("ascii")) != 0:
        raise OSError(ctypes.get_errno(), f"remounting {folder}")


def pages(folder):
    """Bytes that the files take on a tmpfs, wherever they are now."""
    return sum(-(-p.stat().st_size // 4096) * 4096 for p in folder.rglob("*") if p.is_file())


def bad_disks(case, folder, is_old):
    """A full disk at several sizes, then one that cannot be written to, then a good one."""
    with small_disk(folder, "256m"):
        case.prepare(folder, is_old)
        used = pages(folder)
        needed = pages(case.reference) - (0 if is_old else used) if case.growth is None else case.growth
        for share in (0.02, 0.3, 0.7) if needed > 1 << 17 else (0.0,):  # pages are too coarse for small ones
            remount(folder, used + int(share * needed))
            fail(case.command(folder), ["No space left", "make room"])
            case.is_sound(folder)
        remount(folder, "256m", MS_RDONLY)
        before = tree(folder)
        fail(case.command(folder), ["Read-only"])
        require(tree(folder) == before, f"{case.name}: files changed on a read-only disk")
        remount(folder, "256m")
        case.complete(folder)
    print(f"{case.name}: a full disk and a read-only one are told and recovered from"
          f"{', beside an older one' if is_old else ''}", flush=True)


def why_no_disks():
    """Enters a mount namespace of its own, in a user namespace where that needs one; else says why it cannot."""
    user, group = os.geteuid(), os.getegid()
    if LIBC.unshare(CLONE_NEWNS) != 0:
        if LIBC.unshare(CLONE_NEWNS | CLONE_NEWUSER) != 0:
            return f"no mount namespace: {os.strerror(ctypes.get_errno())}"
        for name, text in (("setgroups", "deny"), ("uid_map", f"0 {user} 1"), ("gid_map", f"0 {group} 1")):
            pathlib.Path("/proc/self", name).write_text(text, encoding="ascii")
    if LIBC.mount(b"none", b"/", None, MS_REC | MS_PRIVATE, None) != 0:
        return f"no mounts of its own: {os.strerror(ctypes.get_errno())}"
    return ""


class Cases:
    """The databases to compare with, built undisturbed, and the ways to come to them."""

    def __init__(self, work, osgbindem, osgbinconv, levels):
        self.work, self.osgbindem, self.osgbinconv, self.levels = work, osgbindem, osgbinconv, levels
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
        write_grid(work / "globe.asc", 720, 360, -180, -90, 0.5)
        write_grid(work / "inset.asc", 40, 40, 10, 40, 0.1)
        self.old = self.built("old", 1)
        self.new = self.built("new", levels)
        self.globe = self.built("globe", levels, ["globe.asc"])
        self.index = self.copied("index")
        # the reference has to be whole itself: nothing is missing or broken
        require(succeed(self.index_command(self.index)).stderr.find("warning") < 0, "the reference is not whole")
        self.trees = {f: tree(f) for f in (self.old, self.new, self.globe, self.index)}

    def built(self, name, levels, rasters=("globe.asc", "inset.asc")):
        folder = self.work / name
        folder.mkdir()
        succeed(self.build_command(folder, levels, rasters))
        return folder

    def copied(self, name):
        return pathlib.Path(shutil.copytree(self.new, self.work / name))

    def build_command(self, folder, levels=None, rasters=("globe.asc", "inset.asc")):
        return [self.osgbindem, *(self.work / r for r in rasters), "--cells", "16", "--levels",
                str(levels or self.levels), "-o", folder / "earth.osgb", "--quiet"]

    def index_command(self, folder):
        return [self.osgbinconv, "--index", folder / "earth.osgb", "--quiet"]

    def whole_or_no_root(self, folder, wholes):
        """A root file means that all files are there as a complete run wrote them."""
        if not (folder / "earth.osgb").exists():
            return
        def shown(files):
            return {n: c for n, c in files.items() if n == "earth.osgb" or n.startswith("earth_tiles/")}
        found = shown(tree(folder))
        require(any(found == shown(self.trees[w]) for w in wholes), f"{folder} looks complete and is not")

    def all(self):
        build = Case("osgbindem", lambda folder: [*self.build_command(folder), "--overwrite"],
                     lambda folder, is_old: is_old and shutil.copytree(self.old, folder, dirs_exist_ok=True),
                     lambda folder: self.whole_or_no_root(folder, (self.old, self.new)), self.trees[self.new])
        build.reference = self.new

        def sound_index(folder):
            file = folder / "earth.osgb.bins"
            require(not file.exists() or file.read_bytes() == (self.index / file.name).read_bytes(), "a broken index")

        index = Case("osgbinconv --index", self.index_command,
                     lambda folder, is_old: shutil.copytree(self.index if is_old else self.new, folder, dirs_exist_ok=True),
                     sound_index, self.trees[self.index])
        index.reference = self.index
        update = Case("osgbindem --update", lambda folder: [*self.build_command(folder), "--update"],
                      lambda folder, is_old: shutil.copytree(self.globe, folder, dirs_exist_ok=True),
                      lambda folder: self.whole_or_no_root(folder, (self.globe, self.new)), self.trees[self.new])
        update.reference = self.new
        changed = {n for n, c in self.trees[self.new].items() if c != self.trees[self.globe].get(n)}
        update.growth = sum(-(-(self.new / n).stat().st_size // 4096) * 4096 for n in changed)
        return build, update, index


def run_parts(arguments, programs, no_disks):
    cases = Cases(arguments.work.resolve(), programs / "osgbindem", programs / "osgbinconv", arguments.levels)
    build, update, index = cases.all()
    scratch = cases.work / "run"
    chosen = [case for case in (build, update, index) if arguments.only in case.name]
    require(chosen, f"no case is named {arguments.only}")
    if arguments.part != "disks":
        for case in chosen:
            case.measure(scratch)
            print(f"{case.name}: {len(case.expected)} files in {case.duration:.2f} s undisturbed", flush=True)
            kills(case, scratch, arguments.kills, arguments.seed)
        for case, program, lock in ((build, "osgbindem", "earth_tiles.lock"), (index, "osgbinconv", "earth.osgb.bins.part")):
            if case in chosen:
                both_at_once(case, scratch, [f"another {program}"], lock)
    if arguments.part == "kills" or no_disks:
        return
    for case, is_old in ((build, False), (build, True), (update, True), (index, False)):
        if case in chosen:
            bad_disks(case, scratch, is_old)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="folder with the programs")
    parser.add_argument("--work", type=pathlib.Path, required=True, help="scratch folder, emptied")
    parser.add_argument("--kills", type=int, default=50, help="of each program and way to use it (default 50)")
    parser.add_argument("--levels", type=int, default=3, help="of the database; each makes runs four times as long (default 3)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="the cases alone whose name has this")
    parser.add_argument("--part", choices=("all", "kills", "disks"), default="all",
                        help="kills and two runs at once, or full and read-only disks, or all (default)")
    arguments = parser.parse_args()
    programs = arguments.bin.resolve()
    os.environ.setdefault("OSG_LIBRARY_PATH", str(programs.parent / "lib"))
    begin = time.monotonic()
    no_disks = why_no_disks() if arguments.part != "kills" else ""
    try:
        if arguments.part == "all" or not no_disks:
            run_parts(arguments, programs, no_disks)
            print(f"done in {time.monotonic() - begin:.0f} s, seed {arguments.seed}")
    except Failed as failed:
        print(f"FAILED: {failed}")
        return 1
    if no_disks:
        print(f"SKIPPED: full and read-only disks ({no_disks}); run it as root, or where user namespaces may mount")
        return SKIPPED
    return 0


if __name__ == "__main__":
    sys.exit(main())
