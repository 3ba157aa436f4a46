# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
"""Checks the pages of the site: each has a title of its own, and links and pictures lead to files and anchors that are
there. With Chromium it opens each page from its file, without a window; then nothing may complain on the console, fail
to load or come from a network, and no page may be wider than the window. Exit code 77: skipped, there is no Chromium.
Arguments: folder of the pages; then Chromium."""

import html.parser
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

SKIPPED = 77

FLAGS = """--headless --no-sandbox --disable-gpu --disable-quic --disable-dev-shm-usage --no-first-run
    --disable-extensions --disable-background-networking --disable-component-update --disable-sync
    --window-size=1280,1000 --remote-debugging-pipe"""

# What a page holds when its scripts have run.
CONTENT = """new Promise(done => setTimeout(() => requestAnimationFrame(() => {
    const all = (what, get) => Array.from(document.querySelectorAll(what), get);
    const shown = document.querySelector('#doc-content') || document.body;
    done({title: document.title, anchors: all('[id]', e => e.id).concat(all('a[name]', e => e.name)),
        links: all('a[href]', e => e.href).concat(all('img[src]', e => e.src), all('object[data]', e => e.data)),
        excess: shown.scrollWidth - shown.clientWidth});
}), 0))"""


class Content(html.parser.HTMLParser):
    """The same of a page whose scripts have not run."""

    def __init__(self, file):
        super().__init__()
        self._base = file.as_uri()
        self._in_title = False
        self.page = {"title": "", "anchors": [], "links": [], "excess": 0}
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        self._in_title = tag == "title"
        for name, value in attrs:
            if name == "id" or (tag, name) == ("a", "name"):
                self.page["anchors"].append(value)
            elif name in ("href", "src", "data"):
                self.page["links"].append(urllib.parse.urljoin(self._base, value))

    def handle_data(self, data):
        if self._in_title:
            self.page["title"] += data


class Browser:
    """Chromium as its development tools steer it: it reads JSON from file descriptor 3 and writes JSON to 4, with a zero
    byte after each."""

    def __init__(self, program, profile):
        commands, answers = (pathlib.Path(profile, name) for name in ("commands", "answers"))
        os.mkfifo(commands)
        os.mkfifo(answers)
        command = f'exec "$0" "$@" 3<"{commands}" 4>"{answers}"'
        self._process = subprocess.Popen(["sh", "-c", command, program, *FLAGS.split(), f"--user-data-dir={profile}"],
                                         stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self._commands = commands.open("wb", buffering=0)
        self._answers = answers.open("rb")
        self._count = 0
        self._session = {}
        self.events = []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self._session = {"sessionId": self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]}
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")

    def _read(self):
        message = bytearray()
        while (byte := self._answers.read(1)) != b"\0":
            if not byte:
                sys.exit("the browser ended")
            message += byte
        return json.loads(message)

    def call(self, method, **parameters):
        self._count += 1
        message = {"id": self._count, "method": method, "params": parameters} | self._session
        self._commands.write(json.dumps(message).encode() + b"\0")
        while (message := self._read()).get("id") != self._count:
            self.events.append(message)
        if "error" in message:
            sys.exit(f"{method}: {message['error']['message']}")
        return message["result"]

    def open(self, url):
        """Returns what the page holds, and leaves in `events` what happened."""
        self.events = []
        self.call("Page.navigate", url=url)
        while not any(event["method"] == "Page.loadEventFired" for event in self.events):
            self.events.append(self._read())
        result = self.call("Runtime.evaluate", expression=CONTENT, awaitPromise=True, returnByValue=True)
        return result["result"]["value"]

    def close(self):
        self.call("Browser.close")
        self._process.wait(timeout=30)


def complaints(events):
    sent = [event["params"] for event in events if event["method"] == "Network.requestWillBeSent"]
    requests = {request["requestId"]: request["request"]["url"] for request in sent}
    for url in requests.values():
        if not url.startswith(("file:", "data:")):
            yield f"would load {url}"
    for event in events:
        method, said = event["method"], event["params"]
        if method == "Network.loadingFailed":
            yield f"{requests.get(said['requestId'])}: {said['errorText']}"
        elif method == "Runtime.exceptionThrown":
            yield said["exceptionDetails"].get("exception", {}).get("description", said["exceptionDetails"]["text"])
        elif method == "Runtime.consoleAPICalled" and said["type"] in ("error", "warning", "assert"):
            yield f"console: {said['args']}"
        elif method == "Log.entryAdded" and said["entry"]["level"] in ("error", "warning"):
            yield f"console: {said['entry']['text']} {said['entry'].get('url', '')}"


def missing(pages, folder):
    """Of links between pages: those to files and anchors that are not there."""
    for name, content in pages.items():
        for link in sorted(set(content["links"])):
            url = urllib.parse.urlsplit(link)
            if url.scheme in ("https", "http", "mailto", "javascript", "data"):
                continue
            file = pathlib.Path(urllib.parse.unquote(url.path))
            target = str(file.relative_to(folder)) if folder in file.parents else None
            anchor = urllib.parse.unquote(url.fragment)
            if target is None or not file.is_file():
                yield f"{name}: there is no {link}"
            elif anchor and target in pages and anchor not in pages[target]["anchors"]:
                yield f"{name}: no anchor {target}#{anchor}"


def problems(folder, browser):
    pages = {}
    titles = {}
    for file in sorted(folder.rglob("*.html")):
        name = str(file.relative_to(folder))
        pages[name] = content = browser.open(file.as_uri()) if browser else Content(file).page
        for complaint in complaints(browser.events if browser else []):
            yield f"{name}: {complaint}"
        if content["excess"] > 0:
            yield f"{name}: {content['excess']} pixels wider than the window"
        if file.parent == folder and not file.stem.endswith("-members") and content["title"] in ("", *titles):
            yield f"{name}: its title \"{content['title']}\" is that of {titles.get(content['title'])}"
        titles[content["title"]] = name
        if left := re.search(r"@(ref|section|image|code)\b|\w\]\(\w+\)", file.read_text(encoding="utf-8")):
            yield f"{name}: Doxygen left {left[0]} in the text"
    if len(pages) < 20:
        yield f"{folder}: only {len(pages)} pages"
    yield from missing(pages, folder)


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    if len(sys.argv) == 2:
        found = list(problems(folder, None))
    elif not shutil.which(sys.argv[2]):
        print("skipped: there is no Chromium")
        return SKIPPED
    else:
        with tempfile.TemporaryDirectory() as profile:
            browser = Browser(sys.argv[2], profile)
            found = list(problems(folder, browser))
            browser.close()
    print("\n".join(found) or "all pages are right, and all links lead somewhere")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
