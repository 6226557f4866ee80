#!/usr/bin/env python3
"""The demo load: both arms shuttle between home and poses in the middle, through the public API.

    server/demo.py URL JOBS_FILE [--parent PID]

Reads the moves out and back from a jobs file (config/two_pandas_jobs.json) and keeps two jobs of
each arm accepted for as long as the server runs, so that queue and backlog are at work. An arm
that somebody has moved or canceled elsewhere is brought home first. Ends with the server, or when
the process PID has gone.
"""
import json
import os
import sys
import time
import urllib.error
import urllib.request

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "config"))
from joint_moves import quintic  # noqa: E402

AHEAD = 2  # jobs of each arm that are accepted and have not ended
NEAR_RAD = 0.005  # closer than this, an arm stands at a trajectory's start


class Server:
    def __init__(self, url):
        self.url = url + "/api/v1"

    def call(self, method, path, body=None):
        request = urllib.request.Request(
            self.url + path, method=method,
            data=None if body is None else json.dumps(body).encode(),
            headers={"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=10) as answer:
            return json.load(answer)

    def wait_until_up(self, seconds=60):
        for _ in range(seconds * 10):
            try:
                return self.call("GET", "/queue")
            except (urllib.error.URLError, ConnectionError, TimeoutError):
                time.sleep(0.1)
        sys.exit("demo: the server did not come up")


class Shuttle:
    """One arm, going through its jobs again and again."""

    def __init__(self, server, arm, moves):
        self.server, self.arm, self.moves = server, arm, moves
        self.next = 0
        self.last_goal = None  # where the accepted jobs end; None: wait until they have, and look

    def keep_busy(self, queue):
        waiting = [job for state in ("queued", "backlog", "scheduled", "running")
                   for job in queue[state] if self.arm in job["arms"]]
        if not waiting:
            self.last_goal = self.server.call("GET", f"/arms/{self.arm}")["q"]
        if len(waiting) < AHEAD and self.last_goal is not None:
            self.post_one()

    def post_one(self):
        move = self.moves[self.next]
        start = move["trajectory"]["points"][0]["positions"]
        if max(abs(a - b) for a, b in zip(start, self.last_goal)) > NEAR_RAD:
            self.next = 0  # the first move begins at home
            home = self.moves[0]["trajectory"]["points"][0]["positions"]
            names = move["trajectory"]["joint_names"]
            job = {"name": f"{self.arm}: back home", "trajectory": quintic(names, self.last_goal, home)}
        else:
            job = {"name": move["name"], "trajectory": move["trajectory"]}
            self.next = (self.next + 1) % len(self.moves)
        try:
            self.server.call("POST", "/jobs", job)
            self.last_goal = job["trajectory"]["points"][-1]["positions"]
        except urllib.error.HTTPError as error:
            print(f"demo: {error.code} {error.read().decode()}", file=sys.stderr)
            self.last_goal = None
            time.sleep(1)


def moves_of(arm, jobs):
    return [entry["job"] for entry in jobs
            if entry["job"]["trajectory"]["joint_names"][0].startswith(arm + "_")]


def alive(pid):
    return pid is None or os.path.exists(f"/proc/{pid}")


def main():
    if len(sys.argv) not in (3, 5):
        sys.exit(__doc__)
    parent = int(sys.argv[4]) if len(sys.argv) == 5 else None
    with open(sys.argv[2]) as file:
        jobs = json.load(file)
    server = Server(sys.argv[1])
    server.wait_until_up()
    shuttles = [Shuttle(server, arm["name"], moves_of(arm["name"], jobs))
                for arm in server.call("GET", "/arms")["arms"]]
    while alive(parent):
        try:
            queue = server.call("GET", "/queue")
            for shuttle in shuttles:
                if shuttle.moves and not queue["stopped"]:
                    shuttle.keep_busy(queue)
        except (urllib.error.URLError, ConnectionError, TimeoutError):
            if not alive(parent):
                break
        time.sleep(0.2)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:  # Ctrl-C at the terminal ends server and load alike
        pass
