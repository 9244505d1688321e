#!/usr/bin/env python3
"""How quickly is the 3-D view of the editor and of the pages of `improve` drawn?

Opens page_frames/frames.html in Chromium, with copies above and below the object as the editor shows them, and prints
one row per number of triangles: frames per second while the object turns (Chromium draws at most 60, but for
--unbounded), the time of one frame, what a step of a drag costs the page without the program, and what opening a mesh
costs it. Needs Python and Chromium alone. Without --gpu Chromium draws in software, on any machine.
"""
import argparse
import csv
import functools
import http.server
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading

SOURCE = pathlib.Path(__file__).resolve().parents[2]
COLUMNS = ["triangles", "frames_per_second", "frame_ms", "step_ms", "open_ms", "renderer"]
SOFTWARE = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
HARDWARE = ["--use-angle=vulkan", "--enable-features=Vulkan", "--disable-vulkan-surface", "--ignore-gpu-blocklist"]
UNBOUNDED = ["--disable-frame-rate-limit", "--disable-gpu-vsync"]


class Handler(http.server.SimpleHTTPRequestHandler):
    """Serves the sources of this project, and takes what the page has found."""

    def do_POST(self):
        self.server.found.append(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
        self.send_response(204)
        self.end_headers()
        self.server.arrived.set()

    def log_message(self, *_):
        pass


def measure(options, triangles):
    """Returns what the page finds with so many triangles."""
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=SOURCE))
    server.found, server.arrived = [], threading.Event()
    threading.Thread(target=server.serve_forever, daemon=True).start()
    page = "experiments/speed/page_frames/frames.html"
    address = f"http://127.0.0.1:{server.server_port}/{page}?triangles={triangles}&seconds={options.seconds}"
    flags = (HARDWARE if options.gpu else SOFTWARE) + (UNBOUNDED if options.unbounded else [])
    with tempfile.TemporaryDirectory() as profile:
        browser = subprocess.Popen(
            [options.chromium, "--headless", "--no-sandbox", "--no-first-run", "--disable-background-networking",
             "--window-size=1280,800", f"--user-data-dir={profile}", "--remote-debugging-port=0", *flags, address],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        try:
            arrived = server.arrived.wait(options.patience)
        finally:
            browser.kill()
            said = browser.communicate()[1]
            server.shutdown()
    if not arrived:
        sys.exit(f"page_frames.py: no answer within {options.patience} s. Chromium said:\n{said[-2000:]}")
    if "error" in server.found[0]:
        sys.exit(f"page_frames.py: {server.found[0]['error']}")
    return server.found[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--chromium", default=shutil.which("chromium"), help="program (default: that of the path)")
    parser.add_argument("--triangles", type=int, nargs="+", default=[10_000, 100_000], help="default: 10000 100000")
    parser.add_argument("--seconds", type=float, default=5, help="for which the object turns (default: 5)")
    parser.add_argument("--patience", type=float, default=120, help="seconds to wait for an answer (default: 120)")
    parser.add_argument("--gpu", action="store_true", help="draw on the graphics card, by Vulkan")
    parser.add_argument("--unbounded", action="store_true", help="draw as many frames as there can be")
    options = parser.parse_args()
    if not options.chromium:
        sys.exit("page_frames.py: Chromium was not found; --chromium names it")
    table = csv.DictWriter(sys.stdout, COLUMNS)
    table.writeheader()
    for triangles in options.triangles:
        found = measure(options, triangles)
        table.writerow({name: round(value, 2) if isinstance(value, float) else value for name, value in found.items()})
        sys.stdout.flush()


if __name__ == "__main__":
    main()
