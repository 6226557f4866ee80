"""A server under load, its metrics, and many plain sockets."""
import json
import pathlib
import re
import select
import socket
import subprocess
import sys
import time
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "server"))
from killed_server import swing  # noqa: E402
from latency import TOP, start_server  # noqa: E402

API = "/api/v1"


class LoadedServer:
    """`armloom serve` of two Pandas on a free loopback port; every address 127.x is a separate client."""

    def __init__(self, armloom, *options, demo=False):
        self.process, self.port = start_server([armloom, "serve", "--cell", str(TOP / "config/two_pandas.json"),
                                                *map(str, options)])
        self.demo = demo and subprocess.Popen(
            [sys.executable, TOP / "server/demo.py", f"http://127.0.0.1:{self.port}",
             TOP / "config/two_pandas_jobs.json"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in filter(None, (self.demo, self.process)):
            process.terminate()
            process.wait()

    def call(self, method, path, body=None):
        request = urllib.request.Request(
            f"http://127.0.0.1:{self.port}{path}", method=method, headers={"Content-Type": "application/json"},
            data=None if body is None else json.dumps(body).encode())
        with urllib.request.urlopen(request, timeout=60) as answer:
            return answer.read().decode()

    def submit(self, count, prefix="j"):
        """Submits jobs in batches of 1,000; returns their ids."""
        arms = ("left", "right")
        jobs = [swing(f"{prefix}{i}", arms[i % 2], 2, []) for i in range(count)]
        for job in jobs:
            job["backlog_timeout_s"] = 100000
        for i in range(0, count, 1000):
            self.call("POST", API + "/batches", {"jobs": jobs[i:i + 1000], "atomic": True})
        return [job["id"] for job in jobs]

    def metrics(self):
        figures = {}
        for line in self.call("GET", "/metrics").splitlines():
            if not line.startswith("#"):
                name, value = line.rsplit(" ", 1)
                figures[name] = float(value)
        return figures

    def memory_mib(self, which="VmRSS"):
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(re.search(which + r":\s+(\d+) kB", status)[1]) / 1024


class EmptyLoop:
    """A process with an empty 1 ms loop, which measures the delays of the machine itself."""

    def __init__(self):
        code = ("import select, sys, time\nlast, gaps, longest = time.monotonic(), 0, 0\n"
                "while not select.select([sys.stdin], [], [], 0.001)[0]:\n"
                "  now = time.monotonic(); gaps += now - last > 0.005; longest = max(longest, now - last); last = now\n"
                "print(gaps, 1e3 * longest)")
        self.process = subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)

    def end(self):
        """Returns the number of gaps of more than five periods, and the longest gap in ms."""
        gaps, longest_ms = self.process.communicate("end\n")[0].split()
        return int(gaps), float(longest_ms)


class Periods:
    """Regularity of the control loop between two reads of /metrics, compared with an empty loop."""

    def __init__(self, server, loop="control"):
        self.server, self.loop = server, loop
        self.before, self.empty = self.look(), EmptyLoop()

    def look(self):
        figures = self.server.metrics()
        edges = {}
        for name, value in figures.items():
            if found := re.fullmatch(rf'armloom_period_seconds_bucket{{loop="{self.loop}",le="(.*)"}}', name):
                edges[float(found[1])] = value
        return edges, figures[f'armloom_overruns_total{{loop="{self.loop}"}}']

    def since(self):
        """Returns p99 in ms (interpolated within a histogram bucket), and a text about the overruns."""
        edges, overruns = self.look()
        gaps, _ = self.empty.end()
        counts = {edge: value - self.before[0][edge] for edge, value in edges.items()}
        wanted, low_edge, low = 0.99 * counts[float("inf")], 0.0, 0.0
        for edge, count in sorted(counts.items()):
            if count >= wanted:
                share = (wanted - low) / max(count - low, 1)
                said = (f"{overruns - self.before[1]:.0f} overruns of {counts[float('inf')]:.0f} rounds of {self.loop} "
                        f"(an empty loop: {gaps})")
                return 1e3 * (low_edge + share * (edge - low_edge)), said
            low_edge, low = edge, count


def connect(port, source="127.0.0.1", receive_buffer=0, wait=True):
    s = socket.socket()
    if receive_buffer:
        s.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
    s.bind((source, 0))
    s.setblocking(wait)
    if wait:
        s.settimeout(60)
        s.connect(("127.0.0.1", port))
    else:
        s.connect_ex(("127.0.0.1", port))
    return s


def upgrade(port):
    return (f"GET {API}/ws HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n").encode()


def shake_hands(port, count, receive_buffer=0, wait_s=60, source="127.0.0.1"):
    """Opens WebSockets at once; returns them and for each the time until it was open (s; None if never)."""
    epoll, begun, sockets = select.epoll(), time.monotonic(), {}
    for _ in range(count):
        s = connect(port, source, receive_buffer, wait=False)
        sockets[s.fileno()] = s
        epoll.register(s.fileno(), select.EPOLLOUT)
    took, hello = dict.fromkeys(sockets), upgrade(port)
    left = count
    while left and time.monotonic() - begun < wait_s:
        for fd, event in epoll.poll(1):
            if event & (select.EPOLLERR | select.EPOLLHUP):
                epoll.unregister(fd)
                left -= 1
            elif event & select.EPOLLOUT:
                sockets[fd].send(hello)
                epoll.modify(fd, select.EPOLLIN)
            else:
                try:
                    is_open = sockets[fd].recv(12).startswith(b"HTTP/1.1 101")
                except OSError:
                    is_open = False
                took[fd] = time.monotonic() - begun if is_open else None
                epoll.unregister(fd)
                left -= 1
    return list(sockets.values()), [took[fd] for fd in sockets]


def quantiles(samples_s):
    """"median 1.2, 99 % 3.4, most 5.6 ms of 100"""
    ordered = sorted(1e3 * s for s in samples_s)
    at = lambda share: ordered[min(len(ordered) - 1, int(share * len(ordered)))]
    return f"median {at(0.5):.1f}, 99 % {at(0.99):.1f}, most {ordered[-1]:.1f} ms of {len(ordered)}"


class Repeated:
    """Repeats a request in a separate process, each on a new connection."""

    def __init__(self, port, method, path, source="127.0.0.1", pause_s=0.02):
        code = ("import sys; sys.path.insert(0, %r); from loaded_server import repeat; "
                "repeat(%d, %r, %r, %r, %f)" % (str(TOP / "test/bench"), port, method, path, source, pause_s))
        self.process = subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)

    def end(self):
        """Returns the duration of each request (s)."""
        return [float(line) for line in self.process.communicate("end\n")[0].split()]


def repeat(port, method, path, source, pause_s):
    took = []
    while not select.select([sys.stdin], [], [], pause_s)[0]:
        begun = time.monotonic()
        s = connect(port, source)
        s.sendall(f"{method} {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\n"
                  "Content-Length: 0\r\n\r\n".encode())
        answer = b""
        while piece := s.recv(65536):
            answer += piece
        s.close()
        if b" 20" not in answer[:13]:
            sys.exit(f"{method} {path}: {answer[:200]}")
        took.append(time.monotonic() - begun)
    print("\n".join(map(str, took)))
