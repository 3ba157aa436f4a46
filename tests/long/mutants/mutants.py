#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
"""Puts one fault after the other into a copy of the sources and says whether the tests notice it. The faults are in
faults.py. The sources themselves stay as they are. Several copies are tried at once, each with one compiler; with
ccache they share what they compile. Exit code: 0; 1 when tests fail without a fault, when a fault was not noticed, or
when one could not be put in, because its text is gone or it does not compile; 2 for a wrong command line."""

import argparse
import concurrent.futures
import os
import pathlib
import queue
import resource
import shutil
import subprocess
import sys
import time

from faults import FAULTS, SCENES

SOURCES = pathlib.Path(__file__).resolve().parents[3]
PARTS = ("CMakeLists.txt", "LICENSE", "osgAnalyticBin", "tests", "data", "applications")
LONGEST_RUN = 900  # seconds; a fault may make a test loop
STACK = 64 << 20  # bytes: without inlining, the deepest scenes need more than the usual 8 MB


def run(command, log, **more):
    with open(log, "w", encoding="utf-8") as out:
        try:
            return subprocess.run(command, stdout=out, stderr=subprocess.STDOUT, check=False, **more).returncode
        except subprocess.TimeoutExpired:
            return -1


def tail(log, lines=25):
    return "\n".join(log.read_text(encoding="utf-8", errors="replace").splitlines()[-lines:])


def copy_sources(to):
    shutil.rmtree(to, ignore_errors=True)
    to.mkdir(parents=True)
    for part in PARTS:
        source = SOURCES / part
        if source.is_dir():
            shutil.copytree(source, to / part, ignore=shutil.ignore_patterns("__pycache__", "build"))
        elif source.exists():
            shutil.copy2(source, to / part)


class Scratch:
    def __init__(self, work):
        work.mkdir(parents=True, exist_ok=True)
        self.work, self.sources, self.build, self.log = work, work / "source", work / "build", work / "log.txt"

    def configure(self):
        copy_sources(self.sources)
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", "-DCMAKE_UNITY_BUILD=OFF",
                   "-DOSGANALYTICBIN_WERROR=OFF", "-DOSGANALYTICBIN_BENCHMARKS=OFF"]
        if shutil.which("ccache"):
            options.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
        return run(["cmake", "-S", self.sources, "-B", self.build, "-G", "Ninja", *options], self.log)

    def make(self, target, jobs=1):
        shared = dict(os.environ, CCACHE_BASEDIR=str(self.work), CCACHE_NOHASHDIR="1")
        return run(["cmake", "--build", self.build, "--target", target, "--", "-j", str(jobs)], self.log, env=shared)

    def run_tests(self, target, *options):
        """Returns: the exit code, and what was said."""
        environment = dict(os.environ, OSG_LIBRARY_PATH=str(self.build / "lib"), RC_PARAMS="seed=20260101")
        display = ["xvfb-run", "-a"] if "--pictures" in options else []
        code = run([*display, self.build / "bin" / target, *options], self.log, timeout=LONGEST_RUN, env=environment,
                   cwd=self.build)
        return code, self.log.read_text(encoding="utf-8", errors="replace")

    def has_tests(self, fault):
        return fault.target == SCENES or "\n  " in self.run_tests(fault.target, f"--gtest_filter={fault.tests}", "--gtest_list_tests")[1]

    def test(self, target, tests="*"):
        """Returns: whether all tests passed, and their names that did not."""
        if target == SCENES:
            code, text = self.run_tests(target, "--failures", "1", *tests.replace("*", "").split())
            return code == 0, [line.split(" FAILS", 1)[0] for line in text.splitlines() if " FAILS in" in line]
        code, text = self.run_tests(target, f"--gtest_filter={tests}", "--gtest_brief=1")
        failed = [line.split("]", 1)[1].split()[0].rstrip(",") for line in text.splitlines() if line.startswith("[  FAILED  ]")]
        return code == 0, sorted(set(failed))


def put_in(fault, sources):
    """Returns: the file and its text as it was; None when the fault's text is not there just once."""
    file = sources / fault.place
    if not file.exists():
        return None
    before = file.read_text(encoding="utf-8")
    if before.count(fault.text) != 1:
        return None
    file.write_text(before.replace(fault.text, fault.instead), encoding="utf-8")
    return file, before


