#!/usr/bin/env python3
"""POST /jobs of a 100-waypoint trajectory to first motion, on an idle server.

    test/bench/latency.py ARMLOOM [COUNT]

Starts `armloom serve` on a free loopback port in real time and posts COUNT jobs (default 200), each
after the previous job has ended, alternating the two arms. A sample is the time from writing the first
byte of the request to receiving the event, over a WebSocket, that the job is `running`. The server sends
it in the control cycle in which the arm's commanded progress first moves. Client and server share the
machine. Prints median, p90, p99 and maximum in milliseconds.
"""
import base64
import json
import os
import pathlib
import re
import socket
import statistics
import struct
import subprocess
import sys
import time

TOP = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TOP / "config"))
import joint_moves  # noqa: E402

joint_moves.WAYPOINTS = 100
HOME = [0, -1.2, 0, -2.6, 0, 1.6, 0.785]
NEAR = [0, -1.1, 0, -2.5, 0, 1.6, 0.785]
DURATION_S = 0.5


def start_server(arguments):
    """Starts the server on a port chosen by the system; returns the server and the port that it prints."""
    server = subprocess.Popen([*arguments, "--listen", "127.0.0.1:0"], stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, text=True)
    for line in server.stdout:
        if found := re.search(r"dashboard: http://127\.0\.0\.1:(\d+)/", line):
            return server, int(found[1])
    sys.exit("the server did not come up")


def connect(port):
    s = socket.create_connection(("127.0.0.1", port), timeout=10)
    s.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return s


class Events:
    """Job events of a WebSocket, as they arrive."""

    def __init__(self, port):
        self.socket = connect(port)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(f"GET /api/v1/ws HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n"
                            "Upgrade: websocket\r\nConnection: Upgrade\r\n"
                            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n".encode())
        self.buffer = b""
        while b"\r\n\r\n" not in self.buffer:
            self.buffer += self.socket.recv(65536)
        self.buffer = self.buffer.split(b"\r\n\r\n", 1)[1]

    def take(self, count):
        while len(self.buffer) < count:
            self.buffer += self.socket.recv(65536)
        taken, self.buffer = self.buffer[:count], self.buffer[count:]
        return taken

    def next(self):
        """Returns the next event that is no pose; `arrived` is the time at which it arrived."""
        while True:
            kind, size = self.take(2)
            size &= 0x7F
            if size == 126:
                size = struct.unpack(">H", self.take(2))[0]
            elif size == 127:
                size = struct.unpack(">Q", self.take(8))[0]
            payload = self.take(size)
            self.arrived = time.perf_counter()
            if kind & 0x0F == 9:  # a ping: answer with a pong of the same payload, mask zero
                self.socket.sendall(bytes([0x8A, 0x80 | size, 0, 0, 0, 0]) + payload)
            if kind & 0x0F != 1 or b'"type":"state"' in payload[:20]:
                continue
            return json.loads(payload)

    def wait_for(self, job, state):
        """Returns the time at which the event arrived."""
        while True:
            event = self.next()
            if event["type"] == "job" and event["data"]["id"] == job and event["data"]["state"] == state:
                return self.arrived


def post(connection, port, body):
    text = json.dumps(body).encode()
    began = time.perf_counter()
    connection.sendall(f"POST /api/v1/jobs HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n"
                       "Content-Type: application/json\r\n"
                       f"Content-Length: {len(text)}\r\n\r\n".encode() + text)
    answer = b""
    while b"\r\n\r\n" not in answer:
        answer += connection.recv(65536)
    head, body = answer.split(b"\r\n\r\n", 1)
    size = int([h for h in head.lower().split(b"\r\n") if h.startswith(b"content-length")][0][15:])
    while len(body) < size:
        body += connection.recv(65536)
    if b" 202 " not in head.split(b"\r\n")[0]:
        sys.exit(f"refused: {body.decode()}")
    return began


def main():
    armloom = sys.argv[1]
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 200
    server, port = start_server([armloom, "serve", "--cell", TOP / "config/two_pandas.json"])
    try:
        connection, events = connect(port), Events(port)
        at = {"left": HOME, "right": HOME}
        samples = []
        for n in range(count):
            arm = ("left", "right")[n % 2]
            goal = NEAR if at[arm] is HOME else HOME
            names = [f"{arm}_panda_joint{i}" for i in range(1, 8)]
            job = {"id": f"bench-{n}",
                   "trajectory": joint_moves.quintic(names, at[arm], goal, DURATION_S)}
            began = post(connection, port, job)
            samples.append((events.wait_for(job["id"], "running") - began) * 1e3)
            events.wait_for(job["id"], "succeeded")
            at[arm] = goal
    finally:
        server.terminate()
        server.wait(timeout=10)
    samples.sort()
    print(f"{count} jobs of {joint_moves.WAYPOINTS} waypoints: median "
          f"{statistics.median(samples):.2f} ms, p90 {samples[int(count * 0.9)]:.2f} ms, p99 "
          f"{samples[min(count - 1, int(count * 0.99))]:.2f} ms, max {samples[-1]:.2f} ms")


if __name__ == "__main__":
    main()
