# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
"""Draws the two pictures of osgAnalyticBin/doc/architecture.md, and checks the names in them and in its text.
Arguments: the source folder; with --write, the pictures are written, otherwise compared with those that are there.

Names are files, functions such as fitTile(), and words such as TileFamily or core_tests. Each has to be there, or be in
the code of the project outside of comments."""

import pathlib
import re
import sys
import textwrap

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "layers"))
import layers  # pylint: disable=wrong-import-position

# Columns of the folders that are not in the middle.
COLUMNS = {"index": 0, "occlusion": 2, "mappings": 3, "serializers": 0, "viewer": 2}

FRAME = [("DatabaseCullCallback", "at the root: looks at states and callbacks above, makes a DatabaseView of planes, eye and options"),
         ("SelectionWalk", "tests tiles, chooses levels as PagedLOD does, and lists in a TileSelection what is kept"),
         ("SelectionEvidence.cpp", "says which tiles are whole and opaque, so that they hide what is behind"),
         ("TerrainHider", "TerrainOcclusion marks what terrain hides in the list"),
         ("TileFamily", "OSG comes to a group of tiles, traversing the scene"),
         ("SelectionDrawing", "draws the group's part of the list: plain tiles by FamilyTile, all else by accept()")]
FILE = [("BinReadFileCallback", "reads in the pager's thread, by the application's callback first"),
        ("BinInstaller", "visits what was read; TileFinder says what is a tile"),
        ("fitTile()", "makes the bin: the one stored, else by the index (TileBoundsSource), else by mesh and declared heights"),
        ("InstalledTile", "is the tile's record: parent, extents, plates, reasons not to cull"),
        ("AnalyticBinCullCallback", "on each tile; a ContentWatch notices changes"),
        ("TileFamily", "on each group: SelectionWalk tests its tiles together")]

STYLE = ("text{font:12px sans-serif;fill:#222}.name{font:bold 14px monospace}rect{fill:#eef3f8;stroke:#456}"
         "line{stroke:#456;stroke-width:1.5;marker-end:url(#tip)}.public{stroke-dasharray:6 4}")
TIP = '<marker id="tip" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="8" markerHeight="8" orient="auto">' \
      '<path d="M0 0L8 4L0 8z" fill="#456"/></marker>'


def svg(width, height, parts):
    return "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}">', f"<style>{STYLE}</style>",
                      f"<defs>{TIP}</defs>", f'<rect width="{width}" height="{height}" style="fill:#fff;stroke:none"/>',
                      *parts, "</svg>", ""])


def box(x, y, width, name, text):
    """A box of 56 pixels' height whose upper middle is there."""
    yield f'<rect x="{x - width / 2:g}" y="{y}" width="{width}" height="56" rx="4"/>'
    yield f'<text class="name" x="{x:g}" y="{y + 18}" text-anchor="middle">{name}</text>'
    for i, line in enumerate(textwrap.wrap(text, int(width / 6.5))):
        yield f'<text x="{x:g}" y="{y + 34 + 15 * i}" text-anchor="middle">{line}</text>'


def arrow(x, y, to_x, to_y, kind=""):
    return f'<line{kind} x1="{x:g}" y1="{y:g}" x2="{to_x:g}" y2="{to_y:g}"/>'


def chain(x, head, steps):
    yield f'<text x="{x}" y="24" text-anchor="middle" style="font-weight:bold">{head}</text>'
    for i, (name, text) in enumerate(steps):
        yield from box(x, 40 + 84 * i, 350, name, text)
        if i:
            yield arrow(x, 12 + 84 * i, x, 40 + 84 * i)


def frame_and_file():
    return svg(750, 530, [*chain(185, "a frame", FRAME), *chain(565, "a file", FILE)])


def layer_arrows(table):
    """Pairs of layers: what one may include, without what others of these may. `whole`: with all that is below it."""
    allowed = {layer: {other.rstrip("*") for other in others if other != layer} for layer, (others, _) in table.items()}
    whole = {layer: {other for other in others if allowed[other] <= others and other + "*" not in table[layer][0]}
             for layer, others in allowed.items()}
    for layer, others in allowed.items():
        for other in sorted(others):
            if not any(other in allowed[between] for between in whole[layer] - {other}):
                yield layer, other, other in whole[layer]


def layer_picture(table):
    arrows = list(layer_arrows(table))
    row = {}
    while len(row) < len(table):
        row.update({layer: 1 + max([row[b] for a, b, _ in arrows if a == layer], default=-1) for layer in table
                    if layer not in row and all(b in row for a, b, _ in arrows if a == layer)})
    top = max(row.values())
    place = {layer: (120 + 240 * COLUMNS.get(layer, 1), 10 + 84 * (top - row[layer])) for layer in table}
    parts = []
    for layer, (x, y) in place.items():
        parts += box(x, y, 230, layer, ", ".join(sorted(table[layer][1], key=str.lower)))
    for layer, other, whole in arrows:
        (x, y), (to_x, to_y) = place[layer], place[other]
        parts.append(arrow(x, y + 56, to_x + max(-100, min(100, (x - to_x) / 3)), to_y, "" if whole else ' class="public"'))
    return svg(960, 76 + 84 * top, parts)


def words_of_code(root):
    found = set()
    for top in ("osgAnalyticBin", "applications", "tests"):
        for file in (root / top).rglob("*"):
            if file.suffix in (".h", ".cpp", ".inl") or file.name == "CMakeLists.txt":
                comment = "#.*" if file.suffix == ".txt" else "//.*"
                found.update(re.findall(r"\w+", re.sub(comment, "", file.read_text(encoding="utf-8"))))
    return found


def names_in(text):
    """Paths, functions, and words with capitals or underscores."""
    paths = re.findall(r"[\w./]+\.(?:h|cpp|inl|py|md)\b|\w+(?:/[\w-]+)+(?:\.\w+)?", text)
    yield from paths
    for path in paths:
        text = text.replace(path, " ")
    for word, call in re.findall(r"(\w+)(\(\))?", text):
        if call or re.search(r"[a-z].*[A-Z]|[A-Z].*[a-z]|_", word):
            yield word


def wrong_names(root, pages):
    words = words_of_code(root)
    files = [f"/{f.relative_to(root)}" for top in ("osgAnalyticBin", "applications", "tests") for f in (root / top).rglob("*")]
    for page, texts in pages.items():
        for name in sorted({name for text in texts for name in names_in(text)}):
            is_path = "/" in name or "." in name
            if not (any(file.endswith("/" + name) for file in files) if is_path else name in words):
                yield f"{page}: there is no {name}"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    doc = root / "osgAnalyticBin/doc"
    pictures = {"layers.svg": layer_picture(layers.LAYERS), "frame.svg": frame_and_file()}
    if "--write" in sys.argv:
        for name, picture in pictures.items():
            (doc / name).write_text(picture, encoding="utf-8")
    page = (doc / "architecture.md").read_text(encoding="utf-8")
    pages = {"architecture.md": re.findall(r"`([^`\n]+)`", page),
             "frame.svg": [words for step in FRAME + FILE for words in step], "layers.svg": list(layers.LAYERS)}
    wrong = list(wrong_names(root, pages))
    for name, picture in pictures.items():
        if f"]({name})" not in page:
            wrong.append(f"architecture.md does not show {name}")
        if not (doc / name).exists() or (doc / name).read_text(encoding="utf-8") != picture:
            wrong.append(f"{name} is out of date: run this script with --write")
    print("\n".join(wrong) or "all names are in the sources")
    return 1 if wrong else 0


sys.exit(main())
