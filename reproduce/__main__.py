"""usage: python3 -m reproduce --program PROGRAM [--short] [-o FOLDER]"""

import argparse
import os
import pathlib
import platform
import signal
import subprocess
import sys
import time

from reproduce import check, paper, report, server
from reproduce.client import Client, Problem
from reproduce.context import FULL, SHORT, Context
from reproduce.sections import ENTRIES

# More than any request here takes: the race is of synchronous ones.
SETTINGS = ("--sync-seconds", "3600", "--picture-limit", "1000000", "--log-level", "info")


def arguments():
    parser = argparse.ArgumentParser(prog="./dev reproduce", description="Regenerates the paper's results as "
                                                                         "one page.")
    parser.add_argument("--program", required=True, help="the built wellspaced")
    parser.add_argument("--short", action="store_true", help="fewer and smaller sets, in less than a minute")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, help="folder for report.html")
    return parser.parse_args()


def cpu_model():
    """Of this machine, as far as it says."""
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.machine()


def commit():
    """Of the sources around, if they are in a git checkout."""
    here = pathlib.Path(__file__).resolve().parent
    try:
        said = subprocess.run(["git", "-C", here, "describe", "--always", "--dirty"], capture_output=True, text=True,
                              check=True)
        return said.stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def filled_sections(context):
    sections = []
    for number, entry in enumerate(ENTRIES, 1):
        started = time.perf_counter()
        section = report.Section(entry.anchor, entry.title, number)
        entry.fill(context, section)
        section.seconds = time.perf_counter() - started
        print(f"{section.seconds:7.1f} s  {section.title}", flush=True)
        sections.append(section)
    return sections


def lead(short):
    text = report.paragraph(
        f"{paper.AUTHORS}: \u201c{paper.TITLE}\u201d, {paper.JOURNAL}. Its results, made again with "
        "the service wellspaced through its public HTTP API. Every number of this service was "
        "computed for this page; what the paper or others say stands with where it is from. "
        "The paper's text could not be obtained by this project: what it says is known from its abstract and from "
        "this project's notes, which quote it, and wherever it is not known this page says "
        f"\u201c{paper.NOT_AVAILABLE}\u201d.", "lead")
    if short:
        text += report.paragraph("This is the short form: fewer and smaller point sets than the paper's, to show "
                                 "that everything works.", "lead")
    return text


def write(options, started):
    """Makes the page; what is wrong with it."""
    options.output.mkdir(parents=True, exist_ok=True)
    with server.running(options.program, *SETTINGS) as address:
        client = Client(address)
        version = client.operations()["version"]
        sections = filled_sections(Context(client, SHORT if options.short else FULL))
    total = time.perf_counter() - started
    facts = [("command", "./dev reproduce" + (" --short" if options.short else "")),
             ("version of the service", version),
             ("commit of the sources", commit()),
             ("CPU", f"{cpu_model()}, {os.cpu_count()} cores"),
             ("total", f"{total:.1f} s")]
    page = report.page(f"{paper.TITLE}: reproduced", lead(options.short), sections, facts)
    path = options.output / "report.html"
    path.write_text(page, encoding="utf-8")
    print(f"{total:7.1f} s  in all: {path} ({len(page.encode()) / 1e6:.1f} MB)", flush=True)
    wanted = {"summary": ("table",), "reproduce": ("table",)} | {entry.anchor: entry.has for entry in ENTRIES}
    return check.faults(page, wanted)


def stop(number, frame):
    """A server of our own has to be stopped too, so this is an exception like Ctrl-C's."""
    raise KeyboardInterrupt


def main():
    options = arguments()
    signal.signal(signal.SIGTERM, stop)
    try:
        faults = write(options, time.perf_counter())
    except (Problem, server.ServerFailed, OSError) as error:
        print(f"reproduce: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("reproduce: interrupted", file=sys.stderr)
        return 130
    for fault in faults:
        print(f"reproduce: the page is not as it should be: {fault}", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
