# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
"""Checks that the library's files include only what stands below them, and how large its largest include cycle is.
Argument: the source folder.

A unit is a header with its sources: those of the same name, and those without a header of their own whose names begin
with that name, such as AnalyticBinCullCallbackText.cpp. A public header belongs to the folder of its source."""

import pathlib
import re
import sys

# The folders below src, and what each may include besides itself: other folders (with *: their public headers), and other
# libraries' headers.
GLM, OSG = {"glm"}, {"glm", "osg", "osgTerrain"}
CORE = ["core"]
BASE = CORE + ["kit"]
TILE = BASE + ["kit/surface", "kit/tile"]
DATABASE = TILE + ["kit/cull", "kit/database"]
KIT = DATABASE + ["kit/install"]
LAYERS = {
    "core": ([], GLM | {"hwy"}),
    "kit": (CORE, GLM | {"osg", "osgDB"}),
    "kit/surface": (BASE, OSG),
    "kit/tile": (TILE, OSG),
    "kit/cull": (TILE, OSG | {"osgUtil"}),
    "kit/database": (DATABASE, OSG | {"osgDB", "osgUtil"}),
    "kit/install": (KIT, OSG | {"osgDB"}),
    "index": (TILE, OSG | {"osgDB"}),
    "occlusion": (TILE + ["kit/cull*"], OSG),
    "mappings": (BASE + ["kit/cull"], GLM | {"boost", "osg"}),
    "serializers": (KIT, OSG | {"osgDB"}),
    "plugin": (KIT, OSG | {"osgDB", "proj"}),
    "viewer": (KIT, OSG | {"osgDB", "osgGA", "osgText", "osgUtil", "osgViewer"}),
}
# No unit includes another one that includes it in turn. Raise this for nothing.
LARGEST_CYCLE = 1

OTHERS = {"CLI11", "OpenThreads", "boost", "gdal", "glm", "hwy", "proj"}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.M)


class Library:
    def __init__(self, root):
        self.public = root / "osgAnalyticBin/include"
        self.src = root / "osgAnalyticBin/src"
        self.files = [f for top in (self.public, self.src) for f in sorted(top.rglob("*"))
                      if f.suffix in (".h", ".cpp", ".inl")]
        if len(self.files) < 100:
            sys.exit(f"{root}: only {len(self.files)} files of the library")
        headers = {f.stem for f in self.files if f.suffix == ".h"}
        self.unit = {f: self.unit_of(f, headers) for f in self.files}
        self.layer = {}
        for file in self.files:
            if self.src in file.parents:
                self.layer[self.unit[file]] = self.layer_of(file.relative_to(self.src))
        for file in self.files:
            if self.unit[file] not in self.layer:  # a public header alone
                path = file.relative_to(self.public / "osgAnalyticBin")
                self.layer[self.unit[file]] = self.layer_of(path)

    def unit_of(self, file, headers):
        owners = [name for name in headers if file.suffix == ".cpp" and file.stem.startswith(name)]
        name = max(owners, key=len, default=file.stem)
        apart = next((folder for folder in ("viewer", "plugin", "serializers") if folder in file.parts), None)
        return f"{apart}/{name}" if apart else name

    def layer_of(self, path):
        folders = ["/".join(path.parts[:2]), path.parts[0], "kit/" + path.parts[0]]
        return next((folder for folder in folders if folder in LAYERS), "kit")

    def included(self, file):
        """The files of the library that a file includes, and the names of others."""
        for name in INCLUDE.findall(file.read_text(encoding="utf-8")):
            beside, public = (file.parent / name).resolve(), self.public / name
            found = next((f for f in (beside, public) if f in self.unit), None)
            if name.startswith("osgAnalyticBin/") and not found:
                sys.exit(f"{file}: there is no {name}")
            yield found, name


def upward(library):
    """Includes that lead out of what a layer may include."""
    for file in library.files:
        layer = library.layer[library.unit[file]]
        layers, others = LAYERS[layer]
        for found, name in library.included(file):
            if found:
                other = library.layer[library.unit[found]]
                isPublic = library.public in found.parents
                if other != layer and other not in layers and not (isPublic and other + "*" in layers):
                    yield f"{file.relative_to(library.src.parent)} ({layer}) includes {name} ({other})"
                continue
            of = name.split("/")[0].split(".")[0]
            if (of.startswith("osg") or of in OTHERS) and of != "OpenThreads" and of not in others:
                yield f"{file.relative_to(library.src.parent)} ({layer}) includes {name}"


def cycles(edges):
    """Groups of units each of which includes all others, by way of others: Tarjan's algorithm, without recursion."""
    number, low, on_stack, stack, groups = {}, {}, set(), [], []
    for start in edges:
        path = [] if start in number else [(start, iter(sorted(edges[start])))]
        if path:
            number[start] = low[start] = len(number)
            stack.append(start)
            on_stack.add(start)
        while path:
            unit, rest = path[-1]
            following = next(rest, None)
            if following is None:
                path.pop()
                if path:
                    low[path[-1][0]] = min(low[path[-1][0]], low[unit])
                if low[unit] == number[unit]:
                    at = stack.index(unit)
                    groups.append(stack[at:])
                    on_stack.difference_update(stack[at:])
                    del stack[at:]
            elif following not in number:
                number[following] = low[following] = len(number)
                stack.append(following)
                on_stack.add(following)
                path.append((following, iter(sorted(edges[following]))))
            elif following in on_stack:
                low[unit] = min(low[unit], number[following])
    return groups


def main():
    library = Library(pathlib.Path(sys.argv[1]).resolve())
    edges = {unit: set() for unit in library.unit.values()}
    for file in library.files:
        unit = library.unit[file]
        edges[unit].update(library.unit[found] for found, _ in library.included(file) if found)
    largest = max(cycles(edges), key=len)
    print(f"{len(edges)} units; the largest include cycle has {len(largest)}, {LARGEST_CYCLE} allowed")
    if len(largest) > 1:
        print("  " + ", ".join(sorted(largest)))
    wrong = list(upward(library))
    print("\n".join(wrong) or "each layer includes only those below it")
    return 1 if wrong or len(largest) > LARGEST_CYCLE else 0


if __name__ == "__main__":
    sys.exit(main())
