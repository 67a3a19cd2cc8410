"""A server of our own, for as long as the report takes."""

import contextlib
import json
import os
import pathlib
import subprocess
import tempfile
import time

START_SECONDS = 30
STOP_SECONDS = 20


class ServerFailed(Exception):
    pass


def address_in(log):
    """Where a server listens, by its log; nothing until it does."""
    for line in log.splitlines():
        with contextlib.suppress(ValueError):
            entry = json.loads(line)
            if entry.get("message") == "serving":
                return "http://" + entry["listen"]
    return None


def own_environment(environment):
    """Without settings that were meant for other servers."""
    return {name: value for name, value in environment.items() if not name.startswith("WELLSPACED_")}


def _wait_until_it_listens(process, log):
    end = time.monotonic() + START_SECONDS
    while time.monotonic() < end:
        address = address_in(log.read_text())
        if address:
            return address
        if process.poll() is not None:
            break
        time.sleep(0.02)
    raise ServerFailed(f"{process.args[0]} doesn't serve. It said:\n{log.read_text()}")


@contextlib.contextmanager
def running(program, *settings):
    """Its address. However the block is left, the server is stopped and what it stored is gone."""
    with tempfile.TemporaryDirectory(prefix="wellspaced-reproduce-") as folder:
        log = pathlib.Path(folder, "log")
        with log.open("wb") as output:
            process = subprocess.Popen(
                [program, "--listen", "127.0.0.1:0", "--store", f"{folder}/jobs.db", *settings, "serve"],
                env=own_environment(os.environ), stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT)
        try:
            yield _wait_until_it_listens(process, log)
        finally:
            process.terminate()
            try:
                process.wait(STOP_SECONDS)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
