# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
"""Doxygen's filter of Markdown files: names pages and headings, so that links lead where they lead on code hosts.
Argument: a file of the project. Prints it as Doxygen needs it."""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
SPECIAL = re.compile(r"(?P<code>`[^`]*`)|\]\((?P<target>[^()\s]+)\)|\b(?P<name>osgAnalyticBin)\b(?!::)")
PICTURES = {".gif", ".jpg", ".png", ".svg"}


def slugs(text):
    """The anchors of the headings, in their order, as code hosts make them."""
    found = []
    for heading in re.findall(r"^#+ +(.*?)#*$", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), flags=re.M):
        slug = re.sub(r"[^\w\- ]", "", heading.strip().lower().replace("`", "")).replace(" ", "-")
        found.append(slug if slug not in found else f"{slug}-{found.count(slug)}")
    return found


def page(file):
    """The name of a file's page: of guide.md guide, of tests/README.md tests."""
    if file == ROOT / "README.md":
        return "index"
    return (file.parent.name if file.stem == "README" else file.stem).lower()


def on_a_line(match, file):
    """Of a link to a folder, which the site has not, the text alone."""
    return match[1] if (file.parent / match[2]).is_dir() else match[0].replace("\n", " ")


def replaced(match, file):
    path, _, anchor = (match["target"] or "").partition("#")
    target = (file.parent / path).resolve() if path else file
    if match["name"]:
        return f"%{match[0]}"  # the project, not its namespace
    if match["code"] or re.match(r"[a-z]+:", path) or target.suffix in PICTURES:
        return match[0]
    if target.suffix != ".md":
        return f"]({target.name})"  # what is no page is copied beside the pages
    return f"](@ref {page(target)}-{anchor})" if anchor else f"](@ref {page(target)})"


def lines(file):
    text = re.sub(r"\A(<!--.*?-->\s*)*", "", file.read_text(encoding="utf-8"))
    text = re.sub(r"\[([^\[\]]+)\]\(([^()\s]+)\)", lambda match: on_a_line(match, file), text)
    anchors = slugs(text)
    fenced = False
    for number, line in enumerate(text.splitlines()):
        if line.startswith("```"):
            fenced = not fenced
        elif not fenced and not line.startswith("    "):
            line = SPECIAL.sub(lambda match: replaced(match, file), line)
            if line.startswith("# ") and number == 0:
                anchors.pop(0)
                line += f" {{#{page(file)}}}" if page(file) != "index" else ""
            elif line.startswith("#"):
                line += f" {{#{page(file)}-{anchors.pop(0)}}}"
        yield line


if __name__ == "__main__":
    print("\n".join(lines(pathlib.Path(sys.argv[1]).resolve())))
