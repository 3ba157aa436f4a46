#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
# SPDX-License-Identifier: MIT
"""Serves a folder by HTTP on this machine, each answer so many milliseconds late, as over a distant line.

    python3 applications/latency.py FOLDER --milliseconds 20 -- osgbinbench URL/earth.osgb --jumps ...

runs the command after -- with URL replaced by the server's address, and ends with its exit code. Connections are kept
open, as those of OSG's curl plugin are.
"""

import argparse
import functools
import http.server
import subprocess
import sys
import threading
import time


class LateHandler(http.server.SimpleHTTPRequestHandler):
    protocol_version = "HTTP/1.1"  # keeps connections open
    wbufsize = -1  # head and body in one packet, or the second one waits for the first one's receipt
    disable_nagle_algorithm = True
    seconds = 0.0

    def send_head(self):
        time.sleep(self.seconds)
        return super().send_head()

    def log_message(self, *_):
        pass


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--milliseconds", type=float, default=20.0, help="of every answer (default 20)")
    parser.add_argument("command", nargs="+", help="what is run meanwhile; URL in it stands for the address")
    options = parser.parse_args()
    LateHandler.seconds = options.milliseconds / 1000
    server = http.server.ThreadingHTTPServer(
        ("127.0.0.1", 0), functools.partial(LateHandler, directory=options.folder))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    url = "http://127.0.0.1:%d" % server.server_address[1]
    return subprocess.call([part.replace("URL", url) for part in options.command])


if __name__ == "__main__":
    sys.exit(main())
