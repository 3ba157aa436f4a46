# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
"""Compares the figures of README.md with those of osgAnalyticBin/doc/results.md and guide.md that they are taken from.
Argument: the source folder."""

import pathlib
import re
import sys


def table(text, head):
    """The rows below a line that begins with this, as lists of cells."""
    lines = text.splitlines()
    starts = [i for i, line in enumerate(lines) if line.startswith(head)]
    if len(starts) != 1:
        sys.exit(f"not one table that begins with \"{head}\"")
    rows = []
    for line in lines[starts[0] + 2:]:
        if not line.startswith("|"):
            break
        rows.append([cell.strip() for cell in line.strip("|").split("|")])
    return rows


def number(cell):
    """Written with or without emphasis and spaces between thousands."""
    return cell.replace("*", "").replace(" ", "")


def differences(readme, results, guide):
    # rows in any order; README has another word for one
    names = {"files": "files read"}
    shown = table(readme, "| | spheres |")
    for row in table(results, "| sums of "):
        name = names.get(row[0], row[0])
        own = [cells for cells in shown if cells[0].startswith(name)]
        if [[number(cell) for cell in cells[1:]] for cells in own] != [row[1:]]:
            yield f"\"{name}\": README has {own}, results.md has {row[1:]}"
    other = table(readme, "| other databases")
    readme = " ".join(readme.split())
    poses, needed = re.search(r"^\| sums of (\d+) poses, (\d+) tiles needed", results, flags=re.M).groups()
    for words, figure in ((f"over {poses} views", "poses"), (f"({needed} are in view", "tiles needed")):
        if words not in readme:
            yield f"{figure}: README does not say \"{words}\", as results.md does"
    culled, of = (int(count) for count in re.search(r"(\d+) tiles of (\d+) are culled in \[one valley", readme).groups())
    if not all(f"{count} tiles drawn" in guide for count in (of, of - culled)):
        yield f"README culls {culled} tiles of {of} in a valley, guide.md others"
    for row in other:
        for figure in re.findall(r"\d+\.\d+|\d{3,}", " ".join(row)):
            if figure not in results:
                yield f"\"{row[0]}\": README has {figure}, results.md has not"
    frames = [row for row in table(results, "| figure | value |") if row[0].startswith("`frame_")]
    for row in frames:
        for figure in re.findall(r"[0-9]\.[0-9]+", row[1] + row[3]):
            if figure not in readme:
                yield f"{row[0]}: README does not say {figure}, as results.md does"


def main():
    root = pathlib.Path(sys.argv[1])
    texts = [(root / name).read_text(encoding="utf-8")
             for name in ("README.md", "osgAnalyticBin/doc/results.md", "osgAnalyticBin/doc/guide.md")]
    found = list(differences(*texts))
    print("\n".join(found) or "the figures agree")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
