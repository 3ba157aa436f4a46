#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
"""Makes the tables of osgAnalyticBin/doc/results from what figures.sh has measured.

Usage: tables.py FIGURES RESULTS, two folders. Prints the figures that results.md and README.md quote first.
"""
import csv
import json
import sys
from pathlib import Path

OFF, OBB = "quadratic+horizon+edges", "orientedbox+horizon+edges"
LABELS = {"sphere": "sphere", "cluster": "cluster", OFF: "bins off", "bins": "auto"}


class Sums:
    """The sums of one CSV file of osgbinbench over some of its poses, by method and column."""

    def __init__(self, rows):
        self.sums = {}
        for row in rows:
            sums = self.sums.setdefault(row["method"], {"poses": 0})
            sums["poses"] += 1
            for column, value in row.items():
                if column not in ("pose", "method") and value:
                    sums[column] = sums.get(column, 0.0) + float(value)

    def __call__(self, method, column):
        return self.sums[method][column]


def sums_by_path(file):
    """Of each path, and of all together, which comes last. The name of a pose begins with that of its path."""
    rows = list(csv.DictReader(file.open()))
    paths = dict.fromkeys(row["pose"].split("_")[0] for row in rows)
    sums = {path: Sums(row for row in rows if row["pose"].split("_")[0] == path) for path in paths}
    return {**sums, "all": Sums(rows)}


def ratio(of, column, method, peer):
    return f"{of(method, column) / of(peer, column):.2f}"


def count(value):
    return f"{value:.0f}"


def high_views(sums):
    yield (["path", "poses", "needed", "drawn: sphere", "drawn: cluster", "drawn: bins (to needed)", "files: sphere",
            "files: cluster", "files: bins"] +
           [f"cull bins / {peer}: {caches}" for peer in ("sphere", "cluster", "oracle") for caches in ("warm", "cold")])
    for path, of in sums.items():
        needed, drawn = of("bins", "truth_tiles"), of("bins", "drawn_tiles")
        yield ([path, count(of("bins", "poses")), count(needed)] +
               [count(of(method, "drawn_tiles")) for method in ("sphere", "cluster")] +
               [f"{drawn:.0f} ({drawn / needed:.3f})"] +
               [count(of(method, "files_requested")) for method in ("sphere", "cluster", "bins")] +
               [ratio(of, column, "bins", peer) for peer in ("sphere", "cluster", "oracle")
                for column in ("cull_ms", "cull_cold_ms")])


def low_views(sums):
    methods, labels = list(LABELS), list(LABELS.values())
    yield (["path", "needed", "visible"] + [f"drawn: {label}" for label in labels] +
           [f"files: {label}" for label in labels] + [f"cull: {label}" for label in labels[1:]])
    for path, of in sums.items():
        yield ([path, count(of("bins", "truth_tiles")), count(of("bins", "visible_tiles"))] +
               [count(of(method, "drawn_tiles")) for method in methods] +
               [count(of(method, "files_requested")) for method in methods] +
               [ratio(of, "cull_ms", method, "sphere") for method in methods[1:]])


def frames(figures):
    yield (["flight", "what", "method"] +
           [f"{what}, ms: {part}" for what in ("work", "frame") for part in ("1st percentile", "median", "99th")] +
           [f"all {what} / {peer}" for what in ("work", "frames") for peer in ("sphere", "cluster")])
    for what in ("one thread", "draw thread", "processor"):
        for flight in ("helicopter", "approach", "valley", "rockies"):
            file = figures / f"frames_{flight}_{what}.json"
            methods = json.loads(file.read_text())["methods"] if file.exists() else {}
            work = {method: sums["cull_ms"] + sums["draw_ms"] for method, sums in methods.items()}
            for method, sums in methods.items():
                yield ([flight, what, method] +
                       [f"{sums[f'{part}_{at}_ms']:.3g}" for part in ("work", "frame")
                        for at in ("1st", "median", "99th")] +
                       [f"{work[method] / work[peer]:.2f}" for peer in ("sphere", "cluster")] +
                       [f"{sums['frame_ms'] / methods[peer]['frame_ms']:.2f}" for peer in ("sphere", "cluster")])