def trial(fault, scratch):
    """Returns: a word for what became of the fault, and what there is to say of it."""
    placed = put_in(fault, scratch.sources)
    if not placed:
        return "TEXT GONE", f"its text does not stand once in {fault.place}"
    file, before = placed
    try:
        if scratch.make(fault.target) != 0:
            return "NOT BUILT", tail(scratch.log)
        passed, failed = scratch.test(fault.target, fault.tests)
        if passed:
            return "UNNOTICED", f"{fault.target} --gtest_filter='{fault.tests}' passed"
        return "noticed", ", ".join(failed[:3]) + (f" and {len(failed) - 3} more" if len(failed) > 3 else "") or "it crashed"
    finally:
        file.write_text(before, encoding="utf-8")


def built(scratch, targets, jobs):
    if scratch.configure() != 0:
        print(f"the copy cannot be configured:\n{tail(scratch.log, 60)}")
        return False
    for target in targets:
        if scratch.make(target, jobs) != 0:
            print(f"{target} cannot be built:\n{tail(scratch.log, 60)}")
            return False
    return True


def sound_without_faults(scratch, faults, targets):
    """Whether the tests that are to fail are there, and pass as long as nothing is wrong."""
    for target in targets:
        passed, failed = scratch.test(target)
        if not passed:
            print(f"{target} fails without a fault: {', '.join(failed)}\n{tail(scratch.log)}")
            return False
    for fault in faults:
        if not scratch.has_tests(fault):
            print(f"{fault.name}: {fault.target} has no test {fault.tests}")
            return False
    return True


def try_all(faults, scratch):
    """Takes faults until none is left. Returns: how many were not noticed."""
    bad = 0
    while True:
        try:
            fault = faults.get_nowait()
        except queue.Empty:
            return bad
        start = time.monotonic()
        word, detail = trial(fault, scratch)
        bad += word != "noticed"
        print(f"{word:9} {fault.name} ({time.monotonic() - start:.0f} s): {detail}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--work", type=pathlib.Path, default=SOURCES / "build" / "mutants",
                        help="scratch folder for the copy and its build (default build/mutants)")
    parser.add_argument("--only", default="", help="the faults alone whose name or file has this")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="copies tried at once (default: one per core)")
    parser.add_argument("--after", type=pathlib.Path, help="what an earlier run of the same sources printed: leaves out "
                        "what was noticed then, and the tests without faults")
    parser.add_argument("--list", action="store_true", help="name the faults, and do nothing")
    arguments = parser.parse_args()
    faults = [fault for fault in FAULTS if arguments.only in fault.name or arguments.only in fault.file]
    if not faults:
        parser.error(f"no fault has \"{arguments.only}\" in its name or file")
    if arguments.after:
        before = arguments.after.read_text(encoding="utf-8")
        faults = [fault for fault in faults if f"noticed   {fault.name} (" not in before]
        if not faults:
            print("that run noticed all of them")
            return 0
    if arguments.list:
        for fault in faults:
            print(f"{fault.file}: {fault.name}")
        return 0
    resource.setrlimit(resource.RLIMIT_STACK, (STACK, resource.getrlimit(resource.RLIMIT_STACK)[1]))
    begin = time.monotonic()
    copies = [Scratch(arguments.work.resolve() / str(number)) for number in range(max(1, min(arguments.jobs, len(faults))))]
    targets = sorted({fault.target for fault in faults})
    waiting = queue.SimpleQueue()
    for fault in sorted(faults, key=lambda fault: fault.place):
        waiting.put(fault)
    with concurrent.futures.ThreadPoolExecutor(len(copies)) as pool:
        # the first one by all compilers: with ccache the others are copies of it
        if not built(copies[0], targets, len(copies)):
            return 1
        if not arguments.after and not sound_without_faults(copies[0], faults, targets):
            return 1
        if not all(pool.map(lambda scratch: built(scratch, targets, 1), copies[1:])):
            return 1
        sound = "" if arguments.after else "; without them all tests pass"
        print(f"{len(faults)} faults{sound} ({time.monotonic() - begin:.0f} s)", flush=True)
        bad = sum(pool.map(lambda scratch: try_all(waiting, scratch), copies))
    print(f"{len(faults) - bad} of {len(faults)} noticed in {time.monotonic() - begin:.0f} s")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
