"""Tests of waiting for jobs. python3 -m unittest reproduce.test_client"""

import json
import unittest
from unittest import mock

from reproduce import client as http_client
from reproduce.client import Client, Problem


class Waiting(unittest.TestCase):
    class Endless(Client):
        """A server whose jobs never end; each time that is asked for one, a minute passes."""

        def __init__(self):
            super().__init__("http://localhost:1")
            self.minutes, self.sent = 0, []

        def _send(self, request, timeout=None):
            self.sent.append((request.get_method(), request.selector))
            if request.get_method() == "GET":
                self.minutes += 1
            return json.dumps({"id": "ID", "status": "running"}).encode()

    def test_a_job_that_does_not_end_is_given_up_and_cancelled(self):
        client = self.Endless()
        with mock.patch.object(http_client.time, "monotonic", lambda: 60.0 * client.minutes):
            with self.assertRaises(Problem) as raised:
                client.job("analyze", {"compare": []})
        self.assertIn(f"{http_client.LONGEST_SECONDS} seconds", str(raised.exception))
        self.assertIn("/v1/analyze", str(raised.exception))
        self.assertEqual(client.minutes, http_client.LONGEST_SECONDS / 60)
        self.assertEqual(client.sent[-1], ("DELETE", "/v1/jobs/ID"))

    def test_a_server_that_does_not_take_the_cancellation_hides_nothing(self):
        client = self.Endless()
        send = client._send

        def refusing(request, timeout=None):
            if request.get_method() == "DELETE":
                raise Problem({"title": "no"}, "")
            return send(request, timeout)

        client._send = refusing
        with mock.patch.object(http_client.time, "monotonic", lambda: 60.0 * client.minutes):
            with self.assertRaises(Problem) as raised:
                client.job("analyze", {"compare": []})
        self.assertIn(f"{http_client.LONGEST_SECONDS} seconds", str(raised.exception))


if __name__ == "__main__":
    unittest.main()
