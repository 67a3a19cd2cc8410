"""The service's HTTP API, as far as the report needs it."""

import contextlib
import http.client
import json
import time
import urllib.error
import urllib.request
from dataclasses import dataclass, field

from reproduce import bodies

LARGEST_SVG_BYTES = 1_000_000
PNG_SCALE = 2
LONGEST_SHOWN = 2000    # characters of a request that failed
LONGEST_SECONDS = 3600  # of a request, and of a job
WAIT_SECONDS = 60       # the longest that the server takes to say how a job gets on


class Problem(Exception):
    """A refused request or failed work: what the problem document (RFC 9457) says."""

    def __init__(self, document, request):
        lines = [f"{document.get('title', 'refused')} ({document.get('status', 'no status')})"]
        if document.get("detail"):
            lines.append(document["detail"])
        lines += [f"  at {error.get('pointer')}: {error.get('detail')}" for error in document.get("errors", [])]
        super().__init__("\n".join([*lines, f"request: {request}"]))


def problem_document(text, status):
    """What a refusal says, also when it is not a problem document."""
    try:
        document = json.loads(text)
    except ValueError:
        document = None
    if isinstance(document, dict):
        return document
    return {"title": "The answer is no problem document", "status": status, "detail": text.decode(errors="replace")}


@dataclass
class Picture:
    kind: str  # svg or png
    data: bytes

    @property
    def bytes_in_page(self):
        """A PNG is written there in base 64."""
        return len(self.data) if self.kind == "svg" else len(self.data) * 4 // 3


@dataclass
class Job:
    """One that was successful, with its result and all it was asked for."""

    client: "Client"
    id: str
    operation: str
    body: dict
    result: dict
    pictures: list = field(default_factory=list)

    @property
    def groups(self):
        return self.result["compare"]

    def picture(self, name, **parameters):
        """As SVG, or as PNG where that would be large for a page and PNG is smaller there."""
        query = bodies.picture_query(name, "svg", parameters)
        picture = Picture("svg", self._fetch(query))
        if len(picture.data) > LARGEST_SVG_BYTES:
            png_query = bodies.picture_query(name, "png", {**parameters, "scale": PNG_SCALE})
            png = Picture("png", self._fetch(png_query))
            if png.bytes_in_page < picture.bytes_in_page:
                query, picture = png_query, png
        self.pictures.append((name, picture.kind, query))
        return picture

    def curl(self):
        """The commands that do the same by hand."""
        lines = [bodies.curl(f"/v1/{self.operation}", self.body, respond_async=True),
                 "# with the id that it answers:",
                 "curl -s 'localhost:8080/v1/jobs/ID' -H 'Prefer: wait=60'",
                 "curl -s 'localhost:8080/v1/jobs/ID/result' -o result.json"]
        lines += [f"curl -s 'localhost:8080/v1/jobs/ID/result?{query}' -o {name}.{kind}"
                  for name, kind, query in self.pictures]
        return "\n".join(lines)

    def _fetch(self, query):
        return self.client.get(f"/v1/jobs/{self.id}/result?{query}")


class Client:
    def __init__(self, address):
        self._address = address.rstrip("/")
        # A proxy that is set for the outer world knows nothing of this machine's servers.
        self._opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))

    def get(self, path, **headers):
        return self._send(self._request(path, **headers))

    def post(self, path, body, **headers):
        headers = {"Content-Type": "application/json", **headers}
        return self._send(urllib.request.Request(self._address + path, json.dumps(body).encode(), headers))

    def upload(self, path):
        """What the service says of a domain whose file it now keeps."""
        return json.loads(self._send(urllib.request.Request(
            self._address + "/v1/domains", path.read_bytes(), {"Content-Type": "application/octet-stream"})))

    def operations(self):
        return json.loads(self.get("/v1/operations"))

    def job(self, operation, body):
        """Does the work as a job and waits for its end, but not for ever."""
        path = f"/v1/{operation}"
        end = time.monotonic() + LONGEST_SECONDS
        job = json.loads(self.post(path, body, Prefer="respond-async"))
        while job["status"] in ("accepted", "running"):
            if time.monotonic() >= end:
                self._cancel(job["id"])
                raise Problem({"title": "The job took too long",
                               "detail": f"It was {job['status']} after {LONGEST_SECONDS} seconds and was given up; "
                                         "./dev reproduce --short asks for less"}, bodies.curl(path, body))
            job = json.loads(self._send(self._request(f"/v1/jobs/{job['id']}", Prefer=f"wait={WAIT_SECONDS}"),
                                        2 * WAIT_SECONDS))
        if job["status"] != "successful":
            raise Problem(job.get("problem") or {"title": f"The job is {job['status']}"}, bodies.curl(path, body))
        result = json.loads(self.get(f"/v1/jobs/{job['id']}/result"))
        return Job(self, job["id"], operation, body, result)

    def timed(self, operation, body):
        """A synchronous request: its result, and the seconds from the first byte sent to the last one read."""
        started = time.perf_counter()
        answer = self.post(f"/v1/{operation}", body)
        return json.loads(answer), time.perf_counter() - started

    def _request(self, path, method="GET", **headers):
        return urllib.request.Request(self._address + path, headers=headers, method=method)

    def _cancel(self, job):
        """Nothing is to be done about a server that doesn't take it."""
        with contextlib.suppress(Problem):
            self._send(self._request(f"/v1/jobs/{job}", "DELETE"), WAIT_SECONDS)

    def _send(self, request, timeout=LONGEST_SECONDS):
        body = request.data.decode(errors="replace")[:LONGEST_SHOWN] if request.data else ""
        sent = f"{request.get_method()} {request.selector} {body}".strip()
        try:
            with self._opener.open(request, timeout=timeout) as answer:
                return answer.read()
        except urllib.error.HTTPError as error:
            raise Problem(problem_document(error.read(), error.code), sent) from None
        except (OSError, http.client.HTTPException) as error:
            raise Problem({"title": "The server doesn't answer", "detail": str(error)}, sent) from None
