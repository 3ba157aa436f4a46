# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
"""Runs the shell commands of a Markdown page, one after the other, in a scratch folder that looks like the project
with a small database. Commands that cannot be run here are listed in exceptions.txt with the reason.
Arguments: source folder, build folder, scratch folder (emptied), page."""

import os
import pathlib
import re
import shutil
import subprocess
import sys

# An indented block is shell when it begins like this; fenced blocks say it themselves.
PROGRAM = re.compile(r"(sh|export|cmake|sudo|pkg-config|osgviewer|osgconv|osgbin\w+|osganalyticbin_\w+|xvfb-run|build/release/bin/\w+)\s")

# Words that stand for something, and long runs made short.
STAND_INS = [(r"\bDATABASE\b", "earth.osgb"), (r"\bearth\.ive", "other.osgb"), (r"\bDIR\.\.\.", "none"), (r"--trials \d+", "--trials 1000"),
             (r"--cameras \d+", "--cameras 2"), (r"--size \S+ ", ""),
             (r"(osgbinbench) (?!report|scale)", r"\1 --size 160x90 --repeats 1 --flush 1 "),
             # the databases that other commands show are there before
             (r"(\bosgbindem) (?!.*--(?:update|overwrite))", r"\1 --overwrite "),
             (r"(osgbinpaper) ", r"\1 globe.tif --levels 1 --cameras 2 "),
             (r"(osgbinbench scale) ", r"\1 --levels 2 --poses 2 --rounds 1 --residents 100 --memory-tiles 100 "),
             (r"/usr/share/ferret-vis/data/etopo5.cdf", "globe.tif"),
             (r"/usr/share/ncarg/data/cdf/trinidad.nc", "inset.tif")]

GLOBE = "ncols {n}\nnrows {m}\nxllcorner {x}\nyllcorner {y}\ncellsize {s}\n"


def shell_lines(text):
    """The lines of all shell blocks, continued lines joined, comments left out."""
    blocks = re.findall(r"^```sh\n(.*?)^```", text, flags=re.M | re.S)
    rest = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    for block in re.findall(r"(?:^ {4}.*\n)+", rest, flags=re.M):
        block = re.sub(r"^ {4}", "", block, flags=re.M)
        if PROGRAM.match(block):
            blocks.append(block)
    for block in blocks:
        for line in block.replace("\\\n", " ").splitlines():
            line = re.sub(r"\s+#.*$", "", line).strip()
            if line and not line.startswith("#"):
                yield line


def exceptions(folder):
    """Beginning of a command -> reason."""
    lines = (folder / "exceptions.txt").read_text(encoding="utf-8").splitlines()
    pairs = [line.split(" -- ", 1) for line in lines if line and not line.startswith("#")]
    return {command.strip(): reason.strip() for command, reason in pairs}


def run(command, scratch, environment):
    done = subprocess.run(["sh", "-ec", command], cwd=scratch, env=environment, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, errors="replace", timeout=300, check=False)
    return done.returncode, done.stdout


def write_grid(file, n, m, x, y, s, height):
    rows = [" ".join(str(height(c, r)) for c in range(n)) for r in range(m)]
    file.write_text(GLOBE.format(n=n, m=m, x=x, y=y, s=s) + "\n".join(rows) + "\n", encoding="utf-8")


def shorten_paths(source, scratch):
    """Camera paths of two poses."""
    (scratch / "data/paths").mkdir(parents=True)
    for path in (source / "data/paths").iterdir():
        if path.suffix == ".csv":
            lines = path.read_text(encoding="utf-8").splitlines()
            comments = [line for line in lines if line.startswith("#")]
            rest = [line for line in lines if line and not line.startswith("#")]
            (scratch / "data/paths" / path.name).write_text("\n".join(comments + rest[:3]) + "\n", encoding="utf-8")
        else:
            shutil.copy(path, scratch / "data/paths")


def prepare(source, build, scratch, environment):
    shutil.rmtree(scratch, ignore_errors=True)
    (scratch / "build").mkdir(parents=True)
    (scratch / "osgAnalyticBin/doc").mkdir(parents=True)
    (scratch / "build/release").symlink_to(build)
    (scratch / "applications").symlink_to(source / "applications")
    shorten_paths(source, scratch)
    write_grid(scratch / "globe.asc", 72, 36, -180, -90, 5, lambda c, r: (c * 37 + r * 91) % 3000)
    write_grid(scratch / "inset.asc", 20, 20, -106, 37, 0.05, lambda c, r: 9000 + (c * r) % 500)
    ready = """gdal_translate -q -of GTiff globe.asc globe.tif; gdal_translate -q -of GTiff inset.asc inset.tif
        mkdir demo; for name in demo/earth earth other; do osgbindem --quiet globe.asc --levels 1 -o $name.osgb; done"""
    code, said = run(ready, scratch, environment)
    if code:
        sys.exit(f"the small database could not be made:\n{said}")


def main():
    source, build, scratch = (pathlib.Path(a).resolve() for a in sys.argv[1:4])
    page = sys.argv[4]
    environment = {k: v for k, v in os.environ.items() if k not in ("OSG_LIBRARY_PATH", "LD_LIBRARY_PATH")}
    environment |= {"PATH": f"{build}/bin:{environment['PATH']}", "OSG_LIBRARY_PATH": f"{build}/lib",
                    "OSG_WINDOW": "0 0 160 90", "LIBGL_ALWAYS_SOFTWARE": "1", "PICTURES_FRAMES": "2"}
    known = exceptions(pathlib.Path(__file__).parent)
    prepare(source, build, scratch, environment)
    lines = list(shell_lines((source / page).read_text(encoding="utf-8")))
    exports, failed, count = [], 0, 0
    for line in lines:
        reason = next((why for start, why in known.items() if line.startswith(start)), None)
        if reason:
            print(f"skipped  {line}\n         {reason}")
            continue
        count += 1
        command = line
        for pattern, word in STAND_INS:
            command = re.sub(pattern, word, command)
        if command.startswith("export "):
            exports.append(command)
            continue
        # what stands before the program: environment variables
        viewer = re.match(r"((?:[A-Z_]+=\S+ )*)(\S*osg(?:bin)?viewer .*)", command)
        if viewer:
            frames = "" if ".binflight" in command else "OSG_RUN_FRAME_COUNT=3 "
            display = 9000 + os.getpid() % 3000
            command = (f"{viewer[1]}{frames}xvfb-run -a -n {display} -s '-screen 0 320x240x24 -noreset' {viewer[2]}")
        code, said = run("\n".join(exports + [command]), scratch, environment)
        print(f"{'ok' if code == 0 else 'FAILED':8} {line}", flush=True)
        if code:
            failed += 1
            print(said)
    if count == 0:
        print(f"no command found in {page}")
    return 1 if failed or count == 0 else 0


sys.exit(main())
