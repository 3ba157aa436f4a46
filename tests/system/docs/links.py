# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
"""Checks the relative links, pictures and anchors of all Markdown files. Argument: the source folder."""

import pathlib
import re
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "osgAnalyticBin/doc/site"))
from page import slugs

LINK = re.compile(r"\[(?:[^\[\]]|\[[^\]]*\])*\]\(([^()\s]+)\)")
SKIPPED = {"build", "demo", ".git"}


def without_code(text):
    """Code is no prose: brackets in it are not links."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    text = re.sub(r"^ {4}.*$", "", text, flags=re.M)
    return re.sub(r"`[^`\n]*`", "", text)


def problems(root):
    pages = [p for p in root.rglob("*.md") if not SKIPPED & set(p.relative_to(root).parts)]
    if len(pages) < 5:
        yield f"{root}: only {len(pages)} Markdown files"
    for page in pages:
        for target in LINK.findall(without_code(page.read_text(encoding="utf-8"))):
            if re.match(r"[a-z]+:", target):
                continue
            path, _, anchor = target.partition("#")
            file = (page.parent / path) if path else page
            where = page.relative_to(root)
            if not file.exists():
                yield f"{where}: there is no {target}"
            elif root not in file.resolve().parents:
                yield f"{where}: {target} leaves the project"
            elif anchor and anchor not in slugs(file.read_text(encoding="utf-8")):
                yield f"{where}: no heading makes the anchor {target}"


def main():
    found = list(problems(pathlib.Path(sys.argv[1]).resolve()))
    print("\n".join(found) or "all links lead somewhere")
    return 1 if found else 0


sys.exit(main())