def jumps(figures):
    http, disk = (json.loads((figures / f"jumps_{line}.json").read_text())["methods"] for line in ("http", "disk"))
    yield ["method", "HTTP: files", "HTTP: frames with something missing", "HTTP: ms", "HTTP: / sphere",
           "HTTP: / cluster", "disk: files", "disk: ms"]
    jumped = len(list(csv.reader(line for line in Path("data/paths/demo.csv").open() if line[0] != "#"))) - 1
    for method in ("sphere", "cluster", OBB, OFF, "bins"):
        late = http[method]["complete_ms"]
        yield ([method, http[method]["files_requested"], http[method]["missing_frames"],
                count(late / jumped)] + [f"{late / http[peer]['complete_ms']:.2f}" for peer in ("sphere", "cluster")] +
               [disk[method]["files_requested"], count(disk[method]["complete_ms"] / jumped)])


def scale(figures):
    yield ["levels", "drawn: sphere", "drawn: bins", "cull ms of the flight: sphere", "cull ms of the flight: bins",
           "cull ms of the flight: oracle", "bins above the oracle, us a drawn tile"]
    rows = json.loads((figures / "scale.json").read_text())["depth"]
    for levels in sorted({row["levels"] for row in rows}):
        of = {row["method"]: row for row in rows if row["levels"] == levels}
        ms = {method: of[method]["cull_ms"] for method in of}
        above = 1000.0 * (ms["bins"] - ms["oracle"]) / of["bins"]["drawn_tiles"]
        yield [levels, of["sphere"]["drawn_tiles"], of["bins"]["drawn_tiles"], f"{ms['sphere']:.2f}",
               f"{ms['bins']:.2f} ({ms['bins'] / ms['sphere']:.2f})", f"{ms['oracle']:.2f}", f"{above:.2f}"]


def methods(figures):
    yield ["method", "tested", "drawn", "drawn / needed", "files", "false culls", "differing pixels", "cull time"]
    measured = json.loads((figures / "methods.json").read_text())["methods"]
    for method, sums in measured.items():
        yield ([method, sums["tested_tiles"], sums["drawn_tiles"], f"{sums['drawn_tiles'] / sums['truth_tiles']:.3f}",
                sums["files_requested"], sums["false_culls"], sums["differing_pixels"],
                f"{sums['cull_ms'] / measured['sphere']['cull_ms']:.2f}"])


def main():
    if len(sys.argv) != 3 or not Path(sys.argv[1]).is_dir() or not Path(sys.argv[2]).is_dir():
        sys.exit("tables.py: give the folder that figures.sh has filled, and that of the tables")
    figures, results = map(Path, sys.argv[1:])
    high, low, region = (sums_by_path(figures / f"{name}.csv") for name in ("paths", "low", "region"))
    tables = {
        "paths": high_views(high),
        "low_views": low_views(low),
        "region": low_views(region),
        "frames": frames(figures),
        "jumps": jumps(figures),
        "scale": scale(figures),
        "methods": methods(figures),
    }
    for name, table in tables.items():
        with (results / f"{name}.csv").open("w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows(table)
    every = [high["all"], low["all"]]

    def of_all(column, method, peer, parts=every):
        return sum(of(method, column) for of in parts) / sum(of(peer, column) for of in parts)

    print(f"drawn_over_spheres {of_all('drawn_tiles', 'bins', 'sphere'):.2f}")
    print(f"drawn_high_over_spheres {of_all('drawn_tiles', 'bins', 'sphere', every[:1]):.2f}")
    print(f"drawn_low_over_spheres {of_all('drawn_tiles', 'bins', 'sphere', every[1:]):.2f}")
    print(f"files_over_spheres {of_all('files_requested', 'bins', 'sphere'):.2f}")
    for caches, column in (("warm", "cull_ms"), ("cold", "cull_cold_ms")):
        for peer in ("sphere", "cluster"):
            print(f"cull_{caches}_over_{peer} {of_all(column, 'bins', peer):.2f}")


if __name__ == "__main__":
    main()
